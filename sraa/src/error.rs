//! Errors.

use straightline_runtime as runtime;

/// A reason why SRAA cannot be set up.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A side of the picture is 0, or larger than the device's textures.
    #[error("a picture of {width}x{height} pixels: each side must be 1 to {limit}")]
    Size {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Largest side of a texture on the device.
        limit: u32,
    },
    /// A matrix that projects nothing.
    #[error("the projection matrix {0}")]
    Projection(&'static str),
    /// The crate was built without shaders for this.
    #[error("{what} needs the feature `{feature}` of straightline-sraa")]
    Feature {
        /// Setting that needs the feature.
        what: &'static str,
        /// Name of the feature.
        feature: &'static str,
    },
    /// A shader or a binding that the device refuses.
    #[error(transparent)]
    Runtime(#[from] runtime::Error),
}
