//! Checks that a capture's normals are in the space that it states: they should be perpendicular to the planes that depths
//! make.

use super::GBufferError;
use crate::capture::{Capture, NormalSpace};
use crate::scene::SKY_DEPTH;
use glam::{Mat3, UVec2, Vec3};

/// Sine of the angle from which a normal is off a plane: five degrees.
const OFF: f32 = 0.087;

/// The least share of normals that are off at which a space is doubted.
const MANY: f64 = 0.05;

/// The least share at which normals are taken for those of shading.
const BENT: f64 = 0.15;

/// Factor by which fewer normals must be off in the other space to be taken for normals of that space.
const FEWER: f64 = 2.0;

/// Greatest distance of depths from a plane's at three pixels in a row: of their inverses, as a share of the middle one's, and
/// of their change.
const EVEN: [f32; 2] = [1.0e-4, 0.01];

/// Refuses normals that are off the planes of the depths in the space that the capture says, and far less so in the other
/// one. Normals that are as far off in both, such as those of bumps, tell nothing, and so do those of a camera that is not
/// turned: then it makes no difference.
pub(super) fn check_normal_space(capture: &Capture) -> Result<(), GBufferError> {
    let stated = capture.normal_space;
    let Some(off) = off_planes(capture) else {
        return Ok(());
    };
    let (off, other_off) = match stated {
        NormalSpace::View => (off[0], off[1]),
        NormalSpace::World => (off[1], off[0]),
    };
    match off > MANY && other_off * FEWER < off {
        true => Err(GBufferError::NormalSpace {
            stated: stated.name(),
            off: 100.0 * off,
            other: stated.other().name(),
            other_off: 100.0 * other_off,
        }),
        false => Ok(()),
    }
}

/// Share of the normals on even ground that stand off the planes of the depths, if it is so large that normals must be
/// those of shading, bent by a map.
pub fn bent_normals(capture: &Capture) -> Option<f64> {
    let off = off_planes(capture)?;
    let own = match capture.normal_space {
        NormalSpace::View => off[0],
        NormalSpace::World => off[1],
    };
    (own > BENT).then_some(own)
}

/// Returns whether depths and normals give planes: both are there, with a camera, and in the space that the capture says.
pub fn has_planes(capture: &Capture) -> bool {
    capture.camera.is_some() && capture.normal.is_some() && check_normal_space(capture).is_ok()
}

/// Share of the normals on even ground that are off the planes that depths make, were they in view space, and in the
/// world's; `None` without normals or camera, or where nothing is even.
fn off_planes(capture: &Capture) -> Option<[f64; 2]> {
    let camera = capture.camera?;
    let [first, right, down] = NormalSpace::View.rays(&camera, capture.size);
    let parallel = camera.parallel_height.is_some();
    let to_world = Mat3::from_mat4(camera.view()).transpose();
    let layer = *capture.shaded_layers().first()?;
    let normals = capture.normal.as_ref()?.layers()[layer].texels();
    let depths = capture.depth.layers()[layer].texels();
    let UVec2 { x: width, y: height } = capture.size;
    let place = |x: u32, y: u32| (y * width + x) as usize;
    let point = |x: u32, y: u32| {
        let (aside, depth) = ((x as f32 + 0.5) * right + (y as f32 + 0.5) * down, depths[place(x, y)]);
        match parallel {
            true => aside + first * depth,
            false => (first + aside) * depth,
        }
    };
    let even = |before: usize, at: usize, after: usize| {
        let of = |k: usize| if parallel { depths[k] } else { 1.0 / depths[k] };
        let seen = [before, at, after]
            .into_iter()
            .all(|k| depths[k].is_finite() && (parallel || depths[k] > 0.0) && depths[k] < SKY_DEPTH);
        let bend = (of(before) + of(after) - 2.0 * of(at)).abs();
        seen && bend <= EVEN[0] * of(at).abs() + EVEN[1] * (of(after) - of(before)).abs()
    };
    let (mut sums, mut count) = ([0u64; 2], 0u64);
    for y in 1..height.saturating_sub(1) {
        for x in 1..width.saturating_sub(1) {
            let at = place(x, y);
            // No normal can be off where nothing is drawn, or none is known.
            if normals[at].length_squared() < 0.25 {
                continue;
            }
            if !even(at - 1, at, at + 1) || !even(at - width as usize, at, at + width as usize) {
                continue;
            }
            let across = point(x + 1, y) - point(x - 1, y);
            let Some(plane) = across.cross(point(x, y + 1) - point(x, y - 1)).try_normalize() else {
                continue;
            };
            let off = |plane: Vec3| u64::from(plane.cross(normals[at]).length() > OFF);
            sums[0] += off(plane);
            sums[1] += off(to_world * plane);
            count += 1;
        }
    }
    (count > 0).then(|| sums.map(|sum| sum as f64 / count as f64))
}
