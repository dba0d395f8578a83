//! Broken input on the command line: one clear error, an exit status that says whose fault it is, no partial file.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn straightline(arguments: &[&str]) -> Output {
    let binary = env!("CARGO_BIN_EXE_straightline");
    Command::new(binary).args(arguments).output().expect("the binary runs")
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
    assert!(!error.contains("panicked"), "{error}");
}

fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a scratch folder");
    folder
}

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a file is written");
    path.display().to_string()
}

fn is_empty(folder: &Path) -> bool {
    !folder.exists() || std::fs::read_dir(folder).expect("a folder").next().is_none()
}

#[test]
fn a_syntax_error_is_shown_with_its_place() {
    let folder = scratch("syntax");
    let kernel = write(
        &folder,
        "broken.rs",
        "use straightline_kernels::prelude::*;\npub fn broken(pixel: IVec2) -> Vec4 {\n    let x = ;\n}\n",
    );
    let out = folder.join("out");
    fails(
        &["emit", &kernel, "--out", out.to_str().unwrap()],
        1,
        &["broken.rs:3:13", "not valid Rust"],
    );
    assert!(is_empty(&out));
}

#[test]
fn every_unsupported_construct_is_named_with_the_way_out() {
    let folder = scratch("unsupported");
    let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let f = |x: f32| x;\n    let n = async { 1.0 };\n    color.load(pixel)\n}\n";
    let kernel = write(&folder, "k.rs", text);
    let says = [
        "k.rs:2:13",
        "a closure",
        "write a function",
        "k.rs:3:13",
        "`async`",
        "a kernel computes its value at once",
    ];
    fails(
        &["emit", &kernel, "--out", folder.join("out").to_str().unwrap()],
        1,
        &says,
    );
    assert!(is_empty(&folder.join("out")));
}

#[test]
fn errors_of_evaluation_have_their_place_too() {
    let folder = scratch("evaluation");
    let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let a = [1.0, 2.0];\n    let b = a[2];\n    let c = color.lod(pixel);\n    Vec4::splat(b) + c\n}\n";
    let kernel = write(&folder, "k.rs", text);
    fails(
        &["explain", &kernel],
        1,
        &["k.rs:3:13", "index 2 of an array of 2", "k.rs:4:13", "no method `lod`"],
    );
}

#[test]
fn unknown_names_and_values_are_bad_use() {
    fails(&["explain", "sraaa"], 2, &["no kernel `sraaa`", "sraa"]);
    fails(
        &["explain", "sraa", "--set", "pattrn=latin4"],
        2,
        &["no option `pattrn`", "pattern"],
    );
    fails(
        &["explain", "sraa", "--set", "pattern=latin5"],
        2,
        &["latin5", "latin16"],
    );
    fails(&["explain", "sraa", "--set", "tau=-1"], 2, &["`-1`", "0 to 1000000"]);
    fails(&["explain", "sraa", "--set", "tau=many"], 2, &["`many`"]);
    fails(&["explain", "sraa", "--set", "tau"], 2, &["OPTION=VALUE"]);
    fails(
        &["emit", "sraa", "--target", "cg", "--out", "nowhere"],
        2,
        &["cg", "glsl450"],
    );
    fails(&["no-such-command"], 2, &["no-such-command"]);
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let folder = scratch("unwritable");
    // A file where the folder should be: refused to everyone, root included.
    let blocked = write(&folder, "blocked", "");
    fails(
        &["emit", "sraa", "--out", &format!("{blocked}/shaders")],
        1,
        &["blocked", "cannot write"],
    );
    fails(
        &["demo", "--out", &format!("{blocked}/demo"), "--size", "16x16"],
        1,
        &["blocked", "cannot write"],
    );
}

