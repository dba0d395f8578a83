//! Structures and enums of the kernel's files: what their fields are, with their type parameters replaced.

use super::Checker;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::glam::public_fields;
use crate::front::name::Name;
use crate::front::tree::{Expr, ExprKind, Fields, Generic, Type};
use std::collections::HashMap;

impl<'l> Checker<'l> {
    /// The type arguments of a structure or an enum as variables.
    pub fn fresh_arguments(&mut self, generics: &[Generic]) -> Vec<Ty> {
        generics.iter().map(|_| self.table.fresh(Kind::Any)).collect()
    }

    /// Gives the arguments that stand for functions the types of these. Returns the first of another type, with the function's type.
    pub fn call_arguments(
        &mut self,
        generics: &[Generic],
        functions: &'l HashMap<String, Type>,
        args: &[Ty],
    ) -> Option<(Ty, Ty)> {
        let given = named_arguments(generics, args);
        let mut unlike = None;
        for (generic, arg) in generics.iter().zip(args) {
            if let Some(ty) = functions.get(generic.name()) {
                let wanted = self.quietly(|c| c.substitute_type(ty, &given, Span::default()));
                if !self.table.unify(arg, &wanted) {
                    unlike = unlike.or(Some((arg.clone(), wanted)));
                }
            }
        }
        unlike
    }

    /// Fields with their types, of a type with these arguments.
    pub fn fields_with(&mut self, generics: &[Generic], args: &[Ty], fields: &'l Fields) -> Vec<Ty> {
        let given = named_arguments(generics, args);
        let errors = self.errors.len();
        let types = fields.iter().map(|(_, ty, at)| self.substitute_type(ty, &given, *at));
        let types: Vec<Ty> = types.collect();
        // They are those of the item that states the fields.
        self.errors.truncate(errors);
        for ((_, ty, at), found) in fields.iter().zip(&types) {
            if let Type::Name(name, _) = ty
                && *found == Ty::Unknown
                && !given.contains_key(name)
                && !self.errors.iter().any(|error| error.span == Some(*at))
            {
                self.no_type(name, *at);
            }
        }
        types
    }

    /// Fields of a structure, or of a variant of an enum, with their types.
    pub fn fields_of(&mut self, ty: &Ty, variant: Option<usize>) -> Option<(&'l Fields, Vec<Ty>)> {
        let library = self.library;
        let (generics, args, fields) = match (ty, variant) {
            (Ty::Struct(name, args), None) => {
                let definition = library.structs.get(name)?;
                (&definition.generics, args, &definition.fields)
            }
            (Ty::Enum(name, args), Some(k)) => {
                let definition = library.enums.get(name)?;
                (&definition.generics, args, &definition.variants.get(k)?.fields)
            }
            _ => return None,
        };
        Some((fields, self.fields_with(generics, args, fields)))
    }

    /// The type that a path makes: a structure, or an enum by a variant of it; with its fields, and a name for messages.
    pub fn made_by(&mut self, path: &'l [String]) -> Option<(Ty, &'l Fields, Vec<Ty>)> {
        let library = self.library;
        if let Some((name, k, _)) = library.find_variant(path) {
            let definition = &library.enums[name];
            let args = self.fresh_arguments(&definition.generics);
            self.call_arguments(&definition.generics, &definition.functions, &args);
            let ty = Ty::Enum(name.to_owned(), args);
            let (fields, types) = self.fields_of(&ty, Some(k))?;
            return Some((ty, fields, types));
        }
        let name = path.last()?;
        let definition = library.structs.get(name)?;
        let args = self.fresh_arguments(&definition.generics);
        self.call_arguments(&definition.generics, &definition.functions, &args);
        let ty = Ty::Struct(name.clone(), args);
        let (fields, types) = self.fields_of(&ty, None)?;
        Some((ty, fields, types))
    }

    /// `Name(a, b)`, of a structure or a variant without field names; `None` of anything else.
    pub fn constructed_by(&mut self, path: &'l [String], args: &'l [Expr], span: Span) -> Option<Ty> {
        let (ty, fields, types) = self.made_by(path)?;
        if fields.iter().any(|(name, ..)| name.parse::<usize>().is_err()) {
            return None;
        }
        if args.len() != types.len() {
            let (wanted, given) = (types.len(), args.len());
            let plural = if wanted == 1 { "" } else { "s" };
            let name = path.join("::");
            let error = match wanted {
                0 => Diagnostic::error_at(
                    Code::VariantForm,
                    span,
                    format!("expected function, found unit variant `{name}`"),
                )
                .label("it holds nothing")
                .help(format!("write `{name}`")),
                _ => Diagnostic::error_at(
                    Code::ArgumentCount,
                    span,
                    format!("`{name}` takes {wanted} argument{plural}, not {given}"),
                )
                .label("made here"),
            };
            self.errors.push(error);
        }
        let made = self.check_arguments(args, &types, ty);
        for ((_, stated, _), value) in fields.iter().zip(args) {
            self.length_argument(stated, value, &made);
        }
        Some(made)
    }

