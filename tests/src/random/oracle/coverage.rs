//! Constructs that random kernels contain.

use crate::random::make::{Features, make};
use std::collections::BTreeSet;
use std::path::Path;
use straightline_codegen::Kernel;

/// Names that the page documents and that no random kernel calls, since Rust's library computes them in other bits.
pub const NOT_COMPARED: &[&str] = &["hypot", "log10"];

/// Names in the page's sections that are of the host, of shaders, or of an example.
const NOT_OF_KERNELS: &[&str] = &[
    "bins_count",
    "bins_sum",
    "coord",
    "csv",
    "frame_size",
    "grade_x_axis",
    "lights_0_position",
    "palette_0",
    "rs",
    "scene_tint",
    "storageBarrier",
    "vec2u",
    "workgroupBarrier",
];

/// Constructs that neither the tree nor the page names, by a text that each has.
const CONSTRUCTS: &[(&str, &str)] = &[
    ("a structure in an array", ": [S"),
    ("a constant parameter", "<const N: usize>"),
    ("a slice without an end", "..]"),
    ("a slice without a start", "[.."),
    ("a slice that is iterated", "].iter_mut()"),
    ("a derived order", "PartialOrd, Ord)]"),
    ("a derived order of floats", "PartialEq, PartialOrd)]"),
    ("an order written by hand", "impl Ord for"),
    ("an order of floats written by hand", "impl PartialOrd for"),
    ("the order of two values", ".cmp(&"),
    ("the larger of two values", "std::cmp::max("),
    ("a discriminant that is stated", "V0 = "),
    ("a discriminant of a runtime value", "}) as i32)"),
    ("a structure in an array at a runtime index", " as usize].f0"),
    ("an object in a variable", ": &dyn Ob = if"),
    ("an object in an array", ": [&dyn Ob; 3]"),
    ("an object in a structure", "Lit { ob: if"),
    ("an object of a `match`", ": &dyn Ob = match"),
    ("an object as an argument", "by_object(if"),
    ("a closure in a structure", "Holds { f: |"),
    ("a closure behind a reference in a structure", "Lent { f: &|"),
    ("a function in a structure", "Curve { f: "),
    ("an array of functions", ": [fn(f32) -> f32; 3]"),
    ("a runtime range that is filtered", "..(q & 3)).filter("),
    ("a runtime range that is turned", "..(q & 3)).rev()"),
    ("a runtime range from its second value on", "..(q & 3)).skip(1)"),
    ("the first values of a runtime range", "..(q & 3)).take(2)"),
    ("a runtime range by steps", "..(q & 3)).step_by(2)"),
    ("runtime ranges side by side", ").zip(("),
    ("a runtime range and its places", "..(q & 3)).enumerate()"),
    ("a loop over a runtime range behind adaptors", "in (0..(q & 3))."),
    ("arrays that are flattened", ".flat_map(|"),
    ("a generic structure of a constant", "Ring::<"),
    ("a constant that a type tells", ": [f32; 3] = steps("),
    ("an associated type", "along(&Line"),
    ("an associated type that is a parameter", "along(&Bent"),
    ("a default of a type parameter", "wide(Wide"),
];

/// Constructs that are missing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Missing {
    /// Variants of the front end's tree, `Enum::Variant`.
    pub variants: BTreeSet<String>,
    /// Other constructs.
    pub constructs: BTreeSet<String>,
    /// Names in the language's page.
    pub names: BTreeSet<String>,
}

