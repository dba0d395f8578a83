//! `run` of a chain of passes.

use super::inputs::{self, Wanted};
use super::{check_requests, outputs};
use crate::args::{Executor, RunArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use straightline_bench::execute::{Inputs, Written, interpret_chain};
use straightline_codegen::chain::{Chain, CompiledChain};
use straightline_codegen::ir::{F16, Real};
use straightline_codegen::{EmitOptions, Format, Precision, ShaderSpec, files};

/// Runs a chain once and writes its results.
pub fn run_chain(args: &RunArgs, chain: &Chain) -> Result<(), Failure> {
    check_requests(args)?;
    if args.check_finite {
        return Err(Failure::Usage(
            "--check-finite is for kernels: run the pass by itself".to_owned(),
        ));
    }
    let mut shader = ShaderSpec::new();
    shader.settings = args.kernel.options.settings();
    shader.emit = EmitOptions::new().stage(args.stage).format(Format::Rgba32Float);
    if args.given.executor == Executor::Gpu {
        let precision = args.precision.parse::<Precision>().map_err(Failure::Usage)?;
        shader.emit = shader.emit.precision(precision).accept_loss(true);
    }
    let compiled = chain.compile(&args.chain.chain_spec(shader))?;
    let given = outputs::Given {
        name: compiled.name.clone(),
        targets: compiled
            .results
            .iter()
            .map(|index| compiled.pictures[*index].name.clone())
            .collect(),
        buffers: Vec::new(),
    };
    let outs = outputs::parse_outputs(args, &given)?;
    let wanted = list_inputs(&compiled);
    let inputs = inputs::read_given(&args.given, &wanted)?;
    if args.given.size.is_some() {
        return Err(Failure::Usage(format!(
            "the sizes of `{}` follow from its inputs: leave --size out",
            compiled.name
        )));
    }
    let is_set = |name: &str| inputs.uniforms.iter().any(|(known, _)| known == name);
    if let Some(unset) = wanted.uniforms.iter().find(|u| u.default.is_none() && !is_set(&u.name)) {
        return Err(inputs::unset_uniform(&compiled.name, &unset.name));
    }
    for out in &outs {
        files::try_file(&out.path, false).map_err(Failure::from_error)?;
    }
    let (targets, by) = match args.given.executor {
        Executor::Gpu => {
            let gpu = Gpu::require(&args.given.adapter)?;
            let emitted = compiled.emit()?;
            let targets = gpu.bench().run_chain(&emitted, &inputs).map_err(Failure::from_error)?;
            (targets, gpu.describe())
        }
        Executor::Cpu => {
            let targets = match args.precision.as_str() {
                "f16" => interpret::<F16>(&compiled, &inputs)?,
                "f64" => interpret::<f64>(&compiled, &inputs)?,
                _ => interpret::<f32>(&compiled, &inputs)?,
            };
            (targets, format!("CPU interpreter, {}", args.precision))
        }
    };
    outputs::write_outputs(&outs, &(targets, Vec::new()))?;
    for out in outs {
        outln!("{} ({by})", out.path.display());
    }
    Ok(())
}

fn interpret<R: Real>(compiled: &CompiledChain, inputs: &Inputs) -> Result<Vec<Written>, Failure> {
    interpret_chain::<R>(compiled, inputs).map_err(Failure::from_error)
}

/// Lists what the passes of a chain take from the caller.
fn list_inputs(chain: &CompiledChain) -> Wanted {
    let graph = chain.inputs_graph();
    Wanted {
        name: chain.name.clone(),
        uniforms: inputs::host_values(&graph),
        textures: graph.textures,
        overrides: graph.overrides,
        buffers: graph.buffers,
    }
}
