//! Memory that a kernel writes: buffers and pictures of the host's, and what the invocations of a workgroup share.

use super::Type;

/// Memory that an effect works on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Memory {
    /// A buffer, by index into `Graph::buffers`.
    Buffer(u32),
    /// Workgroup memory, by index into `Graph::shared`.
    Shared(u32),
    /// A picture of the frame's size, by index into `Graph::images`.
    Image(u32),
}

/// Bytes that every device has for what a workgroup shares.
pub const MOST_SHARED_BYTES: u64 = 16_384;

/// An array that the invocations of a workgroup share; all 0 when they begin. It is bound by no host.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SharedArray {
    /// Name in the kernel.
    pub name: String,
    /// A scalar or a vector, of numbers.
    pub element: Type,
    /// Number of its elements, at least 1.
    pub len: u32,
    /// `true` if its elements are changed by atomic operations alone.
    pub atomic: bool,
    /// `true` if the invocations write every element before any of them reads one, so that it need not be 0 first.
    pub filled: bool,
}

impl SharedArray {
    /// Bytes that it takes in a workgroup's memory: as WGSL lays it out, a vector of three lies as one of four does.
    pub fn byte_size(&self) -> u64 {
        let lanes = match self.element.component_count() {
            3 => 4,
            lanes => u64::from(lanes),
        };
        u64::from(self.len) * 4 * lanes
    }
}
