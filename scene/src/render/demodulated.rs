//! Inputs of a filter that borrows light apart from paint and from shadow.

use super::{RenderError, Renderer, Surface, placed};
use crate::capture::{Capture, ShadingSample};
use glam::{UVec2, Vec2, Vec4, uvec2};
use rayon::prelude::*;
use straightline_kernels::prelude::{Frame, FrameLayers};

/// Gives a capture of what `renderer` draws the albedo of every layer of its geometry, with the sun's share in alpha, and,
/// if it is shaded once a pixel, the direct light there and what does not follow the albedo.
///
/// # Errors
///
/// What the renderer refuses.
pub fn add_albedo(capture: &mut Capture, renderer: &dyn Renderer) -> Result<(), RenderError> {
    let mut places = capture.samples.clone();
    if places.len() < capture.layer_count() {
        places.push(Vec2::ZERO);
    }
    let layers: Result<Vec<_>, _> = places.iter().map(|place| renderer.draw_albedo(*place)).collect();
    capture.albedo = Some(FrameLayers::new(layers?));
    capture.direct = once_a_pixel(capture, &places, |place| renderer.draw_sunlight(place))?;
    capture.rest = once_a_pixel(capture, &places, |place| renderer.draw_unpainted(place))?;
    Ok(())
}

/// Draws every pixel at its place of shading, if it has only one.
fn once_a_pixel(
    capture: &Capture,
    places: &[Vec2],
    drawn: impl Fn(Vec2) -> Result<Frame<Vec4>, RenderError>,
) -> Result<Option<Frame<Vec4>>, RenderError> {
    match (&capture.shading, &capture.place) {
        (ShadingSample::Samples(_), _) => Ok(None),
        (ShadingSample::Sample(sample), _) => drawn(places[*sample]).map(Some),
        (ShadingSample::Placed, Some(chosen)) => {
            let centred = drawn(Vec2::ZERO)?;
            placed::gather_placed(places, chosen, centred, drawn).map(Some)
        }
        (ShadingSample::Centre | ShadingSample::Placed, _) => drawn(Vec2::ZERO).map(Some),
    }
}

/// Draws a picture of what `of` returns for each pixel's surface, seen `offset` from its centre.
pub(super) fn map_surfaces<R: Renderer + ?Sized>(
    renderer: &R,
    offset: Vec2,
    of: impl Fn(&Surface, Vec2) -> Vec4 + Sync,
) -> Result<Frame<Vec4>, RenderError> {
    let (size, surfaces): (UVec2, _) = (renderer.size(), renderer.draw_surfaces(offset)?);
    let texel = |(k, surface): (usize, &Surface)| {
        let pixel = uvec2(k as u32 % size.x, k as u32 / size.x);
        of(surface, pixel.as_vec2() + 0.5 + offset)
    };
    Ok(Frame::new(size, surfaces.par_iter().enumerate().map(texel).collect()))
}
