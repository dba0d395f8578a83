//! Knobs: each has one text, one example and one entry in `docs/settings.md`, wherever it is set.
//!
//! `STRAIGHTLINE_BLESS=1` writes the page.

use std::path::Path;
use straightline_codegen::kernels::sraa::{Metric, Pattern, Sraa};
use straightline_codegen::spec::{Arity, KNOBS, Knob, Part, Target};
use straightline_codegen::{Config, Kernel, Overrides, ShaderSpec, Stage};

const INTRODUCTION: &str = "# Settings of a shader

Settings describe how a shader is computed and written.
A setting has the same name, values and default wherever you set it.

* In `build.rs`, a method of the kernel's configuration, of `ShaderSpec`, or of its half `Settings` or `EmitOptions`.
* On the command line, `--NAME` of `emit` and `check`; commands that run a kernel take those of the first half.
* On the page, a control, and a key of the messages to its generator.
* In `engine.toml`, a key of a shader, for settings that the engine determines.
";

/// Returns the expected contents of `docs/settings.md`.
fn page() -> String {
    let mut page = INTRODUCTION.to_owned();
    for (part, heading, about) in [
        (Part::Settings, "What is computed", "`Settings`, for `Kernel::compile`."),
        (
            Part::EmitOptions,
            "How it is written",
            "`EmitOptions`, for `Compiled::emit`.",
        ),
    ] {
        page += &format!("\n## {heading}\n\n{about}\n");
        for knob in KNOBS.iter().filter(|knob| knob.part == part) {
            let value = if knob.value.is_empty() {
                String::new()
            } else {
                format!(" {}", knob.value)
            };
            let help = format!("{}.", knob.help());
            let sentences: Vec<String> = help
                .split_inclusive(". ")
                .map(|sentence| wrapped(sentence.trim()))
                .collect();
            page += &format!("\n### {}\n\n{}\n\n", knob.name, sentences.join("\n"));
            page += &format!("`--{}{value}`, `{}`", knob.name, knob.call);
            let default = knob.value_texts(&ShaderSpec::new()).join(",");
            page += &match (knob.arity, default.as_str()) {
                (Arity::Flag, _) | (_, "") => "\n".to_owned(),
                (_, default) => format!("; by default `{default}`\n"),
            };
        }
    }
    page
}

/// Breaks a sentence into lines of at most 120 columns.
fn wrapped(sentence: &str) -> String {
    let mut lines = vec![String::new()];
    for word in sentence.split(' ') {
        let line = lines.last().map_or(0, |line| line.chars().count());
        if line > 0 && line + 1 + word.chars().count() > 120 {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            *line += if line.is_empty() { "" } else { " " };
            *line += word;
        }
    }
    lines.join("\n")
}

#[test]
fn the_page_has_every_knob() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/settings.md");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(&path, page()).expect("a page that can be written");
    }
    let written = std::fs::read_to_string(&path).expect("docs/settings.md");
    assert_eq!(written, page(), "STRAIGHTLINE_BLESS=1 writes docs/settings.md");
}

/// Returns the texts of a knob's example.
fn texts(knob: &Knob) -> Vec<String> {
    knob.value_texts(&knob.example(ShaderSpec::new()))
}

#[test]
fn each_text_is_read_as_the_value_that_wrote_it() {
    for knob in KNOBS {
        let example = knob.example(ShaderSpec::new());
        assert_ne!(example, ShaderSpec::new(), "{}: the example is the default", knob.name);
        for spec in [example, ShaderSpec::new()] {
            let (mut read, texts) = (knob.example(ShaderSpec::new()), knob.value_texts(&spec));
            let borrowed: Vec<&str> = texts.iter().map(String::as_str).collect();
            let set = if knob.arity == Arity::Many || !texts.is_empty() {
                knob.set(&mut read, &borrowed)
            } else {
                continue;
            };
            assert_eq!((set, &read), (Ok(()), &spec), "{}", knob.name);
        }
    }
}

#[test]
fn values_that_are_none_are_refused_by_name() {
    for knob in KNOBS {
        let mut spec = ShaderSpec::new();
        let refused = knob.set(&mut spec, &["no such \u{1b}value"]);
        // Any word is a name.
        if ["entry", "reserve", "half", "override"].contains(&knob.name) {
            assert_eq!(refused, Ok(()));
            continue;
        }
        let refused = refused.expect_err(knob.name);
        assert!(refused.contains("no such"), "{}: {refused}", knob.name);
        assert_eq!(spec, ShaderSpec::new(), "{}", knob.name);
    }
    let unknown = Knob::find("unrol").expect_err("no knob");
    assert_eq!(unknown, "a shader has no setting `unrol`: did you mean `unroll`?");
}

