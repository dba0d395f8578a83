//! Consecutive frames of a scene in motion, and the pictures that methods make of them.

use super::QualityError;
use super::methods::{Method, MethodKind};
use super::pan::{SIDE, error_frame, mean_square};
use super::shot::render_supersampled;
use super::taa;
use crate::progress::Progress;
use crate::record::{MOST_DB, Motion, MovedMethod};
use glam::{UVec2, Vec2, Vec4};
use std::collections::BTreeMap;
use straightline_bench::execute::{Bench, Inputs};
use straightline_codegen::{Compiled, Kernel, Settings, Stage};
use straightline_kernels::prelude::Frame;
use straightline_manifest::Manifest;
use straightline_oracle::metrics;
use straightline_runtime::Pass;
use straightline_scene::capture::{Capture, ShadingSample, mean_frame};
use straightline_scene::render::{self, CpuRenderer, GuideLight, PlacedBy, Renderer, Shifted};
use straightline_scene::scene::Scene;
use straightline_scene::sequence::{Moment, PLACES, motion_vectors};
use straightline_scene::{gbuffer, picture};

/// Number of frames before the first scored one, over which the mean of temporal antialiasing forms.
pub const BEFORE: usize = 16;

/// Number of those that `history` can reach.
const HISTORY: usize = 4;

/// Scale of the jitter before temporal antialiasing of pictures that SRAA has filtered. Each is already the mean over a pixel: with
/// a scale of 1 the result is blurred, and with 0 a still gains little.
const SRAA_JITTER: f32 = 0.5;

/// A scene in motion, frame by frame.
pub struct Sequence {
    scene: Scene,
    motion: Motion,
    size: UVec2,
    /// Renderers of the frames that were drawn.
    renderers: BTreeMap<usize, CpuRenderer>,
    /// References of the scored frames, 64 samples a pixel, at 8 bits.
    references: Vec<Frame<Vec4>>,
    /// Frames with earlier ones by the inputs that methods read, from the first that `history` can reach.
    moments: BTreeMap<String, Vec<Moment>>,
    /// For temporal antialiasing, by the jitter in hundredths: motion from each frame after the first to the one before.
    motions: BTreeMap<u32, Vec<Frame<Vec2>>>,
}

/// A filter on a device.
struct Filter<'a> {
    bench: &'a Bench,
    compiled: Compiled,
    pass: Pass,
    manifest: Manifest,
}

impl<'a> Filter<'a> {
    fn new(bench: &'a Bench, method: &Method) -> Result<Filter<'a>, QualityError> {
        let settings = Settings::new().set_all(method.options().to_vec());
        let compiled = Kernel::builtin("sraa")?.compile(&settings)?;
        let (pass, manifest) = bench.compile_pass(&compiled, Stage::Compute)?;
        Ok(Filter {
            bench,
            compiled,
            pass,
            manifest,
        })
    }

    fn run(&self, inputs: &Inputs) -> Result<Frame<Vec4>, QualityError> {
        let uploaded = self.bench.upload(&self.manifest, inputs)?;
        Ok(self.bench.picture_of(&self.pass, &uploaded, inputs.size)?)
    }
}

impl Sequence {
    /// Draws `frames` frames of a scene with their references; one step of progress for each row of a reference's samples.
    ///
    /// # Errors
    ///
    /// [`QualityError`], if something cannot be drawn, the camera has parallel rays, or `progress` requests a stop.
    pub fn draw(
        scene: &Scene,
        motion: Motion,
        size: UVec2,
        frames: usize,
        progress: &mut dyn Progress,
    ) -> Result<Sequence, QualityError> {
        if scene.camera.parallel_height.is_some() {
            return Err(QualityError::ParallelMotion);
        }
        let (mut renderers, mut references) = (BTreeMap::new(), Vec::new());
        for frame in BEFORE..BEFORE + frames {
            let renderer = CpuRenderer::new(&motion.scene_at_frame(scene, size, frame), size)?;
            let reference = render_supersampled(&renderer, SIDE, Vec2::ZERO, progress)?;
            references.push(picture::at_eight_bits(&reference));
            renderers.insert(frame, renderer);
        }
        Ok(Sequence {
            scene: scene.clone(),
            motion,
            size,
            renderers,
            references,
            moments: BTreeMap::new(),
            motions: BTreeMap::new(),
        })
    }

