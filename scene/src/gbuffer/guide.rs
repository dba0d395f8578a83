//! Inputs of a filter with `guide=add`: differences of colours from the guide, and its mean.

use super::GBufferError;
use super::pattern::pattern_of;
use crate::capture::{Capture, ShadingSample};
use crate::inputs::Inputs;
use crate::render::OFFSETS;
use glam::{IVec2, UVec2, Vec3, Vec4, ivec2};
use rayon::prelude::*;
use straightline_kernels::OptionValues;
use straightline_kernels::prelude::{Frame, FrameLayers, Texture};
use straightline_kernels::sraa::{
    Colors, FitSums, GBuffer, Guiding, Pattern, Resolve, Shading, Sraa, View, sraa_fit, sraa_fit_sums, sraa_guide,
};

/// The largest half. By definition of the filter, a guide with a brighter channel counts as 0.
const BRIGHTEST: f32 = 65504.0;

/// Returns the guide of every layer of the capture's geometry.
pub(super) fn layers(capture: &Capture) -> Result<&FrameLayers<Vec4>, GBufferError> {
    capture.guide.as_ref().ok_or(GBufferError::Missing {
        what: "guide (guide.exr)",
        option: "guide=add".to_owned(),
        help: "write it, as `straightline capture --guide` does, or use guide=none",
    })
}

/// Returns colours as differences from the guide, and the guide's mean, for a filter with these options.
pub(super) fn colors(capture: &Capture, options: &OptionValues) -> Result<Inputs, GBufferError> {
    let given = layers(capture)?;
    let cfg = configured(capture, options)?;
    let scale = scale(&cfg, capture, options, given)?;
    let guide = &scaled(given, scale);
    let mut inputs = Inputs::new(capture.size)
        .with_image("color", color(capture, guide))
        .with_image("guide_mean", mean(&cfg, capture, guide))
        .with_image("guide_scale", Frame::new(UVec2::ONE, vec![scale.extend(0.0)]));
    if !capture.colors.is_empty() {
        let shaded = capture.shaded_layers();
        let colors = capture.colors.iter().zip(shaded);
        let differences = colors.map(|(color, layer)| difference(color, guide, |_| layer));
        inputs = inputs.with_layers("colors", differences.collect());
    }
    Ok(inputs)
}

/// Returns colours as differences from the guide, for a filter with these options.
pub(crate) fn differences(capture: &Capture, options: &OptionValues) -> Result<Frame<Vec4>, GBufferError> {
    let given = layers(capture)?;
    let cfg = configured(capture, options)?;
    Ok(color(capture, &scaled(given, scale(&cfg, capture, options, given)?)))
}

/// Returns the scale of the guide.
fn scale(
    cfg: &Sraa,
    capture: &Capture,
    options: &OptionValues,
    given: &FrameLayers<Vec4>,
) -> Result<Vec3, GBufferError> {
    match options.flag("fitted") {
        Some(true) => fitted(cfg, capture, given),
        _ => Ok(Vec3::ONE),
    }
}

/// Returns the guide times a scale, as the filter counts it.
fn scaled(guide: &FrameLayers<Vec4>, scale: Vec3) -> FrameLayers<Vec4> {
    let layer = |layer: &Frame<Vec4>| {
        let texels = layer.texels().iter().map(|texel| scale.extend(0.0) * counted(*texel));
        Frame::new(layer.size(), texels.collect())
    };
    FrameLayers::new(guide.layers().iter().map(layer).collect())
}

/// Returns differences of further colours from the guide times `scale`, at the samples in `at`.
pub(crate) fn difference_at(
    color: &Frame<Vec4>,
    guide: &FrameLayers<Vec4>,
    at: &Frame<u32>,
    scale: Vec3,
) -> Frame<Vec4> {
    let texels = color.texels().iter().zip(at.texels()).enumerate();
    let texels = texels.map(|(k, (color, sample))| {
        let layer = guide.layers().get(*sample as usize);
        *color - scale.extend(0.0) * layer.map_or(Vec4::ZERO, |layer| counted(layer.texels()[k]))
    });
    Frame::new(color.size(), texels.collect())
}

/// Returns the difference of each pixel's colour from the guide at the shaded sample.
fn color(capture: &Capture, guide: &FrameLayers<Vec4>) -> Frame<Vec4> {
    let layer = match (&capture.shading, &capture.place) {
        (ShadingSample::Sample(sample), _) => *sample,
        // With several shading samples the mean is not read.
        (ShadingSample::Samples(_), _) => return capture.color.clone(),
        (ShadingSample::Centre | ShadingSample::Placed, None) => capture.samples.len(),
        (_, Some(place)) => return difference(&capture.color, guide, |k| place.texels()[k] as usize),
    };
    difference(&capture.color, guide, |_| layer)
}

