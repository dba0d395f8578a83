//! Samplers and buffers: the kernel's parameters of these types, and their methods.

use super::Evaluator;
// Booleans are in no buffer.
use super::value::{Eval, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::tree::Type as SourceType;
use crate::ir::vector_named as vector_type;
use crate::ir::{BinaryOp, Buffer, Op, Sampler, Type};

impl Evaluator<'_> {
    /// A parameter that stands for a resource; `None` if its type is none.
    pub fn resource(&mut self, name: &str, ty: &SourceType, span: Span) -> Eval<Option<Value>> {
        let SourceType::Name(type_name, args) = ty else {
            return Ok(None);
        };
        match type_name.as_str() {
            "Sampler" | "ComparisonSampler" => {
                self.unused_name(name, span)?;
                let samplers = &mut self.builder.graph_mut().samplers;
                samplers.push(Sampler {
                    name: name.to_owned(),
                    comparison: type_name == "ComparisonSampler",
                });
                Ok(Some(Value::Sampler(samplers.len() as u32 - 1)))
            }
            "Buffer" => {
                let element = self.element_type(name, args, span)?;
                self.unused_name(name, span)?;
                let buffers = &mut self.builder.graph_mut().buffers;
                buffers.push(Buffer {
                    name: name.to_owned(),
                    element,
                });
                Ok(Some(Value::Buffer(buffers.len() as u32 - 1)))
            }
            _ => self.texture_parameter(name, type_name, args, span),
        }
    }

    /// Elements of a buffer lie one after the other natively and in a shader.
    fn element_type(&self, name: &str, args: &[SourceType], span: Span) -> Eval<Type> {
        let element = match args {
            [SourceType::Name(element, _)] => match element.as_str() {
                "f32" => Some(Type::F32),
                "i32" => Some(Type::I32),
                "u32" => Some(Type::U32),
                other => vector_type(other)
                    .filter(|(_, n)| *n != 3)
                    .map(|(kind, n)| Type::value(kind, n)),
            },
            _ => None,
        };
        element.ok_or_else(|| {
            Diagnostic::at(
                span,
                format!("the buffer `{name}` has no elements that a shader can read"),
            )
            .label("of this type")
            .note("a vector of 3 takes the room of 4 in a shader's array, and of 3 in Rust's")
            .help("elements are f32, i32, u32, or vectors of 2 or 4 of them")
            .into()
        })
    }

    /// Bindings go by name.
    pub fn unused_name(&self, name: &str, span: Span) -> Eval<()> {
        let graph = self.builder.graph();
        let mut names = graph.textures.iter().map(|t| &t.name);
        let taken = names.any(|n| n == name)
            || graph.buffers.iter().any(|b| b.name == name)
            || graph.samplers.iter().any(|s| s.name == name)
            || graph.uniforms.iter().any(|u| u.name == name)
            || graph.varyings.iter().any(|v| v.name == name);
        if taken {
            return Err(Diagnostic::at(span, format!("two inputs are called `{name}`"))
                .label("the second")
                .help("bindings go by name: rename one")
                .into());
        }
        Ok(())
    }

    /// A method of a buffer.
    pub fn buffer(&mut self, index: u32, name: &str, args: &[Value], span: Span) -> Eval {
        match (name, args) {
            ("len", []) => Ok(Value::Node(self.builder.add(
                Op::BufferLen(index),
                Vec::new(),
                Type::I32,
            ))),
            ("load", [at]) => {
                let at = self.index_node(at, span)?;
                let len = self.builder.add(Op::BufferLen(index), Vec::new(), Type::I32);
                let (zero, one) = (self.builder.i32(0), self.builder.i32(1));
                let last = self.builder.add(Op::Binary(BinaryOp::Sub), vec![len, one], Type::I32);
                self.name(&Value::Node(last), "last", span);
                let inside = self.builder.add(Op::Clamp, vec![at, zero, last], Type::I32);
                let ty = self.builder.graph().buffers[index as usize].element;
                let op = Op::BufferLoad {
                    buffer: index,
                    site: self.site(),
                };
                Ok(Value::Node(self.builder.add(op, vec![inside], ty)))
            }
            _ => Err(Diagnostic::at(span, format!("a buffer has no method `{name}`"))
                .label("not supported")
                .help("buffers have `load` and `len`")
                .into()),
        }
    }

    pub(super) fn site(&mut self) -> u32 {
        self.sites += 1;
        self.sites
    }
}
