//! Finds the resource that a refused bind group is about. Runs only once something is known to be wrong.

use super::{binding_type, sampler_type, storage_type, texture_type};
use crate::Resource;
use crate::error::{BufferProblem, Error, SamplerProblem, ViewProblem};
use crate::guard::scoped;
use crate::plan::{InputKind, Plan, TexturePlan};
use straightline_manifest::{Dimension, SamplerType};
use wgpu::{BindGroupLayoutEntry, BindingResource, BindingType, ShaderStages};

/// Binds each resource alone, and where one is refused, tries the other type that it could be of, to tell a wrong
/// type from anything else. `whole` is what wgpu said of all of them together.
pub(super) fn culprit(
    device: &wgpu::Device,
    plan: &Plan,
    resources: &[Resource<'_>],
    targets: &[&wgpu::TextureView],
    whole: String,
) -> Error {
    for (input, resource) in plan.inputs.iter().zip(resources) {
        let Err(description) = bind_alone(device, binding_type(&input.kind), resource.binding()) else {
            continue;
        };
        let (kernel, name) = (plan.kernel.clone(), input.name.clone());
        let fits = |other| bind_alone(device, other, resource.binding()).is_ok();
        return match &input.kind {
            InputKind::Texture(texture) => {
                let problem = view_problem(texture, description, fits);
                Error::Input { kernel, name, problem }
            }
            InputKind::Sampler(sampler) => {
                let problem = sampler_problem(*sampler, description, fits);
                Error::InputSampler { kernel, name, problem }
            }
            InputKind::Buffer(_) => {
                let problem = BufferProblem::Refused { description };
                Error::InputBuffer { kernel, name, problem }
            }
        };
    }
    let kernel = plan.kernel.clone();
    for (k, (output, target)) in plan.outputs.iter().zip(targets).enumerate() {
        if output.place.is_some()
            && let Err(description) = bind_alone(
                device,
                storage_type(output.format),
                BindingResource::TextureView(target),
            )
        {
            let (name, problem) = (plan.target_name(k), ViewProblem::Refused { description });
            return Error::Target { kernel, name, problem };
        }
    }
    Error::Combination {
        kernel,
        description: whole.trim().to_owned(),
    }
}

/// `fits` tells whether the view can be bound as a type.
fn view_problem(texture: &TexturePlan, description: String, fits: impl Fn(BindingType) -> bool) -> ViewProblem {
    let (other, found) = match texture.dimension {
        Dimension::D2 => (Dimension::D2Array, "2d-array"),
        Dimension::D2Array => (Dimension::D2, "2d"),
        // Views of multisampled textures are of one dimension only.
        Dimension::D2Multisampled => return ViewProblem::Refused { description },
    };
    let mut changed = *texture;
    changed.dimension = other;
    if fits(texture_type(&changed)) {
        ViewProblem::Dimension {
            needed: texture.dimension,
            found: found.to_owned(),
        }
    } else {
        ViewProblem::Refused { description }
    }
}

/// `fits` tells whether the sampler can be bound as a type.
fn sampler_problem(needed: SamplerType, description: String, fits: impl Fn(BindingType) -> bool) -> SamplerProblem {
    let other = match needed {
        SamplerType::Filtering => SamplerType::Comparison,
        SamplerType::Comparison => SamplerType::Filtering,
    };
    if fits(sampler_type(other)) {
        SamplerProblem::Type { needed }
    } else {
        SamplerProblem::Refused { description }
    }
}

fn bind_alone(device: &wgpu::Device, ty: BindingType, resource: BindingResource<'_>) -> Result<(), String> {
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
            entries: &[wgpu::BindGroupEntry { binding: 0, resource }],
        })
    });
    made.map(drop).map_err(|error| error.to_string().trim().to_owned())
}
