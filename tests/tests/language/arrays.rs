//! Kept loops that write arrays, on a real driver.

use crate::common;

use common::{bench, same_bits};
use straightline_bench::execute::interpret_kernel;
use straightline_codegen::{Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_tests::sraa::options::options;
use straightline_tests::sraa::surfaces;

/// Arrays of structured loops are variables that are changed in place: begun anew, chosen, and read before they change.
#[test]
fn arrays_of_kept_loops_hold_what_the_graph_says() {
    let bench = bench();
    let inputs = surfaces::inputs(&options(&[]), uvec2(12, 9), 3);
    let begun_anew = "let mut a = [1.0, 2.0, 3.0];
        for k in 0..3 {
            total += a[k];
            a = [5.0, 6.0, 7.0];
            a[k] = shade.x;
            total += a[0] + a[2];
        }";
    let chosen = "let mut a = [1.0, 2.0, 3.0];
        for k in 0..3 {
            if shade.x * (k as f32) > 0.4 {
                a[k] += shade.y;
            } else {
                a = [0.5, 0.25, 0.125];
            }
            total += a[0] - a[1] + a[2];
        }";
    let kept_or_begun = "let mut a = [1.0, 2.0, 3.0];
        for k in 0..3 {
            if shade.x > 0.5 {
                a = [9.0, 8.0, 7.0];
            }
            a[k] += 1.0;
            total += a[2 - k];
        }";
    for (name, body) in [
        ("begun_anew", begun_anew),
        ("chosen", chosen),
        ("kept_or_begun", kept_or_begun),
    ] {
        let text = format!(
            "pub fn {name}(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{
                let shade = color.load(pixel);
                let mut total = 0.0;
                {body}
                Vec4::splat(total)
            }}"
        );
        let kernel = straightline_codegen::Kernel::from_text("test.rs", &text, name);
        let settings = |unroll| straightline_codegen::Settings::new().unroll(unroll);
        let compiled = [Unroll::Full, Unroll::None]
            .map(|unroll| kernel.compile(&settings(unroll)).unwrap_or_else(|e| panic!("{e}")));
        let [unrolled, looped] = [0, 1].map(|k| {
            let interpreted = interpret_kernel::<f32>(&compiled[k], &inputs, false);
            interpreted.unwrap_or_else(|e| panic!("{name}: {e}")).texels
        });
        same_bits(&unrolled, &looped).unwrap_or_else(|e| panic!("{name}: {e}"));
        let result = bench
            .run(&compiled[1], Stage::Compute, &inputs)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        for (k, (a, b)) in result.texels().iter().zip(&looped).enumerate() {
            assert!(
                (*a - Vec4::from_array(*b)).abs().max_element() < 1.0e-4,
                "{name}, pixel {k}: {a} and {b:?}"
            );
        }
    }
}
