//! Patterns: what they bind, and what they compare with.

use super::Checker;
use super::types::Ty;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::name::Name;
use crate::front::tree::{EnumVariant, Expr, ExprKind, Pattern};
use crate::ir::UnaryOp;

impl<'l> Checker<'l> {
    /// Binds the names of a whole pattern, each of which it may have once.
    pub fn bind_whole(&mut self, pattern: &'l Pattern, ty: &Ty, deferred: bool) {
        let mark = self.locals.len();
        self.bind_pattern(pattern, ty, deferred);
        for k in mark..self.locals.len() {
            let local = &self.locals[k];
            if self.locals[mark..k].iter().any(|other| other.name == local.name) {
                let (name, span) = (local.name.clone(), local.span);
                self.bound_twice(&name, span, "pattern");
            }
        }
    }

    /// Binds the names of a pattern to the parts of a value of a type. What a reference is taken apart into are references.
    fn bind_pattern(&mut self, pattern: &'l Pattern, ty: &Ty, deferred: bool) {
        if let Pattern::Name(name, mutable, span) = pattern {
            return self.declare_local(name, ty.clone(), *mutable, deferred, *span);
        }
        if let Pattern::Ref(inner, span) = pattern {
            let referred = match self.table.resolve_shallow(ty) {
                Ty::Ref(_, referred) => *referred,
                Ty::Unknown | Ty::Param(_) | Ty::Never => Ty::Unknown,
                other => {
                    let any = self.table.fresh(super::Kind::Any);
                    self.coerce(&other, &any.clone().into_shared_ref(), *span);
                    any
                }
            };
            return self.bind_pattern(inner, &referred, deferred);
        }
        if let Pattern::At(name, mutable, inner, span) = pattern {
            self.declare_local(name, ty.clone(), *mutable, deferred, *span);
            return self.bind_pattern(inner, ty, deferred);
        }
        let (bare, reference) = self.peel_refs(ty);
        let through = |part: Ty| match reference {
            Some(mutable) => Ty::Ref(mutable, Box::new(part)),
            None => part,
        };
        match pattern {
            Pattern::Name(..) | Pattern::Wild | Pattern::Rest | Pattern::Ref(..) | Pattern::At(..) => {}
            Pattern::Tuple(parts, span) => match &bare {
                Ty::Tuple(types) if Pattern::part_ranges(parts, types.len()).is_some() => {
                    for (part, taken) in Pattern::part_ranges(parts, types.len()).into_iter().flatten() {
                        if !part.is_rest() {
                            self.bind_pattern(part, &through(types[taken.start].clone()), deferred);
                        }
                    }
                }
                Ty::Unknown | Ty::Param(_) | Ty::Never => self.bind_unknown(parts, deferred),
                other => {
                    let types: Vec<Ty> = parts.iter().map(|_| self.table.fresh(super::Kind::Any)).collect();
                    self.coerce(other, &Ty::Tuple(types.clone()), *span);
                    for (part, ty) in parts.iter().zip(types) {
                        self.bind_pattern(part, &through(ty), deferred);
                    }
                }
            },
            Pattern::Array(parts, span) => match &bare {
                Ty::Array(element) => {
                    let one = through((**element).clone());
                    let rest = through(Ty::Array(element.clone()));
                    for part in parts {
                        self.bind_pattern(part, if part.is_rest() { &rest } else { &one }, deferred);
                    }
                }
                Ty::Unknown | Ty::Param(_) | Ty::Never => self.bind_unknown(parts, deferred),
                other => {
                    let element = self.table.fresh(super::Kind::Any);
                    self.coerce(other, &Ty::Array(Box::new(element.clone())), *span);
                    parts
                        .iter()
                        .for_each(|part| self.bind_pattern(part, &through(element.clone()), deferred));
                }
            },
            Pattern::Struct(path, fields, span) => {
                let parts = self.parts_of_pattern(path, fields, &bare, *span);
                for ((_, part), ty) in fields.iter().zip(parts) {
                    self.bind_pattern(part, &through(ty), deferred);
                }
            }
            Pattern::Or(cases) => {
                // Every case binds the same names: those of the first are the ones that the arm sees.
                let mark = self.locals.len();
                for (k, case) in cases.iter().enumerate() {
                    let kept = self.locals.len();
                    self.bind_pattern(case, ty, deferred);
                    if k > 0 {
                        let again = self.locals.split_off(kept);
                        for local in again {
                            let first = self.locals[mark..].iter().find(|l| l.name == local.name);
                            if let Some(first) = first.map(|l| l.ty.clone()) {
                                self.coerce(&first, &local.ty, local.span);
                            }
                        }
                    }
                }
            }
            Pattern::Value(expr) => {
                let known = match &expr.kind {
                    // A constant or a variant.
                    ExprKind::Path(path) => {
                        if let Some((_, _, variant)) = self.library.find_variant(path)
                            && !variant.fields.is_empty()
                        {
                            self.holds_data(path, variant, expr.span);
                            return;
                        }
                        self.infer_expr(expr, None)
                    }
                    _ => self.infer_expr(expr, Some(&bare)),
                };
                self.coerce(&bare, &known, expr.span);
            }
            Pattern::Range(low, high, _) => {
                let ends = [low, high].into_iter().flatten();
                ends.for_each(|end| self.check_expr(end, &bare));
                self.not_backwards(pattern);
            }
        }
    }

