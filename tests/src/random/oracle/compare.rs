//! Compares a kernel in every form with the result of rustc's program.

use super::works::Works;
use super::{Given, Place, Texel, Text, World, computed};
use crate::random::forms::{FORMS, PolicyForm, is_internal, same};
use std::collections::BTreeMap;
use std::fmt;
use straightline_codegen::diagnostic::{Code, Errors};
use straightline_codegen::{Kernel, OptionKind, Settings};

/// Difference between a form of a kernel and rustc's program.
#[derive(Clone, Debug, PartialEq)]
pub enum Difference {
    /// A value of a form is not the native one.
    Value {
        /// The form.
        form: PolicyForm,
        /// Position of the value.
        place: Place,
        /// The native value.
        expected: Texel,
        /// The interpreter's.
        found: Texel,
    },
    /// A form cannot be run, or gives another number of values.
    Broken(PolicyForm, String),
    /// The generator made a mistake and says so.
    Internal(PolicyForm, String),
    /// The generator or the interpreter panicked.
    Panicked(String),
}

impl Difference {
    /// Returns whether two are of one sort, so that the smaller text shows the same defect.
    pub fn like(&self, other: &Difference) -> bool {
        match (self, other) {
            (Difference::Value { form: a, .. }, Difference::Value { form: b, .. }) => a == b,
            (Difference::Broken(..), Difference::Broken(..)) => true,
            (Difference::Internal(..), Difference::Internal(..)) => true,
            (Difference::Panicked(a), Difference::Panicked(b)) => a == b,
            _ => false,
        }
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Difference::Value {
                form,
                place,
                expected,
                found,
            } => write!(f, "{place}: rustc gives {expected:?}, {form} gives {found:?}"),
            Difference::Internal(form, what) | Difference::Broken(form, what) => write!(f, "with {form}: {what}"),
            Difference::Panicked(what) => write!(f, "panicked: {what}"),
        }
    }
}

/// Number of times that a reason was given.
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

/// Outcomes of many kernels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Kernels that were compared in all forms.
    pub compared: u64,
    /// Texels of targets that were compared, over all forms.
    pub pixels: u64,
    /// Elements of buffers that were compared, of those that the native program has changed.
    pub written: u64,
    /// Values that were compared with an option overridden.
    pub overridden: u64,
    /// Pixels at which the native program panics, so that they are not compared.
    pub panics: u64,
    /// Pixels that are not a number in every component, so that they show little.
    pub empty: u64,
    /// Kernels that a form refuses, by the first error.
    pub refused: BTreeMap<String, Reason>,
    /// Texts that rustc refuses, by the error: mistakes of the maker.
    pub unusable: BTreeMap<String, Reason>,
    /// Work of compiling each kernel to each form.
    pub works: Works,
}

impl Tally {
    /// Adds another.
    pub fn add(&mut self, other: &Tally) {
        self.compared += other.compared;
        self.pixels += other.pixels;
        self.written += other.written;
        self.overridden += other.overridden;
        self.panics += other.panics;
        self.empty += other.empty;
        self.works.merge(&other.works);
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

/// Why a form gives nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotRun {
    /// The generator refuses the kernel.
    Refused(Errors),
    /// The interpreter cannot run it.
    Failed(String),
}

/// Runs a form of a kernel by the interpreter.
///
/// # Errors
///
/// The generator refuses it, or the interpreter cannot run it.
pub fn interpret(kernel: &Kernel, form: PolicyForm, world: &World) -> Result<Given, NotRun> {
    worked(kernel, &form.settings(), world).map(|(given, _)| given)
}

/// As [`interpret`], with the work of compiling the kernel.
fn worked(kernel: &Kernel, settings: &Settings, world: &World) -> Result<(Given, u64), NotRun> {
    let compiled = kernel.compile(settings).map_err(NotRun::Refused)?;
    let given = computed::<f32>(&compiled, world).map_err(NotRun::Failed)?;
    Ok((given, compiled.work))
}

/// Work of a kernel that is refused for its size.
const REFUSED: u64 = 20_000_000;

/// Returns whether an error says that a kernel exceeds a limit.
fn is_of_size(message: &str) -> bool {
    ["unrolls to more than", "takes more than"]
        .iter()
        .any(|part| message.contains(part))
}

/// Compares what every form gives with what the native program does; what was seen is added to the tally.
///
/// # Errors
///
/// The first difference.
pub fn compare(text: &Text, world: &World, native: &Given, tally: &mut Tally) -> Result<(), Difference> {
    let kernel = Kernel::from_text("random.rs", &text.file(), "k");
    for form in FORMS {
        let run = || worked(&kernel, &form.settings(), world);
        let found = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run));
        let found = match found.map_err(|panic| Difference::Panicked(said(&*panic)))? {
            Ok((found, work)) => {
                tally.works.add(text.source.len(), work, text.seed, form);
                found
            }
            Err(NotRun::Refused(errors)) => {
                let why = errors.first_message().to_owned();
                if is_internal(&errors) {
                    return Err(Difference::Internal(*form, why));
                }
                if is_of_size(&why) {
                    tally.works.add(text.source.len(), REFUSED, text.seed, form);
                }
                Reason::note(&mut tally.refused, why, 1, text.seed);
                return Ok(());
            }
            Err(NotRun::Failed(why)) => return Err(Difference::Broken(*form, why)),
        };
        for (place, expected, _) in equal_pairs(*form, native, &found, world)? {
            match place {
                Place::Pixel(..) => {
                    tally.pixels += 1;
                    tally.empty += u64::from(expected.iter().all(|x| x.is_nan()));
                }
                Place::Buffer(name, k) => tally.written += u64::from(!same(expected, world.initial(&name)[k])),
            }
        }
        tally.panics += native.pixels.iter().filter(|pixel| pixel.is_none()).count() as u64;
    }
    compare_overridden(&kernel, world, native, tally)?;
    tally.compared += 1;
    Ok(())
}

/// Compares forms in which options are overridden, at their defaults. Some kernels need an option as a constant.
fn compare_overridden(kernel: &Kernel, world: &World, native: &Given, tally: &mut Tally) -> Result<(), Difference> {
    let form = FORMS[1];
    for option in kernel.options().unwrap_or_default() {
        if !matches!(option.kind, OptionKind::Number(_) | OptionKind::Flag) {
            continue;
        }
        let settings = form.settings().override_options([option.name]);
        match worked(kernel, &settings, world) {
            Ok((found, _)) => tally.overridden += equal_pairs(form, native, &found, world)?.len() as u64,
            Err(NotRun::Refused(errors)) if errors.first_code() == Some(Code::CannotOverride) => {}
            Err(NotRun::Refused(errors)) => return Err(Difference::Internal(form, errors.to_string())),
            Err(NotRun::Failed(why)) => return Err(Difference::Broken(form, why)),
        }
    }
    Ok(())
}

/// Values of the native program with those of a form, which are the same.
fn equal_pairs(
    form: PolicyForm,
    native: &Given,
    found: &Given,
    world: &World,
) -> Result<Vec<(Place, Texel, Texel)>, Difference> {
    let pairs = native
        .pairs(found, world)
        .map_err(|why| Difference::Broken(form, why))?;
    match pairs.iter().find(|(_, expected, found)| !same(*expected, *found)) {
        Some((place, expected, found)) => Err(Difference::Value {
            form,
            place: place.clone(),
            expected: *expected,
            found: *found,
        }),
        None => Ok(pairs),
    }
}

fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or(panic.downcast_ref::<&str>().copied());
    text.unwrap_or("nothing").to_owned()
}
