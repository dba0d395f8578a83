//! Loops that are requested to be left in the shader: those that can be are, the others say why, and every form computes
//! the values of rustc's own code.

use crate::common;
#[path = "kept/kernels.rs"]
#[allow(clippy::needless_range_loop, clippy::manual_swap)] // kernels as people write them
mod kernels;

use common::{Shaders, bench, same_bits};
use glam::{IVec2, Vec4, ivec2, uvec2};
use std::time::{Duration, Instant};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::emit::Target;
use straightline_codegen::{Branches, Compiled, EmitOptions, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::Frame;

type Native = fn(&Frame<Vec4>, i32, IVec2) -> Vec4;

const TEXT: &str = include_str!("kept/kernels.rs");

/// `n` in the kernels.
const N: i32 = 4;

/// Each kernel, its native version, and the outcome of its loops: `none`, or part of the reason why it was unrolled.
const KERNELS: &[(&str, Native, &[&str])] = &[
    ("elements", kernels::elements, &["none"; 5]),
    ("enumerated", kernels::enumerated, &["none"; 3]),
    ("structures", kernels::structures, &["none"; 3]),
    ("grid", kernels::grid, &["none"; 4]),
    ("whiles", kernels::whiles, &["none"; 2]),
    ("bounded", kernels::bounded, &["none"; 3]),
    ("unsigned", kernels::unsigned, &["none"; 2]),
    ("left", kernels::left, &["none", "none", CULPRIT]),
    ("culprit", kernels::culprit, &[CULPRIT, "none", "none", "none"]),
    ("called_culprit", kernels::called_culprit, &["none", CULPRIT]),
    (
        "outer_culprit",
        kernels::outer_culprit,
        &["the power of `powi`", "none"],
    ),
    ("bounds", kernels::bounds, &["none"; 2]),
    ("swapped", kernels::swapped, &["none"]),
    ("rotated", kernels::rotated, &["none"]),
    ("old_versions", kernels::old_versions, &["none"]),
];

/// Part of the reason why a loop is unrolled for the sake of a constant.
const CULPRIT: &str = "and this loop assigns it";

const FORMS: [(Unroll, Branches); 6] = [
    (Unroll::Full, Branches::Select),
    (Unroll::Full, Branches::Keep),
    (Unroll::None, Branches::AsLoops),
    (Unroll::None, Branches::Select),
    (Unroll::Partial(2), Branches::AsLoops),
    (Unroll::Partial(3), Branches::Keep),
];

fn settings((unroll, branches): (Unroll, Branches)) -> Settings {
    Settings::new().unroll(unroll).branches(branches)
}

fn compile(text: &str, name: &str, settings: &Settings) -> Result<Compiled, Errors> {
    Kernel::from_text("kept.rs", text, name).compile(settings)
}

fn compiled(name: &str, form: (Unroll, Branches)) -> Compiled {
    compile(TEXT, name, &settings(form)).unwrap_or_else(|e| panic!("{name} {form:?}:\n{e}"))
}

fn frame() -> Frame<Vec4> {
    let texel = |k: u32| Vec4::new(k as f32 * 0.125, 1.5 - k as f32 * 0.25, k as f32, 0.75);
    Frame::new(uvec2(4, 3), (0..12).map(texel).collect())
}

fn inputs() -> Inputs {
    let mut inputs = Inputs::new(uvec2(4, 3));
    inputs.images = vec![("color".to_owned(), vec![frame()])];
    inputs.uniforms = vec![("n".to_owned(), vec![f64::from(N)])];
    inputs
}

#[test]
fn loops_become_what_they_can() {
    for (name, _, expected) in KERNELS {
        let compiled = compiled(name, (Unroll::None, Branches::AsLoops));
        let found = compiled.loops.iter().map(|report| match &report.reason {
            None => report.unroll.to_string(),
            Some(reason) => reason.clone(),
        });
        let found: Vec<String> = found.collect();
        assert_eq!(found.len(), expected.len(), "{name}: {found:?}");
        for (found, expected) in found.iter().zip(*expected) {
            assert!(found.contains(expected), "{name}: {found}, not {expected}");
        }
    }
}

#[test]
fn a_while_with_a_bound_is_unrolled() {
    let select = compiled("bounded", (Unroll::Full, Branches::Select));
    let copies: Vec<u64> = select.loops.iter().map(|report| report.copies).collect();
    assert_eq!(copies, [9, 12, 6]);
    let emitted = select.emit(&EmitOptions::new()).unwrap_or_else(|e| panic!("{e}"));
    let text = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
    for (word, count) in [("for (", 0), ("loop {", 0), ("while", 0), ("if ", 1)] {
        // The one `if` is that of pixels outside of the frame.
        assert_eq!(text.matches(word).count(), count, "`{word}` in\n{text}");
    }
}

#[test]
fn every_form_computes_what_rust_does() {
    let (frame, inputs) = (frame(), inputs());
    for (name, native, _) in KERNELS {
        let places = (0..12).map(|k| ivec2(k % 4, k / 4));
        let expected: Vec<[f32; 4]> = places.map(|pixel| native(&frame, N, pixel).to_array()).collect();
        for form in FORMS {
            let result = interpret_kernel::<f32>(&compiled(name, form), &inputs, false);
            let result = result.unwrap_or_else(|e| panic!("{name} {form:?}: {e}"));
            same_bits(&expected, &result.texels).unwrap_or_else(|e| panic!("{name} {form:?}: {e}"));
        }
    }
}

#[test]
fn every_form_is_emitted_and_is_the_same_picture_on_a_gpu() {
    let mut shaders = Shaders::new("kept");
    let (bench, inputs) = (bench(), inputs());
    for (name, ..) in KERNELS {
        for (k, form) in FORMS.into_iter().enumerate() {
            let compiled = compiled(name, form);
            let emitted = compiled.emit(&EmitOptions::new().targets(Target::MODERN));
            let emitted = emitted.unwrap_or_else(|e| panic!("{name} {form:?}: {e}"));
            shaders.write(&emitted, &format!("{name}-{k}"));
            let expected = interpret_kernel::<f32>(&compiled, &inputs, false).expect("ran before");
            let found = bench.run(&compiled, Stage::Compute, &inputs);
            let found = found.unwrap_or_else(|e| panic!("{name} {form:?}: {e}"));
            for (a, b) in found.texels().iter().zip(&expected.texels) {
                let off = (*a - Vec4::from_array(*b)).abs() / b.iter().fold(1.0f32, |m, x| m.max(x.abs()));
                assert!(off.max_element() <= 1.0e-5, "{name} {form:?}: {a} and {b:?}");
            }
        }
    }
    assert!(shaders.glsl.len() >= 60 && shaders.spirv.len() >= 60);
    shaders.read();
}

/// The first error of a kernel with one loop in the middle.
fn refused(body: &str, settings: &Settings) -> String {
    let text = format!(
        "pub fn k(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {{
    let mut s = color.load(pixel).x;
{body}
    vec4(s, 0.0, 0.0, 1.0)
}}
"
    );
    let refused = compile(&text, "k", settings);
    refused.expect_err(&text).render(false)
}

