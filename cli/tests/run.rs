//! `run` on kernels of all kinds, and what it was not given.

mod common;

use common::{example, fails, here, is_empty, scratch, straightline, write};
use std::path::Path;

#[test]
fn any_kernel_runs_on_a_picture() {
    let folder = scratch("run");
    let picture = here("docs/detail.png");
    let out = folder.join("out.png");
    let out = out.to_str().unwrap();
    let run = |more: &[&str]| {
        let kernel = example("median");
        let mut words = vec!["run", kernel.as_str(), "--out", out];
        words.extend(more);
        straightline(&words)
    };
    for more in [
        &["--input", picture.as_str(), "--size", "64x48", "--executor", "cpu"][..],
        &["--input", picture.as_str(), "--executor", "gpu", "--unroll", "2"][..],
    ] {
        let finished = run(more);
        let said = String::from_utf8_lossy(&finished.stderr).into_owned();
        // The interpreter wants a picture of the output's size for a `Frame`.
        if more.contains(&"64x48") {
            assert!(
                !finished.status.success() && said.contains("has the output's size"),
                "{said}"
            );
        } else {
            assert!(finished.status.success(), "{said}");
            assert!(Path::new(out).exists());
        }
    }
}

#[test]
fn run_names_what_it_was_not_given() {
    let folder = scratch("run-wrong");
    let out = folder.join("out.png");
    let out = out.to_str().unwrap();
    let picture = here("docs/detail.png");
    let two = example("joint_bilateral_upsampling");
    let one = example("median");
    fails(
        &["run", &two, "--input", &picture, "--out", out],
        2,
        &["which texture", "low_depth"],
    );
    fails(
        &["run", &one, "--input", "colour=x.png", "--out", out],
        2,
        &["no texture `colour`", "color"],
    );
    fails(
        &["run", &one, "--input", "nowhere.png", "--out", out],
        1,
        &["nowhere.png"],
    );
    fails(
        &["run", &one, "--input", &picture, "--out", "picture.jpg"],
        2,
        &["picture.jpg", ".png"],
    );
    fails(
        &["run", &one, "--input", &picture, "--uniform", "sigma=2", "--out", out],
        2,
        &["no uniform `sigma`"],
    );
    fails(
        &["run", &one, "--input", &picture, "--precision", "f64", "--out", out],
        2,
        &["--executor cpu"],
    );
    assert!(is_empty(&folder));
}

#[test]
fn a_nan_is_traced_to_its_line() {
    let folder = scratch("nan");
    let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let here = color.load(pixel);\n    let mut sum = 0.0;\n    for tap in 0..3 {\n        let ratio = tap as f32 / (here.x - here.x);\n        sum += ratio;\n    }\n    Vec4::splat(sum)\n}\n";
    let kernel = write(&folder, "k.rs", text);
    let picture = here("docs/kernels.png");
    let out = folder.join("out.png");
    for unroll in ["full", "none"] {
        let words = [
            "run",
            &kernel,
            "--input",
            &picture,
            "--out",
            out.to_str().unwrap(),
            "--executor",
            "cpu",
            "--check-finite",
            "--unroll",
            unroll,
        ];
        fails(&words, 1, &["`ratio` became NaN in `div`", "tap 0", "k.rs:5"]);
    }
    assert!(!out.exists());
}
