//! Operations.

use super::{Bits, Memory, RegionId};

/// Operation of a node on its arguments.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A known value, by its bits.
    Const(Bits),
    /// An undefined value: nothing reads it.
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
    /// True if the pixel of an invocation of a workgroup is to be computed: inside the frame.
    Inside,
    /// The argument as the lane beside, above or below, or across has it, bit for bit.
    QuadSwap(QuadDirection),
    /// The argument's fine derivative, of floats: in both lanes of a row the right one's less the left one's, in both of
    /// a column the lower one's less the upper one's.
    Derivative(Axis),
    /// A value that the host's rasteriser interpolates for each lane, by index into `Graph::varyings`.
    Varying(u32),
    /// A run-time parameter, by index into `Graph::uniforms`.
    Uniform(u32),
    /// An operation on one argument.
    Unary(UnaryOp),
    /// Two arguments of one type; comparisons give booleans, lane by lane. Of two float scalars `Min` and `Max` are those of
    /// `f32`, which pass over a NaN; of two vectors those of glam: the first one's component where it is less, or greater, and
    /// else the second one's.
    Binary(BinaryOp),
    /// Sum of the products of the lanes, first to last: two vectors to a scalar.
    Dot,
    /// Cross product of two `vec3<f32>`.
    Cross,
    /// x, low, high, as Rust has it: a float scalar that is a NaN stays one (`f32::clamp`), vectors of floats are
    /// `x.max(low).min(high)` as glam's are.
    Clamp,
    /// condition (scalar boolean), value if true, value if false.
    Select,
    /// A scalar in every lane.
    Splat,
    /// A vector from its lanes, each a scalar.
    Compose,
    /// A component of a vector.
    Extract(u8),
    /// A conversion to the node's type, lane by lane, as WGSL's value constructors do it: floats to integers
    /// truncate and saturate.
    Convert,
    /// Reinterprets the bits as another kind of number, lane by lane.
    Bitcast,
    /// Width and height of a texture's finest level (index into `Graph::textures`), and depth of a volume: a vector of `i32`,
    /// each at least 1.
    TextureSize(u32),
    /// Number of levels of a texture (index into `Graph::textures`), `i32`, at least 1.
    TextureLevels(u32),
    /// Number of layers of a texture (index into `Graph::textures`), `i32`, at least 1.
    TextureLayers(u32),
    /// A texel: coordinate (a vector of `i32`, inside the texture), the layer or sample (`i32`) where there are several, and the
    /// level (`i32`, inside the texture) where it is not the finest.
    /// `site` keeps reads of different calls apart until load sharing sets it to 0.
    Load {
        /// Index into `Graph::textures`.
        texture: u32,
        /// The call that it stands for, or 0.
        site: u32,
    },
    /// A texture between its texels: place (floats from 0 to 1, or a direction), and the layer (`i32`, outside the nearest one)
    /// where there are several. At its finest level; or at that of one more argument, an `f32`; or at that of two more, steps
    /// along which it is read, of the place's type.
    Sample {
        /// Index into `Graph::textures`.
        texture: u32,
        /// Index into `Graph::samplers`.
        sampler: u32,
        /// As of `Load`.
        site: u32,
    },
    /// A component of each of the four texels around a coordinate (`vec2<f32>`), in a layer (`i32`) where there are several, as
    /// `vec4<f32>`: lower left, lower right, upper right, upper left.
    Gather {
        /// Index into `Graph::textures`.
        texture: u32,
        /// Index into `Graph::samplers`.
        sampler: u32,
        /// 0 to 3.
        component: u8,
        /// As of `Load`.
        site: u32,
    },
    /// Fraction of a depth texture around a place, in a layer where there are several (both as of `Sample`), that passes a comparison with
    /// a reference (`f32`).
    Compare {
        /// Index into `Graph::textures`.
        texture: u32,
        /// Index into `Graph::samplers`.
        sampler: u32,
        /// As of `Load`.
        site: u32,
    },
    /// Comparison of each of the four depths around a coordinate (`vec2<f32>`) with a reference (`f32`): 1 for those that pass and 0 for
    /// the others, in the lanes of a `vec4<f32>`, in the order of `Gather`.
    GatherCompare {
        /// Index into `Graph::textures`.
        texture: u32,
        /// Index into `Graph::samplers`.
        sampler: u32,
        /// As of `Load`.
        site: u32,
    },
    /// Number of elements of a buffer (index into `Graph::buffers`), `i32`, at least 1.
    BufferLen(u32),
    /// A part of an element of a buffer: index (`i32`, inside the buffer), and of an array in it the index there (`i32`, inside
    /// the array).
    BufferLoad {
        /// Index into `Graph::buffers`.
        buffer: u32,
        /// Number of the element's field; 0 of an element that is a value.
        field: u32,
        /// As of `Load`.
        site: u32,
    },
    /// Changes an element at once, as no other invocation can come between: condition (scalar boolean), index (`i32`,
    /// inside the memory where the condition holds), and a value of the element's type but for `AtomicOp::Load`. Gives what was
    /// there before, and 0 where the condition does not hold, for which nothing is done. An effect.
    Atomic {
        /// Memory that it changes.
        memory: Memory,
        /// Operation on the element.
        op: AtomicOp,
    },
    /// Writes an element: condition, index, value, as of `Atomic`. An effect.
    Store(Memory),
    /// An element of what a workgroup shares (index into `Graph::shared`): condition (scalar boolean), index (`i32`, inside). Any
    /// value where the condition does not hold. An effect, for it has its place among the others.
    SharedLoad(u32),
    /// Waits for the other invocations of the workgroup; what any of them has done to what they share is seen by all of them
    /// behind it. An effect.
    Barrier {
        /// `true` if it also makes writes to buffers visible.
        buffers: bool,
    },
    /// The argument, floats, as the operation that made it rounds them: no compiler may merge, reorder or contract that operation
    /// with others (`docs/semantics.md`, *Exactness*).
    Exact,
    /// A value counted by name (index into `Graph::tallies`); the value itself.
    Tally(u32),
    /// An array from its elements.
    MakeArray,
    /// array, index (`i32`).
    ArrayGet,
    /// array, index (`i32`), element.
    ArraySet,
    /// start, end (both `i32` or both `u32`), carried values. It ends early where its region says so.
    Loop(RegionId),
    /// condition (scalar boolean): results of the first region if it holds, else of the second.
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

