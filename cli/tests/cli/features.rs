//! Features of the command: all of them where the tests are run, and few where the README begins.

use crate::common;

use common::here;
use std::collections::BTreeSet;
use std::process::Command;

/// Crates that a first `cargo run --release` does without, each with those below it: they make the build minutes longer.
const LEFT_OUT: [&str; 16] = [
    "aho-corasick",
    "exr",
    "gltf",
    "image",
    "khronos-egl",
    "moxcms",
    "pest",
    "plotters",
    "pulp",
    "regex-automata",
    "schemars",
    "smaa",
    "straightline-isa",
    "straightline-study",
    "tobj",
    "wayland-sys",
];

/// The packages of the command with `features`, on Linux: name and version.
fn packages(features: &str) -> BTreeSet<String> {
    let arguments = [
        "tree",
        "--locked",
        "--package",
        "straightline",
        "--edges",
        "normal,build",
        "--prefix",
        "none",
    ];
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .args([
            "--format",
            "{p}",
            "--target",
            "x86_64-unknown-linux-gnu",
            "--features",
            features,
        ])
        .current_dir(here(""))
        .output()
        .expect("cargo runs");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    let name = |line: &str| line.split(' ').take(2).collect::<Vec<_>>().join(" ");
    String::from_utf8_lossy(&output.stdout).lines().map(name).collect()
}

#[test]
fn all_features_are_there_where_tests_run() {
    for (name, built) in straightline_features::FEATURES {
        assert!(built, "`{name}` is not built in: cargo test --workspace");
    }
}

/// So that the first build takes some two minutes: CONTRIBUTING.md has the times, and these numbers.
#[test]
fn the_default_build_is_small() {
    let (small, full) = (packages(""), packages("full"));
    let name = |package: &String| package.split(' ').next().unwrap_or_default().to_owned();
    let names: BTreeSet<String> = small.iter().map(name).collect();
    let all: BTreeSet<String> = full.iter().map(name).collect();
    for left_out in LEFT_OUT {
        assert!(
            !names.contains(left_out),
            "the default build has {left_out} again: cargo tree -i {left_out}"
        );
    }
    assert!(all.contains("straightline-study") && all.contains("exr") && all.contains("gltf"));
    // The workspace's own crates are its code, in however many parts.
    let of_others = names.iter().filter(|name| !name.starts_with("straightline")).count();
    assert!(of_others <= 120, "the default build has {of_others} packages of others");
    let document = std::fs::read_to_string(here("CONTRIBUTING.md")).expect("CONTRIBUTING.md");
    for (count, of) in [(small.len(), "default features"), (full.len(), "`--features full`")] {
        let row = format!("| {of} | {count} |");
        assert!(document.contains(&row), "CONTRIBUTING.md does not say `{row}`");
    }
}
