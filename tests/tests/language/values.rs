//! Values of functions and operators where drivers depart from Rust unless the shader keeps them: what the kernel returns
//! natively, in every form by the interpreter, and on lavapipe and SwiftShader in every language that they read.

use straightline_bench::execute::{Bench, Inputs, interpret_kernel};
use straightline_codegen::{EmitOptions, Format, Kernel, Stage};
use straightline_foreign::vulkan::{Device, Driver};
use straightline_kernels::prelude::*;
use straightline_tests::bare::{LANGUAGES, Shader};
use straightline_tests::random::forms::{FORMS, PolicyForm};

/// Most that a driver may be off, of the larger of 1 and the value's size. `exp` and `pow` of large arguments are the least
/// accurate.
const BOUND: f32 = 1.0e-4;

/// A function of one uniform, its text, what rustc makes of it, and what it must return where the uniform is 1.
struct Case {
    name: &'static str,
    function: &'static str,
    native: fn(f32) -> Vec4,
    expected: [f32; 4],
}

macro_rules! cases {
    ($($name:ident($one:ident) $body:block => $expected:expr;)*) => {
        vec![$(Case {
            name: stringify!($name),
            function: concat!("fn ", stringify!($name), "(", stringify!($one), ": f32) -> Vec4 ", stringify!($body), "\n"),
            native: |$one: f32| -> Vec4 { $body },
            expected: $expected,
        }),*]
    };
}

const NAN: f32 = f32::NAN;
const INF: f32 = f32::INFINITY;
const PI: f32 = std::f32::consts::PI;

