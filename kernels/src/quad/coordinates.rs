//! Coordinates in a shadow map, as filters of quads take them.

use crate::prelude::*;

/// Bound of coordinates that count as numbers.
const FARTHEST: f32 = 1.0e20;

/// Share that a lane which does not count has in a quad's mean, 2⁻¹⁰⁰: nothing beside 1, and as good as 1 among its like.
const NO_SHARE: f32 = 7.888_609e-31;

/// Coordinates of each lane, and its share in what the quad does together.
pub(super) struct Counted {
    /// Finite, and at most the filter's reach away from the map: no texel of the filter differs.
    pub(super) coord: Quad<Vec3>,
    /// 1, or hardly more than 0.
    share: Quad<f32>,
}

/// Coordinates as they count, of a filter that reaches `reach` texels from its place.
///
/// Coordinates of which one is not a number, or 1e20 and more, are 0. Those from which the filter reads the map's border alone are moved to
/// where it still does. Neither moves the quad's mean place, unless no lane has better ones.
pub(super) fn counted(shadow: &DepthTexture, coord: Quad<Vec3>, reach: f32) -> Counted {
    let numbers = coord.x().abs().lt(FARTHEST) & coord.y().abs().lt(FARTHEST) & coord.z().abs().lt(FARTHEST);
    let finite = numbers.select(coord, Quad::splat(Vec3::ZERO));
    let margin = reach / shadow.size().as_vec2();
    let place = finite.truncate().max(-margin).min(margin + 1.0);
    let near = finite.x().eq(place.x()) & finite.y().eq(place.y());
    Counted {
        coord: place.extend(finite.z()),
        share: (numbers & near).select(Quad::splat(1.0), Quad::splat(NO_SHARE)),
    }
}

/// Mean coordinates of the lanes that count, the same in every lane; of all lanes if none counts.
pub(super) fn mean(counted: &Counted) -> Quad<Vec3> {
    let sums = (counted.coord * counted.share).extend(counted.share).sum();
    sums.truncate() / sums.w()
}
