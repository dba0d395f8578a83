//! Loops left in the shader: the variables that they carry from one iteration to the next, and their exits.

use super::for_loops::LoopBody;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::eval::Evaluator;
use crate::eval::control::{EarlyExit, Side};
use crate::eval::shape::same_shape;
use crate::eval::value::{Eval, Exit, Jump, Value};
use crate::front::scan_effects;
use crate::ir::{Naming, NodeId, Op, Origin, RegionId, Type};
use std::sync::Arc;

impl Evaluator<'_> {
    /// Builds a loop of the graph that counts from `start` to `end` by one, both of type `i32` or `u32`. Variables
    /// that the body assigns are carried from one iteration to the next. `iteration` receives the counter.
    pub fn build_loop(
        &mut self,
        body: &LoopBody<'_>,
        bounds: (NodeId, NodeId),
        iteration: impl Fn(&mut Self, NodeId) -> Eval<()>,
        span: Span,
    ) -> Eval<()> {
        if !self.may_nest() {
            return Err(Diagnostic::error_at(
                Code::CannotStay,
                span,
                "loops and branches of the shader are nested more than 100 deep",
            )
            .label("this loop is left in the shader")
            .help("put the condition of inner loops into outer ones")
            .into());
        }
        self.loops.depth += 1;
        let outcome = self.eval_nested(|e| e.carry_widened(body, bounds, iteration, span));
        self.loops.depth -= 1;
        outcome
    }

    /// Carries a value of an enum with every variant that it may be in any iteration. Only the body shows these, so
    /// the body is evaluated again with the variants found so far until no new one appears.
    fn carry_widened(
        &mut self,
        body: &LoopBody<'_>,
        bounds: (NodeId, NodeId),
        iteration: impl Fn(&mut Self, NodeId) -> Eval<()>,
        span: Span,
    ) -> Eval<()> {
        let before = self.take_checkpoint();
        let mut wider = Vec::new();
        for _ in 0..MAX_WIDENED {
            for (slot, value) in wider {
                self.scope.set_value(slot, value);
            }
            wider = self.try_build_loop(body, bounds, &iteration, span)?;
            if wider.is_empty() {
                return Ok(());
            }
            let (slots, values): (Vec<usize>, Vec<Value>) = wider.into_iter().unzip();
            let values = self.return_with(before.clone(), values);
            wider = slots.into_iter().zip(values).collect();
        }
        Err(type_change_error("a variable", span))
    }

    /// Makes one attempt. Returns the variables that have to be carried in a wider form, with their initial values.
    fn try_build_loop(
        &mut self,
        body: &LoopBody<'_>,
        (start, end): (NodeId, NodeId),
        iteration: &impl Fn(&mut Self, NodeId) -> Eval<()>,
        span: Span,
    ) -> Eval<Vec<(usize, Value)>> {
        let carried = self.carried_slots(body);
        let mark = self.scope.enter();
        let mut initial = Vec::new();
        let mut types = vec![self.ty(start)];
        for slot in &carried {
            let value = self.scope.name_and_value(*slot).1.clone();
            let value = self.make_runtime_form(&value, span)?;
            value.flatten(&mut initial);
            self.scope.set_value(*slot, value);
        }
        types.extend(initial.iter().map(|id| self.ty(*id)));
        let settled = self.scope.clone();

        let region = self.builder.open_region(&types);
        self.loops
            .structured
            .push_loop(region, span, [&[start, end], &initial[..]].concat());
        let params = self.builder.graph().region(region).params.clone();
        let mut inner = params[1..].iter().copied();
        for slot in &carried {
            let (name, template) = self.scope.name_and_value(*slot);
            let name = name.to_owned();
            let value = template.clone().unflatten(&mut inner);
            self.name_params(&value, &name, span);
            self.scope.set_value(*slot, value);
        }
        if let Some((name, at)) = body.counter {
            self.name_params(&Value::Node(params[0]), name, at);
        }
        self.loops.tracker.record_iteration();
        let outcome = iteration(self, params[0]).map(|()| Value::unit());
        let departed = self.take_exits();
        let side = self.side_of(outcome, departed, mark, span);
        let mut results = Vec::new();
        let mut changed = None;
        let mut wider = Vec::new();
        for slot in &carried {
            let value = self.scope.name_and_value(*slot).1.clone();
            match self.make_runtime_form(&value, span) {
                // The loop assigns the variable first, so its value before the first iteration is undefined.
                Ok(value) if *settled.name_and_value(*slot).1 == Value::Unset && value != Value::Unset => {
                    wider.push((*slot, self.undef_like(&value)));
                }
                Ok(value) if same_shape(&value, settled.name_and_value(*slot).1) => value.flatten(&mut results),
                Ok(value) => match self.unify_values(settled.name_and_value(*slot).1, &value, span) {
                    // Either the new value is narrower than the carried one, or the carried value has to be widened.
                    Ok((first, value))
                        if same_shape(&first, settled.name_and_value(*slot).1) && same_shape(&first, &value) =>
                    {
                        value.flatten(&mut results);
                    }
                    Ok((first, _)) if !same_shape(&first, settled.name_and_value(*slot).1) => {
                        wider.push((*slot, first))
                    }
                    _ => changed = Some(type_change_error(settled.name_and_value(*slot).0, span)),
                },
                Err(error) => changed = Some(error),
            }
        }
        if !wider.is_empty() && changed.is_none() && side.is_ok() {
            self.builder.close_region(initial);
            return Ok(wider);
        }
        let same = results.iter().map(|id| self.ty(*id)).eq(types[1..].iter().copied());
        let count = initial.len();
        let mut exits = Vec::new();
        if let (true, Ok(side)) = (same && changed.is_none(), &side) {
            match self.exits_of_loop(region, body, side, &mut initial, &mut results, span) {
                Ok(ways) => exits = ways,
                Err(error) => changed = Some(error),
            }
        }
        self.builder
            .close_region(if same { results.clone() } else { initial.clone() });
        let side = side?;
        if let Some(error) = changed {
            return Err(error);
        }
        if !same {
            return Err(type_change_error("a variable", span));
        }

        let args = [vec![start, end], initial].concat();
        let node = self.builder.add(Op::Loop(region), args, Type::Results);
        let result = |e: &mut Self, (k, value): (usize, &NodeId)| {
            let ty = e.ty(*value);
            e.builder.add(Op::Result(k as u32), [node], ty)
        };
        let outs: Vec<NodeId> = results.iter().enumerate().map(|each| result(self, each)).collect();
        let (outs, mut left) = (outs[..count].to_vec(), outs[count..].iter().copied());
        let mut outs = outs.into_iter();
        for slot in &carried {
            let (name, template) = settled.name_and_value(*slot);
            let value = template.unflatten(&mut outs);
            self.name_value(&value, name, span);
            self.scope.set_value(*slot, value);
        }
        for way in exits {
            let Some(condition) = left.next() else { break };
            let way = match way {
                Jump::Return(value) => Jump::Return(value.unflatten(&mut left)),
                other => other,
            };
            let scope = self.in_state(&self.scope, &side.states, Some(&way));
            self.name_exit(condition, &way, span);
            let group = Some(region);
            self.control.push_exit(EarlyExit {
                condition,
                jump: way,
                scope,
                group,
            });
        }
        Ok(Vec::new())
    }

    /// Adds the stop condition of a loop left in the shader. An exit beyond the loop adds two kinds of loop results:
    /// a boolean that it was taken, and the value that it carries.
    fn exits_of_loop(
        &mut self,
        region: RegionId,
        body: &LoopBody<'_>,
        side: &Side,
        initial: &mut Vec<NodeId>,
        results: &mut Vec<NodeId>,
        span: Span,
    ) -> Eval<Vec<Jump>> {
        let never = self.builder.bool(false);
        let mut stop = self.builder.bool(side.value.is_none());
        let mut ways = Vec::new();
        for (way, flag) in &side.exits {
            stop = self.or(stop, *flag);
            if way.breaks_loop(body.label) && body.breaks_here {
                continue;
            }
            let mut leaves = vec![*flag];
            let way = match way {
                Jump::Return(value) => {
                    let value = self.make_runtime_form(value, span)?;
                    value.flatten(&mut leaves);
                    Jump::Return(value)
                }
                other => other.clone(),
            };
            let mut params = Vec::new();
            for leaf in leaves {
                let ty = self.ty(leaf);
                params.push(self.builder.add_param(region, ty));
                initial.push(if leaf == *flag { never } else { self.undef_node(ty) });
                results.push(leaf);
            }
            let mut params = params.into_iter();
            if let Some(flag) = params.next() {
                let way = match &way {
                    Jump::Return(value) => Jump::Return(value.unflatten(&mut params)),
                    other => other.clone(),
                };
                self.name_exit(flag, &way, span);
            }
            ways.push(way);
        }
        self.builder.set_stop(region, stop);
        Ok(ways)
    }

    /// Returns the positions of the variables that a body may write: those that it names, and the referents of
    /// mutable references in them.
    fn carried_slots(&self, body: &LoopBody<'_>) -> Vec<usize> {
        let effects = scan_effects(body.block, &self.library.mutating);
        let mut carried = body.written.clone();
        for slot in effects.assigned.iter().filter_map(|name| self.scope.find_slot(name)) {
            if !carried.contains(&slot) {
                carried.push(slot);
            }
        }
        for slot in effects.mentioned.iter().filter_map(|name| self.scope.find_slot(name)) {
            self.collect_ref_slots(self.scope.name_and_value(slot).1, &mut carried);
        }
        // The reference itself does not change.
        carried.retain(|slot| !matches!(self.scope.name_and_value(*slot).1, Value::Ref(_)));
        carried
    }

    /// Names a loop's parameters, which become variables in the emitted code.
    pub fn name_params(&mut self, value: &Value, name: &str, span: Span) {
        match value {
            Value::Node(id) => {
                let origin = Origin {
                    name: readable_name(name).into(),
                    naming: Naming::Let,
                    file: span.file,
                    line: span.line,
                    counters: Arc::clone(&self.loops.counters),
                };
                self.builder.set_origin(*id, &origin);
            }
            Value::Struct { fields, .. } => {
                for (field, value) in fields.iter() {
                    self.name_params(value, &format!("{name}_{field}"), span);
                }
            }
            Value::Tuple(parts) => self.name_params_each(parts, name, span),
            Value::Array(parts) => self.name_params_each(parts, name, span),
            Value::Table(table) => self.name_params(&table.element, name, span),
            Value::Enum(choice) => {
                let (tag, inside) = self.choice_names(choice, name);
                if let Some((id, name)) = tag {
                    self.name_params(&Value::Node(id), &name, span);
                }
                for (value, name) in inside {
                    self.name_params(&value, &name, span);
                }
            }
            _ => {}
        }
    }

    fn name_params_each(&mut self, parts: &[Value], name: &str, span: Span) {
        for (k, part) in parts.iter().enumerate() {
            self.name_params(part, &format!("{name}_{k}"), span);
        }
    }
}

/// Returns a variable's name; `value` if no kernel can use that name.
fn readable_name(name: &str) -> String {
    match name.strip_prefix('#') {
        Some(hidden) => format!("value{}", &hidden[hidden.find('_').unwrap_or(hidden.len())..]),
        None => name.to_owned(),
    }
}

/// Attempts after which a carried variable is assumed to widen without end.
const MAX_WIDENED: usize = 16;

fn type_change_error(name: &str, span: Span) -> Exit {
    Diagnostic::error_at(
        Code::CannotStay,
        span,
        format!("`{name}` changes its type, or what it stands for, in a loop that is left in the shader"),
    )
    .label("in this loop")
    .help("give it one type, or unroll the loop")
    .into()
}
