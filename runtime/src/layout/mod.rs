//! Bind group layouts, and bind groups of the caller's resources.

mod culprit;
mod limits;

use crate::guard::{run_guarded, run_scoped};
use crate::plan::{InputKind, Plan, StagePlan, TexturePlan};
use crate::uniforms::Uniforms;
use crate::{Error, Resource};
use culprit::find_culprit;
use limits::check_limits;
use straightline_manifest::{Format, SampleType, SamplerType, ViewDimension};
use wgpu::{BindGroupLayoutEntry, BindingType, ShaderStages, TextureViewDimension};

/// The layouts of a pass, one for each group that it uses.
#[derive(Debug)]
pub(crate) struct Layout {
    groups: Vec<Group>,
    pub(crate) pipeline: wgpu::PipelineLayout,
}

#[derive(Debug)]
struct Group {
    index: u32,
    layout: wgpu::BindGroupLayout,
}

/// A bind group with the number it is bound to.
pub(crate) type BoundGroup = (u32, wgpu::BindGroup);

impl Layout {
    /// Creates the layouts for `plan`.
    pub(crate) fn new(device: &wgpu::Device, plan: &Plan) -> Result<Self, Error> {
        Self::with_groups(device, plan, &[])
    }

    /// Makes them for a pipeline that has groups of the caller's too.
    pub(crate) fn with_groups(
        device: &wgpu::Device,
        plan: &Plan,
        others: &[(u32, &wgpu::BindGroupLayout)],
    ) -> Result<Self, Error> {
        let mut entries = layout_entries(plan);
        entries.sort_by_key(|(group, entry)| (*group, entry.binding));
        let used = entries.iter().map(|(group, _)| *group);
        let last = used.chain(others.iter().map(|(index, _)| *index)).max();
        check_limits(device, plan, last.unwrap_or(0))?;

        let kernel = &plan.kernel;
        let refused = |description| Error::Pipeline {
            kernel: kernel.to_string(),
            description,
        };
        for (k, (index, _)) in others.iter().enumerate() {
            if entries.iter().any(|(group, _)| group == index) {
                return Err(refused(format!(
                    "the vertex shader's bind group {index} is the kernel's own: give the vertex shader's another number, or generate \
                     the kernel with another `group`"
                )));
            }
            if others[..k].iter().any(|(earlier, _)| earlier == index) {
                return Err(refused(format!(
                    "the vertex shader's bind group {index} is given twice"
                )));
            }
        }
        run_guarded(device, &format!("making the layouts of `{kernel}`"), refused, || {
            let groups: Vec<Group> = entries
                .chunk_by(|a, b| a.0 == b.0)
                .map(|chunk| {
                    let entries: Vec<BindGroupLayoutEntry> = chunk.iter().map(|(_, entry)| *entry).collect();
                    let descriptor = wgpu::BindGroupLayoutDescriptor {
                        label: Some(kernel),
                        entries: &entries,
                    };
                    Group {
                        index: chunk[0].0,
                        layout: device.create_bind_group_layout(&descriptor),
                    }
                })
                .collect();
            // Group numbers may have holes: a kernel can leave low groups to the renderer.
            let mut slots = vec![None; last.map_or(0, |last| last as usize + 1)];
            for group in &groups {
                slots[group.index as usize] = Some(&group.layout);
            }
            for (index, layout) in others {
                slots[*index as usize] = Some(*layout);
            }
            let pipeline = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(kernel),
                bind_group_layouts: &slots,
                immediate_size: plan.immediate_size(),
            });
            Layout { groups, pipeline }
        })
    }

    /// Bind groups of `resources`, which are in the order of `plan.inputs`, and of `targets` that are storage textures, and of
    /// the region's buffer if the shader has one.
    pub(crate) fn bind_resources(
        &self,
        device: &wgpu::Device,
        plan: &Plan,
        uniforms: &Uniforms,
        resources: &[Resource<'_>],
        (targets, region): (&[&wgpu::TextureView], Option<&wgpu::Buffer>),
    ) -> Result<Vec<BoundGroup>, Error> {
        let made = run_scoped(device, || {
            self.groups
                .iter()
                .map(|group| {
                    (
                        group.index,
                        group.create_bind_group(device, plan, uniforms, resources, (targets, region)),
                    )
                })
                .collect()
        });
        made.map_err(|error| match error {
            wgpu::Error::OutOfMemory { .. } => Error::OutOfMemory {
                doing: format!("binding `{}`", plan.kernel),
            },
            other => find_culprit(device, plan, resources, targets, other.to_string()),
        })
    }
}

