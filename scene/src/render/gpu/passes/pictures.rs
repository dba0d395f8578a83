//! Pictures that the passes make, read back: timing needs none of them, but what is timed should be right.

use super::{FramePass, FramePasses, Samples};
use crate::render::gpu::{multisampled, read, with_error_scope};
use crate::render::{MultisampledGeometry, RenderError};
use glam::{Vec3, Vec4};
use straightline_kernels::prelude::{Frame, FrameLayers};

impl FramePasses {
    /// The picture of deferred shading at every sample and its mean, as the passes make it.
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`].
    pub fn draw_supersampled(&self, samples: Samples) -> Result<Frame<Vec4>, RenderError> {
        self.submit_supersampled(samples)?;
        self.read_picture()
    }

    /// The picture of forward rendering with four samples.
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`].
    pub fn draw_forward(&self) -> Result<Frame<Vec4>, RenderError> {
        self.submit(&[FramePass::Forward])?;
        self.read_picture()
    }

    /// Depths, and normals rounded to halves, from a pass for each sample.
    ///
    /// # Errors
    ///
    /// [`RenderError::Device`].
    pub fn draw_auxiliary(&self, samples: Samples) -> Result<(FrameLayers<f32>, FrameLayers<Vec3>), RenderError> {
        self.submit(&[FramePass::Auxiliary(samples)])?;
        let size = self.renderer.size;
        let layer = |texture, sample| read::read_layer(&self.renderer.device, &self.renderer.queue, texture, sample);
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
        Ok(multisampled.to_geometry(&self.renderer.device, &self.renderer.queue))
    }

    /// Draws and shades sample after sample, then makes their mean.
    pub(super) fn submit_supersampled(&self, samples: Samples) -> Result<(), RenderError> {
        self.submit_recorded(|encoder| {
            for sample in 0..self.places[samples as usize].len() {
                self.encode_sample(FramePass::Geometry(samples), samples, sample, encoder, None);
                self.encode_sample(FramePass::Shading(samples), samples, sample, encoder, None);
            }
            self.encode(FramePass::Resolve(samples), encoder, &[]);
        })
    }

    pub(super) fn submit(&self, passes: &[FramePass]) -> Result<(), RenderError> {
        self.submit_recorded(|encoder| passes.iter().for_each(|pass| self.encode(*pass, encoder, &[])))
    }

    fn submit_recorded(&self, record: impl FnOnce(&mut wgpu::CommandEncoder)) -> Result<(), RenderError> {
        let renderer = &self.renderer;
        with_error_scope(&renderer.device, "drawing a frame's passes", || {
            let descriptor = wgpu::CommandEncoderDescriptor::default();
            let mut encoder = renderer.device.create_command_encoder(&descriptor);
            record(&mut encoder);
            renderer.queue.submit([encoder.finish()]);
        })
    }

    fn read_picture(&self) -> Result<Frame<Vec4>, RenderError> {
        let renderer = &self.renderer;
        let texels = read::read_layer(&renderer.device, &renderer.queue, &self.targets.picture, 0)?;
        Ok(Frame::new(renderer.size, texels))
    }
}
