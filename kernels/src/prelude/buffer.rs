//! Arrays that a host fills.

/// A read-only list of numbers or vectors, at least one. Bound as a `var<storage, read>` of `array<T>`.
///
/// `T` is `f32`, `i32`, `u32`, or a vector of 2 or 4 of them: elements lie one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Buffer<T> {
    elements: Vec<T>,
}

impl<T: Copy> Buffer<T> {
    /// A buffer of its elements. Panics unless there is at least one.
    pub fn new(elements: Vec<T>) -> Self {
        assert!(!elements.is_empty(), "a buffer needs at least one element");
        Buffer { elements }
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Never: a buffer has at least one element.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// All elements.
    pub fn elements(&self) -> &[T] {
        &self.elements
    }

    /// The element at `index`, or the last one beyond the end.
    pub fn load(&self, index: usize) -> T {
        self.elements[index.min(self.elements.len() - 1)]
    }
}
