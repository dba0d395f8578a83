//! `--precision`: what each command makes of it, and what it refuses.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn straightline(arguments: &[&str]) -> Output {
    let binary = env!("CARGO_BIN_EXE_straightline");
    Command::new(binary).args(arguments).output().expect("the binary runs")
}

fn finishes(arguments: &[&str]) -> String {
    let output = straightline(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?} said: {error}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn fails(arguments: &[&str], status: i32, says: &[&str]) {
    let output = straightline(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{arguments:?} said: {error}");
    for text in says {
        assert!(
            error.contains(text),
            "{arguments:?} does not say `{text}` but:\n{error}"
        );
    }
}

fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a scratch folder");
    folder
}

fn here(path: &str) -> String {
    format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn shaders_are_emitted_in_half_precision() {
    let folder = scratch("half-emit");
    let out = folder.to_str().expect("a path of text");
    finishes(&[
        "emit",
        "sraa",
        "--precision",
        "f16",
        "--target",
        "wgsl,spirv,hlsl,msl",
        "--out",
        out,
    ]);
    let wgsl = std::fs::read_to_string(folder.join("sraa.wgsl")).expect("a shader");
    assert!(wgsl.starts_with("enable f16;\n"), "{wgsl}");
    let manifest = std::fs::read_to_string(folder.join("sraa.json")).expect("a manifest");
    assert!(
        manifest.contains("\"precision\": \"f16\"") && manifest.contains("\"shader-f16\""),
        "{manifest}"
    );
    let none = scratch("half-refused");
    let out = none.to_str().expect("a path of text");
    let words = [
        "emit",
        "sraa",
        "--precision",
        "f16",
        "--target",
        "wgsl,glsl450",
        "--out",
        out,
    ];
    fails(&words, 1, &["glsl450", "use wgsl, spirv, hlsl or msl"]);
    assert_eq!(std::fs::read_dir(&none).expect("the folder").count(), 0);
    fails(
        &["emit", "sraa", "--precision", "f64", "--out", out],
        2,
        &["unknown precision `f64`"],
    );
}

#[test]
fn what_a_device_must_have_is_explained() {
    let text = finishes(&["explain", "quad_convolution", "--precision", "f16"]);
    assert!(text.contains("in f16: the device needs subgroup, shader-f16"), "{text}");
    let json = finishes(&["explain", "sraa", "--precision", "f16", "--json"]);
    assert!(json.contains("\"precision\": \"f16\""), "{json}");
    assert!(!finishes(&["explain", "sraa"]).contains("the device needs"));
}

/// On a GPU that has half precision; one that has not is named, and nothing is written.
#[test]
fn kernels_run_in_half_precision() {
    let folder = scratch("half-run");
    let kernel = here("examples/kernels/convolution.rs");
    let picture = here("docs/detail.png");
    let run = |precision: &str, executor: &str| {
        let out = folder.join(format!("{precision}-{executor}.exr"));
        let out = out.to_str().expect("a path of text").to_owned();
        let words = [
            "run",
            &kernel,
            "--input",
            &picture,
            "--out",
            &out,
            "--precision",
            precision,
            "--executor",
            executor,
        ];
        (straightline(&words), out)
    };
    assert!(run("f16", "cpu").0.status.success());
    let (output, out) = run("f16", "gpu");
    let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    match output.status.success() {
        true => assert!(said.contains(", f16)"), "{said}"),
        false => {
            assert!(
                said.contains("has no half precision (SHADER_F16)") && said.contains("--executor cpu"),
                "{said}"
            );
            assert!(!Path::new(&out).exists());
        }
    }
    let (output, out) = run("f64", "gpu");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.code() == Some(2) && said.contains("--precision f64"),
        "{said}"
    );
    assert!(!Path::new(&out).exists());
}
