//! Pictures of the filters' results, for visual inspection.

use crate::failure::Failure;
use glam::Vec4;
use std::collections::BTreeMap;
use std::path::Path;
use straightline_bench::execute::{Bench, Inputs};
use straightline_codegen::files;
use straightline_kernels::prelude::Frame;
use straightline_scene::picture;
use straightline_study::quads::Studied;

/// Writes the shadow scene by each variant of the 8×8 filter, occlusion before and after upsampling, and details of both.
pub fn write_pictures(bench: &Bench, folder: &Path, studied: &Studied) -> Result<(), Failure> {
    let mut set = BTreeMap::new();
    let mut save = |name: &str, frame: &Frame<Vec4>| -> Result<(), Failure> {
        set.insert(name.to_owned(), picture::png_bytes(frame).map_err(Failure::from_error)?);
        Ok(())
    };
    for (way, shown) in shadow_pictures(bench, studied)? {
        save(
            &format!("pcf {way}.png").replace([',', ' '], "-").replace("--", "-"),
            &shown,
        )?;
    }
    save("pcf-details.png", &shadow_details(bench, studied)?)?;
    for (title, shown) in occlusion_pictures(studied) {
        if title != "bilinear" {
            save(&format!("occlusion-{}.png", title.replace(' ', "-")), &shown)?;
        }
    }
    save("occlusion-details.png", &occlusion_details(studied))?;
    files::write_all(folder, &set).map_err(Failure::from_error)?;
    Ok(())
}

/// Returns details of the shadows under the awning over the built-in scene's door (figure 2.7).
pub fn shadow_details(bench: &Bench, studied: &Studied) -> Result<Frame<Vec4>, Failure> {
    Ok(enlarge_part(&shadow_pictures(bench, studied)?, [0.55, 0.53, 0.1, 0.2]))
}

/// Returns details of the occlusion (figure 2.3).
pub fn occlusion_details(studied: &Studied) -> Frame<Vec4> {
    enlarge_part(&occlusion_pictures(studied), [0.53, 0.42, 0.12, 0.22])
}

/// Returns the shadow scene by each variant of the 8×8 filter.
fn shadow_pictures(bench: &Bench, studied: &Studied) -> Result<Vec<(&'static str, Frame<Vec4>)>, Failure> {
    let mut all = Vec::new();
    for way in ["naive", "quad", "quad, gradient", "gather"] {
        if let Some(lit) = studied.picture("PCF 8x8 quadratic", way) {
            all.push((
                way,
                studied
                    .shadowed
                    .shade_picture(bench, lit)
                    .map_err(Failure::from_error)?,
            ));
        }
    }
    Ok(all)
}

/// Returns occlusion at half resolution stretched by a sampler, upsampled, and at full resolution.
fn occlusion_pictures(studied: &Studied) -> Vec<(&'static str, Frame<Vec4>)> {
    let screen = &studied.screen;
    let low = screen.images.iter().rev().find(|(name, _)| name == "low");
    let mut all: Vec<(&str, Frame<Vec4>)> = Vec::new();
    all.extend(low.map(|(_, layers)| ("bilinear", stretch_bilinear(&layers[0], screen))));
    for (family, way, title) in [
        ("upsampling 2x", "quad, 1 read", "bilateral"),
        ("occlusion, 16 taps", "naive", "full resolution"),
        ("occlusion, 16 taps", "quad", "split over the quad"),
    ] {
        if let Some(image) = studied.picture(family, way) {
            let opaque = image.texels().iter().map(|t| t.truncate().extend(1.0));
            all.push((title, Frame::new(image.size(), opaque.collect())));
        }
    }
    all
}

/// Enlarges one part of several pictures and puts the results side by side. `part` is left, top, width and height as shares
/// of the whole.
fn enlarge_part(columns: &[(&str, Frame<Vec4>)], part: [f32; 4]) -> Frame<Vec4> {
    let detail = |frame: &Frame<Vec4>| {
        let size = frame.size().as_vec2();
        let [left, top, width, height] = part;
        let [x, y] = [left * size.x, top * size.y].map(|v| v as u32);
        let [width, height] = [width * size.x, height * size.y].map(|v| (v as u32).max(1));
        picture::enlarge_detail(frame, x, y, width, height, (400 / width).clamp(1, 8))
    };
    let details: Vec<(&str, Frame<Vec4>)> = columns.iter().map(|(title, frame)| (*title, detail(frame))).collect();
    let columns: Vec<(&str, &Frame<Vec4>)> = details.iter().map(|(title, frame)| (*title, frame)).collect();
    picture::compose_montage(&columns)
}

/// Stretches a low-resolution image as a bilinear sampler would, for comparison with bilateral upsampling.
fn stretch_bilinear(low: &Frame<Vec4>, screen: &Inputs) -> Frame<Vec4> {
    let size = screen.size;
    let texel = |k: u32| {
        let place = (glam::uvec2(k % size.x, k / size.x).as_vec2() + 0.5) / 2.0;
        let (corner, t) = (place.floor(), place - place.floor());
        let at = |i: i32, j: i32| low.load(corner.as_ivec2() + glam::ivec2(i, j));
        let row = |j: i32| at(0, j).lerp(at(1, j), t.x);
        row(0).lerp(row(1), t.y).truncate().extend(1.0)
    };
    Frame::new(size, (0..size.x * size.y).map(texel).collect())
}
