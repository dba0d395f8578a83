//! Bind group layouts, and bind groups of the caller's views.

use crate::error::{Error, ViewProblem};
use crate::guard::{guarded, scoped};
use crate::plan::{OutputPlan, Plan, TexturePlan};
use crate::uniforms::UniformBlock;
use straightline_manifest::{Dimension, Format};
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
    /// Makes the layouts that `plan` asks for.
    pub(crate) fn new(device: &wgpu::Device, plan: &Plan) -> Result<Self, Error> {
        let mut entries = entries(plan);
        entries.sort_by_key(|(group, entry)| (*group, entry.binding));
        check_limits(device, plan, entries.last().map_or(0, |(group, _)| *group))?;

        let kernel = &plan.kernel;
        let refused = |description| Error::Pipeline {
            kernel: kernel.clone(),
            description,
        };
        guarded(device, &format!("making the layouts of `{kernel}`"), refused, || {
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
            let mut slots = vec![None; groups.last().map_or(0, |group| group.index as usize + 1)];
            for group in &groups {
                slots[group.index as usize] = Some(&group.layout);
            }
            let pipeline = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(kernel),
                bind_group_layouts: &slots,
                immediate_size: 0,
            });
            Layout { groups, pipeline }
        })
    }

    /// Bind groups of `views`, which are in the order of `plan.textures`, and of `target` if it is a storage texture.
    pub(crate) fn bind(
        &self,
        device: &wgpu::Device,
        plan: &Plan,
        uniforms: &[UniformBlock],
        views: &[&wgpu::TextureView],
        target: &wgpu::TextureView,
    ) -> Result<Vec<BoundGroup>, Error> {
        let made = scoped(device, || {
            self.groups
                .iter()
                .map(|group| (group.index, group.bind(device, plan, uniforms, views, target)))
                .collect()
        });
        made.map_err(|error| match error {
            wgpu::Error::OutOfMemory { .. } => Error::OutOfMemory {
                doing: format!("binding `{}`", plan.kernel),
            },
            other => culprit(device, plan, views, target, other.to_string()),
        })
    }
}

impl Group {
    fn bind(
        &self,
        device: &wgpu::Device,
        plan: &Plan,
        uniforms: &[UniformBlock],
        views: &[&wgpu::TextureView],
        target: &wgpu::TextureView,
    ) -> wgpu::BindGroup {
        let mut entries = Vec::with_capacity(plan.textures.len() + uniforms.len() + 1);
        let mut add = |group: u32, binding: u32, resource| {
            if group == self.index {
                entries.push(wgpu::BindGroupEntry { binding, resource });
            }
        };
        for (texture, view) in plan.textures.iter().zip(views) {
            add(texture.group, texture.binding, wgpu::BindingResource::TextureView(view));
        }
        for block in uniforms {
            add(block.group, block.binding, block.buffer.as_entire_binding());
        }
        if let OutputPlan::Storage { group, binding, .. } = plan.output {
            add(group, binding, wgpu::BindingResource::TextureView(target));
        }
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&plan.kernel),
            layout: &self.layout,
            entries: &entries,
        })
    }
}

/// Every entry with its group.
fn entries(plan: &Plan) -> Vec<(u32, BindGroupLayoutEntry)> {
    let visibility = match plan.output {
        OutputPlan::Storage { .. } => ShaderStages::COMPUTE,
        OutputPlan::Attachment { .. } => ShaderStages::FRAGMENT,
    };
    let entry = |binding, ty| BindGroupLayoutEntry {
        binding,
        visibility,
        ty,
        count: None,
    };
    let mut entries = Vec::new();
    for texture in &plan.textures {
        entries.push((texture.group, entry(texture.binding, texture_type(texture))));
    }
    for uniform in &plan.uniforms {
        let ty = BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: wgpu::BufferSize::new(u64::from(uniform.size)),
        };
        entries.push((uniform.group, entry(uniform.binding, ty)));
    }
    if let OutputPlan::Storage {
        group, binding, format, ..
    } = plan.output
    {
        entries.push((group, entry(binding, storage_type(format))));
    }
    entries
}

