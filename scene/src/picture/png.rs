//! PNG files, in sRGB.

use super::{MAX_BYTES, PictureError, check_size, srgb};
use ::png::{BitDepth, ColorType, Compression, Decoder, DecodingError, Encoder, EncodingError, Filter, Limits};
use ::png::{Reader, Transformations};
use glam::{UVec2, UVec4, Vec4};
use std::fs::File;
use std::io::{self, BufReader, Write};
use std::path::Path;
use straightline_files as files;
use straightline_kernels::prelude::Frame;

/// Writes `frame` to `file`, which errors call `path`.
pub(super) fn encode_png(path: &Path, file: &mut impl Write, frame: &Frame<Vec4>) -> Result<(), PictureError> {
    let bytes: Vec<u8> = frame.texels().iter().flat_map(|texel| to_srgb8(*texel)).collect();
    let size = frame.size();
    let mut encoder = Encoder::new(file, size.x, size.y);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    let failure = |error: EncodingError| PictureError::Io {
        action: "write",
        path: path.to_owned(),
        source: error.into(),
    };
    let mut writer = encoder.write_header().map_err(failure)?;
    writer.write_image_data(&bytes).map_err(failure)?;
    writer.finish().map_err(failure)
}

/// Reads a PNG file as linear colour.
pub(super) fn decode_png(path: &Path) -> Result<Frame<Vec4>, PictureError> {
    let stored = Stored::read(path)?;
    let most = stored.max_component() as f32;
    Ok(stored.frame(|[r, g, b, a]| from_srgb(Vec4::new(r as f32, g as f32, b as f32, a as f32) / most)))
}

/// Reads a PNG file as numbers from 0 to 1, in even steps.
pub(super) fn decode_linear(path: &Path) -> Result<Frame<Vec4>, PictureError> {
    let stored = Stored::read(path)?;
    let most = stored.max_component() as f32;
    Ok(stored.frame(|[r, g, b, a]| Vec4::new(r as f32, g as f32, b as f32, a as f32) / most))
}

/// Reads the numbers of a PNG file as they are stored.
pub(super) fn decode_integers(path: &Path) -> Result<Frame<UVec4>, PictureError> {
    let stored = Stored::read(path)?;
    // Grey is in one component, and what the file lacks is 0.
    let grey = matches!(stored.color, ColorType::Grayscale | ColorType::GrayscaleAlpha);
    Ok(stored.frame(|[r, g, b, a]| match grey {
        true => UVec4::new(r, 0, 0, a),
        false => UVec4::new(r, g, b, a),
    }))
}

/// A decoded file: palettes looked up, grey of few bits widened to 8.
struct Stored {
    size: UVec2,
    color: ColorType,
    depth: BitDepth,
    bytes: Vec<u8>,
}

impl Stored {
    fn read(path: &Path) -> Result<Self, PictureError> {
        let file = files::open_file(path, MAX_BYTES).map_err(|source| PictureError::Io {
            action: "read",
            path: path.to_owned(),
            source,
        })?;
        let failure = |error| to_picture_error(path, error);
        // Sizes are checked here; what a decoder allocates besides is bounded by them.
        let mut decoder = Decoder::new_with_limits(BufReader::new(file), Limits { bytes: usize::MAX });
        let header = decoder.read_header_info().map_err(failure)?;
        check_size(path, UVec2::new(header.width, header.height))?;
        decoder.set_transformations(Transformations::EXPAND);
        Self::decode(decoder.read_info().map_err(failure)?).map_err(failure)
    }

    fn decode(mut reader: Reader<BufReader<File>>) -> Result<Self, DecodingError> {
        let size = UVec2::new(reader.info().width, reader.info().height);
        let (color, depth) = reader.output_color_type();
        let length = reader.output_buffer_size().ok_or(DecodingError::LimitsExceeded)?;
        let mut bytes = vec![0; length];
        reader.next_frame(&mut bytes)?;
        Ok(Stored {
            size,
            color,
            depth,
            bytes,
        })
    }

    /// The largest number of a component.
    fn max_component(&self) -> u32 {
        match self.depth {
            BitDepth::Sixteen => 0xffff,
            _ => 0xff,
        }
    }

    /// Texels of red, green, blue and alpha: grey in all three, and full alpha where the file has none.
    fn frame<T: Copy>(&self, texel: impl Fn([u32; 4]) -> T) -> Frame<T> {
        let width = self.color.samples();
        let numbers: Vec<u32> = match self.depth {
            BitDepth::Sixteen => {
                let pairs = self.bytes.chunks_exact(2);
                pairs
                    .map(|pair| u32::from(u16::from_be_bytes([pair[0], pair[1]])))
                    .collect()
            }
            _ => self.bytes.iter().copied().map(u32::from).collect(),
        };
        let most = self.max_component();
        let texels = numbers.chunks_exact(width).map(|stored| {
            texel(match *stored {
                [grey] => [grey, grey, grey, most],
                [grey, alpha] => [grey, grey, grey, alpha],
                [r, g, b] => [r, g, b, most],
                [r, g, b, a, ..] => [r, g, b, a],
                // No colour of PNG has no component.
                [] => [0, 0, 0, most],
            })
        });
        Frame::new(self.size, texels.collect())
    }
}

/// Clamped; NaN becomes 0. Alpha is linear.
pub(super) fn to_srgb8(texel: Vec4) -> [u8; 4] {
    // A cast from float to integer saturates, and takes NaN to 0.
    let byte = |value: f32| (value * 255.0).round() as u8;
    let color = |light: f32| byte(srgb::from_linear(light.clamp(0.0, 1.0)));
    [color(texel.x), color(texel.y), color(texel.z), byte(texel.w)]
}

/// Returns the texel that [`decode`] reads from the one that [`encode`] writes.
pub(super) fn round_to_srgb8(texel: Vec4) -> Vec4 {
    from_srgb(Vec4::from_array(to_srgb8(texel).map(|byte| f32::from(byte) / 255.0)))
}

fn from_srgb(texel: Vec4) -> Vec4 {
    Vec4::new(
        srgb::to_linear(texel.x),
        srgb::to_linear(texel.y),
        srgb::to_linear(texel.z),
        texel.w,
    )
}

fn to_picture_error(path: &Path, error: DecodingError) -> PictureError {
    match error {
        // A file that ends too early is a damaged one, not a system's refusal.
        DecodingError::IoError(source) if source.kind() != io::ErrorKind::UnexpectedEof => PictureError::Io {
            action: "read",
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
