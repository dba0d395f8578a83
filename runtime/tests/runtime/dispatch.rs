//! Real dispatches: the output equals the shader's definition, pixel by pixel.

use crate::common;

use common::{ADD, COPY, Fixture, Gpu, Kernel, LAYERS, STAGES, Stage, array_view, clear_depth, ramp, view};
use straightline_runtime::manifest::Manifest;
use straightline_runtime::{BindOptions, Pass, PassOptions, Passes, Shader, wgpu};
use wgpu::{TextureFormat, TextureUsages};

const SIZES: [[u32; 2]; 6] = [[1, 1], [1, 7], [7, 1], [8, 8], [9, 16], [33, 17]];

fn pass(gpu: &Gpu, kernel: &Kernel, stage: Stage) -> Pass {
    let Fixture { manifest, wgsl } = kernel.emit(stage);
    Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass")
}

#[test]
fn copies_every_pixel_of_any_size() {
    let gpu = Gpu::new();
    for stage in STAGES {
        let pass = pass(&gpu, &COPY, stage);
        for size in SIZES {
            let color = gpu.upload(size, 1, &ramp(size, 1));
            let target = gpu.target(size);
            let mut encoder = gpu.encoder();
            pass.bind(&[("color", &view(&color))], &view(&target))
                .expect("to bind")
                .encode(&mut encoder);
            gpu.submit(encoder);
            assert_eq!(gpu.download(&target), ramp(size, 1), "{stage:?} {size:?}");
        }
    }
}

#[test]
fn reads_layers_and_takes_inputs_in_any_order() {
    let gpu = Gpu::new();
    let size = [33, 17];
    let (color, depth) = (gpu.upload(size, 1, &ramp(size, 1)), gpu.upload(size, 4, &ramp(size, 4)));
    let count = (size[0] * size[1]) as usize;
    let layers = ramp(size, 4);
    let wanted: Vec<[f32; 4]> = (0..count)
        .map(|i| {
            [
                layers[i][0],
                layers[count + i][0],
                layers[2 * count + i][0],
                ramp(size, 1)[i][3],
            ]
        })
        .collect();
    for stage in STAGES {
        let pass = pass(&gpu, &LAYERS, stage);
        assert_eq!(pass.inputs().collect::<Vec<_>>(), ["color", "depth"]);
        let target = gpu.target(size);
        let mut encoder = gpu.encoder();
        let inputs = [("depth", &array_view(&depth)), ("color", &view(&color))];
        pass.bind(&inputs, &view(&target))
            .expect("to bind")
            .encode(&mut encoder);
        gpu.submit(encoder);
        assert_eq!(gpu.download(&target), wanted, "{stage:?}");
    }
}

#[test]
fn uniforms_start_from_defaults_and_keep_what_is_written() {
    let gpu = Gpu::new();
    let size = [5, 3];
    let color = view(&gpu.upload(size, 1, &ramp(size, 1)));
    let expect = |offset: [f32; 4], scale: f32, steps: f32| -> Vec<[f32; 4]> {
        ramp(size, 1)
            .iter()
            .map(|p| [0, 1, 2, 3].map(|c| p[c] * scale + offset[c] + steps))
            .collect()
    };
    for stage in STAGES {
        let pass = pass(&gpu, &ADD, stage);
        let targets = [gpu.target(size), gpu.target(size)];
        let bind = |target, offset: [f32; 4]| {
            let options = BindOptions::default().uniform("offset", offset);
            pass.bind_with(&[("color", &color)], &view(target), &options)
                .expect("to bind")
        };
        let bounds = [bind(&targets[0], [1.0, 2.0, 3.0, 4.0]), bind(&targets[1], [0.5; 4])];
        let run = || {
            let mut encoder = gpu.encoder();
            bounds.iter().for_each(|bound| bound.encode(&mut encoder));
            gpu.submit(encoder);
            targets.each_ref().map(|target| gpu.download(target))
        };
        let other = expect([0.5; 4], 2.0, -3.0);
        let [bound, _] = &bounds;
        let wanted = expect([1.0, 2.0, 3.0, 4.0], 2.0, -3.0);
        assert_eq!(run(), [wanted, other.clone()], "{stage:?}, defaults");
        bound.write_uniform(&gpu.queue, "scale", 0.5).expect("an f32");
        bound.write_uniform(&gpu.queue, "steps", 10).expect("an i32");
        let wanted = expect([1.0, 2.0, 3.0, 4.0], 0.5, 10.0);
        assert_eq!(run(), [wanted, other.clone()], "{stage:?}, written");
        bound
            .write_uniforms(&gpu.queue, &params([4.0, 3.0, 2.0, 1.0], 4.0, -1))
            .expect("a whole struct");
        let wanted = expect([4.0, 3.0, 2.0, 1.0], 4.0, -1.0);
        assert_eq!(run(), [wanted, other], "{stage:?}, at once");
    }
}

