//! Why nothing was drawn.

use crate::scene::SceneError;
use glam::{UVec2, Vec2};

/// Why nothing was drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The scene has nothing to draw, or something that cannot be drawn.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// No picture of this size.
    #[error("a picture of {}×{} pixels cannot be drawn: {limit}", size.x, size.y)]
    Size {
        /// Width and height in pixels.
        size: UVec2,
        /// What would do.
        limit: String,
    },
    /// A scene of more data than the device takes.
    #[error("the scene has {bytes} bytes of {what}, and this device takes {limit}: choose a smaller model or the CPU")]
    Scale {
        /// Vertices or triangles.
        what: &'static str,
        /// How many bytes they take.
        bytes: u64,
        /// How many the device takes.
        limit: u64,
    },
    /// An offset that is not a place.
    #[error("a sample cannot be at ({}, {}): both must be finite numbers of pixels", offset.x, offset.y)]
    Offset {
        /// The offset from the pixel's centre.
        offset: Vec2,
    },
    /// Nothing to take the mean of.
    #[error("no sample offsets were given: at least one is needed")]
    NoOffsets,
    /// A shading sample that is not one of the geometry samples.
    #[error("shading is to be at sample {sample}, and there are {samples}, counted from 0")]
    ShadingSample {
        /// The index of the sample.
        sample: usize,
        /// How many samples there are.
        samples: usize,
    },
    /// A reference of no or of too many samples.
    #[error("a reference cannot have {side} samples along a pixel's side: choose 1 to {}", super::MAX_SIDE)]
    Side {
        /// Samples along one side.
        side: u32,
    },
    /// The device has too little memory.
    #[error("the GPU has too little memory to {doing} ({problem}): choose a smaller picture or the CPU")]
    OutOfMemory {
        /// What it was for.
        doing: &'static str,
        /// What the device said.
        problem: String,
    },
    /// The device does not do what it was asked, or is gone.
    #[error("the GPU could not {doing}: {problem}")]
    Gpu {
        /// What it should do.
        doing: &'static str,
        /// What the device said.
        problem: String,
    },
}
