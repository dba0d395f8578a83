//! Texts that are nearly kernels.

use super::Random;
use super::make::{Features, make};
use std::path::Path;

/// Deepest nesting that is made.
const NESTING: usize = 600;

/// Words to put anywhere.
const WORDS: &[&str] = &[
    "fn",
    "let",
    "mut",
    "if",
    "else",
    "for",
    "in",
    "while",
    "loop",
    "match",
    "return",
    "break",
    "continue",
    "struct",
    "impl",
    "const",
    "pub",
    "use",
    "mod",
    "enum",
    "true",
    "false",
    "as",
    "self",
    "Self",
    "f32",
    "i32",
    "u32",
    "usize",
    "bool",
    "Vec2",
    "Vec4",
    "IVec2",
    "Frame<Vec4>",
    "a",
    "pixel",
    "k",
    "load",
    "v0",
    "v1",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "<",
    ">",
    "..",
    "..=",
    ";",
    ",",
    ".",
    "::",
    "->",
    "=>",
    "=",
    "==",
    "+=",
    "+",
    "-",
    "*",
    "/",
    "%",
    "&",
    "&&",
    "|",
    "||",
    "!",
    "^",
    "<<",
    ">>",
    "#",
    "'",
    "\"",
    "'a",
    "_",
    "?",
    "@",
    "$",
    "0",
    "1",
    "-1",
    "2147483647",
    "4294967295",
    "4294967296",
    "1e38",
    "1e39",
    "1.0",
    "1.",
    "0x10",
    "1u64",
    "options!",
    "tally",
    "\u{0}",
    "é",
    "//",
    "/*",
    "*/",
    "r#fn",
    ".rev()",
    ".step_by(0)",
    ".len()",
    ".iter()",
    ".clamp(",
    ".xyzw()",
    "unsafe",
    "async",
    "|x|",
];

/// Texts to nest: beginning and end.
const NESTED: &[(&str, &str)] = &[
    ("(", ")"),
    ("[", "]"),
    ("{", "}"),
    ("-", ""),
    ("!", ""),
    ("&", ""),
    ("if true {", "} else { 0 }"),
    ("(1 + ", ")"),
    ("f0(", ")"),
    ("1 + ", "1"),
    ("return ", ""),
    ("&&", ""),
    ("for v0 in 0..2 {", "}"),
    ("match 1 { _ => ", "}"),
    ("mod m {", "}"),
    ("Vec<", ">"),
    ("|v0| ", ""),
];

/// Kernels to change.
#[derive(Clone, Debug)]
pub struct Texts {
    files: Vec<String>,
}

impl Texts {
    /// The kernels of this repository, and random ones.
    pub fn of_repository() -> Texts {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let mut files = Vec::new();
        collect(&root.join("kernels/src"), &mut files);
        collect(&root.join("examples/build-rs/src/kernels"), &mut files);
        assert!(!files.is_empty(), "the repository's kernels");
        Texts { files }
    }

    /// The text of a seed, and the function in it that is to be the kernel.
    pub fn text(&self, seed: u64) -> (String, &'static str) {
        let mut random = Random(seed);
        let (text, function) = if random.once_in(3) {
            let text = random.pick(&self.files);
            let function = if text.contains("fn glow") { "glow" } else { "sraa" };
            (text, function)
        } else {
            (make(random.bits(), Features::all()).file(), "k")
        };
        let mut bytes = text.into_bytes();
        // A single change leaves much that can still be evaluated; more changes reach more of the parser's errors.
        let changes = if random.once_in(2) { 1 } else { 2 + random.below(3) };
        for _ in 0..changes {
            mutate(&mut bytes, &mut random);
        }
        (String::from_utf8_lossy(&bytes).into_owned(), function)
    }
}

fn collect(folder: &Path, files: &mut Vec<String>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|e| e.path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.extend(std::fs::read_to_string(&path));
        }
    }
}

/// Approximate range of a token.
fn token(bytes: &[u8], random: &mut Random) -> (usize, usize) {
    let word = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
    let at = random.below(bytes.len());
    let (mut start, mut end) = (at, at + 1);
    while start > 0 && word(bytes[at]) && word(bytes[start - 1]) {
        start -= 1;
    }
    while end < bytes.len() && word(bytes[at]) && word(bytes[end]) {
        end += 1;
    }
    (start, end)
}

fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    if bytes.is_empty() {
        return;
    }
    let (start, end) = token(bytes, random);
    let (from, to) = token(bytes, random);
    match random.below(12) {
        10 | 11 if bytes[start].is_ascii_digit() => {
            // Larger numbers make loops that only a limit ends, which takes its time.
            let number = random.pick(&[
                "0", "1", "2", "3", "7", "31", "32", "255", "1000", "0.5", "1e30", "0u32",
            ]);
            bytes.splice(start..end, number.bytes());
        }
        10 | 11 => {
            // Another word of the text in its place.
            let other = bytes[from..to].to_vec();
            bytes.splice(start..end, other);
        }
        0 => bytes[start] ^= 1 << random.below(8),
        1 => bytes.truncate(start),
        2 => {
            bytes.drain(start..end);
        }
        3..=4 => {
            let word = format!(" {} ", random.pick(WORDS));
            bytes.splice(start..end, word.into_bytes());
        }
        5 => {
            let word = format!(" {} ", random.pick(WORDS));
            bytes.splice(start..start, word.into_bytes());
        }
        6 => {
            let other = bytes[from..to].to_vec();
            bytes.splice(start..end, other);
        }
        7 => {
            // A piece of a few lines, said twice or left out.
            let end = (start + 1 + random.below(200)).min(bytes.len());
            let piece = if random.once_in(2) {
                Vec::new()
            } else {
                bytes[start..end].repeat(2)
            };
            bytes.splice(start..end, piece);
        }
        8 => {
            let (open, close) = random.pick(NESTED);
            let deepest = if random.once_in(4) { NESTING } else { 20 };
            let times = 1 + random.below(deepest);
            let inner = bytes[start..end].to_vec();
            let nested = [open.repeat(times).into_bytes(), inner, close.repeat(times).into_bytes()].concat();
            bytes.splice(start..end, nested);
        }
        _ => bytes[start] = random.bits() as u8,
    }
}
