//! The Rust that a build script writes: its constants are what the runtime reads from the manifest, and a pass of either is
//! the same.
//!
//! `codegen/tests/bindings/` holds the bindings, as `include_shaders!` includes them.

use crate::common;

use common::{bench, same_bits};
use proc_macro2::{Group, TokenStream, TokenTree};
use std::path::{Path, PathBuf};
use straightline_bench::execute::{Inputs, interpret_chain, test_inputs};
use straightline_codegen::chain as codegen;
use straightline_codegen::emit::{self, Emitted, Module, Modules, Target};
use straightline_codegen::{Compiled, EmitOptions, Format, Kernel, Settings, ShaderSpec, Stage, Unroll, default_set};
use straightline_kernels::CATALOGUE;
use straightline_kernels::prelude::*;
use straightline_manifest::Manifest;
use straightline_manifest::chain::ChainPlan;
use straightline_manifest::plan::Plan;
use straightline_runtime::{BindOptions, Chain, Error, Pass, PassOptions, Shader};
use wgpu::TextureFormat;

mod generated {
    include!("../../../codegen/tests/bindings/straightline.rs");
}

const SIZE: UVec2 = uvec2(45, 31);

/// Each module with its manifest and constant.
const MODULES: [(&str, &Shader<'static>); 9] = [
    (generated::all::MANIFEST, &generated::all::SHADER),
    (generated::tile::MANIFEST, &generated::tile::SHADER),
    (generated::graded::MANIFEST, &generated::graded::SHADER),
    (generated::drawn::MANIFEST, &generated::drawn::SHADER),
    (generated::several::MANIFEST, &generated::several::SHADER),
    (generated::waiting::MANIFEST, &generated::waiting::SHADER),
    (generated::sraa::MANIFEST, &generated::sraa::SHADER),
    (generated::faded::MANIFEST, &generated::faded::SHADER),
    (generated::lit::MANIFEST, &generated::lit::SHADER),
];

fn captured() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../codegen/tests/bindings")
}

#[test]
fn constants_are_what_is_read() {
    for (json, constant) in MODULES {
        let read = Shader::from_json(json, constant.wgsl()).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(read, *constant);
    }
}

