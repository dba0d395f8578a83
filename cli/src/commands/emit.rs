//! `emit`: writes shaders for other engines.

use super::chain::emit_chain;
use super::notes::find_notes;
use crate::args::EmitArgs;
use crate::failure::Failure;
use std::collections::BTreeMap;
use std::path::PathBuf;
use straightline_codegen::{Compiled, EmitOptions, Kernel, OptionInfo, Precision, files};
use straightline_engines::{Engine, EngineError, Request};
use straightline_kernels::HalfPrecision;

/// Writes the shader in every requested language with its manifest, or the files for an engine, or nothing on an error;
/// prints the paths.
pub fn emit_kernel(args: &EmitArgs) -> Result<(), Failure> {
    if let Some(chain) = args.kernel.locate_chain()? {
        return emit_chain(args, &chain);
    }
    args.chain.refuse(&args.kernel.kernel)?;
    let ready = compile_kernel(args)?;
    for file in write_shaders(args, &ready)? {
        outln!("{}", file.display());
    }
    let Ready { kernel, compiled } = &ready;
    for note in find_notes(kernel, &args.shader_spec().settings, compiled) {
        errln!("note: {note}");
    }
    Ok(())
}

/// A compiled kernel, ready for emission.
pub struct Ready {
    kernel: Kernel,
    pub compiled: Compiled,
}

/// Reads and compiles the kernel.
pub fn compile_kernel(args: &EmitArgs) -> Result<Ready, Failure> {
    let kernel = args.kernel.locate_kernel()?;
    let compiled = args.shader_spec().compile(&kernel)?;
    Ok(Ready { kernel, compiled })
}

/// Writes all files or none; returns their paths.
pub fn write_shaders(args: &EmitArgs, Ready { kernel, compiled }: &Ready) -> Result<Vec<PathBuf>, Failure> {
    let options = args.shader_spec().emit;
    if options.accept_loss && options.precision != Precision::F16 {
        return Err(Failure::Usage("--accept-loss goes with --precision f16".to_owned()));
    }
    let name = args.name.as_deref().unwrap_or(&compiled.kernel);
    check_name(name)?;
    if let Some(engine) = &args.engine {
        let request = (options, args.bind.iter().cloned().collect());
        let files = for_engine(request, &kernel.options()?, compiled, engine, name)?;
        return write_all(args, compiled, &files);
    }
    let emitted = compiled.emit(&options)?;
    write_all(args, compiled, &emitted.named_files(name))
}

/// Refuses a name that no file can have everywhere.
pub fn check_name(name: &str) -> Result<(), Failure> {
    let allowed = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
    match name.is_empty() || !name.chars().all(allowed) || name.starts_with('.') {
        true => Err(Failure::Usage(format!(
            "`{name}` cannot name files: use letters, digits, `_`, `-` and `.`"
        ))),
        false => Ok(()),
    }
}

/// Returns the files for an engine.
fn for_engine(
    (emit, binds): (EmitOptions, BTreeMap<String, String>),
    options: &[OptionInfo],
    compiled: &Compiled,
    engine: &str,
    name: &str,
) -> Result<BTreeMap<String, Vec<u8>>, Failure> {
    let engine = Engine::find(engine).map_err(engine_failure)?;
    let request = Request {
        name: name.to_owned(),
        emit,
        binds,
        ..Request::new(compiled, options)
    };
    engine.render_files(&request).map_err(engine_failure)
}

/// Returns the failure of an engine's error.
pub fn engine_failure(error: EngineError) -> Failure {
    match error {
        EngineError::Unknown { .. } => Failure::Usage(error.to_string()),
        EngineError::Kernel(errors) => Failure::Kernel(errors),
        error => Failure::from_error(error),
    }
}

fn write_all(args: &EmitArgs, compiled: &Compiled, named: &BTreeMap<String, Vec<u8>>) -> Result<Vec<PathBuf>, Failure> {
    if args.shader_spec().emit.precision == Precision::F16 && compiled.half_precision() == HalfPrecision::Unstudied {
        let kernel = &args.kernel.kernel;
        errln!("note: no hard cases tell what f16 costs `{kernel}`; compare `run --precision f16` and f32");
    }
    files::write_all(&args.out, named).map_err(Failure::from_error)
}
