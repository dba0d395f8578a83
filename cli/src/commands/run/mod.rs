//! `run`: any kernel on pictures.

mod inputs;
mod values;

use crate::args::{Executor, RunArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use glam::Vec4;
use straightline_codegen::files;
use straightline_codegen::ir::{F16, Real};
use straightline_codegen::{Compiled, Precision};
use straightline_kernels::prelude::Frame;
use straightline_study::execute::{Inputs, interpret};
use straightline_study::picture;

/// Runs a kernel once and writes what it makes.
pub fn run(args: &RunArgs) -> Result<(), Failure> {
    check(args)?;
    let compiled = args.kernel.locate()?.compile(&args.kernel.options.settings())?;
    let inputs = inputs::inputs(args, &compiled)?;
    files::try_file(&args.out, false).map_err(Failure::of)?;
    let (frame, by) = match args.executor {
        Executor::Gpu => {
            let gpu = Gpu::require(&args.adapter)?;
            let precision = args.precision.parse::<Precision>().map_err(Failure::Usage)?;
            if precision == Precision::F16 && !gpu.has_half() {
                return Err(Failure::Failed(format!(
                    "the adapter {} has no half precision (SHADER_F16): use --executor cpu, another --adapter, or the \
                     precision f32",
                    gpu.describe()
                )));
            }
            let bench = gpu.bench().precision(precision);
            let frame = bench.run(&compiled, args.stage.into(), &inputs);
            let by = match precision {
                Precision::F32 => gpu.describe(),
                Precision::F16 => format!("{}, f16", gpu.describe()),
            };
            (frame.map_err(Failure::of)?, by)
        }
        Executor::Cpu => {
            let frame = match args.precision.as_str() {
                "f16" => on_cpu::<F16>(args, &compiled, &inputs)?,
                "f64" => on_cpu::<f64>(args, &compiled, &inputs)?,
                _ => on_cpu::<f32>(args, &compiled, &inputs)?,
            };
            (frame, format!("CPU interpreter, {}", args.precision))
        }
    };
    picture::write(&args.out, &frame).map_err(Failure::of)?;
    outln!("{} ({by})", args.out.display());
    Ok(())
}

/// What would otherwise be found only after all the work.
fn check(args: &RunArgs) -> Result<(), Failure> {
    let extension = args
        .out
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or_default()
        .to_ascii_lowercase();
    if !picture::EXTENSIONS.contains(&extension.as_str()) {
        return Err(Failure::Usage(format!(
            "`{}` is neither .png nor .exr",
            args.out.display()
        )));
    }
    if args.executor == Executor::Gpu && (args.check_finite || args.precision == "f64") {
        return Err(Failure::Usage(
            "--check-finite and --precision f64 are for the interpreter: add --executor cpu".to_owned(),
        ));
    }
    Ok(())
}

fn on_cpu<R: Real>(args: &RunArgs, compiled: &Compiled, inputs: &Inputs) -> Result<Frame<Vec4>, Failure> {
    let result = interpret::<R>(compiled, inputs, args.check_finite).map_err(Failure::of)?;
    if let Some(([x, y], birth)) = &result.not_finite {
        return Err(Failure::Failed(format!(
            "{} pixels had a NaN or an infinity, the first at ({x}, {y}): {birth}",
            result.not_finite_pixels
        )));
    }
    Ok(result.frame(inputs))
}
