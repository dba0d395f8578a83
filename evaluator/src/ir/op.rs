//! Operations.

use super::{Bits, Memory, RegionId};

/// Operation of a node on its arguments.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A constant, by its bits.
    Const(Bits),
    /// An undefined value; no used result depends on it.
    Undef,
    /// Coordinate of the output pixel, `vec2<i32>`, inside the frame.
    Pixel,
    /// Width and height of the frame, `vec2<i32>`, each at least 1.
    FrameSize,
    /// Position of the lane in its quad, `vec2<i32>`, each 0 or 1.
    Lane,
    /// Position of the invocation in its workgroup, `vec2<i32>`, each at least 0 and below the workgroup's size.
    Thread,
    /// The pixel of a workgroup's first invocation, `vec2<i32>`, the same in all of them.
    GroupOrigin,
    /// `true` if the pixel of this workgroup invocation lies inside the frame and must be computed.
    Inside,
    /// The argument's value in the horizontal, vertical or diagonal neighbour lane, bit for bit.
    QuadSwap(QuadDirection),
    /// Fine derivative of a float argument: in both lanes of a row the right value minus the left one, in both lanes of a
    /// column the lower value minus the upper one.
    Derivative(Axis),
    /// A value that the host's rasteriser interpolates for each lane, by index into `Graph::varyings`.
    Varying(u32),
    /// A runtime parameter, by index into `Graph::uniforms`.
    Uniform(u32),
    /// An option that the host sets when it creates the pipeline, by index into `Graph::overrides`.
    Override(u32),
    /// An operation on one argument.
    Unary(UnaryOp),
    /// Two arguments of one type; comparisons return booleans, component by component. For float scalars, `Min` and `Max`
    /// match `f32` and ignore a NaN. For vectors they match glam: the first argument's component where it is less, or
    /// greater, and the second one's otherwise.
    Binary(BinaryOp),
    /// Sum of the products of the components, first to last: two vectors to a scalar.
    Dot,
    /// Cross product of two `vec3<f32>`.
    Cross,
    /// x, low, high, as in Rust: a float scalar that is a NaN stays a NaN (`f32::clamp`); float vectors are
    /// `x.max(low).min(high)` as in glam.
    Clamp,
    /// condition (scalar boolean), value if true, value if false.
    Select,
    /// A scalar in every component.
    Splat,
    /// A vector from its components, each a scalar.
    Compose,
    /// A component of a vector.
    Extract(u8),
    /// A conversion to the node's type, component by component, as in WGSL's value constructors: floats to integers
    /// truncate and saturate.
    Convert,
    /// Reinterprets the bits as another kind of number, component by component.
    Bitcast,
    /// Width and height of a texture's finest level (index into `Graph::textures`), and depth of a volume: a vector of `i32`,
    /// each at least 1.
    TextureSize(u32),
    /// Number of levels of a texture (index into `Graph::textures`), `i32`, at least 1.
    TextureLevels(u32),
    /// Number of layers of a texture (index into `Graph::textures`), `i32`, at least 1.
    TextureLayers(u32),
    /// A texel: coordinate (a vector of `i32`, inside the texture); the layer or sample (`i32`) if there are several; and
    /// the level (`i32`, inside the texture) unless it is the finest. `site` keeps reads of different calls separate until
    /// load sharing sets it to 0.
    Load {
        /// Index into `Graph::textures`.
        texture: u32,
        /// Site of the call, or 0.
        site: u32,
    },
    /// A filtered read of a texture: position (floats from 0 to 1, or a direction), and the layer (`i32`, clamped to the
    /// nearest one) if there are several. Reads the finest level; with one more argument, the level given as `f32`; with
    /// two more, the level for these gradients, of the position's type.
    Sample {
        /// Index into `Graph::textures`.
        texture: u32,
        /// Index into `Graph::samplers`.
        sampler: u32,
        /// As in `Load`.
        site: u32,
    },
    /// A component of each of the four texels around a coordinate (`vec2<f32>`), in a layer (`i32`) if there are several,
    /// as `vec4<f32>`: lower left, lower right, upper right, upper left.
    Gather {
        /// Index into `Graph::textures`.
        texture: u32,
        /// Index into `Graph::samplers`.
        sampler: u32,
        /// Component, 0 to 3.
        component: u8,
        /// As in `Load`.
        site: u32,
    },
    /// Fraction of a depth texture around a position that passes a comparison with a reference (`f32`). Position and layer
    /// are as in `Sample`.
    Compare {
        /// Index into `Graph::textures`.
        texture: u32,
        /// Index into `Graph::samplers`.
        sampler: u32,
        /// As in `Load`.
        site: u32,
    },
    /// Comparison of each of the four depths around a coordinate (`vec2<f32>`) with a reference (`f32`): 1 for those that
    /// pass and 0 for the others, in the components of a `vec4<f32>`, in the order of `Gather`.
    GatherCompare {
        /// Index into `Graph::textures`.
        texture: u32,
        /// Index into `Graph::samplers`.
        sampler: u32,
        /// As in `Load`.
        site: u32,
    },
    /// Number of elements of a buffer (index into `Graph::buffers`), `i32`, at least 1.
    BufferLen(u32),
    /// A part of a buffer element: index (`i32`, inside the buffer), and for a field that is an array the index there
    /// (`i32`, inside the array).
    BufferLoad {
        /// Index into `Graph::buffers`.
        buffer: u32,
        /// Index of the element's field; 0 for an element that is a value.
        field: u32,
        /// As in `Load`.
        site: u32,
    },
    /// Changes an element atomically: condition (scalar boolean), index (`i32`, inside the memory if the condition holds),
    /// and a value of the element's type except for `AtomicOp::Load`. Returns the old value. If the condition does not
    /// hold, returns 0 and does nothing. An effect.
    Atomic {
        /// Memory that is changed.
        memory: Memory,
        /// Operation on the element.
        op: AtomicOp,
    },
    /// Writes an element: condition, index and value, as in `Atomic`. An effect.
    Store(Memory),
    /// An element of shared memory (index into `Graph::shared`): condition (scalar boolean), index (`i32`, inside).
    /// Undefined if the condition does not hold. An effect, because its order among the others matters.
    SharedLoad(u32),
    /// Waits for the other invocations of the workgroup. Their accesses to shared memory before the barrier are visible to
    /// all invocations after it. An effect.
    Barrier {
        /// `true` if writes to buffers become visible too.
        buffers: bool,
    },
    /// The argument, floats, as the operation that computed it rounds it: no compiler may merge, reorder or contract that
    /// operation with others (`docs/semantics.md`, *Exactness*).
    Exact,
    /// The argument, floats, rounded to half precision: to the nearest `f16`, beyond 65504 to an infinity. An operation
    /// whose arguments and result are rounded so is an operation of half precision. In `f64`, the value itself.
    Half,
    /// A value counted by name (index into `Graph::tallies`); returns the value itself.
    Tally(u32),
    /// An array from its elements.
    MakeArray,
    /// array, index (`i32`).
    ArrayGet,
    /// array, index (`i32`), element.
    ArraySet,
    /// start, end (both `i32` or both `u32`), carried values. Ends early if the region's stop holds.
    Loop(RegionId),
    /// condition (scalar boolean). Yields the results of the first region if the condition holds, otherwise those of the
    /// second.
    If(RegionId, RegionId),
    /// A result of a loop or branch.
    Result(u32),
    /// A parameter of a region: 0 is a loop's counter, then the carried values.
    Param(RegionId, u32),
}

