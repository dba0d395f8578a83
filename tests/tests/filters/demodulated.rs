//! Light apart from paint and shadow (`demodulate`): the kernel against its definition in f64, hard cases included, and
//! what it is worth on scenes whose edges are those of paint and of shadow.

use crate::common;

use common::bench;
use glam::{UVec2, Vec4, uvec2, vec4};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::{Compiled, Stage, Unroll};
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_oracle::metrics::psnr;
use straightline_oracle::oracle::{self, Resolved, SraaParams};
use straightline_scene::capture::{Capture, ShadingSample, mean_frame};
use straightline_scene::render::{self, CpuRenderer, Renderer};
use straightline_scene::scene::Scene;
use straightline_scene::{gbuffer, picture};
use straightline_tests::sraa::options::{Options, completed, options, refusal, samples_needed, values};
use straightline_tests::sraa::{Random, compiled, native, surfaces};

const SIZE: UVec2 = uvec2(21, 17);

/// Both ways with everything that they meet: where albedo lies, where shading does, what reads the taps.
fn sets() -> Vec<Options> {
    let others: [&[(&str, &str)]; 21] = [
        &[],
        &[("pattern", "latin16")],
        &[("layout", "superresolution")],
        &[("layout", "superresolution"), ("pattern", "listed")],
        &[("layout", "multisampled")],
        &[("layout", "split")],
        &[("shading", "sample0")],
        &[("shading", "listed")],
        &[("shading", "placed")],
        &[("shading", "placed"), ("layout", "superresolution")],
        &[("shading", "placed"), ("layout", "multisampled"), ("search", "seven")],
        &[("search", "five"), ("difference", "relative"), ("depth-scale", "3")],
        &[("resolve", "tent")],
        &[("unseen-floor", "0.02"), ("normals", "octahedral")],
        &[("rest", "true"), ("pattern", "standard8")],
        &[("rest", "true"), ("search", "five"), ("shading", "placed")],
        &[
            ("rest", "true"),
            ("guards", "fallback"),
            ("unseen-floor", "0.6"),
            ("radius", "1.5"),
        ],
        &[("falloff", "gaussian"), ("radius", "2"), ("albedo-floor", "0.3")],
        &[("non-finite", "spread")],
        &[("guards", "none")],
        &[
            ("guards", "fallback"),
            ("normalisation", "epsilon"),
            ("normals", "packed"),
        ],
    ];
    let ways = ["albedo", "albedo-shadow"];
    let sets = ways.iter().flat_map(|way| {
        let own = others.iter();
        own.map(|own| completed(options(&[own, &[("demodulate", *way)][..]].concat())))
    });
    sets.filter(|set| refusal(set).is_none()).collect()
}

fn made(set: &Options, unroll: Unroll) -> Compiled {
    compiled(set, unroll).unwrap_or_else(|errors| panic!("{set:?}:\n{errors}"))
}

fn defined(set: &Options, inputs: &Inputs) -> Vec<Resolved> {
    let params = SraaParams::from_options(&values(set)).expect("options");
    oracle::resolve_sraa(inputs, &params).unwrap_or_else(|error| panic!("{set:?}: {error}"))
}

/// The largest difference to the definition, relative to values above `scale`; fails if a value is not finite.
fn off(found: impl IntoIterator<Item = [f64; 4]>, expected: &[Resolved], what: &str, scale: f64) -> f64 {
    let (mut largest, mut compared) = (0.0f64, 0);
    for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
        let at = (k as u32 % SIZE.x, k as u32 / SIZE.x);
        assert!(
            expected.color.iter().all(|axis| axis.is_finite()),
            "{what} at {at:?}: {expected:?}"
        );
        assert!(found.iter().all(|axis| axis.is_finite()), "{what} at {at:?}: {found:?}");
        if expected.sure {
            compared += 1;
            for (a, b) in found.into_iter().zip(expected.color) {
                largest = largest.max((a - b).abs() / b.abs().max(scale));
            }
        }
    }
    assert!(2 * compared > expected.len(), "{what}: {compared} pixels compared");
    largest
}

