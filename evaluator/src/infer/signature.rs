//! Types as written, and what their parts are.

use super::Checker;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::textures::TextureType;
use crate::front::tree::{Expr, ExprKind, Function, Generic, IntType, Type, generic_arguments};
use std::collections::HashMap;

pub use crate::front::tree::vector_named as vector;

impl<'l> Checker<'l> {
    /// The type that is written at `span`.
    pub fn convert_type(&mut self, ty: &'l Type, span: Span) -> Ty {
        self.check_array_lengths(ty);
        self.substitute_type(ty, &HashMap::new(), span)
    }

    /// Looks at the lengths of arrays in a type, which are expressions of the item that states it.
    pub fn check_array_lengths(&mut self, ty: &'l Type) {
        match ty {
            Type::Ref(_, inner) => self.check_array_lengths(inner),
            Type::Name(_, args) | Type::Tuple(args) => args.iter().for_each(|arg| self.check_array_lengths(arg)),
            Type::Fn(params, result) => {
                params.iter().for_each(|param| self.check_array_lengths(param));
                self.check_array_lengths(result);
            }
            // No type depends on it.
            Type::Const(_) => {}
            Type::Array(element, len) => {
                self.check_array_lengths(element);
                if let Some(len) = len {
                    let known = self.errors.len();
                    self.check_expr(len, &Ty::USIZE);
                    if let (Some(error), ExprKind::Path(path)) = (self.errors.get_mut(known), &len.kind)
                        && error.code() == Some(Code::MismatchedTypes)
                    {
                        error.help = Some(format!("declare it as `const {}: usize`", path.join("::")));
                    }
                }
            }
        }
    }

    /// A type of another function, its type parameters replaced.
    pub fn substitute_type(&mut self, ty: &'l Type, given: &HashMap<String, Ty>, span: Span) -> Ty {
        match ty {
            Type::Ref(mutable, inner) => Ty::Ref(*mutable, Box::new(self.substitute_type(inner, given, span))),
            Type::Tuple(parts) => Ty::Tuple(parts.iter().map(|p| self.substitute_type(p, given, span)).collect()),
            Type::Array(element, _) => Ty::Array(Box::new(self.substitute_type(element, given, span))),
            Type::Fn(params, result) => Ty::Fn(
                params.iter().map(|p| self.substitute_type(p, given, span)).collect(),
                Box::new(self.substitute_type(result, given, span)),
            ),
            Type::Name(name, args) => self.convert_named_type(name, args, given, span),
            Type::Const(_) => Ty::Unknown,
        }
    }

    /// A constant among the arguments of a type, as far as it is a literal, a constant that is one, or known by its name.
    fn constant_argument(&mut self, argument: &'l Type, given: &HashMap<String, Ty>) -> Ty {
        let name = match argument {
            Type::Const(value) => match (&value.kind, value.known_constant()) {
                (_, Some(value)) => return Ty::Const(value),
                (ExprKind::Path(path), None) if path.len() == 1 => Some(&path[0]),
                _ => None,
            },
            Type::Name(name, args) if args.is_empty() => Some(name),
            _ => None,
        };
        let known = name.and_then(|name| given.get(name)).cloned();
        let constant = || {
            let name = name.filter(|name| self.locals.iter().all(|local| local.name != **name))?;
            self.library.consts.get(name)?.value.known_constant().map(Ty::Const)
        };
        known.or_else(constant).unwrap_or_else(|| self.table.fresh(Kind::Any))
    }

    pub fn convert_named_type(&mut self, name: &str, args: &'l [Type], given: &HashMap<String, Ty>, span: Span) -> Ty {
        if let Some(ty) = given.get(name) {
            return ty.clone();
        }
        if self.params.iter().any(|param| param == name) {
            return Ty::Param(name.to_owned());
        }
        let library = self.library;
        if let Some(definition) = library.enums.get(name) {
            return Ty::Enum(
                name.to_owned(),
                self.convert_arguments(&definition.generics, args, given, span),
            );
        }
        if let Some(definition) = library.structs.get(name) {
            return Ty::Struct(
                name.to_owned(),
                self.convert_arguments(&definition.generics, args, given, span),
            );
        }
        if let Some((kind, lanes)) = vector(name) {
            return Ty::Vector(kind, lanes);
        }
        if let Some(kind) = IntType::from_name(name) {
            return Ty::Int(kind);
        }
        let mut texel = || match args {
            [texel] => self.substitute_type(texel, given, span),
            _ => Ty::Unknown,
        };
        match name {
            "f32" => Ty::Float,
            "bool" => Ty::Bool,
            "str" => Ty::Str,
            "Mat2" => Ty::Matrix(2),
            "Mat3" => Ty::Matrix(3),
            "Mat4" => Ty::Matrix(4),
            "Quad" => Ty::Quad(Box::new(texel())),
            "Range" | "RangeInclusive" => Ty::Range(Box::new(texel())),
            "Buffer" => Ty::Buffer(Box::new(texel())),
            "Shared" | "AtomicShared" => {
                let element = match texel() {
                    Ty::Array(element) => element,
                    _ => Box::new(Ty::Unknown),
                };
                let kind = if name == "Shared" { "Shared" } else { "AtomicShared" };
                Ty::Storage(kind, element)
            }
            "AtomicBuffer" => Ty::Storage("AtomicBuffer", Box::new(texel())),
            "StorageBuffer" => Ty::Storage("StorageBuffer", Box::new(texel())),
            "StorageTexture" => Ty::Storage("StorageTexture", Box::new(texel())),
            "Sampler" => Ty::Sampler,
            "ComparisonSampler" => Ty::ComparisonSampler,
            "_" => self.table.fresh(Kind::Any),
            // A value of one type or another: its methods are those of the trait.
            _ if name.starts_with("dyn ") => {
                self.check_trait_object(name, span);
                Ty::Param(name.to_owned())
            }
            _ => match TextureType::from_name(name) {
                Some(of) if of.kind.is_depth() => Ty::Texture(of, Box::new(Ty::Float)),
                Some(of) => Ty::Texture(of, Box::new(texel())),
                None => {
                    self.unknown_type(name, span);
                    Ty::Unknown
                }
            },
        }
    }

