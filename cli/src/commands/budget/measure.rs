//! Timing of a frame's passes and SRAA's filters, interleaved in one run.

use super::frame;
use crate::args::BudgetArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use serde::Serialize;
use std::time::Duration;
use straightline_bench::execute::{Bench, Clock, Job, Uploaded, Work, next_timestamps};
use straightline_codegen::{Compiled, Kernel, Settings};
use straightline_manifest::Stage;
use straightline_runtime::Pass;
use straightline_scene::render::{FramePass, FramePasses, GpuRenderer, Samples};
use straightline_scene::scene::Scene;
use straightline_scene::{gbuffer, render};
use straightline_study::progress::Progress;
use straightline_study::statistics::Interval;
use straightline_study::turns::run_in_turn;

/// The paper's table 1: milliseconds at 1280×720 with 4 samples on a GeForce GTX 480.
const METRICS: [(&str, f64); 4] = [
    ("planes-normals", 1.86),
    ("depth-normals", 1.14),
    ("normals", 0.95),
    ("depth", 0.55),
];

/// Metric of SRAA by default.
pub const DEFAULT_METRIC: &str = "depth-normals";

/// Sample positions of geometry and shading for the timed filters. With `sample0` only the default metric is timed.
const PLACES: [(&str, &str, Samples); 3] = [
    ("latin4", "centre", Samples::Four),
    ("latin4", "sample0", Samples::Three),
    ("latin16", "centre", Samples::Sixteen),
];

/// The timed passes and their names.
const PASSES: [(&str, FramePass); 13] = [
    ("main G-buffer", FramePass::Geometry(Samples::One)),
    ("main G-buffer", FramePass::Geometry(Samples::Four)),
    ("main G-buffer", FramePass::Geometry(Samples::Sixteen)),
    ("depth and normals", FramePass::Auxiliary(Samples::Three)),
    ("depth and normals", FramePass::Auxiliary(Samples::Four)),
    ("depth and normals, multisampled", FramePass::AuxiliaryMultisampled),
    ("depth and normals", FramePass::Auxiliary(Samples::Sixteen)),
    ("deferred shading", FramePass::Shading(Samples::One)),
    ("deferred shading", FramePass::Shading(Samples::Four)),
    ("deferred shading", FramePass::Shading(Samples::Sixteen)),
    ("box filter", FramePass::Resolve(Samples::Four)),
    ("box filter", FramePass::Resolve(Samples::Sixteen)),
    ("forward, multisampled, shaded and resolved", FramePass::Forward),
];

/// Time of one part of a frame.
#[derive(Clone, Debug, Serialize)]
pub struct PassTime {
    #[serde(skip)]
    pub pass: FramePass,
    pub name: &'static str,
    /// Samples of each pixel.
    pub samples: u32,
    /// Number of render or compute passes.
    pub passes: u32,
    pub ms: Interval,
    pub rounds_ms: Vec<f64>,
}

/// Time of one filter.
#[derive(Clone, Debug, Serialize)]
pub struct Filter {
    pub metric: &'static str,
    pub pattern: &'static str,
    /// Position of the shading sample in the pixel.
    pub shading: &'static str,
    /// Samples drawn in addition to the main G-buffer.
    #[serde(skip)]
    pub samples: Samples,
    pub reads: u32,
    pub ms: Interval,
    /// Median time relative to the default metric with shading at the centre.
    pub ratio: f64,
    /// Value of this ratio in the paper.
    pub paper_ratio: Option<f64>,
    /// Milliseconds of shading once a pixel above which SRAA, its geometry included, is cheaper than shading as many
    /// samples.
    pub break_even_ms: Interval,
    pub rounds_ms: Vec<f64>,
}

/// All measurements.
#[derive(Clone, Debug)]
pub struct Measured {
    pub passes: Vec<PassTime>,
    pub filters: Vec<Filter>,
    pub together: Option<Together>,
}

/// A whole frame in one submission, which switches between graphics and compute as its passes need.
#[derive(Clone, Debug, Serialize)]
pub struct Together {
    /// Method that renders the frame.
    pub method: &'static str,
    pub ms: Interval,
    /// Time relative to the sum of its parts, each submitted on its own; round by round.
    pub over_parts: Interval,
    pub rounds_ms: Vec<f64>,
}

