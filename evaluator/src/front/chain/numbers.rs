//! Expressions of a chain that are known while it is read: integers, booleans, options and sizes.

use super::rule::{apply, as_constant, combine_sides, constant_size, size_of_picture};
use super::state::{Known, Walk};
use super::value::Value;
use super::{Source, refused};
use straightline_kernels::OptionValue;
use straightline_manifest::chain::{SizeOp, SizeRule};

/// Help of a number that cannot be.
const CHECK: &str = "check the numbers that it is computed from";

impl Walk<'_> {
    /// Returns the value of an expression without passes; `None` if only a pass can compute it.
    pub(super) fn known(&self, expr: &syn::Expr) -> Known {
        match expr {
            syn::Expr::Paren(inner) => self.known(&inner.expr),
            syn::Expr::Group(inner) => self.known(&inner.expr),
            syn::Expr::Reference(inner) => self.known(&inner.expr),
            syn::Expr::Cast(cast) => Ok(self.known(&cast.expr)?.filter(|value| is_integer_type(&cast.ty, value))),
            syn::Expr::Lit(literal) => Ok(literal_value(&literal.lit)),
            syn::Expr::Path(path) => self.path_value(path),
            syn::Expr::Field(field) => self.field_value(field),
            syn::Expr::Index(index) => self.element(index),
            syn::Expr::Unary(unary) => Ok(match (&unary.op, self.known(&unary.expr)?) {
                (syn::UnOp::Neg(_), Some(Value::Integer(number))) => number.checked_neg().map(Value::Integer),
                (syn::UnOp::Not(_), Some(Value::Flag(flag))) => Some(Value::Flag(!flag)),
                (syn::UnOp::Deref(_), value) => value,
                _ => None,
            }),
            syn::Expr::Binary(binary) => self.binary_value(binary),
            syn::Expr::MethodCall(call) => self.method_value(call),
            syn::Expr::Call(call) => self.size_value(call),
            _ => Ok(None),
        }
    }

    fn path_value(&self, path: &syn::ExprPath) -> Known {
        if let Some(name) = path.path.get_ident() {
            let name = name.to_string();
            if let Some(variable) = self.variable_named(&name) {
                return Ok(Some(variable.value.clone()));
            }
            return match self.constant_named(&name) {
                Some(value) => self.known(value),
                None => Ok(None),
            };
        }
        let segments: Vec<String> = path.path.segments.iter().map(|s| s.ident.to_string()).collect();
        Ok(
            match segments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
                [.., "UVec2", "ONE"] => Some(Value::Size(constant_size([1, 1]))),
                [.., "UVec2", "ZERO"] => Some(Value::Size(constant_size([0, 0]))),
                [.., _, variant] => Some(Value::Choice(straightline_kernels::kebab(variant))),
                _ => None,
            },
        )
    }

    fn field_value(&self, field: &syn::ExprField) -> Known {
        let name = match &field.member {
            syn::Member::Named(name) => name.to_string(),
            syn::Member::Unnamed(index) => index.index.to_string(),
        };
        Ok(match self.known(&field.base)? {
            Some(Value::Options(_)) => match self.options.get(&name.replace('_', "-")) {
                Some(OptionValue::Flag(flag)) => Some(Value::Flag(*flag)),
                Some(OptionValue::Choice(choice)) => Some(Value::Choice(choice.clone())),
                Some(OptionValue::Number(number)) => Some(Value::Integer(*number as i64)),
                _ => None,
            },
            Some(Value::Size(rule)) => match name.as_str() {
                "x" => Some(side(rule, 0)),
                "y" => Some(side(rule, 1)),
                _ => None,
            },
            Some(Value::Tuple(values)) => name.parse().ok().and_then(|k: usize| values.get(k).cloned()),
            _ => None,
        })
    }

    fn element(&self, index: &syn::ExprIndex) -> Known {
        let (Some(Value::Images(images)), Some(Value::Integer(k))) =
            (self.known(&index.expr)?, self.known(&index.index)?)
        else {
            return Ok(None);
        };
        match usize::try_from(k).ok().and_then(|k| images.get(k)) {
            Some(image) => Ok(Some(Value::Image(image.clone()))),
            None => {
                let what = format!("index {k} of a list of {} pictures", images.len());
                Err(refused(self.file, &index.index, what, CHECK))
            }
        }
    }

    fn binary_value(&self, binary: &syn::ExprBinary) -> Known {
        use syn::BinOp as B;
        let (Some(a), Some(b)) = (self.known(&binary.left)?, self.known(&binary.right)?) else {
            return Ok(None);
        };
        let size_op = match binary.op {
            B::Add(_) => Some(SizeOp::Add),
            B::Sub(_) => Some(SizeOp::Sub),
            B::Mul(_) => Some(SizeOp::Mul),
            B::Div(_) | B::Shr(_) => Some(SizeOp::Div),
            _ => None,
        };
        let (a, b) = match (a, b) {
            (Value::Integer(a), Value::Integer(b)) => {
                return match integer_value(&binary.op, a, b) {
                    Arithmetic::Is(value) => Ok(Some(value)),
                    Arithmetic::Other => Ok(None),
                    Arithmetic::Overflows => {
                        let what = format!("{a} and {b} have no result here");
                        Err(refused(self.file, binary, what, CHECK))
                    }
                };
            }
            (Value::Flag(a), Value::Flag(b)) => {
                return Ok(match binary.op {
                    B::And(_) | B::BitAnd(_) => Some(Value::Flag(a && b)),
                    B::Or(_) | B::BitOr(_) => Some(Value::Flag(a || b)),
                    B::BitXor(_) | B::Ne(_) => Some(Value::Flag(a != b)),
                    B::Eq(_) => Some(Value::Flag(a == b)),
                    _ => None,
                });
            }
            (Value::Choice(a), Value::Choice(b)) => {
                return Ok(match binary.op {
                    B::Eq(_) => Some(Value::Flag(a == b)),
                    B::Ne(_) => Some(Value::Flag(a != b)),
                    _ => None,
                });
            }
            pair => pair,
        };
        let Some(op) = size_op else {
            return Ok(None);
        };
        let by = match (&binary.op, b) {
            (B::Shr(_), Value::Integer(bits @ 0..=31)) => Value::Integer(1 << bits),
            (B::Shr(_), _) => return Ok(None),
            (_, b) => b,
        };
        if op == SizeOp::Div
            && size_operand(&by)
                .and_then(|rule| as_constant(&rule))
                .is_some_and(|by| by.contains(&0))
        {
            return Err(refused(self.file, binary, "a size divided by zero", CHECK));
        }
        Ok(apply_to_sizes(op, &a, &by))
    }

    fn method_value(&self, call: &syn::ExprMethodCall) -> Known {
        let Some(receiver) = self.known(&call.receiver)? else {
            return Ok(None);
        };
        let arguments: Vec<&syn::Expr> = call.args.iter().collect();
        let method = call.method.to_string();
        Ok(match (receiver, method.as_str(), arguments.as_slice()) {
            (Value::Image(image), "size", []) => Some(Value::Size(self.size_of(&image.source))),
            (value @ (Value::Image(_) | Value::Images(_)), "clone" | "as_ref" | "iter" | "as_slice", []) => Some(value),
            (value @ Value::Image(_), "unwrap", []) => Some(value),
            (Value::Images(images), "len", []) => Some(Value::Integer(images.len() as i64)),
            (Value::Images(images), "is_empty", []) => Some(Value::Flag(images.is_empty())),
            (Value::Images(images), "last", []) => images.last().cloned().map(Value::Image),
            (Value::Images(images), "first", []) => images.first().cloned().map(Value::Image),
            (receiver, "max" | "min", [other]) => {
                let Some(other) = self.known(other)? else {
                    return Ok(None);
                };
                match (&receiver, &other) {
                    (Value::Integer(a), Value::Integer(b)) if method == "max" => Some(Value::Integer(*a.max(b))),
                    (Value::Integer(a), Value::Integer(b)) => Some(Value::Integer(*a.min(b))),
                    _ => {
                        let op = if method == "max" { SizeOp::Max } else { SizeOp::Min };
                        apply_to_sizes(op, &receiver, &other)
                    }
                }
            }
            (Value::Integer(base), "pow", [exponent]) => match self.known(exponent)? {
                Some(Value::Integer(exponent)) => {
                    let power = u32::try_from(exponent)
                        .ok()
                        .and_then(|exponent| base.checked_pow(exponent));
                    power.map(Value::Integer)
                }
                _ => None,
            },
            _ => None,
        })
    }

    /// The value of `uvec2(x, y)`, `UVec2::new(x, y)` or `UVec2::splat(side)`.
    fn size_value(&self, call: &syn::ExprCall) -> Known {
        let syn::Expr::Path(path) = &*call.func else {
            return Ok(None);
        };
        let segments: Vec<String> = path.path.segments.iter().map(|s| s.ident.to_string()).collect();
        let is_splat = segments.last().is_some_and(|name| name == "splat");
        let is_size = match segments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
            [.., "uvec2"] => true,
            [.., "UVec2", name] => matches!(*name, "new" | "splat"),
            _ => false,
        };
        if !is_size || call.args.len() != if is_splat { 1 } else { 2 } {
            return Ok(None);
        }
        let mut sides = Vec::new();
        for (axis, argument) in [0, 1].into_iter().zip(call.args.iter().cycle()) {
            match self.known(argument)? {
                Some(Value::Side(rule, of)) if of == axis => sides.push(rule),
                Some(Value::Integer(number)) => match u32::try_from(number) {
                    Ok(number) => sides.push(constant_size([number, number])),
                    Err(_) => {
                        return Err(refused(
                            self.file,
                            argument,
                            format!("a side of {number} texels"),
                            CHECK,
                        ));
                    }
                },
                Some(Value::Side(..)) => {
                    let what = "a width that becomes a height, or the reverse";
                    return Err(refused(
                        self.file,
                        argument,
                        what,
                        "compute widths of widths and heights of heights",
                    ));
                }
                _ => return Ok(None),
            }
        }
        Ok(Some(Value::Size(combine_sides(&sides[0], &sides[1]))))
    }

    /// The size of an input or of a picture.
    pub(super) fn size_of(&self, source: &Source) -> SizeRule {
        match source {
            // All frames among the inputs have one size.
            Source::Input(name) => SizeRule::of_input(
                self.frames
                    .first()
                    .filter(|_| self.frames.contains(name))
                    .unwrap_or(name),
            ),
            Source::Picture(index) => size_of_picture(&self.chain.pictures[*index].size),
        }
    }
}

