//! Filters of samples with negative lobes, beside very bright pixels: no component leaves the range of its surroundings.

use crate::common::{bench, same_bits};
use glam::{UVec2, Vec4, uvec2, vec4};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::{Stage, Unroll};
use straightline_kernels::prelude::Frame;
use straightline_oracle::oracle::{self, SraaParams};
use straightline_tests::sraa::options::{Options, options, values};
use straightline_tests::sraa::{compiled, native, surfaces};

const SIZE: UVec2 = uvec2(16, 11);

/// The largest half, in a column and in single pixels of a dark picture.
fn with_lights(set: &Options) -> Inputs {
    let mut inputs = surfaces::inputs(set, SIZE, 3);
    let dark = |k: u32| {
        let (x, y) = (k % SIZE.x, k / SIZE.x);
        let lit = x == 5 || (x, y) == (11, 4) || (x, y) == (12, 8);
        match lit {
            true => vec4(65504.0, 65504.0, 65504.0, 1.0),
            false => vec4(0.1 + 0.01 * x as f32, 0.2, 0.02 * y as f32, 1.0),
        }
    };
    for (name, layers) in &mut inputs.images {
        if name == "color" {
            layers[0] = Frame::new(SIZE, (0..SIZE.x * SIZE.y).map(dark).collect());
        }
    }
    inputs
}

/// The least and the most of each component in the 7×7 pixels around one.
fn range(inputs: &Inputs, at: UVec2) -> [Vec4; 2] {
    let (_, layers) = inputs.images.iter().find(|(name, _)| name == "color").expect("colours");
    let around = (-3..=3).flat_map(|y| (-3..=3).map(move |x| glam::ivec2(x, y)));
    let colors = around.map(|step| layers[0].load(at.as_ivec2() + step));
    let none = [Vec4::splat(f32::INFINITY), Vec4::splat(f32::NEG_INFINITY)];
    colors.fold(none, |[least, most], color| [least.min(color), most.max(color)])
}

#[test]
fn no_component_leaves_the_range_of_the_samples() {
    let bench = bench();
    for (resolve, radius, more) in [
        ("lanczos", "1.5", &[][..]),
        ("mitchell", "1.5", &[("guards", "fallback")]),
        ("lanczos", "1", &[("shading", "sample0"), ("non-finite", "spread")]),
    ] {
        let set = options(&[&[("resolve", resolve), ("resolve-radius", radius)], more].concat());
        let inputs = with_lights(&set);
        let form = |unroll| compiled(&set, unroll).unwrap_or_else(|errors| panic!("{set:?}:\n{errors}"));
        let expected = native::run(&set, &inputs);
        for unroll in [Unroll::Full, Unroll::None] {
            let found = interpret_kernel::<f32>(&form(unroll), &inputs, false)
                .expect("it runs")
                .texels;
            same_bits(&expected, &found).unwrap_or_else(|e| panic!("{set:?} {unroll}: {e}"));
        }
        let params = SraaParams::from_options(&values(&set)).expect("options");
        let defined = oracle::resolve_sraa(&inputs, &params).expect("a definition");
        let device = bench
            .run(&form(Unroll::Full), Stage::Compute, &inputs)
            .expect("a picture");
        let mut sure = 0;
        for (k, own) in expected.iter().enumerate() {
            let [least, most] = range(&inputs, uvec2(k as u32 % SIZE.x, k as u32 / SIZE.x));
            for found in [Vec4::from_array(*own), device.texels()[k]] {
                let inside = found.cmpge(least).all() && found.cmple(most).all();
                assert!(inside, "{set:?} at {k}: {found} of {least} to {most}");
                if defined[k].sure {
                    let off = (0..4).map(|axis| (f64::from(found[axis]) - defined[k].color[axis]).abs());
                    let off = off.fold(0.0, f64::max);
                    assert!(off < 2.0e-4 * 65504.0, "{set:?} at {k}: off by {off}");
                }
            }
            sure += usize::from(defined[k].sure);
        }
        assert!(sure * 4 > 3 * expected.len(), "{set:?}: {sure} pixels compared");
        // The bright pixels, and the lobes beside them, are there.
        assert!(expected.iter().any(|color| color[0] > 1.0e4), "{set:?}");
    }
}
