//! Quad filters on a rendered frame: every variant and transport, timed in turn against the variant that shares nothing
//! (Penner 2011; `docs/quads.md`).

mod families;
mod inputs;
mod subject;

use crate::progress::Progress;
use crate::record::{QuadWay, QuadsRecord};
use crate::statistics::{CONFIDENCE, Interval};
use crate::turns::run_in_turn;
use families::{FAMILIES, Source};
use glam::{UVec2, Vec4};
use inputs::{low_resolution, screen_inputs};
use std::time::Duration;
use straightline_bench::execute::{Bench, ExecuteError, Forward, Inputs, Shadowed, Work};
use straightline_codegen::Transport;
use straightline_codegen::diagnostic::Errors;
use straightline_kernels::prelude::Frame;
use straightline_manifest::Stage;
use straightline_runtime::Quads;
use straightline_scene::render::RenderError;
use straightline_scene::scene::Scene;
use subject::Subject;

/// Width and height of a quad, in pixels.
const QUAD: [u32; 2] = [2, 2];

/// Width and height of the row of quads that one invocation computes (§2.8), in pixels.
const ROW: [u32; 2] = [8, 2];

/// Setup of a study.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Width and height of the frame.
    pub size: UVec2,
    /// Texels of the shadow map, across and down.
    pub texels: u32,
    /// Rounds of timing.
    pub rounds: u32,
    /// Minimum time for one measurement of a shader.
    pub least: Duration,
}

