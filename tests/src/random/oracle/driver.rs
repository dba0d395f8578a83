//! Kernels on a real driver, against what rustc makes of them.

use super::{Given, Place, Texel, Text, World, computed};
use crate::random::forms::{FORMS, PolicyForm};
use crate::{compilers, passthrough};
use std::fmt;
use straightline_bench::execute::{AllWritten, Bench, Inputs};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, Kernel, Stage};
use straightline_runtime::manifest::Manifest;

/// Most that a driver may be off the native value where rounding shows, relative to its size (and to 1 below that): it
/// may round the sum of a product once instead of twice.
const TOLERANCE: f64 = 1.0e-3;

/// Most that all rounding may change a value that is compared, relative to its size: beyond, a decision hangs on it.
const SURE: f64 = 1.0e-4;

/// Most that a driver may be off where the native value is exact, in units of its last place: Vulkan has divisions and
/// square roots off by 2.5 of them.
const LAST_PLACES: f64 = 4.0;

impl Ways {
    /// The forms of the kernel of a seed.
    fn forms(self, seed: u64) -> &'static [PolicyForm] {
        let one = (seed % FORMS.len() as u64) as usize;
        match self {
            Ways::Forms => FORMS,
            Ways::Languages => &FORMS[one..=one],
        }
    }
}

/// Shaders of a kernel for a driver.
#[derive(Debug)]
pub struct Shaders {
    made: Vec<Shader>,
    /// Forms that are refused, or do nothing.
    refused: u64,
}

#[derive(Debug)]
struct Shader {
    form: PolicyForm,
    compiled: Compiled,
    /// As GLSL, if that is asked for and can be written.
    glsl: Option<Result<Glsl, String>>,
}

#[derive(Debug)]
struct Glsl {
    text: String,
    manifest: Manifest,
    /// Output of glslang.
    words: Result<Vec<u32>, String>,
}

/// A device to run kernels on.
#[derive(Debug)]
pub struct Driver {
    bench: Bench,
    /// The adapter's name.
    pub name: String,
}

/// A form, and the language that the driver is given it in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way(PolicyForm, Target);

/// Forms and languages that each kernel is emitted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ways {
    /// Every form, as WGSL.
    Forms,
    /// A form that depends on the seed, as WGSL and as GLSL.
    Languages,
}

/// Counts of comparisons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Compared {
    /// Kernels compared in every form.
    pub kernels: u64,
    /// Texels of targets, and elements of buffers, that were compared.
    pub pixels: u64,
    /// Number of them that differ from the native ones in bits, where rounding explains it.
    pub rounded: u64,
    /// Pixels whose native value is not finite, or whose kernel panics there, so that shaders may do anything; and those
    /// that are off where a decision hangs on rounding.
    pub unsure: u64,
    /// Forms that are refused.
    pub refused: u64,
}

impl Compared {
    /// Adds another.
    pub fn add(&mut self, other: &Compared) {
        self.kernels += other.kernels;
        self.pixels += other.pixels;
        self.rounded += other.rounded;
        self.unsure += other.unsure;
        self.refused += other.refused;
    }
}

/// Difference between a driver's picture and the native one.
#[derive(Clone, Debug)]
pub enum Off {
    /// A value.
    Value {
        /// The form and the language.
        way: Way,
        /// Position of the value.
        place: Place,
        /// The native value.
        expected: Texel,
        /// The driver's.
        found: Texel,
    },
    /// The shader cannot be made or run.
    Broken(Way, String),
}

impl Off {
    /// Returns whether two are of one sort, so that the smaller text shows the same defect.
    pub fn like(&self, other: &Off) -> bool {
        match (self, other) {
            (Off::Value { way: a, .. }, Off::Value { way: b, .. }) => a == b,
            (Off::Broken(a, _), Off::Broken(b, _)) => a == b,
            _ => false,
        }
    }
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, in {}", self.0, self.1)
    }
}

impl fmt::Display for Off {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Off::Value {
                way,
                place,
                expected,
                found,
            } => write!(f, "{place}: rustc gives {expected:?}, the driver with {way}, {found:?}"),
            Off::Broken(way, why) => write!(f, "with {way}: {why}"),
        }
    }
}

impl Driver {
    /// The device of a Vulkan adapter.
    ///
    /// # Errors
    ///
    /// There is no adapter: what to install.
    pub fn new() -> Result<Driver, String> {
        let bench = passthrough::bench()?;
        let name = bench.device().adapter_info().name;
        Ok(Driver { bench, name })
    }

    /// The shaders of kernels, those of each together.
    ///
    /// # Errors
    ///
    /// glslang cannot be run.
    pub fn shaders(&self, texts: &[Text], ways: Ways) -> Result<Vec<Shaders>, String> {
        let mut all: Vec<Shaders> = texts.iter().map(|text| self.emitted(text, ways)).collect();
        let glsl = || {
            all.iter()
                .flat_map(|shaders| &shaders.made)
                .filter_map(|shader| shader.glsl.as_ref())
        };
        let sources: Vec<&str> = glsl().flatten().map(|glsl| glsl.text.as_str()).collect();
        let mut words = compilers::compiled_glsl_all(&sources)?.into_iter();
        let shaders = all.iter_mut().flat_map(|shaders| &mut shaders.made);
        for glsl in shaders.filter_map(|shader| shader.glsl.as_mut()?.as_mut().ok()) {
            glsl.words = words.next().ok_or("glslang gives nothing")?;
        }
        Ok(all)
    }

