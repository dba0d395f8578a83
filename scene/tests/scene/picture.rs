//! Single pictures in files.

use crate::common;

use common::Scratch;
use glam::{UVec2, Vec4, uvec2, vec4};
use std::fs;
use straightline_kernels::prelude::Frame;
use straightline_scene::picture::{self, PictureError};

fn gradient(size: UVec2) -> Frame<Vec4> {
    let texel = |x: u32, y: u32| vec4(x as f32 / 7.0 - 0.5, y as f32 * 1.0e6, 1.0 / (x + y + 1) as f32, 0.25);
    Frame::new(
        size,
        (0..size.y)
            .flat_map(|y| (0..size.x).map(move |x| texel(x, y)))
            .collect(),
    )
}

#[test]
fn exr_keeps_every_bit() {
    let scratch = Scratch::new("picture-exr");
    let path = scratch.join("picture.exr");
    for size in [uvec2(1, 1), uvec2(37, 23), uvec2(3, 129)] {
        let mut texels = gradient(size).texels().to_vec();
        texels[0] = vec4(f32::INFINITY, f32::NEG_INFINITY, -0.0, f32::MIN_POSITIVE / 4.0);
        let frame = Frame::new(size, texels);
        picture::write_picture(&path, &frame).unwrap();
        let bits = |frame: &Frame<Vec4>| -> Vec<[u32; 4]> {
            frame
                .texels()
                .iter()
                .map(|texel| texel.to_array().map(f32::to_bits))
                .collect()
        };
        assert_eq!(bits(&picture::read_picture(&path).unwrap()), bits(&frame), "{size}");
    }
    assert_eq!(scratch.names(), ["picture.exr"]);
}

#[test]
fn png_is_srgb_and_clamped() {
    let scratch = Scratch::new("picture-png");
    let path = scratch.join("picture.PNG");
    let texels = vec![
        vec4(0.0, 0.18, 1.0, 1.0),
        vec4(-1.0, 7.0, f32::NAN, 0.5),
        vec4(f32::INFINITY, f32::NEG_INFINITY, 0.001, f32::NAN),
    ];
    picture::write_picture(&path, &Frame::new(uvec2(3, 1), texels)).unwrap();
    let stored = image::open(&path).unwrap();
    assert_eq!(stored.color(), image::ColorType::Rgba8);
    let stored = stored.into_rgba8();
    assert_eq!(stored.as_raw()[..], [0, 118, 255, 255, 0, 255, 0, 128, 255, 0, 3, 0]);
    let read = picture::read_picture(&path).unwrap();
    assert_eq!(read.size(), uvec2(3, 1));
    assert!(
        (read.texels()[0] - vec4(0.0, 0.18, 1.0, 1.0)).abs().max_element() < 0.005,
        "{:?}",
        read.texels()[0]
    );
}

#[test]
fn at_eight_bits_is_what_a_png_gives_back() {
    let scratch = Scratch::new("picture-rounded");
    let path = scratch.join("picture.png");
    let frame = gradient(uvec2(40, 30));
    picture::write_picture(&path, &frame).unwrap();
    assert_eq!(picture::read_picture(&path).unwrap(), picture::at_eight_bits(&frame));
    // Values that no PNG holds are not made black.
    let spoilt = Frame::new(
        uvec2(2, 1),
        vec![vec4(f32::NAN, 0.5, 0.5, 1.0), vec4(0.5, 0.5, f32::INFINITY, 1.0)],
    );
    assert!(
        picture::at_eight_bits(&spoilt)
            .texels()
            .iter()
            .all(|texel| !texel.is_finite())
    );
}

#[test]
fn an_extension_that_is_unknown_is_refused() {
    let scratch = Scratch::new("picture-extension");
    for name in ["picture.jpg", "picture", ".png"] {
        let error = picture::write_picture(&scratch.join(name), &gradient(uvec2(2, 2))).unwrap_err();
        assert!(matches!(error, PictureError::UnknownExtension { .. }), "{error:?}");
        let message = error.to_string();
        assert!(message.contains(name) && message.contains(".png or .exr"), "{message}");
        assert!(picture::read_picture(&scratch.join(name)).is_err());
    }
    assert!(scratch.names().is_empty());
}

#[test]
fn a_failed_write_leaves_nothing_behind() {
    let scratch = Scratch::new("picture-failure");
    fs::write(scratch.join("file"), "not a folder").unwrap();
    fs::create_dir(scratch.join("taken.png")).unwrap();
    for (path, reason) in [
        ("file/picture.png", "file"),
        ("absent/picture.exr", "folder exists"),
        ("taken.png", "write"),
    ] {
        let message = picture::write_picture(&scratch.join(path), &gradient(uvec2(5, 4)))
            .unwrap_err()
            .to_string();
        assert!(
            message.contains(reason) && message.contains("cannot write"),
            "{path}: {message}"
        );
    }
    assert_eq!(scratch.names(), ["file", "taken.png"]);
}

#[test]
fn damaged_files_are_refused_by_name() {
    let scratch = Scratch::new("picture-damaged");
    for name in ["picture.png", "picture.exr"] {
        let path = scratch.join(name);
        picture::write_picture(&path, &gradient(uvec2(40, 30))).unwrap();
        let whole = fs::read(&path).unwrap();
        for length in [0, 1, 4, 40, whole.len() / 2, whole.len() - 20] {
            fs::write(&path, &whole[..length]).unwrap();
            let error = picture::read_picture(&path).unwrap_err();
            assert!(matches!(error, PictureError::Damaged { .. }), "{length}: {error:?}");
            assert!(error.to_string().contains(name), "{error}");
        }
        fs::write(&path, "this is not a picture, but a sentence").unwrap();
        assert!(matches!(
            picture::read_picture(&path).unwrap_err(),
            PictureError::Damaged { .. }
        ));
    }
    let missing = picture::read_picture(&scratch.join("missing.exr")).unwrap_err();
    assert!(missing.to_string().contains("missing.exr"), "{missing}");
}
