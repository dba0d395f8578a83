//! Kernels on a real driver, against what rustc makes of them.

use super::{Native, Text, World, colors};
use crate::random::forms::{FORMS, Form};
use glam::{UVec2, Vec4};
use std::fmt;
use straightline_codegen::{Kernel, Stage};
use straightline_kernels::prelude::Frame;
use straightline_study::execute::{Bench, Inputs};

/// Most that a driver may be off the native value where rounding shows, relative to its size (and to 1 below that): it
/// may round the sum of a product once instead of twice.
const TOLERANCE: f32 = 1.0e-3;

/// Most that all rounding may change a pixel that is compared, relative to its size: beyond, a decision hangs on it.
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
    /// Pixels that were compared.
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
    /// A pixel.
    Pixel {
        /// The form.
        form: Form,
        /// The pixel.
        pixel: [u32; 2],
        /// The native colour.
        expected: [f32; 4],
        /// The driver's.
        found: [f32; 4],
    },
    /// The shader cannot be made or run.
    Broken(Form, String),
}

impl fmt::Display for Off {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Off::Pixel {
                form,
                pixel,
                expected,
                found,
            } => write!(
                f,
                "pixel {pixel:?}: rustc gives {expected:?}, the driver with {form} {found:?}"
            ),
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

    /// Compares a kernel's pixels in some forms with the native ones.
    ///
    /// # Errors
    ///
    /// The first difference.
    pub fn compare(&self, text: &Text, world: &World, native: &Native, total: &mut Compared) -> Result<(), Off> {
        let kernel = Kernel::from_text("random.rs", &text.file(), "k");
        let inputs = inputs(world);
        for form in FORMS {
            let Ok(compiled) = kernel.compile(&form.settings()) else {
                total.refused += 1;
                continue;
            };
            let picture = match self.bench.run(&compiled, Stage::Compute, &inputs) {
                Ok(picture) => picture,
                Err(why) => return Err(Off::Broken(*form, why.to_string())),
            };
            let found = picture.texels().iter().map(|t| t.to_array());
            let mut exact: Option<Vec<[f64; 4]>> = None;
            for (k, ((pixel, expected), found)) in World::pixels().zip(native).zip(found).enumerate() {
                let expected = expected.map(|bits| bits.map(f32::from_bits));
                let Some(expected) = expected.filter(|c| c.iter().all(|x| x.is_finite() && !x.is_subnormal())) else {
                    total.unsure += 1;
                    continue;
                };
                // Shaders may lose the sign of a zero.
                if expected == found {
                    total.pixels += 1;
                    continue;
                }
                if exact.is_none() {
                    exact = Some(colors(&compiled, world).map_err(|why| Off::Broken(*form, why))?);
                }
                let exact = exact.as_ref().map_or([f64::NAN; 4], |exact| exact[k]);
                match Rounding::of(expected, exact, found) {
                    Rounding::Decides => total.unsure += 1,
                    Rounding::Shows => {
                        total.pixels += 1;
                        total.rounded += 1;
                    }
                    Rounding::No => {
                        return Err(Off::Pixel {
                            form: *form,
                            pixel,
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
    /// From a pixel's native value, what it is in `f64`, and the driver's value.
    fn of(expected: [f32; 4], exact: [f64; 4], found: [f32; 4]) -> Rounding {
        let mut all = Rounding::Shows;
        for ((expected, exact), found) in expected.into_iter().zip(exact).zip(found) {
            let (native, size) = (f64::from(expected), expected.abs().max(1.0));
            let sure = (native - exact).abs() <= SURE * f64::from(size);
            if !sure {
                return Rounding::Decides;
            }
            let off = expected != found;
            if off && (native == exact || (expected - found).abs() > TOLERANCE * size || found.is_nan()) {
                all = Rounding::No;
            }
        }
        all
    }
}

fn inputs(world: &World) -> Inputs {
    let texels = world.texels.iter().map(|t| Vec4::from_array(*t)).collect();
    let size = UVec2::from_array(super::world::SIZE);
    Inputs::new(size)
        .image("a", Frame::new(size, texels))
        .buffer(
            "b",
            world.buffer.iter().map(|x| [f64::from(*x), 0.0, 0.0, 0.0]).collect(),
        )
        .uniform("p", &[f64::from(world.p)])
        .uniform("q", &[f64::from(world.q)])
        .uniform("r", &[f64::from(world.r)])
}
