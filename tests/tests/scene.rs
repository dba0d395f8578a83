//! The kernel on the built-in scene: what the listing's normalisation loses on thin wires, and what it costs to mend.

mod common;

use common::*;
use straightline_codegen::Unroll;
use straightline_kernels::prelude::*;
use straightline_kernels::sraa::{GBuffer, Pattern};
use straightline_study::capture::{Capture, ShadingSample};
use straightline_study::metrics;
use straightline_study::render::{CpuRenderer, capture, reference};
use straightline_study::scene::builtin;

fn rendered(size: UVec2, pattern: Pattern) -> (Capture, Frame<Vec4>) {
    let renderer = CpuRenderer::new(&builtin(), size).expect("the scene is drawn");
    let offsets: Vec<Vec2> = (0..pattern.samples()).map(|k| pattern.offset(k)).collect();
    let capture = capture(&renderer, &offsets, ShadingSample::Centre).expect("captured");
    let reference = reference(&renderer, 8, &mut |_, _| {}).expect("supersampled");
    (capture, reference)
}

fn resolve(capture: &Capture, options: &[(&str, &str)], unroll: Unroll) -> Frame<Vec4> {
    let options: Vec<_> = options
        .iter()
        .map(|(k, v)| ((*k).to_owned(), (*v).to_owned()))
        .collect();
    let inputs = Inputs {
        size: capture.size,
        gbuffer: GBuffer {
            depth: capture.depth.clone(),
            normal: capture.normal.clone().expect("normals"),
        },
        color: capture.color.clone(),
    };
    let texels = interpret(&compile(&options, unroll), &inputs, &[]);
    Frame::new(capture.size, texels.into_iter().map(Vec4::from_array).collect())
}

#[test]
fn shifting_mends_what_the_listing_loses_and_changes_nothing_else() {
    let (capture, reference) = rendered(uvec2(640, 360), Pattern::Latin4);
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
    let (four, reference) = rendered(uvec2(320, 180), Pattern::Latin4);
    let (sixteen, _) = rendered(uvec2(320, 180), Pattern::Latin16);
    let plain = metrics::psnr(&four.color, &reference);
    let x4 = metrics::psnr(&resolve(&four, &[("pattern", "latin4")], Unroll::Full), &reference);
    let x16 = metrics::psnr(&resolve(&sixteen, &[("pattern", "latin16")], Unroll::Full), &reference);
    println!("1x {plain:.2} dB, SRAA 4 {x4:.2} dB, SRAA 16 {x16:.2} dB");
    assert!(plain + 3.0 < x4 && x4 < x16, "{plain} {x4} {x16}");
}

#[test]
fn looped_and_unrolled_agree_bit_for_bit_on_the_scene() {
    for (pattern, name) in [
        (Pattern::Ordered4, "ordered4"),
        (Pattern::Latin4, "latin4"),
        (Pattern::Ordered16, "ordered16"),
        (Pattern::Latin16, "latin16"),
    ] {
        let renderer = CpuRenderer::new(&builtin(), uvec2(96, 54)).expect("the scene is drawn");
        let offsets: Vec<Vec2> = (0..pattern.samples()).map(|k| pattern.offset(k)).collect();
        let capture = capture(&renderer, &offsets, ShadingSample::Centre).expect("captured");
        for (_, options) in all_options().iter().filter(|(cfg, _)| cfg.pattern == pattern) {
            let set: Vec<(&str, &str)> = options.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
            let bits = |unroll| {
                resolve(&capture, &set, unroll)
                    .texels()
                    .iter()
                    .map(|c| c.to_array())
                    .collect::<Vec<_>>()
            };
            same_bits(&bits(Unroll::None), &bits(Unroll::Full)).unwrap_or_else(|e| panic!("{name} {set:?}: {e}"));
        }
    }
}
