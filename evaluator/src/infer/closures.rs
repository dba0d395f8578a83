//! Closures, functions as values, and the adaptors of iterators that take them.

use super::Checker;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Closure, Expr, IntType};
use crate::front::{COUNTED, UNARY};
use crate::ir::Scalar;

impl<'l> Checker<'l> {
    /// The type of a closure. What is wanted of it tells the types of its parameters, as in rustc.
    pub fn infer_closure(&mut self, closure: &'l Closure, wanted: Option<&Ty>, span: Span) -> Ty {
        let (hints, gives) = match wanted.map(|ty| self.peel_refs(ty).0) {
            Some(Ty::Fn(params, result)) if params.len() == closure.params.len() => (params, Some(*result)),
            _ => (Vec::new(), None),
        };
        let mark = self.locals.len();
        let mut types = Vec::new();
        for (k, (pattern, stated)) in closure.params.iter().enumerate() {
            let ty = match (stated, hints.get(k)) {
                (Some(stated), hint) => {
                    let ty = self.convert_type(stated, span);
                    if let Some(hint) = hint {
                        self.coerce(hint, &ty, span);
                    }
                    ty
                }
                (None, Some(hint)) => hint.clone(),
                (None, None) => self.table.fresh(Kind::Any),
            };
            self.bind_whole(pattern, &ty, false);
            self.check_irrefutable(pattern, &ty, span);
            types.push(ty);
        }
        let result = match (&closure.result, gives) {
            (Some(stated), _) => self.convert_type(stated, span),
            (None, Some(gives)) => gives,
            (None, None) => self.table.fresh(Kind::Any),
        };
        let outer = std::mem::replace(&mut self.result, result.clone());
        let loops = std::mem::take(&mut self.loops);
        let found = self.infer_expr(&closure.body, Some(&result));
        self.coerce(&result, &found, closure.body.span);
        self.result = outer;
        self.loops = loops;
        self.locals.truncate(mark);
        Ty::Fn(types, Box::new(result))
    }

    /// A call of what a variable holds; `None` if there is no such variable, or it is not known to be called.
    pub fn call_of_local(&mut self, name: &str, args: &'l [Expr], span: Span) -> Option<Ty> {
        let local = self.locals.iter().rev().find(|local| local.name == name)?;
        let ty = local.ty.clone();
        self.call_of(&ty, &format!("`{name}`"), args, span)
    }

    /// A call of what an expression gives.
    pub fn infer_invoke(&mut self, callee: &'l Expr, args: &'l [Expr], span: Span) -> Ty {
        let found = self.infer_expr(callee, None);
        if let Some(result) = self.call_of(&found, "what is called", args, span) {
            return result;
        }
        let found = self.table.resolve_deep(&found);
        self.errors.push(
            Diagnostic::error_at(
                Code::NotAFunction,
                callee.span,
                format!("expected function, found `{found}`"),
            )
            .label("not a function")
            .help("call a function, a closure, or a variable or field that holds one"),
        );
        self.infer_loose_args(args);
        Ty::Unknown
    }

    /// A call of a value of a type; `None` if it is not known to be called.
    fn call_of(&mut self, ty: &Ty, name: &str, args: &'l [Expr], span: Span) -> Option<Ty> {
        match self.peel_refs(ty).0 {
            Ty::Fn(params, result) => {
                if params.len() != args.len() {
                    let (wanted, given) = (params.len(), args.len());
                    let plural = if wanted == 1 { "" } else { "s" };
                    self.errors.push(
                        Diagnostic::error_at(
                            Code::ArgumentCount,
                            span,
                            format!("{name} takes {wanted} argument{plural}, not {given}"),
                        )
                        .label("called here"),
                    );
                }
                Some(self.check_arguments(args, &params, *result))
            }
            Ty::Unknown | Ty::Never => {
                self.infer_loose_args(args);
                Some(Ty::Unknown)
            }
            _ => None,
        }
    }