/// A side of a size: a number, of a constant size.
fn side(rule: SizeRule, axis: usize) -> Value {
    match as_constant(&rule) {
        Some(size) => Value::Integer(i64::from(size[axis])),
        None => Value::Side(rule, axis),
    }
}

fn literal_value(literal: &syn::Lit) -> Option<Value> {
    match literal {
        syn::Lit::Int(number) if !matches!(number.suffix(), "f32" | "f64") => {
            number.base10_parse().ok().map(Value::Integer)
        }
        syn::Lit::Bool(flag) => Some(Value::Flag(flag.value)),
        _ => None,
    }
}

/// Returns whether a cast to a type keeps an integer.
fn is_integer_type(ty: &syn::Type, value: &Value) -> bool {
    let syn::Type::Path(path) = ty else {
        return false;
    };
    let integer = path.path.get_ident().is_some_and(|name| {
        ["usize", "u32", "i32", "u64", "i64", "isize"]
            .iter()
            .any(|known| name == known)
    });
    integer && matches!(value, Value::Integer(_) | Value::Side(..))
}

enum Arithmetic {
    Is(Value),
    /// An operation that is left to a pass.
    Other,
    Overflows,
}

fn integer_value(op: &syn::BinOp, a: i64, b: i64) -> Arithmetic {
    use syn::BinOp as B;
    let bits = || u32::try_from(b).ok();
    let number = match op {
        B::Add(_) => a.checked_add(b),
        B::Sub(_) => a.checked_sub(b),
        B::Mul(_) => a.checked_mul(b),
        B::Div(_) => a.checked_div(b),
        B::Rem(_) => a.checked_rem(b),
        B::Shl(_) => bits().and_then(|bits| a.checked_shl(bits)),
        B::Shr(_) => bits().and_then(|bits| a.checked_shr(bits)),
        B::BitAnd(_) => Some(a & b),
        B::BitOr(_) => Some(a | b),
        B::BitXor(_) => Some(a ^ b),
        B::Eq(_) => return Arithmetic::Is(Value::Flag(a == b)),
        B::Ne(_) => return Arithmetic::Is(Value::Flag(a != b)),
        B::Lt(_) => return Arithmetic::Is(Value::Flag(a < b)),
        B::Le(_) => return Arithmetic::Is(Value::Flag(a <= b)),
        B::Gt(_) => return Arithmetic::Is(Value::Flag(a > b)),
        B::Ge(_) => return Arithmetic::Is(Value::Flag(a >= b)),
        _ => return Arithmetic::Other,
    };
    number.map_or(Arithmetic::Overflows, |number| Arithmetic::Is(Value::Integer(number)))
}

/// A size, or a number for both sides.
fn size_operand(value: &Value) -> Option<SizeRule> {
    match value {
        Value::Size(rule) | Value::Side(rule, _) => Some(rule.clone()),
        Value::Integer(number) => u32::try_from(*number)
            .ok()
            .map(|number| constant_size([number, number])),
        _ => None,
    }
}

/// Applies an operation to sizes, or to sides of one axis.
fn apply_to_sizes(op: SizeOp, a: &Value, b: &Value) -> Option<Value> {
    let rule = apply(op, &size_operand(a)?, &size_operand(b)?);
    match (a, b) {
        (Value::Side(_, i), Value::Side(_, j)) if i != j => None,
        (Value::Side(_, axis), Value::Side(..) | Value::Integer(_)) | (Value::Integer(_), Value::Side(_, axis)) => {
            Some(side(rule, *axis))
        }
        (Value::Side(..), _) | (_, Value::Side(..)) => None,
        _ => Some(Value::Size(rule)),
    }
}
