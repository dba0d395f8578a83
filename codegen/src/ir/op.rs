//! Operations.

use super::{Lanes, RegionId};

/// What a node does with its arguments.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A known value, by its bits.
    Const(Lanes),
    /// Coordinate of the output pixel, `vec2<i32>`, inside the frame.
    Pixel,
    /// Width and height of the frame, `vec2<i32>`, each at least 1.
    FrameSize,
    /// A run-time parameter, by index into `Graph::uniforms`.
    Uniform(u32),
    /// One argument.
    Unary(UnaryOp),
    /// Two arguments of one type; comparisons give booleans, lane by lane.
    Binary(BinaryOp),
    /// Sum of the products of the lanes, first to last: two vectors to a scalar.
    Dot,
    /// Cross product of two `vec3<f32>`.
    Cross,
    /// `max(min(x, high), low)`: x, low, high.
    Clamp,
    /// condition (scalar boolean), value if true, value if false.
    Select,
    /// A scalar in every lane.
    Splat,
    /// A vector from its lanes, each a scalar.
    Compose,
    /// One lane of a vector.
    Extract(u8),
    /// A conversion to the node's type, lane by lane, as WGSL's value constructors do it: floats to integers
    /// truncate and saturate.
    Convert,
    /// A texel: coordinate (`vec2<i32>`, inside the frame), and layer (`i32`) for a stack of layers. `site`
    /// keeps reads of different calls apart until load sharing sets it to 0.
    Load {
        /// Index into `Graph::textures`.
        texture: u32,
        /// The call that it stands for, or 0.
        site: u32,
    },
    /// A value counted by name (index into `Graph::tallies`); the value itself.
    Tally(u32),
    /// An array from its elements.
    MakeArray,
    /// array, index (`i32`).
    ArrayGet,
    /// array, index (`i32`), element.
    ArraySet,
    /// start (`i32`), end (`i32`), carried values.
    Loop(RegionId),
    /// condition (scalar boolean): results of the first region if it holds, else of the second.
    If(RegionId, RegionId),
    /// A result of a loop or branch.
    Result(u32),
    /// A parameter of a region: 0 is a loop's counter, then the carried values.
    Param(RegionId, u32),
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
    Sqrt,
    InverseSqrt,
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
    /// Whether it compares, giving booleans.
    pub fn is_comparison(self) -> bool {
        use BinaryOp::*;
        matches!(self, Eq | Ne | Lt | Le | Gt | Ge)
    }

    /// Whether the arguments may be exchanged without any change of the result, bit for bit.
    pub fn commutes(self) -> bool {
        use BinaryOp::*;
        matches!(self, Add | Mul | And | Or | Xor | Eq | Ne)
    }
}

impl UnaryOp {
    /// Whether hardware computes it in a special, slower unit.
    pub fn is_transcendental(self) -> bool {
        use UnaryOp::*;
        matches!(
            self,
            Sqrt | InverseSqrt | Exp | Exp2 | Log | Log2 | Sin | Cos | Tan | Asin | Acos | Atan
        )
    }
}
