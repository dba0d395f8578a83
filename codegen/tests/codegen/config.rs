//! The builder of a `build.rs`: what it refuses, and what its options come to in what is written.

use std::error::Error;
use std::io;
use std::path::PathBuf;
use straightline_codegen::config::{KernelConfig, Variants};
use straightline_codegen::emit::Target;
use straightline_codegen::{Config, Form, Format, Manifest, Origin, Stage, Transport, Unroll};

fn said(config: &Config) -> String {
    config.compile().expect_err("a refusal").to_string()
}

#[test]
fn factors_and_folders_that_say_nothing_are_refused() {
    let out = std::env::temp_dir().join(format!("straightline-config-{}", std::process::id()));
    let unrolled = |unroll| Config::new().kernel("sraa", |k| k.unroll(unroll)).out_dir(&out);
    for n in [0, 1, 4096] {
        let error = said(&unrolled(Unroll::Partial(n)));
        assert!(error.contains(&format!("cannot be unrolled by {n}")), "{error}");
    }
    let of_one = Config::new().kernel("sraa", |k| k.unroll_loop("sraa.tap", Unroll::Partial(0)));
    let error = said(&of_one.out_dir(&out));
    assert!(error.contains("the loop `sraa.tap` cannot be unrolled by 0"), "{error}");
    let twice = Config::new().kernel("sraa", |k| k.set("pattern", "latin4").set("pattern", "latin16"));
    let error = said(&twice.out_dir(&out));
    assert!(
        error.contains("`pattern` is set twice, to `latin4` and to `latin16`"),
        "{error}"
    );
    let error = said(&Config::new().kernel("stalker", |k| k).out_dir(""));
    assert!(error.contains("the folder to write to is empty"), "{error}");
    assert!(!out.exists());
}

#[test]
fn settings_that_would_be_ignored_are_refused() {
    let refused = |options: fn(KernelConfig) -> KernelConfig| {
        said(&Config::new().kernel("stalker", options).out_dir(folder("ignored")))
    };
    let error = refused(|k| k.function("edges"));
    assert!(error.contains("`stalker` is built in"), "{error}");
    for options in [
        (|k| k.workgroup(8, 8).stage(Stage::Fragment)) as fn(KernelConfig) -> KernelConfig,
        |k| k.workgroup(8, 8).form(Form::Function),
    ] {
        let error = refused(options);
        assert!(
            error.contains("have no workgroup") && error.contains("E0703"),
            "{error}"
        );
    }
}

#[test]
fn variants_that_cannot_be_are_refused_by_their_options() {
    let refused = |vary: fn(Variants) -> Variants| {
        said(
            &Config::new()
                .kernel("sraa", |k| k.set("pattern", "latin4").variants(vary))
                .out_dir(folder("variants")),
        )
    };
    let error = refused(|v| v.set("metric", ["depth", "dept"]).set("mask", ["none", "branch"]));
    assert!(error.starts_with("with metric=dept mask=none:\nerror[E0"), "{error}");
    // Another combination with the same error is not named.
    assert_eq!(error.matches("with metric").count(), 1, "{error}");
    let error = refused(|v| v.set("pattern", ["latin16"]));
    assert_eq!(
        error,
        "variants of `sraa`: the option `pattern` is varied, and set to `latin4` for all: leave one out"
    );
}

#[test]
fn candidates_that_cannot_take_its_place_are_refused() {
    let refused = |options: fn(KernelConfig) -> KernelConfig| {
        said(&Config::new().kernel("sraa", options).out_dir(folder("candidates")))
    };
    let error = refused(|k| k.candidate("few", |s| s.set("pattern", "latin16")));
    assert_eq!(
        error,
        "candidates for `sraa`: the candidate `few` sets options, and candidates compute the same: use `.variants(..)`"
    );
    let error = refused(|k| k.candidate("later", |s| s.override_options(["tau"])));
    assert!(error.contains("`later` sets options"), "{error}");
    let error = refused(|k| k.candidate("a b", |s| s));
    assert!(error.contains("`a b` cannot name a candidate"), "{error}");
    let error = refused(|k| k.candidate("rgba8", |s| s.format(Format::Rgba8Unorm)));
    assert!(error.contains("`rgba8` cannot take its place: target `"), "{error}");
    let error = refused(|k| {
        k.candidate("blocks", |s| s.block(3, 1))
            .candidate("none", |s| s.workgroup(0, 1))
    });
    assert!(error.contains("in the candidate `none`:\nerror[E"), "{error}");
    let error = refused(|k| {
        k.candidate("looped", |s| s.unroll(Unroll::None))
            .variants(|v| v.set("metric", ["depth"]))
    });
    assert!(error.contains("it has variants, too"), "{error}");
    let error = refused(|k| k.form(Form::Function).candidate("looped", |s| s.unroll(Unroll::None)));
    assert!(error.contains("only passes are timed"), "{error}");
}

/// The manifest, the shader and the Rust of one built-in kernel.
fn written(kernel: &str, options: impl FnOnce(KernelConfig) -> KernelConfig) -> (Manifest, String, String) {
    let folder = folder(kernel);
    let config = Config::new().kernel(kernel, options).out_dir(&folder);
    config.compile().unwrap_or_else(|e| panic!("{e}"));
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let manifest = Manifest::from_json(&read(&format!("{kernel}.json"))).expect("a manifest");
    let all = (manifest, read(&format!("{kernel}.wgsl")), read("straightline.rs"));
    std::fs::remove_dir_all(&folder).expect("it goes");
    all
}

