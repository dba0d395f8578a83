//! Numbers at the edges of their types, as rustc computes with them, as the interpreter does, and on a GPU: conversions, integer
//! division, bounds and what is not finite.

use crate::common;

use common::{bench, same_bits};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::{Branches, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;

/// The halves of a word: a float holds each.
fn halves(n: u32) -> Vec2 {
    vec2((n & 0xffff) as f32, (n >> 16) as f32)
}

fn conversions(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let a = halves(c.x as i32 as u32);
    let b = halves(c.x as u32);
    vec4(a.x, a.y, b.x, b.y)
}

fn vectors(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let a = vec2(c.y, c.x).as_ivec2();
    let b = vec2(c.y, c.x).as_uvec2();
    let a = halves(a.y as u32);
    let b = halves(b.y);
    vec4(a.x, a.y, b.x, b.y)
}

fn division(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let n = c.z as i32;
    let m = c.w as i32;
    let a = halves((n / m) as u32);
    let b = halves((n % m) as u32);
    vec4(a.x, a.y, b.x, b.y)
}

fn infinities(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let far = 3.0e38 * 2.0;
    let near = c.z.min(far).max(-far);
    let beyond = if c.z < far { 1.0 } else { 2.0 };
    let largest = c.z.min(3.4028235e38);
    vec4(near, beyond, largest, if near * far > 1.0 { 3.0 } else { 4.0 })
}

const TEXT: &str = include_str!("edges.rs");

/// Floats around the edges of the integers, integers that divide, and every pair of them.
fn inputs() -> Inputs {
    let floats = [
        0.0,
        -0.5,
        1.5,
        -1.5,
        2_147_483_520.0,
        2_147_483_648.0,
        -2_147_483_648.0,
        -2_147_483_904.0,
        4_294_967_040.0,
        4_294_967_296.0,
        3.0e9,
        3.0e38,
        -3.0e38,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];
    let integers = [5.0, -5.0, 7.0, -7.0, 1.0, -1.0, 1.0e6, -2_147_483_648.0];
    let texel = |k: usize| {
        let x = floats[k % floats.len()];
        let (n, m) = (integers[k % 8], integers[k / 8 % 8]);
        // Rust panics where a quotient overflows.
        let m = if n < -2.0e9 && m == -1.0 { 2.0 } else { m };
        vec4(x, 1.0, n, m)
    };
    let size = uvec2(16, 8);
    Inputs::new(size).with_image("color", Frame::new(size, (0..128).map(texel).collect()))
}

fn check(name: &str, native: fn(&Frame<Vec4>, IVec2) -> Vec4) {
    // The text of this file holds what is none of a kernel: its functions alone.
    let begin = TEXT.find("/// The halves of a word").expect("the kernels");
    let end = TEXT.find("const TEXT").expect("their end");
    let inputs = inputs();
    let (_, layers) = &inputs.images[0];
    let pixels = (0..8).flat_map(|y| (0..16).map(move |x| ivec2(x, y)));
    let expected: Vec<[f32; 4]> = pixels.map(|at| native(&layers[0], at).to_array()).collect();
    let settings = Settings::new().unroll(Unroll::Full).branches(Branches::Select);
    let compiled = Kernel::from_text("edges.rs", &TEXT[begin..end], name).compile(&settings);
    let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
    let found = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{name}: {e}"));
    same_bits(&expected, &found.texels).unwrap_or_else(|e| panic!("{name}, interpreted: {e}"));
    let shown = bench()
        .run(&compiled, Stage::Compute, &inputs)
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    let shown: Vec<[f32; 4]> = shown.texels().iter().map(|t| t.to_array()).collect();
    same_bits(&expected, &shown).unwrap_or_else(|e| panic!("{name}, on the GPU: {e}"));
}

#[test]
fn conversions_of_scalars_are_those_of_rust() {
    check("conversions", conversions);
}

#[test]
fn conversions_of_vectors_are_those_of_rust() {
    check("vectors", vectors);
}

#[test]
fn integer_division_is_that_of_rust() {
    check("division", division);
}

#[test]
fn infinities_are_those_of_rust() {
    check("infinities", infinities);
}

/// A NaN passes through `clamp` of a number, and becomes the lower bound in one of a vector, as rustc and glam have it; `min`
/// and `max` of vectors are glam's too.
#[test]
fn clamps_of_a_nan_are_those_of_rust() {
    fn clamps(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
        let c = color.load(pixel);
        let v = c.clamp(Vec4::ZERO, Vec4::ONE);
        let least = c.min(vec4(2.0, 2.0, 2.0, 2.0));
        let most = Vec4::ONE.max(c);
        vec4(c.x.clamp(0.0, 1.0), v.x, least.x, most.x)
    }
    let text = "pub fn clamps(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
        let c = color.load(pixel);
        let v = c.clamp(Vec4::ZERO, Vec4::ONE);
        let least = c.min(vec4(2.0, 2.0, 2.0, 2.0));
        let most = Vec4::ONE.max(c);
        vec4(c.x.clamp(0.0, 1.0), v.x, least.x, most.x)
    }";
    let inputs = inputs();
    let (_, layers) = &inputs.images[0];
    let expected: Vec<[f32; 4]> = (0..16).map(|x| clamps(&layers[0], ivec2(x, 0)).to_array()).collect();
    let compiled = Kernel::from_text("edges.rs", text, "clamps").compile(&Settings::default());
    let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
    let found = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{e}"));
    same_bits(&expected, &found.texels[..16]).unwrap_or_else(|e| panic!("{e}"));
}
