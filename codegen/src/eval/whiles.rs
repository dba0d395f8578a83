//! `while` and `loop`.

use super::Evaluator;
use super::loops::{Body, Granted, LEAVES, Wish, again};
use super::partial::Count;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::tree::{Block, Expr, ExprKind, Statement};
use crate::front::{assigned, children};
use crate::policy::{Asked, Unroll};

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
        let body = Body {
            block,
            pattern: None,
            counter: None,
            label,
            written: Vec::new(),
        };
        let outcome = self.run_while(condition, &body, asked, span);
        let made = self.builder.graph().nodes.len();
        let became = *outcome.as_ref().unwrap_or(&Unroll::Full);
        self.loops.leave(became, made);
        outcome.map(|_| Value::unit())
    }

    /// Runs a `while` as asked, or as it can be. To be left in the shader it is run once to count its iterations: as its
    /// condition is known in each, a loop of so many does the same.
    fn run_while(&mut self, condition: &Expr, body: &Body<'_>, asked: Asked, span: Span) -> Eval<Unroll> {
        let mut refused = None;
        if asked.unroll != Unroll::Full && !self.unrolls_all {
            let test = Block {
                statements: vec![Statement::Expr(condition.clone())],
                value: None,
            };
            let mutating = &self.library.mutating;
            let (test, effects) = (assigned(&test, mutating), assigned(body.block, mutating));
            let mut behind = Vec::new();
            for slot in test.mentioned.iter().filter_map(|name| self.scope.slot(name)) {
                self.targets(self.scope.at(slot).1, &mut behind);
            }
            let obstacle = if effects.leaves || test.leaves {
                Some(LEAVES)
            } else if !test.assigned.is_empty() || (!behind.is_empty() && has_calls(condition)) {
                Some("its condition assigns to variables")
            } else {
                None
            };
            let (mut iterations, mut after) = (u64::MAX, Vec::new());
            if obstacle.is_none() {
                let before = self.checkpoint();
                self.unrolls_all = true;
                let counted = self.unrolled_while(condition, body, span);
                self.unrolls_all = false;
                let noted = self.errors.len() > before.errors();
                iterations = counted?;
                if noted {
                    return Err(Exit::Noted);
                }
                after = (0..self.scope.len())
                    .map(|slot| self.scope.at(slot).1.clone())
                    .collect();
                self.return_to(before);
            }
            let wish = Wish {
                asked,
                iterations,
                obstacle,
                span,
                head: condition.span,
            };
            let count = |_: &mut Self| Ok(Count::Times(iterations as u32));
            refused = match self.attempt(body, &wish, count)? {
                Granted::Kept(unroll) => {
                    // What the loop makes of variables is known where it is known without the loop.
                    for (slot, value) in after.into_iter().enumerate() {
                        if self.scope.at(slot).1 != &value && self.is_known(&value) {
                            self.scope.set(slot, value);
                        }
                    }
                    return Ok(unroll);
                }
                Granted::Unrolled(refused) => refused,
            };
        }
        self.unrolled_while(condition, body, span)?;
        refused.map_or(Ok(Unroll::Full), |error| Err(error.into()))
    }

    /// Whether all numbers in a value are known.
    fn is_known(&self, value: &Value) -> bool {
        let mut leaves = Vec::new();
        Self::leaves(value, &mut leaves);
        leaves.iter().all(|id| self.builder.graph().constant(*id).is_some())
    }

    /// Unrolls a `while`; gives how many iterations it had.
    fn unrolled_while(&mut self, condition: &Expr, body: &Body<'_>, span: Span) -> Eval<u64> {
        let noted = self.errors.len();
        let mut iterations = 0;
        loop {
            self.step(span)?;
            let value = self.value(condition)?;
            let id = self.node(&value, condition.span)?;
            match self.known_bool(id) {
                Some(true) => {}
                Some(false) => return Ok(iterations),
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
            iterations += 1;
            self.loops.round();
            let outcome = self.block(body.block);
            if !again(outcome, body.label)? {
                return Ok(iterations);
            }
            if self.errors.len() > noted {
                return Err(Exit::Noted);
            }
        }
    }
}

/// Whether an expression may call what writes through a reference that it is given.
fn has_calls(e: &Expr) -> bool {
    matches!(e.kind, ExprKind::Call(..) | ExprKind::Method(..) | ExprKind::Block(_))
        || children(e).into_iter().any(has_calls)
}
