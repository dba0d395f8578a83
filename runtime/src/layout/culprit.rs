//! Finds the resource that a refused bind group is about. Runs only once something is known to be wrong.

use super::{binding_type, sampler_type, storage_type, texture_type};
use crate::Resource;
use crate::error::{BufferProblem, Error, SamplerProblem, ViewProblem};
use crate::guard::run_scoped;
use crate::plan::{InputKind, Plan, TexturePlan};
use straightline_manifest::{Dimension, SamplerType};
use wgpu::{BindGroupLayoutEntry, BindingResource, BindingType, ShaderStages};

/// Binds each resource alone. If one is rejected, tries the other possible type, to distinguish a wrong type from other
/// errors. `whole` is wgpu's error for all of them together.
pub(super) fn find_culprit(
    device: &wgpu::Device,
    plan: &Plan,
    resources: &[Resource<'_>],
    targets: &[&wgpu::TextureView],
    whole: String,
) -> Error {
    for (input, resource) in plan.inputs.iter().zip(resources) {
        let Err(description) = bind_alone(device, binding_type(&input.kind), resource.as_binding()) else {
            continue;
        };
        let (kernel, name) = (plan.kernel.to_string(), input.name.to_string());
        let fits = |other| bind_alone(device, other, resource.as_binding()).is_ok();
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
    let kernel = plan.kernel.to_string();
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

/// Returns the problem of a view; `fits` returns whether the view can be bound as a type.
fn view_problem(texture: &TexturePlan, description: String, fits: impl Fn(BindingType) -> bool) -> ViewProblem {
    // Views of multisampled textures, and of volumes, are of one dimension only.
    let others = [
        (Dimension::D2, "2d"),
        (Dimension::D2Array, "2d-array"),
        (Dimension::Cube, "cube"),
    ];
    let flat = others.iter().any(|(other, _)| *other == texture.dimension);
    let mut others = others
        .into_iter()
        .filter(|(other, _)| flat && *other != texture.dimension);
    let found = others.find(|(other, _)| {
        fits(texture_type(&TexturePlan {
            dimension: *other,
            ..*texture
        }))
    });
    match found {
        Some((_, found)) => ViewProblem::Dimension {
            needed: texture.dimension,
            found: found.to_owned(),
        },
        None => ViewProblem::Refused { description },
    }
}

/// Returns the problem of a sampler; `fits` returns whether the sampler can be bound as a type.
fn sampler_problem(needed: SamplerType, description: String, fits: impl Fn(BindingType) -> bool) -> SamplerProblem {
    let other = match needed {
        SamplerType::Filtering => [SamplerType::Comparison; 2],
        SamplerType::NonFiltering => [SamplerType::Filtering, SamplerType::Comparison],
        SamplerType::Comparison => [SamplerType::Filtering; 2],
    };
    if other.into_iter().any(|other| fits(sampler_type(other))) {
        SamplerProblem::Type { needed }
    } else {
        SamplerProblem::Refused { description }
    }
}

fn bind_alone(device: &wgpu::Device, ty: BindingType, resource: BindingResource<'_>) -> Result<(), String> {
    let made = run_scoped(device, || {
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
