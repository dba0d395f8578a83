//! One kernel in every form, against what rustc's program computes.

use super::{Native, Text, World};
use crate::random::forms::{FORMS, Form, is_internal, same};
use std::collections::BTreeMap;
use std::fmt;
use straightline_codegen::interp::Interpreter;
use straightline_codegen::ir::Real;
use straightline_codegen::{Compiled, Kernel};

/// How a kernel is not what rustc makes of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Difference {
    /// A pixel of a form is not the native one.
    Pixel {
        /// The form.
        form: Form,
        /// The pixel.
        pixel: [u32; 2],
        /// The native colour.
        expected: [f32; 4],
        /// The interpreter's.
        found: [f32; 4],
    },
    /// The generator made a mistake and says so.
    Internal(Form, String),
    /// The generator or the interpreter panicked.
    Panicked(String),
}

impl Difference {
    /// Whether two are of one sort, so that the smaller text shows the same defect.
    pub fn like(&self, other: &Difference) -> bool {
        match (self, other) {
            (Difference::Pixel { form: a, .. }, Difference::Pixel { form: b, .. }) => a == b,
            (Difference::Internal(..), Difference::Internal(..)) => true,
            (Difference::Panicked(a), Difference::Panicked(b)) => a == b,
            _ => false,
        }
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Difference::Pixel {
                form,
                pixel,
                expected,
                found,
            } => write!(f, "pixel {pixel:?}: rustc gives {expected:?}, {form} gives {found:?}"),
            Difference::Internal(form, what) => write!(f, "with {form}: {what}"),
            Difference::Panicked(what) => write!(f, "panicked: {what}"),
        }
    }
}

/// How often something was said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reason {
    /// Kernels of which it was said.
    pub kernels: u64,
    /// The seed of one of them.
    pub seed: u64,
}

impl Reason {
    fn note(all: &mut BTreeMap<String, Reason>, why: String, kernels: u64, seed: u64) {
        let reason = all.entry(why).or_default();
        reason.kernels += kernels;
        reason.seed = seed;
    }
}

/// What became of many kernels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Kernels that were compared in all forms.
    pub compared: u64,
    /// Pixels that were compared, over all forms.
    pub pixels: u64,
    /// Pixels at which the native program panics, so that they are not compared.
    pub panics: u64,
    /// Pixels that are not a number in every component, so that they show little.
    pub empty: u64,
    /// Kernels that a form refuses, by the first error.
    pub refused: BTreeMap<String, Reason>,
    /// Texts that rustc refuses, by the error: mistakes of the maker.
    pub unusable: BTreeMap<String, Reason>,
}

impl Tally {
    /// Adds another.
    pub fn add(&mut self, other: &Tally) {
        self.compared += other.compared;
        self.pixels += other.pixels;
        self.panics += other.panics;
        self.empty += other.empty;
        for (why, reason) in &other.refused {
            Reason::note(&mut self.refused, why.clone(), reason.kernels, reason.seed);
        }
        for (why, reason) in &other.unusable {
            Reason::note(&mut self.unusable, why.clone(), reason.kernels, reason.seed);
        }
    }

    /// Notes a text that rustc refuses.
    pub fn unusable(&mut self, why: String, seed: u64) {
        Reason::note(&mut self.unusable, why, 1, seed);
    }

    /// Kernels refused, all reasons together.
    pub fn refusals(&self) -> u64 {
        self.refused.values().map(|r| r.kernels).sum()
    }
}

/// The colours of all pixels, as bits.
///
/// # Errors
///
/// The first error of the generator.
pub fn interpret(kernel: &Kernel, form: Form, world: &World) -> Result<Vec<[u32; 4]>, String> {
    let compiled = kernel
        .compile(&form.settings())
        .map_err(|errors| errors.diagnostics[0].message.clone())?;
    let colors = colors::<f32>(&compiled, world)?;
    Ok(colors.into_iter().map(|color| color.map(f32::to_bits)).collect())
}

/// The colours of all pixels of a compiled kernel, in a precision.
///
/// # Errors
///
/// What the kernel reads is not bound.
pub fn colors<R: Real>(compiled: &Compiled, world: &World) -> Result<Vec<[R; 4]>, String> {
    let image = world.image();
    let bindings = world.bindings(&image);
    let interpreter = Interpreter::in_precision(&compiled.graph, &compiled.schedule, super::world::SIZE, &bindings);
    let interpreter = interpreter.map_err(|e| e.to_string())?;
    let mut scratch = interpreter.scratch();
    let pixel = |[x, y]: [u32; 2]| interpreter.pixel(x, y, &mut scratch);
    Ok(World::pixels().map(pixel).collect())
}

/// Compares every form with the native pixels; what was seen is added to the tally.
///
/// # Errors
///
/// The first difference.
pub fn compare(text: &Text, world: &World, native: &Native, tally: &mut Tally) -> Result<(), Difference> {
    let kernel = Kernel::from_text("random.rs", &text.file(), "k");
    for form in FORMS {
        let run = || interpret(&kernel, *form, world);
        let found = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run));
        let found = match found.map_err(|panic| Difference::Panicked(said(&*panic)))? {
            Ok(found) => found,
            Err(why) if is_internal(&why) => return Err(Difference::Internal(*form, why)),
            Err(why) => {
                Reason::note(&mut tally.refused, why, 1, text.seed);
                return Ok(());
            }
        };
        for ((pixel, expected), found) in World::pixels().zip(native).zip(found) {
            let Some(expected) = expected else {
                tally.panics += 1;
                continue;
            };
            let number = |bits: [u32; 4]| bits.map(f32::from_bits);
            let (expected, found) = (number(*expected), number(found));
            if !same(expected, found) {
                return Err(Difference::Pixel {
                    form: *form,
                    pixel,
                    expected,
                    found,
                });
            }
            tally.pixels += 1;
            tally.empty += u64::from(expected.iter().all(|x| x.is_nan()));
        }
    }
    tally.compared += 1;
    Ok(())
}

fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or(panic.downcast_ref::<&str>().copied());
    text.unwrap_or("nothing").to_owned()
}