/// A pass of a chain that writes two pictures of unlike sizes.
#[test]
fn outputs_with_tiles_are_what_is_read() {
    use generated::levels::shaders::levels_quarter_cascade::{MANIFEST, SHADER};
    let read = Shader::from_json(MANIFEST, SHADER.wgsl()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(read, SHADER);
    let plan = ChainPlan::from_json(generated::levels::PLAN).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(plan, *generated::levels::CHAIN.plan());
    assert_eq!(plan.passes.len(), 1);
    let manifest = Manifest::from_json(MANIFEST).unwrap_or_else(|e| panic!("{e}"));
    let tiles: Vec<_> = manifest.outputs.iter().map(|output| output.tile).collect();
    assert_eq!(tiles, [Some([32, 32]), Some([16, 16])]);
    let none = MANIFEST.replacen("[\n        32,\n        32\n      ]", "[0, 32]", 1);
    let refused = Shader::from_json(&none, SHADER.wgsl())
        .expect_err("no texels")
        .to_string();
    assert!(refused.contains("a tile has no texels"), "{refused}");
}

/// The constant of a chain is its plan in JSON, and draws the picture of the interpreter.
#[test]
fn a_chain_of_constants_is_the_chain_that_is_read() {
    let read = ChainPlan::from_json(generated::glow::PLAN).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(read, *generated::glow::CHAIN.plan());
    let bench = bench();
    let chain = Chain::new(bench.device(), &generated::glow::CHAIN, &PassOptions::default());
    let chain = chain.unwrap_or_else(|e| panic!("{e}"));
    let source = codegen::Chain::from_file(&captured().join("kernels/glow.rs"), None).unwrap_or_else(|e| panic!("{e}"));
    let spec = ShaderSpec::new().format(Format::Rgba32Float);
    let compiled = source
        .expect("a chain")
        .compile(&spec.into())
        .unwrap_or_else(|e| panic!("{e}"));
    let texels = (0..SIZE.x * SIZE.y)
        .map(|k| Vec4::splat((k % 7) as f32 * 0.25))
        .collect();
    let inputs = Inputs::new(SIZE)
        .with_image("color", Frame::new(SIZE, texels))
        .with_uniform("strength", &[0.5]);
    let expected = interpret_chain::<f32>(&compiled, &inputs).unwrap_or_else(|e| panic!("{e}"));
    let emitted = compiled.emit().unwrap_or_else(|e| panic!("{e}"));
    let uploaded = bench
        .upload_for_chain(&emitted, &inputs)
        .unwrap_or_else(|e| panic!("{e}"));
    let target = bench.create_target(SIZE, TextureFormat::Rgba32Float);
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let options = BindOptions::default().uniform("strength", 0.5);
    let bound = chain
        .bind_with(&uploaded.resources(), &view, &options)
        .unwrap_or_else(|e| panic!("{e}"));
    let mut encoder = bench
        .device()
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    bound.encode(&mut encoder);
    bench.queue().submit([encoder.finish()]);
    let found = bench.download(&target).unwrap_or_else(|e| panic!("{e}"));
    let far = |(a, b): (&Vec4, &[f64; 4])| (0..4).map(|k| (f64::from(a[k]) - b[k]).abs()).fold(0.0, f64::max);
    let worst = found
        .texels()
        .iter()
        .zip(&expected[0].texels)
        .map(far)
        .fold(0.0, f64::max);
    assert!(worst < 0.01, "off by {worst}");
}

/// The generated structure of overrides has their defaults, and changes the picture of a constant.
#[test]
fn generated_overrides_set_the_picture() {
    use generated::faded::{Inputs, Overrides, Pass};
    let defaults = Overrides::default();
    assert_eq!(
        defaults,
        Overrides {
            strength: 0.75,
            inverted: false
        }
    );
    let bench = bench();
    let texels = (0..SIZE.x * SIZE.y).map(|k| Vec4::splat((k % 5) as f32 * 0.25));
    let color = Frame::new(SIZE, texels.collect());
    let kernel = Kernel::from_file(&captured().join("kernels/faded.rs"), None);
    let compiled = kernel.and_then(|kernel| kernel.compile(&Settings::new().override_options(["strength"])));
    let given = straightline_bench::execute::Inputs::new(SIZE).with_image("color", color.clone());
    let emitted = compiled.and_then(|compiled| compiled.emit(&EmitOptions::new().format(Format::Rgba32Float)));
    let uploaded = bench.upload(&emitted.unwrap_or_else(|e| panic!("{e}")).manifest, &given);
    let uploaded = uploaded.unwrap_or_else(|e| panic!("{e}"));
    let resources = uploaded.resources();
    let [("color", straightline_runtime::Resource::Texture(view))] = resources[..] else {
        panic!("one texture is read");
    };
    for (overrides, kept) in [
        (defaults, 0.75),
        (
            Overrides {
                strength: 0.25,
                ..defaults
            },
            0.25,
        ),
        (
            Overrides {
                strength: 1.0,
                inverted: true,
            },
            1.0,
        ),
    ] {
        let pass = Pass::with_options(bench.device(), &overrides.apply(PassOptions::default()));
        let pass = pass.unwrap_or_else(|e| panic!("{e}"));
        let target = bench.create_target(SIZE, TextureFormat::Rgba32Float);
        let bound = pass.bind(
            &Inputs { color: view },
            &target.create_view(&wgpu::TextureViewDescriptor::default()),
        );
        let mut encoder = bench
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        bound.unwrap_or_else(|e| panic!("{e}")).encode(&mut encoder);
        bench.queue().submit([encoder.finish()]);
        let found = bench.download(&target).unwrap_or_else(|e| panic!("{e}"));
        let expected = color.texels().iter().map(|texel| {
            let texel = if overrides.inverted { Vec4::ONE - *texel } else { *texel };
            texel * kept
        });
        assert_eq!(found.texels(), expected.collect::<Vec<_>>());
    }
    let options = PassOptions::default().override_option("strength", 1.5);
    let refused = Pass::with_options(bench.device(), &options).expect_err("out of range");
    assert!(
        refused
            .to_string()
            .contains("`strength` of `faded` cannot be 1.5: it takes 0 to 1"),
        "{refused}"
    );
}

#[test]
fn both_roads_draw_the_same_picture() {
    let bench = bench();
    for (json, constant) in [MODULES[0], MODULES[6]] {
        let manifest = Manifest::from_json(json).unwrap_or_else(|e| panic!("{e}"));
        let compiled = match constant.kernel() {
            "all" => Kernel::from_file(&captured().join("kernels/all.rs"), None)
                .and_then(|kernel| kernel.compile(&Settings::default())),
            kernel => Kernel::builtin(kernel).and_then(|kernel| kernel.compile(&sraa())),
        };
        let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
        let inputs = test_inputs(&compiled.graph, SIZE).with_uniform("tau", &[0.75]);
        let uploaded = bench.upload(&manifest, &inputs).unwrap_or_else(|e| panic!("{e}"));
        let picture = |pass: Result<Pass, Error>| -> Vec<[f32; 4]> {
            let pass = pass.unwrap_or_else(|e| panic!("{e}"));
            let frame = bench.picture_of(&pass, &uploaded, SIZE);
            let frame = frame.unwrap_or_else(|e| panic!("{e}"));
            frame.texels().iter().map(|texel| texel.to_array()).collect()
        };
        let options = PassOptions::default();
        let read = picture(Pass::new(bench.device(), &manifest, constant.wgsl()));
        let found = picture(Pass::from_shader(bench.device(), constant, &options));
        same_bits(&found, &read).unwrap_or_else(|e| panic!("{}: {e}", constant.kernel()));
        let unbounded = picture(Pass::from_shader(
            bench.device(),
            constant,
            &options.unbounded_loops(true),
        ));
        same_bits(&unbounded, &read).unwrap_or_else(|e| panic!("{} without bounds: {e}", constant.kernel()));
    }
}

#[test]
fn a_loop_that_may_not_end_keeps_its_bound() {
    let bench = bench();
    let options = PassOptions::default().unbounded_loops(true);
    let error = generated::waiting::Pass::with_options(bench.device(), &options).expect_err("a refusal");
    assert!(matches!(error, Error::UnboundedLoop { .. }), "{error}");
    generated::waiting::Pass::new(bench.device()).unwrap_or_else(|e| panic!("{e}"));
}

/// Setters cannot fail; a vector is an array, or one of glam's.
#[test]
fn values_are_set_one_by_one_as_all_at_once() {
    use generated::graded::{Inputs, Light, Parameters, Pass};
    let bench = bench();
    let device = bench.device();
    let light = Light::new([0.25, 0.5, 1.0], 3, [0.5, 2.0, 4.0]);
    let lights = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    bench
        .queue()
        .write_buffer(&lights, 0, &[light.to_bytes(), light.to_bytes()].concat());
    let grade = [[1.0, 2.0, 3.0], [0.0, 1.0, 0.5], [4.0, 0.0, 1.0]];
    let palette = [[0.5, 1.0, 2.0], [1.0, 0.0, 3.0], [0.25, 2.0, 1.0], [1.0, 1.0, 8.0]];
    let parameters = Parameters::ZERO.with_grade(grade).with_palette(palette);
    let parameters = parameters
        .with_weights([5.0, 6.0, 7.0])
        .with_offset([0.5, 1.0])
        .with_steps(-2);
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: 16,
            height: 16,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = target.create_view(&wgpu::TextureViewDescriptor::default());
    let pass = Pass::new(device).unwrap_or_else(|e| panic!("{e}"));
    let bind = |parameters: &Parameters| {
        let bound = pass.bind(&Inputs { lights: &lights }, parameters, &view);
        bound.unwrap_or_else(|e| panic!("{e}"))
    };
    let picture = |bound: &generated::graded::Bound| {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        bound.encode(&mut encoder);
        let texels = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 16 * 256,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(256),
            rows_per_image: None,
        };
        let to = wgpu::TexelCopyBufferInfo {
            buffer: &texels,
            layout,
        };
        encoder.copy_texture_to_buffer(target.as_image_copy(), to, target.size());
        bench.queue().submit([encoder.finish()]);
        texels.map_async(wgpu::MapMode::Read, .., |_| {});
        device.poll(wgpu::PollType::wait_indefinitely()).expect("waited");
        texels.get_mapped_range(..).expect("mapped").to_vec()
    };
    let expected = picture(&bind(&parameters));
    let bound = bind(&Parameters::ZERO);
    assert_ne!(picture(&bound), expected);
    bound.set_grade(bench.queue(), grade);
    bound.set_palette(bench.queue(), palette);
    bound.set_weights(bench.queue(), [5.0, 6.0, 7.0]);
    bound.set_offset(bench.queue(), vec2(0.5, 1.0));
    bound.set_steps(bench.queue(), -2);
    assert_eq!(picture(&bound), expected);
    bound.set_parameters(bench.queue(), &Parameters::ZERO);
    assert_ne!(picture(&bound), expected);
    bound.set_parameters(bench.queue(), &parameters);
    assert_eq!(picture(&bound), expected);
}

