//! Pictures of tests: sRGB, their comparison with golden files, and, with the feature `pictures`, PNG files.
//!
//! The functions of [`testing`](crate::testing) and the command `straightline test` compare pictures by this module.
//! A texel is an `[f32; 4]` of linear RGB and alpha.

mod compare;
#[cfg(feature = "pictures")]
mod golden;
#[cfg(feature = "pictures")]
pub mod png;
pub mod srgb;

pub use compare::{Difference, Likeness, compare_pictures};
#[cfg(feature = "pictures")]
pub use golden::{Mismatch, compare_with_file, picture_path, read_drawn};

/// Widest and tallest picture of a test, in pixels.
pub const MAX_SIDE: u32 = 4096;

/// Most pixels of a picture of a test.
pub const MAX_PIXELS: u32 = 1 << 21;

/// Longest file of a picture of a test, in bytes.
pub const MAX_BYTES: u64 = 1 << 26;

/// A picture that a test reads or draws.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Width and height.
    pub size: [u32; 2],
    /// Texels of linear RGB and alpha, row by row from the top.
    pub texels: Vec<[f32; 4]>,
}

/// Returns whether a picture of a test may have this width and height.
pub fn is_size(size: [u32; 2]) -> bool {
    let [width, height] = size;
    width > 0 && height > 0 && width.max(height) <= MAX_SIDE && width * height <= MAX_PIXELS
}

/// Returns the reason why a test cannot name a picture so; `None` of a PNG file in the kernel's folder or below it.
pub fn name_error(name: &str) -> Option<&'static str> {
    let outside = |part: &str| part.is_empty() || part == "." || part == ".." || part.contains(['\\', ':']);
    if name.split('/').any(outside) {
        Some("it leads out of the folder of the kernel's file")
    } else if !name.ends_with(".png") {
        Some("it is no `.png`")
    } else {
        None
    }
}
