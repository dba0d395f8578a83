//! Earlier frames as further taps (`history`): the kernel against its definition in f64, hard cases included, and what it is worth in a
//! still, a pan, a turn, and where something moves.

mod common;

use common::{Shaders, bench};
use glam::{Mat3, UVec2, Vec2, Vec3, Vec4, uvec2};
use std::collections::BTreeSet;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Stage, Unroll};
use straightline_kernels::prelude::Frame;
use straightline_testbed::capture::{ShadingSample, mean};
use straightline_testbed::execute::{Bench, Inputs, interpret};
use straightline_testbed::metrics::psnr;
use straightline_testbed::oracle::{self, Resolved, SraaParams};
use straightline_testbed::render::{self, CpuRenderer, Renderer};
use straightline_testbed::scene::{Scene, Vertex};
use straightline_testbed::sequence::{Moment, PLACES};
use straightline_testbed::{gbuffer, picture};
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
        assert!(
            expected.color.iter().all(|axis| axis.is_finite()),
            "{what} at {at:?}: {expected:?}"
        );
        assert!(found.iter().all(|axis| axis.is_finite()), "{what} at {at:?}: {found:?}");
        let pairs = found.into_iter().zip(expected.color);
        let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        largest = largest.max(apart);
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
        let single = interpret::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
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
        inputs.layers("history_motion", vec![Frame::new(SIZE, vec![motion; 21 * 17]); 4])
    };
    let none = outside(inputs.clone(), Vec4::splat(f32::NAN));
    for beyond in [Vec4::splat(-40.0), Vec4::new(30.0, 0.5, 0.0, 0.0), Vec4::splat(1.0e12)] {
        let far = outside(inputs.clone(), beyond);
        assert_eq!(native::run(&set, &far), native::run(&plain, &none), "{beyond}");
        let interpreted = interpret::<f32>(&made(&set, Unroll::Full), &far, false).expect("a picture");
        assert_eq!(
            interpreted.targets[0].texels,
            interpret::<f32>(&made(&plain, Unroll::Full), &none, false)
                .expect("a picture")
                .targets[0]
                .texels
        );
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
        let refused = compiled(&options(&[("history", "2"), other]), Unroll::Full)
            .expect_err("refused")
            .to_string();
        assert!(refused.contains(reason), "{refused}");
    }
}

/// What moves from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Motion {
    Still,
    /// The camera, sideways: by 0.7 pixels at its target, and upwards by 0.2.
    Pan,
    /// The camera, about itself: by 0.45 pixels, and upwards by 0.3.
    Turn,
    /// A board before all else, by 3.3 pixels.
    Board,
}

const PICTURE: UVec2 = uvec2(240, 135);

/// Frames before the first that is judged: as many as the longest history.
const BEFORE: usize = 4;

