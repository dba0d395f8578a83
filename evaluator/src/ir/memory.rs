//! Memory that a kernel writes: host buffers and images, and the shared memory of a workgroup.

use super::Type;

/// Memory that an effect works on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Memory {
    /// A buffer, by index into `Graph::buffers`.
    Buffer(u32),
    /// Workgroup memory, by index into `Graph::shared`.
    Shared(u32),
    /// An image, by index into `Graph::images`.
    Image(u32),
}

/// Bytes of workgroup memory that every device supports.
pub const MOST_SHARED_BYTES: u64 = 16_384;

/// An array shared by the invocations of a workgroup. All elements are 0 at the start, and no host binds it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SharedArray {
    /// Name in the kernel.
    pub name: String,
    /// A numeric scalar or vector.
    pub element: Type,
    /// Number of elements, at least 1.
    pub len: u32,
    /// `true` if only atomic operations change the elements.
    pub atomic: bool,
    /// `true` if the invocations write every element before any is read, so that no initialisation to 0 is needed.
    pub filled: bool,
}

impl SharedArray {
    /// Size in bytes in workgroup memory. As in WGSL, a vector of three components takes the space of four.
    pub fn byte_size(&self) -> u64 {
        let lanes = match self.element.component_count() {
            3 => 4,
            lanes => u64::from(lanes),
        };
        u64::from(self.len) * 4 * lanes
    }
}
