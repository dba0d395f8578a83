//! The only crate that opens files for reading and creates files for writing. A set of files is written completely or not
//! at all, only changed files are written, and only regular files are read. [`shorten()`] prepares an external value for a
//! message.

mod read;
mod shorten;
mod unfinished;

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

pub use read::{open_file, read_file, read_text};
pub use shorten::shorten;
pub use unfinished::{Folders, Scrap, remove_unfinished};

/// Reason why files could not be written. None of them has been changed.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The folder cannot be made or written to.
    #[error("cannot write to the folder `{folder}`: {source}")]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write `{file}`: {source}")]
    File {
        /// The file.
        file: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
}

impl WriteError {
    /// An error of a file.
    fn for_file(path: &Path) -> impl Fn(io::Error) -> WriteError + '_ {
        |source| WriteError::File {
            file: path.to_owned(),
            source,
        }
    }

    /// An error of a folder.
    fn for_folder(path: &Path) -> impl Fn(io::Error) -> WriteError + '_ {
        |source| WriteError::Folder {
            folder: path.to_owned(),
            source,
        }
    }
}

/// Writes files by name into `folder`, which is created if missing; a name may lead into folders below it. A file that
/// already has its contents is left untouched, so that nothing depending on it is rebuilt. Returns the paths of all files.
///
/// # Errors
///
/// [`WriteError`]. Then every file and folder is unchanged.
pub fn write_all(folder: &Path, files: &BTreeMap<String, Vec<u8>>) -> Result<Vec<PathBuf>, WriteError> {
    let mut folders = Folders::make(folder).map_err(WriteError::for_folder(folder))?;
    let mut staged = Vec::new();
    for (name, contents) in files {
        let path = folder.join(name);
        if has_contents(&path, contents) {
            continue;
        }
        if path.is_dir() {
            let source = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(WriteError::File { file: path, source });
        }
        if let Some(parent) = path.parent() {
            folders.add(parent).map_err(WriteError::for_folder(parent))?;
        }
        let scrap = Scrap::beside(&path, "partial").map_err(WriteError::for_file(&path))?;
        fs::write(scrap.path(), contents).map_err(WriteError::for_file(&path))?;
        staged.push((scrap, path));
    }
    put_in_place(&staged)?;
    folders.keep();
    Ok(files.keys().map(|name| folder.join(name)).collect())
}

/// Writes one file, creating the folders above it. After an error the file is unchanged.
///
/// # Errors
///
/// [`WriteError`].
pub fn write_file(path: &Path, contents: &[u8]) -> Result<(), WriteError> {
    let folders = make_parents(path).map_err(WriteError::for_file(path))?;
    fill_file(path, |file| file.write_all(contents), |error| error).map_err(WriteError::for_file(path))?;
    folders.keep();
    Ok(())
}

/// Creates `path` with the output of `fill`, replacing an existing file only when everything is written. Its folder must
/// exist. `refused` converts errors of the system.
///
/// # Errors
///
/// Errors of `fill`, and errors of the system.
pub fn fill_file<E>(
    path: &Path,
    fill: impl FnOnce(&mut io::BufWriter<File>) -> Result<(), E>,
    refused: impl Fn(io::Error) -> E,
) -> Result<(), E> {
    let scrap = Scrap::beside(path, "partial").map_err(&refused)?;
    let mut writer = io::BufWriter::new(File::create_new(scrap.path()).map_err(&refused)?);
    fill(&mut writer)?;
    // Only into_inner reports whether the last bytes were written.
    let file = writer.into_inner().map_err(io::IntoInnerError::into_error);
    drop(file.map_err(&refused)?);
    fs::rename(scrap.path(), path).map_err(&refused)
}

/// Checks that files can be written into `folder`, which need not exist: writes one and removes it. For commands that work for
/// long before they write.
///
/// # Errors
///
/// [`WriteError::Folder`].
pub fn try_folder(folder: &Path) -> Result<(), WriteError> {
    let tried = || -> io::Result<()> {
        let _made = Folders::make(folder)?;
        let scrap = Scrap::beside(&folder.join("try"), "partial")?;
        fs::write(scrap.path(), [0; 4096])
    };
    tried().map_err(WriteError::for_folder(folder))
}

/// Checks that `path` can be written, as [`try_folder`] for one file; `folders` says whether the folders above it would be
/// made.
///
/// # Errors
///
/// [`WriteError::File`].
pub fn try_file(path: &Path, folders: bool) -> Result<(), WriteError> {
    let tried = || -> io::Result<()> {
        if path.is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        let _made = folders.then(|| make_parents(path)).transpose()?;
        let scrap = Scrap::beside(path, "partial")?;
        fs::write(scrap.path(), [0; 4096])
    };
    tried().map_err(WriteError::for_file(path))
}

/// Makes the folders above a file.
fn make_parents(path: &Path) -> io::Result<Folders> {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => Folders::make(parent),
        _ => Folders::make(Path::new(".")),
    }
}

/// Returns whether the file already has these contents. Anything but a regular file of their length is not read.
fn has_contents(path: &Path, contents: &[u8]) -> bool {
    let same_length = fs::metadata(path).is_ok_and(|m| m.is_file() && m.len() == contents.len() as u64);
    same_length && fs::read(path).is_ok_and(|present| present == *contents)
}

/// Moves every file to its place. If one cannot be moved, those before it are put back.
fn put_in_place(staged: &[(Scrap, PathBuf)]) -> Result<(), WriteError> {
    let _whole = unfinished::lock_commit();
    let mut moved: Vec<(&Path, Option<Scrap>)> = Vec::new();
    for (scrap, path) in staged {
        let tried = || -> io::Result<Option<Scrap>> {
            let old = match path.exists() {
                true => {
                    let old = Scrap::beside(path, "replaced")?;
                    fs::hard_link(path, old.path()).or_else(|_| fs::copy(path, old.path()).map(drop))?;
                    Some(old)
                }
                false => None,
            };
            fs::rename(scrap.path(), path)?;
            Ok(old)
        };
        match tried() {
            Ok(old) => moved.push((path, old)),
            Err(source) => {
                for (path, old) in moved {
                    // The first error is the one to report.
                    let _ = match old {
                        Some(old) => fs::rename(old.path(), path),
                        None => fs::remove_file(path),
                    };
                }
                return Err(WriteError::File {
                    file: path.clone(),
                    source,
                });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
