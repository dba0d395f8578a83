//! Emitted GLSL and HLSL, compiled by glslang, and the SPIR-V as it is, on a Vulkan driver, compared with the interpreter.

use crate::common;

use straightline_bench::execute::{Bench, Inputs, interpret_kernel, test_inputs};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, Kernel, Settings, Stage, Transport, Unroll};
use straightline_kernels::prelude::*;
use straightline_tests::passthrough;
use straightline_tests::sraa::surfaces;

/// Languages that are compiled to SPIR-V here, or are SPIR-V.
const LANGUAGES: [Target; 3] = [Target::Glsl450, Target::Hlsl, Target::Spirv];

/// Most that a component may be off, of the larger of 1 and its size.
const BOUND: f32 = 1.0e-5;

fn bench() -> Bench {
    passthrough::bench().unwrap_or_else(|e| panic!("{e}"))
}

type Options<'a> = &'a [(&'a str, &'a str)];

fn compiled(name: &str, options: Options<'_>, unroll: Unroll, transport: Option<Transport>) -> Compiled {
    let options = options.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned()));
    let settings = Settings::new().set_all(options).unroll(unroll).transport(transport);
    let kernel = Kernel::builtin(name).and_then(|kernel| kernel.compile(&settings));
    kernel.unwrap_or_else(|errors| panic!("{name}:\n{errors}"))
}

/// Runs a kernel in some languages, and compares each picture with the interpreter's.
#[track_caller]
fn check(bench: &Bench, compiled: &Compiled, stage: Stage, inputs: &Inputs, languages: &[Target]) {
    let emitted = compiled.emit(&bench.emit_options(stage).targets(languages.iter().copied()));
    let emitted = emitted.unwrap_or_else(|e| panic!("{}: {e}", compiled.kernel));
    let expected = interpret_kernel::<f32>(compiled, inputs, false).unwrap_or_else(|e| panic!("{e}"));
    let expected = expected.frame(inputs);
    let first = expected.texels()[0];
    assert!(
        expected.texels().iter().any(|texel| *texel != first),
        "{}: one colour",
        compiled.kernel
    );
    for target in languages {
        let what = format!("{} {stage:?} {target}", compiled.kernel);
        let found = passthrough::run(bench, &emitted, *target, inputs).unwrap_or_else(|e| panic!("{what}: {e}"));
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

/// Inputs of any kernel, sharp edges among them.
fn inputs(compiled: &Compiled) -> Inputs {
    test_inputs(&compiled.graph, uvec2(45, 31))
}

#[test]
fn sraa() {
    let bench = bench();
    let options = [("pattern".to_owned(), "latin4".to_owned())];
    let inputs = surfaces::inputs(&options.to_vec(), uvec2(45, 31), 5);
    for unroll in [Unroll::Full, Unroll::None] {
        let compiled = compiled("sraa", &[("pattern", "latin4")], unroll, None);
        for stage in [Stage::Compute, Stage::Fragment] {
            check(&bench, &compiled, stage, &inputs, &LANGUAGES);
        }
    }
}

#[test]
fn blocks_of_pixels() {
    let bench = bench();
    let compiled = compiled("quad_convolution", &[], Unroll::Full, Some(Transport::Block));
    check(&bench, &compiled, Stage::Compute, &inputs(&compiled), &LANGUAGES);
}

#[test]
fn messages_of_quads() {
    let bench = bench();
    for transport in [Transport::Subgroup, Transport::Derivatives] {
        let compiled = compiled("quad_convolution", &[], Unroll::Full, Some(transport));
        check(
            &bench,
            &compiled,
            Stage::Fragment,
            &inputs(&compiled),
            &[Target::Glsl450, Target::Spirv],
        );
    }
}

/// Samplers that filter and samplers that compare, and textures of other sizes than the picture's.
#[test]
fn samplers() {
    let bench = bench();
    for name in ["pcf", "quad_upsampling"] {
        let compiled = compiled(name, &[], Unroll::Full, Some(Transport::Block));
        check(&bench, &compiled, Stage::Compute, &inputs(&compiled), &LANGUAGES);
    }
}

#[test]
fn edge_filters() {
    let bench = bench();
    for name in ["stalker", "tabula_rasa"] {
        let compiled = compiled(name, &[], Unroll::Full, None);
        for stage in [Stage::Compute, Stage::Fragment] {
            check(&bench, &compiled, stage, &inputs(&compiled), &LANGUAGES);
        }
    }
}

#[test]
fn what_is_missing_is_named() {
    let compiled = compiled("quad_convolution", &[], Unroll::Full, Some(Transport::Block));
    let options = bench()
        .emit_options(Stage::Compute)
        .targets([Target::Glsl450, Target::Msl]);
    let emitted = compiled.emit(&options).expect("it is emitted");
    let refused = |bench: &Bench, target| {
        let refused = passthrough::run(bench, &emitted, target, &inputs(&compiled));
        refused.expect_err("it cannot run")
    };
    let error = refused(&bench(), Target::Msl);
    assert!(error.contains("no compiler makes SPIR-V of msl"), "{error}");
    let error = refused(&common::bench(), Target::Glsl450);
    assert!(error.contains("`PASSTHROUGH_SHADERS`"), "{error}");
}
