//! `for`, and what all loops have in common: a loop is left in the shader where that is asked for and can be done.

use super::Evaluator;
use super::departures::{Departure, Side, Tail};
use super::partial::Count;
use super::value::{Eval, Exit, Place, Step, Value, Way};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::assigned;
use crate::front::tree::{Block, ForLoop, Pattern};
use crate::ir::{Counter, Naming, NodeId, Op, Origin, RegionId, Type};
use crate::policy::{Asked, Unroll};

/// What a loop does in each iteration.
pub struct Body<'a> {
    /// Its statements.
    pub block: &'a Block,
    /// What takes each value; `None` of a `while`.
    pub pattern: Option<&'a Pattern>,
    /// The name of its count in the shader, where the source has one.
    pub counter: Option<(&'a str, Span)>,
    /// Its label.
    pub label: Option<&'a str>,
    /// Positions of variables that it may write through what it runs over.
    pub written: Vec<usize>,
    /// Whether its `break` leads just behind the loop of the graph, and not further.
    pub breaks_here: bool,
}

/// A loop of which the number of iterations is known, and what is asked of it.
pub struct Wish {
    /// What is asked.
    pub asked: Asked,
    /// How often its body is evaluated.
    pub iterations: u64,
    /// The whole of it, by which it is known.
    pub span: Span,
    /// What an error points at.
    pub head: Span,
}

/// What became of a wish.
pub enum Granted {
    /// It is left in the shader.
    Kept(Unroll),
    /// It is to be unrolled. If it was asked for by name, the error that this is.
    Unrolled(Option<Diagnostic>),
}

