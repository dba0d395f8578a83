//! Kernels of workgroups: phases that all threads run, and the memory they share.
//!
//! A workgroup kernel describes the work of the whole group; each of its phases, `group.each(|thread| ...)`, describes that
//! of one thread. Outside phases all threads compute the same, so they agree on every condition and loop around a phase. A
//! barrier separates two phases, unless nothing has been written since the last one.

use super::Evaluator;
use super::buffers::value_named;
use super::effects::{MemoryEffect, atomic_named};
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Function, Type as SourceType};
use crate::ir::{Access, BinaryOp, Invocation, MOST_SHARED_BYTES, Memory, Op, Scalar, SharedArray, Type};

const PAIR: Type = Type::value(Scalar::I32, 2);

/// Number of threads in a workgroup that every device supports.
const MOST_THREADS: i64 = 256;

impl Evaluator<'_> {
    /// Path of the method that runs a phase.
    pub(super) const PHASE: &'static str = "Workgroup::each";

    /// Adds the workgroup parameter, `&Workgroup<WIDTH, HEIGHT>`; `None` for any other type.
    pub(super) fn workgroup_parameter(&mut self, name: &str, ty: &SourceType, span: Span) -> Eval<Option<Value>> {
        let found = self.library.structs.get("Workgroup");
        let first = found.and_then(|structure| structure.fields.first());
        let own = first.is_some_and(|(.., at)| at.file == crate::front::std::FILE);
        let SourceType::Name(of, args) = ty else {
            return Ok(None);
        };
        if of != "Workgroup" || !own {
            return Ok(None);
        }
        let invocation = self.builder.graph().invocation;
        if invocation != Invocation::Pixel {
            return Err(Diagnostic::error_at(
                Code::KernelParameter,
                span,
                format!("`{name}` is a workgroup, in a kernel of several pixels an invocation"),
            )
            .label("not supported")
            .help("take one or the other: no `Quad`, no block of pixels, and one `Workgroup`")
            .into());
        }
        let size = self.workgroup_size(name, args, span)?;
        self.builder.graph_mut().invocation = Invocation::Group(size);
        let mut add = |op: Op, ty: Type| self.builder.add(op, Vec::new(), ty);
        let [pixel, local, origin] = [Op::Pixel, Op::Thread, Op::GroupOrigin].map(|op| add(op, PAIR));
        let inside = add(Op::Inside, Type::BOOL);
        let [x, y] = [0, 1].map(|k| self.builder.add(Op::Extract(k), [local], Type::I32));
        let width = self.builder.i32(size[0] as i32);
        let row = self.builder.add(Op::Binary(BinaryOp::Mul), [y, width], Type::I32);
        let index = self.builder.add(Op::Binary(BinaryOp::Add), [row, x], Type::I32);
        for (id, called) in [
            (local, "local"),
            (origin, "origin"),
            (inside, "inside"),
            (index, "index"),
        ] {
            self.name_value(&Value::Node(id), called, span);
        }
        let index = self.convert_node(index, Scalar::Usize);
        let fields = [("local", local), ("index", index), ("pixel", pixel), ("inside", inside)];
        let fields = fields.map(|(name, id)| (name.into(), Value::Node(id)));
        let thread = Value::structure("Thread", fields.to_vec());
        let fields = vec![("origin".into(), Value::Node(origin)), ("thread".into(), thread)];
        Ok(Some(Value::structure(of.clone(), fields)))
    }

    fn workgroup_size(&mut self, name: &str, args: &[SourceType], span: Span) -> Eval<[u32; 2]> {
        let refused = |what: String| -> Exit {
            Diagnostic::error_at(Code::ResourceElement, span, what)
                .label("of this type")
                .help(format!(
                    "write `{name}: &Workgroup<16, 16>`: {MOST_THREADS} threads at most"
                ))
                .into()
        };
        let [width, height] = args else {
            return Err(refused(format!("`{name}` states no size")));
        };
        let mut sides = [0; 2];
        for (side, arg) in sides.iter_mut().zip([width, height]) {
            let value = match arg {
                SourceType::Const(value) => self.eval_expr(value)?,
                SourceType::Name(constant, args) if args.is_empty() => {
                    self.eval_path(std::slice::from_ref(constant), span)?
                }
                _ => return Err(refused(format!("`{name}` states no size"))),
            };
            *side = self.known_int(&value).unwrap_or(0);
        }
        match sides {
            [width, height] if width > 0 && height > 0 && width.saturating_mul(height) <= MOST_THREADS => {
                Ok([width as u32, height as u32])
            }
            [width, height] => Err(refused(format!("a workgroup of {width} by {height} threads"))),
        }
    }

    /// Adds a parameter that all threads of a workgroup share.
    pub(super) fn shared_parameter(&mut self, name: &str, of: &str, args: &[SourceType], span: Span) -> Eval {
        let atomic = of == "AtomicShared";
        let refused = |what: String| -> Exit {
            Diagnostic::error_at(Code::ResourceElement, span, what)
                .label("of this type")
                .help(match atomic {
                    true => "write `&AtomicShared<[u32; 256]>`: u32 or i32",
                    false => "write `&Shared<[Vec4; 64]>`: f32, i32, u32, or vectors of 2 or 4 of them",
                })
                .into()
        };
        let [SourceType::Array(element, Some(len))] = args else {
            return Err(refused(format!("`{name}` is no array of a length")));
        };
        let element = match &**element {
            SourceType::Name(of, _) => {
                value_named(of).filter(|ty| ty.component_count() != 3 && ty.scalar_kind() != Some(Scalar::Bool))
            }
            _ => None,
        };
        let element = element.filter(|ty| !atomic || matches!(*ty, Type::I32 | Type::U32));
        let Some(element) = element else {
            return Err(refused(format!("`{name}` has no elements that threads can share")));
        };
        let count = self.eval_expr(len)?;
        let count = self.known_int(&count).unwrap_or(0);
        let bytes = |len: i64| (len as u64).saturating_mul(4 * u64::from(element.component_count()));
        if count < 1 {
            return Err(refused(format!("`{name}` is an array without elements")));
        }
        let others = self.builder.graph().shared.iter();
        let others: u64 = others.map(SharedArray::byte_size).sum();
        if bytes(count).saturating_add(others) > MOST_SHARED_BYTES {
            let total = bytes(count).saturating_add(others);
            let what = format!("the workgroup shares {total} bytes, and devices promise {MOST_SHARED_BYTES}");
            return Err(Diagnostic::error_at(Code::ResourceElement, span, what)
                .label("with these")
                .help("share fewer elements, or vectors of fewer components")
                .into());
        }
        let name = &*self.input_name(name);
        let shared = &mut self.builder.graph_mut().shared;
        shared.push(SharedArray {
            name: name.to_owned(),
            element,
            len: count as u32,
            atomic,
            filled: false,
        });
        Ok(Value::Shared(shared.len() as u32 - 1))
    }

    /// Evaluates `group.each(f)`: each thread runs `f` after all threads have finished the code before.
    pub(super) fn eval_phase(&mut self, function: &Function, args: Vec<Value>, span: Span) -> Eval {
        if self.control.in_phase {
            return Err(
                Diagnostic::error_at(Code::WorkgroupPhase, span, "a phase inside a phase")
                    .label("each thread would run all of them")
                    .help("end the `each` around it first")
                    .into(),
            );
        }
        if args.get(1).is_some_and(Value::changes_variables) {
            return Err(Diagnostic::error_at(Code::WorkgroupPhase, span, "a phase that changes variables")
                .label("all threads would change them")
                .help("give the value from the phase, and take it in a later one by `of(thread)`; what threads tell each other lies in a `&Shared`")
                .into());
        }
        if let Some(buffers) = self.needs_barrier() {
            self.builder
                .add_effect(Op::Barrier { buffers }, Vec::new(), Type::Results);
        }
        self.control.in_phase = true;
        let result = self.inline_known(Self::PHASE, function, &[], args, span);
        self.control.in_phase = false;
        result
    }

    /// Determines whether memory was accessed since the last barrier; `None` if not. Otherwise returns whether that
    /// includes buffers that are also read.
    fn needs_barrier(&self) -> Option<bool> {
        let graph = self.builder.graph();
        let atomics = graph.buffers.iter().any(|b| b.access == Access::Atomic);
        let mut found = None;
        for region in self.builder.open_regions().iter().rev() {
            for id in graph.region(*region).effects.iter().rev() {
                let buffers = match graph.node(*id).op {
                    Op::Barrier { .. } => return found,
                    Op::Atomic { memory, .. } => matches!(memory, Memory::Buffer(_)),
                    Op::Loop(_) | Op::If(..) => atomics,
                    _ => false,
                };
                found = Some(found.unwrap_or(false) || buffers);
            }
            // The end of the previous iteration comes before the start of this one.
            if !graph.region(*region).params.is_empty() {
                return Some(atomics);
            }
        }
        found
    }

    /// Evaluates a method of shared memory.
    pub(super) fn shared_memory(&mut self, index: u32, name: &str, args: &[Value], span: Span) -> Eval {
        let shared = self.builder.graph().shared[index as usize].clone();
        let effect = match (shared.atomic, name, args) {
            (_, "len", []) => return Ok(Value::Int(i64::from(shared.len))),
            (false, "load", [_]) => None,
            (false, "store", [_, _]) => Some(MemoryEffect::Store),
            (true, ..) => match atomic_named(name, args.len()) {
                Some(op) => Some(MemoryEffect::Atomic(op)),
                None => return Err(no_such_method(&shared, name, span)),
            },
            _ => return Err(no_such_method(&shared, name, span)),
        };
        if !matches!(self.builder.graph().invocation, Invocation::Group(_)) {
            return Err(Diagnostic::error_at(
                Code::WorkgroupPhase,
                span,
                format!("`{}` is shared by the threads of no workgroup", shared.name),
            )
            .label("not in this kernel")
            .help("take the workgroup instead of the pixel: `group: &Workgroup<16, 16>`")
            .into());
        }
        if !self.control.in_phase {
            return Err(Diagnostic::error_at(
                Code::WorkgroupPhase,
                span,
                format!("`{}` is used outside of the phases", shared.name),
            )
            .label("by which thread?")
            .help("put it into a `group.each(|thread| ...)`")
            .into());
        }
        match effect {
            Some(effect) => self.effect_on(Memory::Shared(index), effect, args, span),
            None => {
                let len = self.builder.i32(shared.len as i32);
                let at = self.held_index(&args[0], len, "", span)?;
                let reached = self.reach_condition();
                let load = Op::SharedLoad(index);
                Ok(Value::Node(self.builder.add_effect(
                    load,
                    vec![reached, at],
                    shared.element,
                )))
            }
        }
    }
}

fn no_such_method(shared: &SharedArray, name: &str, span: Span) -> Exit {
    let (ty, methods) = match shared.atomic {
        true => ("AtomicShared", super::effects::ATOMIC_METHODS),
        false => (
            "Shared",
            "`load` of an index, `store` of an index and a value, and `len`",
        ),
    };
    Diagnostic::error_at(
        Code::UnknownMethod,
        span,
        format!(
            "`{}` is of type `{ty}`, which has no method `{name}` with such arguments",
            shared.name
        ),
    )
    .label("not supported")
    .help(format!("it has {methods}"))
    .into()
}
