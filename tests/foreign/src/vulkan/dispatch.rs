//! A dispatch of a compute shader.
#![expect(
    unsafe_code,
    reason = "Vulkan's functions are foreign; each handle is made, used and destroyed in one dispatch"
)]

use super::Device;
use super::memory::{ALL_OF_IT, Bytes, Image, Texels};
use ash::vk;
use std::collections::BTreeMap;
use std::ffi::CString;
use std::time::Duration;

/// A resource of a shader with its binding number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// Descriptor set.
    pub set: u32,
    /// Number in the set.
    pub number: u32,
    /// The resource.
    pub resource: Resource,
}

/// Kinds of resources.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Resource {
    /// A texture that is read.
    Texture(Image),
    /// A storage image: initial contents before the dispatch, results after it.
    Target(Image),
    /// A sampler that clamps: linear, or of the nearest texel.
    Sampler {
        /// `true` if texels are interpolated.
        linear: bool,
    },
    /// A uniform buffer.
    Uniform(Vec<u8>),
    /// A storage buffer: initial contents before the dispatch, results after it.
    Buffer(Vec<u8>),
}

/// A dispatch of a compute shader with its resources.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dispatch<'a> {
    /// SPIR-V.
    pub words: &'a [u32],
    /// Name of its entry point.
    pub entry: &'a str,
    /// Workgroups across, down and deep.
    pub groups: [u32; 3],
}

/// Time limit of a dispatch, including its compilation.
const LONGEST: Duration = Duration::from_secs(120);

impl Device {
    /// Runs a compute shader, and stores the final contents of its targets and buffers in `bindings`.
    ///
    /// # Errors
    ///
    /// If the driver refuses the shader or a binding, or does not finish within two minutes.
    pub fn dispatch(&self, dispatch: &Dispatch<'_>, bindings: &mut [Binding]) -> Result<(), String> {
        let entry = CString::new(dispatch.entry).map_err(|_| "a name with a zero in it")?;
        let refused = |e: vk::Result| format!("{}: {e}", self.name());
        let bound = bindings.iter().map(|binding| self.bound(&binding.resource));
        let bound: Vec<Bound<'_>> = bound.collect::<Result<_, _>>().map_err(refused)?;
        let mut made = Made::new(&self.device);
        // SAFETY: what is bound outlives the submission, which is waited for.
        unsafe {
            let pipeline = made.pipeline(dispatch.words, &entry, bindings).map_err(refused)?;
            let sets = made.sets(bindings, &bound).map_err(refused)?;
            let done = made.submitted(self.queue, |commands| {
                for texels in bound.iter().filter_map(Bound::texels) {
                    filled(&self.device, commands, texels);
                }
                let point = vk::PipelineBindPoint::COMPUTE;
                self.device.cmd_bind_pipeline(commands, point, pipeline);
                self.device
                    .cmd_bind_descriptor_sets(commands, point, made.layout, 0, &sets, &[]);
                let [x, y, z] = dispatch.groups;
                self.device.cmd_dispatch(commands, x, y, z);
                for texels in bound.iter().filter_map(Bound::target) {
                    read(&self.device, commands, texels);
                }
                seen_by_host(&self.device, commands);
            });
            if let Err(e) = done {
                // The dispatch may still be running, and using these objects.
                std::mem::forget((made, bound));
                return Err(refused(e));
            }
        }
        for (binding, bound) in bindings.iter_mut().zip(&bound) {
            match (&mut binding.resource, bound) {
                (Resource::Target(image), Bound::Target(texels)) => {
                    image.bytes = texels.staging.read().map_err(refused)?;
                }
                (Resource::Buffer(bytes), Bound::Buffer(buffer)) => *bytes = buffer.read().map_err(refused)?,
                _ => {}
            }
        }
        Ok(())
    }

