//! A frame: geometry, once for each sample of a pixel that it needs; shading; SRAA, a part of which goes before shading; and
//! presenting.

mod filter;
mod passes;
#[cfg(not(target_arch = "wasm32"))]
mod reference;
mod targets;
mod view;

use crate::antialiasing::Antialiasing;
use crate::clock::{Clock, Part};
use crate::{Failure, Size};
use filter::{Filter, Kernels};
use glam::{Vec2, vec2};
use passes::{Passes, bytes};
use straightline_runtime::{Bound, wgpu};
use targets::{LAYERS, Targets, all_layers};
use view::View;
use web_time::Instant;
use wgpu::TextureFormat;

/// Positions of the geometry samples, from the pixel's centre in pixels, y down: the kernel's pattern `latin4`.
const SAMPLES: [Vec2; 4] = [vec2(-0.125, -0.375), vec2(0.375, -0.125), vec2(-0.375, 0.125), vec2(0.125, 0.375)];

/// Layer of the G-buffer for the pixel's centre.
const CENTRE: u32 = LAYERS - 1;

/// Passes, and the textures between them.
pub struct Renderer {
    queue: wgpu::Queue,
    passes: Passes,
    kernels: Kernels,
    targets: Targets,
    /// SRAA of the last frame, with its choice. `None` without SRAA.
    filter: Option<(Antialiasing, Filter)>,
    /// Frame times.
    pub clock: Clock,
}

impl Renderer {
    /// Creates a renderer for pictures of `size` into targets of `format`, which converts to sRGB.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, size: Size, format: TextureFormat) -> Result<Self, Failure> {
        Ok(Renderer {
            queue: queue.clone(),
            passes: Passes::new(device, queue, format),
            kernels: Kernels::new(device)?,
            targets: Targets::new(device, size),
            filter: None,
            clock: Clock::new(device, queue)?,
        })
    }

    /// Records and submits the frame at `time` seconds. If the target has another size than the last one, the textures between the
    /// passes are recreated. After this, or with another antialiasing, SRAA is bound anew.
    pub fn draw(&mut self, time: f32, antialiasing: Antialiasing, target: &wgpu::TextureView) -> Result<(), Failure> {
        let begun = Instant::now();
        self.prepare([target.texture().width(), target.texture().height()], antialiasing)?;
        let view = View::new(self.targets.size, time);
        self.set_samples(&view, &SAMPLES, 1.0);
        let Renderer { queue, passes, targets, filter, clock, .. } = self;
        let filter = filter.as_ref().map(|(_, filter)| filter);
        if let Some(filter) = filter {
            filter.set_view(queue, &view);
        }

        let mut encoder = passes.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let layers = match antialiasing {
            Antialiasing::None => CENTRE..LAYERS,
            Antialiasing::Sraa(_) => 0..LAYERS,
            Antialiasing::Supersampling => 0..CENTRE,
        };
        for at in layers {
            passes.draw_geometry(&mut encoder, targets, at, clock.span(Part::Scene)?);
        }
        let placing = filter.and_then(Filter::before_shading);
        if let Some(kernel) = placing {
            record(kernel, &mut encoder, clock)?;
        }
        let [depth, normal, albedo] = targets.geometry.each_ref().map(all_layers);
        let seen = [&depth, &normal, &albedo, &targets.place];
        let (shading, seen) = match (antialiasing, placing) {
            (Antialiasing::Supersampling, _) => (&passes.shade_samples, &seen[..3]),
            (_, Some(_)) => (&passes.shade_placed, &seen[..]),
            (_, None) => (&passes.shade_centre, &seen[..3]),
        };
        let inputs = (Some(&passes.uniforms[CENTRE as usize]), seen);
        passes.cover(&mut encoder, shading, inputs, &targets.shaded, clock.span(Part::Scene)?);
        for kernel in filter.iter().flat_map(|filter| filter.after_shading()) {
            record(kernel, &mut encoder, clock)?;
        }
        let shown = if filter.is_some() { &targets.resolved } else { &targets.shaded };
        passes.cover(&mut encoder, &passes.present, (None, &[shown]), target, clock.span(Part::Scene)?);
        clock.resolve(&mut encoder)?;
        queue.submit([encoder.finish()]);
        clock.add(begun.elapsed())?;
        Ok(())
    }

    /// Makes textures of this size, and binds SRAA to them.
    fn prepare(&mut self, size: Size, antialiasing: Antialiasing) -> Result<(), Failure> {
        if size != self.targets.size {
            self.targets = Targets::new(&self.passes.device, size);
            self.filter = None;
        }
        if self.filter.as_ref().is_none_or(|(own, _)| *own != antialiasing) {
            self.filter = match antialiasing {
                Antialiasing::Sraa(preset) => Some((antialiasing, Filter::new(&self.kernels, preset, &self.targets)?)),
                Antialiasing::None | Antialiasing::Supersampling => None,
            };
        }
        Ok(())
    }

    /// Sets the uniforms of the layers: those of four samples, and the centre.
    fn set_samples(&self, view: &View, samples: &[Vec2; 4], share: f32) {
        for (sample, uniforms) in samples.iter().chain([&Vec2::ZERO]).zip(&self.passes.uniforms) {
            let uniforms_of_sample = bytes(view.uniforms(*sample, share).into_iter());
            self.queue.write_buffer(uniforms, 0, &uniforms_of_sample);
        }
    }
}

/// Records a kernel, timed if the frame is.
fn record(kernel: &Bound, encoder: &mut wgpu::CommandEncoder, clock: &mut Clock) -> Result<(), Failure> {
    match clock.timer(Part::Sraa) {
        Some(timer) => kernel.encode_timed(encoder, timer)?,
        None => kernel.encode(encoder),
    }
    Ok(())
}
