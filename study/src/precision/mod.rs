//! Search for values of a kernel that may be computed in half precision: those that make it cheapest on GPUs while its error
//! keeps a bound.
//!
//! A choice is judged by two oracles that know nothing of each other: the interpreter computes its error against `f64`, and
//! vendors' compilers state its cost. A single value rarely pays, since each conversion costs an instruction, and all
//! values often lose too much. So the search begins with all and takes away.

mod search;

pub use search::Found;

use crate::loops::truth::largest_differences;
use crate::progress::Progress;
use crate::record::{Lowered, MachineFigures};
use glam::Vec4;
use search::Choice;
use std::collections::BTreeMap;
use straightline_bench::execute::{ExecuteError, Inputs, interpret_kernel};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Kernel, Settings, passes};
use straightline_isa::{Compiler, IsaError};
use straightline_kernels::prelude::Frame;

/// Brightness at which a value must still be finite.
const BRIGHT: f32 = 64.0;

/// Why a search has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrecisionError {
    /// The kernel cannot be run on the inputs, or not be emitted.
    #[error(transparent)]
    Execute(#[from] ExecuteError),
    /// A compiler ended.
    #[error(transparent)]
    Compiler(#[from] IsaError),
    /// A compiler has no figures for the kernel in full precision.
    #[error("{gpu}: {why}")]
    NoFigures {
        /// The GPU.
        gpu: String,
        /// Reason.
        why: String,
    },
    /// Nothing can be lowered.
    #[error("`{0}` computes no floats that could be in half precision")]
    NoFloats(String),
    /// Ctrl-C.
    #[error("the search was interrupted")]
    Interrupted,
}

/// Subject of a search.
pub struct Question<'a> {
    /// The kernel.
    pub kernel: &'a Kernel,
    /// Its settings; names in `half` are part of every choice but full precision.
    pub settings: &'a Settings,
    /// Inputs of the kernel. It must also be finite where its pictures are 64 times as bright.
    pub inputs: &'a Inputs,
    /// Bound of the error: of [`Lowered::error`].
    pub max_error: f64,
}

/// Searches. Also returns how many choices were judged.
///
/// # Errors
///
/// [`PrecisionError`].
pub fn search_precision(
    question: &Question<'_>,
    compilers: &mut [Compiler],
    progress: &mut dyn Progress,
) -> Result<(Found, usize), PrecisionError> {
    let mut settings = question.settings.clone();
    settings.half.clear();
    let whole = question.kernel.compile(&settings).map_err(ExecuteError::from)?;
    let names = passes::half_names(&whole.graph);
    if names.is_empty() {
        return Err(PrecisionError::NoFloats(whole.kernel));
    }
    let bright = brightened(question.inputs);
    let exact = interpret_kernel::<f64>(&whole, question.inputs, false)?.texels;
    let largest = |texel: &[f64; 4]| {
        texel
            .iter()
            .filter(|x| x.is_finite())
            .fold(1.0, |most: f64, x| most.max(x.abs()))
    };
    let scales: Vec<f64> = exact.iter().map(largest).collect();
    let gpus: Vec<String> = compilers.iter().map(|compiler| compiler.gpu().to_string()).collect();
    progress.begin("choices", names.len() * 4);
    let mut judge = KernelJudge {
        question,
        exact: exact
            .iter()
            .zip(&scales)
            .map(|(texel, scale)| Some(texel.map(|x| x / scale)))
            .collect(),
        scales,
        finite: finite_pixels(&whole, &bright)?,
        bright,
        compilers,
        whole: BTreeMap::new(),
        known: BTreeMap::new(),
        progress,
    };
    let found = search::search(&mut judge, &names, &gpus, question.max_error)?;
    Ok((found, judge.known.len()))
}

/// Returns the same pictures 64 times as bright.
fn brightened(inputs: &Inputs) -> Inputs {
    let mut bright = inputs.clone();
    for picture in bright.images.iter_mut().flat_map(|(_, layers)| layers) {
        let texels = picture.texels().iter().map(|texel| *texel * BRIGHT);
        *picture = Frame::new(picture.size(), texels.collect());
    }
    bright
}

/// Returns for each pixel whether it is finite.
fn finite_pixels(compiled: &Compiled, inputs: &Inputs) -> Result<Vec<bool>, ExecuteError> {
    let found = interpret_kernel::<f32>(compiled, inputs, false)?;
    Ok(found
        .texels
        .iter()
        .map(|texel| texel.iter().all(|x| x.is_finite()))
        .collect())
}