/// Passes timed together in one submission.
const TOGETHER: [FramePass; 3] = [
    FramePass::Geometry(Samples::One),
    FramePass::Auxiliary(Samples::Four),
    FramePass::Shading(Samples::One),
];

impl Measured {
    /// Returns the rounds of a pass, in milliseconds.
    pub fn pass_time(&self, pass: FramePass) -> Result<&PassTime, Failure> {
        let found = self.passes.iter().find(|timed| timed.pass == pass);
        found.ok_or_else(|| Failure::Failed(format!("{pass:?} was not timed")))
    }

    /// Returns the filter with the default metric for this many samples beside the main G-buffer.
    pub fn default_filter(&self, samples: Samples) -> Result<&Filter, Failure> {
        let mut filters = self.filters.iter();
        let found = filters.find(|filter| filter.samples == samples && filter.metric == DEFAULT_METRIC);
        found.ok_or_else(|| Failure::Failed(format!("no filter with {samples:?} was timed")))
    }
}

/// A filter and its inputs.
struct Subject {
    metric: &'static str,
    paper_ms: f64,
    pattern: &'static str,
    shading: &'static str,
    samples: Samples,
    compiled: Compiled,
    pass: Pass,
    uploaded: Uploaded,
}

impl Subject {
    fn job(&self, args: &BudgetArgs) -> Job<'_> {
        Job {
            pass: &self.pass,
            uploaded: &self.uploaded,
            size: args.size,
        }
    }
}

/// Times everything in turn, after one uncounted warm-up round.
pub fn measure_passes(
    args: &BudgetArgs,
    world: &Scene,
    gpu: &Gpu,
    progress: &mut dyn Progress,
) -> Result<Measured, Failure> {
    let bench = gpu.bench();
    let frame =
        FramePasses::new(&gpu.device, &gpu.queue, world, args.size, args.shading_cost).map_err(Failure::from_error)?;
    let subjects = prepare_subjects(args, world, gpu, &bench)?;
    let mut works: Vec<Work<'_>> = Vec::new();
    for (_, pass) in PASSES {
        let frame = &frame;
        let work = bench.recorded_work(pass.pass_count(), Duration::ZERO, move |encoder, timer| {
            frame.encode(pass, encoder, &next_timestamps(timer, pass.pass_count())?);
            Ok(())
        });
        works.push(work.map_err(Failure::from_error)?);
    }
    for subject in &subjects {
        works.push(
            bench
                .job_work(subject.job(args), Duration::ZERO)
                .map_err(Failure::from_error)?,
        );
    }
    let is_first = |subject: &&Subject| subject.metric == DEFAULT_METRIC && subject.shading == "centre";
    let first = subjects.iter().find(is_first).map(|subject| subject.job(args));
    // Timestamps surround single passes and omit the time between them.
    if let Some(job) = first.filter(|_| bench.clock() == Clock::WallClock) {
        let filter = bench.pass_recorder(job).map_err(Failure::from_error)?;
        let frame = &frame;
        let work = bench.recorded_work(1, Duration::ZERO, move |encoder, _| {
            for pass in TOGETHER {
                frame.encode(pass, encoder, &[]);
            }
            filter(encoder);
            Ok(())
        });
        works.push(work.map_err(Failure::from_error)?);
    }
    progress.begin(&format!("timing {} passes", works.len()), args.rounds as usize);
    let timed = run_in_turn(&bench, &mut works, args.rounds, progress).map_err(Failure::from_error)?;
    drop(works);
    let mut rounds = timed.rounds_ms().into_iter();
    let mut passes = Vec::new();
    for ((name, pass), rounds_ms) in PASSES.into_iter().zip(rounds.by_ref()) {
        passes.push(PassTime {
            pass,
            name,
            samples: sample_count(pass),
            passes: pass.pass_count(),
            ms: frame::find_interval(&rounds_ms)?,
            rounds_ms,
        });
    }
    let mut measured = Measured {
        passes,
        filters: Vec::new(),
        together: None,
    };
    for (subject, rounds_ms) in subjects.iter().zip(rounds.by_ref()) {
        let filter = filter_time(&measured, subject, rounds_ms)?;
        measured.filters.push(filter);
    }
    if let Some(rounds_ms) = rounds.next() {
        measured.together = Some(whole_frame_time(&measured, rounds_ms)?);
    }
    for (pattern, _, samples) in PLACES.into_iter().filter(|(_, shading, _)| *shading == "centre") {
        let base = measured.default_filter(samples)?.ms.median;
        for filter in measured.filters.iter_mut().filter(|filter| filter.pattern == pattern) {
            filter.ratio = filter.ms.median / base;
        }
    }
    Ok(measured)
}

