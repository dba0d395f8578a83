//! Pictures that the passes make, read back: timing needs none of them, but what is timed should be right.

use super::{FramePass, FramePasses, Samples};
use crate::render::gpu::{guarded, multisampled, read};
use crate::render::{MultisampledGeometry, RenderError};
use glam::{Vec3, Vec4};
use straightline_kernels::prelude::{Frame, FrameLayers};

impl FramePasses {
    /// The picture of deferred shading at every sample and its mean, as the passes make it.
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`].
    pub fn supersampled(&self, samples: Samples) -> Result<Frame<Vec4>, RenderError> {
        self.supersample(samples)?;
        self.picture()
    }

    /// The picture of forward rendering with four samples.
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`].
    pub fn forward(&self) -> Result<Frame<Vec4>, RenderError> {
        self.submit(&[FramePass::Forward])?;
        self.picture()
    }

    /// Depths, and normals rounded to halves, from a pass for each sample.
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`].
    pub fn auxiliary(&self, samples: Samples) -> Result<(FrameLayers<f32>, FrameLayers<Vec3>), RenderError> {
        self.submit(&[FramePass::Auxiliary(samples)])?;
        let size = self.renderer.size;
        let layer = |texture, sample| read::layer(&self.renderer.device, &self.renderer.queue, texture, sample);
        let (mut depths, mut normals) = (Vec::new(), Vec::new());
        for sample in 0..samples.count() {
            let depth = layer(&self.targets.auxiliary_depth, sample)?;
            let normal = layer(&self.targets.auxiliary_normal, sample)?;
            depths.push(Frame::new(size, depth.iter().map(|texel| texel.x).collect()));
            normals.push(Frame::new(size, normal.iter().map(|texel| texel.truncate()).collect()));
        }
        Ok((FrameLayers::new(depths), FrameLayers::new(normals)))
    }

    /// Reads depth and normal back at four samples from one multisampled pass.
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`].
    pub fn auxiliary_multisampled(&self) -> Result<MultisampledGeometry, RenderError> {
        self.submit(&[FramePass::AuxiliaryMultisampled])?;
        let multisampled: &multisampled::Multisampled = &self.targets.multisampled;
        Ok(multisampled.geometry(&self.renderer.device, &self.renderer.queue))
    }

    /// Draws and shades sample after sample, then makes their mean.
    pub(super) fn supersample(&self, samples: Samples) -> Result<(), RenderError> {
        self.recorded(|encoder| {
            for sample in 0..self.places[samples as usize].len() {
                self.encode_sample(FramePass::Geometry(samples), samples, sample, encoder, None);
                self.encode_sample(FramePass::Shading(samples), samples, sample, encoder, None);
            }
            self.encode(FramePass::Resolve(samples), encoder, &[]);
        })
    }

    pub(super) fn submit(&self, passes: &[FramePass]) -> Result<(), RenderError> {
        self.recorded(|encoder| passes.iter().for_each(|pass| self.encode(*pass, encoder, &[])))
    }

    fn recorded(&self, record: impl FnOnce(&mut wgpu::CommandEncoder)) -> Result<(), RenderError> {
        let renderer = &self.renderer;
        guarded(&renderer.device, "drawing a frame's passes", || {
            let descriptor = wgpu::CommandEncoderDescriptor::default();
            let mut encoder = renderer.device.create_command_encoder(&descriptor);
            record(&mut encoder);
            renderer.queue.submit([encoder.finish()]);
        })
    }

    fn picture(&self) -> Result<Frame<Vec4>, RenderError> {
        let renderer = &self.renderer;
        let texels = read::layer(&renderer.device, &renderer.queue, &self.targets.picture, 0)?;
        Ok(Frame::new(renderer.size, texels))
    }
}
