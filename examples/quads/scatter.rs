//! Subsurface scattering, imitated by part of a shadow's penumbra, which pixel quads make wide enough (Penner
//! 2011, figure 2.8).

use straightline_kernels::prelude::*;

options! {
    /// Options of the scattering.
    pub struct Scatter {
        /// Distance between comparisons relative to that of a dense filter. Widens the penumbra.
        pub spread: f32 [1.0..=64.0] = 2.0,
        /// Share of the penumbra, from its dark end, without green light.
        pub green: f32 [0.0..=0.9] = 0.3,
        /// Share of the penumbra, from its dark end, without blue light, which travels the shortest distance.
        pub blue: f32 [0.0..=0.9] = 0.45,
    }
}

/// Red, green and blue light on each pixel of a quad, 0 to 1.
///
/// `coord` is interpolated: a position in the shadow map, 0 to 1, and the depth to compare. The quad compares 8×8 texels, 2×2
/// at a time by the sampler's own filter: four reads a lane.
///
/// The light is a number from 0 to 1 for every `coord`. A lane whose coordinates are not finite, or are 1e4 or more, is ignored.
pub fn scatter(
    cfg: &Scatter,
    shadow: &DepthTexture,
    shadow_sampler: &ComparisonSampler,
    coord: Quad<Vec3>,
) -> Quad<Vec4> {
    let size = shadow.size().as_vec2();
    let centre = mean(coord);
    let fraction = fract(centre.truncate() * size - 0.5);
    let mut lit = Quad::splat(0.0);
    for k in 0..4 {
        let corner = vec2((4 * (k % 2) - 2) as f32, (4 * (k / 2) - 2) as f32);
        let place = (quad_vector() + corner - fraction + 0.5) * cfg.spread;
        lit += shadow.compare(shadow_sampler, centre.truncate() + place / size, centre.z());
    }
    let begins = vec3(0.0, cfg.green, cfg.blue);
    let light = (Vec3::ONE * (lit.average() * 0.25) - begins) / (Vec3::ONE - begins);
    light.max(Vec3::ZERO).extend(1.0)
}

/// Upper bound on coordinates that count. Hundreds of maps away there is only the border.
const FARTHEST: f32 = 1.0e4;

/// Weight of an excluded lane in the quad's mean, 2⁻¹⁰⁰: negligible beside 1, but the mean of excluded lanes is still defined.
const NO_SHARE: f32 = 7.888_609e-31;

/// Mean coordinates of the lanes with finite and near ones: a bad lane, such as one with w = 0, affects no other. Without any, 0.
fn mean(coord: Quad<Vec3>) -> Quad<Vec3> {
    let near = counts(coord);
    let finite = near.select(coord, Quad::splat(Vec3::ZERO));
    let share = near.select(Quad::splat(1.0), Quad::splat(NO_SHARE));
    let sums = (finite * share).extend(share).sum();
    sums.truncate() / sums.w()
}

/// Returns whether coordinates are finite and near. Comparisons with NaN are false.
fn counts(coord: Quad<Vec3>) -> Quad<bool> {
    coord.x().abs().lt(FARTHEST) & coord.y().abs().lt(FARTHEST) & coord.z().abs().lt(FARTHEST)
}
