//! `if`, and joining what two sides did.

use super::Evaluator;
use super::scope::Scope;
use super::value::{Eval, Exit, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::tree::{Block, Expr};
use crate::ir::{NodeId, Op, RegionId, Type};
use crate::policy::Branches;
use std::rc::Rc;

impl Evaluator<'_> {
    pub fn if_(
        &mut self,
        condition: &Expr,
        then: &Block,
        otherwise: Option<&Expr>,
        attribute: Option<Branches>,
        span: Span,
    ) -> Eval {
        let value = self.value(condition)?;
        let id = self.node(&value, condition.span)?;
        if self.ty(id) != Type::BOOL {
            return Err(Diagnostic::at(condition.span, "a condition must be a boolean")
                .label(format!("of type {}", self.ty(id).in_rust()))
                .help("compare it: `!= 0`")
                .into());
        }
        match self.known_bool(id) {
            Some(true) => self.block(then),
            Some(false) => otherwise.map_or(Ok(Value::unit()), |e| self.expr(e)),
            None => {
                let keep = self.policy.keeps(attribute);
                self.branch(
                    id,
                    keep,
                    span,
                    |e| e.block(then),
                    |e| otherwise.map_or(Ok(Value::unit()), |o| e.expr(o)),
                )
            }
        }
    }

    /// `assert!`: a condition that is known now and must hold.
    pub fn assert(&mut self, condition: &Expr, message: &str) -> Eval {
        let value = self.expr(condition)?;
        let id = self.node(&value, condition.span)?;
        match self.known_bool(id) {
            Some(true) => Ok(Value::unit()),
            Some(false) => Err(Diagnostic::at(condition.span, message).label("does not hold").into()),
            None => Err(
                Diagnostic::at(condition.span, "an assertion about what is only known at run time")
                    .label("not known now")
                    .note("a shader has no way to fail")
                    .help("assert what follows from options and counters, and let run-time values choose with `if`")
                    .into(),
            ),
        }
    }

    /// A condition that is known at run time: both sides are evaluated, and what differs is selected, or a branch
    /// is kept.
    pub fn branch(
        &mut self,
        condition: NodeId,
        keep: bool,
        span: Span,
        then: impl FnOnce(&mut Self) -> Eval,
        otherwise: impl FnOnce(&mut Self) -> Eval,
    ) -> Eval {
        let before = self.scope.clone();
        let untouched = before.clone();
        let first = keep.then(|| self.builder.open_region(&[]));
        let left = self.side(span, then);
        let after_left = std::mem::replace(&mut self.scope, before);
        if keep {
            self.builder.close_region(Vec::new());
        }
        let second = keep.then(|| self.builder.open_region(&[]));
        let right = self.side(span, otherwise);
        if keep {
            self.builder.close_region(Vec::new());
        }
        let regions = first.zip(second);
        let joined = match (left, right) {
            (Ok(left), Ok(right)) => self.join(condition, regions, (after_left, left), right, span),
            (Err(exit), _) | (_, Err(exit)) => Err(exit),
        };
        if joined.is_err() {
            // Values made inside belong to no place outside.
            self.scope = untouched;
        }
        joined
    }

    /// Evaluates what is only looked at where a run-time condition holds.
    pub fn side(&mut self, span: Span, evaluate: impl FnOnce(&mut Self) -> Eval) -> Eval {
        let mark = self.scope.enter();
        let outcome = evaluate(self);
        self.scope.leave(mark);
        match outcome {
            Err(Exit::Break(_) | Exit::Continue(_) | Exit::Return(_)) => Err(Diagnostic::at(
                span,
                "`break`, `continue` or `return` under a condition that is only known at run time",
            )
            .label("not known now")
            .note("both sides of this `if` are part of the shader, and what follows has to come after both")
            .help("let both sides of the `if` give a value, and go on with that")
            .into()),
            other => other,
        }
    }

    /// Joins the two sides: variables and values that differ are selected, or become the branch's results.
    pub fn join(
        &mut self,
        condition: NodeId,
        regions: Option<(RegionId, RegionId)>,
        (left_scope, left): (Scope, Value),
        right: Value,
        span: Span,
    ) -> Eval {
        let mut pairs = vec![(None, left, right)];
        let mut compared = 0;
        for slot in 0..self.scope.len() {
            let (a, b) = (left_scope.at(slot).1, self.scope.at(slot).1);
            if let (Value::Array(x), Value::Array(y)) = (a, b) {
                if Rc::ptr_eq(x, y) {
                    continue;
                }
                compared += x.len();
            }
            if a != b {
                pairs.push((Some(slot), a.clone(), b.clone()));
            }
        }
        self.copied(4 * compared, span)?;
        let mut joined = Vec::new();
        let (mut lefts, mut rights) = (Vec::new(), Vec::new());
        for (slot, a, b) in pairs {
            let (a, b) = self.agree(&a, &b, span)?;
            let (mut from_a, mut from_b) = (Vec::new(), Vec::new());
            Self::leaves(&a, &mut from_a);
            Self::leaves(&b, &mut from_b);
            joined.push((slot, a, from_a.len()));
            lefts.extend(from_a);
            rights.extend(from_b);
        }
        let nodes = self.merge_nodes(condition, regions, &lefts, &rights);
        let mut nodes = nodes.into_iter();
        let mut result = Value::unit();
        for (slot, template, _) in joined {
            let value = Self::with_leaves(&template, &mut nodes);
            match slot {
                None => result = value,
                Some(slot) => {
                    let name = self.scope.at(slot).0.to_owned();
                    self.name(&value, &name, span);
                    self.scope.set(slot, value);
                }
            }
        }
        Ok(result)
    }

    fn merge_nodes(
        &mut self,
        condition: NodeId,
        regions: Option<(RegionId, RegionId)>,
        lefts: &[NodeId],
        rights: &[NodeId],
    ) -> Vec<NodeId> {
        let pairs = lefts.iter().zip(rights);
        let Some((first, second)) = regions else {
            return pairs.map(|(a, b)| self.select(condition, *a, *b)).collect();
        };
        // Only what differs leaves the branch.
        let differing: Vec<(NodeId, NodeId)> = pairs.clone().filter(|(a, b)| a != b).map(|(a, b)| (*a, *b)).collect();
        if differing.is_empty() {
            return lefts.to_vec();
        }
        let graph = self.builder.graph_mut();
        graph.regions[first.0 as usize].results = differing.iter().map(|(a, _)| *a).collect();
        graph.regions[second.0 as usize].results = differing.iter().map(|(_, b)| *b).collect();
        let node = self.builder.add(Op::If(first, second), vec![condition], Type::Results);
        let mut k = 0;
        let mut merged = Vec::new();
        for (a, b) in lefts.iter().zip(rights) {
            if a == b {
                merged.push(*a);
            } else {
                let ty = self.ty(*a);
                merged.push(self.builder.add(Op::Result(k), vec![node], ty));
                k += 1;
            }
        }
        merged
    }

    /// One of two values; of arrays, element by element.
    fn select(&mut self, condition: NodeId, a: NodeId, b: NodeId) -> NodeId {
        let ty = self.ty(a);
        let Type::Array { len, .. } = ty else {
            return self.builder.add(Op::Select, vec![condition, a, b], ty);
        };
        if a == b {
            return a;
        }
        let element = ty.element();
        let elements = (0..len as i32).map(|k| {
            let k = self.builder.i32(k);
            let [a, b] = [a, b].map(|array| self.builder.add(Op::ArrayGet, vec![array, k], element));
            self.builder.add(Op::Select, vec![condition, a, b], element)
        });
        let elements = elements.collect();
        self.builder.add(Op::MakeArray, elements, ty)
    }
}
