//! Emitted shaders on a real driver against a brute force in f64 that shares no code with the kernel.

mod common;

use common::*;
use straightline_codegen::{Compiled, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_study::execute::Bench;
use straightline_study::oracle::{self, SraaInputs, SraaParams};

/// Most that a result may be off, for colours in 0..1 and before output rounding.
const BOUND: f64 = 1.0 / 1024.0;

/// Every pixel of a compiled kernel, by its shader.
fn run(bench: &Bench, compiled: &Compiled, stage: Stage, inputs: &Inputs) -> Frame<Vec4> {
    bench
        .run(compiled, stage, &images(inputs))
        .unwrap_or_else(|e| panic!("{e}"))
}

fn exact(options: &[(String, String)], inputs: &Inputs) -> Vec<[f64; 4]> {
    let mut params = SraaParams::default();
    for (name, value) in options {
        params.set(name, value).unwrap_or_else(|e| panic!("{e}"));
    }
    let inputs = SraaInputs {
        color: &inputs.color,
        depth: &inputs.gbuffer.depth,
        normal: Some(&inputs.gbuffer.normal),
    };
    oracle::sraa(&inputs, &params)
}

/// The largest difference, over pixels where the exact result is finite and `paper`'s sum does not underflow.
fn difference(options: &[(String, String)], inputs: &Inputs, result: &Frame<Vec4>) -> f64 {
    let mut params = SraaParams::default();
    for (name, value) in options {
        params.set(name, value).unwrap_or_else(|e| panic!("{e}"));
    }
    let read = SraaInputs {
        color: &inputs.color,
        depth: &inputs.gbuffer.depth,
        normal: Some(&inputs.gbuffer.normal),
    };
    let paper = options.iter().any(|(_, v)| v == "paper");
    let lost = oracle::all_weights_underflow(&read, &params);
    let mut largest = 0.0f64;
    for (k, (a, b)) in result.texels().iter().zip(exact(options, inputs)).enumerate() {
        if paper && lost[k] {
            continue;
        }
        for (x, y) in a.to_array().into_iter().zip(b) {
            assert!(x.is_finite(), "pixel {k} is {a}, {options:?}");
            largest = largest.max((f64::from(x) - y).abs());
        }
    }
    largest
}

#[test]
fn all_options_match_the_brute_force() {
    let bench = bench();
    let inputs = surfaces(uvec2(61, 47), 17, 5);
    let mut worst = (0.0, String::new());
    for (_, options) in all_options() {
        for (stage, unroll) in [
            (Stage::Compute, Unroll::Full),
            (Stage::Fragment, Unroll::Full),
            (Stage::Compute, Unroll::None),
        ] {
            let off = difference(
                &options,
                &inputs,
                &run(&bench, &compile(&options, unroll), stage, &inputs),
            );
            let what = format!("{options:?} {stage:?} {unroll:?}");
            assert!(off <= BOUND, "off by {off:e}: {what}");
            if off > worst.0 {
                worst = (off, what);
            }
        }
    }
    println!("largest difference to f64: {:e} ({})", worst.0, worst.1);
}

#[test]
fn any_size_from_one_pixel() {
    let bench = bench();
    for size in [uvec2(1, 1), uvec2(1, 7), uvec2(9, 1), uvec2(8, 8), uvec2(17, 33)] {
        let inputs = surfaces(size, 5, 11);
        for stage in [Stage::Compute, Stage::Fragment] {
            let off = difference(&[], &inputs, &run(&bench, &compile(&[], Unroll::Full), stage, &inputs));
            assert!(off <= BOUND, "{size} {stage:?}: off by {off:e}");
        }
    }
}

#[test]
fn a_bad_colour_spreads_no_further_than_its_weight() {
    let bench = bench();
    let mut inputs = surfaces(uvec2(16, 16), 5, 2);
    // One surface to the left, another to the right of column 8, far apart: nothing crosses.
    let size = inputs.size;
    let column = |k: usize| k as u32 % size.x;
    let depth: Vec<f32> = (0..256).map(|k| if column(k) < 8 { 1.0 } else { 9.0 }).collect();
    let layers = (0..5).map(|_| Frame::new(size, depth.clone())).collect();
    inputs.gbuffer.depth = FrameLayers::new(layers);
    inputs.gbuffer.normal = FrameLayers::new((0..5).map(|_| Frame::new(size, vec![Vec3::Z; 256])).collect());
    let texels = (0..256)
        .map(|k| {
            if column(k) < 8 {
                Vec4::ONE
            } else {
                Vec4::splat(f32::INFINITY)
            }
        })
        .collect();
    inputs.color = Frame::new(size, texels);
    let result = run(&bench, &compile(&[], Unroll::Full), Stage::Compute, &inputs);
    for (k, texel) in result.texels().iter().enumerate().filter(|(k, _)| column(*k) < 8) {
        assert!(
            (*texel - Vec4::ONE).abs().max_element() < 1.0e-6,
            "pixel {k} is {texel}"
        );
    }
}

/// Arrays of kept loops are variables that are changed in place: begun anew, chosen, and read before they change.
#[test]
fn arrays_of_kept_loops_hold_what_the_graph_says() {
    let bench = bench();
    let inputs = surfaces(uvec2(12, 9), 1, 3);
    let begun_anew = "let mut a = [1.0, 2.0, 3.0];
        for k in 0..3 {
            total += a[k];
            a = [5.0, 6.0, 7.0];
            a[k] = shade.x;
            total += a[0] + a[2];
        }";
    let chosen = "let mut a = [1.0, 2.0, 3.0];
        for k in 0..3 {
            if shade.x * (k as f32) > 0.4 {
                a[k] += shade.y;
            } else {
                a = [0.5, 0.25, 0.125];
            }
            total += a[0] - a[1] + a[2];
        }";
    let kept_or_begun = "let mut a = [1.0, 2.0, 3.0];
        for k in 0..3 {
            if shade.x > 0.5 {
                a = [9.0, 8.0, 7.0];
            }
            a[k] += 1.0;
            total += a[2 - k];
        }";
    for (name, body) in [
        ("begun_anew", begun_anew),
        ("chosen", chosen),
        ("kept_or_begun", kept_or_begun),
    ] {
        let text = format!(
            "pub fn {name}(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{
                let shade = color.load(pixel);
                let mut total = 0.0;
                {body}
                Vec4::splat(total)
            }}"
        );
        let kernel = straightline_codegen::Kernel::from_text("test.rs", &text, name);
        let settings = |unroll| straightline_codegen::Settings {
            unroll,
            ..Default::default()
        };
        let compiled = [Unroll::Full, Unroll::None]
            .map(|unroll| kernel.compile(&settings(unroll)).unwrap_or_else(|e| panic!("{e}")));
        let [unrolled, looped] = [0, 1].map(|k| interpret(&compiled[k], &inputs, &[]));
        same_bits(&unrolled, &looped).unwrap_or_else(|e| panic!("{name}: {e}"));
        let result = run(&bench, &compiled[1], Stage::Compute, &inputs);
        for (k, (a, b)) in result.texels().iter().zip(&looped).enumerate() {
            assert!(
                (*a - Vec4::from_array(*b)).abs().max_element() < 1.0e-4,
                "{name}, pixel {k}: {a} and {b:?}"
            );
        }
    }
}
