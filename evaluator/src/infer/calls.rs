//! Calls: of the kernel's own functions by their signatures, of the prelude's and glam's by the tables below.

use super::Checker;
use super::types::{Kind, Ty};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::instead::{Receiver, find_text, find_type};
use crate::front::methods;
use crate::front::testing::{COUNT, RECORD};
use crate::front::tree::{Expr, ExprKind, Function, IntType, Type as SourceType};
use crate::ir::{Scalar, Type};
use std::collections::HashMap;

/// Shading languages' names for differences between the pixels of a quad.
const DERIVATIVES: [&str; 16] = [
    "dpdx",
    "dpdy",
    "fwidth",
    "dpdxFine",
    "dpdyFine",
    "fwidthFine",
    "dpdxCoarse",
    "dpdyCoarse",
    "fwidthCoarse",
    "dFdx",
    "dFdy",
    "ddx",
    "ddy",
    "ddx_fine",
    "ddy_fine",
    "dpdx_fine",
];

/// Functions that every Rust file has, and that the language has not.
const OF_RUST: [&str; 8] = ["Box", "Err", "Ok", "Some", "align_of", "drop", "size_of", "size_of_val"];

/// Methods of matrices that are not text of the kernel language.
const MATRIX_METHODS: [&str; 12] = [
    "col",
    "from_cols",
    "from_diagonal",
    "mul_mat2",
    "mul_mat3",
    "mul_mat4",
    "mul_vec2",
    "mul_vec3",
    "mul_vec4",
    "transform_point3",
    "transform_vector3",
    "transpose",
];

impl<'l> Checker<'l> {
    /// The type of `path::<constants>(args)`.
    pub fn infer_call(&mut self, path: &'l [String], constants: &'l [Expr], args: &'l [Expr], span: Span) -> Ty {
        let last = path.last().map(String::as_str).unwrap_or_default();
        if let [name] = path
            && let Some(found) = self.call_of_local(name, args, span)
        {
            return found;
        }
        let library = self.library;
        if library.broken.contains(&path.join("::")) || library.broken.contains(last) {
            self.infer_loose_args(args);
            return Ty::Unknown;
        }
        if args.is_empty()
            && let Some(found) = self.owned_constant(path, constants, span)
        {
            return found;
        }
        if let Some(found) = self.infer_sequence(path, args, span) {
            return found;
        }
        if let [ty, of, name] = path {
            return self.qualified_call((ty, of, name), constants, args, span);
        }
        if let [of, name] = path {
            if let Some(found) = self.of_type((of, name), constants, args, span) {
                return found;
            }
            if let Some(function) = library.functions.get(&path.join("::")) {
                return self.infer_function_call(&path.join("::"), function, constants, None, args, span);
            }
        }
        let function = library.functions.get(last).filter(|_| crate::front::is_by_last(path));
        if let Some(function) = function {
            return self.infer_function_call(last, function, constants, None, args, span);
        }
        if let Some(made) = self.constructed_by(path, args, span) {
            return made;
        }
        let names: Vec<&str> = path.iter().map(String::as_str).collect();
        self.known_call(&names, args, span)
    }

    /// A function of the kernel's files: each argument against its parameter. A method's receiver has been looked at.
    pub fn infer_function_call(
        &mut self,
        key: &str,
        function: &'l Function,
        constants: &'l [Expr],
        receiver: Option<&Ty>,
        args: &'l [Expr],
        span: Span,
    ) -> Ty {
        if self.library.broken.contains(key) {
            self.infer_loose_args(args);
            return Ty::Unknown;
        }
        let given = self.instantiate_function(function, constants);
        self.note_instance(key, function, &given, span);
        self.with_given(function, given, receiver, args, span)
    }

