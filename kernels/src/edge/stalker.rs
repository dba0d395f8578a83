//! The edge filter of S.T.A.L.K.E.R.

use super::{Form, NonFinite, Normals, Output, bounded, facing, nearby, own};
use crate::prelude::*;

options! {
    /// What the S.T.A.L.K.E.R. filter is made of.
    pub struct Stalker {
        /// Whether the mistakes of the printed code are kept.
        pub form: Form = Form::Corrected,
        /// What comes out.
        pub output: Output = Output::Antialias,
        /// How depth is stored.
        pub depth: Depth = Depth::Projected,
        /// How normals are stored.
        pub normals: Normals = Normals::Float,
        /// What a colour that is infinite or not a number does.
        pub non_finite: NonFinite = NonFinite::Skip,
        /// Cosine of the angle between two normals from which they are alike (`e_barrier.x`).
        pub normal_barrier: f32 [-1.0..=1.0] = uniform(0.8),
        /// Second difference of depth up to which a surface is flat (`e_barrier.y`), in the unit that depth is compared in.
        pub depth_barrier: f32 [0.0..=1.0e6] = uniform(1.0e-5),
        /// How much a diagonal neighbour with a like normal speaks against an edge (`e_weights.x`); at 1 all four together
        /// rule it out. In the printed form each of them does.
        pub normal_weight: f32 [0.0..=4.0] = 1.0,
        /// How much a direction in which depth is flat speaks against an edge (`e_weights.y`), likewise.
        pub depth_weight: f32 [0.0..=4.0] = 1.0,
        /// How far the blur reaches on an edge (`e_kernel`), in half pixels: 1 weighs 3×3 pixels by (1,2,1)²/16. In the
        /// printed form in pixels: 1 takes the four diagonal neighbours and leaves out the pixel itself.
        pub kernel: f32 [0.0..=4.0] = uniform(1.0),
    }
}

/// How depth is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// As z/w after projection, reversed or not: it grows evenly across a plane on the screen.
    Projected,
    /// Along the view direction: its reciprocal, which grows evenly, is compared.
    Linear,
}

/// `offs` 1 to 4: upper left, lower right, upper right, lower left.
const DIAGONALS: [IVec2; 4] = [ivec2(-1, -1), ivec2(1, 1), ivec2(1, -1), ivec2(-1, 1)];

/// `offs` 1, 3, 5 and 6: one of each pair of opposite neighbours.
const AXES: [IVec2; 4] = [ivec2(-1, -1), ivec2(1, -1), ivec2(-1, 0), ivec2(0, -1)];

/// `color` blurred where normals turn or depth bends, or how much it is an edge.
///
/// Normals are in any one space. Nothing of the picture is read to find edges.
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
            // s0 to s3: the neighbours at distance w. Both axes by their own texel size.
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

/// `ne`: how much normals speak against an edge, by the share of diagonal neighbours whose normal is like the pixel's.
fn alike_normals(cfg: &Stalker, normal: &Frame<Vec3>, pixel: IVec2) -> f32 {
    let centre = facing(cfg.normals, normal, pixel);
    let mut alike = 0.0;
    for offset in DIAGONALS {
        let cosine = centre.dot(facing(cfg.normals, normal, pixel + offset));
        // nd = abs(dot(...)): printed, opposite normals are alike.
        let cosine = match cfg.form {
            Form::Paper => cosine.abs(),
            Form::Corrected => cosine,
        };
        // Whatever is not a number is alike to nothing.
        alike += if cosine - cfg.normal_barrier >= 0.0 { 1.0 } else { 0.0 };
    }
    saturate(alike * share(cfg, cfg.normal_weight))
}

/// `de`: how much depth speaks against an edge, by the share of directions in which depth does not bend.
fn flat_depths(cfg: &Stalker, depth: &Frame<f32>, pixel: IVec2) -> f32 {
    let centre = evenly(cfg, depth.load(pixel));
    let mut flat = 0.0;
    for offset in AXES {
        // dd = the sum of two opposite neighbours; abs(2 * dc - dd) - e_barrier.y; step(dd, 0). What is not a number bends.
        let sum = evenly(cfg, depth.load(pixel + offset)) + evenly(cfg, depth.load(pixel - offset));
        let bend = (2.0 * centre - sum).abs() - cfg.depth_barrier;
        flat += if bend <= 0.0 { 1.0 } else { 0.0 };
    }
    saturate(flat * share(cfg, cfg.depth_weight))
}

/// What one of four counts with this weight. As printed, with `e_weights` of 1, one direction without an edge hides those of all
/// others; of ¼ each the sum is a share.
fn share(cfg: &Stalker, weight: f32) -> f32 {
    match cfg.form {
        Form::Paper => weight,
        Form::Corrected => 0.25 * weight,
    }
}

/// The least depth whose reciprocal is a number.
const NEAREST: f32 = 1.0e-30;

/// Depth in a form that grows evenly across a plane on the screen.
fn evenly(cfg: &Stalker, depth: f32) -> f32 {
    match cfg.depth {
        Depth::Projected => depth,
        Depth::Linear => 1.0 / bounded(depth).max(NEAREST),
    }
}