/// From which lane of a quad a message comes.
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

    /// The axes along which it comes from the other side of the quad: 1 or 0.
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
    /// Between 0 and 1; of a NaN 0, of -0 too.
    Saturate,
    Sqrt,
    InverseSqrt,
    /// Of a negative number a negative one.
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

    /// Returns whether hardware computes it in a special, slower unit.
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
    /// Returns whether it does more than compute a value: it happens as often as the kernel says, in the order of the source, and is never
    /// merged with another.
    pub fn is_effect(&self) -> bool {
        matches!(
            self,
            Op::Atomic { .. } | Op::Store(_) | Op::SharedLoad(_) | Op::Barrier { .. }
        )
    }

    /// Tells if it rounds floats, so that a compiler that merges it with others may change a bit.
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

    /// Returns whether it reads memory that a host fills, which nothing changes meanwhile.
    pub fn is_read(&self) -> bool {
        self.site().is_some()
    }

    /// The texture that it reads or asks the size of.
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

    /// The sampler that it reads by.
    pub fn sampler(&self) -> Option<u32> {
        match self {
            Op::Sample { sampler, .. }
            | Op::Gather { sampler, .. }
            | Op::Compare { sampler, .. }
            | Op::GatherCompare { sampler, .. } => Some(*sampler),
            _ => None,
        }
    }

    /// The buffer that it reads, writes or asks the length of.
    pub fn buffer(&self) -> Option<u32> {
        match self {
            Op::BufferLoad { buffer, .. } | Op::BufferLen(buffer) => Some(*buffer),
            _ => match self.memory() {
                Some(Memory::Buffer(buffer)) => Some(buffer),
                _ => None,
            },
        }
    }

    /// The memory that an effect works on.
    pub fn memory(&self) -> Option<Memory> {
        match self {
            Op::Atomic { memory, .. } | Op::Store(memory) => Some(*memory),
            Op::SharedLoad(shared) => Some(Memory::Shared(*shared)),
            _ => None,
        }
    }

    /// Returns whether it is ordered but free of side effects; dead if unused.
    pub fn is_removable_effect(&self) -> bool {
        matches!(self, Op::SharedLoad(_))
    }

    /// The call that a read stands for, 0 for all of them.
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

    /// A read that stands for every call of it.
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
