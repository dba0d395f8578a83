//! Shaders with rows counted from below turn mirrored pictures into mirrored pictures, with the same bits if texels are
//! loaded. A shader without that setting computes another picture, and a worse one of a scene.

use crate::common;

use common::{bench, same_bits};
use straightline_bench::execute::{Bench, Inputs, test_inputs};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Form, Format, Kernel, Origin, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_oracle::metrics;
use straightline_runtime::Region;
use straightline_scene::capture::ShadingSample;
use straightline_scene::gbuffer;
use straightline_scene::render::{CpuRenderer, capture_scene, render_reference};
use straightline_scene::scene::builtin_scene;
use straightline_tests::gl::{self, Context};
use straightline_tests::sraa::compiled as sraa;
use straightline_tests::sraa::options::options;

/// Kernels that name rows in every way that there is, and whether they filter, which drivers round.
const KERNELS: [(&str, &str, bool); 6] = [
    (
        "loads",
        "pub fn loads(color: &Frame<Vec4>, image: &Texture<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel + ivec2(1, 2)) - \
         color.load(pixel - ivec2(0, 1)) * 0.25 + image.load(pixel / 2 + ivec2(0, 1)) + (pixel.y % 5) as f32\n}\n",
        false,
    ),
    (
        "kept",
        "pub fn kept(color: &Frame<Vec4>, rows: i32, pixel: IVec2) -> Vec4 {\n    let mut sum = Vec4::ZERO;\n    for y in 0..rows.clamp(3, 5) {\n        \
         sum += color.load(pixel + ivec2(0, y)) * (y as f32 + 0.5);\n    }\n    sum\n}\n",
        false,
    ),
    (
        "stacks",
        "pub fn stacks(stack: &FrameLayers<f32>, samples: &Multisampled<Vec4>, pixel: IVec2) -> Vec4 {\n    samples.load(pixel / 2 + ivec2(0, 1), 3) \
         * stack.load(pixel + ivec2(1, 1), 2) - stack.load(pixel, 1)\n}\n",
        false,
    ),
    (
        "filters",
        "pub fn filters(image: &Texture<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {\n    let uv = (pixel.as_vec2() + 0.3) / \
         resolution.as_vec2();\n    image.sample(linear, uv + vec2(0.0, 0.07))\n}\n",
        true,
    ),
    (
        "gathers",
        "pub fn gathers(image: &Texture<Vec4>, linear: &Sampler, pixel: IVec2) -> Vec4 {\n    let uv = (pixel.as_vec2() + 1.0) / \
         image.size().as_vec2() * 0.5;\n    let red = image.gather(0, linear, uv + vec2(0.011, 0.013));\n    vec4(red.x - 2.0 * red.w, red.y, red.z, red.w)\n}\n",
        false,
    ),
    (
        "compares",
        "pub fn compares(shadow: &DepthTexture, less: &ComparisonSampler, resolution: UVec2, pixel: IVec2) -> Vec4 {\n    let uv = \
         (pixel.as_vec2() + 0.3) / resolution.as_vec2();\n    let lit = shadow.compare(less, uv + vec2(0.0, 0.07), 0.5);\n    \
         vec4(lit, shadow.load(pixel / 2 + ivec2(0, 1)), 0.0, 1.0)\n}\n",
        true,
    ),
];

fn compiled(name: &str, text: &str, settings: &Settings) -> Compiled {
    let compiled = Kernel::from_text("kernel.rs", text, name).compile(settings);
    compiled.unwrap_or_else(|e| panic!("{e}"))
}

/// A picture whose row 0 is the last.
fn turned(frame: &Frame<Vec4>) -> Frame<Vec4> {
    let size = frame.size();
    let rows = (0..size.y as i32).rev();
    let texels = rows.flat_map(|y| (0..size.x as i32).map(move |x| ivec2(x, y)));
    Frame::new(size, texels.map(|pixel| frame.load(pixel)).collect())
}

fn all_turned(inputs: &Inputs) -> Inputs {
    let mut turned_over = inputs.clone();
    for (_, layers) in &mut turned_over.images {
        layers.iter_mut().for_each(|layer| *layer = turned(layer));
    }
    turned_over
}

fn run(bench: &Bench, compiled: &Compiled, options: &EmitOptions, inputs: &Inputs) -> Frame<Vec4> {
    let made = bench.emit_pass(compiled, options).and_then(|(pass, manifest)| {
        let uploaded = bench.upload(&manifest, inputs)?;
        bench.picture_of(&pass, &uploaded, inputs.size)
    });
    made.unwrap_or_else(|e| panic!("{}: {e}", compiled.kernel))
}

