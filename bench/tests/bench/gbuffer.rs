//! Inputs of a shader from a capture: rays in the normals' own space, and several shading samples a pixel.

use crate::common;

use common::Scratch;
use glam::{Mat3, Quat, Vec2, Vec3, uvec2};
use straightline_bench::execute::interpret_kernel;
use straightline_codegen::{Kernel, Settings};
use straightline_kernels::OptionValues;
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_oracle::metrics;
use straightline_oracle::oracle::{self, SraaParams};
use straightline_scene::capture::{Capture, NormalSpace, ShadingSample};
use straightline_scene::encode::{DepthEncoding, DepthStorage};
use straightline_scene::gbuffer::{self, GBufferError, Misplaced};
use straightline_scene::render::render_reference;
use straightline_scene::render::{self, CpuRenderer, Renderer};
use straightline_scene::scene::{NAMES, Scene};

fn renderer() -> CpuRenderer {
    CpuRenderer::new(&Scene::from_name("grooves").expect("a scene"), uvec2(96, 54)).expect("a renderer")
}

fn captured(shading: ShadingSample) -> Capture {
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    render::capture_scene(&renderer(), &samples, shading).expect("a capture")
}

fn options(words: &[(&str, &str)]) -> OptionValues {
    let words = words
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()));
    let kernel = Kernel::builtin("sraa").expect("it is built in");
    kernel.option_values(&words.collect::<Vec<_>>()).expect("options")
}

fn by_planes(capture: &Capture) -> Result<Vec<[f64; 4]>, GBufferError> {
    let options = options(&[("metric", "planes-normals")]);
    let inputs = gbuffer::sraa_inputs(capture, &options)?;
    let params = SraaParams::from_options(&options).expect("options");
    let resolved = oracle::resolve_sraa(&inputs, &params).expect("all is there");
    Ok(resolved.into_iter().map(|pixel| pixel.color).collect())
}

/// Turns a capture's normals into the world's space.
fn of_the_world(view: &Capture) -> Capture {
    let turn = Mat3::from_mat4(view.camera.expect("a camera").view()).transpose();
    let turned = |layer: &Frame<Vec3>| Frame::new(layer.size(), layer.texels().iter().map(|n| turn * *n).collect());
    let normals = view.normal.as_ref().expect("normals");
    Capture {
        normal: Some(FrameLayers::new(normals.layers().iter().map(turned).collect())),
        normal_space: NormalSpace::World,
        ..view.clone()
    }
}

#[test]
fn normals_of_the_world_are_read_with_rays_of_the_world() {
    let view = captured(ShadingSample::Centre);
    let (expected, found) = (by_planes(&view), by_planes(&of_the_world(&view)));
    let (expected, found) = (expected.expect("a picture"), found.expect("a picture"));
    let largest = expected.iter().flatten().zip(found.iter().flatten());
    let largest = largest.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(largest < 1.0e-4, "{largest}");
}

#[test]
fn normals_in_another_space_than_is_said_are_refused() {
    let mut refused = 0;
    for (name, _) in NAMES {
        let scene = Scene::from_name(name).expect("a scene");
        let renderer = CpuRenderer::new(&scene, uvec2(96, 54)).expect("a renderer");
        let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
        let view = render::capture_scene(&renderer, &samples, ShadingSample::Centre).expect("a capture");
        let planes = options(&[("metric", "planes-normals")]);
        let (_, turned) = Quat::from_mat4(&scene.camera.view()).to_axis_angle();
        let turned = turned.to_degrees();
        println!("{name}: the camera is turned by {turned:.1} degrees");
        for (right, wrong) in [("view", NormalSpace::World), ("world", NormalSpace::View)] {
            let right_one = if right == "view" {
                view.clone()
            } else {
                of_the_world(&view)
            };
            gbuffer::sraa_inputs(&right_one, &planes).unwrap_or_else(|error| panic!("{name}: {error}"));
            let wrong_one = Capture {
                normal_space: wrong,
                ..right_one
            };
            let error = gbuffer::sraa_inputs(&wrong_one, &planes);
            let error = error.map_or_else(|error| error.to_string(), |_| "no refusal".to_owned());
            // A camera that is hardly turned has two spaces that hardly differ.
            if turned > 6.5 {
                refused += 1;
                assert!(
                    error.contains(&format!("write \"normals\": \"{right}\"")),
                    "{name}, turned by {turned}: {error}"
                );
            }
            // Other metrics do not mind.
            gbuffer::sraa_inputs(&wrong_one, &options(&[])).expect("inputs");
        }
    }
    assert!(refused >= 10, "{refused}");
}

