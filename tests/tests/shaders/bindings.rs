//! Groups, numbers and entry points that users give, run by the manifest; bind group layouts made of the manifest's words
//! alone; and the hash that holds a text and its manifest together.

use crate::common;

use common::{bench, same_bits};
use serde_json::Value;
use straightline_bench::execute::{Bench, Inputs, test_inputs};
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::{Compiled, EmitOptions, Kernel, Settings, Stage, ir};
use straightline_kernels::prelude::*;
use straightline_manifest::BindingKind;
use straightline_runtime::{BindOptions, Error, Pass, Resource, UniformValue};
use straightline_tests::passthrough;

/// A kernel with every kind of resource.
const ALL: &str = "pub fn all(color: &Frame<Vec4>, stack: &FrameLayers<f32>, samples: &Multisampled<Vec4>, image: &Texture<Vec4>, linear: &Sampler, \
                   shadow: &DepthTexture, less: &ComparisonSampler, weights: &Buffer<f32>, tau: f32, pixel: IVec2) -> Vec4 {\n    let uv = \
                   (pixel.as_vec2() + 0.3) / image.size().as_vec2();\n    let lit = shadow.compare(less, uv, 0.5);\n    \
                   color.load(pixel + ivec2(1, 2)) * tau + image.sample(linear, uv) * weights.load((pixel.x % 3) as usize) + samples.load(pixel / 2, \
                   1) * stack.load(pixel, 2) + lit\n}\n";

const SIZE: UVec2 = uvec2(45, 31);

fn all() -> Compiled {
    let compiled = Kernel::from_text("all.rs", ALL, "all").compile(&Settings::default());
    compiled.unwrap_or_else(|e| panic!("{e}"))
}

fn inputs(compiled: &Compiled) -> Inputs {
    test_inputs(&compiled.graph, SIZE).with_uniform("tau", &[0.75])
}

fn texels(frame: &Frame<Vec4>) -> Vec<[f32; 4]> {
    let texels: Vec<[f32; 4]> = frame.texels().iter().map(|texel| texel.to_array()).collect();
    assert!(texels.iter().any(|texel| *texel != texels[0]), "one colour");
    texels
}

fn moved(options: EmitOptions) -> EmitOptions {
    let options = options
        .group(2)
        .entry("elsewhere")
        .binding("color", 40)
        .binding("parameters", 1);
    options.binding("weights", 0).binding("image", 12)
}

fn run(bench: &Bench, compiled: &Compiled, options: &EmitOptions) -> Vec<[f32; 4]> {
    let (pass, manifest) = bench.emit_pass(compiled, options).unwrap_or_else(|e| panic!("{e}"));
    let inputs = inputs(compiled);
    let uploaded = bench.upload(&manifest, &inputs).unwrap_or_else(|e| panic!("{e}"));
    texels(
        &bench
            .picture_of(&pass, &uploaded, SIZE)
            .unwrap_or_else(|e| panic!("{e}")),
    )
}

#[test]
fn a_shader_runs_by_the_numbers_of_its_manifest() {
    let (bench, compiled) = (bench(), all());
    for stage in [Stage::Compute, Stage::Fragment] {
        for region in [false, true] {
            let plain = bench.emit_options(stage).region(region);
            let expected = run(&bench, &compiled, &plain);
            let found = run(&bench, &compiled, &moved(plain));
            same_bits(&found, &expected).unwrap_or_else(|e| panic!("{stage:?}, region {region}: {e}"));
        }
    }
}