impl Evaluator<'_> {
    pub fn for_(&mut self, f: &ForLoop, span: Span) -> Eval {
        let items = self.expr(&f.over)?;
        let function = self.calls.last().cloned().unwrap_or_default();
        let counter = counter_of(&f.pattern);
        let asked = self.policy.asked(&function, &counter, f.unroll);
        let made = self.builder.graph().nodes.len();
        self.loops.enter(&function, &counter, span, made);
        let outcome = self.run(f, items, asked, span);
        let made = self.builder.graph().nodes.len();
        let became = *outcome.as_ref().unwrap_or(&Unroll::Full);
        self.loops.leave(became, made);
        outcome.map(|_| Value::unit())
    }

    /// Runs a loop as asked, or as it can be; gives what became of it.
    fn run(&mut self, f: &ForLoop, items: Value, asked: Asked, span: Span) -> Eval<Unroll> {
        let counter = match (&f.pattern, &items) {
            (Pattern::Name(name, _, at), Value::Range(_)) => Some((name.as_str(), *at)),
            _ => None,
        };
        let mut body = Body {
            block: &f.body,
            pattern: Some(&f.pattern),
            counter,
            label: f.label.as_deref(),
            written: Vec::new(),
            breaks_here: true,
        };
        let mut range = None;
        let values = match items {
            Value::Range(items) => match self.range_values(&items, f.over.span)? {
                Some(values) => {
                    range = Some(items);
                    values
                }
                None if asked.by_name && asked.unroll == Unroll::Full => {
                    return Err(Diagnostic::at(
                        f.over.span,
                        "a loop whose bounds are runtime values cannot be unrolled",
                    )
                    .label("a runtime value")
                    .help("give the loop fixed bounds, or leave out that it is to be unrolled")
                    .into());
                }
                None => {
                    let course = self.course(&items, f.over.span)?;
                    return self.keep(&body, &Count::Range(course), asked.unroll, span);
                }
            },
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
        values.iter().for_each(|value| self.targets(value, &mut body.written));
        let wish = Wish {
            asked,
            iterations: values.len() as u64,
            span,
            head: f.over.span,
        };
        let count = |e: &mut Self| match &range {
            Some(range) => e.course(range, f.over.span).map(Count::Range),
            None => match array_behind(&values) {
                Some(array) => Ok(Count::Places(array, values.len() as u32)),
                None => e.by_columns(&values, f.over.span).map(Count::Elements),
            },
        };
        let refused = match self.attempt(&body, &wish, count)? {
            Granted::Kept(unroll) => return Ok(unroll),
            Granted::Unrolled(refused) => refused,
        };
        self.unrolled(&body, values, span)?;
        refused.map_or(Ok(Unroll::Full), |error| Err(error.into()))
    }

    /// Leaves a loop in the shader if that is asked for and can be done.
    pub fn attempt(
        &mut self,
        body: &Body<'_>,
        wish: &Wish,
        count: impl FnOnce(&mut Self) -> Eval<Count>,
    ) -> Eval<Granted> {
        let Wish { asked, span, .. } = *wish;
        let least = match asked.unroll {
            Unroll::Full => return Ok(Granted::Unrolled(None)),
            _ if self.unrolls_all => return Ok(Granted::Unrolled(None)),
            Unroll::None => 1,
            Unroll::Partial(factor) => 2 * u64::from(factor),
        };
        if wish.iterations < least {
            let reason = match wish.iterations {
                0 => "it has no iterations".to_owned(),
                1 => "it has 1 iteration".to_owned(),
                n => format!("it has {n} iterations, fewer than {least}"),
            };
            self.loops.because(span, reason);
            return Ok(Granted::Unrolled(None));
        }
        if let Some(needed) = self.unrolled.get(&span) {
            let why = needed.clone();
            let reason = format!(
                "what follows it needs a compile-time constant that it assigns: {}",
                told(&why)
            );
            self.loops.because(span, reason);
            if asked.by_name {
                let error = refusal(wish, &why).note("what the loop assigns would be a runtime value after it");
                self.loops.defer(error);
            }
            return Ok(Granted::Unrolled(None));
        }
        let why = if let Some(why) = self.loops.given_up(span) {
            why
        } else {
            let before = self.checkpoint();
            match count(self).and_then(|count| self.keep(body, &count, asked.unroll, span)) {
                // What cannot be a loop in the shader is unrolled; if that fails too, it says why.
                Err(exit @ (Exit::Error(_) | Exit::Noted)) => {
                    let noted = self.return_to(before);
                    let why = match exit {
                        Exit::Error(error) => Some(*error),
                        _ => noted,
                    };
                    let why = why.unwrap_or_else(|| Diagnostic::at(wish.head, "its body has an error"));
                    self.loops.refuse(span, &why);
                    why
                }
                // All have left, for good.
                Err(other) => {
                    self.loops.keep(span);
                    return Err(other);
                }
                Ok(unroll) => {
                    self.loops.keep(span);
                    return Ok(Granted::Kept(unroll));
                }
            }
        };
        self.loops.because(span, told(&why));
        Ok(Granted::Unrolled(asked.by_name.then(|| refusal(wish, &why))))
    }

    fn unrolled(&mut self, body: &Body<'_>, items: Vec<Value>, span: Span) -> Eval<()> {
        let (mark, since) = (self.scope.enter(), self.departed.len());
        let noted = self.errors.len();
        let mut outcome = Ok(Value::unit());
        for item in items {
            outcome = self.unless_departed(since, Tail::Open, span, |e| {
                e.loops.round();
                e.body(body, item, span).map(|()| Value::unit())
            });
            if outcome.is_err() {
                break;
            }
            // The next round would only find the same errors again.
            if self.errors.len() > noted {
                return Err(Exit::Noted);
            }
        }
        self.arrive(since, outcome, mark, &|way| way.breaks(body.label), span)?;
        Ok(())
    }

    /// The body for one value of what the loop runs over.
    pub fn body(&mut self, body: &Body<'_>, item: Value, span: Span) -> Eval<()> {
        self.step(span)?;
        let (mark, since) = (self.scope.enter(), self.departed.len());
        let outcome = match body.pattern {
            Some(pattern) => self.round(pattern, item, body, span),
            None => self.block_in(body.block, Tail::Iteration(body.label)),
        };
        self.arrive(
            since,
            outcome.map(|_| Value::unit()),
            mark,
            &|way| way.continues(body.label),
            span,
        )?;
        Ok(())
    }

    /// The body with a value of the counter bound.
    fn round(&mut self, pattern: &Pattern, item: Value, body: &Body<'_>, span: Span) -> Eval {
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
        let outcome = self
            .bind(pattern, item, span)
            .and_then(|()| self.block_in(body.block, Tail::Iteration(body.label)));
        if counted {
            self.counters.pop();
        }
        self.scope.leave(mark);
        outcome
    }

    /// A loop of the graph that goes from `start` to `end` by one, both of type `i32` or `u32`: variables that its body
    /// assigns are carried from one iteration to the next. `iteration` is given the counter.
    pub fn kept(
        &mut self,
        body: &Body<'_>,
        bounds: (NodeId, NodeId),
        iteration: impl FnOnce(&mut Self, NodeId) -> Eval<()>,
        span: Span,
    ) -> Eval<()> {
        let before = self.scope.clone();
        let pending = std::mem::take(&mut self.departed);
        self.kept_loops += 1;
        let outcome = self.carry(body, bounds, iteration, span);
        self.kept_loops -= 1;
        if outcome.is_err() {
            // Values made inside belong to no place outside.
            self.scope = before;
            self.departed.clear();
        }
        self.departed.splice(0..0, pending);
        outcome
    }

    fn carry(
        &mut self,
        body: &Body<'_>,
        (start, end): (NodeId, NodeId),
        iteration: impl FnOnce(&mut Self, NodeId) -> Eval<()>,
        span: Span,
    ) -> Eval<()> {
        let carried = self.carried(body);
        let mark = self.scope.enter();
        let mut initial = Vec::new();
        let mut types = vec![self.ty(start)];
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
        if let Some((name, at)) = body.counter {
            self.name_params(&Value::Node(params[0]), name, at);
        }
        self.loops.round();
        let outcome = iteration(self, params[0]).map(|()| Value::unit());
        let departed = std::mem::take(&mut self.departed);
        let side = self.flatten(outcome, departed, mark, span);
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
        side?;
        if let Some(error) = changed {
            return Err(error);
        }
        if !same {
            return Err(changes("a variable", span));
        }

        let args = [vec![start, end], initial].concat();
        let node = self.builder.add(Op::Loop(region), args, Type::Results);
        let result = |e: &mut Self, (k, value): (usize, &NodeId)| {
            let ty = e.ty(*value);
            e.builder.add(Op::Result(k as u32), vec![node], ty)
        };
        let outs: Vec<NodeId> = results.iter().enumerate().map(|each| result(self, each)).collect();
        let (outs, mut left) = (outs[..count].to_vec(), outs[count..].iter().copied());
        let mut outs = outs.into_iter();
        for slot in &carried {
            let (name, template) = settled.at(*slot);
            let value = Self::with_leaves(template, &mut outs);
            self.name(&value, name, span);
            self.scope.set(*slot, value);
        }
        for way in exits {
            let Some(condition) = left.next() else { break };
            let way = match way {
                Way::Return(value) => Way::Return(Self::with_leaves(&value, &mut left)),
                other => other,
            };
            let scope = self.scope.clone();
            self.name_exit(condition, &way, span);
            let group = Some(region);
            self.departed.push(Departure {
                condition,
                way,
                scope,
                group,
            });
        }
        Ok(())
    }

    /// Lets a loop that is left in the shader stop where its body leaves it. Who leaves what is around it too is told by
    /// further results of the loop, a boolean for each way, with the value that is taken along.
    fn exits_of_loop(
        &mut self,
        region: RegionId,
        body: &Body<'_>,
        side: &Side,
        initial: &mut Vec<NodeId>,
        results: &mut Vec<NodeId>,
        span: Span,
    ) -> Eval<Vec<Way>> {
        let never = self.builder.bool(false);
        let mut stop = self.builder.bool(side.value.is_none());
        let mut ways = Vec::new();
        for (way, flag) in &side.exits {
            stop = self.or(stop, *flag);
            if way.breaks(body.label) && body.breaks_here {
                continue;
            }
            let mut leaves = vec![*flag];
            let way = match way {
                Way::Return(value) => {
                    let value = self.settle(value, span)?;
                    Self::leaves(&value, &mut leaves);
                    Way::Return(value)
                }
                other => other.clone(),
            };
            let mut params = Vec::new();
            for leaf in leaves {
                let ty = self.ty(leaf);
                params.push(self.builder.add_param(region, ty));
                initial.push(if leaf == *flag { never } else { self.unused(ty) });
                results.push(leaf);
            }
            let mut params = params.into_iter();
            if let Some(flag) = params.next() {
                let way = match &way {
                    Way::Return(value) => Way::Return(Self::with_leaves(value, &mut params)),
                    other => other.clone(),
                };
                self.name_exit(flag, &way, span);
            }
            ways.push(way);
        }
        self.builder.set_stop(region, stop);
        Ok(ways)
    }

    /// Positions of the variables that a body may write: those that it names, and those that mutable references in the
    /// variables that it mentions lead to.
    fn carried(&self, body: &Body<'_>) -> Vec<usize> {
        let effects = assigned(body.block, &self.library.mutating);
        let mut carried = body.written.clone();
        for slot in effects.assigned.iter().filter_map(|name| self.scope.slot(name)) {
            if !carried.contains(&slot) {
                carried.push(slot);
            }
        }
        for slot in effects.mentioned.iter().filter_map(|name| self.scope.slot(name)) {
            self.targets(self.scope.at(slot).1, &mut carried);
        }
        // A reference itself stays what it is.
        carried.retain(|slot| !matches!(self.scope.at(*slot).1, Value::Ref(_)));
        carried
    }

    /// Names a loop's parameters, which are variables in the text.
    pub fn name_params(&mut self, value: &Value, name: &str, span: Span) {
        match value {
            Value::Node(id) => {
                let origin = Origin {
                    name: name.to_owned(),
                    naming: Naming::Let,
                    file: span.file,
                    line: span.line,
                    counters: self.counters.clone(),
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
            _ => {}
        }
    }

    fn name_params_each(&mut self, parts: &[Value], name: &str, span: Span) {
        for (k, part) in parts.iter().enumerate() {
            self.name_params(part, &format!("{name}_{k}"), span);
        }
    }
}

/// What a loop goes by in policies: its counter, or the first of the names that it binds.
fn counter_of(pattern: &Pattern) -> String {
    match pattern {
        Pattern::Name(name, ..) => name.clone(),
        _ => "_".to_owned(),
    }
}

/// Why a loop was unrolled, in one line.
fn told(why: &Diagnostic) -> String {
    match why.span {
        Some(span) => format!("{} (line {})", why.message, span.line),
        None => why.message.clone(),
    }
}

/// The error that a loop cannot be left in the shader as it was asked by name.
fn refusal(wish: &Wish, why: &Diagnostic) -> Diagnostic {
    let asked = match wish.asked.unroll {
        Unroll::Partial(factor) => format!("unroll({factor})"),
        other => format!("unroll({other})"),
    };
    let mut error = Diagnostic::at(
        wish.head,
        format!("this loop cannot be left in the shader: {}", why.message),
    )
    .label(format!("`{asked}` asks for it"))
    .help("leave it out, so that the loop is unrolled where it has to be");
    if let Some(at) = why.span.filter(|at| *at != wish.head) {
        let label = if why.label.is_empty() {
            "here"
        } else {
            why.label.as_str()
        };
        error = error.other(at, label);
    }
    error
}

/// The array of which the values are mutable references to all elements, first to last.
fn array_behind(values: &[Value]) -> Option<Place> {
    let mut array: Option<Place> = None;
    for (k, value) in values.iter().enumerate() {
        let Value::Ref(place) = value else { return None };
        let (last, path) = place.path.split_last()?;
        if *last != Step::Index(Value::Int(k as i64)) {
            return None;
        }
        let of = Place {
            path: path.to_vec(),
            ..(**place).clone()
        };
        if array.as_ref().is_some_and(|array| *array != of) {
            return None;
        }
        array = Some(of);
    }
    array
}

fn changes(name: &str, span: Span) -> Exit {
    Diagnostic::at(
        span,
        format!("`{name}` changes its type in a loop that is left in the shader"),
    )
    .label("in this loop")
    .help("give it one type, or unroll the loop")
    .into()
}

/// Whether two settled values differ in their nodes alone.
pub fn same_shape(a: &Value, b: &Value) -> bool {
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
