//! Shadow maps that are seen from afar, where a quad's pixels lie more texels apart than its filter is wide: filters that are as
//! wide as the quad (Penner 2011, §2.9).

use straightline_kernels::prelude::*;

options! {
    /// How a shadow map is filtered from afar.
    pub struct Minified {
        /// What makes the filter as wide as the quad.
        pub remedy: Remedy = Remedy::Sparse,
    }
}

/// What makes the filter as wide as the quad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Nothing: 8×8 texels, however many the quad covers.
    Dense,
    /// Comparisons that lie farther apart.
    Sparse,
    /// Smaller levels of the map, which hold mean depths.
    Levels,
}

/// Share of the way from pixel to pixel that lies between two comparisons: 8×8 texels are as wide as the quad.
const SHARE: f32 = 0.25;

/// Light that comes to all pixels of a quad, 0 to 1: 8×8 texels around its mean place, 2×2 at a time, four reads a lane.
///
/// `coord` is interpolated: a place in the shadow map, 0 to 1, and the depth to compare. `shadow` is the map and compares between
/// 2×2 texels; `levels` is the map again, with smaller levels, and is read by `remedy=levels` alone, which takes one depth of each
/// 2×2 texels: `nearest` filters nothing.
///
/// The light is a number from 0 to 1 whatever `coord` is: a lane whose coordinates are not finite, or 1e4 and more, does not count.
pub fn minified(
    cfg: &Minified,
    shadow: &DepthTexture,
    shadow_sampler: &ComparisonSampler,
    levels: &Texture<f32>,
    nearest: &Sampler,
    coord: Quad<Vec3>,
) -> Quad<Vec4> {
    let centre = mean(coord);
    // A lane without a place of its own lies in the middle.
    let coord = counts(coord).select(coord, centre);
    let mut lit = Quad::splat(0.0);
    match cfg.remedy {
        Remedy::Levels => {
            let size = levels.size().as_vec2();
            let level = spread(coord, size).log2().round_ties_even();
            let texel = level.exp2();
            for k in 0..4 {
                let place = (quad_vector() + corner(k) + 0.5) * texel;
                let depth = levels.sample_level(nearest, centre.truncate() + place / size, level);
                lit += centre.z().le(depth).select(Quad::splat(1.0), Quad::splat(0.0));
            }
        }
        _ => {
            let size = shadow.size().as_vec2();
            let texel = match cfg.remedy {
                Remedy::Sparse => spread(coord, size),
                _ => Quad::splat(1.0),
            };
            let fraction = fract(centre.truncate() * size - 0.5);
            for k in 0..4 {
                let place = (quad_vector() + corner(k) + 0.5 - fraction) * texel;
                lit += shadow.compare(shadow_sampler, centre.truncate() + place / size, centre.z());
            }
        }
    }
    Vec4::ONE * (lit.average() * 0.25)
}

/// Where comparison `k` of a lane lies from where one alone would, in texels.
fn corner(k: usize) -> Vec2 {
    vec2((4 * (k % 2)) as f32 - 2.0, (4 * (k / 2)) as f32 - 2.0)
}

/// Texels from comparison to comparison, for those of a quad to cover it: at least one. Its lanes agree on it.
fn spread(coord: Quad<Vec3>, size: Vec2) -> Quad<f32> {
    let place = coord.truncate() * size;
    let step = (place - place.swap_horizontal())
        .abs()
        .max((place - place.swap_vertical()).abs());
    let own = step.max_element();
    // Each lane knows two sides of the quad, and the lane across the other two.
    (own.max(own.swap_diagonal()) * SHARE).max(1.0)
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