    /// As [`Checker::signature`], with the types of the function's parameters.
    pub fn with_given(
        &mut self,
        function: &'l Function,
        given: HashMap<String, Ty>,
        receiver: Option<&Ty>,
        args: &'l [Expr],
        span: Span,
    ) -> Ty {
        if let (Some(found), Some(own)) = (receiver, function.params.first()) {
            // The receiver's type determines the type parameters of its `impl`.
            let own = self.substitute_type(&own.ty, &given, span);
            let (own, found) = (self.peel_refs(&own).0, self.peel_refs(found).0);
            if matches!(own, Ty::Enum(..) | Ty::Struct(..) | Ty::Array(_)) {
                self.coerce(&own, &found, span);
            }
        }
        let params = &function.params[usize::from(receiver.is_some()).min(function.params.len())..];
        if params.len() == args.len() {
            // As rustc, closures last: the other arguments tell their types.
            let is_closure = |arg: &Expr| matches!(arg.kind, ExprKind::Closure(_));
            let (closures, values): (Vec<_>, Vec<_>) = params.iter().zip(args).partition(|(_, arg)| is_closure(arg));
            for (param, arg) in values.into_iter().chain(closures) {
                let wanted = match object_parameter(&param.ty) {
                    // Each branch may refer to another type.
                    Some(object) if chooses(arg) => object,
                    _ => self.substitute_type(&param.ty, &given, span),
                };
                let known = self.errors.len();
                let found = self.infer_expr(arg, Some(&wanted));
                let inside = self.errors.len();
                self.coerce(&wanted, &found, arg.span);
                if self.errors.len() > inside && inside == known {
                    let error = self.errors.remove(inside);
                    self.errors
                        .push(error.label_at(param.span, format!("`{}` is stated here", param.name)));
                }
            }
        } else {
            self.infer_loose_args(args);
        }
        self.substitute_type(&function.result, &given, span)
    }

    fn note_argument_count(&mut self, name: String, wanted: usize, given: usize, span: Span) {
        let plural = if wanted == 1 { "" } else { "s" };
        self.errors.push(
            Diagnostic::error_at(
                Code::ArgumentCount,
                span,
                format!("`{name}` takes {wanted} argument{plural}, not {given}"),
            )
            .label("called here")
            .help("give one number for each component; a longer vector is made with `.extend(...)`"),
        );
    }

    /// Looks at arguments of which nothing is known.
    pub fn infer_loose_args(&mut self, args: &'l [Expr]) {
        for arg in args {
            let found = self.infer_expr(arg, None);
            self.table.unify(&found, &Ty::Unknown);
        }
    }

    /// Arguments against the types that are wanted of them; how many there are is the evaluator's to check.
    pub fn check_arguments(&mut self, args: &'l [Expr], wanted: &[Ty], result: Ty) -> Ty {
        if args.len() == wanted.len() {
            for (arg, wanted) in args.iter().zip(wanted) {
                self.check_expr(arg, wanted);
            }
        } else {
            self.infer_loose_args(args);
        }
        result
    }

    fn known_call(&mut self, path: &[&str], args: &'l [Expr], span: Span) -> Ty {
        if let Some((ty, wanted)) = constructor_signature(path) {
            if args.len() != wanted.len() {
                self.note_argument_count(path.join("::"), wanted.len(), args.len(), span);
            }
            return self.check_arguments(args, &wanted, ty);
        }
        if let [.., ty, name] = path
            && let Some((kind, lanes)) = super::signature::vector(ty)
        {
            let vector = Ty::Vector(kind, lanes);
            return match *name {
                "splat" => self.check_arguments(args, &[Ty::scalar(kind)], vector),
                "from_array" => self.check_arguments(args, &[Ty::Array(Box::new(Ty::scalar(kind)))], vector),
                "from_slice" => {
                    let list = Ty::Array(Box::new(Ty::scalar(kind))).into_shared_ref();
                    self.check_arguments(args, &[list], vector)
                }
                "from" => self.from(vector, args),
                _ => self.by_path(&vector, name, args, span),
            };
        }
        if let [.., ty, name] = path {
            let receiver = match *ty {
                "f32" => Some(Ty::Float),
                "Mat2" => Some(Ty::Matrix(2)),
                "Mat3" => Some(Ty::Matrix(3)),
                "Mat4" => Some(Ty::Matrix(4)),
                other => IntType::from_name(other).map(Ty::Int),
            };
            match (receiver, *name) {
                (Some(number), "from") if !matches!(number, Ty::Matrix(_)) => return self.from(number, args),
                (Some(Ty::Float), "from_bits") => return self.check_arguments(args, &[Ty::U32], Ty::Float),
                (Some(Ty::Matrix(n)), "from_diagonal") => {
                    return self.check_arguments(args, &[Ty::Vector(Scalar::F32, n)], Ty::Matrix(n));
                }
                (Some(receiver), name) => return self.by_path(&receiver, name, args, span),
                (None, _) => {}
            }
        }
        self.infer_prelude_call(path, args, span)
    }

