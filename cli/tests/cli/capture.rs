//! Broken captures on the command line.

use crate::common;

use common::{fails, finishes, scratch, straightline, write};
use std::path::Path;

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

#[test]
fn a_capture_is_shaded_where_it_is_asked() {
    let folder = scratch("capture-shading");
    let path = |name: &str| folder.join(name).display().to_string();
    let (two, picture) = (path("two"), path("two.png"));
    let capture = |more: &[&str]| -> Vec<String> {
        let words = ["capture", "--size", "48x27", "--out", &two];
        words.iter().chain(more).map(|word| (*word).to_owned()).collect()
    };
    let refused = |more: &[&str], says: &[&str]| {
        let words = capture(more);
        fails(&words.iter().map(String::as_str).collect::<Vec<_>>(), 2, says);
    };
    refused(&["--shading", "listed"], &["--shaded 0,3", "there are 0"]);
    refused(
        &["--shading", "listed", "--shaded", "0,1,2"],
        &["one, two or four", "there are 3"],
    );
    refused(&["--shaded", "0,3"], &["--shading listed", "--shading is centre"]);
    refused(
        &["--shading", "corner"],
        &["`corner`", "centre, sample0, placed or listed"],
    );
    let words = capture(&["--shading", "listed", "--shaded", "0,3", "--reference", "16"]);
    finishes(&words.iter().map(String::as_str).collect::<Vec<_>>());
    let resolve = [
        "resolve",
        "--capture",
        &two,
        "--out",
        &picture,
        "--executor",
        "cpu",
        "--reference",
        "--json",
    ];
    let said: serde_json::Value = serde_json::from_str(&finishes(&resolve)).expect("JSON");
    assert_eq!(
        (&said["options"]["shading"], &said["options"]["shaded"]),
        (&"listed".into(), &"0,3".into())
    );
    let db = |name: &str| said[name].as_f64().expect("a number");
    assert!(db("psnr_db") > db("psnr_1x_db") + 1.0, "{said}");
    // A capture says where it was shaded; what it was not cannot be asked of it.
    fails(
        &[&resolve[..], &["--set", "shaded=0,1"]].concat(),
        2,
        &["shaded=0,1", "shaded=0,3"],
    );
}

/// A single shading sample a pixel, moved where geometry asks for it: `resolve` reads its place from the capture.
#[test]
fn a_capture_that_is_placed_is_closer_to_its_reference() {
    let folder = scratch("capture-placed");
    let path = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let db = |shading: &str, more: &[&str]| {
        let (frame, picture) = (path(shading), path("out.png"));
        let capture = [
            "capture",
            "--scene",
            "railings",
            "--size",
            "192x108",
            "--shading",
            shading,
        ];
        finishes(&[&capture[..], &["--reference", "16", "--out", &frame]].concat());
        let resolve = [
            "resolve",
            "--capture",
            &frame,
            "--out",
            &picture,
            "--executor",
            "cpu",
            "--reference",
            "--json",
        ];
        let relative = ["--set", "difference=relative", "--set", "depth-scale=3"];
        let said: serde_json::Value =
            serde_json::from_str(&finishes(&[&resolve[..], &relative, more].concat())).expect("JSON");
        assert_eq!(said["options"]["shading"], shading);
        said["psnr_db"].as_f64().expect("a number")
    };
    let (centred, placed) = (db("centre", &[]), db("placed", &["--set", "search=five"]));
    assert!(placed > centred + 1.0, "{placed} dB placed, {centred} dB centred");
    std::fs::remove_file(folder.join("placed/place.exr")).expect("it was written");
    let (frame, picture) = (path("placed"), path("none.png"));
    fails(
        &["resolve", "--capture", &frame, "--out", &picture],
        1,
        &["place.exr", "channel Y"],
    );
}

