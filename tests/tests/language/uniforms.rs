//! Parameters that are enums: each form computes what rustc does, for every variant.

#[path = "uniforms/kernels.rs"]
mod kernels;

use crate::common::same_bits;
use glam::{IVec2, Vec4, ivec2, uvec2};
use kernels::{Blend, Layer, Mode, Only};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::{Branches, Kernel, Settings, Unroll};
use straightline_kernels::prelude::Frame;

const TEXT: &str = include_str!("uniforms/kernels.rs");

const MODES: [Mode; 2] = [Mode::Sharp, Mode::Soft];

const BLENDS: [Blend; 4] = [Blend::Over, Blend::Add, Blend::Multiply, Blend::Screen];

const FORMS: [(Unroll, Branches); 4] = [
    (Unroll::Full, Branches::Select),
    (Unroll::Full, Branches::Keep),
    (Unroll::None, Branches::AsLoops),
    (Unroll::Partial(2), Branches::Keep),
];

fn frame() -> Frame<Vec4> {
    let texel = |k: u32| Vec4::new(k as f32 * 0.125, 1.5 - k as f32 * 0.25, k as f32, 0.75);
    Frame::new(uvec2(4, 3), (0..12).map(texel).collect())
}

/// Compares the texels of a kernel with those of its native version.
fn compare(name: &str, uniforms: &[(&str, u32)], native: impl Fn(&Frame<Vec4>, IVec2) -> Vec4) {
    let frame = frame();
    let mut inputs = Inputs::new(uvec2(4, 3));
    let uniform = |(name, value): &(&str, u32)| ((*name).to_owned(), vec![f64::from(*value)]);
    inputs.uniforms = uniforms.iter().map(uniform).collect();
    inputs.uniforms.push(("amount".to_owned(), vec![0.75]));
    inputs.images = vec![("color".to_owned(), vec![frame.clone()])];
    let pixels = (0..12).map(|k| ivec2(k % 4, k / 4));
    let expected: Vec<[f32; 4]> = pixels.map(|pixel| native(&frame, pixel).to_array()).collect();
    for (unroll, branches) in FORMS {
        let settings = Settings::new().unroll(unroll).branches(branches);
        let kernel = Kernel::from_text("uniforms.rs", TEXT, name);
        let compiled = kernel.compile(&settings).unwrap_or_else(|e| panic!("{name}:\n{e}"));
        let result = interpret_kernel::<f32>(&compiled, &inputs, false);
        let result = result.unwrap_or_else(|e| panic!("{name} {unroll}: {e}"));
        same_bits(&expected, &result.texels).unwrap_or_else(|e| panic!("{name} {unroll} {uniforms:?}: {e}"));
    }
}

#[test]
fn enums_are_set_by_the_positions_of_their_variants() {
    for (m, mode) in (0..).zip(MODES) {
        for (b, blend) in (0..).zip(BLENDS) {
            let set = [("mode", m), ("blend", b)];
            compare("modes", &set, |frame, pixel| {
                kernels::modes(frame, mode, blend, Only::One, pixel)
            });
        }
    }
}

#[test]
fn numbers_beyond_the_last_variant_are_the_last_variant() {
    let set = [("mode", 9), ("blend", u32::MAX)];
    let (mode, blend) = (Mode::Soft, Blend::Screen);
    compare("modes", &set, |frame, pixel| {
        kernels::modes(frame, mode, blend, Only::One, pixel)
    });
}

#[test]
fn enums_stand_in_structures_and_arrays() {
    for k in 0..8_u32 {
        let at = |n: u32| BLENDS[((k + n) % 4) as usize];
        let opaque = k % 2 == 1;
        let set = [
            ("blend", (k + 3) % 4),
            ("opaque", u32::from(opaque)),
            ("blends_0", k % 4),
            ("blends_1", (k + 1) % 4),
            ("blends_2", (k + 2) % 4),
        ];
        let layer = Layer {
            blend: at(3),
            opaque,
            amount: 0.75,
        };
        compare("layers", &set, |frame, pixel| {
            kernels::layers(frame, layer, [at(0), at(1), at(2)], pixel)
        });
    }
}
