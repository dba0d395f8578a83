//! Running cases.

use super::file::TestKernel;
use super::outcome::Outcome;
use std::time::Instant;
use straightline_evaluator::interp::{Bindings, Divergence, Interpreter, MOST_ITERATIONS, first_divergence};
use straightline_evaluator::ir::{Access, Real};
use straightline_kernels::properties::Case;

/// Something that runs the kernel of a test.
pub trait Runner {
    /// Name for reports, such as that of a GPU.
    fn name(&self) -> String;

    /// Runs the cases.
    ///
    /// # Errors
    ///
    /// If the kernel cannot be run.
    fn run_cases(&mut self, kernel: &TestKernel, cases: &[Case]) -> Result<Vec<Outcome>, RunnerError>;
}

/// Reason why cases could not be run.
#[derive(Clone, Debug, thiserror::Error)]
pub enum RunnerError {
    /// The cases take too long.
    #[error("{0}")]
    Limit(String),
    /// The runner cannot run the kernel, or failed.
    #[error("{0}")]
    Failed(String),
}

/// Runs the cases by the interpreter, in the precision `R`, until `deadline`.
///
/// # Errors
///
/// If the deadline passes, or a case has too many iterations.
pub fn interpret_cases<R: Real>(
    kernel: &TestKernel,
    cases: &[Case],
    deadline: Instant,
) -> Result<Vec<Outcome>, RunnerError> {
    let contents = buffers_after::<R>(kernel, cases, deadline)?;
    Ok(kernel.outcomes(&contents, cases.len()))
}

/// Contents of the buffers that are written, by name, after the cases have run.
pub(super) fn buffers_after<R: Real>(
    kernel: &TestKernel,
    cases: &[Case],
    deadline: Instant,
) -> Result<Contents, RunnerError> {
    let given = kernel.buffers(cases);
    let bindings = bindings(&given.contents);
    let (contents, _) = run_frame::<R>(kernel, given.size, &bindings, cases.len(), deadline)?;
    Ok(contents)
}

/// Contents of buffers by name.
pub(super) type Contents = Vec<(String, Vec<[f64; 4]>)>;

/// Runs `count` invocations in the rows of a frame. Returns the buffers that they write, and their colours.
pub(super) fn run_frame<R: Real>(
    kernel: &TestKernel,
    size: [u32; 2],
    bindings: &Bindings<'_>,
    count: usize,
    deadline: Instant,
) -> Result<(Contents, Vec<[f32; 4]>), RunnerError> {
    let (graph, schedule) = (&kernel.compiled.graph, &kernel.compiled.schedule);
    let interpreter = Interpreter::<R>::in_precision(graph, schedule, size, bindings)
        .map_err(|error| RunnerError::Failed(error.to_string()))?;
    let mut scratch = interpreter.new_scratch();
    let mut texels = Vec::with_capacity(count);
    let noun = if kernel.test.picture.is_some() { "pixel" } else { "case" };
    for k in 0..count as u32 {
        if Instant::now() > deadline {
            let what = format!("the interpreter ran out of time after {k} of {count} {noun}s");
            return Err(RunnerError::Limit(what));
        }
        let values = interpreter.run_invocation(k % size[0], k / size[0], &mut scratch);
        if scratch.is_endless() {
            return Err(RunnerError::Limit(format!(
                "a {noun} has more than {MOST_ITERATIONS} iterations"
            )));
        }
        let texel = values
            .first()
            .map(|texel| texel.map(|component| component.to_f64() as f32));
        texels.push(texel.unwrap_or_default());
    }
    let buffers = graph.buffers.iter().enumerate();
    let written = buffers.filter(|(_, buffer)| buffer.access != Access::Read);
    let contents = written.map(|(k, buffer)| (buffer.name.clone(), interpreter.buffer_contents(k, &scratch)));
    Ok((contents.collect(), texels))
}

/// Finds the first operation of a case whose results in `f32` and `f64` are far apart.
pub(super) fn divergence_of(kernel: &TestKernel, case: &Case) -> Option<Divergence> {
    let (graph, schedule) = (&kernel.compiled.graph, &kernel.compiled.schedule);
    let given = kernel.buffers(std::slice::from_ref(case));
    first_divergence(graph, schedule, given.size, &bindings(&given.contents), [0, 0]).ok()?
}

pub(super) fn bindings<'a>(contents: &'a [(&'static str, Vec<[f64; 4]>)]) -> Bindings<'a> {
    let all = contents.iter();
    all.fold(Bindings::new(), |bindings, (name, values)| {
        bindings.buffer(name, values)
    })
}
