//! The additive guide (`guide=add`): compares its kernels and the filter with their definitions in f64, hard cases
//! included, and measures the gain on scenes whose colour varies within surfaces.

use crate::common;

use common::bench;
use glam::{UVec2, Vec4, uvec2, vec4};
use std::collections::HashMap;
use straightline_bench::execute::{Bench, Inputs, interpret_kernel};
use straightline_codegen::{Compiled, Stage, Unroll};
use straightline_kernels::prelude::Frame;
use straightline_oracle::metrics::psnr;
use straightline_oracle::oracle::{self, SraaParams};
use straightline_scene::capture::{Capture, ShadingSample, mean_frame};
use straightline_scene::render::{self, CpuRenderer, GuideLight, PlacedBy, Renderer};
use straightline_scene::scene::Scene;
use straightline_scene::{gbuffer, picture};
use straightline_tests::sraa::options::{Options, completed, options, refusal, samples_needed, values};
use straightline_tests::sraa::{self, Random, native, surfaces};

const SIZE: UVec2 = uvec2(21, 17);

/// The colour of a pixel, and `true` if 32 bits make the same decisions as 64.
type Expected = Vec<([f64; 4], bool)>;

fn compiled(kernel: &str, set: &Options, unroll: Unroll) -> Compiled {
    sraa::kernel(kernel, set, unroll).unwrap_or_else(|errors| panic!("{kernel}, {set:?}:\n{errors}"))
}

fn with(set: &Options, more: &[(&str, &str)]) -> Options {
    [set.clone(), options(more)].concat()
}

/// Option sets for the guide's layout, the shading sample, the source of the pixel's colour, and the encoding of
/// normals and depths.
fn sets() -> Vec<Options> {
    let others: [&[(&str, &str)]; 19] = [
        &[],
        &[("pattern", "latin16")],
        &[("layout", "superresolution")],
        &[("layout", "superresolution"), ("pattern", "listed")],
        &[("layout", "multisampled")],
        &[("layout", "split"), ("normals", "octahedral")],
        &[("shading", "sample0"), ("depth", "reversed-infinite")],
        &[("shading", "placed")],
        &[
            ("shading", "placed"),
            ("layout", "superresolution"),
            ("depth", "perspective"),
        ],
        &[("shading", "placed"), ("layout", "multisampled"), ("search", "seven")],
        &[("resolve", "tent"), ("normals", "unorm")],
        &[("resolve", "mitchell"), ("resolve-radius", "1.5")],
        &[("metric", "depth"), ("normals", "float"), ("guards", "fallback")],
        &[
            ("metric", "planes-normals"),
            ("mask", "branch"),
            ("variation", "within"),
        ],
        &[("mask", "select"), ("renormalise", "true"), ("normals", "unorm")],
        &[
            ("metric", "planes-normals"),
            ("mask", "branch"),
            ("variation", "within"),
            ("mask-step", "0.6"),
        ],
        &[
            ("mask", "select"),
            ("variation", "within"),
            ("shading", "placed"),
            ("mask-step", "0.4"),
        ],
        &[("guards", "none"), ("normals", "packed")],
        &[("non-finite", "spread"), ("normalisation", "epsilon")],
    ];
    let sets = others
        .iter()
        .map(|own| completed(with(&options(own), &[("guide", "add")])));
    sets.filter(|set| refusal(set).is_none()).collect()
}

/// Random surfaces, colours and guides, and all inputs of an estimate.
fn inputs(set: &Options, seed: u64) -> Inputs {
    let mut inputs = surfaces::inputs(set, SIZE, seed);
    let guides: Vec<(String, Vec<Frame<Vec4>>)> = inputs.images.clone();
    for (name, images) in guides {
        let (Some(kind), false) = (name.find("guide"), name == "guide_mean") else {
            continue;
        };
        let named = |other: &str| format!("{}{other}{}", &name[..kind], &name[kind + "guide".len()..]);
        let scaled = |image: &Frame<Vec4>| {
            let texels = image.texels().iter().map(|texel| 0.25 * texel.truncate().extend(0.0));
            Frame::new(image.size(), texels.collect())
        };
        inputs = inputs
            .with_layers(&named("albedo"), images.clone())
            .with_layers(&named("emission"), images.iter().map(scaled).collect());
    }
    for (name, images) in &mut inputs.images {
        if name == "guide_scale" {
            *images = vec![Frame::new(UVec2::ONE, vec![vec4(0.75, 0.5, 1.25, 0.0)])];
        }
    }
    inputs
        .with_uniform("light_direction", &[0.48, 0.6, 0.64])
        .with_uniform("light_color", &[2.0, 1.5, 0.5])
        .with_uniform("ambient", &[0.125, 0.25, 0.5])
}

