//! rustc as the oracle: kernels are compiled natively in batches and compared with the interpreter, bit for bit.

mod batch;
pub mod chains;
mod change;
mod compare;
pub mod coverage;
mod driver;
mod given;
mod interface;
mod reduce;
mod rustc;
pub mod same;
pub mod works;
mod world;

pub use batch::run;
pub use change::{Lenient, Verdicts, judge_changed};
pub use compare::{Difference, Reason, Tally, compare, interpret};
pub use driver::{Compared, Driver, Off, Ways};
pub use given::{Given, Place, Texel, computed};
pub use reduce::{reduce, reduce_on_driver};
pub use rustc::{Rustc, Verdict};
pub use world::World;

use super::make::{Features, make};

use std::fmt;

/// A kernel as text: everything that one file holds. The kernel is the function `k`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// The seed that it was made from, or any number that tells it from others.
    pub seed: u64,
    /// The text, without the `use` of the prelude.
    pub source: String,
}

impl Text {
    /// The text as a file of its own, which `straightline emit` takes.
    pub fn file(&self) -> String {
        format!("use straightline_kernels::prelude::*;\n\n{}", self.source)
    }
}

/// A kernel that is not what rustc makes of it.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The kernel.
    pub text: Text,
    /// The seed of the inputs.
    pub world: u64,
    /// Difference from the native result.
    pub difference: Difference,
}

/// Makes kernels of seeds, and compares all of them with what rustc makes of them.
///
/// # Errors
///
/// rustc cannot be run.
pub fn batch(rustc: &Rustc, seeds: std::ops::Range<u64>, features: Features) -> Result<(Tally, Vec<Failure>), String> {
    let world = seeds.start;
    let texts: Vec<Text> = seeds.map(|seed| make(seed, features)).collect();
    check(rustc, &texts, world)
}

/// Compares kernels with what rustc makes of them, on the inputs of a seed.
///
/// # Errors
///
/// rustc cannot be run.
pub fn check(rustc: &Rustc, texts: &[Text], world: u64) -> Result<(Tally, Vec<Failure>), String> {
    let inputs = World::new(world);
    let natives = run(rustc, texts, &inputs)?;
    let (mut tally, mut failures) = (Tally::default(), Vec::new());
    for (text, native) in texts.iter().zip(natives) {
        match native {
            Ok(native) => {
                if let Err(difference) = compare(text, &inputs, &native, &mut tally) {
                    failures.push(Failure {
                        text: text.clone(),
                        world,
                        difference,
                    });
                }
            }
            Err(why) => tally.unusable(why, text.seed),
        }
    }
    Ok((tally, failures))
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "// seed {}\n{}", self.seed, self.source)
    }
}
