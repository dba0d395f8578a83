//! Refusals of quads, with their help.

use super::*;
use straightline_codegen::EmitOptions;
use straightline_codegen::emit::Target;

fn error(text: &str, name: &str, settings: &Settings) -> String {
    match Kernel::from_text("test.rs", text, name).compile(settings) {
        Err(errors) => errors.to_string(),
        Ok(_) => panic!("`{name}` compiles"),
    }
}

#[track_caller]
fn says(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "no `{part}` in:\n{text}");
    }
}

#[test]
fn messages_need_lanes() {
    let text = "pub fn one(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 { image.load(pixel).swap_horizontal() }";
    says(
        &error(text, "one", &Settings::default()),
        &["swap_horizontal", "no other lane to receive from", "pixel: Quad<IVec2>"],
    );
    let text = "pub fn one(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 { image.load(pixel) * quad_vector().x() }";
    says(&error(text, "one", &Settings::default()), &["pixel: Quad<IVec2>"]);
}

#[test]
fn lanes_that_part_are_refused() {
    // rustc refuses this too: a `Quad<bool>` is no condition.
    let text = "
pub fn parts(image: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let own = image.load(pixel);
    let mut sum = own;
    if own.x() > 0.5 {
        sum = own.swap_horizontal();
    }
    sum
}
";
    let keep = Settings::new().branches(straightline_codegen::Branches::Keep);
    says(
        &error(text, "parts", &keep),
        &[
            "do not run in step",
            "another side",
            "choose lane by lane with `select`",
        ],
    );
    let text = "
pub fn leaves(image: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let own = image.load(pixel);
    let mut sum = own;
    for k in 0..8 {
        if own.x() > k as f32 {
            break;
        }
        sum += own.swap_horizontal();
    }
    sum
}
";
    says(&error(text, "leaves", &Settings::default()), &["do not run in step"]);
    let text = "
pub fn searches(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for k in 0..8 {
        let there = image.load(pixel + ivec2(k, 0));
        if there.x > 0.5 {
            break;
        }
        sum += there;
    }
    sum
}
";
    let looped = Settings::new()
        .unroll(straightline_codegen::Unroll::None)
        .branches(straightline_codegen::Branches::Select)
        .block(2, 1);
    says(
        &error(text, "searches", &looped),
        &["a loop that each pixel may leave in another round"],
    );
    let text = "
pub fn rounds(image: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let mut sum = image.load(pixel);
    for k in 0..pixel.x() {
        sum += image.load(pixel + ivec2(k, 0));
    }
    sum
}
";
    says(
        &error(text, "rounds", &Settings::default()),
        &["mismatched types", "found `Quad<i32>`"],
    );
}

#[test]
fn derivatives_carry_floats_alone() {
    let text = "
pub fn whole(image: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    image.load(pixel.swap_horizontal())
}
";
    let settings = Settings::new().transport(Transport::Derivatives);
    says(
        &error(text, "whole", &settings),
        &["IVec2", "floats alone", "`subgroup`"],
    );
    compile_text(text, "whole", &Settings::default());
}

#[test]
fn transports_fit_their_stage() {
    let emit = |transport, stage, target| {
        let compiled = compile("quad_convolution", &[], Unroll::Full, Some(transport));
        compiled.emit(&EmitOptions::new().stage(stage).targets([target]))
    };
    for transport in [Transport::Subgroup, Transport::Derivatives] {
        let error = emit(transport, Stage::Compute, Target::Wgsl)
            .expect_err("compute has no quads")
            .to_string();
        says(&error, &["quad_convolution", "no pixel quads", "`block`"]);
    }
    let error = emit(Transport::Block, Stage::Fragment, Target::Wgsl)
        .expect_err("one pixel")
        .to_string();
    says(&error, &["a fragment writes one", "compute"]);
    let error = emit(Transport::Derivatives, Stage::Fragment, Target::Msl)
        .expect_err("no fine ones")
        .to_string();
    says(&error, &["fine derivatives", "msl", "`subgroup`"]);
    let settings = Settings::new().transport(Transport::Subgroup);
    let error = Kernel::builtin("sraa")
        .and_then(|k| k.compile(&settings))
        .expect_err("one pixel")
        .to_string();
    says(&error, &["sends no messages"]);
    let settings = Settings::new().block(2, 1);
    let error = Kernel::builtin("pcf")
        .and_then(|k| k.compile(&settings))
        .expect_err("quads")
        .to_string();
    says(&error, &["a block of 2x1 pixels has other"]);
    let settings = Settings::new().block(4, 2).transport(Transport::Subgroup);
    let error = Kernel::builtin("pcf")
        .and_then(|k| k.compile(&settings))
        .expect_err("one invocation")
        .to_string();
    says(&error, &["send no messages"]);
    let settings = Settings::new().block(64, 64);
    let error = Kernel::builtin("sraa")
        .and_then(|k| k.compile(&settings))
        .expect_err("too large")
        .to_string();
    says(&error, &["64x64", "1 to 64"]);
}

