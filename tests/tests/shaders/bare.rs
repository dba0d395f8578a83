//! Shaders on lavapipe and SwiftShader without wgpu, compared with the interpreter.

use straightline_bench::execute::{Inputs, interpret_kernel, test_inputs};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Format, Kernel, Settings, Stage, Unroll};
use straightline_foreign::vulkan::{Binding, Device, Dispatch, Driver, Format as TexelFormat, Image, Resource};
use straightline_kernels::prelude::*;
use straightline_tests::bare::{LANGUAGES, SENTINEL, Shader};
use straightline_tests::compilers;

/// Most that a component may be off, of the larger of 1 and its size.
const BOUND: f32 = 1.0e-5;

fn devices() -> Vec<Device> {
    let opened = Driver::ALL.map(|driver| Device::open(driver).unwrap_or_else(|why| panic!("{why}")));
    opened.into_iter().collect()
}

/// Runs a kernel in each language on each driver, and compares each picture with the interpreter's.
#[track_caller]
fn check(compiled: &Compiled, inputs: &Inputs) {
    let options = EmitOptions::new().stage(Stage::Compute).format(Format::Rgba32Float);
    let emitted = compiled
        .emit(&options.targets(LANGUAGES))
        .unwrap_or_else(|e| panic!("{e}"));
    let expected = interpret_kernel::<f32>(compiled, inputs, false).unwrap_or_else(|e| panic!("{e}"));
    let expected = expected.frame(inputs);
    let first = expected.texels()[0];
    assert!(expected.texels().iter().any(|texel| *texel != first), "one colour");
    for target in LANGUAGES {
        let shader = Shader::new(&emitted, target).unwrap_or_else(|why| panic!("{why}"));
        for device in devices() {
            let what = format!("{} {target} on {}", compiled.kernel, device.name());
            let found = shader
                .run(&device, inputs)
                .unwrap_or_else(|why| panic!("{what}: {why}"));
            assert_eq!(found[0].texels().len(), expected.texels().len());
            for (k, (found, expected)) in found[0].texels().iter().zip(expected.texels()).enumerate() {
                let off = (*found - *expected).abs() / expected.abs().max(Vec4::ONE);
                assert!(
                    off.max_element() <= BOUND,
                    "{what}: pixel {k}: found {found}, expected {expected}"
                );
            }
        }
    }
}

#[test]
fn kernels_with_textures_samplers_and_uniforms() {
    for (name, unroll) in [
        ("tabula_rasa", Unroll::Full),
        ("stalker", Unroll::None),
        ("downsampling", Unroll::Full),
    ] {
        let settings = Settings::new().unroll(unroll);
        let compiled = Kernel::builtin(name).and_then(|kernel| kernel.compile(&settings));
        let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
        check(&compiled, &test_inputs(&compiled.graph, uvec2(45, 31)));
    }
}

#[test]
fn kernels_with_buffers_and_integers() {
    let text = "use straightline_kernels::prelude::*;\n\
                pub fn k(ids: &Frame<UVec4>, weights: &Buffer<Vec2>, scale: f32, shift: IVec3, pixel: IVec2) -> Vec4 {\n    \
                let id = ids.load(pixel);\n    let w = weights.load((id.x % 5) as usize);\n    \
                vec4(w.x, w.y, id.y as f32, (shift.z + pixel.x) as f32) * scale\n}\n";
    let compiled = Kernel::from_text("k.rs", text, "k").compile(&Settings::default());
    let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
    let size = uvec2(19, 7);
    let ids = (0..size.x * size.y).map(|k| uvec4(k, k * 3, 0, 0)).collect();
    let weights = (0..5).map(|k| [f64::from(k) * 0.25, f64::from(k), 0.0, 0.0]).collect();
    let inputs = Inputs::new(size)
        .with_integers("ids", vec![Frame::new(size, ids)])
        .with_buffer("weights", weights)
        .with_uniform("scale", &[0.5])
        .with_uniform("shift", &[1.0, 2.0, -3.0]);
    check(&compiled, &inputs);
}

/// Texels that a shader does not write keep their contents.
#[test]
fn texels_that_are_not_written_keep_the_sentinel() {
    let text = "#version 450\nlayout(local_size_x = 1) in;\nlayout(set = 0, binding = 3, rgba32f) uniform writeonly image2D o;\n\
                layout(set = 0, binding = 1) buffer B { uint b[]; };\n\
                void main() { if (gl_GlobalInvocationID.x == 1u) imageStore(o, ivec2(1, 0), vec4(b[0])); b[1] = 7u; }";
    let words = compilers::compiled_glsl(text, "comp").unwrap_or_else(|why| panic!("{why}"));
    for device in devices() {
        let buffer = Resource::Buffer([5u32, 6].iter().flat_map(|x| x.to_le_bytes()).collect());
        let target = Resource::Target(Image {
            format: TexelFormat::Rgba32Float,
            width: 3,
            height: 1,
            bytes: SENTINEL.to_le_bytes().repeat(12),
        });
        let bind = |number, resource| Binding {
            set: 0,
            number,
            resource,
        };
        let mut bindings = [bind(1, buffer), bind(3, target)];
        let dispatch = Dispatch {
            words: &words,
            entry: "main",
            groups: [3, 1, 1],
        };
        device
            .dispatch(&dispatch, &mut bindings)
            .unwrap_or_else(|why| panic!("{why}"));
        let [Resource::Buffer(buffer), Resource::Target(target)] = [&bindings[0].resource, &bindings[1].resource]
        else {
            panic!("other resources");
        };
        assert_eq!(compilers::words(buffer), [5, 7], "{}", device.name());
        let five = 5.0f32.to_bits();
        let expected = [[SENTINEL; 4], [five; 4], [SENTINEL; 4]].concat();
        assert_eq!(compilers::words(&target.bytes), expected, "{}", device.name());
    }
}

#[test]
fn what_is_not_known_is_named() {
    let compiled = Kernel::builtin("pcf").and_then(|kernel| kernel.compile(&Settings::default()));
    let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
    let options = EmitOptions::new().stage(Stage::Compute).targets([Target::Spirv]);
    let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
    let refused = Shader::new(&emitted, Target::Msl).expect_err("it was not emitted");
    assert!(refused.contains("it was not emitted in msl"), "{refused}");
}