impl Group {
    fn create_bind_group(
        &self,
        device: &wgpu::Device,
        plan: &Plan,
        uniforms: &Uniforms,
        resources: &[Resource<'_>],
        (targets, region): (&[&wgpu::TextureView], Option<&wgpu::Buffer>),
    ) -> wgpu::BindGroup {
        let mut entries = Vec::with_capacity(plan.inputs.len() + plan.uniforms.len() + plan.outputs.len() + 1);
        let mut add = |group: u32, binding: u32, resource| {
            if group == self.index {
                entries.push(wgpu::BindGroupEntry { binding, resource });
            }
        };
        for (input, resource) in plan.inputs.iter().zip(resources) {
            add(input.group, input.binding, resource.as_binding());
        }
        for (block, buffer) in plan.uniforms.iter().zip(uniforms.buffers()) {
            if let (Some((group, binding)), Some(buffer)) = (block.place, buffer) {
                add(group, binding, buffer.as_entire_binding());
            }
        }
        let place = plan.region.as_ref().and_then(|region| region.place);
        if let (Some((group, binding)), Some(buffer)) = (place, region) {
            add(group, binding, buffer.as_entire_binding());
        }
        for (output, target) in plan.outputs.iter().zip(targets) {
            if let Some((group, binding)) = output.place {
                add(group, binding, wgpu::BindingResource::TextureView(target));
            }
        }
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&plan.kernel),
            layout: &self.layout,
            entries: &entries,
        })
    }
}

/// Every entry with its group.
fn layout_entries(plan: &Plan) -> Vec<(u32, BindGroupLayoutEntry)> {
    let visibility = match plan.stage {
        StagePlan::Compute { .. } => ShaderStages::COMPUTE,
        StagePlan::Fragment => ShaderStages::FRAGMENT,
    };
    let entry = |binding, ty| BindGroupLayoutEntry {
        binding,
        visibility,
        ty,
        count: None,
    };
    let mut entries = Vec::new();
    for input in plan.inputs.iter() {
        entries.push((input.group, entry(input.binding, binding_type(&input.kind))));
    }
    for uniform in plan.uniform_structs() {
        let Some((group, binding)) = uniform.place else {
            continue;
        };
        let ty = BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: wgpu::BufferSize::new(u64::from(uniform.size)),
        };
        entries.push((group, entry(binding, ty)));
    }
    for output in plan.outputs.iter() {
        if let Some((group, binding)) = output.place {
            entries.push((group, entry(binding, storage_type(output.format))));
        }
    }
    entries
}

fn binding_type(kind: &InputKind) -> BindingType {
    match kind {
        InputKind::Texture(texture) => texture_type(texture),
        InputKind::Sampler(sampler) => sampler_type(*sampler),
        InputKind::Buffer(buffer) => BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage {
                read_only: !buffer.written,
            },
            has_dynamic_offset: false,
            // In an empty array, even a clamped read would have no element.
            min_binding_size: wgpu::BufferSize::new(u64::from(buffer.stride)),
        },
    }
}

fn texture_type(texture: &TexturePlan) -> BindingType {
    BindingType::Texture {
        sample_type: match texture.sample_type {
            // Texel reads need no filtering, and formats that cannot be filtered, such as depth, are welcome.
            SampleType::Unfilterable => wgpu::TextureSampleType::Float { filterable: false },
            SampleType::Filterable => wgpu::TextureSampleType::Float { filterable: true },
            SampleType::Depth => wgpu::TextureSampleType::Depth,
            SampleType::Sint => wgpu::TextureSampleType::Sint,
            SampleType::Uint => wgpu::TextureSampleType::Uint,
        },
        view_dimension: match texture.dimension.view() {
            ViewDimension::D2 => TextureViewDimension::D2,
            ViewDimension::D2Array => TextureViewDimension::D2Array,
            ViewDimension::D3 => TextureViewDimension::D3,
            ViewDimension::Cube => TextureViewDimension::Cube,
        },
        multisampled: texture.dimension.is_multisampled(),
    }
}

fn sampler_type(sampler: SamplerType) -> BindingType {
    BindingType::Sampler(match sampler {
        SamplerType::Filtering => wgpu::SamplerBindingType::Filtering,
        SamplerType::NonFiltering => wgpu::SamplerBindingType::NonFiltering,
        SamplerType::Comparison => wgpu::SamplerBindingType::Comparison,
    })
}

fn storage_type(format: Format) -> BindingType {
    BindingType::StorageTexture {
        access: wgpu::StorageTextureAccess::WriteOnly,
        format: texture_format(format),
        view_dimension: TextureViewDimension::D2,
    }
}

/// The wgpu name of a manifest's format.
pub(crate) fn texture_format(format: Format) -> wgpu::TextureFormat {
    match format {
        Format::Rgba8Unorm => wgpu::TextureFormat::Rgba8Unorm,
        Format::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
        Format::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
        Format::R32Float => wgpu::TextureFormat::R32Float,
        Format::Rg32Float => wgpu::TextureFormat::Rg32Float,
        Format::R32Uint => wgpu::TextureFormat::R32Uint,
        Format::Rg32Uint => wgpu::TextureFormat::Rg32Uint,
        Format::Rgba32Uint => wgpu::TextureFormat::Rgba32Uint,
        Format::R32Sint => wgpu::TextureFormat::R32Sint,
        Format::Rg32Sint => wgpu::TextureFormat::Rg32Sint,
        Format::Rgba32Sint => wgpu::TextureFormat::Rgba32Sint,
    }
}
