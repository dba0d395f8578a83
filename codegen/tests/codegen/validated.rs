//! Texts that naga has validated, as manifests say: all WGSL, and GLSL 4.50 but for constructs that its reader does not know.

use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Form, Kernel, ReadOrder, Settings, Stage};

/// Languages that naga has validated of a kernel in all that are asked for.
fn validated(text: &str, settings: &Settings, options: &EmitOptions) -> Vec<String> {
    let text = format!("use straightline_kernels::prelude::*;\n{text}");
    let compiled = Kernel::from_text("k.rs", &text, "k").compile(settings);
    let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
    let emitted = compiled.emit(options).unwrap_or_else(|errors| panic!("{errors}"));
    emitted.manifest.validated.into_iter().collect()
}

const PLAIN: &str = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) * 0.5 }";

#[test]
fn plain_texts_are_validated_in_every_language_that_naga_reads() {
    let all = EmitOptions::new().targets([
        Target::Wgsl,
        Target::Glsl450,
        Target::Spirv,
        Target::Msl,
        Target::Hlsl,
        Target::Glsl430,
    ]);
    let found = validated(PLAIN, &Settings::new(), &all);
    // HLSL and the GLSL of OpenGL have no reader there.
    assert_eq!(found, ["glsl450", "msl", "spirv", "wgsl"]);
}

#[test]
fn constructs_that_naga_does_not_read_are_not_validated() {
    let compute = EmitOptions::new().targets([Target::Wgsl, Target::Glsl450]);
    let fragment = compute.clone().stage(Stage::Fragment);
    let gathers = Settings::new().reads(ReadOrder::Gather);
    let plain = Settings::new();
    for (construct, text, settings, options) in [
        ("a function", PLAIN, &plain, &fragment.clone().form(Form::Function)),
        (
            "the length of a buffer",
            "pub fn k(list: &Buffer<f32>, pixel: IVec2) -> Vec4 { Vec4::splat(list.len() as f32) }",
            &plain,
            &compute,
        ),
        (
            "a gather",
            "pub fn k(depth: &Frame<f32>, pixel: IVec2) -> Vec4 {
                let p = pixel;
                Vec4::splat(depth.load(p) + depth.load(p + ivec2(1, 0)) + depth.load(p + ivec2(0, 1)))
            }",
            &gathers,
            &compute,
        ),
        (
            "a quad swap",
            "pub fn k(color: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
                let own = color.load(pixel);
                (own + own.swap_horizontal()) * 0.5
            }",
            &plain,
            &fragment,
        ),
        (
            "`precise`",
            "pub fn k(a: f32, b: f32, pixel: IVec2) -> Vec4 {
                let sum = a + b;
                Vec4::splat((sum - a) - b)
            }",
            &plain,
            &compute,
        ),
        (
            "a barrier",
            "pub fn k(sums: &Shared<[f32; 4]>, group: &Workgroup<2, 2>) -> PerThread<Vec4> {
                group.each(|thread| Vec4::splat(sums.load(3 - thread.index)))
            }",
            &plain,
            &compute,
        ),
        (
            "a write",
            "pub fn k(color: &Frame<Vec4>, out: &StorageBuffer<f32>, pixel: IVec2) { out.store(0, color.load(pixel).x); }",
            &plain,
            &compute,
        ),
    ] {
        assert_eq!(validated(text, settings, options), ["wgsl"], "{construct}");
    }
}