#[test]
fn a_model_is_seen_from_where_it_is_asked() {
    let folder = scratch("capture-camera");
    let model = write(
        &folder,
        "quad.obj",
        "v 100 0 0\nv 103 0 0\nv 103 4 0\nv 100 4 0\nf 1 2 3 4\n",
    );
    let out = folder.join("frame");
    let words = [
        "capture",
        "--mesh",
        &model,
        "--size",
        "16x9",
        "--out",
        out.to_str().unwrap(),
    ];
    let seen = ["--eye", "101.5,2,-3", "--target", "101.5,2,0", "--fov", "60"];
    finishes(&[&words[..], &seen].concat());
    let text = std::fs::read_to_string(out.join("capture.json")).expect("a description");
    let camera = &serde_json::from_str::<serde_json::Value>(&text).expect("JSON")["camera"];
    // The model's diagonal of 5 has become 10 around the origin.
    let place = camera["position"].as_array().expect("a place");
    let place: Vec<f64> = place.iter().map(|axis| axis.as_f64().expect("a number")).collect();
    assert!(
        place[0].abs() + place[1].abs() + (place[2] + 6.0).abs() < 1e-5,
        "{camera}"
    );
    assert!((camera["vertical_fov"].as_f64().expect("an angle") - 60f64.to_radians()).abs() < 1e-6);
    for (more, says) in [
        (["--eye", "1,2"], "`1,2` is not a point"),
        (["--eye", "1,2,inf"], "`1,2,inf` is not a point"),
        (["--fov", "180"], "degrees from 1 to 170"),
    ] {
        fails(&[&words[..], &more].concat(), 2, &[says]);
    }
    let same = ["--eye", "1,1,1", "--target", "1,1,1"];
    fails(&[&words[..], &same].concat(), 1, &["view direction"]);
    let old = write(
        &folder,
        "old.gltf",
        r#"{"asset": {"version": "1.0"}, "meshes": {}, "scenes": {}}"#,
    );
    fails(
        &["capture", "--mesh", &old, "--out", out.to_str().unwrap()],
        1,
        &["old.gltf", "glTF 1.0"],
    );
}

/// The options that docs/sraa.md recommends, on what `capture` places by planes.
#[test]
fn the_recommended_options_run_on_a_placed_capture() {
    let folder = scratch("capture-by-planes");
    let path = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let recommended = [
        "mask=branch",
        "variation=within",
        "metric=planes-normals",
        "difference=relative",
        "depth-scale=10",
        "search=five",
        "unseen=0.003",
        "search-threshold=0.004",
    ];
    let sets: Vec<&str> = recommended.iter().flat_map(|option| ["--set", option]).collect();
    let db = |by: &[&str], name: &str| {
        let (frame, picture) = (path(name), path("out.png"));
        let capture = [
            "capture",
            "--scene",
            "railings",
            "--size",
            "160x90",
            "--shading",
            "placed",
            "--reference",
            "16",
            "--out",
            &frame,
        ];
        finishes(&[&capture[..], by].concat());
        let resolve = [
            "resolve",
            "--capture",
            &frame,
            "--out",
            &picture,
            "--reference",
            "--json",
        ];
        let said = finishes(&[&resolve[..], &sets].concat());
        let said: serde_json::Value = serde_json::from_str(&said).expect("JSON");
        assert_eq!(said["warnings"], serde_json::json!([]));
        said["psnr_db"].as_f64().expect("a number")
    };
    let (planes, asked, depths) = (
        db(&[], "planes"),
        db(&["--placed-by", "planes"], "asked"),
        db(&["--placed-by", "depths"], "depths"),
    );
    println!("{planes:.2} dB placed by planes, {depths:.2} by depths");
    assert!(
        planes == asked && planes > depths,
        "{planes} dB by planes, {asked} asked for, {depths} by depths"
    );
    let (listed, out) = ("-0.3,0.1,0.3,-0.1", path("listed"));
    let words = [
        "capture",
        "--size",
        "32x18",
        "--pattern",
        listed,
        "--shading",
        "placed",
        "--out",
        &out,
    ];
    finishes(&words);
    fails(&[&words[..], &["--placed-by", "planes"]].concat(), 1, &["pattern"]);
    let centred = ["capture", "--size", "32x18", "--placed-by", "planes", "--out", &out];
    fails(&centred, 2, &["--shading placed", "--shading is centre"]);
}

#[test]
fn a_capture_with_y_upside_down_is_warned_of() {
    let folder = scratch("capture-upside-down");
    let frame = folder.join("frame").to_string_lossy().into_owned();
    finishes(&["capture", "--scene", "creases", "--size", "96x54", "--out", &frame]);
    let description = format!("{frame}/capture.json");
    let text = std::fs::read_to_string(&description).expect("a description");
    let mut json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    for sample in json["samples"].as_array_mut().expect("samples") {
        sample[1] = serde_json::json!(-sample[1].as_f64().expect("a number"));
    }
    let out = folder.join("out.png").to_string_lossy().into_owned();
    let resolve = ["resolve", "--capture", &frame, "--out", &out, "--executor", "cpu"];
    let warned = |resolve: &[&str]| {
        let resolved = straightline(resolve);
        assert!(resolved.status.success());
        String::from_utf8_lossy(&resolved.stderr).into_owned()
    };
    assert_eq!(warned(&resolve), "");
    std::fs::write(&description, json.to_string()).expect("written");
    let said = warned(&resolve);
    assert!(said.contains("warning: ") && said.contains("y upside down"), "{said}");
}
