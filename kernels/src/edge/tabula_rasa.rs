//! The edge filter of Tabula Rasa.

use super::{DEEPEST, Form, Output, nearby};
use crate::prelude::*;

options! {
    /// What the Tabula Rasa filter is made of.
    pub struct TabulaRasa {
        /// Whether the mistakes of the printed code are kept.
        pub form: Form = Form::Corrected,
        /// What comes out.
        pub output: Output = Output::Antialias,
        /// How many times steeper depth must become from one side of a pixel to the other (`depthSensibility`).
        pub depth_sensibility: f32 [0.0..=1.0e6] = uniform(25.0),
        /// How strongly normals count (`normalSensibility`): a change of 0.4 / this of the cosine is an edge.
        pub normal_sensibility: f32 [0.0..=1.0e3] = uniform(1.0),
        /// How far the blur reaches on an edge, in pixels (`weight`).
        pub weight: f32 [0.0..=4.0] = uniform(1.0),
    }
}

/// The least gradient of depth that counts, so that rounding on a plane is no edge. It goes with how depth is stored.
const LEAST_GRADIENT: f32 = 0.00001;

/// Change of the cosine between normals that is an edge.
const CHANGE: f32 = 0.4;

/// `offsets` 1 to 4 of `DL_GetEdgeWeight`: upper left, top, upper right, right. 5 to 8 lie opposite.
const HALF: [IVec2; 4] = [ivec2(-1, -1), ivec2(0, -1), ivec2(1, -1), ivec2(1, 0)];

/// `color` blurred where the gradient of depth or the normals change, or how much they do.
///
/// Depth may be stored in any way that is continuous on a surface; normals are unit vectors in any one space. The
/// snippet's two helpers read each other's texture; here depth is depth in either form.
pub fn tabula_rasa(
    cfg: &TabulaRasa,
    depth: &Frame<f32>,
    normal: &Frame<Vec3>,
    color: &Frame<Vec4>,
    linear: &Sampler,
    pixel: IVec2,
) -> Vec4 {
    let edge = edge_weight(cfg, depth, normal, pixel);
    match cfg.output {
        Output::Edges => vec4(edge, edge, edge, 1.0),
        Output::Antialias => {
            // The loop over `factor` before this one comes to nothing: what it adds up is overwritten.
            let reach = edge.min(1.0) * cfg.weight;
            let mut sum = 2.0 * color.load(pixel);
            for offset in HALF {
                sum += nearby(color, linear, pixel, offset.as_vec2() * reach);
                sum += nearby(color, linear, pixel, -offset.as_vec2() * reach);
            }
            sum * 0.1
        }
    }
}

/// `DL_GetEdgeWeight`: the share of the four directions in which there is an edge.
fn edge_weight(cfg: &TabulaRasa, depth: &Frame<f32>, normal: &Frame<Vec3>, pixel: IVec2) -> f32 {
    let here = depth.load(pixel).min(DEEPEST);
    let facing = normal.load(pixel);
    let mut edges = 0.0;
    for offset in HALF {
        // Gradients to both sides; an edge where the greater is many times the smaller.
        let before = (depth.load(pixel + offset).min(DEEPEST) - here).abs();
        let after = (depth.load(pixel - offset).min(DEEPEST) - here).abs();
        let least = before.min(after).max(LEAST_GRADIENT);
        let by_depth = step(least * cfg.depth_sensibility, before.max(after));

        let before = normal.load(pixel + offset).dot(facing);
        let after = normal.load(pixel - offset).dot(facing);
        let change = match cfg.form {
            // On a ridge of one pixel both cosines are equal, and their difference finds nothing.
            Form::Paper => (before - after).abs(),
            // For unit vectors never less than that: 1 - min >= max - min.
            Form::Corrected => 1.0 - before.min(after),
        };
        let by_normal = step(CHANGE, change * cfg.normal_sensibility);
        edges += by_depth.max(by_normal);
    }
    edges * 0.25
}