/// Value that an atomic operation computes from an element and its operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // named as in WGSL
pub enum AtomicOp {
    Add,
    Max,
    Min,
    And,
    Or,
    Xor,
    Exchange,
    /// Only reads.
    Load,
}

impl AtomicOp {
    /// Every operation.
    pub const ALL: [AtomicOp; 8] = {
        use AtomicOp::*;
        [Add, Max, Min, And, Or, Xor, Exchange, Load]
    };
}

/// Source lane of a quad swap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // named as in GLSL
pub enum QuadDirection {
    Horizontal,
    Vertical,
    Diagonal,
}

impl QuadDirection {
    /// Every direction.
    pub const ALL: [QuadDirection; 3] = [
        QuadDirection::Horizontal,
        QuadDirection::Vertical,
        QuadDirection::Diagonal,
    ];

    /// 1 for each axis along which the source lane is on the other side of the quad, otherwise 0.
    pub fn axis_bits(self) -> [u32; 2] {
        match self {
            QuadDirection::Horizontal => [1, 0],
            QuadDirection::Vertical => [0, 1],
            QuadDirection::Diagonal => [1, 1],
        }
    }
}

/// An axis of the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // named as everywhere
pub enum Axis {
    X,
    Y,
}

/// Operations on one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // named as in WGSL
pub enum UnaryOp {
    Neg,
    Not,
    BitNot,
    Abs,
    Sign,
    Floor,
    Ceil,
    Round,
    Trunc,
    Fract,
    /// Clamps to 0 to 1; 0 for a NaN and for -0.
    Saturate,
    Sqrt,
    InverseSqrt,
    /// Cube root; negative for a negative number.
    Cbrt,
    Exp,
    Exp2,
    Log,
    Log2,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    CountOneBits,
    ReverseBits,
    LeadingZeros,
    TrailingZeros,
}

/// Operations on two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // named as in WGSL
pub enum BinaryOp {
    Add,
    Sub,
    Mul,
    Div,
    Rem,
    Min,
    Max,
    Pow,
    Atan2,
    And,
    Or,
    Xor,
    Shl,
    Shr,
    Eq,
    Ne,
    Lt,
    Le,
    Gt,
    Ge,
}

impl BinaryOp {
    /// Every operation.
    pub const ALL: [BinaryOp; 20] = {
        use BinaryOp::*;
        [
            Add, Sub, Mul, Div, Rem, Min, Max, Pow, Atan2, And, Or, Xor, Shl, Shr, Eq, Ne, Lt, Le, Gt, Ge,
        ]
    };

