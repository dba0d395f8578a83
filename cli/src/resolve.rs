//! Resolving one frame with one compiled kernel, by whichever executor.

use crate::failure::Failure;
use crate::gpu::Gpu;
use glam::{UVec2, Vec3, Vec4};
use std::collections::BTreeSet;
use straightline_codegen::Compiled;
use straightline_codegen::emit::{Emitted, Target};
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_manifest::{Format, Stage};
use straightline_runtime::Pass;

/// The images of a frame.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    pub color: &'a Frame<Vec4>,
    pub depth: &'a FrameLayers<f32>,
    pub normal: Option<&'a FrameLayers<Vec3>>,
}

/// The images of a frame on the GPU, by the names that kernels call them.
pub struct Uploaded {
    views: Vec<(&'static str, wgpu::TextureView)>,
    pub size: UVec2,
}

impl Uploaded {
    /// Uploads a frame's images.
    pub fn new(gpu: &Gpu, inputs: &Inputs<'_>) -> Result<Uploaded, Failure> {
        let mut views = vec![("color", gpu.color(inputs.color)?), ("depth", gpu.depth(inputs.depth)?)];
        if let Some(normal) = inputs.normal {
            views.push(("normal", gpu.normal(normal)?));
        }
        Ok(Uploaded {
            views,
            size: inputs.color.size(),
        })
    }

    /// Those images that a pass reads.
    pub fn for_pass(&self, pass: &Pass) -> Vec<(&str, &wgpu::TextureView)> {
        let wanted: BTreeSet<&str> = pass.inputs().collect();
        self.views
            .iter()
            .filter(|(name, _)| wanted.contains(name))
            .map(|(name, view)| (*name, view))
            .collect()
    }
}

/// The WGSL of a kernel, writing full floats so that its own error is not hidden by rounding.
pub fn wgsl(compiled: &Compiled, stage: Stage) -> Result<(Emitted, String), Failure> {
    let emitted = compiled
        .emit(stage, Format::Rgba32Float, &BTreeSet::from([Target::Wgsl]))
        .map_err(Failure::of)?;
    let text = emitted.files.get(&Target::Wgsl).cloned().unwrap_or_default();
    let text = String::from_utf8(text).map_err(Failure::of)?;
    Ok((emitted, text))
}

/// A pass of a kernel on a device.
pub fn pass(gpu: &Gpu, compiled: &Compiled, stage: Stage) -> Result<Pass, Failure> {
    let (emitted, text) = wgsl(compiled, stage)?;
    Pass::new(&gpu.device, &emitted.manifest, &text).map_err(Failure::of)
}

/// Every pixel of a kernel, on the GPU.
pub fn on_gpu(gpu: &Gpu, compiled: &Compiled, stage: Stage, inputs: &Inputs<'_>) -> Result<Frame<Vec4>, Failure> {
    let pass = pass(gpu, compiled, stage)?;
    let uploaded = Uploaded::new(gpu, inputs)?;
    let target = gpu.target(uploaded.size, pass.target_format());
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    pass.encode(&mut encoder, &uploaded.for_pass(&pass), &view)
        .map_err(Failure::of)?;
    gpu.queue.submit([encoder.finish()]);
    gpu.download(&target)
}
