//! Antialiasing methods against references of 256 samples a pixel: error by class of pixels, cost, and the causes of SRAA's
//! gap to supersampling.
//!
//! All pictures, including the reference, are compared as displayed: at 8 bits of sRGB ([`picture::at_eight_bits`]), in
//! whatever precision they were computed.

mod bounds;
mod classes;
mod error;
mod figures;
mod film;
mod filters;
mod losses;
mod methods;
mod motion;
mod pan;
mod post;
pub mod resolves;
mod scores;
mod sequence;
mod shot;
mod surfaces;
mod taa;
#[cfg(test)]
mod tests;

use crate::progress::Progress;
use crate::record::SceneErrors;
use classes::{Classes, varies_around, varies_within};
use filters::Filters;
use glam::{UVec2, Vec2, Vec4};
use rayon::prelude::*;
use scores::{measure_gaps, score_picture, share_of_gap};
use shot::render_supersampled;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use straightline_bench::execute::{Bench, Times};
use straightline_kernels::prelude::Frame;
use straightline_scene::capture::Capture;
use straightline_scene::picture;
use straightline_scene::render::{Extra, GpuRenderer};
use straightline_scene::scene::{Camera, Scene};

pub use classes::STEP;
pub use error::QualityError;
pub use figures::{FIGURES, Figure, Made, Pane};
pub use film::{Film, REFERENCE, Shooting, film_scene};
pub use losses::list_losses;
pub use methods::{Method, MethodKind, OwnError, list_methods, methods_of, preset_names};
pub use motion::{in_motion, methods_in_motion};
pub use sequence::{BEFORE, Sequence};
pub use shot::Shot;
pub use surfaces::{Point, Surfaces};

/// Side of the grid of shading samples of a reference: 256x.
const SIDE: u32 = 16;

/// Scene or capture that methods are compared on.
pub enum Source {
    /// A scene to be drawn.
    Scene {
        /// Name for display and for file names.
        name: String,
        /// Purpose of the scene.
        purpose: String,
        /// The scene.
        scene: Box<Scene>,
    },
    /// A capture with a reference.
    Capture {
        /// Name for display and for file names.
        name: String,
        /// The capture.
        capture: Box<Capture>,
    },
}

impl Source {
    /// Returns the width and height of the source's pictures in pixels; scenes are drawn at `drawn`.
    pub fn size(&self, drawn: UVec2) -> UVec2 {
        match self {
            Source::Scene { .. } => drawn,
            Source::Capture { capture, .. } => capture.size,
        }
    }
}

/// Extent of the study.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Width and height of drawn scenes, in pixels.
    pub size: UVec2,
    /// Rounds of timing.
    pub rounds: u32,
    /// `true` for a smaller set of methods.
    pub quick: bool,
    /// Names of the methods to study; empty for all.
    pub only: Vec<String>,
    /// Additional methods of the user.
    pub own: Vec<Method>,
    /// Frames of the pan; 0 for none.
    pub pan_frames: u32,
    /// Number of scenes with a pan and times, from the first.
    pub timed_scenes: usize,
    /// `true` if bloom and tone mapping are applied. Methods that read geometry or samples run before them, filters of the
    /// displayed picture after; some of the former also run after.
    pub post_processed: bool,
    /// `true` if pictures are written.
    pub pictures: bool,
}

/// Result of the study.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Errors for each finished source.
    pub scenes: Vec<SceneErrors>,
    /// Devices on which filters were timed.
    pub timed_on: Vec<String>,
    /// Pictures as PNG files, by their paths beside the record: `pictures/SCENE/METHOD.png`.
    pub pictures: BTreeMap<String, Vec<u8>>,
    /// `true` if all sources were finished.
    pub complete: bool,
}

/// Compares all methods on all sources. Finished sources are kept if `progress` requests a stop.
///
/// # Errors
///
/// [`QualityError`], if something cannot be drawn, run or written.
pub fn study_quality(
    bench: &Bench,
    sources: Vec<Source>,
    setup: &Setup,
    progress: &mut dyn Progress,
) -> Result<Outcome, QualityError> {
    let mut outcome = Outcome::default();
    match study_sources(bench, sources, setup, progress, &mut outcome) {
        Ok(()) => outcome.complete = true,
        Err(QualityError::Stopped) => {}
        Err(error) => return Err(error),
    }
    Ok(outcome)
}

