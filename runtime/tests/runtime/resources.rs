//! Dispatches that read through samplers, from buffers, by sample, by depth, and from textures of another size.

use crate::common;

use common::{Fixture, Gpu, Kernel, RESOLVE, SCALE, SHADOW, STAGES, Stage, TABLE, clear_depth, view};
use straightline_runtime::{Pass, Resource, wgpu};
use wgpu::{TextureFormat, TextureUsages};

fn pass(gpu: &Gpu, kernel: &Kernel, stage: Stage) -> Pass {
    let Fixture { manifest, wgsl } = kernel.emit(stage);
    Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass")
}

/// A row of the result for `inputs`.
fn run<'r, R: Into<Resource<'r>> + Copy>(gpu: &Gpu, pass: &Pass, width: u32, inputs: &[(&str, R)]) -> Vec<[f32; 4]> {
    let target = gpu.target([width, 1]);
    let mut encoder = gpu.encoder();
    pass.bind(inputs, &view(&target)).expect("to bind").encode(&mut encoder);
    gpu.submit(encoder);
    gpu.download(&target)
}

#[test]
fn a_filtering_sampler_on_a_texture_of_another_size() {
    let gpu = Gpu::new();
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let small = gpu.texture([2, 1], 1, TextureFormat::Rgba8Unorm, usage);
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(8),
        rows_per_image: None,
    };
    let texels = [0, 255, 0, 255, 255, 0, 0, 255];
    gpu.queue
        .write_texture(small.as_image_copy(), &texels, layout, small.size());
    let (small, linear) = (view(&small), gpu.sampler(None));
    for stage in STAGES {
        let pass = pass(&gpu, &SCALE, stage);
        assert_eq!(pass.inputs().collect::<Vec<_>>(), ["small", "linear"]);
        let found = run(
            &gpu,
            &pass,
            4,
            &[("linear", Resource::from(&linear)), ("small", (&small).into())],
        );
        for (pixel, red) in found.iter().zip([0.0, 0.25, 0.75, 1.0]) {
            for (found, wanted) in pixel.iter().zip([red, 1.0 - red, 0.0, 1.0]) {
                // Devices filter with eight bits of weight.
                assert!((found - wanted).abs() <= 1.0 / 128.0, "{stage:?}: {found} for {wanted}");
            }
        }
    }
}

#[test]
fn a_storage_buffer_is_bound_whole() {
    let gpu = Gpu::new();
    // Three elements, each padded to 16 bytes, and less than a fourth.
    let words: Vec<f32> = (0..15).map(|i| i as f32 + 0.5).collect();
    let weights = gpu.storage(&words);
    for stage in STAGES {
        let pass = pass(&gpu, &TABLE, stage);
        let found = run(&gpu, &pass, 3, &[("weights", &weights)]);
        let wanted = [[0.5, 1.5, 2.5, 3.0], [4.5, 5.5, 6.5, 3.0], [8.5, 9.5, 10.5, 3.0]];
        assert_eq!(found, wanted, "{stage:?}");
    }
}

#[test]
fn a_multisampled_texture_is_read_by_sample() {
    let gpu = Gpu::new();
    let color = view(&gpu.multisampled([5, 1], 4, TextureFormat::Rgba16Float));
    let mut encoder = gpu.encoder();
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color {
                    r: 0.25,
                    g: 0.5,
                    b: 2.0,
                    a: 1.0,
                }),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    });
    gpu.submit(encoder);
    for stage in STAGES {
        let pass = pass(&gpu, &RESOLVE, stage);
        let found = run(&gpu, &pass, 5, &[("color", &color)]);
        assert_eq!(found, [[0.25, 0.5, 2.0, 1.0]; 5], "{stage:?}");
    }
}

#[test]
fn a_comparison_sampler_on_a_depth_texture() {
    let gpu = Gpu::new();
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
    let compare = gpu.sampler(Some(wgpu::CompareFunction::Less));
    for format in [TextureFormat::Depth32Float, TextureFormat::Depth24PlusStencil8] {
        let depth = gpu.texture([7, 3], 1, format, usage);
        let only_depth = depth.create_view(&wgpu::TextureViewDescriptor {
            aspect: wgpu::TextureAspect::DepthOnly,
            ..Default::default()
        });
        let mut encoder = gpu.encoder();
        clear_depth(&mut encoder, &view(&depth), format, 0.375);
        gpu.submit(encoder);
        for stage in STAGES {
            let pass = pass(&gpu, &SHADOW, stage);
            let inputs = [("depth", Resource::from(&only_depth)), ("compare", (&compare).into())];
            for (pixel, lit) in run(&gpu, &pass, 4, &inputs).iter().zip([1.0, 1.0, 0.0, 0.0]) {
                assert_eq!(pixel[0], lit, "{format:?} {stage:?}");
                assert!((pixel[1] - 0.375).abs() <= 1.0 / f32::from(u16::MAX), "{}", pixel[1]);
            }
        }
    }
}

#[test]
fn a_kernel_without_inputs() {
    let gpu = Gpu::new();
    let kernel = Kernel {
        name: "plain",
        bindings: &[],
        declarations: "",
        result: "vec4f(vec2f(pixel), 0.0, 1.0)",
    };
    for stage in STAGES {
        let pass = pass(&gpu, &kernel, stage);
        let found = run(&gpu, &pass, 2, &[] as &[(&str, Resource)]);
        assert_eq!(found, [[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0]], "{stage:?}");
    }
}
