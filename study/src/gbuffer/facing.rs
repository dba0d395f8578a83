//! Whether a capture's normals are in the space that it says: what is seen faces the camera.

use super::GBufferError;
use crate::capture::{Capture, NormalSpace};
use crate::scene::SKY_DEPTH;

/// Share of normals that may look away: interpolated ones do at silhouettes.
const FEW: f64 = 0.01;

/// Cosine between ray and normal from which a normal looks away: interpolated ones do so a little.
const AWAY: f32 = 0.3;

/// Refuses normals of which more look away from the camera than may, if in the other space less than half as many do. Where both
/// spaces have as many, as of leaves whose normals look one way, nothing can be said; planes do not mind the sign.
pub(super) fn check(capture: &Capture) -> Result<(), GBufferError> {
    let stated = capture.normal_space;
    let (Some(away), Some(other_away)) = (looking_away(capture, stated), looking_away(capture, stated.other())) else {
        return Ok(());
    };
    match away > FEW && other_away < 0.5 * away {
        true => Err(GBufferError::NormalSpace {
            stated: stated.name(),
            away: 100.0 * away,
            other: stated.other().name(),
            other_away: 100.0 * other_away,
        }),
        false => Ok(()),
    }
}

/// Whether next to no normal looks away from the camera, as none can that is in the space that the capture says; not without
/// normals or camera.
pub(crate) fn face_the_camera(capture: &Capture) -> bool {
    looking_away(capture, capture.normal_space).is_some_and(|away| away <= FEW)
}

/// Share of the surfaces at the first shading sample whose normals look away, were they in `space`; `None` without normals or
/// camera.
fn looking_away(capture: &Capture, space: NormalSpace) -> Option<f64> {
    let [corner, right, down] = space.rays(capture.camera.as_ref()?, capture.size);
    let layer = *capture.shaded_layers().first()?;
    let normals = capture.normal.as_ref()?.layers()[layer].texels();
    let depths = capture.depth.layers()[layer].texels();
    let (mut seen, mut away) = (0u64, 0u64);
    for (k, (normal, depth)) in normals.iter().zip(depths).enumerate() {
        if *depth < SKY_DEPTH {
            let (x, y) = (k as u32 % capture.size.x, k as u32 / capture.size.x);
            let ray = corner + (x as f32 + 0.5) * right + (y as f32 + 0.5) * down;
            seen += 1;
            away += u64::from(ray.normalize_or_zero().dot(*normal) > AWAY);
        }
    }
    Some(away as f64 / seen.max(1) as f64)
}
