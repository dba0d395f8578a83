//! The edge filters that deferred renderers used before SRAA: they find edges in depth and normals of one sample a
//! pixel, and blur there.
//!
//! Both are transcribed from a blog's code snippets, which retell S.T.A.L.K.E.R.'s (Shishkovtsov, GPU Gems 2, chapter
//! 9) and Tabula Rasa's (Koonce, GPU Gems 3, chapter 19). The snippets contain mistakes; [`Form::Paper`] keeps those
//! that change what is found, so that what they cost can be measured. A pixel is read at its centre: the half pixel
//! by which Direct3D 9 has to shift a full-screen rectangle has no counterpart here.

mod stalker;
mod tabula_rasa;

use crate::normals::{folded, unit};
use crate::prelude::*;

pub use stalker::{Depth, Stalker, stalker};
pub use tabula_rasa::{TabulaRasa, tabula_rasa};

/// Whether the mistakes of the printed code are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// As printed.
    Paper,
    /// With the mistakes mended.
    Corrected,
}

/// How the G-buffer holds normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normals {
    /// As unit vectors, in a float format.
    Float,
    /// As 0.5 + 0.5 n, in a normalised format such as the snippets' RGBA8; made as long as 1.
    Unorm,
    /// Unfolded to a square, each axis as 0.5 + 0.5 n, in a normalised format of two components such as RG8 or RG16.
    Octahedral,
}

/// What a colour that is infinite or not a number does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NonFinite {
    /// It spoils every pixel that is blurred with it.
    Spread,
    /// The pixel's own colour stands in for a tap that is touched by it, and black for a pixel whose own colour is bad.
    Skip,
}

/// What a filter gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// The picture, blurred where there are edges.
    Antialias,
    /// How much of an edge each pixel is, 0 to 1, in red, green and blue: no colour is read.
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

/// The colour of `pixel`; black if it is not finite and that is not to spread.
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
/// bad: nothing can be told of the others, and `own` is what is left.
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

/// `depth`, at most [`DEEPEST`]; what is infinite or not a number is as deep.
fn bounded(depth: f32) -> f32 {
    if depth.abs() < DEEPEST { depth } else { DEEPEST }
}

/// More than any depth, and finite: the sky's infinite depth less itself is not a number.
const DEEPEST: f32 = 1.0e30;
