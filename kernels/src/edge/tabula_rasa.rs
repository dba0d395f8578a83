//! The edge filter of Tabula Rasa.

use super::{Form, NonFinite, Normals, Output, bounded, facing, nearby, own};
use crate::prelude::*;

options! {
    /// What the Tabula Rasa filter is made of.
    pub struct TabulaRasa {
        /// Whether the mistakes of the printed code are kept.
        pub form: Form = Form::Corrected,
        /// What comes out.
        pub output: Output = Output::Antialias,
        /// How normals are stored.
        pub normals: Normals = Normals::Float,
        /// What a colour that is infinite or not a number does.
        pub non_finite: NonFinite = NonFinite::Skip,
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
/// Depth may be stored in any way that is continuous on a surface; normals are in any one space. The
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
            let own = own(cfg.non_finite, color, pixel);
            let mut sum = 2.0 * own;
            for offset in HALF {
                let offset = offset.as_vec2() * reach;
                sum += nearby(cfg.non_finite, color, linear, pixel, offset, own);
                sum += nearby(cfg.non_finite, color, linear, pixel, -offset, own);
            }
            sum * 0.1
        }
    }
}

/// `DL_GetEdgeWeight`: the share of the four directions in which there is an edge.
fn edge_weight(cfg: &TabulaRasa, depth: &Frame<f32>, normal: &Frame<Vec3>, pixel: IVec2) -> f32 {
    let here = bounded(depth.load(pixel));
    let own = facing(cfg.normals, normal, pixel);
    let mut edges = 0.0;
    for offset in HALF {
        // Gradients to both sides; an edge where the greater is many times the smaller.
        let before = (bounded(depth.load(pixel + offset)) - here).abs();
        let after = (bounded(depth.load(pixel - offset)) - here).abs();
        let least = before.min(after).max(LEAST_GRADIENT);
        let by_depth = step(least * cfg.depth_sensibility, before.max(after));

        let before = facing(cfg.normals, normal, pixel + offset).dot(own);
        let after = facing(cfg.normals, normal, pixel - offset).dot(own);
        let by_normal = match cfg.form {
            // On a ridge of one pixel both cosines are equal, and their difference finds nothing.
            Form::Paper => step(CHANGE, (before - after).abs() * cfg.normal_sensibility),
            // For unit vectors never less than that: 1 - min >= max - min. A cosine that is not a number is an edge.
            Form::Corrected => turned(cfg, before).max(turned(cfg, after)),
        };
        edges += by_depth.max(by_normal);
    }
    edges * 0.25
}

/// 0 if a neighbour with this cosine between normals is on the same surface, else 1.
fn turned(cfg: &TabulaRasa, cosine: f32) -> f32 {
    if (1.0 - cosine) * cfg.normal_sensibility < CHANGE {
        0.0
    } else {
        1.0
    }
}
