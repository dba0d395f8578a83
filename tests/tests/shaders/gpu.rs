//! Emitted shaders on a real driver against a brute force in f64 that shares no code with the kernel.

use crate::common;

use common::bench;
use straightline_bench::execute::{Bench, Inputs, interpret_kernel, test_inputs};
use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Kernel, ReadOrder, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_oracle::oracle::{self, SraaParams};
use straightline_tests::sraa::options::{one_at_a_time, options, random, refusal, samples_needed, values};
use straightline_tests::sraa::{Difference, Options, compiled, difference, scenes, surfaces};

/// Most that a result may be off, for colours in 0..1 and before output rounding.
const BOUND: f64 = 1.0 / 1024.0;

/// Samples of a texel that every device has.
const SAMPLES: u32 = 4;

fn off(bench: &Bench, options: &Options, stage: Stage, unroll: Unroll, inputs: &Inputs) -> Difference {
    let compiled = compiled(options, unroll).unwrap_or_else(|errors| panic!("{options:?}:\n{errors}"));
    let result = bench.run(&compiled, stage, inputs);
    let result = result.unwrap_or_else(|e| panic!("{options:?} {stage:?}: {e}"));
    let params = SraaParams::from_options(&compiled.options).unwrap_or_else(|e| panic!("{e}"));
    let expected = oracle::resolve_sraa(inputs, &params).unwrap_or_else(|e| panic!("{options:?}: {e}"));
    difference(&result, &expected)
}

fn all_match(sets: &[Options], size: UVec2, forms: &[(Stage, Unroll)]) {
    let bench = bench();
    let mut worst = (0.0, String::new());
    for options in sets {
        if refusal(options).is_some() || samples_needed(options) > SAMPLES {
            continue;
        }
        let inputs = surfaces::inputs(options, size, 5);
        for (stage, unroll) in forms {
            let off = off(&bench, options, *stage, *unroll, &inputs);
            let what = format!("{options:?} {stage:?} {unroll}");
            assert!(
                off.compared * 4 > inputs.size.element_product() as usize,
                "{what}: {off:?}"
            );
            assert!(off.largest <= BOUND && off.non_finite == 0, "{what}: {off:?}");
            if off.largest > worst.0 {
                worst = (off.largest, what);
            }
        }
    }
    println!("largest difference to f64: {:e} ({})", worst.0, worst.1);
}

#[test]
fn each_value_of_each_option_matches_the_brute_force() {
    let forms = [
        (Stage::Compute, Unroll::Full),
        (Stage::Fragment, Unroll::Full),
        (Stage::Compute, Unroll::None),
    ];
    all_match(&one_at_a_time(), uvec2(61, 47), &forms);
}

#[test]
fn options_together_match_the_brute_force() {
    let forms = [(Stage::Compute, Unroll::Full), (Stage::Fragment, Unroll::Full)];
    all_match(&random(24, 2), uvec2(29, 23), &forms);
}

#[test]
fn any_size_from_one_pixel() {
    let sets: Vec<Options> = ["layers", "superresolution", "multisampled", "split"]
        .map(|layout| options(&[("layout", layout), ("metric", "planes-normals")]))
        .into();
    for size in [uvec2(1, 1), uvec2(1, 7), uvec2(9, 1), uvec2(8, 8), uvec2(17, 33)] {
        all_match(
            &sets,
            size,
            &[(Stage::Compute, Unroll::Full), (Stage::Fragment, Unroll::Full)],
        );
    }
}