    /// A function by its path, as a value.
    pub fn function_value(&mut self, path: &[String], span: Span) -> Option<Ty> {
        let library = self.library;
        let joined = path.join("::");
        if let Some(function) = library.functions.get(&joined).or_else(|| {
            library
                .functions
                .get(path.last().filter(|_| crate::front::is_by_last(path))?)
        }) {
            let given = self.instantiate_function(function, &[]);
            let params = function
                .params
                .iter()
                .map(|p| self.substitute_type(&p.ty, &given, span));
            let params = params.collect();
            let result = self.substitute_type(&function.result, &given, span);
            return Some(Ty::Fn(params, Box::new(result)));
        }
        if let [of, name] = path
            && let Some((_, function)) = library.declaring_trait(of, name)
            && function.params.first().is_some_and(|own| own.name == "self")
        {
            let mut given = self.instantiate_function(function, &[]);
            given.insert("Self".to_owned(), self.table.fresh(Kind::Any));
            let params = function.params.iter();
            let params = params.map(|p| self.substitute_type(&p.ty, &given, span)).collect();
            let result = self.substitute_type(&function.result, &given, span);
            return Some(Ty::Fn(params, Box::new(result)));
        }
        if let [name] = path
            && UNARY.contains(&name.as_str())
        {
            let of = self.table.fresh(Kind::Any);
            return Some(Ty::Fn(vec![of.clone()], Box::new(of)));
        }
        let names: Vec<&str> = path.iter().map(String::as_str).collect();
        if let Some((made, parts)) = super::calls::constructor_signature(&names) {
            return Some(Ty::Fn(parts, Box::new(made)));
        }
        let [.., ty, method] = path else { return None };
        if super::operator_function(ty, method).is_some() {
            let own = match super::signature::vector(ty) {
                Some((kind, lanes)) => Ty::Vector(kind, lanes),
                None if ty == "f32" => Ty::Float,
                None => IntType::from_name(ty).map_or_else(|| self.table.fresh(Kind::Any), Ty::Int),
            };
            let other = self.table.fresh(Kind::Any);
            return Some(Ty::Fn(vec![own.clone(), other], Box::new(own)));
        }
        let receiver = match ty.as_str() {
            "f32" => Ty::Float,
            "Mat2" | "Mat3" | "Mat4" => return None,
            other => match (IntType::from_name(other), super::signature::vector(other)) {
                (Some(kind), _) => Ty::Int(kind),
                (None, vector) => vector.map(|(kind, lanes)| Ty::Vector(kind, lanes))?,
            },
        };
        // A constant of the type is in capitals.
        if method.starts_with(char::is_uppercase) {
            return None;
        }
        let own = || receiver.clone();
        let of_several = match (method.as_str(), &receiver) {
            ("min" | "max", _) | ("powf" | "atan2", Ty::Float) | ("cross", Ty::Vector(Scalar::F32, 3)) => {
                Some((vec![own(), own()], own()))
            }
            ("powi", Ty::Float) => Some((vec![own(), Ty::I32], own())),
            ("lerp", Ty::Float | Ty::Vector(Scalar::F32, _)) => Some((vec![own(), own(), Ty::Float], own())),
            // The evaluator knows what it takes.
            ("from", _) => Some((vec![self.table.fresh(Kind::Any)], own())),
            ("from_bits", Ty::Float) => Some((vec![Ty::U32], own())),
            ("splat", Ty::Vector(kind, _)) => Some((vec![Ty::scalar(*kind)], own())),
            ("from_array", Ty::Vector(kind, _)) => Some((vec![Ty::Array(Box::new(Ty::scalar(*kind)))], own())),
            ("extend", Ty::Vector(kind, lanes @ 2..4)) => {
                Some((vec![own(), Ty::scalar(*kind)], Ty::Vector(*kind, lanes + 1)))
            }
            ("reflect", Ty::Vector(Scalar::F32, _)) => Some((vec![own(), own()], own())),
            ("rem_euclid" | "div_euclid" | "wrapping_add" | "wrapping_sub" | "wrapping_mul", Ty::Int(_)) => {
                Some((vec![own(), own()], own()))
            }
            ("dot", Ty::Vector(kind, _)) => Some((vec![own(), own()], Ty::scalar(*kind))),
            ("distance", Ty::Vector(Scalar::F32, _)) => Some((vec![own(), own()], Ty::Float)),
            ("clamp", _) => Some((vec![own(), own(), own()], own())),
            _ => None,
        };
        if let Some((params, result)) = of_several {
            return Some(Ty::Fn(params, Box::new(result)));
        }
        match self.known_method(&receiver, method, &[], span) {
            // Of other numbers of arguments the evaluator knows.
            Ty::Unknown => Some(Ty::Unknown),
            result => Some(Ty::Fn(vec![receiver], Box::new(result))),
        }
    }

    /// Returns the type of the items that a value iterates over; `None` if it is no iterator, no array and no range.
    fn item_type(&self, ty: &Ty) -> Option<Ty> {
        match self.table.resolve_shallow(ty) {
            Ty::Range(t) | Ty::Iter(t) | Ty::Array(t) => Some(*t),
            Ty::Ref(mutable, inner) => match self.table.resolve_shallow(&inner) {
                Ty::Array(t) => Some(Ty::Ref(mutable, t)),
                _ => None,
            },
            _ => None,
        }
    }

