//! Values of the tree evaluator.

use super::real::Real;

/// A value; `R` stands for `f32`.
#[derive(Clone, Debug)]
pub enum Value<R> {
    Bool(bool),
    I32(i32),
    U32(u32),
    F32(R),
    /// Floats and how many of them.
    Vec([R; 4], u8),
    IVec([i32; 4], u8),
    UVec([u32; 4], u8),
    /// An array, tuple or structure.
    Many(Vec<Value<R>>),
}

impl<R: Real> Value<R> {
    /// A vector from its lanes.
    pub fn vec(lanes: &[R]) -> Value<R> {
        let mut all = [R::of(0.0); 4];
        all[..lanes.len()].copy_from_slice(lanes);
        Value::Vec(all, lanes.len() as u8)
    }

    /// A vector from its lanes.
    pub fn ivec(lanes: &[i32]) -> Value<R> {
        let mut all = [0; 4];
        all[..lanes.len()].copy_from_slice(lanes);
        Value::IVec(all, lanes.len() as u8)
    }

    /// One lane of a vector, or the scalar itself.
    pub fn lane(&self, k: usize) -> Option<Value<R>> {
        Some(match self {
            Value::Vec(lanes, n) if k < *n as usize => Value::F32(lanes[k]),
            Value::IVec(lanes, n) if k < *n as usize => Value::I32(lanes[k]),
            Value::UVec(lanes, n) if k < *n as usize => Value::U32(lanes[k]),
            _ => return None,
        })
    }

    /// Number of lanes; 1 for a scalar.
    pub fn lanes(&self) -> u8 {
        match self {
            Value::Vec(_, n) | Value::IVec(_, n) | Value::UVec(_, n) => *n,
            _ => 1,
        }
    }

    /// A vector from scalars of one type.
    pub fn gather(lanes: &[Value<R>]) -> Option<Value<R>> {
        let mut floats = Vec::new();
        let mut ints = Vec::new();
        for lane in lanes {
            match lane {
                Value::F32(x) => floats.push(*x),
                Value::I32(n) => ints.push(*n),
                _ => return None,
            }
        }
        if floats.len() == lanes.len() {
            Some(Value::vec(&floats))
        } else if ints.len() == lanes.len() {
            Some(Value::ivec(&ints))
        } else {
            None
        }
    }
}
