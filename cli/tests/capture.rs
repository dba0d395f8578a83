//! Broken captures on the command line.

mod common;

use common::{fails, scratch, straightline};
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
