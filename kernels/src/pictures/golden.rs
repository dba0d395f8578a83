//! Golden files of pictures.

use super::png::{Stored, encode_rgba8};
use super::srgb::{from_srgb, to_srgb8};
use super::{Difference, Drawn, Likeness, MAX_BYTES, MAX_PIXELS, MAX_SIDE, compare_pictures, is_size, name_error};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use straightline_files as files;

/// Reason why a picture is not that of its golden file.
#[derive(Debug)]
pub enum Mismatch {
    /// There is no golden file.
    Missing(PathBuf),
    /// A file cannot be read or written.
    Unusable(String),
    /// The golden file has another size.
    Size {
        /// The golden file.
        golden: PathBuf,
        /// Its width and height, and those of the picture.
        sizes: [[u32; 2]; 2],
    },
    /// The pictures differ by more than the test takes.
    Differs {
        /// The difference.
        difference: Difference,
        /// Greatest difference that the test takes.
        likeness: Likeness,
        /// The picture as drawn, and a picture of the difference.
        files: [PathBuf; 2],
    },
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Mismatch::Missing(golden) => write!(f, "there is no golden file `{}` yet", golden.display()),
            Mismatch::Unusable(text) => f.write_str(text),
            Mismatch::Size {
                golden,
                sizes: [[w, h], [width, height]],
            } => {
                write!(
                    f,
                    "`{}` is {w}×{h} pixels, and the test draws {width}×{height}",
                    golden.display()
                )
            }
            Mismatch::Differs {
                difference, likeness, ..
            } => write!(f, "{difference}; `{likeness}` is asked"),
        }
    }
}

/// Path of a picture that a test names, beside the kernel's file or in a folder below that.
///
/// # Errors
///
/// The reason why a test cannot name a picture so.
pub fn picture_path(folder: &Path, name: &str) -> Result<PathBuf, String> {
    match name_error(name) {
        Some(reason) => Err(format!(
            "a test cannot use the picture `{}`: {reason}",
            files::shorten(name)
        )),
        None => Ok(folder.join(name)),
    }
}

/// Reads a PNG: colours in sRGB as linear ones, or numbers from 0 to 1 as they are if it is `data`.
///
/// # Errors
///
/// If the file cannot be read, is no PNG, or is larger than pictures of tests are.
pub fn read_drawn(path: &Path, data: bool) -> Result<Drawn, String> {
    let stored = read_stored(path).map_err(|error| error.to_string())?;
    let texels = stored.fractions();
    Ok(Drawn {
        size: stored.size,
        texels: match data {
            true => texels.collect(),
            false => texels.map(from_srgb).collect(),
        },
    })
}

/// Compares a picture with its golden file. With `bless` the file is written instead, unless it has these bytes already.
/// A picture that differs too much is written beside it, as `NAME.actual.png` and `NAME.difference.png`.
///
/// # Errors
///
/// [`Mismatch`].
pub fn compare_with_file(golden: &Path, drawn: &Drawn, likeness: Likeness, bless: bool) -> Result<(), Mismatch> {
    let expected = match read_stored(golden) {
        Ok(stored) => Ok(stored),
        Err(ReadError::Missing(path)) => Err(Mismatch::Missing(path)),
        Err(error) => Err(Mismatch::Unusable(error.to_string())),
    };
    let found = expected.and_then(|stored| {
        if stored.size != drawn.size {
            let (golden, sizes) = (golden.to_owned(), [stored.size, drawn.size]);
            return Err(Mismatch::Size { golden, sizes });
        }
        let bytes = stored.fractions().map(|texel| texel.map(|x| (x * 255.0).round() as u8));
        let bytes: Vec<[u8; 4]> = bytes.collect();
        Ok((compare_pictures(drawn.size[0], &drawn.texels, &bytes), bytes))
    });
    let own = || drawn.texels.iter().map(|texel| to_srgb8(*texel)).collect::<Vec<_>>();
    match found {
        Ok((None, _)) => Ok(()),
        _ if bless => write_bytes(golden, drawn.size, &own()),
        Ok((Some(difference), _)) if difference.is_within(likeness) => Ok(()),
        Ok((Some(difference), bytes)) => {
            let own = own();
            let files = ["actual", "difference"].map(|kind| golden.with_extension(format!("{kind}.png")));
            write_bytes(&files[0], drawn.size, &own)?;
            write_bytes(&files[1], drawn.size, &mark_difference(&own, &bytes))?;
            Err(Mismatch::Differs {
                difference,
                likeness,
                files,
            })
        }
        Err(mismatch) => Err(mismatch),
    }
}

/// The distance of each component, in even steps: white is the largest.
fn mark_difference(own: &[[u8; 4]], golden: &[[u8; 4]]) -> Vec<[u8; 4]> {
    let apart = |(own, golden): (&[u8; 4], &[u8; 4])| [0, 1, 2, 3].map(|k: usize| own[k].abs_diff(golden[k]));
    let all: Vec<[u8; 4]> = own.iter().zip(golden).map(apart).collect();
    let most = u32::from(all.iter().flatten().copied().max().unwrap_or(0).max(1));
    let grown = |byte: u8| (u32::from(byte) * 255 / most) as u8;
    // A difference of alpha alone shows too.
    let shown = |[r, g, b, a]: [u8; 4]| [grown(r.max(a)), grown(g.max(a)), grown(b.max(a)), 255];
    all.into_iter().map(shown).collect()
}

enum ReadError {
    Missing(PathBuf),
    Other(String),
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ReadError::Missing(path) => write!(f, "there is no picture `{}`", path.display()),
            ReadError::Other(text) => f.write_str(text),
        }
    }
}

fn read_stored(path: &Path) -> Result<Stored, ReadError> {
    let check = |size: [u32; 2]| match is_size(size) {
        true => Ok(()),
        false => Err(format!(
            "it is {}×{}, and a picture of a test has sides of 1 to {MAX_SIDE} pixels, {MAX_PIXELS} pixels in all",
            size[0], size[1]
        )),
    };
    Stored::read(path, MAX_BYTES, check).map_err(|error| match error {
        super::png::PngError::Io(error) if error.kind() == io::ErrorKind::NotFound => {
            ReadError::Missing(path.to_owned())
        }
        error => ReadError::Other(format!("cannot read `{}`: {error}", path.display())),
    })
}

fn write_bytes(path: &Path, size: [u32; 2], texels: &[[u8; 4]]) -> Result<(), Mismatch> {
    let mut file = Vec::new();
    let encoded = encode_rgba8(&mut file, size, texels.as_flattened()).map_err(|error| error.to_string());
    let written = encoded.and_then(|()| files::write_file(path, &file).map_err(|error| error.to_string()));
    written.map_err(Mismatch::Unusable)
}
