//! Inputs of a filter with an additive guide.

use super::{GuideLight, RenderError, Renderer, demodulated};
use crate::capture::Capture;
use glam::Vec2;
use straightline_kernels::prelude::FrameLayers;

/// Adds the guide to a capture drawn by `renderer`, in every layer of its geometry: see [`Renderer::guide_by`].
///
/// # Errors
///
/// Fails if the renderer does.
pub fn add_guide(capture: &mut Capture, renderer: &dyn Renderer, known: GuideLight) -> Result<(), RenderError> {
    let mut places = capture.samples.clone();
    if places.len() < capture.layer_count() {
        places.push(Vec2::ZERO);
    }
    let layers: Result<Vec<_>, _> = places
        .iter()
        .map(|place| {
            demodulated::map_surfaces(renderer, *place, |surface, at| {
                renderer.guide_by(known, surface, at).extend(0.0)
            })
        })
        .collect();
    capture.guide = Some(FrameLayers::new(layers?));
    Ok(())
}
