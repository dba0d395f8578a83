//! Kernels that give several values: as rustc compiles them, interpreted in every form, and on GPUs in every language and stage;
//! `opengl.rs` has those of OpenGL.

use crate::common;

use common::{Texel, bench, same_texels};
use straightline_bench::execute::{Bench, Inputs, Written, interpret_kernel};
use straightline_codegen::emit::Target;
use straightline_codegen::ir::F16;
use straightline_codegen::{Branches, EmitOptions, Form, Format, Origin, Precision, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_runtime::{Error, PassOptions, Region, wgpu};
use straightline_tests::texts::{compiled, texels};
use straightline_tests::{compilers, kernel, passthrough};

kernel!(GBUFFER, gbuffer, {
    pub struct GBuffer {
        pub albedo: Vec4,
        pub normal: Vec3,
        pub motion: Vec2,
        pub depth: f32,
    }
    pub fn gbuffer(color: &Frame<Vec4>, far: f32, pixel: IVec2) -> GBuffer {
        let here = color.load(pixel);
        let mut sum = Vec4::ZERO;
        for k in -1..=2 {
            sum += color.load(pixel + ivec2(k, 1 - k)) * 0.25;
        }
        if here.x > 0.5 {
            return GBuffer {
                albedo: here,
                normal: Vec3::ONE,
                motion: here.xy(),
                depth: far,
            };
        }
        GBuffer {
            albedo: sum,
            normal: (sum - here).xyz(),
            motion: sum.zw() - here.xy(),
            depth: here.w * far,
        }
    }
});

kernel!(NUMBERED, numbered, {
    pub fn numbered(color: &Frame<Vec4>, pixel: IVec2) -> (Vec4, u32, IVec2, UVec3) {
        let here = color.load(pixel);
        let steps = (here * 16000000.0).as_uvec4();
        (
            here * 0.5,
            steps.x * 201,
            ivec2(-pixel.x * 70000, pixel.y) - 1,
            steps.yzw() * 99,
        )
    }
});

kernel!(LUMA, luma, {
    pub fn luma(color: &Frame<Vec4>, pixel: IVec2) -> f32 {
        color.load(pixel + ivec2(1, 0)).xyz().dot(vec3(0.25, 0.5, 0.25))
    }
});

kernel!(SLOPE, slope, {
    pub fn slope(color: &Frame<Vec4>, pixel: IVec2) -> Vec3 {
        color.load(pixel).xyz() - color.load(pixel + ivec2(0, 1)).xyz()
    }
});

const SIZE: UVec2 = uvec2(13, 9);
const FAR: f32 = 100.0;

fn color() -> Frame<Vec4> {
    texels(SIZE, 11)
}

fn inputs() -> Inputs {
    Inputs::new(SIZE)
        .with_image("color", color())
        .with_uniform("far", &[f64::from(FAR)])
}

type Native = fn(&Frame<Vec4>, IVec2) -> Vec<[f64; 4]>;

/// Name, text, what rustc makes of it, and the names and formats of its targets where colours have 32 bits.
type Case = (&'static str, &'static str, Native, &'static [(&'static str, Format)]);

const KERNELS: [Case; 4] = [
    (
        "gbuffer",
        GBUFFER,
        |color, at| {
            let given = gbuffer::gbuffer(color, FAR, at);
            vec![
                given.albedo.texel(),
                given.normal.texel(),
                given.motion.texel(),
                given.depth.texel(),
            ]
        },
        &[
            ("albedo", Format::Rgba32Float),
            ("normal", Format::Rgba32Float),
            ("motion", Format::Rg32Float),
            ("depth", Format::R32Float),
        ],
    ),
    (
        "numbered",
        NUMBERED,
        |color, at| {
            let (a, b, c, d) = numbered::numbered(color, at);
            vec![a.texel(), b.texel(), c.texel(), d.texel()]
        },
        &[
            ("destination_0", Format::Rgba32Float),
            ("destination_1", Format::R32Uint),
            ("destination_2", Format::Rg32Sint),
            ("destination_3", Format::Rgba32Uint),
        ],
    ),
    (
        "luma",
        LUMA,
        |color, at| vec![luma::luma(color, at).texel()],
        &[("destination", Format::R32Float)],
    ),
    (
        "slope",
        SLOPE,
        |color, at| vec![slope::slope(color, at).texel()],
        &[("destination", Format::Rgba32Float)],
    ),
];

