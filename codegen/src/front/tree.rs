//! The tree that kernels are evaluated from: the supported part of Rust, with places.

use crate::diagnostic::Span;
use crate::ir::{BinaryOp, Scalar, UnaryOp};
use crate::policy::{Branches, Unroll};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// An expression.
#[derive(Clone, Debug)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where it stands.
    pub span: Span,
}

/// Kinds of expressions.
#[derive(Clone, Debug)]
pub enum ExprKind {
    /// An integer literal, with its type: the suffix, or what inference finds.
    Int(i64, Option<IntType>),
    /// A float literal, and whether it says that it is an `f32`.
    Float(f32, bool),
    /// `true` or `false`.
    Bool(bool),
    /// A string literal: the name in `tally`.
    Str(String),
    /// A variable, constant, enum variant or associated constant, by its last two segments.
    Path(Vec<String>),
    /// `-x`, `!x`.
    Unary(UnaryOp, Box<Expr>),
    /// `&place`, `&mut place` (true).
    Ref(bool, Box<Expr>),
    /// `*reference`.
    Deref(Box<Expr>),
    /// `a + b`, ...
    Binary(BinaryOp, Box<Expr>, Box<Expr>),
    /// `&&` (true) and `||` (false): the right side is only looked at where it matters.
    Lazy(bool, Box<Expr>, Box<Expr>),
    /// `place = value`, or `place op= value`.
    Assign(Box<Expr>, Option<BinaryOp>, Box<Expr>),
    /// `function::<constants>(arguments)` by the path's last two segments.
    Call(Vec<String>, Vec<Expr>, Vec<Expr>),
    /// `receiver.method(arguments)`.
    Method(Box<Expr>, String, Vec<Expr>),
    /// `base.field`, `base.0`.
    Field(Box<Expr>, String),
    /// `base[index]`.
    Index(Box<Expr>, Box<Expr>),
    /// `if`, with what its attribute says.
    If(Box<Expr>, Block, Option<Box<Expr>>, Option<Branches>),
    /// `match`, with what its attribute says. `if let`, `let ... else` and `matches!` are this too.
    Match(Box<Expr>, Vec<Arm>, Option<Branches>),
    /// `{ ... }`.
    Block(Block),
    /// `(a, b)`; `()` is empty.
    Tuple(Vec<Expr>),
    /// `[a, b]`.
    Array(Vec<Expr>),
    /// `[value; len]`.
    Repeat(Box<Expr>, Box<Expr>),
    /// `Name { field: value }`.
    Struct(String, Vec<(String, Expr)>, Option<Box<Expr>>),
    /// `value as type`.
    Cast(Box<Expr>, Type),
    /// `a..b`, `a..=b` (true).
    Range(Box<Expr>, Box<Expr>, bool),
    /// `for pattern in iterable`.
    For(Box<ForLoop>),
    /// `while`, or `loop` as `while true`, with its label and what its attribute says.
    While(Box<Expr>, Block, Option<String>, Option<Unroll>),
    /// `return`.
    Return(Option<Box<Expr>>),
    /// `break`, of the loop with a label.
    Break(Option<String>),
    /// `continue`, of the loop with a label.
    Continue(Option<String>),
    /// `assert!(condition, "message")`.
    Assert(Box<Expr>, String),
    /// `|a, b| value`.
    Closure(Arc<Closure>),
}

/// A closure.
#[derive(Clone, Debug)]
pub struct Closure {
    /// What takes its arguments, with types where they are stated.
    pub params: Vec<(Pattern, Option<Type>)>,
    /// What it gives, where that is stated.
    pub result: Option<Type>,
    /// What it computes.
    pub body: Expr,
    /// `move`: it has the values that its variables have where it is made.
    pub moves: bool,
}

/// A `for`.
#[derive(Clone, Debug)]
pub struct ForLoop {
    /// Its label.
    pub label: Option<String>,
    /// What its attribute says.
    pub unroll: Option<Unroll>,
    /// What takes each value.
    pub pattern: Pattern,
    /// What it runs over.
    pub over: Expr,
    /// What it does.
    pub body: Block,
}

/// Integer types by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntType {
    /// `i32`.
    I32,
    /// `u32`.
    U32,
    /// `usize`.
    Usize,
}

/// Statements in braces; the last may be the block's value.
#[derive(Clone, Debug)]
pub struct Block {
    /// In order.
    pub statements: Vec<Statement>,
    /// The value, if the last expression has no semicolon.
    pub value: Option<Box<Expr>>,
}

/// A statement.
#[derive(Clone, Debug)]
pub enum Statement {
    /// `let pattern: type = value;`
    Let(Pattern, Option<Type>, Option<Expr>, Span),
    /// `value;`
    Expr(Expr),
    /// `const NAME: type = value;` inside a function.
    Const(Const),
}

/// One arm of a `match`.
#[derive(Clone, Debug)]
pub struct Arm {
    /// What it takes.
    pub pattern: Pattern,
    /// What must hold besides: `if condition`.
    pub guard: Option<Expr>,
    /// What it gives.
    pub body: Expr,
}

