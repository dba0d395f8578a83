//! `list`: the built-in kernels and engines in a screen, or one of them with all that can be said of it.

use crate::args::ListArgs;
use crate::failure::Failure;
use crate::paragraph::wrap_text;
use serde_json::{Value, json};
use straightline_codegen::chain::Chain;
use straightline_codegen::diagnostic::File;
use straightline_codegen::{Kernel, OptionInfo, OptionKind, Overridable, shorten};
use straightline_engines::description::Description;
use straightline_engines::{Engine, MEANINGS, engine_names};
use straightline_kernels::{CATALOGUE, Entry, Preset};

/// Columns of a screen.
const WIDTH: usize = 80;

/// Prints all kernels and engines, or the one that is named.
pub fn print_list(args: &ListArgs) -> Result<(), Failure> {
    match &args.name {
        None if args.json => all_as_json(),
        None => print_all(),
        Some(name) if engine_names().any(|known| known == name) => print_engine(name, args.json),
        Some(name) if !name.contains(".rs") && straightline_kernels::find(name).is_none() => {
            Err(Failure::Usage(format!(
                "there is no kernel or engine `{}`: `list` shows those that there are",
                shorten(name)
            )))
        }
        Some(name) => print_kernel(name, args.json),
    }
}

fn print_all() -> Result<(), Failure> {
    outln!("Kernels, for `emit`, `explain` and `run`:");
    let of_their_own = || CATALOGUE.iter().filter(|entry| parent_kernel(entry).is_none());
    let width = of_their_own().map(|entry| entry.name.len()).max().unwrap_or(0);
    for entry in of_their_own() {
        outln!("  {:width$}  {}", entry.name, kernel_purpose(entry));
        let passes = CATALOGUE
            .iter()
            .filter(|other| parent_kernel(other) == Some(entry.name));
        let passes: Vec<&str> = passes.map(|pass| pass.name).collect();
        if !passes.is_empty() {
            let indent = " ".repeat(width + 4);
            outln!(
                "{}",
                wrap_text(&format!("with {}", passes.join(", ")), WIDTH, &indent, &indent)
            );
        }
    }
    let engines: Vec<&str> = engine_names().collect();
    outln!("\nEngines, for `emit --engine NAME`:");
    outln!("{}", wrap_text(&engines.join(", "), WIDTH, "  ", "  "));
    outln!();
    outln!("`list KERNEL` shows what a kernel does and its options, `list ENGINE` what is");
    outln!("written for an engine. A kernel of your own: FILE.rs, or FILE.rs::FUNCTION.");
    Ok(())
}

/// Returns the kernel of which an entry is a further pass, as `sraa_guide` is of `sraa`.
fn parent_kernel(entry: &Entry) -> Option<&'static str> {
    let mut names = CATALOGUE.iter().map(|other| other.name);
    names.find(|parent| {
        entry
            .name
            .strip_prefix(parent)
            .is_some_and(|rest| rest.starts_with('_'))
    })
}

/// Returns a kernel's purpose, without its authors.
fn kernel_purpose(entry: &Entry) -> &'static str {
    match entry.summary.rsplit_once(" (") {
        Some((what, _)) if entry.summary.ends_with(')') => what,
        _ => entry.summary,
    }
}

fn all_as_json() -> Result<(), Failure> {
    let mut kernels = Vec::new();
    for entry in CATALOGUE {
        kernels.push(kernel_json(&Kernel::builtin(entry.name)?)?);
    }
    let mut engines = Vec::new();
    for name in engine_names() {
        engines.push(engine_json(&Engine::find(name).map_err(Failure::from_error)?));
    }
    outln!("{:#}", json!({ "kernels": kernels, "engines": engines }));
    Ok(())
}

fn print_engine(name: &str, as_json: bool) -> Result<(), Failure> {
    let engine = Engine::find(name).map_err(Failure::from_error)?;
    if as_json {
        outln!("{:#}", engine_json(&engine));
        return Ok(());
    }
    let description = engine.description();
    let text = format!("{name}: {}: {}", description.title, description.about);
    outln!("{}", wrap_text(&text, WIDTH, "", "  "));
    print_meanings(description);
    print_chains(description);
    outln!("\nstraightline emit KERNEL --engine {name} --out DIR");
    Ok(())
}

