//! Methods, with the signatures that Rust, glam and the prelude give them.

use super::Checker;
use super::places::Access;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::instead::{Receiver, find_text};
use crate::front::methods;
use crate::front::tree::{Expr, ExprKind};
use crate::ir::{Scalar, Type};

impl<'l> Checker<'l> {
    /// The type of `receiver.name(args)`.
    pub fn infer_method_call(
        &mut self,
        receiver: &'l Expr,
        name: &str,
        constants: &'l [Expr],
        args: &'l [Expr],
        span: Span,
    ) -> Ty {
        let (ty, access) = self.infer_place(receiver);
        if self.table.variable_kind(&self.peel_refs(&ty).0) == Some(Kind::Any) {
            self.solve_deferred();
        }
        let (bare, mut reference) = self.peel_refs(&ty);
        if let Ty::Param(parameter) = &bare
            && let Some((of, function)) = self.declared_of(parameter, name)
        {
            if function.params.first().is_some_and(|own| own.ty.is_mutable_reference()) {
                self.check_mutable_receiver(access, reference, receiver);
            }
            return self.of_parameter(parameter, (of, function), name, Some(&ty), args, span);
        }
        let settled = match &bare {
            Ty::Struct(..) | Ty::Enum(..) => bare.clone(),
            _ => self.settle_float(&bare),
        };
        let of = self
            .type_name(&settled)
            .filter(|_| self.table.variable_kind(&settled).is_none());
        if let Some(of) = of.filter(|_| !(matches!(settled, Ty::Int(_)) && is_evaluated_method(name))) {
            let library = self.library;
            let keys = self.keys_of(&of, name);
            if let Some(function) = keys.first().map(|key| &library.functions[*key]) {
                if function.params.first().is_some_and(|own| own.ty.is_mutable_reference()) {
                    self.check_mutable_receiver(access, reference, receiver);
                }
                if let [key] = keys.as_slice() {
                    // The value tells which type the method is of, but not what several traits call the same.
                    if !matches!(settled, Ty::Struct(..) | Ty::Enum(..)) || key.starts_with('<') {
                        self.methods.insert(span, (*key).to_owned());
                    }
                    return self.infer_function_call(key, function, constants, Some(&ty), args, span);
                }
                let mut found = vec![settled];
                found.extend(args.iter().map(|arg| self.infer_expr(arg, None)));
                return self.infer_overloaded(&keys, &found, name, span);
            }
        }
        if name == "into" && args.is_empty() {
            return self.given_back(Some(ty), span);
        }
        if name == "clone" && args.is_empty() && !matches!(bare, Ty::Iter(_) | Ty::Texture(..)) {
            return bare;
        }
        if let Some(found) = self.infer_order_method(&ty, name, args, span) {
            return found;
        }
        let changes = matches!(bare, Ty::Array(_)) && crate::front::CHANGING.contains(&name);
        if name == "iter_mut" || changes {
            self.check_mutable_receiver(access, reference, receiver);
        }
        if matches!(bare, Ty::Int(_)) && reference.is_some() && matches!(name, "min" | "max" | "clamp") {
            // rustc finds `Ord` of the reference before that of the number.
            let wanted = vec![ty.clone(); if name == "clamp" { 2 } else { 1 }];
            return self.check_arguments(args, &wanted, ty.clone());
        }
        if matches!(receiver.kind, ExprKind::Slice(..)) {
            if name == "map" {
                self.errors.push(
                    Diagnostic::error_at(Code::UnknownMethod, span, "a slice has no method `map`")
                        .label("not there")
                        .help("write `.iter().map(...)`"),
                );
                return self.unknown_method(args);
            }
            // rustc takes a reference to a slice for a method that takes `self`.
            reference = Some(false);
        }
        match (&bare, name) {
            (Ty::Array(element), "iter" | "iter_mut") => {
                Ty::Iter(Box::new(Ty::Ref(name == "iter_mut", element.clone())))
            }
            (Ty::Array(element), "into_iter") => Ty::Iter(match reference {
                Some(mutable) => Box::new(Ty::Ref(mutable, element.clone())),
                None => element.clone(),
            }),
            // Methods of `Ord` are those of every integer, so that rustc need not know of which.
            (Ty::Int(_) | Ty::Var(_), "min" | "max" | "clamp")
                if self.table.variable_kind(&bare) == Some(Kind::Integer) =>
            {
                let wanted = vec![bare.clone(); if name == "clamp" { 2 } else { 1 }];
                self.check_arguments(args, &wanted, bare)
            }
            (Ty::Int(_) | Ty::Var(_), _) if self.table.variable_kind(&bare) == Some(Kind::Integer) => {
                self.note_ambiguous_method(name, receiver);
                self.infer_loose_args(args);
                Ty::Unknown
            }
            _ => {
                let bare = self.settle_float(&bare);
                self.known_method(&bare, name, args, span)
            }
        }
    }