    /// A call of a function of `std::iter`; `None` of other functions.
    pub fn infer_sequence(&mut self, path: &[String], args: &'l [Expr], span: Span) -> Option<Ty> {
        let (name, of_module) = match path {
            [name] => (name.as_str(), false),
            [module, name] if module == "iter" => (name.as_str(), true),
            _ => return None,
        };
        let own = self.library.functions.get(name);
        if !of_module && own.is_some_and(|own| own.span.file != crate::front::std::FILE) {
            return None;
        }
        let item = match (name, args) {
            (COUNTED, [start]) => self.infer_expr(start, None),
            ("once" | "repeat", [value]) => self.infer_expr(value, None),
            ("empty", []) => self.table.fresh(Kind::Any),
            ("repeat_n", [value, count]) => {
                self.check_expr(count, &Ty::USIZE);
                self.infer_expr(value, None)
            }
            ("successors", [first, f]) => {
                let item = self.table.fresh(Kind::Any);
                let option = Ty::Enum("Option".to_owned(), vec![item.clone()]);
                self.check_expr(first, &option);
                self.check_expr(f, &Ty::Fn(vec![item.clone().into_shared_ref()], Box::new(option)));
                item
            }
            ("zip", [a, b]) => {
                let parts = [a, b].map(|part| {
                    let found = self.infer_expr(part, None);
                    self.item_type(&found).unwrap_or(Ty::Unknown)
                });
                Ty::Tuple(parts.to_vec())
            }
            ("from_fn" | "repeat_with" | "once_with", [_]) if of_module => {
                self.errors.push(
                    Diagnostic::error_at(
                        Code::NotInLanguage,
                        span,
                        format!("`iter::{name}` is not part of the kernel language"),
                    )
                    .label("not supported")
                    .note("how often it calls the closure would depend on what takes the values")
                    .help("write a `for` that calls the closure, or `iter::successors` from each value to the next"),
                );
                Ty::Unknown
            }
            _ => return None,
        };
        Some(Ty::Iter(Box::new(item)))
    }

    /// A method of an iterator over items; `None` if it is none of these.
    pub fn infer_adaptor(&mut self, item: &Ty, name: &str, args: &'l [Expr]) -> Option<Ty> {
        let iter = |item: Ty| Ty::Iter(Box::new(item));
        Some(match (name, args) {
            ("skip" | "take", [_]) => self.check_arguments(args, &[Ty::USIZE], iter(item.clone())),
            ("count" | "len", []) => Ty::USIZE,
            ("zip" | "chain", [other]) => {
                let found = self.infer_expr(other, None);
                let others = self.item_type(&found).unwrap_or(Ty::Unknown);
                match name {
                    "zip" => iter(Ty::Tuple(vec![item.clone(), others])),
                    _ => {
                        self.coerce(item, &others, other.span);
                        iter(item.clone())
                    }
                }
            }
            ("map", [f]) => iter(self.infer_map_result(item, f)),
            ("flat_map", [f]) => {
                let inner = self.infer_map_result(item, f);
                iter(self.item_type(&inner).unwrap_or(Ty::Unknown))
            }
            ("flatten", []) => iter(self.item_type(item).unwrap_or(Ty::Unknown)),
            ("for_each", [f]) => {
                self.check_expr(f, &Ty::Fn(vec![item.clone()], Box::new(Ty::UNIT)));
                Ty::UNIT
            }
            ("fold", [first, f]) => {
                let sum = self.infer_expr(first, None);
                self.check_expr(f, &Ty::Fn(vec![sum.clone(), item.clone()], Box::new(sum.clone())));
                sum
            }
            ("scan", [first, f]) => {
                let state = self.infer_expr(first, None);
                let made = self.table.fresh(Kind::Any);
                let option = Ty::Enum("Option".to_owned(), vec![made.clone()]);
                let params = vec![Ty::Ref(true, Box::new(state)), item.clone()];
                self.check_expr(f, &Ty::Fn(params, Box::new(option)));
                iter(made)
            }
            ("all" | "any", [f]) => {
                self.check_expr(f, &Ty::Fn(vec![item.clone()], Box::new(Ty::Bool)));
                Ty::Bool
            }
            ("sum" | "product", []) => self.peel_refs(item).0,
            _ => return None,
        })
    }

    /// Returns the type of a closure's result for items.
    pub fn infer_map_result(&mut self, item: &Ty, f: &'l Expr) -> Ty {
        let result = self.table.fresh(Kind::Any);
        self.check_expr(f, &Ty::Fn(vec![item.clone()], Box::new(result.clone())));
        self.table.resolve_shallow(&result)
    }
}
