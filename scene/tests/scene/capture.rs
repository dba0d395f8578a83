//! Captures in folders: what is written is read, and what is broken is refused by name.

use crate::common;

use common::Scratch;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, Layer, LayerAttributes, WritableImage,
};
use glam::{UVec2, Vec2, Vec3, Vec4, uvec2, vec2, vec4};
use std::fs;
use std::path::Path;
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_scene::capture::{Capture, CaptureError, NormalSpace, ShadingSample};
use straightline_scene::picture::{self, PictureError};

const SIZE: UVec2 = uvec2(19, 13);

fn frame<T: Copy>(size: UVec2, texel: impl Fn(f32) -> T) -> Frame<T> {
    Frame::new(size, (0..size.x * size.y).map(|i| texel(i as f32)).collect())
}

fn example(shading: ShadingSample) -> Capture {
    let samples = vec![
        vec2(-0.125, -0.375),
        vec2(0.375, -0.125),
        vec2(-0.375, 0.125),
        vec2(0.125, 0.375),
    ];
    let has_centre = matches!(shading, ShadingSample::Centre | ShadingSample::Placed);
    let layers = if has_centre { 5 } else { 4 };
    let depth = (0..layers)
        .map(|layer| frame(SIZE, |i| 10.0 * layer as f32 + (i * 0.37).sin()))
        .collect();
    let albedo = (0..layers).map(|layer| frame(SIZE, |i| vec4(0.1 * layer as f32, i.cos().abs(), 0.5, i % 2.0)));
    let albedo = FrameLayers::new(albedo.collect());
    let is_one = !matches!(shading, ShadingSample::Samples(_));
    let normal = (0..layers).map(|layer| frame(SIZE, |i| Vec3::new(layer as f32, i.cos(), i.sin()).normalize()));
    Capture {
        size: SIZE,
        samples,
        colors: Vec::new(),
        place: (shading == ShadingSample::Placed).then(|| frame(SIZE, |i| i as u32 % 5)),
        shading,
        normal_space: NormalSpace::View,
        camera: None,
        color: frame(SIZE, |i| vec4(i.sin(), i * 100.0, 1.0 / (i + 1.0), 1.0)),
        depth: FrameLayers::new(depth),
        normal: Some(FrameLayers::new(normal.collect())),
        albedo: Some(albedo),
        direct: is_one.then(|| frame(SIZE, |i| vec4(i.sin(), 2.0, i, 0.0))),
        rest: is_one.then(|| frame(SIZE, |i| vec4(0.5, i.cos(), 0.0, 0.0))),
        guide: Some(FrameLayers::new(vec![
            frame(SIZE, |i| vec4(0.2, -i, i.sin(), 1.0));
            layers
        ])),
        reference: Some(frame(SIZE, Vec4::splat)),
    }
}

/// Writes an EXR file by other means: layers of (name, size, channels).
fn write_exr(path: &Path, layers: &[(&str, UVec2, &[&str])]) {
    let size = |size: UVec2| (size.x as usize, size.y as usize);
    let layers: Vec<_> = layers
        .iter()
        .map(|(name, layer_size, channels)| {
            let values = vec![1.5; (layer_size.x * layer_size.y) as usize];
            let channels = channels
                .iter()
                .map(|name| AnyChannel::new(*name, FlatSamples::F32(values.clone())));
            let attributes = if name.is_empty() {
                LayerAttributes::default()
            } else {
                LayerAttributes::named(*name)
            };
            Layer::new(
                size(*layer_size),
                attributes,
                Encoding::UNCOMPRESSED,
                AnyChannels::sort(channels.collect()),
            )
        })
        .collect();
    Image::from_layers(ImageAttributes::with_size(size(SIZE)), layers)
        .write()
        .to_file(path)
        .unwrap();
}

