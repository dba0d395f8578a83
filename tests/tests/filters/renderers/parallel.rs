//! Parallel projections: the filter against its definition in f64, planes that are even, and what is refused.

use crate::common::{bench, same_bits};
use glam::{Mat3, UVec2, Vec2, Vec3, Vec4, uvec2, vec2, vec3};
use straightline_bench::execute::interpret_kernel;
use straightline_codegen::{Stage, Unroll};
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_oracle::oracle::{self, SraaParams};
use straightline_scene::capture::{Capture, NormalSpace};
use straightline_scene::gbuffer;
use straightline_scene::scene::{Camera, SKY_DEPTH};
use straightline_tests::sraa::options::{Options, options, values};
use straightline_tests::sraa::{compiled, difference, kernel, native, surfaces};

const SIZE: UVec2 = uvec2(31, 23);

/// Height of the view from the upper to the lower edge.
const HEIGHT: f32 = 6.0;

/// A roof of two steep planes before the sky, seen along parallel rays, in view space.
fn roof(at: Vec2) -> (f32, Vec3) {
    let pixel = HEIGHT / SIZE.y as f32;
    // In scene units from the middle, y up.
    let place = (at - 0.5 * SIZE.as_vec2()) * vec2(pixel, -pixel);
    let side = if place.x < 0.3 * place.y { -1.0 } else { 1.0 };
    let normal = vec3(0.75 * side, 0.4, 0.5).normalize();
    // On the plane through (0, 0, -9), or that 1.5 before it.
    let apex = vec3(0.0, 0.0, if side < 0.0 { -9.0 } else { -7.5 });
    let z = apex.z - ((place.x - apex.x) * normal.x + (place.y - apex.y) * normal.y) / normal.z;
    if place.y > 1.9 {
        (SKY_DEPTH, Vec3::Z)
    } else {
        (-z, normal)
    }
}

/// Capture of the scene, with normals in a space.
fn captured(set: &Options, space: NormalSpace) -> Capture {
    let camera = Camera {
        position: [3.0, 2.0, 1.0],
        target: [-1.0, 0.5, 4.0],
        up: [0.0, 1.0, 0.0],
        vertical_fov: 0.0,
        parallel_height: Some(HEIGHT),
        near: 0.5,
    };
    let turn = match space {
        NormalSpace::View => Mat3::IDENTITY,
        NormalSpace::World => Mat3::from_mat4(camera.view()).transpose(),
    };
    let mut capture = surfaces::capture(set, SIZE, 9);
    let mut places = capture.samples.clone();
    places.push(Vec2::ZERO);
    let pixels = || (0..SIZE.y).flat_map(|y| (0..SIZE.x).map(move |x| uvec2(x, y).as_vec2() + 0.5));
    let layers = |of: &dyn Fn((f32, Vec3)) -> Vec4| -> Vec<Frame<Vec4>> {
        let layer = |offset: &Vec2| Frame::new(SIZE, pixels().map(|at| of(roof(at + *offset))).collect());
        places.iter().map(layer).collect()
    };
    let seen = layers(&|(depth, normal)| (turn * normal).extend(depth));
    let depths = seen
        .iter()
        .map(|l| Frame::new(SIZE, l.texels().iter().map(|t| t.w).collect()));
    let normals = seen
        .iter()
        .map(|l| Frame::new(SIZE, l.texels().iter().map(|t| t.truncate()).collect()));
    capture.depth = FrameLayers::new(depths.collect());
    capture.normal = Some(FrameLayers::new(normals.collect()));
    (capture.camera, capture.normal_space) = (Some(camera), space);
    capture
}

fn parallel(more: &[(&str, &str)]) -> Options {
    options(&[&[("projection", "parallel")][..], more].concat())
}

