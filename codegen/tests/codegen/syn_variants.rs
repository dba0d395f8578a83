//! Every variant of syn's tree is either handled or rejected with a place; `docs/syn-variants.md` has the table.
//!
//! `STRAIGHTLINE_BLESS=1` writes the current table.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;
use straightline_codegen::{Kernel, Settings};

/// Declares the variants of enums that syn may not extend: the match has no arm for others.
macro_rules! closed {
    ($($name:ident: $($variant:ident)*;)*) => {
        const CLOSED: &[(&str, &[&str])] = &[$((stringify!($name), &[$(stringify!($variant)),*])),*];

        #[allow(dead_code, non_snake_case)]
        mod closed {
            $(pub fn $name(value: &syn::$name) -> bool {
                match value { $(syn::$name::$variant { .. } => true,)* }
            })*
        }
    };
}

closed! {
    AttrStyle: Outer Inner;
    Fields: Named Unnamed Unit;
    FnArg: Receiver Typed;
    GenericParam: Lifetime Type Const;
    Member: Named Unnamed;
    Meta: Path List NameValue;
    PathArguments: None AngleBracketed Parenthesized;
    PointerMutability: Const Mut;
    RangeLimits: HalfOpen Closed;
    ReturnType: Default Type;
    Safety: Safe Unsafe Default;
    Stmt: Local Item Expr Macro;
    UseTree: Path Name Rename Glob Group;
    Visibility: Public Restricted Inherited;
    WhereClausePlacement: Early Late;
}

/// Variants of the enums that syn may extend, as of syn 3.
const OPEN: &[(&str, &[&str])] = &[
    (
        "BinOp",
        &[
            "Add",
            "Sub",
            "Mul",
            "Div",
            "Rem",
            "And",
            "Or",
            "BitXor",
            "BitAnd",
            "BitOr",
            "Shl",
            "Shr",
            "Eq",
            "Lt",
            "Le",
            "Ne",
            "Ge",
            "Gt",
            "AddAssign",
            "SubAssign",
            "MulAssign",
            "DivAssign",
            "RemAssign",
            "BitXorAssign",
            "BitAndAssign",
            "BitOrAssign",
            "ShlAssign",
            "ShrAssign",
        ],
    ),
    (
        "Expr",
        &[
            "Array",
            "Assign",
            "Async",
            "Await",
            "Binary",
            "Block",
            "Break",
            "Call",
            "Cast",
            "Closure",
            "Const",
            "Continue",
            "Field",
            "ForLoop",
            "Group",
            "If",
            "Index",
            "Infer",
            "Let",
            "Lit",
            "Loop",
            "Macro",
            "Match",
            "MethodCall",
            "Paren",
            "Path",
            "Range",
            "RawAddr",
            "Reference",
            "Repeat",
            "Return",
            "Struct",
            "Try",
            "TryBlock",
            "Tuple",
            "Unary",
            "Unsafe",
            "Verbatim",
            "While",
            "Yield",
        ],
    ),
    ("ForeignItem", &["Fn", "Static", "Type", "Macro", "Verbatim"]),
    (
        "GenericArgument",
        &["Lifetime", "Type", "Const", "AssocType", "AssocConst", "Constraint"],
    ),
    ("ImplItem", &["Const", "Fn", "Type", "Macro", "Verbatim"]),
    (
        "Item",
        &[
            "Const",
            "Enum",
            "ExternCrate",
            "Fn",
            "ForeignMod",
            "Impl",
            "Macro",
            "Mod",
            "Static",
            "Struct",
            "Trait",
            "TraitAlias",
            "Type",
            "Union",
            "Use",
            "Verbatim",
        ],
    ),
    (
        "Lit",
        &[
            "Str", "ByteStr", "CStr", "Byte", "Char", "Int", "Float", "Bool", "Verbatim",
        ],
    ),
    (
        "Pat",
        &[
            "Const",
            "Guard",
            "Ident",
            "Lit",
            "Macro",
            "Or",
            "Paren",
            "Path",
            "Range",
            "Reference",
            "Rest",
            "Slice",
            "Struct",
            "Tuple",
            "TupleStruct",
            "Type",
            "Verbatim",
            "Wild",
        ],
    ),
    ("ReceiverKind", &["Value", "Reference", "Typed"]),
    ("StaticMutability", &["Mut", "None"]),
    ("TraitItem", &["Const", "Fn", "Type", "Macro", "Verbatim"]),
    (
        "Type",
        &[
            "Array",
            "FnPtr",
            "Group",
            "ImplTrait",
            "Infer",
            "Macro",
            "Never",
            "Paren",
            "Path",
            "Ptr",
            "Reference",
            "Slice",
            "TraitObject",
            "Tuple",
            "Verbatim",
        ],
    ),
    ("TypeParamBound", &["Trait", "Lifetime", "PreciseCapture", "Verbatim"]),
    ("UnOp", &["Deref", "Not", "Neg"]),
    ("WherePredicate", &["Lifetime", "Type"]),
];