/// Replaces the colours.
fn with_color(mut inputs: Inputs, texels: Vec<Vec4>) -> Inputs {
    for (name, images) in &mut inputs.images {
        if name == "color" {
            *images = vec![Frame::new(SIZE, texels)];
            break;
        }
    }
    inputs
}

/// Returns the largest difference from the definition, relative to values larger than `scale`. Fails if a value is
/// not finite.
fn off(found: impl IntoIterator<Item = [f64; 4]>, expected: &Expected, what: &str, scale: f64) -> f64 {
    let (mut largest, mut compared) = (0.0f64, 0);
    for (k, (found, (color, is_sure))) in found.into_iter().zip(expected).enumerate() {
        let at = (k as u32 % SIZE.x, k as u32 / SIZE.x);
        let is_finite = |color: &[f64; 4]| color.iter().all(|axis| axis.is_finite());
        assert!(is_finite(color), "{what} at {at:?}: {color:?} is expected");
        assert!(is_finite(&found), "{what} at {at:?}: {found:?}");
        if *is_sure {
            compared += 1;
            for (a, b) in found.into_iter().zip(color) {
                largest = largest.max((a - b).abs() / b.abs().max(scale));
            }
        }
    }
    assert!(2 * compared > expected.len(), "{what}: {compared} pixels compared");
    largest
}

/// Evaluates the definition of a kernel's pictures.
fn defined(kernel: &str, set: &Options, inputs: &Inputs) -> Expected {
    let params = SraaParams::from_options(&values(set)).expect("options");
    let failed = |error| panic!("{kernel}, {set:?}: {error}");
    match kernel {
        "sraa" => {
            let pixels = oracle::resolve_sraa(inputs, &params).unwrap_or_else(failed);
            pixels.iter().map(|pixel| (pixel.color, pixel.sure)).collect()
        }
        "sraa_guide" => {
            let means = oracle::guide(inputs, &params).unwrap_or_else(|error| panic!("{set:?}: {error}"));
            means.iter().map(|[r, g, b]| ([*r, *g, *b, 0.0], true)).collect()
        }
        _ => {
            let differences = oracle::residual(inputs, &params).unwrap_or_else(|error| panic!("{set:?}: {error}"));
            differences.into_iter().map(|color| (color, true)).collect()
        }
    }
}