fn sraa() -> Settings {
    let mut settings = Settings::default();
    for (name, value) in [("pattern", "latin4"), ("metric", "depth"), ("tau", "uniform")] {
        settings.options.push((name.to_owned(), value.to_owned()));
    }
    settings.unroll = Unroll::None;
    settings
}

/// Every shader of the default set, built-in kernel and kernel of the gallery: what is written as Rust reads as the plan
/// prints itself.
#[test]
fn every_plan_is_written_as_it_is_read() {
    let mut compared = 0;
    let set = default_set::emit_files().unwrap_or_else(|e| panic!("{e}"));
    let text = |name: &str| String::from_utf8(set[name].clone()).expect("a text");
    for stem in set.keys().filter_map(|name| name.strip_suffix(".json")) {
        let manifest = Manifest::from_json(&text(&format!("{stem}.json"))).expect("a manifest");
        let kernel = Kernel::builtin(&manifest.kernel).expect("built in");
        let compiled = kernel.compile(&Settings::default()).expect("compiled");
        compare(&compiled, &manifest, &text(&format!("{stem}.wgsl")));
        compared += 1;
    }
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/gallery");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(gallery)
        .expect("the gallery")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect();
    paths.sort();
    let own = paths.iter().map(|path| Kernel::from_file(path, None));
    let built_in = CATALOGUE.iter().map(|entry| Kernel::builtin(entry.name));
    for kernel in built_in.chain(own) {
        let compiled = kernel.and_then(|kernel| kernel.compile(&Settings::default()));
        let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
        for stage in [Stage::Compute, Stage::Fragment] {
            // Some kernels have one stage.
            let Ok(emitted) = compiled.emit(&EmitOptions::new().stage(stage)) else {
                continue;
            };
            let Emitted { manifest, files, .. } = &emitted;
            compare(&compiled, manifest, &String::from_utf8_lossy(&files[&Target::Wgsl]));
            compared += 1;
        }
    }
    assert!(compared > 80, "only {compared} shaders");
}

