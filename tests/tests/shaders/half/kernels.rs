//! Every built-in kernel and every one of `kernels/filters/` in half precision.

use super::*;
use std::path::Path;
use straightline_bench::execute::test_inputs;

const SIZE: UVec2 = uvec2(96, 64);

/// The distance from 1 to the next number.
const EPSILON: f32 = 1.0 / 1024.0;

struct Case {
    name: &'static str,
    /// Largest difference between shader and interpreter, in epsilons: 0 if all operations are rounded by IEEE 754; more for exponentials,
    /// or for filtered texels, which are rounded when they are read.
    off: f32,
    /// Share of pixels that may be off by more: those on which a decision hangs on the last bit.
    unsure: f64,
    /// Largest difference of 99 % of the pixels from `f64`, in epsilons.
    cost: f32,
}

const fn case(name: &'static str, off: f32, unsure: f64, cost: f32) -> Case {
    Case {
        name,
        off,
        unsure,
        cost,
    }
}

const BUILTINS: [Case; 13] = [
    case("sraa", 0.0, 0.0, 6.0),
    case("sraa_place", 0.0, 0.0, 0.0),
    case("sraa_guide", 0.0, 0.0, 4.0),
    case("sraa_residual", 0.0, 0.0, 2.0),
    case("stalker", 2.0, 0.0, 36.0),
    case("tabula_rasa", 4.0, 0.0, 32.0),
    case("quad_convolution", 2.0, 0.0, 3.0),
    case("quad_upsampling", 0.0, 0.0, 2.0),
    case("downsampling", 0.0, 0.0, 4.0),
    case("quad_bilateral", 0.0, 0.0, 3.0),
    // A mean of three lanes is rounded, and then a place in the shadow map may lie in the next texel.
    case("pcf", 0.0, 0.1, 40.0),
    case("pcss", 2.0, 0.1, 40.0),
    case("quad_ssao", 2.0, 0.0, 10.0),
];

const EXAMPLES: [Case; 10] = [
    case("gaussian", 0.0, 0.0, 4.0),
    case("bilateral", 4.0, 0.0, 6.0),
    case("median", 0.0, 0.0, 1.0),
    case("sobel", 0.0, 0.0, 6.0),
    case("catmull_rom", 0.0, 0.0, 4.0),
    case("kuwahara", 0.0, 0.0, 200.0),
    case("fxaa", 4.0, 0.005, 64.0),
    case("ssao", 0.0, 0.0, 10.0),
    case("joint_bilateral_upsampling", 4.0, 0.0, 12.0),
    case("convolution", 0.0, 0.0, 6.0),
];

fn kernels() -> Vec<(Case, Kernel)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kernels/filters");
    let builtins = BUILTINS.into_iter().map(|case| (Kernel::builtin(case.name), case));
    let examples = EXAMPLES
        .into_iter()
        .map(|case| (Kernel::from_file(&folder.join(format!("{}.rs", case.name)), None), case));
    let all = builtins.chain(examples);
    all.map(|(kernel, case)| (case, kernel.unwrap_or_else(|e| panic!("{e}"))))
        .collect()
}

/// The kernels with their options at their defaults.
pub fn compiled() -> Vec<Compiled> {
    let compile = |kernel: Kernel| kernel.compile(&Settings::default());
    let all = kernels().into_iter().map(|(_, kernel)| compile(kernel));
    all.map(|compiled| compiled.unwrap_or_else(|e| panic!("{e}"))).collect()
}

/// A kernel of the list by its name.
pub fn named(name: &str) -> Kernel {
    let all = kernels().into_iter().map(|(_, kernel)| kernel);
    let mut found = all.filter(|kernel| kernel.name() == name);
    found.next().unwrap_or_else(|| panic!("no kernel is called {name}"))
}

/// Largest difference of 99 % of a kernel's pixels from `f64`, in epsilons, where all is computed in half precision.
pub fn cost(name: &str) -> f32 {
    let cases = BUILTINS.iter().chain(&EXAMPLES);
    let mut costs = cases.filter(|case| case.name == name).map(|case| case.cost);
    costs.next().unwrap_or_else(|| panic!("no kernel is called {name}"))
}

