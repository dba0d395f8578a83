//! Types of values, as hosts see them.

#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Type of a value's components: 32 bits each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Scalar {
    /// `f32`.
    F32,
    /// `i32`.
    I32,
    /// `u32`.
    U32,
}

impl Scalar {
    /// `f32`, `i32` or `u32`, in WGSL and in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Scalar::F32 => "f32",
            Scalar::I32 => "i32",
            Scalar::U32 => "u32",
        }
    }

    /// The letter that ends a vector's type in WGSL.
    pub fn letter(self) -> char {
        match self {
            Scalar::F32 => 'f',
            Scalar::I32 => 'i',
            Scalar::U32 => 'u',
        }
    }

    /// Bits of `value` as a number of this type, little-endian, if that can hold it.
    pub fn encode_word(self, value: f64) -> Option<[u8; 4]> {
        if !value.is_finite() {
            return None;
        }
        match self {
            Scalar::F32 => {
                let narrow = value as f32;
                narrow.is_finite().then(|| narrow.to_le_bytes())
            }
            Scalar::I32 => {
                let whole = value as i32;
                (f64::from(whole) == value).then(|| whole.to_le_bytes())
            }
            Scalar::U32 => {
                let whole = value as u32;
                (f64::from(whole) == value).then(|| whole.to_le_bytes())
            }
        }
    }

    fn from_name(name: &str) -> Option<Scalar> {
        [Scalar::F32, Scalar::I32, Scalar::U32]
            .into_iter()
            .find(|scalar| scalar.name() == name)
    }
}

/// Type of a value that passes between host and shader. Its text is WGSL's: `f32`, `vec3i`, `mat3x3f`, `array<vec4f, 3>`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(
    feature = "json",
    derive(Serialize, Deserialize),
    serde(into = "String", try_from = "String")
)]
pub enum ValueType {
    /// A single number.
    Scalar(Scalar),
    /// A vector.
    Vector {
        /// Type of the components.
        of: Scalar,
        /// Number of components, 2 to 4.
        components: u8,
    },
    /// A matrix of `f32`.
    Matrix {
        /// Columns, 2 to 4.
        columns: u8,
        /// Rows, 2 to 4: components of a column.
        rows: u8,
    },
    /// An array of numbers or vectors.
    Array {
        /// Type of the components of an element.
        of: Scalar,
        /// Components of an element: 1 of a number, 2 to 4 of a vector.
        components: u8,
        /// Number of elements, at least 1.
        count: u32,
    },
}

impl ValueType {
    /// A number, or a vector of 2 to 4 components.
    pub fn of(scalar: Scalar, components: u8) -> ValueType {
        match components {
            0 | 1 => ValueType::Scalar(scalar),
            components => ValueType::Vector { of: scalar, components },
        }
    }

    /// Returns the type of the components.
    pub fn scalar(self) -> Scalar {
        match self {
            ValueType::Scalar(of) | ValueType::Vector { of, .. } | ValueType::Array { of, .. } => of,
            ValueType::Matrix { .. } => Scalar::F32,
        }
    }

    /// Components of a part: of a number 1, of a vector all, of a matrix those of a column, of an array those of an element.
    pub fn components(self) -> u8 {
        match self {
            ValueType::Scalar(_) => 1,
            ValueType::Vector { components, .. } | ValueType::Array { components, .. } => components,
            ValueType::Matrix { rows, .. } => rows,
        }
    }

    /// Returns the number of parts: the columns of a matrix, the elements of an array; 1 for all else.
    pub fn parts(self) -> u32 {
        match self {
            ValueType::Scalar(_) | ValueType::Vector { .. } => 1,
            ValueType::Matrix { columns, .. } => columns.into(),
            ValueType::Array { count, .. } => count,
        }
    }

    /// Type of a part: see [`parts`](Self::parts).
    pub fn part(self) -> ValueType {
        ValueType::of(self.scalar(), self.components())
    }

    /// Returns whether this is a number or a vector.
    pub fn is_single(self) -> bool {
        matches!(self, ValueType::Scalar(_) | ValueType::Vector { .. })
    }

    /// Bytes that its components take, without padding between parts.
    pub fn size(self) -> u32 {
        4 * u32::from(self.components()) * self.parts()
    }
}

impl fmt::Display for ValueType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            ValueType::Scalar(of) => f.write_str(of.name()),
            ValueType::Vector { of, components } => write!(f, "vec{components}{}", of.letter()),
            ValueType::Matrix { columns, rows } => write!(f, "mat{columns}x{rows}f"),
            ValueType::Array { count, .. } => write!(f, "array<{}, {count}>", self.part()),
        }
    }
}

/// A text is not the type of a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotAType(pub String);

impl fmt::Display for NotAType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = &self.0;
        write!(
            f,
            "`{text}` is not a 32-bit number or vector, a matrix or an array of these, as WGSL spells them"
        )
    }
}

impl std::error::Error for NotAType {}

impl FromStr for ValueType {
    type Err = NotAType;

    /// Reads a type as WGSL spells it; `vec3<f32>` is `vec3f`.
    fn from_str(text: &str) -> Result<ValueType, NotAType> {
        parse_type(text).ok_or_else(|| NotAType(text.to_owned()))
    }
}