/// Returns `color` minus the guide, in the layer that `layer` returns for each texel.
fn difference(color: &Frame<Vec4>, guide: &FrameLayers<Vec4>, layer: impl Fn(usize) -> usize) -> Frame<Vec4> {
    let texels = color.texels().iter().enumerate();
    let texels = texels.map(|(k, color)| *color - counted(guide.layers()[layer(k)].texels()[k]));
    Frame::new(color.size(), texels.collect())
}

/// Returns a guide as the filter counts it, with alpha 0.
fn counted(guide: Vec4) -> Vec4 {
    match guide.truncate().abs().cmple(Vec3::splat(BRIGHTEST)).all() {
        true => guide.truncate().extend(0.0),
        false => Vec4::ZERO,
    }
}

/// Returns the options of the guide's kernels for a capture, as rustc compiles them.
fn configured(capture: &Capture, options: &OptionValues) -> Result<Sraa, GBufferError> {
    let pattern = pattern_of(&capture.samples);
    let resolve = match options.choice("resolve") {
        Some("tent") => Resolve::Tent,
        Some("gaussian") => Resolve::Gaussian,
        Some("mitchell") => Resolve::Mitchell,
        Some("lanczos") => Resolve::Lanczos,
        _ => Resolve::Box,
    };
    if pattern.is_none() && resolve != Resolve::Box {
        return Err(GBufferError::Missing {
            what: "samples of a pattern that has a name",
            option: "a guide with another filter of samples than a box".to_owned(),
            help: "use resolve=box",
        });
    }
    let unset = Sraa::default();
    let radius = options.number("resolve-radius").map(|radius| radius as f32);
    Ok(Sraa {
        pattern: pattern.unwrap_or(Pattern::Listed),
        offsets: match pattern {
            Some(_) => &[],
            None => &OFFSETS[..2 * capture.samples.len()],
        },
        resolve,
        resolve_radius: radius.unwrap_or(unset.resolve_radius),
        ..unset
    })
}

/// A view that no kernel reads.
const UNSEEN: View = View {
    ray_corner: Vec3::ZERO,
    ray_right: Vec3::ZERO,
    ray_down: Vec3::ZERO,
    ray_forward: Vec3::ZERO,
    origin: IVec2::ZERO,
    near: 1.0,
    far: 1.0,
};

/// Returns the mean of the guide: the kernel `sraa_guide`, as rustc compiles it.
fn mean(cfg: &Sraa, capture: &Capture, guide: &FrameLayers<Vec4>) -> Frame<Vec4> {
    let guiding = Guiding {
        guide: guide.clone(),
        ..Guiding::unread()
    };
    let (gbuffer, colors, size) = (GBuffer::unread(), Colors::unread(), capture.size);
    let pixel = |x: i32, y: i32| sraa_guide(cfg, &gbuffer, &UNSEEN, &colors, &guiding, ivec2(x, y));
    let rows = (0..size.y as i32).into_par_iter();
    let places = rows.flat_map_iter(|y| (0..size.x as i32).map(move |x| (x, y)));
    Frame::new(size, places.map(|(x, y)| pixel(x, y)).collect())
}

/// Returns the scale of the guide: the kernels `sraa_fit_sums` and `sraa_fit`, as rustc compiles them.
fn fitted(cfg: &Sraa, capture: &Capture, guide: &FrameLayers<Vec4>) -> Result<Vec3, GBufferError> {
    let shading = match (&capture.shading, &capture.place) {
        (ShadingSample::Centre, _) => Shading::Centre,
        (ShadingSample::Placed, Some(_)) => Shading::Placed,
        (ShadingSample::Sample(0), _) => Shading::Sample0,
        _ => {
            return Err(GBufferError::Missing {
                what: "one shading sample a pixel, at its centre, its first sample or where it is placed",
                option: "fitted=true".to_owned(),
                help: "use fitted=false",
            });
        }
    };
    let cfg = Sraa { shading, ..*cfg };
    let guiding = Guiding {
        guide: guide.clone(),
        ..Guiding::unread()
    };
    let mut colors = Colors {
        color: capture.color.clone(),
        ..Colors::unread()
    };
    if let Some(place) = &capture.place {
        colors.place = place.clone();
    }
    let (gbuffer, tiles) = (GBuffer::unread(), capture.size.map(|axis| axis.div_ceil(16)).as_ivec2());
    let places = (0..tiles.x * tiles.y).into_par_iter();
    let sums: Vec<FitSums> = places
        .map(|tile| ivec2(tile % tiles.x, tile / tiles.x))
        .map(|tile| sraa_fit_sums(&cfg, &gbuffer, &UNSEEN, &colors, &guiding, tile))
        .collect();
    let texture = |of: fn(&FitSums) -> Vec4| Texture::new(tiles.as_uvec2(), sums.iter().map(of).collect());
    Ok(sraa_fit(&cfg, &texture(|sums| sums.both), &texture(|sums| sums.own), IVec2::ZERO).truncate())
}