#[test]
fn places_are_layers_that_there_are() {
    let scratch = Scratch::new("capture-places");
    let beyond = Capture {
        place: Some(frame(SIZE, |i| 3 + u32::from(i == 20.0) * 2)),
        ..example(ShadingSample::Placed)
    };
    let error = beyond.write(&scratch.join("beyond")).unwrap_err().to_string();
    assert!(error.contains("(1, 1)") && error.contains("4 is the centre"), "{error}");
    let none = Capture {
        place: None,
        ..example(ShadingSample::Placed)
    };
    let error = none.write(&scratch.join("none")).unwrap_err().to_string();
    assert!(error.contains("\"placed\""), "{error}");
    let dir = scratch.join("written");
    example(ShadingSample::Placed).write(&dir).unwrap();
    write_exr(&dir.join("place.exr"), &[("place", SIZE, &["Y"])]);
    let error = Capture::read(&dir).unwrap_err().to_string();
    assert!(error.contains("(0, 0)") && error.contains("place.exr"), "{error}");
    std::fs::remove_file(dir.join("place.exr")).unwrap();
    assert!(matches!(Capture::read(&dir), Err(CaptureError::MissingFile { .. })));
}

#[test]
fn what_is_written_is_read() {
    let scratch = Scratch::new("capture-round-trip");
    let full = example(ShadingSample::Centre);
    assert_eq!(
        (full.layer_count(), full.shaded_layers(), full.shaded_offsets()),
        (5, vec![4], Some(vec![Vec2::ZERO]))
    );
    let small = Capture {
        normal: None,
        albedo: None,
        direct: None,
        rest: None,
        guide: None,
        reference: None,
        ..example(ShadingSample::Sample(2))
    };
    assert_eq!(
        (small.layer_count(), small.shaded_layers(), small.shaded_offsets()),
        (4, vec![2], Some(vec![vec2(-0.375, 0.125)]))
    );
    let placed = example(ShadingSample::Placed);
    for (name, capture) in [("full", full), ("small", small), ("placed", placed)] {
        let dir = scratch.join("deeper").join(name);
        capture.write(&dir).unwrap();
        assert_eq!(Capture::read(&dir).unwrap(), capture);
    }
}

#[test]
fn values_that_are_not_finite_survive() {
    let scratch = Scratch::new("capture-non-finite");
    let mut capture = example(ShadingSample::Sample(0));
    capture.depth = FrameLayers::new(vec![frame(SIZE, |_| f32::INFINITY); 4]);
    capture.color = frame(SIZE, |_| Vec4::splat(f32::NAN));
    let dir = scratch.join("capture");
    capture.write(&dir).unwrap();
    let read = Capture::read(&dir).unwrap();
    assert_eq!(read.depth, capture.depth);
    assert!(read.color.texels().iter().all(|texel| texel.is_nan()));
}

#[test]
fn a_capture_is_replaced_and_leaves_no_file_of_the_old_one() {
    let scratch = Scratch::new("capture-replace");
    let dir = scratch.join("capture");
    example(ShadingSample::Centre).write(&dir).unwrap();
    let second = Capture {
        normal: None,
        albedo: None,
        direct: None,
        rest: None,
        guide: None,
        reference: None,
        ..example(ShadingSample::Sample(0))
    };
    second.write(&dir).unwrap();
    assert_eq!(Capture::read(&dir).unwrap(), second);
    assert_eq!(scratch.names(), ["capture"]);
}

#[test]
fn an_empty_folder_is_filled() {
    let scratch = Scratch::new("capture-empty");
    let dir = scratch.join("capture");
    fs::create_dir(&dir).unwrap();
    example(ShadingSample::Centre).write(&dir).unwrap();
    assert!(Capture::read(&dir).is_ok());
}

