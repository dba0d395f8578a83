//! `shaders-out/` holds what the generator emits today, and every file of it is valid to a second compiler.
//!
//! After a change of the generator: `STRAIGHTLINE_BLESS=1 cargo test -p straightline-tests --test drift`, and read the
//! difference.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use straightline_codegen::{default_set, files};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders-out")
}

#[test]
fn shaders_out_is_up_to_date() {
    let expected = default_set::files().expect("the default set is emitted");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        files::write_all(&folder(), &expected).expect("shaders-out is written");
    }
    let bless = "run STRAIGHTLINE_BLESS=1 cargo test -p straightline-tests --test drift";
    for (name, contents) in &expected {
        let present = std::fs::read(folder().join(name)).unwrap_or_default();
        assert!(
            present == *contents,
            "shaders-out/{name} is not what the generator emits: {bless}"
        );
    }
    let names: BTreeSet<String> = expected.into_keys().collect();
    for entry in std::fs::read_dir(folder()).expect("shaders-out is there") {
        let name = entry
            .expect("a folder entry")
            .file_name()
            .to_string_lossy()
            .into_owned();
        assert!(
            name == "README.md" || names.contains(&name),
            "shaders-out/{name} is emitted no more: delete it"
        );
    }
}

#[test]
fn emission_is_deterministic() {
    assert!(
        default_set::files().expect("emitted") == default_set::files().expect("emitted"),
        "two runs differ"
    );
}

#[test]
fn glslang_accepts_the_glsl() {
    check(
        "glslangValidator",
        "glslang-tools",
        &["comp", "frag"],
        &["-V", "--target-env", "vulkan1.1", "--quiet", "-o", "/dev/null"],
    );
}

#[test]
fn spirv_val_accepts_the_spirv() {
    check("spirv-val", "spirv-tools", &["spv"], &["--target-env", "vulkan1.1"]);
}

fn check(tool: &str, package: &str, extensions: &[&str], arguments: &[&str]) {
    let mut checked = 0;
    for entry in std::fs::read_dir(folder()).expect("shaders-out is there") {
        let path = entry.expect("a folder entry").path();
        if !path.extension().is_some_and(|e| extensions.iter().any(|x| e == *x)) {
            continue;
        }
        let run = Command::new(tool).args(arguments).arg(&path).output();
        let run = run.unwrap_or_else(|e| panic!("cannot run {tool} ({e}): install Debian's {package}"));
        let said = String::from_utf8_lossy(&run.stdout).into_owned() + &String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{tool} refuses {}:\n{said}", path.display());
        checked += 1;
    }
    assert!(checked >= 6, "only {checked} files were there to check");
}
