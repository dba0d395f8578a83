//! Kernels in half precision: what the emitted shader computes against the interpreter, what it costs against `f64`, and what
//! is emitted, stated and refused.
//!
//! `cargo test --workspace --test shaders half:: -- --nocapture` prints how far off each kernel is.
//!
//! What agreement there is: on numbers that half precision holds, + - * / and the square root are rounded to nearest by every
//! driver that does not contract, and llvmpipe then agrees with the interpreter bit for bit. Numbers that it does not hold are
//! rounded as they come in, and WGSL leaves open in which direction: llvmpipe truncates, the interpreter takes the nearest.

use crate::common;
mod chosen;
mod emitted;
mod kernels;
mod quads;
mod values;

use common::bench;
use half::f16;
use straightline_bench::execute::{Bench, Inputs, interpret_kernel};
use straightline_codegen::ir::F16;
use straightline_codegen::{Compiled, Kernel, Precision, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;

/// A kernel of a test's own, `k`.
fn compile_text(text: &str, settings: &Settings) -> Compiled {
    let compiled = Kernel::from_text("test.rs", text, "k").compile(settings);
    compiled.unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A device that has half precision, in which all floats of a kernel are.
fn half_bench() -> Bench {
    capable_bench().with_precision(Precision::F16)
}

/// A device that has half precision.
fn capable_bench() -> Bench {
    let gpu = bench();
    assert!(
        gpu.device().features().contains(wgpu::Features::SHADER_F16),
        "this test needs an adapter with half precision; llvmpipe, of Debian's mesa-vulkan-drivers, has it, SwiftShader does not"
    );
    gpu
}

/// Returns whether the driver is known to round as IEEE 754 defines it, and to contract nothing.
fn rounds_exactly(gpu: &Bench) -> bool {
    gpu.device().adapter_info().driver == "llvmpipe"
}

/// Pictures of a kernel in half precision by the shader and by the interpreter.
fn both(gpu: &Bench, compiled: &Compiled, stage: Stage, inputs: &Inputs) -> [Frame<Vec4>; 2] {
    let shown = gpu.run(compiled, stage, inputs);
    let found = interpret_kernel::<F16>(compiled, inputs, false);
    [
        shown.unwrap_or_else(|e| panic!("{}: {e}", compiled.kernel)),
        found
            .unwrap_or_else(|e| panic!("{}: {e}", compiled.kernel))
            .frame(inputs),
    ]
}

/// The nearest number of half precision.
fn nearest(x: f32) -> f32 {
    f16::from_f32(x).to_f32()
}

/// Inputs all of whose numbers half precision holds: nothing is rounded as it comes in.
fn held(mut inputs: Inputs) -> Inputs {
    for image in inputs.images.iter_mut().flat_map(|(_, layers)| layers) {
        let texels = image
            .texels()
            .iter()
            .map(|t| Vec4::from_array(t.to_array().map(nearest)));
        *image = Frame::new(image.size(), texels.collect());
    }
    let elements = inputs.buffers.iter_mut().flat_map(|(_, elements)| elements).flatten();
    for number in elements.chain(inputs.uniforms.iter_mut().flat_map(|(_, lanes)| lanes)) {
        *number = f16::from_f64(*number).to_f64();
    }
    inputs
}

/// Pictures that a kernel writes at any place are floats of full precision.
#[test]
fn pictures_written_at_any_place_are_widened() {
    let text = "
        pub fn k(color: &Frame<Vec4>, mirrored: &StorageTexture<Vec4>, sum: &StorageTexture<f32>, pixel: IVec2) {
            let here = color.load(pixel);
            let last = mirrored.size().as_ivec2() - 1;
            mirrored.store(ivec2(last.x - pixel.x, pixel.y), here * 2.0);
            sum.store(pixel, here.x + here.y);
        }";
    let compiled = compile_text(text, &Settings::new());
    let size = uvec2(9, 5);
    let texels = (0..size.x * size.y).map(|k| Vec4::splat(k as f32 / 8.0)).collect();
    let inputs = Inputs::new(size).with_image("color", Frame::new(size, texels));
    let found = half_bench().run_targets(&compiled, Stage::Compute, &inputs);
    let expected = interpret_kernel::<F16>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{e}"));
    for (found, expected) in found.unwrap_or_else(|e| panic!("{e}")).iter().zip(&expected.targets) {
        assert_eq!(found.texels, expected.texels, "{}", found.name);
    }
}
