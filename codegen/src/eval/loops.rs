//! `for` and `while`.

use super::Evaluator;
use super::value::{Eval, Exit, Range, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::assigned;
use crate::front::tree::{Block, Expr, ForLoop, Pattern};
use crate::ir::{Counter, NodeId, Op, Origin, Type};
use crate::policy::Unroll;

impl Evaluator<'_> {
    pub fn for_(&mut self, f: &ForLoop, span: Span) -> Eval {
        let items = self.expr(&f.over)?;
        let function = self.calls.last().cloned().unwrap_or_default();
        let counter = match &f.pattern {
            Pattern::Name(name, ..) => name.as_str(),
            _ => "_",
        };
        let unroll = self.policy.of(&function, counter, f.unroll);
        let made = self.builder.graph().nodes.len();
        self.loops.enter(&function, counter, span, made);
        let outcome = self.run(f, items, unroll, span);
        let made = self.builder.graph().nodes.len();
        let became = *outcome.as_ref().unwrap_or(&Unroll::Full);
        self.loops.leave(became, made);
        outcome.map(|_| Value::unit())
    }

    /// Runs a loop as asked, or as it can be; gives what became of it.
    fn run(&mut self, f: &ForLoop, items: Value, unroll: Unroll, span: Span) -> Eval<Unroll> {
        let leaves = assigned(&f.body, &self.library.mutating).leaves;
        let elements = match items {
            Value::Range(range) => {
                let known = self.known_int(&range.start).zip(self.known_int(&range.end));
                let Some((start, end)) = known else {
                    if leaves {
                        return Err(Diagnostic::at(
                            f.over.span,
                            "a loop whose bounds are only known at run time cannot be left early",
                        )
                        .label("not known now")
                        .help("give the loop fixed bounds, or select what is computed in it")
                        .into());
                    }
                    return self.keep(f, &range, unroll, span);
                };
                let values = self.range_values(start, end, &range, f.over.span)?;
                // A loop of one round is its body.
                let worth = match unroll {
                    Unroll::Full => false,
                    Unroll::None => !values.is_empty(),
                    Unroll::Partial(n) => values.len() >= 2 * n as usize,
                };
                if worth && !leaves && !self.unroll_all && !self.unrolled.contains(&span) {
                    let before = self.checkpoint();
                    match self.keep(f, &range, unroll, span) {
                        // What cannot be a loop at run time is run now; if that fails too, it says why.
                        Err(Exit::Error(_) | Exit::Noted) => self.return_to(before),
                        other => {
                            self.loops.keep(span);
                            return other;
                        }
                    }
                }
                values
            }
            Value::Array(elements) => elements.to_vec(),
            Value::Ref(_) => match self.elements_mut(&items, f.over.span)? {
                Value::Array(elements) => elements.to_vec(),
                _ => return Err(Exit::Noted),
            },
            Value::Node(id) if self.ty(id).is_array() => {
                let Type::Array { len, .. } = self.ty(id) else {
                    unreachable!("just matched")
                };
                let mut elements = Vec::new();
                for k in 0..len {
                    elements.push(self.element(&items, &Value::Int(i64::from(k)), span)?);
                }
                elements
            }
            Value::Poison => return Err(Exit::Noted),
            other => {
                return Err(
                    Diagnostic::at(f.over.span, format!("`for` cannot run over {}", other.describe()))
                        .label("not a range")
                        .help("run over a range such as `0..n`, or over an array")
                        .into(),
                );
            }
        };
        self.unrolled(f, elements, span)?;
        Ok(Unroll::Full)
    }

    fn unrolled(&mut self, f: &ForLoop, items: Vec<Value>, span: Span) -> Eval<()> {
        let noted = self.errors.len();
        for item in items {
            self.step(span)?;
            self.loops.round();
            let outcome = self.round(&f.pattern, item, &f.body, span);
            if !again(outcome, f.label.as_deref())? {
                break;
            }
            // The next round would only find the same errors again.
            if self.errors.len() > noted {
                return Err(Exit::Noted);
            }
        }
        Ok(())
    }

    /// The body for one value of the counter.
    pub fn round(&mut self, pattern: &Pattern, item: Value, body: &Block, span: Span) -> Eval {
        let mark = self.scope.enter();
        let counter = match (pattern, self.known_int(&item)) {
            (Pattern::Name(name, ..), Some(value)) => Some(Counter {
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
        outcome
    }

    /// A loop of the graph that goes from `start` to `end` by one: variables that `body` assigns are carried from one
    /// round to the next. `body` is given the counter.
    pub fn kept(
        &mut self,
        f: &ForLoop,
        bounds: (NodeId, NodeId),
        body: impl FnOnce(&mut Self, NodeId) -> Eval<()>,
        span: Span,
    ) -> Eval<()> {
        let before = self.scope.clone();
        let outcome = self.carry(f, bounds, body, span);
        if outcome.is_err() {
            // Values made inside belong to no place outside.
            self.scope = before;
        }
        outcome
    }

    fn carry(
        &mut self,
        f: &ForLoop,
        (start, end): (NodeId, NodeId),
        body: impl FnOnce(&mut Self, NodeId) -> Eval<()>,
        span: Span,
    ) -> Eval<()> {
        let carried = self.carried(&f.body);
        let mut initial = Vec::new();
        let mut types = vec![Type::I32];
        for slot in &carried {
            let value = self.scope.at(*slot).1.clone();
            let value = self.settle(&value, span)?;
            Self::leaves(&value, &mut initial);
            self.scope.set(*slot, value);
        }
        types.extend(initial.iter().map(|id| self.ty(*id)));
        let settled = self.scope.clone();

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
        if let Pattern::Name(name, _, at) = &f.pattern {
            self.name_params(&Value::Node(params[0]), name, *at);
        }
        self.loops.round();
        let outcome = body(self, params[0]);
        let mut results = Vec::new();
        let mut changed = None;
        for slot in &carried {
            let value = self.scope.at(*slot).1.clone();
            match self.settle(&value, span) {
                Ok(value) if same_shape(&value, settled.at(*slot).1) => Self::leaves(&value, &mut results),
                Ok(_) => changed = Some(changes(settled.at(*slot).0, span)),
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
            return Err(changes("a variable", span));
        }

        let args = [vec![start, end], initial].concat();
        let node = self.builder.add(Op::Loop(region), args, Type::Results);
        let outs: Vec<NodeId> = (0..results.len())
            .map(|k| self.builder.add(Op::Result(k as u32), vec![node], types[k + 1]))
            .collect();
        let mut outs = outs.into_iter();
        for slot in &carried {
            let (name, template) = settled.at(*slot);
            let value = Self::with_leaves(template, &mut outs);
            self.name(&value, name, span);
            self.scope.set(*slot, value);
        }
        Ok(())
    }

    /// Positions of the variables that a body may write: those that it names, and those that mutable references in the
    /// variables that it mentions lead to.
    fn carried(&self, body: &Block) -> Vec<usize> {
        let effects = assigned(body, &self.library.mutating);
        let mut carried: Vec<usize> = effects
            .assigned
            .iter()
            .filter_map(|name| self.scope.slot(name))
            .collect();
        for slot in effects.mentioned.iter().filter_map(|name| self.scope.slot(name)) {
            self.targets(self.scope.at(slot).1, &mut carried);
        }
        // A reference itself stays what it is.
        carried.retain(|slot| !matches!(self.scope.at(*slot).1, Value::Ref(_)));
        carried
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

    pub fn while_(&mut self, condition: &Expr, body: &Block, label: Option<&str>, span: Span) -> Eval {
        let function = self.calls.last().cloned().unwrap_or_default();
        let made = self.builder.graph().nodes.len();
        self.loops.enter(&function, "while", span, made);
        let outcome = self.run_while(condition, body, label, span);
        let made = self.builder.graph().nodes.len();
        self.loops.leave(Unroll::Full, made);
        outcome
    }

    fn run_while(&mut self, condition: &Expr, body: &Block, label: Option<&str>, span: Span) -> Eval {
        let noted = self.errors.len();
        loop {
            self.step(span)?;
            let value = self.value(condition)?;
            let id = self.node(&value, condition.span)?;
            match self.known_bool(id) {
                Some(true) => {}
                Some(false) => return Ok(Value::unit()),
                None => {
                    return Err(
                        Diagnostic::at(condition.span, "the condition of `while` is only known at run time")
                            .label("not known now")
                            .note("how often a shader goes round must not hang on what it computes: a GPU would wait for its slowest pixel")
                            .help("use `for` with fixed bounds, and select what is computed in it")
                            .into(),
                    );
                }
            }
            self.loops.round();
            let outcome = self.block(body);
            if !again(outcome, label)? {
                return Ok(Value::unit());
            }
            if self.errors.len() > noted {
                return Err(Exit::Noted);
            }
        }
    }
}

/// Whether a loop with this label goes on after a round that ended so.
fn again(outcome: Eval, label: Option<&str>) -> Eval<bool> {
    let mine = |of: &Option<String>| of.is_none() || of.as_deref() == label;
    match outcome {
        Ok(_) => Ok(true),
        Err(Exit::Continue(of)) if mine(&of) => Ok(true),
        Err(Exit::Break(of)) if mine(&of) => Ok(false),
        Err(other) => Err(other),
    }
}

fn changes(name: &str, span: Span) -> Exit {
    Diagnostic::at(span, format!("`{name}` changes its type in a loop that is kept"))
        .label("in this loop")
        .help("give it one type, or unroll the loop")
        .into()
}

/// Whether two settled values differ in their nodes alone.
fn same_shape(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Node(_), Value::Node(_)) => true,
        (
            Value::Struct { ty, fields },
            Value::Struct {
                ty: other,
                fields: others,
            },
        ) => {
            ty == other
                && fields
                    .iter()
                    .zip(others.iter())
                    .all(|((_, a), (_, b))| same_shape(a, b))
        }
        (Value::Tuple(a), Value::Tuple(b)) => all_same(a, b),
        (Value::Array(a), Value::Array(b)) => all_same(a, b),
        _ => a == b,
    }
}

fn all_same(a: &[Value], b: &[Value]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same_shape(a, b))
}

/// Values of a counter after which a loop is taken to be a mistake.
const MAX_ROUNDS: i64 = 1_000_000;

impl Evaluator<'_> {
    /// The values of a range with known ends, in the order of the loop, of the type of its ends.
    fn range_values(&mut self, start: i64, end: i64, range: &Range, span: Span) -> Eval<Vec<Value>> {
        let rounds = end.saturating_sub(start).max(0) / range.step.max(1);
        if rounds > MAX_ROUNDS {
            return Err(Diagnostic::at(span, format!("a loop of {rounds} rounds"))
                .label("too many")
                .help(format!("a loop may have up to {MAX_ROUNDS}"))
                .into());
        }
        let ty = match (&*range.start, &*range.end) {
            (Value::Node(start), Value::Node(_)) => Some(self.ty(*start)),
            _ => None,
        };
        let mut values: Vec<Value> = (start..end)
            .step_by(range.step.max(1) as usize)
            .map(|n| match ty {
                Some(ty) => Value::Node(self.builder.constant(ty, [n as u32, 0, 0, 0])),
                None => Value::Int(n),
            })
            .collect();
        if range.reversed {
            values.reverse();
        }
        Ok(values)
    }
}