#[test]
fn every_form_gives_what_the_definition_says() {
    let bench = bench();
    let planes = ("metric", "planes-normals");
    for set in [
        parallel(&[planes]),
        parallel(&[planes, ("plane", "tap"), ("depth", "perspective")]),
        parallel(&[planes, ("depth", "reversed"), ("normals", "packed")]),
        parallel(&[("depth", "perspective")]),
        parallel(&[planes, ("search", "five"), ("search-threshold", "0.02")]),
    ] {
        for space in [NormalSpace::View, NormalSpace::World] {
            let form = |unroll| compiled(&set, unroll).unwrap_or_else(|errors| panic!("{set:?}:\n{errors}"));
            let full = form(Unroll::Full);
            let inputs = surfaces::inputs_of(&captured(&set, space), &set, 9);
            let expected = native::run(&set, &inputs);
            for form in [&full, &form(Unroll::None)] {
                let found = interpret_kernel::<f32>(form, &inputs, false).expect("it runs").texels;
                same_bits(&expected, &found).unwrap_or_else(|e| panic!("{set:?}: {e}"));
            }
            let params = SraaParams::from_options(&values(&set)).expect("options");
            let defined = oracle::resolve_sraa(&inputs, &params).expect("a definition");
            let found = bench.run(&full, Stage::Compute, &inputs).expect("a picture");
            let off = difference(&found, &defined);
            assert!(
                off.compared * 10 > 9 * defined.len() && off.non_finite == 0,
                "{set:?}: {off:?}"
            );
            assert!(off.largest < 1.0e-3, "{set:?} {space:?}: {off:?}");
        }
    }
}

/// Steep planes are even by planes, and are not by depth; nothing of them is placed.
#[test]
fn a_plane_is_one_surface() {
    let kept = |set: &Options| {
        let capture = captured(set, NormalSpace::World);
        let form = compiled(set, Unroll::Full).unwrap_or_else(|errors| panic!("{errors}"));
        let inputs = gbuffer::sraa_inputs(&capture, &form.options).expect("inputs");
        let found = interpret_kernel::<f32>(&form, &inputs, false).expect("it runs").texels;
        let own = capture.color.texels().iter().zip(&found);
        own.filter(|(own, found)| own.to_array() == **found).count()
    };
    let mask = [("mask", "branch"), ("variation", "within"), ("depth-scale", "2")];
    let by_planes = kept(&parallel(&[&mask[..], &[("metric", "planes-normals")]].concat()));
    let by_depth = kept(&parallel(&mask));
    let all = (SIZE.x * SIZE.y) as usize;
    assert!(
        by_planes * 10 > 8 * all && by_depth * 2 < all,
        "{by_planes}, {by_depth} of {all}"
    );
    let set = parallel(&[("metric", "planes-normals"), ("depth-scale", "2")]);
    let place = kernel("sraa_place", &set, Unroll::Full).unwrap_or_else(|errors| panic!("{errors}"));
    let inputs = gbuffer::sraa_inputs(&captured(&set, NormalSpace::View), &place.options).expect("inputs");
    let places = interpret_kernel::<f32>(&place, &inputs, false).expect("it runs");
    let moved = places.targets[0].texels.iter().filter(|place| place[0] < 4.0).count();
    assert!(moved * 10 < all, "{moved} of {all} moved");
}

#[test]
fn what_only_a_perspective_has_is_refused() {
    for (set, says) in [
        (parallel(&[("difference", "relative")]), "difference=absolute"),
        (parallel(&[("depth", "reversed-infinite")]), "far plane"),
    ] {
        let refused = compiled(&set, Unroll::Full).expect_err("a refusal").to_string();
        assert!(refused.contains(says), "{refused}");
    }
    let capture = captured(&parallel(&[]), NormalSpace::View);
    let perspective = compiled(&options(&[]), Unroll::Full).unwrap_or_else(|errors| panic!("{errors}"));
    let refused = gbuffer::sraa_inputs(&capture, &perspective.options)
        .expect_err("a refusal")
        .to_string();
    assert!(refused.contains("set projection=parallel"), "{refused}");
    assert!(gbuffer::sampled_at(&capture).contains(&("projection".to_owned(), "parallel".to_owned())));
}