/// Caches may tell in which order texels are read; pictures do not.
#[test]
fn the_order_of_reads_changes_no_bit() {
    let bench = bench();
    for (name, options, unroll) in [
        ("sraa", &[("mask", "select")][..], Unroll::Full),
        ("sraa", &[("pattern", "latin16"), ("layout", "split")], Unroll::Full),
        ("sraa", &[], Unroll::None),
        ("sraa", &[("mask", "branch")], Unroll::Partial(2)),
        ("stalker", &[], Unroll::Full),
        ("quad_convolution", &[("radius", "2")], Unroll::Full),
    ] {
        let compiled = |reads| {
            let settings = Settings::new()
                .set_all(straightline_tests::sraa::options::options(options))
                .unroll(unroll)
                .reads(reads);
            let kernel = Kernel::builtin(name).and_then(|kernel| kernel.compile(&settings));
            kernel.unwrap_or_else(|errors| panic!("{name} {options:?}:\n{errors}"))
        };
        let both = [ReadOrder::Source, ReadOrder::Rows].map(compiled);
        let inputs = test_inputs(&both[0].in_blocks().graph, uvec2(37, 21));
        let [source, rows] = both.each_ref().map(|compiled| {
            let picture = bench.run(compiled, Stage::Compute, &inputs);
            let picture = picture.unwrap_or_else(|error| panic!("{name} {options:?}: {error}"));
            let interpreted = interpret_kernel::<f32>(compiled, &inputs, false);
            (
                picture,
                interpreted.unwrap_or_else(|error| panic!("{name}: {error}")).texels,
            )
        });
        let bits = |frame: &Frame<Vec4>| {
            frame
                .texels()
                .iter()
                .map(|t| t.to_array().map(f32::to_bits))
                .collect::<Vec<_>>()
        };
        assert!(bits(&source.0) == bits(&rows.0), "{name} {options:?} {unroll}");
        assert_eq!(source.1, rows.1, "{name} {options:?} {unroll}");
        let texts = both.each_ref().map(|compiled| {
            let emitted = compiled.emit(&EmitOptions::new().targets([Target::Wgsl]));
            emitted.unwrap_or_else(|error| panic!("{error}")).files[&Target::Wgsl].clone()
        });
        assert!(texts[0] != texts[1], "{name} {options:?} {unroll}: the same text");
    }
}

/// A bad colour is left out of every pixel, its own included.
#[test]
fn a_bad_colour_spreads_nowhere() {
    let bench = bench();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for mask in ["none", "select", "branch"] {
            let set = options(&[("mask", mask)]);
            let mut inputs = surfaces::inputs(&set, uvec2(24, 16), 5);
            let mut texels = image(&inputs, "color").texels().to_vec();
            for (k, texel) in texels.iter_mut().enumerate() {
                if k % 37 == 5 {
                    texel[k % 4] = bad;
                }
            }
            inputs = inputs.with_image("color", Frame::new(uvec2(24, 16), texels));
            for stage in [Stage::Compute, Stage::Fragment] {
                let off = off(&bench, &set, stage, Unroll::Full, &inputs);
                assert_eq!((off.non_finite, off.compared), (0, 24 * 16), "{bad} {mask} {stage:?}");
                assert!(off.largest < BOUND, "{bad} {mask} {stage:?}: {off:?}");
            }
        }
    }
}

/// A pixel whose own samples show the same as its shading sample keeps its colour bit for bit, whatever lies around: and no
/// other pixel does.
#[test]
fn a_pixel_without_variation_within_keeps_its_colour() {
    let bench = bench();
    let size = uvec2(61, 47);
    for more in [
        &[][..],
        &[("shading", "placed"), ("search", "five")],
        &[("shading", "sample0"), ("difference", "relative")],
        &[
            ("metric", "planes-normals"),
            ("difference", "relative"),
            ("guards", "fallback"),
        ],
        &[("resolve", "tent")],
        &[
            ("pattern", "latin16"),
            ("metric", "planes-normals"),
            ("difference", "relative"),
        ],
    ] {
        for mask in ["select", "branch"] {
            let set = options(&[&[("mask", mask), ("variation", "within")], more].concat());
            let inputs = surfaces::inputs(&set, size, 5);
            let params = SraaParams::from_options(&values(&set)).expect("options");
            let expected = oracle::resolve_sraa(&inputs, &params).expect("a definition");
            let color = image(&inputs, "color");
            let own = |k: usize| color.texels()[k].to_array();
            let is_own = |k: usize| expected[k].color == own(k).map(f64::from);
            let compiled = compiled(&set, Unroll::Full).expect("it compiles");
            for stage in [Stage::Compute, Stage::Fragment] {
                let result = bench.run(&compiled, stage, &inputs).expect("it runs");
                let off = difference(&result, &expected);
                assert!(off.largest < BOUND && off.non_finite == 0, "{set:?} {stage:?}: {off:?}");
                let sure = (0..expected.len()).filter(|k| expected[*k].sure);
                let kept = sure.clone().filter(|k| is_own(*k)).count();
                assert!(kept > 100 && kept + 20 < sure.clone().count(), "{set:?}: {kept} kept");
                for k in sure {
                    let bits = result.texels()[k].to_array().map(f32::to_bits);
                    let is_kept = bits == own(k).map(f32::to_bits);
                    assert!(is_kept || !is_own(k), "{set:?} {stage:?} at {k}");
                }
            }
        }
    }
}

