//! What differs between the languages that are emitted here.

use super::error::EmitError;
use super::text::Text;
use crate::ir::{Axis, BinaryOp, Direction, Scalar, Type, UnaryOp};

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
    /// A component of the four texels around a place, and a function that this needs at module scope.
    fn gather(&self, texture: u32, sampler: u32, component: u8, uv: &Text) -> (Text, Option<String>);
    /// A comparison with a reference through a sampler.
    fn compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> Text;
    /// Which of the four depths around a place pass a comparison, and a function that this needs at module scope.
    fn gather_compare(&self, texture: u32, sampler: u32, uv: &Text, reference: &Text) -> (Text, Option<String>);
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
    /// Selection by a scalar boolean.
    fn select(&self, condition: &Text, yes: &Text, no: &Text) -> Text;
    /// Conversion between types of as many lanes. `fits` says of integers that every precision has finite numbers as large.
    fn convert(&self, from: Type, to: Type, x: &Text, fits: bool) -> Text;
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
        Text::call(&self.ty(ty), parts)
    }

    /// A constant scalar or vector.
    fn constant(&self, kernel: &str, ty: Type, bits: &[u32]) -> Result<Text, EmitError> {
        let kind = ty.kind().unwrap_or(Scalar::F32);
        let lanes = &bits[..ty.lanes() as usize];
        if kind == Scalar::F32
            && let Some(bad) = lanes.iter().map(|b| f32::from_bits(*b)).find(|x| !x.is_finite())
        {
            return Err(EmitError::Constant {
                kernel: kernel.to_owned(),
                value: bad.to_string(),
                target: self.name(),
            });
        }
        let parts: Vec<Text> = lanes.iter().map(|b| self.scalar(kind, *b)).collect();
        if parts.len() == 1 {
            return Ok(parts[0].clone());
        }
        let same = lanes.iter().all(|b| *b == lanes[0]);
        let shown: Vec<&Text> = if same { vec![&parts[0]] } else { parts.iter().collect() };
        Ok(Text {
            size: 0,
            ..self.construct(ty, &shown)
        })
    }
}

/// A float with the fewest digits that give it back.
pub fn float(bits: u32) -> Text {
    let x = f32::from_bits(bits);
    let code = format!("{x:?}");
    Text {
        binds: if x.is_sign_negative() {
            super::text::Binds::Prefix
        } else {
            super::text::Binds::Primary
        },
        code,
        size: 0,
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

/// Binary operators that both languages write alike, and how tightly they bind.
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
        And if kind == Scalar::Bool => ("&&", Binds::Mixed),
        Or if kind == Scalar::Bool => ("||", Binds::Mixed),
        Xor if kind == Scalar::Bool => ("!=", Binds::Comparison),
        And => ("&", Binds::Mixed),
        Or => ("|", Binds::Mixed),
        Xor => ("^", Binds::Mixed),
        Shl => ("<<", Binds::Mixed),
        Shr => (">>", Binds::Mixed),
        Min | Max | Pow | Atan2 => return None,
    })
}
