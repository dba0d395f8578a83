//! Running many kernels natively.

use super::given::{Given, Texel};
use super::interface::Interface;
use super::rustc::{modules, refuse};
use super::{Rustc, Text, Verdict, World};
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// Compiles the texts as one program and gives what each of them gives, or why rustc refuses it.
///
/// # Errors
///
/// rustc cannot be run, or the program does not end well: what was said.
pub fn run(rustc: &Rustc, texts: &[Text], world: &World) -> Result<Vec<Result<Given, String>>, String> {
    let callers: Vec<Result<String, String>> = texts.iter().map(caller).collect();
    let verdict = |caller: &Result<String, String>| match caller {
        Ok(_) => Verdict::Accepted,
        Err(why) => Verdict::Refused(why.clone()),
    };
    let mut verdicts: Vec<Verdict> = callers.iter().map(verdict).collect();
    let program = loop {
        let caller = |k: usize| callers[k].clone().unwrap_or_default();
        let (modules, lines) = modules(texts, &verdicts, caller);
        if lines.is_empty() {
            break None;
        }
        let numbers: Vec<usize> = lines.iter().map(|(_, k)| *k).collect();
        let source = program(modules, &numbers, world);
        match rustc.compile(&source, &["--crate-type=bin", "-Ccodegen-units=1"]) {
            Ok(program) => break Some((program, numbers)),
            Err(errors) => refuse(&errors, &lines, &mut verdicts)?,
        }
    };
    let mut natives = match program {
        Some((program, numbers)) => execute(&program, numbers.len())?,
        None => Vec::new(),
    }
    .into_iter();
    let each = verdicts.into_iter().map(|verdict| match verdict {
        Verdict::Accepted => Ok(natives.next().unwrap_or_default()),
        Verdict::Refused(why) => Err(why),
    });
    Ok(each.collect())
}

/// The function that calls a text's kernel.
fn caller(text: &Text) -> Result<String, String> {
    let interface = Interface::of(&text.source).ok_or("no function `k`")?;
    interface.caller()
}

/// Runs a program of some kernels.
fn execute(program: &Path, kernels: usize) -> Result<Vec<Given>, String> {
    let output = Command::new(program).output();
    let _ = std::fs::remove_file(program);
    let output = output.map_err(|e| format!("{}: {e}", program.display()))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        return Err(format!("the native kernels end with {}: {said}", output.status));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let all: Vec<Given> = text.lines().map(given).collect();
    if all.len() == kernels {
        Ok(all)
    } else {
        Err(format!("{kernels} kernels gave {} lines", all.len()))
    }
}

/// A line that the program prints: pixels that end in `;`, then `|name=` and the elements of each buffer.
fn given(line: &str) -> Given {
    let mut parts = line.split('|');
    let pixels = parts.next().unwrap_or_default().split_terminator(';');
    let pixels = pixels.map(|pixel| (pixel != "-").then(|| texels(pixel)));
    Given {
        pixels: pixels.collect(),
        buffers: parts
            .filter_map(|part| part.split_once('='))
            .map(|(name, elements)| (name.to_owned(), texels(elements)))
            .collect(),
    }
}

fn texels(text: &str) -> Vec<Texel> {
    let lanes = text.split_terminator(',').map(|bits| u64::from_str_radix(bits, 16));
    let lanes: Vec<f64> = lanes.map(|bits| bits.map_or(f64::NAN, f64::from_bits)).collect();
    lanes.as_chunks().0.to_vec()
}

/// The crate of a batch.
fn program(modules: String, numbers: &[usize], world: &World) -> String {
    let mut source = modules;
    source += "use straightline_kernels::prelude::*;\n";
    let _ = writeln!(source, "mod resources {{\n{}\n}}", include_str!("native/resources.rs"));
    source += &world.native();
    source += "type Kernel = fn(&World, &mut Vec<u8>);\nstatic KERNELS: &[Kernel] = &[\n";
    for k in numbers {
        let _ = writeln!(source, "k{k}::straightline_native,");
    }
    source += "];\n";
    source += include_str!("native/harness.rs");
    source
}