#[test]
fn other_languages_run_by_the_numbers_too() {
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    let languages = [Target::Glsl450, Target::Hlsl, Target::Spirv];
    let text = "pub fn k(color: &Frame<Vec4>, image: &Texture<Vec4>, linear: &Sampler, tau: f32, pixel: IVec2) -> Vec4 {\n    let uv = \
                (pixel.as_vec2() + 0.3) / image.size().as_vec2();\n    color.load(pixel + ivec2(1, 2)) * tau + image.sample(linear, uv)\n}\n";
    let compiled = Kernel::from_text("k.rs", text, "k").compile(&Settings::default());
    let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
    let inputs = test_inputs(&compiled.graph, SIZE).with_uniform("tau", &[0.75]);
    for stage in [Stage::Compute, Stage::Fragment] {
        let plain = bench.emit_options(stage).targets(languages);
        let moved = plain
            .clone()
            .group(1)
            .binding("color", 1)
            .binding("parameters", 0)
            .entry("elsewhere");
        let emit = |options: &EmitOptions| compiled.emit(options).unwrap_or_else(|e| panic!("{e}"));
        let (plain, moved) = (emit(&plain), emit(&moved));
        for target in languages {
            let picture = |emitted: &Emitted| {
                let picture = passthrough::run(&bench, emitted, target, &inputs);
                texels(&picture.unwrap_or_else(|e| panic!("{target} {stage:?}: {e}")))
            };
            same_bits(&picture(&moved), &picture(&plain)).unwrap_or_else(|e| panic!("{target} {stage:?}: {e}"));
        }
        // Languages that reach the driver directly need the binding numbers that wgpu assigns.
        let holes = emit(&bench.emit_options(stage).targets(languages).binding("color", 9));
        let error = passthrough::run(&bench, &holes, Target::Spirv, &inputs).expect_err("holes");
        assert!(
            error.contains("binding 9") && error.contains("without holes"),
            "{error}"
        );
    }
}

