//! Functions of numbers and vectors, named as in `f32` and glam.

use super::Evaluator;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::methods::{UNLIKE, known_methods};
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type, UnaryOp};

impl Evaluator<'_> {
    /// Evaluates a method of a number or vector.
    pub fn eval_math_method(&mut self, receiver: &Value, name: &str, args: &[Value], span: Span) -> Eval {
        if let Some(value) = self.quad_method(receiver, name, args, span)? {
            return Ok(value);
        }
        let x = self.value_node(receiver, span)?;
        let vectors = name == "mul_add";
        if self.ty(x).is_float()
            && (vectors || self.ty(x).is_scalar())
            && let Some((_, why, write)) = UNLIKE.iter().find(|(known, ..)| *known == name)
        {
            return Err(ambiguity_error(span, why, write));
        }
        let result = match args {
            [] => self.math_one(x, name)?,
            [a] => self.math_two(receiver, x, name, a, span)?,
            [a, b] if name == "clamp" => {
                let (low, high) = (
                    self.same_type(a, receiver, span)?.0,
                    self.same_type(b, receiver, span)?.0,
                );
                let ty = self.ty(x);
                self.in_order(low, high, span)?;
                Some(self.builder.add(Op::Clamp, [x, low, high], ty))
            }
            [to, amount] if name == "lerp" && !self.ty(x).is_scalar() => {
                return self.eval_mix(receiver, to, amount, span);
            }
            _ => None,
        };
        match result {
            Some(id) => Ok(Value::Node(id)),
            None => Err(Diagnostic::error_at(
                Code::UnknownMethod,
                span,
                format!(
                    "there is no method `{name}` with {} argument{} on {}",
                    args.len(),
                    if args.len() == 1 { "" } else { "s" },
                    self.ty(x).in_rust()
                ),
            )
            .label("not supported")
            .help(known_methods(name, self.ty(x)))
            .into()),
        }
    }

    /// Mixes two values as glam's `lerp` does: from * (1 - amount) + to * amount.
    pub fn eval_mix(&mut self, from: &Value, to: &Value, amount: &Value, span: Span) -> Eval {
        let one = Value::Node(self.builder.f32(1.0));
        let rest = self.eval_binary(BinaryOp::Sub, &one, amount, span)?;
        let from = self.eval_binary(BinaryOp::Mul, from, &rest, span)?;
        let to = self.eval_binary(BinaryOp::Mul, to, amount, span)?;
        self.eval_binary(BinaryOp::Add, &from, &to, span)
    }

    fn math_one(&mut self, x: NodeId, name: &str) -> Eval<Option<NodeId>> {
        let ty = self.ty(x);
        if let Some(op) = super::integers::bit_method(name) {
            return Ok(ty.is_integer().then(|| {
                let counted = self.builder.add(Op::Unary(op), [x], ty);
                // Rust returns the count as u32.
                if name == "reverse_bits" {
                    counted
                } else {
                    self.convert_node(counted, Scalar::U32)
                }
            }));
        }
        if let Some(op) = unary_method(name) {
            let fits = ty.is_float() || (name == "abs" && ty.scalar_kind() != Some(Scalar::Bool));
            return Ok(fits.then(|| self.builder.add(Op::Unary(op), [x], ty)));
        }
        if let Some((kind, lanes)) = conversion_method(name) {
            return Ok((ty.component_count() == lanes).then(|| self.convert_node(x, kind)));
        }
        if let Some(swizzled) = self.build_swizzle(x, name) {
            return Ok(Some(swizzled));
        }
        let vector = ty.is_float() && ty.component_count() > 1;
        Ok(match name {
            "recip" if ty.is_float() => {
                let one = self.builder.f32(1.0);
                let one = self.build_splat(one, ty.component_count());
                Some(self.builder.add(Op::Binary(BinaryOp::Div), [one, x], ty))
            }
            "wrapping_neg" if ty.scalar_kind() == Some(Scalar::I32) => {
                Some(self.builder.add(Op::Unary(UnaryOp::Neg), [x], ty))
            }
            "wrapping_neg" if ty.is_integer() => {
                let zero = self.builder.constant(ty, [0; 4]);
                let negative = self.builder.add(Op::Binary(BinaryOp::Sub), [zero, x], ty);
                self.facts.wrapping.insert(negative);
                Some(negative)
            }
            "to_bits" if ty == Type::F32 => Some(self.builder.add(Op::Bitcast, [x], Type::U32)),
            // A shader may assume that there are no NaNs, so the test uses bits: without its sign, a NaN is larger than
            // infinity.
            "is_nan" | "is_finite" if ty.is_float() => {
                let largest = self.largest_magnitude(x);
                let infinity = self.builder.constant(Type::U32, [0x7f80_0000, 0, 0, 0]);
                let op = if name == "is_nan" { BinaryOp::Gt } else { BinaryOp::Lt };
                Some(self.builder.add(Op::Binary(op), [largest, infinity], Type::BOOL))
            }
            "to_radians" | "to_degrees" if ty == Type::F32 => {
                let factor = if name == "to_radians" {
                    std::f32::consts::PI / 180.0
                } else {
                    57.295_78
                };
                let factor = self.builder.f32(factor);
                Some(self.builder.add(Op::Binary(BinaryOp::Mul), [x, factor], ty))
            }
            "perp" if ty == Type::value(Scalar::F32, 2) => {
                let lanes = self.vector_components(x);
                let negative = self.builder.add(Op::Unary(UnaryOp::Neg), [lanes[1]], Type::F32);
                Some(self.builder.add(Op::Compose, [negative, lanes[0]], ty))
            }
            "length_recip" if vector => {
                let length = self.build_length(x);
                let one = self.builder.f32(1.0);
                Some(self.builder.add(Op::Binary(BinaryOp::Div), [one, length], Type::F32))
            }
            "length_squared" if vector => Some(self.build_dot(x, x)),
            "length_squared" if ty.is_integer() && ty.component_count() > 1 => Some(self.integer_dot(x, x)),
            "length" if vector => Some(self.build_length(x)),
            "normalize" if vector => {
                // As in glam: the vector times the reciprocal of its length.
                let length = self.build_length(x);
                let one = self.builder.f32(1.0);
                let scale = self.builder.add(Op::Binary(BinaryOp::Div), [one, length], Type::F32);
                let scale = self.build_splat(scale, ty.component_count());
                Some(self.builder.add(Op::Binary(BinaryOp::Mul), [x, scale], ty))
            }
            "min_element" | "max_element" | "element_sum" | "element_product" if ty.component_count() > 1 => {
                let op = match name {
                    "min_element" => BinaryOp::Min,
                    "max_element" => BinaryOp::Max,
                    "element_product" => BinaryOp::Mul,
                    _ => BinaryOp::Add,
                };
                let lanes = self.vector_components(x);
                let part = self.ty(lanes[0]);
                let fold = |a: NodeId, b: &NodeId| self.builder.add(Op::Binary(op), [a, *b], part);
                Some(lanes[1..].iter().fold(lanes[0], fold))
            }
            "any" | "all" if ty.scalar_kind() == Some(Scalar::Bool) && ty.component_count() > 1 => {
                let op = if name == "any" { BinaryOp::Or } else { BinaryOp::And };
                let lanes = self.vector_components(x);
                let join = |a: NodeId, b: &NodeId| self.builder.add(Op::Binary(op), [a, *b], Type::BOOL);
                Some(lanes[1..].iter().fold(lanes[0], join))
            }
            "truncate" if ty.component_count() > 2 => {
                let lanes = self.vector_components(x);
                let shorter = Type::value(ty.scalar_kind().unwrap_or(Scalar::F32), ty.component_count() - 1);
                Some(self.builder.add(Op::Compose, &lanes[..lanes.len() - 1], shorter))
            }
            "signum" if ty.scalar_kind() == Some(Scalar::I32) => {
                Some(self.builder.add(Op::Unary(UnaryOp::Sign), [x], ty))
            }
            _ => None,
        })
    }

    fn math_two(&mut self, receiver: &Value, x: NodeId, name: &str, a: &Value, span: Span) -> Eval<Option<NodeId>> {
        let ty = self.ty(x);
        let float_vector = ty.is_float() && ty.component_count() > 1;
        let integer_vector = ty.is_integer() && ty.component_count() > 1;
        Ok(match name {
            "cmplt" | "cmple" | "cmpgt" | "cmpge" | "cmpeq" | "cmpne" if ty.component_count() > 1 => {
                let op = match name {
                    "cmplt" => BinaryOp::Lt,
                    "cmple" => BinaryOp::Le,
                    "cmpgt" => BinaryOp::Gt,
                    "cmpge" => BinaryOp::Ge,
                    "cmpeq" => BinaryOp::Eq,
                    _ => BinaryOp::Ne,
                };
                let (x, y) = self.same_type(receiver, a, span)?;
                let mask = Type::value(Scalar::Bool, ty.component_count());
                Some(self.builder.add(Op::Binary(op), [x, y], mask))
            }
            "test" if ty.scalar_kind() == Some(Scalar::Bool) && ty.component_count() > 1 => {
                let component = self.array_element(&Value::Node(x), a, span)?;
                Some(self.value_node(&component, span)?)
            }
            "min" | "max" => {
                let op = if name == "min" { BinaryOp::Min } else { BinaryOp::Max };
                return Ok(Some({
                    let value = self.eval_binary(op, receiver, a, span)?;
                    self.value_node(&value, span)?
                }));
            }
            "wrapping_add" | "wrapping_sub" | "wrapping_mul" | "wrapping_shl" | "wrapping_shr" | "rem_euclid"
            | "div_euclid" | "pow"
                if ty.is_integer() =>
            {
                return self.integer_two(receiver, x, name, a, span);
            }
            "reflect" if float_vector => {
                // As in glam: self - 2 * self.dot(normal) * normal.
                let (v, n) = self.same_type(receiver, a, span)?;
                let dot = self.build_dot(v, n);
                let two = self.builder.f32(2.0);
                let twice = self.builder.add(Op::Binary(BinaryOp::Mul), [two, dot], Type::F32);
                let twice = self.build_splat(twice, ty.component_count());
                let away = self.builder.add(Op::Binary(BinaryOp::Mul), [twice, n], ty);
                Some(self.builder.add(Op::Binary(BinaryOp::Sub), [v, away], ty))
            }
            "powf" | "atan2" if ty.is_float() => {
                let op = if name == "powf" { BinaryOp::Pow } else { BinaryOp::Atan2 };
                let (x, y) = self.same_type(receiver, a, span)?;
                Some(self.builder.add(Op::Binary(op), [x, y], ty))
            }
            "powi" if ty.is_float() => match self.known_int(a) {
                Some(n) => Some(self.build_power(x, n)),
                None => {
                    let error = Diagnostic::error_at(
                        Code::RuntimeValue,
                        span,
                        "the power of `powi` must be a compile-time constant",
                    )
                    .label("a runtime value")
                    .help("write `powf`, which takes runtime powers: `x.powf(n as f32)`");
                    return Err(self.demand_of(&[a], error));
                }
            },
            "dot" if float_vector => {
                let (x, y) = self.same_type(receiver, a, span)?;
                Some(self.build_dot(x, y))
            }
            "dot" if integer_vector => {
                let (x, y) = self.same_type(receiver, a, span)?;
                Some(self.integer_dot(x, y))
            }
            "distance_squared" if integer_vector => {
                let between = self.eval_binary(BinaryOp::Sub, receiver, a, span)?;
                let between = self.value_node(&between, span)?;
                Some(self.integer_dot(between, between))
            }
            "cross" if ty == Type::value(Scalar::F32, 3) => {
                let (x, y) = self.same_type(receiver, a, span)?;
                Some(self.builder.add(Op::Cross, [x, y], ty))
            }
            "distance" | "distance_squared" if float_vector => {
                let between = self.eval_binary(BinaryOp::Sub, receiver, a, span)?;
                let between = self.value_node(&between, span)?;
                Some(if name == "distance" {
                    self.build_length(between)
                } else {
                    self.build_dot(between, between)
                })
            }
            "extend" if (2..4).contains(&ty.component_count()) => {
                let mut lanes = self.vector_components(x);
                let first = Value::Node(lanes[0]);
                lanes.push(self.same_type(a, &first, span)?.0);
                let longer = Type::value(ty.scalar_kind().unwrap_or(Scalar::F32), ty.component_count() + 1);
                Some(self.builder.add(Op::Compose, lanes, longer))
            }
            _ => None,
        })
    }

    /// Builds `x` to a constant power by repeated squaring, lowest bit first as in Rust; the reciprocal for a negative
    /// power.
    fn build_power(&mut self, x: NodeId, n: i64) -> NodeId {
        let ty = self.ty(x);
        let one = self.builder.f32(1.0);
        let one = self.build_splat(one, ty.component_count());
        let (mut square, mut power, mut left) = (x, one, n.unsigned_abs());
        while left > 0 {
            if left % 2 == 1 {
                power = self.builder.add(Op::Binary(BinaryOp::Mul), [power, square], ty);
            }
            left /= 2;
            if left > 0 {
                square = self.builder.add(Op::Binary(BinaryOp::Mul), [square, square], ty);
            }
        }
        match n < 0 {
            true => self.builder.add(Op::Binary(BinaryOp::Div), [one, power], ty),
            false => power,
        }
    }

    /// Builds the sum of products of components, first to last.
    fn integer_dot(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let ty = self.ty(a);
        let part = Type::scalar(ty.scalar_kind().unwrap_or(Scalar::I32));
        let products = self.builder.add(Op::Binary(BinaryOp::Mul), [a, b], ty);
        let products = self.vector_components(products);
        let sum = |e: &mut Self, sum, next: &NodeId| e.builder.add(Op::Binary(BinaryOp::Add), [sum, *next], part);
        products[1..]
            .iter()
            .fold(products[0], |so_far, next| sum(self, so_far, next))
    }

    fn build_dot(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.builder.add(Op::Dot, [a, b], Type::F32)
    }

    /// Builds the bits of the component with the largest magnitude, without the sign.
    fn largest_magnitude(&mut self, x: NodeId) -> NodeId {
        let bits_type = Type::value(Scalar::U32, self.ty(x).component_count());
        let bits = self.builder.add(Op::Bitcast, [x], bits_type);
        let without_sign = self.builder.constant(Type::U32, [0x7fff_ffff, 0, 0, 0]);
        let mask = self.build_splat(without_sign, bits_type.component_count());
        let sizes = self.builder.add(Op::Binary(BinaryOp::And), [bits, mask], bits_type);
        let lanes = self.vector_components(sizes);
        let (first, rest) = (lanes[0], &lanes[1..]);
        rest.iter().fold(first, |largest, lane| {
            self.builder.add(Op::Binary(BinaryOp::Max), [largest, *lane], Type::U32)
        })
    }

    fn build_length(&mut self, x: NodeId) -> NodeId {
        let squared = self.build_dot(x, x);
        self.builder.add(Op::Unary(UnaryOp::Sqrt), [squared], Type::F32)
    }

    /// Components of a vector as scalars.
    pub fn vector_components(&mut self, x: NodeId) -> Vec<NodeId> {
        let ty = self.ty(x);
        if ty.is_scalar() {
            return vec![x];
        }
        let part = Type::value(ty.scalar_kind().unwrap_or(Scalar::F32), 1);
        (0..ty.component_count())
            .map(|k| self.builder.add(Op::Extract(k), [x], part))
            .collect()
    }

    /// Builds a swizzle: `v.xy()`, `v.zyx()`, ...
    fn build_swizzle(&mut self, x: NodeId, name: &str) -> Option<NodeId> {
        let ty = self.ty(x);
        let lanes: Option<Vec<u8>> = name
            .split("")
            .filter(|c| !c.is_empty())
            .map(super::expr::component_index)
            .collect();
        let lanes = lanes.filter(|l| {
            (2..=4).contains(&l.len()) && ty.component_count() > 1 && l.iter().all(|k| *k < ty.component_count())
        })?;
        let part = Type::value(ty.scalar_kind()?, 1);
        let parts: Vec<_> = lanes
            .iter()
            .map(|k| self.builder.add(Op::Extract(*k), [x], part))
            .collect();
        Some(
            self.builder
                .add(Op::Compose, parts, Type::value(ty.scalar_kind()?, lanes.len() as u8)),
        )
    }
}

