//! Types of random kernels and what functions take.

use super::orders::Order;
use super::{Feature, Hold, Maker};

/// Numbers in a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lane {
    F,
    I,
    U,
}

/// A type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ty {
    Bool,
    I32,
    U32,
    Usize,
    F32,
    Vec(Lane, u8),
    Mat(u8),
    Array(Box<Ty>, usize),
    Tuple(Vec<Ty>),
    Struct(usize),
    Enum(usize),
    Option(Box<Ty>),
    /// An enum that holds values.
    Choice(usize),
}

/// A structure with its methods.
#[derive(Clone, Debug)]
pub struct Structure {
    pub name: String,
    /// Names are numbers if it is a tuple structure.
    pub fields: Vec<(String, Ty)>,
    pub tuple: bool,
    /// `true` if it is `Copy`.
    pub copy: bool,
    /// `true` if it has operators.
    pub operators: bool,
    pub order: Order,
}

/// An enum that holds values.
#[derive(Clone, Debug)]
pub struct Choice {
    pub name: String,
    /// Name of each variant, what it holds, and whether its fields have names.
    pub variants: Vec<(String, Vec<Ty>, bool)>,
    pub order: Order,
}

/// An enum.
#[derive(Clone, Debug)]
pub struct Enumeration {
    pub name: String,
    pub variants: Vec<String>,
    pub order: Order,
}

/// A parameter.
#[derive(Clone, Debug)]
pub struct Param {
    pub name: String,
    pub ty: Ty,
    pub hold: Hold,
    /// Bounds of an argument that must be a compile-time constant.
    pub known: Option<(i64, i64)>,
}

/// A function as its callers see it.
#[derive(Clone, Debug)]
pub struct Signature {
    /// Name, with `S0::` for associated functions.
    pub name: String,
    /// The structure that it is a method of, and how it takes it.
    pub receiver: Option<(Ty, Hold)>,
    /// `true` if the inputs are its first parameters.
    pub inputs: bool,
    pub params: Vec<Param>,
    pub result: Option<Ty>,
    /// `true` if its result is a compile-time constant.
    pub known: bool,
    pub cost: u32,
}

impl Signature {
    /// Returns whether calling it may change a variable.
    pub fn changes(&self) -> bool {
        self.params.iter().any(|p| p.hold == Hold::Mutable) || matches!(self.receiver, Some((_, Hold::Mutable)))
    }
}

impl Ty {
    pub fn array(of: Ty, len: usize) -> Ty {
        Ty::Array(Box::new(of), len)
    }

    /// A number, a boolean or a vector of numbers: what an array may hold that a runtime value indexes.
    pub fn plain(&self) -> bool {
        matches!(self, Ty::I32 | Ty::U32 | Ty::F32 | Ty::Vec(..))
    }

    pub fn integer(&self) -> bool {
        matches!(self, Ty::I32 | Ty::U32 | Ty::Usize)
    }

    pub fn lane(&self) -> Option<Ty> {
        match self {
            Ty::Vec(Lane::F, _) => Some(Ty::F32),
            Ty::Vec(Lane::I, _) => Some(Ty::I32),
            Ty::Vec(Lane::U, _) => Some(Ty::U32),
            _ => None,
        }
    }
}

impl Maker {
    /// A type as Rust writes it.
    pub(super) fn ty(&self, ty: &Ty) -> String {
        match ty {
            Ty::Bool => "bool".to_owned(),
            Ty::I32 => "i32".to_owned(),
            Ty::U32 => "u32".to_owned(),
            Ty::Usize => "usize".to_owned(),
            Ty::F32 => "f32".to_owned(),
            Ty::Vec(lane, n) => format!("{}{n}", vector(*lane)),
            Ty::Mat(n) => format!("Mat{n}"),
            Ty::Array(of, len) => format!("[{}; {len}]", self.ty(of)),
            Ty::Tuple(parts) => {
                let parts: Vec<String> = parts.iter().map(|p| self.ty(p)).collect();
                format!("({})", parts.join(", "))
            }
            Ty::Struct(k) => self.structures[*k].name.clone(),
            Ty::Enum(k) => self.enumerations[*k].name.clone(),
            Ty::Option(of) => format!("Option<{}>", self.ty(of)),
            Ty::Choice(k) => self.choices[*k].name.clone(),
        }
    }

    /// Returns whether values of a type can be copied.
    pub(super) fn copies(&self, ty: &Ty) -> bool {
        match ty {
            Ty::Struct(k) => self.structures[*k].copy,
            _ => true,
        }
    }

    /// A number or vector type.
    pub(super) fn plain_type(&mut self) -> Ty {
        match self.random.below(12) {
            0..=3 => Ty::F32,
            4..=5 => Ty::U32,
            6..=7 => Ty::I32,
            _ => self.vector_type(),
        }
    }

    pub(super) fn vector_type(&mut self) -> Ty {
        let lane = self.random.pick(&[Lane::F, Lane::F, Lane::F, Lane::I, Lane::U]);
        Ty::Vec(lane, self.random.between(2, 4) as u8)
    }

    /// A type for a field or a part of a tuple.
    pub(super) fn part_type(&mut self) -> Ty {
        match self.random.below(12) {
            0..=6 => self.plain_type(),
            7 => Ty::Bool,
            8 => Ty::Usize,
            10 if self.on(Feature::Choices) => Ty::Option(Box::new(self.plain_type())),
            9 if self.on(Feature::Nested) => self.copyable_structure().unwrap_or(Ty::F32),
            _ => {
                let of = self.plain_type();
                Ty::array(of, self.random.between(2, 3) as usize)
            }
        }
    }

    fn copyable_structure(&mut self) -> Option<Ty> {
        let all: Vec<usize> = (0..self.structures.len())
            .filter(|k| self.structures[*k].copy)
            .collect();
        (!all.is_empty()).then(|| Ty::Struct(self.random.pick(&all)))
    }

    /// Any type that a variable may have.
    pub(super) fn any_type(&mut self) -> Ty {
        match self.random.below(24) {
            0..=9 => self.plain_type(),
            10 => Ty::Bool,
            11 => Ty::Usize,
            12..=15 => {
                let of = self.plain_type();
                Ty::array(of, self.random.between(1, 4) as usize)
            }
            16 if self.on(Feature::Nested) => match self.copyable_structure() {
                Some(of) => Ty::array(of, self.random.between(2, 3) as usize),
                None => Ty::array(Ty::array(Ty::F32, 2), 2),
            },
            17 if self.on(Feature::Nested) => match self.random.below(3) {
                0 => Ty::array(Ty::array(Ty::U32, 2), 2),
                1 => Ty::array(Ty::Tuple(vec![Ty::U32, Ty::F32]), 2),
                _ => Ty::array(Ty::array(Ty::F32, 3), 2),
            },
            18 | 19 => {
                let parts = self.random.between(2, 3);
                Ty::Tuple((0..parts).map(|_| self.part_type()).collect())
            }
            20 if self.on(Feature::Matrices) => Ty::Mat(self.random.between(2, 4) as u8),
            21 if self.on(Feature::Choices) => match self.choices.len() {
                n if n > 0 && self.random.once_in(2) => Ty::Choice(self.random.below(n)),
                _ => Ty::Option(Box::new(self.plain_type())),
            },
            _ if self.structures.is_empty() => Ty::F32,
            _ => Ty::Struct(self.random.below(self.structures.len())),
        }
    }
}

/// Name of vectors without their length.
pub fn vector(lane: Lane) -> &'static str {
    match lane {
        Lane::F => "Vec",
        Lane::I => "IVec",
        Lane::U => "UVec",
    }
}
