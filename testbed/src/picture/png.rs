//! PNG files, in sRGB.

use super::{MAX_BYTES, PictureError, check_size, srgb};
use glam::{UVec2, UVec4, Vec4};
use image::codecs::png::{PngDecoder, PngEncoder};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, ImageError};
use std::io::{self, BufReader, Write};
use std::path::Path;
use straightline_codegen::files;
use straightline_kernels::prelude::Frame;

/// Writes `frame` to `file`, which errors call `path`.
pub(super) fn encode(path: &Path, file: &mut impl Write, frame: &Frame<Vec4>) -> Result<(), PictureError> {
    let bytes: Vec<u8> = frame.texels().iter().flat_map(|texel| to_srgb8(*texel)).collect();
    let size = frame.size();
    PngEncoder::new(file)
        .write_image(&bytes, size.x, size.y, ExtendedColorType::Rgba8)
        .map_err(|error| failure("write", path, error))
}

/// Reads a PNG file as linear colour.
pub(super) fn decode(path: &Path) -> Result<Frame<Vec4>, PictureError> {
    let (size, image) = image(path)?;
    let texels = image
        .into_rgba32f()
        .pixels()
        .map(|pixel| from_srgb(Vec4::from_array(pixel.0)))
        .collect();
    Ok(Frame::new(size, texels))
}

/// Reads the numbers of a PNG file as they are stored.
pub(super) fn integers(path: &Path) -> Result<Frame<UVec4>, PictureError> {
    let (size, image) = image(path)?;
    // Grey is in one component, and what the file lacks is 0.
    let stored = image.color().has_color();
    let texel = |[r, g, b, a]: [u32; 4]| match stored {
        true => UVec4::new(r, g, b, a),
        false => UVec4::new(r, 0, 0, a),
    };
    let deep = image.color().bytes_per_pixel() / image.color().channel_count() > 1;
    let texels = match deep {
        true => image
            .into_rgba16()
            .pixels()
            .map(|p| texel(p.0.map(u32::from)))
            .collect(),
        false => image.into_rgba8().pixels().map(|p| texel(p.0.map(u32::from))).collect(),
    };
    Ok(Frame::new(size, texels))
}

fn image(path: &Path) -> Result<(UVec2, DynamicImage), PictureError> {
    let file = files::open(path, MAX_BYTES).map_err(|source| PictureError::Io {
        action: "read",
        path: path.to_owned(),
        source,
    })?;
    let decoder = PngDecoder::new(BufReader::new(file)).map_err(|error| failure("read", path, error))?;
    let size = UVec2::from(decoder.dimensions());
    check_size(path, size)?;
    let image = DynamicImage::from_decoder(decoder).map_err(|error| failure("read", path, error))?;
    Ok((size, image))
}

/// Clamped, with 0 for what is not a number. Alpha is linear.
pub(super) fn to_srgb8(texel: Vec4) -> [u8; 4] {
    // A cast from float to integer saturates, and takes NaN to 0.
    let byte = |value: f32| (value * 255.0).round() as u8;
    let color = |light: f32| byte(srgb::encode(light.clamp(0.0, 1.0)));
    [color(texel.x), color(texel.y), color(texel.z), byte(texel.w)]
}

/// What [`decode`] gives of what [`encode`] writes.
pub(super) fn rounded(texel: Vec4) -> Vec4 {
    from_srgb(Vec4::from_array(to_srgb8(texel).map(|byte| f32::from(byte) / 255.0)))
}

fn from_srgb(texel: Vec4) -> Vec4 {
    Vec4::new(
        srgb::decode(texel.x),
        srgb::decode(texel.y),
        srgb::decode(texel.z),
        texel.w,
    )
}

fn failure(action: &'static str, path: &Path, error: ImageError) -> PictureError {
    match error {
        // A file that ends too early is a damaged one, not a system's refusal.
        ImageError::IoError(source) if source.kind() != io::ErrorKind::UnexpectedEof => PictureError::Io {
            action,
            path: path.to_owned(),
            source,
        },
        error => PictureError::Damaged {
            path: path.to_owned(),
            format: "PNG",
            problem: error.to_string(),
        },
    }
}
