//! Random kernels on a real driver.

use super::ast::Program;
use super::check::{FORMS, Failure, Form, compile, pixels};
use super::eval::{Picture, evaluate};
use super::print::print;
use super::real::Noisy;
use glam::{UVec2, Vec4};
use straightline_codegen::Stage;
use straightline_kernels::prelude::Frame;
use straightline_study::execute::{Bench, Inputs};

/// Most that a sure pixel may be off, relative to its size (and to 1 below that).
const TOLERANCE: f32 = 1.0e-3;

/// Most that runs with errors of a GPU's size may be off each other for a pixel to be sure.
const SURE: f32 = 1.0e-4;

/// A device to run kernels on.
#[derive(Debug)]
pub struct Gpu {
    bench: Bench,
}

/// What was compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Compared {
    /// Pixels that were compared.
    pub pixels: usize,
    /// Pixels whose value hangs on the last bits, so that it proves nothing.
    pub unsure: usize,
    /// Forms in which the kernel could not be written, for a reason that is the kernel's.
    pub refused: usize,
}

/// What went wrong on the GPU.
#[derive(Clone, Debug, PartialEq)]
pub enum GpuFailure {
    /// Already wrong on the CPU.
    Cpu(Failure),
    /// The kernel cannot be emitted or run, though it can be interpreted.
    Broken(Form, String),
    /// A pixel is off.
    Off(Failure),
}

impl std::fmt::Display for GpuFailure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            GpuFailure::Cpu(failure) => write!(f, "on the CPU: {failure}"),
            GpuFailure::Off(failure) => write!(f, "on the GPU: {failure}"),
            GpuFailure::Broken(form, why) => write!(f, "with {form}: {why}"),
        }
    }
}

impl GpuFailure {
    /// Whether it is of the same sort as another.
    pub fn like(&self, other: &GpuFailure) -> bool {
        let first = |text: &str| text.split(':').next().unwrap_or_default().to_owned();
        match (self, other) {
            (GpuFailure::Cpu(a), GpuFailure::Cpu(b)) | (GpuFailure::Off(a), GpuFailure::Off(b)) => a.like(b),
            (GpuFailure::Broken(a, x), GpuFailure::Broken(b, y)) => a == b && first(x) == first(y),
            _ => false,
        }
    }
}

impl Gpu {
    /// The default adapter's device.
    ///
    /// # Errors
    ///
    /// There is no adapter: what to install.
    pub fn new() -> Result<Gpu, String> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
        let adapter =
            adapter.map_err(|e| format!("no GPU adapter; without a GPU install Debian's mesa-vulkan-drivers: {e}"))?;
        let device = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()));
        let (device, queue) =
            device.map_err(|e| format!("the adapter {} gives no device: {e}", adapter.get_info().name))?;
        Ok(Gpu {
            bench: Bench::new(&device, &queue, false),
        })
    }

    /// Compares a kernel's pixels, in every form, with the tree's.
    pub fn check(&self, program: &Program, picture: &Picture) -> Result<Compared, GpuFailure> {
        let mut compared = Compared::default();
        let expected = sure_pixels(program, picture).map_err(GpuFailure::Cpu)?;
        let text = print(program);
        for form in FORMS {
            let compiled = compile(&text, *form).map_err(|refusal| GpuFailure::Cpu(Failure::Refused(refusal)))?;
            let found = match self.bench.run(&compiled, Stage::Compute, &inputs(picture)) {
                Ok(frame) => frame,
                Err(why) => return Err(GpuFailure::Broken(*form, why.to_string())),
            };
            let found = found.texels().iter().map(|t| t.to_array());
            for ((pixel, expected), found) in pixels(picture).zip(&expected).zip(found) {
                let Some(expected) = expected else {
                    compared.unsure += 1;
                    continue;
                };
                compared.pixels += 1;
                if !near(*expected, found, TOLERANCE) {
                    return Err(GpuFailure::Off(Failure::Differs {
                        form: *form,
                        pixel,
                        expected: *expected,
                        found,
                    }));
                }
            }
        }
        Ok(compared)
    }
}

fn inputs(picture: &Picture) -> Inputs {
    let texels = picture.texels.iter().map(|t| Vec4::from_array(*t)).collect();
    let size = UVec2::from_array(picture.size);
    Inputs::new(size).image("a", Frame::new(size, texels))
}

/// The colour of each pixel on which runs with errors of a GPU's size agree, in value and in every decision.
fn sure_pixels(program: &Program, picture: &Picture) -> Result<Vec<Option<[f32; 4]>>, Failure> {
    let sure = |[x, y]: [u32; 2]| {
        let at = [x as i32, y as i32];
        let exact = evaluate::<f32>(program, picture, at)?;
        let mut sure = exact.color.iter().all(|lane| lane.is_finite());
        for seed in 1..=2 {
            Noisy::begin(seed);
            let noisy = evaluate::<Noisy>(program, picture, at)?;
            sure &= !Noisy::unsure() && noisy.decisions == exact.decisions && near(exact.color, noisy.color, SURE);
        }
        Ok(sure.then_some(exact.color))
    };
    let all: Result<Vec<_>, _> = pixels(picture).map(sure).collect();
    all.map_err(Failure::Invalid)
}

fn near(a: [f32; 4], b: [f32; 4], tolerance: f32) -> bool {
    a.iter()
        .zip(b)
        .all(|(x, y)| (x - y).abs() <= tolerance * x.abs().max(1.0))
}
