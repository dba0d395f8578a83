//! Histograms of luminance, and what comes of them: bins counted by edges, and the mean of what lies in them.

use crate::common::{bench, forms::pixels};
use crate::gallery::shaders::{average_luminance, global_histogram, luminance_histogram};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::{Compiled, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;

/// Logarithms of luminance from here on, and how many of them.
const LEAST: f32 = -8.0;
const RANGE: f32 = 9.5;
const SIZE: UVec2 = uvec2(93, 61);

/// A picture from dark to bright, with some that is too dark.
fn color() -> Frame<Vec4> {
    let texel = |at: IVec2| {
        let place = at.as_vec2() / SIZE.as_vec2();
        let light = (place.x * 11.0 - 9.0 + (place.y * 7.0).sin()).exp2();
        (vec3(1.0, 0.8, 0.5 + 0.5 * place.y) * light).extend(1.0)
    };
    Frame::new(SIZE, pixels(SIZE).map(texel).collect())
}

/// Number of pixels with a logarithm of luminance between the edges of each bin, which lie 1/254 of the range apart.
fn counted(color: &Frame<Vec4>) -> Vec<i64> {
    let mut luminances: Vec<f64> = color
        .texels()
        .iter()
        .map(|t| 0.2127 * f64::from(t.x) + 0.7152 * f64::from(t.y) + 0.0722 * f64::from(t.z))
        .collect();
    luminances.sort_by(f64::total_cmp);
    let below = |edge: f64| luminances.partition_point(|l| *l < edge) as i64;
    let edge = |k: usize| match k {
        0 => 0.0,
        1 => 0.005,
        // Of the largest one alone.
        255 => (f64::from(LEAST) + f64::from(RANGE)).exp2(),
        256 => f64::INFINITY,
        k => (f64::from(LEAST) + f64::from(RANGE) * (k - 1) as f64 / 254.0)
            .exp2()
            .max(0.005),
    };
    (0..256).map(|k| below(edge(k + 1)) - below(edge(k))).collect()
}

fn compiled(name: &str, unroll: Unroll) -> Compiled {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../examples/gallery/{name}.rs"));
    let settings = Settings::new().unroll(unroll);
    let kernel = Kernel::from_file(&path, None).unwrap_or_else(|e| panic!("{e}"));
    kernel.compile(&settings).unwrap_or_else(|e| panic!("{e}"))
}

fn histogram_inputs() -> Inputs {
    Inputs::new(SIZE)
        .with_image("color", color())
        .with_buffer("bins", vec![[0.0; 4]; 256])
        .with_uniform("least", &[LEAST.into()])
        .with_uniform("inverse_range", &[(1.0 / RANGE).into()])
}

/// Pixels by which two histograms differ.
fn moved(a: &[i64], b: &[i64]) -> i64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<i64>() / 2
}

/// Counted in memory of workgroups or in one buffer, natively, interpreted and on a GPU: all agree, with the definition but for
/// pixels on an edge.
#[test]
fn histograms_agree() {
    let color = color();
    let wanted = counted(&color);
    assert!(wanted.iter().filter(|n| **n > 0).count() > 200, "{wanted:?}");
    assert!(wanted[0] > 100, "{wanted:?}");
    let native = AtomicBuffer::new(vec![0; 256]);
    for group in Workgroup::all(SIZE) {
        let counts = AtomicShared::new();
        luminance_histogram::luminance_histogram(&color, LEAST, 1.0 / RANGE, &counts, &native, &group);
    }
    let all = AtomicBuffer::new(vec![0; 256]);
    for at in pixels(SIZE) {
        global_histogram::global_histogram(&color, LEAST, 1.0 / RANGE, &all, at);
    }
    assert_eq!(native.elements(), all.elements());
    let native: Vec<i64> = native.elements().into_iter().map(i64::from).collect();
    assert_eq!(native.iter().sum::<i64>(), i64::from(SIZE.element_product()));
    let off = moved(&native, &wanted);
    println!(
        "{off} of {} pixels are in another bin than by definition",
        SIZE.element_product()
    );
    assert!(off <= 10, "{off} pixels are in another bin");
    let bench = bench();
    for name in ["luminance_histogram", "global_histogram"] {
        for unroll in [Unroll::Full, Unroll::None] {
            let compiled = compiled(name, unroll);
            let found =
                interpret_kernel::<f32>(&compiled, &histogram_inputs(), false).unwrap_or_else(|e| panic!("{e}"));
            let bins = |buffers: &[(String, Vec<[f64; 4]>)]| -> Vec<i64> {
                buffers[0].1.iter().map(|element| element[0] as i64).collect()
            };
            assert_eq!(bins(&found.buffers), native, "{name}");
            let (_, found) = bench
                .all_written(&compiled, Stage::Compute, &histogram_inputs())
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            // A GPU's logarithm may lie on the other side of an edge.
            let off = moved(&bins(&found), &native);
            assert!(off <= 10, "{name}: {off} pixels are in another bin");
        }
    }
}

#[test]
fn average_luminance() {
    let bins: Vec<u32> = counted(&color()).into_iter().map(|n| n as u32).collect();
    let (last, share) = (0.3, 0.25);
    let pixels: u32 = bins.iter().sum();
    let lit: f64 = bins[1..].iter().map(|n| f64::from(*n)).sum();
    let mean = bins
        .iter()
        .enumerate()
        .skip(1)
        .map(|(k, n)| (k as f64 - 1.0) * f64::from(*n))
        .sum::<f64>()
        / lit;
    let now = (mean / 254.0 * f64::from(RANGE) + f64::from(LEAST)).exp2();
    let wanted = f64::from(last) * f64::from(1.0 - share) + now * f64::from(share);
    let group = Workgroup::new(ivec2(0, 0), uvec2(1, 1));
    let buffer = Buffer::new(bins.clone());
    let native = average_luminance::average_luminance(
        &buffer,
        LEAST,
        RANGE,
        pixels as f32,
        last,
        share,
        &Shared::new(),
        &group,
    );
    let native = native.values()[0];
    assert!(
        (f64::from(native) - wanted).abs() < 1.0e-5 * wanted,
        "{native} for {wanted}"
    );
    let inputs = Inputs::new(uvec2(1, 1))
        .with_buffer("bins", bins.iter().map(|n| [f64::from(*n), 0.0, 0.0, 0.0]).collect())
        .with_uniform("least", &[LEAST.into()])
        .with_uniform("range", &[RANGE.into()])
        .with_uniform("pixels", &[f64::from(pixels)])
        .with_uniform("last", &[last.into()])
        .with_uniform("share", &[share.into()]);
    let bench = bench();
    for unroll in [Unroll::Full, Unroll::None] {
        let compiled = compiled("average_luminance", unroll);
        let found = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(found.targets[0].texels[0][0] as f32, native);
        let (targets, _) = bench
            .all_written(&compiled, Stage::Compute, &inputs)
            .unwrap_or_else(|e| panic!("{e}"));
        let shown = targets[0].texels[0][0];
        assert!((shown - wanted).abs() < 1.0e-4 * wanted, "{shown} for {wanted}");
    }
}
