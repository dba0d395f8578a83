//! `break`, `continue` and `return` under runtime conditions.
//!
//! An early exit captures the state at the exit. Evaluation continues for the remaining invocations and keeps a list of the
//! exits taken so far: condition, target, state. At the target the states are merged: after the loop, at the end of the
//! iteration, at the end of the function. Values computed after an exit are also computed for the invocations that took it,
//! but never read; this is safe because operations are pure. If branches are left in the shader, the code after an exit
//! becomes the other side of the branch, so that no invocation computes unused values.

use crate::diagnostic::Span;
use crate::eval::Evaluator;
use crate::eval::scope::Scope;
use crate::eval::value::{Eval, Exit, Jump, Value};
use crate::front::tree::{Block, Expr, ExprKind, Statement};
use crate::ir::{BinaryOp, NodeId, Op, RegionId, Type, UnaryOp};
use crate::policy::Branches;

/// An exit that was taken from the code being evaluated.
#[derive(Clone, Debug)]
pub struct EarlyExit {
    /// Condition of this exit, given that no earlier exit was taken.
    pub condition: NodeId,
    /// Kind and target of the exit.
    pub jump: Jump,
    /// Variables at the exit.
    pub scope: Scope,
    /// The branch in the shader that this exit belongs to, if any. Exits of one branch are mutually exclusive.
    pub group: Option<RegionId>,
}

impl EarlyExit {
    /// Returns an exit under a condition that belongs to no branch.
    pub fn from_parts(condition: NodeId, way: Jump, scope: Scope) -> EarlyExit {
        EarlyExit {
            condition,
            jump: way,
            scope,
            group: None,
        }
    }
}

/// Construct that the current block is the tail of. Exits that target its end fall through.
#[derive(Clone, Copy, Debug)]
pub enum Tail<'t> {
    /// None: every exit must be recorded.
    Open,
    /// The function.
    Function,
    /// An iteration of the loop with a label.
    Iteration(Option<&'t str>),
}

impl Tail<'_> {
    /// Returns whether an exit targets the end of this construct.
    pub fn is_target_of(self, way: &Jump) -> bool {
        match self {
            Tail::Open => false,
            Tail::Function => matches!(way, Jump::Return(_)),
            Tail::Iteration(label) => way.continues_loop(label),
        }
    }
}

/// Outcome of one side of a branch.
pub struct Side {
    /// Value of the side, if evaluation reaches its end.
    pub value: Option<Value>,
    /// Exits of the side with their conditions, one for each target.
    pub exits: Vec<(Jump, NodeId)>,
    /// States before they were merged into one.
    pub states: Vec<SideState>,
}

/// The variables at the end of a side.
pub struct SideState {
    /// Exit taken in this state; `None` if evaluation continues.
    pub jump: Option<Jump>,
    /// Variables in this state.
    pub scope: Scope,
}

impl SideState {
    /// Returns whether this state takes the exit `way`, or continues if `way` is `None`.
    pub fn matches_jump(&self, way: Option<&Jump>) -> bool {
        match (&self.jump, way) {
            (Some(own), Some(way)) => own.is_like(way),
            (own, way) => own.is_none() && way.is_none(),
        }
    }
}

