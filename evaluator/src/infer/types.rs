//! Types, and variables that stand for those not found yet.

use crate::front::textures::TextureType;
use crate::front::tree::IntType;
use crate::ir::Scalar;
use std::fmt;

/// A type of the kernel language.
#[derive(Clone, Debug, PartialEq)]
pub enum Ty {
    /// To be found.
    Var(u32),
    /// `bool`.
    Bool,
    /// `i32`, `u32`, `usize`.
    Int(IntType),
    /// `f32`.
    Float,
    /// `Vec2` to `UVec4`.
    Vector(Scalar, u8),
    /// `Mat2` to `Mat4`.
    Matrix(u8),
    /// `str`.
    Str,
    /// `(A, B)`.
    Tuple(Vec<Ty>),
    /// `[T; N]` and `[T]`; lengths are compared by the evaluator, which knows them.
    Array(Box<Ty>),
    /// `a..b`.
    Range(Box<Ty>),
    /// Iterator, as `.iter()` and the like return it.
    Iter(Box<Ty>),
    /// A structure of the kernel's files, with its type arguments.
    Struct(String, Vec<Ty>),
    /// An enum of the kernel's files or of Rust, with its type arguments.
    Enum(String, Vec<Ty>),
    /// A value in each lane of a pixel quad.
    Quad(Box<Ty>),
    /// A texture of the prelude by its name, and its texel.
    Texture(&'static TextureType, Box<Ty>),
    /// `Sampler`.
    Sampler,
    /// `ComparisonSampler`.
    ComparisonSampler,
    /// `Buffer<T>`.
    Buffer(Box<Ty>),
    /// A buffer that is written, by the name of its type in the prelude, and its element.
    Storage(&'static str, Box<Ty>),
    /// `&T`, `&mut T` (true).
    Ref(bool, Box<Ty>),
    /// A function or closure: its parameters and its result.
    Fn(Vec<Ty>, Box<Ty>),
    /// A type parameter of the function that is looked at.
    Param(String),
    /// A constant among the arguments of a type: the 3 of `Window<3>`.
    Const(i64),
    /// Of what never gives a value: `return`, `break`.
    Never,
    /// Nothing is known of it, and nothing is said against it.
    Unknown,
}

impl Ty {
    /// `()`.
    pub const UNIT: Ty = Ty::Tuple(Vec::new());
    /// `i32`.
    pub const I32: Ty = Ty::Int(IntType::I32);
    /// `u32`.
    pub const U32: Ty = Ty::Int(IntType::U32);
    /// `usize`.
    pub const USIZE: Ty = Ty::Int(IntType::Usize);

    /// A component of a vector.
    pub fn scalar(kind: Scalar) -> Ty {
        match kind {
            Scalar::Bool => Ty::Bool,
            Scalar::I32 => Ty::I32,
            Scalar::U32 => Ty::U32,
            Scalar::Usize => Ty::USIZE,
            Scalar::F32 => Ty::Float,
        }
    }

    /// `&T`.
    pub fn into_shared_ref(self) -> Ty {
        Ty::Ref(false, Box::new(self))
    }

    /// Component types, for traversals.
    fn parts(&self) -> Vec<&Ty> {
        match self {
            Ty::Tuple(parts) | Ty::Struct(_, parts) | Ty::Enum(_, parts) => parts.iter().collect(),
            Ty::Array(t) | Ty::Range(t) | Ty::Iter(t) | Ty::Quad(t) | Ty::Texture(_, t) | Ty::Buffer(t) => vec![t],
            Ty::Storage(_, t) => vec![t],
            Ty::Ref(_, t) => vec![t],
            Ty::Fn(params, result) => params.iter().chain([&**result]).collect(),
            _ => Vec::new(),
        }
    }
}

/// Types that a variable may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Anything.
    Any,
    /// An integer: it is of a literal without a suffix.
    Integer,
    /// A float: it is of a literal.
    Float,
}

/// All variables of a function.
#[derive(Clone, Debug, Default)]
pub struct Table {
    variables: Vec<Result<Ty, Kind>>,
}

impl Table {
    /// A new variable.
    pub fn fresh(&mut self, kind: Kind) -> Ty {
        self.variables.push(Err(kind));
        Ty::Var(self.variables.len() as u32 - 1)
    }

