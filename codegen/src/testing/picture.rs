//! Pictures of tests: drawn by the interpreter, and reports of failures.

use super::buffers::Buffers;
use super::file::TestKernel;
use super::outcome::{Outcome, Violation};
use super::report::label_of;
use super::run::{Contents, RunnerError, bindings, run_frame};
use super::verdict::Failure;
use std::time::Instant;
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors};
use straightline_evaluator::front::testing::{FLOATS, STATE, TestPicture, WORDS};
use straightline_evaluator::interp::Image;
use straightline_evaluator::ir::Real;
use straightline_kernels::pictures::Drawn;

/// A picture with the outcomes of the assertions in it.
#[derive(Clone, Debug)]
pub struct Painted {
    /// The picture.
    pub drawn: Drawn,
    /// First assertion that fails, with its pixel.
    pub violation: Option<([u32; 2], Violation)>,
}

impl TestKernel {
    /// Buffers of a test that draws a picture, empty unless an assertion is in it.
    pub fn picture_buffers(&self, picture: &TestPicture) -> Buffers {
        let [width, height] = picture.size;
        let count = match self.compiled.graph.has_effects() {
            true => 2 * width as usize * height as usize,
            false => 2,
        };
        let zeros = |name| (name, vec![[0.0; 4]; count]);
        Buffers {
            size: picture.size,
            contents: [STATE, FLOATS, WORDS]
                .map(zeros)
                .into_iter()
                .chain(self.counts_buffer())
                .collect(),
        }
    }

    /// Reads what a run has drawn, and its buffers.
    pub fn read_painted(
        &self,
        picture: &TestPicture,
        texels: Vec<[f32; 4]>,
        buffers: &[(String, Vec<[f64; 4]>)],
    ) -> Painted {
        let outcomes = match self.compiled.graph.has_effects() {
            true => self.outcomes(buffers, texels.len()),
            false => Vec::new(),
        };
        let width = picture.size[0];
        let failed = outcomes.iter().zip(0..).find_map(|(outcome, k)| match outcome {
            Outcome::Failed(violation) => Some(([k % width, k / width], violation.clone())),
            _ => None,
        });
        Painted {
            drawn: Drawn {
                size: picture.size,
                texels,
            },
            violation: failed,
        }
    }
}

/// Draws the picture of a test by the interpreter, in the precision `R`, until `deadline`. `images` has the textures by name.
///
/// # Errors
///
/// If the deadline passes, a pixel has too many iterations, or a texture has not the size that the kernel takes.
pub fn interpret_picture<R: Real>(
    kernel: &TestKernel,
    picture: &TestPicture,
    images: &[(String, Drawn)],
    deadline: Instant,
) -> Result<Painted, RunnerError> {
    let (contents, texels) = run_picture::<R>(kernel, picture, images, deadline)?;
    Ok(kernel.read_painted(picture, texels, &contents))
}

/// Runs the kernel of a picture. Returns the buffers that it writes, and the texels.
pub(super) fn run_picture<R: Real>(
    kernel: &TestKernel,
    picture: &TestPicture,
    images: &[(String, Drawn)],
    deadline: Instant,
) -> Result<(Contents, Vec<[f32; 4]>), RunnerError> {
    let given = kernel.picture_buffers(picture);
    let texture =
        |(name, image): &(String, Drawn)| Some((name.clone(), Image::new(image.size, vec![image.texels.clone()])?));
    let textures: Vec<(String, Image)> = images.iter().filter_map(texture).collect();
    let mut bindings = bindings(&given.contents);
    for (name, image) in &textures {
        bindings = bindings.texture(name, image);
    }
    for (name, state) in &picture.samplers {
        bindings = bindings.sampler(name, *state);
    }
    let [width, height] = picture.size;
    run_frame::<R>(
        kernel,
        picture.size,
        &bindings,
        width as usize * height as usize,
        deadline,
    )
}

/// Reports an assertion that fails at a pixel.
pub fn report_pixel(kernel: &TestKernel, runner: &str, at: [u32; 2], violation: &Violation) -> Failure {
    let what = format!("`{}` fails by the {runner}", kernel.test.path);
    let site = kernel.sites.get(violation.site);
    let mut error = Diagnostic::error_at(Code::Assertion, site.map_or(kernel.test.span, |site| site.span), what);
    if let Some(site) = site {
        error = error.label(label_of(site, violation));
    }
    let inputs = pixel_inputs(at);
    let text = |side: usize| violation.values[side].as_ref().map(|value| value.text());
    error = error.note(format!("for this pixel:\n    {}", inputs.join("\n    ")));
    Failure {
        runner: Some(runner.to_owned()),
        inputs,
        values: [text(0), text(1)],
        ..Failure::from_errors(Errors::new(vec![error], &kernel.files))
    }
}

/// The statement that defines a pixel.
pub fn pixel_inputs([x, y]: [u32; 2]) -> Vec<String> {
    vec![format!("let pixel = ivec2({x}, {y});")]
}