/// A pass has no vertices, and its error names the type that the shader needs.
#[test]
fn passes_refuse_what_they_cannot_draw() {
    let gpu = bench();
    let compiled = compile("pcf", &[], Unroll::Full, Some(Transport::Subgroup));
    let error = gpu
        .compile_pass(&compiled, Stage::Fragment)
        .expect_err("interpolated")
        .to_string();
    says(
        &error,
        &["`coord` is interpolated", "draw your triangles with it by `Draw`"],
    );
    let instance = crate::common::instance();
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
    let adapter = adapter.expect("an adapter, as `bench` found one");
    let plain = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()));
    let (device, queue) = plain.expect("a device without features");
    let gpu = Bench::new(&device, &queue, false);
    let compiled = compile("quad_convolution", &[], Unroll::Full, Some(Transport::Subgroup));
    let error = gpu
        .compile_pass(&compiled, Stage::Fragment)
        .expect_err("no subgroups")
        .to_string();
    says(&error, &["SUBGROUP", "`derivatives` or `block`"]);
}

#[test]
fn browsers_are_told_of_subgroups() {
    let compiled = compile("quad_convolution", &[], Unroll::Full, Some(Transport::Subgroup));
    let mut options = EmitOptions::new().stage(Stage::Fragment);
    options.enable_subgroups = true;
    let text = compiled.emit(&options).expect("emitted").files[&Target::Wgsl].clone();
    assert!(text.starts_with(b"enable subgroups;\n"));
    let plain = compile("quad_convolution", &[], Unroll::Full, Some(Transport::Derivatives));
    let text = plain.emit(&options).expect("emitted").files[&Target::Wgsl].clone();
    assert!(!text.starts_with(b"enable"));
}

/// Every kernel of quads, by every transport, in every language that has it; two other compilers read GLSL and SPIR-V.
#[test]
fn all_emit_in_all_languages() {
    let folder = std::path::PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("quads");
    std::fs::create_dir_all(&folder).expect("a folder for shaders");
    let (mut glsl, mut spirv) = (Vec::new(), Vec::new());
    let kernels: [(&str, &[Options<'_>]); 6] = [
        ("quad_convolution", &[&[], &[("radius", "2"), ("weights", "binomial")]]),
        (
            "quad_upsampling",
            &[&[], &[("reads", "apart"), ("normals", "true")], &[("reads", "naive")]],
        ),
        ("quad_bilateral", &[&[("radius", "1")]]),
        (
            "pcf",
            &[
                &[],
                &[("width", "four")],
                &[("method", "gather"), ("weights", "cubic")],
                &[("weights", "quadratic"), ("gradient", "fitted"), ("spread", "uniform")],
                &[("method", "bilinear"), ("weights", "gaussian")],
            ],
        ),
        ("pcss", &[&[], &[("sharing", "alone")]]),
        ("quad_ssao", &[&[], &[("sharing", "alone")]]),
    ];
    for (name, option_sets) in kernels {
        for (k, options) in option_sets.iter().enumerate() {
            for (transport, stage) in [
                (Transport::Subgroup, Stage::Fragment),
                (Transport::Derivatives, Stage::Fragment),
                (Transport::Block, Stage::Compute),
            ] {
                let compiled = compile(name, options, Unroll::Full, Some(transport));
                let targets = Target::MODERN
                    .into_iter()
                    .filter(|t| transport != Transport::Derivatives || *t != Target::Msl);
                let emitted = compiled
                    .emit(&EmitOptions::new().stage(stage).targets(targets))
                    .unwrap_or_else(|e| panic!("{name} {options:?} by {transport}: {e}"));
                for (file, contents) in emitted.named_files(&format!("{name}-{k}-{transport}")) {
                    let path = folder.join(&file);
                    std::fs::write(&path, contents).expect("a shader is written");
                    match path.extension().and_then(|e| e.to_str()) {
                        Some("frag" | "comp") => glsl.push(path),
                        Some("spv") => spirv.push(path),
                        _ => {}
                    }
                }
            }
        }
    }
    assert_eq!((glsl.len(), spirv.len()), (45, 45));
    common::other_compilers(&glsl, &spirv);
}
