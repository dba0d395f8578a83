//! A frame's passes one by one, in each way that antialiases it, so that what each costs can be timed.

mod pictures;
mod resources;

use super::GpuRenderer;
use super::drawing::{ColorTarget, Drawing, full_view};
use super::pipelines::WORKGROUP;
use crate::render::RenderError;
use crate::scene::Scene;
use glam::{UVec2, Vec2};
use resources::{Forward, Mean, Place, Targets};
use wgpu::CommandEncoder;

/// Number and places of a pass's samples of each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Samples {
    /// A single sample, in the pixel's centre.
    One,
    /// Three: those of the four but the first. Where shading is at the first, the main G-buffer has it.
    Three,
    /// Four: the pattern `latin4`.
    Four,
    /// Sixteen: the pattern `latin16`.
    Sixteen,
}

impl Samples {
    /// All, from the fewest.
    pub const ALL: [Samples; 4] = [Samples::One, Samples::Three, Samples::Four, Samples::Sixteen];

    /// Returns the number of samples.
    pub fn count(self) -> u32 {
        match self {
            Samples::One => 1,
            Samples::Three => 3,
            Samples::Four => 4,
            Samples::Sixteen => 16,
        }
    }

    /// Returns the places of the samples: in pixels from the pixel's centre, y down.
    pub fn offsets(self) -> Vec<Vec2> {
        match self {
            Samples::One => vec![Vec2::ZERO],
            Samples::Three => Samples::Four.offsets().into_iter().skip(1).collect(),
            Samples::Four => crate::gbuffer::pattern_offsets("latin4").unwrap_or_default(),
            Samples::Sixteen => crate::gbuffer::pattern_offsets("latin16").unwrap_or_default(),
        }
    }
}

/// A part of drawing a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FramePass {
    /// The renderer's own G-buffer (normal, depth, colour and material in full floats), drawn once for each sample.
    Geometry(Samples),
    /// Depth and normal alone, drawn once for each sample: what SRAA reads.
    Auxiliary(Samples),
    /// Depth and normal alone at four samples, drawn once, multisampled.
    AuxiliaryMultisampled,
    /// Deferred shading of the G-buffer, once for each sample, to halves.
    Shading(Samples),
    /// The mean of the shaded samples: the box filter of supersampling.
    Resolve(Samples),
    /// Geometry and shading in one pass with four samples, shaded once for each pixel of a triangle, and their mean: forward
    /// rendering with multisampling.
    Forward,
}

impl FramePass {
    /// Passes of wgpu that it records.
    pub fn pass_count(self) -> u32 {
        match self {
            FramePass::Geometry(samples) | FramePass::Auxiliary(samples) | FramePass::Shading(samples) => {
                samples.count()
            }
            FramePass::AuxiliaryMultisampled | FramePass::Resolve(_) | FramePass::Forward => 1,
        }
    }
}

/// Timestamps that a pass writes where it begins and ends.
#[derive(Clone, Debug)]
pub struct Timestamps {
    /// The queries that they are written to.
    pub queries: wgpu::QuerySet,
    /// Index of the query at the pass's begin.
    pub begin: Option<u32>,
    /// Index of the query at its end.
    pub end: Option<u32>,
}

impl Timestamps {
    fn render_writes(&self) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: self.begin,
            end_of_pass_write_index: self.end,
        }
    }

    fn compute_writes(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: self.begin,
            end_of_pass_write_index: self.end,
        }
    }
}

/// Records the passes of frames of one scene at one size.
#[derive(Debug)]
pub struct FramePasses {
    renderer: GpuRenderer,
    /// For each of [`Samples::ALL`].
    places: [Vec<Place>; 4],
    means: [Mean; 4],
    targets: Targets,
    forward: Forward,
}

