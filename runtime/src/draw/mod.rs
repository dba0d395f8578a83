//! Drawing triangles of the caller's with an emitted fragment shader.

mod options;
mod vertices;

use crate::error::Error;
use crate::guard::LossProbe;
use crate::inputs::{Abilities, arrange_inputs, check_inputs, frame_size};
use crate::layout::{BoundGroup, Layout};
use crate::module::Source;
use crate::overrides::{chosen_overrides, pipeline_constants};
use crate::pass::check_features;
use crate::pipeline::{Choices, VertexSide, check_formats, render_pipeline};
use crate::plan::{Plan, StagePlan};
use crate::uniforms::{UniformValue, Uniforms};
use crate::{BindOptions, Resource, Shader};
use std::sync::Arc;
use wgpu::{Device, Queue, RenderPass, RenderPipeline, TextureFormat};

pub use options::{DrawOptions, VertexShader};

/// An emitted fragment shader behind a vertex shader of the caller's: a pipeline for triangles, which a [`Pass`](crate::Pass)
/// has none of. Kernels that take interpolated values, such as shadow filters, are drawn so.
///
/// The caller records the render pass, with its own targets, depth buffer and vertices; [`BoundDraw::set`] sets the pipeline and
/// the kernel's bind groups in it.
///
/// ```no_run
/// use straightline_runtime::{BoundDraw, Draw, DrawOptions, Error, PassOptions, Resource, Shader, wgpu};
///
/// const SCENE: &str = "
///     struct Corner { @builtin(position) clip: vec4f, @location(0) coord: vec3f }
///     @group(1) @binding(0) var<uniform> matrices: array<mat4x4f, 2>;
///     @vertex fn corner(@location(0) place: vec3f) -> Corner {
///         return Corner(matrices[0] * vec4f(place, 1.0), (matrices[1] * vec4f(place, 1.0)).xyz);
///     }";
///
/// fn shadowed(
///     device: &wgpu::Device,
///     // `shaders::pcf::SHADER` of a build script: its varying is `coord: vec3f` at location 0.
///     pcf: &Shader<'_>,
///     matrices: &wgpu::BindGroupLayout,
///     (shadow, compare): (&wgpu::TextureView, &wgpu::Sampler),
/// ) -> Result<BoundDraw, Error> {
///     let place = wgpu::vertex_attr_array![0 => Float32x3];
///     let vertices = [Some(wgpu::VertexBufferLayout {
///         array_stride: 12,
///         step_mode: wgpu::VertexStepMode::Vertex,
///         attributes: &place,
///     })];
///     let options = DrawOptions::new(SCENE, "corner")
///         .buffers(&vertices)
///         .group(1, matrices)
///         .pass(PassOptions::default().target_format(wgpu::TextureFormat::Rgba8UnormSrgb));
///     let draw = Draw::from_shader(device, pcf, &options)?;
///     draw.bind(&[("shadow", Resource::from(shadow)), ("shadow_sampler", compare.into())])
/// }
///
/// fn record(shadowed: &BoundDraw, pass: &mut wgpu::RenderPass<'_>, matrices: &wgpu::BindGroup, corners: &wgpu::Buffer) {
///     shadowed.set(pass);
///     pass.set_bind_group(1, matrices, &[]);
///     pass.set_vertex_buffer(0, corners.slice(..));
///     pass.draw(0..(corners.size() / 12) as u32, 0..1);
/// }
/// ```
#[derive(Debug)]
pub struct Draw {
    device: Device,
    plan: Arc<Plan>,
    layout: Layout,
    pipeline: RenderPipeline,
    formats: Vec<TextureFormat>,
    abilities: Abilities,
    loss_probe: LossProbe,
}

