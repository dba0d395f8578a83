//! Single pictures: files, and what is shown beside one another.
//!
//! A picture is a `Frame<Vec4>` of linear RGB and alpha. [`write_picture()`] chooses the format by the file's extension:
//! PNG for looking at (8 bits, sRGB) or EXR for measuring (32-bit floats, linear). The latter needs the feature `exr`.

mod animation;
mod error;
#[cfg_attr(not(feature = "exr"), path = "without_exr.rs")]
pub(crate) mod exr;
pub(crate) mod layout;
mod lut;
mod png;

use glam::{UVec2, UVec4, Vec4};
use std::path::Path;
use straightline_files as files;
use straightline_kernels::prelude::Frame;

pub use animation::encode_animation;
pub use error::PictureError;
pub use layout::{compare_details, compose_montage, enlarge_detail, find_busiest_square};
pub use lut::{read_cube, slice_strip};
pub use straightline_kernels::pictures::srgb;

/// Widest and tallest picture that is read or written, in pixels.
pub const MAX_SIDE: u32 = 16_384;

/// Maximum number of pixels of a picture; 8K video has half as many.
pub const MAX_PIXELS: u64 = 1 << 26;

/// Extensions that [`read_picture`] and [`write_picture()`] know.
pub const EXTENSIONS: [&str; 2] = ["png", "exr"];

/// Longest file of a picture that is read, in bytes.
pub(crate) const MAX_BYTES: u64 = 1 << 34;

/// Makes the error of the system's refusal to write `path`.
pub(crate) fn write_error(path: &Path) -> impl Fn(std::io::Error) -> PictureError + '_ {
    |source| PictureError::Io {
        action: "write",
        path: path.to_owned(),
        source,
    }
}

enum Format {
    Png,
    Exr,
}

impl Format {
    fn from_path(path: &Path) -> Result<Self, PictureError> {
        let extension = path
            .extension()
            .and_then(|e| e.to_str())
            .unwrap_or_default()
            .to_ascii_lowercase();
        match extension.as_str() {
            "png" => Ok(Format::Png),
            "exr" => Ok(Format::Exr),
            _ => Err(PictureError::UnknownExtension { path: path.to_owned() }),
        }
    }
}

/// Writes a picture, as [`write_png`] or [`write_exr`] by the extension of `path`. A file of that name is
/// replaced once the new one is complete; after an error it is as it was.
pub fn write_picture(path: &Path, frame: &Frame<Vec4>) -> Result<(), PictureError> {
    match Format::from_path(path)? {
        Format::Png => write_png(path, frame),
        Format::Exr => write_exr(path, frame),
    }
}

/// Writes linear colour as an 8-bit RGBA PNG in sRGB. Values are clamped to 0..=1 first; what is not a number
/// becomes 0. Whole or not at all, as [`write_picture()`].
pub fn write_png(path: &Path, frame: &Frame<Vec4>) -> Result<(), PictureError> {
    check_size(path, frame.size())?;
    files::fill_file(path, |file| png::encode_png(path, file, frame), write_error(path))
}

/// The bytes of what [`write_png`] writes.
///
/// # Errors
///
/// If the encoder fails.
pub fn png_bytes(frame: &Frame<Vec4>) -> Result<Vec<u8>, PictureError> {
    let mut bytes = Vec::new();
    png::encode_png(Path::new("a picture in memory"), &mut bytes, frame)?;
    Ok(bytes)
}

/// Linear colour as a PNG of [`write_png`] would give it back: clamped to 0..=1 and rounded to 8 bits of sRGB. A pixel that is
/// not finite stays as it is, so that no comparison takes it for black.
pub fn at_eight_bits(frame: &Frame<Vec4>) -> Frame<Vec4> {
    let texels = frame.texels().iter().map(|texel| match texel.is_finite() {
        true => png::round_to_srgb8(*texel),
        false => *texel,
    });
    Frame::new(frame.size(), texels.collect())
}

