//! Emission and manifests in half precision, and the rejected kernels.

use super::*;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use straightline_codegen::emit::Target;
use straightline_codegen::ir::Invocation;
use straightline_codegen::{Config, EmitOptions, Manifest};
use straightline_runtime::Pass;
use wgpu::naga;
use wgpu::naga::Expression;
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder for shaders");
    folder
}

fn options(stage: Stage) -> EmitOptions {
    EmitOptions::new()
        .stage(stage)
        .precision(Precision::F16)
        .accept_loss(true)
}

/// Naga validates each text on the way, and another validator reads the SPIR-V.
#[test]
fn every_kernel_emits_in_every_language_but_glsl() {
    let folder = folder("half");
    let targets = Target::MODERN.into_iter().filter(|t| *t != Target::Glsl450);
    let targets: BTreeSet<Target> = targets.collect();
    let mut spirv = Vec::new();
    for compiled in kernels::compiled() {
        for stage in [Stage::Compute, Stage::Fragment] {
            let emitted = compiled.emit(&options(stage).targets(targets.clone()));
            let emitted = emitted.unwrap_or_else(|e| panic!("{} {}: {e}", compiled.kernel, stage.name()));
            assert_eq!(emitted.files.len(), targets.len());
            let text = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
            assert!(text.starts_with("enable f16;\n\n// "), "{text}");
            assert!(text.contains("half precision (f16), output"), "{text}");
            assert!(String::from_utf8_lossy(&emitted.files[&Target::Hlsl]).contains("half"));
            assert!(String::from_utf8_lossy(&emitted.files[&Target::Msl]).contains("half"));
            let manifest = &emitted.manifest;
            assert_eq!(manifest.precision, Precision::F16);
            assert!(manifest.features.contains(&"shader-f16".to_owned()));
            let quads = compiled.graph.invocation == Invocation::Lane && stage == Stage::Fragment;
            assert_eq!(manifest.features.contains(&"subgroup".to_owned()), quads);
            let json = manifest.to_json();
            assert_eq!(Manifest::from_json(&json).expect("its own manifest"), *manifest);
            let path = folder.join(format!("{}-{}.spv", compiled.kernel, stage.name()));
            std::fs::write(&path, &emitted.files[&Target::Spirv]).expect("a shader is written");
            spirv.push(path);
        }
    }
    assert_eq!(spirv.len(), 46);
    common::other_compilers(&[], &spirv);
}

/// In full precision there are reads and conversions, and the bounds of integers that become numbers.
#[test]
fn no_arithmetic_is_left_in_full_precision() {
    for compiled in kernels::compiled() {
        let emitted = compiled
            .emit(&options(Stage::Compute))
            .unwrap_or_else(|e| panic!("{e}"));
        let text = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]).into_owned();
        let module = naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
        let info = validator
            .validate(&module)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
        let (function, info) = (&module.entry_points[0].function, info.get_entry_point(0));
        let is = |e: naga::Handle<Expression>, scalar| info[e].ty.inner_with(&module.types).scalar() == Some(scalar);
        let mut halves = 0;
        for (_, expression) in function.expressions.iter() {
            let operand = match expression {
                Expression::Binary { left, .. } => *left,
                Expression::Unary { expr, .. } => *expr,
                Expression::Math { fun, arg, .. } if *fun != naga::MathFunction::Clamp => *arg,
                _ => continue,
            };
            let kernel = &compiled.kernel;
            assert!(!is(operand, naga::Scalar::F32), "{kernel}: {expression:?}\n{text}");
            halves += usize::from(is(operand, naga::Scalar::F16));
        }
        assert!(halves > 0, "{}", compiled.kernel);
    }
}

#[test]
fn glsl_is_refused_with_help() {
    let folder = folder("half-refused");
    let compiled = Kernel::builtin("sraa").and_then(|k| k.compile(&Settings::default()));
    let both = options(Stage::Compute).targets([Target::Wgsl, Target::Glsl450]);
    let error = compiled
        .expect("it compiles")
        .emit(&both)
        .expect_err("no f16 in GLSL")
        .to_string();
    for word in ["`sraa`", "glsl450", "wgsl, spirv, hlsl or msl", "f32"] {
        assert!(error.contains(word), "{error}");
    }
    let config = Config::new().out_dir(&folder).kernel("sraa", |k| {
        k.precision(Precision::F16).accept_loss(true).target(Target::Glsl450)
    });
    let error = config.compile().expect_err("no f16 in GLSL").to_string();
    assert!(error.contains("glsl450"), "{error}");
    assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 0);
}

