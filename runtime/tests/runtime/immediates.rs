//! Uniforms that are immediates: recorded by every way to run a shader, set between recordings, and refused by name.

use crate::common::{self, chains};

use chains::{make, pass, picture, plan, sizes};
use common::{Fixture, Gpu, STAGES, Stage, ramp, tinted, view};
use straightline_runtime::{BindOptions, Bound, Draw, DrawOptions, Error, Pass, PassOptions, wgpu};

const SIZE: [u32; 2] = [9, 5];

const COVER: &str = "@vertex fn cover(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(f32(k & 1u) * 4.0 - 1.0, f32(k >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}";

fn gpu() -> Gpu {
    Gpu::with_immediates(32)
}

fn options() -> BindOptions<'static> {
    BindOptions::default().uniform("offset", [1.0, 2.0, 3.0, 4.0])
}

fn bind(gpu: &Gpu, stage: Stage, target: &wgpu::Texture) -> Bound {
    let Fixture { manifest, wgsl } = tinted(stage);
    let pass = Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass");
    let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
    pass.bind_with(&[("color", &color)], &view(target), &options())
        .expect("to bind")
}

/// The picture for a scale, with the offset of `options` plus `more`.
fn tint(scale: f32, more: f32) -> Vec<[f32; 4]> {
    let tint = |color: [f32; 4]| std::array::from_fn(|k| color[k] * scale + (k as f32 + 1.0 + more));
    ramp(SIZE, 1).into_iter().map(tint).collect()
}

/// Records `work` into a render pass to `target`.
fn render(gpu: &Gpu, target: &wgpu::Texture, work: impl FnOnce(&mut wgpu::RenderPass<'_>)) {
    let mut encoder = gpu.encoder();
    work(&mut encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view(target),
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        ..Default::default()
    }));
    gpu.submit(encoder);
}

/// Two recordings of one submission have a value each, which a uniform buffer could not.
#[test]
fn each_recording_has_its_values() {
    let gpu = gpu();
    for stage in STAGES {
        let (target, kept) = (
            gpu.target(SIZE),
            gpu.texture(
                SIZE,
                1,
                wgpu::TextureFormat::Rgba32Float,
                wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::COPY_SRC,
            ),
        );
        let bound = bind(&gpu, stage, &target);
        let mut encoder = gpu.encoder();
        bound.encode(&mut encoder);
        encoder.copy_texture_to_texture(target.as_image_copy(), kept.as_image_copy(), target.size());
        bound.write_uniform(&gpu.queue, "scale", 0.5_f32).expect("a uniform");
        bound.encode(&mut encoder);
        gpu.submit(encoder);
        assert_eq!(gpu.download(&kept), tint(2.0, 0.0), "{stage:?}");
        assert_eq!(gpu.download(&target), tint(0.5, 0.0), "{stage:?}");

        let numbers = [2.0_f32, 3.0, 4.0, 5.0, 3.0, 0.0, 0.0, 0.0];
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        bound.write_uniforms(&gpu.queue, &bytes).expect("as many bytes");
        bound.write_at(&gpu.queue, 16, &4.0_f32.to_le_bytes());
        let mut encoder = gpu.encoder();
        bound.encode(&mut encoder);
        gpu.submit(encoder);
        assert_eq!(gpu.download(&target), tint(4.0, 1.0), "{stage:?}");
    }
}

#[test]
fn passes_of_the_callers_have_them() {
    let gpu = gpu();
    let target = gpu.target(SIZE);
    let bound = bind(&gpu, Stage::Compute, &target);
    let mut encoder = gpu.encoder();
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    bound.encode_into(&mut pass).expect("a compute shader");
    drop(pass);
    gpu.submit(encoder);
    assert_eq!(gpu.download(&target), tint(2.0, 0.0));

    let target = gpu.target(SIZE);
    let bound = bind(&gpu, Stage::Fragment, &gpu.target(SIZE));
    render(&gpu, &target, |pass| bound.draw_into(pass).expect("a fragment shader"));
    assert_eq!(gpu.download(&target), tint(2.0, 0.0));
}

