//! What tells two surfaces apart (paper §3.2).

use super::Sraa;
use crate::prelude::*;

/// What tells two surfaces apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// The larger of the differences in depth and in normal.
    DepthNormals,
    /// The difference in depth alone: no normals are read.
    Depth,
}

/// Geometry at every sample: layer `s` is sample `s` of the pattern, and with shading at the pixel centre the
/// last layer is the geometry there.
pub struct GBuffer {
    /// Linear depth along the view direction, in scene units.
    pub depth: FrameLayers<f32>,
    /// Unit normals.
    pub normal: FrameLayers<Vec3>,
}

/// The surface seen at one geometry sample.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Linear depth.
    pub depth: f32,
    /// Unit normal.
    pub normal: Vec3,
}

impl GBuffer {
    /// The surface seen at `sample` of `pixel`.
    pub fn surface(&self, pixel: IVec2, sample: usize) -> Surface {
        Surface {
            depth: self.depth.load(pixel, sample).min(DEEPEST),
            normal: self.normal.load(pixel, sample),
        }
    }
}

/// Differences from here on are alike: nothing that a weight could tell apart, whatever tau. The bound keeps a
/// difference exact enough to be shifted by the smallest one: of two that are a million apart, f32 would lose all that
/// the exponential needs.
pub(super) const FAR: f32 = 16.0;

/// More than any depth, and finite: the sky's infinite depth less itself is not a number.
const DEEPEST: f32 = 1.0e30;

/// How different two surfaces are: 0 for the same, 1 or more for unrelated ones.
pub(super) fn distance(cfg: &Sraa, a: &Surface, b: &Surface) -> f32 {
    let depths = cfg.depth_scale * (a.depth - b.depth).abs();
    let larger = match cfg.metric {
        Metric::DepthNormals => depths.max(normal_distance(a.normal, b.normal)),
        Metric::Depth => depths,
    };
    tally("weight_evaluations", larger.min(FAR))
}

/// 1 - a·b of two unit vectors, as ½|a - b|²: the same number without the cancellation.
fn normal_distance(a: Vec3, b: Vec3) -> f32 {
    let apart = a - b;
    0.5 * apart.dot(apart)
}