    /// Finds the constant among the arguments of a structure that is the length of an array in it, from the array as it is written.
    fn length_argument(&mut self, stated: &Type, value: &Expr, made: &Ty) {
        let (Type::Array(element, Some(len)), Ty::Struct(name, args)) = (stated, made) else {
            return;
        };
        let (first, count) = match &value.kind {
            ExprKind::Array(parts) => (parts.first(), Some(parts.len() as i64)),
            ExprKind::Repeat(value, count) => (Some(&**value), count.known_constant()),
            _ => return,
        };
        let generics = &self.library.structs[name].generics;
        let is_len = |generic: &Generic| matches!(&len.kind, ExprKind::Path(path) if path.len() == 1 && path[0] == generic.name());
        if let (Some(count), Some(k)) = (count, generics.iter().position(is_len)) {
            self.table.unify(&args[k], &Ty::Const(count));
        }
        if let Some(first) = first {
            self.length_argument(element, first, made);
        }
    }

    /// `Name { field: value }`, of a structure or a variant.
    pub fn infer_struct(&mut self, path: &'l [String], fields: &'l [(Name, Expr)], rest: Option<&'l Expr>) -> Ty {
        let Some((ty, known, types)) = self.made_by(path) else {
            return self.infer_struct_of_glam(path, fields, rest);
        };
        for (field, value) in fields {
            match known.iter().position(|(name, ..)| name == field) {
                Some(k) => {
                    self.check_expr(value, &types[k]);
                    self.length_argument(&known[k].1, value, &ty);
                }
                None => {
                    self.infer_expr(value, None);
                }
            }
        }
        if let Some(rest) = rest {
            self.check_expr(rest, &ty);
        }
        ty
    }

    /// `Vec3 { x: value, .. }`, of a vector or a matrix of glam.
    fn infer_struct_of_glam(&mut self, path: &'l [String], fields: &'l [(Name, Expr)], rest: Option<&'l Expr>) -> Ty {
        let name = path.last().map(String::as_str).unwrap_or_default();
        let known = public_fields(name, Span::default());
        for (field, value) in fields {
            let stated = known.iter().flatten().find(|(name, ..)| name == field);
            match stated {
                Some((_, Type::Name(part, _), at)) => {
                    let part = self.convert_named_type(part, &[], &HashMap::new(), *at);
                    self.check_expr(value, &part);
                }
                _ => {
                    self.infer_expr(value, None);
                }
            }
        }
        let ty = match known {
            Some(_) => self.convert_named_type(name, &[], &HashMap::new(), Span::default()),
            None => Ty::Unknown,
        };
        if let Some(rest) = rest {
            self.check_expr(rest, &ty);
        }
        ty
    }

    /// `value?`: what it holds, where the function may end with what it has instead.
    pub fn infer_try(&mut self, value: &'l Expr, span: Span) -> Ty {
        let found = self.infer_expr(value, None);
        if self.table.variable_kind(&found) == Some(Kind::Any) {
            self.solve_deferred();
        }
        let result = self.table.resolve_shallow(&self.result.clone());
        match self.table.resolve_shallow(&found) {
            Ty::Enum(name, args) if name == "Option" && args.len() == 1 => {
                let other = self.table.fresh(Kind::Any);
                self.ends_with(&result, Ty::Enum(name, vec![other]), span);
                args[0].clone()
            }
            Ty::Enum(name, args) if name == "Result" && args.len() == 2 => {
                let other = self.table.fresh(Kind::Any);
                self.ends_with(&result, Ty::Enum(name, vec![other, args[1].clone()]), span);
                args[0].clone()
            }
            Ty::Unknown | Ty::Param(_) | Ty::Never | Ty::Var(_) => Ty::Unknown,
            other => {
                let shown = self.table.resolve_deep(&other);
                self.errors.push(
                    Diagnostic::error_at(
                        Code::QuestionMark,
                        span,
                        format!("the `?` operator can only be applied to an `Option` or a `Result`, not to `{shown}`"),
                    )
                    .label("not an `Option`")
                    .help("leave out the `?`"),
                );
                Ty::Unknown
            }
        }
    }

    /// Checks the type that `?` returns from the function if there is no value.
    fn ends_with(&mut self, result: &Ty, wanted: Ty, span: Span) {
        if self.table.unify(result, &wanted) {
            return;
        }
        let (result, wanted) = (self.table.resolve_deep(result), self.table.resolve_deep(&wanted));
        self.errors.push(
            Diagnostic::error_at(
                Code::QuestionMark,
                span,
                format!("the `?` operator in a function that gives `{result}`"),
            )
            .label(format!("the function would have to give `{wanted}`"))
            .help("take the value apart with `let ... else`, or give what is to be there instead with `unwrap_or(..)`"),
        );
    }
}

/// Type arguments by the names of their parameters.
fn named_arguments(generics: &[Generic], args: &[Ty]) -> HashMap<String, Ty> {
    let named = generics.iter().zip(args);
    named
        .map(|(generic, ty)| (generic.name().to_owned(), ty.clone()))
        .collect()
}
