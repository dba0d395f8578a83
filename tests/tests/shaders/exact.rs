//! A single source, three forms: the native kernel, the looped graph and the unrolled graph agree bit for bit.

use crate::common;

use common::same_bits;
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::ir::print;
use straightline_codegen::{Compiled, Kernel, Math, Settings, Unroll};
use straightline_kernels::prelude::*;
use straightline_tests::sraa::options::{one_at_a_time, options, random, refusal};
use straightline_tests::sraa::{Options, compiled, native, surfaces};

fn form(options: &Options, unroll: Unroll) -> Compiled {
    compiled(options, unroll).unwrap_or_else(|errors| panic!("{options:?}:\n{errors}"))
}

fn bits(compiled: &Compiled, inputs: &Inputs) -> Vec<[f32; 4]> {
    let result = interpret_kernel::<f32>(compiled, inputs, false);
    result.unwrap_or_else(|error| panic!("{error}")).texels
}

fn all_forms_agree(options: &Options, size: UVec2) {
    if let Some(why) = refusal(options) {
        let refused = compiled(options, Unroll::Full);
        assert!(refused.is_err(), "{options:?} is not refused, though {why}");
        return;
    }
    let inputs = surfaces::inputs(options, size, 1);
    let expected = native::run(options, &inputs);
    for unroll in [Unroll::Full, Unroll::None] {
        let found = bits(&form(options, unroll), &inputs);
        same_bits(&expected, &found).unwrap_or_else(|e| panic!("native and unroll {unroll}, {options:?}: {e}"));
    }
}

#[test]
fn each_value_of_each_option_is_the_same_in_every_form() {
    for options in one_at_a_time() {
        all_forms_agree(&options, uvec2(13, 9));
    }
}

#[test]
fn options_together_are_the_same_in_every_form() {
    for options in random(40, 1) {
        all_forms_agree(&options, uvec2(7, 5));
    }
}

#[test]
fn smallest_frames_agree() {
    for size in [uvec2(1, 1), uvec2(1, 5), uvec2(5, 1), uvec2(2, 3)] {
        for layout in ["layers", "superresolution", "multisampled", "split"] {
            all_forms_agree(&options(&[("layout", layout), ("metric", "planes-normals")]), size);
        }
    }
}

#[test]
fn a_number_set_at_run_time_means_the_same() {
    let known = options(&[("tau", "80"), ("depth-scale", "3")]);
    let at_run_time = options(&[("tau", "uniform"), ("depth-scale", "uniform")]);
    let inputs = surfaces::inputs(&known, uvec2(16, 16), 3);
    let compiled = form(&at_run_time, Unroll::Full);
    let given = bits(
        &compiled,
        &inputs
            .clone()
            .with_uniform("tau", &[80.0])
            .with_uniform("depth_scale", &[3.0]),
    );
    same_bits(&native::run(&known, &inputs), &given).unwrap_or_else(|e| panic!("{e}"));
    let defaults = native::run(&Options::new(), &inputs);
    same_bits(&defaults, &bits(&compiled, &inputs)).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn one_block_and_no_more_reads_than_distinct_texels() {
    for options in one_at_a_time() {
        let Ok(compiled) = compiled(&options, Unroll::Full) else {
            continue;
        };
        let blocks = compiled.counts.basic_blocks;
        // These keep a branch, and `fallback`, a search and demodulating the loops behind it.
        let has = |words: &[&str]| options.iter().any(|(_, value)| words.contains(&value.as_str()));
        let loops = has(&["fallback", "five", "seven", "albedo", "albedo-shadow"]);
        assert!(loops || has(&["branch"]) || blocks == 1, "{options:?}: {blocks} blocks");
        assert_eq!(compiled.counts.loops > 0, loops, "{options:?}");
    }
    let counts = |set: &[(&str, &str)]| {
        let counts = form(&options(set), Unroll::Full).counts;
        (counts.tallies["weight_evaluations"], counts.texture_reads)
    };
    let listing = [("metric", "depth-normals"), ("shading", "sample0")];
    let with = |pattern, falloff| counts(&[listing[0], listing[1], ("pattern", pattern), ("falloff", falloff)]);
    // The paper: 25 and 58, 81 and 194 (section 3.5); a sample against itself needs no evaluation.
    assert_eq!(with("ordered4", "none"), (24, 24));
    assert_eq!(with("ordered16", "none"), (80, 48));
    assert_eq!(with("ordered4", "tent"), (8, 14));
    // Two pixels on each axis instead of one.
    let wide = counts(&[
        listing[0],
        listing[1],
        ("pattern", "ordered4"),
        ("falloff", "none"),
        ("radius", "2"),
    ]);
    assert_eq!(wide, (80, 56));
    // Half the reads.
    let packed = counts(&[
        listing[0],
        listing[1],
        ("pattern", "ordered4"),
        ("falloff", "none"),
        ("normals", "packed"),
    ]);
    assert_eq!(packed, (24, 12));
}

/// `fallback` computes what `none` does, and where that is not finite what `inline` does, bit for bit.
#[test]
fn fallback_is_taken_where_a_pixel_is_not_finite() {
    for pattern in ["latin4", "latin16"] {
        let with = |guards| options(&[("guards", guards), ("pattern", pattern)]);
        let size = uvec2(24, 18);
        let mut inputs = surfaces::inputs(&with("none"), size, 11);
        let (_, colors) = inputs
            .images
            .iter_mut()
            .find(|(name, _)| name == "color")
            .expect("colours");
        let mut texels = colors[0].texels().to_vec();
        for (k, bad) in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY].into_iter().enumerate() {
            texels[(5 + 4 * k) * size.x as usize + 4 + 7 * k].z = bad;
        }
        colors[0] = Frame::new(size, texels);
        let of = |guards| bits(&form(&with(guards), Unroll::Full), &inputs);
        let (none, inline, fallback) = (of("none"), of("inline"), of("fallback"));
        let is_finite = |pixel: &[f32; 4]| pixel.iter().all(|lane| lane.is_finite());
        let spoilt = none.iter().filter(|pixel| !is_finite(pixel)).count();
        assert!((3..=3 * 9).contains(&spoilt), "{spoilt} pixels");
        assert!(none != inline, "nothing tells them apart");
        let expected = none.iter().zip(&inline).map(|(light, guarded)| match is_finite(light) {
            true => *light,
            false => *guarded,
        });
        same_bits(&expected.collect::<Vec<_>>(), &fallback).unwrap_or_else(|e| panic!("{pattern}: {e}"));
    }
}

