//! Options that a host sets when it creates the pipeline: their declarations in every language, and their manifest.

use straightline_codegen::diagnostic::{Code, Errors};
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::ir::Op;
use straightline_codegen::ir::print as print_graph;
use straightline_codegen::{EmitOptions, Form, Kernel, OptionValue, Overridable, Settings, ShaderSpec, Stage};
use straightline_manifest::{Manifest, OverrideType};

const TEXT: &str = "
options! {
    pub struct Cfg {
        /// How far.
        pub radius: i32 [1..=4] = 2,
        /// How much.
        pub tau: f32 = 500.0,
        /// Mirrored.
        pub mirrored: bool = false,
        /// Seed.
        pub seed: u32 = 7,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for x in 0..cfg.radius {
        let offset = if cfg.mirrored { -x } else { x };
        sum += color.load(pixel + ivec2(offset, 0)) * (cfg.tau * 2.0);
    }
    sum * cfg.seed as f32
}";

fn kernel() -> Kernel {
    Kernel::from_text("k.rs", TEXT, "k")
}

const ALL: [&str; 4] = ["radius", "tau", "mirrored", "seed"];

fn spec() -> ShaderSpec {
    let languages = Target::ALL.into_iter().filter(|target| *target != Target::Msl);
    ShaderSpec::new().override_options(ALL).targets(languages)
}

fn emit(spec: &ShaderSpec) -> Result<Emitted, Errors> {
    spec.emit(&kernel()).map(|(_, emitted)| emitted)
}

fn text(emitted: &Emitted, target: Target) -> &str {
    std::str::from_utf8(&emitted.files[&target]).expect("a text")
}

#[test]
fn every_language_declares_them() {
    // The languages of OpenGL without compute shaders are written for fragments.
    let emitted = emit(&spec().stage(Stage::Fragment)).unwrap_or_else(|e| panic!("{e}"));
    let wgsl = text(&emitted, Target::Wgsl);
    for declared in [
        "@id(0) override radius: i32 = 2; // 1 to 4\n",
        "@id(1) override tau: f32 = 500.0;\n",
        "@id(2) override mirrored: bool = false;\n",
        "@id(3) override seed: u32 = 7u;\n",
        "var<private> tau_value: f32 = tau;\n",
        "// tau = override(500)",
    ] {
        assert!(wgsl.contains(declared), "{declared}:\n{wgsl}");
    }
    let vulkan = text(&emitted, Target::Glsl450);
    assert!(
        vulkan.contains("layout(constant_id = 1) const float tau = 500.0;\n"),
        "{vulkan}"
    );
    assert!(
        vulkan.contains("layout(constant_id = 0) const int radius = 2; // 1 to 4\n"),
        "{vulkan}"
    );
    for target in Target::OPENGL {
        let glsl = text(&emitted, target);
        let macros =
            "#ifndef OVERRIDE_TAU\n#define OVERRIDE_TAU 500.0\n#endif\nconst float tau = float(OVERRIDE_TAU);\n";
        assert!(glsl.contains(macros), "{target}:\n{glsl}");
    }
    let hlsl = text(&emitted, Target::Hlsl);
    let macros = "#ifndef OVERRIDE_MIRRORED\n#define OVERRIDE_MIRRORED false\n#endif\nstatic const bool mirrored = OVERRIDE_MIRRORED;\n";
    assert!(hlsl.contains(macros), "{hlsl}");
}

#[test]
fn functions_have_no_numbers_for_them() {
    let languages = [Target::Wgsl, Target::Glsl450, Target::Essl300, Target::Hlsl];
    let emitted = emit(&spec().form(Form::Function).targets(languages)).unwrap_or_else(|e| panic!("{e}"));
    let wgsl = text(&emitted, Target::Wgsl);
    assert!(wgsl.contains("\noverride tau: f32 = 500.0;\n"), "{wgsl}");
    for target in [Target::Glsl450, Target::Essl300, Target::Hlsl] {
        let text = text(&emitted, target);
        assert!(
            text.contains("#define OVERRIDE_TAU 500.0\n") && !text.contains("constant_id"),
            "{target}:\n{text}"
        );
    }
}

#[test]
fn the_manifest_lists_them() {
    let set = ShaderSpec::new()
        .override_options(ALL)
        .set("radius", 3)
        .set("mirrored", true);
    let manifest = emit(&set).unwrap_or_else(|e| panic!("{e}")).manifest;
    let read = Manifest::from_json(&manifest.to_json()).expect("a manifest");
    assert_eq!(read, manifest);
    let found = manifest
        .overrides
        .iter()
        .map(|of| (of.name.as_str(), of.id, of.ty, of.default, of.range));
    let wanted = [
        ("radius", 0, OverrideType::I32, 3.0, Some([1.0, 4.0])),
        ("tau", 1, OverrideType::F32, 500.0, None),
        ("mirrored", 2, OverrideType::Bool, 1.0, None),
        ("seed", 3, OverrideType::U32, 7.0, None),
    ];
    assert_eq!(found.collect::<Vec<_>>(), wanted);
    assert_eq!(manifest.options["radius"], "override(3)");
    assert_eq!(manifest.overrides[1].define, "OVERRIDE_TAU");
    // The number does not depend on which options are overridden.
    let one = emit(&ShaderSpec::new().override_options(["seed"])).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(one.manifest.overrides[0].id, 3);
    let none = emit(&ShaderSpec::new()).unwrap_or_else(|e| panic!("{e}"));
    assert!(!none.manifest.to_json().contains("overrides"));
}

#[test]
fn all_spellings_are_the_same() {
    let compile = |settings: &Settings| kernel().compile(settings).unwrap_or_else(|e| panic!("{e}"));
    let knob = compile(&Settings::new().set("tau", 300).override_options(["tau"]));
    for spelling in ["override(300)", "override(300.0)"] {
        let set = compile(&Settings::new().set("tau", spelling));
        assert_eq!(
            (print_graph(&set.graph), &set.options),
            (print_graph(&knob.graph), &knob.options)
        );
    }
    let declared = compile(&Settings::new().override_options(["tau"]));
    assert_eq!(
        declared.options,
        compile(&Settings::new().set("tau", "override")).options
    );
    let value = OptionValue::Override(Box::new(OptionValue::Number(500.0)));
    assert_eq!(declared.options.get("tau"), Some(&value));
    assert_eq!(declared.changed, ["tau"]);
}

/// A default that would remove an operation decides nothing: `x * 1` and `x + 0` stay.
#[test]
fn defaults_decide_nothing() {
    let body = |tau: &str, mirrored: &str| {
        let set = Settings::new()
            .set("tau", tau)
            .set("mirrored", mirrored)
            .override_options(ALL);
        let compiled = kernel().compile(&set).unwrap_or_else(|e| panic!("{e}"));
        let text = print_graph(&compiled.graph);
        let lines = text.lines().filter(|line| !line.starts_with("override "));
        (lines.map(str::to_owned).collect::<Vec<_>>(), compiled.text_counts())
    };
    let usual = body("500", "false");
    for (tau, mirrored) in [("0", "true"), ("1", "false"), ("0.5", "true")] {
        assert_eq!(body(tau, mirrored), usual, "{tau} {mirrored}");
    }
    let compiled = kernel().compile(&spec().settings).unwrap_or_else(|e| panic!("{e}"));
    let loops: Vec<_> = compiled
        .loops
        .iter()
        .map(|report| report.reason.clone().unwrap_or_default())
        .collect();
    assert!(
        loops.iter().any(|reason| reason.contains("the override `radius`")),
        "{loops:?}"
    );
    let overrides = compiled
        .graph
        .nodes
        .iter()
        .filter(|node| matches!(node.op, Op::Override(_)));
    assert_eq!(overrides.count(), 4);
}

/// A macro replaces names in the whole text, so nothing else is called as one.
#[test]
fn macros_meet_no_other_name() {
    let text = "
options! {
    pub struct Cfg {
        /// One.
        pub tau: f32 = 1.0,
        /// Another.
        pub Tau: f32 = 2.0,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, OVERRIDE_TAU: f32, pixel: IVec2) -> Vec4 {
    color.load(pixel) * cfg.tau + Vec4::splat(OVERRIDE_TAU * cfg.Tau)
}";
    let kernel = Kernel::from_text("k.rs", text, "k");
    let spec = ShaderSpec::new().set("tau", "override").set("Tau", "override");
    let (_, emitted) = spec
        .targets([Target::Hlsl])
        .emit(&kernel)
        .unwrap_or_else(|e| panic!("{e}"));
    let hlsl = std::str::from_utf8(&emitted.files[&Target::Hlsl]).expect("a text");
    let defines: Vec<&str> = emitted.manifest.overrides.iter().map(|of| of.define.as_str()).collect();
    assert_eq!(defines.len(), 2);
    assert_ne!(defines[0], defines[1]);
    for define in defines {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let uses = hlsl.split(|c| !is_word(c)).filter(|word| *word == define).count();
        assert_eq!(uses, 3, "{define}:\n{hlsl}");
    }
}

#[test]
fn options_tell_what_depends_on_them() {
    let text = TEXT.replace(
        "let mut sum = Vec4::ZERO;",
        "let mut sum = Vec4::ZERO; let _taps = [0.0; cfg.radius as usize];",
    );
    let kernel = Kernel::from_text("k.rs", &text, "k");
    let Ok(Overridable::No(refused)) = kernel.overridable("radius") else {
        panic!("a length depends on it");
    };
    assert_eq!(refused.code(), Some(Code::CannotOverride));
    assert_eq!(refused.span.map(|span| span.line), Some(16));
    assert_eq!(kernel.overridable("tau").expect("a kernel"), Overridable::Yes);
    let sraa = Kernel::builtin("sraa").expect("built in");
    assert_eq!(sraa.overridable("latin").expect("a kernel"), Overridable::Unread);
}

#[test]
fn names_that_mean_others_are_refused() {
    let refused = ShaderSpec::new()
        .override_options(["radus"])
        .compile(&kernel())
        .expect_err("no such option");
    assert_eq!(refused.first_code(), Some(Code::UnknownOption));
    assert!(refused.to_string().contains("did you mean `radius`?"), "{refused}");
    let msl = ShaderSpec::new().override_options(ALL).targets([Target::Msl]);
    let refused = emit(&msl).expect_err("msl has none");
    assert!(refused.to_string().contains("`radius`"), "{refused}");
    let unread = EmitOptions::new().targets([Target::Msl]);
    let constant = kernel()
        .compile(&Settings::new())
        .and_then(|compiled| compiled.emit(&unread));
    constant.unwrap_or_else(|e| panic!("{e}"));
}