#[test]
fn broken_captures_are_refused() {
    let folder = scratch("captures");
    let whole = folder.join("whole");
    let made = straightline(&["capture", "--size", "32x18", "--out", whole.to_str().unwrap()]);
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let picture = folder.join("out.png");
    let resolve = |capture: &Path, says: &[&str]| {
        fails(
            &[
                "resolve",
                "--capture",
                capture.to_str().unwrap(),
                "--out",
                picture.to_str().unwrap(),
                "--executor",
                "cpu",
            ],
            1,
            says,
        );
        assert!(!picture.exists(), "a picture was written from a broken capture");
    };
    let copy = |name: &str| {
        let to = folder.join(name);
        std::fs::create_dir_all(&to).expect("a folder");
        for entry in std::fs::read_dir(&whole).expect("the capture") {
            let path = entry.expect("an entry").path();
            std::fs::copy(&path, to.join(path.file_name().unwrap())).expect("copied");
        }
        to
    };

    resolve(&folder.join("nothing"), &["nothing"]);

    let truncated = copy("truncated");
    let bytes = std::fs::read(truncated.join("depth.exr")).expect("depths");
    std::fs::write(truncated.join("depth.exr"), &bytes[..bytes.len() / 2]).expect("cut");
    resolve(&truncated, &["depth.exr"]);

    // The depths of a capture with other layers, then of one of another size.
    let other = folder.join("other");
    let made = straightline(&[
        "capture",
        "--size",
        "32x18",
        "--shading",
        "sample0",
        "--out",
        other.to_str().unwrap(),
    ]);
    assert!(made.status.success());
    let missing = copy("missing-layer");
    std::fs::copy(other.join("depth.exr"), missing.join("depth.exr")).expect("copied");
    resolve(&missing, &["depth.exr", "centre"]);

    let larger = folder.join("larger");
    let made = straightline(&["capture", "--size", "34x18", "--out", larger.to_str().unwrap()]);
    assert!(made.status.success());
    let mismatch = copy("mismatch");
    std::fs::copy(larger.join("normal.exr"), mismatch.join("normal.exr")).expect("copied");
    resolve(&mismatch, &["normal.exr", "34", "32"]);

    let good = straightline(&[
        "resolve",
        "--capture",
        whole.to_str().unwrap(),
        "--out",
        picture.to_str().unwrap(),
        "--executor",
        "cpu",
    ]);
    assert!(good.status.success(), "{}", String::from_utf8_lossy(&good.stderr));
    assert!(picture.exists());
}