/// The largest difference of what a kernel gives in `f32` to the same without fast mathematics in `f64`.
fn off(fast: &Compiled, exact: &Compiled, inputs: &Inputs) -> f64 {
    let real = interpret_kernel::<f64>(exact, inputs, false).unwrap_or_else(|error| panic!("{error}"));
    let pairs = bits(fast, inputs).into_iter().zip(real.texels);
    let lanes = pairs.flat_map(|(a, b)| a.into_iter().zip(b));
    lanes.map(|(a, b)| (f64::from(a) - b).abs()).fold(0.0, f64::max)
}

/// Fast mathematics is as far from `f64` as exact mathematics, but for some roundings.
#[test]
fn fast_mathematics_changes_roundings_and_no_more() {
    let filter = |name: &str| {
        let path = format!("{}/../kernels/filters/{name}.rs", env!("CARGO_MANIFEST_DIR"));
        Kernel::from_argument(&path).unwrap_or_else(|errors| panic!("{errors}"))
    };
    let sraa = || Kernel::builtin("sraa").unwrap_or_else(|errors| panic!("{errors}"));
    for (name, kernel, set) in [
        ("sraa", sraa(), options(&[])),
        ("sraa 16", sraa(), options(&[("pattern", "latin16")])),
        (
            "sraa planes",
            sraa(),
            options(&[("metric", "planes-normals"), ("difference", "relative")]),
        ),
        ("bilateral", filter("bilateral"), Options::new()),
        ("kuwahara", filter("kuwahara"), Options::new()),
        ("sobel", filter("sobel"), Options::new()),
    ] {
        let with = |math| {
            let settings = Settings::new().set_all(set.clone()).math(math);
            kernel
                .compile(&settings)
                .unwrap_or_else(|errors| panic!("{name}: {errors}"))
        };
        let (exact, fast) = (with(Math::Exact), with(Math::Fast));
        assert_ne!(print(&exact.graph), print(&fast.graph), "{name}: nothing was done");
        let inputs = surfaces::inputs(&set, uvec2(40, 30), 5);
        let (by_exact, by_fast) = (off(&exact, &exact, &inputs), off(&fast, &exact, &inputs));
        assert!(
            by_fast <= 2.0 * by_exact + 1.0e-6,
            "{name}: {by_fast:.1e} where {by_exact:.1e} was"
        );
    }
}

/// A shader reads no buffer and computes no term that its scene does not need.
#[test]
fn a_metric_reads_only_what_it_compares() {
    let bound = |set: &[(&str, &str)]| {
        let compiled = form(&options(set), Unroll::Full);
        let manifest = compiled.emit(&Default::default()).expect("it is emitted").manifest;
        let mut names = Vec::new();
        for binding in manifest.bindings {
            match binding.kind {
                straightline_manifest::BindingKind::Uniform { fields, .. } => {
                    names.extend(fields.into_iter().map(|field| field.name));
                }
                _ => names.push(binding.name),
            }
        }
        names
    };
    assert_eq!(bound(&[("metric", "depth")]), ["depth", "color"]);
    assert_eq!(bound(&[("metric", "normals")]), ["normal", "color"]);
    assert_eq!(bound(&[("metric", "depth-normals")]), ["depth", "normal", "color"]);
    assert_eq!(
        bound(&[("metric", "planes-normals")]),
        [
            "depth",
            "normal",
            "color",
            "ray_corner",
            "ray_right",
            "ray_down",
            "origin"
        ]
    );
    assert_eq!(
        bound(&[("depth", "reversed-infinite")]),
        ["depth", "normal", "color", "near"]
    );
    assert_eq!(
        bound(&[
            ("layout", "multisampled"),
            ("normals", "packed"),
            ("shading", "sample0")
        ]),
        ["packed_samples", "color"]
    );
}

#[test]
fn a_pattern_is_checked() {
    let refused = |offsets: &str, more: &[(&str, &str)]| {
        let mut words = vec![("pattern", "listed"), ("offsets", offsets)];
        words.extend(more);
        compiled(&options(&words), Unroll::Full)
            .err()
            .map(|errors| errors.to_string())
            .unwrap_or_default()
    };
    assert!(refused("0.1,0.2,0.3", &[]).contains("an x and a y for each sample"));
    assert!(refused("", &[]).contains("1 to 64 samples"));
    assert!(refused("0.1,0.2,0.1,0.2", &[]).contains("at the same place"));
    assert!(refused("0.1,0.6", &[]).contains("from -0.5 to 0.5"));
    assert!(refused("-0.3,0.3,-0.3,-0.3", &[("latin", "true")]).contains("no Latin square"));
    assert_eq!(refused("-0.3,0.3,-0.3,-0.3", &[]), "");
    assert_eq!(refused("-0.3,0.3,0.3,-0.3", &[("latin", "true")]), "");
    let shaded = [("shading", "listed"), ("shaded", "0,7")];
    assert!(refused("-0.3,0.3,0.3,-0.3", &shaded).contains("does not have"));
}
