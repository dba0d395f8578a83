//! Bindings that need no runtime, compiled with the version of wgpu that a feature chooses.

#![forbid(unsafe_code)]

#[cfg(feature = "wgpu29")]
extern crate wgpu29 as wgpu;
#[cfg(feature = "wgpu30")]
extern crate wgpu30 as wgpu;

include!("../../../codegen/tests/bindings/straightline_wgpu.rs");

/// Bind group layout and bind group of a pass of `graded`, and a compute pass with both.
pub fn record(
    device: &wgpu::Device,
    pipeline: &wgpu::ComputePipeline,
    resources: &graded::Resources<'_>,
    encoder: &mut wgpu::CommandEncoder,
) {
    let layout = device.create_bind_group_layout(&graded::BIND_GROUP_LAYOUT);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &resources.entries(),
    });
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(pipeline);
    pass.set_bind_group(graded::BIND_GROUP, &group, &[]);
    let size = resources.destination.texture();
    let [x, y, z] = graded::workgroups([size.width(), size.height()]);
    pass.dispatch_workgroups(x, y, z);
}
