//! Transfer function of a PNG's numbers: colours in sRGB, or data as they are.

use crate::failure::Failure;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Mutex;
use straightline_codegen::ir::Texture;
use straightline_scene::picture;

/// Conversion of a PNG's numbers to those of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transfer {
    /// Colours in sRGB are made linear; alpha is unchanged.
    Srgb,
    /// Numbers from 0 to 1, unchanged.
    Linear,
}

/// Splits the value of `--input` into its file or files, and the requested conversion: `FILE,linear`. The text stays whole
/// if a file has that name.
pub fn split_transfer(path: &str) -> (&str, Option<Transfer>) {
    let ends = [(",linear", Transfer::Linear), (",srgb", Transfer::Srgb)];
    let found = ends
        .into_iter()
        .find_map(|(end, transfer)| Some((path.strip_suffix(end)?, transfer)));
    match found {
        Some((file, transfer)) if !Path::new(path).exists() => (file, Some(transfer)),
        _ => (path, None),
    }
}

/// Returns the requested conversion, or the default of the texture's type: data for one or two components, a colour for
/// three or four. Prints a note if a PNG is read as sRGB without a request.
pub fn choose_transfer(asked: Option<Transfer>, texture: &Texture, path: &str) -> Result<Transfer, Failure> {
    let is_png = picture::is_png(Path::new(path));
    match asked {
        Some(Transfer::Srgb) if !is_png => Err(Failure::Usage(format!(
            "`,srgb` is of a PNG, and `{path}` is none: its numbers are read as they are"
        ))),
        Some(transfer) => Ok(transfer),
        None if texture.declared <= 2 => {
            if is_png {
                note_once(format!(
                    "note: `{}` is no colour, so {path} is read as it is, from 0 to 1; as sRGB it is --input {}={path},srgb",
                    texture.name, texture.name
                ));
            }
            Ok(Transfer::Linear)
        }
        None => {
            if is_png {
                note_once(format!(
                    "note: {path} is read as sRGB; if `{}` is data, as normals are: --input {}={path},linear",
                    texture.name, texture.name
                ));
            }
            Ok(Transfer::Srgb)
        }
    }
}

/// Prints a note once, however often a sweep or a watch reads the file.
fn note_once(text: String) {
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    if SAID.lock().is_ok_and(|mut said| said.insert(text.clone())) {
        errln!("{text}");
    }
}
