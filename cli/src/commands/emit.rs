//! `emit`: shaders for other engines.

use crate::args::EmitArgs;
use crate::failure::Failure;
use std::collections::BTreeSet;
use straightline_codegen::{Kernel, files};

/// Writes the shader in every language asked for, and its manifest, or nothing.
pub fn run(args: &EmitArgs) -> Result<(), Failure> {
    let kernel = Kernel::locate(&args.kernel.kernel)?;
    let compiled = kernel.compile(&args.kernel.options.settings())?;
    let targets: BTreeSet<_> = args.target.iter().copied().collect();
    let name = args.name.as_deref().unwrap_or(&compiled.kernel);
    if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c)) || name.starts_with('.')
    {
        return Err(Failure::Usage(format!(
            "`{name}` cannot name files: use letters, digits, `_`, `-` and `.`"
        )));
    }
    let emitted = compiled
        .emit(args.stage.into(), args.format, &targets)
        .map_err(Failure::of)?;
    let written = files::write_all(&args.out, &emitted.named(name)).map_err(Failure::of)?;
    for file in written {
        println!("{}", file.display());
    }
    Ok(())
}