impl Draw {
    /// Combines the fragment shader `shader` with the vertex shader of `options`. Checks everything that does not depend on
    /// the inputs: each varying's location and type in the vertex shader, the formats of vertices, the states of the
    /// pipeline.
    ///
    /// # Errors
    ///
    /// Errors of [`Pass::from_shader`](crate::Pass::from_shader); [`Error::VertexShader`] for a vertex shader that does not
    /// compile; [`Error::Pipeline`] for a shader of another stage or for regions, a bind group that the kernel uses itself,
    /// a varying that the vertex shader does not return or returns with another type, and any other error of wgpu about the
    /// pipeline. With the feature `manifest`, such a varying is an [`Error::Varying`], by name, and a vertex shader without
    /// the entry point an [`Error::VertexShader`].
    pub fn from_shader(device: &Device, shader: &Shader<'_>, options: &DrawOptions<'_>) -> Result<Self, Error> {
        let plan = shader.plan.clone();
        check_drawable(&plan)?;
        check_features(device, &plan)?;
        let formats = check_formats(device, &plan, &options.pass)?;
        let constants = pipeline_constants(&chosen_overrides(&plan, &options.pass)?);
        let doing = format!("making a pipeline of `{}`", plan.kernel);
        let loss_probe = LossProbe::new(device, &doing)?;
        let layout = Layout::with_groups(device, &plan, &options.groups)?;
        let vertices = vertices::vertex_module(device, &plan, &options.vertex)?;
        let fragment = Source::from_shader(shader, &options.pass).create_module(device, &plan);
        let fragment = fragment.map_err(|error| shader.locate(error))?;
        let side = VertexSide {
            module: &vertices,
            entry_point: options.vertex.entry_point(),
            buffers: &options.buffers,
            primitive: options.primitive,
            depth_stencil: options.depth_stencil.clone(),
            multisample: options.multisample,
            blend: options.blend,
        };
        let choices = Choices {
            formats: &formats,
            constants: &constants,
            cache: options.pass.cache.as_ref(),
        };
        let pipeline = render_pipeline(device, &plan, &layout, (side, &fragment), choices);
        let pipeline = pipeline.map_err(|error| vertices::explain_error(error, &plan, &options.vertex))?;
        loss_probe.check(device, &doing)?;
        Ok(Draw {
            device: device.clone(),
            plan: Arc::new(plan),
            layout,
            pipeline,
            formats,
            abilities: Abilities::new(device),
            loss_probe,
        })
    }

    /// The kernel's name.
    pub fn kernel(&self) -> &str {
        &self.plan.kernel
    }

    /// Names of the inputs that [`bind`](Self::bind) wants, textures, samplers and buffers, in binding order.
    pub fn inputs(&self) -> impl ExactSizeIterator<Item = &str> {
        self.plan.inputs.iter().map(|input| input.name.as_ref())
    }

    /// Returns the names of the kernel's outputs with the format that the render pass must have for each, in the order of
    /// its colour attachments.
    pub fn targets(&self) -> impl ExactSizeIterator<Item = (&str, TextureFormat)> {
        let names = self.plan.outputs.iter().map(|output| output.name.as_ref());
        names.zip(self.formats.iter().copied())
    }

    /// Binds the pipeline to the kernel's inputs, `inputs`, by name as for [`Pass::bind`](crate::Pass::bind). Uniforms
    /// start from the manifest's defaults.
    ///
    /// Textures that are read at the pixel must all have the size of the render pass, which is not known here. The render
    /// pass's attachments are not known either: if one of them is an input, wgpu reports that when the caller's encoder is
    /// finished. A kernel with `resolution` and no texture of that size has it as the uniform `resolution`, a `[u32; 2]` that
    /// the caller sets.
    ///
    /// # Errors
    ///
    /// Those of [`Pass::bind`](crate::Pass::bind) that are not about targets.
    pub fn bind<'r, R: Into<Resource<'r>> + Copy>(&self, inputs: &[(&str, R)]) -> Result<BoundDraw, Error> {
        self.bind_with(inputs, &BindOptions::default())
    }

