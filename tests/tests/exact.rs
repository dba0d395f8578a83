//! One source, three forms: the native kernel, the looped graph and the unrolled graph agree bit for bit.

mod common;

use common::*;
use straightline_codegen::Unroll;
use straightline_kernels::prelude::*;
use straightline_kernels::sraa::{Sraa, sraa};

fn native(cfg: &Sraa, inputs: &Inputs) -> Vec<[f32; 4]> {
    let size = inputs.size.as_ivec2();
    let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| ivec2(x, y)));
    pixels
        .map(|pixel| sraa(cfg, &inputs.gbuffer, &inputs.color, pixel).to_array())
        .collect()
}

#[test]
fn native_looped_and_unrolled_agree_for_all_options() {
    let inputs = surfaces(uvec2(23, 17), 17, 1);
    for (cfg, options) in all_options() {
        let expected = native(&cfg, &inputs);
        let unrolled = interpret(&compile(&options, Unroll::Full), &inputs, &[]);
        same_bits(&expected, &unrolled).unwrap_or_else(|e| panic!("native and unrolled, {options:?}: {e}"));
        let looped = interpret(&compile(&options, Unroll::None), &inputs, &[]);
        same_bits(&expected, &looped).unwrap_or_else(|e| panic!("native and looped, {options:?}: {e}"));
    }
}

#[test]
fn smallest_frames_agree() {
    for size in [uvec2(1, 1), uvec2(1, 5), uvec2(5, 1), uvec2(2, 3)] {
        let inputs = surfaces(size, 5, 7);
        let expected = native(&Sraa::default(), &inputs);
        let unrolled = interpret(&compile(&[], Unroll::Full), &inputs, &[]);
        same_bits(&expected, &unrolled).unwrap_or_else(|e| panic!("{size}: {e}"));
    }
}

#[test]
fn a_number_set_at_run_time_means_the_same() {
    let inputs = surfaces(uvec2(16, 16), 5, 3);
    let cfg = Sraa {
        tau: 80.0,
        depth_scale: 3.0,
        ..Sraa::default()
    };
    let options = [("tau", "uniform"), ("depth-scale", "uniform")].map(|(k, v)| (k.to_owned(), v.to_owned()));
    let compiled = compile(&options, Unroll::Full);
    let given = interpret(&compiled, &inputs, &[("tau", 80.0), ("depth_scale", 3.0)]);
    same_bits(&native(&cfg, &inputs), &given).unwrap_or_else(|e| panic!("{e}"));
    let defaults = interpret(&compiled, &inputs, &[]);
    same_bits(&native(&Sraa::default(), &inputs), &defaults).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn one_block_and_no_more_reads_than_distinct_texels() {
    for (_, options) in all_options() {
        let counts = compile(&options, Unroll::Full).counts;
        assert_eq!((counts.basic_blocks, counts.loops), (1, 0), "{options:?}");
    }
    let counts = |set: &[(&str, &str)]| {
        let options: Vec<_> = set.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect();
        let counts = compile(&options, Unroll::Full).counts;
        (counts.tallies["weight_evaluations"], counts.texture_reads)
    };
    let listing = [("metric", "depth-normals"), ("falloff", "none"), ("shading", "sample0")];
    let with = |pattern, falloff| counts(&[listing[0], listing[2], ("pattern", pattern), ("falloff", falloff)]);
    // The paper: 25 and 58, 81 and 194 (section 3.5); a sample against itself needs no evaluation.
    assert_eq!(with("ordered4", "none"), (24, 24));
    assert_eq!(with("ordered16", "none"), (80, 48));
    assert_eq!(with("ordered4", "tent"), (8, 14));
    let depth_only = compile(&[("metric".to_owned(), "depth".to_owned())], Unroll::Full).counts;
    assert!(
        !depth_only.reads.contains_key("normal"),
        "normals are read for depth alone: {:?}",
        depth_only.reads
    );
}
