//! Knobs: `emit`, `check` and the page's generator have all that `build.rs` has, and make the same of them.

use crate::common;

use common::{finishes, here, is_empty, scratch, straightline};
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::emit::Emitted;
use straightline_codegen::spec::{Arity, KNOBS, Knob};
use straightline_codegen::{Kernel, ShaderSpec, Stage};

/// A knob's example as arguments, with what it needs beside.
fn arguments(knob: &Knob, spec: &ShaderSpec) -> Vec<String> {
    let texts = knob.value_texts(spec);
    match knob.arity {
        Arity::Flag => vec![format!("--{}", knob.name)],
        _ => texts.iter().map(|text| format!("--{}={text}", knob.name)).collect(),
    }
}

/// A kernel that the example of a knob fits, and the description with it.
fn case(knob: &Knob) -> (&'static str, ShaderSpec) {
    let function = || {
        ShaderSpec::new()
            .form(straightline_codegen::Form::Function)
            .stage(Stage::Fragment)
    };
    let hlsl = |spec: ShaderSpec| spec.targets([straightline_codegen::emit::Target::Hlsl]);
    let (kernel, base) = match knob.name {
        "transport" => ("quad_convolution", ShaderSpec::new()),
        "set" | "override" | "repeat-loads" | "enable-subgroups" => ("sraa", ShaderSpec::new()),
        "texels" | "global-uniforms" => ("kernels/filters/gaussian.rs", hlsl(function())),
        "register" => ("kernels/filters/gaussian.rs", hlsl(ShaderSpec::new())),
        "accept-loss" => (
            "sraa",
            ShaderSpec::new().precision(straightline_codegen::Precision::F16),
        ),
        _ => ("kernels/filters/gaussian.rs", ShaderSpec::new()),
    };
    (kernel, knob.example(base))
}

/// Arguments that make a description of the default one.
fn all_arguments(spec: &ShaderSpec) -> Vec<String> {
    let changed = KNOBS
        .iter()
        .filter(|knob| knob.value_texts(spec) != knob.value_texts(&ShaderSpec::new()));
    changed.flat_map(|knob| arguments(knob, spec)).collect()
}

fn built(kernel: &str, spec: &ShaderSpec) -> Result<Emitted, Errors> {
    spec.emit(&Kernel::from_argument(kernel)?).map(|(_, emitted)| emitted)
}

/// The kernel as the command and this program both find it.
fn located(kernel: &str) -> String {
    match kernel.ends_with(".rs") {
        true => here(kernel),
        false => kernel.to_owned(),
    }
}

#[test]
fn emit_writes_what_a_build_script_does() {
    let folder = scratch("knobs");
    for knob in KNOBS {
        let (kernel, spec) = case(knob);
        let kernel = located(kernel);
        let out = folder.join(knob.name);
        let mut command = vec![
            "emit".to_owned(),
            kernel.clone(),
            "--out".to_owned(),
            out.display().to_string(),
        ];
        command.extend(all_arguments(&spec));
        let words: Vec<&str> = command.iter().map(String::as_str).collect();
        match built(&kernel, &spec) {
            Ok(emitted) => {
                finishes(&words);
                let files = emitted.named_files(&emitted.manifest.kernel);
                assert_eq!(
                    std::fs::read_dir(&out).expect("a folder").count(),
                    files.len(),
                    "{}",
                    knob.name
                );
                for (name, bytes) in files {
                    assert!(
                        std::fs::read(out.join(&name)).expect(&name) == bytes,
                        "{}: {name}",
                        knob.name
                    );
                }
            }
            Err(errors) => panic!("{}: {errors}", knob.name),
        }
    }
}

#[test]
fn check_takes_what_emit_takes() {
    for knob in KNOBS {
        let (kernel, spec) = case(knob);
        let kernel = located(kernel);
        let command = [vec!["check".to_owned(), kernel], all_arguments(&spec)].concat();
        finishes(&command.iter().map(String::as_str).collect::<Vec<_>>());
    }
}

/// The help of both names each knob.
#[test]
fn help_names_every_knob() {
    for command in ["emit", "check"] {
        let help = finishes(&[command, "--help"]);
        let missing = KNOBS.iter().filter(|knob| !help.contains(&format!("--{}", knob.name)));
        assert_eq!(missing.map(|knob| knob.name).collect::<Vec<_>>(), [""; 0], "{command}");
    }
}

/// An engine's own choices are no argument's; every other knob goes through.
#[test]
fn engines_take_knobs_that_they_do_not_decide() {
    let folder = scratch("knobs-of-engines");
    let kernel = here("kernels/filters/gaussian.rs");
    for knob in KNOBS
        .iter()
        .filter(|knob| knob.part == straightline_codegen::spec::Part::EmitOptions)
    {
        let out = folder.join(knob.name);
        let to = out.display().to_string();
        let (_, spec) = case(knob);
        let given = arguments(knob, &spec);
        let mut command = vec!["emit", &kernel, "--engine", "bevy", "--out", &to];
        command.extend(given.iter().map(String::as_str));
        let output = straightline(&command);
        let said = String::from_utf8_lossy(&output.stderr);
        if straightline_engines::FIXED.contains(&knob.name) {
            assert_eq!(output.status.code(), Some(2), "{}: {said}", knob.name);
            assert!(said.contains("--engine") && is_empty(&out), "{}: {said}", knob.name);
        } else {
            // Bevy's shader is a function, which has no immediates.
            let needs = ["accept-loss", "parameters", "precision"].contains(&knob.name);
            assert!(output.status.success() || needs, "{}: {said}", knob.name);
        }
    }
}
