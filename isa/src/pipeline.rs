//! Pipelines, and the compiler's statistics for them.
#![expect(
    unsafe_code,
    reason = "Vulkan's functions are foreign; each handle is made, used and destroyed in one function"
)]

use super::device::Device;
use super::figures::{Figures, Report};
use super::interface::{Bindings, Interface};
use ash::vk;
use std::ffi::{CStr, CString};

impl Device {
    /// Compiles an entry point of a module, and returns the compiler's report.
    ///
    /// # Errors
    ///
    /// If the words are not a module with such an entry point, or the driver rejects it.
    pub fn compile(&self, words: &[u32], entry: &str) -> Result<Report, String> {
        let interface = Interface::from_words(words, entry).ok_or("no compute or fragment entry point of that name")?;
        let name = CString::new(entry).map_err(|_| "a name with a zero in it")?;
        let refused = |e: vk::Result| format!("the driver refuses it: {e}");
        let mut made = Made::new(&self.device);
        unsafe {
            let layout = made.create_layout(&interface.bindings).map_err(refused)?;
            let module = made.create_module(words).map_err(refused)?;
            let stage = vk::PipelineShaderStageCreateInfo::default()
                .stage(interface.stage)
                .module(module)
                .name(&name);
            let pipeline = match interface.stage {
                vk::ShaderStageFlags::COMPUTE => made.create_compute(stage, layout),
                _ => made.create_fragment(stage, layout),
            };
            self.read_report(pipeline.map_err(refused)?, interface.stage)
                .map_err(refused)
        }
    }

    unsafe fn read_report(&self, pipeline: vk::Pipeline, stage: vk::ShaderStageFlags) -> Result<Report, vk::Result> {
        let (mut figures, mut assembly) = (Figures::default(), String::new());
        let info = vk::PipelineInfoKHR::default().pipeline(pipeline);
        let executables = unsafe { self.properties.get_pipeline_executable_properties(&info) }?;
        for (k, executable) in executables.iter().enumerate() {
            if !executable.stages.contains(stage) {
                continue;
            }
            let info = vk::PipelineExecutableInfoKHR::default()
                .pipeline(pipeline)
                .executable_index(k as u32);
            for figure in unsafe { self.properties.get_pipeline_executable_statistics(&info) }? {
                let name = unsafe { CStr::from_ptr(figure.name.as_ptr()) }.to_string_lossy();
                if figure.format == vk::PipelineExecutableStatisticFormatKHR::UINT64 {
                    let value = unsafe { figure.value.u64 };
                    figures.record_figure(self.driver, &name, value);
                }
            }
            let texts = unsafe { self.read_texts(&info) }?;
            let last = |is: fn(&str) -> bool| texts.iter().rfind(|(name, _)| is(name)).map(|(_, text)| text);
            if let Some(text) = last(|name| name.to_lowercase().ends_with("assembly")) {
                assembly += text;
            }
            if let Some(nir) = last(|name| name.contains("NIR")) {
                figures.count_loops(nir);
            }
        }
        if self.driver == vk::DriverId::MESA_RADV {
            figures.count_instructions(&assembly);
        }
        Ok(Report { figures, assembly })
    }

    /// Texts of a shader on its way to machine code by name, in the compiler's order.
    unsafe fn read_texts(&self, info: &vk::PipelineExecutableInfoKHR) -> Result<Vec<(String, String)>, vk::Result> {
        let get = self
            .properties
            .fp()
            .get_pipeline_executable_internal_representations_khr;
        let device = self.device.handle();
        let mut count = 0;
        unsafe { get(device, info, &mut count, std::ptr::null_mut()) }.result()?;
        let mut all = vec![vk::PipelineExecutableInternalRepresentationKHR::default(); count as usize];
        unsafe { get(device, info, &mut count, all.as_mut_ptr()) }.result()?;
        // Once more, now that their sizes are there.
        let mut texts: Vec<Vec<u8>> = all.iter().map(|one| vec![0; one.data_size]).collect();
        for (one, text) in all.iter_mut().zip(&mut texts) {
            one.p_data = text.as_mut_ptr().cast();
        }
        unsafe { get(device, info, &mut count, all.as_mut_ptr()) }.result()?;
        let named = all.iter().zip(texts).map(|(one, text)| {
            let name = unsafe { CStr::from_ptr(one.name.as_ptr()) }
                .to_string_lossy()
                .into_owned();
            (name, String::from_utf8_lossy(&text).into_owned())
        });
        Ok(named.collect())
    }
}

/// Vulkan objects that are destroyed on drop.
struct Made<'a> {
    device: &'a ash::Device,
    sets: Vec<vk::DescriptorSetLayout>,
    layout: vk::PipelineLayout,
    modules: Vec<vk::ShaderModule>,
    pipeline: vk::Pipeline,
}

/// Bytes of push constants that any module may use: Vulkan's guaranteed minimum.
const PUSH_CONSTANTS: u32 = 128;

