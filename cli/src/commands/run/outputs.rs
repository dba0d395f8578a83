//! Files for a kernel's results.

use crate::args::RunArgs;
use crate::failure::Failure;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use straightline_bench::execute::{AllWritten, Written};
use straightline_codegen::ir::{Access, Buffer};
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

/// Everything that a kernel or a chain writes, by name.
pub struct Given {
    /// Name of the kernel or chain.
    pub name: String,
    pub targets: Vec<String>,
    /// Buffers, with the number of components of their elements.
    pub buffers: Vec<(String, usize)>,
}

impl Given {
    /// Lists what a kernel writes.
    pub fn by_kernel(compiled: &Compiled) -> Given {
        let written = compiled
            .graph
            .buffers
            .iter()
            .filter(|buffer| buffer.access != Access::Read);
        let components = |buffer: &Buffer| buffer.value_type().component_count() as usize;
        Given {
            name: compiled.kernel.clone(),
            targets: compiled
                .graph
                .written_targets()
                .map(|target| target.name.clone())
                .collect(),
            buffers: written
                .map(|buffer| (buffer.name.clone(), components(buffer)))
                .collect(),
        }
    }
}

/// Parses `--out`, which may be given several times: `FILE` for the first target, or `NAME=FILE`.
pub fn parse_outputs(args: &RunArgs, given: &Given) -> Result<Vec<Out>, Failure> {
    let mut outs: Vec<Out> = Vec::new();
    for text in &args.out {
        let out = parse_output(text, given)?;
        if outs.iter().any(|other| other.what == out.what) {
            let name = match &out.what {
                What::Target(k) => &given.targets[*k],
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

fn parse_output(text: &str, given: &Given) -> Result<Out, Failure> {
    let is_name = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
    let buffers = given.buffers.iter().map(|(name, _)| name.as_str());
    let (what, path) = match text.split_once('=') {
        Some((name, path)) if is_name(name) => {
            let target = given.targets.iter().position(|target| target == name);
            let buffer = given.buffers.iter().find(|(buffer, _)| buffer == name);
            let what = match (target, buffer) {
                (Some(target), _) => What::Target(target),
                (None, Some((_, components))) => What::Buffer(name.to_owned(), *components),
                (None, None) => {
                    let names: Vec<&str> = given.targets.iter().map(String::as_str).chain(buffers).collect();
                    return Err(Failure::Usage(format!(
                        "`{}` gives no `{}`; it gives {}",
                        given.name,
                        shorten(name),
                        names.join(", ")
                    )));
                }
            };
            (what, path)
        }
        _ if given.targets.is_empty() => {
            let names: Vec<&str> = buffers.collect();
            return Err(Failure::Usage(format!(
                "`{}` gives no picture, and writes {}: say NAME=FILE.csv",
                given.name,
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
