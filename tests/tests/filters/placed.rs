//! Shading where geometry asks for it: where the kernel `sraa_place` puts it, and what `sraa` makes of that.

use crate::common;

use common::bench;
use glam::{UVec2, uvec2};
use straightline_bench::execute::{Bench, Inputs, interpret_kernel};
use straightline_codegen::{Compiled, Stage, Unroll};
use straightline_oracle::metrics::psnr;
use straightline_oracle::oracle::{self, Placed, SraaParams};
use straightline_scene::capture::{Capture, ShadingSample};
use straightline_scene::render::{self, CpuRenderer, PlacedBy, Renderer};
use straightline_scene::scene::Scene;
use straightline_scene::sequence::{Moment, PLACES};
use straightline_scene::{gbuffer, picture};
use straightline_tests::sraa::options::{Options, one_at_a_time, options, refusal, samples_needed, value, values};
use straightline_tests::sraa::{self, surfaces};

const SIZE: UVec2 = uvec2(61, 47);

fn compiled(kernel: &str, options: &Options, unroll: Unroll) -> Compiled {
    sraa::kernel(kernel, options, unroll).unwrap_or_else(|errors| panic!("{options:?}:\n{errors}"))
}

/// Sets that say something of surfaces: what a colour or a weight is makes no difference here.
fn sets() -> Vec<Options> {
    let of_surfaces = [
        "pattern",
        "metric",
        "difference",
        "depth",
        "normals",
        "layout",
        "turn",
        "guards",
    ];
    let sets = one_at_a_time().into_iter();
    let sets = sets.filter(|set| of_surfaces.contains(&set[0].0.as_str()) && refusal(set).is_none());
    sets.chain([options(&[
        ("pattern", "latin16"),
        ("difference", "relative"),
        ("depth-scale", "3"),
    ])])
    .chain([options(PlacedBy::Planes.options())])
    .collect()
}

/// Random surfaces, and railings.
fn worlds(set: &Options) -> [Inputs; 2] {
    let pattern = value(set, "pattern", "latin4");
    let offsets = if pattern == "listed" {
        value(set, "offsets", "")
    } else {
        pattern
    };
    let scene = Scene::from_name("railings").expect("a scene");
    let renderer = CpuRenderer::new(&scene, SIZE).expect("a renderer");
    let samples = gbuffer::pattern_offsets(offsets).expect("a pattern");
    let capture = render::capture_scene(&renderer, &samples, ShadingSample::Centre).expect("a capture");
    let railings = gbuffer::sraa_inputs(&capture, &compiled("sraa_place", set, Unroll::Full).options).expect("inputs");
    [surfaces::inputs(set, SIZE, 7), railings]
}

/// Compares placements; returns the number of compared pixels.
fn agree(found: &[u32], expected: &[Placed], what: &str) -> usize {
    assert_eq!(found.len(), expected.len(), "{what}");
    let pairs = found.iter().zip(expected).enumerate().filter(|(_, (_, e))| e.sure);
    for (k, (found, expected)) in pairs.clone() {
        let at = (k as u32 % SIZE.x, k as u32 / SIZE.x);
        assert_eq!(*found as usize, expected.sample, "{what} at {at:?}");
    }
    pairs.count()
}

