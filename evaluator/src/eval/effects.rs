//! Side effects of a kernel: writes to buffers and images.
//!
//! Both sides of a selected condition are evaluated, and code after an early exit is evaluated for all invocations. Each
//! effect therefore carries a condition: the conditions of the sides that contain it, and that no exit was taken. For
//! branches and loops left in the shader, the region implies the rest.

use super::Evaluator;
use super::buffers::value_named;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::Type as SourceType;
use crate::ir::{Access, AtomicOp, BinaryOp, Invocation, Memory, NodeId, Op, OutputTarget, Scalar, Type};

/// Methods of a buffer of atomics, with their operations.
const ATOMICS: [(&str, AtomicOp); 8] = [
    ("add", AtomicOp::Add),
    ("max", AtomicOp::Max),
    ("min", AtomicOp::Min),
    ("and", AtomicOp::And),
    ("or", AtomicOp::Or),
    ("xor", AtomicOp::Xor),
    ("exchange", AtomicOp::Exchange),
    ("load", AtomicOp::Load),
];

/// Atomic methods with their arguments, for messages.
pub const ATOMIC_METHODS: &str =
    "`add`, `max`, `min`, `and`, `or`, `xor`, `exchange`, each of an index and a value, `load` of an index, and `len`";

/// Kind of an access to memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemoryEffect {
    /// Atomic change of an element.
    Atomic(AtomicOp),
    /// Write of an element.
    Store,
}

/// Atomic operation of a method with this number of arguments.
pub fn atomic_named(name: &str, arguments: usize) -> Option<AtomicOp> {
    let (_, op) = ATOMICS.iter().find(|(method, _)| *method == name)?;
    (arguments == if *op == AtomicOp::Load { 1 } else { 2 }).then_some(*op)
}