    /// `T::from(value)` of a number or a vector.
    fn from(&mut self, ty: Ty, args: &'l [Expr]) -> Ty {
        let ([value], Ty::Vector(kind, lanes)) = (args, &ty) else {
            // A number, of a boolean or of a number of its own type.
            for arg in args {
                let found = self.infer_expr(arg, Some(&ty));
                if self.table.variable_kind(&found).is_some() {
                    self.table.unify(&ty, &found);
                }
                self.check_lossless(&ty, &found, arg.span);
            }
            return ty;
        };
        let part = Ty::scalar(*kind);
        let found = match &value.kind {
            ExprKind::Tuple(parts) if parts.len() == usize::from(*lanes) => {
                self.infer_expr(value, Some(&Ty::Tuple(vec![part.clone(); parts.len()])))
            }
            _ => self.infer_expr(value, None),
        };
        match self.table.resolve_shallow(&found) {
            Ty::Array(element) => self.coerce(&part, &element, value.span),
            Ty::Tuple(parts) => {
                for found in &parts {
                    if !matches!(self.table.resolve_shallow(found), Ty::Vector(..)) {
                        self.coerce(&part, found, value.span);
                    }
                }
            }
            found => self.coerce(&ty, &found, value.span),
        }
        ty
    }

    /// Notes an error unless `from` takes every value of an integer type.
    fn check_lossless(&mut self, ty: &Ty, found: &Ty, span: Span) {
        let found = self.table.resolve_shallow(found);
        let takes = match (ty, &found) {
            (Ty::Float, Ty::Int(from)) => from.narrow_bits().is_some(),
            // Rust has 16-bit machines in mind.
            (Ty::Int(IntType::Usize), Ty::Int(from)) => {
                *from == IntType::Usize || from.narrow_bits().is_some() && from.range().0 == 0
            }
            (Ty::Int(to), Ty::Int(from)) => to.range().0 <= from.range().0 && from.range().1 <= to.range().1,
            (Ty::Int(_), Ty::Float) => false,
            _ => true,
        };
        if !takes {
            let message = format!("`{ty}::from` takes no {found}, whose values it may not hold");
            self.errors.push(
                Diagnostic::error_at(Code::Cast, span, message)
                    .label("not without a loss")
                    .help(format!("convert it with `as {ty}`")),
            );
        }
    }

    /// A method called by its path: the receiver is the first argument.
    fn by_path(&mut self, receiver: &Ty, name: &str, args: &'l [Expr], span: Span) -> Ty {
        let ty = match receiver {
            Ty::Vector(kind, lanes) => Some(Type::value(*kind, *lanes)),
            Ty::Float => Some(Type::F32),
            Ty::Int(kind) => Some(Type::scalar(kind.scalar())),
            _ => None,
        };
        let is_swizzle = name.chars().all(|c| matches!(c, 'x' | 'y' | 'z' | 'w'));
        let is_known = match ty {
            Some(ty) => {
                let unlike = methods::UNLIKE.iter().any(|(unlike, ..)| *unlike == name);
                methods::has_method(ty, name) || unlike || is_swizzle || name.starts_with("as_")
            }
            None => MATRIX_METHODS.contains(&name),
        };
        if !is_known && name != "default" {
            self.infer_loose_args(args);
            if self.unreached {
                return Ty::Unknown;
            }
            let help = match ty {
                Some(ty) => methods::known_methods(name, ty),
                None => find_text(Receiver::Matrix, name)
                    .unwrap_or_else(|| crate::suggest::suggest_name(name, &MATRIX_METHODS, "matrices have")),
            };
            let message = format!("there is no function `{receiver}::{name}`");
            self.errors.push(
                Diagnostic::error_at(Code::UnknownFunction, span, message)
                    .label("not found")
                    .help(help),
            );
            return Ty::Unknown;
        }
        match args {
            [first, rest @ ..] => {
                self.check_expr(first, receiver);
                self.known_method(receiver, name, rest, span)
            }
            [] => Ty::Unknown,
        }
    }