/// Finds the constructs of the front end's tree, and the page's names, that kernels of the first seeds never have.
///
/// # Errors
///
/// A file of the repository cannot be read.
pub fn missing(seeds: std::ops::Range<u64>) -> Result<Missing, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let read = |path: &str| std::fs::read_to_string(root.join(path)).map_err(|e| format!("{path}: {e}"));
    let variants = variants(&read("evaluator/src/front/tree.rs")?);
    let names = names(&read("docs/kernel-language.md")?);
    let mut missing = Missing {
        constructs: CONSTRUCTS.iter().map(|(name, _)| (*name).to_owned()).collect(),
        variants: variants.iter().map(|(of, name)| format!("{of}::{name}")).collect(),
        names: names
            .into_iter()
            .filter(|name| !NOT_OF_KERNELS.contains(&name.as_str()) && !NOT_COMPARED.contains(&name.as_str()))
            .collect(),
    };
    for seed in seeds {
        let text = make(seed, Features::all());
        missing.names.retain(|name| !calls(&text.source, name));
        for (name, construct) in CONSTRUCTS {
            if text.source.contains(construct) {
                missing.constructs.remove(*name);
            }
        }
        if missing.variants.is_empty() {
            continue;
        }
        // Text that the front end refuses has no tree.
        if let Ok(tree) = Kernel::from_text("random.rs", &text.file(), "k").debug_tree() {
            missing.variants.retain(|variant| !has(&tree, variant));
        }
    }
    Ok(missing)
}

/// The variants of the enums that a kernel's tree is made of, from the text that defines them.
fn variants(text: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut of: Option<&str> = None;
    for line in text.lines() {
        if let Some(rest) = line.strip_prefix("pub enum ") {
            of = Some(rest.trim_end_matches(" {"));
        } else if line == "}" {
            of = None;
        } else if let Some(of) = of
            && let Some(name) = line.strip_prefix("    ").filter(|l| l.starts_with(char::is_uppercase))
        {
            let end = name.find(|c: char| !c.is_alphanumeric()).unwrap_or(name.len());
            found.push((of.to_owned(), name[..end].to_owned()));
        }
    }
    found
}

/// Returns whether a tree, in its `Debug` form, has a variant. Kinds of expressions follow `kind: `, everything else does not.
fn has(tree: &str, variant: &str) -> bool {
    let (of, name) = variant.split_once("::").expect("an enum and a variant");
    match of {
        "ExprKind" => tree.match_indices("kind: ").any(|(at, k)| {
            let rest = &tree[at + k.len()..];
            rest.strip_prefix(name)
                .is_some_and(|after| !after.starts_with(char::is_alphanumeric))
        }),
        _ => tree.match_indices(name).any(|(at, _)| {
            let before = &tree[..at];
            let after = tree[at + name.len()..].chars().next();
            let whole = !before.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '"');
            whole && !before.ends_with("kind: ") && after.is_none_or(|c| !c.is_alphanumeric() && c != '_')
        }),
    }
}

/// The names in backticks of the sections that list methods, functions and types.
fn names(page: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut section = "";
    let mut code = false;
    for line in page.lines() {
        section = line.strip_prefix("## ").unwrap_or(section);
        if line.starts_with("```") {
            code = !code;
        }
        if code {
            continue;
        }
        for word in line.split('`').skip(1).step_by(2) {
            let name = match section {
                "Mathematics" | "Integers and bits" | "Matrices" | "Loops" | "Closures" | "Arrays" => method(word),
                "What a kernel reads" | "What a kernel writes" | "Workgroups" => method_or_type(word),
                _ => None,
            };
            found.extend(name.map(str::to_owned));
        }
    }
    found
}

/// A word that is the name of a method or function, and nothing else.
fn method(word: &str) -> Option<&str> {
    let word = word.trim_start_matches('.').trim_end_matches("()");
    let of_name = |c: char| c.is_ascii_lowercase() || c == '_' || c.is_ascii_digit();
    // Refused, or a lane's name.
    let name = !word.is_empty() && word.chars().all(of_name) && !["signum", "for", "while", "loop"].contains(&word);
    name.then_some(word)
}

/// The method of a text like `sample(sampler, uv)` or `thread.index`, or the type of one like `&Frame<T>`.
fn method_or_type(text: &str) -> Option<&str> {
    let text = text.trim_start_matches('&');
    let end = text.find(['(', '<']).unwrap_or(text.len());
    let name = text[..end].rsplit('.').next()?;
    let of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    (name.len() > 1 && name.chars().all(of_name)).then_some(name)
}

/// Returns whether a text has a name as a word.
fn calls(source: &str, name: &str) -> bool {
    source.match_indices(name).any(|(at, _)| {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        !source[..at].ends_with(word) && !source[at + name.len()..].starts_with(word)
    })
}
