//! The tree of a random kernel. Every expression carries its type; every variable has a number of its own besides
//! its name, so that shadowing is resolved here and by the generator independently.

/// A type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ty {
    /// `bool`.
    Bool,
    /// `i32`.
    I32,
    /// `u32`.
    U32,
    /// `f32`.
    F32,
    /// `Vec2` to `Vec4`.
    Vec(u8),
    /// `IVec2` to `IVec4`.
    IVec(u8),
    /// `UVec2`: a texture's size.
    UVec2,
    /// `[T; n]`.
    Array(Box<Ty>, u8),
    /// `(A, B, ...)`.
    Tuple(Vec<Ty>),
    /// A structure of the program.
    Struct(u8),
}

/// A variable: its number, which is unique in the program, and its name, which is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Var {
    /// Number.
    pub id: u32,
    /// Index of the name.
    pub name: u8,
}

/// An expression and its type.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// Type.
    pub ty: Ty,
    /// What it is.
    pub kind: Kind,
}

/// Kinds of expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A literal.
    Float(f32),
    /// A literal.
    Int(i32),
    /// A literal.
    Uint(u32),
    /// A literal.
    Bool(bool),
    /// A local variable or parameter.
    Var(Var),
    /// A constant of the program.
    Const(u8),
    /// The kernel's `pixel`.
    Pixel,
    /// `a.size()`.
    Size,
    /// `a.load(coordinate)`.
    Load(Box<Expr>),
    /// `-x`, `!x`.
    Unary(Unary, Box<Expr>),
    /// `a + b`, ...; one side may be a scalar where the other is a vector.
    Binary(Binary, Box<Expr>, Box<Expr>),
    /// A method; the first argument is the receiver.
    Method(Method, Vec<Expr>),
    /// `v.zyx()`.
    Swizzle(Box<Expr>, Vec<u8>),
    /// `v.x`.
    Lane(Box<Expr>, u8),
    /// `tuple.0`, `structure.f0`.
    Part(Box<Expr>, u8),
    /// `array[index]`.
    Index(Box<Expr>, Box<Expr>),
    /// `x as type`.
    Cast(Box<Expr>),
    /// `vec3(...)`.
    Compose(Vec<Expr>),
    /// `Vec3::splat(x)`.
    Splat(Box<Expr>),
    /// `(a, b)`, `[a, b]` or `S0 { f0: a, f1: b }`, by the type.
    Many(Vec<Expr>),
    /// `[x; n]`.
    Repeat(Box<Expr>),
    /// `f0(...)`.
    Call(u8, Vec<Expr>),
    /// `if c { a } else { b }`.
    If(Box<Expr>, Box<Block>, Box<Block>),
    /// `match x { 0 | 1 => a, _ => b }`: an arm without values takes the rest.
    Match(Box<Expr>, Vec<(Vec<i32>, Expr)>),
    /// `{ ... }`.
    Block(Box<Block>),
}

/// Unary operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // named as in Rust's traits
pub enum Unary {
    Neg,
    Not,
}

/// Binary operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // named as in Rust's traits
pub enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    Rem,
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
    LazyAnd,
    LazyOr,
}

/// Methods of numbers, vectors and arrays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // named as in Rust and glam
pub enum Method {
    Abs,
    Floor,
    Ceil,
    Trunc,
    RoundTiesEven,
    Sqrt,
    Exp2,
    Recip,
    Min,
    Max,
    Clamp,
    Dot,
    Cross,
    LengthSquared,
    Length,
    DistanceSquared,
    Lerp,
    Extend,
    Truncate,
    MinElement,
    MaxElement,
    ElementSum,
    Powi,
    /// `as_vec2` .. `as_ivec4`, by the type.
    As,
    /// `len() as i32`.
    Len,
}

/// Statements, and perhaps a value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// In order.
    pub statements: Vec<Stmt>,
    /// The value.
    pub value: Option<Expr>,
}

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Stmt {
    /// `let [mut] name [: type] = value;`
    Let {
        /// The variable.
        var: Var,
        /// Whether `mut`.
        mutable: bool,
        /// Whether the type is written.
        typed: bool,
        /// The first value.
        init: Expr,
    },
    /// `let (a, b) = value;`
    LetTuple(Vec<Var>, Expr),
    /// `place = value;` or `place op= value;`
    Assign(Place, Option<Binary>, Expr),
    /// `if`; without an `else` if that is empty.
    If(Expr, Block, Block),
    /// `for var in range { ... }`.
    For(Var, Range, Block),
    /// `for var in array { ... }`; by reference if true.
    ForArray(Var, Expr, bool, Block),
    /// `while`.
    While(Expr, Block),
    /// `match` on a known integer.
    Match(Expr, Vec<(Vec<i32>, Block)>),
    /// `{ ... }`.
    Block(Block),
    /// `break;`
    Break,
    /// `continue;`
    Continue,
    /// `return value;`
    Return(Expr),
}

/// What a `for` counts through.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// First.
    pub start: Expr,
    /// End.
    pub end: Expr,
    /// `..=`.
    pub inclusive: bool,
    /// `.step_by(step)`, if above 1.
    pub step: u8,
    /// `.rev()`.
    pub reversed: bool,
}

/// A variable or a part of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The variable.
    pub var: Var,
    /// From the variable to the part.
    pub path: Vec<Step>,
}

/// A step from a value to a part of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// `.x`.
    Lane(u8),
    /// `.0`.
    Part(u8),
    /// `.f0`.
    Field(u8),
    /// `[index]`.
    Index(Expr),
}

/// A helper function.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Parameters, after the texture and the pixel, which each helper takes.
    pub params: Vec<(Var, Ty)>,
    /// What it gives.
    pub result: Ty,
    /// The body.
    pub body: Block,
}

/// A kernel with all that it uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Fields of each structure.
    pub structs: Vec<Vec<Ty>>,
    /// Constants: literals.
    pub consts: Vec<Expr>,
    /// Helpers.
    pub functions: Vec<Function>,
    /// The kernel's body.
    pub body: Block,
}

/// Name of a variable.
pub fn name(index: u8) -> String {
    match index {
        N => "n".to_owned(),
        k => format!("v{k}"),
    }
}

/// Index of the name `n`, which only parameters that bound a recursion have.
pub const N: u8 = 255;
