//! Pixels without a surface: renderers clear normals to 0, depth to that of the far plane, or a linear depth to anything.
//! There the filter goes by depth alone, in every form, and a sky costs nothing.

use crate::common::{bench, same_bits};
use glam::{Mat3, UVec2, Vec3, uvec2};
use straightline_bench::execute::{Bench, Inputs, interpret_kernel};
use straightline_codegen::{Stage, Unroll};
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_oracle::metrics::psnr;
use straightline_oracle::oracle::{self, SraaParams};
use straightline_scene::capture::{Capture, NormalSpace, ShadingSample};
use straightline_scene::render::{self, CpuRenderer};
use straightline_scene::scene::Scene;
use straightline_scene::{gbuffer, picture};
use straightline_tests::sraa::options::{Options, options, values};
use straightline_tests::sraa::{compiled, difference, kernel, native, surfaces};

const SIZE: UVec2 = uvec2(15, 11);

/// Everything that compares surfaces, with what else looks at them.
fn sets() -> Vec<Options> {
    let planes = ("metric", "planes-normals");
    let relative = [planes, ("difference", "relative"), ("depth-scale", "10")];
    let with = |more: &[(&str, &str)]| options(&[&relative[..], more].concat());
    vec![
        options(&[]),
        options(&[planes]),
        options(&[("metric", "normals")]),
        options(&[("turn", "chord"), ("depth", "perspective")]),
        with(&[("plane", "tap")]),
        with(&[("turn", "chord")]),
        with(&[("depth", "reversed"), ("layout", "superresolution")]),
        with(&[("depth", "reversed-infinite"), ("guards", "fallback")]),
        with(&[("normals", "unorm"), ("depth", "perspective")]),
        with(&[("normals", "packed"), ("depth", "perspective")]),
        with(&[
            ("normals", "octahedral"),
            ("search", "five"),
            ("search-threshold", "0.004"),
        ]),
        with(&[("shading", "placed"), ("mask", "branch"), ("variation", "within")]),
        options(&[("history", "1"), ("depth", "reversed")]),
    ]
}

fn form(set: &Options, unroll: Unroll) -> straightline_codegen::Compiled {
    compiled(set, unroll).unwrap_or_else(|errors| panic!("{set:?}:\n{errors}"))
}

/// Largest difference to the definition, by a shader.
fn off(bench: &Bench, set: &Options, inputs: &Inputs) -> f64 {
    let params = SraaParams::from_options(&values(set)).expect("options");
    let expected = oracle::resolve_sraa(inputs, &params).unwrap_or_else(|error| panic!("{set:?}: {error}"));
    let found = bench.run(&form(set, Unroll::Full), Stage::Compute, inputs);
    let found = found.unwrap_or_else(|error| panic!("{set:?}: {error}"));
    let difference = difference(&found, &expected);
    assert_eq!(difference.non_finite, 0, "{set:?}");
    assert!(
        difference.compared * 20 > expected.len() * 17,
        "{set:?}: {difference:?}"
    );
    difference.largest
}

#[test]
fn every_form_goes_by_depth_where_nothing_is_drawn() {
    let bench = bench();
    for (k, set) in sets().into_iter().enumerate() {
        for depth in [[None, Some(0.0)], [None, Some(37.5)]][k % 2] {
            let capture = surfaces::cleared(surfaces::capture(&set, SIZE, 5), depth);
            let inputs = surfaces::inputs_of(&capture, &set, 5);
            let expected = native::run(&set, &inputs);
            for unroll in [Unroll::Full, Unroll::None] {
                let found = interpret_kernel::<f32>(&form(&set, unroll), &inputs, false)
                    .expect("it runs")
                    .texels;
                same_bits(&expected, &found).unwrap_or_else(|e| panic!("{set:?} {unroll}: {e}"));
            }
            let largest = off(&bench, &set, &inputs);
            assert!(largest < 2.0e-4, "{set:?}, cleared to {depth:?}: off by {largest}");
        }
    }
}

/// A scene before the sky, its capture, and its reference.
struct World {
    capture: Capture,
    reference: Frame<glam::Vec4>,
}

impl World {
    fn new(scene: &str) -> World {
        let scene = Scene::from_name(scene).expect("a scene");
        let renderer = CpuRenderer::new(&scene, uvec2(128, 72)).expect("a renderer");
        let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
        World {
            capture: render::capture_scene(&renderer, &samples, ShadingSample::Centre).expect("a capture"),
            reference: render::render_reference(&renderer, 4, &mut |_, _| {}).expect("a reference"),
        }
    }

