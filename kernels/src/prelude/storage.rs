//! Arrays and pictures that a kernel writes.

use glam::{IVec2, UVec2};
use std::fmt;
use std::sync::atomic::{AtomicI32, AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What an [`AtomicBuffer`] holds: `u32` or `i32`.
pub trait AtomicElement: Copy + Default {
    /// Rust's own atomic type of it.
    type Cell: From<Self> + fmt::Debug + Send + Sync;
    /// What is there now.
    fn load(cell: &Self::Cell) -> Self;
    /// Puts something else there, and gives what was there.
    fn exchange(cell: &Self::Cell, value: Self) -> Self;
    /// Adds, around the ends of the type, and gives what was there.
    fn add(cell: &Self::Cell, value: Self) -> Self;
    /// Leaves the larger of the two, and gives what was there.
    fn max(cell: &Self::Cell, value: Self) -> Self;
    /// Leaves the smaller of the two, and gives what was there.
    fn min(cell: &Self::Cell, value: Self) -> Self;
    /// Leaves the bits of both, and gives what was there.
    fn and(cell: &Self::Cell, value: Self) -> Self;
    /// Leaves the bits of either, and gives what was there.
    fn or(cell: &Self::Cell, value: Self) -> Self;
    /// Leaves the bits of one alone, and gives what was there.
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

/// What is done to an element of atomics at once: methods of an index and a value, which give what was there before.
macro_rules! operations {
    ({ $($of:tt)* } $element:ty) => {
        operations! { { $($of)* } $element;
            /// Puts `value` there.
            exchange;
            /// Adds `value`, around the ends of the type.
            add;
            /// Leaves the larger of what is there and `value`.
            max;
            /// Leaves the smaller of what is there and `value`.
            min;
            /// Leaves the bits that both have.
            and;
            /// Leaves the bits that either has.
            or;
            /// Leaves the bits that one alone has.
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

/// A list of `u32` or `i32`, at least one, that all pixels change together, each change at once. Bound as a
/// `var<storage, read_write>` of `array<atomic<T>>`.
///
/// Each method gives what was there before. At an index beyond the end nothing happens, and 0 is given. In which order pixels
/// come is not said: sums, bits, the largest and the smallest do not depend on it, but what is given before does.
#[derive(Debug)]
pub struct AtomicBuffer<T: AtomicElement> {
    elements: Vec<T::Cell>,
}

impl<T: AtomicElement> AtomicBuffer<T> {
    /// A buffer of its elements. Panics unless there is at least one.
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

    /// Never: a buffer has at least one element.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// All elements as they are now.
    pub fn elements(&self) -> Vec<T> {
        self.elements.iter().map(T::load).collect()
    }

    fn at(&self, index: usize, change: impl FnOnce(&T::Cell) -> T) -> T {
        self.elements.get(index).map_or_else(T::default, change)
    }

    /// What is at `index` now.
    pub fn load(&self, index: usize) -> T {
        self.at(index, T::load)
    }
}

/// A list of numbers or vectors, at least one, that a kernel writes and does not read. Bound as a `var<storage, read_write>` of
/// `array<T>`.
///
/// `T` is `f32`, `i32`, `u32`, or a vector of 2 or 4 of them. What is stored beyond the end is dropped. Of two pixels that
/// store at one index either may come last.
#[derive(Debug)]
pub struct StorageBuffer<T> {
    elements: Mutex<Vec<T>>,
}

impl<T: Copy> StorageBuffer<T> {
    /// A buffer of its elements. Panics unless there is at least one.
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

    /// Never: a buffer has at least one element.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// All elements as they are now.
    pub fn elements(&self) -> Vec<T> {
        self.locked().clone()
    }

    /// Puts `value` at `index`.
    pub fn store(&self, index: usize, value: T) {
        if let Some(place) = self.locked().get_mut(index) {
            *place = value;
        }
    }
}

/// A picture of the frame's size that a kernel writes at any place and does not read. Bound as a `texture_storage_2d`, beside those
/// of what the kernel gives for its own pixel.
///
/// `T` is `f32`, `i32`, `u32`, or a vector of them. What is stored outside of the frame is dropped. Of two pixels that store at one
/// place either may come last; where none does, the picture stays what it was.
#[derive(Debug)]
pub struct StorageTexture<T> {
    size: UVec2,
    texels: Mutex<Vec<T>>,
}

impl<T: Copy + Default> StorageTexture<T> {
    /// A picture of zeros.
    pub fn new(size: UVec2) -> Self {
        StorageTexture {
            size,
            texels: Mutex::new(vec![T::default(); size.element_product() as usize]),
        }
    }

    /// Width and height.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// All texels as they are now, row by row.
    pub fn texels(&self) -> Vec<T> {
        self.texels.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Puts `texel` at a place.
    pub fn store(&self, at: IVec2, texel: T) {
        if at.cmpge(IVec2::ZERO).all() && at.as_uvec2().cmplt(self.size).all() {
            let [x, y] = at.as_uvec2().to_array();
            let mut texels = self.texels.lock().unwrap_or_else(PoisonError::into_inner);
            texels[(y * self.size.x + x) as usize] = texel;
        }
    }
}
