//! Arrays filled by the host.

/// A read-only list of numbers or vectors with at least one element. Bound as a `var<storage, read>` of `array<T>`.
///
/// `T` is `f32`, `i32`, `u32`, or a vector of 2 or 4 of them. Elements are tightly packed.
#[derive(Clone, Debug, PartialEq)]
pub struct Buffer<T> {
    elements: Vec<T>,
}

impl<T: Copy> Buffer<T> {
    /// Creates a buffer from its elements. Panics if there are none.
    pub fn new(elements: Vec<T>) -> Self {
        assert!(!elements.is_empty(), "a buffer needs at least one element");
        Buffer { elements }
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Always `false`: a buffer has at least one element.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// All elements.
    pub fn elements(&self) -> &[T] {
        &self.elements
    }

    /// Returns the element at `index`, or the last one if `index` is out of bounds.
    pub fn load(&self, index: usize) -> T {
        self.elements[index.min(self.elements.len() - 1)]
    }
}