impl FramePasses {
    /// Passes that draw `scene` in pictures of `size` pixels on `device`, to which `queue` belongs. Each sample is shaded as the
    /// mean of `evaluations`, at least one, at places of their own in its pixel: so much dearer shading is.
    ///
    /// All of them are recorded once, so that what a device cannot do is known.
    ///
    /// # Errors
    ///
    /// As [`GpuRenderer::new`].
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        size: UVec2,
        evaluations: u32,
    ) -> Result<Self, RenderError> {
        let renderer = GpuRenderer::new(device, queue, scene, size)?;
        let passes = super::with_error_scope(device, "making a frame's passes", || {
            resources::create_passes(renderer, scene, evaluations.max(1))
        })?;
        for samples in Samples::ALL {
            passes.submit_supersampled(samples)?;
            passes.submit(&[FramePass::Auxiliary(samples)])?;
        }
        passes.submit(&[FramePass::AuxiliaryMultisampled, FramePass::Forward])?;
        Ok(passes)
    }

    /// Records a pass; `timestamps` has one entry for each of its [passes](FramePass::pass_count), or none if they are not timed.
    ///
    /// Shading reads the G-buffer that was drawn last, and [`FramePass::Resolve`] what was shaded last.
    pub fn encode(&self, pass: FramePass, encoder: &mut CommandEncoder, timestamps: &[Timestamps]) {
        let first = timestamps.first();
        match pass {
            FramePass::Geometry(samples) | FramePass::Auxiliary(samples) | FramePass::Shading(samples) => {
                for sample in 0..self.places[samples as usize].len() {
                    self.encode_sample(pass, samples, sample, encoder, timestamps.get(sample));
                }
            }
            FramePass::AuxiliaryMultisampled => {
                let writes = first.map(Timestamps::render_writes);
                let group = &self.places[Samples::One as usize][0].geometry;
                self.targets
                    .multisampled
                    .record_draw(encoder, &self.renderer.resources, group, writes);
            }
            FramePass::Resolve(samples) => {
                let mean = &self.means[samples as usize];
                self.dispatch("straightline mean", &mean.pipeline, &mean.group, encoder, first);
            }
            FramePass::Forward => self.encode_forward(encoder, first),
        }
    }

    /// Encodes one sample of a pass that has several.
    fn encode_sample(
        &self,
        pass: FramePass,
        samples: Samples,
        sample: usize,
        encoder: &mut CommandEncoder,
        timestamps: Option<&Timestamps>,
    ) {
        let place = &self.places[samples as usize][sample];
        let GpuRenderer {
            pipelines, resources, ..
        } = &self.renderer;
        if let FramePass::Shading(_) = pass {
            let label = "straightline deferred shading";
            return self.dispatch(label, &self.targets.deferred, &place.shading, encoder, timestamps);
        }
        let timestamps = timestamps.map(Timestamps::render_writes);
        if let FramePass::Geometry(_) = pass {
            pipelines.record_draw(encoder, resources, &place.geometry, timestamps);
            return;
        }
        let tested = full_view(&resources.depth);
        let [depth, normal] = &self.targets.auxiliary_views[sample];
        let drawing = Drawing {
            label: "straightline auxiliary geometry",
            pipeline: &self.targets.auxiliary,
            group: &place.geometry,
            targets: &[
                ColorTarget::cleared(depth, super::multisampled::SKY_AT),
                ColorTarget::cleared(normal, super::multisampled::SKY_FACING),
            ],
            tested: &tested,
            behind: None,
            timestamps,
        };
        drawing.record(encoder, resources);
    }

    fn encode_forward(&self, encoder: &mut CommandEncoder, timestamps: Option<&Timestamps>) {
        let forward = &self.forward;
        let [color, tested, picture] = [&forward.color, &forward.tested, &self.targets.picture].map(full_view);
        let drawing = Drawing {
            label: "straightline forward",
            pipeline: &forward.surfaces,
            group: &forward.group,
            targets: &[ColorTarget::cleared(&color, wgpu::Color::TRANSPARENT).resolved(&picture)],
            tested: &tested,
            behind: Some(&forward.sky),
            timestamps: timestamps.map(Timestamps::render_writes),
        };
        drawing.record(encoder, &self.renderer.resources);
    }

    /// Runs `pipeline` for every pixel.
    fn dispatch(
        &self,
        label: &'static str,
        pipeline: &wgpu::ComputePipeline,
        group: &wgpu::BindGroup,
        encoder: &mut CommandEncoder,
        timestamps: Option<&Timestamps>,
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(label),
            timestamp_writes: timestamps.map(Timestamps::compute_writes),
        });
        let size = self.renderer.size;
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(size.x.div_ceil(WORKGROUP), size.y.div_ceil(WORKGROUP), 1);
    }
}
