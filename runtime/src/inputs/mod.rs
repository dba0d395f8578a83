//! Checks of the caller's resources against a shader's reads and writes, before wgpu sees them.

mod target;
mod texture;

use crate::error::{BufferProblem, Error, Names};
use crate::plan::{BufferPlan, InputKind, InputPlan, Plan};
use crate::{Resource, ResourceKind};
use straightline_manifest::Extent;
use texture::check_texture;
use wgpu::{Buffer, BufferUsages, Device, Features, TextureView};

pub(crate) use target::check_targets;
pub(crate) use texture::{check_readable, is_one_image, texture_size};

/// Bytes of which the size of a storage binding must be a multiple, by WebGPU.
const SIZE_ALIGNMENT: u64 = 4;

/// Features and limits of a device that decide whether a resource fits. Asked once, as wgpu copies all of its limits each time.
#[derive(Debug)]
pub(crate) struct Abilities {
    features: Features,
    max_workgroups: u32,
    max_storage_binding: u64,
}

impl Abilities {
    /// Reads the features and limits of `device`.
    pub(crate) fn new(device: &Device) -> Self {
        let limits = device.limits();
        Abilities {
            features: device.features(),
            max_workgroups: limits.max_compute_workgroups_per_dimension,
            max_storage_binding: limits.max_storage_buffer_binding_size,
        }
    }

    /// Most pixels along one axis that a dispatch covers, if a workgroup covers `each`.
    pub(crate) fn most_pixels(&self, each: u32) -> u32 {
        self.max_workgroups.saturating_mul(each)
    }
}

/// The resources for `plan.inputs`, in that order: each exactly once, of its kind, and nothing else.
pub(crate) fn arrange_inputs<'r>(plan: &Plan, given: &[(&str, Resource<'r>)]) -> Result<Vec<Resource<'r>>, Error> {
    let kind = |input: &InputPlan| Some(ResourceKind::of_input(input.kind));
    let needed: Vec<_> = plan.inputs.iter().map(|input| (&*input.name, kind(input))).collect();
    arrange_resources(&plan.kernel, &needed, given)
}

/// The resources for the inputs `needed` of `kernel`, in that order: each exactly once, of its kind if that is known, and
/// nothing else.
pub(crate) fn arrange_resources<'r>(
    kernel: &str,
    needed: &[(&str, Option<ResourceKind>)],
    given: &[(&str, Resource<'r>)],
) -> Result<Vec<Resource<'r>>, Error> {
    let known = || needed.iter().map(|(name, _)| *name).collect::<Names>();
    for (i, (name, _)) in given.iter().enumerate() {
        if needed.iter().all(|(needed, _)| needed != name) {
            return Err(Error::UnknownInput {
                kernel: kernel.to_owned(),
                name: (*name).to_owned(),
                known: known(),
            });
        }
        if given[..i].iter().any(|(earlier, _)| earlier == name) {
            return Err(Error::DuplicateInput {
                kernel: kernel.to_owned(),
                name: (*name).to_owned(),
            });
        }
    }
    let arranged = needed.iter().map(|(name, kind)| {
        let (_, resource) = given
            .iter()
            .find(|(given, _)| given == name)
            .ok_or_else(|| Error::MissingInput {
                kernel: kernel.to_owned(),
                name: (*name).to_owned(),
                known: known(),
            })?;
        match kind {
            Some(kind) if *kind != resource.kind() => Err(Error::InputKind {
                kernel: kernel.to_owned(),
                name: (*name).to_owned(),
                needed: *kind,
                given: resource.kind(),
            }),
            _ => Ok(*resource),
        }
    });
    arranged.collect()
}

