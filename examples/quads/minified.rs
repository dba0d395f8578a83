//! Minified shadow maps, where a quad's pixels are more texels apart than its filter is wide: filters that are as
//! wide as the quad (Penner 2011, §2.9).

use straightline_kernels::prelude::*;

options! {
    /// Options of the minified filter.
    pub struct Minified {
        /// Method of making the filter as wide as the quad.
        pub remedy: Remedy = Remedy::Sparse,
    }
}

/// Method of making the filter as wide as the quad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// None: 8×8 texels, however many the quad covers.
    Dense,
    /// Comparisons spread farther apart.
    Sparse,
    /// Smaller levels of the map, which hold mean depths.
    Levels,
}

/// Distance between two comparisons relative to that between pixels: 8×8 texels are then as wide as the quad.
const SHARE: f32 = 0.25;

/// Light on all pixels of a quad, 0 to 1, from 8×8 texels around its mean position, compared 2×2 at a time, four reads a lane.
///
/// `coord` is interpolated: a position in the shadow map, 0 to 1, and the depth to compare. `shadow` is the map, compared between
/// 2×2 texels. `levels` is the same map with smaller levels. It is read only with `remedy=levels`, which takes one depth of each
/// 2×2 texels with `nearest`, an unfiltered sampler.
///
/// The light is a number from 0 to 1 for every `coord`. A lane whose coordinates are not finite, or are 1e4 or more, is ignored.
pub fn minified(
    cfg: &Minified,
    shadow: &DepthTexture,
    shadow_sampler: &ComparisonSampler,
    levels: &Texture<f32>,
    nearest: &Sampler,
    coord: Quad<Vec3>,
) -> Quad<Vec4> {
    let centre = mean(coord);
    // A lane without valid coordinates uses the centre.
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

/// Offset of comparison `k` of a lane from that of a lane with only one comparison, in texels.
fn corner(k: usize) -> Vec2 {
    vec2((4 * (k % 2)) as f32 - 2.0, (4 * (k / 2)) as f32 - 2.0)
}

/// Texels between comparisons such that those of a quad cover it, at least one. Equal in all lanes.
fn spread(coord: Quad<Vec3>, size: Vec2) -> Quad<f32> {
    let place = coord.truncate() * size;
    let step = (place - place.swap_horizontal())
        .abs()
        .max((place - place.swap_vertical()).abs());
    let own = step.max_element();
    // Each lane knows two sides of the quad, and the diagonally opposite lane the other two.
    (own.max(own.swap_diagonal()) * SHARE).max(1.0)
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