impl<'a> Made<'a> {
    fn new(device: &'a ash::Device) -> Made<'a> {
        Made {
            device,
            sets: Vec::new(),
            layout: vk::PipelineLayout::null(),
            modules: Vec::new(),
            pipeline: vk::Pipeline::null(),
        }
    }

    unsafe fn create_layout(&mut self, bindings: &Bindings) -> Result<vk::PipelineLayout, vk::Result> {
        let groups = bindings.keys().next_back().map_or(0, |last| last + 1);
        for group in 0..groups {
            let numbers = bindings.get(&group).into_iter().flatten();
            let all: Vec<_> = numbers
                .map(|(number, kind)| {
                    vk::DescriptorSetLayoutBinding::default()
                        .binding(*number)
                        .descriptor_type(*kind)
                        .descriptor_count(1)
                        .stage_flags(vk::ShaderStageFlags::ALL)
                })
                .collect();
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&all);
            self.sets
                .push(unsafe { self.device.create_descriptor_set_layout(&info, None) }?);
        }
        let constants = [vk::PushConstantRange::default()
            .stage_flags(vk::ShaderStageFlags::ALL)
            .size(PUSH_CONSTANTS)];
        let info = vk::PipelineLayoutCreateInfo::default()
            .set_layouts(&self.sets)
            .push_constant_ranges(&constants);
        self.layout = unsafe { self.device.create_pipeline_layout(&info, None) }?;
        Ok(self.layout)
    }

    unsafe fn create_module(&mut self, words: &[u32]) -> Result<vk::ShaderModule, vk::Result> {
        let info = vk::ShaderModuleCreateInfo::default().code(words);
        let module = unsafe { self.device.create_shader_module(&info, None) }?;
        self.modules.push(module);
        Ok(module)
    }

    unsafe fn create_compute(
        &mut self,
        stage: vk::PipelineShaderStageCreateInfo,
        layout: vk::PipelineLayout,
    ) -> Result<vk::Pipeline, vk::Result> {
        let info = vk::ComputePipelineCreateInfo::default()
            .flags(REPORTED)
            .stage(stage)
            .layout(layout);
        let made = unsafe {
            self.device
                .create_compute_pipelines(vk::PipelineCache::null(), &[info], None)
        };
        self.pipeline = made.map_err(|(_, e)| e)?[0];
        Ok(self.pipeline)
    }

    /// With a triangle over the whole target before it.
    unsafe fn create_fragment(
        &mut self,
        stage: vk::PipelineShaderStageCreateInfo,
        layout: vk::PipelineLayout,
    ) -> Result<vk::Pipeline, vk::Result> {
        let corner = unsafe { self.create_module(&super::vertex::triangle_words()) }?;
        let vertex = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::VERTEX)
            .module(corner)
            .name(c"corner");
        let stages = [vertex, stage];
        let input = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly =
            vk::PipelineInputAssemblyStateCreateInfo::default().topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default()
            .viewport_count(1)
            .scissor_count(1);
        let raster = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
        let samples =
            vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(vk::SampleCountFlags::TYPE_1);
        let target = vk::PipelineColorBlendAttachmentState::default().color_write_mask(vk::ColorComponentFlags::RGBA);
        let targets = [target; TARGETS];
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&targets);
        let changing = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let changing = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&changing);
        let formats = [vk::Format::R16G16B16A16_SFLOAT; TARGETS];
        let mut rendering = vk::PipelineRenderingCreateInfo::default().color_attachment_formats(&formats);
        let info = vk::GraphicsPipelineCreateInfo::default()
            .flags(REPORTED)
            .stages(&stages)
            .vertex_input_state(&input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&raster)
            .multisample_state(&samples)
            .color_blend_state(&blend)
            .dynamic_state(&changing)
            .layout(layout)
            .push_next(&mut rendering);
        let made = unsafe {
            self.device
                .create_graphics_pipelines(vk::PipelineCache::null(), &[info], None)
        };
        self.pipeline = made.map_err(|(_, e)| e)?[0];
        Ok(self.pipeline)
    }
}

/// Colour targets of fragment shaders: no emitted shader has more, and unwritten ones cost nothing.
const TARGETS: usize = 4;

const REPORTED: vk::PipelineCreateFlags = vk::PipelineCreateFlags::from_raw(
    vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR.as_raw()
        | vk::PipelineCreateFlags::CAPTURE_INTERNAL_REPRESENTATIONS_KHR.as_raw(),
);

impl Drop for Made<'_> {
    fn drop(&mut self) {
        unsafe {
            self.device.destroy_pipeline(self.pipeline, None);
            self.device.destroy_pipeline_layout(self.layout, None);
            for module in &self.modules {
                self.device.destroy_shader_module(*module, None);
            }
            for set in &self.sets {
                self.device.destroy_descriptor_set_layout(*set, None);
            }
        }
    }
}