/// In every form what the definition says; gives how many pixels are shaded at a sample.
fn places_agree(bench: &Bench, set: &Options, inputs: &Inputs) -> usize {
    let params = SraaParams::from_options(&values(set)).expect("options");
    let expected = oracle::place_shading(inputs, &params).unwrap_or_else(|e| panic!("{set:?}: {e}"));
    for unroll in [Unroll::Full, Unroll::None] {
        let compiled = compiled("sraa_place", set, unroll);
        let what = format!("{set:?} {unroll}");
        let interpreted = interpret_kernel::<f32>(&compiled, inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
        let numbers = |texels: &[[f64; 4]]| texels.iter().map(|t| t[0] as u32).collect::<Vec<_>>();
        let compared = agree(&numbers(&interpreted.targets[0].texels), &expected, &what);
        assert!(compared * 4 > expected.len(), "{what}: {compared} pixels compared");
        if samples_needed(set) <= 4 {
            for stage in [Stage::Compute, Stage::Fragment] {
                let targets = bench.run_targets(&compiled, stage, inputs);
                let targets = targets.unwrap_or_else(|e| panic!("{what} {stage:?}: {e}"));
                agree(&numbers(&targets[0].texels), &expected, &format!("{what} {stage:?}"));
            }
        }
    }
    let samples = params.sample_offsets().len();
    expected.iter().filter(|placed| placed.sample < samples).count()
}

#[test]
fn places_are_those_of_the_definition() {
    let bench = bench();
    let mut moved = 0;
    for set in sets() {
        for inputs in worlds(&set) {
            moved += places_agree(&bench, &set, &inputs);
        }
    }
    assert!(
        moved > 500,
        "{moved} pixels are shaded at a sample: too few to say anything"
    );
}

/// With earlier frames, centres lie `jitter` aside, and planes need to know.
#[test]
fn places_are_those_of_the_definition_in_a_frame_that_is_shaded_aside() {
    let bench = bench();
    let planes = PlacedBy::Planes.options();
    let scene = Scene::from_name("railings").expect("a scene");
    for pattern in ["latin4", "latin16"] {
        let still = options(&[planes, &[("pattern", pattern)]].concat());
        let set = options(&[planes, &[("pattern", pattern), ("history", "1")]].concat());
        let samples = gbuffer::pattern_offsets(pattern).expect("a pattern");
        let [now, then] = [PLACES[1], PLACES[2]]
            .map(|jitter| Moment::draw(scene.clone(), SIZE, jitter, &samples, None).expect("a picture"));
        let inputs = gbuffer::sraa_inputs(now.capture(), &values(&still)).expect("inputs");
        let inputs = now.with_history(inputs, &[&then]).expect("inputs");
        let moved = places_agree(&bench, &set, &inputs);
        assert!(moved > 10, "{moved} pixels are shaded at a sample");
        let placed = |set: &Options| {
            let kernel = compiled("sraa_place", set, Unroll::Full);
            interpret_kernel::<f32>(&kernel, &inputs, false)
                .expect("it runs")
                .targets
                .swap_remove(0)
        };
        let [aside, centred] = [&set, &still].map(placed);
        assert!(aside.texels != centred.texels, "{pattern}: the jitter changes nothing");
    }
}

/// A frame of railings, shaded once a pixel: where it is placed, by planes or by depths.
fn captured(placed: Option<PlacedBy>) -> (Capture, Inputs, CpuRenderer) {
    let scene = Scene::from_name("railings").expect("a scene");
    let renderer = CpuRenderer::new(&scene, uvec2(320, 180)).expect("a renderer");
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    let capture = match placed {
        Some(by) => render::capture_placed(&renderer, &samples, by),
        None => render::capture_scene(&renderer, &samples, ShadingSample::Centre),
    };
    let capture = capture.expect("a capture");
    let planes = PlacedBy::Planes.instead_of(&gbuffer::sampled_at(&capture));
    let inputs = gbuffer::sraa_inputs(&capture, &values(&planes)).expect("inputs");
    (capture, inputs, renderer)
}

#[test]
fn of_a_pixel_and_its_neighbours_one_moves_at_most() {
    for by in [PlacedBy::Depths, PlacedBy::Planes] {
        let (capture, inputs, _) = captured(Some(by));
        let place = capture.place.expect("places");
        // The renderer's own settings are those that its options name.
        let kernel = compiled("sraa_place", &options(by.options()), Unroll::Full);
        let named = interpret_kernel::<f32>(&kernel, &inputs, false).expect("it runs");
        let named = named.targets[0].texels.iter().map(|texel| texel[0] as u32);
        let same = named.zip(place.texels()).filter(|(a, b)| a == *b).count();
        assert!(same * 1000 > 999 * place.texels().len(), "{by:?}: {same} are the same");
        let (width, samples) = (place.size().x as usize, capture.samples.len() as u32);
        let moved: Vec<usize> = (0..place.texels().len())
            .filter(|k| place.texels()[*k] < samples)
            .collect();
        assert!(
            moved.len() > place.texels().len() / 100,
            "{by:?}: {} pixels moved",
            moved.len()
        );
        assert!(moved.iter().all(|k| (k % width + k / width) % 2 == 0), "{by:?}");
    }
}

/// Section 3.5 of the paper leaves what no shading sample shows to chance. One sample a pixel still, moved, and a search:
/// railings come within a decibel and a half of supersampling even where they are a few pixels wide.
#[test]
fn placing_and_searching_close_most_of_the_gap() {
    let bench = bench();
    let (centred, centred_inputs, renderer) = captured(None);
    let (_, placed_inputs, _) = captured(Some(PlacedBy::Planes));
    let reference = render::render_reference(&renderer, 16, &mut |_, _| {}).expect("a reference");
    let judged = |frame| psnr(&picture::at_eight_bits(&frame), &picture::at_eight_bits(&reference));
    let filtered = |more: &[(&str, &str)], inputs: &Inputs| {
        let set = options(&[PlacedBy::Planes.options(), more].concat());
        let compiled = compiled("sraa", &set, Unroll::Full);
        judged(bench.run(&compiled, Stage::Compute, inputs).expect("a picture"))
    };
    let plain = filtered(&[], &centred_inputs);
    let searched = filtered(&[("search", "five")], &centred_inputs);
    let placed = filtered(&[("shading", "placed")], &placed_inputs);
    let both = filtered(&[("shading", "placed"), ("search", "five")], &placed_inputs);
    let kept_even = [
        ("shading", "placed"),
        ("search", "five"),
        ("mask", "branch"),
        ("variation", "within"),
    ];
    let kept_even = filtered(&kept_even, &placed_inputs);
    let shaded = centred
        .samples
        .iter()
        .map(|at| renderer.draw_shaded(*at).expect("a picture"));
    let shaded: Vec<_> = shaded.collect();
    let texel = |k: usize| shaded.iter().map(|frame| frame.texels()[k]).sum::<glam::Vec4>() / 4.0;
    let mean = (0..shaded[0].texels().len()).map(texel).collect();
    let supersampled = judged(straightline_kernels::prelude::Frame::new(shaded[0].size(), mean));
    println!(
        "plain {plain:.2}, searched {searched:.2}, placed {placed:.2}, both {both:.2}, kept even too {kept_even:.2}, \
         4x {supersampled:.2} dB"
    );
    assert!(
        searched > plain && placed > plain + 1.0 && both > placed,
        "{plain} {searched} {placed} {both}"
    );
    assert!(supersampled - both < 1.5, "{both} of {supersampled}");
    assert!((kept_even - both).abs() < 0.2, "{kept_even} of {both}");
}
