//! Why methods could not be compared.

use crate::execute::ExecuteError;
use crate::gbuffer::GBufferError;
use crate::picture::PictureError;
use crate::render::RenderError;
use straightline_codegen::diagnostic::Errors;

/// Why methods could not be compared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum QualityError {
    /// It was told to stop; [`study`](super::study) makes of this a result that is not complete.
    #[error("stopped")]
    Stopped,
    /// A capture lacks what is needed.
    #[error("{0}")]
    Capture(String),
    /// A method was run on a picture that was not drawn for it: a mistake in this program.
    #[error("nothing was drawn for {0}")]
    NotDrawn(String),
    /// The scene could not be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A filter could not be run.
    #[error(transparent)]
    Execute(#[from] ExecuteError),
    /// A capture cannot feed a filter.
    #[error(transparent)]
    GBuffer(#[from] GBufferError),
    /// A kernel cannot be compiled.
    #[error("{0}")]
    Kernel(#[from] Errors),
    /// A picture could not be written.
    #[error(transparent)]
    Picture(#[from] PictureError),
}