    /// The type as far as its outermost part is known.
    pub fn resolve_shallow(&self, ty: &Ty) -> Ty {
        let mut ty = ty;
        while let Ty::Var(v) = ty {
            match &self.variables[*v as usize] {
                Ok(found) => ty = found,
                Err(_) => break,
            }
        }
        ty.clone()
    }

    /// Returns the types that an unknown variable may take; `None` for a type that is known.
    pub fn variable_kind(&self, ty: &Ty) -> Option<Kind> {
        match self.resolve_shallow(ty) {
            Ty::Var(v) => self.variables[v as usize].as_ref().err().copied(),
            _ => None,
        }
    }

    /// The type with all that is known of its parts.
    pub fn resolve_deep(&self, ty: &Ty) -> Ty {
        let boxed = |t: &Ty| Box::new(self.resolve_deep(t));
        match self.resolve_shallow(ty) {
            Ty::Tuple(parts) => Ty::Tuple(parts.iter().map(|p| self.resolve_deep(p)).collect()),
            Ty::Struct(name, args) => Ty::Struct(name, args.iter().map(|p| self.resolve_deep(p)).collect()),
            Ty::Enum(name, args) => Ty::Enum(name, args.iter().map(|p| self.resolve_deep(p)).collect()),
            Ty::Array(t) => Ty::Array(boxed(&t)),
            Ty::Range(t) => Ty::Range(boxed(&t)),
            Ty::Iter(t) => Ty::Iter(boxed(&t)),
            Ty::Quad(t) => Ty::Quad(boxed(&t)),
            Ty::Texture(name, t) => Ty::Texture(name, boxed(&t)),
            Ty::Buffer(t) => Ty::Buffer(boxed(&t)),
            Ty::Storage(name, t) => Ty::Storage(name, boxed(&t)),
            Ty::Ref(mutable, t) => Ty::Ref(mutable, boxed(&t)),
            Ty::Fn(params, result) => Ty::Fn(params.iter().map(|p| self.resolve_deep(p)).collect(), boxed(&result)),
            other => other,
        }
    }

    /// Number of parts of a type, counted up to `limit`.
    pub fn size(&self, ty: &Ty, limit: usize) -> usize {
        let mut sum = 1;
        for part in self.resolve_shallow(ty).parts() {
            if sum > limit {
                break;
            }
            sum += self.size(part, limit - sum);
        }
        sum
    }

    /// Makes two types one; false if they differ. Of what is not known, nothing is refused.
    pub fn unify(&mut self, a: &Ty, b: &Ty) -> bool {
        let (a, b) = (self.resolve_shallow(a), self.resolve_shallow(b));
        match (&a, &b) {
            (Ty::Var(x), Ty::Var(y)) if x == y => true,
            (Ty::Var(x), Ty::Var(y)) => {
                let (of_x, of_y) = (self.variables[*x as usize].clone(), self.variables[*y as usize].clone());
                match (of_x, of_y) {
                    (Err(Kind::Integer), Err(Kind::Float)) | (Err(Kind::Float), Err(Kind::Integer)) => false,
                    (Err(Kind::Any), _) => self.bind(*x, b),
                    _ => self.bind(*y, a),
                }
            }
            (Ty::Var(v), ty) | (ty, Ty::Var(v)) => {
                let fits = match self.variables[*v as usize] {
                    Err(Kind::Integer) => matches!(ty, Ty::Int(_) | Ty::Unknown | Ty::Never | Ty::Param(_)),
                    Err(Kind::Float) => matches!(ty, Ty::Float | Ty::Unknown | Ty::Never | Ty::Param(_)),
                    _ => !self.occurs(*v, ty),
                };
                match ty {
                    // An expression that never returns determines no other type.
                    Ty::Never => fits,
                    _ => fits && self.bind(*v, ty.clone()),
                }
            }
            (Ty::Never | Ty::Unknown | Ty::Param(_), _) | (_, Ty::Never | Ty::Unknown | Ty::Param(_)) => {
                self.taint(&a);
                self.taint(&b);
                true
            }
            (Ty::Tuple(xs), Ty::Tuple(ys)) => xs.len() == ys.len() && xs.iter().zip(ys).all(|(x, y)| self.unify(x, y)),
            (Ty::Struct(x, xs), Ty::Struct(y, ys)) | (Ty::Enum(x, xs), Ty::Enum(y, ys)) => {
                x == y && xs.len() == ys.len() && xs.iter().zip(ys).all(|(x, y)| self.unify(x, y))
            }
            (Ty::Fn(xs, r), Ty::Fn(ys, s)) => {
                xs.len() == ys.len() && xs.iter().zip(ys).all(|(x, y)| self.unify(x, y)) && self.unify(r, s)
            }
            (Ty::Texture(x, s), Ty::Texture(y, t)) => x.name == y.name && self.unify(s, t),
            (Ty::Storage(x, s), Ty::Storage(y, t)) => x == y && self.unify(s, t),
            (Ty::Array(s), Ty::Array(t))
            | (Ty::Range(s), Ty::Range(t))
            | (Ty::Iter(s), Ty::Iter(t))
            | (Ty::Quad(s), Ty::Quad(t))
            | (Ty::Buffer(s), Ty::Buffer(t)) => self.unify(s, t),
            (Ty::Ref(m, s), Ty::Ref(n, t)) => m == n && self.unify(s, t),
            _ => a == b,
        }
    }