/// An entry of a bind group layout, from nothing but what the JSON says.
fn entry(binding: &Value, visibility: wgpu::ShaderStages) -> wgpu::BindGroupLayoutEntry {
    let word = |key: &str| {
        binding[key]
            .as_str()
            .unwrap_or_else(|| panic!("no `{key}` in {binding}"))
    };
    let dimension = || match word("view_dimension") {
        "2d" => wgpu::TextureViewDimension::D2,
        "2d-array" => wgpu::TextureViewDimension::D2Array,
        "3d" => wgpu::TextureViewDimension::D3,
        "cube" => wgpu::TextureViewDimension::Cube,
        other => panic!("{other} is none of WebGPU's that kernels read"),
    };
    let ty = match word("type") {
        "texture" => wgpu::BindingType::Texture {
            sample_type: match word("sample_type") {
                "float" => wgpu::TextureSampleType::Float { filterable: true },
                "unfilterable-float" => wgpu::TextureSampleType::Float { filterable: false },
                "depth" => wgpu::TextureSampleType::Depth,
                "sint" => wgpu::TextureSampleType::Sint,
                "uint" => wgpu::TextureSampleType::Uint,
                other => panic!("{other} is no sample type that kernels read"),
            },
            view_dimension: dimension(),
            multisampled: binding["multisampled"].as_bool().expect("a flag"),
        },
        "sampler" => wgpu::BindingType::Sampler(match word("sampler_type") {
            "filtering" => wgpu::SamplerBindingType::Filtering,
            "comparison" => wgpu::SamplerBindingType::Comparison,
            other => panic!("{other} is no sampler type that kernels use"),
        }),
        "buffer" | "uniform" => wgpu::BindingType::Buffer {
            ty: match word("buffer_type") {
                "uniform" => wgpu::BufferBindingType::Uniform,
                "read-only-storage" => wgpu::BufferBindingType::Storage { read_only: true },
                other => panic!("{other} is no buffer type that kernels read"),
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        "storage-texture" => wgpu::BindingType::StorageTexture {
            access: match word("access") {
                "write-only" => wgpu::StorageTextureAccess::WriteOnly,
                other => panic!("{other} is no access that kernels have"),
            },
            format: match word("format") {
                "rgba32float" => wgpu::TextureFormat::Rgba32Float,
                other => panic!("{other} was not asked for"),
            },
            view_dimension: dimension(),
        },
        other => panic!("{other} is no resource"),
    };
    wgpu::BindGroupLayoutEntry {
        binding: binding["binding"].as_u64().expect("a number") as u32,
        visibility,
        ty,
        count: None,
    }
}

#[test]
fn a_layout_is_made_of_the_manifests_words_alone() {
    let (bench, compiled) = (bench(), all());
    let options = moved(bench.emit_options(Stage::Compute)).group(1);
    let expected = run(&bench, &compiled, &bench.emit_options(Stage::Compute));
    let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
    let files = emitted.named_files("all");
    let json: Value = serde_json::from_slice(&files["all.json"]).expect("JSON");
    let wgsl = String::from_utf8(files[json["files"]["wgsl"].as_str().expect("a file")].clone()).expect("text");
    // The output is bound like the rest.
    let mut output = json["output"].clone();
    output["type"] = "storage-texture".into();
    let mut bindings = json["bindings"].as_array().expect("a list").clone();
    bindings.push(output);
    let entries: Vec<_> = bindings.iter().map(|b| entry(b, wgpu::ShaderStages::COMPUTE)).collect();
    assert_eq!(entries.len(), 10, "{bindings:#?}");
    assert!(bindings.iter().all(|b| b["group"] == 1));
    let device = bench.device();
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &entries,
    });
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(wgsl.as_str().into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[None, Some(&layout)],
            immediate_size: 0,
        })),
        module: &module,
        entry_point: json["entry_point"].as_str(),
        compilation_options: Default::default(),
        cache: None,
    });

    // Resources are the bench's; their places follow the manifest.
    let uploaded = bench
        .upload(&emitted.manifest, &inputs(&compiled))
        .unwrap_or_else(|e| panic!("{e}"));
    let resources = uploaded.resources();
    let uniforms = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 16,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    bench.queue().write_buffer(&uniforms, 0, &0.75f32.to_le_bytes());
    let target = bench.create_target(SIZE, wgpu::TextureFormat::Rgba32Float);
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let entries: Vec<wgpu::BindGroupEntry<'_>> = bindings
        .iter()
        .map(|binding| {
            let name = binding["name"].as_str().expect("a name");
            let resource = match resources.iter().find(|(known, _)| *known == name) {
                Some((_, Resource::Texture(view))) => wgpu::BindingResource::TextureView(view),
                Some((_, Resource::Sampler(sampler))) => wgpu::BindingResource::Sampler(sampler),
                Some((_, Resource::Buffer(buffer))) => buffer.as_entire_binding(),
                None if name == "parameters" => uniforms.as_entire_binding(),
                None => wgpu::BindingResource::TextureView(&view),
                Some((_, other)) => panic!("{name} is {}", other.kind()),
            };
            let binding = binding["binding"].as_u64().expect("a number") as u32;
            wgpu::BindGroupEntry { binding, resource }
        })
        .collect();
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &entries,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(1, &group, &[]);
        let side = |k: usize| json["workgroup_size"][k].as_u64().expect("a number") as u32;
        pass.dispatch_workgroups(SIZE.x.div_ceil(side(0)), SIZE.y.div_ceil(side(1)), 1);
    }
    bench.queue().submit([encoder.finish()]);
    let found = texels(&bench.download(&target).unwrap_or_else(|e| panic!("{e}")));
    same_bits(&found, &expected).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn a_text_of_another_hash_is_refused() {
    let (bench, compiled) = (bench(), all());
    let emitted = compiled
        .emit(&bench.emit_options(Stage::Compute))
        .unwrap_or_else(|e| panic!("{e}"));
    let wgsl = String::from_utf8(emitted.files[&Target::Wgsl].clone()).expect("text");
    let made = |wgsl: &str| Pass::new(bench.device(), &emitted.manifest, wgsl);
    // Binds the same resources, and computes something else.
    let edited = wgsl.replacen(" * ", " + ", 1);
    assert_ne!(edited, wgsl);
    let error = made(&edited).expect_err("another text");
    assert!(matches!(error, Error::Hash { .. }), "{error}");
    let message = error.to_string();
    let hash = &emitted.manifest.hashes["wgsl"];
    assert!(
        message.contains("`all`") && message.contains(hash) && message.contains("generator run"),
        "{message}"
    );
    // A checkout on Windows changes line ends.
    made(&wgsl.replace('\n', "\r\n")).unwrap_or_else(|e| panic!("{e}"));
    let mut claims_nothing = emitted.manifest.clone();
    claims_nothing.hashes.clear();
    Pass::new(bench.device(), &claims_nothing, &edited).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn a_function_is_no_pass() {
    let (bench, compiled) = (bench(), {
        let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel) * 0.5\n}\n";
        Kernel::from_text("k.rs", text, "k")
            .compile(&Settings::default())
            .unwrap_or_else(|e| panic!("{e}"))
    });
    let options = EmitOptions::new().form(straightline_codegen::Form::Function);
    let error = bench
        .emit_pass(&compiled, &options)
        .map(|_| ())
        .expect_err("a function")
        .to_string();
    assert!(
        error.contains("`k`") && error.contains("a function") && error.contains("form `entry`"),
        "{error}"
    );
}

