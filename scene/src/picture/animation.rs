//! Animated PNG files.

use super::srgb::to_srgb8;
use super::{PictureError, check_size};
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
pub fn encode_animation(frames: &[Frame<Vec4>], milliseconds: u16) -> Result<Vec<u8>, PictureError> {
    let path = Path::new("an animation in memory");
    let refused = |why: &str| super::write_error(path)(io::Error::new(io::ErrorKind::InvalidInput, why));
    let Some(first) = frames.first() else {
        return Err(refused("it has no frame"));
    };
    let size = first.size();
    check_size(path, size)?;
    if frames.iter().any(|frame| frame.size() != size) {
        return Err(refused("its frames differ in size"));
    }
    let failure = |error: EncodingError| super::write_error(path)(io::Error::other(error));
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
            .flat_map(|texel| to_srgb8(texel.to_array()))
            .collect();
        writer.write_image_data(&texels).map_err(failure)?;
    }
    writer.finish().map_err(failure)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::png::Decoder;
    use glam::uvec2;
    use std::io::Cursor;

    #[test]
    fn every_frame_is_in_the_animation() {
        let frames =
            [Vec4::W, Vec4::ONE, Vec4::new(1.0, 0.0, 0.0, 1.0)].map(|color| Frame::new(uvec2(3, 2), vec![color; 6]));
        let bytes = encode_animation(&frames, 40).expect("an animation");
        let mut reader = Decoder::new(Cursor::new(&bytes)).read_info().expect("a picture");
        let control = reader.info().animation_control.expect("it is animated");
        assert_eq!((control.num_frames, control.num_plays), (3, 0));
        for color in [[0, 0, 0, 255], [255; 4], [255, 0, 0, 255]] {
            let mut texels = vec![7; 24];
            reader.next_frame(&mut texels).expect("a frame");
            assert_eq!(texels, color.repeat(6));
        }
    }

    #[test]
    fn what_is_no_animation_is_refused() {
        let [small, large] = [1, 2].map(|side| Frame::new(uvec2(side, side), vec![Vec4::ONE; (side * side) as usize]));
        assert!(encode_animation(&[], 40).is_err());
        assert!(encode_animation(&[small, large], 40).is_err());
    }
}