    fn bound(&self, resource: &Resource) -> Result<Bound<'_>, vk::Result> {
        Ok(match resource {
            Resource::Texture(image) => Bound::Texture(Texels::new(self, image, false)?),
            Resource::Target(image) => Bound::Target(Texels::new(self, image, true)?),
            Resource::Sampler { linear } => Bound::Sampler(Sampler::new(&self.device, *linear)?),
            Resource::Uniform(bytes) => Bound::Uniform(Bytes::new(self, bytes)?),
            Resource::Buffer(bytes) => Bound::Buffer(Bytes::new(self, bytes)?),
        })
    }
}

/// A resource on the device.
enum Bound<'d> {
    Texture(Texels<'d>),
    Target(Texels<'d>),
    Sampler(Sampler<'d>),
    Uniform(Bytes<'d>),
    Buffer(Bytes<'d>),
}

impl<'d> Bound<'d> {
    fn texels(&self) -> Option<&Texels<'d>> {
        match self {
            Bound::Texture(texels) | Bound::Target(texels) => Some(texels),
            _ => None,
        }
    }

    fn target(&self) -> Option<&Texels<'d>> {
        match self {
            Bound::Target(texels) => Some(texels),
            _ => None,
        }
    }
}

struct Sampler<'d>(&'d ash::Device, vk::Sampler);

impl<'d> Sampler<'d> {
    fn new(device: &'d ash::Device, linear: bool) -> Result<Sampler<'d>, vk::Result> {
        let filter = match linear {
            true => vk::Filter::LINEAR,
            false => vk::Filter::NEAREST,
        };
        let edge = vk::SamplerAddressMode::CLAMP_TO_EDGE;
        let info = vk::SamplerCreateInfo::default()
            .mag_filter(filter)
            .min_filter(filter)
            .address_mode_u(edge)
            .address_mode_v(edge)
            .address_mode_w(edge);
        // SAFETY: it is destroyed once, when it goes.
        Ok(Sampler(device, unsafe { device.create_sampler(&info, None) }?))
    }
}

impl Drop for Sampler<'_> {
    fn drop(&mut self) {
        // SAFETY: no command is running.
        unsafe { self.0.destroy_sampler(self.1, None) };
    }
}

fn descriptor_type(resource: &Resource) -> vk::DescriptorType {
    match resource {
        Resource::Texture(_) => vk::DescriptorType::SAMPLED_IMAGE,
        Resource::Target(_) => vk::DescriptorType::STORAGE_IMAGE,
        Resource::Sampler { .. } => vk::DescriptorType::SAMPLER,
        Resource::Uniform(_) => vk::DescriptorType::UNIFORM_BUFFER,
        Resource::Buffer(_) => vk::DescriptorType::STORAGE_BUFFER,
    }
}

/// Vulkan objects, destroyed when dropped.
struct Made<'d> {
    device: &'d ash::Device,
    set_layouts: Vec<vk::DescriptorSetLayout>,
    layout: vk::PipelineLayout,
    module: vk::ShaderModule,
    pipeline: vk::Pipeline,
    descriptors: vk::DescriptorPool,
    commands: std::cell::Cell<vk::CommandPool>,
    fence: std::cell::Cell<vk::Fence>,
}