/// Prints whether an engine takes chains of several passes.
fn print_chains(description: &Description) {
    let text = match &description.chain {
        None => "It takes one pass: a kernel, or a chain whose pictures are all fused.".to_owned(),
        Some(chain) if chain.meanings.is_empty() => "It takes chains of several passes.".to_owned(),
        Some(chain) => format!(
            "It takes chains of several passes, and provides {} to them.",
            chain.meanings.join(", ")
        ),
    };
    outln!("\n{}", wrap_text(&text, WIDTH, "", ""));
}

/// Prints the inputs that an engine provides by meaning.
fn print_meanings(description: &Description) {
    if description.meanings.is_empty() {
        outln!("\nYou set every input of a kernel by its own name.");
        return;
    }
    outln!("\nInputs that it provides, by their names or by `--bind NAME=MEANING`:");
    for meaning in &MEANINGS {
        let Some(source) = description.meanings.get(meaning.name) else {
            continue;
        };
        let text = format!("{}: {} Here: {}.", meaning.name, meaning.doc, source.stored);
        outln!("{}", wrap_text(&text, WIDTH, "  ", "      "));
    }
}

fn print_kernel(name: &str, as_json: bool) -> Result<(), Failure> {
    if let (Some(chain), false) = (Chain::from_argument(name)?, as_json) {
        outln!("{}: a chain of passes", chain.name());
        return print_options(&chain.options()?, &|name| {
            Ok(overridable(chain.overridable(name)?, chain.files()))
        });
    }
    let kernel = Kernel::from_argument(name)?;
    if as_json {
        outln!("{:#}", kernel_json(&kernel)?);
        return Ok(());
    }
    let options = kernel.options()?;
    let summary = straightline_kernels::find(name).map_or(String::new(), |entry| format!(": {}", entry.summary));
    outln!("{}", wrap_text(&format!("{}{summary}", kernel.name()), WIDTH, "", "  "));
    if !kernel.presets().is_empty() {
        outln!("\nPresets, for `--set preset=NAME`; options set beside one override its own:");
        kernel.presets().iter().for_each(print_preset);
    }
    print_options(&options, &|name| {
        Ok(overridable(kernel.overridable(name)?, kernel.files()))
    })
}

/// Text on an option that says whether it can be overridden.
type Describe<'a> = dyn Fn(&str) -> Result<String, Failure> + 'a;

fn print_options(options: &[OptionInfo], overridable: &Describe<'_>) -> Result<(), Failure> {
    if options.is_empty() {
        outln!("\nIt has no options.");
        return Ok(());
    }
    outln!("\nOptions, for `--set OPTION=VALUE`:");
    for option in options {
        print_option(option);
        let is_single = matches!(option.kind, OptionKind::Number(_) | OptionKind::Flag);
        if is_single {
            let text = overridable(&option.name)?;
            outln!("{}", wrap_text(&text, WIDTH, "    ", "      "));
        }
    }
    Ok(())
}

/// Says of an option whether it can be overridden, and where a constant is needed if not.
fn overridable(answer: Overridable, files: &[File]) -> String {
    let refused = match answer {
        Overridable::Yes => return "can be overridden: `--override`".to_owned(),
        Overridable::Unread => return "can be overridden, where other options have it read".to_owned(),
        Overridable::No(refused) => refused,
    };
    let reason = refused.message.split_once(": ").map_or("", |(_, reason)| reason);
    let place = refused.span.and_then(|span| {
        let file = files.get(span.file as usize)?;
        Some(format!(" ({}:{})", file.path, span.line))
    });
    format!("cannot be overridden: {reason}{}", place.unwrap_or_default())
}

fn print_preset(preset: &Preset) {
    outln!();
    let summary = format!("{}: {}", preset.name, preset.summary);
    outln!("{}", wrap_text(&summary, WIDTH, "  ", "      "));
    let settings = settings(preset);
    if !settings.is_empty() {
        outln!("{}", wrap_text(&settings.join(" "), WIDTH, "    ", "    "));
    }
}

/// Options of a preset as they are set.
fn settings(preset: &Preset) -> Vec<String> {
    let options = preset.options();
    options.map(|(name, value)| format!("{name}={value}")).collect()
}

