//! The pass: one emitted shader, ready to be recorded into the caller's encoders.

use crate::error::ViewProblem;
use crate::guard::{Pulse, guarded};
use crate::inputs::{Abilities, arrange, check_inputs, check_targets, frame_size, is_one_image, shared, size};
use crate::layout::{BoundGroup, Layout};
use crate::module::Source;
use crate::pipeline::{Pipeline, check_formats};
use crate::plan::Plan;
use crate::targets::Targets;
use crate::timer::{Span, Timer};
use crate::uniforms::{self, UniformBlock, UniformValue};
use crate::{Error, Region, Resource, reflect};
use std::time::Duration;
use straightline_manifest::Manifest;
use wgpu::{CommandEncoder, Device, Queue, TextureFormat, TextureView};

/// Choices that the manifest leaves open.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct PassOptions {
    /// Format of the colour target of a fragment pass, where it is not the manifest's; a swap chain's, say.
    /// For compute, the shader's text fixes the format, and another one here is an error.
    pub target_format: Option<TextureFormat>,
    /// The same of a kernel that writes several targets, by their names.
    pub formats: Vec<(String, TextureFormat)>,
    /// Whether loops go without the bound that wgpu otherwise puts on the rounds of each, by a counter that costs time. Only
    /// for shaders whose text shows that every loop ends, as that of emitted shaders does; all others are refused.
    pub unbounded_loops: bool,
}

impl PassOptions {
    /// Draws to targets of `format`.
    pub fn target_format(mut self, format: TextureFormat) -> Self {
        self.target_format = Some(format);
        self
    }

    /// Draws what the kernel calls `name` to targets of `format`.
    pub fn format_of(mut self, name: &str, format: TextureFormat) -> Self {
        self.formats.push((name.to_owned(), format));
        self
    }

    /// Whether loops go without wgpu's bound.
    pub fn unbounded_loops(mut self, unbounded: bool) -> Self {
        self.unbounded_loops = unbounded;
        self
    }
}

/// One emitted shader on one device: pipeline, bind group layouts and uniform buffers.
///
/// Making one compiles the shader; keep it. Recording it with [`encode`](Self::encode) makes its bind groups anew,
/// so views may change from frame to frame. A pass can be shared between threads.
#[derive(Debug)]
pub struct Pass {
    device: Device,
    plan: Plan,
    layout: Layout,
    pipeline: Pipeline,
    creation_time: Duration,
    uniforms: Vec<UniformBlock>,
    formats: Vec<TextureFormat>,
    abilities: Abilities,
    pulse: Pulse,
}

impl Pass {
    /// A pass of the shader `wgsl` that `manifest` describes, with default options.
    ///
    /// # Errors
    ///
    /// [`Error::BadManifest`], [`Error::Hash`], [`Error::Mismatch`] and [`Error::Shader`] if the two are damaged or do not
    /// belong together; [`Error::Limit`], [`Error::Pipeline`] and [`Error::OutOfMemory`] if the device cannot run the
    /// shader; [`Error::DeviceLost`].
    pub fn new(device: &Device, manifest: &Manifest, wgsl: &str) -> Result<Self, Error> {
        Self::with_options(device, manifest, wgsl, &PassOptions::default())
    }

    /// [`new`](Self::new) for a manifest as it lies on disk.
    ///
    /// # Errors
    ///
    /// Those of [`new`](Self::new), and [`Error::Manifest`] if `manifest_json` is not a manifest or of another schema.
    pub fn from_json(device: &Device, manifest_json: &str, wgsl: &str) -> Result<Self, Error> {
        Self::new(device, &Manifest::from_json(manifest_json)?, wgsl)
    }

    /// [`new`](Self::new) with options.
    ///
    /// # Errors
    ///
    /// Those of [`new`](Self::new); [`Error::TargetFormat`] if the shader cannot write the format asked for, and
    /// [`Error::UnboundedLoop`] if loops are to go without a bound and one may not end.
    pub fn with_options(
        device: &Device,
        manifest: &Manifest,
        wgsl: &str,
        options: &PassOptions,
    ) -> Result<Self, Error> {
        let plan = Plan::new(manifest)?;
        check_hash(manifest, wgsl)?;
        reflect::check(&plan, wgsl)?;
        let source = Source::Wgsl {
            text: wgsl,
            unbounded_loops: options.unbounded_loops,
        };
        Self::made(device, manifest, plan, source, options)
    }