/// Values of rustc's code, target by target.
fn native(kernel: Native, targets: usize) -> Vec<Vec<[f64; 4]>> {
    let color = color();
    let pixels = (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| ivec2(x, y)));
    let given: Vec<_> = pixels.map(|at| kernel(&color, at)).collect();
    (0..targets)
        .map(|k| given.iter().map(|texels| texels[k]).collect())
        .collect()
}

#[track_caller]
fn same(what: &str, native: &[Vec<[f64; 4]>], found: &[Written]) {
    assert_eq!(native.len(), found.len(), "{what}");
    for (native, found) in native.iter().zip(found) {
        same_texels(native, &found.texels).unwrap_or_else(|e| panic!("{what}, {}: {e}", found.name));
    }
}

/// Of floats that a driver rounds in another way; integers are the same.
#[track_caller]
fn near(what: &str, native: &[Vec<[f64; 4]>], found: &[Written], uploaded: f64) {
    assert_eq!(native.len(), found.len(), "{what}");
    for (native, found) in native.iter().zip(found) {
        for (k, (a, b)) in native.iter().zip(&found.texels).enumerate() {
            let off = (0..4)
                .map(|c| (a[c] - b[c]).abs() / a[c].abs().max(1.0))
                .fold(0.0, f64::max);
            assert!(off <= uploaded, "{what}, {}, pixel {k}: {a:?} and {b:?}", found.name);
        }
    }
}

