//! The intermediate representation: a graph of pure operations.
//!
//! # Semantics
//!
//! - A [`Graph`] computes values for each pixel that one invocation has: one pixel, or those of a block, row by row; of each
//!   pixel a value for each of [`Graph::targets`], a colour say ([`Graph::outputs`]). What a host stores of these, and where, is the entry point's affair.
//! - What an invocation computes is stated in [`Graph::invocation`]. Of a block, [`Op::Pixel`] is the upper left pixel,
//!   inside the frame and a multiple of the block's size; others may lie outside, and are not stored.
//! - The invocations of a kernel of quads are [`Invocation::Lane`]s: four of them, at even coordinates, compute in step.
//!   Each stores its own pixel; one that lies outside of the frame computes as the others do, and its [`Op::Pixel`] is
//!   outside. [`Op::QuadSwap`] gives the other lane's bits as they are. A condition, or a bound of a structured loop, is the
//!   same in all lanes of a quad, so that all of them come to every message.
//! - The invocations of a kernel of workgroups ([`Invocation::Group`]) are those of a workgroup, each with its pixel, which may
//!   lie outside of the frame: all of them compute, and what is given for a pixel outside is not stored. Conditions and bounds
//!   around an [`Op::Barrier`] are the same in all of them, so that all come to it. Between two barriers no invocation reads or
//!   writes what another one writes of what they share, but by atomic operations.
//! - A node is a pure, total function of its arguments. It may be evaluated never, once or often, early or
//!   late, with the same result. This holds for reads too: textures and buffers do not change during a dispatch,
//!   and coordinates and indices are clamped by nodes of their own.
//! - Arithmetic is that of WGSL: `f32` rounds to nearest, ties to even, and is never contracted or reassociated
//!   by a pass in exact mode; `i32` and `u32` wrap; a division by zero of integers gives the dividend and its
//!   remainder 0; shifts use the count modulo 32.
//! - Vectors have 2 to 4 lanes. Both sides of a binary operation have the same type: a scalar that meets a
//!   vector is [`Op::Splat`] first.
//! - Arrays are values: [`Op::ArraySet`] gives a new array and leaves the old one as it was. An index out of
//!   range, a negative one too, is that of the last element, for reads and for writes, as in WGSL.
//! - A structured loop is one [`Op::Loop`] node with a [`Region`]. Its arguments are the first counter, the end (not
//!   included) and the initial carried values; the region's parameters are the counter and the carried values,
//!   and its results the carried values of the next iteration. Counter and bounds have one type, `i32` or `u32`, in
//!   which they are compared; from an end that is not above the start there are no iterations. If the region has a
//!   stop, a boolean, and it holds in an iteration, that one is the last: its results are those of the loop. A region
//!   may use any node that is computed outside it. [`Op::Result`] reads the carried values after the last iteration.
//! - [`Op::Undef`] is any value, of which nothing that is looked at depends: what a loop gives for those who did not
//!   leave it early, say.
//! - A kept branch is one [`Op::If`] node with two regions without parameters.
//! - Nodes belong to no region by themselves: where a node is evaluated follows from what it depends on and who
//!   uses it, and is decided in one place, the schedule.
//! - Effects ([`Op::is_effect`]) are not pure: each happens once wherever its region is evaluated, after those before it in
//!   [`Region::effects`], if its condition holds. What it writes, no node reads but effects. Effects of different
//!   invocations come in any order, but for barriers.
//! - Equal nodes are one node (hash-consing), but for effects. Reads carry the site of their call so that they are only shared by
//!   the pass that is there for it.
//!
//! A graph is not changed once built: a pass builds another.

pub mod arith;
mod buffer;
mod exact;
mod graph;
mod memory;
mod op;
mod origin;
mod parse;
mod print;
mod real;
mod rebuild;
mod texture;
mod types;
pub mod verify;

pub use buffer::{Access, Buffer, Element, Field, Structure};
pub use graph::{
    Builder, Event, Graph, Invocation, Mark, Node, NodeId, Purpose, Region, RegionId, Rules, Sampler, Target, Uniform,
    UniformPart, Varying,
};
pub use memory::{MOST_SHARED_BYTES, Memory, SharedArray};
pub use op::{AtomicOp, Axis, BinaryOp, Op, QuadDirection, UnaryOp};
pub use origin::{Counter, Naming, Origin};
pub use parse::{ParseError, parse};
pub use print::print;
pub use real::{F16, Real};
pub use rebuild::{Rebuild, Replace, copy_tables, rebuild_graph, rebuild_replacing};
pub use texture::{Texture, TextureKind};
pub use types::{Bits, Scalar, Type, usize_bits, usize_value, vector_named};
