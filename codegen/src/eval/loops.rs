//! `for` and `while`.

use super::value::{Eval, Exit, Range, Value};
use super::{Evaluator, Unroll};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::assigned;
use crate::front::tree::{Block, Expr, Pattern};
use crate::ir::{BinaryOp, Counter, NodeId, Op, Origin, Type};

impl Evaluator<'_> {
    pub fn for_(&mut self, pattern: &Pattern, over: &Expr, body: &Block, span: Span) -> Eval {
        let items = self.expr(over)?;
        let effects = assigned(body);
        match items {
            Value::Range(range) => {
                let known = self.known_int(&range.start).zip(self.known_int(&range.end));
                match known {
                    Some((start, end)) if self.unroll == Unroll::Full || effects.leaves => {
                        self.unrolled(pattern, range_values(start, end, &range), body, span)
                    }
                    None if effects.leaves => Err(Diagnostic::at(
                        over.span,
                        "a loop whose bounds are only known at run time cannot be left early",
                    )
                    .label("not known now")
                    .help("give the loop fixed bounds, or select what is computed in it")
                    .into()),
                    _ => self.kept(pattern, &range, body, span),
                }
            }
            Value::Array(elements) => self.unrolled(pattern, elements, body, span),
            Value::Node(id) if self.ty(id).is_array() => {
                let Type::Array { len, .. } = self.ty(id) else {
                    unreachable!("just matched")
                };
                let mut elements = Vec::new();
                for k in 0..len {
                    elements.push(self.element(&items, &Value::Int(i64::from(k)), span)?);
                }
                self.unrolled(pattern, elements, body, span)
            }
            Value::Poison => Err(Exit::Noted),
            other => Err(
                Diagnostic::at(over.span, format!("`for` cannot run over {}", other.describe()))
                    .help("run over a range such as `0..n`, or over an array")
                    .into(),
            ),
        }
    }

    fn unrolled(&mut self, pattern: &Pattern, items: Vec<Value>, body: &Block, span: Span) -> Eval {
        let noted = self.errors.len();
        for item in items {
            self.step(span)?;
            let mark = self.scope.enter();
            let counter = match (pattern, self.known_int(&item)) {
                (Pattern::Name(name, _), Some(value)) => Some(Counter {
                    name: name.clone(),
                    value,
                }),
                _ => None,
            };
            let counted = counter.is_some();
            self.counters.extend(counter);
            let outcome = self.bind(pattern, item, span).and_then(|()| self.block(body));
            if counted {
                self.counters.pop();
            }
            self.scope.leave(mark);
            match outcome {
                Ok(_) | Err(Exit::Continue) => {}
                Err(Exit::Break) => break,
                Err(other) => return Err(other),
            }
            // The next round would only find the same errors again.
            if self.errors.len() > noted {
                return Err(Exit::Noted);
            }
        }
        Ok(Value::unit())
    }

    /// A loop of the graph: variables that the body assigns are carried from one iteration to the next.
    fn kept(&mut self, pattern: &Pattern, range: &Range, body: &Block, span: Span) -> Eval {
        let (start, end) = (self.index_node(&range.start, span)?, self.index_node(&range.end, span)?);
        let carried: Vec<usize> = assigned(body)
            .assigned
            .iter()
            .filter_map(|name| self.scope.slot(name))
            .collect();
        let mut initial = Vec::new();
        let mut types = vec![Type::I32];
        for slot in &carried {
            let value = self.scope.at(*slot).1.clone();
            let value = self.settle(&value, span)?;
            Self::leaves(&value, &mut initial);
            self.scope.set(*slot, value);
        }
        types.extend(initial.iter().map(|id| self.ty(*id)));

        let region = self.builder.open_region(&types);
        let params = self.builder.graph().region(region).params.clone();
        let mut inner = params[1..].iter().copied();
        for slot in &carried {
            let (name, template) = self.scope.at(*slot);
            let name = name.to_owned();
            let value = Self::with_leaves(&template.clone(), &mut inner);
            self.name_params(&value, &name, span);
            self.scope.set(*slot, value);
        }
        if let Pattern::Name(name, at) = pattern {
            self.name_params(&Value::Node(params[0]), name, *at);
        }
        let (first, trips_end) = (start, self.trips(start, end, range));
        let counter = self.counter(params[0], first, range, end);
        let mark = self.scope.enter();
        let outcome = self
            .bind(pattern, Value::Node(counter), span)
            .and_then(|()| self.block(body));
        self.scope.leave(mark);

        let mut results = Vec::new();
        let mut changed = None;
        for slot in &carried {
            let value = self.scope.at(*slot).1.clone();
            match self.settle(&value, span) {
                Ok(value) => Self::leaves(&value, &mut results),
                Err(error) => changed = Some(error),
            }
        }
        let same = results.iter().map(|id| self.ty(*id)).eq(types[1..].iter().copied());
        self.builder
            .close_region(if same { results.clone() } else { initial.clone() });
        outcome?;
        if let Some(error) = changed {
            return Err(error);
        }
        if !same {
            return Err(
                Diagnostic::at(span, "a variable changes its type in a loop that is kept")
                    .help("give it one type, or unroll the loop")
                    .into(),
            );
        }

        let (loop_start, loop_end) = trips_end;
        let mut args = vec![loop_start, loop_end];
        args.extend(&initial);
        let node = self.builder.add(Op::Loop(region), args, Type::Results);
        let outs: Vec<NodeId> = (0..results.len())
            .map(|k| self.builder.add(Op::Result(k as u32), vec![node], types[k + 1]))
            .collect();
        let mut outs = outs.into_iter();
        for slot in &carried {
            let (name, template) = self.scope.at(*slot);
            let name = name.to_owned();
            let value = Self::with_leaves(&template.clone(), &mut outs);
            self.name(&value, &name, span);
            self.scope.set(*slot, value);
        }
        Ok(Value::unit())
    }

    /// Names a loop's parameters, which are variables in the text.
    fn name_params(&mut self, value: &Value, name: &str, span: Span) {
        let mut nodes = Vec::new();
        Self::leaves(value, &mut nodes);
        for id in nodes {
            let origin = Origin {
                name: name.to_owned(),
                file: span.file,
                line: span.line,
                counters: self.counters.clone(),
            };
            self.builder.set_origin(id, &origin);
        }
    }

    /// Bounds of the loop's own counter: the range itself if it goes up by one, else 0 to the number of values.
    fn trips(&mut self, start: NodeId, end: NodeId, range: &Range) -> (NodeId, NodeId) {
        if !range.reversed && range.step == 1 {
            return (start, end);
        }
        let zero = self.builder.i32(0);
        let mut length = self.builder.add(Op::Binary(BinaryOp::Sub), vec![end, start], Type::I32);
        if range.step != 1 {
            let up = self.builder.i32(range.step as i32 - 1);
            let step = self.builder.i32(range.step as i32);
            length = self.builder.add(Op::Binary(BinaryOp::Add), vec![length, up], Type::I32);
            length = self
                .builder
                .add(Op::Binary(BinaryOp::Div), vec![length, step], Type::I32);
        }
        (zero, length)
    }

    /// The source's counter from the loop's own.
    fn counter(&mut self, own: NodeId, start: NodeId, range: &Range, end: NodeId) -> NodeId {
        if !range.reversed && range.step == 1 {
            return own;
        }
        let step = self.builder.i32(range.step as i32);
        if range.reversed {
            // Of a, a+s, ..., the last comes first.
            let one = self.builder.i32(1);
            let (_, trips) = self.trips(start, end, range);
            let last = self.builder.add(Op::Binary(BinaryOp::Sub), vec![trips, one], Type::I32);
            let back = self.builder.add(Op::Binary(BinaryOp::Sub), vec![last, own], Type::I32);
            let far = self.builder.add(Op::Binary(BinaryOp::Mul), vec![back, step], Type::I32);
            return self.builder.add(Op::Binary(BinaryOp::Add), vec![start, far], Type::I32);
        }
        let far = self.builder.add(Op::Binary(BinaryOp::Mul), vec![own, step], Type::I32);
        self.builder.add(Op::Binary(BinaryOp::Add), vec![start, far], Type::I32)
    }

    pub fn while_(&mut self, condition: &Expr, body: &Block, span: Span) -> Eval {
        let noted = self.errors.len();
        loop {
            self.step(span)?;
            let value = self.expr(condition)?;
            let id = self.node(&value, condition.span)?;
            match self.known_bool(id) {
                Some(true) => {}
                Some(false) => return Ok(Value::unit()),
                None => {
                    return Err(
                        Diagnostic::at(condition.span, "the condition of `while` is only known at run time")
                            .label("not known now")
                            .help("use `for` with fixed bounds, and select what is computed in it")
                            .into(),
                    );
                }
            }
            match self.block(body) {
                Ok(_) | Err(Exit::Continue) => {}
                Err(Exit::Break) => return Ok(Value::unit()),
                Err(other) => return Err(other),
            }
            if self.errors.len() > noted {
                return Err(Exit::Noted);
            }
        }
    }
}

/// The values of a range with known ends, in the order of the loop.
fn range_values(start: i64, end: i64, range: &Range) -> Vec<Value> {
    let values = (start..end).step_by(range.step.max(1) as usize).map(Value::Int);
    if range.reversed {
        values.collect::<Vec<_>>().into_iter().rev().collect()
    } else {
        values.collect()
    }
}