#[test]
fn every_form_gives_what_rustc_gives() {
    for (name, text, kernel, targets) in KERNELS {
        let expected = native(kernel, targets.len());
        for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(3)] {
            for branches in [Branches::Keep, Branches::Select] {
                let settings = Settings::new().unroll(unroll).branches(branches);
                let found = interpret_kernel::<f32>(&compiled(name, text, &settings), &inputs(), false);
                let found = found.unwrap_or_else(|e| panic!("{name}: {e}"));
                let names: Vec<&str> = found.targets.iter().map(|target| target.name.as_str()).collect();
                assert_eq!(names, targets.iter().map(|(name, _)| *name).collect::<Vec<_>>());
                same(&format!("{name} {unroll} {branches}"), &expected, &found.targets);
            }
        }
        let first: Vec<[f64; 4]> = {
            let found = interpret_kernel::<f32>(&compiled(name, text, &Settings::default()), &inputs(), false);
            let texels = found.expect("ran before").texels;
            texels.iter().map(|texel| texel.map(f64::from)).collect()
        };
        same_texels(&expected[0], &first).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn every_stage_gives_the_same_on_a_gpu() {
    let bench = bench();
    for (name, text, kernel, targets) in KERNELS {
        let expected = native(kernel, targets.len());
        for unroll in [Unroll::Full, Unroll::None] {
            let settings = Settings::new().unroll(unroll);
            let compiled = compiled(name, text, &settings);
            for stage in [Stage::Compute, Stage::Fragment] {
                let what = format!("{name} {unroll} {stage:?}");
                let (pass, manifest) = bench
                    .compile_pass(&compiled, stage)
                    .unwrap_or_else(|e| panic!("{what}: {e}"));
                let written: Vec<(&str, Format)> = manifest
                    .outputs
                    .iter()
                    .map(|output| (output.name.as_str(), output.format))
                    .collect();
                assert_eq!(written, targets, "{what}");
                let uploaded = bench
                    .upload(&manifest, &inputs())
                    .unwrap_or_else(|e| panic!("{what}: {e}"));
                let found = bench
                    .written_by(&pass, &uploaded, SIZE)
                    .unwrap_or_else(|e| panic!("{what}: {e}"));
                near(&what, &expected, &found, 1.0e-5);
            }
        }
    }
}

/// Two pixels across and two down by one invocation, at a size that is no multiple of either.
#[test]
fn blocks_of_pixels_store_all_of_them() {
    let bench = bench();
    for (name, text, kernel, targets) in KERNELS {
        let expected = native(kernel, targets.len());
        let settings = Settings::new().block(2, 2);
        let compiled = compiled(name, text, &settings);
        let found = interpret_kernel::<f32>(&compiled, &inputs(), false).unwrap_or_else(|e| panic!("{name}: {e}"));
        same(name, &expected, &found.targets);
        let found = bench.run_targets(&compiled, Stage::Compute, &inputs());
        near(
            name,
            &expected,
            &found.unwrap_or_else(|e| panic!("{name}: {e}")),
            1.0e-5,
        );
    }
}

#[test]
fn half_precision_rounds_floats_alone() {
    let bench = bench().with_precision(Precision::F16);
    let (name, text, ..) = KERNELS[0];
    let compiled = compiled(name, text, &Settings::default());
    let expected = interpret_kernel::<F16>(&compiled, &inputs(), false).unwrap_or_else(|e| panic!("{e}"));
    let expected: Vec<_> = expected.targets.into_iter().map(|target| target.texels).collect();
    for stage in [Stage::Compute, Stage::Fragment] {
        let found = bench
            .run_targets(&compiled, stage, &inputs())
            .unwrap_or_else(|e| panic!("{e}"));
        near(name, &expected, &found, 1.0 / 64.0);
    }
    let emitted = compiled.emit(
        &EmitOptions::new()
            .precision(Precision::F16)
            .targets([Target::Hlsl, Target::Msl]),
    );
    let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
    let hlsl = String::from_utf8_lossy(&emitted.files[&Target::Hlsl]);
    assert!(hlsl.contains("RWTexture2D<float2> motion"), "{hlsl}");
}

/// A rectangle, and rows that count from below: each target has what the whole picture has there.
#[test]
fn regions_and_rows_from_below_hold_for_every_target() {
    let bench = bench();
    let (name, text, kernel, targets) = KERNELS[0];
    let expected = native(kernel, targets.len());
    let compiled = compiled(name, text, &Settings::default());
    let region = Region {
        first: [3, 2],
        size: [6, 5],
        place: [1, 1],
    };
    for stage in [Stage::Compute, Stage::Fragment] {
        let options = bench.emit_options(stage).region(true);
        let (pass, manifest) = bench.emit_pass(&compiled, &options).unwrap_or_else(|e| panic!("{e}"));
        let uploaded = bench.upload(&manifest, &inputs()).unwrap_or_else(|e| panic!("{e}"));
        let found = written(&bench, &pass, &uploaded, uvec2(8, 7), Some(region));
        for (k, target) in found.iter().enumerate() {
            for y in 0..5 {
                for x in 0..6 {
                    let there = expected[k][(y + 2) * SIZE.x as usize + x + 3];
                    let here = target.texels[(y + 1) * 8 + x + 1];
                    let off = (0..4).map(|c| (there[c] - here[c]).abs()).fold(0.0, f64::max);
                    assert!(off <= 1.0e-3, "{stage:?} {} {x} {y}: {there:?} {here:?}", target.name);
                }
            }
        }
        let below = bench.emit_options(stage).origin(Origin::LowerLeft);
        let (pass, manifest) = bench.emit_pass(&compiled, &below).unwrap_or_else(|e| panic!("{e}"));
        let turned = |texels: &[[f64; 4]]| -> Vec<[f64; 4]> {
            texels.chunks(SIZE.x as usize).rev().flatten().copied().collect()
        };
        let over = color()
            .texels()
            .chunks(SIZE.x as usize)
            .rev()
            .flatten()
            .copied()
            .collect();
        let over = inputs().with_image("color", Frame::new(SIZE, over));
        let uploaded = bench.upload(&manifest, &over).unwrap_or_else(|e| panic!("{e}"));
        let found = bench
            .written_by(&pass, &uploaded, SIZE)
            .unwrap_or_else(|e| panic!("{e}"));
        let expected: Vec<_> = expected.iter().map(|texels| turned(texels)).collect();
        near("from below", &expected, &found, 1.0e-5);
    }
}

/// Texels that a pass writes in a region, read back by way of the bench.
fn written(
    bench: &Bench,
    pass: &straightline_runtime::Pass,
    uploaded: &straightline_bench::execute::Uploaded,
    size: UVec2,
    region: Option<Region>,
) -> Vec<Written> {
    let textures: Vec<_> = pass
        .targets()
        .map(|(name, format)| (name, bench.create_target(size, format)))
        .collect();
    let views: Vec<_> = textures
        .iter()
        .map(|(name, texture)| (*name, texture.create_view(&wgpu::TextureViewDescriptor::default())))
        .collect();
    // In another order than the kernel's: names tell.
    let mut targets: Vec<(&str, &wgpu::TextureView)> = views.iter().map(|(name, view)| (*name, view)).collect();
    targets.reverse();
    let mut encoder = bench
        .device()
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let bound = match region {
        Some(region) => uploaded.bind_region(pass, targets.as_slice(), region),
        None => uploaded.bind(pass, targets.as_slice()),
    };
    bound.unwrap_or_else(|e| panic!("{e}")).encode(&mut encoder);
    bench.queue().submit([encoder.finish()]);
    let read = textures.iter().map(|(name, texture)| Written {
        name: (*name).to_owned(),
        size,
        texels: bench.read_texels(texture).unwrap_or_else(|e| panic!("{e}")),
    });
    read.collect()
}

#[test]
fn glsl_hlsl_and_spirv_give_the_same_through_vulkan() {
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    for (name, text, kernel, targets) in KERNELS {
        let expected = native(kernel, targets.len());
        let compiled = compiled(name, text, &Settings::default());
        for stage in [Stage::Compute, Stage::Fragment] {
            let languages = [Target::Wgsl, Target::Glsl450, Target::Hlsl, Target::Spirv];
            for language in languages.into_iter().skip(1) {
                let options = bench.emit_options(stage).targets([Target::Wgsl, language]);
                let emitted = compiled
                    .emit(&options)
                    .unwrap_or_else(|e| panic!("{name} {language}: {e}"));
                let found = passthrough::run_all(&bench, &emitted, language, &inputs());
                let found = found.unwrap_or_else(|e| panic!("{name} {stage:?} {language}: {e}"));
                near(&format!("{name} {stage:?} {language}"), &expected, &found, 1.0e-5);
            }
        }
    }
}

/// A text as a file for a compiler.
fn file(name: &str, text: &str) -> std::path::PathBuf {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("outputs");
    std::fs::create_dir_all(&folder).expect("a folder for shaders");
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a shader is written");
    path
}

#[test]
fn compilers_read_every_language() {
    for (name, text, ..) in KERNELS {
        let compiled = compiled(name, text, &Settings::default());
        for stage in [Stage::Compute, Stage::Fragment] {
            let emitted = compiled.emit(&EmitOptions::new().stage(stage).targets(Target::MODERN));
            let emitted = emitted.unwrap_or_else(|e| panic!("{name} {stage:?}: {e}"));
            compilers::read(&emitted).unwrap_or_else(|e| panic!("{name} {stage:?}: {e}"));
        }
    }
}

/// A function gives a structure, which a shader of the host's takes apart.
#[test]
fn functions_give_structures() {
    let (name, text, ..) = KERNELS[0];
    let compiled = compiled(name, text, &Settings::default());
    let emitted = |target: Target| {
        let options = EmitOptions::new().form(Form::Function).targets([target]);
        let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{target}: {e}"));
        String::from_utf8_lossy(&emitted.files[&target]).into_owned()
    };
    let wgsl = emitted(Target::Wgsl);
    let caller = "@group(0) @binding(0) var color_texture: texture_2d<f32>;\n@fragment\nfn caller(@builtin(position) at: vec4f) -> \
                  @location(0) vec4f {\n    let all: gbuffer_Outputs = gbuffer(color_texture, at.xy, 100.0);\n    return \
                  vec4f(all.normal, all.depth) + all.albedo * all.motion.x;\n}\n";
    let whole = format!("{wgsl}\n{caller}");
    wgpu::naga::front::wgsl::parse_str(&whole).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&whole)));
    if compilers::has_tint() {
        compilers::tint(&file("caller.wgsl", &whole)).unwrap_or_else(|e| panic!("{e}"));
    }
    let glsl = emitted(Target::Glsl330);
    let caller = "uniform sampler2D color_texture;\nlayout(location = 0) out vec4 result;\nvoid main() {\n    gbuffer_Outputs all = \
                  gbuffer(color_texture, gl_FragCoord.xy, 100.0);\n    result = vec4(all.normal, all.depth) + all.albedo * \
                  all.motion.x;\n}\n";
    let whole = format!("#version 330\n{glsl}\n{caller}");
    compilers::opengl(&file("caller.frag", &whole)).unwrap_or_else(|e| panic!("{e}"));
    let hlsl = emitted(Target::Hlsl);
    let caller = "Texture2D<float4> color_texture : register(t0);\nfloat4 caller(float4 at : SV_Position) : SV_Target0 {\n    \
                  gbuffer_Outputs all_of_it = gbuffer(color_texture, at.xy, 100.0);\n    return float4(all_of_it.normal, \
                  all_of_it.depth) + all_of_it.albedo * all_of_it.motion.x;\n}\n";
    compilers::compiled_hlsl(&format!("{hlsl}\n{caller}"), Stage::Fragment, "caller")
        .unwrap_or_else(|e| panic!("{e}\n{hlsl}"));
}

