//! Texts that users read: help, `list` and `explain`, as captured in `captures/`; completions; manual pages.
//!
//! After a rewording: `STRAIGHTLINE_BLESS=1 cargo test --workspace --test cli words::`.

use crate::common;

use common::{fails, finishes, here, scratch};
use std::path::Path;

/// The commands that people see, by the help of all.
fn commands() -> Vec<String> {
    let help = finishes(&["--help"]);
    let (_, list) = help.split_once("Commands:\n").expect("a list of commands");
    let lines = list.lines().take_while(|line| line.starts_with("  "));
    let names = lines.filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

#[test]
fn words_are_as_captured() {
    let kernel = here("kernels/filters/convolution.rs");
    for (name, arguments) in [
        ("help", &["--help"][..]),
        ("check", &["check", "--help"]),
        ("watch", &["watch", "-h"]),
        ("list", &["list"]),
        ("list-pcss", &["list", "pcss"]),
        ("list-godot", &["list", "godot"]),
        ("explain-convolution", &["explain", &kernel, "--unroll", "4"]),
    ] {
        let said = finishes(arguments);
        let path = here(&format!("cli/tests/captures/{name}.txt"));
        if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
            std::fs::write(&path, &said).expect("a capture is written");
        } else {
            let captured = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
            assert_eq!(
                said, captured,
                "{name}: if it is meant, run STRAIGHTLINE_BLESS=1 cargo test --workspace --test cli words::"
            );
        }
    }
}

#[test]
fn the_list_fits_a_screen_and_has_everything() {
    let list = finishes(&["list"]);
    assert!(list.lines().count() <= 24, "{list}");
    assert!(list.lines().all(|line| line.chars().count() <= 80), "{list}");
    let all: serde_json::Value = serde_json::from_str(&finishes(&["list", "--json"])).expect("JSON");
    for (of, rest) in [("kernels", 10), ("engines", 16)] {
        let entries = all[of].as_array().expect("a list");
        assert!(entries.len() >= rest);
        for entry in entries {
            let name = entry["name"].as_str().expect("a name");
            assert!(list.contains(name), "{name} is missing:\n{list}");
            let one: serde_json::Value = serde_json::from_str(&finishes(&["list", name, "--json"])).expect("JSON");
            assert_eq!(&one, entry);
            let text = finishes(&["list", name]);
            assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
            for option in entry["options"].as_array().into_iter().flatten() {
                assert!(
                    text.contains(&format!("\n  {}: ", option["name"].as_str().expect("a name"))),
                    "{text}"
                );
            }
        }
    }
    // A user's own kernel.
    let own = finishes(&["list", &here("kernels/filters/kuwahara.rs")]);
    assert!(
        own.contains("  radius: ") && own.contains("1 to 5, or uniform (default 3)"),
        "{own}"
    );
    fails(&["list", "nix"], 2, &["there is no kernel or engine `nix`"]);
    fails(&["list", "nix.rs"], 2, &["cannot read the kernel file `nix.rs`"]);
}

#[test]
fn a_bare_call_outside_of_cargo_prints_help() {
    let mut bare = std::process::Command::new(env!("CARGO_BIN_EXE_straightline"));
    let output = bare.env_remove("CARGO_MANIFEST_DIR").output().expect("the binary runs");
    assert!(output.status.success());
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        text.contains("Usage: straightline") && text.contains("  demo "),
        "{text}"
    );
}

#[test]
fn every_command_has_a_line_and_a_page() {
    let folder = scratch("man");
    let out = folder.join("man");
    let said = finishes(&["man", out.to_str().expect("a path")]);
    let help = finishes(&["--help"]);
    for command in commands() {
        let line = help
            .lines()
            .find(|line| line.trim_start().starts_with(&format!("{command} ")));
        assert!(line.is_some_and(|line| line.chars().count() <= 100), "{line:?}");
        let page = out.join(format!("straightline-{command}.1"));
        let text = std::fs::read_to_string(&page).unwrap_or_else(|error| panic!("{command}: {error}"));
        assert!(text.contains(".SH NAME") && text.contains(".SH SYNOPSIS"), "{text}");
        assert!(said.contains(&page.display().to_string()), "{said}");
    }
    assert!(out.join("straightline-study-loops.1").is_file() && !out.join("straightline-serve-isa.1").exists());
}

/// Bash is asked what it would offer, as its user would see it after a tab.
#[cfg(unix)]
#[test]
fn bash_completes_commands_options_and_files() {
    let folder = scratch("completions");
    common::write(&folder, "lens.rs", "");
    let script = common::write(&folder, "straightline.bash", &finishes(&["completions", "bash"]));
    let offered = |words: &[&str]| -> Vec<String> {
        let (last, before) = words.split_last().expect("a word");
        let previous = before.last().expect("the program");
        let count = before.len();
        let asked = format!(
            "source {script}; COMP_WORDS=({}); COMP_CWORD={count}; _straightline straightline '{last}' '{previous}'; printf '%s\\n' \"${{COMPREPLY[@]}}\"",
            words
                .iter()
                .map(|word| format!("'{word}'"))
                .collect::<Vec<_>>()
                .join(" ")
        );
        let output = std::process::Command::new("bash")
            .args(["-c", &asked])
            .current_dir(Path::new(&folder))
            .output()
            .expect("bash runs");
        String::from_utf8_lossy(&output.stdout)
            .lines()
            .map(str::to_owned)
            .collect()
    };
    assert_eq!(offered(&["straightline", "chec"]), ["check"]);
    assert_eq!(offered(&["straightline", "check", "--message-format", "j"]), ["json"]);
    assert_eq!(offered(&["straightline", "emit", "--acc"]), ["--accept-loss"]);
    for shell in ["zsh", "fish", "elvish", "powershell"] {
        let text = finishes(&["completions", shell]);
        for command in commands() {
            assert!(text.contains(&command), "{shell} does not know {command}");
        }
        assert!(!text.is_empty());
    }
    fails(&["completions", "csh"], 2, &["bash", "zsh"]);
}
