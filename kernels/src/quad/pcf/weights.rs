//! How texels of a shadow map are weighed by their distance.

use crate::prelude::*;

/// How texels are weighed by their distance on each axis. All but the box end at zero, so that no texel comes in at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShadowWeights {
    /// All alike.
    Box,
    /// 1 up to half of the way, then straight down.
    LinearStep,
    /// 1 up to a quarter of the way, then down in a cubic.
    SmoothStep,
    /// A Gaussian whose sigma is half of the way, less what it has at the end.
    Gaussian,
    /// A linear B-spline: a tent.
    Linear,
    /// A quadratic B-spline.
    Quadratic,
    /// A cubic B-spline.
    Cubic,
    /// As a table says ([`table`](super::table)), of any filter: of `quad` and `bilinear` alone.
    Lookup,
}

/// exp(-2): a Gaussian at two sigma.
const AT_TWO_SIGMA: f32 = 0.135_335_28;

/// The weights on each axis at `offset` texels from the middle of a filter that ends at `half`.
pub fn weigh(weights: ShadowWeights, half: f32, offset: Quad<Vec2>) -> Quad<Vec2> {
    let away = offset.abs();
    match weights {
        // Of a table pairs of texels alone have weights: no method that comes here takes it.
        ShadowWeights::Box | ShadowWeights::Lookup => {
            // Of a texel at the very end half counts.
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
