//! Methods of what is not a number: textures, arrays, ranges, and the kernel's own types.

use super::Evaluator;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::tree::Expr;
use crate::ir::{BinaryOp, Op, Scalar, Type};

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
                    return self.inline(&method, all, span);
                }
                Err(Diagnostic::at(span, format!("`{ty}` has no method `{name}`")).into())
            }
            Value::Texture(index) => self.texture(*index, name, &args, span),
            Value::Range(range) => match (name, args.as_slice()) {
                ("rev", []) => {
                    let mut range = range.clone();
                    range.reversed = !range.reversed;
                    Ok(Value::Range(range))
                }
                ("step_by", [step]) => match self.known_int(step) {
                    Some(step @ 1..) if !range.reversed && range.step == 1 => {
                        let mut range = range.clone();
                        range.step = step;
                        Ok(Value::Range(range))
                    }
                    _ => Err(Diagnostic::at(
                        span,
                        "`step_by` needs a known step of at least 1, and comes before `rev`",
                    )
                    .into()),
                },
                _ => Err(Diagnostic::at(span, format!("a range has no method `{name}`"))
                    .help("ranges have `rev` and `step_by`")
                    .into()),
            },
            Value::Array(elements) => match (name, args.is_empty()) {
                ("len", true) => Ok(Value::Int(elements.len() as i64)),
                ("iter" | "into_iter" | "copied", true) => Ok(value.clone()),
                _ => Err(Diagnostic::at(span, format!("an array has no method `{name}`"))
                    .help("arrays have `len` and `iter`")
                    .into()),
            },
            Value::Node(id) if self.ty(*id).is_array() => match (self.ty(*id), name) {
                (Type::Array { len, .. }, "len") => Ok(Value::Int(i64::from(len))),
                _ => Err(Diagnostic::at(span, format!("an array has no method `{name}`"))
                    .help("arrays have `len` and `iter`")
                    .into()),
            },
            Value::Int(n) => match (name, args.as_slice()) {
                ("abs", []) => Ok(Value::Int(n.abs())),
                ("min", [other]) => self.binary(BinaryOp::Min, &value, other, span),
                ("max", [other]) => self.binary(BinaryOp::Max, &value, other, span),
                _ => self.math(&value, name, &args, span),
            },
            Value::Poison => Err(Exit::Noted),
            _ => self.math(&value, name, &args, span),
        }
    }

    fn texture(&mut self, index: u32, name: &str, args: &[Value], span: Span) -> Eval {
        let texture = self.builder.graph().textures[index as usize].clone();
        match (name, args) {
            ("size", []) => {
                let size = self.builder.add(Op::FrameSize, Vec::new(), Type::value(Scalar::I32, 2));
                Ok(Value::Node(self.convert(size, Scalar::U32)))
            }
            ("load", [coord]) if !texture.layered => self.load(index, coord, None, span),
            ("load", [coord, layer]) if texture.layered => {
                let layer = self.index_node(layer, span)?;
                self.load(index, coord, Some(layer), span)
            }
            ("load", _) => {
                let expected = if texture.layered {
                    "a coordinate and a layer"
                } else {
                    "a coordinate"
                };
                Err(Diagnostic::at(span, format!("`load` of `{}` takes {expected}", texture.name)).into())
            }
            _ => Err(Diagnostic::at(span, format!("a texture has no method `{name}`"))
                .help("textures have `load` and `size`")
                .into()),
        }
    }

    /// A texel, its coordinate clamped to the frame.
    fn load(&mut self, texture: u32, coord: &Value, layer: Option<crate::ir::NodeId>, span: Span) -> Eval {
        let pair = Type::value(Scalar::I32, 2);
        let coord = self.node(coord, span)?;
        if self.ty(coord) != pair {
            return Err(Diagnostic::at(
                span,
                format!("a texel's coordinate is an IVec2, not {}", self.ty(coord)),
            )
            .into());
        }
        let size = self.builder.add(Op::FrameSize, Vec::new(), pair);
        let one = self.builder.constant(pair, [1, 1, 0, 0]);
        let zero = self.builder.constant(pair, [0; 4]);
        let last = self.builder.add(Op::Binary(BinaryOp::Sub), vec![size, one], pair);
        self.name(&Value::Node(last), "last", span);
        let inside = self.builder.add(Op::Clamp, vec![coord, zero, last], pair);
        self.name(&Value::Node(inside), "texel", span);
        self.sites += 1;
        let components = self.builder.graph().textures[texture as usize].components;
        let args = std::iter::once(inside).chain(layer).collect();
        let op = Op::Load {
            texture,
            site: self.sites,
        };
        Ok(Value::Node(self.builder.add(
            op,
            args,
            Type::value(Scalar::F32, components),
        )))
    }
}