    /// A kernel in every way that compiles and does something; GLSL is not compiled yet.
    fn emitted(&self, text: &Text, ways: Ways) -> Shaders {
        let kernel = Kernel::from_text("random.rs", &text.file(), "k");
        let forms = ways.forms(text.seed);
        let compiled = forms
            .iter()
            .filter_map(|form| Some((*form, kernel.compile(&form.settings()).ok()?)));
        // A write under a condition that never holds is not in the shader, and a shader that does nothing is not run.
        let compiled = compiled.filter(|(_, made)| !made.graph.targets.is_empty() || made.graph.has_lasting_effects());
        let made: Vec<Shader> = compiled
            .map(|(form, compiled)| Shader {
                glsl: (ways == Ways::Languages).then(|| self.glsl(&compiled)),
                compiled,
                form,
            })
            .collect();
        Shaders {
            refused: (forms.len() - made.len()) as u64,
            made,
        }
    }

    fn glsl(&self, compiled: &Compiled) -> Result<Glsl, String> {
        let options = self.bench.emit_options(Stage::Compute).targets([Target::Glsl450]);
        let emitted = compiled.emit(&options).map_err(|error| error.to_string())?;
        Ok(Glsl {
            text: String::from_utf8_lossy(&emitted.files[&Target::Glsl450]).into_owned(),
            manifest: emitted.manifest,
            words: Ok(Vec::new()),
        })
    }

    /// Compares what a kernel's shaders give with what the native program does.
    ///
    /// # Errors
    ///
    /// The first difference.
    pub fn compare(&self, shaders: &Shaders, world: &World, native: &Given, total: &mut Compared) -> Result<(), Off> {
        let inputs = world.inputs();
        for shader in &shaders.made {
            let judged = |language: Target, run: Result<AllWritten, String>, total: &mut Compared| {
                let way = Way(shader.form, language);
                let (targets, buffers) = run.map_err(|why| Off::Broken(way, why))?;
                judge(
                    way,
                    &shader.compiled,
                    world,
                    native,
                    &Given::of_run(&shader.compiled, &targets, buffers),
                    total,
                )
            };
            let run = self.bench.all_written(&shader.compiled, Stage::Compute, &inputs);
            judged(Target::Wgsl, run.map_err(|why| why.to_string()), total)?;
            if let Some(glsl) = &shader.glsl {
                judged(Target::Glsl450, self.run(glsl, &inputs), total)?;
            }
        }
        total.refused += shaders.refused;
        total.unsure += native.pixels.iter().filter(|pixel| pixel.is_none()).count() as u64;
        total.kernels += u64::from(!shaders.made.is_empty());
        Ok(())
    }

    fn run(&self, glsl: &Result<Glsl, String>, inputs: &Inputs) -> Result<AllWritten, String> {
        let glsl = glsl.as_ref().map_err(Clone::clone)?;
        let words = glsl.words.as_ref().map_err(Clone::clone)?;
        passthrough::written(&self.bench, glsl.manifest.clone(), Target::Glsl450, words, inputs)
    }
}

/// Compares what a driver gives with what the native program does.
fn judge(
    way: Way,
    compiled: &Compiled,
    world: &World,
    native: &Given,
    found: &Given,
    total: &mut Compared,
) -> Result<(), Off> {
    let broken = |why: String| Off::Broken(way, why);
    let pairs = native.pairs(found, world).map_err(broken)?;
    let mut exact: Option<Vec<Texel>> = None;
    for (k, (place, expected, found)) in pairs.into_iter().enumerate() {
        let number = |x: &f64| x.is_finite() && !(*x as f32).is_subnormal();
        if !expected.iter().all(number) {
            total.unsure += 1;
            continue;
        }
        // Shaders may lose the sign of a zero.
        if expected == found {
            total.pixels += 1;
            continue;
        }
        if exact.is_none() {
            let run = computed::<f64>(compiled, world).map_err(broken)?;
            let pairs = native.pairs(&run, world).map_err(broken)?;
            exact = Some(pairs.into_iter().map(|(_, _, exact)| exact).collect());
        }
        let exact = exact.as_ref().map_or([f64::NAN; 4], |exact| exact[k]);
        match Rounding::of(expected, exact, found) {
            Rounding::Decides => total.unsure += 1,
            Rounding::Shows => {
                total.pixels += 1;
                total.rounded += 1;
            }
            Rounding::No => {
                return Err(Off::Value {
                    way,
                    place,
                    expected,
                    found,
                });
            }
        }
    }
    Ok(())
}

/// Role of rounding in a difference between a driver's pixel and the native one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rounding {
    /// A decision hangs on it, so that the pixel proves nothing.
    Decides,
    /// Explains the difference, in the last bits.
    Shows,
    /// Does not explain it.
    No,
}

impl Rounding {
    /// From a native value, what it is in `f64`, and the driver's value.
    fn of(expected: Texel, exact: Texel, found: Texel) -> Rounding {
        let mut all = Rounding::Shows;
        for ((expected, exact), found) in expected.into_iter().zip(exact).zip(found) {
            let size = expected.abs().max(1.0);
            let sure = (expected - exact).abs() <= SURE * size;
            if !sure {
                return Rounding::Decides;
            }
            let most = match expected == exact {
                true => LAST_PLACES * last_place(expected),
                false => TOLERANCE * size,
            };
            if (expected - found).abs() > most || found.is_nan() {
                all = Rounding::No;
            }
        }
        all
    }
}

/// The distance from a value to the next one in `f32`.
fn last_place(x: f64) -> f64 {
    let x = (x.abs() as f32).max(f32::MIN_POSITIVE);
    f64::from(x.next_up()) - f64::from(x)
}
