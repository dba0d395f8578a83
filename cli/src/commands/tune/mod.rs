//! `tune`: the cheapest shader that is good enough for a scene.

mod print;

use super::study::isa::start_compiler;
use super::study::{ProgressBars, circumstances_of};
use crate::args::TuneArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use glam::UVec2;
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::{EmitOptions, Kernel, OptionValue, OptionValues, Settings, files};
use straightline_scene::capture::Capture;
use straightline_scene::gbuffer;
use straightline_study::progress::Progress;
use straightline_study::record::Record;
use straightline_study::tune::{self, Beyond, Chosen, Cost, Gauge, PATTERNS, Question, Subject, TuneError};

/// Default size of a scene's picture.
const SIZE: UVec2 = UVec2::new(640, 360);

/// Searches, writes the record and the shader, and prints the result.
pub fn tune_shader(args: &TuneArgs) -> Result<(), Failure> {
    let asked = asked_options(args)?;
    files::try_folder(&args.out).map_err(Failure::from_error)?;
    let gpu = Gpu::require(&args.adapter)?;
    // A missing compiler is reported before anything is drawn.
    let gauge = open_gauge(args.cost)?;
    let mut progress = ProgressBars::new();
    let Some(subject) = draw_subject(args, &asked, &gpu, &mut progress)? else {
        return Err(nothing_measured());
    };
    let no_half = match (gpu.has_half(), args.target.contains(&Target::Glsl450)) {
        (false, _) => Some("the adapter has none".to_owned()),
        (true, true) => Some("GLSL, which is asked for, has none".to_owned()),
        (true, false) => None,
    };
    let question = Question {
        metric: args.metric,
        max_error: args.max_error,
        rounds: args.rounds,
        no_half,
        fixed: args.set.clone(),
    };
    let stem = stem(&subject.name);
    let circumstances = circumstances_of(&gpu, subject.size(), args.rounds);
    let found = tune::tune_subject(&gpu.bench(), subject, &question, gauge, circumstances, &mut progress)
        .map_err(to_failure)?;
    drop(progress);
    let Some(outcome) = found else {
        return Err(nothing_measured());
    };
    let emitted = outcome
        .chosen
        .as_ref()
        .map(|chosen| emit_chosen(args, chosen))
        .transpose()?;
    let place = outcome.chosen.as_ref().and_then(|chosen| chosen.place.as_ref());
    let place = place.map(|compiled| compiled.emit(&emit_options(args))).transpose()?;
    // The shader and the record that justifies it are written as one set.
    let mut set = outcome
        .record
        .to_files(&format!("tune-{stem}"))
        .map_err(Failure::from_error)?;
    if let Some(emitted) = emitted {
        set.extend(emitted.named_files(&format!("sraa-{stem}")));
    }
    if let Some(place) = place {
        set.extend(place.named_files(&format!("sraa-place-{stem}")));
    }
    let written = files::write_all(&args.out, &set).map_err(Failure::from_error)?;
    print::print_report(args, &outcome.record, &written)?;
    match outcome.chosen {
        Some(_) => Ok(()),
        None => Err(Failure::Failed(format!(
            "interrupted: the record in `{}` has what was measured, and no shader was chosen",
            args.out.display()
        ))),
    }
}

fn open_gauge(cost: Cost) -> Result<Gauge, Failure> {
    let Cost::Isa(gpu) = cost else {
        return Ok(Gauge::Device);
    };
    let compiler = start_compiler(gpu).map_err(Failure::from_error)?;
    Ok(Gauge::Compiler(Box::new(compiler)))
}

/// Draws the subject to tune for; returns `None` if interrupted.
fn draw_subject(
    args: &TuneArgs,
    asked: &OptionValues,
    gpu: &Gpu,
    progress: &mut dyn Progress,
) -> Result<Option<Subject>, Failure> {
    if let Some(folder) = &args.subject.capture {
        let capture = Capture::read(folder).map_err(Failure::from_error)?;
        return Ok(Some(Subject::of_capture(&folder.display().to_string(), capture)));
    }
    let name = args.subject.scene.as_deref().unwrap_or_default();
    let world = scene::load_scene(args.subject.mesh.as_deref(), name)?;
    let name = match &args.subject.mesh {
        Some(path) => path.display().to_string(),
        None => name.to_owned(),
    };
    let renderer = scene::create_renderer(Some(gpu), &world, args.size.unwrap_or(SIZE))?;
    // Terms that are not searched need not be drawn.
    let beyond = Beyond {
        placing: asked.choice("shading").is_none_or(|place| place == "placed"),
        light: asked.choice("demodulate").is_none_or(|what| what != "none"),
    };
    let patterns: Vec<&str> = match asked.choice("pattern") {
        Some(pattern) if gbuffer::PATTERNS.contains(&pattern) => vec![pattern],
        Some(other) => {
            return Err(Failure::Usage(format!(
                "a scene is not sampled at `pattern={other}` here; use one of {}, or tune a capture",
                gbuffer::PATTERNS.join(", ")
            )));
        }
        None => PATTERNS.to_vec(),
    };
    Subject::of_scene(&name, renderer.as_ref(), &patterns, beyond, progress).map_err(to_failure)
}

/// Returns the values of the options that are set. Rejects unknown options, and options left to a host, before anything is
/// drawn.
fn asked_options(args: &TuneArgs) -> Result<OptionValues, Failure> {
    let settings = Settings::new().set_all(args.set.clone());
    let mut asked = Kernel::builtin("sraa")?.compile(&settings)?.options;
    asked.retain(|name, _| args.set.iter().any(|(set, _)| set == name));
    let is_left = |value: &OptionValue| matches!(value, OptionValue::Uniform | OptionValue::Override(_));
    if let Some((name, value)) = asked.iter().find(|(_, value)| is_left(value)) {
        return Err(Failure::Usage(format!(
            "`{name}={value}` leaves the value to a host; here give a number"
        )));
    }
    Ok(asked)
}

fn emit_chosen(args: &TuneArgs, chosen: &Chosen) -> Result<Emitted, Failure> {
    let options = emit_options(args).precision(chosen.precision).accept_loss(true);
    let mut emitted = chosen.compiled.emit(&options)?;
    emitted.manifest.tuned = Some(chosen.tuned.clone());
    Ok(emitted)
}

fn emit_options(args: &TuneArgs) -> EmitOptions {
    EmitOptions::new()
        .format(args.format)
        .targets(args.target.iter().copied())
}

/// Returns the stem of file names for a scene, a model's path or a capture's.
fn stem(name: &str) -> String {
    let path = std::path::Path::new(name);
    let last = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("scene");
    let kept = last
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '-' });
    kept.collect()
}

fn nothing_measured() -> Failure {
    Failure::Failed("interrupted before anything was measured: nothing is written".to_owned())
}

fn to_failure(error: TuneError) -> Failure {
    match error {
        TuneError::Kernel(errors) => Failure::Kernel(errors),
        TuneError::Space(message) => Failure::Usage(message),
        other => Failure::from_error(other),
    }
}
