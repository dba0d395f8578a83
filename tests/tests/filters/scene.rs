//! The kernel on the built-in scene: the loss by the listing's normalisation on thin wires, and the cost of fixing it.

use crate::common;

use common::same_bits;
use straightline_bench::execute::interpret_kernel;
use straightline_codegen::Unroll;
use straightline_kernels::prelude::*;
use straightline_oracle::metrics;
use straightline_scene::capture::{Capture, ShadingSample};
use straightline_scene::gbuffer;
use straightline_scene::picture;
use straightline_scene::render::{CpuRenderer, capture_scene, render_reference};
use straightline_scene::scene::{SKY_DEPTH, Scene, builtin_scene};
use straightline_tests::sraa::compiled;
use straightline_tests::sraa::options::options;

fn captured(size: UVec2, pattern: &str) -> Capture {
    let renderer = CpuRenderer::new(&builtin_scene(), size).expect("the scene is drawn");
    let samples = gbuffer::pattern_offsets(pattern).expect("a pattern");
    capture_scene(&renderer, &samples, ShadingSample::Centre).expect("captured")
}

fn rendered(size: UVec2, pattern: &str) -> (Capture, Frame<Vec4>) {
    let renderer = CpuRenderer::new(&builtin_scene(), size).expect("the scene is drawn");
    let reference = render_reference(&renderer, 8, &mut |_, _| {}).expect("supersampled");
    (captured(size, pattern), reference)
}

fn resolve(capture: &Capture, words: &[(&str, &str)], unroll: Unroll) -> Frame<Vec4> {
    let compiled = compiled(&options(words), unroll).unwrap_or_else(|errors| panic!("{errors}"));
    let inputs = gbuffer::sraa_inputs(capture, &compiled.options).expect("all is captured");
    let interpreted = interpret_kernel::<f32>(&compiled, &inputs, false).expect("all is bound");
    interpreted.frame(&inputs)
}

#[test]
fn shifting_mends_what_the_listing_loses_and_changes_nothing_else() {
    let (capture, reference) = rendered(uvec2(640, 360), "latin4");
    // Skipping what is not finite would make these pixels black.
    let listed = [("normalisation", "paper"), ("non-finite", "spread")];
    let paper = resolve(&capture, &listed, Unroll::Full);
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
    for pattern in ["latin4", "ordered16"] {
        let capture = captured(uvec2(64, 36), pattern);
        for metric in ["planes-normals", "depth-normals", "normals", "depth"] {
            let bits = |unroll| -> Vec<[f32; 4]> {
                let resolved = resolve(&capture, &[("pattern", pattern), ("metric", metric)], unroll);
                resolved.texels().iter().map(|color| color.to_array()).collect()
            };
            same_bits(&bits(Unroll::None), &bits(Unroll::Full)).unwrap_or_else(|e| panic!("{pattern} {metric}: {e}"));
        }
    }
}

/// A scene by name, drawn on the CPU, with what it should look like.
fn scene(name: &str, size: UVec2) -> (Capture, Frame<Vec4>) {
    let scene = Scene::from_name(name).expect("a scene");
    let renderer = CpuRenderer::new(&scene, size).expect("the scene is drawn");
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    let capture = capture_scene(&renderer, &samples, ShadingSample::Centre).expect("captured");
    let reference = render_reference(&renderer, 8, &mut |_, _| {}).expect("supersampled");
    (capture, reference)
}

/// Pictures of a scene in several metrics side by side, where `STRAIGHTLINE_PICTURES` names a folder.
fn show(name: &str, columns: &[(&str, &Frame<Vec4>)], corner: UVec2) {
    let Some(folder) = std::env::var_os("STRAIGHTLINE_PICTURES") else {
        return;
    };
    let details: Vec<(&str, Frame<Vec4>)> = columns
        .iter()
        .map(|(label, frame)| (*label, picture::enlarge_detail(frame, corner.x, corner.y, 72, 72, 4)))
        .collect();
    let details: Vec<(&str, &Frame<Vec4>)> = details.iter().map(|(label, frame)| (*label, frame)).collect();
    let path = std::path::Path::new(&folder).join(format!("{name}.png"));
    picture::write_picture(&path, &picture::compose_montage(&details)).expect("the picture is written");
}