    /// A pass of a shader that is the manifest's, whose plan is `plan`.
    pub(crate) fn made(
        device: &Device,
        manifest: &Manifest,
        plan: Plan,
        source: Source<'_>,
        options: &PassOptions,
    ) -> Result<Self, Error> {
        check_features(device, manifest)?;
        let formats = check_formats(device, &plan, options)?;
        let doing = format!("making a pass of `{}`", plan.kernel);
        let pulse = Pulse::new(device, &doing)?;
        let layout = Layout::new(device, &plan)?;
        let (pipeline, creation_time) = Pipeline::new(device, &plan, &layout, source, &formats)?;
        let blocks = plan
            .uniforms
            .iter()
            .map(|block| UniformBlock::new(device, &plan.kernel, block));
        let uniforms = blocks.collect::<Result<Vec<_>, _>>()?;
        // Lost meanwhile, everything above was made without complaint and is dead.
        pulse.check(device, &doing)?;
        Ok(Pass {
            device: device.clone(),
            plan,
            layout,
            pipeline,
            creation_time,
            uniforms,
            formats,
            abilities: Abilities::new(device),
            pulse,
        })
    }

    /// The kernel's name.
    pub fn kernel(&self) -> &str {
        &self.plan.kernel
    }

    /// Names of the inputs that [`encode`](Self::encode) wants, textures, samplers and buffers, in binding order.
    pub fn inputs(&self) -> impl ExactSizeIterator<Item = &str> {
        self.plan.inputs.iter().map(|input| input.name.as_str())
    }

    /// The format that the target must have; of several, the first one. Panics if the kernel has none.
    pub fn target_format(&self) -> TextureFormat {
        self.formats[0]
    }

    /// Names of the targets that [`encode`](Self::encode) wants, with the format that each must have, in the order of the
    /// kernel's fields.
    pub fn targets(&self) -> impl ExactSizeIterator<Item = (&str, TextureFormat)> {
        let names = self.plan.outputs.iter().map(|output| output.name.as_str());
        names.zip(self.formats.iter().copied())
    }

    /// How long the device took to make the pipeline: wgpu's translation of the checked shader into the backend's language,
    /// and what the driver compiles then. Some drivers compile only when the pass first runs.
    pub fn creation_time(&self) -> Duration {
        self.creation_time
    }

    /// Sets the uniform `name`, for all passes recorded into what `queue`, the device's own, submits next.
    ///
    /// Uniforms start from the manifest's defaults. As with any `write_buffer`, all encoders of one submission see
    /// the value that was written last before it. Nothing is allocated here.
    ///
    /// # Errors
    ///
    /// [`Error::UnknownUniform`], or [`Error::UniformType`] for a value of another type. A lost device shows when
    /// the pass is encoded.
    pub fn write_uniform(&self, queue: &Queue, name: &str, value: impl Into<UniformValue>) -> Result<(), Error> {
        uniforms::write(&self.uniforms, &self.plan.kernel, queue, name, value.into())
    }

    /// Sets all uniforms at once, from `bytes` that are the uniform struct as it lies in the buffer: little-endian,
    /// each field at the offset that the manifest gives, and as long as the manifest's size, padding included. (Of
    /// several structs, one after the other in binding order.) All fields count as set.
    ///
    /// When the values are seen, see [`write_uniform`](Self::write_uniform). Nothing is allocated here.
    ///
    /// # Errors
    ///
    /// [`Error::NoUniforms`], or [`Error::UniformSize`] for another length. Nothing has been written then.
    pub fn write_uniforms(&self, queue: &Queue, bytes: &[u8]) -> Result<(), Error> {
        uniforms::write_all(&self.uniforms, &self.plan.kernel, queue, bytes)
    }