#[test]
fn a_pass_says_what_is_wrong_with_targets() {
    let bench = bench();
    let (name, text, ..) = KERNELS[0];
    let compiled = compiled(name, text, &Settings::default());
    let (pass, manifest) = bench
        .compile_pass(&compiled, Stage::Compute)
        .unwrap_or_else(|e| panic!("{e}"));
    let uploaded = bench.upload(&manifest, &inputs()).unwrap_or_else(|e| panic!("{e}"));
    let texture = |size: UVec2, format| {
        let texture = bench.create_target(size, format);
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    };
    use wgpu::TextureFormat::{R32Float, Rg32Float, Rgba32Float};
    let good = [Rgba32Float, Rgba32Float, Rg32Float, R32Float].map(|format| texture(SIZE, format));
    let [albedo, normal, motion, depth] = &good;
    let said = |targets: &[(&str, &wgpu::TextureView)]| {
        let result = uploaded.bind(&pass, targets);
        result.err().map(|e: Error| e.to_string()).unwrap_or_default()
    };
    let all = [
        ("albedo", albedo),
        ("normal", normal),
        ("motion", motion),
        ("depth", depth),
    ];
    assert_eq!(said(&all), "");
    assert_eq!(
        said(&all[..3]),
        "`gbuffer` was not given the target `depth`; it writes `albedo`, `normal`, `motion` and `depth`"
    );
    assert!(said(&[("albedo", albedo), ("albedo", normal)]).contains("target `albedo` more than once"));
    assert!(said(&[("colour", albedo)]).contains("no target `colour`"));
    let small = texture(uvec2(4, 4), R32Float);
    let mut other = all;
    other[3].1 = &small;
    assert_eq!(
        said(&other),
        "target `depth` of `gbuffer`: is 4x4, but the first target is 13x9: all targets have one size"
    );
    other[3].1 = motion;
    assert!(said(&other).contains("target `depth` of `gbuffer`: is Rg32Float, but the shader writes R32Float"));
    other = all;
    other[1].1 = albedo;
    assert!(said(&other).contains("target `normal` of `gbuffer`: is the target `albedo` too"));
    // Another view of the same image.
    let again = albedo.texture().create_view(&wgpu::TextureViewDescriptor::default());
    other[1].1 = &again;
    assert!(said(&other).contains("target `normal` of `gbuffer`: is the target `albedo` too"));
    let one = uploaded.bind(&pass, albedo).expect_err("one target for four");
    assert!(
        one.to_string()
            .contains("give each its target by name, as in `&[(\"albedo\", &view), ...]`"),
        "{one}"
    );

    let emitted = compiled
        .emit(&bench.emit_options(Stage::Fragment))
        .unwrap_or_else(|e| panic!("{e}"));
    let made = |options: PassOptions| {
        bench
            .create_pass(&emitted, &options)
            .err()
            .map(|e| e.to_string())
            .unwrap_or_default()
    };
    assert_eq!(
        made(PassOptions::default().format_of("normal", wgpu::TextureFormat::Rgba16Float)),
        ""
    );
    let ambiguous = made(PassOptions::default().target_format(wgpu::TextureFormat::Rgba16Float));
    assert!(ambiguous.contains("say with `format_of` which is meant"), "{ambiguous}");
    let wide = made(PassOptions::default().format_of("depth", Rgba32Float));
    assert!(wide.contains("`depth` has 1 of the format's 4 components"), "{wide}");
    let integers = made(PassOptions::default().format_of("depth", wgpu::TextureFormat::R32Uint));
    assert!(integers.contains("use a float or normalised format"), "{integers}");
}

