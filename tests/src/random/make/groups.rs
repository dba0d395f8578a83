//! Kernels of workgroups: phases, what threads share, and values that each of them keeps. No thread reads what another one
//! writes in the same phase: in each phase a memory is read by all, or written by each thread in a place of its own.

use super::types::Ty;
use super::{Feature, Maker};

/// Memory that the threads of a workgroup share.
#[derive(Clone, Debug)]
pub struct Memory {
    name: String,
    ty: Ty,
    len: usize,
    atomic: bool,
    /// Use of the memory in the phase that is being made.
    role: Role,
}

/// Use of a memory in a phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// Every thread reads any element.
    Read,
    /// Every thread writes and reads the element of its own number.
    Own,
    /// Of atomics: every thread changes any element, all in one way, and looks at none.
    Changed(&'static str),
}

/// A value that each thread has.
#[derive(Clone, Debug)]
pub struct Kept {
    name: String,
    ty: Ty,
}

/// Operations whose order shows in nothing.
const UNORDERED: &[&str] = &["add", "min", "max", "and", "or", "xor"];

impl Maker {
    /// Declares what threads share, as parameters of the kernel.
    pub(super) fn memories(&mut self) -> Vec<String> {
        let Some([width, height]) = self.shape.group else {
            return Vec::new();
        };
        let threads = width * height;
        let mut stated = Vec::new();
        for k in 0..1 + self.random.below(3) {
            let atomic = self.random.once_in(3);
            let ty = match atomic {
                true => self.random.pick(&[Ty::U32, Ty::I32]),
                false => self.shared_type(),
            };
            let len = match atomic {
                true => 1 + self.random.below(2 * threads),
                false => threads + self.random.below(threads),
            };
            let name = format!("h{}", ["a", "b", "c"][k]);
            let of = if atomic { "AtomicShared" } else { "Shared" };
            stated.push(format!("{name}: &{of}<[{}; {len}]>", self.ty(&ty)));
            self.memories.push(Memory {
                name,
                ty,
                len,
                atomic,
                role: Role::Read,
            });
        }
        stated
    }

    /// Type of the elements of workgroup memory.
    fn shared_type(&mut self) -> Ty {
        loop {
            let ty = self.plain_type();
            if !matches!(ty, Ty::Vec(_, 3)) {
                return ty;
            }
        }
    }

    /// The body of a kernel of workgroups: statements that all threads run alike, and phases.
    pub(super) fn phases(&mut self) {
        for (name, ty) in [("p", Ty::I32), ("q", Ty::U32), ("r", Ty::F32)] {
            let local = self.name();
            self.line(format!("let {local} = {name};"));
            self.bind(&local, &ty, false);
        }
        let origin = self.fresh("v");
        self.line(format!("let {origin} = group.origin();"));
        self.bind(&origin, &Ty::Vec(super::Lane::I, 2), false);
        for _ in 0..2 + self.random.below(3) {
            match self.random.below(6) {
                0 => self.phases_in_loop(),
                1 => self.phase_under_condition(),
                2 => self.statement(),
                3 => self.phase(None),
                _ => {
                    let ty = self.plain_type();
                    self.phase(Some(&ty));
                }
            }
        }
        let result = self.shape.result.clone();
        self.budget += 120;
        self.phase_of(Some(&result), true);
    }

    /// A loop that all threads go through together.
    fn phases_in_loop(&mut self) {
        let name = self.fresh("k");
        let (head, words): (String, &[&str]) = match self.random.below(4) {
            0 => (format!("for {name} in 0..p.clamp(0, 3)"), &["unroll(none)"]),
            1 => (format!("for {name} in (1..=q as i32 & 3).rev()"), &["unroll(none)"]),
            _ => (
                format!("for {name} in 0..{}", self.random.between(1, 3)),
                &["unroll(none)", "unroll(full)", "unroll(2)"],
            ),
        };
        if self.chance(Feature::Attributes, 4) {
            let word = self.random.pick(words);
            self.line(format!("#[cfg_attr(false, {word})]"));
        }
        let (mark, repeats) = (self.locals.len(), self.repeats);
        self.repeats *= 3;
        self.open(format!("{head} {{"));
        self.bind(&name, &Ty::I32, false);
        self.last().counter = true;
        for _ in 0..1 + self.random.below(2) {
            self.phase(None);
        }
        if self.random.once_in(3) {
            let want = self.wish(1);
            let condition = self.condition(want);
            self.open(format!("if {condition} {{"));
            self.line("break;");
            self.close("}");
            self.phase(None);
        }
        self.close("}");
        self.unknown_after(true);
        self.locals.truncate(mark);
        self.repeats = repeats;
    }

    /// A condition that is the same for all threads.
    fn phase_under_condition(&mut self) {
        let want = self.wish(1);
        let condition = self.condition(want);
        self.open(format!("if {condition} {{"));
        self.phase(None);
        if self.random.once_in(2) {
            self.close("} else {");
            self.indent += 1;
            self.phase(None);
        }
        self.close("}");
    }

    fn phase(&mut self, result: Option<&Ty>) {
        self.phase_of(result, false);
    }

