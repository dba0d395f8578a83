//! Writing a set of files whole or not at all, and only what has changed.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

/// Why files could not be written. None of them has been changed.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The folder cannot be made or written to.
    #[error("cannot write to the folder `{folder}`: {source}")]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write `{file}`: {source}")]
    File {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// Writes files by name into `folder`, which is made if it is not there. A file that already has its contents is left
/// untouched, so that nothing built from it is built again. Gives the paths of all files.
pub fn write_all(folder: &Path, files: &BTreeMap<String, Vec<u8>>) -> Result<Vec<PathBuf>, WriteError> {
    std::fs::create_dir_all(folder).map_err(|source| WriteError::Folder {
        folder: folder.to_owned(),
        source,
    })?;
    let mut staged = Staged::default();
    for (name, contents) in files {
        let path = folder.join(name);
        if std::fs::read(&path).is_ok_and(|present| present == *contents) {
            continue;
        }
        if path.is_dir() {
            let source = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(WriteError::File { file: path, source });
        }
        let beside = folder.join(format!(".{name}.{}.part", std::process::id()));
        staged.pairs.push((beside.clone(), path.clone()));
        std::fs::write(&beside, contents).map_err(|source| WriteError::File { file: path, source })?;
    }
    for (beside, path) in &staged.pairs {
        std::fs::rename(beside, path).map_err(|source| WriteError::File {
            file: path.clone(),
            source,
        })?;
    }
    Ok(files.keys().map(|name| folder.join(name)).collect())
}

/// Files written beside their places; what has not moved to its place is removed.
#[derive(Default)]
struct Staged {
    pairs: Vec<(PathBuf, PathBuf)>,
}

impl Drop for Staged {
    fn drop(&mut self) {
        for (beside, _) in &self.pairs {
            let _ = std::fs::remove_file(beside);
        }
    }
}