fn texels(frame: &Frame<Vec4>) -> Vec<[f32; 4]> {
    frame.texels().iter().map(|texel| texel.to_array()).collect()
}

/// The shader from below, on inputs turned over, against the other one's picture turned over. `filters` says that a driver rounds
/// places and weights.
#[track_caller]
fn check(bench: &Bench, compiled: &Compiled, upright: &EmitOptions, inputs: &Inputs, filters: bool) {
    let what = format!(
        "{} {:?} region {} {}",
        compiled.kernel, upright.stage, upright.region, inputs.size
    );
    let expected = turned(&run(bench, compiled, upright, inputs));
    let below = upright.clone().origin(Origin::LowerLeft);
    let over = all_turned(inputs);
    let found = run(bench, compiled, &below, &over);
    match filters {
        false => same_bits(&texels(&found), &texels(&expected)).unwrap_or_else(|e| panic!("{what}: {e}")),
        true => {
            // Weights of filters have 8 bits of fraction.
            let off = metrics::max_abs_difference(&found, &expected);
            assert!(off <= 0.02, "{what}: off by {off}");
        }
    }
    let told_nothing = run(bench, compiled, upright, &over);
    let off = metrics::max_abs_difference(&told_nothing, &expected);
    assert!(off > 0.05, "{what}: it makes no difference, {off}");
}

#[test]
fn every_way_to_name_a_row_is_turned() {
    let bench = bench();
    for (name, text, filters) in KERNELS {
        let compiled = compiled(name, text, &Settings::default());
        for size in [uvec2(44, 30), uvec2(45, 31)] {
            let inputs = test_inputs(&compiled.graph, size);
            for stage in [Stage::Compute, Stage::Fragment] {
                check(&bench, &compiled, &bench.emit_options(stage), &inputs, filters);
                check(
                    &bench,
                    &compiled,
                    &bench.emit_options(stage).region(true),
                    &inputs,
                    filters,
                );
            }
        }
    }
}

#[test]
fn filters_of_fragments_are_turned_where_the_frame_is_known() {
    let bench = bench();
    let text = "pub fn k(color: &Frame<Vec4>, image: &Texture<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {\n    let uv = \
                (pixel.as_vec2() + 0.3137) / resolution.as_vec2();\n    image.sample(linear, uv + vec2(0.0, 0.07)) + image.gather(1, linear, uv) + \
                color.load(pixel)\n}\n";
    let compiled = compiled("k", text, &Settings::default());
    let inputs = test_inputs(&compiled.graph, uvec2(45, 31));
    check(&bench, &compiled, &bench.emit_options(Stage::Fragment), &inputs, true);
}

#[test]
fn blocks_and_whole_quads_are_turned() {
    let bench = bench();
    let (name, text, _) = KERNELS[0];
    for block in [[2, 2], [1, 4], [3, 1]] {
        let settings = Settings::new().block(block[0], block[1]);
        let compiled = compiled(name, text, &settings);
        for region in [false, true] {
            let inputs = test_inputs(&compiled.graph, uvec2(45, 31));
            check(
                &bench,
                &compiled,
                &bench.emit_options(Stage::Compute).region(region),
                &inputs,
                false,
            );
        }
    }
    let quads = "pub fn quads(color: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {\n    let [own, beside, below, across] = \
                 color.load(pixel).gather();\n    own * 0.5 + beside * 0.25 - below + across * 0.125\n}\n";
    let compiled = compiled("quads", quads, &Settings::default());
    // Turned over, a quad of an even height is a quad, and messages go both ways: only an odd height makes a difference.
    let inputs = test_inputs(&compiled.graph, uvec2(45, 31));
    check(&bench, &compiled, &bench.emit_options(Stage::Compute), &inputs, false);
}