    /// Returns whether the operation compares, with a boolean result.
    pub fn is_comparison(self) -> bool {
        use BinaryOp::*;
        matches!(self, Eq | Ne | Lt | Le | Gt | Ge)
    }

    /// Returns whether exchanging the arguments changes no bit of the result.
    pub fn is_commutative(self) -> bool {
        use BinaryOp::*;
        matches!(self, Add | Mul | And | Or | Xor | Eq | Ne)
    }
}

impl UnaryOp {
    /// Every operation.
    pub const ALL: [UnaryOp; 31] = {
        use UnaryOp::*;
        [
            Neg,
            Not,
            BitNot,
            Abs,
            Sign,
            Floor,
            Ceil,
            Round,
            Trunc,
            Fract,
            Saturate,
            Sqrt,
            InverseSqrt,
            Cbrt,
            Exp,
            Exp2,
            Log,
            Log2,
            Sin,
            Cos,
            Tan,
            Asin,
            Acos,
            Atan,
            Sinh,
            Cosh,
            Tanh,
            CountOneBits,
            ReverseBits,
            LeadingZeros,
            TrailingZeros,
        ]
    };

    /// Returns whether hardware computes the operation in a special, slower unit.
    pub fn is_transcendental(self) -> bool {
        use UnaryOp::*;
        matches!(
            self,
            Sqrt | InverseSqrt
                | Cbrt
                | Exp
                | Exp2
                | Log
                | Log2
                | Sin
                | Cos
                | Tan
                | Asin
                | Acos
                | Atan
                | Sinh
                | Cosh
                | Tanh
        )
    }
}

impl Op {
    /// Returns whether the operation does more than compute a value. An effect happens as often as the kernel says, in
    /// source order, and is never merged with another.
    pub fn is_effect(&self) -> bool {
        matches!(
            self,
            Op::Atomic { .. } | Op::Store(_) | Op::SharedLoad(_) | Op::Barrier { .. }
        )
    }

    /// Returns whether the operation rounds floats, so that merging it with others may change a bit.
    pub fn is_rounding(&self) -> bool {
        use BinaryOp::{Add, Atan2, Div, Mul, Pow, Rem, Sub};
        match self {
            Op::Binary(op) => matches!(op, Add | Sub | Mul | Div | Rem | Pow | Atan2),
            Op::Unary(op) => !matches!(
                op,
                UnaryOp::Neg | UnaryOp::Not | UnaryOp::BitNot | UnaryOp::Abs | UnaryOp::Sign
            ),
            Op::Dot | Op::Cross => true,
            _ => false,
        }
    }

    /// Returns whether the operation reads host memory that does not change during a dispatch.
    pub fn is_read(&self) -> bool {
        self.site().is_some()
    }

    /// Texture that is read or queried.
    pub fn texture(&self) -> Option<u32> {
        match self {
            Op::Load { texture, .. }
            | Op::Sample { texture, .. }
            | Op::Gather { texture, .. }
            | Op::Compare { texture, .. }
            | Op::GatherCompare { texture, .. }
            | Op::TextureSize(texture)
            | Op::TextureLevels(texture)
            | Op::TextureLayers(texture) => Some(*texture),
            _ => None,
        }
    }

    /// Sampler of a read.
    pub fn sampler(&self) -> Option<u32> {
        match self {
            Op::Sample { sampler, .. }
            | Op::Gather { sampler, .. }
            | Op::Compare { sampler, .. }
            | Op::GatherCompare { sampler, .. } => Some(*sampler),
            _ => None,
        }
    }

    /// Buffer that is read, written or queried.
    pub fn buffer(&self) -> Option<u32> {
        match self {
            Op::BufferLoad { buffer, .. } | Op::BufferLen(buffer) => Some(*buffer),
            _ => match self.memory() {
                Some(Memory::Buffer(buffer)) => Some(buffer),
                _ => None,
            },
        }
    }

    /// Memory that an effect works on.
    pub fn memory(&self) -> Option<Memory> {
        match self {
            Op::Atomic { memory, .. } | Op::Store(memory) => Some(*memory),
            Op::SharedLoad(shared) => Some(Memory::Shared(*shared)),
            _ => None,
        }
    }

    /// Returns whether the operation is ordered but free of side effects; dead if unused.
    pub fn is_removable_effect(&self) -> bool {
        matches!(self, Op::SharedLoad(_))
    }

    /// Site of a read; 0 if the read is shared by all calls.
    pub fn site(&self) -> Option<u32> {
        match self {
            Op::Load { site, .. }
            | Op::Sample { site, .. }
            | Op::Gather { site, .. }
            | Op::Compare { site, .. }
            | Op::GatherCompare { site, .. }
            | Op::BufferLoad { site, .. } => Some(*site),
            _ => None,
        }
    }

    /// The read shared by all calls.
    pub fn without_site(mut self) -> Op {
        if let Op::Load { site, .. }
        | Op::Sample { site, .. }
        | Op::Gather { site, .. }
        | Op::Compare { site, .. }
        | Op::GatherCompare { site, .. }
        | Op::BufferLoad { site, .. } = &mut self
        {
            *site = 0;
        }
        self
    }
}
