//! Loops over ranges of every kind, in every form: the sequence of counters is Rust's own, in the interpreter and, for a
//! sample, on a driver.

use crate::common;

use common::bench;
use glam::{Vec4, uvec2};
use std::fmt::Write;
use straightline_bench::execute::Inputs;
use straightline_codegen::interp::{Bindings, Image, Interpreter};
use straightline_codegen::{Compiled, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::Frame;

const FORMS: [Unroll; 4] = [Unroll::Full, Unroll::None, Unroll::Partial(2), Unroll::Partial(3)];

/// The adapters that a range is walked through.
const ADAPTERS: [&str; 7] = [
    "",
    ".rev()",
    ".step_by(3)",
    ".rev().step_by(3)",
    ".step_by(3).rev()",
    ".step_by(1_000_000_000)",
    ".rev().step_by(1_000_000_000)",
];

/// Counters that a native loop gives, more of them than a test needs cut off.
const LONGEST: usize = 300;

/// Result of a kernel for the counters, natively.
fn told(counters: &[u32]) -> [f32; 4] {
    let hash = counters
        .iter()
        .fold(1u32, |h, i| (h ^ i).wrapping_mul(16_777_619).wrapping_add(h >> 15));
    [(hash & 0xffff) as f32, (hash >> 16) as f32, counters.len() as f32, 0.0]
}

/// The counters of a range of a type, walked through an adapter; `None` if there are too many.
macro_rules! native {
    ($name:ident, $ty:ty) => {
        fn $name(a: i64, b: i64, inclusive: bool, adapter: &str) -> Option<Vec<u32>> {
            let (a, b) = (a as $ty, b as $ty);
            let counters: Box<dyn Iterator<Item = $ty>> = match (adapter, inclusive) {
                ("", false) => Box::new(a..b),
                ("", true) => Box::new(a..=b),
                (".rev()", false) => Box::new((a..b).rev()),
                (".rev()", true) => Box::new((a..=b).rev()),
                (".step_by(3)", false) => Box::new((a..b).step_by(3)),
                (".step_by(3)", true) => Box::new((a..=b).step_by(3)),
                (".rev().step_by(3)", false) => Box::new((a..b).rev().step_by(3)),
                (".rev().step_by(3)", true) => Box::new((a..=b).rev().step_by(3)),
                // Reversing what is stepped needs a length that a range of these types does not tell.
                (".step_by(3).rev()", _) => {
                    let mut forward = $name(a as i64, b as i64, inclusive, ".step_by(3)")?;
                    forward.reverse();
                    return Some(forward);
                }
                (".step_by(1_000_000_000)", false) => Box::new((a..b).step_by(1_000_000_000)),
                (".step_by(1_000_000_000)", true) => Box::new((a..=b).step_by(1_000_000_000)),
                (_, false) => Box::new((a..b).rev().step_by(1_000_000_000)),
                (_, true) => Box::new((a..=b).rev().step_by(1_000_000_000)),
            };
            let counters: Vec<u32> = counters.take(LONGEST + 1).map(|i| i as u32).collect();
            (counters.len() <= LONGEST).then_some(counters)
        }
    };
}

native!(native_i32, i32);
native!(native_u32, u32);
native!(native_usize, usize);

fn native(ty: &str, a: i64, b: i64, inclusive: bool, adapter: &str) -> Option<Vec<u32>> {
    match ty {
        "i32" => native_i32(a, b, inclusive, adapter),
        "u32" => native_u32(a, b, inclusive, adapter),
        _ => native_usize(a, b, inclusive, adapter),
    }
}

/// Ends of ranges of a type.
fn ends(ty: &str) -> Vec<(i64, i64)> {
    let (least, most) = match ty {
        "i32" => (i64::from(i32::MIN), i64::from(i32::MAX)),
        "u32" => (0, i64::from(u32::MAX)),
        _ => (0, 1000),
    };
    let mut all = vec![
        (0, 8),
        (0, 7),
        (0, 0),
        (5, 3),
        (1, 0),
        (0, 1),
        (2, 9),
        (3, 3),
        (40, 100),
    ];
    if ty != "usize" {
        all.extend([
            (most - 4, most),
            (most - 1, most),
            (most, most),
            (least, least),
            (least, least + 4),
            (least, most),
            (most, least),
            (most, 0),
            (0x7fff_fff0, 0x7fff_ffff),
        ]);
    }
    match ty {
        "i32" => all.extend([(-5, 5), (-3, -1), (1, least), (2, least + 1), (-1, most), (least, -2)]),
        "u32" => all.extend([(0x7fff_fffe, 0x8000_0003), (0x8000_0000, 0x8000_0007), (7, most)]),
        _ => {}
    }
    all
}

fn kernel(params: &str, lets: &str, range: &str) -> String {
    let mut text = String::new();
    let _ = write!(
        text,
        "pub fn k(color: &Frame<Vec4>{params}, pixel: IVec2) -> Vec4 {{
    let zero = color.load(pixel).x * 0.0;
{lets}    let mut h = 1u32;
    let mut n = 0.0;
    for i in {range} {{
        h = (h ^ (i as u32)).wrapping_mul(16777619).wrapping_add(h >> 15u32);
        n += 1.0;
    }}
    vec4((h & 0xffffu32) as f32 + zero, (h >> 16u32) as f32, n, 0.0)
}}
"
    );
    text
}