fn print_option(option: &OptionInfo) {
    let line = |first: &str, text: &str| outln!("{}", wrap_text(text, WIDTH, first, "      "));
    outln!();
    line("  ", &format!("{}: {}", option.name, option.docs));
    match &option.kind {
        OptionKind::Choice(values) => {
            for (name, docs) in values {
                let mark = if option.default.choice() == Some(name.as_str()) {
                    " (default)"
                } else {
                    ""
                };
                line("    ", &format!("{name}{mark}: {docs}"));
            }
        }
        OptionKind::Number(of) => {
            let bound = |b: &Option<f64>| b.map_or("any".to_owned(), format_bound);
            let (or, default) = match option.uniform {
                true => ("", "default: uniform, "),
                false => (", or uniform", "default "),
            };
            let default = format!("({default}{})", option.default);
            line(
                "    ",
                &format!("{} to {}{or} {default}", bound(&of.min), bound(&of.max)),
            );
        }
        OptionKind::List { len, .. } => {
            let many = len.map_or("any number of".to_owned(), |len| len.to_string());
            let default = default_list(&option.default.to_string());
            line(
                "    ",
                &format!("{many} numbers, separated by commas (default {default})"),
            );
        }
        OptionKind::Flag => line("    ", &format!("true or false (default {})", option.default)),
    }
}

/// The default of a list, in few words where all of its numbers are the same.
fn default_list(default: &str) -> String {
    let numbers: Vec<&str> = default.split(',').collect();
    match numbers[..] {
        [""] => "none".to_owned(),
        [first, .., last] if numbers.len() > 8 && numbers.iter().all(|number| number == &last) => {
            format!("{} times {first}", numbers.len())
        }
        _ => default.to_owned(),
    }
}

/// A bound as its author wrote it: the shortest number that is the same float.
fn format_bound(bound: f64) -> String {
    let float = bound as f32;
    match f64::from(float) == bound {
        true => float.to_string(),
        false => bound.to_string(),
    }
}

fn engine_json(engine: &Engine) -> Value {
    let description = engine.description();
    let provided = MEANINGS
        .iter()
        .filter(|meaning| description.meanings.contains_key(meaning.name));
    let provided: Vec<&str> = provided.map(|meaning| meaning.name).collect();
    json!({
        "name": engine.name(), "title": description.title, "about": description.about, "provides": provided,
        "chains": description.chain.is_some(),
    })
}

fn kernel_json(kernel: &Kernel) -> Result<Value, Failure> {
    let summary = straightline_kernels::find(kernel.name()).map(|entry| entry.summary);
    let options = kernel.options()?;
    let options = options.iter().map(|option| option_json(kernel, option));
    let options = options.collect::<Result<Vec<Value>, Failure>>()?;
    let presets: Vec<Value> = kernel.presets().iter().map(preset_json).collect();
    Ok(json!({ "name": kernel.name(), "summary": summary, "presets": presets, "options": options }))
}

fn preset_json(preset: &Preset) -> Value {
    json!({ "name": preset.name, "summary": preset.summary, "options": settings(preset) })
}

fn option_json(kernel: &Kernel, option: &OptionInfo) -> Result<Value, Failure> {
    let values = match &option.kind {
        OptionKind::Choice(values) => json!(
            values
                .iter()
                .map(|(name, docs)| json!({ "value": name, "docs": docs }))
                .collect::<Vec<_>>()
        ),
        OptionKind::Number(of) => {
            json!({ "integer": of.is_integer(), "min": of.min, "max": of.max, "uniform": true })
        }
        OptionKind::List { len, of } => {
            json!({ "numbers": len, "integer": of.is_integer(), "min": of.min, "max": of.max })
        }
        OptionKind::Flag => json!(["true", "false"]),
    };
    let overridable = match option.kind {
        OptionKind::Number(_) | OptionKind::Flag => !matches!(kernel.overridable(&option.name)?, Overridable::No(_)),
        OptionKind::Choice(_) | OptionKind::List { .. } => false,
    };
    Ok(json!({
        "name": option.name, "docs": option.docs, "default": option.default.to_string(), "values": values,
        "uniform_by_default": option.uniform, "overridable": overridable,
    }))
}
