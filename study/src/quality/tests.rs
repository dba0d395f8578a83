//! Kinds of pixels and bounds, on pictures whose surfaces are known.

use super::bounds::{by_coverage, once_a_surface, reconstruct_ideal, where_edges_are};
use super::classes::{Classes, varies_within};
use super::surfaces::Surfaces;
use glam::{UVec2, Vec2, Vec3, Vec4, uvec2, vec3};
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_scene::capture::{Capture, NormalSpace, ShadingSample, mean_frame};
use straightline_scene::scene::{Camera, SKY_DEPTH};

const SIZE: UVec2 = uvec2(8, 6);
const CAMERA: Camera = Camera {
    position: [0.0, 0.0, 0.0],
    target: [0.0, 0.0, -1.0],
    up: [0.0, 1.0, 0.0],
    vertical_fov: 1.0,
    parallel_height: None,
    near: 0.1,
};

/// A plane through `through`, and what it is painted with.
#[derive(Clone, Copy)]
struct Plane {
    normal: Vec3,
    through: Vec3,
    color: Vec4,
}

fn plane(normal: Vec3, through: Vec3, color: f32) -> Plane {
    Plane {
        normal: normal.normalize(),
        through,
        color: Vec4::splat(color),
    }
}

/// Captures the planes that `seen` puts at each place, in pixels; `None` for the sky, which is black.
fn captured(seen: impl Fn(Vec2) -> Option<Plane>) -> (Capture, Vec<Frame<Vec4>>) {
    let samples = straightline_scene::gbuffer::pattern_offsets("latin4").expect("a pattern");
    let extent = CAMERA.half_extent(SIZE);
    let texel = |place: Vec2| {
        let at = place / SIZE.as_vec2() * 2.0 - 1.0;
        let ray = vec3(at.x * extent.x, -at.y * extent.y, -1.0);
        match seen(place) {
            Some(plane) => {
                let depth = plane.through.dot(plane.normal) / ray.dot(plane.normal);
                (depth, plane.normal, plane.color)
            }
            None => (SKY_DEPTH, Vec3::Z, Vec4::ZERO),
        }
    };
    let layers: Vec<Vec<(f32, Vec3, Vec4)>> = samples
        .iter()
        .chain([&Vec2::ZERO])
        .map(|offset| {
            let pixels = (0..SIZE.x * SIZE.y).map(|k| uvec2(k % SIZE.x, k / SIZE.x));
            pixels.map(|pixel| texel(pixel.as_vec2() + 0.5 + *offset)).collect()
        })
        .collect();
    let colors = |layer: &Vec<(f32, Vec3, Vec4)>| Frame::new(SIZE, layer.iter().map(|t| t.2).collect());
    let capture = Capture {
        size: SIZE,
        samples,
        shading: ShadingSample::Centre,
        normal_space: NormalSpace::View,
        colors: Vec::new(),
        place: None,
        camera: Some(CAMERA),
        color: colors(&layers[4]),
        depth: FrameLayers::new(
            layers
                .iter()
                .map(|l| Frame::new(SIZE, l.iter().map(|t| t.0).collect()))
                .collect(),
        ),
        normal: Some(FrameLayers::new(
            layers
                .iter()
                .map(|l| Frame::new(SIZE, l.iter().map(|t| t.1).collect()))
                .collect(),
        )),
        albedo: None,
        direct: None,
        rest: None,
        guide: None,
        reference: None,
    };
    let shaded = layers[..4].iter().map(colors).collect();
    (capture, shaded)
}

fn classes(capture: &Capture, shaded: &[Frame<Vec4>]) -> Classes {
    let surfaces = Surfaces::from_captures(&[capture]).expect("a capture");
    Classes::new(&surfaces, &varies_within(shaded))
}

/// Indices of pixels of a class, as columns of the picture.
fn columns(class: &[bool]) -> Vec<usize> {
    let mut columns: Vec<usize> = (0..class.len())
        .filter(|k| class[*k])
        .map(|k| k % SIZE.x as usize)
        .collect();
    columns.sort_unstable();
    columns.dedup();
    columns
}

#[test]
fn a_plane_at_a_grazing_angle_is_one_surface() {
    // The plane's depth grows from 0.8 below to 4.5 above.
    let (capture, shaded) = captured(|_| Some(plane(vec3(0.05, 1.0, 0.75), vec3(0.0, -1.0, 0.0), 0.5)));
    let found = classes(&capture, &shaded);
    assert_eq!(found.shares().flat, 1.0, "{:?}", found.geometry);
    assert_eq!(found.shares().unseen, 0.0);
}

#[test]
fn a_step_a_crease_and_the_sky_are_edges_and_paint_is_not() {
    let front = plane(Vec3::Z, vec3(0.0, 0.0, -5.0), 0.8);
    let edge_at = |edge: f32, behind: Option<Plane>| {
        let (capture, shaded) = captured(|place| if place.x < edge { Some(front) } else { behind });
        let found = classes(&capture, &shaded);
        (columns(&found.geometry), columns(&found.shading))
    };
    // Through the middle of column 3, where a pixel is 5 * 2 tan(0.5) / 6 = 0.91 wide.
    let step = plane(Vec3::Z, vec3(0.0, 0.0, -5.3), 0.8);
    let crease = plane(vec3(-0.4, 0.0, 1.0), vec3(-0.5, 0.0, -5.0), 0.8);
    let paint = plane(Vec3::Z, vec3(0.0, 0.0, -5.0), 0.2);
    for behind in [Some(step), Some(crease), None] {
        assert_eq!(edge_at(3.6, behind).0, [3]);
    }
    assert_eq!(edge_at(3.6, Some(paint)), (vec![], vec![3]));
    // A step of a hundredth of a pixel is none.
    let nothing = plane(Vec3::Z, vec3(0.0, 0.0, -5.01), 0.8);
    assert_eq!(edge_at(3.6, Some(nothing)), (vec![], vec![]));
}

