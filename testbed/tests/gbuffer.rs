//! What a capture feeds a shader with: rays in the normals' own space, and several shading samples a pixel.

mod common;

use common::Scratch;
use glam::{Mat3, Quat, Vec2, Vec3, uvec2};
use std::collections::BTreeMap;
use straightline_codegen::{Kernel, Settings};
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_testbed::capture::{Capture, NormalSpace, ShadingSample};
use straightline_testbed::execute::interpret;
use straightline_testbed::gbuffer::{self, GBufferError};
use straightline_testbed::oracle::{self, SraaParams};
use straightline_testbed::render::{self, CpuRenderer, Renderer};
use straightline_testbed::scene::{NAMES, Scene};
use straightline_testbed::{metrics, render::reference};

fn renderer() -> CpuRenderer {
    CpuRenderer::new(&Scene::named("grooves").expect("a scene"), uvec2(96, 54)).expect("a renderer")
}

fn captured(shading: ShadingSample) -> Capture {
    let samples = gbuffer::samples("latin4").expect("a pattern");
    render::capture(&renderer(), &samples, shading).expect("a capture")
}

fn options(words: &[(&str, &str)]) -> BTreeMap<String, String> {
    words
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect()
}

fn by_planes(capture: &Capture) -> Result<Vec<[f64; 4]>, GBufferError> {
    let options = options(&[("metric", "planes-normals")]);
    let inputs = gbuffer::inputs(capture, &options)?;
    let params = SraaParams::of(&options).expect("options");
    let resolved = oracle::sraa(&inputs, &params).expect("all is there");
    Ok(resolved.into_iter().map(|pixel| pixel.color).collect())
}

/// The same with its normals turned into the world's space.
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
        let scene = Scene::named(name).expect("a scene");
        let renderer = CpuRenderer::new(&scene, uvec2(96, 54)).expect("a renderer");
        let samples = gbuffer::samples("latin4").expect("a pattern");
        let view = render::capture(&renderer, &samples, ShadingSample::Centre).expect("a capture");
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
            gbuffer::inputs(&right_one, &planes).unwrap_or_else(|error| panic!("{name}: {error}"));
            let wrong_one = Capture {
                normal_space: wrong,
                ..right_one
            };
            let error = gbuffer::inputs(&wrong_one, &planes);
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
            gbuffer::inputs(&wrong_one, &options(&[])).expect("inputs");
        }
    }
    assert!(refused >= 10, "{refused}");
}

#[test]
fn several_shading_samples_are_captured_and_filtered() {
    let two = captured(ShadingSample::Samples(vec![3, 0]));
    let shaded = |k: usize| renderer().shaded(two.samples[k]).expect("a picture");
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
        let settings = Settings {
            options: gbuffer::sampled_at(capture),
            ..Settings::default()
        };
        let compiled = Kernel::builtin("sraa")
            .and_then(|kernel| kernel.compile(&settings))
            .expect("it compiles");
        let inputs = gbuffer::inputs(capture, &compiled.options).expect("inputs");
        let params = SraaParams::of(&compiled.options).expect("options");
        let expected = oracle::sraa(&inputs, &params).expect("all is there");
        let expected: Vec<[f64; 4]> = expected.into_iter().map(|pixel| pixel.color).collect();
        let found = interpret::<f32>(&compiled, &inputs, false)
            .expect("it runs")
            .frame(&inputs);
        let off = metrics::max_abs_difference_to(&found, &expected);
        assert!(off < 1.0e-5, "{off}");
        found
    };
    let perfect = reference(&renderer(), 8, &mut |_, _| {}).expect("a reference");
    let one = captured(ShadingSample::Centre);
    let psnr = |picture: &Frame<_>| metrics::psnr(picture, &perfect);
    let (plain, once, twice) = (psnr(&one.color), psnr(&filtered(&one)), psnr(&filtered(&two)));
    println!("{plain:.2} dB without, {once:.2} dB with one shading sample, {twice:.2} dB with two");
    assert!(plain < once && once < twice);
}