    /// Records the pass into `encoder`: reads `inputs`, given by name in any order, and writes every pixel of `targets`: `&view`,
    /// or `&[("albedo", &albedo), ("depth", &depth)]` for a kernel that gives a structure of these fields.
    ///
    /// Where all inputs are textures, `inputs` can be a slice of views, `&[("color", &view)]`; otherwise each is made
    /// a [`Resource`]: `&[("color", Resource::from(&view)), ("linear", (&sampler).into())]`. A kernel without inputs
    /// is given `&[] as &[(&str, Resource)]`.
    ///
    /// - A texture is a 2-D view, or 2-D array view with at least as many layers as the manifest says, of a texture
    ///   with [`TEXTURE_BINDING`](wgpu::TextureUsages::TEXTURE_BINDING) usage, the target's size unless the manifest
    ///   says that any will do, and a format with at least the components that the kernel reads: float, normalised or
    ///   depth where texels are read one by one, float or normalised where they are filtered, depth where depths are
    ///   compared. (Of a combined depth-stencil texture, give a view of the depth aspect.) It has one sample a texel,
    ///   or, where the kernel reads samples, at least as many as the manifest says.
    /// - A sampler has a comparison function exactly if the kernel compares with it.
    /// - A buffer has [`STORAGE`](wgpu::BufferUsages::STORAGE) usage and room for one element at least. All of it is
    ///   bound, so that its size says how many elements there are. One that the kernel writes keeps what is not written, and is
    ///   none that it reads. A kernel that only writes buffers is given no targets, `&[]`, and runs over its inputs.
    ///
    /// Targets have one size. Each has the format that [`targets`](Self::targets) says, and
    /// [`STORAGE_BINDING`](wgpu::TextureUsages::STORAGE_BINDING) usage for compute or
    /// [`RENDER_ATTACHMENT`](wgpu::TextureUsages::RENDER_ATTACHMENT) for fragment.
    ///
    /// wgpu does not tell which mip level and layers a view shows. Give views of level 0 that begin at the layer that
    /// the kernel calls 0: sizes and layers are checked on the texture.
    ///
    /// # Errors
    ///
    /// [`Error::MissingInput`], [`Error::UnknownInput`], [`Error::DuplicateInput`] and [`Error::InputKind`];
    /// [`Error::TargetNames`], [`Error::MissingTarget`], [`Error::UnknownTarget`] and [`Error::DuplicateTarget`];
    /// [`Error::Input`], [`Error::InputSampler`], [`Error::InputBuffer`], [`Error::Target`] and
    /// [`Error::Combination`] for unfit resources; [`Error::UniformUnset`]; [`Error::DeviceLost`] and
    /// [`Error::OutOfMemory`]. Nothing has been recorded then.
    pub fn encode<'r, 't, R: Into<Resource<'r>> + Copy>(
        &self,
        encoder: &mut CommandEncoder,
        inputs: &[(&str, R)],
        targets: impl Into<Targets<'t>>,
    ) -> Result<(), Error> {
        let targets = targets.into().arranged(&self.plan)?;
        let prepared = self.prepare(&resources(inputs), &targets, None)?;
        self.record(encoder, &prepared, &targets, None);
        Ok(())
    }

    /// [`encode`](Self::encode) for a rectangle: reads what lies at and around `region.first` of the inputs, and writes the
    /// pixels at `region.place` of `target`; all others stay as they are. The inputs need not have the target's size, only
    /// one size. The shader must have been generated for regions. One small buffer is allocated for each call.
    ///
    /// # Errors
    ///
    /// Those of [`encode`](Self::encode), and [`Error::Region`] if the shader filters whole images only, or the rectangle
    /// leaves the inputs or the target.
    pub fn encode_region<'r, 't, R: Into<Resource<'r>> + Copy>(
        &self,
        encoder: &mut CommandEncoder,
        inputs: &[(&str, R)],
        targets: impl Into<Targets<'t>>,
        region: Region,
    ) -> Result<(), Error> {
        let targets = targets.into().arranged(&self.plan)?;
        let prepared = self.prepare(&resources(inputs), &targets, Some(region))?;
        self.record(encoder, &prepared, &targets, None);
        Ok(())
    }

    /// [`encode`](Self::encode), timed on the GPU as the next span of `timer`.
    ///
    /// # Errors
    ///
    /// Those of [`encode`](Self::encode), and [`Error::TimerFull`]. No span is used up then.
    pub fn encode_timed<'r, 't, R: Into<Resource<'r>> + Copy>(
        &self,
        encoder: &mut CommandEncoder,
        inputs: &[(&str, R)],
        targets: impl Into<Targets<'t>>,
        timer: &mut Timer,
    ) -> Result<(), Error> {
        let targets = targets.into().arranged(&self.plan)?;
        let prepared = self.prepare(&resources(inputs), &targets, None)?;
        let span = timer.span()?;
        self.record(encoder, &prepared, &targets, Some(&span));
        Ok(())
    }

    /// Everything that can fail.
    fn prepare(
        &self,
        inputs: &[(&str, Resource<'_>)],
        targets: &[&TextureView],
        region: Option<Region>,
    ) -> Result<Prepared, Error> {
        self.pulse
            .check(&self.device, &format!("encoding `{}`", self.plan.kernel))?;
        let resources = arrange(&self.plan, inputs)?;
        check_targets(&self.plan, &self.formats, &self.abilities, targets)?;
        let whole = self.whole(&resources, targets)?;
        let rectangle = self.rectangle(&resources, whole, region)?;
        let frame = match self.plan.region {
            Some(_) => frame_size(&self.plan, &resources),
            None => None,
        };
        check_inputs(&self.plan, &self.abilities, &resources, frame.unwrap_or(whole))?;
        uniforms::check_set(&self.uniforms, &self.plan.kernel)?;
        let buffer = match self.plan.region {
            Some(_) => Some(rectangle.buffer(&self.device, &self.plan.kernel)?),
            None => None,
        };
        let bound = (targets, buffer.as_ref());
        let groups = self
            .layout
            .bind(&self.device, &self.plan, &self.uniforms, &resources, bound);
        let shared = shared(&self.plan, &resources, targets);
        let prepared = groups.and_then(|groups| {
            let prepared = Prepared {
                groups,
                rectangle,
                is_part: region.is_some(),
            };
            match (&self.pipeline, shared) {
                // Binding has judged every resource.
                (Pipeline::Compute { .. }, None) => Ok(prepared),
                _ => self.rehearse(&prepared, targets, shared.is_some()).map(|()| prepared),
            }
        });
        prepared.map_err(|error| match (error, shared) {
            // A texture of one image has no other part to show.
            (Error::Combination { kernel, .. }, Some((input, target))) if is_one_image(target.texture()) => {
                Error::Input {
                    kernel,
                    name: input.name.clone(),
                    problem: ViewProblem::IsTarget,
                }
            }
            (error, _) => error,
        })
    }

    /// The size of what is computed: that of the targets, or of a kernel that has none, of its inputs.
    fn whole(&self, resources: &[Resource<'_>], targets: &[&TextureView]) -> Result<[u32; 2], Error> {
        let of_inputs = || frame_size(&self.plan, resources);
        let whole = targets.first().map(|target| size(target.texture())).or_else(of_inputs);
        whole.ok_or_else(|| Error::BadManifest {
            kernel: self.plan.kernel.clone(),
            place: "output".to_owned(),
            problem: "nothing is given, and no input has a size that tells how many pixels there are".to_owned(),
        })
    }

    /// The rectangle to filter: the one asked for, or all of the inputs.
    fn rectangle(&self, resources: &[Resource<'_>], whole: [u32; 2], region: Option<Region>) -> Result<Region, Error> {
        match (&self.plan.region, region) {
            (None, None) => Ok(Region::at([0, 0], whole)),
            (None, Some(region)) => Err(Error::Region {
                kernel: self.plan.kernel.clone(),
                region,
                problem: "its shader filters whole images: generate it with `region`".to_owned(),
            }),
            (Some(_), region) => {
                let frame = frame_size(&self.plan, resources);
                let region = region.unwrap_or_else(|| Region::at([0, 0], frame.unwrap_or(whole)));
                region.check(&self.plan.kernel, frame, whole)?;
                Ok(region)
            }
        }
    }

    /// Records into an encoder of its own and throws it away. What wgpu holds against a colour target, or against
    /// reading and writing the same image, it says only when an encoder is finished; that must not be the caller's.
    ///
    /// Inputs have been bound by now, so the fault is the target's, unless that is `shared` with an input.
    fn rehearse(&self, prepared: &Prepared, targets: &[&TextureView], shared: bool) -> Result<(), Error> {
        let kernel = &self.plan.kernel;
        let refused = |description| match shared {
            true => Error::Combination {
                kernel: kernel.clone(),
                description,
            },
            false => Error::Target {
                kernel: kernel.clone(),
                name: None,
                problem: ViewProblem::Refused { description },
            },
        };
        guarded(&self.device, &format!("encoding `{kernel}`"), refused, || {
            let mut encoder = self
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.record(&mut encoder, prepared, targets, None);
            drop(encoder.finish());
        })
    }

    fn record(&self, encoder: &mut CommandEncoder, prepared: &Prepared, targets: &[&TextureView], span: Option<&Span>) {
        let Prepared {
            groups,
            rectangle,
            is_part,
        } = prepared;
        let [width, height] = rectangle.size;
        let label = Some(self.plan.kernel.as_str());
        match &self.pipeline {
            Pipeline::Compute { pipeline, workgroup } => {
                let timestamp_writes = span.map(Span::compute_writes);
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label,
                    timestamp_writes,
                });
                pass.set_pipeline(pipeline);
                for (index, group) in groups {
                    pass.set_bind_group(*index, group, &[]);
                }
                pass.dispatch_workgroups(
                    width.div_ceil(workgroup[0] * self.plan.block[0]),
                    height.div_ceil(workgroup[1] * self.plan.block[1]),
                    1,
                );
            }
            Pipeline::Render(pipeline) => {
                let attachments = targets.iter().map(|view| {
                    Some(wgpu::RenderPassColorAttachment {
                        view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            // Where every pixel is overwritten, clearing spares tiled GPUs from loading the old ones.
                            load: match is_part {
                                true => wgpu::LoadOp::Load,
                                false => wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                            },
                            store: wgpu::StoreOp::Store,
                        },
                    })
                });
                let attachments: Vec<_> = attachments.collect();
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label,
                    color_attachments: &attachments,
                    depth_stencil_attachment: None,
                    timestamp_writes: span.map(Span::render_writes),
                    occlusion_query_set: None,
                    multiview_mask: None,
                });
                pass.set_pipeline(pipeline);
                for (index, group) in groups {
                    pass.set_bind_group(*index, group, &[]);
                }
                let [x, y] = rectangle.place;
                pass.set_scissor_rect(x, y, width, height);
                pass.draw(0..3, 0..1);
            }
        }
    }
}