/// The features of two extensions at once.
#[test]
fn directives_come_first() {
    let compiled = Kernel::builtin("quad_convolution").and_then(|k| k.compile(&Settings::default()));
    let mut options = options(Stage::Fragment);
    options.enable_subgroups = true;
    let emitted = compiled.expect("it compiles").emit(&options).expect("it is emitted");
    assert!(emitted.files[&Target::Wgsl].starts_with(b"enable subgroups;\nenable f16;\n\n// "));
    assert_eq!(emitted.manifest.features, ["subgroup", "shader-f16"]);
}

/// Manifests of full precision do not mention it, and are read as before.
#[test]
fn manifests_of_before_are_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders-out");
    let mut read = 0;
    for entry in std::fs::read_dir(folder).expect("shaders-out is there") {
        let path = entry.expect("a file").path();
        if path.extension().is_some_and(|e| e == "json") {
            let text = std::fs::read_to_string(&path).expect("a manifest");
            let manifest = Manifest::from_json(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            assert_eq!(manifest.precision, Precision::F32);
            assert_eq!(manifest.to_json(), text);
            read += 1;
        }
    }
    assert!(read > 10, "{read}");
}

#[test]
fn a_device_without_half_precision_is_refused() {
    let instance = crate::common::instance();
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
    let adapter = adapter.expect("this test needs a GPU adapter; without a GPU install Debian's mesa-vulkan-drivers");
    let plain = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()));
    let (device, _) = plain.expect("a device without features");
    let compiled = Kernel::builtin("sraa").and_then(|k| k.compile(&Settings::default()));
    let emitted = compiled
        .expect("it compiles")
        .emit(&options(Stage::Compute))
        .expect("it is emitted");
    let wgsl = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
    let error = Pass::new(&device, &emitted.manifest, &wgsl)
        .expect_err("no f16")
        .to_string();
    for word in ["`sraa`", "half precision", "SHADER_F16", "required_features", "`f32`"] {
        assert!(error.contains(word), "{error}");
    }
    // A manifest that lost the line is still no way to a panic.
    let mut damaged = emitted.manifest.clone();
    damaged.features.clear();
    let error = Pass::new(&device, &damaged, &wgsl).expect_err("no f16").to_string();
    assert!(error.contains("f16"), "{error}");
}

/// The host's side is the same in every precision: struct, setters, sizes.
#[test]
fn bindings_stay_as_they_are() {
    let text = |precision: Precision| {
        let folder = folder(&format!("half-bindings-{precision}"));
        let config = Config::new().out_dir(&folder).kernel("sraa", |k| {
            k.set("tau", "uniform")
                .set("sigma", "uniform")
                .set("falloff", "gaussian")
                .precision(precision)
                .accept_loss(true)
        });
        config.compile().unwrap_or_else(|e| panic!("{e}"));
        let manifest = std::fs::read_to_string(folder.join("sraa.json")).expect("a manifest");
        let bindings = std::fs::read_to_string(folder.join("straightline.rs")).expect("bindings");
        (Manifest::from_json(&manifest).expect("a manifest").bindings, bindings)
    };
    let (full, half) = (text(Precision::F32), text(Precision::F16));
    assert_eq!(full.0, half.0);
    // The shaders themselves differ: by the hashes of their texts, and by the feature that one needs.
    let of_the_shader = |line: &&str| {
        ["0x", "features: "]
            .iter()
            .any(|start| line.trim_start().starts_with(start))
    };
    let of_a_host = |text: &str| {
        text.lines()
            .filter(|line| !of_the_shader(line))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(of_a_host(&full.1), of_a_host(&half.1));
    assert_eq!(full.1.lines().filter(of_the_shader).count(), 2);
    assert!(half.1.contains("tau: f32"), "{}", half.1);
}
