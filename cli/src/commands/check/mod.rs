//! `check`: prints the errors of kernels, for people or for editors, and writes no files.

mod before;
mod message;
mod notes;

use crate::args::{CheckArgs, KernelArgs, MessageFormat};
use crate::failure::{Failure, format_count};
use crate::output;
use std::collections::HashSet;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use straightline_codegen::chain::{Chain, ChainSpec};
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::{Compiled, Kernel};

/// Checks every kernel and prints all errors. Fails if there is one, or if the command that runs first fails.
pub fn check_kernels(args: &CheckArgs) -> Result<(), Failure> {
    let names = kernel_names(&args.kernels, &args.source)?;
    // A missing file is a usage error, reported before anything runs.
    let mut located = Vec::new();
    for name in &names {
        match Checked::locate(&args.kernel_args(name)) {
            Ok(checked) => located.push(checked),
            Err(errors) => {
                // Editors read only messages.
                if args.message_format == MessageFormat::Json {
                    outln!("{}", message::message_json(name, &errors));
                    outln!("{}", message::finished_json(false));
                }
                return Err(errors.into());
            }
        }
    }
    let before = before::run_command(&args.command, args.message_format)?;
    let mut shown = HashSet::new();
    let (mut broken, mut found) = (0, 0);
    for (name, checked) in names.iter().zip(&located) {
        let errors = match checked.check(args) {
            Ok(notes) => {
                if args.message_format == MessageFormat::Human {
                    outln!("{name}: no errors");
                }
                let new = notes
                    .into_iter()
                    .filter(|note| shown.insert(format!("{:?}", note.diagnostics)));
                new.for_each(|note| notes::print(args.message_format, name, &note));
                continue;
            }
            Err(errors) => errors,
        };
        broken += 1;
        for diagnostic in &errors.diagnostics {
            let one = Errors {
                diagnostics: vec![diagnostic.clone()],
                files: errors.files.clone(),
            };
            // Kernels that share a file also share its errors.
            if shown.insert(one.render(false)) {
                found += 1;
                print(args.message_format, name, &one);
            }
        }
    }
    let success = broken == 0 && before.is_ok();
    if args.message_format == MessageFormat::Json {
        outln!("{}", message::finished_json(success));
    }
    if broken > 0 {
        return Err(Failure::Failed(format!(
            "{} in {broken} of {}",
            format_count(found, "error"),
            format_count(names.len(), "kernel")
        )));
    }
    before.map_err(Failure::Failed)
}

/// A kernel or a chain to check.
enum Checked {
    Kernel(Kernel),
    Chain(Chain),
}

impl Checked {
    fn locate(args: &KernelArgs) -> Result<Checked, Errors> {
        match args.locate_chain()? {
            Some(chain) => Ok(Checked::Chain(chain)),
            None => args.locate_kernel().map(Checked::Kernel),
        }
    }

    /// Compiles and emits, and returns remarks.
    fn check(&self, args: &CheckArgs) -> Result<Vec<Errors>, Errors> {
        match self {
            Checked::Kernel(kernel) => check_kernel(args, kernel).map(|compiled| notes::find_notes(&compiled, kernel)),
            Checked::Chain(chain) => {
                let compiled = chain.compile(&ChainSpec::from(args.shader_spec()));
                compiled.and_then(|compiled| compiled.emit()).map(|_| Vec::new())
            }
        }
    }
}

/// Returns the kernels to check; those of a folder are sorted by name.
fn kernel_names(given: &[String], sources: &[PathBuf]) -> Result<Vec<String>, Failure> {
    let mut names = Vec::new();
    for name in given {
        let folder = Path::new(name);
        if !folder.is_dir() {
            names.push(name.clone());
            continue;
        }
        let refused = |error| Failure::Failed(format!("cannot read the folder `{name}`: {error}"));
        let mut found = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(refused)? {
            let path = entry.map_err(refused)?.path();
            let rust = path.extension().is_some_and(|extension| extension == "rs");
            if rust && path.to_str().is_none() {
                let what = format!(
                    "the name of `{}` is not UTF-8: rename the file, or give the others by their names",
                    path.display()
                );
                return Err(Failure::Usage(what));
            }
            // Files that only hold modules, or are given as `--source`, are not kernels.
            if rust && !path.ends_with("mod.rs") && !sources.contains(&path) {
                found.push(path.display().to_string());
            }
        }
        if found.is_empty() {
            return Err(Failure::Usage(format!(
                "no .rs file lies in the folder `{name}`: give a folder with kernels in it"
            )));
        }
        found.sort();
        names.append(&mut found);
    }
    Ok(names)
}

/// Compiles and emits a kernel to find its errors. Every error has a span, because editors show no others.
fn check_kernel(args: &CheckArgs, kernel: &Kernel) -> Result<Compiled, Errors> {
    let placed = |mut errors: Errors| {
        let place = kernel.name_span();
        for diagnostic in errors.diagnostics.iter_mut().filter(|d| d.span.is_none()) {
            diagnostic.span = place;
        }
        errors.files = kernel.files().to_vec().into();
        errors
    };
    let compiled = compile_and_emit(args, kernel);
    let checked = match (compiled, kernel.check_others()) {
        (compiled, Ok(())) => compiled,
        (Ok(_), Err(others)) => Err(others),
        (Err(errors), Err(others)) => Err(join_errors(errors, others)),
    };
    checked.map_err(placed)
}

/// The errors of both, each once, in the order of their places.
fn join_errors(mut errors: Errors, others: Errors) -> Errors {
    let new = others.diagnostics.into_iter();
    let new: Vec<_> = new.filter(|other| !errors.diagnostics.contains(other)).collect();
    errors.diagnostics.extend(new);
    errors.diagnostics.sort_by_key(|error| error.span);
    errors
}

fn compile_and_emit(args: &CheckArgs, kernel: &Kernel) -> Result<Compiled, Errors> {
    let mut spec = args.shader_spec();
    let compiled = spec.compile(kernel)?;
    if !args.writing.0.has("stage") {
        spec.emit.stage = super::natural_stage(&compiled);
    }
    compiled.emit(&spec.emit)?;
    Ok(compiled)
}

fn print(format: MessageFormat, kernel: &str, error: &Errors) {
    match format {
        MessageFormat::Json => outln!("{}", message::message_json(kernel, error)),
        MessageFormat::Human => {
            let text = error.render(std::io::stderr().is_terminal());
            output::note(format_args!("{}\n", output::limit_lines(&text)));
        }
    }
}
