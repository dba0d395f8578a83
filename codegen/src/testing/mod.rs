//! Tests of a kernel's file, run as shaders.
//!
//! A `#[test]` in the file becomes a compute kernel whose invocations run one case each. [`TestFile`] finds the tests,
//! [`TestFile::compile`] makes the kernel of one, and [`check_test`] runs it: by the interpreter in `f32` and `f64`, and by
//! any other [`Runner`], such as a GPU. [`Coverage`] has what the tests execute. A test that draws a picture runs by [`interpret_picture`]; the caller compares it.
//!
//! ```
//! use straightline_codegen::testing::{Plan, TestFile, Verdict, check_test};
//!
//! let text = "
//!     pub fn weight(tau: f32) -> f32 { (-tau).exp() }
//!
//!     #[cfg(test)]
//!     mod tests {
//!         use super::*;
//!         use straightline_kernels::testing::*;
//!
//!         #[test]
//!         fn weights_are_finite() {
//!             for_all(|tau: f32| assert!(weight(tau).is_finite()));
//!         }
//!     }";
//! let file = TestFile::from_text("weight.rs", text)?;
//! let kernel = file.compile(&file.tests[0])?;
//! let Verdict::Failed(failure) = check_test(&kernel, &Plan::default(), None) else {
//!     panic!("exp(100) is not finite");
//! };
//! assert!(failure.errors.render(false).contains("`weight(tau)` is f32::INFINITY"));
//! # Ok::<(), straightline_codegen::diagnostic::Errors>(())
//! ```

mod buffers;
mod check;
mod coverage;
mod file;
mod outcome;
mod picture;
mod report;
mod run;
mod verdict;

pub use buffers::Buffers;
pub use check::{Plan, check_test, report_not_run};
pub use coverage::{Branch, Coverage, FileCoverage, cover_cases, cover_picture};
pub use file::{TestFile, TestKernel};
pub use outcome::{Outcome, Recording, Violation};
pub use picture::{Painted, interpret_picture, pixel_inputs, report_pixel};
pub use run::{Runner, RunnerError, interpret_cases};
pub use straightline_evaluator::front::testing::{ImageSource, Site, SiteKind, Test, TestImage, TestPicture};
pub use straightline_kernels::properties::{CASES, Case, SEED};
pub use verdict::{Failure, Passed, Verdict};
