//! Methods of integer vectors and of matrices, written out for each size.

use super::LANES;
use std::fmt::Write;

/// Writes methods of vectors that glam computes component by component.
pub(super) fn write_vectors(text: &mut String, lanes: usize) {
    let vector = format!("Vec{lanes}");
    let each = |part: &dyn Fn(&str) -> String| LANES[..lanes].iter().map(|l| part(l)).collect::<Vec<_>>().join(", ");
    let mask = |name: &str| each(&|l| format!("self.{l}.{name}()"));
    let (sines, cosines) = (
        each(&|l| format!("self.{l}.sin()")),
        each(&|l| format!("self.{l}.cos()")),
    );
    let (nan, finite) = (mask("is_nan"), mask("is_finite"));
    let _ = writeln!(
        text,
        "impl {vector} {{\n    fn sin_cos(self) -> ({vector}, {vector}) {{ ({vector}::new({sines}), {vector}::new({cosines})) }}\n    \
         fn is_nan_mask(self) -> B{vector} {{ B{vector}::new({nan}) }}\n    \
         fn is_finite_mask(self) -> B{vector} {{ B{vector}::new({finite}) }}\n}}"
    );
    let items = each(&|l| format!("a[{}]", LANES.iter().position(|lane| *lane == l).unwrap_or_default()));
    for (prefix, number) in [("", "f32"), ("I", "i32"), ("U", "u32"), ("B", "bool")] {
        let own = format!("{prefix}{vector}");
        let _ = writeln!(
            text,
            "impl {own} {{\n    fn from_array(a: [{number}; {lanes}]) -> {own} {{ {own}::new({items}) }}\n}}"
        );
    }
    for (prefix, test) in [("", ".is_sign_negative()"), ("I", " < 0")] {
        let parts = each(&|l| format!("self.{l}{test}"));
        let _ = writeln!(
            text,
            "impl {prefix}{vector} {{\n    fn is_negative_mask(self) -> B{vector} {{ B{vector}::new({parts}) }}\n    \
             fn is_negative_bitmask(self) -> u32 {{ self.is_negative_mask().bitmask() }}\n}}"
        );
    }
    for prefix in ["I", "U"] {
        let own = format!("{prefix}{vector}");
        let _ = writeln!(text, "impl {own} {{");
        for name in [
            "saturating_add",
            "saturating_sub",
            "saturating_mul",
            "saturating_div",
            "wrapping_div",
        ] {
            let parts = each(&|l| format!("self.{l}.{name}(other.{l})"));
            let _ = writeln!(
                text,
                "    fn {name}(self, other: {own}) -> {own} {{ {own}::new({parts}) }}"
            );
        }
        for name in ["checked_add", "checked_sub", "checked_mul", "checked_div"] {
            let parts = each(&|l| format!("self.{l}.{name}(other.{l})"));
            let some = each(&|l| format!("Some({l})"));
            let all = each(&str::to_owned);
            let _ = writeln!(
                text,
                "    fn {name}(self, other: {own}) -> Option<{own}> {{\n        match ({parts}) {{\n            \
                 ({some}) => Some({own}::new({all})),\n            _ => None,\n        }}\n    }}"
            );
        }
        let apart = |joint: &str| {
            let all = LANES[..lanes].iter().map(|l| format!("self.{l}.abs_diff(other.{l})"));
            all.collect::<Vec<_>>().join(joint)
        };
        let largest = LANES[1..lanes]
            .iter()
            .fold("self.x.abs_diff(other.x)".to_owned(), |most, l| {
                format!("{most}.max(self.{l}.abs_diff(other.{l}))")
            });
        let _ = writeln!(
            text,
            "    fn manhattan_distance(self, other: {own}) -> u32 {{ {} }}\n    \
             fn chebyshev_distance(self, other: {own}) -> u32 {{ {largest} }}",
            apart(" + ")
        );
        if lanes == 3 {
            let _ = writeln!(
                text,
                "    fn cross(self, other: {own}) -> {own} {{ {own}::new(self.y * other.z - other.y * self.z, self.z * other.x - \
                 other.z * self.x, self.x * other.y - other.x * self.y) }}"
            );
        }
        text.push_str("}\n");
    }
}

