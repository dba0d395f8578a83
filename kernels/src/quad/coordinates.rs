//! Coordinates in a shadow map, with the guards of quad filters.

use crate::prelude::*;

/// Coordinates of this size and above are treated as non-finite.
const FARTHEST: f32 = 1.0e20;

/// Weight of an excluded lane in a quad's mean, 2⁻¹⁰⁰: negligible beside 1, but the mean of excluded lanes is still defined.
const NO_SHARE: f32 = 7.888_609e-31;

/// Guarded coordinates of each lane, and its weight in the quad's mean.
pub(super) struct Counted {
    /// Finite, and clamped to the filter's reach around the map. Clamping changes no texel of the filter.
    pub(super) coord: Quad<Vec3>,
    /// 1, or [`NO_SHARE`] for an excluded lane.
    share: Quad<f32>,
}

/// Guards the coordinates of a filter that reaches `reach` texels from its position.
///
/// All three coordinates become 0 if one is NaN, or is 1e20 or more. Those for which the filter reads only the map's border
/// are clamped to where it still does. Neither moves the quad's mean position, unless no lane has better coordinates.
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

/// Mean coordinates of the lanes that are not excluded, the same in every lane; of all lanes if all are excluded.
pub(super) fn mean(counted: &Counted) -> Quad<Vec3> {
    let sums = (counted.coord * counted.share).extend(counted.share).sum();
    sums.truncate() / sums.w()
}