#[test]
fn every_form_gives_what_the_definition_says() {
    let bench = bench();
    let [mut in_f64, mut in_f32, mut on_device] = [0.0f64; 3];
    for set in sets() {
        let inputs = surfaces::inputs(&set, SIZE, 11);
        let expected = defined(&set, &inputs);
        for unroll in [Unroll::Full, Unroll::None] {
            let (compiled, what) = (made(&set, unroll), format!("{set:?} {unroll}"));
            let exact = interpret_kernel::<f64>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
            in_f64 = in_f64.max(off(exact.targets[0].texels.iter().copied(), &expected, &what, 1.0));
            let single = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
            in_f32 = in_f32.max(off(single.targets[0].texels.iter().copied(), &expected, &what, 1.0));
            if unroll == Unroll::Full && samples_needed(&set) <= 4 {
                for stage in [Stage::Compute, Stage::Fragment] {
                    let picture = bench
                        .run(&compiled, stage, &inputs)
                        .unwrap_or_else(|e| panic!("{what}: {e}"));
                    let texels = picture.texels().iter().map(|texel| texel.to_array().map(f64::from));
                    on_device = on_device.max(off(texels, &expected, &format!("{what} {stage:?}"), 1.0));
                }
            }
        }
        let texels = native::run(&set, &inputs).into_iter().map(|texel| texel.map(f64::from));
        in_f32 = in_f32.max(off(texels, &expected, &format!("{set:?} natively"), 1.0));
    }
    println!("off the definition: {in_f64:.1e} in f64, {in_f32:.1e} in f32, {on_device:.1e} on the device");
    assert!(in_f64 < 1.0e-5 && in_f32 < 1.0e-4 && on_device < 1.0e-4);
}

/// Values that albedo and visibility cannot have, and that count as little or nothing.
const SMALL: [f32; 6] = [f32::NAN, f32::NEG_INFINITY, 0.0, -1.0, 1.0e-30, f32::MIN_POSITIVE];

/// Values brighter than any paint.
const LARGE: [f32; 4] = [f32::INFINITY, 7.0, 1.0e30, f32::MAX];

/// With `bad` numbers here and there in albedo and visibility, and light that is not finite.
fn hard(inputs: Inputs, bad: &[f32]) -> Inputs {
    let mut random = Random(99);
    let mut spoiled = |frame: &Frame<Vec4>| {
        let texels = frame.texels().iter().map(|texel| {
            let mut texel = *texel;
            if random.unit() < 0.25 {
                let component = random.choose(&[0, 1, 2, 3]);
                texel[component] = random.choose(bad);
            }
            texel
        });
        Frame::new(frame.size(), texels.collect())
    };
    let mut inputs = inputs;
    for (name, layers) in &mut inputs.images {
        if name.contains("albedo") {
            *layers = layers.iter().map(&mut spoiled).collect();
        }
        if ["direct", "rest", "color"].contains(&name.as_str()) {
            // Not always in the same pixels.
            let first = usize::from(name == "rest");
            let texels = layers[0]
                .texels()
                .iter()
                .enumerate()
                .map(|(k, texel)| match (k + first) % 11 {
                    0 => vec4(f32::NAN, texel.y, texel.z, texel.w),
                    5 => vec4(texel.x, f32::INFINITY, texel.z, texel.w),
                    _ => *texel,
                });
            *layers = vec![Frame::new(layers[0].size(), texels.collect())];
        }
    }
    inputs
}

#[test]
fn what_albedo_and_light_cannot_be_spoils_nothing() {
    let bench = bench();
    let mut largest = 0.0f64;
    let kept = |set: &Options| {
        let is_guarded =
            |(_, value): &(String, String)| ["none", "fallback", "spread", "listed"].contains(&value.as_str());
        !set.iter().any(is_guarded)
    };
    let sets: Vec<Options> = sets().into_iter().filter(kept).collect();
    assert!(sets.len() > 15, "{} sets", sets.len());
    for set in sets {
        let compiled = made(&set, Unroll::Full);
        for bad in [&SMALL[..], &LARGE] {
            let inputs = hard(surfaces::inputs(&set, SIZE, 12), bad);
            let (expected, what) = (defined(&set, &inputs), format!("hard, {set:?}, {bad:?}"));
            let single = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
            let single = single.targets[0].texels.iter().copied();
            let picture = bench.run(&compiled, Stage::Compute, &inputs);
            let picture = picture.unwrap_or_else(|e| panic!("{what}: {e}"));
            let on_device = picture.texels().iter().map(|texel| texel.to_array().map(f64::from));
            // A lamp's albedo against paint's: terms of millions that leave ones, so that only the picture's scale says anything.
            let brightest = expected.iter().flat_map(|pixel| pixel.color).fold(1.0, f64::max);
            let scale = if bad.len() == LARGE.len() { brightest } else { 1.0 };
            largest = largest.max(off(single, &expected, &what, scale));
            largest = largest.max(off(on_device, &expected, &what, scale));
        }
    }
    println!("off the definition: {largest:.1e}");
    assert!(largest < 1.0e-4);
}

