//! Subpixel Reconstruction Antialiasing (SRAA; Chajdas, McGuire and Luebke 2011) for a renderer with wgpu: a picture that is
//! shaded once a pixel gets edges as of four or sixteen samples.
//!
//! [`Sraa`] owns the textures, the shaders and their bindings. A renderer draws its geometry into [`Sraa::geometry`], shades
//! into [`Sraa::color`], and shows [`Sraa::resolved`]:
//!
//! ```no_run
//! use straightline_sraa::{Error, Preset, Projection, Sraa, wgpu};
//!
//! # struct Renderer;
//! # impl Renderer {
//! #     fn draw_depth(&self, _: &mut wgpu::RenderPass<'_>, _: [[f32; 4]; 4]) {}
//! #     fn draw_shaded(&self, _: &mut wgpu::RenderPass<'_>, _: [[f32; 4]; 4]) {}
//! #     fn show(&self, _: &mut wgpu::CommandEncoder, _: &wgpu::TextureView) {}
//! # }
//! # fn run(renderer: &Renderer, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, matrix: [[f32; 4]; 4]) -> Result<(), Error> {
//! // Once.
//! let projection = Projection::from_matrix(matrix)?;
//! let sraa = Sraa::new(device, [1280, 720], Preset::Fast, &projection)?;
//!
//! // Every frame.
//! for pass in sraa.geometry() {
//!     renderer.draw_depth(&mut pass.begin(encoder), pass.matrix());
//! }
//! renderer.draw_shaded(&mut sraa.begin_shading(encoder, wgpu::Color::BLACK), matrix);
//! sraa.encode(encoder);
//! renderer.show(encoder, sraa.resolved());
//! # Ok(())
//! # }
//! ```
//!
//! With [`Preset::Fast`] geometry is depth alone: a pipeline without a fragment shader draws it. The other presets also compare
//! normals, and [`Preset::Guided`] an estimate of the colour ([`GeometryPass`]). [`Preset::Full`] and [`Preset::Guided`] are for
//! deferred shading: [`Sraa::encode_placing`] decides at which sample each pixel is shaded.
//!
//! All colours are in linear light: show or tone-map the result, not the input.
//!
//! # Features
//!
//! - `sixteen`: sixteen samples a pixel, [`Samples::Sixteen`].
//! - `parallel`: cameras without perspective.
//!
//! Without them the build script generates fewer shaders.

mod error;
mod filter;
mod geometry;
mod options;
mod projection;
mod shaders;
mod targets;

pub use error::Error;
pub use geometry::GeometryPass;
pub use options::{Options, Preset, Samples};
pub use projection::Projection;
pub use straightline_runtime as runtime;
pub use straightline_runtime::wgpu;
pub use targets::{COLOR, DEPTH, GUIDE, NORMAL};

use filter::Filter;
use geometry::cleared;
use straightline_runtime::{Bound, PassOptions, Passes};
use targets::Targets;
use wgpu::{Color, ColorTargetState, CommandEncoder, Device, Queue, RenderPass, TextureView};

/// SRAA on a device: its textures for one size, and its shaders bound to them.
#[derive(Debug)]
pub struct Sraa {
    device: Device,
    passes: Passes,
    options: Options,
    projection: Projection,
    size: [u32; 2],
    targets: Targets,
    filter: Filter,
}

impl Sraa {
    /// Creates the textures for pictures of `size`, width and height in pixels, and compiles the shaders.
    ///
    /// # Errors
    ///
    /// [`Error::Size`]; [`Error::Feature`] for what this crate was built without; [`Error::Runtime`] if the device cannot run
    /// the shaders.
    pub fn new(
        device: &Device,
        size: [u32; 2],
        options: impl Into<Options>,
        projection: &Projection,
    ) -> Result<Self, Error> {
        let (options, mut passes) = (
            options.into(),
            Passes::new(device, PassOptions::default().unbounded_loops(true)),
        );
        let (targets, filter) = prepare(device, &mut passes, (size, options), projection)?;
        Ok(Sraa {
            device: device.clone(),
            passes,
            options,
            projection: *projection,
            size,
            targets,
            filter,
        })
    }

    /// Replaces size, options and camera. All textures are new; shaders that were compiled stay.
    ///
    /// # Errors
    ///
    /// As [`Sraa::new`]. After an error, nothing has changed.
    pub fn reset(&mut self, size: [u32; 2], options: impl Into<Options>, projection: &Projection) -> Result<(), Error> {
        let options = options.into();
        let (targets, filter) = prepare(&self.device, &mut self.passes, (size, options), projection)?;
        (self.size, self.options, self.projection) = (size, options, *projection);
        (self.targets, self.filter) = (targets, filter);
        Ok(())
    }

    /// Replaces the textures by those of another size. Nothing happens if size and projection are the same.
    ///
    /// # Errors
    ///
    /// As [`Sraa::new`].
    pub fn resize(&mut self, size: [u32; 2], projection: &Projection) -> Result<(), Error> {
        match size == self.size && *projection == self.projection {
            true => Ok(()),
            false => self.reset(size, self.options, projection),
        }
    }

