//! Errors of reading and writing pictures.

use glam::UVec2;
use std::io;
use std::path::PathBuf;

/// Reason why a picture could not be read or written. Each names the file, and the layer if there is one.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The operating system refused.
    #[error("cannot {action} {}: {source}{}", .path.display(), io_advice(.source.kind()))]
    Io {
        /// Operation that failed: `read`, `write`, ...
        action: &'static str,
        /// File or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// No format is known for the file's extension.
    #[error("{}: the extension decides the format, and must be .{}", .path.display(), super::EXTENSIONS.join(" or ."))]
    UnknownExtension {
        /// The file.
        path: PathBuf,
    },
    /// A format that this build does not know.
    #[error("{}: this build has no {format} files: build it with `--features {feature}`", .path.display())]
    NotBuilt {
        /// The file.
        path: PathBuf,
        /// Format of the file.
        format: &'static str,
        /// The feature of the crate that has them.
        feature: &'static str,
    },
    /// The contents are not, or no longer, those of a complete picture.
    #[error("{} is damaged, cut short or not {format} ({problem}): write or copy it again", .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Format that the file should have.
        format: &'static str,
        /// Problem that the decoder met.
        problem: String,
    },
    /// A sound file that is outside what can be used.
    #[error("{} cannot be used: {problem}", .path.display())]
    Unusable {
        /// The file.
        path: PathBuf,
        /// Description of the obstacle, and of a file that would do.
        problem: String,
    },
    /// An EXR file lacks a layer.
    #[error(
        "{} has no layer `{layer}` (it has {found}): write an EXR part of that name with {channels}",
        .path.display()
    )]
    MissingLayer {
        /// The file.
        path: PathBuf,
        /// The layer that is not there.
        layer: String,
        /// Channels that it should have.
        channels: String,
        /// The layers that are there.
        found: String,
    },
    /// An EXR layer lacks a channel.
    #[error(
        "{}: {layer} has no channel `{channel}` (the file has {found}): write it with {channels}",
        .path.display()
    )]
    MissingChannel {
        /// The file.
        path: PathBuf,
        /// The layer, in words.
        layer: String,
        /// The channel that is not there.
        channel: String,
        /// All channels that it should have.
        channels: String,
        /// The layers and channels that are there.
        found: String,
    },
    /// An EXR file has no colour.
    #[error(
        "{} holds no colour: no layer has channels R, G and B (it has {found}); write those, and optionally A",
        .path.display()
    )]
    NoColor {
        /// The file.
        path: PathBuf,
        /// The layers and channels that are there.
        found: String,
    },
    /// Two things that must be of one size are not.
    #[error(
        "{}: {layer} is {}×{} pixels, but {expected_by} says {}×{}: render all of them at one size",
        .path.display(), .found.x, .found.y, .expected.x, .expected.y
    )]
    Size {
        /// The file.
        path: PathBuf,
        /// The layer, in words.
        layer: String,
        /// Size of the layer.
        found: UVec2,
        /// The size that it must have.
        expected: UVec2,
        /// File or picture that states that size.
        expected_by: String,
    },
}

/// Help for the commonest refusals.
fn io_advice(kind: io::ErrorKind) -> &'static str {
    match kind {
        io::ErrorKind::NotFound => "; check the spelling, and that the folder exists",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "; choose a folder that you may write to"
        }
        io::ErrorKind::NotADirectory => "; a part of that path is a file, not a folder",
        io::ErrorKind::StorageFull => "; free some space or choose another disk",
        _ => "",
    }
}