fn compile(text: &str, unroll: Unroll) -> Compiled {
    let settings = Settings::new().unroll(unroll);
    Kernel::from_text("range.rs", text, "k")
        .compile(&settings)
        .unwrap_or_else(|errors| panic!("{unroll}:\n{text}\n{errors}"))
}

fn run(compiled: &Compiled, uniforms: &[(&str, i64)]) -> [f32; 4] {
    let image = Image::new([1, 1], vec![vec![[0.0; 4]]]).expect("one texel");
    let lanes: Vec<(&str, [f64; 1])> = uniforms.iter().map(|(name, value)| (*name, [*value as f64])).collect();
    let mut bindings = Bindings::new().texture("color", &image);
    for (name, lanes) in &lanes {
        bindings = bindings.uniform(name, lanes);
    }
    let interpreter = Interpreter::new(&compiled.graph, &compiled.schedule, [1, 1], &bindings).expect("all is bound");
    interpreter.run_pixel(0, 0, &mut interpreter.new_scratch())
}

/// A literal of a type.
fn literal(ty: &str, n: i64) -> String {
    match (ty, n) {
        ("i32", n) if n == i64::from(i32::MIN) => "i32::MIN".to_owned(),
        (_, n) if n < 0 => format!("({n}{ty})"),
        _ => format!("{n}{ty}"),
    }
}

#[test]
fn known_ranges_have_the_counters_of_rust() {
    let mut compared = 0;
    for ty in ["i32", "u32", "usize"] {
        for (a, b) in ends(ty) {
            for inclusive in [false, true] {
                for adapter in ADAPTERS {
                    let Some(counters) = native(ty, a, b, inclusive, adapter) else {
                        continue;
                    };
                    let dots = if inclusive { "..=" } else { ".." };
                    let range = format!("({}{dots}{}){adapter}", literal(ty, a), literal(ty, b));
                    let text = kernel("", "", &range);
                    for unroll in FORMS {
                        let found = run(&compile(&text, unroll), &[]);
                        assert_eq!(found, told(&counters), "{range} {unroll}: {counters:?}");
                        compared += 1;
                    }
                }
            }
        }
    }
    assert!(compared > 1500, "{compared}");
}

/// Ranges of which one end or both are runtime values: the parameters `a` and `b`.
fn runtime_ranges() -> Vec<(&'static str, bool, &'static str, String, Vec<&'static str>)> {
    let mut all = Vec::new();
    for ty in ["i32", "u32", "usize"] {
        for inclusive in [false, true] {
            for adapter in ADAPTERS {
                let dots = if inclusive { "..=" } else { ".." };
                let cast = if ty == "usize" { " as usize" } else { "" };
                for (start, params) in [(format!("a{cast}"), vec!["a", "b"]), (format!("0{ty}"), vec!["b"])] {
                    let range = format!("({start}{dots}b{cast}){adapter}");
                    all.push((ty, inclusive, adapter, range, params));
                }
            }
        }
    }
    all
}

fn text_of(ty: &str, range: &str, params: &[&str]) -> String {
    let ty = if ty == "usize" { "i32" } else { ty };
    let params: String = params.iter().map(|name| format!(", {name}: {ty}")).collect();
    kernel(&params, "", range)
}

