//! Values for uniforms.

use std::fmt;
use straightline_manifest::{Scalar, ValueType};

/// Components of the largest value that needs no allocation: a 4x4 matrix.
const INLINE: usize = 16;

/// A value for a uniform: a number, a vector, a matrix, or an array of numbers or vectors.
///
/// Made by `From` of `f32`, `i32` and `u32`; of arrays of two to four of them, which are vectors; and of arrays of
/// two to four arrays of two to four `f32`, which are the columns of a matrix. Other arrays are made by
/// [`array`](Self::array) and [`vectors`](Self::vectors).
#[derive(Clone, PartialEq, Eq)]
pub struct UniformValue {
    ty: ValueType,
    words: Words,
}

/// Components one after the other, as a shader has them.
#[derive(Clone, PartialEq, Eq)]
enum Words {
    Few([[u8; 4]; INLINE], usize),
    Many(Vec<[u8; 4]>),
}

/// A number that can be the component of a uniform.
pub trait Component: Copy {
    /// Scalar type of the number in a shader.
    const SCALAR: Scalar;

    /// Returns the bits, little-endian.
    fn word(self) -> [u8; 4];
}

macro_rules! components {
    ($($number:ty: $scalar:ident),*) => {$(
        impl Component for $number {
            const SCALAR: Scalar = Scalar::$scalar;

            fn word(self) -> [u8; 4] {
                self.to_le_bytes()
            }
        }

        impl From<$number> for UniformValue {
            fn from(value: $number) -> Self {
                UniformValue::filled(ValueType::Scalar(Scalar::$scalar), [value].into_iter())
            }
        }

        components!(vectors $number, 2, 3, 4);
    )*};
    (vectors $number:ty, $($n:literal),*) => {$(
        impl From<[$number; $n]> for UniformValue {
            fn from(value: [$number; $n]) -> Self {
                UniformValue::filled(ValueType::of(<$number>::SCALAR, $n), value.into_iter())
            }
        }
    )*};
}

components!(f32: F32, i32: I32, u32: U32);

macro_rules! matrices {
    ($($columns:literal x $rows:literal),*) => {$(
        impl From<[[f32; $rows]; $columns]> for UniformValue {
            fn from(value: [[f32; $rows]; $columns]) -> Self {
                let ty = ValueType::Matrix { columns: $columns, rows: $rows };
                UniformValue::filled(ty, value.into_iter().flatten())
            }
        }
    )*};
}

matrices!(2 x 2, 2 x 3, 2 x 4, 3 x 2, 3 x 3, 3 x 4, 4 x 2, 4 x 3, 4 x 4);

impl UniformValue {
    /// An array of numbers. `None` of an empty one.
    pub fn array<T: Component>(elements: &[T]) -> Option<Self> {
        UniformValue::from_elements(elements.len(), 1, elements.iter().copied())
    }

    /// An array of vectors of two to four components. `None` of an empty one, and of other numbers of components.
    pub fn vectors<T: Component, const N: usize>(elements: &[[T; N]]) -> Option<Self> {
        let fits = (2..=4).contains(&N);
        let components = u8::try_from(N).ok().filter(|_| fits)?;
        UniformValue::from_elements(elements.len(), components, elements.iter().flatten().copied())
    }

    /// A value of any type, of the bits of its components in order: of a matrix column by column, of an array element by element,
    /// without padding. `None` if they are not as many as the type has.
    pub fn from_words(ty: ValueType, words: &[[u8; 4]]) -> Option<Self> {
        let fits = words.len() * 4 == ty.size() as usize;
        fits.then(|| UniformValue {
            ty,
            words: words.iter().copied().collect(),
        })
    }

    /// The value's type.
    pub fn ty(&self) -> ValueType {
        self.ty
    }

    /// The bits of its components in order, without padding.
    pub fn words(&self) -> &[[u8; 4]] {
        match &self.words {
            Words::Few(words, count) => &words[..*count],
            Words::Many(words) => words,
        }
    }

    /// Bytes of a part: of the value itself, of a column, of an element. No parts beyond the last.
    pub(crate) fn part_bytes(&self, index: u32) -> &[u8] {
        let each = usize::from(self.ty.components());
        let words = self.words().chunks_exact(each).nth(index as usize);
        words.map_or(&[], <[[u8; 4]]>::as_flattened)
    }

    fn from_elements<T: Component>(count: usize, components: u8, numbers: impl Iterator<Item = T>) -> Option<Self> {
        let count = u32::try_from(count).ok().filter(|count| *count > 0)?;
        let ty = ValueType::Array {
            of: T::SCALAR,
            components,
            count,
        };
        Some(UniformValue::filled(ty, numbers))
    }

    fn filled<T: Component>(ty: ValueType, numbers: impl Iterator<Item = T>) -> Self {
        let words = numbers.map(T::word).collect();
        UniformValue { ty, words }
    }
}

impl FromIterator<[u8; 4]> for Words {
    fn from_iter<I: IntoIterator<Item = [u8; 4]>>(words: I) -> Self {
        let mut few = [[0; 4]; INLINE];
        let mut words = words.into_iter();
        for (count, place) in few.iter_mut().enumerate() {
            match words.next() {
                Some(word) => *place = word,
                None => return Words::Few(few, count),
            }
        }
        match words.next() {
            None => Words::Few(few, INLINE),
            Some(next) => Words::Many(few.into_iter().chain([next]).chain(words).collect()),
        }
    }
}

impl fmt::Debug for UniformValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut list = f.debug_list();
        for word in self.words() {
            match self.ty.scalar() {
                Scalar::F32 => list.entry(&f32::from_le_bytes(*word)),
                Scalar::I32 => list.entry(&i32::from_le_bytes(*word)),
                Scalar::U32 => list.entry(&u32::from_le_bytes(*word)),
            };
        }
        list.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_lie_component_by_component() {
        let value = UniformValue::from([1u32, 2, 3]);
        assert_eq!(value.ty().to_string(), "vec3u");
        assert_eq!(value.part_bytes(0), [1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0]);
        let matrix = UniformValue::from([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]);
        assert_eq!(matrix.ty().to_string(), "mat3x2f");
        assert_eq!(matrix.part_bytes(2), [5.0f32, 6.0].map(f32::to_le_bytes).as_flattened());
        assert!(matrix.part_bytes(3).is_empty());
        let array: Vec<i32> = (0..40).collect();
        let array = UniformValue::array(&array).expect("elements");
        assert_eq!(
            (array.ty().to_string().as_str(), array.words().len()),
            ("array<i32, 40>", 40)
        );
        assert_eq!(array.part_bytes(39), 39i32.to_le_bytes());
        assert_eq!(
            format!("{:?}", UniformValue::vectors(&[[1.0, 2.5]])),
            "Some([1.0, 2.5])"
        );
    }

    #[test]
    fn what_has_no_type_is_no_value() {
        assert_eq!(UniformValue::array::<f32>(&[]), None);
        assert_eq!(UniformValue::vectors(&[[1.0; 5]]), None);
        let ty = ValueType::of(Scalar::F32, 3);
        assert_eq!(UniformValue::from_words(ty, &[[0; 4]; 2]), None);
        assert_eq!(UniformValue::from_words(ty, &[[0; 4]; 3]), Some([0.0; 3].into()));
    }
}