    /// A receiver that a method changes.
    fn check_mutable_receiver(&mut self, access: Access, reference: Option<bool>, receiver: &Expr) {
        match reference {
            Some(true) => {}
            Some(false) => self.check_writable(Access::Shared, receiver, false),
            None => self.check_writable(access, receiver, false),
        }
    }

    fn note_ambiguous_method(&mut self, name: &str, receiver: &Expr) {
        self.errors.push(
            Diagnostic::error_at(
                Code::TypeNeeded,
                receiver.span,
                format!("cannot call method `{name}` on an integer of which the type is not known yet"),
            )
            .label("of which type?")
            .help("write its type behind a literal, such as `2_i32`, or state it where the variable is declared"),
        );
    }

    /// A method of a type that the generator knows.
    pub fn known_method(&mut self, receiver: &Ty, name: &str, args: &'l [Expr], span: Span) -> Ty {
        let own = receiver.clone();
        match receiver {
            Ty::Float | Ty::Int(_) | Ty::Vector(..) => {
                let found = match receiver {
                    Ty::Vector(kind, lanes) => self.of_vector(*kind, *lanes, name, args),
                    Ty::Int(_) => self.of_integer(receiver, name, args, span),
                    _ => self.of_float(name, args),
                };
                // Of integers of 8 and 16 bits it is said already.
                let is_narrow = matches!(receiver, Ty::Int(kind) if kind.narrow_bits().is_some());
                if found == Ty::Unknown && !is_narrow {
                    self.no_method(receiver, name, args.len(), span);
                }
                found
            }
            Ty::Matrix(n) => {
                let column = Ty::Vector(Scalar::F32, *n);
                match name {
                    "transpose" => self.check_arguments(args, &[], own),
                    "col" => self.check_arguments(args, &[Ty::USIZE], column),
                    "mul_vec2" | "mul_vec3" | "mul_vec4" => self.takes_own(args, column),
                    "mul_mat2" | "mul_mat3" | "mul_mat4" if args.len() == 1 => {
                        let found = self.infer_expr(&args[0], None);
                        let found = self.peel_refs(&found).0;
                        self.coerce(&own, &found, args[0].span);
                        own
                    }
                    "transform_point3" | "transform_vector3" => {
                        let point = Ty::Vector(Scalar::F32, 3);
                        self.takes_own(args, point)
                    }
                    _ => self.unknown_method(args),
                }
            }
            Ty::Array(_) if self.library.functions.contains_key(&format!("Array::{name}")) => {
                let key = format!("Array::{name}");
                let function = &self.library.functions[&key];
                self.methods.insert(span, key.clone());
                self.infer_function_call(&key, function, &[], Some(receiver), args, span)
            }
            Ty::Array(item) if matches!(name, "windows" | "chunks" | "chunks_exact") => {
                let part = Ty::Array(item.clone()).into_shared_ref();
                self.check_arguments(args, &[Ty::USIZE], Ty::Iter(Box::new(part)))
            }
            Ty::Array(item) if matches!(name, "chunks_mut" | "chunks_exact_mut") => {
                let part = Ty::Ref(true, Box::new(Ty::Array(item.clone())));
                self.check_arguments(args, &[Ty::USIZE], Ty::Iter(Box::new(part)))
            }
            Ty::Array(_) if name == "len" => self.check_arguments(args, &[], Ty::USIZE),
            Ty::Array(item) if name == "map" && args.len() == 1 => {
                // In order and at once, other than that of iterators, so that its closure may change variables.
                self.methods.insert(span, "Array::map".to_owned());
                Ty::Array(Box::new(self.infer_map_result(item, &args[0])))
            }
            Ty::Array(_)
                if matches!(
                    name,
                    "all"
                        | "any"
                        | "chain"
                        | "cloned"
                        | "copied"
                        | "enumerate"
                        | "flat_map"
                        | "fold"
                        | "for_each"
                        | "product"
                        | "rev"
                        | "skip"
                        | "step_by"
                        | "sum"
                        | "take"
                        | "zip"
                ) =>
            {
                self.errors.push(
                    Diagnostic::error_at(
                        Code::UnknownMethod,
                        span,
                        format!("an array is no iterator: it has no method `{name}`"),
                    )
                    .label("not an iterator")
                    .help(format!("write `.iter().{name}(...)`")),
                );
                self.unknown_method(args)
            }
            Ty::Array(_) if !matches!(name, "iter" | "iter_mut" | "into_iter" | "len" | "map") => {
                let own = self
                    .library
                    .functions
                    .keys()
                    .filter_map(|key| key.strip_prefix("Array::"));
                let known: Vec<&str> = own.chain(["iter", "len", "map", "windows", "chunks"]).collect();
                let help = find_text(Receiver::List, name)
                    .unwrap_or_else(|| crate::suggest::suggest_name(name, &known, "arrays and slices have"));
                let message = format!("arrays and slices have no method `{name}`");
                self.errors.push(
                    Diagnostic::error_at(Code::UnknownMethod, span, message)
                        .label("not there")
                        .help(help),
                );
                self.unknown_method(args)
            }
            Ty::Range(item) | Ty::Iter(item) => match name {
                "rev" | "cycle" => self.check_arguments(args, &[], own),
                "step_by" => self.check_arguments(args, &[Ty::USIZE], own),
                "contains" => self.check_arguments(args, &[(**item).clone().into_shared_ref()], Ty::Bool),
                "enumerate" => self.check_arguments(
                    args,
                    &[],
                    Ty::Iter(Box::new(Ty::Tuple(vec![Ty::USIZE, (**item).clone()]))),
                ),
                "copied" | "cloned" => {
                    let bare = self.peel_refs(item).0;
                    self.check_arguments(args, &[], Ty::Iter(Box::new(bare)))
                }
                "iter" | "into_iter" => self.check_arguments(args, &[], own),
                "min" | "max" if matches!(self.peel_refs(item).0, Ty::Float | Ty::Vector(..)) => {
                    let of = self.peel_refs(item).0;
                    let first = if name == "min" { "INFINITY" } else { "NEG_INFINITY" };
                    let error = Diagnostic::error_at(
                        Code::TraitBound,
                        span,
                        format!("the trait bound `{of}: Ord` is not satisfied"),
                    )
                    .label(format!("`Ord` is not implemented for `{of}`"));
                    self.errors.push(error.help(match of {
                        Ty::Float => format!("fold it: `.fold(f32::{first}, f32::{name})`"),
                        _ => "fold it from the first one on".to_owned(),
                    }));
                    self.unknown_method(args)
                }
                _ if self.library.functions.contains_key(&format!("Iterator::{name}")) => {
                    let key = format!("Iterator::{name}");
                    let function = &self.library.functions[&key];
                    let items = Ty::Array(item.clone());
                    self.infer_function_call(&key, function, &[], Some(&items), args, span)
                }
                _ if find_text(Receiver::List, name).is_some() => {
                    let help = find_text(Receiver::List, name).unwrap_or_default();
                    let message = format!("an iterator has no method `{name}` here");
                    self.errors.push(
                        Diagnostic::error_at(Code::UnknownMethod, span, message)
                            .label("not supported")
                            .help(help),
                    );
                    // Closures of such a method are not looked at.
                    Ty::Unknown
                }
                _ => match self.infer_adaptor(item, name, args) {
                    Some(found) => found,
                    None => self.unknown_method(args),
                },
            },
            Ty::Texture(kind, texel) => self.of_texture(kind, texel, name, args),
            Ty::Buffer(element) => match name {
                "load" => self.check_arguments(args, &[Ty::USIZE], (**element).clone()),
                "len" => self.check_arguments(args, &[], Ty::USIZE),
                _ => self.unknown_method(args),
            },
            Ty::Storage("StorageTexture", texel) => match name {
                "store" => self.check_arguments(args, &[Ty::Vector(Scalar::I32, 2), (**texel).clone()], Ty::UNIT),
                "size" => self.check_arguments(args, &[], Ty::Vector(Scalar::U32, 2)),
                _ => self.unknown_method(args),
            },
            Ty::Storage(kind, element) => match (*kind, name) {
                (_, "len") => self.check_arguments(args, &[], Ty::USIZE),
                ("StorageBuffer" | "Shared", "store") => {
                    self.check_arguments(args, &[Ty::USIZE, (**element).clone()], Ty::UNIT)
                }
                ("AtomicBuffer" | "Shared" | "AtomicShared", "load") => {
                    self.check_arguments(args, &[Ty::USIZE], (**element).clone())
                }
                ("AtomicBuffer" | "AtomicShared", "add" | "max" | "min" | "and" | "or" | "xor" | "exchange") => {
                    self.check_arguments(args, &[Ty::USIZE, (**element).clone()], (**element).clone())
                }
                _ => self.unknown_method(args),
            },
            Ty::Quad(lane) => self.of_quad(lane, name, args, span),
            Ty::Enum(of, parts) if matches!(of.as_str(), "Option" | "Result") => match (name, parts.first()) {
                ("unwrap", Some(held)) => self.check_arguments(args, &[], held.clone()),
                ("expect", Some(held)) => self.check_arguments(args, &[Ty::Str.into_shared_ref()], held.clone()),
                _ => self.unknown_method(args),
            },
            Ty::Bool => match name {
                "select" => Ty::Unknown,
                "min" | "max" => self.takes_own(args, Ty::Bool),
                "clamp" => self.check_arguments(args, &[Ty::Bool, Ty::Bool], Ty::Bool),
                _ => {
                    self.no_method(receiver, name, args.len(), span);
                    self.unknown_method(args)
                }
            },
            _ => self.unknown_method(args),
        }
    }

