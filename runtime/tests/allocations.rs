//! Recording a bound pass allocates only what wgpu allocates.

mod common;

use allocation_counter::{AllocationInfo, measure};
use common::chains::{make_of, pass, picture, plan, sizes};
use common::{COPY, Fixture, Gpu, STAGES, Stage, tinted, view};
use straightline_runtime::{BindOptions, Bound, Draw, DrawOptions, Pass, wgpu};
use wgpu::{TextureFormat, TextureUsages, TextureView};

const SIZE: [u32; 2] = [16, 8];

const COVER: &str = "@vertex fn cover(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(f32(k & 1u) * 4.0 - 1.0, f32(k >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}";

/// The equivalent of a pass in direct wgpu calls.
enum Handwritten {
    Compute(wgpu::ComputePipeline, wgpu::BindGroup),
    Render(wgpu::RenderPipeline, wgpu::BindGroup, TextureView),
}

impl Handwritten {
    fn new(gpu: &Gpu, stage: Stage, color: &TextureView, target: &TextureView) -> Self {
        let module = |text: &str| {
            gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl(text.into()),
            })
        };
        let Fixture { wgsl, .. } = COPY.emit(stage);
        let color = wgpu::BindGroupEntry {
            binding: 0,
            resource: wgpu::BindingResource::TextureView(color),
        };
        let group = |layout: wgpu::BindGroupLayout, entries: &[wgpu::BindGroupEntry<'_>]| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &layout,
                entries,
            })
        };
        match stage {
            Stage::Compute => {
                let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: None,
                    layout: None,
                    module: &module(&wgsl),
                    entry_point: None,
                    compilation_options: Default::default(),
                    cache: None,
                });
                let output = wgpu::BindGroupEntry {
                    binding: 15,
                    resource: wgpu::BindingResource::TextureView(target),
                };
                let group = group(pipeline.get_bind_group_layout(0), &[color, output]);
                Handwritten::Compute(pipeline, group)
            }
            Stage::Fragment => {
                let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                    label: None,
                    layout: None,
                    vertex: wgpu::VertexState {
                        module: &module(COVER),
                        entry_point: None,
                        compilation_options: Default::default(),
                        buffers: &[],
                    },
                    primitive: Default::default(),
                    depth_stencil: None,
                    multisample: Default::default(),
                    fragment: Some(wgpu::FragmentState {
                        module: &module(&wgsl),
                        entry_point: None,
                        compilation_options: Default::default(),
                        targets: &[Some(TextureFormat::Rgba32Float.into())],
                    }),
                    multiview_mask: None,
                    cache: None,
                });
                let group = group(pipeline.get_bind_group_layout(0), &[color]);
                Handwritten::Render(pipeline, group, target.clone())
            }
        }
    }

    fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        match self {
            Handwritten::Compute(..) => compute(encoder, |pass| self.dispatch(pass)),
            Handwritten::Render(pipeline, group, target) => {
                render(encoder, target, |pass| {
                    pass.set_pipeline(pipeline);
                    pass.set_bind_group(0, group, &[]);
                    pass.draw(0..3, 0..1);
                });
            }
        }
    }

    fn dispatch(&self, pass: &mut wgpu::ComputePass<'_>) {
        let Handwritten::Compute(pipeline, group) = self else {
            panic!("a compute shader");
        };
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(SIZE[0] / 8, SIZE[1] / 8, 1);
    }
}

/// Opens a compute pass of `copy`.
fn compute(encoder: &mut wgpu::CommandEncoder, record: impl FnOnce(&mut wgpu::ComputePass<'_>)) {
    compute_labelled(encoder, "copy", record);
}

/// Opens a compute pass. wgpu allocates its label.
fn compute_labelled(encoder: &mut wgpu::CommandEncoder, label: &str, record: impl FnOnce(&mut wgpu::ComputePass<'_>)) {
    record(&mut encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
        label: Some(label),
        timestamp_writes: None,
    }));
}

