//! Kernels on a real driver, against what rustc makes of them.

use super::{Native, Text, World};
use crate::random::check::{FORMS, Form};
use glam::{UVec2, Vec4};
use std::fmt;
use straightline_codegen::{Kernel, Settings, Stage};
use straightline_kernels::prelude::Frame;
use straightline_study::execute::{Bench, Inputs};

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
    /// Pixels whose native value is not finite, or whose kernel panics there: shaders may do anything.
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
            let settings = Settings {
                unroll: form.0,
                branches: form.1,
                ..Default::default()
            };
            let Ok(compiled) = kernel.compile(&settings) else {
                total.refused += 1;
                continue;
            };
            let picture = match self.bench.run(&compiled, Stage::Compute, &inputs) {
                Ok(picture) => picture,
                Err(why) => return Err(Off::Broken(*form, why.to_string())),
            };
            let found = picture.texels().iter().map(|t| t.to_array());
            for ((pixel, expected), found) in World::pixels().zip(native).zip(found) {
                let expected = expected.map(|bits| bits.map(f32::from_bits));
                let Some(expected) = expected.filter(|c| c.iter().all(|x| x.is_finite() && !x.is_subnormal())) else {
                    total.unsure += 1;
                    continue;
                };
                total.pixels += 1;
                // Shaders may lose the sign of a zero, and nothing else.
                if expected != found {
                    return Err(Off::Pixel {
                        form: *form,
                        pixel,
                        expected,
                        found,
                    });
                }
            }
        }
        total.kernels += 1;
        Ok(())
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