#[test]
fn several_shading_samples_are_captured_and_filtered() {
    let two = captured(ShadingSample::Samples(vec![3, 0]));
    let shaded = |k: usize| renderer().draw_shaded(two.samples[k]).expect("a picture");
    assert_eq!(two.colors, [shaded(3), shaded(0)]);
    assert_eq!(
        two.color.texels()[1000],
        0.5 * (shaded(3).texels()[1000] + shaded(0).texels()[1000])
    );
    assert_eq!((two.layer_count(), two.shaded_layers()), (4, vec![3, 0]));
    assert_eq!(
        two.shaded_offsets(),
        Some(vec![Vec2::new(0.125, 0.375), Vec2::new(-0.125, -0.375)])
    );
    let options = gbuffer::sampled_at(&two);
    let words: Vec<(&str, &str)> = options
        .iter()
        .map(|(name, value)| (name.as_str(), value.as_str()))
        .collect();
    assert_eq!(words, [("pattern", "latin4"), ("shading", "listed"), ("shaded", "3,0")]);

    let scratch = Scratch::new("gbuffer-several");
    two.write(&scratch.join("frame")).expect("written");
    assert_eq!(Capture::read(&scratch.join("frame")).expect("read"), two);

    let filtered = |capture: &Capture| {
        let settings = Settings::new().set_all(gbuffer::sampled_at(capture));
        let compiled = Kernel::builtin("sraa")
            .and_then(|kernel| kernel.compile(&settings))
            .expect("it compiles");
        let inputs = gbuffer::sraa_inputs(capture, &compiled.options).expect("inputs");
        let params = SraaParams::from_options(&compiled.options).expect("options");
        let expected = oracle::resolve_sraa(&inputs, &params).expect("all is there");
        let expected: Vec<[f64; 4]> = expected.into_iter().map(|pixel| pixel.color).collect();
        let found = interpret_kernel::<f32>(&compiled, &inputs, false)
            .expect("it runs")
            .frame(&inputs);
        let off = metrics::max_abs_difference_to(&found, &expected);
        assert!(off < 1.0e-5, "{off}");
        found
    };
    let perfect = render_reference(&renderer(), 8, &mut |_, _| {}).expect("a reference");
    let one = captured(ShadingSample::Centre);
    let psnr = |picture: &Frame<_>| metrics::psnr(picture, &perfect);
    let (plain, once, twice) = (psnr(&one.color), psnr(&filtered(&one)), psnr(&filtered(&two)));
    println!("{plain:.2} dB without, {once:.2} dB with one shading sample, {twice:.2} dB with two");
    assert!(plain < once && once < twice);
}

/// Ground and walls at many depths.
fn ground() -> Capture {
    let renderer = CpuRenderer::new(&Scene::from_name("terrain").expect("a scene"), uvec2(96, 54)).expect("a renderer");
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    render::capture_scene(&renderer, &samples, ShadingSample::Centre).expect("a capture")
}

#[test]
fn sample_offsets_that_are_stated_wrongly_show() {
    type Wrong = fn(Vec2) -> Vec2;
    let cases: [(Wrong, Option<Misplaced>); 5] = [
        (|at| at, None),
        (|at| Vec2::new(at.x, -at.y), Some(Misplaced::FlippedY)),
        (|at| Vec2::new(-at.x, at.y), Some(Misplaced::FlippedX)),
        (|at| -at, Some(Misplaced::Flipped)),
        (|at| Vec2::new(at.y, at.x), Some(Misplaced::Exchanged)),
    ];
    for scene in ["roof", "creases"] {
        let renderer = CpuRenderer::new(&Scene::from_name(scene).expect("a scene"), uvec2(96, 54)).expect("a renderer");
        for shading in [ShadingSample::Centre, ShadingSample::Sample(0)] {
            let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
            let right = render::capture_scene(&renderer, &samples, shading).expect("a capture");
            for (wrong, expected) in cases {
                let mut stated = right.clone();
                stated.samples.iter_mut().for_each(|at| *at = wrong(*at));
                assert_eq!(
                    gbuffer::find_misplaced(&stated),
                    expected,
                    "{scene} {:?}",
                    stated.shading
                );
            }
        }
    }
}

