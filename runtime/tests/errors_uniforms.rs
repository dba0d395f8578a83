//! Uniforms that are missing, unknown or of another type or size are errors that name them.

mod common;

use common::{ADD, COPY, Fixture, Gpu, Kernel, Stage, ramp, view};
use straightline_runtime::{Error, Pass, wgpu};
use wgpu::TextureView;

const SIZE: [u32; 2] = [16, 9];

fn pass(gpu: &Gpu, kernel: &Kernel, stage: Stage) -> Pass {
    let Fixture { manifest, wgsl } = kernel.emit(stage);
    Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass")
}

/// Encodes what must be refused. The encoder must still be good.
fn refuse(gpu: &Gpu, pass: &Pass, inputs: &[(&str, &TextureView)], target: &TextureView) -> Error {
    let mut encoder = gpu.encoder();
    let error = pass.encode(&mut encoder, inputs, target).expect_err("a refusal");
    gpu.submit(encoder);
    assert!(error.to_string().contains(&format!("`{}`", pass.kernel())), "{error}");
    error
}

#[test]
fn uniforms_that_are_unset_unknown_or_of_another_type() {
    let gpu = Gpu::new();
    let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
    let target = view(&gpu.target(SIZE));
    let pass = pass(&gpu, &ADD, Stage::Compute);
    let error = refuse(&gpu, &pass, &[("color", &color)], &target);
    assert!(
        matches!(&error, Error::UniformUnset { name, .. } if name == "offset"),
        "{error}"
    );
    let error = pass.write_uniform(&gpu.queue, "tau", 1.0).expect_err("no such uniform");
    assert!(
        error
            .to_string()
            .contains("no uniform `tau`; it has `offset`, `scale` and `steps`"),
        "{error}"
    );
    let error = pass
        .write_uniform(&gpu.queue, "steps", 1.0)
        .expect_err("a float for an integer");
    assert!(
        matches!(&error, Error::UniformType { needed, given, .. } if needed == "i32" && given == "f32"),
        "{error}"
    );
    assert!(pass.write_uniform(&gpu.queue, "offset", [1.0, 2.0]).is_err());
    let error = pass.write_uniforms(&gpu.queue, &[0; 24]).expect_err("too few bytes");
    assert!(
        matches!(
            error,
            Error::UniformSize {
                needed: 32,
                given: 24,
                ..
            }
        ),
        "{error}"
    );
    assert!(pass.write_uniforms(&gpu.queue, &[0; 48]).is_err());
    // What was refused did not count as set.
    assert!(matches!(
        refuse(&gpu, &pass, &[("color", &color)], &target),
        Error::UniformUnset { .. }
    ));
}

#[test]
fn a_struct_for_a_kernel_without_uniforms() {
    let gpu = Gpu::new();
    let pass = pass(&gpu, &COPY, Stage::Compute);
    for bytes in [&[][..], &[0; 16]] {
        let error = pass.write_uniforms(&gpu.queue, bytes).expect_err("no uniforms");
        assert!(matches!(error, Error::NoUniforms { .. }), "{error}");
    }
}
