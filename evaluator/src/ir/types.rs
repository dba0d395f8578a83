//! Types of nodes.

use std::fmt;

/// The bits of a scalar or of up to four components of a vector; unused components are 0. A `usize` has two words, the
/// lower first.
pub type Bits = [u32; 4];

/// The bits of a `usize`.
pub fn usize_bits(value: u64) -> Bits {
    [value as u32, (value >> 32) as u32, 0, 0]
}

/// Value of the bits of a `usize`.
pub fn usize_value(bits: &Bits) -> u64 {
    u64::from(bits[0]) | u64::from(bits[1]) << 32
}

/// Kind of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Scalar {
    /// 0 or 1.
    Bool,
    /// Two's complement, wrapping.
    I32,
    /// Wrapping.
    U32,
    /// 64 bits, wrapping: a runtime `usize` during evaluation. The pass `narrow` removes it.
    Usize,
    /// IEEE 754 binary32.
    F32,
}

/// Type of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Type {
    /// A scalar (`components` 1) or a vector of 2 to 4.
    Value {
        /// Kind of each component.
        scalar: Scalar,
        /// Number of components, 1 to 4.
        components: u8,
    },
    /// A fixed number of scalars or vectors.
    Array {
        /// Kind of each component of an element.
        scalar: Scalar,
        /// Number of components of an element, 1 to 4.
        components: u8,
        /// Number of elements, at least 1.
        len: u32,
    },
    /// Results of a loop or branch, read by `Op::Result`.
    Results,
}

impl Type {
    /// A scalar boolean.
    pub const BOOL: Type = Type::scalar(Scalar::Bool);
    /// A scalar signed integer.
    pub const I32: Type = Type::scalar(Scalar::I32);
    /// A scalar unsigned integer.
    pub const U32: Type = Type::scalar(Scalar::U32);
    /// A scalar `usize`.
    pub const USIZE: Type = Type::scalar(Scalar::Usize);
    /// A scalar float.
    pub const F32: Type = Type::scalar(Scalar::F32);

    /// A scalar.
    pub const fn scalar(scalar: Scalar) -> Type {
        Type::Value { scalar, components: 1 }
    }

    /// A scalar or vector.
    pub const fn value(scalar: Scalar, components: u8) -> Type {
        Type::Value { scalar, components }
    }

    /// Kind of the components; `None` for `Results`.
    pub fn scalar_kind(self) -> Option<Scalar> {
        match self {
            Type::Value { scalar, .. } | Type::Array { scalar, .. } => Some(scalar),
            Type::Results => None,
        }
    }

    /// Number of components of a value or of an array's element; 0 for `Results`.
    pub fn component_count(self) -> u8 {
        match self {
            Type::Value { components, .. } | Type::Array { components, .. } => components,
            Type::Results => 0,
        }
    }

    /// Returns the same shape with components of another kind.
    pub fn with_scalar(self, scalar: Scalar) -> Type {
        match self {
            Type::Value { components, .. } => Type::Value { scalar, components },
            Type::Array { components, len, .. } => Type::Array {
                scalar,
                components,
                len,
            },
            Type::Results => Type::Results,
        }
    }

    /// Element type of an array; a value is its own element.
    pub fn element_type(self) -> Type {
        match self {
            Type::Array { scalar, components, .. } => Type::Value { scalar, components },
            other => other,
        }
    }

    /// Number of scalars or vectors: the elements of an array; 1 for a value.
    pub fn part_count(self) -> u32 {
        match self {
            Type::Array { len, .. } => len,
            _ => 1,
        }
    }

    /// Alignment and size in bytes in memory, as in WGSL and in GLSL's std430.
    pub fn memory_layout(self) -> (u32, u32) {
        let (alignment, size) = match self.component_count() {
            1 => (4, 4),
            2 => (8, 8),
            3 => (16, 12),
            _ => (16, 16),
        };
        match self {
            Type::Array { len, .. } => (alignment, alignment.max(size) * len),
            _ => (alignment, size),
        }
    }

    /// Returns whether this is an array.
    pub fn is_array(self) -> bool {
        matches!(self, Type::Array { .. })
    }

    /// Returns whether this is a scalar.
    pub fn is_scalar(self) -> bool {
        matches!(self, Type::Value { components: 1, .. })
    }

    /// Returns whether the components are integers.
    pub fn is_integer(self) -> bool {
        matches!(self.scalar_kind(), Some(Scalar::I32 | Scalar::U32 | Scalar::Usize))
    }

    /// Returns whether the components are floats.
    pub fn is_float(self) -> bool {
        self.scalar_kind() == Some(Scalar::F32)
    }
}

impl Type {
    /// Name of the type in Rust or glam: `f32`, `IVec2`, `[Vec4; 9]`.
    pub fn in_rust(self) -> String {
        match self {
            Type::Value { scalar, components: 1 } => scalar.to_string(),
            Type::Value { scalar, components } => {
                let prefix = match scalar {
                    Scalar::F32 => "",
                    Scalar::I32 => "I",
                    Scalar::U32 => "U",
                    Scalar::Bool => "B",
                    Scalar::Usize => "usize",
                };
                format!("{prefix}Vec{components}")
            }
            Type::Array { len, .. } => format!("[{}; {len}]", self.element_type().in_rust()),
            Type::Results => "nothing".to_owned(),
        }
    }
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Scalar::Bool => "bool",
            Scalar::I32 => "i32",
            Scalar::U32 => "u32",
            Scalar::Usize => "usize",
            Scalar::F32 => "f32",
        })
    }
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Type::Value { scalar, components: 1 } => write!(f, "{scalar}"),
            Type::Value { scalar, components } => write!(f, "vec{components}<{scalar}>"),
            Type::Array { len, .. } => write!(f, "array<{}, {len}>", self.element_type()),
            Type::Results => f.write_str("results"),
        }
    }
}

/// Kind and number of components of a glam vector type such as `Vec3` or `IVec2`.
pub fn vector_named(name: &str) -> Option<(Scalar, u8)> {
    let (kind, components) = match name.strip_prefix("Vec") {
        Some(components) => (Scalar::F32, components),
        None => match name.strip_prefix("IVec") {
            Some(components) => (Scalar::I32, components),
            None => (Scalar::U32, name.strip_prefix("UVec")?),
        },
    };
    match components {
        "2" => Some((kind, 2)),
        "3" => Some((kind, 3)),
        "4" => Some((kind, 4)),
        _ => None,
    }
}