/// Of a region the host states rows from below, in the inputs and in the target.
#[test]
fn regions_are_stated_from_below() {
    let bench = bench();
    let (name, text, _) = KERNELS[0];
    let size = uvec2(45, 31);
    for block in [[1, 1], [2, 2]] {
        let settings = Settings::new().block(block[0], block[1]);
        let compiled = compiled(name, text, &settings);
        let inputs = test_inputs(&compiled.graph, size);
        for stage in [Stage::Compute, Stage::Fragment] {
            if stage == Stage::Fragment && block != [1, 1] {
                continue;
            }
            let part = |origin: Origin, inputs: &Inputs, region: Region| {
                let options = bench.emit_options(stage).region(true).origin(origin);
                let (pass, manifest) = bench.emit_pass(&compiled, &options).unwrap_or_else(|e| panic!("{e}"));
                let uploaded = bench.upload(&manifest, inputs).unwrap_or_else(|e| panic!("{e}"));
                let target = bench.create_target(size, pass.target_format());
                let view = target.create_view(&wgpu::TextureViewDescriptor::default());
                let mut encoder = bench
                    .device()
                    .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
                let bound = uploaded.bind_region(&pass, &view, region);
                bound.unwrap_or_else(|e| panic!("{e}")).encode(&mut encoder);
                bench.queue().submit([encoder.finish()]);
                bench.download(&target).unwrap_or_else(|e| panic!("{e}"))
            };
            let region = |first: [u32; 2], place: [u32; 2]| Region {
                place,
                ..Region::at(first, [9, 7])
            };
            let above = part(Origin::UpperLeft, &inputs, region([5, 3], [11, 20]));
            // The rectangles above, with their lowest rows counted from below.
            let from_below = region([5, 31 - 3 - 7], [11, 31 - 20 - 7]);
            let below = part(Origin::LowerLeft, &all_turned(&inputs), from_below);
            same_bits(&texels(&below), &texels(&turned(&above))).unwrap_or_else(|e| panic!("{stage:?} {block:?}: {e}"));
            assert!(
                above.texels().iter().filter(|t| **t != Vec4::ZERO).count() >= 60,
                "nothing was written"
            );
        }
    }
}

/// The silent mistake: without the setting that rows count from below, SRAA looks right but has a larger error.
#[test]
fn a_scene_from_below_beats_its_mirror() {
    let bench = bench();
    let size = uvec2(320, 181);
    let renderer = CpuRenderer::new(&builtin_scene(), size).expect("the scene is drawn");
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    let captured = capture_scene(&renderer, &samples, ShadingSample::Centre).expect("captured");
    let expected = turned(&render_reference(&renderer, 8, &mut |_, _| {}).expect("supersampled"));
    let words = options(&[("pattern", "latin4")]);
    let compiled = sraa(&words, Unroll::Full).unwrap_or_else(|e| panic!("{e}"));
    let inputs = gbuffer::sraa_inputs(&captured, &compiled.options).expect("all is captured");
    let over = all_turned(&inputs);
    for stage in [Stage::Compute, Stage::Fragment] {
        let upright = bench.emit_options(stage);
        let below = upright.clone().origin(Origin::LowerLeft);
        let decibels = |options: &EmitOptions| metrics::psnr(&run(&bench, &compiled, options, &over), &expected);
        let (told, mirrored) = (decibels(&below), decibels(&upright));
        println!("{stage:?}: {told:.2} dB from below, {mirrored:.2} dB mirrored");
        assert!(told > mirrored + 0.3, "{told} {mirrored}");
        check(&bench, &compiled, &upright, &inputs, false);
    }
}

/// On OpenGL itself, where rows count so; and as a function that a shader of the host's calls.
#[test]
fn opengl_computes_the_same() {
    let context = Context::desktop().unwrap_or_else(|e| panic!("this test needs OpenGL: {e}"));
    let (name, text, _) = KERNELS[0];
    let compiled = compiled(name, text, &Settings::default());
    let inputs = test_inputs(&compiled.graph, uvec2(45, 31));
    let bench = bench();
    let expected = turned(&run(&bench, &compiled, &bench.emit_options(Stage::Fragment), &inputs));
    for (target, stage) in [(Target::Glsl330, Stage::Fragment), (Target::Glsl430, Stage::Compute)] {
        let options = EmitOptions::new()
            .stage(stage)
            .format(Format::Rgba32Float)
            .targets([target]);
        let options = options.origin(Origin::LowerLeft);
        let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
        let found = gl::run_emitted(&context, &emitted, target, &all_turned(&inputs)).unwrap_or_else(|e| panic!("{e}"));
        same_bits(&texels(&found), &texels(&expected)).unwrap_or_else(|e| panic!("{target}: {e}"));
    }
    let options = EmitOptions::new()
        .form(Form::Function)
        .targets([Target::Glsl330])
        .origin(Origin::LowerLeft);
    let mut emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
    let function = String::from_utf8_lossy(&emitted.files[&Target::Glsl330]).into_owned();
    let caller = "uniform sampler2D color;\nuniform sampler2D image;\nlayout(location = 0) out vec4 result;\nvoid main() {\n    result = \
                  loads(color, image, gl_FragCoord.xy);\n}\n";
    let whole = format!("#version 330\n{function}\n{caller}");
    emitted.files.insert(Target::Glsl330, whole.into_bytes());
    emitted.manifest.outputs[0].format = Format::Rgba32Float;
    let found =
        gl::run_emitted(&context, &emitted, Target::Glsl330, &all_turned(&inputs)).unwrap_or_else(|e| panic!("{e}"));
    same_bits(&texels(&found), &texels(&expected)).unwrap_or_else(|e| panic!("function: {e}"));
}