/// Alpha is a weight like any other component: what is premultiplied stays so, and colours may be brighter than 1.
#[test]
fn bright_and_transparent_colours_are_filtered_as_they_are() {
    let bench = bench();
    let set = options(&[]);
    let inputs = surfaces::inputs(&set, uvec2(24, 16), 6);
    let texels = image(&inputs, "color").texels().iter().enumerate().map(|(k, texel)| {
        let alpha = (k % 5) as f32 / 4.0;
        (texel.truncate() * 1.0e4 * alpha).extend(alpha)
    });
    let color = Frame::new(uvec2(24, 16), texels.collect());
    let inputs = inputs.clone().with_image("color", color);
    let off = off(&bench, &set, Stage::Compute, Unroll::Full, &inputs);
    assert!(off.largest < 1.0e4 * BOUND && off.non_finite == 0, "{off:?}");
    let compiled = compiled(&set, Unroll::Full).expect("it compiles");
    let result = bench.run(&compiled, Stage::Compute, &inputs).expect("it runs");
    for texel in result.texels() {
        assert!(
            (0.0..=1.001).contains(&texel.w) && texel.truncate().max_element() <= texel.w * 1.001e4,
            "{texel}"
        );
    }
}

/// Pixels on even ground keep their colour bit for bit, however bright, where the mask is on.
#[test]
fn the_mask_keeps_even_ground_bit_for_bit() {
    let bench = bench();
    for mask in ["select", "branch"] {
        let set = options(&[("mask", mask)]);
        let size = uvec2(32, 24);
        let even = |texel: Vec4| Frame::new(size, vec![texel; 32 * 24]);
        let inputs = surfaces::inputs(&set, size, 7)
            .with_layers("depth", vec![even(Vec4::splat(3.0)); 5])
            .with_layers("normal", vec![even(vec4(0.0, 0.0, 1.0, 0.0)); 5]);
        let color = image(&inputs, "color").clone();
        let compiled = compiled(&set, Unroll::Full).expect("it compiles");
        for stage in [Stage::Compute, Stage::Fragment] {
            let result = bench.run(&compiled, stage, &inputs).expect("it runs");
            assert_eq!(result.texels(), color.texels(), "{mask} {stage:?}");
        }
        let interpreted = interpret_kernel::<f32>(&compiled, &inputs, false).expect("it runs");
        assert_eq!(interpreted.frame(&inputs), color, "{mask}");
    }
}

fn image<'a>(inputs: &'a Inputs, name: &str) -> &'a Frame<Vec4> {
    let found = inputs.images.iter().rev().find(|(known, _)| known == name);
    &found.expect("it is there").1[0]
}

/// Planes at a grazing angle, far away, where depths are large and so are their roundings.
#[test]
fn planes_on_grazing_ground_are_within_the_bounds_of_the_error_analysis() {
    for scene in ["floor", "terrain"] {
        let sets = [
            options(&[("metric", "planes-normals")]),
            options(&[
                ("metric", "planes-normals"),
                ("difference", "relative"),
                ("depth-scale", "3"),
            ]),
            options(&[("metric", "planes-normals"), ("plane", "tap")]),
            options(&[
                ("metric", "planes-normals"),
                ("plane", "tap"),
                ("difference", "relative"),
                ("depth-scale", "3"),
            ]),
            options(&[
                ("metric", "depth-normals"),
                ("difference", "relative"),
                ("depth-scale", "3"),
            ]),
        ];
        for row in scenes::of_scene(&bench(), scene, "latin4", &sets).unwrap_or_else(|e| panic!("{e}")) {
            println!(
                "{scene} {:?}: {:.1e}, bound {:.1e}",
                row.options, row.largest, row.bound
            );
            assert_eq!(row.beyond, 0, "{row:?}");
            assert!(row.largest > 0.0 && row.largest < BOUND, "{row:?}");
        }
    }
}