/// As it is found out afterwards: a pixel that is not finite is filtered again.
#[test]
fn a_fallback_is_what_tests_give() {
    for way in ["albedo", "albedo-shadow"] {
        let [tested, fallback] =
            ["inline", "fallback"].map(|guards| options(&[("demodulate", way), ("guards", guards)]));
        let inputs = hard(surfaces::inputs(&tested, SIZE, 13), &SMALL);
        let [tested, fallback] = [tested, fallback].map(|set| {
            let result = interpret_kernel::<f32>(&made(&set, Unroll::Full), &inputs, false).expect("a picture");
            result.targets[0].texels.clone()
        });
        let finite = |texels: &[[f64; 4]]| texels.iter().flatten().all(|axis| axis.is_finite());
        assert!(finite(&tested) && finite(&fallback), "{way}");
        let largest = tested.iter().flatten().zip(fallback.iter().flatten());
        let largest = largest
            .map(|(a, b)| (a - b).abs() / a.abs().max(1.0))
            .fold(0.0, f64::max);
        assert!(largest < 1.0e-5, "{way}: {largest}");
    }
}

#[test]
fn even_paint_in_even_light_changes_nothing() {
    for way in ["albedo", "albedo-shadow"] {
        let set = options(&[("demodulate", way)]);
        let mut inputs = surfaces::inputs(&set, SIZE, 5);
        for (name, layers) in &mut inputs.images {
            if name == "albedo" {
                let even = Frame::new(SIZE, vec![vec4(0.3, 0.01, 0.8, 0.25); layers[0].texels().len()]);
                *layers = vec![even; layers.len()];
            }
        }
        let plain = native::run(&Options::new(), &inputs);
        let found = native::run(&set, &inputs);
        let pairs = plain.iter().flatten().zip(found.iter().flatten());
        let largest = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(largest < 2.0e-6, "{way}: {largest}");
    }
}

#[test]
fn what_cannot_be_taken_apart_is_refused_with_the_reason() {
    for (set, reasons) in [
        (
            &[("demodulate", "albedo"), ("mask", "select")][..],
            ["mask", "mask=none"],
        ),
        (
            &[
                ("demodulate", "albedo-shadow"),
                ("shading", "listed"),
                ("shaded", "0,3"),
            ],
            ["demodulate=albedo", "once a pixel"],
        ),
        (
            &[
                ("demodulate", "albedo"),
                ("rest", "true"),
                ("shading", "listed"),
                ("shaded", "0,3"),
            ],
            ["rest=false", "once a pixel"],
        ),
    ] {
        let refused = compiled(&options(set), Unroll::Full).expect_err("refused").to_string();
        for reason in reasons {
            assert!(refused.contains(reason), "{refused}");
        }
    }
    let scene = Scene::from_name("awning").expect("a scene");
    let renderer = CpuRenderer::new(&scene, uvec2(16, 9)).expect("a renderer");
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    let mut capture = render::capture_scene(&renderer, &samples, ShadingSample::Centre).expect("a capture");
    let set = values(&options(&[("demodulate", "albedo-shadow")]));
    let refused = gbuffer::sraa_inputs(&capture, &set).expect_err("no albedo").to_string();
    assert!(
        refused.contains("albedo.exr") && refused.contains("capture --albedo"),
        "{refused}"
    );
    render::add_albedo(&mut capture, &renderer).expect("albedo");
    capture.direct = None;
    let refused = gbuffer::sraa_inputs(&capture, &set).expect_err("no light").to_string();
    assert!(refused.contains("direct.exr"), "{refused}");
    let set = values(&options(&[("demodulate", "albedo"), ("rest", "true")]));
    capture.rest = None;
    let refused = gbuffer::sraa_inputs(&capture, &set).expect_err("no rest").to_string();
    assert!(refused.contains("rest.exr"), "{refused}");
}

