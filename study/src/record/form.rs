//! Forms of a kernel.

use serde::{Deserialize, Serialize};

/// Form of a kernel, of its loops above all: to be timed, and to be compiled for GPUs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FormKind {
    /// Loops left in the shader, as wgpu compiles them: with a bound on the iterations of each. The baseline of all
    /// comparisons.
    Looped,
    /// Loops left in the shader, without that bound.
    LoopedUnchecked,
    /// Hand-optimised loops: repeated reads are done once, into arrays.
    #[serde(alias = "by-hand")]
    LoopedByHand,
    /// Hand-optimised loops without the bound, so that compilers can unroll them.
    LoopedByHandUnchecked,
    /// Loops left with two iterations in a row.
    Partial2,
    /// Loops left with four iterations in a row.
    Partial4,
    /// No loop left; each read as often as the source performs it.
    FullUnshared,
    /// No loop left; each distinct read once.
    #[serde(alias = "unrolled")]
    Full,
    /// As `Full`, with 2x2 pixels per invocation.
    #[serde(alias = "block")]
    FullBlock,
    /// As `Full`, with reads shared by the pixels of a workgroup through its memory.
    #[serde(alias = "tile")]
    FullTile,
    /// As `Full`, with gathers: four texels in one read, where several of them are needed.
    #[serde(alias = "gather")]
    FullGather,
    /// As `Full`, with mathematics that may change roundings.
    #[serde(alias = "fast")]
    FullFast,
    /// As `Full`, computed in half precision.
    FullHalf,
    /// The reads and the store of `Full`, with almost no arithmetic between: a lower bound for every form.
    Floor,
    /// Straight-line code that Slang's compiler makes for the same work.
    Slang,
}

impl FormKind {
    /// Every form of our own, in the order of tables.
    pub const ALL: [FormKind; 14] = [
        FormKind::Looped,
        FormKind::LoopedUnchecked,
        FormKind::LoopedByHand,
        FormKind::LoopedByHandUnchecked,
        FormKind::Partial2,
        FormKind::Partial4,
        FormKind::FullUnshared,
        FormKind::Full,
        FormKind::FullBlock,
        FormKind::FullTile,
        FormKind::FullGather,
        FormKind::FullFast,
        FormKind::FullHalf,
        FormKind::Floor,
    ];

    /// Returns whether wgpu must not bound the loops of the form.
    pub fn is_unbounded(self) -> bool {
        matches!(self, FormKind::LoopedUnchecked | FormKind::LoopedByHandUnchecked)
    }

    /// A name for people.
    pub fn display_name(self) -> &'static str {
        match self {
            FormKind::Looped => "looped",
            FormKind::LoopedUnchecked => "looped, unbounded",
            FormKind::LoopedByHand => "looped, hand-optimised",
            FormKind::LoopedByHandUnchecked => "hand-optimised, unbounded",
            FormKind::Partial2 => "partial(2)",
            FormKind::Partial4 => "partial(4)",
            FormKind::FullUnshared => "unrolled, loads not shared",
            FormKind::Full => "unrolled",
            FormKind::FullBlock => "unrolled, 2×2 pixels",
            FormKind::FullTile => "unrolled, shared by workgroups",
            FormKind::FullGather => "unrolled, gathered",
            FormKind::FullFast => "unrolled, fast mathematics",
            FormKind::FullHalf => "unrolled, f16",
            FormKind::Floor => "floor",
            FormKind::Slang => "unrolled, by Slang",
        }
    }
}
