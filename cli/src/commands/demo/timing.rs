//! Runs and times of the demo's frames.

use super::{Filtered, Method};
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use glam::{UVec2, Vec4};
use std::time::{Duration, Instant};
use straightline_bench::execute::{Clock, ExecuteError, Job, Times, Uploaded, Work, interpret_kernel, next_timestamps};
use straightline_kernels::prelude::Frame;
use straightline_manifest::Stage;
use straightline_runtime::Pass;
use straightline_scene::render::{FramePass, FramePasses, Samples};
use straightline_scene::scene::Scene;

/// Time after which no further round begins: a software driver takes seconds for one.
const BUDGET: Duration = Duration::from_secs(10);

/// Passes of a frame, without filters.
const PASSES: [FramePass; 7] = [
    FramePass::Geometry(Samples::One),
    FramePass::Shading(Samples::One),
    FramePass::Auxiliary(Samples::Four),
    FramePass::Auxiliary(Samples::Sixteen),
    FramePass::Geometry(Samples::Sixteen),
    FramePass::Shading(Samples::Sixteen),
    FramePass::Resolve(Samples::Sixteen),
];

/// Passes of a frame without antialiasing, and supersampled.
const PLAIN: [FramePass; 2] = [FramePass::Geometry(Samples::One), FramePass::Shading(Samples::One)];
const SUPERSAMPLED: [FramePass; 3] = [
    FramePass::Geometry(Samples::Sixteen),
    FramePass::Shading(Samples::Sixteen),
    FramePass::Resolve(Samples::Sixteen),
];

/// Times of all frames.
pub struct Measured {
    pub clock: Clock,
    /// Milliseconds of a frame; `None` without a GPU.
    pub plain_ms: Option<f64>,
    pub supersampled_ms: Option<f64>,
    pub methods: Vec<MethodTimes>,
}

/// Times of a method.
pub struct MethodTimes {
    pub looped: Times,
    pub unrolled: Times,
    /// Milliseconds of a frame with the unrolled filter; `None` without a GPU.
    pub frame_ms: Option<f64>,
}

/// Runs a method's filter, on the GPU or else in the interpreter. Returns its picture and the time of all.
pub fn run(gpu: Option<&Gpu>, method: &Method) -> Result<(Frame<Vec4>, Duration), Failure> {
    let start = Instant::now();
    let (kernel, inputs) = (&method.unrolled, &method.inputs);
    let picture = match gpu {
        Some(gpu) => gpu.bench().run(kernel, Stage::Compute, inputs),
        None => interpret_kernel::<f32>(kernel, inputs, false).map(|texels| texels.frame(inputs)),
    };
    Ok((picture.map_err(Failure::from_error)?, start.elapsed()))
}

/// Times the filters, looped and unrolled, and the passes of each frame, in turn.
pub fn time_frames(
    gpu: &Gpu,
    world: &Scene,
    size: UVec2,
    filtered: &[Filtered],
    rounds: u32,
) -> Result<Measured, Failure> {
    let bench = gpu.bench();
    let frame = FramePasses::new(&gpu.device, &gpu.queue, world, size, 1).map_err(Failure::from_error)?;
    let prepare = |(compiled, method): (_, &Method)| -> Result<(Pass, Uploaded), ExecuteError> {
        let (pass, manifest) = bench.compile_pass(compiled, Stage::Compute)?;
        let uploaded = bench.upload(&manifest, &method.inputs)?;
        Ok((pass, uploaded))
    };
    let methods = filtered.iter().map(|of| &of.method);
    let filters = methods
        .clone()
        .flat_map(|method| [(&method.looped, method), (&method.unrolled, method)]);
    let filters = filters
        .map(prepare)
        .collect::<Result<Vec<_>, _>>()
        .map_err(Failure::from_error)?;
    let mut works: Vec<Work<'_>> = Vec::new();
    for (pass, uploaded) in &filters {
        let job = Job { pass, uploaded, size };
        works.push(bench.job_work(job, Duration::ZERO).map_err(Failure::from_error)?);
    }
    for pass in PASSES {
        let frame = &frame;
        let work = bench.recorded_work(pass.pass_count(), Duration::ZERO, move |encoder, timer| {
            frame.encode(pass, encoder, &next_timestamps(timer, pass.pass_count())?);
            Ok(())
        });
        works.push(work.map_err(Failure::from_error)?);
    }
    let bar = scene::progress_bar(&format!("timing {} passes", works.len()));
    bar.set_length(u64::from(rounds));
    let start = Instant::now();
    let timed = bench.in_turn(&mut works, rounds, |round| {
        bar.set_position(u64::from(round));
        round == 0 || start.elapsed() < BUDGET
    });
    let timed = timed.map_err(Failure::from_error)?;
    bar.finish_and_clear();
    let times = timed.rounds.iter().map(|times| Times::from_durations(times));
    let times: Option<Vec<Times>> = times.collect();
    let times = times.ok_or_else(|| Failure::Failed("nothing was timed".to_owned()))?;
    let (filters, passes) = times.split_at(2 * filtered.len());
    let sum = |of: &[FramePass]| -> f64 {
        let medians = PASSES.iter().zip(passes).filter(|(pass, _)| of.contains(pass));
        medians.map(|(_, times)| times.median_ms).sum()
    };
    let (filters, _) = filters.as_chunks::<2>();
    let methods = methods.zip(filters).map(|(method, [looped, unrolled])| MethodTimes {
        frame_ms: Some(sum(&PLAIN) + sum(&[FramePass::Auxiliary(method.samples)]) + unrolled.median_ms),
        looped: looped.clone(),
        unrolled: unrolled.clone(),
    });
    Ok(Measured {
        clock: timed.clock,
        plain_ms: Some(sum(&PLAIN)),
        supersampled_ms: Some(sum(&SUPERSAMPLED)),
        methods: methods.collect(),
    })
}

/// Times of the interpreter, of one run each: it is there to show the result, not to be timed.
pub fn time_interpreter(filtered: &[Filtered]) -> Result<Measured, Failure> {
    let once = |took| Times::from_durations(&[took]).ok_or_else(|| Failure::Failed("nothing was timed".to_owned()));
    let methods = filtered.iter().map(|Filtered { method, took, .. }| {
        let start = Instant::now();
        interpret_kernel::<f32>(&method.looped, &method.inputs, false).map_err(Failure::from_error)?;
        Ok(MethodTimes {
            looped: once(start.elapsed())?,
            unrolled: once(*took)?,
            frame_ms: None,
        })
    });
    Ok(Measured {
        clock: Clock::WallClock,
        plain_ms: None,
        supersampled_ms: None,
        methods: methods.collect::<Result<_, Failure>>()?,
    })
}