impl<'d> Made<'d> {
    fn new(device: &'d ash::Device) -> Made<'d> {
        Made {
            device,
            set_layouts: Vec::new(),
            layout: vk::PipelineLayout::null(),
            module: vk::ShaderModule::null(),
            pipeline: vk::Pipeline::null(),
            descriptors: vk::DescriptorPool::null(),
            commands: std::cell::Cell::default(),
            fence: std::cell::Cell::default(),
        }
    }

    unsafe fn pipeline(
        &mut self,
        words: &[u32],
        entry: &std::ffi::CStr,
        bindings: &[Binding],
    ) -> Result<vk::Pipeline, vk::Result> {
        let mut sets: BTreeMap<u32, Vec<vk::DescriptorSetLayoutBinding<'_>>> = BTreeMap::new();
        for binding in bindings {
            let entry = vk::DescriptorSetLayoutBinding::default()
                .binding(binding.number)
                .descriptor_type(descriptor_type(&binding.resource))
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE);
            sets.entry(binding.set).or_default().push(entry);
        }
        let count = sets.keys().next_back().map_or(0, |last| last + 1);
        // SAFETY: all that is pointed at outlives the calls.
        unsafe {
            for set in 0..count {
                let entries = sets.get(&set).map_or(&[][..], Vec::as_slice);
                let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(entries);
                self.set_layouts
                    .push(self.device.create_descriptor_set_layout(&info, None)?);
            }
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&self.set_layouts);
            self.layout = self.device.create_pipeline_layout(&info, None)?;
            let info = vk::ShaderModuleCreateInfo::default().code(words);
            self.module = self.device.create_shader_module(&info, None)?;
            let stage = vk::PipelineShaderStageCreateInfo::default()
                .stage(vk::ShaderStageFlags::COMPUTE)
                .module(self.module)
                .name(entry);
            let info = vk::ComputePipelineCreateInfo::default()
                .stage(stage)
                .layout(self.layout);
            let made = self
                .device
                .create_compute_pipelines(vk::PipelineCache::null(), &[info], None);
            self.pipeline = made.map_err(|(_, e)| e)?[0];
        }
        Ok(self.pipeline)
    }

    /// The descriptor sets of what is bound.
    unsafe fn sets(&mut self, bindings: &[Binding], bound: &[Bound<'_>]) -> Result<Vec<vk::DescriptorSet>, vk::Result> {
        if self.set_layouts.is_empty() {
            return Ok(Vec::new());
        }
        let mut counts: BTreeMap<i32, u32> = BTreeMap::new();
        for binding in bindings {
            *counts.entry(descriptor_type(&binding.resource).as_raw()).or_default() += 1;
        }
        let size = |(ty, count): (&i32, &u32)| vk::DescriptorPoolSize {
            ty: vk::DescriptorType::from_raw(*ty),
            descriptor_count: *count,
        };
        let sizes: Vec<_> = counts.iter().map(size).collect();
        let info = vk::DescriptorPoolCreateInfo::default()
            .max_sets(self.set_layouts.len() as u32)
            .pool_sizes(&sizes);
        // SAFETY: all that is pointed at outlives the calls.
        unsafe {
            self.descriptors = self.device.create_descriptor_pool(&info, None)?;
            let info = vk::DescriptorSetAllocateInfo::default()
                .descriptor_pool(self.descriptors)
                .set_layouts(&self.set_layouts);
            let sets = self.device.allocate_descriptor_sets(&info)?;
            for (binding, bound) in bindings.iter().zip(bound) {
                let write = vk::WriteDescriptorSet::default()
                    .dst_set(sets[binding.set as usize])
                    .dst_binding(binding.number)
                    .descriptor_type(descriptor_type(&binding.resource));
                let (mut image, mut buffer) = (vk::DescriptorImageInfo::default(), vk::DescriptorBufferInfo::default());
                image.image_layout = vk::ImageLayout::GENERAL;
                buffer.range = vk::WHOLE_SIZE;
                match bound {
                    Bound::Texture(texels) | Bound::Target(texels) => image.image_view = texels.view,
                    Bound::Sampler(sampler) => image.sampler = sampler.1,
                    Bound::Uniform(bytes) | Bound::Buffer(bytes) => buffer.buffer = bytes.buffer,
                }
                let (images, buffers) = ([image], [buffer]);
                let write = match bound {
                    Bound::Uniform(_) | Bound::Buffer(_) => write.buffer_info(&buffers),
                    _ => write.image_info(&images),
                };
                self.device.update_descriptor_sets(&[write], &[]);
            }
            Ok(sets)
        }
    }

    /// Records commands, submits them and waits for completion.
    unsafe fn submitted(&self, queue: vk::Queue, record: impl FnOnce(vk::CommandBuffer)) -> Result<(), vk::Result> {
        // SAFETY: the pool, the buffer and the fence are new, and the submission is waited for.
        unsafe {
            let pool = self
                .device
                .create_command_pool(&vk::CommandPoolCreateInfo::default(), None)?;
            self.commands.set(pool);
            let info = vk::CommandBufferAllocateInfo::default()
                .command_pool(pool)
                .command_buffer_count(1);
            let commands = self.device.allocate_command_buffers(&info)?;
            self.device
                .begin_command_buffer(commands[0], &vk::CommandBufferBeginInfo::default())?;
            record(commands[0]);
            self.device.end_command_buffer(commands[0])?;
            let fence = self.device.create_fence(&vk::FenceCreateInfo::default(), None)?;
            self.fence.set(fence);
            let info = vk::SubmitInfo::default().command_buffers(&commands);
            self.device.queue_submit(queue, &[info], fence)?;
            self.device.wait_for_fences(&[fence], true, LONGEST.as_nanos() as u64)
        }
    }
}