/// Writes linear colour as it is: an EXR file of 32-bit float channels R, G, B and A, compressed without loss.
/// Whole or not at all, as [`write_picture()`].
pub fn write_exr(path: &Path, frame: &Frame<Vec4>) -> Result<(), PictureError> {
    exr::write_layers(path, frame.size(), vec![exr::Layer::new("", color_channels(frame))])
}

/// Reads a PNG (8 or 16 bits, taken as sRGB) or EXR (16- or 32-bit floats, taken as linear) as linear colour,
/// by the extension of `path`. Without an alpha channel alpha is 1.
///
/// An EXR file's colour is that of the first part with channels `R`, `G` and `B`, whose data window must be
/// the display window.
pub fn read_picture(path: &Path) -> Result<Frame<Vec4>, PictureError> {
    match Format::from_path(path)? {
        Format::Png => png::decode_png(path),
        Format::Exr => exr::read_color(path, None),
    }
}

/// Reads a picture like [`read_picture`], but takes the numbers of a PNG as they are, 0 to 1: as of data, such as depths
/// and normals, not of colours.
///
/// # Errors
///
/// As [`read_picture`].
pub fn read_linear(path: &Path) -> Result<Frame<Vec4>, PictureError> {
    match Format::from_path(path)? {
        Format::Png => png::decode_linear(path),
        Format::Exr => exr::read_color(path, None),
    }
}

/// Returns whether a file is read as sRGB by [`read_picture`], and as it is by [`read_linear`].
pub fn is_png(path: &Path) -> bool {
    matches!(Format::from_path(path), Ok(Format::Png))
}

/// Reads the numbers of a PNG as they are stored, 0 to 255 or to 65535; components that it lacks are 0, and alpha the largest.
///
/// # Errors
///
/// If the file cannot be read, or is no PNG.
pub fn read_integers(path: &Path) -> Result<Frame<UVec4>, PictureError> {
    match Format::from_path(path)? {
        Format::Png => png::decode_integers(path),
        Format::Exr => Err(PictureError::Unusable {
            path: path.to_owned(),
            problem: "texels of integers are read from PNG files, as they are stored there".to_owned(),
        }),
    }
}

/// Names of the layers of an EXR file that has layers and no colour, such as the depths and normals of a capture; none of any
/// other picture.
///
/// # Errors
///
/// If the file cannot be read.
pub fn layer_names(path: &Path) -> Result<Vec<String>, PictureError> {
    match Format::from_path(path)? {
        Format::Png => Ok(Vec::new()),
        Format::Exr => exr::layer_names(path),
    }
}

/// Reads one layer of an EXR file: its channels R, G and B or X, Y and Z, or its only one (Z, Y or any other) in all
/// components.
///
/// # Errors
///
/// If the file cannot be read, or has no such layer.
pub fn read_layer(path: &Path, layer: &str) -> Result<Frame<Vec4>, PictureError> {
    exr::read_layer(path, layer)
}

/// Channels of an image of colours.
pub(crate) fn color_channels(frame: &Frame<Vec4>) -> Vec<(&'static str, Vec<f32>)> {
    let plane = |axis: usize| frame.texels().iter().map(|texel| texel[axis]).collect();
    vec![("R", plane(0)), ("G", plane(1)), ("B", plane(2)), ("A", plane(3))]
}

/// Refuses pictures of no or of absurd size before anything is allocated for them.
pub(crate) fn check_size(path: &Path, size: UVec2) -> Result<(), PictureError> {
    let pixels = u64::from(size.x) * u64::from(size.y);
    if pixels == 0 || size.max_element() > MAX_SIDE || pixels > MAX_PIXELS {
        let problem = format!(
            "its size is {}×{}, and each side must be 1 to {MAX_SIDE} pixels, {MAX_PIXELS} pixels in all",
            size.x, size.y
        );
        return Err(PictureError::Unusable {
            path: path.to_owned(),
            problem,
        });
    }
    Ok(())
}