/// Variants that parsing never produces.
const NEVER: [&str; 3] = ["Expr::Group", "Type::Group", "Lit::Verbatim"];

/// Returns whether the text, parsed by syn, contains the variant.
fn holds(debug: &str, variant: &str) -> bool {
    debug.match_indices(variant).any(|(at, _)| {
        let after = debug[at + variant.len()..].chars().next();
        let before = debug[..at].chars().next_back();
        !after.is_some_and(char::is_alphanumeric) && !before.is_some_and(char::is_alphanumeric)
    })
}

/// Returns a whole file: statements go into a kernel, items before it.
fn whole(text: &str) -> String {
    const HEAD: &str = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4";
    match text.split_once("===") {
        Some((items, body)) => format!("{items}\n{HEAD} {{ {body} }}\n"),
        None => format!("{HEAD} {{ let a = color.load(pixel); let x = a.x; {text}; a * x }}\n"),
    }
}

/// Compiles the file; returns `handled`, or the error.
fn result(file: &str) -> String {
    match Kernel::from_text("k.rs", file, "k").compile(&Settings::default()) {
        Ok(_) => "handled".to_owned(),
        Err(errors) => {
            let first = &errors.diagnostics[0];
            assert!(first.span.is_some(), "no place: {}\n{file}", first.message);
            format!("refused: {}", first.message)
        }
    }
}

#[test]
fn every_variant_is_handled_or_refused() {
    let listed = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/syn_variants.txt");
    let listed = std::fs::read_to_string(listed).expect("the examples");
    let cases: Vec<(&str, &str)> = listed
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .map(|line| line.split_once(" | ").unwrap_or_else(|| panic!("no ` | ` in {line}")))
        .collect();
    let mut table = String::from(
        "# Support for each kind of Rust syntax\n\n\
         The front end parses kernels with syn.\n\
         The tables list every variant of syn's syntax tree, with an example and the result.\n\
         The generator either handles a variant, or refuses it with an error if a kernel reaches it.\n\
         `cargo test -p straightline-codegen --test codegen syn_variants::` checks this page.\n",
    );
    let mut seen = BTreeSet::new();
    let mut wrong = Vec::new();
    for (name, variants) in CLOSED.iter().chain(OPEN) {
        let _ = write!(
            table,
            "\n## `{name}`\n\n| variant | example | result |\n| --- | --- | --- |\n"
        );
        for variant in *variants {
            let full = format!("{name}::{variant}");
            if NEVER.contains(&full.as_str()) {
                let _ = writeln!(table, "| {variant} | | never produced by parsing |");
                continue;
            }
            let examples: Vec<&str> = cases
                .iter()
                .filter(|(n, _)| *n == full)
                .map(|(_, text)| *text)
                .collect();
            if examples.is_empty() {
                wrong.push(format!("no example of {full}"));
            }
            for text in examples {
                let file = whole(text);
                seen.insert(full.clone());
                match syn::parse_file(&file) {
                    Ok(parsed) if holds(&format!("{parsed:?}"), &full) => {}
                    Ok(_) => wrong.push(format!("{full} is not in {file}")),
                    Err(error) => wrong.push(format!("{full}: {error} in {file}")),
                }
                let shown = text.replace("===", "…").replace('|', "\\|");
                let _ = writeln!(
                    table,
                    "| {variant} | `{shown}` | {} |",
                    result(&file).replace('|', "\\|")
                );
            }
        }
    }
    wrong.extend(
        cases
            .iter()
            .filter(|(full, _)| !seen.contains(*full))
            .map(|(full, _)| format!("{full} is in no list")),
    );
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/syn-variants.md");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(&path, &table).expect("the table is written");
    } else {
        let known = std::fs::read_to_string(&path).unwrap_or_default();
        assert_eq!(known, table, "bless with STRAIGHTLINE_BLESS=1, and read what changed");
    }
}
