//! `docs/sources.md`: what it says is there is there.

use crate::common;

use common::{finishes, here, straightline};
use std::path::Path;

/// The cells of every row.
fn rows(document: &str) -> Vec<Vec<String>> {
    let rows = document
        .lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| no.") && !line.contains("---"));
    let cells = |line: &str| {
        let line = line.replace("\\|", "\u{1}");
        let cells = line.trim_matches('|').split('|');
        cells.map(|cell| cell.trim().replace('\u{1}', "|")).collect()
    };
    rows.map(cells).collect()
}

/// Splits out the texts between backticks, with the text before each since the last one.
fn codes(cell: &str) -> Vec<(&str, &str)> {
    let parts: Vec<&str> = cell.split('`').collect();
    parts.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
}

fn document() -> String {
    std::fs::read_to_string(here("docs/sources.md")).expect("docs/sources.md")
}

#[test]
fn every_claim_has_a_place_or_a_reason() {
    let document = document();
    let rows = rows(&document);
    let mut counts = [("work,", 0), ("partly,", 0), ("are missing", 0)];
    for (k, row) in rows.iter().enumerate() {
        let [number, place, claim, state, evidence] = &row[..] else {
            panic!("{row:?} has {} cells", row.len());
        };
        assert_eq!(number, &(k + 1).to_string(), "{row:?}");
        assert!(
            !place.is_empty() && !claim.is_empty() && !evidence.is_empty(),
            "{row:?}"
        );
        let kind = ["works", "partly", "missing"].iter().position(|word| word == state);
        counts[kind.unwrap_or_else(|| panic!("{row:?}: `{state}`"))].1 += 1;
    }
    assert_eq!(rows.len(), 170);
    for (word, count) in counts {
        assert!(document.contains(&format!("{count} {word}")), "{count} {word}");
    }
}

/// Commands are taken, those that are quick are run and say what they are said to; files and sections are there.
#[test]
fn commands_files_and_sections_are_there() {
    let (mut commands, mut files) = (0, 0);
    let one_line = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    for row in rows(&document()) {
        let mut said = String::new();
        for (before, code) in codes(&row[4]) {
            if let Some(command) = code.strip_prefix("straightline ") {
                let mut arguments: Vec<&str> = command.split_whitespace().collect();
                if arguments[0] != "explain" {
                    arguments.push("--help");
                }
                let output = straightline(&arguments);
                let error = String::from_utf8_lossy(&output.stderr);
                assert!(output.status.success(), "{}: {command}: {error}", row[0]);
                said = one_line(&String::from_utf8_lossy(&output.stdout));
                commands += 1;
            } else if before.trim() == "gives" {
                assert!(said.contains(code), "{}: not `{code}` but {said}", row[0]);
            } else if code.contains('/') && !code.contains(' ') {
                assert!(Path::new(&here(code)).is_file(), "{}: there is no {code}", row[0]);
                files += 1;
            }
        }
        for link in row[4].split("](").skip(1) {
            let target = link.split(')').next().unwrap_or_default();
            let (path, section) = target.split_once('#').unwrap_or((target, ""));
            let path = here(&format!("docs/{path}"));
            let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {path}: {error}", row[0]));
            let slug = |line: &str| {
                let words = line.trim_start_matches('#').trim().to_lowercase().replace(' ', "-");
                words
                    .chars()
                    .filter(|c| c.is_alphanumeric() || *c == '-')
                    .collect::<String>()
            };
            let mut headings = text.lines().filter(|line| line.starts_with('#'));
            assert!(
                section.is_empty() || headings.any(|line| slug(line) == section),
                "{}: {path} has no section {section}",
                row[0]
            );
        }
    }
    assert!(commands > 80 && files > 25, "{commands} commands and {files} files");
}

/// The paper's counts stand beside ours where the options are the paper's. They are counted from the kernel.
#[test]
fn counts_of_the_paper_are_those_of_its_options() {
    let counts = |options: &[&str]| {
        let said = finishes(&[&["explain", "sraa", "--json"], options].concat());
        let said: serde_json::Value = serde_json::from_str(&said).expect("JSON");
        let of = |name: &str| said[name].as_u64();
        of("paper_weight_evaluations").zip(of("paper_texture_reads"))
    };
    // Section 3.5.
    assert_eq!(counts(&[]), Some((25, 58)));
    assert_eq!(counts(&["--set", "pattern=latin16"]), Some((81, 194)));
    assert_eq!(counts(&["--set", "preset=paper"]), Some((25, 58)));
    for option in [
        "metric=depth",
        "radius=2",
        "search=five",
        "pattern=standard8",
        "layout=superresolution",
    ] {
        assert_eq!(counts(&["--set", option]), None, "{option}");
    }
}