/// The struct of `ADD` as it lies in the buffer.
fn params(offset: [f32; 4], scale: f32, steps: i32) -> Vec<u8> {
    let mut bytes: Vec<u8> = offset.iter().flat_map(|v| v.to_le_bytes()).collect();
    bytes.extend(scale.to_le_bytes());
    bytes.extend(steps.to_le_bytes());
    bytes.resize(32, 0);
    bytes
}

#[test]
fn a_whole_struct_sets_what_has_no_default() {
    let gpu = Gpu::new();
    let size = [3, 2];
    let color = gpu.upload(size, 1, &ramp(size, 1));
    let target = gpu.target(size);
    let pass = pass(&gpu, &ADD, Stage::Compute);
    let bytes = params([1.0; 4], 1.0, -2);
    // Single values count before those of the whole struct.
    let options = BindOptions::default().uniform("steps", -1).uniforms(&bytes);
    let mut encoder = gpu.encoder();
    pass.bind_with(&[("color", &view(&color))], &view(&target), &options)
        .expect("no uniform to be missing")
        .encode(&mut encoder);
    gpu.submit(encoder);
    assert_eq!(gpu.download(&target), ramp(size, 1));
}

#[test]
fn passes_chain_in_one_encoder() {
    let gpu = Gpu::new();
    let size = [19, 6];
    let color = gpu.upload(size, 1, &ramp(size, 1));
    for (first, second) in [(Stage::Compute, Stage::Fragment), (Stage::Fragment, Stage::Compute)] {
        let (copy, add) = (pass(&gpu, &COPY, first), pass(&gpu, &ADD, second));
        let options = BindOptions::default().uniform("offset", [0.0; 4]);
        let (middle, target) = (gpu.target(size), gpu.target(size));
        let mut encoder = gpu.encoder();
        copy.bind(&[("color", &view(&color))], &view(&middle))
            .expect("to bind")
            .encode(&mut encoder);
        add.bind_with(&[("color", &view(&middle))], &view(&target), &options)
            .expect("to bind")
            .encode(&mut encoder);
        gpu.submit(encoder);
        let wanted: Vec<[f32; 4]> = ramp(size, 1).iter().map(|p| p.map(|v| v * 2.0 - 3.0)).collect();
        assert_eq!(gpu.download(&target), wanted, "{first:?} then {second:?}");
    }
}

#[test]
fn depth_buffers_are_read_in_place() {
    let gpu = Gpu::new();
    let size = [3, 5];
    let kernel = Kernel {
        name: "show",
        bindings: &[r#"{"group": 0, "binding": 1, "name": "depth", "type": "texture",
            "view_dimension": "2d", "multisampled": false, "sample_type": "unfilterable-float", "components": 1, "layers": 1, "samples": 1,
            "extent": "output"}"#],
        declarations: "@group(0) @binding(1) var depth: texture_2d<f32>;",
        result: "vec4f(textureLoad(depth, pixel, 0).x, 0.0, 0.0, 1.0)",
    };
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
    for format in [TextureFormat::Depth32Float, TextureFormat::Depth24PlusStencil8] {
        let depth = gpu.texture(size, 1, format, usage);
        let only_depth = depth.create_view(&wgpu::TextureViewDescriptor {
            aspect: wgpu::TextureAspect::DepthOnly,
            ..Default::default()
        });
        for stage in STAGES {
            let pass = pass(&gpu, &kernel, stage);
            let target = gpu.target(size);
            let mut encoder = gpu.encoder();
            clear_depth(&mut encoder, &view(&depth), format, 0.25);
            pass.bind(&[("depth", &only_depth)], &view(&target))
                .expect("to bind")
                .encode(&mut encoder);
            gpu.submit(encoder);
            for [red, ..] in gpu.download(&target) {
                assert!(
                    (red - 0.25).abs() <= 1.0 / f32::from(u16::MAX),
                    "{format:?} {stage:?}: {red}"
                );
            }
        }
    }
}

