//! `figures`, and what `docs/figures.md` says of them.

use crate::common;

use common::{finishes, here, scratch, straightline};
use std::path::Path;

#[test]
fn captions_are_what_the_command_gives() {
    let text = std::fs::read_to_string(here("docs/figures.md")).expect("the document");
    let folder = scratch("figures");
    let out = folder.to_str().unwrap();
    for (name, methods) in [
        (
            "sraa-04",
            [
                ("normals", "SRAA 4, normals"),
                ("depth", "SRAA 4, depth"),
                ("both", "SRAA 4"),
            ],
        ),
        (
            "sraa-05",
            [
                ("depth", "SRAA 4, depth"),
                ("depth and normals", "SRAA 4"),
                ("planes and normals", "SRAA 4, planes and normals"),
            ],
        ),
    ] {
        let said = finishes(&["figures", "--figure", name, "--out", out]);
        let picture = folder.join(format!("{name}.png"));
        assert!(picture.is_file(), "{}", picture.display());
        let row = text
            .lines()
            .find(|line| line.contains(&format!("`{name}`:")))
            .expect("a row");
        let (_, row) = row.split_once(&format!("`{name}`: ")).expect("a caption");
        for (words, method) in methods {
            let after = |text: &str, before: &str| -> f64 {
                let number = |part: &str| {
                    let rest = part.trim().strip_prefix(before)?.strip_prefix(' ')?;
                    rest.split(' ').next()?.parse().ok()
                };
                let found = text.split([';', ',']).find_map(number);
                found.unwrap_or_else(|| panic!("no `{before}` in {text}"))
            };
            // A method's name has commas of its own.
            let said = said.replace(method, "THIS");
            let (found, caption) = (after(&said, "THIS"), after(row, words));
            assert!(
                (found - caption).abs() < 0.11,
                "{name}, {method}: {found}, and the caption says {caption}"
            );
        }
    }
}

#[test]
fn every_figure_is_in_the_document() {
    let text = std::fs::read_to_string(here("docs/figures.md")).expect("the document");
    let output = straightline(&["figures", "--figure", "none", "--out", "unused"]);
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(error.contains("there is no figure `none`"), "{error}");
    let names = error.split("there are ").nth(1).expect("a list").trim();
    let names: Vec<&str> = names.split(", ").map(str::trim).collect();
    assert_eq!(names.len(), 12, "{names:?}");
    for name in names {
        assert!(text.contains(&format!("`{name}`")), "{name}");
        assert!(text.contains(&format!("](figures/{name}.png)")), "{name}");
        assert!(
            Path::new(&here(&format!("docs/figures/{name}.png"))).is_file(),
            "{name}"
        );
    }
}