#[test]
fn folders_of_others_are_not_replaced() {
    let scratch = Scratch::new("capture-occupied");
    let (home, capture) = (scratch.join("home"), scratch.join("capture"));
    fs::create_dir(&home).unwrap();
    fs::write(home.join("thesis.tex"), "years of work").unwrap();
    example(ShadingSample::Centre).write(&capture).unwrap();
    fs::write(capture.join("notes.txt"), "mine").unwrap();
    for (dir, entry) in [(&home, "thesis.tex"), (&capture, "notes.txt")] {
        let error = example(ShadingSample::Sample(0)).write(dir).unwrap_err();
        assert!(
            matches!(&error, CaptureError::Occupied { entry: found, .. } if found == entry),
            "{error:?}"
        );
        assert!(dir.join(entry).exists());
    }
    assert_eq!(Capture::read(&capture).unwrap(), example(ShadingSample::Centre));
    assert_eq!(scratch.names(), ["capture", "home"]);
}

#[test]
fn an_unwritable_place_is_refused_and_nothing_is_left() {
    let scratch = Scratch::new("capture-unwritable");
    fs::write(scratch.join("file"), "not a folder").unwrap();
    for path in ["file", "file/capture"] {
        let message = example(ShadingSample::Centre)
            .write(&scratch.join(path))
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("cannot write") && message.contains("file"),
            "{message}"
        );
    }
    assert_eq!(scratch.names(), ["file"]);
}

#[test]
fn a_capture_that_contradicts_itself_is_not_written() {
    let scratch = Scratch::new("capture-contradiction");
    let good = example(ShadingSample::Centre);
    let other = uvec2(3, 3);
    let layers = |count| FrameLayers::new(vec![frame(SIZE, |i| i); count]);
    for (bad, reasons) in [
        (
            Capture {
                depth: layers(4),
                ..good.clone()
            },
            &["depth.exr", "4 layers", "`sample3` and `centre`"][..],
        ),
        (
            Capture {
                depth: layers(6),
                ..good.clone()
            },
            &["depth.exr", "6 layers"],
        ),
        (
            Capture {
                color: frame(other, Vec4::splat),
                ..good.clone()
            },
            &["color.exr", "3×3", "19×13"],
        ),
        (
            Capture {
                reference: Some(frame(other, Vec4::splat)),
                ..good.clone()
            },
            &["reference.exr", "3×3"],
        ),
        (
            Capture {
                albedo: Some(FrameLayers::new(vec![frame(SIZE, Vec4::splat); 4])),
                ..good.clone()
            },
            &["albedo.exr", "4 layers"],
        ),
        (
            Capture {
                guide: Some(FrameLayers::new(vec![frame(SIZE, Vec4::splat); 3])),
                ..good.clone()
            },
            &["guide.exr", "3 layers"],
        ),
        (
            Capture {
                direct: Some(frame(other, Vec4::splat)),
                ..good.clone()
            },
            &["direct.exr", "3×3"],
        ),
        (
            Capture {
                rest: Some(frame(other, Vec4::splat)),
                ..good.clone()
            },
            &["rest.exr", "3×3"],
        ),
        (
            Capture {
                shading: ShadingSample::Samples(vec![0, 1]),
                colors: vec![good.color.clone(); 2],
                depth: layers(4),
                normal: None,
                albedo: None,
                guide: None,
                ..good.clone()
            },
            &["direct.exr", "several times a pixel", "leave the file out"],
        ),
        (
            Capture {
                samples: vec![],
                ..good.clone()
            },
            &["samples", "there are 0"],
        ),
        (
            Capture {
                samples: vec![vec2(0.0, f32::NAN); 4],
                ..good.clone()
            },
            &["samples", "NaN"],
        ),
        (
            Capture {
                shading: ShadingSample::Sample(4),
                ..good.clone()
            },
            &["shading", "sample 4", "0 to 3"],
        ),
        (
            Capture {
                size: uvec2(0, 5),
                ..good.clone()
            },
            &["0×5"],
        ),
    ] {
        let message = bad.write(&scratch.join("capture")).unwrap_err().to_string();
        for reason in reasons {
            assert!(message.contains(reason), "{message:?} lacks {reason:?}");
        }
    }
    assert!(scratch.names().is_empty());
}

