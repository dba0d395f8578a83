//! Each operation of the language by itself, on numbers of every kind: what rustc makes of it is what every form computes, and
//! what a driver computes of its WGSL and of its GLSL. Random kernels meet some of them seldom.

use std::collections::BTreeSet;
use straightline_codegen::Kernel;
use straightline_codegen::ir::{BinaryOp, Op, UnaryOp};
use straightline_tests::random::forms::FORMS;
use straightline_tests::random::oracle::{self, Compared, Driver, Rustc, Text, Ways, World};

/// Of floats `x`, `y`, `z`, each in four components, in one and all at once.
const FLOATS: [&str; 58] = [
    "-x",
    "x.abs()",
    "sign(x)",
    "x.floor()",
    "x.ceil()",
    "round(x)",
    "x.trunc()",
    "fract(x)",
    "saturate(x)",
    "x.sqrt()",
    "inverse_sqrt(x)",
    "x.cbrt()",
    "x.exp()",
    "(x * 8.0).exp()",
    "x.exp2()",
    "x.ln()",
    "x.log2()",
    "x.clamp(-8.0, 8.0).sin()",
    "x.clamp(-8.0, 8.0).cos()",
    "(x * 0.0625).clamp(-1.0, 1.0).tan()",
    "x.asin()",
    "(x * 0.125).asin()",
    "x.acos()",
    "(x * 0.125).acos()",
    "x.atan()",
    "x.sinh()",
    "x.cosh()",
    "x.tanh()",
    "(x * 8.0).sinh() * 1.0e-30",
    "(x * 8.0).tanh()",
    "x + y",
    "x - y",
    "x * y",
    "x / y",
    "x / 0.0",
    "x / 1.0e-39",
    "x % y",
    "(x * 1.0e10) % y",
    "x % 3.0",
    "x.min(y)",
    "x.max(y)",
    "x.powf(y)",
    "x.powf(y.trunc())",
    "x.powf(3.0)",
    "x.powf(-2.0)",
    "x.powf(0.4545)",
    "(x.abs() + 0.25).powf(y * 0.125)",
    "x.atan2(y)",
    "x.trunc().atan2(y.trunc())",
    "x.clamp(-2.5, 3.0)",
    "x.rem_euclid(y)",
    "x.div_euclid(y)",
    "if x < y { z } else { x }",
    "if x <= y { z } else { x }",
    "if x > y { z } else { x }",
    "if x >= y { z } else { x }",
    "if x == z.trunc() { y } else { x }",
    "if x != z.trunc() && !(x < z || y < z) { y } else { x }",
];

/// A number for every float: drivers are compared where what is shown is finite.
const SHOWN: &str = "fn shown(x: f32) -> f32 { if x.is_nan() { -7.5 } else { x.clamp(-1.0e9, 1.0e9) } }\n";

/// Of vectors `x`, `y`, `z` of four floats.
const VECTORS: [&str; 16] = [
    "-x",
    "x.abs()",
    "x.floor()",
    "x.ceil()",
    "x.trunc()",
    "fract(x)",
    "x + y * z",
    "x.min(y)",
    "x.max(y)",
    "x.clamp(y.min(z), y.max(z))",
    "Vec4::splat(x.dot(y))",
    "x.truncate().cross(y.truncate()).extend(x.length_squared())",
    "Vec4::select(x.cmplt(y), y, z)",
    "Vec4::select(x.cmpeq(z.trunc()) | x.cmpgt(y), y, z)",
    "vec4(x.w, y.z, x.y, z.x)",
    "mix(x, y, 0.25)",
];

/// Of integers `i`, `j` of four components, signed and unsigned.
const INTEGERS: [&str; 31] = [
    "!i",
    "i.wrapping_add(j)",
    "i.wrapping_sub(j)",
    "i.wrapping_mul(j)",
    "i / (j | 1)",
    "i % (j | 1)",
    "(i >> 1) / 7",
    "(i >> 1) % 7",
    "i & j",
    "i | j",
    "i ^ j",
    "i << (j & 31)",
    "i >> (j & 31)",
    "i.min(j)",
    "i.max(j)",
    "i.clamp(3, 60)",
    "i.wrapping_shl(3)",
    "i.rem_euclid((j >> 1) | 1)",
    "i.div_euclid((j >> 1) | 1)",
    "i.count_ones() as T",
    "i.leading_zeros() as T",
    "i.trailing_zeros() as T",
    "i.reverse_bits()",
    "i.rotate_left(5)",
    "i.abs_diff(j) as T",
    "if i < j { i } else { 7 }",
    "if i <= j { i } else { 7 }",
    "if i > j { i } else { 7 }",
    "if i >= j { i } else { 7 }",
    "if i == j { i } else { 7 }",
    "if (i != j) ^ (i & 1 == 0) { i } else { 7 }",
];

/// Of signed integers alone.
const SIGNED: [&str; 4] = ["i.wrapping_neg()", "(i >> 1).abs()", "i.signum()", "(i >> 3).pow(2)"];

/// Of floats and integers, giving a float.
const CONVERSIONS: [&str; 12] = [
    "x as i32 as f32",
    "x as u32 as f32",
    "(x * 1.0e9) as i32 as f32",
    "(x * 1.0e9) as u32 as f32",
    "(i >> 9) as f32",
    "(u >> 9) as f32",
    "i as f32",
    "u as f32",
    "f32::from_bits(x.to_bits() ^ 0x400000)",
    "f32::from_bits((u >> 9) | 0x3f800000)",
    "(u as i32 >> 7) as f32",
    "(i as u32 >> 7) as f32",
];

