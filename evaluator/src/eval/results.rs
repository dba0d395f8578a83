//! Results of a kernel: one value for each pixel, or a structure or tuple of them, each with a target of its own.

use super::Evaluator;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::Function;
use crate::front::unraw;
use crate::ir::{Invocation, NodeId, OutputTarget, Scalar, Type};

/// Minimum number of colour attachments that WebGPU guarantees.
const MOST: usize = 8;

impl Evaluator<'_> {
    /// Splits a kernel's value into its results, and records their targets in the graph.
    pub fn split_results(&mut self, value: &Value, function: &Function) -> Eval<Vec<NodeId>> {
        let span = function.span;
        let parts = self.parts_of_result(value, function)?;
        let (mut targets, mut results) = (Vec::new(), Vec::new());
        for (name, part, at) in parts {
            let id = match &part {
                Value::Node(id) if self.is_target(*id) => *id,
                Value::Poison => return Err(Exit::Noted),
                _ => return Err(self.no_target(&name, &part, at)),
            };
            let name = self.output_name(&name, &targets);
            let ty = self.ty(id);
            targets.push(OutputTarget { name, ty, tile: None });
            results.push(id);
        }
        let written = targets.len() + self.builder.graph().images.len();
        if written > MOST {
            let what = match written - targets.len() {
                0 => format!("a kernel that gives {written} values for each pixel"),
                _ => format!("a kernel that writes {written} pictures"),
            };
            return Err(Diagnostic::error_at(Code::KernelResult, span, what)
                .label("the kernel")
                .help(format!(
                    "a shader writes {MOST} targets at most: pack numbers into vectors"
                ))
                .into());
        }
        self.builder.graph_mut().targets = targets;
        Ok(results)
    }

    /// Unique name of a result: the field's, unless an image that the kernel writes has it.
    fn output_name(&self, name: &str, targets: &[OutputTarget]) -> String {
        let images = &self.builder.graph().images;
        self.free_name(unraw(name), &|name| {
            images.iter().chain(targets).any(|target| target.name == name)
        })
    }

    /// Result values with their names and source locations.
    fn parts_of_result(&self, value: &Value, function: &Function) -> Eval<Vec<(String, Value, Span)>> {
        let span = function.span;
        let of_group = matches!(self.builder.graph().invocation, Invocation::Group(_));
        let value = match value {
            // Each thread stores the value of its own pixel.
            Value::Struct { ty, fields } if of_group && ty == "PerThread" => &fields[0].1,
            Value::Tuple(parts) if of_group && parts.is_empty() => value,
            _ if of_group => {
                let what = format!("a kernel of workgroups gives {}", value.describe());
                return Err(Diagnostic::error_at(Code::KernelResult, span, what)
                    .label("one for all threads")
                    .help("give what a phase gives, a value for each of its threads: `-> PerThread<Vec4>`")
                    .into());
            }
            _ => value,
        };
        let numbered = |k: usize| format!("{}_{k}", OutputTarget::DEFAULT_NAME);
        match value {
            Value::Tuple(parts) if parts.is_empty() && self.builder.graph().has_lasting_effects() => Ok(Vec::new()),
            Value::Tuple(parts) if !parts.is_empty() => {
                let parts = parts.iter().enumerate();
                Ok(parts.map(|(k, part)| (numbered(k), part.clone(), span)).collect())
            }
            Value::Struct { ty, fields } => {
                let Some(structure) = self.library.structs.get(&**ty) else {
                    return Err(self.no_target(OutputTarget::DEFAULT_NAME, value, span));
                };
                let mut parts = Vec::new();
                for (k, (name, part)) in fields.iter().enumerate() {
                    let at = structure.fields.iter().find(|(field, ..)| field == name);
                    let at = at.map_or(span, |(.., at)| *at);
                    let is_numbered = name.starts_with(|c: char| c.is_ascii_digit());
                    let name = if is_numbered { numbered(k) } else { name.to_string() };
                    parts.push((name, part.clone(), at));
                }
                match parts.is_empty() {
                    true => Err(self.no_target(OutputTarget::DEFAULT_NAME, value, span)),
                    false => Ok(parts),
                }
            }
            other => Ok(vec![(OutputTarget::DEFAULT_NAME.to_owned(), other.clone(), span)]),
        }
    }

    fn is_target(&self, id: NodeId) -> bool {
        matches!(self.ty(id), Type::Value { scalar, .. } if !matches!(scalar, Scalar::Bool | Scalar::Usize))
    }

    fn no_target(&self, name: &str, value: &Value, span: Span) -> Exit {
        let found = match value {
            Value::Node(id) => self.ty(*id).in_rust(),
            Value::Int(_) => "a `usize`".to_owned(),
            other => other.describe(),
        };
        let (what, label) = match name == OutputTarget::DEFAULT_NAME {
            true if matches!(value, Value::Tuple(parts) if parts.is_empty()) => (
                "a kernel that gives nothing and writes nothing".to_owned(),
                "the kernel",
            ),
            true => (format!("a kernel gives numbers and vectors, not {found}"), "the kernel"),
            false => (
                format!("`{name}` is one of the values that the kernel gives, and is {found}"),
                "not supported",
            ),
        };
        let help = match value {
            Value::Node(id) if self.ty(*id).scalar_kind() == Some(Scalar::Bool) => {
                "a target holds numbers: choose one, `if condition { 1.0 } else { 0.0 }`"
            }
            Value::Int(_) => "convert it with `as i32` or `as u32`",
            Value::Node(id) if self.ty(*id).scalar_kind() == Some(Scalar::Usize) => {
                "convert it with `as i32` or `as u32`"
            }
            Value::Tuple(parts) if parts.is_empty() => {
                "give a value for each pixel, or write to an `&AtomicBuffer`, a `&StorageBuffer` or a `&StorageTexture`"
            }
            _ => {
                "give f32, i32, u32, a vector of 2 to 4 of them, or a structure or tuple of such values, each of which has a target \
                 of its own"
            }
        };
        Diagnostic::error_at(Code::KernelResult, span, what)
            .label(label)
            .help(help)
            .into()
    }
}
