//! HLSL as DXC reads it, in its default language version and in that of 2021.

use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Kernel, Settings, Stage, Unroll};
use straightline_tests::compilers;

/// Loops with one name for their counters: beside each other, in each other, in branches, and in functions that are called twice.
const LOOPS: &str = r"
use straightline_kernels::prelude::*;

fn sum(color: &Frame<Vec4>, pixel: IVec2, n: i32) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for i in 0..n {
        sum += color.load(pixel + ivec2(i, 0));
    }
    for i in 0..n {
        for j in 0..i {
            sum += color.load(pixel + ivec2(j, i)) * 0.5;
        }
        for j in 0..2 {
            sum += color.load(pixel + ivec2(j, -i)) * 0.25;
        }
    }
    sum
}

pub fn loops(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut total = sum(color, pixel, n) + sum(color, pixel, n + 1);
    if total.x > 1.0 {
        for i in 0..n {
            total += color.load(pixel - ivec2(i, 0));
        }
    } else {
        for i in 0..n {
            total -= color.load(pixel - ivec2(0, i));
        }
    }
    let mut i = 1;
    while i < n {
        total += color.load(pixel * i) * 0.125;
        i *= 2;
    }
    for k in 0..4 {
        total += color.load(pixel * k);
    }
    for k in 0..4 {
        total += color.load(pixel * k + (128 >> k));
    }
    total * (1 << (n & 15)) as f32
}
";

fn emitted(unroll: Unroll, stage: Stage) -> String {
    let settings = Settings::new().unroll(unroll);
    let compiled = Kernel::from_text("loops.rs", LOOPS, "loops").compile(&settings);
    let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
    let emitted = compiled.emit(&EmitOptions::new().stage(stage).targets([Target::Hlsl]));
    let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
    compilers::read(&emitted).unwrap_or_else(|e| panic!("{unroll} {stage:?}: {e}"));
    String::from_utf8_lossy(&emitted.files[&Target::Hlsl]).into_owned()
}

#[test]
fn dxc_reads_loops_with_counters_of_one_name() {
    for unroll in [Unroll::None, Unroll::Partial(2), Unroll::Full] {
        for stage in [Stage::Compute, Stage::Fragment] {
            let text = emitted(unroll, stage);
            let loops = text.matches("for (int ").count();
            assert!(loops >= 8, "{unroll} {stage:?} has {loops} loops:\n{text}");
        }
    }
}

/// A counter of HLSL lives until the end of the block around its loop: DXC's default language version warns of a second one, and
/// refuses a variable of its name.
#[test]
fn dxc_tells_of_a_counter_twice_in_a_block() {
    let text = "RWTexture2D<float4> o : register(u0);\n[numthreads(1, 1, 1)]\nvoid main() {\n    \
                for (int i = 0; i < 3; i++) o[int2(i, 0)] = 1.0;\n    for (int i = 0; i < 3; i++) o[int2(i, 1)] = 1.0;\n}\n";
    let variable = text.replacen(
        "for (int i = 0; i < 3; i++) o[int2(i, 1)]",
        "int i = 1; o[int2(i, 1)]",
        1,
    );
    for text in [text, &variable] {
        let refused = compilers::dxc(text, Stage::Compute, "main").expect_err("DXC takes it");
        assert!(refused.contains("redefinition of 'i'"), "{refused}");
    }
    let other = text
        .replacen("int i", "int j", 1)
        .replacen("i < 3; i++", "j < 3; j++", 1);
    let other = other.replacen("int2(i, 0)", "int2(j, 0)", 1);
    compilers::dxc(&other, Stage::Compute, "main").unwrap_or_else(|why| panic!("{why}"));
}