/// Returns the deviation of a kernel from its definition: in f64, in f32, and on the device.
fn distances(bench: &Bench, kernel: &str, set: &Options, inputs: &Inputs, scale: f64) -> [f64; 3] {
    let expected = defined(kernel, set, inputs);
    let [mut in_f64, mut in_f32, mut on_device] = [0.0f64; 3];
    for unroll in [Unroll::Full, Unroll::None] {
        let (compiled, what) = (compiled(kernel, set, unroll), format!("{kernel}, {set:?} {unroll}"));
        let exact = interpret_kernel::<f64>(&compiled, inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
        in_f64 = in_f64.max(off(exact.targets[0].texels.iter().copied(), &expected, &what, scale));
        let single = interpret_kernel::<f32>(&compiled, inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
        in_f32 = in_f32.max(off(single.targets[0].texels.iter().copied(), &expected, &what, scale));
        if unroll == Unroll::Full && samples_needed(set) <= 4 {
            for stage in [Stage::Compute, Stage::Fragment] {
                let picture = bench.run(&compiled, stage, inputs);
                let picture = picture.unwrap_or_else(|e| panic!("{what}: {e}"));
                let texels = picture.texels().iter().map(|texel| texel.to_array().map(f64::from));
                on_device = on_device.max(off(texels, &expected, &format!("{what} {stage:?}"), scale));
            }
        }
    }
    [in_f64, in_f32, on_device]
}

/// `true` if the options have this source of the guide. Filters by depth have no normals, so only `given`.
fn way_is_there(set: &Options, way: &str) -> bool {
    way == "given" || values(set).choice("metric") != Some("depth")
}

#[test]
fn every_form_gives_what_the_definition_says() {
    let bench = bench();
    let mut largest = [0.0f64; 3];
    for (k, set) in sets().into_iter().enumerate() {
        let inputs = inputs(&set, 31);
        let mut judge = |kernel: &str, set: &Options| {
            let found = distances(&bench, kernel, set, &inputs, 1.0);
            largest = [0, 1, 2].map(|axis| largest[axis].max(found[axis]));
        };
        judge("sraa", &set);
        let ways = [("given", "false"), ("diffuse", "true"), ("emissive", "false")];
        // Each layout and encoding runs in at least one way, the first few in all.
        for (n, (way, fitted)) in ways.into_iter().enumerate() {
            if way_is_there(&set, way) && (k < 4 || k % ways.len() == n) {
                let own = with(&set, &[("estimate", way), ("fitted", fitted)]);
                judge("sraa_guide", &own);
                judge("sraa_residual", &own);
            }
        }
        let texels = native::run(&set, &inputs).into_iter().map(|texel| texel.map(f64::from));
        largest[1] = largest[1].max(off(texels, &defined("sraa", &set, &inputs), "natively", 1.0));
    }
    let [in_f64, in_f32, on_device] = largest;
    println!("off the definition: {in_f64:.1e} in f64, {in_f32:.1e} in f32, {on_device:.1e} on the device");
    assert!(in_f64 < 1.0e-5 && in_f32 < 1.0e-4 && on_device < 1.0e-4);
}

/// Replaces some texels by values that are not finite, exceed a half, or are far brighter than any colour.
fn hard(inputs: Inputs, names: &[&str], bad: &[f32]) -> Inputs {
    let mut random = Random(77);
    let mut inputs = inputs;
    for (name, images) in &mut inputs.images {
        if names.iter().any(|known| name.contains(known)) {
            for image in images {
                let texels = image.texels().iter().map(|texel| {
                    let mut texel = *texel;
                    if random.unit() < 0.2 {
                        texel[random.choose(&[0, 1, 2])] = random.choose(bad);
                    }
                    texel
                });
                *image = Frame::new(image.size(), texels.collect());
            }
        }
    }
    inputs
}

#[test]
fn a_guide_that_is_not_finite_is_left_out() {
    let bench = bench();
    let mut largest = 0.0f64;
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 65536.0, -1.0e9, f32::MAX];
    for set in sets() {
        let values = values(&set);
        // With colours that are not finite, lobes may leave a sum of weights near 0.
        if values.choice("guards") == Some("none")
            || values.choice("non-finite") == Some("spread")
            || values.choice("resolve") == Some("mitchell")
        {
            continue;
        }
        // Multisampled images hold halves, in which larger numbers become the largest half.
        let bad = match values.choice("layout") {
            Some("multisampled") => &bad[..3],
            _ => &bad,
        };
        let of_guides = hard(inputs(&set, 32), &["guide", "emission", "albedo"], bad);
        let mut judge = |kernel: &str, set: &Options, inputs: &Inputs, scale: f64| {
            let found = distances(&bench, kernel, set, inputs, scale)[2];
            assert!(found < 1.0e-4, "{kernel}, {set:?}: {found}");
            largest = largest.max(found);
        };
        for (kernel, way) in [
            ("sraa_guide", "given"),
            ("sraa_guide", "emissive"),
            ("sraa_residual", "given"),
        ] {
            if way_is_there(&set, way) {
                judge(kernel, &with(&set, &[("estimate", way)]), &of_guides, 65536.0);
            }
        }
        let of_means = hard(inputs(&set, 33), &["guide_mean"], bad);
        judge("sraa", &set, &of_means, 1.0);
        // A difference that is not finite has no weight, like any colour.
        if values.choice("guards") == Some("inline") {
            let of_colors = hard(inputs(&set, 34), &["color"], &bad[..3]);
            judge("sraa", &set, &of_colors, 1.0);
        }
    }
    println!("off the definition: {largest:.1e}");
    assert!(largest < 1.0e-4);
}

#[test]
fn the_scale_is_that_of_the_definition() {
    let bench = bench();
    for own in [
        &[][..],
        &[("shading", "placed"), ("estimate", "emissive")],
        &[("layout", "superresolution"), ("estimate", "diffuse")],
    ] {
        let set = with(&options(own), &[("guide", "add")]);
        let params = SraaParams::from_options(&values(&set)).expect("options");
        let bad = [f32::NAN, f32::INFINITY, 1.0e30];
        for seed in 41..45 {
            let black = with_color(inputs(&set, seed), vec![Vec4::ZERO; (SIZE.x * SIZE.y) as usize]);
            let unscaled = SraaParams {
                fitted: false,
                ..params.clone()
            };
            let differences = oracle::residual(&black, &unscaled).expect("differences");
            // Colours that follow the guide, each channel by a scale of its own, and something that it lacks.
            let mut random = Random(seed);
            let scales = [0.3, 0.9, 2.5].map(|most| most * (0.5 + 0.5 * random.unit()));
            let follow = |difference: &[f64; 4]| {
                let channel = |axis: usize| 0.05 * random.unit() - scales[axis] * difference[axis] as f32;
                let [red, green, blue] = [0, 1, 2].map(channel);
                vec4(red, green, blue, 1.0)
            };
            let inputs = with_color(black, differences.iter().map(follow).collect());
            let inputs = if seed == 44 {
                hard(inputs, &["color", "guide", "albedo"], &bad)
            } else {
                inputs
            };
            let expected = oracle::scale(&inputs, &params).expect("a scale");
            let [sums, rows, fit] =
                ["sraa_fit_sums", "sraa_fit_rows", "sraa_fit"].map(|kernel| compiled(kernel, &set, Unroll::Full));
            let sums_of = |kernel: &Compiled, size: UVec2, inputs: Inputs| {
                let sums = bench
                    .run_targets(kernel, Stage::Compute, &Inputs { size, ..inputs })
                    .expect("sums");
                let [both, own] = <[_; 2]>::try_from(sums).expect("two targets");
                Inputs::new(UVec2::ONE)
                    .with_image("both", both.frame())
                    .with_image("own", own.frame())
            };
            let tiles = SIZE.map(|side| side.div_ceil(16));
            // Sums beyond the tiles are of nothing.
            let of_tiles = sums_of(&sums, SIZE, inputs);
            let of_rows = sums_of(&rows, uvec2(1, tiles.y), of_tiles.clone());
            for of_sums in [of_tiles, of_rows] {
                let found = bench.run(&fit, Stage::Compute, &of_sums).expect("a scale").texels()[0];
                println!("{set:?}: {found}, {expected:?} is expected");
                for axis in 0..3 {
                    assert!((0.01..4.0).contains(&expected[axis]), "{expected:?}");
                    let off = (f64::from(found[axis]) - expected[axis]).abs();
                    assert!(off < 1.0e-5, "{set:?}: {found}, {expected:?} is expected");
                }
            }
        }
    }
}

/// Returns the filtered colour of an even surface, from differences and a mean.
fn even(color: Vec4, guide: Vec4) -> [f32; 4] {
    let set = options(&[("guide", "add")]);
    let mut capture = surfaces::capture(&set, SIZE, 3);
    let filled = |texel: Vec4| Frame::new(SIZE, vec![texel; (SIZE.x * SIZE.y) as usize]);
    capture.color = filled(color);
    let layers = capture.layer_count();
    capture.guide = Some(straightline_kernels::prelude::FrameLayers::new(vec![
        filled(guide);
        layers
    ]));
    let inputs = surfaces::inputs_of(&capture, &set, 3);
    native::run(&set, &inputs)[0]
}

/// A guide far brighter than the colour loses at most a rounding of the guide. A colour larger than a
/// half is kept.
#[test]
fn a_guide_costs_no_more_than_its_own_rounding() {
    let color = vec4(0.25, 3.0e4, 1.0e9, 1.0);
    for bright in [0.0f32, 1.0, 1000.0, 65504.0] {
        let found = even(color, Vec4::splat(bright));
        for (axis, found) in found.into_iter().enumerate().take(3) {
            let rounding = 4.0 * f32::EPSILON * color[axis].max(bright);
            assert!((found - color[axis]).abs() <= rounding, "{axis} of {bright}: {found}");
        }
        assert_eq!(found[3], 1.0);
    }
}

#[test]
fn the_colour_itself_is_supersampled_and_none_changes_nothing() {
    let scene = Scene::from_name("posters").expect("a scene");
    let renderer = CpuRenderer::new(&scene, uvec2(64, 36)).expect("a renderer");
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    let mut capture = render::capture_scene(&renderer, &samples, ShadingSample::Centre).expect("a capture");
    let mut layers: Vec<Frame<Vec4>> = samples
        .iter()
        .map(|at| renderer.draw_shaded(*at).expect("a picture"))
        .collect();
    let supersampled = mean_frame(&layers).expect("a mean");
    layers.push(capture.color.clone());
    let bench = bench();
    let filtered = |capture: &Capture, own: &[(&str, &str)]| {
        let compiled = compiled("sraa", &options(own), Unroll::Full);
        let inputs = gbuffer::sraa_inputs(capture, &compiled.options).expect("inputs");
        bench.run(&compiled, Stage::Compute, &inputs).expect("a picture")
    };
    let plain = filtered(&capture, &[]);
    capture.guide = Some(straightline_kernels::prelude::FrameLayers::new(layers));
    let found = filtered(&capture, &[("guide", "add")]);
    let pairs = found.texels().iter().zip(supersampled.texels());
    let largest = pairs
        .map(|(a, b)| (a.truncate() - b.truncate()).abs().max_element())
        .fold(0.0, f32::max);
    assert!(largest < 1.0e-6, "{largest}");
    let nothing = Frame::new(capture.size, vec![Vec4::ZERO; plain.texels().len()]);
    capture.guide = Some(straightline_kernels::prelude::FrameLayers::new(vec![nothing; 5]));
    assert_eq!(filtered(&capture, &[("guide", "add")]).texels(), plain.texels());
}

#[test]
fn what_a_guide_cannot_go_with_is_refused_with_the_reason() {
    let set = options(&[("guide", "add"), ("demodulate", "albedo")]);
    let refused = sraa::kernel("sraa", &set, Unroll::Full)
        .expect_err("refused")
        .to_string();
    assert!(refused.contains("demodulate=none"), "{refused}");
    let set = options(&[("shading", "listed"), ("shaded", "0,3")]);
    let refused = sraa::kernel("sraa_residual", &set, Unroll::Full)
        .expect_err("refused")
        .to_string();
    assert!(refused.contains("shade once a pixel"), "{refused}");
    let capture = Capture {
        guide: None,
        ..surfaces::capture(&Options::new(), SIZE, 1)
    };
    let set = values(&options(&[("guide", "add")]));
    let refused = gbuffer::sraa_inputs(&capture, &set).expect_err("no guide").to_string();
    assert!(
        refused.contains("guide.exr") && refused.contains("capture --guide"),
        "{refused}"
    );
}

/// Returns a scene's PSNR in dB: each preset's, and shaded at every sample.
fn judged(name: &str, pattern: &str) -> HashMap<&'static str, f64> {
    let scene = Scene::from_name(name).expect("a scene");
    let renderer = CpuRenderer::new(&scene, uvec2(320, 180)).expect("a renderer");
    let samples = gbuffer::pattern_offsets(pattern).expect("a pattern");
    let mut capture = render::capture_placed(&renderer, &samples, PlacedBy::Planes).expect("a capture");
    render::add_guide(&mut capture, &renderer, GuideLight::default()).expect("a guide");
    let centred = render::capture_scene(&renderer, &samples, ShadingSample::Centre).expect("a capture");
    let reference =
        picture::at_eight_bits(&render::render_reference(&renderer, 16, &mut |_, _| {}).expect("a reference"));
    let bench = bench();
    let filtered = |preset: &'static str| {
        let compiled = compiled(
            "sraa",
            &options(&[("preset", preset), ("pattern", pattern)]),
            Unroll::Full,
        );
        let capture = match preset {
            "full" | "guided" => &capture,
            _ => &centred,
        };
        let inputs = gbuffer::sraa_inputs(capture, &compiled.options).expect("inputs");
        let made = bench.run(&compiled, Stage::Compute, &inputs).expect("a picture");
        (preset, psnr(&picture::at_eight_bits(&made), &reference))
    };
    let shaded: Result<Vec<_>, _> = samples.iter().map(|at| renderer.draw_shaded(*at)).collect();
    let supersampled = mean_frame(&shaded.expect("pictures")).expect("a mean");
    let supersampled = psnr(&picture::at_eight_bits(&supersampled), &reference);
    let mut all = HashMap::from(["paper", "edges", "full", "guided"].map(filtered));
    all.insert("supersampled", supersampled);
    println!("{name} {pattern}: {all:.2?}");
    all
}