impl Drop for Made<'_> {
    fn drop(&mut self) {
        // SAFETY: no command is running; what was not made is null, which is no error.
        unsafe {
            self.device.destroy_fence(self.fence.get(), None);
            self.device.destroy_command_pool(self.commands.get(), None);
            self.device.destroy_descriptor_pool(self.descriptors, None);
            self.device.destroy_pipeline(self.pipeline, None);
            self.device.destroy_shader_module(self.module, None);
            self.device.destroy_pipeline_layout(self.layout, None);
            for layout in &self.set_layouts {
                self.device.destroy_descriptor_set_layout(*layout, None);
            }
        }
    }
}

/// Records the copy of a buffer to its image.
unsafe fn filled(device: &ash::Device, commands: vk::CommandBuffer, texels: &Texels<'_>) {
    let layout = vk::ImageLayout::GENERAL;
    // SAFETY: the commands are being recorded, and the image is as large as its buffer.
    unsafe {
        barrier(device, commands, texels, vk::ImageLayout::UNDEFINED);
        device.cmd_copy_buffer_to_image(commands, texels.staging.buffer, texels.image, layout, &[texels.copy()]);
        barrier(device, commands, texels, layout);
    }
}

/// Records the copy of an image to its buffer.
unsafe fn read(device: &ash::Device, commands: vk::CommandBuffer, texels: &Texels<'_>) {
    let layout = vk::ImageLayout::GENERAL;
    // SAFETY: as in `filled`.
    unsafe {
        barrier(device, commands, texels, layout);
        device.cmd_copy_image_to_buffer(commands, texels.image, layout, texels.staging.buffer, &[texels.copy()]);
    }
}

/// Records a barrier that makes writes visible to the host.
unsafe fn seen_by_host(device: &ash::Device, commands: vk::CommandBuffer) {
    let (all, host) = (vk::PipelineStageFlags::ALL_COMMANDS, vk::PipelineStageFlags::HOST);
    let memory = vk::MemoryBarrier::default()
        .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
        .dst_access_mask(vk::AccessFlags::HOST_READ);
    // SAFETY: the commands are being recorded.
    unsafe { device.cmd_pipeline_barrier(commands, all, host, vk::DependencyFlags::empty(), &[memory], &[], &[]) };
}

/// Records a full barrier, for an image in this layout.
unsafe fn barrier(device: &ash::Device, commands: vk::CommandBuffer, texels: &Texels<'_>, from: vk::ImageLayout) {
    let all = vk::PipelineStageFlags::ALL_COMMANDS;
    let access = vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE;
    let image = vk::ImageMemoryBarrier::default()
        .src_access_mask(access)
        .dst_access_mask(access)
        .old_layout(from)
        .new_layout(vk::ImageLayout::GENERAL)
        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .image(texels.image)
        .subresource_range(ALL_OF_IT);
    // SAFETY: the commands are being recorded.
    unsafe { device.cmd_pipeline_barrier(commands, all, all, vk::DependencyFlags::empty(), &[], &[], &[image]) };
}
