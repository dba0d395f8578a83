//! Structures of glam that Rust lets be written out: `Vec3 { x, y, z }`.

use super::name::Name;
use super::tree::{Fields, Type};
use crate::diagnostic::Span;

/// Fields of a structure of glam; `None` where glam keeps them private, as those of `Vec4`, `Mat2` and `Quat`.
pub fn public_fields(name: &str, span: Span) -> Option<Fields> {
    let (names, part): (&[&str], &str) = match name {
        "Mat3" => (&["x_axis", "y_axis", "z_axis"], "Vec3"),
        "Mat4" => (&["x_axis", "y_axis", "z_axis", "w_axis"], "Vec4"),
        _ => {
            let (kind, lanes) = name.split_once("Vec")?;
            let part = match kind {
                "" => "f32",
                "I" => "i32",
                "U" => "u32",
                "B" => "bool",
                _ => return None,
            };
            match lanes {
                "2" => (&["x", "y"], part),
                "3" => (&["x", "y", "z"], part),
                "4" if !kind.is_empty() => (&["x", "y", "z", "w"], part),
                _ => return None,
            }
        }
    };
    let field = |name: &&str| (Name::from(*name), Type::Name(part.to_owned(), Vec::new()), span);
    Some(names.iter().map(field).collect())
}
