//! `page` on the command line: the whole page, or nothing of it.

use crate::common;

use common::{fails, finishes, is_empty, scratch, straightline, write};
use std::fs;
use std::process::Command;

/// The smallest module that has what the page calls.
const MODULE: &[u8] = b"\0asm\x01\0\0\0\x07\x26\x04\x06memory\x02\0\x07request\0\0\x04call\0\x01\x08answered\0\x02";

#[test]
fn the_whole_page_is_written() {
    let folder = scratch("page-whole");
    let module = folder.join("module.wasm");
    fs::write(&module, MODULE).expect("a module");
    let out = folder.join("out").join("page");
    let arguments = [
        "page",
        "--out",
        out.to_str().unwrap(),
        "--module",
        module.to_str().unwrap(),
        "--templates",
        module.to_str().unwrap(),
    ];
    let said = finishes(&arguments);
    assert_eq!(said.trim_end(), out.join("index.html").display().to_string());
    for (name, bytes) in straightline_page::FILES {
        assert_eq!(fs::read(out.join(name)).expect(name), *bytes);
    }
    for name in [straightline_page::GENERATOR, straightline_page::TEMPLATES] {
        assert_eq!(fs::read(out.join(name)).expect("the module"), MODULE);
    }
    let count = fs::read_dir(&out).expect("the page").count();
    assert_eq!(count, straightline_page::FILES.len() + 2);
    // Once more changes nothing.
    let before = fs::metadata(out.join("main.js"))
        .and_then(|m| m.modified())
        .expect("a time");
    finishes(&arguments);
    assert_eq!(
        fs::metadata(out.join("main.js"))
            .and_then(|m| m.modified())
            .expect("a time"),
        before
    );
}

#[test]
fn without_the_generator_nothing_is_written() {
    let folder = scratch("page-refused");
    let out = folder.join("out");
    let out_text = out.to_str().unwrap();
    let text = write(&folder, "text.wasm", "no module");
    fails(
        &["page", "--out", out_text, "--module", &text, "--templates", &text],
        1,
        &["text.wasm", "no WebAssembly module", "page/build"],
    );
    fails(
        &[
            "page",
            "--out",
            out_text,
            "--module",
            "missing.wasm",
            "--templates",
            &text,
        ],
        1,
        &["cannot read the module `missing.wasm`"],
    );
    fails(&["page", "--out", out_text, "--module", &text], 2, &["--templates"]);
    fails(&["page"], 2, &["--out"]);
    assert!(is_empty(&out));
    // A folder that cannot be written to is reported before anything is built.
    let file = write(&folder, "file", "");
    fails(
        &["page", "--out", &format!("{file}/page")],
        1,
        &["cannot write to the folder"],
    );
    // Nor is a generator built where there is no source.
    let outside = std::env::temp_dir();
    let binary = env!("CARGO_BIN_EXE_straightline");
    let output = Command::new(binary)
        .current_dir(outside)
        .args(["page", "--out", out_text])
        .output();
    let output = output.expect("the binary runs");
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.contains("--module") && error.contains("checkout"), "{error}");
    assert!(is_empty(&out));
}

#[test]
fn what_was_there_stays_after_an_error() {
    let folder = scratch("page-kept");
    let module = folder.join("module.wasm");
    fs::write(&module, MODULE).expect("a module");
    let out = folder.join("out");
    // A folder stands where a file must go.
    fs::create_dir_all(out.join("main.js")).expect("a folder");
    fs::write(out.join("index.html"), "mine").expect("a file");
    let arguments = [
        "page",
        "--out",
        out.to_str().unwrap(),
        "--module",
        module.to_str().unwrap(),
        "--templates",
        module.to_str().unwrap(),
    ];
    let output = straightline(&arguments);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(fs::read_to_string(out.join("index.html")).expect("mine"), "mine");
    assert_eq!(fs::read_dir(&out).expect("a folder").count(), 2);
}