    /// Notes an error about a method that a number, a boolean or a vector has not; with other arguments, the evaluator says what it takes.
    fn no_method(&mut self, receiver: &Ty, name: &str, arguments: usize, span: Span) {
        let ty = match receiver {
            Ty::Vector(kind, lanes) => Type::value(*kind, *lanes),
            Ty::Int(kind) => Type::scalar(kind.scalar()),
            Ty::Bool => Type::BOOL,
            _ => Type::F32,
        };
        // Of a quad's messages the evaluator says what they need.
        if !name.starts_with("swap_")
            && !methods::has_method(ty, name)
            && methods::UNLIKE.iter().all(|(unlike, ..)| *unlike != name)
        {
            let plural = if arguments == 1 { "" } else { "s" };
            let message = format!("there is no method `{name}` with {arguments} argument{plural} on {receiver}");
            self.errors.push(
                Diagnostic::error_at(Code::UnknownMethod, span, message)
                    .label("not supported")
                    .help(methods::known_methods(name, ty)),
            );
        }
    }

    /// A method with one argument of the type of its result.
    fn takes_own(&mut self, args: &'l [Expr], own: Ty) -> Ty {
        self.check_arguments(args, std::slice::from_ref(&own), own.clone())
    }

    fn unknown_method(&mut self, args: &'l [Expr]) -> Ty {
        self.infer_loose_args(args);
        Ty::Unknown
    }

