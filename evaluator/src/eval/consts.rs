//! Constants of the standard library and of glam.

use super::Evaluator;
use super::call::vector_type;
use super::value::Value;
use crate::front::tree::IntType;
use crate::ir::{Op, Scalar, Type};
use std::f32::consts;

impl Evaluator<'_> {
    /// Evaluates a named constant: `PI`, `f32::MAX`, `Vec4::ZERO`, ...
    pub fn known_constant(&mut self, path: &[String]) -> Option<Value> {
        let (ty, name) = match path {
            [.., ty, name] => (ty.as_str(), name.as_str()),
            [name] => ("consts", name.as_str()),
            [] => return None,
        };
        if let Some((kind, lanes)) = vector_type(ty) {
            return self.vector_constant(kind, lanes, name);
        }
        if let Some(n) = super::matrix::column_count(ty) {
            let one = self.builder.f32(1.0);
            let zero = self.builder.f32(0.0);
            let diagonal = match name {
                "IDENTITY" => one,
                "ZERO" => zero,
                "NAN" => self.builder.f32(f32::NAN),
                _ => return None,
            };
            let zero = if name == "NAN" { diagonal } else { zero };
            let columns: Vec<_> = (0..n)
                .map(|c| {
                    let parts: Vec<_> = (0..n).map(|r| if r == c { diagonal } else { zero }).collect();
                    self.builder.add(Op::Compose, parts, Type::value(Scalar::F32, n))
                })
                .collect();
            return Some(super::matrix::matrix_value(&columns));
        }
        let float = match (ty, name) {
            ("consts", _) => named_constant(name)?,
            ("f32", "MAX") => f32::MAX,
            ("f32", "MIN") => f32::MIN,
            ("f32", "MIN_POSITIVE") => f32::MIN_POSITIVE,
            ("f32", "EPSILON") => f32::EPSILON,
            ("f32", "INFINITY") => f32::INFINITY,
            ("f32", "NEG_INFINITY") => f32::NEG_INFINITY,
            ("f32", "NAN") => f32::NAN,
            ("usize", "BITS") => return Some(Value::Node(self.builder.constant(Type::U32, [64, 0, 0, 0]))),
            ("usize", "MIN") => return Some(Value::Int(0)),
            ("usize", "MAX") => return Some(Value::Node(self.builder.usize(u64::MAX))),
            (ty, "BITS" | "MIN" | "MAX")
                if let Some(kind) = IntType::from_name(ty).filter(|k| k.narrow_bits().is_some()) =>
            {
                let number = match name {
                    "BITS" => i64::from(kind.narrow_bits().unwrap_or_default()),
                    "MIN" => kind.range().0,
                    _ => kind.range().1,
                };
                let ty = if name == "BITS" { Scalar::U32 } else { kind.scalar() };
                let bits = [number as u32, 0, 0, 0];
                return Some(Value::Node(self.builder.constant(Type::scalar(ty), bits)));
            }
            ("u32" | "i32", "BITS") => return Some(Value::Node(self.builder.constant(Type::U32, [32, 0, 0, 0]))),
            ("i32", "MAX") => return Some(Value::Node(self.builder.i32(i32::MAX))),
            ("i32", "MIN") => return Some(Value::Node(self.builder.i32(i32::MIN))),
            ("u32", "MIN") => return Some(Value::Node(self.builder.constant(Type::U32, [0; 4]))),
            ("u32", "MAX") => return Some(Value::Node(self.builder.constant(Type::U32, [u32::MAX, 0, 0, 0]))),
            _ => return None,
        };
        Some(Value::Node(self.builder.f32(float)))
    }

    fn vector_constant(&mut self, kind: Scalar, lanes: u8, name: &str) -> Option<Value> {
        let (negated, name) = match name.strip_prefix("NEG_") {
            Some(rest) if matches!(kind, Scalar::F32 | Scalar::I32) => (true, rest),
            _ => (false, name),
        };
        if name == "AXES" && kind != Scalar::Bool {
            let axes = ["X", "Y", "Z", "W"].into_iter().take(lanes.into());
            return axes
                .map(|axis| self.vector_constant(kind, lanes, axis))
                .collect::<Option<_>>()
                .map(Value::array);
        }
        let one = match (kind, negated) {
            (Scalar::F32, false) => 1.0f32.to_bits(),
            (Scalar::F32, true) => (-1.0f32).to_bits(),
            (_, true) => -1_i32 as u32,
            _ => 1,
        };
        let all = match (kind, name, negated) {
            (Scalar::F32, "INFINITY", false) => Some(f32::INFINITY.to_bits()),
            (Scalar::F32, "INFINITY", true) => Some(f32::NEG_INFINITY.to_bits()),
            (Scalar::F32, "NAN", false) => Some(f32::NAN.to_bits()),
            (Scalar::F32, "MAX", false) => Some(f32::MAX.to_bits()),
            (Scalar::F32, "MIN", false) => Some(f32::MIN.to_bits()),
            (Scalar::I32, "MAX", false) => Some(i32::MAX as u32),
            (Scalar::I32, "MIN", false) => Some(i32::MIN as u32),
            (Scalar::U32, "MAX", false) => Some(u32::MAX),
            (Scalar::U32, "MIN", false) => Some(0),
            _ => None,
        };
        let mut bits = [0; 4];
        if let Some(all) = all {
            bits[..usize::from(lanes)].fill(all);
            return Some(Value::Node(self.builder.constant(Type::value(kind, lanes), bits)));
        }
        let axis = match name {
            "ZERO" if kind != Scalar::Bool && !negated => 0..0,
            "FALSE" if kind == Scalar::Bool => 0..0,
            "TRUE" if kind == Scalar::Bool => 0..lanes as usize,
            _ if kind == Scalar::Bool => return None,
            "ONE" => 0..lanes as usize,
            "X" => 0..1,
            "Y" => 1..2,
            "Z" => 2..3,
            "W" => 3..4,
            _ => return None,
        };
        if axis.end > lanes as usize {
            return None;
        }
        bits[axis].fill(one);
        Some(Value::Node(self.builder.constant(Type::value(kind, lanes), bits)))
    }
}

fn named_constant(name: &str) -> Option<f32> {
    Some(match name {
        "PI" => consts::PI,
        "TAU" => consts::TAU,
        "E" => consts::E,
        "LN_2" => consts::LN_2,
        "LN_10" => consts::LN_10,
        "LOG2_E" => consts::LOG2_E,
        "LOG2_10" => consts::LOG2_10,
        "LOG10_2" => consts::LOG10_2,
        "LOG10_E" => consts::LOG10_E,
        "SQRT_2" => consts::SQRT_2,
        "FRAC_1_SQRT_2" => consts::FRAC_1_SQRT_2,
        "FRAC_1_PI" => consts::FRAC_1_PI,
        "FRAC_2_PI" => consts::FRAC_2_PI,
        "FRAC_PI_2" => consts::FRAC_PI_2,
        "FRAC_PI_3" => consts::FRAC_PI_3,
        "FRAC_PI_4" => consts::FRAC_PI_4,
        "FRAC_PI_6" => consts::FRAC_PI_6,
        "FRAC_PI_8" => consts::FRAC_PI_8,
        _ => return None,
    })
}
