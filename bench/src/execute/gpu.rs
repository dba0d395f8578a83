//! Emitted shaders on a device: images up, the pass, the picture down.

use super::convert;
use super::parameters::{override_options, uniform_values};
use super::textures::integers_of;
use super::{Address, Comparison, ExecuteError, Inputs, SamplerState, Written, find_entry, has_input};
use glam::{UVec2, Vec4, uvec2};
use straightline_codegen::emit::Emitted;
use straightline_codegen::{Compiled, EmitOptions, Format, Precision, Stage};
use straightline_kernels::prelude::Frame;
use straightline_manifest::{
    Binding, BindingKind, BufferType, Element, Immediates, Manifest, SamplerType, UniformField,
};
use straightline_runtime::{
    BindOptions, Bound, BoundDraw, Draw, Error as RuntimeError, Pass, PassOptions, Region, Resource, Targets,
    UniformValue,
};
use wgpu::{TextureFormat, TextureUsages};

/// A device to run shaders on.
#[derive(Clone, Debug)]
pub struct Bench {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    /// True if passes are timed by the device itself.
    pub(super) timestamps: bool,
    /// Precision that shaders compute in.
    precision: Precision,
}

/// Elements of buffers by name, each in as many lanes as it has.
pub type Buffers = Vec<(String, Vec<[f64; 4]>)>;

/// Outputs of a kernel: its targets, and its buffers.
pub type AllWritten = (Vec<Written>, Buffers);

/// A shader's inputs on a device, and its uniforms.
#[derive(Debug, Default)]
pub struct Uploaded {
    resources: Vec<(String, Owned)>,
    uniforms: Vec<(String, UniformValue)>,
}

#[derive(Clone, Debug)]
enum Owned {
    Texture(wgpu::TextureView),
    Sampler(wgpu::Sampler),
    Buffer(wgpu::Buffer),
}

impl Uploaded {
    /// A pass that reads these inputs, and writes `targets`.
    ///
    /// # Errors
    ///
    /// If they do not fit.
    pub fn bind<'t>(&self, pass: &Pass, targets: impl Into<Targets<'t>>) -> Result<Bound, RuntimeError> {
        pass.bind_with(&self.resources(), targets, &self.bind_options())
    }

    /// A pass that reads these inputs, for a rectangle of `targets`.
    ///
    /// # Errors
    ///
    /// If they or the rectangle do not fit.
    pub fn bind_region<'t>(
        &self,
        pass: &Pass,
        targets: impl Into<Targets<'t>>,
        region: Region,
    ) -> Result<Bound, RuntimeError> {
        pass.bind_with(&self.resources(), targets, &self.bind_options().region(region))
    }

    /// A fragment shader for triangles that reads these inputs.
    ///
    /// # Errors
    ///
    /// If they do not fit.
    pub fn bind_draw(&self, draw: &Draw) -> Result<BoundDraw, RuntimeError> {
        draw.bind_with(&self.resources(), &self.bind_options())
    }

    pub(super) fn bind_options(&self) -> BindOptions<'_> {
        let values = self.uniforms.iter();
        values.fold(BindOptions::default(), |options, (name, value)| {
            options.uniform(name, value.clone())
        })
    }

    /// The inputs as a pass takes them.
    pub fn resources(&self) -> Vec<(&str, Resource<'_>)> {
        let resources = self.resources.iter().map(|(name, owned)| {
            let resource = match owned {
                Owned::Texture(view) => Resource::Texture(view),
                Owned::Sampler(sampler) => Resource::Sampler(sampler),
                Owned::Buffer(buffer) => Resource::Buffer(buffer),
            };
            (name.as_str(), resource)
        });
        resources.collect()
    }

    /// Replaces the resource called `name` by a buffer of the caller's, to be used elsewhere too.
    pub fn with_buffer(mut self, name: &str, buffer: &wgpu::Buffer) -> Uploaded {
        self.resources.retain(|(known, _)| known != name);
        self.resources.push((name.to_owned(), Owned::Buffer(buffer.clone())));
        self
    }

    /// Bytes of all textures and buffers, as they lie on the device.
    pub fn byte_size(&self) -> u64 {
        let bytes = |owned: &Owned| match owned {
            Owned::Texture(view) => texture_bytes(view.texture()),
            Owned::Sampler(_) => 0,
            Owned::Buffer(buffer) => buffer.size(),
        };
        self.resources.iter().map(|(_, owned)| bytes(owned)).sum()
    }
}

