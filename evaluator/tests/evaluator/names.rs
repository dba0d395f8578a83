//! Every public name of Rust's types and of glam's: taken, refused with the text to write, or none of a shader's matter.
//!
//! `tests/names/names.txt` is the list. A name that counts as taken is evaluated in a small kernel, and the message of one that
//! is refused has the text to write. `STRAIGHTLINE_BLESS=1` writes `tests/names/verdicts.txt` and the table of
//! `docs/kernel-language.md`.

#[path = "names/list.rs"]
mod list;

use list::Name;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Diagnostic, File};
use straightline_evaluator::eval::evaluate_kernel;
use straightline_evaluator::ir::Invocation;
use straightline_evaluator::limits::{Limits, Meter};
use straightline_evaluator::policy::Policy;
use straightline_evaluator::{front, infer};

/// Outcome of a name.
enum Verdict {
    Taken,
    /// The message, with the text to write.
    Refused(String),
    /// The reason why no shader needs it.
    Outside(&'static str),
    /// The message: none of the above.
    Missing(String),
}

/// Reasons why no shader needs a name, each with words of names or signatures. `=name` is the whole name, `name(` its end.
#[rustfmt::skip]
const OUTSIDE: [(&str, &[&str]); 9] = [
    ("panics", &["strict_", "=expect", "=expect_err", "=unwrap_err", "=unwrap"]),
    ("processor", &["USES_", "select_unpredictable", "Vec3A", "Mat3A", "affine3a", "mat3a", "vec3a", "NonZero"]),
    ("memory", &[
        "ptr", "*const", "*mut", "uninit", "unchecked", "assume_init", "align_to", "write_copy", "write_clone", "Box<", "Vec<",
        "to_vec", "into_vec", "=concat", "=join", "element_offset", "Pin<", "iter_mut", "as_mut", "get_or_insert", "_mut(", "_mut<",
        "_mut_", "split_off", "get_disjoint", "new_zeroed", "=repeat", "sort_by_cached_key", "IterMut",
    ]),
    ("text", &["&str", "ascii", "char", "_bytes", "Formatter", "String", "utf8", "escape", "[u8", "from_str_radix", "strip_"]),
    ("width", &[
        "f64", "u64", "i64", "u128", "i128", "DVec", "DMat", "DQuat", "DAffine", "I8Vec", "U8Vec", "I16Vec", "U16Vec", "I64Vec",
        "U64Vec", "USizeVec", "ISizeVec", "f16", "isize", "carrying_", "borrowing_",
    ]),
    ("byte order", &["=from_be", "=from_le", "=to_be", "=to_le", "=swap_bytes"]),
    ("format of floats", &["=RADIX", "DIGITS", "_EXP"]),
    ("ordering", &["Ordering", "=total_cmp", "=partial_cmp", "=cmp"]),
    ("errors", &["Try", "try_", "inspect", "Residual", "as_deref"]),
];

fn evaluate(text: &str) -> Result<(), Box<Diagnostic>> {
    let files = Arc::new(vec![File {
        path: "k.rs".to_owned(),
        text: text.to_owned(),
    }]);
    let first = |errors: Vec<Diagnostic>| Box::new(errors.into_iter().next().expect("an error"));
    let mut parsed = front::parse(&files, "k").map_err(|errors| first(errors.diagnostics))?;
    let mut wrong = parsed.errors.clone();
    if let Err(mistyped) = infer::infer_types(&mut parsed.library, &parsed.reached) {
        wrong.extend(mistyped);
    }
    if !wrong.is_empty() {
        return Err(first(wrong));
    }
    let _meter = Meter::open(Limits::DEFAULT);
    let found = evaluate_kernel(&parsed.library, &files, "k", &[], &Policy::default(), Invocation::Pixel);
    found.map(drop).map_err(|errors| first(errors.diagnostics))
}

/// Returns the kernel that a statement is tried in.
fn kernel(statement: &str) -> String {
    format!(
        "pub fn k(f: f32, i: i32, u: u32, b: bool, v2: Vec2, v3: Vec3, v4: Vec4, i2: IVec2, i3: IVec3, i4: IVec4, u2: UVec2, \
         u3: UVec3, u4: UVec4, m2: Mat2, m3: Mat3, m4: Mat4, pixel: IVec2) -> Vec4 {{\n    {statement}\n    Vec4::ZERO\n}}\n"
    )
}

fn judge(name: &Name) -> Verdict {
    let whole = format!("{}{}", name.name, name.signature);
    let has = |word: &str| match word.strip_prefix('=') {
        Some(word) => name.name == word,
        None => whole.contains(word),
    };
    let outside = OUTSIDE.iter().find(|(_, words)| words.iter().any(|word| has(word)));
    let Some(statement) = name.statement() else {
        return match outside {
            Some((why, _)) => Verdict::Outside(why),
            None => Verdict::Missing("no call is known".to_owned()),
        };
    };
    match (evaluate(&kernel(&statement)), outside) {
        (Ok(()), _) => Verdict::Taken,
        (Err(_), Some((why, _))) => Verdict::Outside(why),
        (Err(error), None) => {
            let help = error.help.clone().unwrap_or_default();
            let text = format!("{}; {help}", error.message);
            match help.starts_with("write ") {
                true => Verdict::Refused(text),
                false => Verdict::Missing(text),
            }
        }
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// Marks around the table of `docs/kernel-language.md`.
const MARKS: [&str; 2] = ["<!-- names -->\n", "<!-- end of names -->"];

/// Compares a text with the one that is kept, or keeps it.
#[track_caller]
fn compare_kept(path: &Path, found: &str) {
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(path, found).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        return;
    }
    let kept = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    for (kept, found) in kept.lines().zip(found.lines()) {
        assert_eq!(kept, found, "STRAIGHTLINE_BLESS=1 writes {}", path.display());
    }
    assert_eq!(kept.lines().count(), found.lines().count());
}

#[test]
fn every_name_is_taken_or_has_a_reason() {
    let mut verdicts = String::new();
    let mut counts: Vec<(&str, [usize; 3])> = Vec::new();
    let mut missing = Vec::new();
    for name in Name::all() {
        if counts.last().is_none_or(|(of, _)| *of != name.of) {
            counts.push((name.of, [0; 3]));
        }
        let (column, said) = match judge(&name) {
            Verdict::Taken => (0, "taken".to_owned()),
            Verdict::Refused(message) => (1, format!("refused: {message}")),
            Verdict::Outside(why) => (2, format!("no shader's matter: {why}")),
            Verdict::Missing(message) => {
                missing.push(format!("{}::{}: {message}", name.of, name.name));
                continue;
            }
        };
        if let Some((_, count)) = counts.last_mut() {
            count[column] += 1;
        }
        let _ = writeln!(verdicts, "{} {}: {}", name.of, name.name, said.replace('\n', " "));
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
    compare_kept(&root().join("tests/names/verdicts.txt"), &verdicts);
    let mut table = String::from(
        "\n| type | taken | refused with the text to write | no shader's matter |\n| --- | --: | --: | --: |\n",
    );
    let mut sum = [0; 3];
    for (of, [taken, refused, outside]) in &counts {
        let _ = writeln!(table, "| `{of}` | {taken} | {refused} | {outside} |");
        sum = [sum[0] + taken, sum[1] + refused, sum[2] + outside];
    }
    let _ = writeln!(table, "| all | {} | {} | {} |\n", sum[0], sum[1], sum[2]);
    let path = root().join("../docs/kernel-language.md");
    let page = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let (before, rest) = page.split_once(MARKS[0]).expect("the mark");
    let (_, after) = rest.split_once(MARKS[1]).expect("the end");
    compare_kept(&path, &format!("{before}{}{table}{}{after}", MARKS[0], MARKS[1]));
}
