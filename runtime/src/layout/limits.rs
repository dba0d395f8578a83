//! Limits of the device that a pass can exceed.

use crate::bound::MAX_TARGETS;
use crate::plan::{InputKind, Plan, StagePlan};
use crate::{Error, ResourceKind};

/// The limits that a pass can exceed, each by its own name; wgpu names some of them only in passing.
pub(super) fn check_limits(device: &wgpu::Device, plan: &Plan, last_group: u32) -> Result<(), Error> {
    let limits = device.limits();
    let count = |kind| {
        plan.inputs
            .iter()
            .filter(|input| ResourceKind::of_input(input.kind) == kind)
            .count() as u64
    };
    let [textures, samplers, buffers] = [ResourceKind::Texture, ResourceKind::Sampler, ResourceKind::Buffer].map(count);
    let uniform_buffers = || plan.uniform_structs().filter(|uniform| uniform.place.is_some());
    let mut wanted = vec![
        (
            "max_bind_groups",
            u64::from(last_group) + 1,
            u64::from(limits.max_bind_groups),
        ),
        (
            "max_sampled_textures_per_shader_stage",
            textures,
            u64::from(limits.max_sampled_textures_per_shader_stage),
        ),
        (
            "max_samplers_per_shader_stage",
            samplers,
            u64::from(limits.max_samplers_per_shader_stage),
        ),
        (
            "max_storage_buffers_per_shader_stage",
            buffers,
            u64::from(limits.max_storage_buffers_per_shader_stage),
        ),
        (
            "max_storage_buffer_binding_size",
            plan.inputs
                .iter()
                .map(|input| least_size(&input.kind))
                .max()
                .unwrap_or(0),
            limits.max_storage_buffer_binding_size,
        ),
        (
            "max_uniform_buffers_per_shader_stage",
            uniform_buffers().count() as u64,
            u64::from(limits.max_uniform_buffers_per_shader_stage),
        ),
        (
            "max_uniform_buffer_binding_size",
            uniform_buffers().map(|u| u64::from(u.size)).max().unwrap_or(0),
            limits.max_uniform_buffer_binding_size,
        ),
        (
            "max_immediate_size",
            u64::from(plan.immediate_size()),
            u64::from(limits.max_immediate_size),
        ),
    ];
    let outputs = plan.outputs.len() as u64;
    if let StagePlan::Fragment = plan.stage {
        wanted.push((
            "max_color_attachments",
            outputs,
            u64::from(limits.max_color_attachments.min(MAX_TARGETS as u32)),
        ));
    }
    if let StagePlan::Compute {
        workgroup: [x, y, _], ..
    } = plan.stage
    {
        let invocations = u64::from(x) * u64::from(y);
        wanted.extend([
            (
                "max_storage_textures_per_shader_stage",
                outputs,
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
            kernel: plan.kernel.to_string(),
            limit,
            needed,
            available,
        }),
    }
}

/// Bytes of the smallest storage buffer that can be bound: those of one element.
fn least_size(kind: &InputKind) -> u64 {
    match kind {
        InputKind::Buffer(buffer) => u64::from(buffer.stride),
        InputKind::Texture(_) | InputKind::Sampler(_) => 0,
    }
}