fn folder(name: &str) -> PathBuf {
    let name = format!(
        "straightline-config-{name}-{}-{:?}",
        std::process::id(),
        std::thread::current().id()
    );
    std::env::temp_dir().join(name.replace(['(', ')'], "-"))
}

#[test]
fn places_and_names_come_to_the_shader_and_its_rust() {
    let (manifest, wgsl, rust) = written("stalker", |k| {
        k.group(1)
            .binding("color", 5)
            .entry("edges")
            .target(Target::Hlsl)
            .register("color", "t3".parse().expect("a register"))
    });
    assert!(
        wgsl.contains("@group(1) @binding(5) var color") && wgsl.contains("fn edges("),
        "{wgsl}"
    );
    assert_eq!(manifest.entry_point, "edges");
    let registers: Vec<_> = manifest
        .language_bindings
        .iter()
        .filter(|b| b.name == "color")
        .map(|b| b.register.as_deref())
        .collect();
    assert_eq!(registers, [Some("t3")]);
    for line in [
        "Layout of bind group 1, ",
        "binding: 5",
        r#"ENTRY_POINT: &str = "edges""#,
    ] {
        assert!(rust.contains(line), "no `{line}` in\n{rust}");
    }
    let error = said(
        &Config::new()
            .kernel("stalker", |k| k.binding("colr", 5))
            .out_dir(folder("refused")),
    );
    assert!(error.contains("did you mean `color`"), "{error}");
}

#[test]
fn a_function_is_a_module_without_a_pass() {
    let (manifest, wgsl, rust) = written("stalker", |k| k.form(Form::Function).origin(Origin::LowerLeft));
    assert_eq!((manifest.form, manifest.origin), (Form::Function, Origin::LowerLeft));
    assert!(wgsl.starts_with("fn stalker("), "{wgsl}");
    assert!(
        rust.contains(r#"FUNCTION: &str = "stalker""#) && !rust.contains("Pass"),
        "{rust}"
    );
}

#[test]
fn transports_and_blocks_are_the_command_lines() {
    let (manifest, ..) = written("sraa", |k| k.block(2, 2));
    assert_eq!(manifest.block, [2, 2]);
    let (manifest, wgsl, _) = written("pcf", |k| k.transport(Transport::Derivatives).stage(Stage::Fragment));
    assert!(manifest.features.is_empty() && wgsl.contains("dpdyFine"), "{wgsl}");
    let error = said(
        &Config::new()
            .kernel("pcf", |k| k.transport(Transport::Subgroup))
            .out_dir(folder("refused")),
    );
    assert!(error.contains("no pixel quads"), "{error}");
    let error = said(
        &Config::new()
            .kernel("sraa", |k| k.block(9, 9))
            .out_dir(folder("refused")),
    );
    assert!(error.contains("a block of 9x9 pixels"), "{error}");
}

/// The system's own error is behind that of a build.
#[test]
fn sources_are_kept() {
    fn kind(config: &Config) -> Option<io::ErrorKind> {
        let error = config.compile().expect_err("it fails");
        let source = error.source()?.downcast_ref::<io::Error>()?;
        Some(source.kind())
    }
    let none = Config::new().file("no/such/kernel.rs").out_dir(folder("sources"));
    assert_eq!(kind(&none), Some(io::ErrorKind::NotFound));
    let file = folder("sources-file");
    std::fs::write(&file, "").expect("a file");
    let no_folder = Config::new().kernel("stalker", |k| k).out_dir(&file);
    assert!(kind(&no_folder).is_some());
    std::fs::remove_file(&file).expect("it goes");
}

#[test]
fn a_shader_is_emitted_as_it_is_written() {
    let folder = folder("emitted");
    std::fs::create_dir_all(&folder).expect("a folder");
    let (file, more) = (folder.join("twice.rs"), folder.join("more.rs"));
    let text = "pub fn twice(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { grown(color.load(pixel)) }\n";
    std::fs::write(&file, text).expect("a file");
    std::fs::write(&more, "pub fn grown(x: Vec4) -> Vec4 { 2.0 * x }\n").expect("a file");
    let settings = |k: KernelConfig| k.source(&more).stage(Stage::Fragment);
    let config = settings(KernelConfig::from_file(&file));
    assert_eq!(config.files().collect::<Vec<_>>(), [&file, &more]);
    let emitted = config.emit().unwrap_or_else(|e| panic!("{e}"));
    let written = Config::new().file_with(&file, settings).out_dir(&folder);
    written.compile().unwrap_or_else(|e| panic!("{e}"));
    let wgsl = std::fs::read_to_string(folder.join("twice.wgsl")).expect("a shader");
    assert_eq!(emitted.wgsl(), wgsl);
    let several = config.variants(|v| v.set("none", ["1", "2"])).emit().map(drop);
    assert!(several.expect_err("a refusal").to_string().contains("none"));
    std::fs::remove_dir_all(&folder).expect("it goes");
}