/// The error of reading an example capture after `damage` was done to its folder.
fn damaged(name: &str, damage: impl FnOnce(&Path)) -> CaptureError {
    let scratch = Scratch::new(&format!("capture-damaged-{name}"));
    let dir = scratch.join("capture");
    example(ShadingSample::Centre).write(&dir).unwrap();
    damage(&dir);
    Capture::read(&dir).expect_err(name)
}

fn contains(error: &CaptureError, parts: &[&str]) {
    let message = error.to_string();
    for part in parts {
        assert!(message.contains(part), "{message:?} lacks {part:?}");
    }
}

#[test]
fn a_folder_without_description_is_no_capture() {
    let error = damaged("no-json", |dir| fs::remove_file(dir.join("capture.json")).unwrap());
    assert!(matches!(error, CaptureError::NotACapture { .. }), "{error:?}");
    contains(&error, &["capture-damaged-no-json", "capture.json", "docs/captures.md"]);
    let absent = Capture::read(Path::new("no/such/folder")).unwrap_err();
    assert!(matches!(absent, CaptureError::NotACapture { .. }), "{absent:?}");
    let file = Capture::read(Path::new(file!()).file_name().unwrap().as_ref()).unwrap_err();
    assert!(matches!(file, CaptureError::NotACapture { .. }), "{file:?}");
}

#[test]
fn a_bad_description_is_refused_with_line_and_column() {
    let error = damaged("json", |dir| {
        fs::write(dir.join("capture.json"), "{\n  \"schema\": 1,\n  size\n}").unwrap()
    });
    contains(&error, &["capture.json", "line 3 column 3"]);
    let error = damaged("binary", |dir| {
        fs::write(dir.join("capture.json"), [0xff, 0xfe, 0x00]).unwrap()
    });
    contains(&error, &["capture.json", "UTF-8"]);
}

#[test]
fn a_missing_file_is_named() {
    for file in ["color.exr", "depth.exr"] {
        let error = damaged(&format!("missing-{file}"), |dir| {
            fs::remove_file(dir.join(file)).unwrap()
        });
        assert!(matches!(error, CaptureError::MissingFile { .. }), "{error:?}");
        contains(&error, &[file, "is missing", "channel"]);
    }
}

#[test]
fn a_missing_layer_is_named_with_those_that_are_there() {
    let z: &[&str] = &["Z"];
    let layers = ["sample0", "sample1", "sample2", "sample3", "centre"].map(|name| (name, SIZE, z));
    for (missing, found) in [(2, "`sample1`: Z; `sample3`: Z"), (4, "`sample3`: Z")] {
        let error = damaged(&format!("layer-{missing}"), |dir| {
            let rest: Vec<_> = layers
                .iter()
                .copied()
                .filter(|layer| layer.0 != layers[missing].0)
                .collect();
            write_exr(&dir.join("depth.exr"), &rest);
        });
        assert!(
            matches!(error, CaptureError::Picture(PictureError::MissingLayer { .. })),
            "{error:?}"
        );
        contains(
            &error,
            &[
                "depth.exr",
                &format!("no layer `{}`", layers[missing].0),
                found,
                "channel Z",
            ],
        );
    }
}

#[test]
fn a_missing_channel_is_named() {
    let error = damaged("channel", |dir| {
        let layers = ["sample0", "sample1", "sample2", "sample3", "centre"];
        write_exr(
            &dir.join("normal.exr"),
            &layers.map(|name| (name, SIZE, &["X", "Y"][..])),
        );
    });
    assert!(
        matches!(error, CaptureError::Picture(PictureError::MissingChannel { .. })),
        "{error:?}"
    );
    contains(&error, &["normal.exr", "layer `sample0`", "`Z`", "channels X, Y and Z"]);
    let error = damaged("color", |dir| {
        write_exr(&dir.join("color.exr"), &[("", SIZE, &["R", "G", "Z"])])
    });
    contains(&error, &["color.exr", "no colour", "unnamed: G, R, Z"]);
}

