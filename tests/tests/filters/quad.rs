//! Filters of quads: as rustc compiles them, in every form by the interpreter, and on a GPU by every transport, against
//! what they are to give by definition (`src/quads/`).
//!
//! `cargo test --workspace --test filters quad:: -- --nocapture` prints the largest error of each.

// Kernels and oracles are written with counters.
#![allow(clippy::needless_range_loop)]

mod bounce;
use crate::common;
mod counts;
mod filters;
mod forward;
mod hard;
mod messages;
mod minified;
mod refused;
mod scatter;
mod shadows;

use common::{Random, bench, same_bits};
use straightline_bench::execute::{Bench, Inputs, interpret_kernel};
use straightline_codegen::{Compiled, Kernel, Settings, Stage, Transport, Unroll};
use straightline_kernels::prelude::*;
use straightline_tests::quads::Picture;

/// Even and odd sizes, one smaller than a quad, and one with quads at the right border only.
const SIZES: [UVec2; 4] = [uvec2(32, 22), uvec2(33, 21), uvec2(1, 1), uvec2(5, 2)];

/// Options by name.
type Options<'a> = &'a [(&'a str, &'a str)];

/// Forms that must agree bit for bit.
const FORMS: [Unroll; 4] = [Unroll::Full, Unroll::None, Unroll::Partial(2), Unroll::Partial(3)];

fn compile(name: &str, options: Options<'_>, unroll: Unroll, transport: Option<Transport>) -> Compiled {
    let settings = Settings::new()
        .set_all(options.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())))
        .unroll(unroll)
        .transport(transport);
    Kernel::from_argument(name)
        .and_then(|k| k.compile(&settings))
        .unwrap_or_else(|e| panic!("{e}"))
}

/// A kernel of a test's own.
fn compile_text(text: &str, name: &str, settings: &Settings) -> Compiled {
    Kernel::from_text("test.rs", text, name)
        .compile(settings)
        .unwrap_or_else(|e| panic!("{e}"))
}

/// Every pixel, quad by quad; lanes outside of the frame are dropped.
fn native(size: UVec2, kernel: impl Fn(Quad<IVec2>) -> Quad<Vec4>) -> Vec<[f32; 4]> {
    let mut image = vec![[0.0; 4]; (size.x * size.y) as usize];
    for y in (0..size.y).step_by(2) {
        for x in (0..size.x).step_by(2) {
            let corner = ivec2(x as i32, y as i32);
            let (pixels, colors) = (Quad::pixels(corner).lanes(), kernel(Quad::pixels(corner)).lanes());
            for (pixel, color) in pixels.iter().zip(colors) {
                if pixel.x < size.x as i32 && pixel.y < size.y as i32 {
                    image[(pixel.y as u32 * size.x + pixel.x as u32) as usize] = color.to_array();
                }
            }
        }
    }
    image
}

fn defined(size: UVec2, oracle: impl Fn([i64; 2]) -> [f64; 4]) -> Vec<[f64; 4]> {
    let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| [i64::from(x), i64::from(y)]));
    pixels.map(oracle).collect()
}

fn largest(found: &[[f32; 4]], expected: &[[f64; 4]]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    pairs
        .map(|(a, b)| {
            let off = (f64::from(*a) - b).abs();
            if off.is_nan() { f64::INFINITY } else { off }
        })
        .fold(0.0, f64::max)
}

fn texels(frame: &Frame<Vec4>) -> Vec<[f32; 4]> {
    frame.texels().iter().map(|t| t.to_array()).collect()
}

fn picture(frame: &Frame<Vec4>) -> Picture {
    Picture {
        size: [i64::from(frame.size().x), i64::from(frame.size().y)],
        texels: frame.texels().iter().map(|t| t.to_array().map(f64::from)).collect(),
    }
}

/// Noise in every component.
fn noise(size: UVec2, seed: u64) -> Frame<Vec4> {
    let mut random = Random(seed);
    let texel = |_| vec4(random.unit(), random.unit(), random.unit(), random.unit());
    Frame::new(size, (0..size.x * size.y).map(texel).collect())
}

fn unit_normals(size: UVec2, seed: u64) -> Frame<Vec4> {
    let mut random = Random(seed);
    let texel = |_| {
        let v = vec3(random.unit() - 0.5, random.unit() - 0.5, -0.2 - random.unit());
        v.normalize().extend(0.0)
    };
    Frame::new(size, (0..size.x * size.y).map(texel).collect())
}

fn components<T: Copy>(frame: &Frame<Vec4>, of: impl Fn(Vec4) -> T) -> Frame<T> {
    Frame::new(frame.size(), frame.texels().iter().map(|t| of(*t)).collect())
}

/// Runs a filter in every form and by every transport. `tolerance` bounds the error against the definition; the derivative
/// transport, which rounds, may be off by `rounding` more.
fn check(
    gpu: &Bench,
    [row, name]: [&str; 2],
    options: Options<'_>,
    inputs: &Inputs,
    native: &[[f32; 4]],
    defined: &[[f64; 4]],
    [tolerance, rounding]: [f64; 2],
) {
    // Other forms differ in what they compute, not in where: one size is enough for them.
    let forms = if inputs.size == SIZES[1] {
        &FORMS[..]
    } else {
        &FORMS[..1]
    };
    for unroll in forms.iter().copied() {
        let compiled = compile(name, options, unroll, None);
        let found = interpret_kernel::<f32>(&compiled, inputs, false).unwrap_or_else(|e| panic!("{row}: {e}"));
        same_bits(native, &found.texels).unwrap_or_else(|e| panic!("{row} {unroll}: {e}"));
    }
    let off = largest(native, defined);
    assert!(off <= tolerance, "{row}: natively off by {off:.3e}");
    let mut shown = format!("{row} | {}x{} | {off:.1e}", inputs.size.x, inputs.size.y);
    let ways = [
        (Some(Transport::Subgroup), Stage::Fragment, tolerance),
        (Some(Transport::Derivatives), Stage::Fragment, tolerance + rounding),
        (Some(Transport::Block), Stage::Compute, tolerance),
    ];
    for (transport, stage, tolerance) in ways {
        let compiled = compile(name, options, Unroll::Full, transport);
        let frame = gpu
            .run(&compiled, stage, inputs)
            .unwrap_or_else(|e| panic!("{row} by {transport:?}: {e}"));
        let off = largest(&texels(&frame), defined);
        assert!(
            off <= tolerance,
            "{row} by {transport:?}, {}: off by {off:.3e}, more than {tolerance:.1e}",
            inputs.size
        );
        shown += &format!(" | {off:.1e}");
    }
    for block in [[4, 2], [8, 2], [2, 4]] {
        let settings = Settings::new()
            .set_all(options.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())))
            .block(block[0], block[1]);
        let rows = Kernel::from_argument(name)
            .and_then(|k| k.compile(&settings))
            .unwrap_or_else(|e| panic!("{e}"));
        let found = interpret_kernel::<f32>(&rows, inputs, false).unwrap_or_else(|e| panic!("{row}: {e}"));
        same_bits(native, &found.texels).unwrap_or_else(|e| panic!("{row} in {block:?}: {e}"));
        if block == [8, 2] {
            let frame = gpu
                .run(&rows, Stage::Compute, inputs)
                .unwrap_or_else(|e| panic!("{row}: {e}"));
            let off = largest(&texels(&frame), defined);
            assert!(off <= tolerance, "{row} in rows of quads: off by {off:.3e}");
            shown += &format!(" | {off:.1e}");
        }
    }
    println!("{shown}");
}