    fn of_float(&mut self, name: &str, args: &'l [Expr]) -> Ty {
        let float = Ty::Float;
        match name {
            "powf" | "atan2" | "min" | "max" => self.takes_own(args, float),
            "clamp" | "mul_add" => self.check_arguments(args, &[float.clone(), float.clone()], float),
            "powi" => self.check_arguments(args, &[Ty::I32], float),
            "is_nan" | "is_finite" => self.check_arguments(args, &[], Ty::Bool),
            "to_bits" => self.check_arguments(args, &[], Ty::U32),
            _ if args.is_empty() && methods::has_method(Type::F32, name) => float,
            _ => self.unknown_method(args),
        }
    }

    fn of_integer(&mut self, own: &Ty, name: &str, args: &'l [Expr], span: Span) -> Ty {
        let own = own.clone();
        if let Ty::Int(kind) = own
            && kind.narrow_bits().is_some()
            && !matches!(name, "min" | "max" | "clamp")
        {
            let wide = Ty::scalar(kind.scalar());
            self.errors.push(
                Diagnostic::error_at(
                    Code::UnknownMethod,
                    span,
                    format!("there is no method `{name}` on {own}"),
                )
                .label("not supported")
                .help(format!("convert it with `as {wide}` first")),
            );
            return self.unknown_method(args);
        }
        match name {
            "abs" | "signum" | "reverse_bits" | "wrapping_neg" => self.check_arguments(args, &[], own),
            "count_ones" | "leading_zeros" | "trailing_zeros" => self.check_arguments(args, &[], Ty::U32),
            "min" | "max" | "rem_euclid" | "div_euclid" | "div_ceil" | "wrapping_add" | "wrapping_sub"
            | "wrapping_mul" => self.takes_own(args, own),
            "clamp" => self.check_arguments(args, &[own.clone(), own.clone()], own),
            "is_multiple_of" => self.check_arguments(args, &[own], Ty::Bool),
            "pow" | "wrapping_shl" | "wrapping_shr" => self.check_arguments(args, &[Ty::U32], own),
            _ => self.unknown_method(args),
        }
    }

