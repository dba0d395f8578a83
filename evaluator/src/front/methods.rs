//! The methods of numbers and vectors by their names, and those that Rust and shaders compute differently.

use super::instead::{Receiver, find_text};
use crate::ir::{Scalar, Type};

/// Methods of floats, component by component.
#[rustfmt::skip]
const FLOATS: &[&str] = &[
    "abs", "acos", "asin", "atan", "atan2", "cbrt", "ceil", "clamp", "cos", "cosh", "exp", "exp2", "floor",
    "is_finite", "is_nan", "ln", "log2", "max", "min", "powf", "powi", "recip", "round_ties_even", "sin", "sinh",
    "sqrt", "tan", "tanh", "to_bits", "to_degrees", "to_radians", "trunc",
];

/// Further methods of vectors.
#[rustfmt::skip]
const VECTORS: &[&str] = &[
    "cmpeq", "cmpge", "cmpgt", "cmple", "cmplt", "cmpne", "cross", "distance", "distance_squared", "dot",
    "element_product", "element_sum", "extend", "length", "length_recip", "length_squared", "lerp", "max_element",
    "min_element", "normalize", "perp", "reflect", "to_array", "truncate",
];

/// Methods of floats that Rust and shaders compute differently: why, and what to write.
pub const UNLIKE: [(&str, &str, &str); 3] = [
    (
        "mul_add",
        "`mul_add` rounds once in Rust, and once or twice in shaders",
        "x * a + b",
    ),
    (
        "exp_m1",
        "`exp_m1` is exact near 0 in Rust, and shaders have no such function",
        "x.exp() - 1.0",
    ),
    (
        "ln_1p",
        "`ln_1p` is exact near 0 in Rust, and shaders have no such function",
        "(1.0 + x).ln()",
    ),
];

/// Comparisons of vectors, component by component.
#[rustfmt::skip]
const COMPARISONS: &[&str] = &[
    "cmpeq", "cmpge", "cmpgt", "cmple", "cmplt", "cmpne", "extend", "truncate",
];

/// Methods of vectors of booleans.
const MASKS: &[&str] = &["all", "any", "test"];

/// Methods of integers.
#[rustfmt::skip]
const INTEGERS: &[&str] = &[
    "abs", "clamp", "count_ones", "leading_zeros", "max", "min", "pow", "rem_euclid", "reverse_bits", "signum",
    "trailing_zeros", "wrapping_add", "wrapping_mul", "wrapping_neg", "wrapping_shl", "wrapping_shr",
    "wrapping_sub",
];

/// Methods of a runtime `usize`.
#[rustfmt::skip]
const SIZES: &[&str] = &[
    "clamp", "count_ones", "max", "min", "pow", "rem_euclid", "wrapping_add", "wrapping_mul", "wrapping_neg",
    "wrapping_shl", "wrapping_shr", "wrapping_sub",
];

/// The methods of a type by their names.
fn method_lists(ty: Type) -> &'static [&'static [&'static str]] {
    match (ty.scalar_kind(), ty.component_count()) {
        (Some(Scalar::F32), 1) => &[FLOATS],
        (Some(Scalar::F32), _) => &[FLOATS, VECTORS],
        (Some(Scalar::Bool), _) => &[MASKS],
        (Some(Scalar::Usize), _) => &[SIZES],
        (_, 1) => &[INTEGERS],
        _ => &[INTEGERS, COMPARISONS],
    }
}

/// Help for a method that does not exist.
pub fn known_methods(name: &str, ty: Type) -> String {
    if let Some(text) = find_text(Receiver::Number, name) {
        return text;
    }
    let mut known: Vec<&str> = method_lists(ty).concat();
    known.extend(super::std::function_names(&ty.in_rust()));
    crate::suggest::suggest_name(name, &known, &format!("{} has", ty.in_rust()))
}

/// Returns whether numbers or vectors of a type have a method here.
pub fn has_method(ty: Type, name: &str) -> bool {
    method_lists(ty).iter().any(|list| list.contains(&name))
}

/// Methods that numbers have in Rust, and vectors of them only here.
#[rustfmt::skip]
const SCALARS_ONLY: &[&str] = &[
    "acos", "asin", "atan", "atan2", "cbrt", "cosh", "count_ones", "leading_zeros", "pow", "powi", "reverse_bits",
    "round_ties_even", "sinh", "tan", "tanh", "trailing_zeros",
];

/// Returns whether a number, a vector or a matrix has a constant of a name in Rust or glam.
fn has_constant(ty: &str, name: &str) -> bool {
    let Some((kind, lanes)) = crate::front::tree::vector_named(ty) else {
        return match ty {
            "f32" => [
                "DIGITS",
                "EPSILON",
                "INFINITY",
                "MANTISSA_DIGITS",
                "MAX",
                "MAX_10_EXP",
                "MAX_EXP",
                "MIN",
                "MIN_10_EXP",
                "MIN_EXP",
                "MIN_POSITIVE",
                "NAN",
                "NEG_INFINITY",
                "RADIX",
            ]
            .contains(&name),
            "i32" | "u32" | "usize" | "i8" | "i16" | "u8" | "u16" => ["BITS", "MAX", "MIN"].contains(&name),
            "Mat2" | "Mat3" | "Mat4" => ["IDENTITY", "NAN", "ZERO"].contains(&name),
            _ => false,
        };
    };
    let axes = &["X", "Y", "Z", "W"][..usize::from(lanes)];
    let is_axis = |name: &str| name == "ONE" || axes.contains(&name);
    match kind {
        Scalar::Bool => matches!(name, "FALSE" | "TRUE"),
        _ if is_axis(name) || matches!(name, "AXES" | "MAX" | "MIN" | "ZERO") => true,
        Scalar::F32 if matches!(name, "INFINITY" | "NAN" | "NEG_INFINITY") => true,
        Scalar::F32 | Scalar::I32 => name.strip_prefix("NEG_").is_some_and(is_axis),
        _ => false,
    }
}

/// Returns whether slices and arrays have a method of a name.
pub fn is_of_slices(name: &str) -> bool {
    matches!(
        name,
        "as_slice"
            | "chunks"
            | "chunks_exact"
            | "chunks_exact_mut"
            | "chunks_mut"
            | "into_iter"
            | "iter"
            | "iter_mut"
            | "len"
            | "map"
            | "windows"
    ) || super::std::has_function("Array", name)
}

/// Returns whether numbers or vectors have an inherent method or constant of a name, which takes precedence over one of a trait.
pub fn is_inherent(ty: &str, name: &str) -> bool {
    if has_constant(ty, name) {
        return true;
    }
    let value = match (ty, crate::front::tree::vector_named(ty)) {
        (_, Some((kind, lanes))) => Type::value(kind, lanes),
        ("f32", _) => Type::F32,
        ("i32", _) => Type::I32,
        ("usize", _) => Type::USIZE,
        ("u32", _) => Type::U32,
        ("bool", _) => Type::BOOL,
        _ => return false,
    };
    let is_of_vectors = value.component_count() == 1 || !SCALARS_ONLY.contains(&name);
    is_of_vectors && has_method(value, name) || super::std::has_function(ty, name)
}
