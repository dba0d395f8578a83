//! Text to write in place of methods that the kernel language does not have.

/// Kind of receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Receiver {
    /// A number, or a vector of numbers.
    Number,
    /// A matrix.
    Matrix,
    /// A quaternion.
    Quaternion,
    /// An array, a slice or an iterator.
    List,
    /// An `Option` or a `Result`.
    Choice,
}

use Receiver::{Choice, List, Matrix, Number, Quaternion};

/// Methods by receiver and name, with the text to write.
#[rustfmt::skip]
const TEXTS: &[(Receiver, &str, &str)] = &[
    (Number, "asinh", "(x + (x * x + 1.0).sqrt()).ln()"),
    (Number, "acosh", "(x + (x * x - 1.0).sqrt()).ln()"),
    (Number, "atanh", "0.5 * ((1.0 + x) / (1.0 - x)).ln()"),
    (Number, "lerp", "mix(x, to, amount)"),
    (Number, "saturate", "saturate(x)"),
    (Number, "step", "step(edge, x)"),
    (Number, "smoothstep", "smoothstep(low, high, x)"),
    (Number, "classify", "x.is_nan()`, `x.is_infinite()` or `x.is_normal()"),
    (Number, "checked_pow", "x.wrapping_mul(x)` for each factor, or `x.pow(3)"),
    (Number, "wrapping_pow", "x.pow(3)` with a constant exponent, or `x.wrapping_mul(x)"),
    (Number, "saturating_pow", "x.saturating_mul(x)"),
    (Number, "overflowing_pow", "x.overflowing_mul(x)"),
    (Number, "ilog", "x.ilog2()` or `x.ilog10()"),
    (Number, "checked_ilog", "x.checked_ilog2()` or `x.checked_ilog10()"),
    (Number, "write_to_slice", "a.copy_from_slice(&v.to_array())"),
    (Number, "slerp", "Quat::from_axis_angle(axis, angle * s) * v"),
    (Number, "rotate_towards", "Quat::from_axis_angle(axis, angle) * v"),
    (Number, "overflowing_div", "x.checked_div(y)"),
    (Number, "overflowing_rem", "x.checked_rem(y)"),
    (Number, "overflowing_div_euclid", "x.checked_div_euclid(y)"),
    (Number, "overflowing_rem_euclid", "x.checked_rem_euclid(y)"),
    (Number, "overflowing_shl", "x.checked_shl(n)"),
    (Number, "overflowing_shr", "x.checked_shr(n)"),
    (Number, "overflowing_add_unsigned", "x.checked_add_unsigned(y)"),
    (Number, "overflowing_sub_unsigned", "x.checked_sub_unsigned(y)"),
    (Number, "overflowing_add_signed", "x.checked_add_signed(y)"),
    (Number, "overflowing_sub_signed", "x.checked_add_signed(-y)"),
    (Number, "checked_sub_signed", "x.checked_add_signed(-y)"),
    (Number, "saturating_sub_signed", "x.saturating_add_signed(-y)"),
    (Number, "wrapping_sub_signed", "x.wrapping_sub(y as u32)"),
    (Number, "checked_signed_diff", "x.wrapping_sub(y) as i32"),
    (Number, "checked_manhattan_distance", "a.manhattan_distance(b)"),
    (Number, "set", "BVec3::new(x, y, z)"),
    (Number, "rotate_angle", "v.rotate(Vec2::from_angle(angle))"),
    (Number, "project", "v.xyz() / v.w"),
    (Matrix, "from_euler", "Mat3::from_rotation_z(z) * Mat3::from_rotation_y(y) * Mat3::from_rotation_x(x)"),
    (Matrix, "from_mat4_minor", "Mat3::from_cols(m.x_axis.xyz(), m.y_axis.xyz(), m.z_axis.xyz())"),
    (Matrix, "set_row", "m.x_axis.y = row.x` for each column"),
    (Matrix, "write_cols_to_slice", "a.copy_from_slice(&m.to_cols_array())"),
    (Matrix, "from_cols_slice", "Mat3::from_cols_array(&a)"),
    (Matrix, "from_rows_slice", "Mat3::from_rows_array(&a)"),
    (Matrix, "to_euler", "m.x_axis.y.atan2(m.x_axis.x)` for the angle about z"),
    (Matrix, "to_scale_angle_translation", "m.x_axis.length()` for the scale, and `m.z_axis.xy()` for the translation"),
    (Matrix, "to_scale_rotation_translation", "m.w_axis.xyz()` for the translation, and `m.x_axis.length()` for the scale"),
    (Quaternion, "from_euler", "Quat::from_rotation_z(z) * Quat::from_rotation_y(y) * Quat::from_rotation_x(x)"),
    (Quaternion, "to_euler", "q.to_axis_angle()"),
    (Quaternion, "from_rotation_arc_colinear", "Quat::from_rotation_arc(from, to)"),
    (Quaternion, "from_rotation_arc_2d", "Quat::from_rotation_z(from.angle_to(to))"),
    (Quaternion, "rotate_towards", "q.slerp(end, s)"),
    (Quaternion, "slerp_long", "q.slerp(-end, s)"),
    (Quaternion, "from_slice", "Quat::from_xyzw(a[0], a[1], a[2], a[3])"),
    (Quaternion, "write_to_slice", "a.copy_from_slice(&q.to_array())"),
    (Quaternion, "from_affine3", "Quat::from_mat3(&m)"),
    (Quaternion, "from_affine3a", "Quat::from_mat3(&m)"),
    (List, "collect", "std::array::from_fn(|k| ...)"),
    (List, "partition", "items.iter().filter(...)` for each part"),
    (List, "unzip", "items.map(|(a, _)| a)` for each part"),
    (List, "peekable", "items[k + 1]` in a loop over `k"),
    (List, "next", "items[k]` in a loop over `k"),
    (List, "size_hint", "items.len()"),
    (List, "fuse", "items.iter()"),
    (List, "by_ref", "items[k]` in a loop over `k"),
    (List, "eq", "a == b"),
    (List, "ne", "a != b"),
    (List, "lt", "a[k] < b[k]` in a loop over `k"),
    (List, "le", "a[k] <= b[k]` in a loop over `k"),
    (List, "gt", "a[k] > b[k]` in a loop over `k"),
    (List, "ge", "a[k] >= b[k]` in a loop over `k"),
    (List, "is_sorted_by_key", "items.is_sorted_by(|a, b| ...)"),
    (List, "rchunks", "items.chunks(n).rev()"),
    (List, "rchunks_exact", "items.chunks_exact(n).rev()"),
    (List, "binary_search", "items.iter().position(|x| *x == value)"),
    (List, "partition_point", "items.iter().position(|x| !holds(x))"),
    (List, "each_ref", "items.iter()"),
    (List, "copy_within", "items[to..].copy_from_slice(&copy[from..])` with a copy of the array"),
    (List, "as_flattened", "items[k / 2][k % 2]"),
    (List, "first_chunk", "std::array::from_fn(|k| items[k])"),
    (List, "last_chunk", "std::array::from_fn(|k| items[items.len() - n + k])"),
    (List, "split_first_chunk", "std::array::from_fn(|k| items[k])"),
    (List, "split_last_chunk", "std::array::from_fn(|k| items[items.len() - n + k])"),
    (List, "as_array", "items"),
    (List, "as_chunks", "items.chunks_exact(n)"),
    (List, "as_rchunks", "items.chunks_exact(n).rev()"),
    (List, "array_windows", "items.windows(n)"),
    (List, "chunk_by", "for x in items` with a variable"),
    (List, "split", "for x in items` with a variable"),
    (List, "split_inclusive", "for x in items` with a variable"),
    (List, "rsplit", "for x in items` with a variable"),
    (List, "splitn", "for x in items` with a variable"),
    (List, "rsplitn", "for x in items` with a variable"),
    (List, "binary_search_by", "items.iter().position(|x| ...)"),
    (List, "binary_search_by_key", "items.iter().position(|x| ...)"),
    (List, "select_nth_unstable", "items.sort_unstable()"),
    (List, "select_nth_unstable_by", "items.sort_unstable_by(|a, b| ...)"),
    (List, "select_nth_unstable_by_key", "items.sort_unstable_by_key(|x| ...)"),
    (List, "start", "a` of `a..=b"),
    (List, "end", "b` of `a..=b"),
    (List, "into_inner", "(a, b)` of `a..=b"),
    (Choice, "flatten", "x.and_then(|x| x)"),
    (Choice, "as_slice", "if let Some(x) = x"),
    (Choice, "as_deref", "if let Some(x) = x"),
    (Choice, "iter", "if let Some(x) = x"),
    (Choice, "take_if", "if holds { x.take() } else { None }"),
    (Choice, "unzip", "x.map(|(a, _)| a)` for each part"),
    (Choice, "transpose", "match x"),
    (Choice, "as_ref", "match x"),
    (Choice, "copied", "x.map(|x| *x)"),
    (Choice, "cloned", "x.map(|x| *x)"),
];

/// Returns the help for a method that a receiver does not have, if another text does the same.
pub fn find_text(receiver: Receiver, name: &str) -> Option<String> {
    let found = TEXTS.iter().find(|(of, known, _)| *of == receiver && *known == name);
    found.map(|(_, _, text)| match text.matches('`').count() % 2 {
        // A text that ends in words closes its own code.
        1 => format!("write `{text}"),
        _ => format!("write `{text}`"),
    })
}

/// Returns the help for a type that the kernel language does not have, if others take its place.
pub fn find_type(name: &str) -> Option<&'static str> {
    let text = match name {
        "Affine2" => "write a `Mat3`: its `transform_point2` and `transform_vector2` do the same",
        "Affine3A" | "Affine3" => "write a `Mat4`: its `transform_point3` and `transform_vector3` do the same",
        "EulerRot" => "write `Mat3::from_rotation_z(z) * Mat3::from_rotation_y(y) * Mat3::from_rotation_x(x)`",
        "RangeInclusive" => "write `a..=b`",
        "Vec3A" => "write `Vec3`",
        "Mat3A" => "write `Mat3`",
        _ => return None,
    };
    Some(text)
}