/// A structure of quads gives what kernels of quads give that give one field alone.
#[test]
fn quads_give_several_values() {
    let bench = bench();
    let text = |result: &str, given: &str| {
        format!(
            "pub struct Both {{ pub mean: Quad<Vec4>, pub slope: Quad<f32> }}\npub fn k(color: &Frame<Vec4>, pixel: Quad<IVec2>) -> {result} \
             {{\n    let here = color.load(pixel);\n    let mean = (here + here.swap_horizontal()) * 0.5;\n    let slope = here.x() - \
             here.swap_vertical().x();\n    {given}\n}}\n"
        )
    };
    let of = |result: &str, given: &str| compiled("k", &text(result, given), &Settings::default());
    let both = of("Both", "Both { mean, slope }");
    let alone = [of("Quad<Vec4>", "mean"), of("Quad<f32>", "slope")];
    let expected: Vec<_> = alone
        .iter()
        .map(|kernel| {
            let mut targets = interpret_kernel::<f32>(kernel, &inputs(), false)
                .unwrap_or_else(|e| panic!("{e}"))
                .targets;
            targets.swap_remove(0).texels
        })
        .collect();
    let found = interpret_kernel::<f32>(&both, &inputs(), false).unwrap_or_else(|e| panic!("{e}"));
    same("quads", &expected, &found.targets);
    let found = bench
        .run_targets(&both, Stage::Compute, &inputs())
        .unwrap_or_else(|e| panic!("{e}"));
    near("quads", &expected, &found, 1.0e-5);
}