#[rustfmt::skip]
#[allow(clippy::eq_op, clippy::zero_divided_by_zero, clippy::neg_cmp_op_on_partial_ord, clippy::excessive_precision)]
#[allow(clippy::manual_range_contains, clippy::approx_constant, clippy::nonminimal_bool, clippy::blocks_in_conditions)]
fn cases() -> Vec<Case> {
    cases! {
        powers(one) {
            let x = -0.5 * one;
            let zero = one - 1.0;
            vec4(x.powf(3.0), x.powf(-2.0), zero.powf(0.0), x.powf(1.0))
        } => [-0.125, 4.0, 1.0, -0.5];
        powers_at_run_time(one) {
            let x = -2.0 * one;
            vec4(x.powf(3.0 * one), x.powf(-one), x.powf(2.0 * one), x.powf(0.5 * one))
        } => [-8.0, -0.5, 4.0, NAN];
        powers_of_zero(one) {
            let zero = one - 1.0;
            let below = f32::from_bits(0x8000_0000 * one as u32);
            vec4(zero.powf(one), zero.powf(-one), below.powf(-3.0), zero.powf(zero))
        } => [0.0, INF, -INF, 1.0];
        powers_without_root(one) {
            let nan = f32::from_bits(0x7fc0_0000 * one as u32);
            vec4((-one).powf(0.4545), nan.powf(0.4545), nan.powf(one - 1.0), one.powf(nan))
        } => [NAN, NAN, 1.0, 1.0];
        powers_of_infinity(one) {
            let infinity = f32::from_bits(0x7f80_0000 * one as u32);
            vec4((-infinity).powf(0.5), (-infinity).powf(3.0), (-infinity).powf(-0.5), (-one).powf(infinity))
        } => [INF, -INF, 0.0, 1.0];
        large_powers(one) {
            let x = -1.0625 * one;
            vec4(x.powf(64.0), x.powf(63.0), x.powf(-65.0), x.powf(101.0))
        } => [48.423_042, -45.574_627, -0.019_436_542, -456.270_94];
        powers_of_what_is_positive(one) {
            let infinity = f32::from_bits(0x7f80_0000 * one as u32);
            let zero = one - 1.0;
            vec4(f32::INFINITY.powf(zero), infinity.max(0.25).powf(zero), one.max(0.25).powf(infinity), 2.0f32.powf(-one))
        } => [1.0, 1.0, 1.0, 0.5];
        powers_of_vectors(one) {
            vec4(-2.0, -0.5, 0.0, 3.0).powf(3.0) * one + vec4(-2.0, 0.0, 4.0, -1.0).powf(-one) + Vec4::ONE.powf(0.4545 * one)
        } => [-7.5, INF, 1.25, 27.0];
        powers_of_integers(one) {
            let x = -2.0 * one;
            vec4(x.powi(0), x.powi(-3), (one - 1.0).powi(0), (one - 1.0).powi(-1))
        } => [1.0, -0.125, 1.0, INF];
        roots(one) {
            let nan = f32::from_bits(0x7fc0_0000 * one as u32);
            vec4((-27.0 * one).cbrt(), nan.cbrt(), (1.0 / (one - 1.0)).cbrt(), saturate(-one).powf(-0.5))
        } => [-3.0, NAN, INF, INF];
        angles(one) {
            let zero = one - 1.0;
            vec4(zero.atan2(zero), zero.atan2(-one), (-zero).atan2(one), one.atan2(zero))
        } => [0.0, PI, 0.0, PI / 2.0];
        angles_below_zero(one) {
            let (zero, below) = (one - 1.0, f32::from_bits(0x8000_0000 * one as u32));
            vec4(below.atan2(-one), below.atan2(below), zero.atan2(below), (-one).atan2(below))
        } => [-PI, -PI, PI, -PI / 2.0];
        angles_of_infinities(one) {
            let infinity = f32::from_bits(0x7f80_0000 * one as u32);
            let nan = f32::from_bits(0x7fc0_0000 * one as u32);
            vec4(infinity.atan2(infinity), (-infinity).atan2(-infinity), one.atan2(-infinity), (one - 1.0).atan2(nan))
        } => [PI / 4.0, -3.0 * PI / 4.0, PI, NAN];
        angles_of_vectors(one) {
            let x = vec2(-3.0e38, -3.0e38) * one;
            vec4(x.to_angle(), Vec2::ZERO.to_angle() * one, f32::atan(f32::from_bits(0x7fc0_0000 * one as u32)), (1.0 / (one - 1.0)).atan())
        } => [-3.0 * PI / 4.0, 0.0, NAN, PI / 2.0];
        steps_of_no_width(one) {
            let e = 0.5 * one;
            vec4(
                smoothstep(0.5, 0.5, 0.25 * one), smoothstep(0.5, 0.5, 0.75 * one), smoothstep(0.5, 0.5, e),
                smoothstep(e, e, 0.75 * one),
            )
        } => [0.0, 1.0, 0.0, 1.0];
        steps_backwards(one) {
            let nan = f32::from_bits(0x7fc0_0000 * one as u32);
            let e = vec4(0.5, 0.25, 0.75, 0.5) * one;
            let all = smoothstep(0.5, 0.5, e);
            vec4(smoothstep(one, 0.0, 0.25), smoothstep(0.0, 1.0, nan), all.x + all.y, all.z + step(0.5, nan))
        } => [0.84375, 0.0, 0.0, 2.0];
        division_by_zero(one) {
            let scale = [0.0, 0.0, 4.0][one as usize - 1];
            let x = one / scale;
            vec4(x, -one / 0.0, if x.is_finite() { 0.0 } else { 1.0 }, 0.0)
        } => [INF, -INF, 1.0, 0.0];
        division_of_zero(one) {
            let zero = one - 1.0;
            vec4(zero / 0.0, one / (zero - zero), zero / (one - one), -one / -0.0)
        } => [NAN, INF, NAN, INF];
        division_by_constants(one) {
            let infinity = f32::from_bits(0x7f80_0000 * one as u32);
            vec4(one / f32::INFINITY, infinity / f32::INFINITY, 1.0e-10 * one / 1.0e-40, one / f32::NAN)
        } => [0.0, NAN, 1.000_005_4e30, NAN];
        division_of_vectors(one) {
            Vec4::splat(one) / vec4(0.0, 4.0, -0.0, f32::INFINITY) + (vec3(-1.0, 0.0, 2.0) * one / Vec3::ZERO).extend(0.0)
        } => [NAN, NAN, NAN, 0.0];
        division_of_vectors_by_nothing(one) {
            let edge = vec2(one, 2.0 * one);
            (vec2(3.0, -3.0) * one / (edge - edge)).extend(1.0).extend(one / (one * 0.25 + 0.75))
        } => [INF, -INF, 1.0, 1.0];
        hyperbolic(one) {
            vec4((100.0 * one).tanh(), (-1000.0 * one).tanh(), (90.0 * one).tanh(), (88.8 * one).sinh())
        } => [1.0, -1.0, 1.0, 1.837_897_8e38];
        hyperbolic_at_the_ends(one) {
            let nan = f32::from_bits(0x7fc0_0000 * one as u32);
            vec4((-88.8 * one).cosh(), (-100.0 * one).sinh(), nan.tanh(), (1.0 / (one - 1.0)).tanh())
        } => [1.837_897_8e38, -INF, NAN, 1.0];
        logarithms(one) {
            let nan = f32::from_bits(0x7fc0_0000 * one as u32);
            vec4((one - 1.0).ln(), (-one).ln(), nan.log2(), (1.0 / (one - 1.0)).log2())
        } => [-INF, NAN, NAN, INF];
        logarithms_of_vectors(one) {
            let x = vec4(0.0, -1.0, 8.0, 0.125) * one;
            vec4(x.x.log2(), x.y.log2(), x.z.log2(), x.w.log2())
        } => [-INF, NAN, 3.0, -3.0];
        remainders(one) {
            vec4((1.0e10 * one) % 3.0, (-7.5 * one) % 2.0, (5.0 * one) % f32::INFINITY, one % (one - 1.0))
        } => [1.0, -1.5, 5.0, NAN];
        remainders_of_large_numbers(one) {
            let large = 3.0e38 * one;
            vec4(large % 0.7, large % (-11.0 * one), (-1.0e10 * one).rem_euclid(3.0), (16_777_215.0 * one) % 0.1)
        } => [0.207_808_5, 4.0, 2.0, 0.050_000_02];
        remainders_below_their_multiple(one) {
            let y = vec2(0.1, 0.3) * one;
            let x = vec2(0.7, 0.9) * one;
            let r = x % y;
            vec4(r.x, r.y, (2.999_999_8 * one) % 3.0, (-0.1 * one).div_euclid(1.0 / (one - 1.0)))
        } => [0.099_999_985, 0.299_999_98, 2.999_999_8, -1.0];
        fractions(one) {
            let infinity = f32::from_bits(0x7f80_0000 * one as u32);
            vec4(fract(infinity), fract(-0.25 * one), fract(vec2(infinity, 1.5)).x, fract(vec2(infinity, 1.5) * one).y)
        } => [NAN, 0.75, NAN, 0.5];
        signs(one) {
            let nan = f32::from_bits(0x7fc0_0000 * one as u32);
            vec4(sign(nan), sign(-3.0 * one), saturate(nan), saturate(1.0 / (one - 1.0)))
        } => [0.0, -1.0, 0.0, 1.0];
        unequal(one) {
            let x = f32::from_bits(0x7fc0_0000 * one as u32);
            vec4(
                if x != x { 1.0 } else { 0.0 }, if x == x { 1.0 } else { 0.0 }, if x.is_nan() { 1.0 } else { 0.0 },
                if !(x < 1.0) { 1.0 } else { 0.0 },
            )
        } => [1.0, 0.0, 1.0, 1.0];
        unequal_otherwise(one) {
            let x = f32::from_bits(0x7fc0_0000 * one as u32);
            let v = vec4(x, 1.0, x, 2.0) * one;
            vec4(
                if x != 0.0 && !(x == one) { 1.0 } else { 0.0 }, if v.cmpne(v).any() { 1.0 } else { 0.0 },
                if v.cmpeq(v).all() { 1.0 } else { 0.0 }, if !(x != x) || v == v { 1.0 } else { 0.0 },
            )
        } => [1.0, 1.0, 0.0, 0.0];
        unequal_at_the_end_of_a_loop(one) {
            let mut x = -2.0 * one;
            let mut n = 0;
            while n < 9 {
                x = (x + 1.0).sqrt();
                n += 1;
                if x != x {
                    break;
                }
            }
            vec4(n as f32, one, 0.0, 0.0)
        } => [1.0, 1.0, 0.0, 0.0];
    }
}

