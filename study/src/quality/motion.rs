//! Methods in a still, a pan, a turn and with a moving object: consecutive frames, as `history` needs them.

use super::methods::{Method, MethodKind, PLACED, RELATIVE, SEARCHED};
use super::pan::{SIDE, error_frame, mean_square};
use super::shot::render_supersampled;
use super::{QualityError, check_stopped};
use crate::progress::Progress;
use crate::record::{MOST_DB, Motion, MovedMethod};
use glam::{Mat3, UVec2, Vec2, Vec3, Vec4};
use std::collections::BTreeMap;
use straightline_bench::execute::Bench;
use straightline_codegen::{Kernel, Settings, Stage};
use straightline_kernels::prelude::Frame;
use straightline_oracle::metrics;
use straightline_scene::capture::{ShadingSample, mean_frame};
use straightline_scene::render::{CpuRenderer, Renderer};
use straightline_scene::scene::{Scene, Vertex};
use straightline_scene::sequence::{Moment, PLACES};
use straightline_scene::{gbuffer, picture};

/// Number of frames before the first scored one: the longest history.
pub const BEFORE: usize = 4;

/// Frame in which the board is in the middle of the picture.
const MIDDLE: f32 = 6.0;

impl Motion {
    /// Returns the scene in a given frame, for pictures of `size`.
    pub fn scene_at_frame(self, scene: &Scene, size: UVec2, frame: usize) -> Scene {
        let mut scene = scene.clone();
        let camera = &mut scene.camera;
        let (eye, target) = (Vec3::from(camera.position), Vec3::from(camera.target));
        let to_world = Mat3::from_mat4(camera.view()).transpose();
        let pixel = 2.0 * camera.half_extent(size).y / size.y as f32;
        let distance = (target - eye).length();
        let aside = |x: f32, y: f32| to_world * Vec3::new(x, y, 0.0) * (pixel * frame as f32 * distance);
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
    let mut all = Vec::new();
    for (samples, pattern) in [(4, "latin4"), (16, "latin16")] {
        let sraa = |what: &str, own: &[(&str, &str)]| {
            let basis = [("pattern", pattern), RELATIVE[0], RELATIVE[1]];
            Method::new(
                &format!("SRAA {samples}, {what}"),
                MethodKind::Sraa,
                &[&basis, own].concat(),
            )
        };
        all.extend([
            sraa("relative depth", &[]),
            sraa("placed and searched", &[PLACED, SEARCHED]),
            sraa("history", &REMEMBERED),
            sraa(
                "history, placed and searched",
                &[&[PLACED, SEARCHED], &REMEMBERED[..]].concat(),
            ),
            Method::new(&format!("{samples}x"), MethodKind::Supersampled(samples), &[]),
        ]);
    }
    all
}

/// A scene in motion, frame by frame.
pub struct Sequence {
    scene: Scene,
    motion: Motion,
    size: UVec2,
    /// Renderers of the scored frames.
    renderers: Vec<CpuRenderer>,
    /// References of the scored frames, 64 samples a pixel, at 8 bits.
    references: Vec<Frame<Vec4>>,
    /// Frames by the inputs that methods read, including those before the first scored one if they are read.
    moments: BTreeMap<String, Vec<Moment>>,
}

impl Sequence {
    /// Draws `frames` frames of a scene with their references; one step of progress for each row of a reference's samples.
    ///
    /// # Errors
    ///
    /// [`QualityError`], if something cannot be drawn, or `progress` requests a stop.
    pub fn draw(
        scene: &Scene,
        motion: Motion,
        size: UVec2,
        frames: usize,
        progress: &mut dyn Progress,
    ) -> Result<Sequence, QualityError> {
        let (mut renderers, mut references) = (Vec::new(), Vec::new());
        for frame in BEFORE..BEFORE + frames {
            let renderer = CpuRenderer::new(&motion.scene_at_frame(scene, size, frame), size)?;
            let reference = render_supersampled(&renderer, SIDE, Vec2::ZERO, progress)?;
            references.push(picture::at_eight_bits(&reference));
            renderers.push(renderer);
        }
        Ok(Sequence {
            scene: scene.clone(),
            motion,
            size,
            renderers,
            references,
            moments: BTreeMap::new(),
        })
    }

    /// Returns the references of the scored frames.
    pub fn references(&self) -> &[Frame<Vec4>] {
        &self.references
    }

