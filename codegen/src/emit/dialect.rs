//! What differs between the languages that are emitted here.

use super::text::Text;
use crate::ir::{Axis, BinaryOp, Direction, Scalar, Type, UnaryOp};

/// What is known of the operands of an integer division.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Division {
    /// No component of the divisor can be 0, and no quotient can overflow.
    pub defined: bool,
    /// No component of either side can be negative.
    pub positive: bool,
}

/// A shading language.
pub trait Dialect {
    /// Its name, for messages and templates.
    fn name(&self) -> &'static str;
    /// A type.
    fn ty(&self, ty: Type) -> String;
    /// A scalar constant from its bits.
    fn scalar(&self, kind: Scalar, bits: u32) -> Text;
    /// An immutable local.
    fn immutable(&self, name: &str, ty: Type, value: &str) -> String;
    /// A mutable local; without a value it is undefined until it is assigned.
    fn mutable(&self, name: &str, ty: Type, value: Option<&str>) -> String;
    /// An array at module scope.
    fn table(&self, name: &str, ty: Type, value: &str) -> String;
    /// The head of a loop, up to the opening brace.
    fn loop_head(&self, counter: &str, ty: Type, start: &Text, end: &Text) -> String;
    /// The head of a branch, up to the opening brace.
    fn if_head(&self, condition: &Text) -> String;
    /// A texel of a texture, or sample of one.
    fn load(&self, texture: u32, coord: &Text, layer: Option<&Text>) -> Text;
    /// A texture through a sampler, at its finest level.
    fn sample(&self, texture: u32, sampler: u32, uv: &Text) -> Text;
    /// A component of the four texels around a place.
    fn gather(&self, texture: u32, sampler: u32, component: u8, uv: &Text) -> Text;
    /// A comparison with a reference through a sampler.
    fn compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> Text;
    /// Which of the four depths around a place pass a comparison.
    fn gather_compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> Text;
    /// What another lane of the quad has.
    fn message(&self, direction: Direction, x: &Text) -> Text;
    /// A fine derivative.
    fn derivative(&self, axis: Axis, x: &Text) -> Text;
    /// Width and height of a texture as signed integers.
    fn size(&self, texture: u32) -> Text;
    /// An element of a buffer.
    fn element(&self, buffer: u32, index: &Text) -> Text;
    /// Number of a buffer's elements as a signed integer.
    fn len(&self, buffer: u32) -> Text;
    /// The same bits as another type.
    fn bitcast(&self, from: Type, to: Type, x: &Text) -> Text;
    /// One argument.
    fn unary(&self, op: UnaryOp, ty: Type, x: &Text) -> Text;
    /// Two arguments of a type.
    fn binary(&self, op: BinaryOp, ty: Type, x: &Text, y: &Text) -> Text;
    /// Selection of a value of a type by a scalar boolean.
    fn select(&self, ty: Type, condition: &Text, yes: &Text, no: &Text) -> Text;
    /// A division or remainder of integers, and the function at module scope that it calls, where the operator alone would
    /// not do what Rust and WGSL do. The default is the operator.
    fn divide(&self, _: BinaryOp, _: Type, _: &Text, _: &Text, _: Division) -> Option<(Text, String)> {
        None
    }
    /// Conversion between types of as many lanes. `fits` says of integers that every precision has finite numbers as large,
    /// of floats that the target type has an integer for each of them.
    fn convert(&self, from: Type, to: Type, x: &Text, fits: bool) -> (Text, Option<String>);
    /// An index that stays inside an array of so many elements, where the language itself does not see to it.
    fn inside(&self, index: &Text, _len: u32) -> Text {
        index.clone()
    }
    /// A float that is not finite, where an expression can say it.
    fn non_finite(&self, _bits: u32) -> Option<Text> {
        None
    }
    /// A run-time parameter.
    fn uniform(&self, name: &str) -> Text;
    /// A type as a host lays it out and interpolates it.
    fn outside(&self, ty: Type) -> String {
        self.ty(ty)
    }
    /// A value that was read, as the shader computes with it.
    fn enter(&self, _: Type, x: Text) -> Text {
        x
    }
    /// A value that the shader computed, as reads, messages and the output take it.
    fn leave(&self, _: Type, x: Text) -> Text {
        x
    }

