//! Cascades of a sun's shadow, side by side in one map, filtered by pixel quads (Penner 2011, §2.9).

use straightline_kernels::prelude::*;

/// Cascades in the map, from left to right; each covers twice as much across and down as the one before.
const CASCADES: usize = 3;

/// Texels from the middle of a filter to where it ends, and one to spare for the sampler's own filter.
const REACH: f32 = 5.0;

/// Light that comes to all pixels of a quad, 0 to 1: 8×8 texels around its mean place, 2×2 at a time, four reads a lane, of the
/// finest cascade that has them all.
///
/// `coord` is interpolated: the place beside the viewer as the sun sees it, the first cascade from -1 to 1 on both axes, and the depth
/// to compare, the same in all cascades. Farther out than the last cascade lies its border.
///
/// The light is a number from 0 to 1 whatever `coord` is: a lane whose coordinates are not finite, or 1e4 and more, does not count.
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
    // No comparison reaches into the cascade beside.
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
