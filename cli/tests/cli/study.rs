//! The studies on the command line: what they write, and what they refuse before any work.

use crate::common;

use common::{example, fails, finishes, here, is_empty, scratch, straightline, write};
use serde_json::Value;
use std::path::{Path, PathBuf};

#[test]
fn unrolling_is_compared_and_recorded() {
    let folder = scratch("loops");
    let out = folder.join("out");
    let pictures = folder.join("pictures");
    let text = std::fs::read_to_string(example("sobel")).expect("the example");
    let kernel = write(&folder, "edges.rs", &text);
    let kernel = format!("{kernel}::sobel");
    let by_hand = here("study/kernels/sobel.rs");
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
        "unbounded",
        "hand-optimised",
        "partial(2)",
        "partial(4)",
        "unrolled",
        "2×2",
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
        &[
            "1 hand-optimised kernels for 2 kernels",
            "one --by-hand for each --from",
        ],
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

#[test]
fn a_pan_is_filmed_by_methods_side_by_side() {
    let folder = scratch("film");
    let out = folder.join("film");
    let film = |more: &[&str]| {
        let own = ["study", "film", "--out", out.to_str().unwrap()];
        [&own[..], more]
            .concat()
            .iter()
            .map(|word| (*word).to_owned())
            .collect::<Vec<_>>()
    };
    let refused = |more: &[&str], says: &[&str]| {
        let arguments = film(more);
        fails(&arguments.iter().map(String::as_str).collect::<Vec<_>>(), 2, says);
        assert!(is_empty(&out));
    };
    refused(
        &["--method", "sharp"],
        &["no method `sharp`", "SRAA 4, radius 2", "NAME=KERNEL"],
    );
    refused(&["--method", "1x", "--method", "1x"], &["`1x` is given twice"]);
    refused(&["--step", "1"], &["two numbers from -64 to 64"]);
    refused(&["--step", "nan,0"], &["two numbers from -64 to 64"]);
    refused(&["--frames", "1"], &["--frames"]);
    refused(
        &["--size", "8000x8000"],
        &["8000x8000 pixels are too many to keep", "--size"],
    );

    let arguments = film(&[
        "--size",
        "64x36",
        "--frames",
        "3",
        "--method",
        "1x",
        "--method",
        "mask=sraa,mask=select",
    ]);
    let printed = finishes(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
    assert!(printed.contains("mask") && printed.contains("64x"), "{printed}");
    let table = std::fs::read_to_string(out.join("film.csv")).expect("a table");
    let errors: Vec<f64> = table
        .lines()
        .skip(1)
        .map(|line| line.rsplit(',').next().unwrap().parse().unwrap())
        .collect();
    // Two changes by each of two methods, of which antialiasing changes less wrongly.
    assert_eq!(errors.len(), 4, "{table}");
    assert!(errors[2] < errors[0] && errors[3] < errors[1], "{table}");
    assert!(
        out.join("film.png").is_file()
            && out.join("frames/0002.png").is_file()
            && !out.join("frames/0003.png").exists()
    );
}

#[test]
fn methods_are_compared_in_motion() {
    let out = scratch("motion").join("motion");
    let motion = ["study", "motion", "--out", out.to_str().unwrap(), "--size", "48x27"];
    let of = |more: &[&'static str]| [&motion[..], more].concat();
    fails(&of(&["--method", "4y"]), 2, &["no method `4y`", "SRAA 4, history"]);
    fails(&of(&["--method", "a=stalker"]), 1, &["`a` is not compared in motion"]);
    fails(&of(&["--scene", "bridge"]), 2, &["bridge"]);
    // A pan of one moment is none of earlier frames.
    let film = ["study", "film", "--out", out.to_str().unwrap(), "--size", "48x27"];
    let film = [&film[..], &["--method", "a=sraa,history=2"]].concat();
    fails(&film, 1, &["no earlier frames", "history=2", "study motion"]);
    assert!(is_empty(&out));

    let own = "own=sraa,history=2,demodulate=albedo,rest=true,difference=relative,depth-scale=3";
    let plain = "plain=sraa,difference=relative,depth-scale=3";
    let more = [
        "--scene", "railings", "--frames", "2", "--method", plain, "--method", own, "--method", "4x",
    ];
    let printed = finishes(&of(&more));
    assert!(printed.contains("board") && printed.contains("own"), "{printed}");
    let table = std::fs::read_to_string(out.join("motion.csv")).expect("a table");
    let psnrs: Vec<f64> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(3).unwrap().parse().unwrap())
        .collect();
    assert_eq!(psnrs.len(), 12, "{table}");
    assert!(psnrs.chunks(3).all(|methods| methods[0] < methods[1]), "{table}");
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
    let method = |text: &str, status, says: &[&str]| fails_with(&["--scene", "roof", "--method", text], status, says);
    fails_with(&["--only", "SRAA 5"], 2, &["no method `SRAA 5`", "SRAA 4, demodulated"]);
    method("sharp", 2, &["`sharp` is no method", "NAME=KERNEL"]);
    method("sharp=sraa,wide", 2, &["`sharp=sraa,wide` is no method"]);
    method("SRAA 4=sraa", 2, &["there is a method `SRAA 4` already"]);
    method("own=sraa,pattern=listed", 2, &["pattern `listed`", "latin4"]);
    method("own=sraa,raduis=2", 2, &["raduis"]);
    method("own=nowhere.rs", 2, &["nowhere.rs"]);
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

#[test]
fn a_compiler_is_asked_without_its_gpu() {
    let explained = |kernel: &str| -> serde_json::Value {
        let text = finishes(&["explain", kernel, "--isa", "amd:navi21", "--json"]);
        serde_json::from_str(&text).expect("JSON")
    };
    let found = explained("sraa");
    let figure = |name: &str| found["isa"]["figures"][name].as_u64().expect("a figure");
    assert!(figure("inverse_throughput") > 0 && figure("vector") > 0);
    assert!(figure("vector") + figure("memory") <= figure("instructions"));

    // Reads and writes are counted twice: in the text by the generator, in machine code by the compiler.
    let found = explained(&format!("{}::sobel", example("sobel")));
    let reads = found["reads"].as_object().expect("reads").values();
    let reads: u64 = reads.filter_map(serde_json::Value::as_u64).sum();
    assert_eq!(found["isa"]["figures"]["memory"], reads + 1);
}

#[test]
fn gpus_that_can_be_compiled_for_are_listed() {
    let listed = finishes(&["isa", "--json"]);
    let listed: serde_json::Value = serde_json::from_str(&listed).expect("JSON");
    let gpus = listed["gpus"].as_array().expect("a list");
    for gpu in gpus {
        assert!(gpu["device"].is_string() != gpu["refused"].is_string(), "{gpu}");
    }
    let of = |name: &str| gpus.iter().find(|gpu| gpu["gpu"] == name).expect(name);
    let device = of("amd:navi21")["device"]
        .as_str()
        .expect("libvulkan1 and mesa-vulkan-drivers are installed");
    assert!(device.to_lowercase().contains("navi21"), "{device}");
    assert_eq!(of("device")["about"], "the GPU of this machine, by its own driver");
    // One line for each vendor without a driver, with what helps.
    let text = finishes(&["isa", "--list"]);
    assert!(text.contains("RDNA 2, 2020"), "{text}");
    let refused = of("arm:g610")["refused"].as_str();
    assert!(
        refused.is_none_or(|why| why.contains("STRAIGHTLINE_DRIVERS")),
        "{refused:?}"
    );
    assert!(text.matches("GPUs of Arm").count() <= 1, "{text}");
    fails(&["isa", "matrox"], 2, &["no such GPU", "nvidia:blackwell"]);
}

#[test]
fn compilers_are_compared_and_recorded() {
    let out = scratch("isa").join("out");
    let (out, sobel) = (out.to_str().unwrap(), format!("{}::sobel", example("sobel")));
    let table = finishes(&["study", "isa", "--from", &sobel, "--gpu", "navi21", "--out", out]);
    for row in [
        "sobel unrolled naga",
        "sobel looped naga",
        "sobel partial(2) naga",
        "sobel unrolled, 2×2 pixels naga",
        "sobel unrolled, shared by workgroups naga",
    ] {
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            table.lines().any(|line| words(line).starts_with(row)),
            "{row} is not in {table}"
        );
    }
    for file in ["isa.json", "isa.csv", "report.html"] {
        assert!(Path::new(out).join(file).is_file(), "{file}");
    }
    fails(
        &["study", "isa", "--gpu", "amd:navi99", "--out", out],
        2,
        &["navi99", "amd:navi21"],
    );
}

/// A uniform without a default.
const BRIGHTER: &str = "pub fn brighter(color: &Frame<Vec4>, gain: f32, pixel: IVec2) -> Vec4 {\n    let mut sum = Vec4::ZERO;\n    for x in -1..=1 {\n        sum += color.load(pixel + ivec2(x, 0));\n    }\n    gain * sum\n}\n";

#[test]
fn uniforms_of_a_studied_kernel_are_said() {
    let folder = scratch("study-uniforms");
    let kernel = write(&folder, "brighter.rs", BRIGHTER);
    let out = folder.join("out").display().to_string();
    let words = [
        "study", "loops", "--size", "16x16", "--rounds", "1", "--out", &out, "--from", &kernel,
    ];
    for (more, value) in [(&[][..], "gain = 1"), (&["--uniform", "gain=2.5"][..], "gain = 2.5")] {
        let said = finishes(&[&words[..], more].concat());
        assert!(
            said.contains(&format!("brighter: on the test card with {value}\n")),
            "{said}"
        );
        let record = std::fs::read_to_string(format!("{out}/loops.json")).expect("a record");
        assert!(record.contains(&format!("the test card with {value}\"")), "{record}");
        let page = std::fs::read_to_string(format!("{out}/report.html")).expect("a page");
        assert!(
            page.contains(&format!("On the test card with {value}.")),
            "no {value} on the page"
        );
    }
    fails(&[&words[..], &["--uniform", "gian=2"]].concat(), 2, &["uniform `gian`"]);
    fails(&[&words[..], &["--uniform", "gain=much"]].concat(), 2, &["gain"]);
}

/// Records of one small scene, and the frames that are put together of them: sums of their parts, with a panel for each cost of shading.
#[test]
fn frames_are_put_together_of_two_records() {
    let folder = scratch("study-frame");
    let path = |name: &str| folder.join(name).to_str().expect("a name").to_owned();
    let (passes, out) = (path("budget.json"), path("frame"));
    let small = ["--size", "48x32", "--rounds", "3"];
    finishes(&[&["budget", "--scene", "floor", "--record", &passes][..], &small].concat());
    let methods = ["1x", "SMAA", "SRAA 4", "4x"].map(|name| ["--only", name]).concat();
    let error = ["study", "error", "--scene", "floor", "--out", &path("error")].map(str::to_owned);
    let error: Vec<&str> = error.iter().map(String::as_str).collect();
    finishes(&[&error[..], &methods, &small].concat());
    let errors = path("error/error.json");
    let frame = [
        "study", "frame", "--passes", &passes, "--errors", &errors, "--out", &out,
    ];
    let printed = finishes(&[&frame[..], &["--shading", "1,20"]].concat());
    assert!(
        printed.contains("SRAA 4") && printed.contains("frame at 20 ms"),
        "{printed}"
    );

    let read = |name: &str| std::fs::read_to_string(folder.join("frame").join(name)).expect("a file");
    let record: Value = serde_json::from_str(&read("frame.json")).expect("JSON");
    let methods = record["methods"].as_array().expect("methods");
    let names: Vec<&str> = methods.iter().filter_map(|method| method["method"].as_str()).collect();
    assert_eq!(names.len(), 4, "{names:?}");
    for method in methods {
        let number = |name: &str| method[name].as_f64().unwrap_or_else(|| panic!("{name} of {method}"));
        for (frame, shading) in method["frames"].as_array().expect("frames").iter().zip([1.0, 20.0]) {
            let sum = number("geometry_ms") + number("shaded") * shading + number("filter_ms");
            assert!((frame["ms"].as_f64().expect("ms") - sum).abs() < 1e-9, "{method}");
        }
    }
    for panel in ["frame-1ms.svg", "frame-20ms.svg"] {
        assert!(read(panel).contains("<svg"), "{panel}");
    }
    assert!(read("report.html").contains("Time of a frame against error"));

    // Another size is another frame.
    let other = path("other.json");
    finishes(&[
        "budget", "--scene", "floor", "--record", &other, "--size", "32x32", "--rounds", "3",
    ]);
    let words = ["study", "frame", "--passes", &other, "--errors", &errors, "--out", &out];
    fails(&words, 1, &["differ in their size: 32x32 and 48x32"]);
}