    /// The functions of the prelude.
    fn infer_prelude_call(&mut self, path: &[&str], args: &'l [Expr], span: Span) -> Ty {
        let pair = |kind| Ty::Quad(Box::new(Ty::Vector(kind, 2)));
        match (path, args) {
            ([.., "Quad", "splat" | "from"], [value]) => Ty::Quad(Box::new(self.infer_expr(value, None))),
            ([.., "Quad", "new"], [lanes]) => match self.infer_expr(lanes, None) {
                Ty::Array(lane) => Ty::Quad(lane),
                _ => Ty::Unknown,
            },
            ([.., "Quad", "from_xy"], [x, y]) => {
                self.check_lane_argument(x, &Ty::Float);
                self.check_lane_argument(y, &Ty::Float);
                pair(Scalar::F32)
            }
            ([.., "lane_position"], []) => pair(Scalar::I32),
            ([.., "quad_vector" | "quad_select"], []) => pair(Scalar::F32),
            ([.., "fract" | "round" | "sign" | "saturate" | "inverse_sqrt"], [x]) => self.infer_lanes(x),
            ([.., "mix"], [from, to, amount]) => {
                let ty = self.infer_lanes(from);
                self.check_expr(to, &ty);
                let found = self.infer_expr(amount, None);
                let (of, by) = (self.peel_refs(&ty).0, self.peel_refs(&found).0);
                match (&of, &by) {
                    (Ty::Vector(..) | Ty::Quad(_), Ty::Vector(..) | Ty::Quad(_) | Ty::Unknown) | (Ty::Unknown, _) => {}
                    _ => self.coerce(&Ty::Float, &found, amount.span),
                }
                ty
            }
            ([.., "step"], [edge, x]) => {
                self.check_expr(edge, &Ty::Float);
                self.check_expr(x, &Ty::Float);
                Ty::Float
            }
            ([.., "smoothstep"], [low, high, x]) => {
                self.check_expr(low, &Ty::Float);
                self.check_expr(high, &Ty::Float);
                self.infer_lanes(x)
            }
            ([.., "tally"], [name, value]) => {
                self.infer_expr(name, None);
                self.infer_expr(value, None)
            }
            ([.., COUNT], [probe]) => {
                self.infer_expr(probe, None);
                Ty::UNIT
            }
            ([.., RECORD], [site, condition, left, right]) => {
                self.infer_expr(site, None);
                self.check_expr(condition, &Ty::Bool);
                self.infer_expr(left, None);
                self.infer_expr(right, None);
                Ty::UNIT
            }
            ([.., "uniform"], [value]) => self.infer_expr(value, None),
            (["array", "from_fn"] | ["from_fn"], [f]) => {
                let item = self.infer_map_result(&Ty::USIZE, f);
                Ty::Array(Box::new(item))
            }
            (["cmp", "max" | "min"] | ["max" | "min"], [a, b]) => self.infer_larger(a, b, span),
            (["mem", "swap"] | ["swap"], [a, b]) => {
                let of = Ty::Ref(true, Box::new(self.table.fresh(Kind::Any)));
                self.takes_both(a, b, &of, &of);
                Ty::UNIT
            }
            (["mem", "take"] | ["take"], [place]) => {
                let of = self.table.fresh(Kind::Any);
                let found = self.infer_expr(place, None);
                self.coerce(&Ty::Ref(true, Box::new(of.clone())), &found, place.span);
                of
            }
            (["mem", "replace"] | ["replace"], [place, value]) => {
                let of = self.table.fresh(Kind::Any);
                self.takes_both(place, value, &Ty::Ref(true, Box::new(of.clone())), &of);
                of
            }
            _ => {
                match path {
                    [name] => self.no_function(name, span),
                    [.., ty, _] => self.no_type(ty, span),
                    [] => {}
                }
                self.infer_loose_args(args);
                Ty::Unknown
            }
        }
    }

