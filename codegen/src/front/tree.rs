//! The tree that kernels are evaluated from: the supported part of Rust, with places.

use crate::diagnostic::Span;
use crate::ir::{BinaryOp, UnaryOp};
use crate::policy::{Branches, Unroll};
use std::collections::HashMap;

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
    /// An integer literal, with its suffix.
    Int(i64, Option<IntType>),
    /// A float literal.
    Float(f32),
    /// `true` or `false`.
    Bool(bool),
    /// A string literal: the name in `tally`.
    Str(String),
    /// A variable, constant, enum variant or associated constant, by its last two segments.
    Path(Vec<String>),
    /// `-x`, `!x`.
    Unary(UnaryOp, Box<Expr>),
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
    /// `match`.
    Match(Box<Expr>, Vec<Arm>),
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
    /// `i32`, and `usize` and `isize`, which index.
    I32,
    /// `u32`.
    U32,
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
    /// What it gives.
    pub body: Expr,
}

/// A pattern.
#[derive(Clone, Debug)]
pub enum Pattern {
    /// `name`, `mut name`.
    Name(String, Span),
    /// `(a, b)`.
    Tuple(Vec<Pattern>, Span),
    /// `_`.
    Wild,
    /// A value to compare with: a variant, a constant or a literal.
    Value(Box<Expr>),
    /// `[a, b]`.
    Array(Vec<Pattern>, Span),
    /// `a | b`.
    Or(Vec<Pattern>),
    /// `Name { field: pattern, .. }`.
    Struct(Vec<(String, Pattern)>, Span),
    /// `low..=high`: integers.
    Range(Box<Expr>, Box<Expr>),
}

/// A type as written; references are dropped.
#[derive(Clone, Debug)]
pub enum Type {
    /// A name, with its arguments: `f32`, `Vec3`, `Frame<Vec4>`.
    Name(String, Vec<Type>),
    /// `[T; n]`, or `[T]` without a length.
    Array(Box<Type>, Option<Box<Expr>>),
    /// `(A, B)`.
    Tuple(Vec<Type>),
}

/// A function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Documentation.
    pub docs: String,
    /// Generic parameters in order: the name of a constant, `None` for a type.
    pub generics: Vec<Option<String>>,
    /// Parameters in order; a method's first is `self`.
    pub params: Vec<(String, Type, Span)>,
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
    /// Constants.
    pub consts: HashMap<String, Const>,
    /// Structures.
    pub structs: HashMap<String, Struct>,
    /// Enums.
    pub enums: HashMap<String, Enum>,
    /// Structures declared by `options!`.
    pub options: HashMap<String, Vec<OptionField>>,
}