#[test]
fn json_holds_what_is_changed() {
    let all = KNOBS.iter().fold(ShaderSpec::new(), |spec, knob| knob.example(spec));
    let json = serde_json::to_string_pretty(&all).expect("JSON");
    assert_eq!(serde_json::from_str::<ShaderSpec>(&json).expect(&json), all, "{json}");
    assert_eq!(serde_json::to_string(&ShaderSpec::new()).expect("JSON"), "{}");
    let other = r#"{ "set": { "pattern": "latin16", "tau": 500 }, "block": "2x2", "region": true, "group": 1 }"#;
    let other: ShaderSpec = serde_json::from_str(other).expect("a description");
    let same = ShaderSpec::new()
        .set("pattern", "latin16")
        .set("tau", 500)
        .block(2, 2)
        .region(true)
        .group(1);
    assert_eq!(other, same);
    for (json, says) in [
        (r#"{ "unrol": "none" }"#, "did you mean `unroll`?"),
        (r#"{ "unroll": "some" }"#, "unknown unroll policy `some`"),
        (
            r#"{ "unroll": ["full", "none"] }"#,
            "it takes one value, and 2 are given",
        ),
        (r#"{ "region": "yes" }"#, "neither `true` nor `false`"),
        (r#"{ "block": { "x": 2 } }"#, "not a size"),
        (r#"{ "block": null }"#, "a text, a number"),
        (r#"{ "target": "" }"#, "unknown language ``"),
        (r#"{ "reserve": "a,,b" }"#, "an empty word"),
    ] {
        let error = serde_json::from_str::<Overrides>(json).expect_err(json).to_string();
        assert!(error.contains(says), "{json}: {error}");
    }
}

/// The typed options of a built-in kernel equal the same options as texts.
#[test]
fn structures_of_options_are_texts() {
    let typed = Sraa {
        pattern: Pattern::Listed,
        metric: Metric::Normals,
        offsets: &[-0.25, -0.25, 0.25, 0.25],
        tau: 250.0,
        rest: true,
        ..Sraa::default()
    };
    let spec = ShaderSpec::new().options(&typed);
    let texts = [
        "pattern=listed",
        "offsets=-0.25,-0.25,0.25,0.25",
        "metric=normals",
        "rest=true",
        "tau=250.0",
    ];
    let mut found: Vec<String> = spec
        .settings
        .options
        .iter()
        .map(|(name, value)| format!("{name}={value}"))
        .collect();
    found.sort_unstable();
    let mut wanted = texts.map(str::to_owned);
    wanted.sort_unstable();
    assert_eq!(found, wanted);
    let kernel = Kernel::builtin("sraa").expect("a kernel");
    let values = kernel.option_values(&spec.settings.options).expect("values");
    let set = texts.iter().filter_map(|text| text.split_once('='));
    let set: Vec<_> = set.map(|(name, value)| (name.to_owned(), value.to_owned())).collect();
    assert_eq!(values, kernel.option_values(&set).expect("values"));
    assert!(ShaderSpec::new().options(&Sraa::default()).settings.options.is_empty());
}

/// A description shared by several shaders writes the same files in a `build.rs` and without one.
#[test]
fn configurations_write_what_a_description_says() {
    let spec = ShaderSpec::new()
        .set("pattern", "ordered4")
        .stage(Stage::Fragment)
        .entry("antialias");
    let folder = std::env::temp_dir().join(format!("straightline-knobs-{}", std::process::id()));
    let config = Config::new()
        .kernel("sraa", |k| k.spec(spec.clone()).name("aa"))
        .out_dir(&folder);
    config.compile().unwrap_or_else(|errors| panic!("{errors}"));
    let (_, emitted) = spec
        .emit(&Kernel::builtin("sraa").expect("a kernel"))
        .unwrap_or_else(|e| panic!("{e}"));
    for (name, bytes) in emitted.named_files("aa") {
        assert_eq!(std::fs::read(folder.join(&name)).expect(&name), bytes, "{name}");
    }
    std::fs::remove_dir_all(&folder).expect("a folder of ours");
}

/// Bindings include the WGSL, whatever languages are requested.
#[test]
fn configurations_always_write_wgsl() {
    let folder = std::env::temp_dir().join(format!("straightline-targets-{}", std::process::id()));
    let config = Config::new()
        .kernel("tabula_rasa", |k| k.targets([Target::Hlsl]))
        .out_dir(&folder);
    config.compile().unwrap_or_else(|errors| panic!("{errors}"));
    for extension in ["wgsl", "hlsl"] {
        let path = folder.join("tabula_rasa").with_extension(extension);
        assert!(path.metadata().is_ok_and(|file| file.len() > 0), "{}", path.display());
    }
    std::fs::remove_dir_all(&folder).expect("a folder of ours");
}

#[test]
fn the_order_of_knobs_is_that_of_their_halves() {
    let parts: Vec<Part> = KNOBS.iter().map(|knob| knob.part).collect();
    let first = parts.iter().take_while(|part| **part == Part::Settings).count();
    assert!(parts[first..].iter().all(|part| *part == Part::EmitOptions));
    assert!(KNOBS.iter().all(|knob| !texts(knob).is_empty()));
}
