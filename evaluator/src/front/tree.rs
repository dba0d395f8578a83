//! The tree that kernels are evaluated from: the supported part of Rust, with places.

use super::name::Name;
use crate::diagnostic::Span;
use crate::ir::{BinaryOp, Scalar, UnaryOp};
use crate::policy::{Branches, Unroll};
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

/// An expression.
#[derive(Clone, Debug)]
pub struct Expr {
    /// Kind of expression, with its parts.
    pub kind: ExprKind,
    /// Source location.
    pub span: Span,
}

impl Expr {
    /// Value of a literal integer or boolean.
    pub fn known_constant(&self) -> Option<i64> {
        match &self.kind {
            ExprKind::Int(value, _) => Some(*value),
            ExprKind::Bool(value) => Some(i64::from(*value)),
            ExprKind::Unary(UnaryOp::Neg, operand) => operand.known_constant().map(|value| -value),
            ExprKind::Block(block) if block.statements.is_empty() => block.value.as_ref()?.known_constant(),
            _ => None,
        }
    }
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
    /// `function::<constants>(arguments)` by the path's last two segments; without arguments also a constant of a type that has
    /// arguments or of a trait: `Window::<3>::SIZE`, `<f32 as Zero>::ZERO`.
    Call(Vec<String>, Vec<Expr>, Vec<Expr>),
    /// `(callee)(arguments)`: a call of what an expression gives.
    Invoke(Box<Expr>, Vec<Expr>),
    /// `receiver.method::<constants>(arguments)`.
    Method(Box<Expr>, String, Vec<Expr>, Vec<Expr>),
    /// `base.field`, `base.0`.
    Field(Box<Expr>, Name),
    /// `base[index]`.
    Index(Box<Expr>, Box<Expr>),
    /// `if`, with what its attribute says.
    If(Box<Expr>, Block, Option<Box<Expr>>, Option<Branches>),
    /// `match`, with what its attribute says. `if let`, `let ... else` and `matches!` are this too.
    Match(Box<Expr>, Vec<Arm>, Option<Branches>),
    /// `{ ... }`.
    Block(Block),
    /// `'label: { ... }`, which a `break` may leave.
    Labelled(String, Block),
    /// `(a, b)`; `()` is empty.
    Tuple(Vec<Expr>),
    /// `[a, b]`.
    Array(Vec<Expr>),
    /// `[value; len]`.
    Repeat(Box<Expr>, Box<Expr>),
    /// `Name { field: value }`, of a structure or a variant, by the last two segments of its path.
    Struct(Vec<String>, Vec<(Name, Expr)>, Option<Box<Expr>>),
    /// `value as type`.
    Cast(Box<Expr>, Type),
    /// `a..b`, `a..=b` (true).
    Range(Box<Expr>, Box<Expr>, bool),
    /// A slice of an array: `array[a..b]`.
    Slice(Box<Expr>, Bounds),
    /// `for pattern in iterable`.
    For(Box<ForLoop>),
    /// `while`, or `loop` as `while true`, with its label and what its attribute says.
    While(Box<Expr>, Block, Option<String>, Option<Unroll>),
    /// `value?`: what an `Option` or a `Result` holds, or the function ends with what it has instead.
    Try(Box<Expr>),
    /// `return`.
    Return(Option<Box<Expr>>),
    /// `break`, of the loop with a label.
    Break(Option<String>),
    /// `continue`, of the loop with a label.
    Continue(Option<String>),
    /// `unreachable!()`: the values of its branch are never used.
    Unreachable,
    /// `assert!(condition, "message")`.
    Assert {
        /// The condition, a boolean.
        condition: Box<Expr>,
        /// Message of the error if it does not hold.
        message: String,
        /// `true` if release builds of Rust leave it out.
        only_debug: bool,
    },
    /// `|a, b| value`.
    Closure(Arc<Closure>),
}

/// Ends of a range in brackets.
#[derive(Clone, Debug)]
pub struct Bounds {
    /// First index; 0 if it is missing.
    pub start: Option<Box<Expr>>,
    /// Last index, or the one after it; the array's length if it is missing.
    pub end: Option<Box<Expr>>,
    /// `true` if the range includes its end: `a..=b`.
    pub inclusive: bool,
}