/// A kernel of examples/kernels, from the folder that tests run in.
fn example(name: &str) -> String {
    format!("{}/../examples/kernels/{name}.rs", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn any_kernel_runs_on_a_picture() {
    let folder = scratch("run");
    let picture = format!("{}/../docs/detail.png", env!("CARGO_MANIFEST_DIR"));
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
    let picture = format!("{}/../docs/detail.png", env!("CARGO_MANIFEST_DIR"));
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
    let picture = format!("{}/../docs/kernels.png", env!("CARGO_MANIFEST_DIR"));
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

#[test]
fn unrolling_is_compared_and_recorded() {
    let folder = scratch("loops");
    let out = folder.join("out");
    let pictures = folder.join("pictures");
    let text = std::fs::read_to_string(example("sobel")).expect("the example");
    let kernel = write(&folder, "edges.rs", &text);
    let kernel = format!("{kernel}::sobel");
    let by_hand = format!("{}/../study/kernels/sobel.rs", env!("CARGO_MANIFEST_DIR"));
    let words = [
        "study",
        "loops",
        "--from",
        &kernel,
        "--by-hand",
        &by_hand,
        "--size",
        "32x16",
        "--rounds",
        "1",
        "--out",
        out.to_str().unwrap(),
        "--pictures",
        pictures.to_str().unwrap(),
    ];
    let finished = straightline(&words);
    assert!(
        finished.status.success(),
        "{}",
        String::from_utf8_lossy(&finished.stderr)
    );
    let table = String::from_utf8_lossy(&finished.stdout).into_owned();
    for word in [
        "looped",
        "no bound",
        "by hand",
        "partial(2)",
        "partial(4)",
        "full",
        "2x2",
        "floor",
    ] {
        assert!(table.contains(word), "no {word} in:\n{table}");
    }
    let record = std::fs::read_to_string(out.join("loops.json")).expect("a record");
    assert!(
        record.contains("\"adapter\"")
            && record.contains("\"looped-by-hand\"")
            && record.contains("\"complete\": true")
    );
    assert!(out.join("loops.csv").exists());
    assert!(pictures.join("sobel.png").exists() && pictures.join("all.png").exists());
}

#[test]
fn what_cannot_be_studied_is_named() {
    let folder = scratch("study-loops");
    let out = folder.join("out");
    let out_text = out.to_str().unwrap();
    let broken = write(&folder, "broken.rs", "pub fn broken(pixel: IVec2) -> Vec4 { 1.0 }\n");
    let good = example("sobel");
    let study = |more: &[&str], status: i32, says: &[&str]| {
        let words = ["study", "loops", "--size", "16x16", "--rounds", "1", "--out", out_text];
        fails(&[&words, more].concat(), status, says);
    };
    study(&["--from", &broken], 1, &["broken.rs:1"]);
    study(&["--from", &good, "--by-hand", &broken], 1, &["broken.rs:1"]);
    study(
        &["--from", &format!("{good}::sobeel")],
        2,
        &["no function `sobeel`", "luma, sobel"],
    );
    study(&["--from", "nowhere.rs"], 2, &["nowhere.rs"]);
    study(&["--from", "sraaa"], 2, &["no kernel `sraaa`"]);
    study(&["--by-hand", &good], 2, &["--from"]);
    study(
        &["--from", &good, "--from", &good, "--by-hand", &good],
        2,
        &["1 kernels by hand for 2 kernels", "one --by-hand for each --from"],
    );
    study(&["--rounds", "0"], 2, &["--rounds"]);
    study(&["--adapter", "no such adapter"], 2, &["no such adapter"]);
    assert!(is_empty(&out));
    let blocked = write(&folder, "blocked", "");
    let words = [
        "study", "loops", "--size", "16x16", "--rounds", "1", "--from", &good, "--out",
    ];
    fails(&[&words[..], &[&format!("{blocked}/out")]].concat(), 1, &["blocked"]);
}

#[test]
fn scenes_are_listed_and_unknown_ones_refused() {
    let listed = String::from_utf8_lossy(&straightline(&["scenes"]).stdout).into_owned();
    for name in ["roof", "grooves", "sparkle"] {
        assert!(
            listed.lines().any(|line| line.starts_with(name)),
            "no {name} in:\n{listed}"
        );
    }
    let folder = scratch("scenes");
    let out = folder.join("out");
    let out_text = out.to_str().unwrap();
    fails(
        &["capture", "--scene", "rooof", "--out", out_text],
        2,
        &["no scene `rooof`", "roof, grooves"],
    );
    fails(
        &["capture", "--scene", "floor", "--mesh", "some.obj", "--out", out_text],
        2,
        &["--mesh", "--scene"],
    );
    assert!(is_empty(&out));
}

#[test]
fn transports_that_a_stage_does_not_have_are_refused() {
    let folder = scratch("transports");
    let out = folder.join("out");
    let out = out.to_str().unwrap();
    fails(
        &["emit", "pcf", "--transport", "subgroup", "--out", out],
        1,
        &["no pixel quads", "`block`"],
    );
    fails(
        &[
            "emit",
            "pcf",
            "--transport",
            "block",
            "--stage",
            "fragment",
            "--out",
            out,
        ],
        1,
        &["a fragment writes one"],
    );
    fails(
        &[
            "emit",
            "sraa",
            "--transport",
            "subgroup",
            "--stage",
            "fragment",
            "--out",
            out,
        ],
        1,
        &["sends no messages", "pixel: Quad<IVec2>"],
    );
    fails(
        &["emit", "pcf", "--transport", "telepathy", "--out", out],
        2,
        &["subgroup, derivatives or block"],
    );
    fails(
        &["emit", "pcf", "--block", "2x2", "--out", out],
        1,
        &["no other blocks"],
    );
    assert!(is_empty(&folder.join("out")));
}

#[test]
fn quads_measures_every_filter_on_a_small_frame() {
    let folder = scratch("quads");
    let record = folder.join("record.json");
    let arguments = [
        "quads", "--size", "64x48", "--texels", "64", "--rounds", "1", "--record",
    ];
    let pictures = folder.join("pictures");
    let more = [record.to_str().unwrap(), "--pictures", pictures.to_str().unwrap()];
    let output = straightline(&[&arguments[..], &more].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table = String::from_utf8_lossy(&output.stdout);
    for text in ["blur 3x3", "PCF 8x8 quadratic", "PCSS", "derivatives Fine"] {
        assert!(table.contains(text), "no `{text}` in:\n{table}");
    }
    let record = std::fs::read_to_string(record).expect("a record");
    assert!(!record.contains("null"), "a figure is missing:\n{record}");
    assert!(pictures.join("pcf-details.png").is_file() && pictures.join("occlusion-details.png").is_file());
}

/// The capture of `examples/captures/spheres`, to be broken.
fn spheres(folder: &Path) -> PathBuf {
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/captures/spheres");
    let to = folder.join("spheres");
    std::fs::create_dir_all(&to).expect("a folder");
    for entry in std::fs::read_dir(from).expect("the capture is there") {
        let entry = entry.expect("an entry");
        std::fs::copy(entry.path(), to.join(entry.file_name())).expect("a copy");
    }
    to
}

#[test]
fn what_errors_cannot_be_measured_of_is_refused_before_any_work() {
    let folder = scratch("study-error");
    let out = folder.join("out");
    let fails_with = |arguments: &[&str], status, says: &[&str]| {
        let all = [&["study", "error", "--out", out.to_str().unwrap()], arguments].concat();
        fails(&all, status, says);
        assert!(is_empty(&out));
    };
    fails_with(&["--scene", "rooof"], 2, &["no scene `rooof`", "terrain"]);
    fails_with(&["--mesh", "nowhere.glb"], 1, &["nowhere.glb", "cannot be read"]);
    fails_with(
        &["--capture", "nowhere"],
        1,
        &["nowhere is not a capture", "docs/captures.md"],
    );

    let capture = spheres(&folder);
    let with_capture = |says: &[&str]| fails_with(&["--capture", capture.to_str().unwrap()], 1, says);
    let original = std::fs::read(capture.join("depth.exr")).expect("depth");
    std::fs::write(capture.join("depth.exr"), &original[..original.len() / 2]).expect("written");
    with_capture(&["depth.exr"]);
    std::fs::write(capture.join("depth.exr"), "no picture").expect("written");
    with_capture(&["depth.exr"]);
    std::fs::write(capture.join("depth.exr"), &original).expect("written");

    let description = capture.join("capture.json");
    let text = std::fs::read_to_string(&description).expect("a description");
    for (right, wrong, says) in [
        ("\"linear\"", "\"reversed\"", "depth encoding `reversed` is unknown"),
        ("\"schema\": 1", "\"schema\": 7", "schema 7"),
        ("\"shading\"", "\"shadding\"", "shadding"),
        ("96,", "97,", "color.exr"),
    ] {
        assert!(text.contains(right), "{right}");
        std::fs::write(&description, text.replacen(right, wrong, 1)).expect("written");
        with_capture(&[says]);
    }
    std::fs::write(&description, &text).expect("written");
    std::fs::remove_file(capture.join("reference.exr")).expect("removed");
    with_capture(&["has no reference.exr", "--reference 256"]);
}
