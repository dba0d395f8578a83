//! Earlier frames as further taps (`history`): the kernel against its definition in f64, hard cases included, and what it
//! is worth in a still, a pan, a turn, and where something moves.

use crate::common;

use common::{Shaders, bench};
use glam::{DVec4, IVec2, UVec2, Vec2, Vec3, Vec4, ivec2, uvec2};
use std::collections::BTreeSet;
use straightline_bench::execute::{Bench, Inputs, interpret_kernel};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Stage, Unroll};
use straightline_kernels::prelude::Frame;
use straightline_oracle::oracle::{self, Resolved, SraaParams};
use straightline_scene::gbuffer;
use straightline_scene::render::{CpuRenderer, PlacedBy, Renderer};
use straightline_scene::scene::Scene;
use straightline_scene::sequence::{Moment, PLACES};
use straightline_study::progress::Silent;
use straightline_study::quality::{BEFORE, Sequence, methods_in_motion};
use straightline_study::record::{Motion, MovedMethod};
use straightline_tests::sraa::options::{Options, options, samples_needed, value, values};
use straightline_tests::sraa::{Random, compiled, native, surfaces};

const SIZE: UVec2 = uvec2(21, 17);

/// With every option that earlier frames may meet.
fn sets() -> Vec<Options> {
    let sets: [&[(&str, &str)]; 31] = [
        &[("history", "1")],
        &[("history", "3")],
        &[("history", "4")],
        &[("history", "2"), ("pattern", "latin16")],
        &[("history", "2"), ("metric", "planes-normals")],
        &[
            ("history", "2"),
            ("metric", "planes-normals"),
            ("plane", "tap"),
            ("difference", "relative"),
        ],
        &[("history", "2"), ("metric", "normals")],
        &[("history", "2"), ("metric", "depth"), ("depth", "reversed")],
        &[("history", "2"), ("difference", "relative"), ("depth-scale", "3")],
        &[("history", "2"), ("normals", "unorm")],
        &[
            ("history", "2"),
            ("normals", "unorm"),
            ("metric", "planes-normals"),
            ("renormalise", "true"),
        ],
        &[("history", "2"), ("normals", "packed"), ("turn", "chord")],
        &[("history", "2"), ("layout", "superresolution")],
        &[("history", "2"), ("layout", "multisampled")],
        &[("history", "2"), ("layout", "split"), ("falloff", "none")],
        &[
            ("history", "2"),
            ("falloff", "gaussian"),
            ("sigma", "0.25"),
            ("radius", "2"),
        ],
        &[("history", "2"), ("non-finite", "spread")],
        &[("history", "2"), ("guards", "none")],
        &[("history", "2"), ("guards", "fallback")],
        &[("history", "2"), ("search", "five")],
        &[("history", "2"), ("search", "seven"), ("pattern", "latin16")],
        &[("history", "2"), ("shading", "placed")],
        &[("history", "3"), ("shading", "placed"), ("search", "five")],
        &[("history", "2"), ("shading", "placed"), ("layout", "superresolution")],
        &[("history", "2"), ("demodulate", "albedo"), ("unseen-floor", "0.04")],
        &[("history", "2"), ("demodulate", "albedo"), ("rest", "true")],
        &[
            ("history", "3"),
            ("shading", "placed"),
            ("search", "five"),
            ("demodulate", "albedo"),
            ("rest", "true"),
        ],
        &[
            ("history", "2"),
            ("shading", "placed"),
            ("metric", "planes-normals"),
            ("difference", "relative"),
            ("search", "five"),
        ],
        &[("history", "2"), ("mask", "branch"), ("mask-threshold", "0.01")],
        &[
            ("history", "2"),
            ("metric", "planes-normals"),
            ("mask", "select"),
            ("variation", "within"),
            ("mask-threshold", "0.01"),
            ("mask-step", "0.3"),
        ],
        // The preset `guided` with larger thresholds: depths here are off the planes that normals are of.
        &[
            ("history", "3"),
            ("falloff", "gaussian"),
            ("sigma", "0.3"),
            ("metric", "planes-normals"),
            ("difference", "relative"),
            ("search", "five"),
            ("shading", "placed"),
            ("mask", "branch"),
            ("variation", "within"),
            ("guide", "add"),
        ],
    ];
    sets.iter().map(|set| options(set)).collect()
}

fn made(set: &Options, unroll: Unroll) -> Compiled {
    compiled(set, unroll).unwrap_or_else(|errors| panic!("{set:?}:\n{errors}"))
}

fn defined(set: &Options, inputs: &Inputs) -> Vec<Resolved> {
    let params = SraaParams::from_options(&values(set)).expect("options");
    oracle::resolve_sraa(inputs, &params).unwrap_or_else(|error| panic!("{set:?}: {error}"))
}

