//! Places in the source from which nodes come.

use super::Counter;
use std::sync::Arc;

/// Range of bytes in a source file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Span {
    /// Index of the file in [`Graph::files`](super::Graph::files).
    pub file: u32,
    /// First byte.
    pub start: u32,
    /// Byte after the last one.
    pub end: u32,
    /// Line of the first byte, from 1.
    pub line: u32,
    /// Column of the first byte in characters, from 1.
    pub column: u32,
}

impl Span {
    /// File index of locations inside the built-in library, which is no file of a kernel.
    pub const LIBRARY: u32 = u32::MAX;
}

/// Expression of the source that a node computes, and the iteration of the unrolled loops around it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// The expression.
    pub span: Span,
    /// Counters of the enclosing unrolled loops, outermost first.
    pub counters: Arc<[Counter]>,
}
