//! `while` and `loop`.

use super::Evaluator;
use super::departures::Tail;
use super::loops::{Body, Granted, Wish};
use super::partial::Count;
use super::scope::Scope;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Block, Expr, ExprKind, Statement};
use crate::front::{assigned, breaks, children, guarded};
use crate::ir::NodeId;
use crate::policy::{Asked, Unroll};
use std::collections::BTreeSet;

/// Iterations of a `while`, if they are known, and by slot the constants that variables are after them.
type Counted = (Option<u64>, Vec<(usize, Value)>);

/// Extent to which a `while` can be unrolled.
enum Rounds {
    /// To its end, or to where it is left for good.
    Ended(Eval),
    /// To nowhere: the end is a runtime value, which depends on these loops that are left in the shader.
    Open(BTreeSet<Span>),
}

impl Evaluator<'_> {
    pub fn while_(
        &mut self,
        condition: &Expr,
        block: &Block,
        label: Option<&str>,
        attribute: Option<Unroll>,
        span: Span,
    ) -> Eval {
        let function = self.calls.last().cloned().unwrap_or_default();
        let asked = self.policy.asked(&function, "while", attribute);
        let made = self.builder.graph().nodes.len();
        self.loops.enter(&function, "while", span, made);
        let outcome = self.run_while(condition, block, label, asked, span);
        let made = self.builder.graph().nodes.len();
        let became = match &outcome {
            Ok((unroll, _)) => *unroll,
            Err(_) => Unroll::Full,
        };
        self.loops.leave(became, made);
        let (_, ends) = outcome?;
        ends
    }

    /// Runs a `while` as asked, or as it can be. Where the iterations can be counted now, as the condition is known in each, a
    /// loop of so many is left in the shader; where they cannot, one that the body leaves.
    ///
    /// Gives what became of it, and how it ends.
    fn run_while(
        &mut self,
        condition: &Expr,
        block: &Block,
        label: Option<&str>,
        asked: Asked,
        span: Span,
    ) -> Eval<(Unroll, Eval)> {
        let body = Body {
            block,
            pattern: None,
            counter: None,
            label,
            written: Vec::new(),
            breaks_here: true,
        };
        let guarded = guarded(condition, block);
        let until = Body {
            block: &guarded,
            written: Vec::new(),
            ..body
        };
        let mut refused = None;
        if asked.unroll != Unroll::Full && !self.unrolls_all {
            let (iterations, after) = self.counted(condition, &body, span)?;
            let wish = Wish {
                asked,
                iterations: iterations.unwrap_or(u64::MAX),
                span,
                head: condition.span,
            };
            let granted = match iterations {
                Some(n) => self.attempt(&body, &wish, |_| Ok(Count::Times(n as u32)))?,
                None => self.attempt(&until, &wish, |_| Ok(Count::Unknown))?,
            };
            refused = match granted {
                Granted::Kept(unroll) => {
                    // What the loop makes of variables is known where it is known without the loop.
                    for (slot, value) in after {
                        if self.scope.at(slot).1 != &value {
                            self.scope.set(slot, value);
                        }
                    }
                    return Ok((unroll, self.behind(condition, block, label)));
                }
                Granted::Unrolled(refused) => refused,
            };
        }
        let before = self.checkpoint();
        let loops = match self.rounds(condition, &body, &mut 0, span)? {
            Rounds::Ended(outcome) => {
                return match refused {
                    Some(error) => Err(error.into()),
                    None => Ok((Unroll::Full, outcome.map(|_| Value::unit()))),
                };
            }
            Rounds::Open(loops) => loops,
        };
        self.return_to(before);
        let reason = "its end is a runtime value";
        if asked.by_name && asked.unroll == Unroll::Full {
            let error = Diagnostic::at(
                Code::CannotUnroll,
                condition.span,
                format!("this loop cannot be unrolled: {reason}"),
            )
            .label("its trip count is a runtime value")
            .help("leave out that it is to be unrolled, or bound it: `#[cfg_attr(false, bound(64))]`");
            return Err(self.demanded(loops, error));
        }
        self.kept.ends(span, loops.clone());
        self.keep(&until, &Count::Unknown, Unroll::None, span)
            .map_err(|exit| match exit {
                Exit::Error(error) => self.demanded(loops, *error),
                other => other,
            })?;
        self.loops.because(span, reason.to_owned());
        Ok((Unroll::None, self.behind(condition, block, label)))
    }

    /// What comes behind a loop that was left in the shader: nothing, if only `return` or an outer loop's `break` ends it.
    fn behind(&mut self, condition: &Expr, block: &Block, label: Option<&str>) -> Eval {
        let endless = matches!(condition.kind, ExprKind::Bool(true)) && !breaks(block, label);
        match endless.then(|| self.departed.pop()).flatten() {
            None => Ok(Value::unit()),
            Some(last) => {
                self.scope = last.scope;
                Err(Exit::Left(last.way))
            }
        }
    }

    /// How many iterations a `while` has, if that is known, and the constants that variables are after it.
    fn counted(&mut self, condition: &Expr, body: &Body<'_>, span: Span) -> Eval<Counted> {
        let test = Block {
            statements: vec![Statement::Expr(condition.clone())],
            value: None,
            exact: false,
        };
        let mutating = &self.library.mutating;
        let (test, effects) = (assigned(&test, mutating), assigned(body.block, mutating));
        let mut behind = Vec::new();
        for slot in test.mentioned.iter().filter_map(|name| self.scope.slot(name)) {
            self.targets(self.scope.at(slot).1, &mut behind);
        }
        let writes = !test.assigned.is_empty() || (!behind.is_empty() && has_calls(condition));
        if effects.leaves || test.leaves || writes {
            return Ok((None, Vec::new()));
        }
        let (before, initial) = (self.checkpoint(), self.scope.clone());
        let unrolls_all = std::mem::replace(&mut self.unrolls_all, true);
        let mut rounds = 0;
        let made = self.builder.graph().nodes.len();
        let most_nodes = self.most_nodes;
        self.most_nodes = most_nodes.min(made + MAX_COUNTED);
        let counted = self.rounds(condition, body, &mut rounds, span);
        self.unrolls_all = unrolls_all;
        let too_many = self.exhausted && self.builder.graph().nodes.len() > self.most_nodes;
        self.most_nodes = most_nodes;
        if too_many && self.builder.graph().nodes.len() <= most_nodes {
            self.exhausted = false;
            self.return_to(before);
            return Ok((None, Vec::new()));
        }
        let noted = self.errors.len() > before.errors();
        let ended = matches!(counted?, Rounds::Ended(_));
        if noted {
            return Err(Exit::Noted);
        }
        let mut after = Vec::new();
        if ended {
            let values = (0..self.scope.len()).map(|slot| (slot, self.scope.at(slot).1.clone()));
            let changed = values.filter(|(slot, value)| initial.at(*slot).1 != value);
            after = changed.filter(|(_, value)| self.is_known(value)).collect();
        }
        let (slots, values): (Vec<usize>, Vec<Value>) = after.into_iter().unzip();
        let values = self.return_with(before, values);
        Ok((ended.then_some(rounds), slots.into_iter().zip(values).collect()))
    }

    /// Whether all numbers in a value are known.
    fn is_known(&self, value: &Value) -> bool {
        let mut leaves = Vec::new();
        value.flatten(&mut leaves);
        value.is_plain() && leaves.iter().all(|id| self.builder.graph().constant(*id).is_some())
    }

    /// Unrolls a `while`, as far as its end is a compile-time constant. Counts its iterations.
    fn rounds(&mut self, condition: &Expr, body: &Body<'_>, rounds: &mut u64, span: Span) -> Eval<Rounds> {
        let (mark, since) = (self.scope.enter(), self.departed.len());
        let noted = self.errors.len();
        let mut outcome = Ok(Value::unit());
        let limit = self.loops.guesses(span);
        let mut before: Option<Scope> = None;
        loop {
            self.step(span)?;
            let id = self.condition(condition)?;
            match self.known_bool(id) {
                Some(true) => {}
                Some(false) => break,
                None => return Ok(self.open_end(&[id])),
            }
            if self.departed.len() > since {
                // With nothing new known the next iteration is decided as the last one was, and so are all that follow.
                let repeats = before.as_ref().is_some_and(|before| self.as_known(before, &self.scope));
                if repeats || *rounds >= limit {
                    if !repeats {
                        self.loops.guessed(span);
                    }
                    let conditions: Vec<NodeId> = self.departed[since..].iter().map(|d| d.condition).collect();
                    return Ok(self.open_end(&conditions));
                }
                before = Some(self.scope.clone());
            }
            *rounds += 1;
            outcome = self.unless_departed(since, Tail::Open, span, |e| {
                e.loops.round();
                e.body(body, Value::unit(), span).map(|()| Value::unit())
            });
            if outcome.is_err() {
                break;
            }
            if self.errors.len() > noted {
                return Err(Exit::Noted);
            }
        }
        let arrived = self.arrive(since, outcome, mark, &|way| way.breaks(body.label), span);
        match arrived {
            Err(exit) if exit.is_failure() => Err(exit),
            other => Ok(Rounds::Ended(other)),
        }
    }

    /// The end of a `while` that conditions decide at run time.
    fn open_end(&self, conditions: &[NodeId]) -> Rounds {
        Rounds::Open(self.kept.behind(self.builder.graph(), conditions))
    }
}

/// Nodes that are made to count the iterations of a loop, after which its end is left to the shader.
const MAX_COUNTED: usize = 50_000;

/// Whether an expression may call what writes through a reference that it is given.
fn has_calls(e: &Expr) -> bool {
    matches!(e.kind, ExprKind::Call(..) | ExprKind::Method(..) | ExprKind::Block(_))
        || children(e).into_iter().any(has_calls)
}
