//! Kernels that take `resolution` without a texture of that size: every form, stage, language and origin, and the grid of a
//! kernel that only writes buffers.

use crate::common;

use common::{Texel, bench, same_texels};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Form, Format, Origin, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_manifest::{BindingKind, Manifest, UniformField};
use straightline_runtime::{BindOptions, Error, Resource, wgpu};
use straightline_tests::gl::{self, Context};
use straightline_tests::texts::{compiled, texels};
use straightline_tests::{compilers, kernel, passthrough};

kernel!(STRETCHED, stretched, {
    pub fn stretched(image: &Texture<Vec4>, strength: f32, resolution: UVec2, pixel: IVec2) -> Vec4 {
        let from = (pixel.as_vec2() + 0.5) / resolution.as_vec2() * image.size().as_vec2();
        let mut sum = image.load(from.as_ivec2()) * strength;
        for k in 0..3 {
            sum += image.load(ivec2(k, pixel.y % 4));
        }
        sum * 0.25 + (resolution.x * 64 + resolution.y) as f32
    }
});

kernel!(COUNTED, counted, {
    pub fn counted(weights: &Buffer<f32>, bins: &AtomicBuffer<u32>, resolution: UVec2, pixel: IVec2) {
        let id = pixel.y as u32 * resolution.x + pixel.x as u32;
        if weights.load((id % 7) as usize) > 0.5 {
            bins.add((id % 5) as usize, id);
        }
    }
});

const SIZE: UVec2 = uvec2(13, 9);

fn image() -> Texture<Vec4> {
    Texture::new(uvec2(6, 5), texels(uvec2(6, 5), 3).texels().to_vec())
}

fn stretched_inputs() -> Inputs {
    Inputs::new(SIZE)
        .with_image("image", texels(uvec2(6, 5), 3))
        .with_uniform("strength", &[0.5])
}

fn weights() -> Vec<f32> {
    (0..7).map(|k| k as f32 / 6.0).collect()
}

fn counted_inputs() -> Inputs {
    let weights = weights().into_iter().map(|w| [w.into(), 0.0, 0.0, 0.0]).collect();
    Inputs::new(SIZE)
        .with_buffer("weights", weights)
        .with_buffer("bins", vec![[0.0; 4]; 5])
}

fn pixels() -> impl Iterator<Item = IVec2> {
    (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| ivec2(x, y)))
}

/// Values of rustc's code.
fn native() -> Vec<[f64; 4]> {
    let image = image();
    pixels()
        .map(|at| stretched::stretched(&image, 0.5, SIZE, at).texel())
        .collect()
}

/// Elements of the buffer as rustc's code leaves them.
fn native_bins() -> Vec<[f64; 4]> {
    let (weights, bins) = (Buffer::new(weights()), AtomicBuffer::new(vec![0; 5]));
    pixels().for_each(|at| counted::counted(&weights, &bins, SIZE, at));
    let elements = bins.elements().into_iter();
    elements.map(|bin| [bin.into(), 0.0, 0.0, 0.0]).collect()
}

/// The field of a manifest that holds the frame's size.
fn size_field(manifest: &Manifest) -> Option<&UniformField> {
    manifest.bindings.iter().find_map(|binding| match &binding.kind {
        BindingKind::Uniform { fields, .. } => fields.iter().find(|field| field.frame_size),
        _ => None,
    })
}

#[test]
fn every_form_and_stage_has_the_size() {
    let (expected, bench) = (native(), bench());
    for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(2)] {
        let compiled = compiled("stretched", STRETCHED, &Settings::new().unroll(unroll));
        let found = interpret_kernel::<f32>(&compiled, &stretched_inputs(), false).unwrap_or_else(|e| panic!("{e}"));
        same_texels(&expected, &found.targets[0].texels).unwrap_or_else(|e| panic!("{unroll}: {e}"));
        for stage in [Stage::Compute, Stage::Fragment] {
            let found = bench.run_targets(&compiled, stage, &stretched_inputs());
            let found = found.unwrap_or_else(|e| panic!("{unroll} {stage:?}: {e}"));
            for (expected, found) in expected.iter().zip(&found[0].texels) {
                let off = (0..4).map(|c| (expected[c] - found[c]).abs()).fold(0.0, f64::max);
                assert!(off <= 1.0e-3, "{unroll} {stage:?}: {expected:?} and {found:?}");
            }
        }
    }
}