/// Differences between two pictures, in epsilons, pixel by pixel, the smallest first.
pub fn apart(a: &Frame<Vec4>, b: &Frame<Vec4>) -> Vec<f32> {
    let pixel = |(a, b): (&Vec4, &Vec4)| {
        // Of what is larger than 1, in steps as large.
        let off = (*a - *b).abs() / b.abs().max(Vec4::ONE);
        assert!(a.is_finite() && b.is_finite(), "{a} and {b}");
        off.max_element() / EPSILON
    };
    let mut apart: Vec<f32> = a.texels().iter().zip(b.texels()).map(pixel).collect();
    apart.sort_by(f32::total_cmp);
    apart
}

pub fn at(sorted: &[f32], share: f64) -> f32 {
    sorted[((sorted.len() - 1) as f64 * share) as usize]
}

#[test]
fn all_catalogued_kernels_are_tested() {
    // The order of the list of `sraa_extra` depends on the device, and no half holds the sums of a picture.
    let names = straightline_kernels::CATALOGUE.iter().map(|e| e.name);
    let names: Vec<&str> = names
        .filter(|name| !["sraa_extra", "sraa_fit_sums", "sraa_fit_rows", "sraa_fit"].contains(name))
        .collect();
    assert_eq!(names, BUILTINS.map(|case| case.name));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kernels/filters");
    let files = std::fs::read_dir(folder).expect("kernels/filters is there").count();
    assert_eq!(files, EXAMPLES.len());
}

/// On numbers that half precision holds.
#[test]
fn shaders_compute_what_the_interpreter_does() {
    let gpu = half_bench();
    for (case, kernel) in kernels() {
        for unroll in [Unroll::Full, Unroll::None] {
            let settings = Settings::new().unroll(unroll);
            let compiled = kernel.compile(&settings).unwrap_or_else(|e| panic!("{e}"));
            let inputs = held(test_inputs(&compiled.in_blocks().graph, SIZE));
            let [shown, expected] = both(&gpu, &compiled, Stage::Compute, &inputs);
            let apart = apart(&shown, &expected);
            let allowed = match unroll {
                _ if !rounds_exactly(&gpu) => case.off.max(4.0),
                // Exponentials of counters are computed then, not known.
                Unroll::None if case.name == "gaussian" => 2.0,
                _ => case.off,
            };
            let unsure = if rounds_exactly(&gpu) {
                case.unsure
            } else {
                case.unsure.max(0.01)
            };
            let over = apart.iter().filter(|off| **off > allowed).count();
            assert!(
                over as f64 <= unsure * apart.len() as f64,
                "{} {unroll}: {over} pixels are off by more than {allowed} epsilons, the last by {}",
                case.name,
                at(&apart, 1.0)
            );
        }
    }
}

/// On any numbers, against `f64`.
#[test]
fn what_half_precision_costs() {
    let gpu = half_bench();
    println!("off f64, in epsilons of 1/1024: half of the pixels, 99 %, all");
    println!("{:<27} {:>24} {:>24}", "kernel", "interpreter", "shader");
    for (case, kernel) in kernels() {
        let compiled = kernel.compile(&Settings::default()).unwrap_or_else(|e| panic!("{e}"));
        let inputs = test_inputs(&compiled.in_blocks().graph, SIZE);
        let [shown, found] = both(&gpu, &compiled, Stage::Compute, &inputs);
        let exact = interpret_kernel::<f64>(&compiled, &inputs, false)
            .expect("it ran in f16")
            .frame(&inputs);
        let [shown, found] = [&shown, &found].map(|picture| apart(picture, &exact));
        let figures = |a: &[f32]| format!("{:7.2} {:7.2} {:7.2}", at(a, 0.5), at(a, 0.99), at(a, 1.0));
        println!("{:<27} {:>24} {:>24}", case.name, figures(&found), figures(&shown));
        for apart in [shown, found] {
            assert!(at(&apart, 0.99) <= case.cost, "{}: {}", case.name, at(&apart, 0.99));
        }
    }
}
