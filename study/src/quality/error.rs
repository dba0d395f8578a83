//! Reasons why methods could not be compared.

use straightline_bench::execute::ExecuteError;
use straightline_codegen::diagnostic::Errors;
use straightline_scene::gbuffer::GBufferError;
use straightline_scene::picture::PictureError;
use straightline_scene::render::RenderError;

/// Reason why methods could not be compared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum QualityError {
    /// The study was stopped; [`study_quality`](super::study_quality) turns this into an incomplete result.
    #[error("stopped")]
    Stopped,
    /// A capture lacks an input.
    #[error("{0}")]
    Capture(String),
    /// A method was run on a picture that was not drawn for it: a bug of this program.
    #[error("nothing was drawn for {0}")]
    NotDrawn(String),
    /// A scene in motion is seen by a camera with parallel rays.
    #[error("motion is known of perspective cameras only: choose a scene other than `isometric`")]
    ParallelMotion,
    /// A method was requested in motion that does not support consecutive frames.
    #[error("`{0}` is not compared in motion: 1x, SRAA that shades once a pixel, and supersampling are")]
    NotInMotion(String),
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
