//! Earlier frames as further taps (`history`): the kernel against its definition in f64, hard cases included, and what it is worth in a
//! still, a pan, a turn, and where something moves.

mod common;

use common::bench;
use glam::{UVec2, Vec4, uvec2};
use straightline_codegen::{Compiled, Stage, Unroll};
use straightline_kernels::prelude::Frame;
use straightline_testbed::execute::{Inputs, interpret};
use straightline_testbed::oracle::{self, Resolved, SraaParams};
use straightline_tests::sraa::options::{Options, options, samples_needed};
use straightline_tests::sraa::{Random, compiled, native, surfaces};

const SIZE: UVec2 = uvec2(21, 17);

/// With every option that earlier frames may meet.
fn sets() -> Vec<Options> {
    let sets: [&[(&str, &str)]; 19] = [
        &[("history", "1")],
        &[("history", "3")],
        &[("history", "4")],
        &[("history", "2"), ("pattern", "latin16")],
        &[("history", "2"), ("metric", "planes-normals")],
        &[("history", "2"), ("metric", "planes-normals"), ("plane", "tap"), ("difference", "relative")],
        &[("history", "2"), ("metric", "normals")],
        &[("history", "2"), ("metric", "depth"), ("depth", "reversed")],
        &[("history", "2"), ("difference", "relative"), ("depth-scale", "3")],
        &[("history", "2"), ("normals", "unorm")],
        &[("history", "2"), ("normals", "unorm"), ("metric", "planes-normals"), ("renormalise", "true")],
        &[("history", "2"), ("normals", "packed"), ("turn", "chord")],
        &[("history", "2"), ("layout", "superresolution")],
        &[("history", "2"), ("layout", "multisampled")],
        &[("history", "2"), ("layout", "split"), ("falloff", "none")],
        &[("history", "2"), ("falloff", "gaussian"), ("sigma", "0.25"), ("radius", "2")],
        &[("history", "2"), ("non-finite", "spread")],
        &[("history", "2"), ("guards", "none")],
        &[("history", "2"), ("guards", "fallback")],
    ];
    sets.iter().map(|set| options(set)).collect()
}

fn made(set: &Options, unroll: Unroll) -> Compiled {
    compiled(set, unroll).unwrap_or_else(|errors| panic!("{set:?}:\n{errors}"))
}

fn defined(set: &Options, inputs: &Inputs) -> Vec<Resolved> {
    let params = SraaParams::of(set.iter().map(|(name, value)| (name, value))).expect("options");
    oracle::sraa(inputs, &params).unwrap_or_else(|error| panic!("{set:?}: {error}"))
}

/// The largest difference to the definition; all of it is finite.
fn off(found: impl IntoIterator<Item = [f64; 4]>, expected: &[Resolved], what: &str) -> f64 {
    let mut largest = 0.0f64;
    for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
        let at = (k as u32 % SIZE.x, k as u32 / SIZE.x);
        assert!(expected.sure, "{what} at {at:?}");
        assert!(expected.color.iter().all(|axis| axis.is_finite()), "{what} at {at:?}: {expected:?}");
        assert!(found.iter().all(|axis| axis.is_finite()), "{what} at {at:?}: {found:?}");
        for (a, b) in found.into_iter().zip(expected.color) {
            largest = largest.max((a - b).abs());
        }
    }
    largest
}

#[test]
fn every_form_gives_what_the_definition_says() {
    let bench = bench();
    let [mut in_f64, mut in_f32, mut on_device, mut worth] = [0.0f64; 4];
    for set in sets() {
        let inputs = surfaces::inputs(&set, SIZE, 11);
        let expected = defined(&set, &inputs);
        // Earlier frames must have made a difference.
        let without: Options = set.iter().filter(|(name, _)| name != "history").cloned().collect();
        let changed = defined(&without, &inputs).into_iter().map(|pixel| pixel.color);
        worth = worth.max(0.1 / off(changed, &expected, "without history"));
        for unroll in [Unroll::Full, Unroll::None] {
            let (compiled, what) = (made(&set, unroll), format!("{set:?} {unroll}"));
            let exact = interpret::<f64>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
            in_f64 = in_f64.max(off(exact.targets[0].texels.iter().copied(), &expected, &what));
            let single = interpret::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
            in_f32 = in_f32.max(off(single.targets[0].texels.iter().copied(), &expected, &what));
            if unroll == Unroll::Full && samples_needed(&set) <= 4 {
                for stage in [Stage::Compute, Stage::Fragment] {
                    let picture = bench
                        .run(&compiled, stage, &inputs)
                        .unwrap_or_else(|e| panic!("{what}: {e}"));
                    let texels = picture.texels().iter().map(|texel| texel.to_array().map(f64::from));
                    on_device = on_device.max(off(texels, &expected, &format!("{what} {stage:?}")));
                }
            }
        }
        let texels = native::run(&set, &inputs).into_iter().map(|texel| texel.map(f64::from));
        in_f32 = in_f32.max(off(texels, &expected, &format!("{set:?} natively")));
    }
    println!("off the definition: {in_f64:.1e} in f64, {in_f32:.1e} in f32, {on_device:.1e} on the device");
    assert!(worth < 1.0, "earlier frames change next to nothing");
    assert!(in_f64 < 1.0e-5 && in_f32 < 1.0e-4 && on_device < 1.0e-4);
}

