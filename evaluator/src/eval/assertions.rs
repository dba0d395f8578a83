//! Assertions of a test, whose first failure in an invocation is written to buffers of the test's kernel, and its probes.

use super::Evaluator;
use super::effects::MemoryEffect;
use super::value::{Eval, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::testing::{COUNTS, FLOATS, Kind, Recorded, STATE, WORDS};
use crate::ir::{AtomicOp, BinaryOp, Memory, NodeId, Op, Scalar, Type};

impl Evaluator<'_> {
    /// Records that an assertion fails unless `condition` holds, with its values, if none failed before.
    pub(super) fn eval_record(&mut self, site: &Value, condition: &Value, values: [&Value; 2], span: Span) -> Eval {
        let condition = self.value_node(condition, span)?;
        let failed = self.not(condition);
        if self
            .builder
            .graph()
            .constant_bits(failed)
            .is_some_and(|bits| bits[0] == 0)
        {
            return Ok(Value::unit());
        }
        let site = self.known_int(site).unwrap_or(0) as u32;
        let [state, floats, words] = [STATE, FLOATS, WORDS].map(|name| self.buffer_named(name));
        let (Some(state), Some(floats), Some(words)) = (state, floats, words) else {
            return Err(Diagnostic::error_at(Code::UnknownFunction, span, "an assertion outside of a test").into());
        };
        let parts = values.map(|value| self.recorded_parts(value));
        let recorded = |parts: &Option<(Kind, Vec<NodeId>)>| parts.as_ref().map(|(kind, of)| (*kind, of.len() as u8));
        let of = [recorded(&parts[0]), recorded(&parts[1])];
        let slots = self.recorded_slots();
        let code = self.u32_value(Recorded { site, of }.encode());
        self.eval_under(&[(failed, true)], |e| {
            let one = e.u32_value(1);
            let add = MemoryEffect::Atomic(AtomicOp::Add);
            let before = e.effect_on(state, add, &[slots[0].clone(), one], span)?;
            let before = e.value_node(&before, span)?;
            let zero = e.builder.constant(Type::U32, [0; 4]);
            let first = e.builder.add(Op::Binary(BinaryOp::Eq), [before, zero], Type::BOOL);
            e.eval_under(&[(first, true)], |e| {
                let max = MemoryEffect::Atomic(AtomicOp::Max);
                e.effect_on(state, max, &[slots[1].clone(), code], span)?;
                for (slot, parts) in slots.iter().zip(parts) {
                    let Some((kind, parts)) = parts else { continue };
                    let (memory, scalar) = match kind {
                        Kind::F32 => (floats, Scalar::F32),
                        _ => (words, Scalar::U32),
                    };
                    let whole = e.padded_vector(&parts, scalar);
                    e.effect_on(memory, MemoryEffect::Store, &[slot.clone(), whole], span)?;
                }
                Ok(Value::unit())
            })
        })
    }

    /// Counts an execution of a probe.
    pub(super) fn eval_count(&mut self, probe: &Value, span: Span) -> Eval {
        let Some(counts) = self.buffer_named(COUNTS) else {
            return Err(Diagnostic::error_at(Code::UnknownFunction, span, "a probe outside of a test").into());
        };
        let one = self.u32_value(1);
        self.effect_on(counts, MemoryEffect::Atomic(AtomicOp::Add), &[probe.clone(), one], span)?;
        Ok(Value::unit())
    }

    fn u32_value(&mut self, n: u32) -> Value {
        Value::Node(self.builder.constant(Type::U32, [n, 0, 0, 0]))
    }

    fn buffer_named(&self, name: &str) -> Option<Memory> {
        let buffers = &self.builder.graph().buffers;
        let index = buffers.iter().position(|buffer| buffer.name == name)?;
        Some(Memory::Buffer(index as u32))
    }

    /// The two elements of an invocation in each buffer.
    fn recorded_slots(&mut self) -> [Value; 2] {
        let pair = Type::value(Scalar::I32, 2);
        let [pixel, frame] = [Op::Pixel, Op::FrameSize].map(|op| self.builder.add(op, Vec::new(), pair));
        let [x, y] = [0, 1].map(|k| self.builder.add(Op::Extract(k), [pixel], Type::I32));
        let width = self.builder.add(Op::Extract(0), [frame], Type::I32);
        let row = self.builder.add(Op::Binary(BinaryOp::Mul), [y, width], Type::I32);
        let index = self.builder.add(Op::Binary(BinaryOp::Add), [row, x], Type::I32);
        let (one, two) = (self.builder.i32(1), self.builder.i32(2));
        let even = self.builder.add(Op::Binary(BinaryOp::Mul), [index, two], Type::I32);
        let odd = self.builder.add(Op::Binary(BinaryOp::Add), [even, one], Type::I32);
        [even, odd].map(Value::Node)
    }

    /// The components of a number, vector or boolean, floats as they are and others as `u32`; `None` of other values.
    fn recorded_parts(&mut self, value: &Value) -> Option<(Kind, Vec<NodeId>)> {
        let id = match value {
            Value::Int(n) => {
                let n = i32::try_from(*n).ok()?;
                self.builder.i32(n)
            }
            Value::Node(id) => *id,
            _ => return None,
        };
        let ty = self.ty(id);
        if ty.is_array() {
            return None;
        }
        let kind = match ty.scalar_kind()? {
            Scalar::F32 => Kind::F32,
            Scalar::I32 => Kind::I32,
            Scalar::U32 | Scalar::Usize => Kind::U32,
            Scalar::Bool => Kind::Bool,
        };
        let mut parts = self.vector_components(id);
        if kind != Kind::F32 {
            for part in &mut parts {
                *part = self.convert_node(*part, Scalar::U32);
            }
        }
        Some((kind, parts))
    }

    /// A vector of four components: the parts, then zeros.
    fn padded_vector(&mut self, parts: &[NodeId], scalar: Scalar) -> Value {
        let zero = self.builder.constant(Type::value(scalar, 1), [0; 4]);
        let all: Vec<NodeId> = parts.iter().copied().chain(std::iter::repeat(zero)).take(4).collect();
        Value::Node(self.builder.add(Op::Compose, all, Type::value(scalar, 4)))
    }
}