#[test]
fn fragment_draws_to_the_format_asked_for() {
    let gpu = Gpu::new();
    let Fixture { manifest, wgsl } = COPY.emit(Stage::Fragment);
    let manifest = Manifest::from_json(&manifest).expect("a manifest");
    let color = gpu.upload([2, 1], 1, &[[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]]);
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
    for format in [TextureFormat::Bgra8Unorm, TextureFormat::Bgra8UnormSrgb] {
        let options = PassOptions::default().target_format(format);
        let pass = Pass::with_options(&gpu.device, &manifest, &wgsl, &options).expect("a pass");
        assert_eq!(pass.target_format(), format);
        // As with a swap chain: the texture is plain, the view has the pass's format.
        let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: color.size(),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TextureFormat::Bgra8Unorm,
            usage,
            view_formats: &[TextureFormat::Bgra8UnormSrgb],
        });
        let view_of = target.create_view(&wgpu::TextureViewDescriptor {
            format: Some(format),
            ..Default::default()
        });
        let mut encoder = gpu.encoder();
        pass.bind(&[("color", &view(&color))], &view_of)
            .expect("to bind")
            .encode(&mut encoder);
        gpu.submit(encoder);
        assert_eq!(
            gpu.download_bytes(&target),
            [0, 0, 255, 255, 0, 255, 0, 255],
            "{format:?}"
        );
    }
}

#[test]
fn a_layer_of_a_texture_is_a_target_and_another_an_input() {
    let gpu = Gpu::new();
    let size = [9, 4];
    let layer = |texture: &wgpu::Texture, base_array_layer| {
        texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer,
            array_layer_count: Some(1),
            ..Default::default()
        })
    };
    for stage in STAGES {
        let copy = pass(&gpu, &COPY, stage);
        let usage = TextureUsages::TEXTURE_BINDING
            | TextureUsages::STORAGE_BINDING
            | TextureUsages::RENDER_ATTACHMENT
            | TextureUsages::COPY_SRC;
        let stack = gpu.texture(size, 2, TextureFormat::Rgba32Float, usage);
        let (color, target) = (gpu.upload(size, 1, &ramp(size, 1)), gpu.target(size));
        let mut encoder = gpu.encoder();
        copy.bind(&[("color", &view(&color))], &layer(&stack, 1))
            .expect("to bind")
            .encode(&mut encoder);
        copy.bind(&[("color", &layer(&stack, 1))], &layer(&stack, 0))
            .expect("to bind")
            .encode(&mut encoder);
        copy.bind(&[("color", &layer(&stack, 0))], &view(&target))
            .expect("to bind")
            .encode(&mut encoder);
        gpu.submit(encoder);
        assert_eq!(gpu.download(&target), ramp(size, 1), "{stage:?}");
    }
}

#[test]
fn passes_and_what_is_bound_are_shared_between_threads() {
    let gpu = Gpu::new();
    let size = [8, 8];
    let copy = pass(&gpu, &COPY, Stage::Compute);
    let color = view(&gpu.upload(size, 1, &ramp(size, 1)));
    let common = gpu.target(size);
    let shared = copy.bind(&[("color", &color)], &view(&common)).expect("to bind");
    // Often enough that every interleaving of binding with submitting and polling turns up.
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let target = gpu.target(size);
                for _ in 0..500 {
                    let mut encoder = gpu.encoder();
                    let bound = copy.bind(&[("color", &color)], &view(&target)).expect("to bind");
                    bound.encode(&mut encoder);
                    shared.encode(&mut encoder);
                    gpu.submit(encoder);
                    gpu.device.poll(wgpu::PollType::Poll).expect("to poll");
                }
                assert_eq!(gpu.download(&target), ramp(size, 1));
            });
        }
    });
    assert_eq!(gpu.download(&common), ramp(size, 1));
}

#[test]
fn what_is_bound_outlives_all_that_it_was_made_of() {
    let gpu = Gpu::new();
    let size = [9, 4];
    for stage in STAGES {
        let target = gpu.target(size);
        let bound = {
            let pass = pass(&gpu, &COPY, stage);
            let color = view(&gpu.upload(size, 1, &ramp(size, 1)));
            pass.bind(&[("color", &color)], &view(&target)).expect("to bind")
        };
        for _ in 0..2 {
            let mut encoder = gpu.encoder();
            bound.encode(&mut encoder);
            gpu.submit(encoder);
            assert_eq!(gpu.download(&target), ramp(size, 1), "{stage:?}");
        }
    }
}

#[test]
fn a_shader_is_compiled_once() {
    let gpu = Gpu::new();
    let (copy, add) = (COPY.emit(Stage::Compute), ADD.emit(Stage::Compute));
    let other = add.manifest.replace("\"default\": 2.0", "\"default\": 3.0");
    let read = |manifest, wgsl| Shader::from_json(manifest, wgsl).expect("a shader");
    let [copy, add, other] = [
        read(&copy.manifest, &copy.wgsl),
        read(&add.manifest, &add.wgsl),
        read(&other, &add.wgsl),
    ];
    let mut passes = Passes::new(&gpu.device, PassOptions::default());
    for (shader, made) in [(&copy, 1), (&add, 2), (&copy, 2), (&add, 2), (&other, 3), (&add, 3)] {
        assert_eq!(passes.get(shader).expect("a pass").kernel(), shader.kernel());
        assert_eq!(passes.made(), made);
    }
}
