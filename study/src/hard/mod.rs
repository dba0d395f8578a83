//! Numerical stability: named cases that are hard to compute, kernels in several options, precisions and executors.
//!
//! [`run_cases`] computes every form of a kernel ([`KernelForm`]) in every case ([`Case`]) that it is for: by the interpreter, by
//! the interpreter with subnormal numbers flushed, by the interpreter as inexact as WGSL allows, and by the shader that is
//! emitted; in `f32` and in `f16`. Each result is compared with the definition in `f64` ([`straightline_oracle::oracle`])
//! and held to a bound that follows from an error analysis of the case's inputs ([`straightline_oracle::oracle::bound`]).
//!
//! In `f16` no such bound is useful, because it grows beyond what can be seen as soon as depths are compared; there each
//! result is held to what can be seen, and [`half_precision_verdict`] says which kernels may compute in it.

mod case;
mod cases;
mod expected;
mod form;
mod inputs;
mod judge;
mod reals;
mod run;
mod verdict;

pub use case::{Case, Normal, Place, Seen};
pub use form::{Family, KernelForm, PAPER};
pub use reals::{Flushed, Loose};
pub use run::{Selection, judged_as, run_cases};
pub use verdict::half_precision_verdict;

use straightline_bench::execute::ExecuteError;
use straightline_codegen::diagnostic::Errors;
use straightline_oracle::oracle::OracleError;

/// Returns every case.
pub fn all_cases() -> Vec<Case> {
    cases::all_cases()
}

/// Returns the case of a name.
///
/// # Errors
///
/// [`HardError::UnknownCase`].
pub fn find_case(name: &str) -> Result<Case, HardError> {
    all_cases()
        .into_iter()
        .find(|case| case.name == name)
        .ok_or_else(|| HardError::UnknownCase(name.to_owned()))
}

/// Reason why hard cases could not be run.
#[derive(Debug, thiserror::Error)]
pub enum HardError {
    /// There is no such case.
    #[error("there is no hard case `{0}`; `straightline study hard --list` names all of them")]
    UnknownCase(String),
    /// The kernel is not among those that are studied.
    #[error(
        "`{0}` has no hard cases that show half precision: they are there for sraa, the edge filters and the filters of quads, but not \
         for quad_ssao and bilinear taps, whose pictures would have to be larger"
    )]
    NotStudied(String),
    /// A kernel does not compile.
    #[error("{form}: {errors}")]
    Kernel {
        /// Name of the form.
        form: String,
        /// Errors of the kernel.
        errors: Errors,
    },
    /// A kernel could not be run.
    #[error("{form} on `{case}`: {source}")]
    Execute {
        /// Name of the form.
        form: String,
        /// Name of the case.
        case: String,
        /// Cause of the failure.
        source: Box<ExecuteError>,
    },
    /// The definition cannot be evaluated.
    #[error(transparent)]
    Oracle(#[from] OracleError),
}