#[test]
fn depth_in_steps_is_told_from_depth_in_floats() {
    let capture = ground();
    let planes = |more: &[(&str, &str)]| {
        let recommended = [
            ("metric", "planes-normals"),
            ("difference", "relative"),
            ("depth-scale", "10"),
            ("search", "five"),
            ("search-threshold", "0.004"),
        ];
        options(&[&recommended[..], more].concat())
    };
    let stored = |of: &dyn Fn(f64) -> f64| {
        let layer = |layer: &Frame<f32>| {
            let texels = layer
                .texels()
                .iter()
                .map(|z| if *z < 1.0e6 { of(f64::from(*z)) as f32 } else { *z });
            Frame::new(layer.size(), texels.collect())
        };
        Capture {
            depth: FrameLayers::new(capture.depth.layers().iter().map(layer).collect()),
            ..capture.clone()
        }
    };
    let sixteen_bits = |near: f64| {
        let encoding = DepthEncoding::Perspective { near, far: 100.0 };
        move |z: f64| encoding.decode(DepthStorage::Unorm16.round(encoding.encode(z)))
    };
    assert_eq!(gbuffer::detect_coarse_depth(&capture, &planes(&[])), None);
    assert_eq!(
        gbuffer::detect_coarse_depth(&capture, &planes(&[("depth", "reversed-infinite")])),
        None
    );
    let coarse = gbuffer::detect_coarse_depth(&stored(&sixteen_bits(0.05)), &planes(&[])).expect("16 bits are coarse");
    assert!(coarse.share > 0.2 && coarse.least > coarse.threshold, "{coarse:?}");
    let half = |z: f64| half::f16::from_f64(z).to_f64();
    let coarse = gbuffer::detect_coarse_depth(&stored(&half), &planes(&[])).expect("half floats are coarse");
    assert!((1.0e-3..=3.0e-2).contains(&coarse.least), "{coarse:?}");
    // In 32 bits a near plane far before everything is.
    let mut near = capture.clone();
    near.camera.as_mut().expect("a camera").near = 1.0e-4;
    assert!(gbuffer::detect_coarse_depth(&near, &planes(&[("depth", "perspective")])).is_some());
    assert_eq!(
        gbuffer::detect_coarse_depth(&near, &planes(&[("depth", "reversed")])),
        None
    );
    assert_eq!(
        gbuffer::detect_coarse_depth(&stored(&half), &options(&[("metric", "normals")])),
        None
    );
}

#[test]
fn normals_of_a_map_are_told_from_those_of_geometry() {
    for scene in ["roof", "grooves", "creases"] {
        let renderer = CpuRenderer::new(&Scene::from_name(scene).expect("a scene"), uvec2(96, 54)).expect("a renderer");
        let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
        let mut capture = render::capture_scene(&renderer, &samples, ShadingSample::Centre).expect("a capture");
        assert_eq!(gbuffer::bent_normals(&capture), None, "{scene}");
        let bumps =
            |(k, n): (usize, &Vec3)| (*n + 0.2 * Vec3::new((k as f32).sin(), (1.7 * k as f32).cos(), 0.0)).normalize();
        let layer =
            |layer: &Frame<Vec3>| Frame::new(layer.size(), layer.texels().iter().enumerate().map(bumps).collect());
        let normals = capture.normal.as_ref().expect("normals").layers().iter().map(layer);
        capture.normal = Some(FrameLayers::new(normals.collect()));
        assert!(
            gbuffer::bent_normals(&capture).is_some_and(|share| share > 0.5),
            "{scene}"
        );
    }
}
