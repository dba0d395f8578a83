//! Shaders emitted for OpenGL and OpenGL ES, run on Mesa's software driver without a display, against the interpreter.

use straightline_bench::execute::{Inputs, interpret_kernel, test_inputs};
use straightline_codegen::diagnostic::Code;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Format, Kernel, Settings, Stage, Transport, Unroll};
use straightline_kernels::prelude::*;
use straightline_tests::gl::{self, Context};
use straightline_tests::sraa::surfaces;

/// Most that a component may be off, of the larger of 1 and its size.
const BOUND: f32 = 1.0e-5;

type Options<'a> = &'a [(&'a str, &'a str)];

fn compiled(name: &str, options: Options<'_>, unroll: Unroll, transport: Option<Transport>) -> Compiled {
    let options = options.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned()));
    let settings = Settings::new().set_all(options).unroll(unroll).transport(transport);
    let kernel = Kernel::builtin(name).and_then(|kernel| kernel.compile(&settings));
    kernel.unwrap_or_else(|errors| panic!("{name}:\n{errors}"))
}

/// Runs a kernel in every language of OpenGL that has its stage, and compares each picture with the interpreter's.
#[track_caller]
fn check(compiled: &Compiled, stage: Stage, inputs: &Inputs, expected_languages: &[Target]) {
    let expected = interpret_kernel::<f32>(compiled, inputs, false).unwrap_or_else(|e| panic!("{e}"));
    let expected = expected.frame(inputs);
    let first = expected.texels()[0];
    assert!(expected.texels().iter().any(|texel| *texel != first), "one colour");
    for target in Target::OPENGL {
        let what = format!("{} {stage:?} {target}", compiled.kernel);
        let options = EmitOptions::new()
            .stage(stage)
            .format(Format::Rgba32Float)
            .targets([target]);
        let emitted = match compiled.emit(&options) {
            Ok(emitted) => emitted,
            Err(error) if error.first_code() == Some(Code::NotInTarget) && !expected_languages.contains(&target) => {
                continue;
            }
            Err(e) => panic!("{what}: {e}"),
        };
        assert!(expected_languages.contains(&target), "{what} is not refused");
        let context = match target {
            Target::Essl310 | Target::Essl300 => Context::es(),
            _ => Context::desktop(),
        };
        let context = context.unwrap_or_else(|e| panic!("this test needs OpenGL: {e}"));
        let found = gl::run_emitted(&context, &emitted, target, inputs);
        let found = found.unwrap_or_else(|e| panic!("{what}: {e}"));
        let mut largest = 0.0f32;
        for (k, (found, expected)) in found.texels().iter().zip(expected.texels()).enumerate() {
            let off = (*found - *expected).abs() / expected.abs().max(Vec4::ONE);
            assert!(
                off.max_element() <= BOUND,
                "{what}: pixel {k}: found {found}, expected {expected}"
            );
            largest = largest.max(off.max_element());
        }
        assert_eq!(found.texels().len(), expected.texels().len());
        println!("{what}: off by at most {largest:e}");
    }
}

const SIZE: UVec2 = uvec2(45, 31);

/// Languages with compute shaders.
const COMPUTE: [Target; 2] = [Target::Glsl430, Target::Essl310];

#[test]
fn sraa() {
    let options = [("pattern".to_owned(), "latin4".to_owned())];
    let inputs = surfaces::inputs(&options.to_vec(), SIZE, 5);
    for unroll in [Unroll::Full, Unroll::None] {
        let compiled = compiled("sraa", &[("pattern", "latin4")], unroll, None);
        check(&compiled, Stage::Fragment, &inputs, &Target::OPENGL);
        check(&compiled, Stage::Compute, &inputs, &COMPUTE);
    }
}

#[test]
fn edge_filters() {
    for name in ["stalker", "tabula_rasa"] {
        let compiled = compiled(name, &[], Unroll::Full, None);
        let inputs = test_inputs(&compiled.graph, SIZE);
        check(&compiled, Stage::Fragment, &inputs, &Target::OPENGL);
    }
}