impl Bounds {
    /// The ends that are written.
    pub fn ends(&self) -> impl Iterator<Item = &Expr> {
        [&self.start, &self.end].into_iter().filter_map(Option::as_deref)
    }
}

/// A closure.
#[derive(Clone, Debug)]
pub struct Closure {
    /// Patterns of the arguments, with types where they are stated.
    pub params: Vec<(Pattern, Option<Type>)>,
    /// Type of the result, if it is stated.
    pub result: Option<Type>,
    /// Value of the closure.
    pub body: Expr,
    /// `move`: it has the values that its variables have where it is made.
    pub moves: bool,
}

/// A `for`.
#[derive(Clone, Debug)]
pub struct ForLoop {
    /// Label without its quote.
    pub label: Option<String>,
    /// Policy that its attribute requests.
    pub unroll: Option<Unroll>,
    /// Pattern of each value.
    pub pattern: Pattern,
    /// Range, array or iterator to iterate over.
    pub over: Expr,
    /// Statements of an iteration.
    pub body: Block,
    /// `true` for a `while` that its attribute bounds.
    pub bounded: bool,
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
    /// `i8`, computed as an `i32`.
    I8,
    /// `i16`, computed as an `i32`.
    I16,
    /// `u8`, computed as a `u32`.
    U8,
    /// `u16`, computed as a `u32`.
    U16,
}

impl IntType {
    const ALL: [IntType; 7] = [
        IntType::I32,
        IntType::U32,
        IntType::Usize,
        IntType::I8,
        IntType::I16,
        IntType::U8,
        IntType::U16,
    ];

    /// Name in Rust.
    pub fn name(self) -> &'static str {
        match self {
            IntType::I32 => "i32",
            IntType::U32 => "u32",
            IntType::Usize => "usize",
            IntType::I8 => "i8",
            IntType::I16 => "i16",
            IntType::U8 => "u8",
            IntType::U16 => "u16",
        }
    }

    /// Type of a name in Rust.
    pub fn from_name(name: &str) -> Option<IntType> {
        IntType::ALL.into_iter().find(|known| known.name() == name)
    }

    /// Smallest and largest value; of `usize` those that fit into 63 bits.
    pub fn range(self) -> (i64, i64) {
        match self {
            IntType::I32 => (i32::MIN.into(), i32::MAX.into()),
            IntType::U32 => (0, u32::MAX.into()),
            IntType::Usize => (0, i64::MAX),
            IntType::I8 => (i8::MIN.into(), i8::MAX.into()),
            IntType::I16 => (i16::MIN.into(), i16::MAX.into()),
            IntType::U8 => (0, u8::MAX.into()),
            IntType::U16 => (0, u16::MAX.into()),
        }
    }

    /// Type in which a shader holds the values.
    pub fn scalar(self) -> Scalar {
        match self {
            IntType::I32 | IntType::I8 | IntType::I16 => Scalar::I32,
            IntType::U32 | IntType::U8 | IntType::U16 => Scalar::U32,
            IntType::Usize => Scalar::Usize,
        }
    }

    /// Number of bits, if a shader holds the values in more of them. Such numbers are stored, compared and converted;
    /// they have no arithmetic, which would need its own overflow.
    pub fn narrow_bits(self) -> Option<u32> {
        match self {
            IntType::I8 | IntType::U8 => Some(8),
            IntType::I16 | IntType::U16 => Some(16),
            IntType::I32 | IntType::U32 | IntType::Usize => None,
        }
    }
}

