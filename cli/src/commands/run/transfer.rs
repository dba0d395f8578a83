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
    /// They are colours in sRGB, made linear; alpha is as it is.
    Srgb,
    /// They are as they are, from 0 to 1.
    Linear,
}

/// The file, or files, of `--input`, and the transfer that is asked for behind them: `FILE,linear`. A file of such a name is one.
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

/// Returns the requested conversion, or the one of the texture's type: one or two components are data, three or four a colour.
/// Notes that a PNG is read as sRGB without a request.
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

/// Says something once, however often a sweep or a watch reads the file.
fn note_once(text: String) {
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    if SAID.lock().is_ok_and(|mut said| said.insert(text.clone())) {
        errln!("{text}");
    }
}
