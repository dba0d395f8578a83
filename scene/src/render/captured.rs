//! Captures of what a renderer draws.

use super::{PlacedBy, RenderError, Renderer, shade_placed};
use crate::capture::{Capture, NormalSpace, ShadingSample, mean_frame};
use crate::gbuffer;
use glam::Vec2;
use straightline_kernels::prelude::FrameLayers;

/// Draws the inputs of a filter: colour shaded once a pixel, or at each of several samples, and geometry at each of `samples`
/// (and, with [`ShadingSample::Centre`] and [`ShadingSample::Placed`], once more at the pixel's centre).
///
/// Shading is placed by depths: see [`capture_placed`].
///
/// `samples` are in pixels from the pixel's centre, y down. There is no reference in the capture;
/// [`render_reference`](super::render_reference()) makes one.
///
/// # Errors
///
/// [`RenderError::NoOffsets`] without samples, [`RenderError::ShadingSample`] if `shading` names one that there is
/// not; what the renderer refuses.
pub fn capture_scene(
    renderer: &dyn Renderer,
    samples: &[Vec2],
    shading: ShadingSample,
) -> Result<Capture, RenderError> {
    capture_with(renderer, samples, shading, PlacedBy::Depths)
}

/// Draws the inputs of a filter with [`ShadingSample::Placed`], by the kernel `sraa_place` with the options of `by`.
///
/// # Errors
///
/// [`RenderError::Unnamed`] by planes if `samples` lie at no pattern that has a name; else as [`capture_scene`].
pub fn capture_placed(renderer: &dyn Renderer, samples: &[Vec2], by: PlacedBy) -> Result<Capture, RenderError> {
    if by == PlacedBy::Planes && gbuffer::pattern_of(samples).is_none() {
        return Err(RenderError::Unnamed { samples: samples.len() });
    }
    capture_with(renderer, samples, ShadingSample::Placed, by)
}

fn capture_with(
    renderer: &dyn Renderer,
    samples: &[Vec2],
    shading: ShadingSample,
    by: PlacedBy,
) -> Result<Capture, RenderError> {
    super::check_offsets(samples)?;
    let mut places = samples.to_vec();
    let of = |sample: &usize| {
        samples.get(*sample).copied().ok_or(RenderError::ShadingSample {
            sample: *sample,
            samples: samples.len(),
        })
    };
    let shaded = match &shading {
        ShadingSample::Sample(sample) => vec![of(sample)?],
        ShadingSample::Samples(several) => several.iter().map(of).collect::<Result<_, _>>()?,
        ShadingSample::Centre | ShadingSample::Placed => {
            places.push(Vec2::ZERO);
            vec![Vec2::ZERO]
        }
    };
    let mut colors = Vec::new();
    for place in shaded {
        colors.push(renderer.draw_shaded(place)?);
    }
    let color = mean_frame(&colors).ok_or(RenderError::NoOffsets)?;
    let (mut depth, mut normal) = (Vec::new(), Vec::new());
    for place in &places {
        let (depths, normals) = renderer.draw_geometry(*place)?;
        depth.push(depths);
        normal.push(normals);
    }
    let mut capture = Capture {
        size: renderer.size(),
        samples: samples.to_vec(),
        color,
        colors: match &shading {
            ShadingSample::Samples(_) => colors,
            ShadingSample::Sample(_) | ShadingSample::Centre | ShadingSample::Placed => Vec::new(),
        },
        shading,
        normal_space: NormalSpace::View,
        camera: Some(renderer.camera()),
        place: None,
        depth: FrameLayers::new(depth),
        normal: Some(FrameLayers::new(normal)),
        albedo: None,
        direct: None,
        rest: None,
        guide: None,
        reference: None,
    };
    if capture.shading == ShadingSample::Placed
        && let Some(placed) = shade_placed(&capture, renderer, by)?
    {
        capture.color = placed.color;
        capture.place = Some(placed.place);
    }
    Ok(capture)
}
