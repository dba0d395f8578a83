//! Messages themselves: what arrives, by which transport, and in which quads.

use super::*;
use straightline_codegen::ir::F16;

const HEARD: &str = "
/// A lane's value, and the values that it receives from the three others.
pub fn heard(value: &Frame<f32>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let [own, beside, below, across] = value.load(pixel).gather();
    Quad::from_xy(own, beside).extend(below).extend(across)
}
";

fn heard(transport: Option<Transport>) -> Compiled {
    let settings = Settings::new().transport(transport);
    compile_text(HEARD, "heard", &settings)
}

/// Values received by the lanes of a quad through derivatives, in plain arithmetic: towards the other lane and back.
fn by_derivatives(lanes: [f32; 4]) -> [[f32; 4]; 4] {
    let [a, b, c, d] = lanes;
    let towards = |own: f32, sign: f32, slope: f32| own + sign * slope;
    let beside = [
        towards(a, 1.0, b - a),
        towards(b, -1.0, b - a),
        towards(c, 1.0, d - c),
        towards(d, -1.0, d - c),
    ];
    let below = [
        towards(a, 1.0, c - a),
        towards(b, 1.0, d - b),
        towards(c, -1.0, c - a),
        towards(d, -1.0, d - b),
    ];
    let across = [
        towards(below[0], 1.0, below[1] - below[0]),
        towards(below[1], -1.0, below[1] - below[0]),
        towards(below[2], 1.0, below[3] - below[2]),
        towards(below[3], -1.0, below[3] - below[2]),
    ];
    std::array::from_fn(|k| [lanes[k], beside[k], below[k], across[k]])
}

/// Pairs that a difference does not carry well; each quad holds the first on the left and the second on the right.
const PAIRS: [(&str, f32, f32); 11] = [
    ("1, 1e-8", 1.0, 1.0e-8),
    ("1e8, 1", 1.0e8, 1.0),
    ("1, 1.5", 1.0, 1.5),
    ("1, 2", 1.0, 2.0),
    ("1, 3", 1.0, 3.0000002),
    ("3e38, -3e38", 3.0e38, -3.0e38),
    ("inf, 1", f32::INFINITY, 1.0),
    ("nan, 1", f32::NAN, 1.0),
    ("1e-40, 1", 1.0e-40, 1.0),
    ("1e-40, 2e-40", 1.0e-40, 2.0e-40),
    ("0.1, 0.7", 0.1, 0.7),
];