    /// Returns the references of the scored frames.
    pub fn references(&self) -> &[Frame<Vec4>] {
        &self.references
    }

    /// Returns the pictures of the scored frames by one method, at 8 bits: shading as it is, supersampling, or SRAA; each also
    /// before temporal antialiasing.
    ///
    /// # Errors
    ///
    /// [`QualityError::NotInMotion`] for another method; others if something cannot be drawn or run.
    pub fn make_pictures(&mut self, bench: &Bench, method: &Method) -> Result<Vec<Frame<Vec4>>, QualityError> {
        let scored = BEFORE..BEFORE + self.references.len();
        let filter = match method.kind {
            MethodKind::Sraa => Some(Filter::new(bench, method)?),
            MethodKind::Plain | MethodKind::Supersampled(_) => None,
            _ => return Err(QualityError::NotInMotion(method.name.clone())),
        };
        let history = filter
            .as_ref()
            .and_then(|filter| filter.compiled.options.number("history"));
        let made: Result<Vec<_>, QualityError> = match (filter, history.unwrap_or(0.0) as usize) {
            (_, 1..) if method.has_taa => Err(QualityError::NotInMotion(method.name.clone())),
            (filter, 0) if method.has_taa => self.accumulate_frames(filter.as_ref(), method),
            (Some(filter), history @ 1..) => self.filter_with_history(&filter, method, history),
            (filter, _) => scored
                .map(|frame| self.draw_frame(filter.as_ref(), method, frame, Vec2::ZERO))
                .collect(),
        };
        Ok(made?.iter().map(picture::at_eight_bits).collect())
    }

    /// Draws the renderer of a frame, unless it is there.
    fn renderer(&mut self, frame: usize) -> Result<&CpuRenderer, QualityError> {
        if !self.renderers.contains_key(&frame) {
            let scene = self.motion.scene_at_frame(&self.scene, self.size, frame);
            self.renderers.insert(frame, CpuRenderer::new(&scene, self.size)?);
        }
        Ok(&self.renderers[&frame])
    }

    /// Returns the picture of a frame that no other takes part in, moved by `jitter`, linear.
    fn draw_frame(
        &mut self,
        filter: Option<&Filter<'_>>,
        method: &Method,
        frame: usize,
        jitter: Vec2,
    ) -> Result<Frame<Vec4>, QualityError> {
        let samples = gbuffer::pattern_offsets(method.pattern()).unwrap_or_default();
        let moved = Shifted {
            renderer: self.renderer(frame)?,
            by: jitter,
        };
        let Some(filter) = filter else {
            let places = match method.kind {
                MethodKind::Supersampled(_) => samples,
                _ => vec![Vec2::ZERO],
            };
            let shaded: Result<Vec<_>, _> = places.iter().map(|at| moved.draw_shaded(*at)).collect();
            return mean_frame(&shaded?).ok_or_else(|| QualityError::NotDrawn(method.name.clone()));
        };
        let mut capture = match placement(method)? {
            Some(by) => render::capture_placed(&moved, &samples, by)?,
            None => render::capture_scene(&moved, &samples, ShadingSample::Centre)?,
        };
        if method.reads_albedo() {
            render::add_albedo(&mut capture, &moved)?;
        }
        if method.reads_guide() {
            render::add_guide(&mut capture, &moved, GuideLight::default())?;
        }
        let inputs = gbuffer::sraa_inputs(&capture, &filter.compiled.options)?;
        filter.run(&with_moved_rays(inputs, &capture, jitter))
    }

