//! Sums whose order of operations matters: what rustc makes of them is what every form computes, in every language on a
//! driver, bit for bit. And kernels in which nothing hangs on an order, where nothing is marked.

use straightline_bench::execute::{Bench, Inputs, interpret_kernel};
use straightline_codegen::emit::Target;
use straightline_codegen::ir::Op;
use straightline_codegen::policy::Math;
use straightline_codegen::{Compiled, EmitOptions, Format, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_tests::gl::{self, Context};
use straightline_tests::passthrough;
use straightline_tests::random::oracle::{self, Rustc, Text};

mod kernels;

use kernels::{ASKED, ORDERED, ORDINARY};

/// Forms of a kernel: all loops unrolled, none, and some by factors that do and do not divide the trip counts.
const FORMS: [Unroll; 5] = [
    Unroll::Full,
    Unroll::None,
    Unroll::Partial(2),
    Unroll::Partial(4),
    Unroll::Partial(5),
];

/// Languages that are compiled to SPIR-V here, or are SPIR-V.
const PAST_WGPU: [Target; 3] = [Target::Glsl450, Target::Hlsl, Target::Spirv];

fn source(kernel: &str) -> String {
    format!("use straightline_kernels::prelude::*;\n\n{kernel}")
}

fn compiled(kernel: &str, unroll: Unroll, math: Math) -> Compiled {
    let settings = Settings::new().unroll(unroll).math(math);
    let compiled = Kernel::from_text("sum.rs", &source(kernel), "k").compile(&settings);
    compiled.unwrap_or_else(|errors| panic!("{kernel}\n{errors}"))
}

/// Operations that are marked.
fn marks(compiled: &Compiled) -> usize {
    let graph = &compiled.graph;
    graph.node_ids().filter(|id| graph.node(*id).op == Op::Exact).count()
}

/// Numbers of sizes that lose bits of each other.
fn inputs() -> Inputs {
    let size = uvec2(8, 8);
    let mut state = 1_u32;
    let mut next = || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let scale = [1.0e-4, 0.1, 1.0, 88.8, 4.0e3, 1.0e5, 16_777_216.0, 3.0e8][(state >> 29) as usize];
        ((state >> 8) as f32 / 8_388_608.0 - 1.0) * scale
    };
    let texels = (0..size.x * size.y)
        .map(|_| vec4(next(), next(), next(), next()))
        .collect();
    Inputs::new(size).with_image("a", Frame::new(size, texels))
}

fn bits(frame: &Frame<Vec4>) -> Vec<[u32; 4]> {
    frame
        .texels()
        .iter()
        .map(|texel| texel.to_array().map(f32::to_bits))
        .collect()
}

/// Compares bit for bit, a NaN with any NaN.
#[track_caller]
fn same(what: &str, found: &[[u32; 4]], expected: &[[u32; 4]]) {
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        let number = |bits: &u32| f32::from_bits(*bits);
        let same =
            |(a, b): (&u32, &u32)| a == b || (number(a).is_nan() && number(b).is_nan()) || number(a) == number(b);
        assert!(
            found.iter().zip(expected).all(same),
            "{what}: pixel {k}: found {:?}, expected {:?}",
            found.map(f32::from_bits),
            expected.map(f32::from_bits)
        );
    }
    assert_eq!(found.len(), expected.len());
}

/// Runs a kernel in every form and language, and compares all with the interpreter.
fn check(bench: &Bench, name: &str, kernel: &str, math: Math) {
    let inputs = inputs();
    let native = compiled(kernel, Unroll::Full, math);
    let expected = interpret_kernel::<f32>(&native, &inputs, false).unwrap_or_else(|e| panic!("{name}: {e}"));
    let expected = bits(&expected.frame(&inputs));
    for unroll in FORMS {
        let what = format!("{name}, {math}, loops {unroll}");
        let compiled = compiled(kernel, unroll, math);
        // Constants may be all that is left of an unrolled loop.
        assert!(
            marks(&compiled) > 0 || unroll != Unroll::None,
            "{what}: nothing is marked"
        );
        let computed = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
        same(&what, &bits(&computed.frame(&inputs)), &expected);
        for stage in [Stage::Compute, Stage::Fragment] {
            let emitted = compiled.emit(
                &bench
                    .emit_options(stage)
                    .targets([Target::Wgsl].into_iter().chain(PAST_WGPU)),
            );
            let emitted = emitted.unwrap_or_else(|e| panic!("{what}: {e}"));
            let found = bench
                .run(&compiled, stage, &inputs)
                .unwrap_or_else(|e| panic!("{what}: {e}"));
            same(&format!("{what}, {stage:?} wgsl"), &bits(&found), &expected);
            // A single stage is enough to test how compilers of the languages and drivers treat the body.
            for target in PAST_WGPU.into_iter().filter(|_| stage == Stage::Compute) {
                let what = format!("{what}, {stage:?} {target}");
                let found =
                    passthrough::run(bench, &emitted, target, &inputs).unwrap_or_else(|e| panic!("{what}: {e}"));
                same(&what, &bits(&found), &expected);
            }
        }
    }
}