    /// A vector or array from its parts.
    fn construct(&self, ty: Type, parts: &[&Text]) -> Text {
        if ty.kind() == Some(Scalar::Bool) && parts.len() > 1 {
            // `a < b, c > d` would begin a list of template arguments in WGSL.
            let parts: Vec<Text> = parts.iter().map(|part| part.in_parentheses()).collect();
            return Text::call(&self.ty(ty), &parts.iter().collect::<Vec<_>>());
        }
        Text::call(&self.ty(ty), parts)
    }

    /// A constant scalar or vector of finite numbers.
    fn constant(&self, ty: Type, bits: &[u32]) -> Text {
        let kind = ty.kind().unwrap_or(Scalar::F32);
        let lanes = &bits[..ty.lanes() as usize];
        let parts: Vec<Text> = lanes.iter().map(|b| self.scalar(kind, *b)).collect();
        self.vector(ty, &parts)
    }

    /// A constant from the texts of its components: one that is the same in all is written once.
    fn vector(&self, ty: Type, parts: &[Text]) -> Text {
        if parts.len() == 1 {
            return parts[0].clone();
        }
        let same = parts.iter().all(|part| *part == parts[0]);
        let shown: Vec<&Text> = if same { vec![&parts[0]] } else { parts.iter().collect() };
        Text {
            size: 0,
            ..self.construct(ty, &shown)
        }
    }
}

/// A finite float with few digits that every reader takes for the same bits.
pub fn float(bits: u32) -> Text {
    let x = f32::from_bits(bits);
    Text {
        binds: if x.is_sign_negative() {
            super::text::Binds::Prefix
        } else {
            super::text::Binds::Primary
        },
        code: digits(x),
        size: 0,
    }
}

/// The shortest decimal that gives a float back, whether it is read as an `f32` at once or as an `f64` that is then rounded.
/// Tint and glslang read literals as `f64`, and Tint refuses what is larger than the largest `f32` by less than a rounding:
/// such numbers, and those that would be rounded twice, have the digits of the `f64` that equals them.
pub fn digits(x: f32) -> String {
    let short = format!("{x:?}");
    let read = short.parse::<f64>().unwrap_or(f64::NAN);
    if read as f32 == x && read.abs() <= f64::from(f32::MAX) {
        short
    } else {
        format!("{:?}", f64::from(x))
    }
}

/// An integer literal with a suffix.
pub fn integer(n: i64, suffix: &str) -> Text {
    let code = format!("{n}{suffix}");
    Text {
        binds: if n < 0 {
            super::text::Binds::Prefix
        } else {
            super::text::Binds::Primary
        },
        code,
        size: 0,
    }
}

/// Binary operators that both languages write alike, and how tightly they bind. Of booleans `&` and `|` are those of WGSL:
/// operands are pure, and naga makes control flow of `&&` and `||`.
pub fn operator(op: BinaryOp, kind: Scalar) -> Option<(&'static str, super::text::Binds)> {
    use super::text::Binds;
    use BinaryOp::*;
    Some(match op {
        Add => ("+", Binds::Sum),
        Sub => ("-", Binds::Sum),
        Mul => ("*", Binds::Product),
        Div => ("/", Binds::Product),
        Rem => ("%", Binds::Product),
        Eq => ("==", Binds::Comparison),
        Ne => ("!=", Binds::Comparison),
        Lt => ("<", Binds::Comparison),
        Le => ("<=", Binds::Comparison),
        Gt => (">", Binds::Comparison),
        Ge => (">=", Binds::Comparison),
        Xor if kind == Scalar::Bool => ("!=", Binds::Comparison),
        And => ("&", Binds::Mixed),
        Or => ("|", Binds::Mixed),
        Xor => ("^", Binds::Mixed),
        Shl => ("<<", Binds::Mixed),
        Shr => (">>", Binds::Mixed),
        Min | Max | Pow | Atan2 => return None,
    })
}
