//! The edge filters that deferred renderers used before SRAA. They find edges in the depth and normals of one sample a
//! pixel, and blur there.
//!
//! Both are transcribed from a blog's code snippets, which retell S.T.A.L.K.E.R.'s (Shishkovtsov, GPU Gems 2, chapter
//! 9) and Tabula Rasa's (Koonce, GPU Gems 3, chapter 19). The snippets contain mistakes. [`Form::Paper`] keeps those
//! that change which edges are found, so that their cost can be measured. A pixel is read at its centre: the half-pixel
//! shift that Direct3D 9 needs for a full-screen rectangle has no counterpart here.

mod stalker;
mod tabula_rasa;

use crate::normals::{folded, unit};
use crate::prelude::*;

pub use stalker::{Depth, Stalker, stalker};
pub use tabula_rasa::{TabulaRasa, tabula_rasa};

/// Treatment of the mistakes in the printed code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// As printed.
    Paper,
    /// With the mistakes corrected.
    Corrected,
}

/// Encoding of normals in the G-buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normals {
    /// As unit vectors, in a float format.
    Float,
    /// As 0.5 + 0.5 n, in a normalised format such as the snippets' RGBA8. Rescaled to length 1 after reading.
    Unorm,
    /// Octahedral map to a square, each axis as 0.5 + 0.5 n, in a normalised two-component format such as RG8 or RG16.
    Octahedral,
}

/// Treatment of colours that are infinite or NaN.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NonFinite {
    /// Spread to every pixel that is blurred with them.
    Spread,
    /// Skipped: the pixel's own colour replaces an affected tap, and black replaces the pixel's own colour if that is bad.
    Skip,
}

/// Output of the filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// The picture, blurred where there are edges.
    Antialias,
    /// Edge strength of each pixel, 0 to 1, in red, green and blue. No colour is read.
    Edges,
}

/// The unit normal at `pixel`.
fn facing(normals: Normals, normal: &Frame<Vec3>, pixel: IVec2) -> Vec3 {
    let stored = normal.load(pixel);
    match normals {
        Normals::Float => stored,
        Normals::Unorm => unit(2.0 * stored - 1.0),
        Normals::Octahedral => folded(2.0 * stored.xy() - 1.0),
    }
}

/// The colour of `pixel`; black if it is not finite and `non_finite` is `Skip`.
fn own(non_finite: NonFinite, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let own = color.load(pixel);
    match non_finite {
        NonFinite::Spread => own,
        NonFinite::Skip => {
            if own.is_finite() {
                own
            } else {
                Vec4::ZERO
            }
        }
    }
}

/// The colour `offset` pixels from the centre of `pixel`, filtered. A sampler reads four texels, and 0 times a bad one is
/// bad: the other three cannot be recovered, and `own` is returned instead.
fn nearby(non_finite: NonFinite, color: &Frame<Vec4>, linear: &Sampler, pixel: IVec2, offset: Vec2, own: Vec4) -> Vec4 {
    let texel_size = Vec2::ONE / color.size().as_vec2();
    let tap = color.sample(linear, (pixel.as_vec2() + 0.5 + offset) * texel_size);
    match non_finite {
        NonFinite::Spread => tap,
        NonFinite::Skip => {
            if tap.is_finite() {
                tap
            } else {
                own
            }
        }
    }
}

/// `depth`, clamped to at most [`DEEPEST`]; infinite and NaN depths become [`DEEPEST`].
fn bounded(depth: f32) -> f32 {
    if depth.abs() < DEEPEST { depth } else { DEEPEST }
}

/// Larger than any depth, and finite: subtracting the sky's infinite depth from itself would be NaN.
const DEEPEST: f32 = 1.0e30;
