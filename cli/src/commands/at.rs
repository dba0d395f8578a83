//! `explain --at`: the source of a line of a shader, and the lines of a shader that come from a line of the source.

use crate::args::{At, ExplainArgs};
use crate::failure::Failure;
use serde_json::{Value, json};
use std::fmt::Display;
use straightline_codegen::emit::{DebugInfo, Target};
use straightline_codegen::{EmitOptions, files};
use straightline_manifest::{MappedStatement, SourceMap};

/// End of the names of source maps.
const MAP: &str = ".map.json";

/// Longest source map that is read, in bytes.
const LONGEST: u64 = 1 << 28;

/// Prints what stands at `at` in the source map that the arguments name, or in that of the kernel's shader.
pub fn explain_at(args: &ExplainArgs, at: &At) -> Result<(), Failure> {
    let (target, map) = match args.kernel.kernel.ends_with(MAP) {
        true => in_file(&args.kernel.kernel, at)?,
        false => in_shader(args, at)?,
    };
    let found: Vec<&MappedStatement> = match at {
        At::Text(_, line) => map.at_line(&target, *line).into_iter().collect(),
        At::Source(file, line) => map.from_source(&target, file, *line).collect(),
    };
    if found.is_empty() {
        return Err(Failure::Failed(nothing_there(&map, &target, at)));
    }
    if args.json {
        let found = found.into_iter().map(|statement| {
            let mut object = json!(statement);
            object["file"] = json!(map.file_of(statement));
            object["target"] = json!(target);
            object
        });
        outln!("{:#}", Value::Array(found.collect()));
        return Ok(());
    }
    for statement in found {
        let lines = match statement.first == statement.last {
            true => statement.first.to_string(),
            false => format!("{}-{}", statement.first, statement.last),
        };
        let name = match statement.name.as_str() {
            "" => String::new(),
            name => format!(", {name}"),
        };
        outln!("{target}:{lines}{name}: {}", map.describe(statement));
    }
    Ok(())
}

/// Returns the source map of a file, and the language to look in: for a line of the source WGSL, or else the first one.
fn in_file(path: &str, at: &At) -> Result<(String, SourceMap), Failure> {
    let failed = |error: &dyn Display| Failure::Failed(format!("{path}: {error}"));
    let text = files::read_text(path.as_ref(), LONGEST).map_err(|error| failed(&error))?;
    let map = SourceMap::from_json(&text).map_err(|error| failed(&error))?;
    let target = match at {
        At::Text(target, _) => target.to_string(),
        At::Source(..) => {
            let wgsl = Target::Wgsl.to_string();
            let known = map.texts.contains_key(&wgsl).then_some(wgsl);
            known.or_else(|| map.texts.keys().next().cloned()).unwrap_or_default()
        }
    };
    Ok((target, map))
}

/// Returns the source map of a kernel's shader as `emit` writes it, and its language.
fn in_shader(args: &ExplainArgs, at: &At) -> Result<(String, SourceMap), Failure> {
    let target = match at {
        At::Text(target @ (Target::Spirv | Target::Msl), _) => {
            let what = format!("the lines of {target} are those of its translator: give one of wgsl, glsl or hlsl");
            return Err(Failure::Usage(what));
        }
        At::Text(target, _) => *target,
        At::Source(..) => Target::Wgsl,
    };
    if args.kernel.locate_chain()?.is_some() {
        let help = "a chain has a shader for each pass: emit it with `--debug map`, and give a NAME.map.json";
        return Err(Failure::Usage(help.to_owned()));
    }
    let kernel = args.kernel.locate_kernel()?;
    let compiled = kernel.compile(&args.kernel.options.settings())?;
    let options = EmitOptions::new()
        .targets([target])
        .precision(args.precision)
        .accept_loss(true)
        .debug(DebugInfo::Map);
    let emitted = compiled.emit(&options)?;
    let map = emitted
        .source_map
        .ok_or_else(|| Failure::Failed("the shader has no source map".to_owned()))?;
    Ok((target.to_string(), map))
}

/// Returns the message for a line that has no counterpart, with those that have one.
fn nothing_there(map: &SourceMap, target: &str, at: &At) -> String {
    let kernel = &map.kernel;
    let Some(statements) = map.texts.get(target).filter(|statements| !statements.is_empty()) else {
        let known: Vec<&str> = map.texts.keys().map(String::as_str).collect();
        return format!(
            "the source map of `{kernel}` has no lines of {target}, only of: {}",
            known.join(", ")
        );
    };
    match at {
        At::Text(_, line) => {
            let first = statements.first().map_or(0, |statement| statement.first);
            let last = statements.last().map_or(0, |statement| statement.last);
            format!(
                "line {line} of `{kernel}` in {target} comes from no expression of the source: its statements are in \
                 the lines {first} to {last}"
            )
        }
        At::Source(file, line) => {
            let is_there = |path: &&String| path.ends_with(file.as_str());
            match map.files.iter().find(is_there) {
                Some(path) => format!("no statement of `{kernel}` in {target} comes from {path}:{line}"),
                None => format!("`{kernel}` has no file {file}; it has {}", map.files.join(", ")),
            }
        }
    }
}
