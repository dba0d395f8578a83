//! `run`: any kernel on pictures.

use crate::args::{Executor, RunArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use glam::Vec4;
use std::path::Path;
use straightline_codegen::Compiled;
use straightline_codegen::Precision;
use straightline_codegen::ir::{F16, Real, TextureKind};
use straightline_kernels::prelude::Frame;
use straightline_study::execute::{Inputs, interpret};
use straightline_study::picture;

/// Runs a kernel once and writes what it makes.
pub fn run(args: &RunArgs) -> Result<(), Failure> {
    check(args)?;
    let compiled = args.kernel.locate()?.compile(&args.kernel.options.settings())?;
    let inputs = inputs(args, &compiled)?;
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
    println!("{} ({by})", args.out.display());
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

fn inputs(args: &RunArgs, compiled: &Compiled) -> Result<Inputs, Failure> {
    let graph = &compiled.graph;
    let names: Vec<&str> = graph.textures.iter().map(|t| t.name.as_str()).collect();
    let mut inputs = Inputs::default();
    for text in &args.input {
        let (name, path) = match text.split_once('=') {
            Some((name, path)) if names.contains(&name) => (name, path),
            Some((name, _)) if !Path::new(text).exists() => {
                return Err(Failure::Usage(format!(
                    "`{}` has no texture `{name}`; it has {}",
                    compiled.kernel,
                    list(&names)
                )));
            }
            _ => match names[..] {
                [only] => (only, text.as_str()),
                _ => {
                    return Err(Failure::Usage(format!(
                        "say which texture `{text}` is for, NAME=FILE: `{}` has {}",
                        compiled.kernel,
                        list(&names)
                    )));
                }
            },
        };
        let picture = picture::read(Path::new(path)).map_err(Failure::of)?;
        let kind = graph.textures.iter().find(|t| t.name == name).map(|t| t.kind);
        match inputs.images.iter_mut().find(|(known, _)| known == name) {
            Some((_, layers)) if kind.is_some_and(TextureKind::is_indexed) => layers.push(picture),
            Some(_) => return Err(Failure::Usage(format!("the texture `{name}` takes one picture"))),
            None => inputs = inputs.image(name, picture),
        }
    }
    for (name, numbers) in &args.uniform {
        let known: Vec<&str> = graph.uniforms.iter().map(|u| u.name.as_str()).collect();
        if !known.contains(&name.as_str()) {
            return Err(Failure::Usage(format!(
                "`{}` has no uniform `{name}`; it has {}",
                compiled.kernel,
                list(&known)
            )));
        }
        inputs = inputs.uniform(name, &parse(name, numbers)?);
    }
    for (name, text) in &args.buffer {
        let Some(buffer) = graph.buffers.iter().find(|b| b.name == *name) else {
            let known: Vec<&str> = graph.buffers.iter().map(|b| b.name.as_str()).collect();
            return Err(Failure::Usage(format!(
                "`{}` has no buffer `{name}`; it has {}",
                compiled.kernel,
                list(&known)
            )));
        };
        let numbers = parse(name, text)?;
        let lanes = usize::from(buffer.element.lanes());
        if numbers.len() % lanes != 0 {
            return Err(Failure::Usage(format!(
                "`{name}` holds {}, and {} numbers are no whole number of them",
                buffer.element,
                numbers.len()
            )));
        }
        let element = |c: &[f64]| std::array::from_fn(|k| c.get(k).copied().unwrap_or(0.0));
        inputs = inputs.buffer(name, numbers.chunks_exact(lanes).map(element).collect());
    }
    let first = inputs
        .images
        .first()
        .and_then(|(_, layers)| layers.first())
        .map(Frame::size);
    inputs.size = args
        .size
        .or(first)
        .ok_or_else(|| Failure::Usage("give the output's --size".to_owned()))?;
    Ok(inputs)
}

fn list(names: &[&str]) -> String {
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}

fn parse(name: &str, text: &str) -> Result<Vec<f64>, Failure> {
    let number = |t: &str| t.trim().parse::<f64>().ok().filter(|n| n.is_finite());
    text.split(',')
        .map(number)
        .collect::<Option<Vec<f64>>>()
        .ok_or_else(|| {
            Failure::Usage(format!(
                "`{text}` for `{name}` is no list of numbers: write 1.5 or 1,2,3"
            ))
        })
}
