//! Work in turn, with progress.

use crate::progress::Progress;
use straightline_bench::execute::{Bench, ExecuteError, Timed, Work};

/// Runs every work once a round, in turn, after a round that is not counted. A round is a step of `progress`, which may stop
/// the rounds.
///
/// # Errors
///
/// Errors of the work.
pub fn run_in_turn(
    bench: &Bench,
    works: &mut [Work<'_>],
    rounds: u32,
    progress: &mut dyn Progress,
) -> Result<Timed, ExecuteError> {
    bench.in_turn(works, rounds, |round| {
        if round > 0 {
            progress.step();
        }
        !progress.is_stopped()
    })
}