/// Bytes of all texels of a texture without smaller levels.
pub fn texture_bytes(texture: &wgpu::Texture) -> u64 {
    let extent = texture.size();
    let texels = [
        extent.width,
        extent.height,
        extent.depth_or_array_layers,
        texture.sample_count(),
    ];
    let each = texture.format().block_copy_size(None).unwrap_or(4);
    texels.map(u64::from).iter().product::<u64>() * u64::from(each)
}

impl Bench {
    /// Works on the caller's device. With `FLOAT32_FILTERABLE` filtered textures keep full precision; with `timestamps`
    /// passes are timed by the device, which must then have `TIMESTAMP_QUERY`, else by the wall clock.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, timestamps: bool) -> Self {
        Bench {
            device: device.clone(),
            queue: queue.clone(),
            timestamps,
            precision: Precision::default(),
        }
    }

    /// Sets the precision that shaders compute in; half precision needs the device's feature `SHADER_F16`.
    pub fn with_precision(mut self, precision: Precision) -> Self {
        self.precision = precision;
        self
    }

    /// Returns the options with which this bench emits kernels: for a stage, writing full floats, whatever half precision
    /// loses.
    pub fn emit_options(&self, stage: Stage) -> EmitOptions {
        let options = EmitOptions::new().stage(stage).precision(self.precision);
        options.accept_loss(true).format(Format::Rgba32Float)
    }

    /// The device.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The device's queue.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// The kernel as a pass that writes full floats, and its manifest.
    ///
    /// # Errors
    ///
    /// If it cannot be emitted, or the device cannot run it.
    pub fn compile_pass(&self, compiled: &Compiled, stage: Stage) -> Result<(Pass, Manifest), ExecuteError> {
        self.emit_pass(compiled, &self.emit_options(stage))
    }

    /// The kernel as a pass emitted with `options`, and its manifest.
    ///
    /// # Errors
    ///
    /// If it cannot be emitted, or the device cannot run it.
    pub fn emit_pass(&self, compiled: &Compiled, options: &EmitOptions) -> Result<(Pass, Manifest), ExecuteError> {
        let emitted = compiled.emit(options)?;
        let pass = self.create_pass(&emitted, &PassOptions::default())?;
        Ok((pass, emitted.manifest))
    }

    /// As [`emit_pass`](Self::emit_pass), with the values of overrides that `inputs` have among the uniforms.
    ///
    /// # Errors
    ///
    /// If it cannot be emitted, the device cannot run it, or an override cannot have its value.
    pub fn emit_pass_for(
        &self,
        compiled: &Compiled,
        options: &EmitOptions,
        inputs: &Inputs,
    ) -> Result<(Pass, Manifest), ExecuteError> {
        let emitted = compiled.emit(options)?;
        let pass = self.create_pass(&emitted, &override_options(&emitted.manifest, inputs))?;
        Ok((pass, emitted.manifest))
    }

    /// Makes a pass of an emitted shader, by its WGSL.
    ///
    /// # Errors
    ///
    /// If the device cannot run it.
    pub fn create_pass(&self, emitted: &Emitted, options: &PassOptions) -> Result<Pass, ExecuteError> {
        Ok(Pass::with_options(
            &self.device,
            &emitted.manifest,
            emitted.wgsl(),
            options,
        )?)
    }

    /// Puts onto the device what a manifest asks for.
    ///
    /// # Errors
    ///
    /// If something is missing, or the device refuses it.
    pub fn upload(&self, manifest: &Manifest, inputs: &Inputs) -> Result<Uploaded, ExecuteError> {
        self.upload_onto(manifest, inputs, &Uploaded::default())
    }

    /// As [`upload`](Self::upload), with what `inputs` does not have taken from what is there already.
    ///
    /// # Errors
    ///
    /// If something is missing in both, or the device refuses it.
    pub fn upload_onto(
        &self,
        manifest: &Manifest,
        inputs: &Inputs,
        there: &Uploaded,
    ) -> Result<Uploaded, ExecuteError> {
        self.upload_bindings((&manifest.bindings, manifest.immediates.as_ref()), inputs, there)
    }

    /// As [`upload_onto`](Self::upload_onto), for bindings by themselves.
    pub(super) fn upload_bindings(
        &self,
        (bindings, immediates): (&[Binding], Option<&Immediates>),
        inputs: &Inputs,
        there: &Uploaded,
    ) -> Result<Uploaded, ExecuteError> {
        let mut resources = Vec::new();
        for binding in bindings {
            let found = there.resources.iter().find(|(name, _)| *name == binding.name);
            let owned = match found.filter(|_| !has_input(inputs, &binding.name)) {
                Some((_, owned)) => Some(owned.clone()),
                None => self.create_resource(binding, inputs)?,
            };
            resources.extend(owned.map(|owned| (binding.name.clone(), owned)));
        }
        Ok(Uploaded {
            resources,
            uniforms: uniform_values(bindings, immediates, inputs),
        })
    }

    /// Makes the resource of a binding; nothing if it is a uniform.
    fn create_resource(&self, binding: &Binding, inputs: &Inputs) -> Result<Option<Owned>, ExecuteError> {
        let missing = |what: &str, name: &str| ExecuteError::Input(format!("no {what} is given for `{name}`"));
        let name = binding.name.as_str();
        Ok(Some(match &binding.kind {
            BindingKind::Texture {
                dimension,
                sample_type,
                components,
                ..
            } => {
                if let Some(scalar) = integers_of(*sample_type) {
                    let layers =
                        find_entry(&inputs.integers, name).ok_or_else(|| missing("image of integers", name))?;
                    Owned::Texture(self.create_integer_texture(layers, *dimension, scalar)?)
                } else {
                    let layers = find_entry(&inputs.images, name).ok_or_else(|| missing("image", name))?;
                    let smaller = find_entry(&inputs.smaller, name).map_or(&[][..], Vec::as_slice);
                    Owned::Texture(self.create_mip_texture(layers, smaller, *dimension, *sample_type, *components)?)
                }
            }
            BindingKind::Sampler { .. } => {
                let state = find_entry(&inputs.samplers, name).copied().unwrap_or_default();
                let is = |of| matches!(&binding.kind, BindingKind::Sampler { sampler } if *sampler == of);
                // A non-filtering sampler is made by the generator, and not among a kernel's inputs.
                let state = match is(SamplerType::NonFiltering) {
                    true => SamplerState::NEAREST,
                    false => state,
                };
                Owned::Sampler(self.create_sampler(state, is(SamplerType::Comparison)))
            }
            BindingKind::Buffer {
                element,
                stride,
                fields,
                ..
            } => {
                let elements = find_entry(&inputs.buffers, name).ok_or_else(|| missing("list of elements", name))?;
                Owned::Buffer(self.create_buffer(elements, element, fields, *stride))
            }
            BindingKind::Uniform { .. } => return Ok(None),
        }))
    }

    /// As [`upload`](Self::upload), with all but uniforms taken from what another shader of the same kernel reads, so that many
    /// shaders share one copy. That shader must read as many components and layers of each texture, or more.
    ///
    /// # Errors
    ///
    /// If the other shader does not read what this one does.
    pub fn share_inputs(
        &self,
        manifest: &Manifest,
        inputs: &Inputs,
        other: &Uploaded,
    ) -> Result<Uploaded, ExecuteError> {
        let mut resources = Vec::new();
        for binding in &manifest.bindings {
            if matches!(binding.kind, BindingKind::Uniform { .. }) {
                continue;
            }
            if let BindingKind::Sampler {
                sampler: SamplerType::NonFiltering,
            } = binding.kind
            {
                let own = Owned::Sampler(self.create_sampler(SamplerState::NEAREST, false));
                resources.push((binding.name.clone(), own));
                continue;
            }
            let found = other.resources.iter().find(|(name, _)| *name == binding.name);
            let shared =
                found.ok_or_else(|| ExecuteError::Input(format!("nothing is given for `{}`", binding.name)))?;
            resources.push(shared.clone());
        }
        Ok(Uploaded {
            resources,
            uniforms: uniform_values(&manifest.bindings, manifest.immediates.as_ref(), inputs),
        })
    }

    /// Every pixel of every target of a kernel, in the order of the kernel's fields.
    ///
    /// # Errors
    ///
    /// If it cannot be emitted or run on these inputs.
    pub fn run_targets(
        &self,
        compiled: &Compiled,
        stage: Stage,
        inputs: &Inputs,
    ) -> Result<Vec<Written>, ExecuteError> {
        let (pass, manifest) = self.emit_pass_for(compiled, &self.emit_options(stage), inputs)?;
        let uploaded = self.upload(&manifest, inputs)?;
        self.written_by(&pass, &uploaded, inputs.size)
    }

    /// Runs a kernel and returns its targets and the contents of the buffers that it writes, by name.
    ///
    /// # Errors
    ///
    /// If it cannot be emitted or run on these inputs.
    pub fn all_written(&self, compiled: &Compiled, stage: Stage, inputs: &Inputs) -> Result<AllWritten, ExecuteError> {
        let (pass, manifest) = self.emit_pass_for(compiled, &self.emit_options(stage), inputs)?;
        let uploaded = self.upload(&manifest, inputs)?;
        let targets = self.written_by(&pass, &uploaded, inputs.size)?;
        Ok((targets, self.read_buffers(&manifest, &uploaded)?))
    }

    /// Reads the current contents of the buffers that a shader writes, by name.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn read_buffers(&self, manifest: &Manifest, uploaded: &Uploaded) -> Result<Buffers, ExecuteError> {
        let mut buffers = Vec::new();
        for binding in &manifest.bindings {
            if let BindingKind::Buffer {
                buffer_type: BufferType::Storage,
                element: Element::Value(ty),
                ..
            } = &binding.kind
                && let Some((name, Owned::Buffer(buffer))) =
                    uploaded.resources.iter().find(|(name, _)| *name == binding.name)
            {
                let bytes = self.bytes_of(buffer)?;
                buffers.push((name.clone(), convert::decode_elements(&bytes, *ty)));
            }
        }
        Ok(buffers)
    }

    /// The bytes of a buffer, read back.
    fn bytes_of(&self, buffer: &wgpu::Buffer) -> Result<Vec<u8>, ExecuteError> {
        let copy = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: buffer.size(),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &copy, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        copy.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait()?;
        let mapped = copy.get_mapped_range(..).map_err(|e| ExecuteError::Device {
            doing: "reading a buffer back",
            message: e.to_string(),
        })?;
        Ok(mapped.to_vec())
    }

    /// Runs a pass on its inputs and returns its targets.
    ///
    /// # Errors
    ///
    /// If it cannot be bound, or the device fails.
    pub fn written_by(&self, pass: &Pass, uploaded: &Uploaded, size: UVec2) -> Result<Vec<Written>, ExecuteError> {
        let textures: Vec<_> = pass
            .targets()
            .map(|(name, format)| (name, self.create_target(size, format)))
            .collect();
        let views: Vec<_> = textures
            .iter()
            .map(|(name, texture)| (*name, texture.create_view(&wgpu::TextureViewDescriptor::default())))
            .collect();
        let targets: Vec<(&str, &wgpu::TextureView)> = views.iter().map(|(name, view)| (*name, view)).collect();
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        uploaded.bind(pass, targets.as_slice())?.encode(&mut encoder);
        self.queue.submit([encoder.finish()]);
        let written = textures.iter().map(|(name, texture)| {
            Ok(Written {
                name: (*name).to_owned(),
                size,
                texels: self.read_texels(texture)?,
            })
        });
        written.collect()
    }

    /// The first target of a kernel, every pixel: its picture, where it gives a colour.
    ///
    /// # Errors
    ///
    /// If it cannot be emitted or run on these inputs.
    pub fn run(&self, compiled: &Compiled, stage: Stage, inputs: &Inputs) -> Result<Frame<Vec4>, ExecuteError> {
        let mut written = self.run_targets(compiled, stage, inputs)?;
        match written.len() {
            0 => Err(ExecuteError::Input(format!("`{}` gives no picture", compiled.kernel))),
            _ => Ok(written.swap_remove(0).frame()),
        }
    }

    /// Runs a pass that writes one target of full floats.
    ///
    /// # Errors
    ///
    /// If it cannot be bound, or the device fails.
    pub fn picture_of(&self, pass: &Pass, uploaded: &Uploaded, size: UVec2) -> Result<Frame<Vec4>, ExecuteError> {
        let target = self.create_target(size, pass.target_format());
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        uploaded.bind(pass, &view)?.encode(&mut encoder);
        self.queue.submit([encoder.finish()]);
        self.download(&target)
    }

    fn create_sampler(&self, state: SamplerState, compares: bool) -> wgpu::Sampler {
        let filter = if state.linear {
            wgpu::FilterMode::Linear
        } else {
            wgpu::FilterMode::Nearest
        };
        let address = match state.address {
            Address::Clamp => wgpu::AddressMode::ClampToEdge,
            Address::Repeat => wgpu::AddressMode::Repeat,
            Address::Mirror => wgpu::AddressMode::MirrorRepeat,
        };
        let compare = match state.comparison {
            Comparison::Less => wgpu::CompareFunction::Less,
            Comparison::LessEqual => wgpu::CompareFunction::LessEqual,
            Comparison::Greater => wgpu::CompareFunction::Greater,
            Comparison::GreaterEqual => wgpu::CompareFunction::GreaterEqual,
        };
        self.device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: address,
            address_mode_v: address,
            address_mode_w: address,
            mag_filter: filter,
            min_filter: filter,
            mipmap_filter: match state.linear_mip {
                true => wgpu::MipmapFilterMode::Linear,
                false => wgpu::MipmapFilterMode::Nearest,
            },
            compare: compares.then_some(compare),
            ..Default::default()
        })
    }

    /// A storage buffer of elements, or of structures of fields.
    fn create_buffer(
        &self,
        elements: &[[f64; 4]],
        element: &Element,
        fields: &[UniformField],
        stride: u32,
    ) -> wgpu::Buffer {
        let bytes = match element {
            Element::Value(ty) => convert::element_bytes(elements, *ty),
            Element::Structure(_) => convert::structure_bytes(elements, fields, stride),
        };
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes.len() as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, &bytes);
        buffer
    }

    /// A target that either stage can write and that can be read back.
    pub fn create_target(&self, size: UVec2, format: TextureFormat) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size.x,
                height: size.y,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            // A result of a chain can be read by its later passes.
            usage: TextureUsages::STORAGE_BINDING
                | TextureUsages::RENDER_ATTACHMENT
                | TextureUsages::TEXTURE_BINDING
                | TextureUsages::COPY_SRC,
            view_formats: &[],
        })
    }

    /// A picture of `rgba32float` texels, read back.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn download(&self, texture: &wgpu::Texture) -> Result<Frame<Vec4>, ExecuteError> {
        let size = uvec2(texture.width(), texture.height());
        let rows = self.read_rows(texture)?;
        let texels = rows
            .iter()
            .flat_map(|line| bytemuck::pod_collect_to_vec::<u8, Vec4>(line));
        Ok(Frame::new(size, texels.collect()))
    }

    /// Texels of 32-bit components, read back: components that the format lacks are 0, and the fourth is 1.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn read_texels(&self, texture: &wgpu::Texture) -> Result<Vec<[f64; 4]>, ExecuteError> {
        let format = texture.format();
        let components = usize::from(format.components());
        let component = |bytes: [u8; 4]| match format.sample_type(None, None) {
            Some(wgpu::TextureSampleType::Uint) => f64::from(u32::from_le_bytes(bytes)),
            Some(wgpu::TextureSampleType::Sint) => f64::from(i32::from_le_bytes(bytes)),
            _ => f64::from(f32::from_le_bytes(bytes)),
        };
        let texel = |bytes: &[u8]| {
            std::array::from_fn(|k| match bytes.get(4 * k..4 * k + 4) {
                Some(&[a, b, c, d]) => component([a, b, c, d]),
                _ => f64::from(u8::from(k == 3)),
            })
        };
        let rows = self.read_rows(texture)?;
        Ok(rows
            .iter()
            .flat_map(|line| line.chunks_exact(4 * components).map(texel).collect::<Vec<_>>())
            .collect())
    }

    /// The bytes of a texture, row by row.
    fn read_rows(&self, texture: &wgpu::Texture) -> Result<Vec<Vec<u8>>, ExecuteError> {
        let bytes = texture.width() * texture.format().block_copy_size(None).unwrap_or(16);
        let row = bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row) * u64::from(texture.height()),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: None,
        };
        let copy = wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), copy, texture.size());
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait()?;
        let mapped = buffer.get_mapped_range(..).map_err(|e| ExecuteError::Device {
            doing: "reading a picture back",
            message: e.to_string(),
        })?;
        let rows = mapped.chunks_exact(row as usize);
        Ok(rows.map(|line| line[..bytes as usize].to_vec()).collect())
    }

    /// Waits until everything submitted is done.
    ///
    /// # Errors
    ///
    /// If the device fails.
    pub fn wait(&self) -> Result<(), ExecuteError> {
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        waited.map(|_| ()).map_err(|e| ExecuteError::Device {
            doing: "waiting for the device",
            message: e.to_string(),
        })
    }
}
