//! Messages between the lanes of a quad: they travel as `f32`, which holds every number of half precision.

use super::*;
use straightline_bench::execute::test_inputs;
use straightline_codegen::Transport;

const HEARD: &str = "
pub fn k(value: &Frame<f32>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let [own, beside, below, across] = value.load(pixel).gather();
    Quad::from_xy(own, beside).extend(below).extend(across)
}
";

fn by(transport: Option<Transport>) -> Settings {
    Settings::new().transport(transport)
}

#[test]
fn messages_arrive() {
    let gpu = half_bench();
    let lanes = [1000.0, 0.3, -0.0, 65504.0, 6.0e-8, -7.0, 0.1, 1.0e-4].map(nearest);
    let size = uvec2(4, 2);
    let image = Frame::new(size, lanes.map(Vec4::splat).to_vec());
    let inputs = Inputs::new(size).with_image("value", image.clone());
    let heard =
        |x: i32, y: i32| [(x, y), (x ^ 1, y), (x, y ^ 1), (x ^ 1, y ^ 1)].map(|(x, y)| image.load(ivec2(x, y)).x);
    for (transport, stage) in [
        (Transport::Subgroup, Stage::Fragment),
        (Transport::Block, Stage::Compute),
    ] {
        let compiled = compile_text(HEARD, &by(Some(transport)));
        for found in both(&gpu, &compiled, stage, &inputs) {
            for (x, y) in (0..2).flat_map(|y| (0..4).map(move |x| (x, y))) {
                let found = found.load(ivec2(x, y)).to_array();
                assert_eq!(
                    found.map(f32::to_bits),
                    heard(x, y).map(f32::to_bits),
                    "{transport} {x} {y}"
                );
            }
        }
    }
    // By derivatives they lose what the interpreter says, much more than in full precision.
    let lossy = compile_text(HEARD, &by(Some(Transport::Derivatives)));
    let [shown, expected] = both(&gpu, &lossy, Stage::Fragment, &inputs);
    assert!(expected.texels() != both(&gpu, &compile_text(HEARD, &by(None)), Stage::Compute, &inputs)[1].texels());
    for (shown, expected) in shown.texels().iter().zip(expected.texels()) {
        if rounds_exactly(&gpu) {
            assert_eq!(shown, expected);
        }
        assert!(((*shown - *expected).abs() / expected.abs().max(Vec4::ONE)).max_element() < 2.0 / 1024.0);
    }
}

/// Whole filters by every transport, on numbers that half precision holds.
#[test]
fn filters_of_quads_agree_by_every_transport() {
    let gpu = half_bench();
    for name in ["quad_convolution", "quad_bilateral", "quad_ssao"] {
        for transport in [Transport::Subgroup, Transport::Derivatives] {
            let compiled = Kernel::builtin(name).and_then(|k| k.compile(&by(Some(transport))));
            let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
            let inputs = held(test_inputs(&compiled.in_blocks().graph, uvec2(33, 21)));
            let [shown, expected] = both(&gpu, &compiled, Stage::Fragment, &inputs);
            let off = |(a, b): (&Vec4, &Vec4)| (*a - *b).abs().max_element();
            let worst = shown
                .texels()
                .iter()
                .zip(expected.texels())
                .map(off)
                .fold(0.0, f32::max);
            println!("{name} by {transport}: {worst:e}");
            assert!(worst <= 4.0 / 1024.0, "{name} by {transport}: {worst:e}");
        }
    }
}
