//! `compare` on the command line.

use crate::common;

use common::{fails, finishes, here, scratch};
use straightline_kernels::prelude::{Frame, UVec2, Vec4};
use straightline_scene::picture;

/// A grey picture with one brighter pixel.
fn grey(size: u32, light: f32) -> Frame<Vec4> {
    let mut texels = vec![Vec4::new(0.25, 0.25, 0.25, 1.0); (size * size) as usize];
    texels[(size * size / 2) as usize] += Vec4::new(light, light, light, 0.0);
    Frame::new(UVec2::splat(size), texels)
}

#[test]
fn two_pictures_are_compared() {
    let folder = scratch("compare");
    let path = |name: &str| folder.join(name).display().to_string();
    for (name, light) in [
        ("a.exr", 0.0),
        ("b.exr", 0.1),
        ("c.exr", 1.0e-5),
        ("a.png", 0.0),
        ("b.png", 0.1),
    ] {
        picture::write_picture(&folder.join(name), &grey(20, light)).expect("written");
    }
    // A pixel of 400 is off by 0.1: 20 dB, and 26.02 for the 399 that are right.
    let said = finishes(&["compare", &path("b.exr"), &path("a.exr")]);
    assert!(
        said.contains("46.02 dB") && said.contains("SSIM") && said.contains("FLIP"),
        "{said}"
    );
    assert!(!said.contains("8 bits"), "{said}");
    let json = |a: &str, b: &str| -> serde_json::Value {
        serde_json::from_str(&finishes(&["compare", &path(a), &path(b), "--json"])).expect("JSON")
    };
    assert_eq!(json("a.png", "a.png")["psnr_db"], 160.0);
    // A hundredth of a step of 8 bits is seen in floats alone.
    let (floats, bytes) = (json("c.exr", "a.exr"), json("c.exr", "a.png"));
    assert_eq!((&floats["bits"], &bytes["bits"]), (&32.into(), &8.into()));
    assert!(
        floats["psnr_db"].as_f64() < Some(150.0) && bytes["psnr_db"] == 160.0,
        "{floats} {bytes}"
    );
    assert_eq!(json("b.exr", "a.png")["flip"], json("b.png", "a.exr")["flip"]);
}

#[test]
fn pictures_of_two_sizes_are_refused() {
    let folder = scratch("compare-sizes");
    let path = |name: &str| folder.join(name).display().to_string();
    picture::write_picture(&folder.join("a.png"), &grey(20, 0.0)).expect("written");
    picture::write_picture(&folder.join("b.png"), &grey(21, 0.0)).expect("written");
    fails(
        &["compare", &path("a.png"), &path("b.png")],
        1,
        &["a.png is 20x20", "b.png is 21x21", "sizes"],
    );
    fails(&["compare", &path("a.png"), &path("none.png")], 1, &["none.png"]);
    fails(
        &["compare", &path("a.png"), &here("README.md")],
        1,
        &["README.md", ".png or .exr"],
    );
    fails(&["compare", &path("a.png")], 2, &["REFERENCE"]);
}