/// With what is not a number, infinite or far away here and there in all that earlier frames left.
fn hard(inputs: Inputs) -> Inputs {
    const BAD: [f32; 8] = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        -1.0e30,
        1.0e20,
        3.0e9,
        0.0,
    ];
    let mut random = Random(99);
    let mut inputs = inputs;
    for (name, layers) in &mut inputs.images {
        if name.starts_with("history") {
            for layer in layers.iter_mut() {
                let texels = layer.texels().iter().map(|texel| {
                    let mut texel = *texel;
                    if random.unit() < 0.3 {
                        texel[random.choose(&[0, 1, 2, 3])] = random.choose(&BAD);
                    }
                    // Of colours only what is not finite is bad; the largest would be right to show.
                    match name.as_str() {
                        "history_color" if texel.abs().max_element() > 1.0e3 => Vec4::splat(f32::NAN),
                        _ => texel,
                    }
                });
                *layer = Frame::new(layer.size(), texels.collect());
            }
        }
    }
    inputs
}

#[test]
fn what_earlier_frames_cannot_be_spoils_nothing() {
    let bench = bench();
    let mut largest = 0.0f64;
    let guarded = |set: &Options| !set.iter().any(|(_, v)| ["none", "fallback", "spread"].contains(&v.as_str()));
    let sets: Vec<Options> = sets().into_iter().filter(guarded).collect();
    assert!(sets.len() > 12, "{} sets", sets.len());
    for set in sets {
        let inputs = hard(surfaces::inputs(&set, SIZE, 12));
        let (compiled, what) = (made(&set, Unroll::Full), format!("hard, {set:?}"));
        let expected = defined(&set, &inputs);
        let single = interpret::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
        largest = largest.max(off(single.targets[0].texels.iter().copied(), &expected, &what));
        if samples_needed(&set) <= 4 {
            let picture = bench.run(&compiled, Stage::Compute, &inputs);
            let picture = picture.unwrap_or_else(|e| panic!("{what}: {e}"));
            let texels = picture.texels().iter().map(|texel| texel.to_array().map(f64::from));
            largest = largest.max(off(texels, &expected, &what));
        }
    }
    println!("off the definition: {largest:.1e}");
    assert!(largest < 1.0e-4);
}

#[test]
fn frames_from_outside_the_picture_change_nothing() {
    let set = options(&[("history", "4")]);
    let plain = options(&[("history", "1")]);
    let inputs = surfaces::inputs(&set, SIZE, 3);
    let outside = |inputs: Inputs, motion: Vec4| inputs.layers("history_motion", vec![Frame::new(SIZE, vec![motion; 21 * 17]); 4]);
    let none = outside(inputs.clone(), Vec4::splat(f32::NAN));
    for beyond in [Vec4::splat(-40.0), Vec4::new(30.0, 0.5, 0.0, 0.0), Vec4::splat(1.0e12)] {
        let far = outside(inputs.clone(), beyond);
        assert_eq!(native::run(&set, &far), native::run(&plain, &none), "{beyond}");
        let interpreted = interpret::<f32>(&made(&set, Unroll::Full), &far, false).expect("a picture");
        assert_eq!(interpreted.targets[0].texels, interpret::<f32>(&made(&plain, Unroll::Full), &none, false).expect("a picture").targets[0].texels);
    }
}

#[test]
fn what_earlier_frames_have_no_part_in_is_refused_with_the_reason() {
    for (other, reason) in [
        (("shading", "sample0"), "shading=centre"),
        (("normalisation", "epsilon"), "normalisation=shifted"),
        (("resolve", "tent"), "resolve=box"),
        (("search", "five"), "search=none"),
        (("demodulate", "albedo"), "demodulate=none"),
        (("mask", "select"), "mask=none"),
    ] {
        let refused = compiled(&options(&[("history", "2"), other]), Unroll::Full).expect_err("refused").to_string();
        assert!(refused.contains(reason), "{refused}");
    }
}
