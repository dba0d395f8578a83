//! The kernels of `kernels/filters/`: as rustc compiles them, in every form by the interpreter, and on a GPU.
//! `STRAIGHTLINE_PICTURES=DIR` writes what they make.

// As a graphics programmer's crate would hold them.
#![allow(clippy::needless_range_loop)]

#[path = "../../../kernels/filters/bilateral.rs"]
mod bilateral;
#[path = "../../../kernels/filters/catmull_rom.rs"]
mod catmull_rom;
use crate::common;
#[path = "../../../kernels/filters/convolution.rs"]
mod convolution;
#[path = "../../../kernels/filters/fxaa.rs"]
mod fxaa;
#[allow(dead_code)] // one of its two passes is used
#[path = "../../../kernels/filters/gaussian.rs"]
mod gaussian;
#[path = "../../../kernels/filters/joint_bilateral_upsampling.rs"]
mod joint_bilateral_upsampling;
#[path = "../../../kernels/filters/kuwahara.rs"]
mod kuwahara;
#[path = "../../../kernels/filters/median.rs"]
mod median;
#[path = "../../../kernels/filters/sobel.rs"]
mod sobel;
#[path = "../../../kernels/filters/ssao.rs"]
mod ssao;

use common::forms::{Example, first, image, save, texture};
use straightline_bench::execute::{Inputs, test_inputs};
use straightline_codegen::Settings;
use straightline_kernels::prelude::*;

const SIZE: UVec2 = uvec2(96, 64);

fn inputs(example: &Example) -> Inputs {
    test_inputs(&example.compile(&Settings::default()).graph, SIZE)
}

/// Runs one kernel in every form. `native` is given the inputs and a pixel.
fn check(name: &'static str, tolerance: f32, unsure: f64, native: impl Fn(&Inputs, IVec2) -> Vec4) {
    let example = Example::new("kernels/filters", name);
    let inputs = inputs(&example);
    let shown = example.check(&inputs, tolerance, unsure, |at| native(&inputs, at));
    save(name, &inputs, &shown);
}

#[test]
fn gaussian() {
    let cfg = gaussian::Gaussian::default();
    check("gaussian", 1.0e-5, 0.0, |inputs, at| {
        gaussian::gaussian(&cfg, image(inputs, "color"), at)
    });
}

#[test]
fn bilateral() {
    let cfg = bilateral::Bilateral::default();
    check("bilateral", 1.0e-4, 0.0, |inputs, at| {
        bilateral::bilateral(&cfg, image(inputs, "color"), at)
    });
}

#[test]
fn median() {
    check("median", 0.0, 0.0, |inputs, at| {
        median::median(image(inputs, "color"), at)
    });
}

/// The network against sorting, on every component.
#[test]
fn the_network_finds_the_median() {
    let inputs = inputs(&Example::new("kernels/filters", "median"));
    let color = image(&inputs, "color");
    for at in [ivec2(0, 0), ivec2(40, 30), ivec2(95, 63)] {
        let found = median::median(color, at);
        for lane in 0..4 {
            let taps = (0..9).map(|k| color.load(at + ivec2(k % 3 - 1, k / 3 - 1))[lane]);
            let mut sorted: Vec<f32> = taps.collect();
            sorted.sort_by(f32::total_cmp);
            assert_eq!(found[lane], sorted[4], "at {at}");
        }
    }
}

#[test]
fn sobel() {
    check("sobel", 1.0e-4, 0.0, |inputs, at| {
        sobel::sobel(image(inputs, "color"), at)
    });
}

#[test]
fn catmull_rom() {
    let cache = std::cell::OnceCell::new();
    check("catmull_rom", 1.0e-4, 0.0, |inputs, at| {
        let image = cache.get_or_init(|| texture(inputs, "image"));
        catmull_rom::catmull_rom(image, SIZE, at)
    });
}