/// A guide of a wrong brightness or tint lowers the quality, but not if it is scaled.
#[test]
fn a_scaled_guide_may_have_a_wrong_brightness_and_tint() {
    let scene = Scene::from_name("posters").expect("a scene");
    let renderer = CpuRenderer::new(&scene, uvec2(320, 180)).expect("a renderer");
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    let mut capture = render::capture_placed(&renderer, &samples, PlacedBy::Planes).expect("a capture");
    render::add_guide(&mut capture, &renderer, GuideLight::default()).expect("a guide");
    let reference =
        picture::at_eight_bits(&render::render_reference(&renderer, 16, &mut |_, _| {}).expect("a reference"));
    let bench = bench();
    let filtered = |capture: &Capture, own: &[(&str, &str)]| {
        let compiled = compiled("sraa", &options(own), Unroll::Full);
        let inputs = gbuffer::sraa_inputs(capture, &compiled.options).expect("inputs");
        let made = bench.run(&compiled, Stage::Compute, &inputs).expect("a picture");
        psnr(&picture::at_eight_bits(&made), &reference)
    };
    let none = filtered(&capture, &[("preset", "full")]);
    let right = capture.guide.clone().expect("a guide");
    let factors = [1.0, 3.0, 0.25].map(Vec4::splat);
    for factor in factors.into_iter().chain([vec4(0.5, 1.0, 3.0, 0.0)]) {
        let wrong = right.layers().iter().map(|layer| {
            let texels = layer.texels().iter().map(|texel| factor * *texel);
            Frame::new(layer.size(), texels.collect())
        });
        capture.guide = Some(straightline_kernels::prelude::FrameLayers::new(wrong.collect()));
        let given = filtered(&capture, &[("preset", "guided"), ("fitted", "false")]);
        let scaled = filtered(&capture, &[("preset", "guided")]);
        println!("times {factor}: none {none:.2}, as given {given:.2}, scaled {scaled:.2} dB");
        assert!(scaled > none + 2.0 && scaled > given - 0.1, "{none}, {given}, {scaled}");
        if factor.x == 3.0 {
            assert!(given < none, "{none}, {given}");
        }
    }
}