/// Reason why the study of quads failed.
#[derive(Debug, thiserror::Error)]
pub enum QuadsError {
    /// The frame could not be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A shader could not be run.
    #[error(transparent)]
    Execute(#[from] ExecuteError),
    /// A filter could not be compiled.
    #[error(transparent)]
    Kernel(#[from] Errors),
    /// The layout of the device's quads could not be determined.
    #[error(transparent)]
    Detect(#[from] straightline_runtime::Error),
}

/// Measurements, and the pictures that were measured.
#[derive(Debug)]
pub struct Studied {
    /// Every variant with its measurements.
    pub ways: Vec<QuadWay>,
    /// Picture of each variant, in order.
    pub pictures: Vec<Frame<Vec4>>,
    /// The median time of the pass that draws coordinates.
    pub coordinates_ms: f64,
    /// Description of the device's quads.
    pub quads: String,
    /// Inputs of the shadow filters.
    pub shadowed: Shadowed,
    /// The frame and its occlusion at half the resolution, as the full-screen filters read them.
    pub screen: Inputs,
}

impl Studied {
    /// Returns the picture of a variant; `None` if there is no such variant.
    pub fn picture(&self, filter: &str, way: &str) -> Option<&Frame<Vec4>> {
        let mut ways = self.ways.iter().zip(&self.pictures);
        ways.find(|(of, _)| of.filter == filter && of.way == way)
            .map(|(_, picture)| picture)
    }

    /// Returns the record of the measurements.
    pub fn to_record(&self, circumstances: crate::record::Circumstances) -> QuadsRecord {
        QuadsRecord {
            circumstances,
            quads: self.quads.clone(),
            triangles: self.shadowed.corners.len() / 3,
            coordinates_ms: self.coordinates_ms,
            ways: self.ways.clone(),
        }
    }
}

/// Measures every variant of every filter, in one run.
///
/// # Errors
///
/// [`QuadsError`], if the device fails or lacks a feature.
pub fn study_quads(
    bench: &Bench,
    scene: &Scene,
    setup: &Setup,
    progress: &mut dyn Progress,
) -> Result<Studied, QuadsError> {
    let quads = Quads::detect(bench.device(), bench.queue())?;
    let chosen = match quads.choose() {
        Ok(transport) => format!("{transport:?}").to_lowercase(),
        Err(why) => why,
    };
    let described = format!(
        "derivatives {:?}, origin {:?}; chosen: {chosen}",
        quads.kind, quads.origin
    );
    let shadowed = Shadowed::new(bench, scene, setup.size, setup.texels, 9.0)?;
    let of_triangles = shadowed.kernel_inputs(bench)?;
    let screen = screen_inputs(bench, scene, setup.size)?;
    let half = low_resolution(bench, &screen, 2)?;
    let quarter = low_resolution(bench, &screen, 4)?;
    let mut subjects = Vec::new();
    for family in FAMILIES {
        let inputs = match family.from {
            Source::Frame => &half,
            Source::Quarter => &quarter,
            Source::Triangles => &of_triangles,
        };
        for (way, options) in family.ways {
            for transport in way_transports(way, quads.subgroup.is_some()) {
                subjects.push(Subject::new(
                    bench,
                    family,
                    way,
                    options,
                    (transport, QUAD),
                    inputs,
                    &shadowed,
                )?);
            }
            if family.from != Source::Triangles {
                let row = (Transport::Block, ROW);
                subjects.push(Subject::new(bench, family, way, options, row, inputs, &shadowed)?);
            }
        }
    }
    let coordinates = shadowed.coordinate_pass(bench)?;
    let rounds = time_subjects(bench, setup, &subjects, &coordinates, progress)?;
    // A forward pass only draws the pixels covered by the scene's triangles.
    let drawn = of_triangles.images.iter().find(|(name, _)| name == "coord");
    let covered: Option<Vec<bool>> =
        drawn.map(|(_, layers)| layers[0].texels().iter().map(|place| *place != Vec4::ZERO).collect());
    let covered = covered.as_deref();
    let (coordinates, rounds) = rounds
        .split_last()
        .map_or((&[][..], &[][..]), |(c, all)| (c.as_slice(), all));
    Ok(Studied {
        ways: build_ways(&subjects, rounds, coordinates, covered),
        pictures: subjects.into_iter().map(|subject| subject.image).collect(),
        coordinates_ms: median_or_zero(coordinates),
        quads: described,
        shadowed,
        screen: half,
    })
}

/// Returns the transports to measure. A variant that shares nothing has no communication, so one fragment shader and one
/// compute shader represent it.
fn way_transports(way: &str, subgroup: bool) -> Vec<Transport> {
    let alone = way == "naive" || way == "bilinear";
    let fragment = match subgroup {
        true => Transport::Subgroup,
        false => Transport::Derivatives,
    };
    match alone {
        true => vec![fragment, Transport::Block],
        false => Transport::ALL
            .into_iter()
            .filter(|t| subgroup || *t != Transport::Subgroup)
            .collect(),
    }
}

/// Returns the milliseconds of every round of each subject, and last of the pass that draws coordinates.
fn time_subjects(
    bench: &Bench,
    setup: &Setup,
    subjects: &[Subject],
    coordinates: &Forward,
    progress: &mut dyn Progress,
) -> Result<Vec<Vec<f64>>, ExecuteError> {
    progress.begin(&format!("timing {} shaders", subjects.len()), setup.rounds as usize);
    let works: Result<Vec<Work<'_>>, _> = subjects
        .iter()
        .map(|subject| subject.work(bench, setup))
        .chain([bench.draw_work(coordinates, setup.least)])
        .collect();
    let timed = run_in_turn(bench, &mut works?, setup.rounds, progress)?;
    Ok(timed.rounds_ms())
}

fn build_ways(
    subjects: &[Subject],
    rounds: &[Vec<f64>],
    coordinates: &[f64],
    covered: Option<&[bool]>,
) -> Vec<QuadWay> {
    // Time from triangles to picture in every variant: dispatched variants need the pass that draws coordinates.
    let whole = |k: usize| -> Vec<f64> {
        let needs = subjects[k].family.from == Source::Triangles && subjects[k].stage == Stage::Compute;
        let drawn = coordinates.iter().map(|ms| if needs { *ms } else { 0.0 });
        rounds[k].iter().zip(drawn).map(|(own, drawn)| own + drawn).collect()
    };
    let mut ways = Vec::new();
    for (k, subject) in subjects.iter().enumerate() {
        let same = |other: &Subject| other.family.name == subject.family.name;
        let first = subjects.iter().position(same).unwrap_or(k);
        let rounds_ms = whole(k);
        let Some(speedup) = Interval::of_ratio(&whole(first), &rounds_ms) else {
            continue;
        };
        let forward = subject.family.from == Source::Triangles;
        let covered = covered.filter(|_| forward);
        let (mean_difference, largest_difference) = color_differences(&subject.image, &subjects[first].image, covered);
        ways.push(QuadWay {
            filter: subject.family.name.to_owned(),
            way: subject.way.to_owned(),
            transport: subject.transport.clone(),
            hash: subject.hash.clone(),
            stage: subject.stage,
            forward,
            reads: subject.counts.texture_reads,
            messages: subject.counts.messages,
            statements: subject.counts.statements,
            median_ms: median_or_zero(&rounds_ms),
            rounds_ms,
            speedup,
            mean_difference,
            largest_difference,
        });
    }
    ways
}

fn median_or_zero(values: &[f64]) -> f64 {
    Interval::of_median(values, CONFIDENCE).map_or(0.0, |of| of.median)
}

/// Returns the mean and largest difference over all colours of the covered pixels; of all pixels without a coverage. A
/// pixel in full shadow is covered, and its colour is 0.
fn color_differences(a: &Frame<Vec4>, b: &Frame<Vec4>, covered: Option<&[bool]>) -> (f64, f64) {
    let pairs = a.texels().iter().zip(b.texels()).enumerate();
    let counted = pairs.filter(|(k, _)| covered.is_none_or(|covered| covered[*k]));
    let (mut sum, mut largest, mut count) = (0.0, 0.0f64, 0.0);
    for (_, (a, b)) in counted {
        let off = f64::from((a.truncate() - b.truncate()).abs().max_element());
        sum += off;
        count += 1.0;
        largest = largest.max(off);
    }
    (sum / f64::max(count, 1.0), largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shadows_count_and_what_is_not_drawn_does_not() {
        let frame = |values: [f32; 4]| Frame::new(glam::uvec2(4, 1), values.map(Vec4::splat).to_vec());
        // In the umbra one is 0 and the other is not; the last pixel is sky.
        let (a, b) = (frame([0.0, 0.5, 1.0, 0.0]), frame([0.25, 0.5, 1.0, 1.0]));
        let covered = [true, true, true, false];
        assert_eq!(color_differences(&a, &b, Some(&covered)), (0.25 / 3.0, 0.25));
        assert_eq!(color_differences(&a, &b, None), (1.25 / 4.0, 1.0));
    }
}
