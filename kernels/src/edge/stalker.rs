//! The edge filter of S.T.A.L.K.E.R.

use super::{Form, NonFinite, Normals, Output, bounded, facing, nearby, own};
use crate::prelude::*;

options! {
    /// Options of the S.T.A.L.K.E.R. filter.
    pub struct Stalker {
        /// Treatment of the mistakes in the printed code.
        pub form: Form = Form::Corrected,
        /// Output of the filter.
        pub output: Output = Output::Antialias,
        /// Encoding of depth.
        pub depth: Depth = Depth::Projected,
        /// Encoding of normals.
        pub normals: Normals = Normals::Float,
        /// Treatment of colours that are infinite or NaN.
        pub non_finite: NonFinite = NonFinite::Skip,
        /// Cosine of the angle between two normals above which they count as alike (`e_barrier.x`).
        pub normal_barrier: f32 [-1.0..=1.0] = uniform(0.8),
        /// Second difference of depth up to which a surface is flat (`e_barrier.y`), in the unit in which depth is compared.
        pub depth_barrier: f32 [0.0..=1.0e6] = uniform(1.0e-5),
        /// Weight of a diagonal neighbour with a similar normal against an edge (`e_weights.x`). At 1, all four together
        /// rule an edge out. In the printed form, any one of them does.
        pub normal_weight: f32 [0.0..=4.0] = 1.0,
        /// Weight of a direction in which depth is flat against an edge (`e_weights.y`), likewise.
        pub depth_weight: f32 [0.0..=4.0] = 1.0,
        /// Reach of the blur on an edge (`e_kernel`), in half pixels: 1 weights 3×3 pixels by (1,2,1)²/16. In the
        /// printed form, in pixels: 1 takes the four diagonal neighbours and omits the pixel itself.
        pub kernel: f32 [0.0..=4.0] = uniform(1.0),
    }
}

/// Encoding of depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// As z/w after projection, reversed or not. It varies linearly across a plane on the screen.
    Projected,
    /// Along the view direction. The filter compares its reciprocal, which varies linearly across a plane.
    Linear,
}

/// `offs` 1 to 4: upper left, lower right, upper right, lower left.
const DIAGONALS: [IVec2; 4] = [ivec2(-1, -1), ivec2(1, 1), ivec2(1, -1), ivec2(-1, 1)];

/// `offs` 1, 3, 5 and 6: one of each pair of opposite neighbours.
const AXES: [IVec2; 4] = [ivec2(-1, -1), ivec2(1, -1), ivec2(-1, 0), ivec2(0, -1)];

/// Blurs `color` where normals turn or depth bends, or returns the edge strength.
///
/// Normals are in any one space. The picture is not read to find edges.
pub fn stalker(
    cfg: &Stalker,
    depth: &Frame<f32>,
    normal: &Frame<Vec3>,
    color: &Frame<Vec4>,
    linear: &Sampler,
    pixel: IVec2,
) -> Vec4 {
    // w = (1 - de * ne) * e_kernel.x
    let alike = alike_normals(cfg, normal, pixel) * flat_depths(cfg, depth, pixel);
    let edge = 1.0 - alike;
    match cfg.output {
        Output::Edges => vec4(edge, edge, edge, 1.0),
        Output::Antialias => {
            // s0 to s3: the neighbours at distance w. Each axis uses its own texel size.
            let own = match cfg.non_finite {
                NonFinite::Spread => Vec4::ZERO,
                NonFinite::Skip => own(cfg.non_finite, color, pixel),
            };
            let reach = match cfg.form {
                Form::Paper => edge * cfg.kernel,
                Form::Corrected => edge * (0.5 * cfg.kernel),
            };
            let mut sum = Vec4::ZERO;
            for offset in DIAGONALS {
                let offset = offset.as_vec2() * reach;
                sum += nearby(cfg.non_finite, color, linear, pixel, offset, own);
            }
            sum * 0.25
        }
    }
}

/// `ne`: evidence of the normals against an edge, the share of diagonal neighbours whose normal is like the pixel's.
fn alike_normals(cfg: &Stalker, normal: &Frame<Vec3>, pixel: IVec2) -> f32 {
    let centre = facing(cfg.normals, normal, pixel);
    let mut alike = 0.0;
    for offset in DIAGONALS {
        let cosine = centre.dot(facing(cfg.normals, normal, pixel + offset));
        // nd = abs(dot(...)): as printed, opposite normals count as alike.
        let cosine = match cfg.form {
            Form::Paper => cosine.abs(),
            Form::Corrected => cosine,
        };
        // A NaN is similar to nothing.
        alike += if cosine - cfg.normal_barrier >= 0.0 { 1.0 } else { 0.0 };
    }
    saturate(alike * share(cfg, cfg.normal_weight))
}

/// `de`: evidence of depth against an edge, the share of directions in which depth does not bend.
fn flat_depths(cfg: &Stalker, depth: &Frame<f32>, pixel: IVec2) -> f32 {
    let centre = evenly(cfg, depth.load(pixel));
    let mut flat = 0.0;
    for offset in AXES {
        // dd = the sum of two opposite neighbours; abs(2 * dc - dd) - e_barrier.y; step(dd, 0). A NaN counts as a bend.
        let sum = evenly(cfg, depth.load(pixel + offset)) + evenly(cfg, depth.load(pixel - offset));
        let bend = (2.0 * centre - sum).abs() - cfg.depth_barrier;
        flat += if bend <= 0.0 { 1.0 } else { 0.0 };
    }
    saturate(flat * share(cfg, cfg.depth_weight))
}

/// Contribution of one of the four neighbours or directions. As printed, with `e_weights` of 1, one direction without an edge
/// hides the edges in all others. With ¼ each, the sum is a share.
fn share(cfg: &Stalker, weight: f32) -> f32 {
    match cfg.form {
        Form::Paper => weight,
        Form::Corrected => 0.25 * weight,
    }
}

/// Smallest depth with a finite reciprocal.
const NEAREST: f32 = 1.0e-30;

/// Depth in a form that varies linearly across a plane on the screen.
fn evenly(cfg: &Stalker, depth: f32) -> f32 {
    match cfg.depth {
        Depth::Projected => depth,
        Depth::Linear => 1.0 / bounded(depth).max(NEAREST),
    }
}
