//! Errors of a shader, its manifest or the device are found when the pass is made, and name their cause.

use crate::common;

use common::{ADD, COPY, Fixture, Gpu, Kernel, LAYERS, SCALE, STAGES, Stage, TABLE};
use straightline_runtime::manifest::Manifest;
use straightline_runtime::{Error, Pass, PassOptions, wgpu};
use wgpu::TextureFormat;

/// Makes a pass that must fail and returns the error with its message.
fn refuse(gpu: &Gpu, manifest: &str, wgsl: &str) -> (Error, String) {
    let error = Pass::from_json(&gpu.device, manifest, wgsl).expect_err("a refusal");
    let message = error.to_string();
    (error, message)
}

/// `text` with `from`, which must be there, replaced.
fn edit(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "the fixture has no {from}");
    text.replace(from, to)
}

#[test]
fn a_text_that_is_no_manifest() {
    let gpu = Gpu::new();
    let Fixture { manifest, wgsl } = COPY.emit(Stage::Compute);
    assert!(matches!(refuse(&gpu, "{", &wgsl).0, Error::Manifest(_)));
    let (_, message) = refuse(&gpu, &edit(&manifest, r#""schema": 3"#, r#""schema": 9"#), &wgsl);
    assert!(message.contains("schema 9"), "{message}");
    let mut read = Manifest::from_json(&manifest).expect("a manifest");
    read.schema = 9;
    assert!(matches!(Pass::new(&gpu.device, &read, &wgsl), Err(Error::Manifest(_))));
}

#[test]
fn manifests_that_contradict_themselves() {
    let gpu = Gpu::new();
    let compute = [
        (r#""workgroup_size": [8, 8, 1],"#, "", "workgroup_size"),
        ("[8, 8, 1]", "[8, 0, 1]", "workgroup_size"),
        ("[8, 8, 1]", "[4, 4, 4]", "workgroup_size"),
        (r#""binding": 15, "#, "", "group and binding"),
        (r#""binding": 15"#, r#""location": 0, "binding": 15"#, "location"),
        (
            r#""binding": 15"#,
            r#""binding": 0"#,
            "@group(0) @binding(0) is listed twice",
        ),
        (r#""access": "write-only""#, r#""access": "read-only""#, "only written"),
        (r#""components": 4"#, r#""components": 5"#, "`color`: 5 components"),
        (
            r#""components": 4, "layers": 1"#,
            r#""components": 4, "layers": 2"#,
            "`color`: not a 2d-array, but with 2 layers",
        ),
        (r#""layers": 3"#, r#""layers": 0"#, "`depth`: no layers"),
        (
            r#""name": "depth""#,
            r#""name": "color""#,
            "input `color` is listed twice",
        ),
        (
            r#""stage": "compute""#,
            r#""stage": "fragment""#,
            "the stage is fragment",
        ),
    ];
    for (from, to, wanted) in compute {
        let Fixture { manifest, wgsl } = LAYERS.emit(Stage::Compute);
        let (error, message) = refuse(&gpu, &edit(&manifest, from, to), &wgsl);
        assert!(matches!(error, Error::BadManifest { .. }), "{message}");
        assert!(message.contains(wanted) && message.contains("`layers`"), "{message}");
    }
    let uniform = [
        (r#""type": "vec4f""#, r#""type": "mat4x4f""#, "`mat4x4f`"),
        (r#""size": 32"#, r#""size": 20"#, "20 bytes"),
        (r#""offset": 16"#, r#""offset": 18"#, "offset 18"),
        (r#""offset": 20"#, r#""offset": 32"#, "ends beyond"),
        (
            r#""offset": 16, "size": 4"#,
            r#""offset": 16, "size": 8"#,
            "8 bytes instead of 4",
        ),
        (
            r#""default": -3"#,
            r#""default": -3.5"#,
            "-3.5 of field `steps` is no i32",
        ),
        (
            r#""name": "steps""#,
            r#""name": "scale""#,
            "uniform `scale` is listed twice",
        ),
    ];
    let uniform = uniform.into_iter().chain([
        (
            r#""buffer_type": "uniform""#,
            r#""buffer_type": "read-only-storage""#,
            "not uniform",
        ),
        (
            r#""stage": "compute""#,
            r#""form": "function", "stage": "compute""#,
            "put it into a shader of your own",
        ),
    ]);
    for (from, to, wanted) in uniform {
        let Fixture { manifest, wgsl } = ADD.emit(Stage::Compute);
        let (error, message) = refuse(&gpu, &edit(&manifest, from, to), &wgsl);
        assert!(matches!(error, Error::BadManifest { .. }), "{message}");
        assert!(message.contains(wanted), "{message}");
    }
    let fragment = [
        (r#""location": 0"#, r#""location": 1"#),
        (r#""location": 0"#, r#""location": 0, "group": 0"#),
    ];
    for (from, to) in fragment {
        let Fixture { manifest, wgsl } = COPY.emit(Stage::Fragment);
        let (error, message) = refuse(&gpu, &edit(&manifest, from, to), &wgsl);
        assert!(matches!(error, Error::BadManifest { .. }), "{message}");
    }
}

#[test]
fn shaders_that_are_not_their_manifests() {
    let gpu = Gpu::new();
    let cases = [
        ("fn add", "fn sum", "no entry point `add`, only `sum`"),
        (
            "@workgroup_size(8, 8, 1)",
            "@workgroup_size(16, 8, 1)",
            "workgroup size is [16, 8, 1]",
        ),
        ("rgba32float", "rgba16float", "texture_storage_2d<rgba32float, write>"),
        (
            "@binding(0) var color",
            "@binding(7) var color",
            "nothing at @group(0) @binding(0)",
        ),
        (
            "color",
            "colour",
            "`colour` is at @group(0) @binding(0), where `color` should be",
        ),
        (
            "texture_2d<f32>",
            "texture_multisampled_2d<f32>",
            "`color` is not a `texture_2d<f32>`",
        ),
        (
            "scale: f32, steps: i32",
            "steps: i32, scale: f32",
            "`params.scale` lies at offset 20",
        ),
        ("steps: i32", "steps: u32", "`params.steps` is not of type i32"),
        (
            "steps: i32",
            "steps: i32, more: f32",
            "member `more` that the manifest does not list",
        ),
        (
            "struct Params",
            "@group(0) @binding(9) var extra: texture_2d<f32>; struct Params",
            "`extra`",
        ),
    ];
    for (from, to, wanted) in cases {
        let Fixture { manifest, wgsl } = ADD.emit(Stage::Compute);
        let (error, message) = refuse(&gpu, &manifest, &edit(&wgsl, from, to));
        assert!(matches!(error, Error::Mismatch { .. }), "{message}");
        assert!(message.contains(wanted) && message.contains("`add`"), "{message}");
    }
    let (fragment, compute) = (COPY.emit(Stage::Fragment), COPY.emit(Stage::Compute));
    let (error, message) = refuse(&gpu, &fragment.manifest, &compute.wgsl);
    assert!(
        matches!(error, Error::Mismatch { .. }) && message.contains("stage Compute"),
        "{message}"
    );
}

#[test]
fn shaders_that_do_not_compile() {
    let gpu = Gpu::new();
    for stage in STAGES {
        let Fixture { manifest, wgsl } = COPY.emit(stage);
        for (from, to, wanted) in [
            ("textureLoad(", "textureLode(", "textureLode"),
            ("let pixel", "lot pixel", "expected"),
            // Parses, but does not validate.
            (
                "@group(0) @binding(0)",
                "fn nothing() -> f32 {}\n@group(0) @binding(0)",
                "nothing",
            ),
        ] {
            let (error, message) = refuse(&gpu, &manifest, &edit(&wgsl, from, to));
            assert!(matches!(error, Error::Shader { .. }), "{message}");
            assert!(message.contains(wanted) && message.contains("`copy`"), "{message}");
        }
    }
    // Half precision needs a device feature that was not asked for.
    let Fixture { manifest, wgsl } = COPY.emit(Stage::Compute);
    let half = format!(
        "enable f16;\n{}",
        edit(&wgsl, "let pixel", "let half = f16(id.x) * 2h; let pixel")
    );
    let (error, message) = refuse(&gpu, &manifest, &half);
    assert!(matches!(error, Error::Shader { .. }), "{message}");
}

#[test]
fn target_formats_that_cannot_be_written() {
    let gpu = Gpu::new();
    let make = |stage, format| {
        let Fixture { manifest, wgsl } = COPY.emit(stage);
        let manifest = Manifest::from_json(&manifest).expect("a manifest");
        Pass::with_options(
            &gpu.device,
            &manifest,
            &wgsl,
            &PassOptions::default().target_format(format),
        )
    };
    for (stage, format) in [
        (Stage::Compute, TextureFormat::Rgba16Float),
        (Stage::Fragment, TextureFormat::Rgba8Uint),
        (Stage::Fragment, TextureFormat::Depth32Float),
        (Stage::Fragment, TextureFormat::Rgb9e5Ufloat),
        (Stage::Fragment, TextureFormat::Bc1RgbaUnorm),
    ] {
        let error = make(stage, format).expect_err("a refusal");
        assert!(
            matches!(error, Error::TargetFormat { format: named, .. } if named == format),
            "{error}"
        );
        assert!(error.to_string().contains(&format!("{format:?}")), "{error}");
    }
    make(Stage::Compute, TextureFormat::Rgba32Float).expect("the format that the shader writes");
    make(Stage::Fragment, TextureFormat::R8Unorm).expect("a format with fewer components than the result");
}

#[test]
fn limits_that_are_too_low() {
    let low = |change: fn(&mut wgpu::Limits)| {
        let mut limits = wgpu::Limits::default();
        change(&mut limits);
        Gpu::with(wgpu::Features::empty(), limits)
    };
    let cases: [(Gpu, Kernel, &str); 7] = [
        (low(|l| l.max_bind_groups = 2), ADD, "max_bind_groups"),
        (
            low(|l| l.max_compute_invocations_per_workgroup = 32),
            ADD,
            "max_compute_invocations_per_workgroup",
        ),
        (
            low(|l| l.max_compute_workgroup_size_x = 4),
            ADD,
            "max_compute_workgroup_size_x",
        ),
        (
            low(|l| l.max_storage_textures_per_shader_stage = 0),
            ADD,
            "max_storage_textures_per_shader_stage",
        ),
        (
            low(|l| l.max_samplers_per_shader_stage = 0),
            SCALE,
            "max_samplers_per_shader_stage",
        ),
        (
            low(|l| l.max_storage_buffers_per_shader_stage = 0),
            TABLE,
            "max_storage_buffers_per_shader_stage",
        ),
        (
            low(|l| l.max_storage_buffer_binding_size = 12),
            TABLE,
            "max_storage_buffer_binding_size",
        ),
    ];
    for (gpu, kernel, name) in cases {
        let Fixture { manifest, wgsl } = kernel.emit(Stage::Compute);
        let (error, message) = refuse(&gpu, &manifest, &wgsl);
        assert!(
            matches!(error, Error::Limit { limit, .. } if limit == name),
            "{message}"
        );
    }
}

#[test]
fn a_lost_device() {
    for stage in STAGES {
        let gpu = Gpu::new();
        let Fixture { manifest, wgsl } = ADD.emit(stage);
        gpu.device.destroy();
        for _ in 0..2 {
            let (error, message) = refuse(&gpu, &manifest, &wgsl);
            assert!(
                matches!(error, Error::DeviceLost { .. }) && message.contains("`add`"),
                "{message}"
            );
            // The second time round, wgpu has released everything.
            gpu.device
                .poll(wgpu::PollType::wait_indefinitely())
                .expect("an idle device");
        }
    }
}