/// Paper figure 5: grooves and insets lie a little behind the surface, and the surface itself recedes by as much.
#[test]
fn planes_beat_depth_in_grooves() {
    let (capture, reference) = scene("grooves", uvec2(320, 180));
    let filtered = |metric| resolve(&capture, &[("metric", metric), ("depth-scale", "10")], Unroll::Full);
    let [planes, depth_normals, depth] = ["planes-normals", "depth-normals", "depth"].map(filtered);
    let [a, b, c] = [&planes, &depth_normals, &depth].map(|frame| metrics::psnr(frame, &reference));
    println!("grooves: planes and normals {a:.2} dB, depth and normals {b:.2} dB, depth {c:.2} dB");
    let columns = [
        ("1x", &capture.color),
        ("planes and normals", &planes),
        ("depth and normals", &depth_normals),
        ("depth", &depth),
        ("256x", &reference),
    ];
    show("grooves", &columns, uvec2(120, 72));
    assert!(a > b + 0.5 && b > c + 1.0, "{a} {b} {c}");
}

/// Paper figure 4: where walls meet, depth goes on and normals turn.
#[test]
fn normals_beat_depth_at_creases() {
    let (capture, reference) = scene("creases", uvec2(320, 180));
    let filtered = |metric| resolve(&capture, &[("metric", metric)], Unroll::Full);
    let [both, normals, depth] = ["depth-normals", "normals", "depth"].map(filtered);
    let [a, b, c] = [&both, &normals, &depth].map(|frame| metrics::psnr(frame, &reference));
    println!("creases: depth and normals {a:.2} dB, normals {b:.2} dB, depth {c:.2} dB");
    let columns = [
        ("1x", &capture.color),
        ("depth and normals", &both),
        ("normals", &normals),
        ("depth", &depth),
        ("256x", &reference),
    ];
    show("creases", &columns, uvec2(120, 72));
    assert!(a > c + 2.0 && b > c + 2.0, "{a} {b} {c}");
}

/// §3.3: an even region is blurred, the less the more the falloff is felt, and not at all where the mask is on.
#[test]
fn the_mask_keeps_a_textured_floor_and_falloff_limits_its_blur() {
    let (capture, _) = scene("floor", uvec2(320, 180));
    let filtered = |falloff, mask| {
        let words = [
            ("metric", "planes-normals"),
            ("difference", "relative"),
            ("falloff", falloff),
            ("mask", mask),
        ];
        resolve(&capture, &words, Unroll::Full)
    };
    // Pixels that lie on the floor with everything that a filter reads around them, and not so near the horizon that depth grows
    // by half from one to the next. Beyond the border lie copies, which are on no plane.
    let (size, depths) = (capture.size.as_ivec2(), capture.depth.layers());
    let is_floor = |x: i32, y: i32| {
        let around = (-1..=1).flat_map(|j| (-1..=1).map(move |i| ivec2(x + i, y + j)));
        let near = around.flat_map(|at| depths.iter().map(move |layer| layer.load(at)));
        let (least, most) = near.fold((f32::INFINITY, 0.0f32), |(least, most), z| (least.min(z), most.max(z)));
        let inside = x > 0 && y > 0 && x + 1 < size.x && y + 1 < size.y;
        inside && most < 0.5 * SKY_DEPTH && most - least < 0.5 * least
    };
    let floor: Vec<bool> = (0..size.y)
        .flat_map(|y| (0..size.x).map(move |x| is_floor(x, y)))
        .collect();
    let on_floor = floor.iter().filter(|is| **is).count();
    assert!(on_floor * 3 > floor.len(), "{on_floor} of {} pixels", floor.len());
    let mut blurs = Vec::new();
    for falloff in ["none", "gaussian", "tent"] {
        let blurred = filtered(falloff, "none");
        let blur = metrics::psnr_where(&blurred, &capture.color, |k| floor[k]);
        println!("floor, falloff {falloff}: {blur:.2} dB of what was shaded");
        blurs.push(blur);
        for mask in ["select", "branch"] {
            let masked = filtered(falloff, mask);
            let kept = floor.iter().enumerate().filter(|(_, is)| **is).all(|(k, _)| {
                masked.texels()[k].to_array().map(f32::to_bits)
                    == capture.color.texels()[k].to_array().map(f32::to_bits)
            });
            assert!(kept, "falloff {falloff}, mask {mask}");
        }
    }
    assert!(blurs[0] + 3.0 < blurs[1] && blurs[0] + 3.0 < blurs[2], "{blurs:?}");
}
