//! `list`: the built-in kernels and their options.

use crate::args::ListArgs;
use crate::failure::Failure;
use serde_json::json;
use straightline_codegen::{Kernel, OptionInfo, OptionKind};
use straightline_engines::{Engine, names};
use straightline_kernels::CATALOGUE;

/// Prints every kernel with its options.
pub fn run(args: &ListArgs) -> Result<(), Failure> {
    let mut kernels = Vec::new();
    for entry in CATALOGUE {
        kernels.push((entry, Kernel::builtin(entry.name)?.options()?));
    }
    if args.json {
        let list: Vec<_> = kernels
            .iter()
            .map(|(entry, options)| {
                let options: Vec<_> = options.iter().map(option_json).collect();
                json!({ "name": entry.name, "summary": entry.summary, "options": options })
            })
            .collect();
        let engines: Vec<_> = engines()?
            .iter()
            .map(|engine| json!({ "name": engine.name(), "title": engine.description().title, "about": engine.description().about }))
            .collect();
        outln!("{:#}", json!({ "kernels": list, "engines": engines }));
        return Ok(());
    }
    for (entry, options) in &kernels {
        outln!("{}\n  {}\n", entry.name, entry.summary);
        for option in options {
            print_option(option);
        }
    }
    outln!("Engines, for `emit --engine NAME`:");
    for engine in engines()? {
        let description = engine.description();
        outln!("  {}: {}: {}", engine.name(), description.title, description.about);
    }
    outln!();
    outln!("Set an option with --set OPTION=VALUE. A kernel of your own: FILE.rs::FUNCTION in place of the name.");
    Ok(())
}

/// The built-in engines.
fn engines() -> Result<Vec<Engine>, Failure> {
    names().map(|name| Engine::find(name).map_err(Failure::of)).collect()
}

fn print_option(option: &OptionInfo) {
    outln!("  {}: {}", option.name, option.docs);
    match &option.kind {
        OptionKind::Choice(values) => {
            for (name, docs) in values {
                let mark = if *name == option.default { " (default)" } else { "" };
                outln!("      {name}{mark}: {docs}");
            }
        }
        OptionKind::Number { min, max, .. } => {
            let bound = |b: &Option<f64>| b.map_or("any".to_owned(), |b| b.to_string());
            let (or, default) = match option.uniform {
                true => ("", "default: uniform, "),
                false => (", or uniform", "default "),
            };
            outln!(
                "      {} to {}{or} ({default}{})",
                bound(min),
                bound(max),
                option.default
            );
        }
        OptionKind::List { len, .. } => {
            let many = len.map_or("any number of".to_owned(), |len| len.to_string());
            let default = if option.default.is_empty() {
                "none"
            } else {
                &option.default
            };
            outln!("      {many} numbers, separated by commas (default {default})");
        }
        OptionKind::Flag => outln!("      true or false (default {})", option.default),
    }
}

fn option_json(option: &OptionInfo) -> serde_json::Value {
    let values = match &option.kind {
        OptionKind::Choice(values) => json!(
            values
                .iter()
                .map(|(name, docs)| json!({ "value": name, "docs": docs }))
                .collect::<Vec<_>>()
        ),
        OptionKind::Number { integer, min, max } => {
            json!({ "integer": integer, "min": min, "max": max, "uniform": true })
        }
        OptionKind::List { len, integer, min, max } => {
            json!({ "numbers": len, "integer": integer, "min": min, "max": max })
        }
        OptionKind::Flag => json!(["true", "false"]),
    };
    json!({
        "name": option.name, "docs": option.docs, "default": option.default, "values": values,
        "uniform_by_default": option.uniform,
    })
}
