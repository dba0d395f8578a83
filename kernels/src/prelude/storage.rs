//! Arrays and pictures written by a kernel.

use glam::{IVec2, UVec2};
use std::fmt;
use std::sync::atomic::{AtomicI32, AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Element type of an [`AtomicBuffer`]: `u32` or `i32`.
pub trait AtomicElement: Copy + Default {
    /// Rust's atomic type for it.
    type Cell: From<Self> + fmt::Debug + Send + Sync;
    /// Returns the current value.
    fn load(cell: &Self::Cell) -> Self;
    /// Stores `value` and returns the previous value.
    fn exchange(cell: &Self::Cell, value: Self) -> Self;
    /// Adds `value`, wrapping on overflow, and returns the previous value.
    fn add(cell: &Self::Cell, value: Self) -> Self;
    /// Stores the larger of the two and returns the previous value.
    fn max(cell: &Self::Cell, value: Self) -> Self;
    /// Stores the smaller of the two and returns the previous value.
    fn min(cell: &Self::Cell, value: Self) -> Self;
    /// Stores the bitwise AND and returns the previous value.
    fn and(cell: &Self::Cell, value: Self) -> Self;
    /// Stores the bitwise OR and returns the previous value.
    fn or(cell: &Self::Cell, value: Self) -> Self;
    /// Stores the bitwise XOR and returns the previous value.
    fn xor(cell: &Self::Cell, value: Self) -> Self;
}

macro_rules! element {
    ($ty:ty, $cell:ty) => {
        impl AtomicElement for $ty {
            type Cell = $cell;
            fn load(cell: &$cell) -> $ty {
                cell.load(Ordering::Relaxed)
            }
            fn exchange(cell: &$cell, value: $ty) -> $ty {
                cell.swap(value, Ordering::Relaxed)
            }
            fn add(cell: &$cell, value: $ty) -> $ty {
                cell.fetch_add(value, Ordering::Relaxed)
            }
            fn max(cell: &$cell, value: $ty) -> $ty {
                cell.fetch_max(value, Ordering::Relaxed)
            }
            fn min(cell: &$cell, value: $ty) -> $ty {
                cell.fetch_min(value, Ordering::Relaxed)
            }
            fn and(cell: &$cell, value: $ty) -> $ty {
                cell.fetch_and(value, Ordering::Relaxed)
            }
            fn or(cell: &$cell, value: $ty) -> $ty {
                cell.fetch_or(value, Ordering::Relaxed)
            }
            fn xor(cell: &$cell, value: $ty) -> $ty {
                cell.fetch_xor(value, Ordering::Relaxed)
            }
        }
    };
}

element!(u32, AtomicU32);
element!(i32, AtomicI32);

/// Read-modify-write operations on an element: methods that take an index and a value and return the previous value.
macro_rules! operations {
    ({ $($of:tt)* } $element:ty) => {
        operations! { { $($of)* } $element;
            /// Stores `value`.
            exchange;
            /// Adds `value`, wrapping on overflow.
            add;
            /// Stores the larger of the element and `value`.
            max;
            /// Stores the smaller of the element and `value`.
            min;
            /// Stores the bitwise AND of the element and `value`.
            and;
            /// Stores the bitwise OR of the element and `value`.
            or;
            /// Stores the bitwise XOR of the element and `value`.
            xor;
        }
    };
    ({ $($of:tt)* } $element:ty; $($(#[$doc:meta])* $name:ident;)*) => {
        $($of)* {
            $(
                $(#[$doc])*
                pub fn $name(&self, index: usize, value: $element) -> $element {
                    self.at(index, |cell| <$element>::$name(cell, value))
                }
            )*
        }
    };
}
pub(super) use operations;

operations!({ impl<T: AtomicElement> AtomicBuffer<T> } T);

/// A list of `u32` or `i32` with at least one element that all pixels modify atomically. Bound as a
/// `var<storage, read_write>` of `array<atomic<T>>`.
///
/// Each method returns the previous value. An index out of bounds has no effect, and 0 is returned. The order of the pixels is
/// unspecified. Sums, bitwise results, the largest and the smallest do not depend on it; the returned previous value does.
#[derive(Debug)]
pub struct AtomicBuffer<T: AtomicElement> {
    elements: Vec<T::Cell>,
}

impl<T: AtomicElement> AtomicBuffer<T> {
    /// Creates a buffer from its elements. Panics if there are none.
    pub fn new(elements: Vec<T>) -> Self {
        assert!(!elements.is_empty(), "a buffer needs at least one element");
        AtomicBuffer {
            elements: elements.into_iter().map(T::Cell::from).collect(),
        }
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Always `false`: a buffer has at least one element.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Current values of all elements.
    pub fn elements(&self) -> Vec<T> {
        self.elements.iter().map(T::load).collect()
    }

    fn at(&self, index: usize, change: impl FnOnce(&T::Cell) -> T) -> T {
        self.elements.get(index).map_or_else(T::default, change)
    }

    /// Returns the current value at `index`.
    pub fn load(&self, index: usize) -> T {
        self.at(index, T::load)
    }
}

/// A list of numbers or vectors with at least one element that a kernel writes and does not read. Bound as a
/// `var<storage, read_write>` of `array<T>`.
///
/// `T` is `f32`, `i32`, `u32`, or a vector of 2 or 4 of them. Stores out of bounds are dropped. If two pixels store at the
/// same index, either value may remain.
#[derive(Debug)]
pub struct StorageBuffer<T> {
    elements: Mutex<Vec<T>>,
}

impl<T: Copy> StorageBuffer<T> {
    /// Creates a buffer from its elements. Panics if there are none.
    pub fn new(elements: Vec<T>) -> Self {
        assert!(!elements.is_empty(), "a buffer needs at least one element");
        StorageBuffer {
            elements: Mutex::new(elements),
        }
    }

    fn locked(&self) -> MutexGuard<'_, Vec<T>> {
        self.elements.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.locked().len()
    }

    /// Always `false`: a buffer has at least one element.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Current values of all elements.
    pub fn elements(&self) -> Vec<T> {
        self.locked().clone()
    }

    /// Stores `value` at `index`.
    pub fn store(&self, index: usize, value: T) {
        if let Some(place) = self.locked().get_mut(index) {
            *place = value;
        }
    }
}

/// A picture of the frame's size that a kernel writes at any position and does not read. Bound as a `texture_storage_2d`, next
/// to those of the kernel's outputs for its own pixel.
///
/// `T` is `f32`, `i32`, `u32`, or a vector of them. Stores outside of the frame are dropped. If two pixels store at the same
/// position, either value may remain. Texels that no pixel stores keep their value.
#[derive(Debug)]
pub struct StorageTexture<T> {
    size: UVec2,
    texels: Mutex<Vec<T>>,
}

impl<T: Copy + Default> StorageTexture<T> {
    /// Creates a picture of zeros.
    pub fn new(size: UVec2) -> Self {
        StorageTexture {
            size,
            texels: Mutex::new(vec![T::default(); size.element_product() as usize]),
        }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// Current values of all texels, row by row.
    pub fn texels(&self) -> Vec<T> {
        self.texels.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Stores `texel` at a position.
    pub fn store(&self, at: IVec2, texel: T) {
        if at.cmpge(IVec2::ZERO).all() && at.as_uvec2().cmplt(self.size).all() {
            let [x, y] = at.as_uvec2().to_array();
            let mut texels = self.texels.lock().unwrap_or_else(PoisonError::into_inner);
            texels[(y * self.size.x + x) as usize] = texel;
        }
    }
}