    /// Work of each thread in a phase: a statement whose values are kept, or the last expression of the kernel.
    fn phase_of(&mut self, result: Option<&Ty>, last: bool) {
        for k in 0..self.memories.len() {
            let operation = self.random.pick(UNORDERED);
            let owned = self.memories[k].len >= self.threads();
            self.memories[k].role = match self.random.below(3) {
                0 => Role::Read,
                _ if !self.memories[k].atomic => Role::Own,
                1 if owned => Role::Own,
                _ => Role::Changed(operation),
            };
        }
        let unit = Ty::Tuple(Vec::new());
        let ty = result.cloned().unwrap_or(unit.clone());
        let arrow = if ty == unit {
            String::new()
        } else {
            format!(" -> {}", self.ty(&ty))
        };
        let kept = (!last && ty != unit).then(|| self.fresh("w"));
        let start = kept.as_ref().map_or(String::new(), |name| format!("let {name} = "));
        self.open(format!("{start}group.each(|thread|{arrow} {{"));
        // All that stands around is read, and nothing is changed.
        let around = self.locals.clone();
        for local in &mut self.locals {
            local.mutable = false;
        }
        let (loops, dynamic) = (std::mem::take(&mut self.loops), self.dynamic);
        let before = (
            self.result.replace(ty.clone()),
            std::mem::replace(&mut self.inputs, true),
        );
        self.thread();
        for _ in 0..1 + self.random.below(3) {
            match self.random.below(3) {
                0 => self.statement(),
                _ => self.change_memory(),
            }
        }
        // A kernel that gives nothing writes something.
        if last && ty == unit {
            self.write();
        }
        if ty != unit {
            let want = self.wish(2).inferred(true);
            let value = if last { self.given(&ty) } else { self.expr(&ty, want) };
            self.line(value);
        }
        (self.result, self.inputs) = before;
        (self.loops, self.dynamic) = (loops, dynamic);
        self.locals = around;
        let end = if last && ty != unit { "})" } else { "});" };
        self.close(end);
        if let Some(name) = kept {
            self.kept.push(Kept { name, ty });
        }
    }

    fn threads(&self) -> usize {
        self.shape.group.map_or(0, |[width, height]| width * height)
    }

    /// Variables of a thread: its position, and the values that it has kept.
    fn thread(&mut self) {
        self.line("let pixel = thread.pixel;");
        let (index, local) = (self.fresh("v"), self.fresh("v"));
        self.line(format!("let {index} = thread.index;"));
        self.bind(&index, &Ty::Usize, false);
        self.last().range = Some((0, self.threads() as i64 - 1));
        if self.random.once_in(2) {
            self.line(format!("let {local} = thread.local;"));
            self.bind(&local, &Ty::Vec(super::Lane::I, 2), false);
        }
        if self.random.once_in(3) {
            let inside = self.fresh("v");
            self.line(format!("let {inside} = thread.inside;"));
            self.bind(&inside, &Ty::Bool, false);
        }
        for kept in self.kept.clone() {
            if self.random.below(3) > 0 {
                let name = self.fresh("v");
                let mutable = self.random.once_in(2);
                let sign = if mutable { "mut " } else { "" };
                self.line(format!("let {sign}{name} = {}.of(thread);", kept.name));
                self.bind(&name, &kept.ty, mutable);
            }
        }
        for memory in self.memories.clone() {
            if self.random.once_in(2)
                && let Some(value) = self.memory_read(&memory.ty)
            {
                let name = self.fresh("v");
                self.line(format!("let mut {name} = {value};"));
                self.bind(&name, &memory.ty, true);
            }
        }
        let acc = self.fresh("v");
        self.line(format!("let mut {acc} = 0.5f32;"));
        self.bind(&acc, &Ty::F32, true);
    }

    /// Changes what is shared, as the phase does, or what all pixels share.
    fn change_memory(&mut self) {
        let changed: Vec<Memory> = self.memories.iter().filter(|m| m.role != Role::Read).cloned().collect();
        if changed.is_empty() {
            return if self.writes() { self.write() } else { self.assign() };
        }
        let memory = self.random.pick(&changed);
        let want = self.wish(2).inferred(true);
        let value = self.expr(&memory.ty, want);
        let Memory { name, len, .. } = &memory;
        let condition = match self.random.below(4) {
            0 => "if thread.inside { ".to_owned(),
            1 => {
                let want = self.wish(1);
                format!("if {} {{ ", self.condition(want))
            }
            _ => String::new(),
        };
        let end = if condition.is_empty() { "" } else { " }" };
        let own = match self.random.once_in(8) {
            // Outside: nothing happens.
            true => format!("thread.index + {len}"),
            false => "thread.index".to_owned(),
        };
        let change = match memory.role {
            Role::Changed(operation) => {
                let index = self.index(len + 1, false, 1);
                format!("{name}.{operation}({index}, {value});")
            }
            _ if memory.atomic => {
                let operation = self.random.pick(UNORDERED);
                format!("{name}.{operation}({own}, {value});")
            }
            _ => format!("{name}.store({own}, {value});"),
        };
        self.line(format!("{condition}{change}{end}"));
    }

    /// An element of what is shared that this phase may read.
    pub(super) fn memory_read(&mut self, ty: &Ty) -> Option<String> {
        if !self.inputs || self.reading {
            return None;
        }
        let read = |m: &&Memory| m.ty == *ty && !matches!(m.role, Role::Changed(_));
        let fit: Vec<Memory> = self.memories.iter().filter(read).cloned().collect();
        if fit.is_empty() {
            return None;
        }
        let memory = self.random.pick(&fit);
        let Memory { name, len, role, .. } = &memory;
        if *role == Role::Own {
            return Some(format!("{name}.load(thread.index)"));
        }
        if self.random.once_in(4) {
            return Some(format!("{name}.load({name}.len() - 1)"));
        }
        self.reading = true;
        let index = match memory.atomic {
            // Beyond the end atomics give 0, other memory its last element.
            true => self.index(len + 1, false, 1),
            false => self.index(len + 2, false, 1),
        };
        self.reading = false;
        Some(format!("{name}.load({index})"))
    }
}