fn study_sources(
    bench: &Bench,
    sources: Vec<Source>,
    setup: &Setup,
    progress: &mut dyn Progress,
    outcome: &mut Outcome,
) -> Result<(), QualityError> {
    let mut listed = list_methods(setup.quick && setup.only.is_empty());
    if !setup.only.is_empty() {
        listed.retain(|method| setup.only.contains(&method.name));
    }
    listed.extend(setup.own.iter().cloned());
    if setup.post_processed {
        listed.extend(post::the_other_order());
    }
    progress.begin("speed against error", count_steps(&sources, &listed, setup));
    let drawn = sources.iter().filter_map(|source| match source {
        Source::Scene { scene, .. } => Some(scene.camera),
        Source::Capture { .. } => None,
    });
    let of_camera =
        |camera: &Camera| -> Vec<Method> { listed.iter().map(|method| method.for_camera(camera)).collect() };
    let methods: BTreeMap<_, _> = drawn
        .map(|camera| (projection_of(&camera), of_camera(&camera)))
        .collect();
    let mut compiled = BTreeMap::new();
    let mut seen = 0;
    for source in sources {
        match source {
            Source::Scene { name, purpose, scene } => {
                let projection = projection_of(&scene.camera);
                let listed = &methods[&projection];
                let filters = match compiled.entry(projection) {
                    Entry::Occupied(filters) => filters.into_mut(),
                    Entry::Vacant(place) => place.insert(Filters::new(bench, listed, setup.size, progress)?),
                };
                let renderer = GpuRenderer::new(bench.device(), bench.queue(), &scene, setup.size)?;
                let shot = Shot::draw(&renderer, &listed.iter().collect::<Vec<_>>(), progress)?;
                let reference = render_supersampled(&renderer, SIDE, Vec2::ZERO, progress)?;
                let made = &mut outcome.pictures;
                let wanted = Wanted {
                    name,
                    purpose,
                    setup,
                    made,
                };
                let mut errors = wanted.measure_errors(listed, filters, &shot, &reference, progress)?;
                let is_timed = seen < setup.timed_scenes;
                seen += 1;
                if is_timed && setup.pan_frames > 1 {
                    let found = pan::measure_pan(&renderer, listed, filters, setup.pan_frames, progress)?;
                    for (method, temporal) in errors.methods.iter_mut().zip(found) {
                        method.temporal = temporal;
                    }
                }
                if is_timed {
                    let times = time_methods(filters, &shot, setup, progress)?;
                    outcome.timed_on.push(errors.scene.clone());
                    put_times(&mut errors, &times);
                }
                outcome.scenes.push(errors);
            }
            Source::Capture { name, capture } => {
                let errors = of_capture(bench, name, *capture, setup, &mut outcome.pictures, progress)?;
                outcome.timed_on.push(errors.scene.clone());
                outcome.scenes.push(errors);
            }
        }
    }
    Ok(())
}

fn of_capture(
    bench: &Bench,
    name: String,
    capture: Capture,
    setup: &Setup,
    made: &mut BTreeMap<String, Vec<u8>>,
    progress: &mut dyn Progress,
) -> Result<SceneErrors, QualityError> {
    let (mut listed, absent) = methods_of(&capture);
    listed.extend(setup.own.iter().map(|method| method.for_capture(&capture)));
    let Some(reference) = capture.reference.clone() else {
        return Err(QualityError::Capture(format!(
            "`{name}` has no reference.exr, so nothing can be said of errors: write one, shaded at many places of each pixel \
             (docs/captures.md); `straightline capture --reference 256` does"
        )));
    };
    let mut filters = Filters::new(bench, &listed, capture.size, progress)?;
    let wanted = Wanted {
        name,
        purpose: "a capture".to_owned(),
        setup,
        made,
    };
    let shot = Shot::from_capture(capture);
    let mut errors = wanted.measure_errors(&listed, &mut filters, &shot, &reference, progress)?;
    errors.absent = absent;
    let times = time_methods(&mut filters, &shot, setup, progress)?;
    put_times(&mut errors, &times);
    Ok(errors)
}

/// Returns the part of a camera that options of methods depend on, in a form that can be compared.
fn projection_of(camera: &Camera) -> Option<u32> {
    camera.parallel_height.map(f32::to_bits)
}

/// Counts the steps of `progress`.
fn count_steps(sources: &[Source], listed: &[Method], setup: &Setup) -> usize {
    let projections = sources.iter().filter_map(|source| match source {
        Source::Scene { scene, .. } => Some(projection_of(&scene.camera)),
        Source::Capture { .. } => None,
    });
    let (drawn, projections) = (projections.clone().count(), projections.collect::<BTreeSet<_>>());
    let timing = setup.rounds as usize;
    let mut steps = projections.len() * listed.len();
    if drawn > 0 {
        steps += drawn * (SIDE as usize + listed.len()) + drawn.min(setup.timed_scenes) * timing;
        if setup.pan_frames > 1 {
            steps += drawn.min(setup.timed_scenes) * setup.pan_frames as usize * (pan::SIDE as usize + 1);
        }
    }
    for source in sources {
        if let Source::Capture { capture, .. } = source {
            steps += 2 * (methods_of(capture).0.len() + setup.own.len()) + timing;
        }
    }
    steps
}

/// Methods whose pictures are in memory at once, to be scored on all processors.
const AT_ONCE: usize = 16;

/// Request to study one source.
struct Wanted<'a> {
    name: String,
    purpose: String,
    setup: &'a Setup,
    /// Map that receives the source's pictures.
    made: &'a mut BTreeMap<String, Vec<u8>>,
}

