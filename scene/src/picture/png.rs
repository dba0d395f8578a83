//! PNG files, in sRGB.

use super::srgb::{from_srgb, to_srgb8};
use super::{MAX_BYTES, PictureError, check_size, write_error};
use glam::{UVec2, UVec4, Vec4};
use std::io::Write;
use std::path::Path;
use straightline_kernels::pictures::png::{PngError, Stored, encode_rgba8};
use straightline_kernels::prelude::Frame;

/// Writes `frame` to `file`, which errors call `path`.
pub(super) fn encode_png(path: &Path, file: &mut impl Write, frame: &Frame<Vec4>) -> Result<(), PictureError> {
    let texels = frame.texels().iter();
    let bytes: Vec<u8> = texels.flat_map(|texel| to_srgb8(texel.to_array())).collect();
    let encoded = encode_rgba8(file, frame.size().to_array(), &bytes);
    encoded.map_err(|error| write_error(path)(error.into()))
}

/// Reads a PNG file as linear colour.
pub(super) fn decode_png(path: &Path) -> Result<Frame<Vec4>, PictureError> {
    let stored = read(path)?;
    let texels = stored.fractions().map(|texel| Vec4::from_array(from_srgb(texel)));
    Ok(Frame::new(stored.size.into(), texels.collect()))
}

/// Reads a PNG file as numbers from 0 to 1, in even steps.
pub(super) fn decode_linear(path: &Path) -> Result<Frame<Vec4>, PictureError> {
    let stored = read(path)?;
    let texels = stored.fractions().map(Vec4::from_array);
    Ok(Frame::new(stored.size.into(), texels.collect()))
}

/// Reads the numbers of a PNG file as they are stored.
pub(super) fn decode_integers(path: &Path) -> Result<Frame<UVec4>, PictureError> {
    let stored = read(path)?;
    // Grey is in one component, and what the file lacks is 0.
    let grey = stored.is_grey();
    let texels = stored.numbers().map(|[r, g, b, a]| match grey {
        true => UVec4::new(r, 0, 0, a),
        false => UVec4::new(r, g, b, a),
    });
    Ok(Frame::new(stored.size.into(), texels.collect()))
}

/// Returns the texel that [`decode_png`] reads from the one that [`encode_png`] writes.
pub(super) fn round_to_srgb8(texel: Vec4) -> Vec4 {
    let bytes = to_srgb8(texel.to_array());
    Vec4::from_array(from_srgb(bytes.map(|byte| f32::from(byte) / 255.0)))
}

fn read(path: &Path) -> Result<Stored, PictureError> {
    Stored::read(path, MAX_BYTES, |size| check_size(path, UVec2::from_array(size))).map_err(|error| match error {
        PngError::Io(source) => PictureError::Io {
            action: "read",
            path: path.to_owned(),
            source,
        },
        PngError::Damaged(error) => PictureError::Damaged {
            path: path.to_owned(),
            format: "PNG",
            problem: error.to_string(),
        },
        PngError::Size(error) => error,
    })
}
