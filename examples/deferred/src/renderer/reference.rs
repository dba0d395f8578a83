//! A picture of 256 samples a pixel, with which the choices are compared.

use super::Renderer;
use super::passes::pipeline;
use super::targets::view;
use crate::Failure;
use crate::antialiasing::Antialiasing;
use straightline_sraa::wgpu;
use wgpu::TextureFormat;

/// Format of the mean of all frames.
const MEAN: TextureFormat = TextureFormat::Rgba32Float;

/// Samples across a pixel.
const SIDE: u32 = 16;

impl Renderer {
    /// Draws the mean of 256 frames at `time`, each of another sample of the pixels.
    pub fn draw_reference(&mut self, time: f32, target: &wgpu::TextureView) -> Result<(), Failure> {
        let size = [target.texture().width(), target.texture().height()];
        let camera = self.prepare(size, time, Antialiasing::None)?;
        let device = self.passes.device.clone();
        let shader = device.create_shader_module(wgpu::include_wgsl!("../scene.wgsl"));
        let accumulate = pipeline(&device, &shader, ["cover", "accumulate"], &[MEAN], None);
        let [mut earlier, mut mean] = [0, 1].map(|_| view(&device, size, MEAN, 1));
        for frame in 0..SIDE * SIDE {
            let matrix = camera.projection().matrix_at(place(frame), size);
            self.set_uniforms(&camera, matrix, 1.0 / (frame + 1) as f32);
            let Renderer { queue, passes, targets, sraa, .. } = self;
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            passes.draw_geometry(&mut encoder, sraa.centre(), &targets.albedo[1], None);
            let (uniforms, seen) = (Some(&passes.uniforms), super::seen(sraa, targets));
            passes.cover(&mut encoder, &passes.shade_centre, (uniforms, &seen[3..6]), &targets.shaded, None);
            let both = [(1, &targets.shaded), (2, &earlier)];
            passes.cover(&mut encoder, &accumulate, (uniforms, &both), &mean, None);
            queue.submit([encoder.finish()]);
            (earlier, mean) = (mean, earlier);
        }
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.passes.cover(&mut encoder, &self.passes.present, (None, &[(1, &earlier)]), target, None);
        self.queue.submit([encoder.finish()]);
        Ok(())
    }
}

/// Position of a sample in a regular grid, from the pixel's centre in pixels.
fn place(sample: u32) -> [f32; 2] {
    [sample % SIDE, sample / SIDE].map(|k| (k as f32 + 0.5) / SIDE as f32 - 0.5)
}