#[test]
fn kuwahara() {
    let cfg = kuwahara::Kuwahara::default();
    // The last bit decides between two quarters that vary alike.
    check("kuwahara", 5.0e-3, 0.01, |inputs, at| {
        kuwahara::kuwahara(&cfg, image(inputs, "color"), at)
    });
}

#[test]
fn fxaa() {
    let cfg = fxaa::Fxaa::default();
    // The end of a search hangs on filtered texels, which a GPU weighs in steps of 1/256.
    check("fxaa", 5.0e-3, 0.01, |inputs, at| {
        fxaa::fxaa(&cfg, image(inputs, "color"), &Sampler::default(), at)
    });
}

#[test]
fn ssao() {
    let cfg = ssao::Ssao::default();
    let cache = std::cell::OnceCell::new();
    // A point that falls between two pixels, or just behind a surface, may count for one or the other.
    check("ssao", 5.0e-3, 0.01, |inputs, at| {
        let (depth, normal) = cache.get_or_init(|| {
            let normals = image(inputs, "normal").texels().iter().map(|n| n.truncate()).collect();
            (first(inputs, "depth", Frame::new), Frame::new(SIZE, normals))
        });
        ssao::ssao(&cfg, depth, normal, at)
    });
}

/// A surface that faces up sees what is above it in the picture, where rows are fewer.
#[test]
fn ssao_looks_where_the_normal_points() {
    let cfg = ssao::Ssao {
        radius: 1.0,
        bias: 0.05,
        focal: 100.0,
    };
    let middle = SIZE.as_ivec2() / 2;
    let open_with = |normal: Vec3, is_near: &dyn Fn(IVec2) -> bool| {
        let pixels = (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| ivec2(x, y)));
        let depths = pixels.map(|at| if is_near(at - middle) { 9.0 } else { 10.0 }).collect();
        let normals = vec![normal; (SIZE.x * SIZE.y) as usize];
        ssao::ssao(&cfg, &Frame::new(SIZE, depths), &Frame::new(SIZE, normals), middle).x
    };
    let (up, right) = (vec3(0.0, 0.6, 0.8), vec3(0.6, 0.0, 0.8));
    let (above, below) = (|at: IVec2| at.y < 0, |at: IVec2| at.y > 0);
    assert!(open_with(up, &above) < open_with(up, &below) - 0.1);
    let (left_of, right_of) = (|at: IVec2| at.x < 0, |at: IVec2| at.x > 0);
    assert!(open_with(right, &right_of) < open_with(right, &left_of) - 0.1);
}

#[test]
fn joint_bilateral_upsampling() {
    let cfg = joint_bilateral_upsampling::Upsampling::default();
    let cache = std::cell::OnceCell::new();
    check("joint_bilateral_upsampling", 1.0e-3, 0.0, |inputs, at| {
        let (low, low_depth, depth) = cache.get_or_init(|| {
            (
                texture(inputs, "low"),
                first(inputs, "low_depth", Texture::new),
                first(inputs, "depth", Frame::new),
            )
        });
        joint_bilateral_upsampling::joint_bilateral_upsampling(&cfg, low, low_depth, depth, at)
    });
}

#[test]
fn convolution() {
    let cfg = convolution::Convolution::default();
    check("convolution", 1.0e-5, 0.0, |inputs, at| {
        convolution::convolution(&cfg, image(inputs, "color"), at)
    });
}

/// A weight of zero is not in the shader: neither its product nor its read.
#[test]
fn zero_weights_cost_nothing() {
    let example = Example::new("kernels/filters", "convolution");
    let reads = |weights: &str| {
        let settings = Settings::new().set("weights", weights);
        example.compile(&settings).counts.colour_reads
    };
    let cross = "0,0,0,0,0, 0,0,1,0,0, 0,1,-4,1,0, 0,0,1,0,0, 0,0,0,0,0";
    assert_eq!(reads(cross), 5);
    let dense = ["0.04"; 25].join(",");
    assert_eq!(reads(&dense), 25);
}