    /// The type of an argument of the prelude's functions of numbers and vectors. Of the floats, only `f32` is taken, so
    /// that rustc infers it for a literal.
    fn infer_lanes(&mut self, x: &'l Expr) -> Ty {
        let ty = self.infer_expr(x, None);
        if self.table.variable_kind(&ty) == Some(Kind::Float) {
            self.table.unify(&ty, &Ty::Float);
        }
        ty
    }

    /// Notes an error about a type that a function is called of, and that is none.
    pub fn no_type(&mut self, ty: &str, span: Span) {
        let library = self.library;
        let known = !ty.starts_with(char::is_uppercase)
            || ty.contains("::")
            || crate::front::is_prelude_type(ty)
            || library.structs.contains_key(ty)
            || library.enums.contains_key(ty)
            || self.params.iter().any(|param| param == ty);
        if !known {
            let mut types: Vec<&str> = library
                .structs
                .keys()
                .chain(library.enums.keys())
                .map(String::as_str)
                .collect();
            types.extend([
                "Vec2", "Vec3", "Vec4", "IVec2", "IVec3", "IVec4", "UVec2", "UVec3", "UVec4",
            ]);
            types.sort_unstable();
            self.errors.push(
                Diagnostic::error_at(Code::UnknownType, span, format!("cannot find type `{ty}`"))
                    .label("not found in the kernel's files")
                    .help(
                        match types
                            .iter()
                            .filter(|_| find_type(ty).is_none())
                            .find(|known| crate::suggest::is_close(ty, known))
                        {
                            Some(close) => format!("did you mean `{close}`?"),
                            None => find_type(ty)
                                .unwrap_or("define it in one of the kernel's files")
                                .to_owned(),
                        },
                    ),
            );
        }
    }

    fn takes_both(&mut self, a: &'l Expr, b: &'l Expr, of_a: &Ty, of_b: &Ty) {
        self.check_expr(a, of_a);
        self.check_expr(b, of_b);
    }

    /// Notes an error about a name that is called and is no function.
    fn no_function(&mut self, name: &str, span: Span) {
        if crate::front::FUNCTIONS.contains(&name) {
            // With other arguments; the evaluator says which it takes.
            return;
        }
        if self.unreached && OF_RUST.contains(&name) {
            return;
        }
        if span.file == crate::front::std::FILE {
            // The evaluator has some for the library alone.
            return;
        }
        let error = match self.locals.iter().rev().find(|local| local.name == name) {
            Some(local) => Diagnostic::error_at(
Code::NotAFunction,
                span,
                format!("expected function, found `{}`", self.table.resolve_deep(&local.ty)),
            )
            .label("not a function")
            .label_at(local.span, format!("`{name}` is declared here")),
            None if DERIVATIVES.contains(&name) => Diagnostic::error_at(
Code::QuadMessage,
                span,
                format!("`{name}` asks the pixels beside this one, and a kernel computes one pixel"),
            )
            .label("needs a quad")
            .note("natively, and in a compute shader, there is no other pixel to ask")
            .help(
                "take `pixel: Quad<IVec2>`, whose lanes send each other values: `x.swap_horizontal() - x`; or read the texel beside: \
                 `color.load(pixel + ivec2(1, 0))`",
            ),
            None => {
                let mut known: Vec<&str> = self.library.functions.keys().map(String::as_str).collect();
                known.extend(crate::front::FUNCTIONS);
                known.sort_unstable();
                let close = known.iter().find(|known| crate::suggest::is_close(name, known));
                Diagnostic::error_at(Code::UnknownFunction, span, format!("cannot find function `{name}`"))
                    .label("not found in the kernel's files")
                    .help(match close {
                        Some(close) => format!("did you mean `{close}`?"),
                        None => "define it in one of the kernel's files, or use a function of the prelude".to_owned(),
                    })
            }
        };
        self.errors.push(error);
    }

