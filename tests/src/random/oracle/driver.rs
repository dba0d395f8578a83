//! Kernels on a real driver, against what rustc makes of them.

use super::{Given, Place, Texel, Text, World, computed};
use crate::random::forms::{FORMS, Form};
use std::fmt;
use straightline_codegen::{Kernel, Stage};
use straightline_testbed::execute::Bench;

/// Most that a driver may be off the native value where rounding shows, relative to its size (and to 1 below that): it
/// may round the sum of a product once instead of twice.
const TOLERANCE: f64 = 1.0e-3;

/// Most that all rounding may change a value that is compared, relative to its size: beyond, a decision hangs on it.
const SURE: f64 = 1.0e-4;

/// A device to run kernels on.
#[derive(Debug)]
pub struct Driver {
    bench: Bench,
    /// The adapter's name.
    pub name: String,
}

/// What was compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Compared {
    /// Kernels compared in every form.
    pub kernels: u64,
    /// Texels of targets, and elements of buffers, that were compared.
    pub pixels: u64,
    /// Those of them that are not the native ones bit for bit, but where rounding shows.
    pub rounded: u64,
    /// Pixels whose native value is not finite, or whose kernel panics there, so that shaders may do anything; and those
    /// that are off where a decision hangs on rounding.
    pub unsure: u64,
    /// Forms that are refused.
    pub refused: u64,
}

/// How a driver's picture is not the native one.
#[derive(Clone, Debug)]
pub enum Off {
    /// A value.
    Value {
        /// The form.
        form: Form,
        /// Where it lies.
        place: Place,
        /// The native value.
        expected: Texel,
        /// The driver's.
        found: Texel,
    },
    /// The shader cannot be made or run.
    Broken(Form, String),
}

impl Off {
    /// Whether two are of one sort, so that the smaller text shows the same defect.
    pub fn like(&self, other: &Off) -> bool {
        match (self, other) {
            (Off::Value { form: a, .. }, Off::Value { form: b, .. }) => a == b,
            (Off::Broken(a, _), Off::Broken(b, _)) => a == b,
            _ => false,
        }
    }
}

impl fmt::Display for Off {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Off::Value {
                form,
                place,
                expected,
                found,
            } => write!(f, "{place}: rustc gives {expected:?}, the driver with {form} {found:?}"),
            Off::Broken(form, why) => write!(f, "with {form}: {why}"),
        }
    }
}

impl Driver {
    /// The default adapter's device.
    ///
    /// # Errors
    ///
    /// There is no adapter: what to install.
    pub fn new() -> Result<Driver, String> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
        let adapter =
            adapter.map_err(|e| format!("no GPU adapter; without a GPU install Debian's mesa-vulkan-drivers: {e}"))?;
        let name = adapter.get_info().name;
        let device = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()));
        let (device, queue) = device.map_err(|e| format!("the adapter {name} gives no device: {e}"))?;
        Ok(Driver {
            bench: Bench::new(&device, &queue, false),
            name,
        })
    }

    /// Compares what a kernel gives in every form with what the native program does.
    ///
    /// # Errors
    ///
    /// The first difference.
    pub fn compare(&self, text: &Text, world: &World, native: &Given, total: &mut Compared) -> Result<(), Off> {
        let kernel = Kernel::from_text("random.rs", &text.file(), "k");
        let inputs = world.inputs();
        total.unsure += native.pixels.iter().filter(|pixel| pixel.is_none()).count() as u64;
        for form in FORMS {
            let broken = |why: String| Off::Broken(*form, why);
            let Ok(compiled) = kernel.compile(&form.settings()) else {
                total.refused += 1;
                continue;
            };
            // What is written under a condition that never holds is not in the shader, and one that does nothing is not run.
            if compiled.graph.targets.is_empty() && !compiled.graph.has_lasting_effects() {
                total.refused += 1;
                continue;
            }
            let run = self.bench.all_written(&compiled, Stage::Compute, &inputs);
            let (targets, buffers) = run.map_err(|why| broken(why.to_string()))?;
            let found = Given::of_run(&targets, buffers);
            let pairs = native.pairs(&found, world).map_err(broken)?;
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
                    let run = computed::<f64>(&compiled, world).map_err(broken)?;
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
                            form: *form,
                            place,
                            expected,
                            found,
                        });
                    }
                }
            }
        }
        total.kernels += 1;
        Ok(())
    }
}

/// Whether rounding explains that a driver's pixel is not the native one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rounding {
    /// A decision hangs on it, so that the pixel proves nothing.
    Decides,
    /// It does, in the last bits.
    Shows,
    /// It does not.
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
            let off = expected != found;
            if off && (expected == exact || (expected - found).abs() > TOLERANCE * size || found.is_nan()) {
                all = Rounding::No;
            }
        }
        all
    }
}
