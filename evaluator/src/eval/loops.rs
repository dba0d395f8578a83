//! `for`, and what all loops have in common: a loop is left in the shader where that is asked for and can be done.

use super::Evaluator;
use super::demand::Why;
use super::departures::Tail;
use super::partial::Count;
use super::value::{Eval, Exit, Place, Step, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Block, ForLoop, Pattern};
use crate::ir::Counter;
use crate::policy::{Asked, Unroll};
use std::sync::Arc;

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
        let counter = counter_of(f);
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
                    let error = Diagnostic::at(
                        Code::CannotUnroll,
                        f.over.span,
                        "a loop whose bounds are runtime values cannot be unrolled",
                    )
                    .label("a runtime value")
                    .help("give the loop fixed bounds, or leave out that it is to be unrolled");
                    return Err(self.demand_of(&[&Value::Range(items)], error));
                }
                None => {
                    let course = self.course(&items, f.over.span)?;
                    let bounds = course.bounds();
                    let outcome = self.keep(&body, &Count::Range(course), asked.unroll, span);
                    return self.demanding(&bounds, outcome);
                }
            },
            Value::Array(elements) => elements.to_vec(),
            Value::Ref(_) => match self.elements_mut(&items, f.over.span)? {
                Value::Array(elements) => elements.to_vec(),
                _ => return Err(Exit::Noted),
            },
            Value::Table(_) => self.rows(&items, f.over.span)?,
            Value::Node(id) if self.ty(id).is_array() => self.rows(&items, f.over.span)?,
            Value::Poison => return Err(Exit::Noted),
            other => {
                return Err(Diagnostic::at(
                    Code::MismatchedTypes,
                    f.over.span,
                    format!("`for` cannot run over {}", other.describe()),
                )
                .label("not a range")
                .help("run over a range such as `0..n`, or over an array")
                .into());
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
            self.loops.because(span, why.reason);
            if asked.by_name {
                let error = refusal(wish, &why.error).note("what the loop assigns would be a runtime value after it");
                self.loops.defer(error);
            }
            return Ok(Granted::Unrolled(None));
        }
        let why = if let Some(why) = self.loops.given_up(span) {
            why
        } else {
            let before = self.checkpoint();
            self.kept.avoidable(span);
            match count(self).and_then(|count| self.keep(body, &count, asked.unroll, span)) {
                Err(exit) if self.exhausted => return Err(exit),
                // All have left for good, or loops around or before this one are to be unrolled.
                Err(exit @ Exit::Left(_)) => return Err(exit),
                Err(Exit::Demand(needs)) if needs.iter().all(|need| !need.loops.contains(&span)) => {
                    return Err(Exit::Demand(needs));
                }
                // A loop that cannot stay in the shader is unrolled; if that fails too, it says why.
                Err(exit) => {
                    let noted = self.return_to(before);
                    let why = match exit {
                        Exit::Demand(needs) => {
                            let own = needs.into_iter().find(|need| need.loops.contains(&span));
                            own.map(|need| self.why(need.error))
                        }
                        Exit::Error(error) => Some(told(*error)),
                        _ => noted.map(told),
                    };
                    let body = || told(Diagnostic::at(Code::CannotStay, wish.head, "its body has an error"));
                    let why = why.unwrap_or_else(body);
                    self.loops.refuse(span, &why);
                    why
                }
                Ok(unroll) => return Ok(Granted::Kept(unroll)),
            }
        };
        self.loops.because(span, why.reason);
        Ok(Granted::Unrolled(asked.by_name.then(|| refusal(wish, &why.error))))
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
                name: name.as_str().into(),
                value,
            }),
            _ => None,
        };
        let around = Arc::clone(&self.counters);
        if counter.is_some() {
            self.counters = around.iter().cloned().chain(counter).collect();
        }
        let outcome = self
            .bind(pattern, item, span)
            .and_then(|()| self.block_in(body.block, Tail::Iteration(body.label)));
        self.counters = around;
        self.scope.leave(mark);
        outcome
    }
}

/// What a loop goes by in policies: its counter, or the first of the names that it binds.
fn counter_of(f: &ForLoop) -> String {
    match &f.pattern {
        _ if f.bounded => "while".to_owned(),
        Pattern::Name(name, ..) => name.to_string(),
        _ => "_".to_owned(),
    }
}

/// An error that is itself the reason why a loop cannot be left in the shader.
fn told(error: Diagnostic) -> Why {
    let reason = match error.span {
        Some(span) => format!("{} (line {})", error.message, span.line),
        None => error.message.clone(),
    };
    Why { error, reason }
}

/// The error that a loop cannot be left in the shader as it was asked by name.
fn refusal(wish: &Wish, why: &Diagnostic) -> Diagnostic {
    let asked = match wish.asked.unroll {
        Unroll::Partial(factor) => format!("unroll({factor})"),
        other => format!("unroll({other})"),
    };
    let mut error = Diagnostic::at(
        Code::CannotStay,
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