/// With a guide of the sun, its shadow and one constant of ambient light, paint, shadow and haze match supersampling.
#[test]
fn paint_shadow_and_haze_come_close_to_supersampling() {
    for name in ["posters", "awning", "floor"] {
        for (pattern, gap) in [("latin4", 0.4), ("latin16", 1.0)] {
            let all = judged(name, pattern);
            assert!(all["guided"] > all["full"] + 2.0, "{name} {pattern}: {all:?}");
            assert!(all["supersampled"] - all["guided"] < gap, "{name} {pattern}: {all:?}");
            for preset in ["edges", "full"] {
                assert!(all[preset] > all["paper"], "{name} {pattern}: {all:?}");
            }
        }
    }
}

/// With four lamps, an environment and studs, a guide of the sun alone helps, and each light that it knows more helps more.
#[test]
fn a_guide_that_knows_more_lights_is_better() {
    let scene = Scene::from_name("studio").expect("a scene");
    let renderer = CpuRenderer::new(&scene, uvec2(240, 135)).expect("a renderer");
    let reference =
        picture::at_eight_bits(&render::render_reference(&renderer, 16, &mut |_, _| {}).expect("a reference"));
    let bench = bench();
    for pattern in ["latin4", "latin16"] {
        let samples = gbuffer::pattern_offsets(pattern).expect("a pattern");
        let mut capture = render::capture_placed(&renderer, &samples, PlacedBy::Planes).expect("a capture");
        let filtered = |capture: &Capture, preset: &str| {
            let options = options(&[("preset", preset), ("pattern", pattern)]);
            let compiled = compiled("sraa", &options, Unroll::Full);
            let inputs = gbuffer::sraa_inputs(capture, &compiled.options).expect("inputs");
            let made = bench.run(&compiled, Stage::Compute, &inputs).expect("a picture");
            psnr(&picture::at_eight_bits(&made), &reference)
        };
        let none = filtered(&capture, "full");
        let mut all = Vec::new();
        for known in GuideLight::ALL {
            render::add_guide(&mut capture, &renderer, known).expect("a guide");
            all.push(filtered(&capture, "guided"));
            println!("{pattern}, {known:?}: {:.2} dB, without {none:.2}", all[all.len() - 1]);
        }
        let shaded: Result<Vec<_>, _> = samples.iter().map(|at| renderer.draw_shaded(*at)).collect();
        let supersampled = picture::at_eight_bits(&mean_frame(&shaded.expect("pictures")).expect("a mean"));
        let best = psnr(&supersampled, &reference);
        println!("{pattern}, supersampled: {best:.2} dB");
        assert!(all.is_sorted_by(|less, more| *more > less - 0.05), "{all:?}");
        // Of what the simplest guide leaves below supersampling, the lights close more than half.
        let left = |guided: f64| best - guided;
        assert!(
            all[0] > none - 0.2 && left(all[4]) < 0.5 * left(all[0]),
            "without {none}: {all:?}, of {best}"
        );
    }
}
