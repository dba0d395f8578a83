//! The codes of errors: `docs/errors.md` holds the explanation of each, and the kernels in it are refused or taken as it says.
//!
//! `STRAIGHTLINE_BLESS=1` writes the page.

use std::collections::BTreeSet;
use std::path::Path;
use straightline_codegen::chain::{Chain, ChainSpec};
use straightline_codegen::diagnostic::Code;
use straightline_codegen::{EmitOptions, Kernel, Settings};

/// Heading of each hundred of numbers.
const STAGES: [(&str, &str); 9] = [
    ("E01", "Reading and syntax"),
    ("E02", "Names and items"),
    ("E03", "Types"),
    ("E04", "What the language does not have"),
    ("E05", "Evaluation"),
    ("E06", "Options and settings"),
    ("E07", "Emission"),
    ("E08", "Engines"),
    ("E09", "Mistakes in Straightline"),
];

const INTRODUCTION: &str = "# Errors

Every error has a code, which stands behind the word: `error[E0301]: mismatched types: ...`.
This page explains each code: what is refused, why, and what to write instead.
`straightline explain E0301` prints the same, `straightline check --message-format json` has it beside each error, and
a program that calls the generator finds it as `Diagnostic::code`.

Kernels below a code are compiled when the tests run: the first is refused with the code, the second is what to write.
";

/// The page that `docs/errors.md` is to be.
fn page() -> String {
    let mut page = INTRODUCTION.to_owned();
    for (stage, heading) in STAGES {
        page += &format!("\n## {heading}\n");
        for code in Code::ALL.iter().filter(|code| code.number().starts_with(stage)) {
            page += &format!("\n### {code}: {}\n\n{}", code.title(), code.explanation());
        }
    }
    page
}

/// Code blocks of an explanation with what stands behind their `rust`.
fn blocks(explanation: &str) -> Vec<(&str, &str)> {
    let mut found = Vec::new();
    let mut rest = explanation;
    while let Some((_, after)) = rest.split_once("```rust") {
        let (mark, after) = after.split_once('\n').expect("a line");
        let (text, after) = after.split_once("```").expect("the end of a block");
        found.push((mark.trim_start_matches(','), text));
        rest = after;
    }
    found
}

/// Codes with which a kernel or chain is refused; none if it is one.
fn codes_of(text: &str) -> BTreeSet<Code> {
    let errors = match Chain::find("k.rs", text, Some("k"), "k") {
        Ok(None) => {
            let compiled = Kernel::from_text("k.rs", text, "k").compile(&Settings::default());
            compiled.and_then(|compiled| compiled.emit(&EmitOptions::new())).err()
        }
        Ok(Some(chain)) => chain
            .compile(&ChainSpec::default())
            .and_then(|chain| chain.emit())
            .err(),
        Err(errors) => Some(errors),
    };
    let errors = errors.map(|errors| errors.diagnostics).unwrap_or_default();
    errors.iter().map(|error| error.code().expect("a code")).collect()
}

#[test]
fn the_page_explains_every_code() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/errors.md");
    let page = page();
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(&path, page).expect("the page is written");
        return;
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == page,
        "docs/errors.md is out of date: STRAIGHTLINE_BLESS=1 writes it"
    );
}

#[test]
fn numbers_ascend_and_lead_back() {
    let numbers: Vec<&str> = Code::ALL.iter().map(|code| code.number()).collect();
    assert!(numbers.is_sorted(), "{numbers:?}");
    assert_eq!(numbers.iter().collect::<BTreeSet<_>>().len(), numbers.len());
    for code in Code::ALL {
        assert_eq!(Code::from_number(code.number()), Some(*code));
        assert!(
            STAGES.iter().any(|(stage, _)| code.number().starts_with(stage)),
            "{code}"
        );
        assert!(code.explanation().len() > 60, "{code} is explained in a few words");
    }
    assert_eq!(Code::from_number("E9999"), None);
}

#[test]
fn explanations_are_true() {
    let mut wrong = Vec::new();
    for code in Code::ALL {
        for (mark, text) in blocks(code.explanation()) {
            let expected: BTreeSet<Code> = Code::from_number(mark).into_iter().collect();
            let found = codes_of(text);
            if found != expected {
                wrong.push(format!("{code} ({mark}): {found:?}\n{text}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