    /// Binds as [`bind`](Self::bind), with other uniforms than the manifest's defaults.
    ///
    /// # Errors
    ///
    /// Those of [`bind`](Self::bind); [`Error::UnknownUniform`], [`Error::UniformType`], [`Error::NoUniforms`] and
    /// [`Error::UniformSize`]; and [`Error::Region`] for a rectangle, which the caller sets by scissor and triangles
    /// instead.
    pub fn bind_with<'r, R: Into<Resource<'r>> + Copy>(
        &self,
        inputs: &[(&str, R)],
        options: &BindOptions<'_>,
    ) -> Result<BoundDraw, Error> {
        let plan = &self.plan;
        if let Some(region) = options.region {
            return Err(Error::Region {
                kernel: plan.kernel.to_string(),
                region,
                problem: "triangles say what is drawn; cut it by the render pass's scissor".to_owned(),
            });
        }
        let inputs: Vec<(&str, Resource<'r>)> = inputs.iter().map(|(name, input)| (*name, (*input).into())).collect();
        self.loss_probe
            .check(&self.device, &format!("binding `{}`", plan.kernel))?;
        let resources = arrange_inputs(plan, &inputs)?;
        // Without a texture of the frame's size none is compared with it.
        let frame = frame_size(plan, &resources).unwrap_or_default();
        check_inputs(plan, &self.abilities, &resources, frame)?;
        let uniforms = Uniforms::new(&self.device, plan, options, None)?;
        let groups = self
            .layout
            .bind_resources(&self.device, plan, &uniforms, &resources, (&[], None))?;
        Ok(BoundDraw {
            plan: Arc::clone(plan),
            pipeline: self.pipeline.clone(),
            groups,
            uniforms,
        })
    }
}

/// Rejects shaders that cannot be drawn with triangles.
fn check_drawable(plan: &Plan) -> Result<(), Error> {
    let refused = |description: &str| {
        Err(Error::Pipeline {
            kernel: plan.kernel.to_string(),
            description: description.to_owned(),
        })
    };
    match (plan.stage, &plan.region) {
        (StagePlan::Compute { .. }, _) => refused(
            "it is a compute shader, and triangles are drawn with a fragment shader: generate it for the stage \
             `fragment`, or dispatch it with a `Pass`",
        ),
        (_, Some(_)) => refused(
            "it is a shader for regions, which fills a rectangle: generate it without `region`, or run it with a `Pass`",
        ),
        (StagePlan::Fragment, None) => Ok(()),
    }
}

/// A [`Draw`] with its inputs, to be set in a render pass of the caller's any number of times. It keeps its resources
/// alive, has no lifetime, and can be shared between threads.
#[derive(Debug)]
pub struct BoundDraw {
    plan: Arc<Plan>,
    pipeline: RenderPipeline,
    groups: Vec<BoundGroup>,
    uniforms: Uniforms,
}

impl BoundDraw {
    /// The kernel's name.
    pub fn kernel(&self) -> &str {
        &self.plan.kernel
    }

    /// Sets the pipeline and the kernel's bind groups and immediates in `pass`. A vertex shader with immediates of its own
    /// would read the same bytes. What the vertex shader reads, its own bind groups and
    /// vertex buffers, and the draw calls are the caller's. It cannot fail, and allocates nothing of its own.
    pub fn set(&self, pass: &mut RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        for (index, group) in &self.groups {
            pass.set_bind_group(*index, group, &[]);
        }
        self.uniforms.record_immediates(|bytes| pass.set_immediates(0, bytes));
    }

    /// Sets the uniform `name`: see [`Bound::write_uniform`](crate::Bound::write_uniform).
    ///
    /// # Errors
    ///
    /// [`Error::UnknownUniform`], or [`Error::UniformType`] for a value of another type. Nothing has been written then.
    pub fn write_uniform(&self, queue: &Queue, name: &str, value: impl Into<UniformValue>) -> Result<(), Error> {
        self.uniforms.write_value(&self.plan, queue, name, &value.into())
    }

    /// Sets all uniforms at once: see [`Bound::write_uniforms`](crate::Bound::write_uniforms).
    ///
    /// # Errors
    ///
    /// [`Error::NoUniforms`], or [`Error::UniformSize`] for another length. Nothing has been written then.
    pub fn write_uniforms(&self, queue: &Queue, bytes: &[u8]) -> Result<(), Error> {
        self.uniforms.write_all(&self.plan, queue, bytes)
    }

    /// Writes `bytes` at `offset` of the uniform struct, for generated code, which knows both.
    #[doc(hidden)]
    pub fn write_at(&self, queue: &Queue, offset: u32, bytes: &[u8]) {
        self.uniforms.write_at(queue, offset, bytes);
    }
}