    /// An argument that is a value, or one in each lane: `impl Into<Quad<T>>`.
    pub fn check_lane_argument(&mut self, arg: &'l Expr, wanted: &Ty) {
        let found = self.infer_expr(arg, Some(wanted));
        match self.table.resolve_shallow(&found) {
            Ty::Quad(lane) => self.coerce(wanted, &lane, arg.span),
            _ => self.coerce(wanted, &found, arg.span),
        }
    }

    /// Floats of a method that takes literals as its receiver: an unsuffixed one is an `f32`, as there is no other.
    pub fn settle_float(&mut self, ty: &Ty) -> Ty {
        if self.table.variable_kind(ty) == Some(Kind::Float) {
            self.table.unify(ty, &Ty::Float);
        }
        self.table.resolve_shallow(ty)
    }
}

/// The type that a constructor of glam makes, and the types of its parameters.
pub fn constructor_signature(path: &[&str]) -> Option<(Ty, Vec<Ty>)> {
    let made = constructed_type(path)?;
    let parts = match &made {
        Ty::Vector(kind, lanes) => vec![Ty::scalar(*kind); usize::from(*lanes)],
        Ty::Matrix(n) => vec![Ty::Vector(Scalar::F32, *n); usize::from(*n)],
        _ => Vec::new(),
    };
    Some((made, parts))
}

/// `vec3`, `Vec3::new`, `mat3`, `Mat3::from_cols`.
fn constructed_type(path: &[&str]) -> Option<Ty> {
    let (ty, name) = match path {
        [.., ty, name] if !ty.starts_with(|c: char| c.is_lowercase()) => (*ty, *name),
        [.., name] => (*name, "new"),
        [] => return None,
    };
    let ty = match ty {
        "vec2" => "Vec2",
        "vec3" => "Vec3",
        "vec4" => "Vec4",
        "ivec2" => "IVec2",
        "ivec3" => "IVec3",
        "ivec4" => "IVec4",
        "uvec2" => "UVec2",
        "uvec3" => "UVec3",
        "uvec4" => "UVec4",
        "bvec2" => "BVec2",
        "bvec3" => "BVec3",
        "bvec4" => "BVec4",
        other => other,
    };
    match (super::signature::vector(ty), ty, name) {
        (Some((kind, lanes)), _, "new") => Some(Ty::Vector(kind, lanes)),
        (None, "mat2" | "Mat2", "new" | "from_cols") => Some(Ty::Matrix(2)),
        (None, "mat3" | "Mat3", "new" | "from_cols") => Some(Ty::Matrix(3)),
        (None, "mat4" | "Mat4", "new" | "from_cols") => Some(Ty::Matrix(4)),
        _ => None,
    }
}

/// The type `&dyn Trait`, if a parameter has it.
fn object_parameter(ty: &SourceType) -> Option<Ty> {
    match ty {
        SourceType::Ref(mutable, inner) => match &**inner {
            SourceType::Name(name, _) if name.starts_with("dyn ") => {
                Some(Ty::Ref(*mutable, Box::new(Ty::Param(name.clone()))))
            }
            _ => None,
        },
        _ => None,
    }
}

/// Returns whether an expression is one of several values.
fn chooses(expr: &Expr) -> bool {
    matches!(expr.kind, ExprKind::If(..) | ExprKind::Match(..) | ExprKind::Block(..))
}