/// The size is a uniform of fragment shaders and functions, and the output's own size in compute shaders.
#[test]
fn manifests_name_the_uniform_that_holds_the_size() {
    let compiled = compiled("stretched", STRETCHED, &Settings::default());
    let emitted = |options: EmitOptions| compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
    let compute = emitted(EmitOptions::new().targets(compilers::READ));
    assert_eq!(size_field(&compute.manifest), None);
    compilers::read(&compute).unwrap_or_else(|e| panic!("{e}"));
    let fragment = EmitOptions::new().stage(Stage::Fragment);
    let below = fragment.clone().origin(Origin::LowerLeft);
    for options in [fragment.clone(), fragment.region(true), below] {
        let emitted = emitted(options.targets(compilers::READ));
        let field = size_field(&emitted.manifest).expect("a field");
        assert_eq!(
            (field.name.as_str(), field.ty.to_string().as_str()),
            ("resolution", "vec2u")
        );
        compilers::read(&emitted).unwrap_or_else(|e| panic!("{e}"));
    }
    let function =
        emitted(
            EmitOptions::new()
                .form(Form::Function)
                .targets([Target::Wgsl, Target::Glsl330, Target::Hlsl]),
        );
    assert!(size_field(&function.manifest).is_some());
    let text = String::from_utf8_lossy(&function.files[&Target::Glsl330]);
    assert!(text.contains("uvec2 resolution"), "{text}");
}

/// A uniform of the kernel's own keeps its name, and the size has another.
#[test]
fn names_of_the_kernel_come_first() {
    let text = "pub fn own(resolution: f32, pixel: IVec2) -> Vec4 {\n    Vec4::splat(resolution + pixel.y as f32)\n}\n";
    let compiled = compiled("own", text, &Settings::default());
    let options = EmitOptions::new()
        .stage(Stage::Fragment)
        .origin(Origin::LowerLeft)
        .targets(compilers::READ);
    let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(
        size_field(&emitted.manifest).map(|field| field.name.as_str()),
        Some("resolution_")
    );
    compilers::read(&emitted).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn opengl_and_other_languages_have_the_size() {
    let expected = native();
    let compiled = compiled("stretched", STRETCHED, &Settings::default());
    let near = |what: &str, found: &Frame<Vec4>| {
        for (expected, found) in expected.iter().zip(found.texels()) {
            let off = (0..4)
                .map(|c| (expected[c] - found.texel()[c]).abs())
                .fold(0.0, f64::max);
            assert!(off <= 1.0e-3, "{what}: {expected:?} and {found:?}");
        }
    };
    for target in Target::OPENGL {
        let options = EmitOptions::new()
            .stage(Stage::Fragment)
            .format(Format::Rgba32Float)
            .targets([target]);
        let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
        let context = match target {
            Target::Essl310 | Target::Essl300 => Context::es(),
            _ => Context::desktop(),
        };
        let context = context.unwrap_or_else(|e| panic!("this test needs OpenGL: {e}"));
        let found = gl::run_emitted(&context, &emitted, target, &stretched_inputs());
        near(&target.to_string(), &found.unwrap_or_else(|e| panic!("{target}: {e}")));
    }
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    for target in [Target::Spirv, Target::Glsl450, Target::Hlsl] {
        let options = bench.emit_options(Stage::Fragment).targets([target]);
        let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
        let found = passthrough::run(&bench, &emitted, target, &stretched_inputs());
        near(&target.to_string(), &found.unwrap_or_else(|e| panic!("{target}: {e}")));
    }
}

#[test]
fn kernels_that_only_write_buffers_run_over_a_grid() {
    let (expected, bench) = (native_bins(), bench());
    for unroll in [Unroll::Full, Unroll::None] {
        let compiled = compiled("counted", COUNTED, &Settings::new().unroll(unroll));
        let found = interpret_kernel::<f32>(&compiled, &counted_inputs(), false).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(found.buffers, [("bins".to_owned(), expected.clone())]);
        let (_, found) = bench
            .all_written(&compiled, Stage::Compute, &counted_inputs())
            .unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(found, [("bins".to_owned(), expected.clone())]);
    }
}

/// A pass without targets runs over the grid that the caller sets, and refuses none and one that is too large.
#[test]
fn the_grid_is_checked() {
    let bench = bench();
    let compiled = compiled("counted", COUNTED, &Settings::default());
    let (pass, manifest) = bench
        .compile_pass(&compiled, Stage::Compute)
        .unwrap_or_else(|e| panic!("{e}"));
    let uploaded = bench
        .upload(&manifest, &counted_inputs())
        .unwrap_or_else(|e| panic!("{e}"));
    let inputs: Vec<(&str, Resource<'_>)> = uploaded.resources();
    let none: &[(&str, &wgpu::TextureView)] = &[];
    let unset = pass.bind(&inputs, none).expect_err("no grid");
    assert!(
        matches!(&unset, Error::UniformUnset { name, .. } if name == "resolution"),
        "{unset}"
    );
    for grid in [[0, 4], [u32::MAX, 1]] {
        let options = BindOptions::default().uniform("resolution", grid);
        let error = pass.bind_with(&inputs, none, &options).expect_err("no such grid");
        assert!(
            error.to_string().contains("a dispatch of this device has 1x1 to"),
            "{error}"
        );
    }
    let options = BindOptions::default().uniform("resolution", [3u32, 4]);
    pass.bind_with(&inputs, none, &options)
        .unwrap_or_else(|e| panic!("{e}"));
}
