//! Why a capture could not be read or written.

use super::{DESCRIPTION, SCHEMA};
use crate::picture::PictureError;
use std::path::PathBuf;

/// Why a capture could not be read or written. Each names the file, and the layer where there is one.
#[derive(Debug, thiserror::Error)]
pub enum CaptureError {
    /// The folder has no `capture.json`, or is none.
    #[error("{} is not a capture: it is no folder with a {DESCRIPTION}; see docs/captures.md", .dir.display())]
    NotACapture {
        /// The folder.
        dir: PathBuf,
    },
    /// A file that every capture has is not there.
    #[error("{} is missing: the capture needs {contents}", .path.display())]
    MissingFile {
        /// The file.
        path: PathBuf,
        /// Contents that the file should have.
        contents: String,
    },
    /// `capture.json` is not JSON, or lacks something, or has something unknown.
    #[error("{}: {source}; see docs/captures.md", .path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// Description of the error, with line and column.
        source: serde_json::Error,
    },
    /// A layout of another time.
    #[error("{}: schema {found}, but this reader knows schema {SCHEMA}: write the capture again", .path.display())]
    Schema {
        /// The file.
        path: PathBuf,
        /// The schema that it states.
        found: u32,
    },
    /// Depth that is not linear.
    #[error("{}: depth encoding `{found}` is unknown: convert depth to `linear`", .path.display())]
    DepthEncoding {
        /// The file.
        path: PathBuf,
        /// The encoding that it states.
        found: String,
    },
    /// A field whose value makes no sense.
    #[error("{}: {field}: {problem}", .path.display())]
    Value {
        /// The file.
        path: PathBuf,
        /// The field of `capture.json`.
        field: &'static str,
        /// Description of the problem, and of a value that would do.
        problem: String,
    },
    /// More or fewer layers than there are samples.
    #[error("{}: {problem}, but {DESCRIPTION} has {samples} samples and so asks for {expected}", .path.display())]
    Layers {
        /// The file.
        path: PathBuf,
        /// Description of the layers found.
        problem: String,
        /// Samples in `capture.json`.
        samples: usize,
        /// The layers that there must be.
        expected: String,
    },
    /// The folder to write is in use for something else.
    #[error(
        "{} holds `{entry}`, which is no part of a capture, and so is not replaced: choose another folder",
        .dir.display()
    )]
    Occupied {
        /// The folder.
        dir: PathBuf,
        /// A file or folder in it.
        entry: String,
    },
    /// A picture of the capture could not be read or written.
    #[error(transparent)]
    Picture(#[from] PictureError),
}