/// Opens a render pass to `target`.
fn render(encoder: &mut wgpu::CommandEncoder, target: &TextureView, record: impl FnOnce(&mut wgpu::RenderPass<'_>)) {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("copy"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    });
    record(&mut pass);
}

/// Counts the allocations of recording one frame.
fn frame(gpu: &Gpu, record: impl FnOnce(&mut wgpu::CommandEncoder)) -> AllocationInfo {
    let mut encoder = gpu.encoder();
    let info = measure(|| record(&mut encoder));
    gpu.submit(encoder);
    info
}

/// Records both often enough that what is allocated once only does not count, and compares.
fn same(
    gpu: &Gpu,
    ours: impl Fn(&mut wgpu::CommandEncoder),
    handwritten: impl Fn(&mut wgpu::CommandEncoder),
    what: &str,
) {
    for _ in 0..3 {
        frame(gpu, &ours);
        frame(gpu, &handwritten);
    }
    let [ours, theirs] = [frame(gpu, ours), frame(gpu, handwritten)];
    assert!(theirs.count_total > 0, "wgpu allocates, and it is seen");
    assert_eq!(
        (ours.count_total, ours.bytes_total),
        (theirs.count_total, theirs.bytes_total),
        "{what}"
    );
}

#[test]
fn a_frame_allocates_what_wgpu_does() {
    let gpu = Gpu::new();
    let color = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba8Unorm, TextureUsages::TEXTURE_BINDING));
    for stage in STAGES {
        let Fixture { manifest, wgsl } = COPY.emit(stage);
        let target = view(&gpu.target(SIZE));
        let pass = Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass");
        let bound: Bound = pass.bind(&[("color", &color)], &target).expect("to bind");
        let handwritten = Handwritten::new(&gpu, stage, &color, &target);
        same(
            &gpu,
            |encoder| bound.encode(encoder),
            |encoder| handwritten.encode(encoder),
            stage.name(),
        );
        match &handwritten {
            Handwritten::Compute(..) => same(
                &gpu,
                |encoder| compute(encoder, |pass| bound.encode_into(pass).expect("a compute shader")),
                |encoder| {
                    compute(encoder, |pass| {
                        pass.push_debug_group("copy");
                        handwritten.dispatch(pass);
                        pass.pop_debug_group();
                    });
                },
                "in a compute pass",
            ),
            Handwritten::Render(pipeline, group, _) => same(
                &gpu,
                |encoder| {
                    render(encoder, &target, |pass| {
                        bound.draw_into(pass).expect("a fragment shader")
                    })
                },
                |encoder| {
                    render(encoder, &target, |pass| {
                        pass.push_debug_group("copy");
                        pass.set_pipeline(pipeline);
                        pass.set_bind_group(0, group, &[]);
                        pass.draw(0..3, 0..1);
                        pass.pop_debug_group();
                    });
                },
                "in a render pass",
            ),
        }
    }
    let Fixture { manifest, wgsl } = COPY.emit(Stage::Fragment);
    let target = view(&gpu.target(SIZE));
    let options = DrawOptions::new(COVER, "cover");
    let draw = Draw::from_json(&gpu.device, &manifest, &wgsl, &options).expect("it fits");
    let bound = draw.bind(&[("color", &color)]).expect("to bind");
    let handwritten = Handwritten::new(&gpu, Stage::Fragment, &color, &target);
    same(
        &gpu,
        |encoder| {
            render(encoder, &target, |pass| {
                bound.set(pass);
                pass.draw(0..3, 0..1);
            });
        },
        |encoder| handwritten.encode(encoder),
        "drawn",
    );
}

/// The bytes of immediates are kept: recording and setting them allocates nothing beside wgpu.
#[test]
fn immediates_allocate_what_wgpu_does() {
    let gpu = Gpu::with_immediates(32);
    let color = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba8Unorm, TextureUsages::TEXTURE_BINDING));
    let target = view(&gpu.target(SIZE));
    let Fixture { manifest, wgsl } = tinted(Stage::Compute);
    let pass = Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass");
    let options = BindOptions::default().uniform("offset", [0.0; 4]);
    let bound = pass
        .bind_with(&[("color", &color)], &target, &options)
        .expect("to bind");
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(wgsl.into()),
    });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: None,
        compilation_options: Default::default(),
        cache: None,
    });
    let entry = |binding, view| wgpu::BindGroupEntry {
        binding,
        resource: wgpu::BindingResource::TextureView(view),
    };
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[entry(0, &color), entry(15, &target)],
    });
    same(
        &gpu,
        |encoder| {
            bound.write_uniform(&gpu.queue, "scale", 0.5_f32).expect("a uniform");
            bound.encode(encoder);
        },
        |encoder| {
            compute_labelled(encoder, bound.kernel(), |pass| {
                pass.set_pipeline(&pipeline);
                pass.set_bind_group(0, &group, &[]);
                pass.set_immediates(0, &[0; 32]);
                pass.dispatch_workgroups(SIZE[0] / 8, SIZE[1] / 8, 1);
            });
        },
        "with immediates",
    );
}

#[test]
fn a_frame_of_a_chain_allocates_what_its_passes_do() {
    let gpu = Gpu::new();
    let color = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba8Unorm, TextureUsages::TEXTURE_BINDING));
    let [full, _] = sizes();
    let plan = plan(
        &["color"],
        vec![picture("copy", &full, Some(0)), picture("out", &full, None)],
        vec![
            pass("copy", &[("color", "color")], &["copy"]),
            pass("copy", &[("color", "copy")], &["out"]),
        ],
    );
    for stage in STAGES {
        let chain = make_of(&gpu, &plan, &[&COPY], stage).expect("a chain");
        let target = view(&gpu.target(SIZE));
        let bound = chain.bind(&[("color", &color)], &target).expect("to bind");
        let copy = bound.picture("copy").expect("a picture");
        let handwritten = [
            Handwritten::new(&gpu, stage, &color, copy),
            Handwritten::new(&gpu, stage, copy, &target),
        ];
        same(
            &gpu,
            |encoder| bound.encode(encoder),
            |encoder| {
                encoder.push_debug_group(bound.name());
                handwritten.iter().for_each(|pass| pass.encode(encoder));
                encoder.pop_debug_group();
            },
            stage.name(),
        );
        if let Stage::Compute = stage {
            same(
                &gpu,
                |encoder| compute(encoder, |pass| bound.encode_into(pass).expect("compute shaders")),
                |encoder| {
                    compute(encoder, |pass| {
                        pass.push_debug_group(bound.name());
                        for dispatch in &handwritten {
                            pass.push_debug_group("copy");
                            dispatch.dispatch(pass);
                            pass.pop_debug_group();
                        }
                        pass.pop_debug_group();
                    });
                },
                "in a compute pass",
            );
        }
    }
}