/// Statements in braces; the last may be the block's value.
#[derive(Clone, Debug)]
pub struct Block {
    /// In order.
    pub statements: Vec<Statement>,
    /// The value, if the last expression has no semicolon.
    pub value: Option<Box<Expr>>,
    /// `true` if its operations on floats are exact, including those of the functions that it calls.
    pub exact: bool,
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

impl Statement {
    /// Place that the statement is known by.
    pub fn span(&self) -> Span {
        match self {
            Statement::Let(.., span) => *span,
            Statement::Expr(e) => e.span,
            Statement::Const(constant) => constant.value.span,
        }
    }
}

/// An arm of a `match`.
#[derive(Clone, Debug)]
pub struct Arm {
    /// Pattern of the values that the arm handles.
    pub pattern: Pattern,
    /// Additional condition: `if condition`.
    pub guard: Option<Expr>,
    /// Value of the arm.
    pub body: Expr,
}

/// A pattern.
#[derive(Clone, Debug)]
pub enum Pattern {
    /// `name`, `mut name` (true).
    Name(Name, bool, Span),
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
    Struct(Vec<String>, Vec<(Name, Pattern)>, Span),
    /// `low..high`, `low..=high` (true), of which an end may be missing.
    Range(Option<Box<Expr>>, Option<Box<Expr>>, bool),
    /// `name @ pattern`, `mut name @ pattern` (true).
    At(Name, bool, Box<Pattern>, Span),
    /// `..` among the parts of a tuple or an array: those that the others leave.
    Rest,
}

impl Pattern {
    /// Returns whether the pattern matches the remaining parts of a tuple or an array: `..`, `name @ ..`.
    pub fn is_rest(&self) -> bool {
        match self {
            Pattern::Rest => true,
            Pattern::At(_, _, inner, _) => matches!(**inner, Pattern::Rest),
            _ => false,
        }
    }

    /// The parts that each of some patterns takes of `count`: one, or what `..` takes. `None` if they are not of so many.
    pub fn part_ranges(patterns: &[Pattern], count: usize) -> Option<Vec<(&Pattern, Range<usize>)>> {
        let rest = patterns.iter().position(Pattern::is_rest);
        let left = match rest {
            Some(_) => (count + 1).checked_sub(patterns.len())?,
            None if patterns.len() == count => 0,
            None => return None,
        };
        let mut at = 0;
        let each = patterns.iter().enumerate().map(|(k, pattern)| {
            let from = at;
            at += if Some(k) == rest { left } else { 1 };
            (pattern, from..at)
        });
        Some(each.collect())
    }
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

/// Name that implementations for arrays and slices are listed under.
pub const ARRAY: &str = "[]";

/// Name that implementations for tuples of so many parts are listed under.
pub fn tuple_name(parts: usize) -> String {
    format!("({parts})")
}

/// Returns whether implementations for arrays, slices or tuples are listed under a name.
pub fn is_unnamed(name: &str) -> bool {
    name.starts_with(['[', '('])
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
    /// A function or closure: `impl Fn(A) -> B`, `fn(A) -> B`.
    Fn(Vec<Type>, Box<Type>),
    /// A constant where an argument stands: the 3 of `Window<3>`.
    Const(Box<Expr>),
}

impl Type {
    /// The type behind any shared or mutable references.
    pub fn peel_refs(&self) -> &Type {
        match self {
            Type::Ref(_, inner) => inner.peel_refs(),
            other => other,
        }
    }

    /// Name that implementations of the type are listed under. That of an array or a tuple is none that a kernel can write.
    pub fn listed_name(&self) -> Option<String> {
        match self.peel_refs() {
            Type::Name(name, _) => Some(name.clone()),
            Type::Array(..) => Some(ARRAY.to_owned()),
            Type::Tuple(parts) => Some(tuple_name(parts.len())),
            Type::Ref(..) | Type::Fn(..) | Type::Const(_) => None,
        }
    }

    /// Arguments of the type: those after its name, the parts of a tuple, or the element and the length of an array.
    pub fn arguments(&self) -> Cow<'_, [Type]> {
        match self.peel_refs() {
            Type::Name(_, args) | Type::Tuple(args) => Cow::Borrowed(args),
            Type::Array(element, len) => {
                let len = len.iter().map(|len| Type::Const(len.clone()));
                Cow::Owned(std::iter::once((**element).clone()).chain(len).collect())
            }
            _ => Cow::Borrowed(&[]),
        }
    }