#[test]
fn a_layer_too_many_is_named() {
    let error = damaged("surplus", |dir| {
        let layers = ["sample0", "sample1", "sample2", "sample3", "sample4", "centre"];
        write_exr(&dir.join("depth.exr"), &layers.map(|name| (name, SIZE, &["Z"][..])));
    });
    assert!(matches!(error, CaptureError::Layers { .. }), "{error:?}");
    contains(
        &error,
        &[
            "depth.exr",
            "`sample4`",
            "4 samples",
            "`sample0` to `sample3` and `centre`",
        ],
    );
}

#[test]
fn sizes_that_differ_are_named_both() {
    let other = uvec2(8, 13);
    for file in ["color.exr", "reference.exr"] {
        let error = damaged(&format!("size-{file}"), |dir| {
            picture::write_exr(&dir.join(file), &frame(other, Vec4::splat)).unwrap();
        });
        assert!(
            matches!(error, CaptureError::Picture(PictureError::Size { .. })),
            "{error:?}"
        );
        contains(&error, &[file, "8×13", "19×13", "capture.json"]);
    }
    let error = damaged("size-layer", |dir| {
        let z: &[&str] = &["Z"];
        let layers = ["sample0", "sample1", "sample2", "sample3", "centre"];
        write_exr(
            &dir.join("depth.exr"),
            &layers.map(|name| (name, if name == "sample2" { other } else { SIZE }, z)),
        );
    });
    contains(&error, &["depth.exr", "layer `sample2`", "8×13", "19×13"]);
}

#[test]
fn layers_may_be_prefixes_of_channels() {
    let scratch = Scratch::new("capture-prefix");
    let dir = scratch.join("capture");
    let written = example(ShadingSample::Centre);
    written.write(&dir).unwrap();
    let channels = ["sample0.Z", "sample1.Z", "sample2.Z", "sample3.Z", "centre.Z"];
    write_exr(&dir.join("depth.exr"), &[("", SIZE, &channels)]);
    let read = Capture::read(&dir).unwrap();
    assert_eq!(read.depth, FrameLayers::new(vec![frame(SIZE, |_| 1.5); 5]));
    assert_eq!(read.normal, written.normal);
}

#[test]
fn a_layer_that_covers_a_part_is_refused() {
    let error = damaged("cropped", |dir| {
        let channels = ["R", "G", "B"].map(|name| AnyChannel::new(name, FlatSamples::F32(vec![0.0; 19 * 13])));
        let attributes = LayerAttributes::default().with_position(exr::math::Vec2(2, 0));
        let layer = Layer::new(
            (19, 13),
            attributes,
            Encoding::UNCOMPRESSED,
            AnyChannels::sort(channels.into_iter().collect()),
        );
        Image::new(ImageAttributes::with_size((21, 13)), layer)
            .write()
            .to_file(dir.join("color.exr"))
            .unwrap();
    });
    contains(&error, &["color.exr", "display window"]);
}

#[test]
fn truncated_files_are_refused_at_every_length() {
    let scratch = Scratch::new("capture-truncated");
    let dir = scratch.join("capture");
    example(ShadingSample::Centre).write(&dir).unwrap();
    for file in ["color.exr", "depth.exr", "normal.exr", "reference.exr"] {
        let path = dir.join(file);
        let whole = fs::read(&path).unwrap();
        // Every part of the headers, then steps through the blocks, then the last bytes.
        let lengths = (0..whole.len()).filter(|length| length % 29 == 0 || whole.len() - length <= 8);
        for length in lengths {
            fs::write(&path, &whole[..length]).unwrap();
            let error = Capture::read(&dir).expect_err(&format!("{file} cut to {length} of {} bytes", whole.len()));
            assert!(error.to_string().contains(file), "{error}");
        }
        fs::write(&path, &whole).unwrap();
    }
    assert!(Capture::read(&dir).is_ok());
}

