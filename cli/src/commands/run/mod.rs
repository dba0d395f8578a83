//! `run`: runs any kernel on pictures.

mod chain;
pub mod inputs;
mod outputs;
mod transfer;
pub mod values;

use crate::args::{Executor, RunArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use std::path::PathBuf;
use straightline_bench::execute::{AllWritten, Inputs, interpret_kernel};
use straightline_codegen::files;
use straightline_codegen::ir::{F16, Real};
use straightline_codegen::{Compiled, Precision};

/// Runs a kernel once and writes its results.
pub fn run_kernel(args: &RunArgs) -> Result<(), Failure> {
    if let Some(chain) = args.kernel.locate_chain()? {
        return chain::run_chain(args, &chain);
    }
    args.chain.refuse(&args.kernel.kernel)?;
    let compiled = args.kernel.locate_kernel()?.compile(&args.kernel.options.settings())?;
    let made = run_compiled(args, &compiled, &mut None)?;
    for file in made.files {
        outln!("{} ({})", file.display(), made.by);
    }
    Ok(())
}

/// Result of a run: its files, and the device or interpreter that computed it.
pub struct Made {
    pub files: Vec<PathBuf>,
    by: String,
}

/// Runs a compiled kernel and writes its results. The device is opened on demand, and kept in `gpu`.
pub fn run_compiled(args: &RunArgs, compiled: &Compiled, gpu: &mut Option<Gpu>) -> Result<Made, Failure> {
    check_requests(args)?;
    let outs = outputs::parse_outputs(args, &outputs::Given::by_kernel(compiled))?;
    let inputs = inputs::read_inputs(&args.given, args.stage, compiled)?;
    for out in &outs {
        files::try_file(&out.path, false).map_err(Failure::from_error)?;
    }
    let (targets, by) = match args.given.executor {
        Executor::Gpu => {
            let gpu = match gpu {
                Some(gpu) => gpu,
                none => none.insert(Gpu::require(&args.given.adapter)?),
            };
            let precision = args.precision.parse::<Precision>().map_err(Failure::Usage)?;
            if precision == Precision::F16 && !gpu.has_half() {
                return Err(Failure::Failed(format!(
                    "the adapter {} has no half precision (SHADER_F16): use --executor cpu, another --adapter, or the \
                     precision f32",
                    gpu.describe()
                )));
            }
            let bench = gpu.bench().with_precision(precision);
            let targets = bench.all_written(compiled, args.stage, &inputs);
            let by = match precision {
                Precision::F32 => gpu.describe(),
                Precision::F16 => format!("{}, f16", gpu.describe()),
            };
            (targets.map_err(Failure::from_error)?, by)
        }
        Executor::Cpu => {
            if args.precision == "f16" && !compiled.gathered.is_empty() {
                return Err(Failure::Usage(
                    "half precision does not hold where gathered texels lie: leave --reads or --precision out"
                        .to_owned(),
                ));
            }
            let targets = match args.precision.as_str() {
                "f16" => on_cpu::<F16>(args, compiled, &inputs)?,
                "f64" => on_cpu::<f64>(args, compiled, &inputs)?,
                _ => on_cpu::<f32>(args, compiled, &inputs)?,
            };
            (targets, format!("CPU interpreter, {}", args.precision))
        }
    };
    outputs::write_outputs(&outs, &targets)?;
    let files = outs.into_iter().map(|out| out.path).collect();
    Ok(Made { files, by })
}

/// Rejects invalid requests that would otherwise fail only after all the work.
fn check_requests(args: &RunArgs) -> Result<(), Failure> {
    if args.given.executor == Executor::Gpu && (args.check_finite || args.precision == "f64") {
        return Err(Failure::Usage(
            "--check-finite and --precision f64 are for the interpreter: add --executor cpu".to_owned(),
        ));
    }
    Ok(())
}

fn on_cpu<R: Real>(args: &RunArgs, compiled: &Compiled, inputs: &Inputs) -> Result<AllWritten, Failure> {
    let result = interpret_kernel::<R>(compiled, inputs, args.check_finite).map_err(Failure::from_error)?;
    if let Some(([x, y], non_finite_origin)) = &result.not_finite {
        return Err(Failure::Failed(format!(
            "{} pixels had a NaN or an infinity, the first at ({x}, {y}): {non_finite_origin}",
            result.not_finite_pixels
        )));
    }
    Ok((result.targets, result.buffers))
}