impl Wanted<'_> {
    fn measure_errors(
        mut self,
        listed: &[Method],
        filters: &mut Filters<'_>,
        shot: &Shot,
        reference: &Frame<Vec4>,
        progress: &mut dyn Progress,
    ) -> Result<SceneErrors, QualityError> {
        let classes = classify_pixels(shot)?;
        let post_processed = self.setup.post_processed;
        let reference = &picture::at_eight_bits(&match post_processed {
            true => post::post_process(reference),
            false => reference.clone(),
        });
        let late = post_processed.then(|| shot.post_process());
        let bytes = filters.traffic_bytes(shot)?;
        let shown = self.encode_picture(reference)?;
        let mut errors = SceneErrors {
            reference: self.keep_picture("reference", shown),
            shares: classes.shares(),
            methods: Vec::new(),
            absent: Vec::new(),
            gaps: Vec::new(),
            scene: self.name.clone(),
            purpose: self.purpose.clone(),
        };
        let mut reconstructed = Vec::new();
        for (group, methods) in listed.chunks(AT_ONCE).enumerate() {
            let mut made = Vec::new();
            for (k, method) in methods.iter().enumerate() {
                check_stopped(progress)?;
                let k = group * AT_ONCE + k;
                made.push(picture::at_eight_bits(&match &late {
                    None => filters.filter_shot(k, shot)?,
                    Some(late) if method.is_last() => filters.filter_shot(k, late)?,
                    Some(_) => post::post_process(&filters.filter_shot(k, shot)?),
                }));
                progress.step();
            }
            let scored = methods.par_iter().zip(&made).map(|(method, made)| {
                let png = if method.pictured {
                    self.encode_picture(made)?
                } else {
                    None
                };
                Ok((score_picture(method, made, reference, &classes), png))
            });
            let scored: Vec<_> = scored.collect::<Result<_, QualityError>>()?;
            for ((method, made), (mut scores, png)) in methods.iter().zip(made).zip(scored) {
                scores.picture = self.keep_picture(&method.file_stem(), png);
                errors.methods.push(scores);
                if method.explained {
                    reconstructed.push(made);
                }
            }
        }
        for ((scores, method), bytes) in errors.methods.iter_mut().zip(listed).zip(bytes) {
            (scores.bytes, scores.extra) = (bytes, shot.extra_for(method).map(Extra::share));
        }
        share_of_gap(&mut errors.methods);
        if let [four, sixteen] = &reconstructed[..]
            && !shot.shaded.is_empty()
            && !post_processed
        {
            errors.gaps = measure_gaps(shot, [four, sixteen], reference, &classes)?;
        }
        Ok(errors)
    }

    /// Returns a picture as a PNG file, if pictures are requested.
    fn encode_picture(&self, frame: &Frame<Vec4>) -> Result<Option<Vec<u8>>, QualityError> {
        Ok(match self.setup.pictures {
            true => Some(picture::png_bytes(frame)?),
            false => None,
        })
    }

    /// Stores a picture, and returns its path beside the record.
    fn keep_picture(&mut self, stem: &str, png: Option<Vec<u8>>) -> Option<String> {
        let path = format!("pictures/{}/{stem}.png", methods::to_file_stem(&self.name));
        self.made.insert(path.clone(), png?);
        Some(path)
    }
}

/// Classifies pixels by all available geometry.
fn classify_pixels(shot: &Shot) -> Result<Classes, QualityError> {
    let dense: Vec<&Capture> = match shot.captures.get("latin16") {
        Some(latin16) => std::iter::once(latin16).chain(shot.captures.get("latin4")).collect(),
        None => vec![shot.any_capture()?],
    };
    let surfaces = Surfaces::from_captures(&dense).ok_or_else(|| QualityError::NotDrawn("any method".to_owned()))?;
    let varies = match shot.shaded.get(&16) {
        Some(shaded) => varies_within(shaded),
        None => varies_around(&shot.any_capture()?.color, &surfaces),
    };
    Ok(Classes::new(&surfaces, &varies))
}

fn time_methods(
    filters: &mut Filters<'_>,
    shot: &Shot,
    setup: &Setup,
    progress: &mut dyn Progress,
) -> Result<Vec<Option<Times>>, QualityError> {
    let (timed, places) = filters.time_filters(shot, setup.rounds, progress)?;
    check_stopped(progress)?;
    let times = places.into_iter().map(|place| place.and_then(|k| timed.times(k)));
    Ok(times.collect())
}

fn put_times(errors: &mut SceneErrors, times: &[Option<Times>]) {
    for (method, time) in errors.methods.iter_mut().zip(times) {
        method.time = time.clone();
    }
}

/// Ends the study if `progress` requests a stop.
fn check_stopped(progress: &dyn Progress) -> Result<(), QualityError> {
    match progress.is_stopped() {
        true => Err(QualityError::Stopped),
        false => Ok(()),
    }
}