/// A changed byte may go unnoticed where it changes a value; it must never do worse than an error.
#[test]
fn changed_bytes_never_panic() {
    let scratch = Scratch::new("capture-changed");
    let dir = scratch.join("capture");
    example(ShadingSample::Centre).write(&dir).unwrap();
    let path = dir.join("depth.exr");
    let whole = fs::read(&path).unwrap();
    let (mut refused, mut tried) = (0, 0);
    // A step that meets every byte of a 32-bit number.
    for position in (0..whole.len()).step_by(7) {
        for change in [0x01, 0x80, 0xff] {
            let mut bytes = whole.clone();
            bytes[position] ^= change;
            fs::write(&path, &bytes).unwrap();
            tried += 1;
            match Capture::read(&dir) {
                Ok(read) => assert_eq!(read.depth.layers().len(), 5),
                Err(error) => {
                    assert!(error.to_string().contains("depth.exr"), "{error}");
                    refused += 1;
                }
            }
        }
    }
    assert!(refused > tried / 4, "{refused} of {tried} refused");
}

#[test]
fn surplus_and_double_layers_are_refused() {
    let scratch = Scratch::new("capture-surplus");
    let dir = scratch.join("capture");
    let capture = Capture {
        albedo: None,
        direct: None,
        rest: None,
        guide: None,
        reference: None,
        ..example(ShadingSample::Sample(0))
    };
    let layers = |names: &[&'static str]| -> Vec<(&'static str, UVec2, &'static [&'static str])> {
        names.iter().map(|name| (*name, SIZE, &["Z"][..])).collect()
    };
    for (names, says) in [
        (
            &["sample0", "sample1", "sample2", "sample3", "centre"][..],
            "a layer `centre`",
        ),
        (
            &["sample0", "sample1", "sample2", "sample3", "sample4"],
            "a layer `sample4`",
        ),
        (
            &["sample0", "sample1", "sample2", "sample3", "sample03"],
            "a layer `sample03`",
        ),
        (
            &["sample0", "sample1", "sample2", "sample3", "beauty"],
            "a layer `beauty`",
        ),
    ] {
        let _ = fs::remove_dir_all(&dir);
        capture.write(&dir).unwrap();
        write_exr(&dir.join("depth.exr"), &layers(names));
        let said = Capture::read(&dir).unwrap_err().to_string();
        assert!(said.contains("depth.exr") && said.contains(says), "{said}");
    }
    let twice = [
        ("sample0", &["Z"][..]),
        ("rest", &["sample0.Z", "sample1.Z", "sample2.Z", "sample3.Z"]),
    ];
    let twice: Vec<_> = twice.iter().map(|(name, channels)| (*name, SIZE, *channels)).collect();
    write_exr(&dir.join("depth.exr"), &twice);
    let said = Capture::read(&dir).unwrap_err().to_string();
    assert!(said.contains("two layers `sample0` with a channel `Z`"), "{said}");
}

#[test]
fn normals_and_references_that_are_not_finite_are_refused_with_their_place() {
    let scratch = Scratch::new("capture-nan");
    let at = |k: usize| move |i: f32| if i == k as f32 { f32::NAN } else { 0.5 };
    let good = example(ShadingSample::Sample(0));
    let mut normal = good.clone();
    let mut layers: Vec<Frame<Vec3>> = normal.normal.clone().unwrap().layers().to_vec();
    layers[2] = frame(SIZE, |i| Vec3::splat(at(21)(i)));
    normal.normal = Some(FrameLayers::new(layers));
    let mut reference = good;
    reference.reference = Some(frame(SIZE, |i| Vec4::splat(at(40)(i))));
    for (name, capture, says) in [
        (
            "normal",
            normal,
            ["normal.exr", "layer `sample2`", "at (2, 1)", "1 of 247 pixels"],
        ),
        (
            "reference",
            reference,
            ["reference.exr", "its colour", "at (2, 2)", "not finite"],
        ),
    ] {
        let dir = scratch.join(name);
        capture.write(&dir).unwrap();
        let said = Capture::read(&dir).unwrap_err().to_string();
        for text in says {
            assert!(said.contains(text), "{said}");
        }
    }
}