impl Evaluator<'_> {
    /// Adds a parameter that is an image of the frame's size, written by the kernel.
    pub(super) fn image_parameter(&mut self, name: &str, args: &[SourceType], span: Span) -> Eval {
        let ty = match args {
            [SourceType::Name(of, _)] => value_named(of),
            _ => None,
        };
        let Some(ty) = ty.filter(|ty| ty.scalar_kind() != Some(Scalar::Bool)) else {
            return Err(Diagnostic::error_at(
                Code::ResourceElement,
                span,
                format!("the picture `{name}` has no texels that a shader can write"),
            )
            .label("of this type")
            .help("texels are f32, i32, u32, or vectors of them")
            .into());
        };
        let name = &*self.input_name(name);
        let images = &mut self.builder.graph_mut().images;
        images.push(OutputTarget {
            name: name.to_owned(),
            ty,
            tile: None,
        });
        Ok(Value::Image(images.len() as u32 - 1))
    }

    /// Evaluates a method of an image that the kernel writes.
    pub fn eval_image_method(&mut self, index: u32, name: &str, args: &[Value], span: Span) -> Eval {
        let image = self.builder.graph().images[index as usize].name.clone();
        match (name, args) {
            ("size", []) => {
                let size = self.builder.add(Op::FrameSize, Vec::new(), Type::value(Scalar::I32, 2));
                Ok(Value::Node(self.convert_node(size, Scalar::U32)))
            }
            ("store", [_, _]) => {
                self.check_write_allowed(&image, span)?;
                self.effect_on(Memory::Image(index), MemoryEffect::Store, args, span)
            }
            _ => Err(Diagnostic::error_at(
                Code::UnknownMethod,
                span,
                format!("`{image}` is a `StorageTexture`, which has no method `{name}` with such arguments"),
            )
            .label("not supported")
            .help("it has `store` of a place and a texel, and `size`; take a `&Frame` or a `&Texture` to read")
            .into()),
        }
    }

    /// Evaluates a method of a buffer that the kernel writes.
    pub fn written_buffer(&mut self, index: u32, name: &str, args: &[Value], span: Span) -> Eval {
        let buffer = self.builder.graph().buffers[index as usize].clone();
        let effect = match (buffer.access, atomic_named(name, args.len()), args) {
            (_, _, []) if name == "len" => {
                let len = self.builder.add(Op::BufferLen(index), Vec::new(), Type::I32);
                return Ok(self.as_usize(len));
            }
            (Access::Atomic, Some(op), _) => MemoryEffect::Atomic(op),
            (Access::Write, _, [_, _]) if name == "store" => MemoryEffect::Store,
            _ => return Err(no_such_method(&buffer.name, buffer.access, name, span)),
        };
        self.check_write_allowed(&buffer.name, span)?;
        self.effect_on(Memory::Buffer(index), effect, args, span)
    }

    /// Adds an effect on memory. The first of `args` is the index, the second the value.
    pub fn effect_on(&mut self, memory: Memory, effect: MemoryEffect, args: &[Value], span: Span) -> Eval {
        let (element, name) = self.builder.graph().memory(memory);
        let name = name.to_owned();
        let at = match memory {
            Memory::Image(_) => self.value_node(&args[0], span)?,
            Memory::Buffer(_) | Memory::Shared(_) => self.index_node(&args[0], span)?,
        };
        let mut given = vec![at];
        if let Some(value) = args.get(1) {
            let value = match element {
                Type::Value { scalar, components: 1 } => self.int_or_node(value, scalar, span)?,
                _ => self.value_node(value, span)?,
            };
            if self.ty(value) != element {
                let (wanted, found) = (element.in_rust(), self.ty(value).in_rust());
                return Err(Diagnostic::error_at(
                    Code::MismatchedTypes,
                    span,
                    format!("`{name}` holds {wanted}, not {found}"),
                )
                .label("of this value")
                .help(format!("convert it to {wanted}"))
                .into());
            }
            given.push(value);
        }
        let inside = match memory {
            Memory::Image(_) => self.inside_frame(at),
            _ => self.index_in_bounds(memory, &args[0], span)?,
        };
        let reached = self.reach_condition();
        let condition = self.and(reached, inside);
        let args = [&[condition], &given[..]].concat();
        Ok(match effect {
            MemoryEffect::Atomic(op) => Value::Node(self.builder.add_effect(Op::Atomic { memory, op }, args, element)),
            MemoryEffect::Store => {
                self.builder.add_effect(Op::Store(memory), args, Type::Results);
                Value::unit()
            }
        })
    }

    /// Builds the test for an index inside memory.
    fn index_in_bounds(&mut self, memory: Memory, index: &Value, span: Span) -> Eval<NodeId> {
        let index = self.value_node(index, span)?;
        let len = match memory {
            Memory::Image(_) => return Ok(self.inside_frame(index)),
            Memory::Buffer(buffer) => self.builder.add(Op::BufferLen(buffer), Vec::new(), Type::I32),
            Memory::Shared(shared) => {
                let len = self.builder.graph().shared[shared as usize].len;
                let bounds = crate::passes::integer_bounds(self.builder.graph(), index);
                if bounds.is_some_and(|(low, high)| low >= 0 && high < i64::from(len)) {
                    return Ok(self.builder.bool(true));
                }
                self.builder.i32(len as i32)
            }
        };
        // A negative index becomes a large one.
        let kind = match self.ty(index) {
            Type::USIZE => Scalar::Usize,
            _ => Scalar::U32,
        };
        let [at, len] = [index, len].map(|id| self.convert_node(id, kind));
        if let Memory::Buffer(_) = memory {
            let name = self.builder.graph().memory(memory).1.to_owned();
            self.name_value(&Value::Node(len), &format!("{name}_len"), span);
        }
        Ok(self.builder.add(Op::Binary(BinaryOp::Lt), [at, len], Type::BOOL))
    }

    /// Builds the test for a position inside the frame.
    fn inside_frame(&mut self, at: NodeId) -> NodeId {
        if matches!(self.builder.graph().node(at).op, Op::Pixel) && self.builder.graph().invocation == Invocation::Pixel
        {
            return self.builder.bool(true);
        }
        let frame = self.builder.add(Op::FrameSize, Vec::new(), Type::value(Scalar::I32, 2));
        let [at, frame] = [at, frame].map(|id| self.vector_components(id));
        let mut inside = self.builder.bool(true);
        for (at, side) in at.into_iter().zip(frame) {
            // A negative coordinate becomes a large one.
            let [at, side] = [at, side].map(|id| self.convert_node(id, Scalar::U32));
            let within = self.builder.add(Op::Binary(BinaryOp::Lt), [at, side], Type::BOOL);
            inside = self.and(inside, within);
        }
        inside
    }

    /// Rejects writes unless each invocation computes one pixel inside the frame.
    fn check_write_allowed(&mut self, name: &str, span: Span) -> Eval<()> {
        let (what, help) = match self.builder.graph().invocation {
            Invocation::Pixel => return Ok(()),
            Invocation::Group(_) if self.control.in_phase => return Ok(()),
            Invocation::Group(_) => (
                "a kernel of workgroups, outside of its phases,",
                "put it into a `group.each(|thread| ...)`, or every thread would do it",
            ),
            Invocation::Lane => (
                "a kernel of quads",
                "lanes that lie outside of the frame compute too: take `pixel: IVec2`",
            ),
            Invocation::MayBeOutside | Invocation::Block(_) => (
                "an invocation of several pixels",
                "pixels that lie outside of the frame compute too: leave the block out",
            ),
        };
        Err(
            Diagnostic::error_at(Code::MisplacedWrite, span, format!("{what} writes to `{name}`"))
                .label("not supported")
                .help(help)
                .into(),
        )
    }
}

fn no_such_method(buffer: &str, access: Access, name: &str, span: Span) -> Exit {
    let (ty, methods, help) = match access {
        Access::Atomic => ("an `AtomicBuffer`", ATOMIC_METHODS, ""),
        _ => (
            "a `StorageBuffer`",
            "`store` of an index and a value, and `len`",
            "; take a `&Buffer` to read, or an `&AtomicBuffer` for both",
        ),
    };
    Diagnostic::error_at(
        Code::UnknownMethod,
        span,
        format!("`{buffer}` is {ty}, which has no method `{name}` with such arguments"),
    )
    .label("not supported")
    .help(format!("it has {methods}{help}"))
    .into()
}