/// Values by the names of GPUs.
type ByGpu<T> = BTreeMap<String, T>;

/// Judge of choices, which judges each once.
struct KernelJudge<'a> {
    question: &'a Question<'a>,
    /// Pixels in `f64`, divided by `scales`.
    exact: Vec<Option<[f64; 4]>>,
    /// By pixel its largest component, or 1: larger differences are relative.
    scales: Vec<f64>,
    bright: Inputs,
    /// By pixel of the bright pictures, whether it is finite in full precision.
    finite: Vec<bool>,
    compilers: &'a mut [Compiler],
    /// Costs in full precision, by GPU.
    whole: ByGpu<u64>,
    known: BTreeMap<Choice, Lowered>,
    progress: &'a mut dyn Progress,
}

impl search::Judge for KernelJudge<'_> {
    fn judge(&mut self, half: &Choice) -> Result<Lowered, PrecisionError> {
        if let Some(known) = self.known.get(half) {
            return Ok(known.clone());
        }
        if self.progress.is_stopped() {
            return Err(PrecisionError::Interrupted);
        }
        let mut settings = self.question.settings.clone();
        match half.is_empty() {
            true => settings.half.clear(),
            false => settings.half.extend(half.iter().cloned()),
        }
        let compiled = self.question.kernel.compile(&settings).map_err(ExecuteError::from)?;
        let (machine, costs) = self.ask(&compiled)?;
        if half.is_empty() {
            self.whole.clone_from(&costs);
        }
        let ratio = |(gpu, cost): (String, u64)| {
            let whole = self.whole.get(&gpu)?;
            Some((gpu, cost as f64 / (*whole).max(1) as f64))
        };
        let lowered = Lowered {
            error: self.error_of(&compiled)?,
            ratios: costs.into_iter().filter_map(ratio).collect(),
            half: settings.half,
            machine,
        };
        self.known.insert(half.clone(), lowered.clone());
        self.progress.step();
        Ok(lowered)
    }
}

impl KernelJudge<'_> {
    /// Error of a kernel, unless it is not finite somewhere.
    fn error_of(&self, compiled: &Compiled) -> Result<Option<f64>, ExecuteError> {
        let finite = finite_pixels(compiled, &self.bright)?;
        if finite.iter().zip(&self.finite).any(|(own, whole)| *whole && !*own) {
            return Ok(None);
        }
        let found = interpret_kernel::<f32>(compiled, self.question.inputs, false)?;
        let scaled = found.texels.iter().zip(&self.scales);
        let scaled = scaled.map(|(texel, scale)| Vec4::from_array(texel.map(|x| (f64::from(x) / scale) as f32)));
        let (_, error) = largest_differences(&scaled.collect::<Vec<_>>(), &self.exact);
        Ok((error < f64::MAX).then_some(error))
    }

    /// Figures and costs of a kernel, by GPU.
    fn ask(&mut self, compiled: &Compiled) -> Result<(ByGpu<MachineFigures>, ByGpu<u64>), PrecisionError> {
        let options = EmitOptions::new().unbounded_loops(true).targets([Target::Spirv]);
        let emitted = compiled.emit(&options).map_err(ExecuteError::from)?;
        let module = emitted.files.get(&Target::Spirv).map_or(&[][..], Vec::as_slice);
        let entry = &emitted.manifest.entry_point;
        let answers: Vec<_> = std::thread::scope(|scope| {
            let asked = self
                .compilers
                .iter_mut()
                .map(|compiler| scope.spawn(move || (compiler.gpu().to_string(), compiler.compile(module, entry))));
            let asked: Vec<_> = asked.collect();
            asked
                .into_iter()
                .map(|thread| thread.join().expect("a compiler's thread ends"))
                .collect()
        });
        let (mut machine, mut costs) = (BTreeMap::new(), BTreeMap::new());
        for (gpu, answer) in answers {
            let figures = answer?.figures;
            let Some(cost) = figures.cost() else {
                let why = "its compiler states no cycles, and instructions do not say how often those of a loop run"
                    .to_owned();
                return Err(PrecisionError::NoFigures { gpu, why });
            };
            machine.insert(gpu.clone(), MachineFigures::from(&figures));
            costs.insert(gpu, cost);
        }
        Ok((machine, costs))
    }
}
