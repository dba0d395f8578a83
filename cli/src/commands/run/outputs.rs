//! Files for a kernel's results.

use crate::args::RunArgs;
use crate::failure::Failure;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use straightline_bench::execute::{AllWritten, Written};
use straightline_codegen::ir::Access;
use straightline_codegen::{Compiled, files, shorten};
use straightline_scene::picture;

/// Extensions of files that hold the elements of a buffer, one a line.
const TEXTS: [&str; 2] = ["csv", "txt"];

/// A file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Out {
    /// Contents of the file.
    what: What,
    /// The file.
    pub path: PathBuf,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum What {
    /// A target, by its index in the kernel's graph.
    Target(usize),
    /// A buffer, by its name, and the number of components of its elements.
    Buffer(String, usize),
}

/// Parses `--out`, which may be given several times: `FILE` for the first target, or `NAME=FILE`.
pub fn parse_outputs(args: &RunArgs, compiled: &Compiled) -> Result<Vec<Out>, Failure> {
    let mut outs: Vec<Out> = Vec::new();
    for text in &args.out {
        let out = parse_output(text, compiled)?;
        if outs.iter().any(|other| other.what == out.what) {
            let name = match &out.what {
                What::Target(k) => compiled
                    .graph
                    .written_targets()
                    .nth(*k)
                    .map_or("", |target| &target.name),
                What::Buffer(name, _) => name,
            };
            return Err(Failure::Usage(format!("`{name}` is to be written twice")));
        }
        if outs.iter().any(|other| other.path == out.path) {
            return Err(Failure::Usage(format!(
                "`{}` is to be written twice: give each a file of its own",
                out.path.display()
            )));
        }
        outs.push(out);
    }
    Ok(outs)
}

fn parse_output(text: &str, compiled: &Compiled) -> Result<Out, Failure> {
    let graph = &compiled.graph;
    let is_name = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let written = || graph.buffers.iter().filter(|buffer| buffer.access != Access::Read);
    let (what, path) = match text.split_once('=') {
        Some((name, path)) if is_name(name) => {
            let target = graph.written_targets().position(|target| target.name == name);
            let buffer = written().find(|buffer| buffer.name == name);
            let what = match (target, buffer) {
                (Some(target), _) => What::Target(target),
                (None, Some(buffer)) => What::Buffer(name.to_owned(), buffer.value_type().component_count() as usize),
                (None, None) => {
                    let names = graph.written_targets().map(|target| target.name.as_str());
                    let names: Vec<&str> = names.chain(written().map(|buffer| buffer.name.as_str())).collect();
                    return Err(Failure::Usage(format!(
                        "`{}` gives no `{}`; it gives {}",
                        compiled.kernel,
                        shorten(name),
                        names.join(", ")
                    )));
                }
            };
            (what, path)
        }
        _ if graph.written_targets().next().is_none() => {
            let names: Vec<&str> = written().map(|buffer| buffer.name.as_str()).collect();
            return Err(Failure::Usage(format!(
                "`{}` gives no picture, and writes {}: say NAME=FILE.csv",
                compiled.kernel,
                names.join(", ")
            )));
        }
        _ => (What::Target(0), text),
    };
    let path = PathBuf::from(path);
    match &what {
        What::Target(_) => check_extension(&path, &picture::EXTENSIONS, "neither .png nor .exr")?,
        What::Buffer(..) => check_extension(&path, &TEXTS, "neither .csv nor .txt")?,
    }
    Ok(Out { what, path })
}

/// Rejects a file with an unknown extension.
fn check_extension(path: &Path, known: &[&str], otherwise: &str) -> Result<(), Failure> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    match known.contains(&extension.to_ascii_lowercase().as_str()) {
        true => Ok(()),
        false => Err(Failure::Usage(format!("`{}` is {otherwise}", path.display()))),
    }
}

/// Writes the files.
pub fn write_outputs(outs: &[Out], (targets, buffers): &AllWritten) -> Result<(), Failure> {
    for Out { what, path } in outs {
        match what {
            What::Target(k) => {
                picture::write_picture(path, &Written::frame(&targets[*k])).map_err(Failure::from_error)?
            }
            What::Buffer(name, lanes) => {
                let found = buffers.iter().find(|(known, _)| known == name);
                let elements = found.map_or(&[][..], |(_, elements)| elements);
                files::write_file(path, format_elements(elements, *lanes).as_bytes()).map_err(Failure::from_error)?;
            }
        }
    }
    Ok(())
}

/// Formats the elements, one a line, with components separated by commas.
fn format_elements(elements: &[[f64; 4]], lanes: usize) -> String {
    let mut text = String::new();
    for element in elements {
        let components: Vec<String> = element[..lanes].iter().map(f64::to_string).collect();
        let _ = writeln!(text, "{}", components.join(","));
    }
    text
}