/// The largest difference to the definition, without the few pixels close to a threshold; fails if a value is not finite.
fn off(found: impl IntoIterator<Item = [f64; 4]>, expected: &[Resolved], what: &str) -> f64 {
    let mut largest = 0.0f64;
    let unsure = expected.iter().filter(|pixel| !pixel.sure).count();
    assert!(unsure * 20 < expected.len(), "{what}: {unsure} pixels are not compared");
    for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
        let at = (k as u32 % SIZE.x, k as u32 / SIZE.x);
        assert!(
            expected.color.iter().all(|axis| axis.is_finite()),
            "{what} at {at:?}: {expected:?}"
        );
        assert!(found.iter().all(|axis| axis.is_finite()), "{what} at {at:?}: {found:?}");
        if !expected.sure {
            continue;
        }
        let pairs = found.into_iter().zip(expected.color);
        let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        largest = largest.max(apart);
    }
    largest
}

#[test]
fn every_form_gives_what_the_definition_says() {
    let bench = bench();
    let [mut in_f64, mut in_f32, mut on_device] = [0.0f64; 3];
    for set in sets() {
        let inputs = surfaces::inputs(&set, SIZE, 11);
        let expected = defined(&set, &inputs);
        // Earlier frames must have made a difference, except in pixels that a mask keeps.
        let without: Options = set.iter().filter(|(name, _)| name != "history").cloned().collect();
        let changed = defined(&without, &inputs).into_iter().map(|pixel| pixel.color);
        let change = off(changed, &expected, "without history");
        assert!(
            change > 0.1 || value(&set, "mask", "none") != "none",
            "{set:?}: earlier frames change next to nothing, {change}"
        );
        for unroll in [Unroll::Full, Unroll::None] {
            let (compiled, what) = (made(&set, unroll), format!("{set:?} {unroll}"));
            let exact = interpret_kernel::<f64>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
            in_f64 = in_f64.max(off(exact.targets[0].texels.iter().copied(), &expected, &what));
            let single = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
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
    assert!(in_f64 < 1.0e-5 && in_f32 < 1.0e-4 && on_device < 1.0e-4);
}

/// The mask compares shading samples where this frame has them, `jitter` aside.
#[test]
fn a_mask_keeps_pixels_of_a_frame_that_is_shaded_aside() {
    let scene = Scene::from_name("railings").expect("a scene");
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    for (placed, variation) in [(false, "around"), (false, "within"), (true, "within")] {
        let draw = |jitter: Vec2| {
            let placed = placed.then_some(PlacedBy::Planes);
            Moment::draw(scene.clone(), SIZE, jitter, &samples, placed).expect("a picture")
        };
        let [now, one, two] = [PLACES[1], PLACES[2], PLACES[3]].map(draw);
        let shading = if placed { "placed" } else { "centre" };
        let mask = [
            ("shading", shading),
            ("mask", "select"),
            ("variation", variation),
            ("mask-step", "0.3"),
        ];
        let alone = options(&[PlacedBy::Planes.options(), &mask].concat());
        let set = [alone.clone(), options(&[("history", "2")])].concat();
        let inputs = gbuffer::sraa_inputs(now.capture(), &values(&alone)).expect("inputs");
        let inputs = now.with_history(inputs, &[&one, &two]).expect("inputs");
        let (expected, what) = (defined(&set, &inputs), format!("{shading}, {variation}"));
        let found = interpret_kernel::<f32>(&made(&set, Unroll::Full), &inputs, false).expect("it runs");
        let off = off(found.targets[0].texels.iter().copied(), &expected, &what);
        // Of the pixels that the mask keeps, those within a surface: each neighbour has its 24th.
        let color = &now.capture().color;
        let width = SIZE.x as usize;
        let is_kept = |(k, pixel): (usize, &Resolved)| {
            let at = ivec2((k % width) as i32, (k / width) as i32);
            let texel = |away: IVec2| color.load(at + away).as_dvec4();
            let around = [IVec2::X, IVec2::NEG_X, IVec2::Y, IVec2::NEG_Y].map(texel);
            let mean = (20.0 * texel(IVec2::ZERO) + around.iter().sum::<DVec4>()) / 24.0;
            (mean - DVec4::from_array(pixel.color)).abs().max_element() < 1.0e-9
        };
        let kept = expected.iter().enumerate().filter(|pixel| is_kept(*pixel)).count();
        println!("{what}: off by {off:.1e}, {kept} of {} pixels are kept", expected.len());
        assert!(off < 1.0e-4, "{what}: {off}");
        assert!(
            kept * 20 > expected.len() && kept * 20 < 19 * expected.len(),
            "{what}: {kept} pixels are kept"
        );
    }
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
                        "history_color" | "history_rest" if texel.abs().max_element() > 1.0e3 => Vec4::splat(f32::NAN),
                        // A plane with a normal of that length is where rounding puts it.
                        "history_surface" if texel.truncate().is_finite() && texel.truncate().length() > 1.5 => {
                            Vec3::NAN.extend(texel.w)
                        }
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
    let guarded = |set: &Options| {
        !set.iter()
            .any(|(_, v)| ["none", "fallback", "spread"].contains(&v.as_str()))
    };
    let sets: Vec<Options> = sets().into_iter().filter(guarded).collect();
    assert!(sets.len() > 12, "{} sets", sets.len());
    for set in sets {
        let inputs = hard(surfaces::inputs(&set, SIZE, 12));
        let (compiled, what) = (made(&set, Unroll::Full), format!("hard, {set:?}"));
        let expected = defined(&set, &inputs);
        let single = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
        largest = largest.max(off(single.targets[0].texels.iter().copied(), &expected, &what));
        assert!(largest < 1.0e-4, "{what}: {largest}");
        if samples_needed(&set) <= 4 {
            let picture = bench.run(&compiled, Stage::Compute, &inputs);
            let picture = picture.unwrap_or_else(|e| panic!("{what}: {e}"));
            let texels = picture.texels().iter().map(|texel| texel.to_array().map(f64::from));
            largest = largest.max(off(texels, &expected, &what));
            assert!(largest < 1.0e-4, "{what} on a device: {largest}");
        }
    }
    println!("off the definition: {largest:.1e}");
}

/// naga validates each text on the way, and two other compilers read the GLSL and SPIR-V.
#[test]
fn all_languages_have_it() {
    let mut shaders = Shaders::new("history");
    let targets: BTreeSet<Target> = Target::MODERN.into();
    for (k, set) in sets().iter().enumerate() {
        for (unroll, stage) in [(Unroll::Full, Stage::Compute), (Unroll::None, Stage::Fragment)] {
            let emitted = made(set, unroll).emit(&EmitOptions::new().stage(stage).targets(targets.clone()));
            let emitted = emitted.unwrap_or_else(|e| panic!("{set:?} {unroll}: {e}"));
            assert_eq!(emitted.files.len(), targets.len());
            shaders.write(&emitted, &format!("{k}-{}", stage.name()));
        }
    }
    let (glsl, spirv) = (shaders.glsl.len(), shaders.spirv.len());
    assert_eq!((glsl, spirv), (2 * sets().len(), 2 * sets().len()));
    shaders.read();
}

#[test]
fn frames_from_outside_the_picture_change_nothing() {
    let set = options(&[("history", "4")]);
    let plain = options(&[("history", "1")]);
    let inputs = surfaces::inputs(&set, SIZE, 3);
    let outside = |inputs: Inputs, motion: Vec4| {
        inputs.with_layers("history_motion", vec![Frame::new(SIZE, vec![motion; 21 * 17]); 4])
    };
    let none = outside(inputs.clone(), Vec4::splat(f32::NAN));
    for beyond in [Vec4::splat(-40.0), Vec4::new(30.0, 0.5, 0.0, 0.0), Vec4::splat(1.0e12)] {
        let far = outside(inputs.clone(), beyond);
        assert_eq!(native::run(&set, &far), native::run(&plain, &none), "{beyond}");
        let interpreted = interpret_kernel::<f32>(&made(&set, Unroll::Full), &far, false).expect("a picture");
        assert_eq!(
            interpreted.targets[0].texels,
            interpret_kernel::<f32>(&made(&plain, Unroll::Full), &none, false)
                .expect("a picture")
                .targets[0]
                .texels
        );
    }
}

#[test]
fn what_earlier_frames_have_no_part_in_is_refused_with_the_reason() {
    let others: [(&[(&str, &str)], &str); 4] = [
        (&[("shading", "sample0")], "shading=centre or shading=placed"),
        (&[("normalisation", "epsilon")], "normalisation=shifted"),
        (&[("resolve", "tent")], "resolve=box"),
        (&[("demodulate", "albedo-shadow")], "demodulate=albedo"),
    ];
    for (others, reason) in others {
        let refused = compiled(&options(&[&[("history", "2")], others].concat()), Unroll::Full)
            .expect_err("refused")
            .to_string();
        assert!(refused.contains(reason), "{refused}");
    }
}

const PICTURE: UVec2 = uvec2(240, 135);

fn sequence(name: &str, motion: Motion) -> Sequence {
    let scene = Scene::from_name(name).expect("a scene");
    Sequence::draw(&scene, motion, PICTURE, 4, &mut Silent).expect("pictures")
}

fn pictures(bench: &Bench, sequence: &mut Sequence, name: &str) -> (Vec<Frame<Vec4>>, MovedMethod) {
    let method = methods_in_motion().into_iter().find(|method| method.name == name);
    let method = method.unwrap_or_else(|| panic!("no method {name}"));
    let pictures = sequence
        .make_pictures(bench, &method)
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    let score = sequence.score(&method, &pictures);
    (pictures, score)
}

fn close_to_supersampling(name: &str) {
    let bench = bench();
    for motion in [Motion::Still, Motion::Pan, Motion::Turn] {
        let mut sequence = sequence(name, motion);
        for samples in [4, 16] {
            let mut score = |what: &str| pictures(&bench, &mut sequence, what).1;
            let supersampled = score(&format!("{samples}x"));
            let [plain, placed, history, all] = [
                "relative depth",
                "placed and searched",
                "history",
                "history, placed and searched",
            ]
            .map(|what| score(&format!("SRAA {samples}, {what}")));
            let row = [&plain, &placed, &history, &all, &supersampled]
                .map(|score| format!("{:.2}, {:.4}", score.psnr, score.flicker));
            println!(
                "| {name} | {} | {samples} | {} |",
                motion.display_name(),
                row.join(" | ")
            );
            if samples == 4 && motion == Motion::Still {
                assert!(history.psnr > supersampled.psnr - 0.1, "{name} {motion:?}: {history:?}");
            }
            assert!(history.psnr > plain.psnr + 1.0, "{name} {motion:?}: {history:?}");
            let most = if motion == Motion::Still {
                0.01
            } else {
                0.9 * plain.flicker
            };
            assert!(history.flicker < most, "{name} {motion:?}: {history:?}");
            let lost = if samples == 4 { 0.6 } else { 3.0 };
            assert!(all.psnr > supersampled.psnr - lost, "{name} {motion:?}: {all:?}");
            assert!(
                all.flicker < 1.3 * supersampled.flicker + 0.005,
                "{name} {motion:?}: {all:?}"
            );
        }
    }
}

#[test]
fn railings_come_close_to_supersampling() {
    close_to_supersampling("railings");
}

#[test]
#[ignore = "takes as long as all others together; `cargo test --workspace --test filters history:: -- --include-ignored`"]
fn a_roof_comes_close_to_supersampling() {
    close_to_supersampling("roof");
}

/// Pixels where the board was in the last frame and is no more, nor beside.
fn uncovered(name: &str, frame: usize) -> Vec<bool> {
    let covered = |frame: usize| {
        let with = Motion::Board.scene_at_frame(&Scene::from_name(name).expect("a scene"), PICTURE, frame);
        let away = 0.5 * (Vec3::from(with.camera.target) - Vec3::from(with.camera.position)).length();
        let (depth, _) = CpuRenderer::new(&with, PICTURE)
            .and_then(|renderer| renderer.draw_geometry(Vec2::ZERO))
            .expect("geometry");
        depth
            .texels()
            .iter()
            .map(|z| (z - away).abs() < 1.0e-3 * away)
            .collect::<Vec<bool>>()
    };
    let (before, now) = (covered(frame - 1), covered(frame));
    let width = PICTURE.x as usize;
    let at = |k: usize, away: isize| now.get(k.wrapping_add_signed(away)).copied().unwrap_or(false);
    let beside = |k: usize| {
        [0, -1, 1, -(width as isize), width as isize]
            .iter()
            .any(|away| at(k, *away))
    };
    (0..now.len()).map(|k| before[k] && !beside(k)).collect()
}

#[test]
fn a_moving_board_leaves_no_ghost() {
    let bench = bench();
    for name in ["railings", "roof"] {
        let mut sequence = sequence(name, Motion::Board);
        let methods = ["4x", "SRAA 4, relative depth", "SRAA 4, history"];
        let made = methods.map(|method| pictures(&bench, &mut sequence, method));
        let scores = made.each_ref().map(|(_, score)| score);
        let mut squares = [0.0f64; 3];
        let mut count = 0;
        for (k, reference) in sequence.references().iter().enumerate() {
            for (at, is_uncovered) in uncovered(name, BEFORE + k).into_iter().enumerate() {
                if is_uncovered {
                    count += 1;
                    for (sum, (pictures, _)) in squares.iter_mut().zip(&made) {
                        let off = pictures[k].texels()[at] - reference.texels()[at];
                        *sum += off.truncate().as_dvec3().length_squared() / 3.0;
                    }
                }
            }
        }
        let [supersampled, plain, history] = squares.map(|sum| (sum / f64::from(count)).sqrt());
        println!(
            "{name}: {count} pixels uncovered, off by {supersampled:.4} supersampled, {plain:.4} without, {history:.4} with earlier frames; {scores:.4?}"
        );
        assert!(count > 300, "{count} pixels uncovered");
        // The board is 0.5 off from what is behind it: a hundredth of it would be seen.
        assert!(history < 1.1 * plain + 0.005, "{name}: {history} with, {plain} without");
        assert!(scores[2].psnr > scores[1].psnr, "{name}: {scores:?}");
    }
}