    /// Returns whether an argument of a type is a parameter, by its name.
    pub fn is_parameter(&self, parameter: &str) -> bool {
        match self {
            Type::Name(name, args) => name == parameter && args.is_empty(),
            Type::Const(value) => {
                matches!(&value.kind, ExprKind::Path(path) if matches!(path.as_slice(), [name] if name == parameter))
            }
            _ => false,
        }
    }

    /// Returns whether no type is both of two types that `impl`s are of, as their arguments differ.
    pub fn is_apart(&self, other: &Type, is_parameter: &impl Fn(&str) -> bool) -> bool {
        match (self.peel_refs(), other.peel_refs()) {
            (Type::Name(a, _), _) | (_, Type::Name(a, _)) if is_parameter(a) => false,
            (Type::Name(a, of_a), Type::Name(b, of_b)) => {
                a != b || of_a.iter().zip(of_b).any(|(a, b)| a.is_apart(b, is_parameter))
            }
            (Type::Tuple(a), Type::Tuple(b)) => {
                a.len() != b.len() || a.iter().zip(b).any(|(a, b)| a.is_apart(b, is_parameter))
            }
            (Type::Array(a, of_a), Type::Array(b, of_b)) => {
                let length = |len: &Option<Box<Expr>>| len.as_ref().and_then(|len| len.known_constant());
                let lengths = length(of_a).zip(length(of_b));
                lengths.is_some_and(|(a, b)| a != b) || a.is_apart(b, is_parameter)
            }
            (Type::Const(a), Type::Const(b)) => match (a.known_constant(), b.known_constant()) {
                (Some(a), Some(b)) => a != b,
                _ => false,
            },
            (Type::Const(_), _) | (_, Type::Const(_)) | (Type::Fn(..), Type::Fn(..)) => false,
            _ => true,
        }
    }

    /// Returns whether the type is `&mut T`.
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

impl Generic {
    /// Name of the parameter.
    pub fn name(&self) -> &str {
        match self {
            Generic::Type(name) | Generic::Const(name, _) => name,
        }
    }
}

/// A parameter of a function.
#[derive(Clone, Debug)]
pub struct Param {
    /// Name; a method's first parameter is `self`.
    pub name: Name,
    /// Type, with `Self` resolved.
    pub ty: Type,
    /// `true` if the function may assign to it: `mut name`.
    pub mutable: bool,
    /// Source location.
    pub span: Span,
}

/// A function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Documentation.
    pub docs: String,
    /// Policy for its loops and those of the functions that it calls, unless they have their own.
    pub unroll: Option<Unroll>,
    /// Names of its values that attributes put into half precision, its own among them.
    pub half: Vec<String>,
    /// Generic parameters in order, those of its `impl` last.
    pub generics: Vec<Generic>,
    /// Type that its `impl` is of, with its arguments.
    pub of: Option<Type>,
    /// The traits that type parameters have, by their names.
    pub bounds: HashMap<String, Vec<String>>,
    /// Types that `into` of type parameters gives, by their names.
    pub conversions: HashMap<String, Type>,
    /// Trait whose default function it is.
    pub default_of: Option<String>,
    /// Parameters in order.
    pub params: Vec<Param>,
    /// Type of the result; `()` is an empty tuple.
    pub result: Type,
    /// The body.
    pub body: Block,
    /// Source location of its name.
    pub span: Span,
}

/// Generic arguments of a call: those of the function, and the type before it, if that has arguments: `Window::<3>::new`, which are
/// lowered as `() as Window<3>` behind the others. An argument that has arguments itself is a path: `Window as Window<3>`.
pub fn generic_arguments(stated: &[Expr]) -> (&[Expr], Option<&Type>) {
    match stated.split_last() {
        Some((
            Expr {
                kind: ExprKind::Cast(unit, ty @ (Type::Name(..) | Type::Array(..) | Type::Tuple(_))),
                ..
            },
            own,
        )) if matches!(unit.kind, ExprKind::Tuple(_)) => (own, Some(ty)),
        _ => (stated, None),
    }
}

impl Function {
    /// The argument of a type that stands for a parameter of the `impl`: of `Window<3>` for `N` of `impl<const N: usize> Window<N>`.
    pub fn argument_of<'t>(&self, ty: &'t Type, parameter: &str) -> Option<&'t Type> {
        let (own, args) = match (self.of.as_ref()?, ty) {
            (Type::Name(_, own), Type::Name(_, args)) | (Type::Tuple(own), Type::Tuple(args)) => {
                (own.as_slice(), args.as_slice())
            }
            (Type::Array(own, _), Type::Array(element, _)) => {
                (std::slice::from_ref(&**own), std::slice::from_ref(&**element))
            }
            _ => return None,
        };
        let mut pairs = own.iter().zip(args);
        let found = pairs.find(|(own, _)| own.is_parameter(parameter));
        found.map(|(_, arg)| arg)
    }
}

