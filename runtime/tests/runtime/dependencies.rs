//! A crate that includes its build script's output depends on no parser.

use std::collections::BTreeSet;
use std::process::Command;

/// Packages of the runtime by name: those it names itself, or all.
fn packages(arguments: &[&str]) -> BTreeSet<String> {
    let output = Command::new(env!("CARGO"))
        .args([
            "tree",
            "--locked",
            "--package",
            "straightline-runtime",
            "--edges",
            "normal",
        ])
        .args([
            "--prefix",
            "none",
            "--format",
            "{p}",
            "--target",
            "x86_64-unknown-linux-gnu",
        ])
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    let name = |line: &str| line.split(' ').next().unwrap_or_default().to_owned();
    String::from_utf8_lossy(&output.stdout).lines().map(name).collect()
}

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn constants_need_nothing_that_parses() {
    let own = [
        "straightline-files",
        "straightline-manifest",
        "straightline-runtime",
        "thiserror",
        "web-time",
        "wgpu",
    ];
    assert_eq!(packages(&["--depth", "1"]), set(&own));
    let all = packages(&[]);
    for parser in ["serde", "serde_json", "straightline-reflect"] {
        assert!(
            !all.contains(parser),
            "the runtime has {parser}: cargo tree -p straightline-runtime -i {parser}"
        );
    }
}

#[test]
fn manifests_are_read_behind_a_feature() {
    let all = packages(&["--features", "manifest"]);
    assert!(
        all.is_superset(&set(&["serde_json", "straightline-reflect"])),
        "{all:?}"
    );
}

#[test]
fn the_generator_is_behind_a_feature() {
    let generator = "straightline-codegen";
    assert!(!packages(&["--features", "manifest"]).contains(generator));
    assert!(packages(&["--features", "reload"]).contains(generator));
}
