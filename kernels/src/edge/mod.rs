//! The edge filters that deferred renderers used before SRAA: they find edges in depth and normals of one sample a
//! pixel, and blur there.
//!
//! Both are transcribed from a blog's code snippets, which retell S.T.A.L.K.E.R.'s (Shishkovtsov, GPU Gems 2, chapter
//! 9) and Tabula Rasa's (Koonce, GPU Gems 3, chapter 19). The snippets contain mistakes; [`Form::Paper`] keeps those
//! that change what is found, so that what they cost can be measured. A pixel is read at its centre: the half pixel
//! by which Direct3D 9 has to shift a full-screen rectangle has no counterpart here.

mod stalker;
mod tabula_rasa;

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

/// What a filter gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// The picture, blurred where there are edges.
    Antialias,
    /// How much of an edge each pixel is, 0 to 1, in red, green and blue: no colour is read.
    Edges,
}

/// The colour `offset` pixels from the centre of `pixel`, filtered.
fn nearby(color: &Frame<Vec4>, linear: &Sampler, pixel: IVec2, offset: Vec2) -> Vec4 {
    let texel = Vec2::ONE / color.size().as_vec2();
    color.sample(linear, (pixel.as_vec2() + 0.5 + offset) * texel)
}

/// More than any depth, and finite: the sky's infinite depth less itself is not a number.
const DEEPEST: f32 = 1.0e30;