fn alike(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// As a device that flushes subnormals gives it.
fn flushed(x: f32) -> f32 {
    if x.is_subnormal() { 0.0 } else { x }
}

#[test]
fn quad_operations_move_bits_and_derivatives_err_as_predicted() {
    let gpu = bench();
    let size = uvec2(2 * PAIRS.len() as u32, 2);
    let row = || PAIRS.iter().flat_map(|(_, a, b)| [*a, *b]);
    let image = Frame::new(size, row().chain(row()).map(Vec4::splat).collect());
    let inputs = Inputs::new(size).with_image("value", image.clone());
    let exact = gpu
        .run(&heard(Some(Transport::Subgroup)), Stage::Fragment, &inputs)
        .expect("it runs");
    let block = gpu
        .run(&heard(Some(Transport::Block)), Stage::Compute, &inputs)
        .expect("it runs");
    let lossy = gpu
        .run(&heard(Some(Transport::Derivatives)), Stage::Fragment, &inputs)
        .expect("it runs");
    let predicted = interpret_kernel::<f32>(&heard(Some(Transport::Derivatives)), &inputs, false).expect("it runs");
    println!("pair | subgroup | derivatives | predicted");
    for (k, (name, a, b)) in PAIRS.iter().enumerate() {
        let arithmetic = by_derivatives([*a, *b, *a, *b]);
        for lane in 0..4 {
            let at = uvec2(2 * k as u32 + lane as u32 % 2, lane as u32 / 2);
            let here = [*a, *b][lane % 2];
            let there = [*b, *a][lane % 2];
            let index = (at.y * size.x + at.x) as usize;
            let expected = [here, there, here, there];
            for image in [&exact, &block] {
                let found = image.load(at.as_ivec2()).to_array();
                // A driver may flush what it reads; what arrives is what the other lane has.
                let moved = found.iter().zip(expected);
                assert!(
                    moved.clone().all(|(f, e)| alike(*f, e)) || moved.clone().all(|(f, e)| alike(*f, flushed(e))),
                    "{name}, lane {lane}: {found:?}"
                );
            }
            let (found, predicted) = (lossy.load(at.as_ivec2()).to_array(), predicted.texels[index]);
            for m in 0..4 {
                assert!(
                    alike(predicted[m], arithmetic[lane][m]),
                    "{name}, lane {lane}, message {m}: the interpreter says {}, arithmetic {}",
                    predicted[m],
                    arithmetic[lane][m]
                );
                assert!(
                    alike(found[m], predicted[m]) || (found[m] - predicted[m]).abs() < f32::MIN_POSITIVE,
                    "{name}, lane {lane}, message {m}: {} arrives, {} is predicted",
                    found[m],
                    predicted[m]
                );
            }
            if lane < 2 {
                println!(
                    "{name}, lane {lane} receives {there:e} | {:e} | {:e} | {:e}",
                    exact.load(at.as_ivec2()).y,
                    found[1],
                    predicted[1]
                );
            }
        }
    }
}

/// In half precision, by the interpreter: 0.3 is lost beside 1000.
#[test]
fn half_precision_loses_more() {
    let size = uvec2(2, 2);
    let image = Frame::new(size, [1000.0, 0.3, 1000.0, 0.3].map(Vec4::splat).to_vec());
    let inputs = Inputs::new(size).with_image("value", image);
    let found = interpret_kernel::<F16>(&heard(Some(Transport::Derivatives)), &inputs, false).expect("it runs");
    let heard_left = half::f16::from_f32(1000.0) + (half::f16::from_f32(0.3) - half::f16::from_f32(1000.0));
    let left = found.frame(&inputs).load(IVec2::ZERO).y;
    assert_eq!(left, heard_left.to_f32());
    assert!((left - 0.3).abs() > 0.1, "the loss shows: {left}");
    let exact = interpret_kernel::<F16>(&heard(None), &inputs, false).expect("it runs");
    assert_eq!(
        exact.frame(&inputs).load(IVec2::ZERO).y,
        half::f16::from_f32(0.3).to_f32()
    );
}

/// Pairs between half and twice of each other arrive whole (Sterbenz); all others lose at most an ULP of the larger.
#[test]
fn the_error_of_a_derivative_is_bounded() {
    let mut random = Random(3);
    for _ in 0..200_000 {
        let scale = (random.unit() * 60.0 - 30.0).exp2();
        let (a, b) = (
            scale * (random.unit() - 0.5),
            (random.unit() - 0.5) * scale * (random.unit() * 20.0 - 10.0).exp2(),
        );
        let heard = a + (b - a);
        let larger = a.abs().max(b.abs());
        let ulp = f32::from_bits(larger.to_bits() + 1) - larger;
        assert!((heard - b).abs() <= ulp, "{a} receives {b} as {heard}");
        if a * b > 0.0 && a.abs() <= 2.0 * b.abs() && b.abs() <= 2.0 * a.abs() {
            assert_eq!(heard, b, "{a} and {b} are near each other");
        }
    }
}

const METHODS: &str = "
/// Sums, means, positions and choices of lanes.
pub fn methods(value: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let own = value.load(pixel);
    let sum = own.truncate().sum();
    let mean = own.w().average();
    let number = (lane_position().x() + lane_position().y() * 2).as_f32();
    let by_table = Quad::new([0.5, 1.5, 2.5, 3.5]);
    let side = quad_vector() * quad_select() - quad_vector();
    let chosen = own.x().lt(own.y()).select(own.x() - mean, own.y().max(mean) * 2.0);
    let mut odd = Quad::splat(0.0);
    for k in 0..4 {
        odd += own.z().gather()[k] * (k as f32 + 1.0);
    }
    let first = number + by_table + side.x() * 10.0 + side.y() * 100.0 + chosen;
    let even = (!own.x().gt(0.5) & own.y().ge(0.25) | own.z().le(0.125)).select(Quad::splat(1.0), Quad::splat(-1.0));
    sum.extend(odd) + Quad::from_xy(first, mean).extend(even).extend(own.swap_vertical().x().min(0.75))
}
";

/// As rustc compiles the text above.
fn methods(value: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> {
    let own = value.load(pixel);
    let sum = own.truncate().sum();
    let mean = own.w().average();
    let number = (lane_position().x() + lane_position().y() * 2).as_f32();
    let by_table = Quad::new([0.5, 1.5, 2.5, 3.5]);
    let side = quad_vector() * quad_select() - quad_vector();
    let chosen = own.x().lt(own.y()).select(own.x() - mean, own.y().max(mean) * 2.0);
    let mut odd = Quad::splat(0.0);
    for k in 0..4 {
        odd += own.z().gather()[k] * (k as f32 + 1.0);
    }
    let first = number + by_table + side.x() * 10.0 + side.y() * 100.0 + chosen;
    let even = (!own.x().gt(0.5) & own.y().ge(0.25) | own.z().le(0.125)).select(Quad::splat(1.0), Quad::splat(-1.0));
    sum.extend(odd)
        + Quad::from_xy(first, mean)
            .extend(even)
            .extend(own.swap_vertical().x().min(0.75))
}

#[test]
fn every_method_means_the_same_natively_and_in_a_shader() {
    let gpu = bench();
    for size in SIZES {
        let image = noise(size, 21);
        let inputs = Inputs::new(size).with_image("value", image.clone());
        let expected = native(size, |pixel| methods(&image, pixel));
        for unroll in FORMS {
            let settings = Settings::new().unroll(unroll);
            let compiled = compile_text(METHODS, "methods", &settings);
            let found = interpret_kernel::<f32>(&compiled, &inputs, false).expect("it runs");
            same_bits(&expected, &found.texels).unwrap_or_else(|e| panic!("{unroll}: {e}"));
            for (transport, stage) in [
                (Transport::Subgroup, Stage::Fragment),
                (Transport::Derivatives, Stage::Fragment),
                (Transport::Block, Stage::Compute),
            ] {
                let settings = Settings::new().unroll(unroll).transport(transport);
                let compiled = compile_text(METHODS, "methods", &settings);
                let shown = gpu.run(&compiled, stage, &inputs).expect("it runs");
                let expected: Vec<[f64; 4]> = expected.iter().map(|t| t.map(f64::from)).collect();
                let off = largest(&texels(&shown), &expected);
                assert!(off < 2.0e-4, "{unroll} by {transport}, {size}: off by {off:.2e}");
            }
        }
    }
}

/// Blocks of a kernel of single pixels: the same pixels, fewer reads.
#[test]
fn blocks_of_pixels_share_their_reads() {
    let gpu = bench();
    let text = "
pub fn box3(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for j in -1..=1 {
        for i in -1..=1 {
            sum += image.load(pixel + ivec2(i, j));
        }
    }
    sum / 9.0
}
";
    for size in SIZES {
        let inputs = Inputs::new(size).with_image("image", noise(size, 5));
        let plain = compile_text(text, "box3", &Settings::default());
        let expected = interpret_kernel::<f32>(&plain, &inputs, false).expect("it runs").texels;
        for (block, reads) in [([2, 1], 12), ([1, 2], 12), ([2, 2], 16), ([4, 2], 24)] {
            let settings = Settings::new().block(block[0], block[1]);
            let compiled = compile_text(text, "box3", &settings);
            assert_eq!(compiled.counts.texture_reads, reads, "{block:?}");
            let found = interpret_kernel::<f32>(&compiled, &inputs, false)
                .expect("it runs")
                .texels;
            same_bits(&expected, &found).unwrap_or_else(|e| panic!("{block:?}: {e}"));
            let shown = gpu.run(&compiled, Stage::Compute, &inputs).expect("it runs");
            let wanted: Vec<[f64; 4]> = expected.iter().map(|t| t.map(f64::from)).collect();
            assert!(largest(&texels(&shown), &wanted) < 1.0e-6, "{block:?} at {size}");
        }
    }
}
