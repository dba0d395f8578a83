//! Methods of what is not a number: textures, arrays, ranges, and the kernel's own types.

use super::Evaluator;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::tree::Expr;
use crate::ir::{BinaryOp, Type};

impl Evaluator<'_> {
    pub fn method(&mut self, receiver: &Expr, name: &str, args: &[Expr], span: Span) -> Eval {
        let value = self.expr(receiver)?;
        let args = self.all(args)?;
        if args.contains(&Value::Poison) {
            return Err(Exit::Noted);
        }
        match &value {
            Value::Struct { ty, .. } | Value::Enum { ty, .. } => {
                let method = format!("{ty}::{name}");
                if self.library.functions.contains_key(&method) {
                    let all = std::iter::once(value.clone()).chain(args).collect();
                    return self.inline(&method, &[], all, span);
                }
                if super::matrix::size(ty).is_some() {
                    return self.matrix_method(&value, name, &args, span);
                }
                let prefix = format!("{ty}::");
                let functions = self.library.functions.keys();
                let mut names: Vec<&str> = functions.filter_map(|f| f.strip_prefix(prefix.as_str())).collect();
                names.sort_unstable();
                let help = match names.is_empty() {
                    true => format!("it has none: write it in an `impl {ty}`"),
                    false => super::call::suggest(name, &names, "it has"),
                };
                Err(Diagnostic::at(span, format!("`{ty}` has no method `{name}`"))
                    .label("not there")
                    .help(help)
                    .into())
            }
            Value::Texture(index) => self.texture(*index, name, &args, span),
            Value::Buffer(index) => self.buffer(*index, name, &args, span),
            Value::Range(range) => self.range_method(range, name, &args, span),
            Value::Array(elements) => self.array_method(elements, name, args.is_empty(), span),
            Value::Node(id) if self.ty(*id).is_array() => {
                let Type::Array { len, .. } = self.ty(*id) else {
                    unreachable!("just matched")
                };
                let each = (0..len).map(|k| self.element(&value, &Value::Int(i64::from(k)), span));
                let elements = each.collect::<Eval<Vec<Value>>>()?;
                self.array_method(&elements, name, args.is_empty(), span)
            }
            Value::Int(n) => match (name, args.as_slice()) {
                ("abs", []) => Ok(Value::Int(n.abs())),
                ("signum", []) => Ok(Value::Int(n.signum())),
                ("rem_euclid", [Value::Int(m)]) if *m > 0 => Ok(Value::Int(n.rem_euclid(*m))),
                ("div_euclid", [Value::Int(m)]) if *m > 0 => Ok(Value::Int(n.div_euclid(*m))),
                ("div_ceil", [Value::Int(m)]) if *n >= 0 && *m > 0 => Ok(Value::Int(n / m + i64::from(n % m > 0))),
                ("is_multiple_of", [Value::Int(m)]) => {
                    let multiple = if *m == 0 { *n == 0 } else { n % m == 0 };
                    Ok(Value::Node(self.builder.bool(multiple)))
                }
                ("min", [other]) => self.binary(BinaryOp::Min, &value, other, span),
                ("max", [other]) => self.binary(BinaryOp::Max, &value, other, span),
                _ => self.math(&value, name, &args, span),
            },
            Value::Poison => Err(Exit::Noted),
            Value::Node(id) if name == "to_array" && args.is_empty() && self.ty(*id).lanes() > 1 => {
                let lanes = self.lanes(*id);
                Ok(Value::array(lanes.into_iter().map(Value::Node).collect()))
            }
            _ => self.math(&value, name, &args, span),
        }
    }

    fn array_method(&mut self, elements: &[Value], name: &str, plain: bool, span: Span) -> Eval {
        match (name, plain) {
            ("len", true) => Ok(Value::Int(elements.len() as i64)),
            ("iter" | "into_iter" | "copied", true) => Ok(Value::array(elements.to_vec())),
            ("enumerate", true) => {
                let pair = |(k, element): (usize, &Value)| Value::Tuple(vec![Value::Int(k as i64), element.clone()]);
                Ok(Value::array(elements.iter().enumerate().map(pair).collect()))
            }
            ("rev", true) => Ok(Value::array(elements.iter().rev().cloned().collect())),
            _ => Err(Diagnostic::at(span, format!("an array has no method `{name}`"))
                .label("not supported")
                .help("arrays have `len`, `iter`, `enumerate` and `rev`")
                .into()),
        }
    }
}