    /// Follows a camera whose projection changes, for example by zooming. Writes uniforms; but where the kind of projection
    /// changes, this is a [`reset`](Sraa::reset).
    ///
    /// # Errors
    ///
    /// As [`Sraa::new`], where the kind of projection changes.
    pub fn set_projection(&mut self, queue: &Queue, projection: &Projection) -> Result<(), Error> {
        let kind = |of: &Projection| (of.is_parallel(), of.is_reversed());
        if kind(projection) != kind(&self.projection) {
            return self.reset(self.size, self.options, projection);
        }
        self.projection = *projection;
        self.filter
            .set_projection(queue, (self.options.preset, projection, self.size))
    }

    /// Settings.
    pub fn options(&self) -> Options {
        self.options
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Passes in which the renderer draws its geometry, before shading: one for all samples of a pixel, or one for each.
    pub fn geometry(&self) -> impl ExactSizeIterator<Item = GeometryPass<'_>> {
        let offsets = self.options.samples.offsets();
        let samples = &self.targets.geometry.samples;
        let (sample_count, offsets) = match samples.len() {
            1 => (offsets.len() as u32, &[[0.0; 2]][..]),
            _ => (1, offsets),
        };
        let pass = move |(surface, offset): (_, &[f32; 2])| GeometryPass {
            surface,
            projection: &self.projection,
            size: self.size,
            offset: *offset,
            sample_count,
        };
        samples.iter().zip(offsets).map(pass)
    }

    /// Pass in which the renderer draws the geometry at the pixels' centres, before or while it shades.
    pub fn centre(&self) -> GeometryPass<'_> {
        GeometryPass {
            surface: &self.targets.geometry.centre,
            projection: &self.projection,
            size: self.size,
            offset: [0.0; 2],
            sample_count: 1,
        }
    }

    /// Colour targets of the geometry passes, for the pipelines that draw into them; beside them there is depth, [`DEPTH`].
    pub fn geometry_targets(&self) -> Vec<Option<ColorTargetState>> {
        let all = [
            (self.options.has_normals(), NORMAL),
            (self.options.preset.has_guide(), GUIDE),
        ];
        let formats = all.into_iter().filter(|(is_drawn, _)| *is_drawn);
        formats.map(|(_, format)| Some(format.into())).collect()
    }

    /// Begins the pass of a forward renderer: it shades into [`Sraa::color`] and draws the geometry of the pixels' centres.
    /// Its targets are the colour, [`COLOR`], cleared to `background`, then those of [`Sraa::geometry_targets`].
    pub fn begin_shading(&self, encoder: &mut CommandEncoder, background: Color) -> RenderPass<'static> {
        let color = Some(cleared(&self.targets.color, background));
        self.centre().begin_with(encoder, &[color], None)
    }

    /// Records the decision where each pixel is shaded, after the geometry and before shading: with [`Preset::Full`] and
    /// [`Preset::Guided`]; otherwise nothing.
    pub fn encode_placing(&self, encoder: &mut CommandEncoder) {
        encode_group("SRAA placing", self.before_shading(), encoder);
    }

    /// Place of each pixel's shading, an unsigned integer: the index of a sample in [`Samples::offsets`], or their number for the
    /// pixel's centre. `None` for presets that shade all pixels at their centres.
    pub fn place(&self) -> Option<&TextureView> {
        self.targets.place.as_ref()
    }

    /// Target of the shading: colours in linear light, at the centres or where [`Sraa::place`] says.
    pub fn color(&self) -> &TextureView {
        &self.targets.color
    }

    /// Textures of the geometry by the names that the kernels have for them, for the renderer's own shading.
    ///
    /// Four samples: `depth_samples` and `normal_samples` are multisampled, `centre_depth` and `centre_normal` are not. Sixteen:
    /// `depth` and `normal` are arrays, with the centre in the last layer. The same for the guide.
    pub fn geometry_texture(&self, name: &str) -> Option<&TextureView> {
        let mut all = self.targets.geometry.read.iter();
        all.find(|(known, _)| *known == name).map(|(_, view)| view)
    }

    /// Records the filter, after shading.
    pub fn encode(&self, encoder: &mut CommandEncoder) {
        encode_group("SRAA", self.after_shading(), encoder);
    }

    /// The antialiased picture, in linear light. It stays as it is until the next frame.
    pub fn resolved(&self) -> &TextureView {
        &self.targets.resolved
    }

    /// Passes of [`Sraa::encode_placing`], to time them.
    pub fn before_shading(&self) -> &[Bound] {
        &self.filter.before_shading
    }

    /// Passes of [`Sraa::encode`] in order, to time them.
    pub fn after_shading(&self) -> &[Bound] {
        &self.filter.after_shading
    }
}

/// Makes the textures, and binds the shaders to them.
fn prepare(
    device: &Device,
    passes: &mut Passes,
    (size, options): ([u32; 2], Options),
    projection: &Projection,
) -> Result<(Targets, Filter), Error> {
    let limit = device.limits().max_texture_dimension_2d;
    let [width, height] = size;
    if size.iter().any(|side| !(1..=limit).contains(side)) {
        return Err(Error::Size { width, height, limit });
    }
    let targets = Targets::new(device, size, options);
    let filter = Filter::new(passes, options, (projection, size), &targets)?;
    Ok((targets, filter))
}

/// Records passes in a debug group, by which a debugger shows them together.
fn encode_group(name: &str, passes: &[Bound], encoder: &mut CommandEncoder) {
    encoder.push_debug_group(name);
    passes.iter().for_each(|bound| bound.encode(encoder));
    encoder.pop_debug_group();
}