/// Size of the first texture that is to have the frame's: the target's, unless a region is filtered.
pub(crate) fn frame_size(plan: &Plan, resources: &[Resource<'_>]) -> Option<[u32; 2]> {
    let mut pairs = plan.inputs.iter().zip(resources);
    pairs.find_map(|(input, resource)| match (&input.kind, resource) {
        (InputKind::Texture(texture), Resource::Texture(view)) if texture.extent == Extent::Output => {
            Some(texture_size(view.texture()))
        }
        _ => None,
    })
}

/// Checks each input against the manifest, the device and the frame's size. `resources` is as [`arrange_inputs`] made it.
pub(crate) fn check_inputs(
    plan: &Plan,
    abilities: &Abilities,
    resources: &[Resource<'_>],
    frame: [u32; 2],
) -> Result<(), Error> {
    for (input, resource) in plan.inputs.iter().zip(resources) {
        let names = || (plan.kernel.to_string(), input.name.to_string());
        match (&input.kind, resource) {
            (InputKind::Texture(texture), Resource::Texture(view)) => {
                check_texture(texture, abilities, view.texture(), frame).map_err(|problem| {
                    let (kernel, name) = names();
                    Error::Input { kernel, name, problem }
                })?;
            }
            (InputKind::Buffer(plan), Resource::Buffer(buffer)) => {
                check_buffer(plan, abilities, buffer).map_err(|problem| {
                    let (kernel, name) = names();
                    Error::InputBuffer { kernel, name, problem }
                })?;
            }
            // wgpu exposes nothing about a sampler; it is checked when it is bound.
            _ => {}
        }
    }
    check_aliases(plan, resources)
}

/// Refuses a buffer that is written and bound under another name, too: all of it is bound, so the two overlap.
fn check_aliases(plan: &Plan, resources: &[Resource<'_>]) -> Result<(), Error> {
    let bound = || plan.inputs.iter().zip(resources);
    for (k, (input, resource)) in bound().enumerate() {
        let (InputKind::Buffer(BufferPlan { written: true, .. }), Resource::Buffer(buffer)) = (&input.kind, resource)
        else {
            continue;
        };
        let is_same = |other: &Resource<'_>| matches!(other, Resource::Buffer(other) if other == buffer);
        let other = bound().enumerate().find(|(n, (_, other))| *n != k && is_same(other));
        if let Some((_, (other, _))) = other {
            return Err(Error::InputBuffer {
                kernel: plan.kernel.to_string(),
                name: input.name.to_string(),
                problem: BufferProblem::IsOther {
                    other: other.name.to_string(),
                },
            });
        }
    }
    Ok(())
}

/// Checks `buffer`, which is bound whole. What is left after the last whole element is not read.
fn check_buffer(plan: &BufferPlan, abilities: &Abilities, buffer: &Buffer) -> Result<(), BufferProblem> {
    if !buffer.usage().contains(BufferUsages::STORAGE) {
        return Err(BufferProblem::Usage { missing: "STORAGE" });
    }
    let size = buffer.size();
    if size < u64::from(plan.stride) {
        let stride = plan.stride;
        return Err(BufferProblem::TooSmall { size, stride });
    }
    if size > abilities.max_storage_binding {
        let max = abilities.max_storage_binding;
        return Err(BufferProblem::TooLarge { size, max });
    }
    if !size.is_multiple_of(SIZE_ALIGNMENT) {
        return Err(BufferProblem::Unaligned { size });
    }
    Ok(())
}

/// The first input that is of a target's texture, and which target that is. Whether it shows the same part of it, only wgpu
/// knows.
pub(crate) fn find_shared<'p, 't>(
    plan: &'p Plan,
    resources: &[Resource<'_>],
    targets: &[&'t TextureView],
) -> Option<(&'p InputPlan, &'t TextureView)> {
    let mut pairs = plan.inputs.iter().zip(resources);
    pairs.find_map(|(input, resource)| match resource {
        Resource::Texture(view) => {
            let target = targets.iter().find(|target| target.texture() == view.texture());
            target.map(|target| (input, *target))
        }
        _ => None,
    })
}