#[test]
fn runtime_ranges_have_the_counters_of_rust() {
    let mut compared = 0;
    for (ty, inclusive, adapter, range, params) in runtime_ranges() {
        let text = text_of(ty, &range, &params);
        for unroll in FORMS {
            let compiled = compile(&text, unroll);
            for (a, b) in ends(ty) {
                let a = if params.len() == 2 { a } else { 0 };
                let Some(counters) = native(ty, a, b, inclusive, adapter) else {
                    continue;
                };
                let found = run(&compiled, &[("a", a), ("b", b)][2 - params.len()..]);
                assert_eq!(
                    found,
                    told(&counters),
                    "{range} {unroll}, a = {a}, b = {b}: {counters:?}\n{text}"
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 3000, "{compared}");
}

#[test]
fn runtime_ranges_have_the_counters_of_rust_on_a_gpu() {
    let bench = bench();
    for (k, (ty, inclusive, adapter, range, params)) in runtime_ranges().into_iter().enumerate() {
        let text = text_of(ty, &range, &params);
        let unroll = [Unroll::None, Unroll::Partial(2)][k % 2];
        let compiled = compile(&text, unroll);
        for (a, b) in ends(ty).into_iter().skip(k % 3).step_by(3) {
            let a = if params.len() == 2 { a } else { 0 };
            let Some(counters) = native(ty, a, b, inclusive, adapter) else {
                continue;
            };
            let mut inputs = Inputs::new(uvec2(1, 1));
            inputs.images = vec![("color".to_owned(), vec![Frame::new(uvec2(1, 1), vec![Vec4::ZERO])])];
            let uniforms = [("a", a), ("b", b)];
            let uniforms = uniforms[2 - params.len()..].iter();
            inputs.uniforms = uniforms
                .map(|(name, value)| ((*name).to_owned(), vec![*value as f64]))
                .collect();
            let found = bench.run(&compiled, Stage::Compute, &inputs);
            let found = found.unwrap_or_else(|e| panic!("{range} {unroll}: {e}"));
            assert_eq!(
                found.texels()[0].to_array(),
                told(&counters),
                "{range} {unroll}, a = {a}, b = {b}"
            );
        }
    }
}

/// Literals at the ends of a type, as shading languages read them.
#[test]
fn known_ranges_at_the_ends_of_a_type_run_on_a_gpu() {
    let bench = bench();
    for (ty, a, b, inclusive, adapter) in [
        ("i32", i64::from(i32::MIN), i64::from(i32::MIN) + 4, false, ""),
        ("i32", i64::from(i32::MAX) - 4, i64::from(i32::MAX), true, ""),
        (
            "i32",
            i64::from(i32::MIN),
            i64::from(i32::MAX),
            true,
            ".step_by(1_000_000_000)",
        ),
        ("u32", i64::from(u32::MAX) - 4, i64::from(u32::MAX), true, ""),
        ("u32", 0x7fff_fffe, 0x8000_0003, false, ""),
        ("u32", 0, i64::from(u32::MAX), true, ".rev().step_by(1_000_000_000)"),
    ] {
        let counters = native(ty, a, b, inclusive, adapter).expect("few");
        let dots = if inclusive { "..=" } else { ".." };
        let range = format!("({}{dots}{}){adapter}", literal(ty, a), literal(ty, b));
        for unroll in FORMS {
            let mut inputs = Inputs::new(uvec2(1, 1));
            inputs.images = vec![("color".to_owned(), vec![Frame::new(uvec2(1, 1), vec![Vec4::ZERO])])];
            let found = bench.run(&compile(&kernel("", "", &range), unroll), Stage::Compute, &inputs);
            let found = found.unwrap_or_else(|e| panic!("{range} {unroll}: {e}"));
            assert_eq!(found.texels()[0].to_array(), told(&counters), "{range} {unroll}");
        }
    }
}

/// All values of a type are more than a loop counts: it is refused where that is known.
#[test]
fn a_range_of_all_values_is_refused() {
    for unroll in FORMS {
        for range in ["0u32..=u32::MAX", "i32::MIN..=i32::MAX"] {
            let settings = Settings::new().unroll(unroll);
            let refused = Kernel::from_text("range.rs", &kernel("", "", range), "k").compile(&settings);
            let error = refused.expect_err("too many iterations").to_string();
            assert!(error.contains("a loop of 4294967296 iterations"), "{error}");
        }
    }
}