    fn bind(&mut self, variable: u32, ty: Ty) -> bool {
        self.variables[variable as usize] = Ok(ty);
        true
    }

    fn occurs(&self, variable: u32, ty: &Ty) -> bool {
        match self.resolve_shallow(ty) {
            Ty::Var(v) => v == variable,
            other => other.parts().into_iter().any(|part| self.occurs(variable, part)),
        }
    }

    /// Marks a type that is unified with an unknown one as unknown: its literals take their types from the values that they meet.
    fn taint(&mut self, ty: &Ty) {
        match self.resolve_shallow(ty) {
            Ty::Var(v) => {
                self.bind(v, Ty::Unknown);
            }
            other => {
                for part in other.parts() {
                    self.taint(part);
                }
            }
        }
    }
}

impl fmt::Display for Ty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Ty::Var(_) | Ty::Unknown => f.write_str("_"),
            Ty::Bool => f.write_str("bool"),
            Ty::Int(kind) => f.write_str(kind.name()),
            Ty::Float => f.write_str("f32"),
            Ty::Vector(kind, lanes) => {
                let prefix = match kind {
                    Scalar::F32 => "",
                    Scalar::I32 => "I",
                    Scalar::U32 => "U",
                    Scalar::Bool => "B",
                    Scalar::Usize => "usize",
                };
                write!(f, "{prefix}Vec{lanes}")
            }
            Ty::Matrix(n) => write!(f, "Mat{n}"),
            Ty::Str => f.write_str("str"),
            Ty::Tuple(parts) => {
                f.write_str("(")?;
                for (k, part) in parts.iter().enumerate() {
                    write!(f, "{}{part}", if k > 0 { ", " } else { "" })?;
                }
                f.write_str(if parts.len() == 1 { ",)" } else { ")" })
            }
            Ty::Array(t) => write!(f, "[{t}]"),
            Ty::Range(t) => write!(f, "Range<{t}>"),
            Ty::Iter(t) => write!(f, "an iterator over {t}"),
            Ty::Param(name) => f.write_str(name),
            Ty::Const(value) => write!(f, "{value}"),
            Ty::Struct(name, args) | Ty::Enum(name, args) if args.is_empty() => f.write_str(name),
            Ty::Struct(name, args) | Ty::Enum(name, args) => {
                let args: Vec<String> = args.iter().map(Ty::to_string).collect();
                write!(f, "{name}<{}>", args.join(", "))
            }
            Ty::Quad(t) => write!(f, "Quad<{t}>"),
            Ty::Texture(of, _) if of.kind.is_depth() => f.write_str(of.name),
            Ty::Texture(of, t) => write!(f, "{}<{t}>", of.name),
            Ty::Sampler => f.write_str("Sampler"),
            Ty::ComparisonSampler => f.write_str("ComparisonSampler"),
            Ty::Buffer(t) => write!(f, "Buffer<{t}>"),
            Ty::Storage(name, t) => write!(f, "{name}<{t}>"),
            Ty::Fn(params, result) => {
                let params: Vec<String> = params.iter().map(Ty::to_string).collect();
                write!(f, "impl Fn({})", params.join(", "))?;
                match **result == Ty::UNIT {
                    true => Ok(()),
                    false => write!(f, " -> {result}"),
                }
            }
            Ty::Ref(true, t) => write!(f, "&mut {t}"),
            Ty::Ref(false, t) => write!(f, "&{t}"),
            Ty::Never => f.write_str("!"),
        }
    }
}