/// Samplers that compare and samplers that filter, of textures of other sizes than the picture's.
#[test]
fn samplers_and_blocks() {
    for name in ["pcf", "quad_upsampling", "quad_convolution", "quad_bilateral"] {
        let compiled = compiled(name, &[], Unroll::Full, Some(Transport::Block));
        check(&compiled, Stage::Compute, &test_inputs(&compiled.graph, SIZE), &COMPUTE);
    }
}

#[test]
fn quads_are_refused_by_name() {
    let compiled = compiled("quad_convolution", &[], Unroll::Full, Some(Transport::Subgroup));
    for target in Target::OPENGL {
        let options = EmitOptions::new().stage(Stage::Fragment).targets([target]);
        let error = compiled.emit(&options).expect_err("there are no quad operations");
        assert_eq!(
            error.first_message(),
            format!(
                "`quad_convolution` cannot be written in {target}: it swaps values by quad operations, which {target} does not have"
            )
        );
        let help = error.diagnostics[0].help.as_deref();
        assert_eq!(help, Some("use glsl450, wgsl, spirv, hlsl or msl"));
    }
}

/// Kernels that give several values, target by target: floats, and integers that an `f32` holds.
const SEVERAL: [&str; 2] = [
    "pub struct GBuffer {\n    pub albedo: Vec4,\n    pub normal: Vec3,\n    pub depth: f32,\n}\npub fn k(color: &Frame<Vec4>, \
     pixel: IVec2) -> GBuffer {\n    let here = color.load(pixel);\n    let there = color.load(pixel + ivec2(1, 0));\n    GBuffer { \
     albedo: here * 0.5, normal: (there - here).truncate(), depth: here.w }\n}\n",
    "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> (Vec4, u32, IVec2) {\n    let here = color.load(pixel);\n    (here, (here.x * \
     200.0) as u32, pixel - ivec2((here.y * 90.0) as i32, 7))\n}\n",
];

#[test]
fn several_values() {
    for (text, has_pairs) in SEVERAL.into_iter().zip([false, true]) {
        let compiled = Kernel::from_text("kernel.rs", text, "k").compile(&Settings::default());
        let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
        let inputs = test_inputs(&compiled.graph, SIZE);
        let expected = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{e}"));
        for (stage, target) in [Stage::Compute, Stage::Fragment]
            .into_iter()
            .flat_map(|s| Target::OPENGL.map(|t| (s, t)))
        {
            let options = EmitOptions::new()
                .stage(stage)
                .format(Format::Rgba32Float)
                .targets([target]);
            let es = matches!(target, Target::Essl310 | Target::Essl300);
            // OpenGL ES has no images of two components.
            let is_there = stage == Stage::Fragment || (COMPUTE.contains(&target) && !(es && has_pairs));
            let emitted = match compiled.emit(&options) {
                Err(error) if error.first_code() == Some(Code::NotInTarget) && !is_there => continue,
                emitted => emitted.unwrap_or_else(|e| panic!("{target}: {e}")),
            };
            assert!(is_there, "{stage:?} {target} is not refused");
            let context = if es { Context::es() } else { Context::desktop() };
            let context = context.unwrap_or_else(|e| panic!("this test needs OpenGL: {e}"));
            for (k, expected) in expected.targets.iter().enumerate() {
                let found = gl::run_output(&context, &emitted, target, &inputs, k);
                let found = found.unwrap_or_else(|e| panic!("{stage:?} {target} {}: {e}", expected.name));
                for (pixel, (found, expected)) in found.texels().iter().zip(expected.frame().texels()).enumerate() {
                    let off = (*found - *expected).abs().max_element();
                    assert!(
                        off <= BOUND,
                        "{stage:?} {target} {k}, pixel {pixel}: {found}, expected {expected}"
                    );
                }
            }
        }
    }
}
