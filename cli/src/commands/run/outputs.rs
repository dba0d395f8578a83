//! Where what a kernel gives is written to.

use crate::args::RunArgs;
use crate::failure::Failure;
use std::path::{Path, PathBuf};
use straightline_codegen::{Compiled, shorten};
use straightline_study::execute::Written;
use straightline_study::picture;

/// A picture to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Out {
    /// Index of the target in the kernel's graph.
    pub target: usize,
    /// The file.
    pub path: PathBuf,
}

/// What `--out` says, which may be given several times: `FILE` for the first target, or `NAME=FILE`.
pub fn outs(args: &RunArgs, compiled: &Compiled) -> Result<Vec<Out>, Failure> {
    let mut outs: Vec<Out> = Vec::new();
    for text in &args.out {
        let out = out(text, compiled)?;
        if outs.iter().any(|other| other.target == out.target) {
            let name = &compiled.graph.targets[out.target].name;
            return Err(Failure::Usage(format!("the target `{name}` is to be written twice")));
        }
        if outs.iter().any(|other| other.path == out.path) {
            return Err(Failure::Usage(format!(
                "`{}` is to be written twice: give each target a file of its own",
                out.path.display()
            )));
        }
        outs.push(out);
    }
    Ok(outs)
}

fn out(text: &str, compiled: &Compiled) -> Result<Out, Failure> {
    let targets = &compiled.graph.targets;
    let is_name = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let (target, path) = match text.split_once('=') {
        Some((name, path)) if is_name(name) => {
            let target = targets.iter().position(|target| target.name == name);
            let target = target.ok_or_else(|| {
                let names: Vec<&str> = targets.iter().map(|target| target.name.as_str()).collect();
                Failure::Usage(format!(
                    "`{}` gives no `{}`; it gives {}",
                    compiled.kernel,
                    shorten(name),
                    names.join(", ")
                ))
            })?;
            (target, path)
        }
        _ => (0, text),
    };
    let path = PathBuf::from(path);
    check_extension(&path)?;
    Ok(Out { target, path })
}

/// Refuses a file of which neither kind of picture can be told.
fn check_extension(path: &Path) -> Result<(), Failure> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    match picture::EXTENSIONS.contains(&extension.to_ascii_lowercase().as_str()) {
        true => Ok(()),
        false => Err(Failure::Usage(format!("`{}` is neither .png nor .exr", path.display()))),
    }
}

/// Writes the pictures.
pub fn write(outs: &[Out], targets: &[Written], by: &str) -> Result<(), Failure> {
    for Out { target, path } in outs {
        picture::write(path, &targets[*target].frame()).map_err(Failure::of)?;
        outln!("{} ({by})", path.display());
    }
    Ok(())
}
