//! Cascades of a sun shadow, side by side in one map, filtered by pixel quads (Penner 2011, §2.9).

use straightline_kernels::prelude::*;

/// Cascades in the map, from left to right. Each covers twice the width and height of the previous one.
const CASCADES: usize = 3;

/// Texels from the middle of the filter to its end, and one spare for the sampler's own filter.
const REACH: f32 = 5.0;

/// Light on all pixels of a quad, 0 to 1, from 8×8 texels around its mean position. They are compared 2×2 at a time, four reads
/// a lane, in the finest cascade that has them all.
///
/// `coord` is interpolated: the position relative to the viewer in the sun's view, the first cascade from -1 to 1 on both axes,
/// and the depth to compare, the same in all cascades. Beyond the last cascade its border is used.
///
/// The light is a number from 0 to 1 for every `coord`. A lane whose coordinates are not finite, or are 1e4 or more, is ignored.
pub fn cascades(shadow: &DepthTexture, shadow_sampler: &ComparisonSampler, coord: Quad<Vec3>) -> Quad<Vec4> {
    let size = shadow.size().as_vec2();
    let own = size / vec2(CASCADES as f32, 1.0);
    let centre = mean(coord);
    let farthest = centre.truncate().abs().max_element();
    let room = 1.0 - 2.0 * REACH / own.min_element();
    let mut half = Quad::splat((1 << (CASCADES - 1)) as f32);
    let mut first = Quad::splat(own.x * (CASCADES - 1) as f32);
    for k in (0..CASCADES - 1).rev() {
        let covers = (1 << k) as f32;
        let holds = farthest.le(covers * room);
        half = holds.select(Quad::splat(covers), half);
        first = holds.select(Quad::splat(own.x * k as f32), first);
    }
    let place = (centre.truncate() / half * 0.5 + 0.5) * own;
    // No comparison reaches into an adjacent cascade.
    let place = place.max(Vec2::splat(REACH)).min(own - REACH);
    let corner = (place - 0.5).floor() + 0.5;
    let mut lit = Quad::splat(0.0);
    for k in 0..4 {
        let away = vec2((4 * (k % 2)) as f32 - 2.0, (4 * (k / 2)) as f32 - 2.0);
        let at = corner + quad_vector() + away + 0.5;
        let at = Quad::from_xy(at.x() + first, at.y());
        lit += shadow.compare(shadow_sampler, at / size, centre.z());
    }
    Vec4::ONE * (lit.average() * 0.25)
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