    /// The types of what the fields of a pattern `Name { field: part }` or `Name(part)` take.
    fn parts_of_pattern(
        &mut self,
        path: &'l [String],
        fields: &'l [(Name, Pattern)],
        bare: &Ty,
        span: Span,
    ) -> Vec<Ty> {
        let Some((ty, known, types)) = self.made_by(path) else {
            let of = |field: &(Name, Pattern)| match bare {
                Ty::Vector(kind, lanes) if lane_of(&field.0) < usize::from(*lanes) => Ty::scalar(*kind),
                _ => Ty::Unknown,
            };
            if let [.., enumeration, _] = path
                && self.library.enums.contains_key(enumeration)
            {
                self.no_variant(path, span);
            }
            return fields.iter().map(of).collect();
        };
        self.coerce(bare, &ty, span);
        let counted = known.iter().all(|(name, ..)| name.parse::<usize>().is_ok());
        let mut found = Vec::new();
        for (field, _) in fields {
            let k = known.iter().position(|(name, ..)| name == field);
            if k.is_none() {
                let name = path.join("::");
                let names: Vec<&str> = known.iter().map(|(name, ..)| name.as_str()).collect();
                let plural = if known.len() == 1 { "" } else { "s" };
                self.errors.push(match counted && field.parse::<usize>().is_ok() {
                    true => Diagnostic::error_at(
                        Code::Pattern,
                        span,
                        format!(
                            "this pattern has more fields than `{name}`, which has {} field{plural}",
                            known.len()
                        ),
                    )
                    .label("too many"),
                    false => Diagnostic::error_at(Code::UnknownField, span, format!("`{name}` has no field `{field}`"))
                        .label("not there")
                        .help(crate::suggest::suggest_name(field, &names, "it has")),
                });
            }
            found.push(k.map_or(Ty::Unknown, |k| types[k].clone()));
        }
        found
    }

    /// Notes an error about a pattern that leaves out what a variant holds.
    fn holds_data(&mut self, path: &[String], variant: &EnumVariant, span: Span) {
        let name = path.join("::");
        let named = variant.fields.iter().any(|(name, ..)| name.parse::<usize>().is_err());
        let rest = if named { " { .. }" } else { "(..)" };
        self.errors.push(
            Diagnostic::error_at(
                Code::VariantForm,
                span,
                format!("expected unit variant, found variant `{name}`, which holds values"),
            )
            .label("its fields are left out")
            .help(format!("write `{name}{rest}`, or give the fields names")),
        );
    }

    /// Notes an error about a variant that an enum does not have.
    pub fn no_variant(&mut self, path: &[String], span: Span) {
        let [.., ty, variant] = path else { return };
        let library = self.library;
        let variants = library.enums.get(ty).map_or(&[][..], |e| &e.variants);
        let names: Vec<&str> = variants.iter().map(|v| v.name.as_str()).collect();
        self.errors.push(
            Diagnostic::error_at(Code::UnknownVariant, span, format!("`{ty}` has no variant `{variant}`"))
                .label("not there")
                .help(crate::suggest::suggest_name(variant, &names, "it has")),
        );
    }

    /// Notes an error about a range of literals that takes nothing.
    fn not_backwards(&mut self, pattern: &'l Pattern) {
        if let Pattern::Range(Some(low), Some(high), inclusive) = pattern
            && let (Some(from), Some(to)) = (literal_number(low), literal_number(high))
            && (from > to || (from == to && !inclusive))
        {
            self.errors.push(
                Diagnostic::error_at(Code::Pattern, high.span, "this range pattern takes no value")
                    .label("not above its lower bound")
                    .help("write the smaller bound first"),
            );
        }
    }

    fn bind_unknown(&mut self, parts: &'l [Pattern], deferred: bool) {
        parts
            .iter()
            .for_each(|part| self.bind_pattern(part, &Ty::Unknown, deferred));
    }
}

/// The position of a component of a vector by its name.
fn lane_of(name: &str) -> usize {
    ["x", "y", "z", "w"]
        .iter()
        .position(|lane| *lane == name)
        .unwrap_or(usize::MAX)
}

/// The value of a literal, which an `f64` holds exactly.
fn literal_number(expr: &Expr) -> Option<f64> {
    match &expr.kind {
        ExprKind::Int(value, _) => Some(*value as f64),
        ExprKind::Float(value, _) => Some(f64::from(*value)),
        ExprKind::Unary(UnaryOp::Neg, operand) => literal_number(operand).map(|value| -value),
        _ => None,
    }
}
