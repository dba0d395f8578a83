//! The edge filter of Tabula Rasa.

use super::{Form, NonFinite, Normals, Output, bounded, facing, nearby, own};
use crate::prelude::*;

options! {
    /// Options of the Tabula Rasa filter.
    pub struct TabulaRasa {
        /// Treatment of the mistakes in the printed code.
        pub form: Form = Form::Corrected,
        /// Output of the filter.
        pub output: Output = Output::Antialias,
        /// Encoding of normals.
        pub normals: Normals = Normals::Float,
        /// Treatment of colours that are infinite or NaN.
        pub non_finite: NonFinite = NonFinite::Skip,
        /// Factor by which depth must steepen from one side of a pixel to the other to be an edge (`depthSensibility`).
        pub depth_sensibility: f32 [0.0..=1.0e6] = uniform(25.0),
        /// Sensitivity to normals (`normalSensibility`): a change of the cosine by 0.4 / this is an edge.
        pub normal_sensibility: f32 [0.0..=1.0e3] = uniform(1.0),
        /// Reach of the blur on an edge, in pixels (`weight`).
        pub weight: f32 [0.0..=4.0] = uniform(1.0),
    }
}

/// Smallest depth gradient that counts, so that rounding on a plane is not an edge. It depends on the encoding of depth.
const LEAST_GRADIENT: f32 = 0.00001;

/// Change of the cosine between normals above which there is an edge.
const CHANGE: f32 = 0.4;

/// `offsets` 1 to 4 of `DL_GetEdgeWeight`: upper left, top, upper right, right. Offsets 5 to 8 are their opposites.
const HALF: [IVec2; 4] = [ivec2(-1, -1), ivec2(0, -1), ivec2(1, -1), ivec2(1, 0)];

/// Blurs `color` where the depth gradient or the normals change, or returns the edge strength.
///
/// Depth may be stored in any way that is continuous on a surface. Normals are in any one space. The
/// snippet's two helpers read each other's texture; here `depth` is depth in either form.
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
            // The snippet's loop over `factor` before this one has no effect: its sum is overwritten.
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

/// `DL_GetEdgeWeight`: share of the four directions in which there is an edge.
fn edge_weight(cfg: &TabulaRasa, depth: &Frame<f32>, normal: &Frame<Vec3>, pixel: IVec2) -> f32 {
    let here = bounded(depth.load(pixel));
    let own = facing(cfg.normals, normal, pixel);
    let mut edges = 0.0;
    for offset in HALF {
        // Gradients to both sides. There is an edge if the larger is many times the smaller.
        let before = (bounded(depth.load(pixel + offset)) - here).abs();
        let after = (bounded(depth.load(pixel - offset)) - here).abs();
        let least = before.min(after).max(LEAST_GRADIENT);
        let by_depth = step(least * cfg.depth_sensibility, before.max(after));

        let before = facing(cfg.normals, normal, pixel + offset).dot(own);
        let after = facing(cfg.normals, normal, pixel - offset).dot(own);
        let by_normal = match cfg.form {
            // On a one-pixel ridge both cosines are equal, and their difference finds no edge.
            Form::Paper => step(CHANGE, (before - after).abs() * cfg.normal_sensibility),
            // For unit vectors never smaller than the printed value: 1 - min >= max - min. A NaN cosine is an edge.
            Form::Corrected => turned(cfg, before).max(turned(cfg, after)),
        };
        edges += by_depth.max(by_normal);
    }
    edges * 0.25
}

/// Returns 0 if a neighbour with this cosine between normals is on the same surface, else 1.
fn turned(cfg: &TabulaRasa, cosine: f32) -> f32 {
    if (1.0 - cosine) * cfg.normal_sensibility < CHANGE {
        0.0
    } else {
        1.0
    }
}