impl Evaluator<'_> {
    /// Evaluates `rest` under the condition that none of the exits since `since` was taken, if branches are kept in the
    /// shader.
    pub fn eval_if_live(
        &mut self,
        since: usize,
        tail: Tail<'_>,
        span: Span,
        rest: impl FnOnce(&mut Self) -> Eval,
    ) -> Eval {
        if self.control.early_exits.len() == since || !self.keeps_exits(None) {
            return rest(self);
        }
        let departed = self.control.early_exits.split_off(since);
        let conditions = departed.iter().map(|d| d.condition).collect::<Vec<_>>();
        let left = conditions.into_iter().reduce(|a, b| self.or(a, b));
        let left = left.unwrap_or_else(|| unreachable!("somebody has left"));
        self.eval_branch(tail, left, true, span, |e| e.rethrow_exits(departed), rest)
    }

    /// Repeats recorded exits from the block that is being evaluated now.
    fn rethrow_exits(&mut self, mut departed: Vec<EarlyExit>) -> Eval {
        let Some(last) = departed.pop() else {
            return Ok(Value::unit());
        };
        self.control.early_exits.extend(departed);
        self.scope = last.scope;
        Err(Exit::Left(last.jump))
    }

    /// Evaluates an `if` and the code after it. If one side always exits, that code becomes part of the other side.
    pub fn eval_guard_clause(
        &mut self,
        (condition, then, otherwise): (&Expr, &Block, Option<&Expr>),
        tail: Tail<'_>,
        span: Span,
        rest: &mut dyn FnMut(&mut Self) -> Eval,
    ) -> Eval {
        let id = self.eval_condition(condition)?;
        match self.known_bool(id) {
            Some(true) => self.followed_by(|e| e.eval_block(then), tail, span, rest),
            Some(false) => self.other_side(otherwise, tail, span, rest),
            None if always_leaves(then) => self.eval_branch(
                tail,
                id,
                true,
                span,
                |e| e.block_in(then, tail),
                |e| e.other_side(otherwise, tail, span, rest),
            ),
            None if otherwise.is_some_and(expr_always_leaves) => self.eval_branch(
                tail,
                id,
                true,
                span,
                |e| e.followed_by(|e| e.eval_block(then), tail, span, rest),
                |e| otherwise.map_or(Ok(Value::unit()), |other| e.expr_in(other, tail)),
            ),
            None => {
                let other = |e: &mut Self| otherwise.map_or(Ok(Value::unit()), |other| e.eval_expr(other));
                let both = |e: &mut Self| e.eval_branch(Tail::Open, id, true, span, |e| e.eval_block(then), other);
                self.followed_by(both, tail, span, rest)
            }
        }
    }

    /// Evaluates the `else` side of an `if`, and the code after it.
    fn other_side(
        &mut self,
        otherwise: Option<&Expr>,
        tail: Tail<'_>,
        span: Span,
        rest: &mut dyn FnMut(&mut Self) -> Eval,
    ) -> Eval {
        let Some(other) = otherwise else { return rest(self) };
        match &other.kind {
            ExprKind::If(condition, then, last, attribute)
                if has_exits(then, last.as_deref()) && self.keeps_exits(*attribute) =>
            {
                self.eval_guard_clause((condition, then, last.as_deref()), tail, other.span, rest)
            }
            _ => self.followed_by(|e| e.eval_expr(other), tail, span, rest),
        }
    }

    /// Evaluates `first`, then `rest` under the condition that `first` took no exit.
    pub fn followed_by(
        &mut self,
        first: impl FnOnce(&mut Self) -> Eval,
        tail: Tail<'_>,
        span: Span,
        rest: &mut dyn FnMut(&mut Self) -> Eval,
    ) -> Eval {
        let since = self.control.early_exits.len();
        first(self)?;
        self.eval_if_live(since, tail, span, |e| rest(e))
    }

    /// Returns whether code after an exit under a runtime condition becomes a branch in the shader.
    pub fn keeps_exits(&self, attribute: Option<Branches>) -> bool {
        let stated = attribute.unwrap_or(self.policy.branches);
        self.may_nest()
            && (self.policy.keeps_branch(attribute) || (self.loops.is_inside_kept() && stated == Branches::AsLoops))
    }

    /// Merges the exits since `since` that target this point into the current state, each with the value that it carries.
    /// Variables after `mark` are dropped.
    pub fn merge_exits(
        &mut self,
        since: usize,
        outcome: Eval,
        mark: usize,
        leads_here: &dyn Fn(&Jump) -> bool,
        span: Span,
    ) -> Eval {
        let mut mine: Vec<EarlyExit> = Vec::new();
        // Condition that none of the merged exits was taken.
        let mut others = self.builder.bool(true);
        for mut departure in self.control.early_exits.split_off(since) {
            if leads_here(&departure.jump) {
                let stays = self.not(departure.condition);
                others = self.and(others, stays);
                mine.push(departure);
                continue;
            }
            departure.condition = self.and(others, departure.condition);
            self.control.early_exits.push(departure);
        }
        let mut value = match outcome {
            Ok(value) => value,
            Err(Exit::Left(way)) if leads_here(&way) => way.into_value(),
            Err(Exit::Left(way)) => match mine.pop() {
                None => return Err(Exit::Left(way)),
                Some(last) if matches!(way, Jump::Unreachable(_)) => {
                    self.scope = last.scope;
                    last.jump.into_value()
                }
                // All other invocations have left for good.
                Some(last) => {
                    let arrived: Vec<NodeId> = mine.iter().map(|d| d.condition).chain([last.condition]).collect();
                    let mut condition = self.builder.bool(true);
                    for id in arrived {
                        let stays = self.not(id);
                        condition = self.and(stays, condition);
                    }
                    let scope = std::mem::replace(&mut self.scope, last.scope);
                    self.control
                        .early_exits
                        .push(EarlyExit::from_parts(condition, way, scope));
                    last.jump.into_value()
                }
            },
            Err(error) => return Err(error),
        };
        self.scope.leave(mark);
        for departure in mine.into_iter().rev() {
            let theirs = (departure.scope, departure.jump.into_value());
            value = self.join_sides(departure.condition, None, theirs, value, span)?;
        }
        Ok(value)
    }

    /// Merges the exits of a side and its normal end into one state that can leave a region. A boolean for each target
    /// records which exit was taken.
    pub fn side_of(&mut self, outcome: Eval, departed: Vec<EarlyExit>, mark: usize, span: Span) -> Eval<Side> {
        let (value, last) = match outcome {
            Ok(value) => (Some(value), None),
            Err(Exit::Left(way)) => (None, Some(way)),
            Err(error) => return Err(error),
        };
        let mut exits: Vec<(Jump, NodeId)> = Vec::new();
        let mut staying = self.builder.bool(true);
        let alone = |group: Option<RegionId>| group.is_some() && departed.iter().all(|d| d.group == group);
        for departure in &departed {
            let leaves = match alone(departure.group) {
                true => departure.condition,
                false => self.and(staying, departure.condition),
            };
            self.add_exit(&mut exits, &departure.jump, leaves, span)?;
            let stays = self.not(departure.condition);
            staying = self.and(staying, stays);
        }
        if let Some(way) = last.as_ref().filter(|way| !matches!(way, Jump::Unreachable(_))) {
            self.add_exit(&mut exits, way, staying, span)?;
        }
        self.scope.leave(mark);
        let mut states = vec![SideState {
            jump: last,
            scope: self.scope.clone(),
        }];
        for mut departure in departed.into_iter().rev() {
            departure.scope.leave(mark);
            states.push(SideState {
                jump: Some(departure.jump),
                scope: departure.scope.clone(),
            });
            self.scope.fill_unset(&mut departure.scope);
            let theirs = (departure.scope, Value::unit());
            self.join_sides(departure.condition, None, theirs, Value::unit(), span)?;
        }
        Ok(Side { value, exits, states })
    }

    fn add_exit(&mut self, exits: &mut Vec<(Jump, NodeId)>, way: &Jump, leaves: NodeId, span: Span) -> Eval<()> {
        let Some(k) = exits.iter().position(|(known, _)| known.is_like(way)) else {
            exits.push((way.clone(), leaves));
            return Ok(());
        };
        let (known, before) = exits[k].clone();
        if let (Jump::Return(first), Jump::Return(second)) = (&known, way) {
            let scope = self.scope.clone();
            let value = self.join_sides(before, None, (scope, first.clone()), second.clone(), span)?;
            exits[k].0 = Jump::Return(value);
        }
        exits[k].1 = self.or(before, leaves);
        Ok(())
    }

    /// Joins two sides that are left in the shader as regions. Their exits are recorded as early exits of the branch.
    pub fn join_kept(
        &mut self,
        condition: NodeId,
        negated: NodeId,
        regions: (RegionId, RegionId),
        (mut left_scope, left): (Scope, Side),
        right: Side,
        span: Span,
    ) -> Eval {
        let mut pairs = Vec::new();
        let goes_on = match (&left.value, &right.value) {
            (None, None) => false,
            (a, b) => {
                pairs.push(self.pair_values(a.as_ref(), b.as_ref()));
                true
            }
        };
        let mut ways: Vec<Jump> = left.exits.iter().map(|(way, _)| way.clone()).collect();
        for (way, _) in &right.exits {
            if !ways.iter().any(|known| known.is_like(way)) {
                ways.push(way.clone());
            }
        }
        let never = self.builder.bool(false);
        let mut flags = Vec::new();
        for way in &ways {
            let of = |side: &Side| side.exits.iter().find(|(known, _)| known.is_like(way)).cloned();
            let (a, b) = (of(&left), of(&right));
            let flag = |exit: &Option<(Jump, NodeId)>| exit.as_ref().map_or(never, |(_, flag)| *flag);
            let (first, second) = (flag(&a), flag(&b));
            flags.push(match (self.known_bool(first), self.known_bool(second)) {
                (Some(true), Some(false)) if ways.len() == 1 => Some(condition),
                (Some(false), Some(true)) if ways.len() == 1 => Some(negated),
                _ => {
                    pairs.push((Value::Node(first), Value::Node(second)));
                    None
                }
            });
            if matches!(way, Jump::Return(_)) {
                let value = |exit: Option<(Jump, NodeId)>| exit.map(|(way, _)| way.into_value());
                pairs.push(self.pair_values(value(a).as_ref(), value(b).as_ref()));
            }
        }
        self.scope.fill_unset(&mut left_scope);
        let joined = self.join_all(condition, Some(regions), &left_scope, pairs, span)?;
        let mut joined = joined.into_iter();
        let mut value = goes_on.then(|| joined.next()).flatten();
        let of_sides: Vec<&Value> = left.value.iter().chain(&right.value).collect();
        if let Some(refined) = value
            .as_ref()
            .and_then(|value| self.refine_from_states(value, &of_sides))
        {
            value = Some(refined);
        }
        let states: Vec<SideState> = left.states.into_iter().chain(right.states).collect();
        let merged = self.scope.clone();
        let mut departed = Vec::new();
        for (way, flag) in ways.into_iter().zip(flags) {
            let condition = match flag {
                Some(known) => known,
                None => self.value_node(&joined.next().unwrap_or(Value::Poison), span)?,
            };
            let way = match way {
                Jump::Return(_) => Jump::Return(joined.next().unwrap_or(Value::Poison)),
                other => other,
            };
            if flag.is_none() {
                self.name_exit(condition, &way, span);
            }
            let scope = self.in_state(&merged, &states, Some(&way));
            let group = Some(regions.0);
            departed.push(EarlyExit {
                condition,
                jump: way,
                scope,
                group,
            });
        }
        match value {
            Some(value) => {
                self.scope = self.in_state(&merged, &states, None);
                self.control.early_exits.extend(departed);
                Ok(value)
            }
            None if departed.is_empty() => Err(Exit::Left(Jump::Unreachable(span))),
            None => self.rethrow_exits(departed),
        }
    }

    /// Returns the values of both sides of a branch. A missing value is undefined.
    fn pair_values(&mut self, a: Option<&Value>, b: Option<&Value>) -> (Value, Value) {
        match (a, b) {
            (Some(a), Some(b)) => (a.clone(), b.clone()),
            (Some(a), None) => (a.clone(), self.undef_like(a)),
            (None, Some(b)) => (self.undef_like(b), b.clone()),
            (None, None) => (Value::unit(), Value::unit()),
        }
    }

    /// Undefined value of the same shape.
    pub fn undef_like(&mut self, value: &Value) -> Value {
        let mut leaves = Vec::new();
        value.flatten(&mut leaves);
        let blanks: Vec<NodeId> = leaves.into_iter().map(|id| self.undef_node(self.ty(id))).collect();
        value.unflatten(&mut blanks.into_iter())
    }

    /// Undefined value of a type.
    pub fn undef_node(&mut self, ty: Type) -> NodeId {
        let Type::Array { len, .. } = ty else {
            return self.builder.add(Op::Undef, Vec::new(), ty);
        };
        let element = self.builder.add(Op::Undef, Vec::new(), ty.element_type());
        self.builder.add(Op::MakeArray, vec![element; len as usize], ty)
    }

    /// Names the boolean that records whether an exit was taken, and the returned value.
    pub fn name_exit(&mut self, flag: NodeId, way: &Jump, span: Span) {
        let name = match way {
            Jump::Break(_) => "stopped",
            Jump::Continue(_) => "skipped",
            Jump::Return(_) => "returned",
            Jump::Unreachable(_) => return,
        };
        self.name_params(&Value::Node(flag), name, span);
        if let Jump::Return(value) = way {
            self.name_params(value, "result", span);
        }
    }

    /// Builds `!a`.
    pub fn not(&mut self, a: NodeId) -> NodeId {
        self.builder.add(Op::Unary(UnaryOp::Not), [a], Type::BOOL)
    }

    /// Builds `a && b`.
    pub fn and(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.known_bool(a), self.known_bool(b)) {
            (Some(true), _) => b,
            (Some(false), _) | (_, Some(true)) => a,
            (_, Some(false)) => b,
            _ => self.builder.add(Op::Binary(BinaryOp::And), [a, b], Type::BOOL),
        }
    }

    /// Builds `a || b`.
    pub fn or(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.known_bool(a), self.known_bool(b)) {
            (Some(false), _) => b,
            (Some(true), _) | (_, Some(false)) => a,
            (_, Some(true)) => b,
            _ => self.builder.add(Op::Binary(BinaryOp::Or), [a, b], Type::BOOL),
        }
    }
}

