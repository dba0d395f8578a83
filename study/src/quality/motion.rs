//! Scenes in motion: a still, a pan, a turn and a moving object, and the methods that are compared in them.

use super::methods::{Method, MethodKind, PLACED, RELATIVE, SEARCHED};
use super::pan::SIDE;
use super::sequence::{BEFORE, Sequence};
use super::{QualityError, check_stopped};
use crate::progress::Progress;
use crate::record::{Motion, MovedMethod};
use glam::{Mat3, UVec2, Vec3};
use straightline_bench::execute::Bench;
use straightline_scene::scene::{Scene, Vertex};

/// Frame in which the scene is as it was loaded.
const LOADED: f32 = BEFORE as f32 - 4.0;

/// Frame in which the board is in the middle of the picture.
const MIDDLE: f32 = BEFORE as f32 + 2.0;

impl Motion {
    /// Returns the scene in a given frame, for pictures of `size`.
    pub fn scene_at_frame(self, scene: &Scene, size: UVec2, frame: usize) -> Scene {
        let mut scene = scene.clone();
        let camera = &mut scene.camera;
        let (eye, target) = (Vec3::from(camera.position), Vec3::from(camera.target));
        let to_world = Mat3::from_mat4(camera.view()).transpose();
        let pixel = 2.0 * camera.half_extent(size).y / size.y as f32;
        let distance = (target - eye).length();
        let aside = |x: f32, y: f32| to_world * Vec3::new(x, y, 0.0) * (pixel * (frame as f32 - LOADED) * distance);
        match self {
            Motion::Still => {}
            Motion::Pan => {
                camera.position = (eye + aside(0.7, 0.2)).into();
                camera.target = (target + aside(0.7, 0.2)).into();
            }
            Motion::Turn => camera.target = (target + aside(0.45, 0.3)).into(),
            Motion::Board => {
                let away = 0.5 * distance;
                let moved = Vec3::new(3.3 * (frame as f32 - MIDDLE), 0.0, 0.0) * pixel;
                let middle = eye + to_world * (moved - Vec3::Z) * away;
                let first = scene.vertices.len() as u32;
                for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                    scene.vertices.push(Vertex {
                        position: (middle + to_world * Vec3::new(20.0 * x, 30.0 * y, 0.0) * pixel * away).into(),
                        normal: (to_world * Vec3::Z).into(),
                        color: [0.8, 0.1, 0.1],
                        ..Vertex::default()
                    });
                }
                let corners = [[first, first + 1, first + 2], [first, first + 2, first + 3]];
                scene.triangles.extend(corners);
            }
        }
        scene
    }
}

/// Three earlier frames, each tap with the surface near it.
const REMEMBERED: [(&str, &str); 3] = [("history", "3"), ("falloff", "gaussian"), ("sigma", "0.3")];

/// Returns the default methods of the study of motion.
pub fn methods_in_motion() -> Vec<Method> {
    let mut all = vec![
        Method::new("1x", MethodKind::Plain, &[]),
        Method::new("1x + TAA", MethodKind::Plain, &[]).with_taa(),
    ];
    for (samples, pattern) in [(4, "latin4"), (16, "latin16")] {
        let sraa = |what: &str, own: &[(&str, &str)]| {
            let name = format!("SRAA {samples}{what}");
            Method::new(&name, MethodKind::Sraa, &[&[("pattern", pattern)], own].concat())
        };
        let relative = |what: &str, own: &[(&str, &str)]| sraa(what, &[&RELATIVE, own].concat());
        let preset = |name: &str| sraa(&format!(", {name}"), &[("preset", name)]);
        // Earlier frames smooth paint too, unless the mask keeps this frame's.
        let full = [&[("preset", "full"), ("mask", "none")], &REMEMBERED[..]].concat();
        let guided = [&[("preset", "guided")], &REMEMBERED[..]].concat();
        all.extend([
            sraa("", &[]),
            relative(", relative depth", &[]),
            relative(", placed and searched", &[PLACED, SEARCHED]),
            relative(", history", &REMEMBERED),
            relative(
                ", history, placed and searched",
                &[&[PLACED, SEARCHED], &REMEMBERED[..]].concat(),
            ),
            preset("edges"),
            preset("full"),
            preset("guided"),
            sraa(", full, history", &full),
            sraa(", guided, history", &guided),
            sraa(" + TAA", &[]).with_taa(),
            sraa(", guided + TAA", &[("preset", "guided")]).with_taa(),
            Method::new(&format!("{samples}x"), MethodKind::Supersampled(samples), &[]),
        ]);
    }
    all
}

/// Scores each method in a motion; one step of progress for each row of a reference's samples and for each method.
///
/// # Errors
///
/// [`QualityError`], if something cannot be drawn or run, or `progress` requests a stop.
pub fn in_motion(
    bench: &Bench,
    (scene, motion): (&Scene, Motion),
    methods: &[Method],
    (size, frames): (UVec2, usize),
    progress: &mut dyn Progress,
) -> Result<Vec<MovedMethod>, QualityError> {
    progress.begin(motion.display_name(), frames * SIDE as usize + methods.len());
    let mut sequence = Sequence::draw(scene, motion, size, frames, progress)?;
    let mut scores = Vec::new();
    for method in methods {
        check_stopped(progress)?;
        let pictures = sequence.make_pictures(bench, method)?;
        scores.push(sequence.score(method, &pictures));
        progress.step();
    }
    Ok(scores)
}
