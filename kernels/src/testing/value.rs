//! Arguments of properties, read from the bits of a case.

use crate::properties::{Argument, Component};
use glam::{IVec2, IVec3, IVec4, UVec2, UVec3, UVec4, Vec2, Vec3, Vec4};

/// The components of a case that have not been read yet.
pub struct Bits<'a>(pub(super) std::slice::Iter<'a, u32>);

impl Bits<'_> {
    fn next(&mut self) -> u32 {
        self.0.next().copied().unwrap_or(0)
    }
}

/// A type that arguments of a property may have.
pub trait Value {
    /// The argument of this type.
    const ARGUMENT: Argument;

    /// Reads a value from its bits.
    fn read(bits: &mut Bits<'_>) -> Self;
}

macro_rules! numbers {
    ($($number:ty, $component:ident, $bits:ident => $value:expr;)*) => {$(
        impl Value for $number {
            const ARGUMENT: Argument = Argument::new(Component::$component, 1);

            fn read(bits: &mut Bits<'_>) -> Self {
                let $bits = bits.next();
                $value
            }
        }
    )*};
}

numbers! {
    f32, F32, bits => f32::from_bits(bits);
    i32, I32, bits => bits as i32;
    u32, U32, bits => bits;
    bool, Bool, bits => bits != 0;
}

macro_rules! vectors {
    ($($vector:ty, $component:ident, $width:literal;)*) => {$(
        impl Value for $vector {
            const ARGUMENT: Argument = Argument::new(Component::$component, $width);

            fn read(bits: &mut Bits<'_>) -> Self {
                Self::from_array(std::array::from_fn(|_| Value::read(bits)))
            }
        }
    )*};
}

vectors! {
    Vec2, F32, 2;
    Vec3, F32, 3;
    Vec4, F32, 4;
    IVec2, I32, 2;
    IVec3, I32, 3;
    IVec4, I32, 4;
    UVec2, U32, 2;
    UVec3, U32, 3;
    UVec4, U32, 4;
}

impl<T: Value, const N: usize> Value for [T; N] {
    const ARGUMENT: Argument = Argument {
        elements: Some(N),
        ..T::ARGUMENT
    };

    fn read(bits: &mut Bits<'_>) -> Self {
        std::array::from_fn(|_| T::read(bits))
    }
}
