//! Captures of what a renderer draws.

use super::{RenderError, Renderer};
use crate::capture::{Capture, ShadingSample};
use glam::Vec2;
use straightline_kernels::prelude::FrameLayers;

/// What a filter gets: colour shaded once a pixel, and geometry at each of `samples` (and, with
/// [`ShadingSample::Centre`], once more at the pixel's centre).
///
/// `samples` are in pixels from the pixel's centre, y down. There is no reference in the capture;
/// [`reference`](super::reference()) makes one.
///
/// # Errors
///
/// [`RenderError::NoOffsets`] without samples, [`RenderError::ShadingSample`] if `shading` names one that there is
/// not; what the renderer refuses.
pub fn capture(renderer: &dyn Renderer, samples: &[Vec2], shading: ShadingSample) -> Result<Capture, RenderError> {
    super::check_offsets(samples)?;
    let mut places = samples.to_vec();
    let shaded = match shading {
        ShadingSample::Sample(sample) => *samples.get(sample).ok_or(RenderError::ShadingSample {
            sample,
            samples: samples.len(),
        })?,
        ShadingSample::Centre => {
            places.push(Vec2::ZERO);
            Vec2::ZERO
        }
    };
    let (mut depth, mut normal) = (Vec::new(), Vec::new());
    for place in places {
        let (depths, normals) = renderer.geometry(place)?;
        depth.push(depths);
        normal.push(normals);
    }
    Ok(Capture {
        size: renderer.size(),
        samples: samples.to_vec(),
        shading,
        camera: Some(renderer.camera()),
        color: renderer.shaded(shaded)?,
        depth: FrameLayers::new(depth),
        normal: Some(FrameLayers::new(normal)),
        reference: None,
    })
}