fn bench() -> Bench {
    passthrough::bench().unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn every_sum_is_what_rustc_makes_of_it() {
    let rustc = Rustc::find().unwrap_or_else(|why| panic!("{why}"));
    let all = ORDERED.iter().chain(ASKED).chain(ORDINARY);
    // The program that rustc runs has no uniforms.
    let texts = all
        .filter(|(_, kernel)| !kernel.contains("taps"))
        .enumerate()
        .map(|(seed, (_, kernel))| Text {
            seed: seed as u64,
            source: (*kernel).to_owned(),
        });
    let texts: Vec<Text> = texts.collect();
    let (tally, failures) = oracle::check(&rustc, &texts, 1).unwrap_or_else(|why| panic!("{why}"));
    if let Some(failure) = failures.first() {
        panic!("{}\n{}", failure.text, failure.difference);
    }
    assert_eq!(tally.compared, texts.len() as u64, "all are compared: {tally:?}");
}

#[test]
fn drivers_keep_the_order_of_sums_that_hang_on_it() {
    let bench = bench();
    for (name, kernel) in ORDERED {
        check(&bench, name, kernel, Math::Exact);
    }
}

#[test]
fn opengl_keeps_the_order_of_sums_that_hang_on_it() {
    let needs = |e: String| -> Context { panic!("this test needs OpenGL: {e}") };
    let desktop = Context::desktop().unwrap_or_else(needs);
    let es = Context::es().unwrap_or_else(needs);
    let inputs = inputs();
    for (name, kernel) in ORDERED {
        for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(4)] {
            let compiled = compiled(kernel, unroll, Math::Exact);
            let expected = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{name}: {e}"));
            let expected = bits(&expected.frame(&inputs));
            for target in Target::OPENGL {
                let what = format!("{name}, loops {unroll}, {target}");
                let options = EmitOptions::new()
                    .stage(Stage::Fragment)
                    .format(Format::Rgba32Float)
                    .targets([target]);
                let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{what}: {e}"));
                let context = match target {
                    Target::Essl310 | Target::Essl300 => &es,
                    _ => &desktop,
                };
                let found = gl::run_emitted(context, &emitted, target, &inputs);
                same(
                    &what,
                    &bits(&found.unwrap_or_else(|e| panic!("{what}: {e}"))),
                    &expected,
                );
            }
        }
    }
}

#[test]
fn fast_mathematics_leaves_such_sums_alone() {
    let bench = bench();
    for (name, kernel) in ORDERED.iter().filter(|(name, _)| kernels::FAST.contains(name)) {
        check(&bench, name, kernel, Math::Fast);
    }
}

#[test]
fn drivers_keep_an_order_that_is_asked_for() {
    let bench = bench();
    for (name, kernel) in ASKED {
        check(&bench, name, kernel, Math::Exact);
    }
}

#[test]
fn strict_mathematics_is_that_of_rustc_on_drivers() {
    let bench = bench();
    for (name, kernel) in ORDERED
        .iter()
        .chain(ORDINARY)
        .filter(|(name, _)| kernels::STRICT.contains(name))
    {
        check(&bench, name, kernel, Math::Strict);
    }
}

#[test]
fn nothing_is_marked_where_nothing_hangs_on_an_order() {
    for (name, kernel) in ORDINARY {
        for unroll in FORMS {
            assert_eq!(
                marks(&compiled(kernel, unroll, Math::Exact)),
                0,
                "{name}, loops {unroll}"
            );
        }
    }
}

#[test]
fn every_language_says_what_is_exact() {
    let compiled = compiled(ORDERED[0].1, Unroll::None, Math::Exact);
    let emitted = compiled.emit(&EmitOptions::new().targets(Target::ALL.into_iter().filter(|target| {
        // Languages without compute shaders.
        !matches!(target, Target::Glsl330 | Target::Essl300)
    })));
    let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
    assert!(emitted.manifest.counts.exact > 0);
    for (target, word) in [
        (Target::Wgsl, "= as_written("),
        (Target::Msl, "as_written("),
        (Target::Essl310, "= as_written("),
        (Target::Essl310, "uintBitsToFloat(min(floatBitsToUint("),
        (Target::Glsl430, "precise float"),
        (Target::Glsl450, "precise float"),
        (Target::Hlsl, "precise float"),
    ] {
        let text = String::from_utf8_lossy(&emitted.files[&target]).into_owned();
        assert!(text.contains(word), "{target}: no `{word}` in\n{text}");
    }
}

/// The kernel and what it reads have the names of the functions that keep values as they are written.
#[test]
fn names_of_its_own_functions_are_free() {
    let text = "use straightline_kernels::prelude::*;
pub fn as_written(as_written_vec2f: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let as_written = as_written_vec2f.load(pixel);
    let moved = vec2(as_written.x + 1.0e7, as_written.y + 1.0e7);
    vec4(moved.x - 1.0e7, moved.y - 1.0e7, (as_written.x + as_written.y) - as_written.x, 1.0)
}
";
    let compiled = Kernel::from_text("as_written.rs", text, "as_written").compile(&Settings::default());
    let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
    let mut inputs = inputs();
    inputs.images[0].0 = "as_written_vec2f".to_owned();
    let expected = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{e}"));
    let expected = bits(&expected.frame(&inputs));
    let bench = bench();
    let emitted = compiled.emit(&bench.emit_options(Stage::Compute).targets(PAST_WGPU));
    let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
    let found = bench
        .run(&compiled, Stage::Compute, &inputs)
        .unwrap_or_else(|e| panic!("{e}"));
    same("wgsl", &bits(&found), &expected);
    for target in PAST_WGPU {
        let found = passthrough::run(&bench, &emitted, target, &inputs).unwrap_or_else(|e| panic!("{target}: {e}"));
        same(&target.to_string(), &bits(&found), &expected);
    }
}