fn whole_frame_time(measured: &Measured, rounds_ms: Vec<f64>) -> Result<Together, Failure> {
    let mut parts = vec![0.0; rounds_ms.len()];
    let filter = &measured.default_filter(Samples::Four)?.rounds_ms;
    for pass in TOGETHER {
        let rounds = &measured.pass_time(pass)?.rounds_ms;
        parts.iter_mut().zip(rounds).for_each(|(sum, part)| *sum += part);
    }
    let sums = parts.iter().zip(filter).map(|(sum, part)| sum + part);
    let ratios: Vec<f64> = rounds_ms.iter().zip(sums).map(|(whole, parts)| whole / parts).collect();
    Ok(Together {
        method: "SRAA 4",
        ms: frame::find_interval(&rounds_ms)?,
        over_parts: frame::find_interval(&ratios)?,
        rounds_ms,
    })
}

fn sample_count(pass: FramePass) -> u32 {
    match pass {
        FramePass::Geometry(samples)
        | FramePass::Auxiliary(samples)
        | FramePass::Shading(samples)
        | FramePass::Resolve(samples) => samples.count(),
        FramePass::AuxiliaryMultisampled | FramePass::Forward => 4,
    }
}

fn filter_time(measured: &Measured, subject: &Subject, rounds_ms: Vec<f64>) -> Result<Filter, Failure> {
    let counts = &subject.compiled.counts;
    let four = matches!(subject.samples, Samples::Four);
    Ok(Filter {
        metric: subject.metric,
        pattern: subject.pattern,
        shading: subject.shading,
        samples: subject.samples,
        reads: counts.texture_reads + counts.colour_reads,
        ms: frame::find_interval(&rounds_ms)?,
        ratio: 1.0,
        paper_ratio: four.then_some(subject.paper_ms / METRICS[1].1),
        break_even_ms: frame::break_even(measured, subject.samples, &rounds_ms)?,
        rounds_ms,
    })
}

fn prepare_subjects(args: &BudgetArgs, world: &Scene, gpu: &Gpu, bench: &Bench) -> Result<Vec<Subject>, Failure> {
    let renderer = GpuRenderer::new(&gpu.device, &gpu.queue, world, args.size).map_err(Failure::from_error)?;
    let mut subjects = Vec::new();
    for (pattern, shading, samples) in PLACES {
        let offsets = scene::sample_offsets(pattern)?;
        let capture = render::capture_scene(&renderer, &offsets, scene::parse_shading(shading, &[])?)
            .map_err(Failure::from_error)?;
        for (metric, paper_ms) in METRICS {
            if samples == Samples::Three && metric != DEFAULT_METRIC {
                continue;
            }
            let settings = Settings::new()
                .set("pattern", pattern)
                .set("metric", metric)
                .set("shading", shading);
            let compiled = Kernel::builtin("sraa")?.compile(&settings)?;
            let inputs = gbuffer::sraa_inputs(&capture, &compiled.options).map_err(Failure::from_error)?;
            let (pass, manifest) = bench
                .compile_pass(&compiled, Stage::Compute)
                .map_err(Failure::from_error)?;
            let uploaded = bench.upload(&manifest, &inputs).map_err(Failure::from_error)?;
            subjects.push(Subject {
                metric,
                paper_ms,
                pattern,
                shading,
                samples,
                compiled,
                pass,
                uploaded,
            });
        }
    }
    Ok(subjects)
}