fn text(seed: usize, result: &str, prelude: &str, value: &str) -> Text {
    Text {
        seed: seed as u64,
        source: format!(
            "pub fn k(a: &Frame<Vec4>, fw: &Frame<UVec4>, pixel: IVec2) -> {result} {{\n    \
             let (here, beside, below) = (pixel, pixel + ivec2(1, 0), pixel + ivec2(2, 1));\n{prelude}    {value}\n}}\n"
        ),
    }
}

/// A kernel for each operation.
fn texts() -> Vec<Text> {
    let floats = "    let (xs, ys, zs) = (a.load(here), a.load(beside), a.load(below));\n";
    let mut texts = Vec::new();
    let mut add = |result: &str, prelude: String, value: String| {
        texts.push(text(texts.len(), result, &prelude, &value));
    };
    for op in FLOATS {
        let each: Vec<String> = ["x", "y", "z", "w"]
            .iter()
            .map(|c| format!("f(xs.{c}, ys.{c}, zs.{c})"))
            .collect();
        let f = format!("{floats}    {SHOWN}    fn f(x: f32, y: f32, z: f32) -> f32 {{ shown({op}) }}\n");
        add("Vec4", f, format!("vec4({})", each.join(", ")));
    }
    for op in VECTORS {
        let f = format!("{floats}    fn f(x: Vec4, y: Vec4, z: Vec4) -> Vec4 {{ {op} }}\n");
        add("Vec4", f, "f(xs, ys, zs)".to_owned());
    }
    for (ty, vector, cast, ops) in [
        (
            "i32",
            "IVec4",
            ".as_ivec4()",
            INTEGERS.iter().chain(&SIGNED).collect::<Vec<_>>(),
        ),
        ("u32", "UVec4", "", INTEGERS.iter().collect()),
    ] {
        for op in ops {
            let op = op.replace("as T", &format!("as {ty}"));
            let each: Vec<String> = ["x", "y", "z", "w"]
                .iter()
                .map(|c| format!("f(is.{c}, js.{c})"))
                .collect();
            let f = format!(
                "    let (is, js) = (fw.load(here){cast}, fw.load(below){cast});\n    fn f(i: {ty}, j: {ty}) -> {ty} {{ {op} }}\n"
            );
            add(vector, f, format!("{vector}::new({})", each.join(", ")));
        }
    }
    for op in CONVERSIONS {
        let each: Vec<String> = ["x", "y", "z", "w"]
            .iter()
            .map(|c| format!("f(xs.{c}, us.{c} as i32, us.{c})"))
            .collect();
        let f = format!(
            "    let (xs, us) = (a.load(here), fw.load(here));\n    fn f(x: f32, i: i32, u: u32) -> f32 {{ {op} }}\n"
        );
        add("Vec4", f, format!("vec4({})", each.join(", ")));
    }
    texts
}

/// Arithmetic operations of the kernels.
fn operations(texts: &[Text]) -> (BTreeSet<UnaryOp>, BTreeSet<BinaryOp>) {
    let (mut unary, mut binary) = (BTreeSet::new(), BTreeSet::new());
    for text in texts {
        let compiled = Kernel::from_text("operation.rs", &text.file(), "k")
            .compile(&FORMS[0].settings())
            .unwrap_or_else(|errors| panic!("{text}\n{errors}"));
        for id in compiled.graph.node_ids() {
            match compiled.graph.node(id).op {
                Op::Unary(op) => _ = unary.insert(op),
                Op::Binary(op) => _ = binary.insert(op),
                _ => {}
            }
        }
    }
    (unary, binary)
}

#[test]
fn every_operation_is_tried() {
    let (unary, binary) = operations(&texts());
    let missing: Vec<UnaryOp> = UnaryOp::ALL.into_iter().filter(|op| !unary.contains(op)).collect();
    assert_eq!(missing, []);
    let missing: Vec<BinaryOp> = BinaryOp::ALL.into_iter().filter(|op| !binary.contains(op)).collect();
    assert_eq!(missing, []);
}

#[test]
fn each_operation_is_what_rustc_makes_of_it() {
    let texts = texts();
    let rustc = Rustc::find().unwrap_or_else(|why| panic!("{why}"));
    for world in 0..4 {
        let (tally, failures) = oracle::check(&rustc, &texts, world).unwrap_or_else(|why| panic!("{why}"));
        if let Some(failure) = failures.first() {
            panic!("{}\nworld {world}: {}", failure.text, failure.difference);
        }
        assert_eq!(tally.compared, texts.len() as u64, "all are compared: {tally:?}");
    }
}

#[test]
fn a_driver_computes_each_operation_as_wgsl_and_as_glsl() {
    let texts = texts();
    let rustc = Rustc::find().unwrap_or_else(|why| panic!("{why}"));
    let driver = Driver::new().unwrap_or_else(|why| panic!("{why}"));
    let shaders = driver
        .shaders(&texts, Ways::Languages)
        .unwrap_or_else(|why| panic!("{why}"));
    let mut wrong = Vec::new();
    for world in 0..2 {
        let world = World::for_drivers(world);
        let natives = oracle::run(&rustc, &texts, &world).unwrap_or_else(|why| panic!("{why}"));
        for ((text, shaders), native) in texts.iter().zip(&shaders).zip(natives) {
            let native = native.unwrap_or_else(|why| panic!("{text}\n{why}"));
            let mut compared = Compared::default();
            if let Err(off) = driver.compare(shaders, &world, &native, &mut compared) {
                wrong.push(format!("{text}\n{off}"));
                continue;
            }
            assert!(
                compared.pixels * 2 > compared.unsure,
                "most pixels are compared: {text}\n{compared:?}"
            );
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