#[test]
fn triangles_have_them() {
    let gpu = gpu();
    let Fixture { manifest, wgsl } = tinted(Stage::Fragment);
    let draw = Draw::from_json(&gpu.device, &manifest, &wgsl, &DrawOptions::new(COVER, "cover")).expect("it fits");
    let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
    let bound = draw.bind_with(&[("color", &color)], &options()).expect("to bind");
    bound.write_uniform(&gpu.queue, "scale", 3.0_f32).expect("a uniform");
    let target = gpu.target(SIZE);
    render(&gpu, &target, |pass| {
        bound.set(pass);
        pass.draw(0..3, 0..1);
    });
    assert_eq!(gpu.download(&target), tint(3.0, 0.0));
}

#[test]
fn passes_of_a_chain_have_them() {
    let gpu = gpu();
    let [full, _] = sizes();
    let plan = plan(
        &["color"],
        vec![picture("first", &full, Some(0)), picture("out", &full, None)],
        vec![
            pass("tinted", &[("color", "color")], &["first"]),
            pass("tinted", &[("color", "first")], &["out"]),
        ],
    );
    let chain = make(
        &gpu,
        &plan,
        &[("tinted", tinted(Stage::Compute))],
        &PassOptions::default(),
    )
    .expect("a chain");
    let (color, target) = (view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1))), gpu.target(SIZE));
    let bound = chain
        .bind_with(&[("color", &color)], &view(&target), &options())
        .expect("to bind");
    bound.write_uniform(&gpu.queue, "scale", 0.5_f32).expect("a uniform");
    let mut encoder = gpu.encoder();
    bound.encode(&mut encoder);
    gpu.submit(encoder);
    let twice = |first: [f32; 4]| -> [f32; 4] { std::array::from_fn(|k| first[k] * 0.5 + (k as f32 + 1.0)) };
    let wanted: Vec<[f32; 4]> = tint(0.5, 0.0).into_iter().map(twice).collect();
    assert_eq!(gpu.download(&target), wanted);
}

#[test]
fn a_device_without_them_is_told_what_to_ask_for() {
    let Fixture { manifest, wgsl } = tinted(Stage::Compute);
    let refuse = |gpu: &Gpu, manifest: &str| Pass::from_json(&gpu.device, manifest, &wgsl).expect_err("a refusal");
    let message = refuse(&Gpu::new(), &manifest).to_string();
    for word in [
        "`tinted`",
        "IMMEDIATES",
        "max_immediate_size: 32",
        "`parameters` as `uniform`",
    ] {
        assert!(message.contains(word), "{message}");
    }
    let few = refuse(&Gpu::with_immediates(16), &manifest);
    assert!(
        matches!(
            few,
            Error::Limit {
                limit: "max_immediate_size",
                needed: 32,
                available: 16,
                ..
            }
        ),
        "{few}"
    );
    let edits = [
        (
            r#""features": ["immediates"]"#,
            r#""features": []"#,
            "the feature `immediates` is not listed",
        ),
        (
            r#""size": 32"#,
            r#""size": 24"#,
            "immediates `params`: 24 bytes, not a multiple of 16",
        ),
        (r#""size": 32"#, r#""size": 16"#, "ends beyond"),
        (
            r#""name": "params""#,
            r#""name": "other""#,
            "it has no immediates `other`",
        ),
    ];
    for (from, to, wanted) in edits {
        assert!(manifest.contains(from), "{from}");
        let message = refuse(&gpu(), &manifest.replace(from, to)).to_string();
        assert!(message.contains(wanted), "{message}");
    }
    let (head, rest) = manifest.split_once(r#""immediates": {"#).expect("immediates");
    let (_, tail) = rest.split_once(r#""bindings""#).expect("bindings");
    let message = refuse(&gpu(), &format!(r#"{head}"bindings"{tail}"#)).to_string();
    assert!(
        message.contains("it uses the immediates `params`, which the manifest lacks"),
        "{message}"
    );
}