/// Writes methods of a square matrix that glam computes column by column.
pub(super) fn write_matrix(text: &mut String, size: usize) {
    let (matrix, vector) = (format!("Mat{size}"), format!("Vec{size}"));
    let lanes = &LANES[..size];
    let each = |part: &dyn Fn(&str) -> String| lanes.iter().map(|l| part(l)).collect::<Vec<_>>().join(", ");
    let _ = writeln!(text, "impl {matrix} {{");
    let mut method = |name: &str, parameters: &str, result: &str, body: &str| {
        let _ = writeln!(text, "    fn {name}({parameters}) -> {result} {{ {body} }}");
    };
    let columns = |part: &dyn Fn(&str) -> String| format!("{matrix}::from_cols({})", each(part));
    method("abs", "&self", &matrix, &columns(&|l| format!("self.{l}_axis.abs()")));
    method(
        "recip",
        "&self",
        &matrix,
        &columns(&|l| format!("self.{l}_axis.recip()")),
    );
    for (name, sign) in [("add", "+"), ("sub", "-")] {
        let body = columns(&|l| format!("self.{l}_axis {sign} other.{l}_axis"));
        let name = format!("{name}_mat{size}");
        method(&name, &format!("&self, other: &{matrix}"), &matrix, &body);
    }
    method(
        "mul_scalar",
        "&self, x: f32",
        &matrix,
        &columns(&|l| format!("self.{l}_axis * x")),
    );
    method(
        "div_scalar",
        "&self, x: f32",
        &matrix,
        &columns(&|l| format!("self.{l}_axis / x")),
    );
    let scaled = columns(&|l| format!("self.{l}_axis * scale.{l}"));
    method(
        "mul_diagonal_scale",
        &format!("&self, scale: {vector}"),
        &matrix,
        &scaled,
    );
    method(
        "diagonal",
        "&self",
        &vector,
        &format!("{vector}::new({})", each(&|l| format!("self.{l}_axis.{l}"))),
    );
    let tests = |name: &str, joint: &str| {
        let all = lanes.iter().map(|l| format!("self.{l}_axis.{name}()"));
        all.collect::<Vec<_>>().join(joint)
    };
    method("is_finite", "&self", "bool", &tests("is_finite", " && "));
    method("is_nan", "&self", "bool", &tests("is_nan", " || "));
    let near = lanes
        .iter()
        .map(|l| format!("self.{l}_axis.abs_diff_eq(other.{l}_axis, most)"));
    let near = near.collect::<Vec<_>>().join(" && ");
    method(
        "abs_diff_eq",
        &format!("&self, other: {matrix}, most: f32"),
        "bool",
        &near,
    );
    let row = |l: &str| format!("{vector}::new({})", each(&|column| format!("self.{column}_axis.{l}")));
    let arms = lanes.iter().enumerate().map(|(k, l)| match k + 1 == size {
        true => format!("_ => {}", row(l)),
        false => format!("{k} => {}, ", row(l)),
    });
    method(
        "row",
        "&self, index: usize",
        &vector,
        &format!("match index {{ {} }}", arms.collect::<String>()),
    );
    let dots = each(&|l| format!("self.{l}_axis.dot(v)"));
    for name in ["transpose_mul_vec", "mul_transpose_vec"] {
        let body = format!("{vector}::new({dots})");
        method(&format!("{name}{size}"), &format!("&self, v: {vector}"), &vector, &body);
    }
    let parameters = each(&|l| format!("{l}: {vector}"));
    method(
        "from_rows",
        &parameters,
        &matrix,
        &format!("{matrix}::from_cols({}).transpose()", each(&str::to_owned)),
    );
    let array = format!("[f32; {}]", size * size);
    method(
        "from_rows_array",
        &format!("m: &{array}"),
        &matrix,
        &format!("{matrix}::from_cols_array(m).transpose()"),
    );
    method("to_rows_array", "&self", &array, "self.transpose().to_cols_array()");
    let nested = format!("[[f32; {size}]; {size}]");
    method(
        "to_cols_array_2d",
        "&self",
        &nested,
        &format!("[{}]", each(&|l| format!("self.{l}_axis.to_array()"))),
    );
    let zero = columns(&|_| format!("{vector}::ZERO"));
    let checked = format!("let inverse = self.inverse(); if inverse.is_finite() {{ inverse }} else {{ {zero} }}");
    method("inverse_or_zero", "&self", &matrix, &checked);
    text.push_str("}\n");
}