/// Returns whether a block never reaches its end.
pub fn always_leaves(block: &Block) -> bool {
    let last = block.value.as_deref().or(match block.statements.last() {
        Some(Statement::Expr(e)) => Some(e),
        _ => None,
    });
    last.is_some_and(expr_always_leaves)
}

/// Returns whether an expression never yields a value.
pub fn expr_always_leaves(e: &Expr) -> bool {
    match &e.kind {
        ExprKind::Return(_) | ExprKind::Break(_) | ExprKind::Continue(_) => true,
        ExprKind::Block(block) => always_leaves(block),
        ExprKind::If(_, then, Some(otherwise), _) => always_leaves(then) && expr_always_leaves(otherwise),
        ExprKind::Match(_, arms, _) => !arms.is_empty() && arms.iter().all(|arm| expr_always_leaves(&arm.body)),
        _ => false,
    }
}

/// Returns whether a branch of an `if`, or of one of its `else if`s, never reaches its end.
pub fn has_exits(then: &Block, otherwise: Option<&Expr>) -> bool {
    always_leaves(then)
        || otherwise.is_some_and(|other| match &other.kind {
            ExprKind::If(_, then, otherwise, _) => has_exits(then, otherwise.as_deref()),
            _ => expr_always_leaves(other),
        })
}