/// Returns whether values differ by no more than `bound`; a NaN equals a NaN, and an infinity the same one.
fn close(found: Vec4, expected: Vec4, bound: f32) -> bool {
    found
        .to_array()
        .iter()
        .zip(expected.to_array())
        .all(|(found, expected)| {
            if !expected.is_finite() || !found.is_finite() {
                return (found.is_nan() && expected.is_nan()) || *found == expected;
            }
            (found - expected).abs() <= bound * expected.abs().max(1.0)
        })
}

fn bench(driver: Driver) -> Bench {
    let adapter = driver.adapter().unwrap_or_else(|why| panic!("{why}"));
    let device = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()));
    let (device, queue) = device.unwrap_or_else(|e| panic!("{driver}: {e}"));
    Bench::new(&device, &queue, false)
}

/// A kernel that returns a case's value for each pixel of a row.
fn kernel(cases: &[Case]) -> Kernel {
    let functions: String = cases.iter().map(|case| case.function).collect();
    let arms = cases[1..]
        .iter()
        .enumerate()
        .map(|(k, case)| format!("{} => {}(one), ", k + 1, case.name));
    let source = format!(
        "use straightline_kernels::prelude::*;\n{functions}pub fn k(one: f32, pixel: IVec2) -> Vec4 {{\n    \
         match pixel.x {{ {}_ => {}(one) }}\n}}\n",
        arms.collect::<String>(),
        cases[0].name
    );
    Kernel::from_text("values.rs", &source, "k")
}