fn ambiguity_error(span: Span, message: &str, write: &str) -> super::value::Exit {
    Diagnostic::error_at(Code::DiffersFromRust, span, message)
        .label("means two things")
        .help(format!("write `{write}`"))
        .into()
}

fn unary_method(name: &str) -> Option<UnaryOp> {
    use UnaryOp::*;
    Some(match name {
        "abs" => Abs,
        "floor" => Floor,
        "ceil" => Ceil,
        "trunc" => Trunc,
        "round_ties_even" => Round,
        "sqrt" => Sqrt,
        "cbrt" => Cbrt,
        "exp" => Exp,
        "exp2" => Exp2,
        "ln" => Log,
        "log2" => Log2,
        "sin" => Sin,
        "cos" => Cos,
        "tan" => Tan,
        "asin" => Asin,
        "acos" => Acos,
        "atan" => Atan,
        "sinh" => Sinh,
        "cosh" => Cosh,
        "tanh" => Tanh,
        _ => return None,
    })
}

/// Target type of `as_vec2` and similar methods.
fn conversion_method(name: &str) -> Option<(Scalar, u8)> {
    let rest = name.strip_prefix("as_")?;
    let (kind, lanes) = match rest.strip_prefix("vec") {
        Some(lanes) => (Scalar::F32, lanes),
        None => match rest.strip_prefix("ivec") {
            Some(lanes) => (Scalar::I32, lanes),
            None => (Scalar::U32, rest.strip_prefix("uvec")?),
        },
    };
    lanes.parse().ok().filter(|n| (2..=4).contains(n)).map(|n| (kind, n))
}