    /// Returns the pictures of the scored frames by one method, at 8 bits: supersampling, or SRAA.
    ///
    /// # Errors
    ///
    /// [`QualityError::NotInMotion`] for another method; others if something cannot be drawn or run.
    pub fn make_pictures(&mut self, bench: &Bench, method: &Method) -> Result<Vec<Frame<Vec4>>, QualityError> {
        let samples = gbuffer::pattern_offsets(method.pattern()).unwrap_or_default();
        let made: Result<Vec<Frame<Vec4>>, QualityError> = match method.kind {
            MethodKind::Supersampled(_) => {
                let supersampled = |renderer: &CpuRenderer| {
                    let shaded: Result<Vec<_>, _> = samples.iter().map(|at| renderer.draw_shaded(*at)).collect();
                    mean_frame(&shaded?).ok_or_else(|| QualityError::NotDrawn(method.name.clone()))
                };
                self.renderers.iter().map(supersampled).collect()
            }
            MethodKind::Sraa => self.filter_frames(bench, method, &samples),
            _ => Err(QualityError::NotInMotion(method.name.clone())),
        };
        Ok(made?.iter().map(picture::at_eight_bits).collect())
    }

    fn filter_frames(
        &mut self,
        bench: &Bench,
        method: &Method,
        samples: &[Vec2],
    ) -> Result<Vec<Frame<Vec4>>, QualityError> {
        let settings = Settings::new().set_all(method.options().to_vec());
        let compiled = Kernel::builtin("sraa")?.compile(&settings)?;
        // A single frame has all inputs except the history's.
        let mut alone = compiled.options.clone();
        let history = alone.number("history").unwrap_or(0.0) as usize;
        alone.remove("history");
        let (judged, before) = (self.references.len(), if history == 0 { 0 } else { BEFORE });
        let key = format!("{} {before} {}", method.capture_name(), method.reads_albedo());
        if !self.moments.contains_key(&key) {
            let drawn = self.draw_frames(method, samples, before, judged)?;
            self.moments.insert(key.clone(), drawn);
        }
        let moments = &self.moments[&key];
        let picture = |frame: usize| {
            let now = &moments[before + frame];
            let mut inputs = gbuffer::sraa_inputs(now.capture(), &alone)?;
            if history > 0 {
                let earlier: Vec<&Moment> = moments[before + frame - history..before + frame].iter().collect();
                inputs = now.with_history(inputs, &earlier)?;
            }
            Ok(bench.run(&compiled, Stage::Compute, &inputs)?)
        };
        (0..judged).map(picture).collect()
    }

    /// Draws the scored frames and the `before` frames preceding them. Without earlier frames, each is shaded at the
    /// centres of its pixels.
    fn draw_frames(
        &self,
        method: &Method,
        samples: &[Vec2],
        before: usize,
        judged: usize,
    ) -> Result<Vec<Moment>, QualityError> {
        let placed = match method.shading_sample() {
            ShadingSample::Centre => None,
            ShadingSample::Placed => Some(method.placed_by()),
            _ => return Err(QualityError::NotInMotion(method.name.clone())),
        };
        let moment = |frame: usize| {
            let jitter = if before == 0 {
                Vec2::ZERO
            } else {
                PLACES[frame % PLACES.len()]
            };
            let scene = self.motion.scene_at_frame(&self.scene, self.size, frame);
            let drawn = Moment::draw(scene, self.size, jitter, samples, placed)?;
            Ok(if method.reads_albedo() {
                drawn.with_albedo()?
            } else {
                drawn
            })
        };
        (BEFORE - before..BEFORE + judged).map(moment).collect()
    }

    /// Scores pictures of the scored frames: means over them.
    pub fn score(&self, method: &Method, pictures: &[Frame<Vec4>]) -> MovedMethod {
        let pairs = || pictures.iter().zip(&self.references);
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let wrong: Vec<Frame<Vec4>> = pairs()
            .map(|(picture, reference)| error_frame(picture, reference))
            .collect();
        let changes = wrong.windows(2).map(|pair| mean_square(&pair[0], &pair[1]));
        MovedMethod {
            method: method.name.clone(),
            options: method.options().to_vec(),
            psnr: mean(pairs().map(|(a, b)| metrics::psnr(a, b).min(MOST_DB)).collect()),
            flip: mean(pairs().map(|(a, b)| metrics::flip(a, b)).collect()),
            flicker: mean(changes.collect()).sqrt(),
        }
    }
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
