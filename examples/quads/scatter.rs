//! Light that scatters below a surface, mimicked by part of a shadow's penumbra, which pixel quads make wide enough (Penner
//! 2011, figure 2.8).

use straightline_kernels::prelude::*;

options! {
    /// How a shadow falls on what light enters.
    pub struct Scatter {
        /// Distance between comparisons over that of a dense filter: how wide the penumbra is.
        pub spread: f32 [1.0..=64.0] = 2.0,
        /// Share of the penumbra in which there is red light alone, and green has yet to come.
        pub green: f32 [0.0..=0.9] = 0.3,
        /// The same of blue, which goes least far.
        pub blue: f32 [0.0..=0.9] = 0.45,
    }
}

/// Light that comes to each pixel of a quad, 0 to 1, red, green and blue.
///
/// `coord` is interpolated: a place in the shadow map, 0 to 1, and the depth to compare. The quad compares 8×8 texels, 2×2 at a
/// time by the sampler's own filter: four reads a lane.
///
/// The light is a number from 0 to 1 whatever `coord` is: a lane whose coordinates are not finite, or 1e4 and more, does not count.
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

/// Coordinates are numbers that count below this: hundreds of maps away lies the border alone.
const FARTHEST: f32 = 1.0e4;

/// Share of a lane that does not count in the quad's mean, 2⁻¹⁰⁰: nothing beside 1, and as good as 1 among its like.
const NO_SHARE: f32 = 7.888_609e-31;

/// Mean coordinates of the lanes whose own are finite and near: a bad lane, as of w = 0, spoils no other. Without any, all are 0.
fn mean(coord: Quad<Vec3>) -> Quad<Vec3> {
    let near = counts(coord);
    let finite = near.select(coord, Quad::splat(Vec3::ZERO));
    let share = near.select(Quad::splat(1.0), Quad::splat(NO_SHARE));
    let sums = (finite * share).extend(share).sum();
    sums.truncate() / sums.w()
}

/// Whether coordinates are numbers that count; a comparison with what is no number fails.
fn counts(coord: Quad<Vec3>) -> Quad<bool> {
    coord.x().abs().lt(FARTHEST) & coord.y().abs().lt(FARTHEST) & coord.z().abs().lt(FARTHEST)
}
