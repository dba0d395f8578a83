//! The kernel on the built-in scene: what the listing's normalisation loses on thin wires, and what it costs to mend.

mod common;

use common::same_bits;
use straightline_codegen::Unroll;
use straightline_kernels::prelude::*;
use straightline_study::capture::{Capture, ShadingSample};
use straightline_study::execute::interpret;
use straightline_study::gbuffer;
use straightline_study::metrics;
use straightline_study::render::{CpuRenderer, capture, reference};
use straightline_study::scene::builtin;
use straightline_tests::sraa::compiled;
use straightline_tests::sraa::options::options;

fn captured(size: UVec2, pattern: &str) -> Capture {
    let renderer = CpuRenderer::new(&builtin(), size).expect("the scene is drawn");
    let samples = gbuffer::samples(pattern).expect("a pattern");
    capture(&renderer, &samples, ShadingSample::Centre).expect("captured")
}

fn rendered(size: UVec2, pattern: &str) -> (Capture, Frame<Vec4>) {
    let renderer = CpuRenderer::new(&builtin(), size).expect("the scene is drawn");
    let reference = reference(&renderer, 8, &mut |_, _| {}).expect("supersampled");
    (captured(size, pattern), reference)
}

fn resolve(capture: &Capture, words: &[(&str, &str)], unroll: Unroll) -> Frame<Vec4> {
    let compiled = compiled(&options(words), unroll).unwrap_or_else(|errors| panic!("{errors}"));
    let inputs = gbuffer::inputs(capture, &compiled.options).expect("all is captured");
    let interpreted = interpret::<f32>(&compiled, &inputs, false).expect("all is bound");
    interpreted.frame(&inputs)
}

#[test]
fn shifting_mends_what_the_listing_loses_and_changes_nothing_else() {
    let (capture, reference) = rendered(uvec2(640, 360), "latin4");
    let paper = resolve(&capture, &[("normalisation", "paper")], Unroll::Full);
    let shifted = resolve(&capture, &[("normalisation", "shifted")], Unroll::Full);
    let (lost, left) = (metrics::non_finite(&paper), metrics::non_finite(&shifted));
    let finite: Vec<bool> = paper.texels().iter().map(|c| c.is_finite()).collect();
    let [a, b] = [&paper, &shifted].map(|frame| metrics::psnr_where(frame, &reference, |k| finite[k]));
    println!(
        "{lost} of {} pixels are 0/0 with paper, {left} with shifted; elsewhere {a:.4} and {b:.4} dB",
        finite.len()
    );
    assert!(lost > 0, "the scene's wires are too thick to lose the listing");
    assert_eq!(left, 0);
    assert!((a - b).abs() < 0.01, "{a} dB with paper, {b} with shifted");
}

#[test]
fn antialiasing_helps_and_more_samples_help_more() {
    let (four, reference) = rendered(uvec2(320, 180), "latin4");
    let sixteen = captured(uvec2(320, 180), "latin16");
    let plain = metrics::psnr(&four.color, &reference);
    let x4 = metrics::psnr(&resolve(&four, &[("pattern", "latin4")], Unroll::Full), &reference);
    let x16 = metrics::psnr(&resolve(&sixteen, &[("pattern", "latin16")], Unroll::Full), &reference);
    println!("1x {plain:.2} dB, SRAA 4 {x4:.2} dB, SRAA 16 {x16:.2} dB");
    assert!(plain + 3.0 < x4 && x4 < x16, "{plain} {x4} {x16}");
}

#[test]
fn looped_and_unrolled_agree_bit_for_bit_on_the_scene() {
    for pattern in gbuffer::PATTERNS {
        let capture = captured(uvec2(96, 54), pattern);
        for metric in ["planes-normals", "depth-normals", "normals", "depth"] {
            let bits = |unroll| -> Vec<[f32; 4]> {
                let resolved = resolve(&capture, &[("pattern", pattern), ("metric", metric)], unroll);
                resolved.texels().iter().map(|color| color.to_array()).collect()
            };
            same_bits(&bits(Unroll::None), &bits(Unroll::Full)).unwrap_or_else(|e| panic!("{pattern} {metric}: {e}"));
        }
    }
}