impl TryFrom<String> for ValueType {
    type Error = NotAType;

    fn try_from(text: String) -> Result<ValueType, NotAType> {
        text.parse()
    }
}

impl From<ValueType> for String {
    fn from(ty: ValueType) -> String {
        ty.to_string()
    }
}

fn parse_type(text: &str) -> Option<ValueType> {
    if let Some(scalar) = Scalar::from_name(text) {
        return Some(ValueType::Scalar(scalar));
    }
    if let Some(rest) = text.strip_prefix("vec") {
        let (components, suffix) = parse_side(rest)?;
        let of = parse_component(suffix)?;
        return Some(ValueType::Vector { of, components });
    }
    if let Some(rest) = text.strip_prefix("mat") {
        let (columns, rest) = parse_side(rest)?;
        let (rows, suffix) = parse_side(rest.strip_prefix('x')?)?;
        return (parse_component(suffix)? == Scalar::F32).then_some(ValueType::Matrix { columns, rows });
    }
    let (of, count) = text.strip_prefix("array<")?.strip_suffix('>')?.rsplit_once(',')?;
    let (of, count) = (parse_type(of.trim())?, count.trim().parse().ok()?);
    (of.is_single() && count > 0).then_some(ValueType::Array {
        of: of.scalar(),
        components: of.components(),
        count,
    })
}

/// A number from 2 to 4, and what follows it.
fn parse_side(text: &str) -> Option<(u8, &str)> {
    let first = *text.as_bytes().first()?;
    matches!(first, b'2'..=b'4').then(|| (first - b'0', &text[1..]))
}

/// Parses the component type of a vector or a matrix: `f`, or `<f32>`.
fn parse_component(suffix: &str) -> Option<Scalar> {
    match suffix.strip_prefix('<') {
        Some(name) => Scalar::from_name(name.strip_suffix('>')?),
        None => [Scalar::F32, Scalar::I32, Scalar::U32]
            .into_iter()
            .find(|scalar| suffix == scalar.letter().encode_utf8(&mut [0; 4])),
    }
}

/// Type of the elements of a storage buffer.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "json",
    derive(Serialize, Deserialize),
    serde(into = "String", from = "String")
)]
pub enum Element {
    /// Numbers or vectors.
    Value(ValueType),
    /// Structures of this name, whose fields the binding lists.
    Structure(String),
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Element::Value(ty) => ty.fmt(f),
            Element::Structure(name) => f.write_str(name),
        }
    }
}

impl From<String> for Element {
    fn from(text: String) -> Element {
        match text.parse() {
            Ok(ty) => Element::Value(ty),
            Err(_) => Element::Structure(text),
        }
    }
}

impl From<Element> for String {
    fn from(element: Element) -> String {
        element.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_read_as_they_are_written() {
        for text in [
            "f32",
            "i32",
            "u32",
            "vec2f",
            "vec3i",
            "vec4u",
            "mat2x2f",
            "mat4x3f",
            "array<f32, 3>",
            "array<vec2u, 17>",
        ] {
            assert_eq!(text.parse::<ValueType>().map(|ty| ty.to_string()).as_deref(), Ok(text));
        }
        assert_eq!("vec3<f32>".parse::<ValueType>(), "vec3f".parse());
        assert_eq!("array<vec4<i32>,2>".parse::<ValueType>(), "array<vec4i, 2>".parse());
    }

    #[test]
    fn what_is_no_type_is_refused() {
        for text in [
            "",
            "f",
            "f16",
            "bool",
            "vec",
            "vec5f",
            "vec2",
            "vec2f32",
            "vec2<f32",
            "mat4x4i",
            "mat1x4f",
            "mat4f",
            "vec2é",
            "array<f32>",
            "array<f32, 0>",
            "array<mat2x2f, 2>",
            "array<array<f32, 2>, 2>",
        ] {
            assert_eq!(text.parse::<ValueType>(), Err(NotAType(text.to_owned())), "{text}");
        }
    }

    #[test]
    fn words_are_of_numbers_that_fit() {
        assert_eq!(Scalar::F32.encode_word(0.5), Some(0.5f32.to_le_bytes()));
        assert_eq!(Scalar::I32.encode_word(-3.0), Some((-3i32).to_le_bytes()));
        assert_eq!(Scalar::U32.encode_word(4294967295.0), Some(u32::MAX.to_le_bytes()));
        for (scalar, value) in [
            (Scalar::U32, -1.0),
            (Scalar::I32, 0.5),
            (Scalar::I32, 3e9),
            (Scalar::F32, 1e300),
            (Scalar::F32, f64::NAN),
        ] {
            assert_eq!(scalar.encode_word(value), None, "{scalar:?} {value}");
        }
    }

    #[test]
    fn parts_of_a_type() {
        let of = |text: &str| {
            text.parse::<ValueType>()
                .map(|ty| (ty.part().to_string(), ty.parts(), ty.size()))
        };
        assert_eq!(of("vec3f"), Ok(("vec3f".to_owned(), 1, 12)));
        assert_eq!(of("mat4x3f"), Ok(("vec3f".to_owned(), 4, 48)));
        assert_eq!(of("array<u32, 5>"), Ok(("u32".to_owned(), 5, 20)));
    }
}
