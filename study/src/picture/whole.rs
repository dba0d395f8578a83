//! Files and folders that appear whole or not at all.
//!
//! Both are made under another name beside their place and renamed when complete, so that neither a crash, a
//! full disk nor a second program ever shows half of one.

use super::PictureError;
use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// A name beside `path` that no other call uses.
pub(crate) fn beside(path: &Path, purpose: &str) -> io::Result<PathBuf> {
    static NEXT: AtomicU32 = AtomicU32::new(0);
    let name = path.file_name().ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::InvalidInput,
            "the path ends in no name; give one, such as `out` or `out.png`",
        )
    })?;
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    Ok(path.with_file_name(format!(
        ".{}.{purpose}-{}-{number}",
        name.to_string_lossy(),
        std::process::id()
    )))
}

/// Removes what is at its path when dropped, unless that has moved on.
pub(crate) struct Scrap(pub PathBuf);

impl Drop for Scrap {
    fn drop(&mut self) {
        // Nothing sensible can be done about a scrap that will not go away; the first error is the one to tell.
        let _ = if self.0.is_dir() {
            fs::remove_dir_all(&self.0)
        } else {
            fs::remove_file(&self.0)
        };
    }
}

/// Creates `path` with what `fill` writes, replacing a file of that name only when all is written.
pub(crate) fn file(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> Result<(), PictureError>,
) -> Result<(), PictureError> {
    let refused = |source| PictureError::Io {
        action: "write",
        path: path.to_owned(),
        source,
    };
    let scrap = Scrap(beside(path, "partial").map_err(refused)?);
    let mut writer = BufWriter::new(File::create_new(&scrap.0).map_err(refused)?);
    fill(&mut writer)?;
    // Only into_inner tells whether the last bytes found room.
    drop(writer.into_inner().map_err(|error| refused(error.into_error()))?);
    fs::rename(&scrap.0, path).map_err(refused)
}
