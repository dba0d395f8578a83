//! Bindings that use wgpu alone draw what the runtime draws. `tests/plain-wgpu` compiles them with other versions of wgpu.

use crate::common;

use common::bench;
use straightline_bench::execute::test_inputs;
use straightline_codegen::{Kernel, Settings};
use straightline_kernels::prelude::*;
use straightline_manifest::Manifest;
use straightline_runtime::{BindOptions, Pass, Resource};
use wgpu::TextureFormat;

mod without_runtime {
    include!("../../../codegen/tests/bindings/straightline_wgpu.rs");
}

const SIZE: UVec2 = uvec2(45, 31);

/// A pipeline with the layout of the bindings.
fn pipeline(device: &wgpu::Device, group: &wgpu::BindGroupLayout) -> wgpu::ComputePipeline {
    use without_runtime::graded::{ENTRY_POINT, WGSL};
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(group)],
        immediate_size: 0,
    });
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(WGSL.into()),
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&layout),
        module: &module,
        entry_point: Some(ENTRY_POINT),
        compilation_options: Default::default(),
        cache: None,
    })
}

#[test]
fn the_picture_is_that_of_the_runtime() {
    use without_runtime::graded::{
        BIND_GROUP, BIND_GROUP_LAYOUT, MANIFEST, Parameters, Resources, TARGETS, WGSL, workgroups,
    };
    let bench = bench();
    let (device, queue) = (bench.device(), bench.queue());
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../codegen/tests/bindings/kernels/graded.rs"
    );
    let compiled = Kernel::from_file(path.as_ref(), None).and_then(|kernel| kernel.compile(&Settings::default()));
    let inputs = test_inputs(&compiled.unwrap_or_else(|e| panic!("{e}")).graph, SIZE);
    let manifest = Manifest::from_json(MANIFEST).unwrap_or_else(|e| panic!("{e}"));
    let uploaded = bench.upload(&manifest, &inputs).unwrap_or_else(|e| panic!("{e}"));
    let inputs = uploaded.resources();
    let [("lights", Resource::Buffer(lights))] = inputs[..] else {
        panic!("one buffer is read");
    };
    let parameters = Parameters {
        steps: -3,
        ..Parameters::ZERO
    };
    let parameters = parameters
        .with_grade([[0.5, 0.25, 1.0], [2.0, -1.0, 0.0], [0.125, 3.0, 1.5]])
        .with_palette([[1.0, 0.0, 0.5], [0.0, 1.0, 2.0], [0.25, 0.5, 0.75], [-1.0, 4.0, 0.0]])
        .with_offset([0.5, 0.75])
        .with_weights([1.0, 2.0, 0.25]);
    assert_eq!(TARGETS, [TextureFormat::Rgba32Float]);
    let [ours, theirs] = [(), ()].map(|()| bench.create_target(SIZE, TARGETS[0]));
    let view = |target: &wgpu::Texture| target.create_view(&wgpu::TextureViewDescriptor::default());

    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: parameters.to_bytes().len() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    queue.write_buffer(&buffer, 0, &parameters.to_bytes());
    let layout = device.create_bind_group_layout(&BIND_GROUP_LAYOUT);
    let resources = Resources {
        lights,
        destination: &view(&ours),
        parameters: &buffer,
    };
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &resources.entries(),
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_pipeline(&pipeline(device, &layout));
    pass.set_bind_group(BIND_GROUP, &group, &[]);
    let [x, y, z] = workgroups(SIZE.to_array());
    pass.dispatch_workgroups(x, y, z);
    drop(pass);

    let bytes = parameters.to_bytes();
    let pass = Pass::from_json(device, MANIFEST, WGSL).unwrap_or_else(|e| panic!("{e}"));
    let bound = pass.bind_with(&inputs, &view(&theirs), &BindOptions::default().uniforms(&bytes));
    bound.unwrap_or_else(|e| panic!("{e}")).encode(&mut encoder);
    queue.submit([encoder.finish()]);
    let [ours, theirs] = [&ours, &theirs].map(|target| bench.download(target).unwrap_or_else(|e| panic!("{e}")));
    let bits = |picture: &Frame<Vec4>| -> Vec<[u32; 4]> {
        let texels = picture.texels().iter();
        texels.map(|texel| texel.to_array().map(f32::to_bits)).collect()
    };
    assert_eq!(bits(&ours), bits(&theirs));
    assert!(ours.texels().iter().any(|texel| *texel != ours.texels()[0]));
}

/// A dispatch has a workgroup for each part of a target, of several that which needs most.
#[test]
fn workgroups_cover_the_targets() {
    assert_eq!(without_runtime::graded::workgroups([16, 17]), [1, 2, 1]);
    assert_eq!(without_runtime::graded::workgroups([0, 1]), [1, 1, 1]);
    let tiles = without_runtime::levels_quarter_cascade::workgroups([[64, 65], [97, 16]]);
    assert_eq!(tiles, [7, 3, 1]);
    let overrides = without_runtime::faded::Overrides {
        inverted: true,
        ..Default::default()
    };
    assert_eq!(overrides.constants(), [("0", 0.75), ("1", 1.0)]);
    assert_eq!(without_runtime::lit::IMMEDIATE_SIZE, 32);
}
