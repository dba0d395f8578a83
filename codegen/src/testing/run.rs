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
    let (graph, schedule) = (&kernel.compiled.graph, &kernel.compiled.schedule);
    let given = kernel.buffers(cases);
    let interpreter = Interpreter::<R>::in_precision(graph, schedule, given.size, &bindings(&given.contents))
        .map_err(|error| RunnerError::Failed(error.to_string()))?;
    let mut scratch = interpreter.new_scratch();
    for k in 0..cases.len() as u32 {
        if Instant::now() > deadline {
            let what = format!("the interpreter ran out of time after {k} of {} cases", cases.len());
            return Err(RunnerError::Limit(what));
        }
        interpreter.run_invocation(k % given.size[0], k / given.size[0], &mut scratch);
        if scratch.is_endless() {
            return Err(RunnerError::Limit(format!(
                "a case has more than {MOST_ITERATIONS} iterations"
            )));
        }
    }
    let buffers = graph.buffers.iter().enumerate();
    let written = buffers.filter(|(_, buffer)| buffer.access != Access::Read);
    let contents = written.map(|(k, buffer)| (buffer.name.clone(), interpreter.buffer_contents(k, &scratch)));
    Ok(kernel.outcomes(&contents.collect::<Vec<_>>(), cases.len()))
}

/// Finds the first operation of a case whose results in `f32` and `f64` are far apart.
pub(super) fn divergence_of(kernel: &TestKernel, case: &Case) -> Option<Divergence> {
    let (graph, schedule) = (&kernel.compiled.graph, &kernel.compiled.schedule);
    let given = kernel.buffers(std::slice::from_ref(case));
    first_divergence(graph, schedule, given.size, &bindings(&given.contents), [0, 0]).ok()?
}

fn bindings<'a>(contents: &'a [(&'static str, Vec<[f64; 4]>)]) -> Bindings<'a> {
    let all = contents.iter();
    all.fold(Bindings::new(), |bindings, (name, values)| {
        bindings.buffer(name, values)
    })
}
