//! Uniforms as immediates on a Vulkan driver: bit for bit the picture of a uniform buffer, in every language that the driver
//! can be given.

use glam::{Vec4, uvec2};
use straightline_bench::execute::{Bench, Inputs, interpret_kernel, test_inputs};
use straightline_codegen::chain::{Chain, ChainSpec};
use straightline_codegen::emit::{Emitted, Parameters, Target};
use straightline_codegen::{Compiled, EmitOptions, Format, Kernel, Settings, ShaderSpec, Stage};
use straightline_kernels::prelude::Frame;
use straightline_tests::{compilers, passthrough};

/// Members that languages would pack in different ways, a matrix with an unread column, and the frame's size.
const TEXT: &str = "
pub fn k(image: &Texture<Vec4>, first: f32, offset: Vec3, gain: f32, turn: Mat3, count: u32, both: bool, resolution: UVec2, \
     pixel: IVec2) -> Vec4 {
    let texel = image.load(pixel);
    let turned = texel.x * turn.x_axis + texel.y * turn.z_axis;
    let last = if both { first + gain } else { first };
    (turned + offset).extend(last) * ((count * resolution.x) as f32)
}";

const LANGUAGES: [Target; 4] = [Target::Wgsl, Target::Spirv, Target::Glsl450, Target::Hlsl];

fn bench() -> Bench {
    passthrough::bench().unwrap_or_else(|e| panic!("{e}"))
}

fn bits(picture: &Frame<Vec4>) -> Vec<[u32; 4]> {
    let texels = picture.texels().iter();
    texels.map(|texel| texel.to_array().map(f32::to_bits)).collect()
}

fn emit(compiled: &Compiled, options: EmitOptions) -> Emitted {
    compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"))
}

/// The picture of an emitted shader in one language.
fn picture(bench: &Bench, emitted: &Emitted, target: Target, inputs: &Inputs) -> Vec<[u32; 4]> {
    let written = match target {
        Target::Wgsl => {
            let pass = bench.create_pass(emitted, &Default::default());
            let uploaded = bench.upload(&emitted.manifest, inputs);
            let (pass, uploaded) = (
                pass.unwrap_or_else(|e| panic!("{e}")),
                uploaded.unwrap_or_else(|e| panic!("{e}")),
            );
            let written = bench.written_by(&pass, &uploaded, inputs.size);
            written.map_err(|e| e.to_string())
        }
        // glslang does not define the macro by which the text tells Vulkan from Direct3D.
        Target::Hlsl => {
            let manifest = emitted.manifest.clone();
            let text = String::from_utf8_lossy(&emitted.files[&target]);
            let words = compilers::spirv_by_dxc(&text, manifest.stage, &manifest.entry_point);
            let words = words.unwrap_or_else(|e| panic!("{e}"));
            passthrough::written(bench, manifest, target, &words, inputs).map(|(written, _)| written)
        }
        target => passthrough::run_all(bench, emitted, target, inputs),
    };
    bits(&written.unwrap_or_else(|e| panic!("{target}: {e}"))[0].frame())
}

#[test]
fn every_language_draws_the_picture_of_a_buffer() {
    let bench = bench();
    let compiled = Kernel::from_text("k.rs", TEXT, "k").compile(&Settings::new());
    let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
    let mut inputs = test_inputs(&compiled.graph, uvec2(13, 9));
    let values: [(&str, &[f64]); 5] = [
        ("first", &[0.3]),
        ("offset", &[1.5, -2.25, 0.125]),
        ("gain", &[7.0]),
        ("count", &[3.0]),
        ("both", &[1.0]),
    ];
    for (name, numbers) in values {
        inputs = inputs.with_uniform(name, numbers);
    }
    let interpreted = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{e}"));
    let expected = bits(&interpreted.frame(&inputs));
    for stage in [Stage::Compute, Stage::Fragment] {
        let options = |space| bench.emit_options(stage).targets(Target::MODERN).parameters(space);
        let [buffer, immediate] =
            [Parameters::Uniform, Parameters::Immediate].map(|space| emit(&compiled, options(space)));
        compilers::read(&immediate).unwrap_or_else(|e| panic!("{e}"));
        assert!(immediate.manifest.immediates.is_some() && buffer.manifest.immediates.is_none());
        for target in LANGUAGES {
            let found = picture(&bench, &immediate, target, &inputs);
            assert_eq!(found, picture(&bench, &buffer, target, &inputs), "{stage:?} {target}");
            assert_eq!(found, expected, "{stage:?} {target}");
        }
    }
}

/// SRAA has its tolerance in a uniform, in both precisions and with a region.
#[test]
fn sraa_draws_the_picture_of_a_buffer() {
    let bench = bench();
    let settings = Settings::new().set("pattern", "latin4").set("tau", "uniform");
    let compiled = Kernel::builtin("sraa").and_then(|kernel| kernel.compile(&settings));
    let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
    let inputs = test_inputs(&compiled.graph, uvec2(45, 31)).with_uniform("tau", &[300.0]);
    for region in [false, true] {
        let options = |space| bench.emit_options(Stage::Compute).region(region).parameters(space);
        let [buffer, immediate] = [Parameters::Uniform, Parameters::Immediate].map(|space| {
            let emitted = emit(&compiled, options(space));
            picture(&bench, &emitted, Target::Wgsl, &inputs)
        });
        assert_eq!(immediate, buffer, "{region}");
    }
}

#[test]
fn chains_draw_the_picture_of_buffers() {
    const CHAIN: &str = "
pub fn graded(color: &Frame<Vec4>, gain: f32) -> Frame<Vec4> {
    let scaled: Frame<Vec4> = draw(color.size(), |pixel| color.load(pixel) * gain);
    draw(color.size(), |pixel| (scaled.load(pixel) - color.load(pixel)) * gain)
}";
    let bench = bench();
    let run = |space| {
        let spec = ShaderSpec::new().format(Format::Rgba32Float).parameters(space);
        let spec = ChainSpec::from(spec).pictures(Format::Rgba32Float);
        let compiled = Chain::from_text("graded.rs", CHAIN, "graded").compile(&spec);
        let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
        let emitted = compiled.emit().unwrap_or_else(|e| panic!("{e}"));
        let inputs = test_inputs(&compiled.inputs_graph(), uvec2(13, 9)).with_uniform("gain", &[6.5]);
        let written = bench.run_chain(&emitted, &inputs).unwrap_or_else(|e| panic!("{e}"));
        bits(&written[0].frame())
    };
    assert_eq!(run(Parameters::Immediate), run(Parameters::Uniform));
}
