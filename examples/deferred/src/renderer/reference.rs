//! A picture of 256 samples a pixel, with which the choices are compared.

use super::passes::pipeline;
use super::targets::{all_layers, layer, texture};
use super::view::View;
use super::{CENTRE, Renderer};
use crate::Failure;
use crate::antialiasing::Antialiasing;
use glam::{Vec2, vec2};
use straightline_runtime::wgpu;
use wgpu::{TextureFormat, TextureUsages};

/// Format of the mean of all frames.
const MEAN: TextureFormat = TextureFormat::Rgba32Float;

/// Samples across a pixel.
const SIDE: u32 = 16;

/// Samples of a pixel that one frame has.
const AT_ONCE: u32 = 4;

impl Renderer {
    /// Draws the mean of 64 frames at `time`, each with four other samples a pixel.
    pub fn draw_reference(&mut self, time: f32, target: &wgpu::TextureView) -> Result<(), Failure> {
        let size = [target.texture().width(), target.texture().height()];
        self.prepare(size, Antialiasing::Supersampling)?;
        let view = View::new(size, time);
        let device = self.passes.device.clone();
        let shader = device.create_shader_module(wgpu::include_wgsl!("../scene.wgsl"));
        let accumulate = pipeline(&device, &shader, ["cover", "accumulate"], &[MEAN], false);
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        let [mut earlier, mut mean] = [0, 1].map(|_| layer(&texture(&device, size, MEAN, 1, usage), 0));
        for frame in 0..SIDE * SIDE / AT_ONCE {
            self.set_samples(
                &view,
                &std::array::from_fn(|k| place(frame * AT_ONCE + k as u32)),
                1.0 / (frame + 1) as f32,
            );
            let Renderer { queue, passes, targets, .. } = self;
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            for at in 0..AT_ONCE {
                passes.draw_geometry(&mut encoder, targets, at, None);
            }
            let [depth, normal, albedo] = targets.geometry.each_ref().map(all_layers);
            let uniforms = Some(&passes.uniforms[CENTRE as usize]);
            let seen = [&depth, &normal, &albedo];
            passes.cover(&mut encoder, &passes.shade_samples, (uniforms, &seen), &targets.shaded, None);
            let both = [&targets.shaded, &earlier];
            passes.cover(&mut encoder, &accumulate, (uniforms, &both), &mean, None);
            queue.submit([encoder.finish()]);
            (earlier, mean) = (mean, earlier);
        }
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.passes.cover(&mut encoder, &self.passes.present, (None, &[&earlier]), target, None);
        self.queue.submit([encoder.finish()]);
        Ok(())
    }
}

/// Position of a sample in a regular grid, from the pixel's centre in pixels.
fn place(sample: u32) -> Vec2 {
    (vec2((sample % SIDE) as f32, (sample / SIDE) as f32) + 0.5) / SIDE as f32 - 0.5
}
