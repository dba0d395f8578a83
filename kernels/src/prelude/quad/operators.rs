//! Operators: lane by lane with another quad, or with one value for all lanes.

use super::Quad;
use glam::{IVec2, IVec3, IVec4, UVec2, Vec2, Vec3, Vec4};
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Rem, Sub, SubAssign};

macro_rules! of_quads {
    ($($op:ident $method:ident),*) => { $(
        impl<T: Copy + $op<U>, U: Copy> $op<Quad<U>> for Quad<T>
        where
            T::Output: Copy,
        {
            type Output = Quad<T::Output>;

            fn $method(self, other: Quad<U>) -> Self::Output {
                self.zip(other, T::$method)
            }
        }
    )* };
}

of_quads! { Add add, Sub sub, Mul mul, Div div, Rem rem, BitAnd bitand, BitOr bitor }

macro_rules! with_one {
    ($ty:ty: $($op:ident $method:ident),*) => { $(
        impl<T: Copy + $op<$ty>> $op<$ty> for Quad<T>
        where
            T::Output: Copy,
        {
            type Output = Quad<T::Output>;

            fn $method(self, other: $ty) -> Self::Output {
                self.map(|lane| T::$method(lane, other))
            }
        }
    )* };
}

/// Operators of one value and a quad. Each pair of types is written out: with a generic bound, rustc would look for quads of
/// quads wherever a number's type is not yet known.
macro_rules! one_and_quad {
    ($ty:ty: $lane:ty => $result:ty: $($op:ident $method:ident),*) => { $(
        impl $op<Quad<$lane>> for $ty {
            type Output = Quad<$result>;

            fn $method(self, other: Quad<$lane>) -> Self::Output {
                other.map(|lane| <$ty as $op<$lane>>::$method(self, lane))
            }
        }
    )* };
}

macro_rules! numbers {
    ($($ty:ty: $($vector:ty)*;)*) => { $(
        with_one! { $ty: Add add, Sub sub, Mul mul, Div div, Rem rem }
        one_and_quad! { $ty: $ty => $ty: Add add, Sub sub, Mul mul, Div div, Rem rem }
        $(
            with_one! { $vector: Add add, Sub sub, Mul mul, Div div, Rem rem }
            one_and_quad! { $vector: $vector => $vector: Add add, Sub sub, Mul mul, Div div, Rem rem }
            one_and_quad! { $ty: $vector => $vector: Add add, Sub sub, Mul mul, Div div, Rem rem }
            one_and_quad! { $vector: $ty => $vector: Add add, Sub sub, Mul mul, Div div, Rem rem }
        )*
    )* };
}

numbers! {
    f32: Vec2 Vec3 Vec4;
    i32: IVec2 IVec3 IVec4;
    u32: UVec2;
}
with_one! { bool: BitAnd bitand, BitOr bitor }
one_and_quad! { bool: bool => bool: BitAnd bitand, BitOr bitor }

macro_rules! assigning {
    ($($op:ident $method:ident $plain:ident $call:ident),*) => { $(
        impl<T: Copy, U> $op<U> for Quad<T>
        where
            Quad<T>: $plain<U, Output = Quad<T>>,
        {
            fn $method(&mut self, other: U) {
                *self = $plain::$call(*self, other);
            }
        }
    )* };
}

assigning! { AddAssign add_assign Add add, SubAssign sub_assign Sub sub, MulAssign mul_assign Mul mul }

impl<T: Copy + Neg> Neg for Quad<T> {
    type Output = Quad<T::Output>;

    fn neg(self) -> Self::Output {
        self.map(T::neg)
    }
}

impl Not for Quad<bool> {
    type Output = Quad<bool>;

    fn not(self) -> Self::Output {
        self.map(bool::not)
    }
}

impl<T: Copy> From<T> for Quad<T> {
    fn from(value: T) -> Self {
        Quad::splat(value)
    }
}