    /// The capture with normals in world space, where the sky's are `sky`.
    fn in_the_world(&self, sky: Vec3) -> Capture {
        let mut capture = surfaces::cleared(self.capture.clone(), None);
        let to_world = Mat3::from_mat4(capture.camera.expect("a camera").view()).transpose();
        let normals = capture.normal.take().expect("normals");
        let turned = |n: &Vec3| if *n == Vec3::ZERO { sky } else { to_world * *n };
        let layers = normals.layers().iter();
        let layers = layers.map(|layer| Frame::new(layer.size(), layer.texels().iter().map(turned).collect()));
        capture.normal = Some(FrameLayers::new(layers.collect()));
        capture.normal_space = NormalSpace::World;
        capture
    }

    fn judged(&self, bench: &Bench, capture: &Capture, set: &Options) -> f64 {
        let inputs = gbuffer::sraa_inputs(capture, &form(set, Unroll::Full).options).expect("inputs");
        let resolved = bench
            .run(&form(set, Unroll::Full), Stage::Compute, &inputs)
            .expect("a picture");
        psnr(
            &picture::at_eight_bits(&resolved),
            &picture::at_eight_bits(&self.reference),
        )
    }
}

/// A renderer of others lost 3.8 dB by normals that it cleared to 0.
#[test]
fn a_cleared_sky_costs_nothing() {
    let bench = bench();
    let planes = |more: &[(&str, &str)]| {
        let recommended = [
            ("metric", "planes-normals"),
            ("difference", "relative"),
            ("depth-scale", "10"),
        ];
        options(&[&recommended[..], more].concat())
    };
    let sets = [
        planes(&[]),
        planes(&[("depth", "perspective")]),
        planes(&[
            ("depth", "reversed"),
            ("normals", "octahedral"),
            ("search", "five"),
            ("search-threshold", "0.004"),
        ]),
        options(&[("depth", "perspective")]),
    ];
    for scene in ["wires"] {
        let world = World::new(scene);
        let drawn = world.capture.depth.layers()[0].texels();
        let bare = drawn.iter().filter(|z| **z >= 1.0e6).count();
        assert!(bare * 10 > drawn.len(), "{scene}: {bare} pixels of sky");
        for set in &sets {
            let unit = world.judged(&bench, &world.capture, set);
            for (what, capture) in [
                ("view", surfaces::cleared(world.capture.clone(), None)),
                (
                    "view, depth cleared to 0",
                    surfaces::cleared(world.capture.clone(), Some(0.0)),
                ),
                ("world", world.in_the_world(Vec3::ZERO)),
            ] {
                // A projected depth of nothing is that of the far plane, whatever was cleared.
                if what.contains("depth") && set.iter().any(|(name, _)| name == "depth") {
                    continue;
                }
                let cleared = world.judged(&bench, &capture, set);
                assert!(
                    cleared > unit - 0.1,
                    "{scene}, {what}, {set:?}: {cleared:.2} dB of {unit:.2}"
                );
            }
            let encoded = set.iter().any(|(name, _)| name == "depth");
            if encoded {
                let cleared = world.judged(&bench, &world.in_the_world(Vec3::Z), set);
                assert!(
                    cleared > unit - 0.1,
                    "{scene}, world +z, {set:?}: {cleared:.2} dB of {unit:.2}"
                );
            }
        }
    }
}

/// An even sky is even: nothing is placed in it, nothing listed, and the mask keeps it.
#[test]
fn nothing_is_placed_in_a_sky() {
    let capture = World::new("wires").in_the_world(Vec3::ZERO);
    let set = options(&[
        ("metric", "planes-normals"),
        ("difference", "relative"),
        ("depth-scale", "10"),
        ("unseen", "0.003"),
        ("depth", "perspective"),
    ]);
    let place = kernel("sraa_place", &set, Unroll::Full).unwrap_or_else(|errors| panic!("{errors}"));
    let inputs = gbuffer::sraa_inputs(&capture, &place.options).expect("inputs");
    let places = interpret_kernel::<f32>(&place, &inputs, false).expect("it runs");
    let layers = capture.depth.layers();
    let (mut bare, mut moved) = (0, 0);
    for (at, place) in places.targets[0].texels.iter().enumerate() {
        let is_bare = layers.iter().all(|layer| layer.texels()[at] >= 1.0e6);
        bare += usize::from(is_bare);
        moved += usize::from(!is_bare && place[0] < 4.0);
        assert!(
            !is_bare || place[0] == 4.0,
            "pixel {at} of the sky is moved to sample {}",
            place[0]
        );
    }
    assert!(bare > 1000 && moved > 20, "{bare} of sky, {moved} moved");
}