/// What is bound, and what is filtered.
struct Prepared {
    groups: Vec<BoundGroup>,
    rectangle: Region,
    /// Whether what lies around the rectangle stays as it is.
    is_part: bool,
}

/// Refuses a text that is not the one that the manifest was written for, though it may bind the same. A manifest without a
/// hash of it claims nothing.
fn check_hash(manifest: &Manifest, wgsl: &str) -> Result<(), Error> {
    let found = straightline_manifest::hash_of_text(wgsl);
    match manifest.hashes.get("wgsl") {
        Some(wanted) if *wanted != found => Err(Error::Hash {
            kernel: manifest.kernel.clone(),
            wanted: wanted.clone(),
            found,
        }),
        _ => Ok(()),
    }
}

/// Refuses what a shader needs and the device, or this crate, does not have.
fn check_features(device: &Device, manifest: &Manifest) -> Result<(), Error> {
    let refused = |description: String| Error::Pipeline {
        kernel: manifest.kernel.clone(),
        description,
    };
    if let Some(first) = manifest.varyings.first() {
        return Err(refused(format!(
            "its `{}` is interpolated, and a pass has no vertices to interpolate between: draw it in a render pipeline of \
             your own, or generate it for compute, where it is read from a texture",
            first.name
        )));
    }
    for feature in &manifest.features {
        let (needed, why) = match feature.as_str() {
            "subgroup" => (
                wgpu::Features::SUBGROUP,
                "it sends messages by quad operations, and the device was created without the feature SUBGROUP: ask for \
                 that, or generate the shader with the transport `derivatives` or `block`",
            ),
            "shader-f16" => (
                wgpu::Features::SHADER_F16,
                "it computes in half precision, and the device was created without the feature SHADER_F16: ask for that \
                 in `DeviceDescriptor::required_features` where the adapter has it, or generate the shader with the \
                 precision `f32`",
            ),
            _ => return Err(refused(format!("it needs `{feature}`, which this crate does not know"))),
        };
        if !device.features().contains(needed) {
            return Err(refused(why.to_owned()));
        }
    }
    Ok(())
}

fn resources<'n, 'r, R: Into<Resource<'r>> + Copy>(inputs: &[(&'n str, R)]) -> Vec<(&'n str, Resource<'r>)> {
    inputs
        .iter()
        .map(|(name, resource)| (*name, (*resource).into()))
        .collect()
}
