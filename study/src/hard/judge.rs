//! Runs one form on one case, and judges the result.

use super::HardError;
use super::case::Case;
use super::expected::{Expected, expected_result, half_limit};
use super::form::KernelForm;
use super::inputs::{CaseInputs, build_case_inputs};
use super::reals::{Flushed, Loose};
use crate::builtin::load_builtin;
use crate::record::{Executor, HardResult};
use straightline_bench::execute::{Bench, ExecuteError, Inputs, interpret_kernel};
use straightline_codegen::ir::{F16, Real};
use straightline_codegen::{Compiled, Precision};
use straightline_kernels::OptionText;
use straightline_manifest::Manifest;
use straightline_runtime::Pass;

/// A form on a case, with the expected result.
pub struct Trial<'a> {
    case: &'a Case,
    form: &'a KernelForm,
    options: Vec<OptionText>,
    reads: CaseInputs,
    expected: Expected,
}

/// Result of one run.
struct Found {
    texels: Vec<[f64; 4]>,
    non_finite_origins: Vec<([u32; 2], String)>,
}

impl<'a> Trial<'a> {
    /// Creates the trial of a form with `options` on a case.
    pub fn new(case: &'a Case, form: &'a KernelForm, options: Vec<OptionText>) -> Result<Trial<'a>, HardError> {
        let values = form.option_values(&options)?;
        let reads = build_case_inputs(case, form, &values)?;
        let expected = expected_result(form, &values, &reads)?;
        Ok(Trial {
            case,
            form,
            options,
            reads,
            expected,
        })
    }

    /// Runs every executor except a device.
    pub fn run_interpreters(&self, compiled: &Compiled, precision: Precision) -> Result<Vec<HardResult>, HardError> {
        let found = match precision {
            Precision::F32 => [
                self.interpret::<f32>(compiled, true),
                self.interpret::<Flushed<f32>>(compiled, false),
                self.interpret::<Loose<f32>>(compiled, false),
            ],
            Precision::F16 => [
                self.interpret::<F16>(compiled, true),
                self.interpret::<Flushed<F16>>(compiled, false),
                self.interpret::<Loose<F16>>(compiled, false),
            ],
        };
        let executors = [
            Executor::Interpreter,
            Executor::InterpreterFlushed,
            Executor::InterpreterLoose,
        ];
        let judged = found.into_iter().zip(executors);
        judged
            .map(|(found, executor)| Ok(self.judge_result(&self.locate_error(found)?, precision, executor)))
            .collect()
    }

    /// Runs on a device.
    pub fn run_device(
        &self,
        bench: &Bench,
        pass: &Pass,
        manifest: &Manifest,
        precision: Precision,
    ) -> Result<HardResult, HardError> {
        let frame = bench.upload(manifest, self.inputs());
        let frame = frame.and_then(|uploaded| bench.picture_of(pass, &uploaded, self.case.size));
        let found = frame.map(|frame| Found {
            texels: frame.texels().iter().map(|t| t.to_array().map(f64::from)).collect(),
            non_finite_origins: Vec::new(),
        });
        Ok(self.judge_result(&self.locate_error(found)?, precision, Executor::Gpu))
    }

    /// Records a run that did not take place, and the reason.
    pub fn record_refusal(&self, precision: Precision, executor: Executor, why: &str) -> HardResult {
        HardResult {
            kernel: self.form.name.clone(),
            options: self.options.clone(),
            precision: precision.to_string(),
            executor,
            pixels: self.expected.colors.len(),
            non_finite: 0,
            difference: None,
            ulps: None,
            born: None,
            bound: None,
            kept: true,
            promised: false,
            analysed: None,
            refused: Some(why.to_owned()),
        }
    }

    fn inputs(&self) -> &Inputs {
        &self.reads.inputs
    }

    fn locate_error(&self, found: Result<Found, ExecuteError>) -> Result<Found, HardError> {
        found.map_err(|source| HardError::Execute {
            form: self.form.name.clone(),
            case: self.case.name.to_owned(),
            source: Box::new(source),
        })
    }

    fn interpret<R: Real>(&self, compiled: &Compiled, watch: bool) -> Result<Found, ExecuteError> {
        let result = interpret_kernel::<R>(compiled, self.inputs(), watch)?;
        Ok(Found {
            texels: result.texels.iter().map(|t| t.map(Real::to_f64)).collect(),
            non_finite_origins: result.non_finite_origins,
        })
    }

    fn judge_result(&self, found: &Found, precision: Precision, executor: Executor) -> HardResult {
        let half = precision == Precision::F16;
        let limit = half_limit(self.case, self.form.family);
        let watched = half && !self.case.common;
        let (mut non_finite, mut kept) = (0, true);
        let (mut difference, mut ulps, mut bound): (Option<f64>, Option<f64>, Option<f64>) = (None, None, None);
        let mut first_bad = None;
        for (k, (texel, expected)) in found.texels.iter().zip(&self.expected.colors).enumerate() {
            let own = match (half, executor) {
                (true, _) => limit,
                (false, Executor::Gpu) => self.expected.device_bounds[k],
                (false, _) => self.expected.bounds[k],
            };
            if own.is_finite() && !watched {
                bound = Some(bound.unwrap_or(0.0).max(own));
            }
            let finite = texel.iter().all(|lane| lane.is_finite());
            if !finite {
                non_finite += 1;
                first_bad = first_bad.or(Some(k));
                kept &= watched || !self.form.promises && !half;
                continue;
            }
            if !expected.iter().all(|lane| lane.is_finite()) {
                continue;
            }
            for (lane, exact) in texel.iter().zip(expected).take(self.expected.lanes) {
                let off = (lane - exact).abs();
                difference = Some(difference.unwrap_or(0.0).max(off));
                ulps = Some(ulps.unwrap_or(0.0).max(off / ulp_at(*exact, precision)));
                kept &= watched || off <= own;
            }
        }
        let width = self.case.size.x;
        let born = first_bad.and_then(|k| {
            // Quads record their events at their upper left pixel.
            let at = [k as u32 % width, k as u32 / width];
            let quad = at.map(|axis| axis - axis % 2);
            let non_finite_origin = found
                .non_finite_origins
                .iter()
                .find(|(place, _)| *place == at || *place == quad);
            non_finite_origin.map(|([x, y], text)| format!("at ({x}, {y}): {text}"))
        });
        HardResult {
            kernel: self.form.name.clone(),
            options: self.options.clone(),
            precision: precision.to_string(),
            executor,
            pixels: found.texels.len(),
            non_finite,
            difference,
            ulps,
            born,
            bound,
            kept,
            promised: self.form.promises && !half,
            analysed: (self.expected.half_bounds.as_ref())
                .filter(|_| half)
                .map(|all| all.iter().copied().fold(0.0, f64::max))
                .filter(|most| most.is_finite()),
            refused: None,
        }
    }
}

/// Returns the distance of neighbouring numbers at `x`; at 0 and below the smallest normal number, the distance at that
/// number.
fn ulp_at(x: f64, precision: Precision) -> f64 {
    let (digits, smallest) = match precision {
        Precision::F32 => (23, f64::from(f32::MIN_POSITIVE)),
        Precision::F16 => (10, 1.0 / 16384.0),
    };
    let exponent = x.abs().max(smallest).log2().floor() as i32;
    2.0f64.powi(exponent - digits)
}

/// Compiles a form with its options in a case.
pub fn compile_form(form: &KernelForm, options: &[OptionText]) -> Result<Compiled, HardError> {
    let settings = straightline_codegen::Settings::new()
        .set_all(options.to_vec())
        // Each invocation computes a quad: the stage is a compute shader.
        .transport(
            form.family
                .is_of_quads()
                .then_some(straightline_codegen::Transport::Block),
        )
        .math(form.math);
    let compiled = load_builtin(&form.kernel).and_then(|kernel| kernel.compile(&settings));
    compiled.map_err(|errors| HardError::Kernel {
        form: form.name.clone(),
        errors,
    })
}
