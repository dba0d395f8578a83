//! Unrolled against looped: cost and error of every form of a kernel.
//!
//! All forms of a kernel are timed in turn, round by round. The speedup over the looped form is computed within each round,
//! so that a slowdown of a whole round cancels.

pub(crate) mod forms;
mod subjects;
pub(crate) mod truth;

use crate::progress::Progress;
use crate::record::{FormKind, FormRecord, KernelForms};
use crate::statistics::Interval;
use crate::turns::run_in_turn;
use forms::{Forms, Ready, Stand};
use glam::{UVec2, Vec4};
use std::time::Duration;
use straightline_bench::execute::{Bench, ExecuteError, Job};
use straightline_codegen::diagnostic::Errors;
use straightline_kernels::prelude::Frame;
use straightline_oracle::oracle::OracleError;
use straightline_scene::gbuffer::GBufferError;
use straightline_scene::render::RenderError;
use straightline_scene::scene::SceneError;
use truth::Truth;

pub use subjects::{ByHand, Input, Subject, list_subjects};

/// Setup of the measurements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setup {
    /// Width and height of the pictures.
    pub size: UVec2,
    /// Rounds of timing.
    pub rounds: u32,
    /// Minimum time of one measurement; faster forms are run several times in a row.
    pub least: Duration,
    /// Number of times that each pipeline is created.
    pub pipelines: u32,
}

/// Measurements of a kernel.
#[derive(Clone, Debug)]
pub struct Studied {
    /// Record of the forms.
    pub forms: KernelForms,
    /// The kernel's picture, unrolled.
    pub picture: Frame<Vec4>,
}

/// Reason why a study failed.
#[derive(Debug, thiserror::Error)]
pub enum LoopsError {
    /// A kernel, or its hand-written version, is invalid.
    #[error("the kernel `{name}` is refused")]
    Kernel {
        /// The kernel's name.
        name: String,
        /// Every error.
        errors: Errors,
    },
    /// A form cannot be run.
    #[error("`{name}`, {form}: {source}")]
    Form {
        /// The kernel's name.
        name: String,
        /// Name of the form, as in the record.
        form: String,
        /// Cause of the failure.
        source: Box<LoopsError>,
    },
    /// Execution failed.
    #[error(transparent)]
    Execute(#[from] ExecuteError),
    /// There is no such scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The scene cannot be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The scene lacks an input of the kernel.
    #[error(transparent)]
    GBuffer(#[from] GBufferError),
    /// The oracle lacks an input.
    #[error(transparent)]
    Oracle(#[from] OracleError),
    /// No form was measured.
    #[error("nothing was measured")]
    Nothing,
}

/// Measures the kernels one by one. Returns the results so far if `watch` stops the study.
///
/// # Errors
///
/// [`LoopsError`] names the kernel that is invalid or cannot be run. For a missing form, the record has the reason.
pub fn study_loops(
    bench: &Bench,
    subjects: &[Subject],
    setup: &Setup,
    progress: &mut dyn Progress,
) -> Result<Vec<Studied>, LoopsError> {
    let mut truth = Truth::new(bench, setup.size);
    let mut all = Vec::new();
    for subject in subjects {
        match measure_subject(bench, subject, setup, &mut truth, progress)? {
            Some(studied) => all.push(studied),
            None => break,
        }
    }
    Ok(all)
}

/// Measures one kernel; `None` if it was stopped before anything was measured.
fn measure_subject(
    bench: &Bench,
    subject: &Subject,
    setup: &Setup,
    truth: &mut Truth<'_>,
    progress: &mut dyn Progress,
) -> Result<Option<Studied>, LoopsError> {
    let half = bench.device().features().contains(wgpu::Features::SHADER_F16);
    let forms = Forms::from_subject(subject, half).map_err(|errors| LoopsError::Kernel {
        name: subject.name.clone(),
        errors,
    })?;
    progress.begin(&subject.name, forms.made.len() + 1 + setup.rounds as usize);
    let inputs = truth.inputs(subject, &forms.full)?;
    if progress.is_stopped() {
        return Ok(None);
    }
    let exact = truth::expected_colors(subject, &forms.full, &inputs)?;
    progress.step();

    let mut stand = Stand::new(bench, &inputs);
    let mut ready: Vec<(Ready, Option<(f64, f64)>)> = Vec::new();
    let mut picture = None;
    for (kind, compiled) in &forms.made {
        if progress.is_stopped() {
            return Ok(None);
        }
        let in_form = |source: LoopsError| LoopsError::Form {
            name: subject.name.clone(),
            form: crate::record::json_name(kind),
            source: Box::new(source),
        };
        let form = stand.prepare_form(*kind, compiled, setup.pipelines).map_err(in_form)?;
        let frame = bench.picture_of(&form.pass, &form.uploaded, setup.size)?;
        let off = (*kind != FormKind::Floor).then(|| truth::largest_differences(frame.texels(), &exact));
        if *kind == FormKind::Full {
            picture = Some(frame);
        }
        ready.push((form, off));
        progress.step();
    }

    let works = ready.iter().map(|(form, _)| {
        let job = Job {
            pass: &form.pass,
            uploaded: &form.uploaded,
            size: setup.size,
        };
        bench.job_work(job, setup.least)
    });
    let timed = run_in_turn(
        bench,
        &mut works.collect::<Result<Vec<_>, _>>()?,
        setup.rounds,
        progress,
    )?;
    let mut measured = Vec::new();
    for (k, (form, off)) in ready.iter().enumerate() {
        let (Some(looped), Some(time)) = (timed.times(0), timed.times(k)) else {
            continue;
        };
        let Some(ratio) = Interval::of_ratio(&looped.rounds_ms, &time.rounds_ms) else {
            continue;
        };
        let counts = &form.emitted.manifest.counts;
        measured.push(FormRecord {
            kind: form.kind,
            hash: form.hash(),
            loops: counts.loops,
            statements: counts.statements,
            reads: counts.reads.values().sum(),
            spirv_bytes: form.spirv_bytes(),
            pipeline_ms: form.pipeline_ms(time.median_ms),
            time,
            ratio,
            difference_999: off.map(|(_, most)| most),
            difference: off.map(|(largest, _)| largest),
        });
    }
    let forms = KernelForms {
        kernel: subject.name.clone(),
        options: subject.options.clone(),
        input: truth::input_name(subject, &forms.full, &inputs),
        forms: measured,
        absent: forms.absent,
    };
    let picture = picture.ok_or(LoopsError::Nothing)?;
    Ok(Some(Studied { forms, picture }))
}