/// A constant.
#[derive(Clone, Debug)]
pub struct Const {
    /// Name, or `Type::NAME`.
    pub name: String,
    /// Generic parameters of its `impl`.
    pub generics: Vec<Generic>,
    /// Type that its `impl` is of, with its arguments.
    pub of: Option<Type>,
    /// The traits that type parameters have, by their names.
    pub bounds: HashMap<String, Vec<String>>,
    /// Trait whose default constant it is.
    pub default_of: Option<String>,
    /// Value.
    pub value: Expr,
    /// Type.
    pub ty: Type,
}

/// Name and type of each field; fields without names go by their numbers.
pub type Fields = Vec<(Name, Type, Span)>;

/// A structure.
#[derive(Clone, Debug)]
pub struct Struct {
    /// Generic parameters in order.
    pub generics: Vec<Generic>,
    /// Types of functions by the type parameters that stand for them: `Fn(f32) -> f32` of `F: Fn(f32) -> f32`.
    pub functions: HashMap<String, Type>,
    /// Fields in order.
    pub fields: Fields,
    /// The traits that it derives.
    pub derives: Vec<String>,
}

/// An enum.
#[derive(Clone, Debug)]
pub struct Enum {
    /// Generic parameters in order.
    pub generics: Vec<Generic>,
    /// Types of functions by the type parameters that stand for them.
    pub functions: HashMap<String, Type>,
    /// Variants in order.
    pub variants: Vec<EnumVariant>,
    /// The traits that it derives.
    pub derives: Vec<String>,
}

/// A variant of an enum.
#[derive(Clone, Debug)]
pub struct EnumVariant {
    /// Name of the variant.
    pub name: String,
    /// Documentation.
    pub docs: String,
    /// Fields in order.
    pub fields: Fields,
    /// Stated discriminant: the 4 of `Green = 4`.
    pub discriminant: Option<Expr>,
}

impl Enum {
    /// The position of a variant.
    pub fn position(&self, variant: &str) -> Option<usize> {
        self.variants.iter().position(|known| known.name == variant)
    }
}

/// A trait of the kernel's files: what its functions take and give, with `Self` as a type parameter.
#[derive(Clone, Debug)]
pub struct Trait {
    /// Functions by name, without bodies.
    pub functions: HashMap<String, Function>,
    /// Types of its constants.
    pub consts: HashMap<String, Type>,
    /// The traits that a type needs to have it.
    pub supers: Vec<String>,
}

/// A function or a constant that an implementation of a trait gives a type.
#[derive(Clone, Debug)]
pub struct Implemented {
    /// The trait.
    pub of: String,
    /// The trait's type arguments.
    pub args: Vec<Type>,
    /// Key in the functions or the constants of a library.
    pub key: String,
}

/// Name of a trait's function for a type: `<T as Shape>::area`. The type may be a type parameter.
pub fn qualify_name(ty: &str, of: &str, name: &str) -> String {
    format!("<{ty} as {of}>::{name}")
}

/// The type, trait and function of a name that [`qualify_name`] made.
pub fn split_qualified(text: &str) -> Option<(&str, &str, &str)> {
    let (owner, name) = text.strip_prefix('<')?.rsplit_once(">::")?;
    let (ty, of) = owner.split_once(" as ")?;
    Some((ty, of, name))
}

/// A line of `options!`.
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
    /// `true` if it is set at run time unless a setting says otherwise: `= uniform(default)`.
    pub uniform: bool,
    /// Source location of its name.
    pub span: Span,
}
