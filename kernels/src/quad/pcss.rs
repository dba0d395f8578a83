//! Shadows that are sharp at the contact: percentage-closer soft shadows, with both searches shared over the quad
//! (the chapter's §2.10 names contact hardening).

use super::coordinates::{counted, mean};
use super::guards::Guards;
use crate::prelude::*;

options! {
    /// Options of the contact-hardening shadow.
    pub struct Pcss {
        /// Distribution of the reads.
        pub sharing: SearchSharing = SearchSharing::Quad,
        /// Width of the blocker search, in texels.
        pub search: f32 [1.0..=256.0] = 16.0,
        /// Width of the penumbra, in texels, for a difference in depth of 1: the size of the light.
        pub light: f32 [0.0..=1.0e6] = 400.0,
        /// Narrowest penumbra, in texels.
        pub narrowest: f32 [0.5..=64.0] = 2.0,
        /// Widest penumbra, in texels.
        pub widest: f32 [1.0..=256.0] = 24.0,
        /// Tests for coordinates that are not finite or far from the map.
        pub guards: Guards = Guards::Inline,
    }
}

/// Distribution of the reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SearchSharing {
    /// Shared: each lane reads four depths and takes four comparisons around the quad's mean position.
    Quad,
    /// Not shared: each pixel reads sixteen depths and takes sixteen comparisons around its own position.
    Alone,
}

/// Light on each pixel of a quad, 0 to 1, in every component.
///
/// Of sixteen depths in the search's width, those nearer to the light than the pixel are its blockers. Their mean distance
/// determines the penumbra, in which sixteen comparisons are taken. `coord` is interpolated: a position in the shadow map, 0 to
/// 1, and the depth to compare. Depths are linear, as for a directional light.
///
/// The light is a number from 0 to 1 for every `coord`. A lane whose coordinates are not finite, or so far from the map that
/// both searches read only its border, does not move the quad's mean position. Its own result is that of a position beside the
/// map, or of the map's first corner at depth 0 if its coordinates are not finite. `guards=none` omits these tests; it is a
/// promise that coordinates are finite and at most a map's width away from the map.
pub fn pcss(cfg: &Pcss, shadow: &DepthTexture, shadow_sampler: &ComparisonSampler, coord: Quad<Vec3>) -> Quad<Vec4> {
    // Taps lie at up to three eighths of a width.
    let seen = counted(shadow, coord, 0.375 * cfg.search.max(cfg.widest) + 2.0);
    let (coord, centre) = match cfg.guards {
        Guards::Inline => (seen.coord, mean(&seen)),
        Guards::None => (coord, coord.average()),
    };
    let lit = match cfg.sharing {
        SearchSharing::Quad => {
            let mut found = Quad::splat(Vec2::ZERO);
            for k in 0..4 {
                found += blocker(cfg, shadow, centre, quad_vector() + away(k));
            }
            let width = penumbra(cfg, found.sum(), centre.z());
            let mut sum = Quad::splat(0.0);
            for k in 0..4 {
                sum += compare(shadow, shadow_sampler, centre, width, quad_vector() + away(k));
            }
            sum.average() * 0.25
        }
        SearchSharing::Alone => {
            let mut found = Quad::splat(Vec2::ZERO);
            for k in 0..16 {
                found += blocker(cfg, shadow, coord, Quad::splat(grid(k)));
            }
            let width = penumbra(cfg, found, coord.z());
            let mut sum = Quad::splat(0.0);
            for k in 0..16 {
                sum += compare(shadow, shadow_sampler, coord, width, Quad::splat(grid(k)));
            }
            sum / 16.0
        }
    };
    Vec4::ONE * lit
}

/// Offset of a lane's tap `k` from that of a lane with only one tap.
fn away(k: usize) -> Vec2 {
    vec2(4.0 * (k % 2) as f32 - 2.0, 4.0 * (k / 2) as f32 - 2.0)
}

/// Tap `k` of sixteen: -3, -1, 1 or 3 on each axis.
fn grid(k: usize) -> Vec2 {
    vec2(2.0 * (k % 4) as f32 - 3.0, 2.0 * (k / 4) as f32 - 3.0)
}

/// A blocker's depth and 1, or zeros if the texel is no blocker.
fn blocker(cfg: &Pcss, shadow: &DepthTexture, coord: Quad<Vec3>, at: Quad<Vec2>) -> Quad<Vec2> {
    let place = coord.truncate() * shadow.size().as_vec2() + at * (cfg.search / 8.0);
    let depth = shadow.load(place.floor().as_ivec2());
    let blocks = depth.lt(coord.z());
    blocks.select(Quad::from_xy(depth, 1.0), Quad::splat(Vec2::ZERO))
}

/// Width of the penumbra in texels, from the blockers' summed depths and their number.
fn penumbra(cfg: &Pcss, found: Quad<Vec2>, depth: Quad<f32>) -> Quad<f32> {
    let distance = depth - found.x() / found.y().max(1.0);
    let width = distance * cfg.light;
    // The distance of an infinitely near blocker may be NaN. The comparison is false for a NaN.
    let width = width.lt(cfg.widest).select(width, Quad::splat(cfg.widest));
    let width = width.max(cfg.narrowest);
    // Without a blocker everything is lit, whatever the width.
    found.y().gt(0.5).select(width, Quad::splat(cfg.narrowest))
}

fn compare(
    shadow: &DepthTexture,
    shadow_sampler: &ComparisonSampler,
    coord: Quad<Vec3>,
    width: Quad<f32>,
    at: Quad<Vec2>,
) -> Quad<f32> {
    let place = at * (width * 0.125) / shadow.size().as_vec2();
    shadow.compare(shadow_sampler, coord.truncate() + place, coord.z())
}