/// A scene's PSNR in dB: plain SRAA, demodulated by albedo, by albedo and shadow, the same placed and searched, the same
/// with what does not follow the albedo, and shaded at every sample.
fn judged(name: &str, pattern: &str) -> [f64; 6] {
    let scene = Scene::from_name(name).expect("a scene");
    let renderer = CpuRenderer::new(&scene, uvec2(320, 180)).expect("a renderer");
    let samples = gbuffer::pattern_offsets(pattern).expect("a pattern");
    let captured = |shading| {
        let mut capture = render::capture_scene(&renderer, &samples, shading).expect("a capture");
        render::add_albedo(&mut capture, &renderer).expect("albedo");
        capture
    };
    let centred = captured(ShadingSample::Centre);
    let placed = captured(ShadingSample::Placed);
    let reference =
        picture::at_eight_bits(&render::render_reference(&renderer, 16, &mut |_, _| {}).expect("a reference"));
    let bench = bench();
    let filtered = |capture: &Capture, own: &[(&str, &str)]| {
        let relative = [("difference", "relative"), ("depth-scale", "3"), ("pattern", pattern)];
        let compiled = made(&options(&[&relative[..], own].concat()), Unroll::Full);
        let inputs = gbuffer::sraa_inputs(capture, &compiled.options).expect("inputs");
        let made = bench.run(&compiled, Stage::Compute, &inputs).expect("a picture");
        psnr(&picture::at_eight_bits(&made), &reference)
    };
    let shaded: Result<Vec<_>, _> = samples.iter().map(|at| renderer.draw_shaded(*at)).collect();
    let supersampled = mean_frame(&shaded.expect("pictures")).expect("a mean");
    let both = ("demodulate", "albedo-shadow");
    let all = [
        filtered(&centred, &[]),
        filtered(&centred, &[("demodulate", "albedo")]),
        filtered(&centred, &[both]),
        filtered(&placed, &[both, ("shading", "placed"), ("search", "five")]),
        filtered(
            &placed,
            &[both, ("shading", "placed"), ("search", "five"), ("rest", "true")],
        ),
        psnr(&picture::at_eight_bits(&supersampled), &reference),
    ];
    println!("{name} {pattern}: {all:.2?}");
    all
}

/// Demodulated, most of what plain SRAA lacks of supersampling at edges of paint and shadow is there.
#[test]
fn paint_and_shadow_come_close_to_supersampling() {
    for (pattern, apart, at_best) in [("latin4", 1.5, 1.25), ("latin16", 3.5, 2.6)] {
        let [plain, albedo, both, best, exact, supersampled] = judged("posters", pattern);
        assert!(plain < supersampled - 5.0 && (albedo - both).abs() < 0.01);
        assert!(
            both > supersampled - apart && best > supersampled - at_best,
            "{both} {best} {supersampled}"
        );
        assert!(exact > supersampled - 0.15, "{exact} {supersampled}");
        let [plain, albedo, both, best, exact, supersampled] = judged("awning", pattern);
        assert!(plain < supersampled - 2.0 && (plain - albedo).abs() < 0.1 && both > plain + 2.0);
        assert!(
            both > supersampled - 0.6 && best > supersampled - 0.1 && exact > supersampled - 0.1,
            "{both} {best} {exact} {supersampled}"
        );
    }
}

/// White window bars before dark panes: many samples take another surface's light, which is not to cost what paint gains.
#[test]
fn light_of_other_surfaces_costs_nothing() {
    for pattern in ["latin4", "latin16"] {
        let [plain, albedo, both, best, exact, supersampled] = judged("roof", pattern);
        assert!(albedo > plain + 0.5 && both > plain + 0.5, "{plain} {albedo} {both}");
        assert!(
            best > both + 1.5 && exact > best + 0.5,
            "{both} {best} {exact} {supersampled}"
        );
    }
}

/// A renderer's picture is the sun's share, where it shines, and a rest that shadow does not change.
#[test]
fn colours_are_a_rest_and_the_suns_share() {
    let scene = Scene::from_name("awning").expect("a scene");
    let renderer = CpuRenderer::new(&scene, uvec2(160, 90)).expect("a renderer");
    let shaded = renderer.draw_shaded(glam::Vec2::ZERO).expect("a picture");
    let albedo = renderer.draw_albedo(glam::Vec2::ZERO).expect("albedo");
    let direct = renderer.draw_sunlight(glam::Vec2::ZERO).expect("light");
    let rest = |k: usize| shaded.texels()[k] - albedo.texels()[k].w * direct.texels()[k];
    let least = (0..shaded.texels().len())
        .map(|k| rest(k).min_element())
        .fold(1.0, f32::min);
    assert!(least >= 0.0, "{least}");
    let [lit, dark] = [1.0, 0.0].map(|share| albedo.texels().iter().filter(|texel| texel.w == share).count());
    assert!(
        lit + dark == albedo.texels().len() && lit.min(dark) > 1000,
        "{lit} lit, {dark} in shadow"
    );
    let layers = FrameLayers::new(vec![albedo]);
    assert!(layers.layers()[0].texels().iter().all(|texel| texel.is_finite()));
}