fn texture_type(texture: &TexturePlan) -> BindingType {
    BindingType::Texture {
        // Texel reads need no filtering, and formats that cannot be filtered, such as depth, are welcome.
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: match texture.dimension {
            Dimension::D2 => TextureViewDimension::D2,
            Dimension::D2Array => TextureViewDimension::D2Array,
        },
        multisampled: false,
    }
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
    }
}

/// The limits that a pass can exceed, each by its own name; wgpu names some of them only in passing.
fn check_limits(device: &wgpu::Device, plan: &Plan, last_group: u32) -> Result<(), Error> {
    let limits = device.limits();
    let mut wanted = vec![
        (
            "max_bind_groups",
            u64::from(last_group) + 1,
            u64::from(limits.max_bind_groups),
        ),
        (
            "max_sampled_textures_per_shader_stage",
            plan.textures.len() as u64,
            u64::from(limits.max_sampled_textures_per_shader_stage),
        ),
        (
            "max_uniform_buffers_per_shader_stage",
            plan.uniforms.len() as u64,
            u64::from(limits.max_uniform_buffers_per_shader_stage),
        ),
        (
            "max_uniform_buffer_binding_size",
            plan.uniforms.iter().map(|u| u64::from(u.size)).max().unwrap_or(0),
            limits.max_uniform_buffer_binding_size,
        ),
    ];
    if let OutputPlan::Storage {
        workgroup: [x, y, _], ..
    } = plan.output
    {
        let invocations = u64::from(x) * u64::from(y);
        wanted.extend([
            (
                "max_storage_textures_per_shader_stage",
                1,
                u64::from(limits.max_storage_textures_per_shader_stage),
            ),
            (
                "max_compute_workgroup_size_x",
                u64::from(x),
                u64::from(limits.max_compute_workgroup_size_x),
            ),
            (
                "max_compute_workgroup_size_y",
                u64::from(y),
                u64::from(limits.max_compute_workgroup_size_y),
            ),
            (
                "max_compute_invocations_per_workgroup",
                invocations,
                u64::from(limits.max_compute_invocations_per_workgroup),
            ),
        ]);
    }
    match wanted.into_iter().find(|(_, needed, available)| needed > available) {
        None => Ok(()),
        Some((limit, needed, available)) => Err(Error::Limit {
            kernel: plan.kernel.clone(),
            limit,
            needed,
            available,
        }),
    }
}

/// Which view a refused bind group is about: binds each view alone, and where one is refused, tries the other
/// dimension to tell a wrong dimension from anything else. Runs only once something is known to be wrong.
fn culprit(
    device: &wgpu::Device,
    plan: &Plan,
    views: &[&wgpu::TextureView],
    target: &wgpu::TextureView,
    whole: String,
) -> Error {
    let kernel = || plan.kernel.clone();
    for (texture, view) in plan.textures.iter().zip(views) {
        let Err(description) = bind_alone(device, texture_type(texture), view) else {
            continue;
        };
        let other = match texture.dimension {
            Dimension::D2 => Dimension::D2Array,
            Dimension::D2Array => Dimension::D2,
        };
        let fits_other = bind_alone(
            device,
            texture_type(&TexturePlan {
                dimension: other,
                ..texture.clone()
            }),
            view,
        )
        .is_ok();
        let problem = if fits_other {
            let found = match other {
                Dimension::D2 => "2d",
                Dimension::D2Array => "2d-array",
            };
            ViewProblem::Dimension {
                needed: texture.dimension,
                found: found.to_owned(),
            }
        } else {
            ViewProblem::Refused { description }
        };
        return Error::Input {
            kernel: kernel(),
            name: texture.name.clone(),
            problem,
        };
    }
    if let OutputPlan::Storage { format, .. } = plan.output
        && let Err(description) = bind_alone(device, storage_type(format), target)
    {
        return Error::Target {
            kernel: kernel(),
            problem: ViewProblem::Refused { description },
        };
    }
    Error::Combination {
        kernel: kernel(),
        description: whole.trim().to_owned(),
    }
}

fn bind_alone(device: &wgpu::Device, ty: BindingType, view: &wgpu::TextureView) -> Result<(), String> {
    let made = scoped(device, || {
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[BindGroupLayoutEntry {
                binding: 0,
                visibility: ShaderStages::COMPUTE,
                ty,
                count: None,
            }],
        });
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(view),
            }],
        })
    });
    made.map(drop).map_err(|error| error.to_string().trim().to_owned())
}
