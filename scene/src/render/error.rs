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
    #[error("a picture of {}x{} pixels cannot be drawn: each side must be 1 to {most} pixels", size.x, size.y)]
    Size {
        /// Width and height in pixels.
        size: UVec2,
        /// Longest side in pixels.
        most: u32,
    },
    /// More data than the device takes.
    #[error("{needed} bytes are needed where this device takes {most} in its {what}: choose a smaller {smaller}")]
    Limit {
        /// Kind of memory.
        what: &'static str,
        /// Bytes that the device takes.
        most: u64,
        /// Bytes that are needed.
        needed: u64,
        /// Part of the input to make smaller.
        smaller: &'static str,
    },
    /// An offset that is not a place.
    #[error("a sample cannot be at ({}, {}): both must be finite numbers of pixels", offset.x, offset.y)]
    Offset {
        /// The offset from the pixel's centre.
        offset: Vec2,
    },
    /// Nothing to sample.
    #[error("no sample offsets were given: at least one is needed")]
    NoOffsets,
    /// A shading sample that is not one of the geometry samples.
    #[error("shading is to be at sample {sample}, and there are {samples}, counted from 0")]
    ShadingSample {
        /// The index of the sample.
        sample: usize,
        /// Number of samples.
        samples: usize,
    },
    /// Samples of which it is not known where they lie on a surface's plane.
    #[error(
        "shading is placed by planes where a pattern that has a name is sampled, as latin4, and not at these {samples} places: place it by \
         depths"
    )]
    Unnamed {
        /// Number of samples.
        samples: usize,
    },
    /// A picture of which no pixel can be shaded once more.
    #[error(
        "further shading samples are of pictures with normals and a camera, shaded at the first sample, the pixel's centre or where they \
         are placed, and sampled at a pattern that has a name"
    )]
    Extra,
    /// The device has too little memory, does not do what it was asked, or is gone.
    #[error("the GPU failed while {doing}: {description}")]
    Device {
        /// Operation that failed.
        doing: &'static str,
        /// The device's message.
        description: String,
    },
}