/// A matrix and an array are one value to who sets them, and so many fields in the shader as it reads of them.
#[test]
fn matrices_and_arrays_are_set_as_one_value() {
    let text = "pub fn k(turn: Mat2, palette: &[Vec3; 4], weights: &[f32; 2], pixel: IVec2) -> Vec4 {\n    let turned = turn * vec2(1.0, 2.0);\n    \
                (palette[3] - palette[1]).extend(weights[1]) + turned.xyxy()\n}\n";
    let (bench, compiled) = (
        bench(),
        Kernel::from_text("k.rs", text, "k").compile(&Settings::default()),
    );
    let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
    let graph = ir::print(&compiled.graph);
    assert_eq!(ir::print(&ir::parse(&graph).unwrap_or_else(|e| panic!("{e:?}"))), graph);
    let target = bench.create_target(uvec2(1, 1), wgpu::TextureFormat::Rgba32Float);
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let (turn, weights) = ([[3.0, 5.0], [7.0, 11.0]], [13.0, 17.0]);
    let palette = [[0.0; 3], [1.0, 2.0, 4.0], [0.0; 3], [8.0, 16.0, 32.0]];
    let [palette, weights] = [UniformValue::vectors(&palette), UniformValue::array(&weights)].map(Option::unwrap);
    let options = BindOptions::default().uniform("turn", turn);
    let options = options.uniform("palette", palette).uniform("weights", weights);
    for stage in [Stage::Compute, Stage::Fragment] {
        let (pass, manifest) = bench.compile_pass(&compiled, stage).unwrap_or_else(|e| panic!("{e}"));
        let fields: Vec<String> = manifest
            .bindings
            .iter()
            .filter_map(|binding| match &binding.kind {
                BindingKind::Uniform { fields, .. } => Some(fields),
                _ => None,
            })
            .flatten()
            .filter_map(|field| {
                field
                    .part
                    .as_ref()
                    .map(|part| format!("{} {} {} {}", field.name, part.of, part.ty, part.index))
            })
            .collect();
        let wanted = [
            "turn_x_axis turn mat2x2f 0",
            "turn_y_axis turn mat2x2f 1",
            "palette_1 palette array<vec3f, 4> 1",
            "palette_3 palette array<vec3f, 4> 3",
            "weights_1 weights array<f32, 2> 1",
        ];
        assert_eq!(fields, wanted);
        let bound = pass.bind_with(&[] as &[(&str, Resource<'_>)], &view, &options);
        let mut encoder = bench.device().create_command_encoder(&Default::default());
        bound.unwrap_or_else(|e| panic!("{e}")).encode(&mut encoder);
        bench.queue().submit([encoder.finish()]);
        let found = bench.download(&target).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(
            found.texels(),
            [vec4(7.0 + 17.0, 14.0 + 27.0, 28.0 + 17.0, 17.0 + 27.0)],
            "{stage:?}"
        );
    }
}