/// A pattern.
#[derive(Clone, Debug)]
pub enum Pattern {
    /// `name`, `mut name` (true).
    Name(String, bool, Span),
    /// `(a, b)`.
    Tuple(Vec<Pattern>, Span),
    /// `_`.
    Wild,
    /// `&pattern`, `&mut pattern`.
    Ref(Box<Pattern>, Span),
    /// A value to compare with: a variant, a constant or a literal.
    Value(Box<Expr>),
    /// `[a, b]`.
    Array(Vec<Pattern>, Span),
    /// `a | b`.
    Or(Vec<Pattern>),
    /// `Name { field: pattern, .. }`, `Name(pattern)`, by the last two segments of its path.
    Struct(Vec<String>, Vec<(String, Pattern)>, Span),
    /// `low..high`, `low..=high` (true), of which an end may be missing.
    Range(Option<Box<Expr>>, Option<Box<Expr>>, bool),
    /// `name @ pattern`, `mut name @ pattern` (true).
    At(String, bool, Box<Pattern>, Span),
}

/// The vector that glam calls so, `BVec2` to `BVec4` among them: the kind and the number of its components.
pub fn vector_named(name: &str) -> Option<(Scalar, u8)> {
    match name {
        "BVec2" => Some((Scalar::Bool, 2)),
        "BVec3" => Some((Scalar::Bool, 3)),
        "BVec4" => Some((Scalar::Bool, 4)),
        _ => crate::ir::vector_named(name),
    }
}

/// A type as written.
#[derive(Clone, Debug)]
pub enum Type {
    /// A name, with its arguments: `f32`, `Vec3`, `Frame<Vec4>`.
    Name(String, Vec<Type>),
    /// `[T; n]`, or `[T]` without a length.
    Array(Box<Type>, Option<Box<Expr>>),
    /// `(A, B)`.
    Tuple(Vec<Type>),
    /// `&T`, `&mut T` (true).
    Ref(bool, Box<Type>),
    /// What is called: `impl Fn(A) -> B`.
    Fn(Vec<Type>, Box<Type>),
}

impl Type {
    /// The type behind any shared or mutable references.
    pub fn bare(&self) -> &Type {
        match self {
            Type::Ref(_, inner) => inner.bare(),
            other => other,
        }
    }

    /// Whether it is `&mut T`.
    pub fn is_mutable_reference(&self) -> bool {
        matches!(self, Type::Ref(true, _))
    }
}

/// A generic parameter of a function; lifetimes are dropped.
#[derive(Clone, Debug)]
pub enum Generic {
    /// `T`.
    Type(String),
    /// `const N: usize`.
    Const(String, Type),
}

/// A parameter of a function.
#[derive(Clone, Debug)]
pub struct Param {
    /// Its name; a method's first is `self`.
    pub name: String,
    /// Its type, with `Self` resolved.
    pub ty: Type,
    /// Whether the function may assign to it: `mut name`.
    pub mutable: bool,
    /// Where it stands.
    pub span: Span,
}

/// A function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Documentation.
    pub docs: String,
    /// Generic parameters in order.
    pub generics: Vec<Generic>,
    /// Parameters in order.
    pub params: Vec<Param>,
    /// What it gives; `()` is an empty tuple.
    pub result: Type,
    /// The body.
    pub body: Block,
    /// Where its name stands.
    pub span: Span,
}

/// A constant.
#[derive(Clone, Debug)]
pub struct Const {
    /// Name, or `Type::NAME`.
    pub name: String,
    /// Its value.
    pub value: Expr,
    /// Its type.
    pub ty: Type,
}

/// A structure.
#[derive(Clone, Debug)]
pub struct Struct {
    /// Name and type of each field.
    pub fields: Vec<(String, Type, Span)>,
}

/// An enum without data.
#[derive(Clone, Debug)]
pub struct Enum {
    /// Name and documentation of each variant.
    pub variants: Vec<(String, String)>,
}

/// One line of `options!`.
#[derive(Clone, Debug)]
pub struct OptionField {
    /// Name of the field.
    pub name: String,
    /// Documentation.
    pub docs: String,
    /// Type: `f32`, `i32`, `u32`, `bool` or an enum.
    pub ty: Type,
    /// Allowed values of a number.
    pub range: Option<Expr>,
    /// The default.
    pub default: Expr,
    /// Whether it is set at run time unless a setting says otherwise: `= uniform(default)`.
    pub uniform: bool,
    /// Where its name stands.
    pub span: Span,
}

/// Everything that a kernel's files define, by name.
#[derive(Clone, Debug, Default)]
pub struct Library {
    /// Functions and methods (`Type::name`).
    pub functions: HashMap<String, Function>,
    /// Names of the methods that take `&mut self`.
    pub mutating: HashSet<String>,
    /// Constants.
    pub consts: HashMap<String, Const>,
    /// Structures.
    pub structs: HashMap<String, Struct>,
    /// Enums.
    pub enums: HashMap<String, Enum>,
    /// Structures declared by `options!`.
    pub options: HashMap<String, Vec<OptionField>>,
}