#[test]
fn what_no_shading_sample_saw_is_unseen_and_takes_the_nearest_colour() {
    let wall = plane(Vec3::Z, vec3(0.0, 0.0, -5.0), 0.25);
    let wire = plane(Vec3::Z, vec3(0.0, 0.0, -4.0), 1.0);
    // Between the centres of columns 3 and 4: the sample 3/8 to the right of column 3 sees it, no centre does.
    let (capture, shaded) = captured(|place| match (3.8..3.95).contains(&place.x) {
        true => Some(wire),
        false => Some(wall),
    });
    let found = classes(&capture, &shaded);
    assert_eq!((columns(&found.geometry), columns(&found.unseen)), (vec![3], vec![3]));
    let surfaces = Surfaces::from_captures(&[&capture]).expect("a capture");
    let bound = mean_frame(&shaded).expect("pictures");
    let best = reconstruct_ideal(&surfaces, &shaded, &capture.color);
    for k in 0..best.texels().len() {
        let lost = k % SIZE.x as usize == 3;
        assert_eq!(best.texels()[k].x, 0.25, "{k}");
        assert_eq!(bound.texels()[k].x, if lost { 0.25 + 0.75 / 4.0 } else { 0.25 }, "{k}");
    }
}

#[test]
fn what_was_seen_has_its_true_colour() {
    let left = plane(Vec3::Z, vec3(0.0, 0.0, -5.0), 0.25);
    let right = plane(Vec3::Z, vec3(0.0, 0.0, -7.0), 1.0);
    let (capture, shaded) = captured(|place| Some(if place.x < 3.7 { left } else { right }));
    let surfaces = Surfaces::from_captures(&[&capture]).expect("a capture");
    let bound = mean_frame(&shaded).expect("pictures");
    assert_eq!(
        reconstruct_ideal(&surfaces, &shaded, &capture.color).texels(),
        bound.texels(),
        "all surfaces were seen"
    );
    // Each surface has one colour, so shading it once loses nothing.
    assert_eq!(once_a_surface(&surfaces, &shaded).texels(), bound.texels());
}

#[test]
fn deferred_multisampling_shades_every_sample_at_edges_alone() {
    let wall = |color| plane(Vec3::Z, vec3(0.0, 0.0, -5.0), color);
    // Column 3 has a step in it, column 6 is painted.
    let (capture, shaded) = captured(|place| match place.x {
        x if x < 3.6 => Some(plane(Vec3::Z, vec3(0.0, 0.0, -4.0), 1.0)),
        x if x < 6.6 => Some(wall(0.2)),
        _ => Some(wall(0.8)),
    });
    let surfaces = Surfaces::from_captures(&[&capture]).expect("a capture");
    let (found, all) = (
        where_edges_are(&surfaces, &shaded),
        mean_frame(&shaded).expect("pictures"),
    );
    for k in 0..found.texels().len() {
        let expected = if k % SIZE.x as usize == 3 { &all } else { &shaded[0] };
        assert_eq!(found.texels()[k], expected.texels()[k], "{k}");
    }
    assert_ne!(found.texels(), all.texels());
}

#[test]
fn coverage_counts_all_samples_and_colours_few() {
    let left = plane(Vec3::Z, vec3(0.0, 0.0, -5.0), 0.25);
    let right = plane(Vec3::Z, vec3(0.0, 0.0, -7.0), 1.0);
    let (capture, shaded) = captured(|place| Some(if place.x < 3.7 { left } else { right }));
    let surfaces = Surfaces::from_captures(&[&capture]).expect("a capture");
    let all = mean_frame(&shaded).expect("pictures");
    // Both surfaces are among the stored colours, wherever they are stored.
    let sides: Vec<usize> = (0..4).filter(|k| capture.samples[*k].x > 0.2).take(1).collect();
    let others: Vec<usize> = (0..4).filter(|k| capture.samples[*k].x < 0.0).take(1).collect();
    let stored = [sides[0], others[0]];
    assert_eq!(by_coverage(&surfaces, &shaded, &stored).texels(), all.texels());
    // A surface that is not stored says nothing.
    let found = by_coverage(&surfaces, &shaded, &others);
    for (k, texel) in found.texels().iter().enumerate() {
        let expected = if k % SIZE.x as usize <= 3 { 0.25 } else { 1.0 };
        assert_eq!(texel.x, expected, "{k}");
    }
}

#[test]
fn multisampling_shades_a_surface_once() {
    // Painted on: one surface, so a pixel has the colour of its first sample.
    let painted = |place: Vec2| {
        Some(plane(
            Vec3::Z,
            vec3(0.0, 0.0, -5.0),
            if place.x < 3.6 { 0.2 } else { 0.8 },
        ))
    };
    let (capture, shaded) = captured(painted);
    let surfaces = Surfaces::from_captures(&[&capture]).expect("a capture");
    assert_eq!(once_a_surface(&surfaces, &shaded).texels(), shaded[0].texels());
    assert_ne!(mean_frame(&shaded).expect("pictures").texels(), shaded[0].texels());
}
