//! `if`, and the join of its two sides.

use super::departures::{EarlyExit, Side, Tail};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::eval::Evaluator;
use crate::eval::scope::Scope;
use crate::eval::value::{Eval, Exit, Jump, Value};
use crate::front::tree::{Block, Expr};
use crate::ir::{NodeId, Op, RegionId, Type};
use crate::policy::Branches;
use std::rc::Rc;

/// Maximum nesting of branches and loops left in the shader. WGSL accepts 127 nested braces, some of which belong to the
/// function and the test for the frame's border.
const MAX_NESTED: usize = 100;

impl Evaluator<'_> {
    /// Evaluates an `if` in tail position.
    pub fn eval_if(
        &mut self,
        condition: &Expr,
        then: &Block,
        otherwise: Option<&Expr>,
        attribute: Option<Branches>,
        tail: Tail<'_>,
        span: Span,
    ) -> Eval {
        let id = self.eval_condition(condition)?;
        let other = |e: &mut Self| otherwise.map_or(Ok(Value::unit()), |o| e.expr_in(o, tail));
        match self.known_bool(id) {
            Some(true) => self.block_in(then, tail),
            Some(false) => other(self),
            None => {
                let keep = self.policy.keeps_branch(attribute);
                self.eval_branch(tail, id, keep, span, |e| e.block_in(then, tail), other)
            }
        }
    }

    /// Returns whether another branch or loop may be nested in the open ones in the shader. Beyond the limit, branches
    /// become selections.
    pub fn may_nest(&self) -> bool {
        self.builder.open_regions().len() < MAX_NESTED
    }

    /// Evaluates a condition to a boolean.
    pub fn eval_condition(&mut self, condition: &Expr) -> Eval<NodeId> {
        let value = self.eval_value(condition)?;
        let id = self.value_node(&value, condition.span)?;
        if self.ty(id) != Type::BOOL {
            return Err(
                Diagnostic::error_at(Code::MismatchedTypes, condition.span, "a condition must be a boolean")
                    .label(format!("of type {}", self.ty(id).in_rust()))
                    .help("compare it: `!= 0`")
                    .into(),
            );
        }
        Ok(id)
    }

    /// Evaluates `assert!`, whose condition must be a compile-time constant that holds. That of `debug_assert!` may be a runtime
    /// value, which release builds of Rust do not look at.
    pub fn eval_assert(&mut self, condition: &Expr, message: &str, only_debug: bool) -> Eval {
        let value = self.eval_expr(condition)?;
        let id = self.value_node(&value, condition.span)?;
        match self.known_bool(id) {
            Some(true) => Ok(Value::unit()),
            Some(false) => Err(Diagnostic::error_at(Code::Assertion, condition.span, message)
                .label("does not hold")
                .into()),
            None if only_debug => Ok(Value::unit()),
            None => {
                let error = Diagnostic::error_at(Code::Assertion, condition.span, "an assertion about a runtime value")
                    .label("not a compile-time constant")
                    .note("a shader has no way to fail")
                    .help("assert what follows from options and counters, and let run-time values choose with `if`");
                Err(self.demand_constants(&[id], error))
            }
        }
    }

    /// Evaluates both sides of a runtime condition. Values that differ are selected, or a branch is left in the shader.
    pub fn eval_branch(
        &mut self,
        tail: Tail<'_>,
        condition: NodeId,
        keep: bool,
        span: Span,
        then: impl FnOnce(&mut Self) -> Eval,
        otherwise: impl FnOnce(&mut Self) -> Eval,
    ) -> Eval {
        let keep = keep && self.may_nest();
        self.control
            .branch_conditions
            .push((self.report.call_depth(), condition));
        let joined = self.eval_nested(|e| match keep {
            true => e.structured_branch(tail, condition, span, then, otherwise),
            false => e.selected_branch(tail, condition, span, then, otherwise),
        });
        self.control.branch_conditions.pop();
        joined
    }

    fn selected_branch(
        &mut self,
        tail: Tail<'_>,
        condition: NodeId,
        span: Span,
        then: impl FnOnce(&mut Self) -> Eval,
        otherwise: impl FnOnce(&mut Self) -> Eval,
    ) -> Eval {
        let before = self.scope.clone();
        let left = self.eval_under(&[(condition, true)], |e| e.eval_side(tail, span, then));
        if matches!(left, Err(Exit::Demand(_))) {
            return left;
        }
        let after_left = std::mem::replace(&mut self.scope, before);
        let departed_left = self.take_exits();
        let right = self.eval_under(&[(condition, false)], |e| e.eval_side(tail, span, otherwise));
        let departed_right = self.take_exits();
        let negated = self.not(condition);
        for (side, departed) in [(condition, departed_left), (negated, departed_right)] {
            for departure in departed {
                let condition = self.and(side, departure.condition);
                self.control
                    .early_exits
                    .push(EarlyExit::from_parts(condition, departure.jump, departure.scope));
            }
        }
        match (left, right) {
            // Of a side that no invocation reaches, nothing is used but the exits before.
            (Err(Exit::Left(Jump::Unreachable(_))), right) => right,
            (left, Err(Exit::Left(Jump::Unreachable(_)))) => {
                self.scope = after_left;
                left
            }
            (Ok(left), Ok(right)) => self.join_sides(condition, None, (after_left, left), right, span),
            (Err(Exit::Left(way)), Ok(right)) => {
                self.control
                    .early_exits
                    .push(EarlyExit::from_parts(condition, way, after_left));
                Ok(right)
            }
            (Ok(left), Err(Exit::Left(way))) => {
                let scope = std::mem::replace(&mut self.scope, after_left);
                self.control
                    .early_exits
                    .push(EarlyExit::from_parts(negated, way, scope));
                Ok(left)
            }
            (Err(Exit::Left(left)), Err(Exit::Left(right))) => {
                self.control
                    .early_exits
                    .push(EarlyExit::from_parts(condition, left, after_left));
                Err(Exit::Left(right))
            }
            (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    fn structured_branch(
        &mut self,
        tail: Tail<'_>,
        condition: NodeId,
        span: Span,
        then: impl FnOnce(&mut Self) -> Eval,
        otherwise: impl FnOnce(&mut Self) -> Eval,
    ) -> Eval {
        let before = self.scope.clone();
        let negated = self.not(condition);
        let first = self.builder.open_region(&[]);
        let left = self.flat_side(tail, span, then);
        self.builder.close_region(Vec::new());
        if let Err(demand @ Exit::Demand(_)) = left {
            return Err(demand);
        }
        let after_left = std::mem::replace(&mut self.scope, before);
        let second = self.builder.open_region(&[]);
        let right = self.flat_side(tail, span, otherwise);
        self.builder.close_region(Vec::new());
        self.join_kept(condition, negated, (first, second), (after_left, left?), right?, span)
    }

    /// Evaluates one side of a branch in the shader and merges the states of its exits into one.
    fn flat_side(&mut self, tail: Tail<'_>, span: Span, evaluate: impl FnOnce(&mut Self) -> Eval) -> Eval<Side> {
        let mark = self.scope.enter();
        let outcome = self.eval_side(tail, span, evaluate);
        let departed = self.take_exits();
        self.side_of(outcome, departed, mark, span)
    }

    /// Evaluates code whose result is used only where a runtime condition holds.
    fn eval_side(&mut self, tail: Tail<'_>, span: Span, evaluate: impl FnOnce(&mut Self) -> Eval) -> Eval {
        let (mark, since) = (self.scope.enter(), self.control.early_exits.len());
        let outcome = evaluate(self);
        let outcome = self.merge_exits(since, outcome, mark, &|way| tail.is_target_of(way), span);
        self.scope.leave(mark);
        outcome
    }

    /// Evaluates the right side of `&&` or `||` after `condition`. The right side has no exits.
    pub fn lazy_side(&mut self, condition: NodeId, right: impl FnOnce(&mut Self) -> Eval, span: Span) -> Eval {
        let (mark, since) = (self.scope.enter(), self.control.early_exits.len());
        let outcome = right(self);
        self.scope.leave(mark);
        let left = self.control.early_exits.len() > since;
        self.control.early_exits.truncate(since);
        match outcome {
            Ok(value) if !left => Ok(value),
            Ok(_) | Err(Exit::Left(_)) => {
                let error = Diagnostic::error_at(
                    Code::Leaving,
                    span,
                    "`break`, `continue` or `return` on the right side of `&&` or `||`",
                )
                .label("whether it is reached is a runtime value")
                .help("write an `if`");
                Err(self.demand_constants(&[condition], error))
            }
            error => error,
        }
    }

    /// Joins the two sides: variables and values that differ are selected, or become results of the branch.
    pub fn join_sides(
        &mut self,
        condition: NodeId,
        regions: Option<(RegionId, RegionId)>,
        (left_scope, left): (Scope, Value),
        right: Value,
        span: Span,
    ) -> Eval {
        let joined = self.join_all(condition, regions, &left_scope, vec![(left, right)], span)?;
        Ok(joined.into_iter().next().unwrap_or(Value::Poison))
    }

    /// Like [`Evaluator::join_sides`], for several values in addition to the variables.
    pub fn join_all(
        &mut self,
        condition: NodeId,
        regions: Option<(RegionId, RegionId)>,
        left_scope: &Scope,
        values: Vec<(Value, Value)>,
        span: Span,
    ) -> Eval<Vec<Value>> {
        let mut pairs: Vec<_> = values.into_iter().map(|(left, right)| (None, left, right)).collect();
        let mut compared = 0;
        // An exit taken before a variable was created never reaches code that can see it.
        for slot in 0..self.scope.len().min(left_scope.len()) {
            let (a, b) = (left_scope.name_and_value(slot).1, self.scope.name_and_value(slot).1);
            if let (Value::Array(x), Value::Array(y)) = (a, b) {
                if Rc::ptr_eq(x, y) {
                    continue;
                }
                compared += x.len();
            }
            if a == b {
                if left_scope.shared_value(slot) != self.scope.shared_value(slot) {
                    self.scope.clear_shared(slot);
                }
            } else if let Some(common) = self.scope.common_value(left_scope, slot) {
                let common = common.clone();
                self.scope.set_value(slot, common);
            } else {
                pairs.push((Some(slot), a.clone(), b.clone()));
            }
        }
        self.count_copy(4 * compared, span)?;
        let mut joined = Vec::new();
        let (mut lefts, mut rights) = (Vec::new(), Vec::new());
        for (slot, a, b) in pairs {
            let unified = self.unify_values(&a, &b, span);
            let (a, b) = self.demand_on_error(&[condition], unified)?;
            a.flatten(&mut lefts);
            b.flatten(&mut rights);
            joined.push((slot, a));
        }
        let nodes = self.merge_nodes(condition, regions, &lefts, &rights);
        let mut nodes = nodes.into_iter();
        let mut results = Vec::new();
        for (slot, template) in joined {
            let value = template.unflatten(&mut nodes);
            match slot {
                None => results.push(value),
                Some(slot) => {
                    let name = self.scope.name_and_value(slot).0.to_owned();
                    self.name_value(&value, &name, span);
                    self.scope.set_value(slot, value);
                }
            }
        }
        Ok(results)
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
            return pairs.map(|(a, b)| self.build_select(condition, *a, *b)).collect();
        };
        // Only values that differ become results of the branch.
        let differing: Vec<(NodeId, NodeId)> = pairs.clone().filter(|(a, b)| a != b).map(|(a, b)| (*a, *b)).collect();
        let graph = self.builder.graph_mut();
        let happens = [first, second]
            .iter()
            .any(|region| !graph.region(*region).effects.is_empty());
        if differing.is_empty() && !happens {
            return lefts.to_vec();
        }
        graph.regions[first.0 as usize].results = differing.iter().map(|(a, _)| *a).collect();
        graph.regions[second.0 as usize].results = differing.iter().map(|(_, b)| *b).collect();
        let node = self.builder.add(Op::If(first, second), [condition], Type::Results);
        let mut k = 0;
        let mut merged = Vec::new();
        for (a, b) in lefts.iter().zip(rights) {
            if a == b {
                merged.push(*a);
            } else {
                let ty = self.ty(*a);
                merged.push(self.builder.add(Op::Result(k), [node], ty));
                k += 1;
            }
        }
        merged
    }

    /// Selects between two values; arrays are selected element by element.
    fn build_select(&mut self, condition: NodeId, a: NodeId, b: NodeId) -> NodeId {
        let ty = self.ty(a);
        let Type::Array { len, .. } = ty else {
            return self.builder.add(Op::Select, [condition, a, b], ty);
        };
        if a == b {
            return a;
        }
        let element = ty.element_type();
        let elements = (0..len as i32).map(|k| {
            let k = self.builder.i32(k);
            let [a, b] = [a, b].map(|array| self.builder.add(Op::ArrayGet, [array, k], element));
            self.builder.add(Op::Select, [condition, a, b], element)
        });
        let elements: Vec<_> = elements.collect();
        self.builder.add(Op::MakeArray, elements, ty)
    }
}