fn compare(compiled: &Compiled, manifest: &Manifest, wgsl: &str) {
    let module = Module {
        name: "shader",
        compiled,
        manifest,
        wgsl,
    };
    let text = emit::render_bindings(&Modules {
        shaders: vec![module],
        ..Default::default()
    })
    .unwrap_or_else(|e| panic!("{e}"));
    let plan = Plan::from_manifest(manifest).expect("a plan");
    let printed: TokenStream = format!("{plan:?}").parse().expect("tokens");
    let workgroup = text
        .split_once("WORKGROUP_SIZE: [u32; 3] = ")
        .and_then(|(_, rest)| rest.split_once(';'));
    let workgroup = workgroup.map_or("", |(size, _)| size).parse().expect("tokens");
    let written = find_plan(text.parse().expect("tokens")).expect("a plan");
    let written = as_printed(written, &workgroup).to_string();
    assert_eq!(
        written,
        as_printed(printed, &workgroup).to_string(),
        "{}",
        manifest.kernel
    );
}

/// The expression `Plan { .. }` in a file of bindings.
fn find_plan(tokens: TokenStream) -> Option<TokenStream> {
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        match (&token, tokens.peek()) {
            (TokenTree::Ident(ident), Some(fields @ TokenTree::Group(_))) if ident == "Plan" => {
                return Some([token, fields.clone()].into_iter().collect());
            }
            (TokenTree::Group(group), _) => {
                if let Some(found) = find_plan(group.stream()) {
                    return Some(found);
                }
            }
            _ => {}
        }
    }
    None
}

/// Constants as `Debug` prints their values: without paths, references, `Borrowed`, trailing commas, and with the bytes of
/// numbers.
fn as_printed(tokens: TokenStream, workgroup: &TokenStream) -> TokenStream {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let is = |k: usize, text: &str| tokens.get(k).is_some_and(|token: &TokenTree| token.to_string() == text);
    let mut printed = Vec::new();
    let mut k = 0;
    while k < tokens.len() {
        let number_of_bytes = is(k + 1, ".") && is(k + 2, "to_le_bytes");
        match &tokens[k] {
            TokenTree::Ident(_) if is(k + 1, ":") && is(k + 2, ":") => k += 2,
            TokenTree::Ident(ident) if ident == "WORKGROUP_SIZE" => printed.extend(workgroup.clone()),
            TokenTree::Ident(ident) if ident == "Borrowed" => {
                if let Some(TokenTree::Group(value)) = tokens.get(k + 1) {
                    printed.extend(as_printed(value.stream(), workgroup));
                }
                k += 1;
            }
            TokenTree::Punct(mark) if mark.as_char() == '&' => {}
            TokenTree::Punct(mark) if mark.as_char() == ',' && k + 1 == tokens.len() => {}
            number if number_of_bytes => {
                printed.extend(bytes(&number.to_string()).parse::<TokenStream>().expect("an array"));
                k += 3;
            }
            TokenTree::Group(group) => {
                let inner = as_printed(group.stream(), workgroup);
                printed.push(Group::new(group.delimiter(), inner).into());
            }
            token => printed.push(token.clone()),
        }
        k += 1;
    }
    printed.into_iter().collect()
}

/// The bytes of a number, as `Debug` prints them.
fn bytes(number: &str) -> String {
    let text = number.replace(['(', ')', ' '], "");
    let bytes = match text.rsplit_once('_') {
        Some((value, "f32")) => value.parse::<f32>().expect("a float").to_le_bytes(),
        Some((value, "i32")) => value.parse::<i32>().expect("an integer").to_le_bytes(),
        Some((value, "u32")) => value.parse::<u32>().expect("an integer").to_le_bytes(),
        _ => panic!("no number: {text}"),
    };
    format!("{bytes:?}")
}
