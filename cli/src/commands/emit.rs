//! `emit`: shaders for other engines.

use crate::args::EmitArgs;
use crate::failure::Failure;
use straightline_codegen::{EmitOptions, files};

/// Writes the shader in every language asked for, and its manifest, or nothing.
pub fn run(args: &EmitArgs) -> Result<(), Failure> {
    let kernel = args.kernel.locate()?;
    let compiled = kernel.compile(&args.kernel.options.settings())?;
    let name = args.name.as_deref().unwrap_or(&compiled.kernel);
    if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c)) || name.starts_with('.')
    {
        return Err(Failure::Usage(format!(
            "`{name}` cannot name files: use letters, digits, `_`, `-` and `.`"
        )));
    }
    let mut options = EmitOptions::new()
        .stage(args.stage.into())
        .format(args.format)
        .precision(args.precision)
        .targets(args.target.iter().copied());
    options.region = args.region;
    options.enable_subgroups = args.enable_subgroups;
    options.workgroup = args.workgroup.map(|size| size.to_array());
    let emitted = compiled.emit(&options).map_err(Failure::of)?;
    let written = files::write_all(&args.out, &emitted.named(name)).map_err(Failure::of)?;
    for file in written {
        println!("{}", file.display());
    }
    Ok(())
}