/// A scene as it is in a frame.
fn scene(name: &str, motion: Motion, frame: usize) -> Scene {
    let mut scene = Scene::named(name).expect("a scene");
    let camera = &mut scene.camera;
    let (eye, target) = (Vec3::from(camera.position), Vec3::from(camera.target));
    let to_world = Mat3::from_mat4(camera.view()).transpose();
    let pixel = 2.0 * camera.half_extent(PICTURE).y / PICTURE.y as f32;
    let step = pixel * frame as f32;
    let aside = match motion {
        Motion::Turn => to_world * Vec3::new(0.45, 0.3, 0.0) * step,
        _ => to_world * Vec3::new(0.7, 0.2, 0.0) * step,
    };
    match motion {
        Motion::Still => {}
        Motion::Pan => {
            let aside = aside * (target - eye).length();
            camera.position = (eye + aside).into();
            camera.target = (target + aside).into();
        }
        Motion::Turn => camera.target = (target + aside * (target - eye).length()).into(),
        Motion::Board => {
            let away = 0.5 * (target - eye).length();
            let middle = eye + to_world * (Vec3::new(3.3 * (frame as f32 - 6.0), 0.0, 0.0) * pixel - Vec3::Z) * away;
            let first = scene.vertices.len() as u32;
            for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                scene.vertices.push(Vertex {
                    position: (middle + to_world * Vec3::new(20.0 * x, 30.0 * y, 0.0) * pixel * away).into(),
                    normal: (to_world * Vec3::Z).into(),
                    color: [0.8, 0.1, 0.1],
                    ..Vertex::default()
                });
            }
            scene
                .triangles
                .extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    scene
}

/// Pictures of the frames that are judged, each with its reference.
struct Sequence {
    moments: Vec<Moment>,
    references: Vec<Frame<Vec4>>,
}

/// How good the pictures of a method are.
#[derive(Clone, Copy, Debug)]
struct Score {
    /// PSNR in dB, mean over the frames.
    psnr: f64,
    /// Root of the mean squared change of what is wrong, from frame to frame.
    flicker: f64,
}

impl Sequence {
    fn draw(name: &str, motion: Motion, frames: usize) -> Sequence {
        let moment = |frame: usize| {
            let drawn = Moment::draw(scene(name, motion, frame), PICTURE, PLACES[frame % PLACES.len()]);
            drawn.expect("a picture")
        };
        let moments: Vec<Moment> = (0..BEFORE + frames).map(moment).collect();
        let reference = |moment: &Moment| {
            picture::at_eight_bits(&render::reference(moment.renderer(), 8, &mut |_, _| {}).expect("a reference"))
        };
        Sequence {
            references: moments[BEFORE..].iter().map(reference).collect(),
            moments,
        }
    }

    /// The pictures that a method makes of the frame of each number.
    fn pictures(&self, of: impl Fn(usize) -> Frame<Vec4>) -> Vec<Frame<Vec4>> {
        let frames = BEFORE..self.moments.len();
        frames.map(|frame| picture::at_eight_bits(&of(frame))).collect()
    }

    fn supersampled(&self, pattern: &str) -> Vec<Frame<Vec4>> {
        let samples = gbuffer::samples(pattern).expect("a pattern");
        self.pictures(|frame| {
            let renderer = self.moments[frame].renderer();
            let shaded: Result<Vec<_>, _> = samples.iter().map(|at| renderer.shaded(*at)).collect();
            mean(&shaded.expect("pictures")).expect("a mean")
        })
    }

    /// By SRAA with relative depths and these options, shaded at the centre without earlier frames.
    fn filtered(&self, bench: &Bench, pattern: &str, own: &[(&str, &str)]) -> Vec<Frame<Vec4>> {
        let relative = [("difference", "relative"), ("depth-scale", "3"), ("pattern", pattern)];
        let set = options(&[&relative[..], own].concat());
        let compiled = made(&set, Unroll::Full);
        let samples = gbuffer::samples(pattern).expect("a pattern");
        let history: usize = compiled
            .options
            .get("history")
            .map_or(0, |n| n.parse().expect("a number"));
        self.pictures(|frame| {
            let now = &self.moments[frame];
            let inputs = if history == 0 {
                let shading = match compiled.options.get("shading").map(String::as_str) {
                    Some("placed") => ShadingSample::Placed,
                    _ => ShadingSample::Centre,
                };
                let capture = render::capture(now.renderer(), &samples, shading).expect("a capture");
                gbuffer::inputs(&capture, &compiled.options).expect("inputs")
            } else {
                let inputs = gbuffer::inputs(&now.capture(&samples).expect("a capture"), &compiled.options);
                let earlier: Vec<&Moment> = self.moments[frame - history..frame].iter().collect();
                now.with_history(inputs.expect("inputs"), &earlier)
                    .expect("earlier frames")
            };
            bench.run(&compiled, Stage::Compute, &inputs).expect("a picture")
        })
    }

    fn score(&self, pictures: &[Frame<Vec4>]) -> Score {
        let pairs = || pictures.iter().zip(&self.references);
        let psnrs = pairs().map(|(picture, reference)| psnr(picture, reference));
        let wrong: Vec<Vec<Vec4>> = pairs()
            .map(|(picture, reference)| {
                let texels = picture.texels().iter().zip(reference.texels());
                texels.map(|(a, b)| *a - *b).collect()
            })
            .collect();
        let changes = wrong.windows(2).flat_map(|pair| pair[0].iter().zip(&pair[1]));
        let squares: Vec<f64> = changes
            .map(|(a, b)| (*b - *a).truncate().as_dvec3().length_squared() / 3.0)
            .collect();
        Score {
            psnr: psnrs.sum::<f64>() / pictures.len() as f64,
            flicker: (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt(),
        }
    }
}

/// Three earlier frames, each tap for what lies near it.
const REMEMBERED: [(&str, &str); 3] = [("history", "3"), ("falloff", "gaussian"), ("sigma", "0.3")];

/// Supersampling, SRAA, SRAA placed and searched, and SRAA with three earlier frames.
fn judged(bench: &Bench, sequence: &Sequence, pattern: &str) -> [Score; 4] {
    let score = |own: &[(&str, &str)]| sequence.score(&sequence.filtered(bench, pattern, own));
    [
        sequence.score(&sequence.supersampled(pattern)),
        score(&[]),
        score(&[("shading", "placed"), ("search", "five")]),
        score(&REMEMBERED),
    ]
}

fn close_to_supersampling(name: &str) {
    let bench = bench();
    for motion in [Motion::Still, Motion::Pan, Motion::Turn] {
        let sequence = Sequence::draw(name, motion, 4);
        for pattern in ["latin4", "latin16"] {
            let scores = judged(&bench, &sequence, pattern);
            let [supersampled, plain, _, history] = scores;
            let row = scores.map(|score| format!("{:.2}, {:.4}", score.psnr, score.flicker));
            println!("| {name} | {motion:?} | {pattern} | {} |", row.join(" | "));
            if pattern == "latin4" && motion == Motion::Still {
                assert!(history.psnr > supersampled.psnr - 0.1, "{name} {motion:?}: {scores:?}");
            }
            assert!(history.psnr > plain.psnr + 1.0, "{name} {motion:?}: {scores:?}");
            let most = if motion == Motion::Still {
                0.01
            } else {
                0.9 * plain.flicker
            };
            assert!(history.flicker < most, "{name} {motion:?}: {scores:?}");
        }
    }
}

#[test]
fn railings_come_close_to_supersampling() {
    close_to_supersampling("railings");
}

#[test]
#[ignore = "takes as long as all others together; `cargo test --workspace --test history -- --include-ignored`"]
fn a_roof_comes_close_to_supersampling() {
    close_to_supersampling("roof");
}

/// Where the board was in the last frame and is no more, nor beside.
fn uncovered(name: &str, frame: usize) -> Vec<bool> {
    let covered = |frame: usize| {
        let with = scene(name, Motion::Board, frame);
        let away = 0.5 * (Vec3::from(with.camera.target) - Vec3::from(with.camera.position)).length();
        let (depth, _) = CpuRenderer::new(&with, PICTURE)
            .and_then(|renderer| renderer.geometry(Vec2::ZERO))
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
        let sequence = Sequence::draw(name, Motion::Board, 4);
        let pictures = [
            sequence.supersampled("latin4"),
            sequence.filtered(&bench, "latin4", &[]),
            sequence.filtered(&bench, "latin4", &REMEMBERED),
        ];
        let scores = pictures.each_ref().map(|pictures| sequence.score(pictures));
        let mut squares = [0.0f64; 3];
        let mut count = 0;
        for (k, reference) in sequence.references.iter().enumerate() {
            for (at, is_uncovered) in uncovered(name, BEFORE + k).into_iter().enumerate() {
                if is_uncovered {
                    count += 1;
                    for (sum, pictures) in squares.iter_mut().zip(&pictures) {
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
