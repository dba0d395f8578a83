//! Animated PNG files.

use super::{PictureError, check_size, png as still};
use ::png::{BitDepth, ColorType, Encoder, EncodingError};
use glam::Vec4;
use std::io;
use std::path::Path;
use straightline_kernels::prelude::Frame;

/// Frames of one size as an animated PNG that begins again when it has ended, each shown for so many milliseconds, as
/// [`super::write_png`] writes pictures. What shows no animation shows the first.
///
/// # Errors
///
/// If there is no frame, one has another size or too many pixels, or the encoder fails.
pub fn animation(frames: &[Frame<Vec4>], milliseconds: u16) -> Result<Vec<u8>, PictureError> {
    let path = Path::new("an animation in memory");
    let refused = |why: &str| super::refused(path)(io::Error::new(io::ErrorKind::InvalidInput, why));
    let Some(first) = frames.first() else {
        return Err(refused("it has no frame"));
    };
    let size = first.size();
    check_size(path, size)?;
    if frames.iter().any(|frame| frame.size() != size) {
        return Err(refused("its frames differ in size"));
    }
    let failure = |error: EncodingError| super::refused(path)(io::Error::other(error));
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, size.x, size.y);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_animated(frames.len() as u32, 0).map_err(failure)?;
    encoder.set_frame_delay(milliseconds, 1000).map_err(failure)?;
    let mut writer = encoder.write_header().map_err(failure)?;
    for frame in frames {
        let texels: Vec<u8> = frame
            .texels()
            .iter()
            .flat_map(|texel| still::to_srgb8(*texel))
            .collect();
        writer.write_image_data(&texels).map_err(failure)?;
    }
    writer.finish().map_err(failure)?;
    Ok(bytes)
}
