//! A frame: geometry at the samples and the centre of each pixel, shading, SRAA, and presenting.

mod passes;
#[cfg(not(target_arch = "wasm32"))]
mod reference;
mod targets;
mod view;

use crate::antialiasing::Antialiasing;
use crate::clock::{Clock, Part};
use crate::{Failure, Size};
use passes::{Passes, bytes};
use straightline_sraa::runtime::Bound;
use straightline_sraa::{Options, Preset, Sraa, wgpu};
use targets::Targets;
use view::View;
use web_time::Instant;
use wgpu::TextureFormat;

/// Passes, and the textures between them.
pub struct Renderer {
    queue: wgpu::Queue,
    passes: Passes,
    targets: Targets,
    /// SRAA, or only its G-buffer.
    sraa: Sraa,
    /// Frame times.
    pub clock: Clock,
}

impl Renderer {
    /// Creates a renderer for pictures of `size` into targets of `format`, which converts to sRGB.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, size: Size, format: TextureFormat) -> Result<Self, Failure> {
        Ok(Renderer {
            queue: queue.clone(),
            passes: Passes::new(device, queue, format),
            targets: Targets::new(device, size),
            sraa: Sraa::new(device, size, options(Antialiasing::None), &View::new(size, 0.0).projection())?,
            clock: Clock::new(device, queue)?,
        })
    }

    /// Records and submits the frame at `time` seconds. If the target has another size than the last one, or the antialiasing is
    /// another, the textures between the passes are recreated.
    pub fn draw(&mut self, time: f32, antialiasing: Antialiasing, target: &wgpu::TextureView) -> Result<(), Failure> {
        let begun = Instant::now();
        let view = self.prepare([target.texture().width(), target.texture().height()], time, antialiasing)?;
        self.set_uniforms(&view, view.projection().matrix(), 1.0);
        let Renderer { queue, passes, targets, sraa, clock, .. } = self;
        let mut encoder = passes.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let [samples_albedo, centre_albedo] = &targets.albedo;
        if antialiasing != Antialiasing::None {
            for pass in sraa.geometry() {
                passes.draw_geometry(&mut encoder, pass, samples_albedo, clock.span(Part::Scene)?);
            }
        }
        if antialiasing != Antialiasing::Supersampling {
            passes.draw_geometry(&mut encoder, sraa.centre(), centre_albedo, clock.span(Part::Scene)?);
        }
        let is_sraa = matches!(antialiasing, Antialiasing::Sraa(_));
        if is_sraa {
            record(sraa.before_shading(), &mut encoder, clock)?;
        }
        let seen = seen(sraa, targets);
        let (shading, seen) = match (antialiasing, sraa.place()) {
            (Antialiasing::Supersampling, _) => (&passes.shade_samples, &seen[..3]),
            (_, Some(_)) => (&passes.shade_placed, &seen[..]),
            (_, None) => (&passes.shade_centre, &seen[3..6]),
        };
        let shaded = if is_sraa { sraa.color() } else { &targets.shaded };
        passes.cover(&mut encoder, shading, (Some(&passes.uniforms), seen), shaded, clock.span(Part::Scene)?);
        if is_sraa {
            record(sraa.after_shading(), &mut encoder, clock)?;
        }
        let shown = if is_sraa { sraa.resolved() } else { shaded };
        passes.cover(&mut encoder, &passes.present, (None, &[(1, shown)]), target, clock.span(Part::Scene)?);
        clock.resolve(&mut encoder)?;
        queue.submit([encoder.finish()]);
        clock.add(begun.elapsed())?;
        Ok(())
    }

    /// Makes textures of this size for this antialiasing. Returns the view.
    fn prepare(&mut self, size: Size, time: f32, antialiasing: Antialiasing) -> Result<View, Failure> {
        let view = View::new(size, time);
        if size != self.sraa.size() {
            self.targets = Targets::new(&self.passes.device, size);
        }
        let options = options(antialiasing);
        if size != self.sraa.size() || options != self.sraa.options() {
            self.sraa.reset(size, options, &view.projection())?;
        }
        Ok(view)
    }

    fn set_uniforms(&self, view: &View, projection: [[f32; 4]; 4], share: f32) {
        self.queue.write_buffer(&self.passes.uniforms, 0, &bytes(view.uniforms(projection, share).into_iter()));
    }
}

/// Options of SRAA. Shading reads normals, whatever the preset compares.
fn options(antialiasing: Antialiasing) -> Options {
    let preset = match antialiasing {
        Antialiasing::Sraa(preset) => preset,
        Antialiasing::None | Antialiasing::Supersampling => Preset::Fast,
    };
    Options::new(preset).draw_normals(true)
}

/// Textures that shading reads, with their bindings: of the samples, of the centre, and the place of the shading.
fn seen<'a>(sraa: &'a Sraa, targets: &'a Targets) -> Vec<(u32, &'a wgpu::TextureView)> {
    let texture = |name| sraa.geometry_texture(name);
    let views = [
        texture("depth_samples"),
        texture("normal_samples"),
        Some(&targets.albedo[0]),
        texture("centre_depth"),
        texture("centre_normal"),
        Some(&targets.albedo[1]),
        sraa.place(),
    ];
    (1..).zip(views).filter_map(|(binding, view)| Some((binding, view?))).collect()
}

/// Records passes of SRAA, timed if the frame is.
fn record(passes: &[Bound], encoder: &mut wgpu::CommandEncoder, clock: &mut Clock) -> Result<(), Failure> {
    for pass in passes {
        match clock.timer(Part::Sraa) {
            Some(timer) => pass.encode_timed(encoder, timer)?,
            None => pass.encode(encoder),
        }
    }
    Ok(())
}
