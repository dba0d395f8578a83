//! Why there is no scene.

use std::path::PathBuf;

/// Why a model could not be read, or a scene not be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file's name does not tell what it is.
    #[error("{}: a model's file name ends with .{}", path.display(), super::EXTENSIONS.join(", ."))]
    UnknownExtension {
        /// The file.
        path: PathBuf,
    },
    /// This build reads no models.
    #[error("{}: this build reads no models: build it with `--features models`", path.display())]
    NotBuilt {
        /// The file.
        path: PathBuf,
    },
    /// There is no built-in scene of this name.
    #[error("there is no scene `{name}`; there are {}", super::NAMES.iter().chain(&super::FURTHER).map(|(name, _)| *name).collect::<Vec<_>>().join(", "))]
    UnknownName {
        /// The name.
        name: String,
    },
    /// The file, or one that it names, cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// The file is damaged, or uses what is not supported.
    #[error("{}: {problem}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Description of the error, with its place in the file.
        problem: String,
    },
    /// The file is well-formed and there is nothing to draw in it.
    #[error("{}: there are no triangles in it (points, lines and curves are not drawn)", path.display())]
    NoTriangles {
        /// The file.
        path: PathBuf,
    },
    /// No renderer could draw it.
    #[error("the scene cannot be drawn: {problem}")]
    Unusable {
        /// Description of the error, with its vertex, triangle or camera.
        problem: String,
    },
}
