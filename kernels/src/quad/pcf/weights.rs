//! Weights of a shadow map's texels by distance.

use crate::prelude::*;

/// Weights of texels by their distance on each axis. All but the box end at zero, so that no texel enters abruptly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowWeights {
    /// All equal.
    Box,
    /// 1 up to half the distance, then linear to 0.
    LinearStep,
    /// 1 up to a quarter of the distance, then cubic to 0.
    SmoothStep,
    /// A Gaussian whose sigma is half the distance, minus its value at the end.
    Gaussian,
    /// A linear B-spline: a tent.
    Linear,
    /// A quadratic B-spline.
    Quadratic,
    /// A cubic B-spline.
    Cubic,
    /// From a table ([`table`](super::table)), for any filter. `method=quad` and `method=bilinear` only.
    Lookup,
}

/// exp(-2): a Gaussian at two sigma.
const AT_TWO_SIGMA: f32 = 0.135_335_28;

/// Weights on each axis at `offset` texels from the middle of a filter that ends at `half`.
pub fn weigh(weights: ShadowWeights, half: f32, offset: Quad<Vec2>) -> Quad<Vec2> {
    let away = offset.abs();
    match weights {
        // A table has weights only for pairs of texels, and no method that uses them calls this.
        ShadowWeights::Box | ShadowWeights::Lookup => {
            // A texel at the very end counts half.
            saturate(half + 0.5 - away)
        }
        ShadowWeights::LinearStep => saturate((away - half) / (0.5 * half - half)),
        ShadowWeights::SmoothStep => smoothstep(half, 0.25 * half, away),
        ShadowWeights::Gaussian => {
            let z = away * (2.0 / half);
            (((z * z) * (-0.5 * std::f32::consts::LOG2_E)).exp2() - AT_TWO_SIGMA).max(Vec2::ZERO)
        }
        ShadowWeights::Linear => (1.0 - away / half).max(Vec2::ZERO),
        ShadowWeights::Quadratic => {
            let x = away * (1.5 / half);
            let (outer, inner) = ((1.5 - x).max(Vec2::ZERO), (0.5 - x).max(Vec2::ZERO));
            outer * outer * 0.5 - inner * inner * 1.5
        }
        ShadowWeights::Cubic => {
            let x = away * (2.0 / half);
            let (outer, inner) = ((2.0 - x).max(Vec2::ZERO), (1.0 - x).max(Vec2::ZERO));
            (outer * outer * outer - inner * inner * inner * 4.0) * (1.0 / 6.0)
        }
    }
}