    fn of_vector(&mut self, kind: Scalar, lanes: u8, name: &str, args: &'l [Expr]) -> Ty {
        let (own, part) = (Ty::Vector(kind, lanes), Ty::scalar(kind));
        if kind == Scalar::Bool {
            return match name {
                "any" | "all" => self.check_arguments(args, &[], Ty::Bool),
                "test" => self.check_arguments(args, &[Ty::USIZE], Ty::Bool),
                _ => self.unknown_method(args),
            };
        }
        if let Some(to) = name.strip_prefix("as_") {
            let target = to.strip_prefix("vec").map(|n| format!("Vec{n}"));
            let target = target.or_else(|| to.strip_prefix("ivec").map(|n| format!("IVec{n}")));
            let target = target.or_else(|| to.strip_prefix("uvec").map(|n| format!("UVec{n}")));
            return match target.and_then(|name| super::signature::vector(&name)) {
                Some((kind, lanes)) => self.check_arguments(args, &[], Ty::Vector(kind, lanes)),
                None => self.unknown_method(args),
            };
        }
        if name.len() <= 4 && name.len() > 1 && name.chars().all(|c| "xyzw".contains(c)) {
            return self.check_arguments(args, &[], Ty::Vector(kind, name.len() as u8));
        }
        match name {
            "dot" | "distance" | "distance_squared" => self.check_arguments(args, &[own], part),
            "length" | "length_squared" | "length_recip" | "min_element" | "max_element" | "element_sum"
            | "element_product" => self.check_arguments(args, &[], part),
            "min" | "max" | "cross" | "reflect" | "rem_euclid" | "div_euclid" => self.takes_own(args, own),
            "cmplt" | "cmple" | "cmpgt" | "cmpge" | "cmpeq" | "cmpne" => {
                self.check_arguments(args, &[own], Ty::Vector(Scalar::Bool, lanes))
            }
            "clamp" => self.check_arguments(args, &[own.clone(), own.clone()], own),
            "lerp" => self.check_arguments(args, &[own.clone(), Ty::Float], own),
            "powf" => self.check_arguments(args, &[Ty::Float], own),
            "extend" => self.check_arguments(args, &[part], Ty::Vector(kind, lanes + 1)),
            "truncate" => self.check_arguments(args, &[], Ty::Vector(kind, lanes - 1)),
            "to_array" => self.check_arguments(args, &[], Ty::Array(Box::new(part))),
            "is_nan" | "is_finite" => self.check_arguments(args, &[], Ty::Bool),
            "abs" | "ceil" | "floor" | "trunc" | "exp" | "exp2" | "ln" | "log2" | "sqrt" | "recip" | "normalize"
            | "perp" | "sin" | "cos" | "signum" | "round" | "fract" => self.check_arguments(args, &[], own),
            _ => self.unknown_method(args),
        }
    }

