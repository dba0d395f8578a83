//! The intermediate representation: a graph of pure operations.
//!
//! # Semantics
//!
//! - A [`Graph`] computes values for each pixel of one invocation: a single pixel, or those of a block, row by row. For
//!   each pixel there is a value for each of [`Graph::targets`], such as a colour ([`Graph::outputs`]). The entry point
//!   decides which of these a host stores, and where.
//! - [`Graph::invocation`] states what an invocation computes. For a block, [`Op::Pixel`] is the upper left pixel. That
//!   pixel lies inside the frame at a multiple of the block's size; others may lie outside, and are not stored.
//! - The invocations of a quad kernel are [`Invocation::Lane`]s: four of them, at even coordinates, compute in step. Each
//!   stores its own pixel. A lane outside the frame computes like the others, and its [`Op::Pixel`] lies outside.
//!   [`Op::QuadSwap`] returns the other lane's bits unchanged. Conditions and bounds of structured loops are the same in
//!   all lanes of a quad, so that all of them reach every swap.
//! - The invocations of a workgroup kernel ([`Invocation::Group`]) are those of a workgroup, each with its own pixel, which
//!   may lie outside the frame: all of them compute, and results for pixels outside are not stored. Conditions and bounds
//!   around an [`Op::Barrier`] are the same in all of them, so that all reach it. Between two barriers, no invocation reads
//!   or writes shared memory that another one writes, except by atomic operations.
//! - A node is a pure, total function of its arguments. It may be evaluated never, once or several times, early or late,
//!   with the same result. This holds for reads too: textures and buffers do not change during a dispatch, and separate
//!   nodes clamp coordinates and indices.
//! - Arithmetic is that of WGSL. `f32` rounds to nearest, ties to even, and no pass in exact mode contracts or reassociates
//!   it. `i32` and `u32` wrap. Integer division by zero returns the dividend, with remainder 0. Shifts use the count modulo
//!   32.
//! - Vectors have 2 to 4 components. Both sides of a binary operation have the same type: a scalar that meets a vector is
//!   [`Op::Splat`] first.
//! - Arrays are values: [`Op::ArraySet`] returns a new array and leaves the old one unchanged. An index out of range,
//!   including a negative one, refers to the last element, for reads and for writes, as in WGSL.
//! - A structured loop is one [`Op::Loop`] node with a [`Region`]. Its arguments are the first counter, the end (exclusive)
//!   and the initial carried values. The region's parameters are the counter and the carried values, and its results are
//!   the carried values of the next iteration. Counter and bounds have one type, `i32` or `u32`, in which they are
//!   compared; there are no iterations unless the end is above the start. If the region has a stop, a boolean, and it holds
//!   in an iteration, that iteration is the last: its results are those of the loop. A region may use any node that is
//!   computed outside it. [`Op::Result`] reads the carried values after the last iteration.
//! - [`Op::Undef`] is an undefined value. No used result depends on it: for example, the values that a loop returns for an
//!   early exit that was not taken.
//! - A branch in the shader is one [`Op::If`] node with two regions without parameters.
//! - A node does not belong to a fixed region. Its arguments and users determine where it is evaluated; only the schedule
//!   decides that.
//! - Effects ([`Op::is_effect`]) are not pure. Each happens once whenever its region is evaluated, after the effects before
//!   it in [`Region::effects`], if its condition holds. Only other effects read what an effect writes. Effects of different
//!   invocations are unordered, except by barriers.
//! - Equal nodes are one node (hash-consing), except for effects. Reads carry the site of their call, so that only the pass
//!   for that purpose shares them.
//!
//! A graph is immutable once built: a pass builds a new one.

pub mod arith;
mod buffer;
mod exact;
mod graph;
mod memory;
mod op;
mod origin;
mod parse;
mod place;
mod print;
mod real;
mod rebuild;
mod texture;
mod types;
pub mod verify;

pub use buffer::{Access, Buffer, Element, Field, Structure};
pub use graph::{
    Builder, Event, Graph, Invocation, Mark, Node, NodeId, OutputTarget, Override, Purpose, Region, RegionId, Rules,
    Sampler, Uniform, UniformPart, Varying,
};
pub use memory::{MOST_SHARED_BYTES, Memory, SharedArray};
pub use op::{AtomicOp, Axis, BinaryOp, Op, QuadDirection, UnaryOp};
pub use origin::{Counter, Naming, Origin};
pub use parse::{ParseError, parse};
pub use place::{Place, Span};
pub use print::print;
pub use real::{F16, Real};
pub use rebuild::{Rebuild, Replace, copy_tables, rebuild_graph, rebuild_replacing};
pub use texture::{Texture, TextureKind};
pub use types::{Bits, Scalar, Type, usize_bits, usize_value, vector_named};