fn ones(pixels: usize) -> Inputs {
    Inputs::new(uvec2(pixels as u32, 1)).with_uniform("one", &[1.0])
}

/// Runs a kernel on drivers in each language, and names all pixels that differ from the expected ones.
fn on_drivers(kernel: &Kernel, forms: &[PolicyForm], expected: &[(&str, Vec4)]) {
    let inputs = ones(expected.len());
    let mut wrong = Vec::new();
    for form in forms {
        let compiled = kernel
            .compile(&form.settings())
            .unwrap_or_else(|errors| panic!("{errors}"));
        let options = EmitOptions::new().stage(Stage::Compute).format(Format::Rgba32Float);
        let emitted = compiled.emit(&options.targets(LANGUAGES));
        let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
        let shaders = LANGUAGES.map(|target| Shader::new(&emitted, target).unwrap_or_else(|why| panic!("{why}")));
        for driver in Driver::ALL {
            let picture = bench(driver).run(&compiled, Stage::Compute, &inputs);
            let mut found = vec![("wgsl".to_owned(), picture.unwrap_or_else(|e| panic!("{driver}: {e}")))];
            let device = Device::open(driver).unwrap_or_else(|why| panic!("{why}"));
            for (target, shader) in LANGUAGES.iter().zip(&shaders) {
                let mut pictures = shader
                    .run(&device, &inputs)
                    .unwrap_or_else(|why| panic!("{driver} {target}: {why}"));
                found.push((target.to_string(), pictures.swap_remove(0)));
            }
            for (road, picture) in found {
                for (found, (name, expected)) in picture.texels().iter().zip(expected) {
                    if !close(*found, *expected, BOUND) {
                        wrong.push(format!("{name}, {form}, {driver} {road}: {found}, expected {expected}"));
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn operations_at_their_edges_are_natively_what_is_stated() {
    let mut wrong = Vec::new();
    for case in cases() {
        let native = (case.native)(1.0);
        let expected = Vec4::from_array(case.expected);
        if !close(native, expected, 1.0e-6) {
            wrong.push(format!("{}: {native}, expected {expected}", case.name));
        }
        let name = case.name;
        let kernel = kernel(&[case]);
        for form in FORMS {
            let compiled = kernel
                .compile(&form.settings())
                .unwrap_or_else(|errors| panic!("{errors}"));
            let found = interpret_kernel::<f32>(&compiled, &ones(1), false).unwrap_or_else(|e| panic!("{name}: {e}"));
            let found = found.frame(&ones(1)).texels()[0];
            let same = |(a, b): (&f32, f32)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
            if !found.to_array().iter().zip(native.to_array()).all(same) {
                wrong.push(format!("{name}, {form}: {found}, natively {native}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn operations_at_their_edges_are_kept_on_every_road() {
    for cases in cases().chunks(9) {
        let expected: Vec<_> = cases
            .iter()
            .map(|case| (case.name, Vec4::from_array(case.expected)))
            .collect();
        on_drivers(&kernel(cases), &FORMS[..1], &expected);
    }
}

/// Powers of integers by a loop's counter, from 0 on and below: what a series of octaves is.
#[test]
fn powers_by_a_loops_counter() {
    let series = "use straightline_kernels::prelude::*;
pub fn k(one: f32, pixel: IVec2) -> Vec4 {
    let x = 0.5 * one;
    let (mut sum, mut octaves) = (0.0, 0.0);
    for k in 0..4 {
        sum += x.powi(k) * (k + 1) as f32;
        octaves += one * 0.5f32.powi(k);
    }
    vec4(sum, octaves, x.powi(-2), one * 2.0f32.powi(-3))
}";
    let kernel = Kernel::from_text("series.rs", series, "k");
    on_drivers(&kernel, &FORMS[..2], &[("series", vec4(3.25, 1.875, 4.0, 0.125))]);
}