    /// Returns the scored pictures of a method with earlier frames.
    fn filter_with_history(
        &mut self,
        filter: &Filter<'_>,
        method: &Method,
        history: usize,
    ) -> Result<Vec<Frame<Vec4>>, QualityError> {
        // A single frame has all inputs except the history's.
        let mut alone = filter.compiled.options.clone();
        alone.remove("history");
        let key = format!(
            "{} {} {:?}",
            method.capture_name(),
            method.reads_albedo(),
            method.reads_guide().then(|| alone.flag("fitted"))
        );
        if !self.moments.contains_key(&key) {
            let samples = gbuffer::pattern_offsets(method.pattern()).unwrap_or_default();
            let placed = placement(method)?;
            let moment = |frame: usize| -> Result<Moment, QualityError> {
                let scene = self.motion.scene_at_frame(&self.scene, self.size, frame);
                let jitter = PLACES[frame % PLACES.len()];
                let mut drawn = Moment::draw(scene, self.size, jitter, &samples, placed)?;
                if method.reads_albedo() {
                    drawn = drawn.with_albedo()?;
                }
                if method.reads_guide() {
                    drawn = drawn.with_guide::<QualityError>(&alone)?;
                }
                Ok(drawn)
            };
            let drawn = (BEFORE - HISTORY..BEFORE + self.references.len()).map(moment);
            let drawn = drawn.collect::<Result<_, _>>()?;
            self.moments.insert(key.clone(), drawn);
        }
        let moments = &self.moments[&key];
        let scored = HISTORY..HISTORY + self.references.len();
        let picture = |frame: usize| {
            let now = &moments[frame];
            let earlier: Vec<&Moment> = moments[frame - history..frame].iter().collect();
            let inputs = gbuffer::sraa_inputs(now.capture(), &alone)?;
            filter.run(&now.with_history(inputs, &earlier)?)
        };
        scored.map(picture).collect()
    }

    /// Returns the scored pictures of a method before temporal antialiasing, which begins with the first frame.
    fn accumulate_frames(
        &mut self,
        filter: Option<&Filter<'_>>,
        method: &Method,
    ) -> Result<Vec<Frame<Vec4>>, QualityError> {
        let scale = if filter.is_some() { SRAA_JITTER } else { 1.0 };
        let last = BEFORE + self.references.len();
        let key = (100.0 * scale) as u32;
        if !self.motions.contains_key(&key) {
            let motions = self.draw_motions(scale, last)?;
            self.motions.insert(key, motions);
        }
        let mut scored = Vec::new();
        let mut mean = self.draw_frame(filter, method, 0, scale * taa::jitter(0))?;
        for frame in 1..last {
            let now = self.draw_frame(filter, method, frame, scale * taa::jitter(frame))?;
            mean = taa::accumulate(&mean, &now, &self.motions[&key][frame - 1]);
            if frame >= BEFORE {
                scored.push(mean.clone());
            }
        }
        Ok(scored)
    }

    /// Returns the motion from each frame to the one before, as the nearest surface around each pixel moves.
    fn draw_motions(&self, scale: f32, last: usize) -> Result<Vec<Frame<Vec2>>, QualityError> {
        let moment = |frame: usize| {
            let scene = self.motion.scene_at_frame(&self.scene, self.size, frame);
            Moment::draw(scene, self.size, scale * taa::jitter(frame), &[Vec2::ZERO], None)
        };
        let mut motions = Vec::new();
        let mut then = moment(0)?;
        for frame in 1..last {
            let now = moment(frame)?;
            // Into a raster that is moved by the jitter of then.
            let jitter = scale * taa::jitter(frame - 1);
            let texels = motion_vectors(&now, &then)?;
            let texels = texels
                .texels()
                .iter()
                .map(|motion| Vec2::new(motion.x, motion.y) + jitter);
            let motion = Frame::new(self.size, texels.collect());
            motions.push(taa::dilate(&motion, &now.capture().depth.layers()[1]));
            then = now;
        }
        Ok(motions)
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

/// Returns the metric by which a method's shading is placed; `None` at the centres of pixels.
fn placement(method: &Method) -> Result<Option<PlacedBy>, QualityError> {
    match method.shading_sample() {
        ShadingSample::Centre => Ok(None),
        ShadingSample::Placed => Ok(Some(method.placed_by())),
        _ => Err(QualityError::NotInMotion(method.name.clone())),
    }
}

/// Moves the rays through the pixels by `jitter`: those of a moved picture.
fn with_moved_rays(mut inputs: Inputs, capture: &Capture, jitter: Vec2) -> Inputs {
    if let Some([corner, right, down]) = capture.perspective_rays() {
        let moved = corner + jitter.x * right + jitter.y * down;
        for (_, numbers) in inputs.uniforms.iter_mut().filter(|(name, _)| name == "ray_corner") {
            *numbers = moved.to_array().map(f64::from).to_vec();
        }
    }
    inputs
}
