//! Roads from a text to a driver.

use crate::edges_of_functions::kernels::Made;
use std::sync::Mutex;
use straightline_bench::execute::Bench;
use straightline_foreign::vulkan::{Device, Driver};
use straightline_kernels::prelude::*;
use straightline_runtime::PassOptions;
use straightline_tests::bare::{LANGUAGES, SENTINEL};

/// Name of the road that leads to no driver.
pub const INTERPRETER: &str = "interpreter";

/// A language on a driver.
pub struct Road {
    driver: Driver,
    way: Way,
}

#[expect(clippy::large_enum_variant, reason = "there are few roads")]
enum Way {
    /// WGSL through wgpu.
    Wgpu(Bench),
    /// A language of `LANGUAGES`, by the driver alone.
    Bare(usize, Mutex<Device>),
}

impl Road {
    /// All of them.
    pub fn all() -> Result<Vec<Road>, String> {
        let mut roads = Vec::new();
        for driver in Driver::ALL {
            let adapter = driver.adapter()?;
            let descriptor = wgpu::DeviceDescriptor {
                required_limits: wgpu::Limits {
                    max_color_attachment_bytes_per_sample: 64,
                    ..wgpu::Limits::default()
                },
                ..Default::default()
            };
            let device = pollster::block_on(adapter.request_device(&descriptor));
            let (device, queue) = device.map_err(|e| format!("{driver}: {e}"))?;
            let way = Way::Wgpu(Bench::new(&device, &queue, false));
            roads.push(Road { driver, way });
            for language in 0..LANGUAGES.len() {
                let way = Way::Bare(language, Mutex::new(Device::open(driver)?));
                roads.push(Road { driver, way });
            }
        }
        Ok(roads)
    }

    /// Runs a kernel: the picture of each target.
    pub fn run(&self, made: &Made<'_>) -> Result<Vec<Frame<Vec4>>, String> {
        match &self.way {
            Way::Wgpu(bench) => by_wgpu(bench, made),
            Way::Bare(language, device) => {
                let device = device.lock().map_err(|e| e.to_string())?;
                made.shaders[*language].run(&device, made.inputs)
            }
        }
    }
}

impl std::fmt::Display for Road {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.way {
            Way::Wgpu(_) => write!(f, "{} wgsl", self.driver),
            Way::Bare(language, _) => write!(f, "{} {}", self.driver, LANGUAGES[*language]),
        }
    }
}

/// Through wgpu, with targets that are cleared to the sentinel first.
fn by_wgpu(bench: &Bench, made: &Made<'_>) -> Result<Vec<Frame<Vec4>>, String> {
    let failed = |e: &dyn std::fmt::Display| e.to_string();
    let pass = bench
        .create_pass(&made.emitted, &PassOptions::default())
        .map_err(|e| failed(&e))?;
    let uploaded = bench
        .upload(&made.emitted.manifest, made.inputs)
        .map_err(|e| failed(&e))?;
    let mut encoder = bench
        .device()
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let size = made.inputs.size;
    let targets = pass
        .targets()
        .map(|(name, format)| (name, bench.create_target(size, format)));
    let targets: Vec<_> = targets.collect();
    let views: Vec<_> = targets
        .iter()
        .map(|(name, texture)| (*name, texture.create_view(&wgpu::TextureViewDescriptor::default())))
        .collect();
    for (_, view) in &views {
        let held = f64::from(f32::from_bits(SENTINEL));
        let color = wgpu::Color {
            r: held,
            g: held,
            b: held,
            a: held,
        };
        let attachment = wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(color),
                store: wgpu::StoreOp::Store,
            },
        };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(attachment)],
            ..Default::default()
        });
    }
    let bound: Vec<(&str, &wgpu::TextureView)> = views.iter().map(|(name, view)| (*name, view)).collect();
    let bound = uploaded.bind(&pass, bound.as_slice()).map_err(|e| failed(&e))?;
    bound.encode(&mut encoder);
    bench.queue().submit([encoder.finish()]);
    let pictures = targets
        .iter()
        .map(|(_, texture)| bench.download(texture).map_err(|e| failed(&e)));
    pictures.collect()
}