    fn of_quad(&mut self, lane: &Ty, name: &str, args: &'l [Expr], span: Span) -> Ty {
        let lane = self.table.resolve_shallow(lane);
        let own = Ty::Quad(Box::new(lane.clone()));
        match name {
            "swap_horizontal" | "swap_vertical" | "swap_diagonal" | "sum" | "average" => {
                self.check_arguments(args, &[], own)
            }
            "gather" => self.check_arguments(args, &[], Ty::Array(Box::new(own))),
            "lt" | "le" | "gt" | "ge" | "eq" | "ne" => {
                args.iter().for_each(|arg| self.check_lane_argument(arg, &lane));
                Ty::Quad(Box::new(Ty::Bool))
            }
            "select" => match args {
                [yes, no] => {
                    let ty = self.infer_expr(yes, None);
                    self.check_expr(no, &ty);
                    ty
                }
                _ => self.unknown_method(args),
            },
            "x" | "y" | "z" | "w" => match lane {
                Ty::Vector(kind, _) => Ty::Quad(Box::new(Ty::scalar(kind))),
                _ => Ty::Unknown,
            },
            "as_f32" => Ty::Quad(Box::new(Ty::Float)),
            "as_i32" => Ty::Quad(Box::new(Ty::I32)),
            // As the lane's method does, whose arguments may be quads or single values.
            _ if args.is_empty() => match self.known_method(&lane, name, args, span) {
                Ty::Unknown => Ty::Unknown,
                result => Ty::Quad(Box::new(result)),
            },
            "extend" => {
                args.iter().for_each(|arg| self.check_lane_argument(arg, &Ty::Float));
                match lane {
                    Ty::Vector(kind, lanes) => Ty::Quad(Box::new(Ty::Vector(kind, lanes + 1))),
                    _ => Ty::Unknown,
                }
            }
            "dot" | "distance" | "distance_squared" => {
                args.iter().for_each(|arg| self.check_lane_argument(arg, &lane));
                Ty::Quad(Box::new(Ty::Float))
            }
            "min" | "max" | "clamp" | "atan2" | "powf" | "cross" => {
                args.iter().for_each(|arg| self.check_lane_argument(arg, &lane));
                own
            }
            _ => self.unknown_method(args),
        }
    }
}

/// Methods of integers that the evaluator computes where it knows the numbers, and else takes from the library.
fn is_evaluated_method(name: &str) -> bool {
    matches!(name, "rem_euclid" | "div_euclid" | "div_ceil" | "is_multiple_of")
}
