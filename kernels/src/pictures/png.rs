//! PNG files.

use png::{
    BitDepth, ColorType, Compression, Decoder, DecodingError, Encoder, EncodingError, Filter, Limits, Transformations,
};
use std::fmt;
use std::io::{self, BufReader, Write};
use std::path::Path;
use straightline_files as files;

/// Reason why a file could not be read.
#[derive(Debug)]
pub enum PngError<E> {
    /// The system refused.
    Io(io::Error),
    /// The contents are not those of a complete PNG.
    Damaged(DecodingError),
    /// The caller refused the size.
    Size(E),
}

impl<E: fmt::Display> fmt::Display for PngError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PngError::Io(error) => error.fmt(f),
            PngError::Damaged(error) => write!(f, "it is damaged, cut short or no PNG ({error})"),
            PngError::Size(error) => error.fmt(f),
        }
    }
}

/// A decoded file: palettes looked up, grey of few bits widened to 8.
pub struct Stored {
    /// Width and height.
    pub size: [u32; 2],
    color: ColorType,
    depth: BitDepth,
    bytes: Vec<u8>,
}

impl Stored {
    /// Reads a file of at most `most_bytes` whose width and height `check` takes, before anything is allocated for it.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, is no PNG, or is refused by `check`.
    pub fn read<E>(
        path: &Path,
        most_bytes: u64,
        check: impl FnOnce([u32; 2]) -> Result<(), E>,
    ) -> Result<Stored, PngError<E>> {
        let file = files::open_file(path, most_bytes).map_err(PngError::Io)?;
        // Sizes are checked here; what a decoder allocates besides is bounded by them.
        let mut decoder = Decoder::new_with_limits(BufReader::new(file), Limits { bytes: usize::MAX });
        let header = decoder.read_header_info().map_err(to_error)?;
        let size = [header.width, header.height];
        check(size).map_err(PngError::Size)?;
        decoder.set_transformations(Transformations::EXPAND);
        let mut reader = decoder.read_info().map_err(to_error)?;
        let (color, depth) = reader.output_color_type();
        let length = reader.output_buffer_size();
        let mut bytes = vec![0; length.ok_or_else(|| to_error(DecodingError::LimitsExceeded))?];
        reader.next_frame(&mut bytes).map_err(to_error)?;
        Ok(Stored {
            size,
            color,
            depth,
            bytes,
        })
    }

    /// Returns whether the file is grey, with or without alpha.
    pub fn is_grey(&self) -> bool {
        matches!(self.color, ColorType::Grayscale | ColorType::GrayscaleAlpha)
    }

    /// The largest number of a component.
    pub fn max_component(&self) -> u32 {
        match self.depth {
            BitDepth::Sixteen => 0xffff,
            _ => 0xff,
        }
    }

    /// Numbers of red, green, blue and alpha of each texel, row by row from the top: grey in all three, and full alpha where the
    /// file has none.
    pub fn numbers(&self) -> impl Iterator<Item = [u32; 4]> + '_ {
        let most = self.max_component();
        let width = match self.depth {
            BitDepth::Sixteen => 2,
            _ => 1,
        };
        let texels = self.bytes.chunks_exact(self.color.samples() * width);
        texels.map(move |texel| {
            let number = |k: usize| match texel.get(k * width..(k + 1) * width) {
                Some([high, low]) => Some(u32::from(u16::from_be_bytes([*high, *low]))),
                Some([byte]) => Some(u32::from(*byte)),
                _ => None,
            };
            // No colour of PNG has no component.
            let first = number(0).unwrap_or(0);
            match (number(1), number(2), number(3)) {
                (None, ..) => [first, first, first, most],
                (Some(alpha), None, _) => [first, first, first, alpha],
                (Some(g), Some(b), alpha) => [first, g, b, alpha.unwrap_or(most)],
            }
        })
    }

    /// Numbers from 0 to 1 of each texel, in even steps.
    pub fn fractions(&self) -> impl Iterator<Item = [f32; 4]> + '_ {
        let most = self.max_component() as f32;
        self.numbers()
            .map(move |texel| texel.map(|number| number as f32 / most))
    }
}

/// Writes a picture of 8 bits a component: red, green, blue and alpha of each texel, row by row from the top.
///
/// # Errors
///
/// If `file` cannot be written, or `bytes` has not the length that `size` asks for.
pub fn encode_rgba8(file: &mut impl Write, size: [u32; 2], bytes: &[u8]) -> Result<(), EncodingError> {
    let mut encoder = Encoder::new(file, size[0], size[1]);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    writer.finish()
}

fn to_error<E>(error: DecodingError) -> PngError<E> {
    match error {
        // A file that ends too early is a damaged one, not a system's refusal.
        DecodingError::IoError(source) if source.kind() != io::ErrorKind::UnexpectedEof => PngError::Io(source),
        error => PngError::Damaged(error),
    }
}
