//! Passes and chains in compute and render passes of the caller's.

use crate::chains::glowing;
use crate::common::{self, chains, ramp, view};

use chains::{BLEND, DOWN, glow, make, make_of};
use common::{COPY, Fixture, Gpu, STAGES, Stage};
use straightline_runtime::{Bound, Error, Pass, PassOptions, wgpu};

const SIZE: [u32; 2] = [9, 5];

fn copy(gpu: &Gpu, stage: Stage, [from, to]: [&wgpu::Texture; 2]) -> Bound {
    let Fixture { manifest, wgsl } = COPY.emit(stage);
    let pass = Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass");
    pass.bind(&[("color", &view(from))], &view(to)).expect("to bind")
}

/// Records `work` into a compute pass of an encoder, and submits it.
fn compute<T>(gpu: &Gpu, work: impl FnOnce(&mut wgpu::ComputePass<'_>) -> T) -> T {
    let mut encoder = gpu.encoder();
    let done = work(&mut encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default()));
    gpu.submit(encoder);
    done
}

/// Records `work` into a render pass to `target`, which starts black, and returns the finished encoder.
fn render<T>(
    gpu: &Gpu,
    target: &wgpu::Texture,
    work: impl FnOnce(&mut wgpu::RenderPass<'_>) -> T,
) -> (wgpu::CommandBuffer, T) {
    let mut encoder = gpu.encoder();
    let done = work(&mut encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view(target),
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        ..Default::default()
    }));
    (encoder.finish(), done)
}

#[test]
fn dispatches_share_a_compute_pass() {
    let gpu = Gpu::new();
    let color = gpu.upload(SIZE, 1, &ramp(SIZE, 1));
    let [first, second, third] = [gpu.target(SIZE), gpu.target(SIZE), gpu.target(SIZE)];
    // Each reads what the one before has written.
    let copies = [[&color, &first], [&first, &second], [&second, &third]];
    let bound = copies.map(|textures| copy(&gpu, Stage::Compute, textures));
    compute(&gpu, |pass| bound.iter().try_for_each(|bound| bound.encode_into(pass))).expect("compute shaders");
    assert_eq!(gpu.download(&third), ramp(SIZE, 1));
}

#[test]
fn a_chain_shares_a_compute_pass() {
    let gpu = Gpu::new();
    let chain = make_of(&gpu, &glow(), &[&DOWN, &BLEND], Stage::Compute).expect("a chain");
    let [copied, target] = [gpu.target(SIZE), gpu.target(SIZE)];
    let before = copy(&gpu, Stage::Compute, [&gpu.upload(SIZE, 1, &ramp(SIZE, 1)), &copied]);
    let bound = chain
        .bind(&[("color", &view(&copied))], &view(&target))
        .expect("to bind");
    compute(&gpu, |pass| {
        before.encode_into(pass)?;
        bound.encode_into(pass)
    })
    .expect("compute shaders");
    assert_eq!(gpu.download(&target), glowing(SIZE));
}

#[test]
fn a_draw_obeys_the_render_pass() {
    let gpu = Gpu::new();
    let color = gpu.upload(SIZE, 1, &ramp(SIZE, 1));
    let [bound_to, drawn_to] = [gpu.target(SIZE), gpu.target(SIZE)];
    let bound = copy(&gpu, Stage::Fragment, [&color, &bound_to]);
    let (buffer, done) = render(&gpu, &drawn_to, |pass| {
        pass.set_scissor_rect(2, 1, 3, 2);
        bound.draw_into(pass)
    });
    done.expect("a fragment shader");
    gpu.queue.submit([buffer]);
    let places = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    let wanted: Vec<[f32; 4]> = places
        .zip(ramp(SIZE, 1))
        .map(|((x, y), color)| match (2..5).contains(&x) && (1..3).contains(&y) {
            true => color,
            false => [0.0; 4],
        })
        .collect();
    assert_eq!(gpu.download(&drawn_to), wanted);
    assert_eq!(gpu.download(&bound_to), [[0.0; 4]; 45]);
}

#[test]
fn wgpu_reports_a_render_pass_of_another_format() {
    let gpu = Gpu::new();
    let bound = copy(
        &gpu,
        Stage::Fragment,
        [&gpu.upload(SIZE, 1, &ramp(SIZE, 1)), &gpu.target(SIZE)],
    );
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
    let other = gpu.texture(SIZE, 1, wgpu::TextureFormat::Rgba8Unorm, usage);
    let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let (_, done) = render(&gpu, &other, |pass| bound.draw_into(pass));
    done.expect("a fragment shader");
    let error = pollster::block_on(scope.pop()).expect("an error").to_string();
    assert!(error.contains("Rgba8Unorm") && error.contains("Rgba32Float"), "{error}");
}

#[test]
fn a_pass_of_the_other_kind_is_refused() {
    let gpu = Gpu::new();
    let color = gpu.upload(SIZE, 1, &ramp(SIZE, 1));
    for stage in STAGES {
        let target = gpu.target(SIZE);
        let bound = copy(&gpu, stage, [&color, &target]);
        let (refused, wanted) = match stage {
            Stage::Compute => (
                render(&gpu, &gpu.target(SIZE), |pass| bound.draw_into(pass)).1,
                "`copy` is a compute shader and cannot be recorded into a render pass: call `encode_into`, or generate it \
                 for the stage `fragment`",
            ),
            Stage::Fragment => (
                compute(&gpu, |pass| bound.encode_into(pass)),
                "`copy` is a fragment shader and cannot be recorded into a compute pass: call `draw_into`, or generate it \
                 for the stage `compute`",
            ),
        };
        let refused = refused.expect_err("a refusal");
        assert_eq!(refused.to_string(), wanted);
        assert_eq!(gpu.download(&target), [[0.0; 4]; 45]);
    }
}

#[test]
fn a_chain_with_a_fragment_shader_is_refused_by_its_pass() {
    let gpu = Gpu::new();
    let shaders = [
        ("down", DOWN.emit(Stage::Compute)),
        ("blend", BLEND.emit(Stage::Fragment)),
    ];
    let chain = make(&gpu, &glow(), &shaders, &PassOptions::default()).expect("a chain");
    let (color, target) = (view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1))), gpu.target(SIZE));
    let bound = chain.bind(&[("color", &color)], &view(&target)).expect("to bind");
    let error = compute(&gpu, |pass| bound.encode_into(pass)).expect_err("a refusal");
    assert!(matches!(error, Error::Chain { .. }));
    let wanted = "chain `chain`: pass `out`: `blend` is a fragment shader and cannot be recorded into a compute pass: ";
    assert!(error.to_string().starts_with(wanted), "{error}");
    let half = bound.picture("half").expect("a picture").texture();
    assert!(gpu.download(half).iter().all(|pixel| *pixel == [0.0; 4]));
}