#[test]
fn a_loop_asked_for_by_name_is_left_in_the_shader_or_refused() {
    let left = "this loop cannot be left in the shader";
    let attribute = refused(
        "    #[cfg_attr(false, unroll(none))]
    for i in 1..4 { s += 0.5_f32.powi(i); }",
        &Settings::default(),
    );
    assert!(
        attribute.contains(left) && attribute.contains("the power of `powi`"),
        "{attribute}"
    );
    let factor = refused(
        "    #[cfg_attr(false, unroll(2))]
    for i in 1..5 { s += 0.5_f32.powi(i); }",
        &Settings::default(),
    );
    assert!(
        factor.contains(left) && factor.contains("the power of `powi`"),
        "{factor}"
    );
    assert!(factor.contains("`unroll(2)`"), "{factor}");
    let stepped = refused(
        "    let mut i = 0;
    #[cfg_attr(false, unroll(none))]
    while i < 4 { i += 1; s += 0.5_f32.powi(i); }",
        &Settings::default(),
    );
    assert!(stepped.contains(left), "{stepped}");
    let named = Settings::new().unroll_loop("k.i", Unroll::None);
    let path = refused("    for i in 1..4 { s += 0.5_f32.powi(i); }", &named);
    assert!(path.contains(left), "{path}");
    let followed = refused(
        "    let mut m = 0;
    for i in 0..4 { m += i; }
    s += 0.5_f32.powi(m);",
        &named,
    );
    assert!(
        followed.contains(left) && followed.contains("the power of `powi`"),
        "{followed}"
    );
    let runtime = refused(
        "    #[cfg_attr(false, unroll(full))]
    for i in 0..n { s += i as f32; }",
        &Settings::default(),
    );
    assert!(runtime.contains("cannot be unrolled"), "{runtime}");
    // Errors that do not depend on the loop's evaluation are reported as they are.
    let wrong = refused("    for i in 0..4 { s += missing(i); }", &named);
    assert!(wrong.contains("missing") && !wrong.contains(left), "{wrong}");
    let wrong = refused("    for i in 0..4 { s += 1.0; }\n    s += missing(1);", &named);
    assert!(wrong.contains("missing") && !wrong.contains(left), "{wrong}");
}

/// Loops in loops, of which none can be left in the shader, are not tried twice a level.
#[test]
fn nested_loops_that_cannot_stay_take_little_time() {
    let mut text =
        "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let mut s = color.load(pixel).x;\n".to_owned();
    for depth in 0..25 {
        text += &format!("for i{depth} in 1..2 {{\n");
    }
    text += "s += 0.5_f32.powi(i24);\ns += 0.5_f32.powi(i0);\n";
    text += &"}\n".repeat(25);
    text += "    vec4(s, 0.0, 0.0, 1.0)\n}\n";
    let began = Instant::now();
    let settings = settings((Unroll::None, Branches::AsLoops));
    compile(&text, "k", &settings).unwrap_or_else(|e| panic!("{e}"));
    assert!(began.elapsed() < Duration::from_secs(20), "{:?}", began.elapsed());
}
