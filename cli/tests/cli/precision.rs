//! `--precision`: what each command makes of it, and what it refuses.

use crate::common;

use common::{example, fails, finishes, here, is_empty, scratch, straightline};
use std::path::Path;

#[test]
fn shaders_are_emitted_in_half_precision() {
    let folder = scratch("half-emit");
    let out = folder.to_str().expect("a path of text");
    finishes(&[
        "emit",
        "sraa",
        "--set",
        "metric=normals",
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
        "--accept-loss",
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

/// Depths of 11 bits make steps of slopes: that is for the user to want.
#[test]
fn half_precision_that_shows_is_refused_with_its_reason() {
    let folder = scratch("half-loss");
    let out = folder.to_str().expect("a path of text");
    let words = ["emit", "sraa", "--precision", "f16", "--out", out];
    fails(&words, 1, &["`sraa` in f16", "2^-11", "--accept-loss", "study hard"]);
    assert!(is_empty(&folder));
    finishes(&[&words[..], &["--accept-loss"]].concat());
    assert!(folder.join("sraa.wgsl").exists());
    let f32 = ["emit", "sraa", "--accept-loss", "--out", out];
    fails(&f32, 2, &["--accept-loss", "--precision f16"]);
    // A user's own kernel is judged by its author.
    let own = example("median");
    let output = straightline(&["emit", &own, "--precision", "f16", "--out", out]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("no hard cases"), "{said}");
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
    let kernel = here("kernels/filters/convolution.rs");
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

/// A median only compares, so half precision is cheaper for it on any driver's word, and its error that of one rounding.
#[test]
fn the_cheapest_values_in_half_precision_are_found() {
    let folder = scratch("half-search");
    let out = folder.to_str().expect("a path of text");
    let kernel = here("kernels/filters/median.rs");
    let ask = |more: &[&str]| {
        let fixed = ["study", "precision", &kernel, "--isa", "amd:navi21", "--out", out];
        [&fixed[..], more]
            .concat()
            .iter()
            .map(|word| (*word).to_owned())
            .collect::<Vec<_>>()
    };
    let borrowed = |all: &[String]| -> String {
        let words: Vec<&str> = all.iter().map(String::as_str).collect();
        finishes(&words)
    };
    let table = borrowed(&ask(&[]));
    assert!(table.contains("amd:navi21: --half values"), "{table}");
    let record = std::fs::read_to_string(folder.join("precision.json")).expect("a record");
    let record: serde_json::Value = serde_json::from_str(&record).expect("JSON");
    let proposed = &record["proposals"][0]["lowered"];
    assert!(
        proposed["ratios"]["amd:navi21"]
            .as_f64()
            .is_some_and(|ratio| ratio < 0.95),
        "{proposed}"
    );
    assert!(
        proposed["error"]
            .as_f64()
            .is_some_and(|error| error > 0.0 && error < 1.0e-3),
        "{proposed}"
    );
    // Half precision has 11 bits.
    let strict = borrowed(&ask(&["--max-error", "1e-5"]));
    assert!(strict.contains("amd:navi21: full precision"), "{strict}");
    let none = folder.join("none.rs");
    std::fs::write(
        &none,
        "pub fn none(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) }",
    )
    .expect("a kernel");
    let none = none.to_str().expect("a path of text");
    let refused = ["study", "precision", none, "--isa", "amd:navi21", "--out", out];
    fails(
        &refused,
        1,
        &["`none` computes no floats that could be in half precision"],
    );
    let unbounded = [
        "study",
        "precision",
        "sraa",
        "--isa",
        "amd:navi21",
        "--max-error",
        "0",
        "--out",
        out,
    ];
    fails(&unbounded, 2, &["a positive number is needed, such as 0.004"]);
}