    /// The type arguments of a structure or an enum; those that are not written are to be found.
    fn convert_arguments(
        &mut self,
        generics: &[Generic],
        args: &'l [Type],
        given: &HashMap<String, Ty>,
        span: Span,
    ) -> Vec<Ty> {
        let each = generics
            .iter()
            .enumerate()
            .map(|(k, generic)| match (generic, args.get(k)) {
                (Generic::Type(_), Some(ty)) => self.substitute_type(ty, given, span),
                (Generic::Const(..), Some(argument)) => self.constant_argument(argument, given),
                (_, None) => self.table.fresh(Kind::Any),
            });
        each.collect()
    }

    fn unknown_type(&mut self, name: &str, span: Span) {
        let help = match name {
            "f64" => "use `f32`, which is what shaders compute in",
            "i64" | "i128" | "isize" => "use `i32`",
            "u64" | "u128" => "use `u32`",
            "Vec3A" => "use `Vec3`",
            _ => {
                "use numbers, vectors, matrices, arrays, tuples, the prelude's resources, or structures and enums of the kernel's files"
            }
        };
        self.errors.push(
            Diagnostic::error_at(
                Code::NotInLanguage,
                span,
                format!("the type `{name}` is not part of the kernel language"),
            )
            .label("of this type")
            .help(help),
        );
    }

    /// A type in `::<>`, written as what has it.
    fn type_argument(&mut self, stated: &'l Expr) -> Ty {
        match &stated.kind {
            ExprKind::Path(path) if path.len() == 1 => {
                self.convert_named_type(&path[0], &[], &HashMap::new(), stated.span)
            }
            ExprKind::Cast(_, ty) => self.convert_type(ty, stated.span),
            ExprKind::Repeat(element, _) => Ty::Array(Box::new(self.type_argument(element))),
            ExprKind::Tuple(parts) if !parts.is_empty() => {
                Ty::Tuple(parts.iter().map(|part| self.type_argument(part)).collect())
            }
            _ => self.table.fresh(Kind::Any),
        }
    }

    /// Type parameters of a function as variables: those stated in `::<>`, the others to be found.
    pub fn instantiate_function(&mut self, function: &'l Function, stated: &'l [Expr]) -> HashMap<String, Ty> {
        let mut given = HashMap::new();
        let (stated, owner) = generic_arguments(stated);
        for (k, generic) in function.generics.iter().enumerate() {
            match generic {
                Generic::Type(name) => {
                    let of_owner = owner.and_then(|owner| function.argument_of(owner, name));
                    let ty = match (stated.get(k), of_owner) {
                        (Some(stated), _) if !is_inferred(stated) => self.type_argument(stated),
                        (_, Some(ty)) => self.convert_type(ty, function.span),
                        _ => self.table.fresh(Kind::Any),
                    };
                    given.insert(name.clone(), ty);
                }
                Generic::Const(name, ty) => {
                    let constant = stated.get(k).filter(|stated| !is_inferred(stated));
                    if let Some(constant) = constant {
                        let ty = self.substitute_type(ty, &HashMap::new(), constant.span);
                        self.check_expr(constant, &ty);
                    }
                    let of_owner = owner.and_then(|owner| function.argument_of(owner, name));
                    let value = match (constant.map(Expr::known_constant), of_owner) {
                        (Some(Some(value)), _) => Ty::Const(value),
                        (None, Some(argument)) => self.constant_argument(argument, &HashMap::new()),
                        _ => self.table.fresh(Kind::Any),
                    };
                    given.insert(name.clone(), value);
                }
            }
        }
        given
    }
}

/// Returns whether a generic argument is `_`.
fn is_inferred(stated: &Expr) -> bool {
    matches!(&stated.kind, ExprKind::Path(path) if path == &[crate::front::INFERRED])
}
