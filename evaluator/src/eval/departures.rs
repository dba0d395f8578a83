//! `break`, `continue` and `return` under runtime conditions.
//!
//! Who leaves does so in the state that it has then; all others go on. Evaluation goes on for the others alone, and keeps
//! in mind who has left: with which condition, by which way, in which state. Where that way leads, the states meet again:
//! behind the loop, at the end of the iteration, at the end of the function. What the others compute meanwhile is computed
//! for those who have left too, but never looked at: operations are pure. Where branches are kept, what follows becomes
//! their other side, so that nothing is computed in vain.

use super::Evaluator;
use super::scope::Scope;
use super::value::{Eval, Exit, Value, Way};
use crate::diagnostic::Span;
use crate::front::tree::{Block, Expr, ExprKind, Statement};
use crate::ir::{BinaryOp, NodeId, Op, RegionId, Type, UnaryOp};
use crate::policy::Branches;

/// Those who have left what is being evaluated.
#[derive(Clone, Debug)]
pub struct Departure {
    /// Holds for them, unless it is one of those before them.
    pub condition: NodeId,
    /// The way that they took.
    pub way: Way,
    /// Their variables.
    pub scope: Scope,
    /// Of those who left one branch by different ways, which that was: nobody took two of them.
    pub group: Option<RegionId>,
}

impl Departure {
    /// Of those for whom a condition holds.
    pub fn of(condition: NodeId, way: Way, scope: Scope) -> Departure {
        Departure {
            condition,
            way,
            scope,
            group: None,
        }
    }
}

/// What ends with the block that is being evaluated: ways that lead there need no departure.
#[derive(Clone, Copy, Debug)]
pub enum Tail<'t> {
    /// Nothing.
    Open,
    /// The function.
    Function,
    /// An iteration of the loop with a label.
    Iteration(Option<&'t str>),
}

impl Tail<'_> {
    /// Whether a way leads to the end of what it is the end of.
    pub fn takes(self, way: &Way) -> bool {
        match self {
            Tail::Open => false,
            Tail::Function => matches!(way, Way::Return(_)),
            Tail::Iteration(label) => way.continues(label),
        }
    }
}

/// What one side of a branch came to.
pub struct Side {
    /// Its value, if it goes on.
    pub value: Option<Value>,
    /// Who leaves it, each by another way.
    pub exits: Vec<(Way, NodeId)>,
    /// States before they were merged into one.
    pub states: Vec<State>,
}

/// The variables at the end of a side.
pub struct State {
    /// Exit that is taken in this state; `None` of the state that goes on.
    pub way: Option<Way>,
    /// Variables in this state.
    pub scope: Scope,
}

impl State {
    /// Whether this state goes where `way` leads; `None` is on.
    pub fn goes(&self, way: Option<&Way>) -> bool {
        match (&self.way, way) {
            (Some(own), Some(way)) => own.is_like(way),
            (own, way) => own.is_none() && way.is_none(),
        }
    }
}

impl Evaluator<'_> {
    /// Evaluates for those alone who have not left since there were `since` departures, if it can be said in the shader.
    pub fn unless_departed(
        &mut self,
        since: usize,
        tail: Tail<'_>,
        span: Span,
        rest: impl FnOnce(&mut Self) -> Eval,
    ) -> Eval {
        if self.departed.len() == since || !self.keeps_exits(None) {
            return rest(self);
        }
        let departed = self.departed.split_off(since);
        let conditions = departed.iter().map(|d| d.condition).collect::<Vec<_>>();
        let left = conditions.into_iter().reduce(|a, b| self.or(a, b));
        let left = left.unwrap_or_else(|| unreachable!("somebody has left"));
        self.branch(tail, left, true, span, |e| e.depart(departed), rest)
    }

    /// Those who left leave again, from the block that is being evaluated now.
    fn depart(&mut self, mut departed: Vec<Departure>) -> Eval {
        let Some(last) = departed.pop() else {
            return Ok(Value::unit());
        };
        self.departed.extend(departed);
        self.scope = last.scope;
        Err(Exit::Left(last.way))
    }

    /// An `if` and what follows it: where one side always leaves, that belongs to the other side.
    pub fn guarded(
        &mut self,
        (condition, then, otherwise): (&Expr, &Block, Option<&Expr>),
        tail: Tail<'_>,
        span: Span,
        rest: &mut dyn FnMut(&mut Self) -> Eval,
    ) -> Eval {
        let id = self.condition(condition)?;
        match self.known_bool(id) {
            Some(true) => self.followed_by(|e| e.block(then), tail, span, rest),
            Some(false) => self.other_side(otherwise, tail, span, rest),
            None if always_leaves(then) => self.branch(
                tail,
                id,
                true,
                span,
                |e| e.block_in(then, tail),
                |e| e.other_side(otherwise, tail, span, rest),
            ),
            None if otherwise.is_some_and(leaves) => self.branch(
                tail,
                id,
                true,
                span,
                |e| e.followed_by(|e| e.block(then), tail, span, rest),
                |e| otherwise.map_or(Ok(Value::unit()), |other| e.expr_in(other, tail)),
            ),
            None => {
                let other = |e: &mut Self| otherwise.map_or(Ok(Value::unit()), |other| e.expr(other));
                let both = |e: &mut Self| e.branch(Tail::Open, id, true, span, |e| e.block(then), other);
                self.followed_by(both, tail, span, rest)
            }
        }
    }

    /// The side of an `if` where its condition does not hold, and what follows.
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
                self.guarded((condition, then, last.as_deref()), tail, other.span, rest)
            }
            _ => self.followed_by(|e| e.expr(other), tail, span, rest),
        }
    }

    /// Evaluates something, and what follows it for those who have not left it.
    pub fn followed_by(
        &mut self,
        first: impl FnOnce(&mut Self) -> Eval,
        tail: Tail<'_>,
        span: Span,
        rest: &mut dyn FnMut(&mut Self) -> Eval,
    ) -> Eval {
        let since = self.departed.len();
        first(self)?;
        self.unless_departed(since, tail, span, |e| rest(e))
    }

    /// Whether what follows an exit under a run-time condition is left to a branch in the shader.
    pub fn keeps_exits(&self, attribute: Option<Branches>) -> bool {
        let stated = attribute.unwrap_or(self.policy.branches);
        self.may_nest() && (self.policy.keeps(attribute) || (self.kept_loops > 0 && stated == Branches::AsLoops))
    }

    /// Those who have left by a way that leads here, since there were `since` departures, go on from here, with the values
    /// that they left with. `mark`: variables beyond are gone.
    pub fn arrive(
        &mut self,
        since: usize,
        outcome: Eval,
        mark: usize,
        leads_here: &dyn Fn(&Way) -> bool,
        span: Span,
    ) -> Eval {
        let mut mine: Vec<Departure> = Vec::new();
        // Holds for those who have not arrived yet.
        let mut others = self.builder.bool(true);
        for mut departure in self.departed.split_off(since) {
            if leads_here(&departure.way) {
                let stays = self.not(departure.condition);
                others = self.and(others, stays);
                mine.push(departure);
                continue;
            }
            departure.condition = self.and(others, departure.condition);
            self.departed.push(departure);
        }
        let mut value = match outcome {
            Ok(value) => value,
            Err(Exit::Left(way)) if leads_here(&way) => way.value(),
            Err(Exit::Left(way)) => match mine.pop() {
                None => return Err(Exit::Left(way)),
                // All others have left for good.
                Some(last) => {
                    let arrived: Vec<NodeId> = mine.iter().map(|d| d.condition).chain([last.condition]).collect();
                    let mut condition = self.builder.bool(true);
                    for id in arrived {
                        let stays = self.not(id);
                        condition = self.and(stays, condition);
                    }
                    let scope = std::mem::replace(&mut self.scope, last.scope);
                    self.departed.push(Departure::of(condition, way, scope));
                    last.way.value()
                }
            },
            Err(error) => return Err(error),
        };
        self.scope.leave(mark);
        for departure in mine.into_iter().rev() {
            let theirs = (departure.scope, departure.way.value());
            value = self.join(departure.condition, None, theirs, value, span)?;
        }
        Ok(value)
    }

    /// Makes one state of those who left a side and those who go on, so that it can leave a region: who left by which way
    /// is told by a boolean each.
    pub fn side_of(&mut self, outcome: Eval, departed: Vec<Departure>, mark: usize, span: Span) -> Eval<Side> {
        let (value, last) = match outcome {
            Ok(value) => (Some(value), None),
            Err(Exit::Left(way)) => (None, Some(way)),
            Err(error) => return Err(error),
        };
        let mut exits: Vec<(Way, NodeId)> = Vec::new();
        let mut staying = self.builder.bool(true);
        let alone = |group: Option<RegionId>| group.is_some() && departed.iter().all(|d| d.group == group);
        for departure in &departed {
            let leaves = match alone(departure.group) {
                true => departure.condition,
                false => self.and(staying, departure.condition),
            };
            self.add_exit(&mut exits, &departure.way, leaves, span)?;
            let stays = self.not(departure.condition);
            staying = self.and(staying, stays);
        }
        if let Some(way) = &last {
            self.add_exit(&mut exits, way, staying, span)?;
        }
        self.scope.leave(mark);
        let mut states = vec![State {
            way: last,
            scope: self.scope.clone(),
        }];
        for mut departure in departed.into_iter().rev() {
            departure.scope.leave(mark);
            states.push(State {
                way: Some(departure.way),
                scope: departure.scope.clone(),
            });
            self.scope.fill_unset(&mut departure.scope);
            let theirs = (departure.scope, Value::unit());
            self.join(departure.condition, None, theirs, Value::unit(), span)?;
        }
        Ok(Side { value, exits, states })
    }

    fn add_exit(&mut self, exits: &mut Vec<(Way, NodeId)>, way: &Way, leaves: NodeId, span: Span) -> Eval<()> {
        let Some(k) = exits.iter().position(|(known, _)| known.is_like(way)) else {
            exits.push((way.clone(), leaves));
            return Ok(());
        };
        let (known, before) = exits[k].clone();
        if let (Way::Return(first), Way::Return(second)) = (&known, way) {
            let scope = self.scope.clone();
            let value = self.join(before, None, (scope, first.clone()), second.clone(), span)?;
            exits[k].0 = Way::Return(value);
        }
        exits[k].1 = self.or(before, leaves);
        Ok(())
    }

    /// Joins two sides that have been kept as regions: exits become departures.
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
                pairs.push(self.paired(a.as_ref(), b.as_ref()));
                true
            }
        };
        let mut ways: Vec<Way> = left.exits.iter().map(|(way, _)| way.clone()).collect();
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
            let flag = |exit: &Option<(Way, NodeId)>| exit.as_ref().map_or(never, |(_, flag)| *flag);
            let (first, second) = (flag(&a), flag(&b));
            flags.push(match (self.known_bool(first), self.known_bool(second)) {
                (Some(true), Some(false)) if ways.len() == 1 => Some(condition),
                (Some(false), Some(true)) if ways.len() == 1 => Some(negated),
                _ => {
                    pairs.push((Value::Node(first), Value::Node(second)));
                    None
                }
            });
            if matches!(way, Way::Return(_)) {
                let value = |exit: Option<(Way, NodeId)>| exit.map(|(way, _)| way.value());
                pairs.push(self.paired(value(a).as_ref(), value(b).as_ref()));
            }
        }
        self.scope.fill_unset(&mut left_scope);
        let joined = self.join_all(condition, Some(regions), &left_scope, pairs, span)?;
        let mut joined = joined.into_iter();
        let mut value = goes_on.then(|| joined.next()).flatten();
        let of_sides: Vec<&Value> = left.value.iter().chain(&right.value).collect();
        if let Some(refined) = value.as_ref().and_then(|value| self.refined(value, &of_sides)) {
            value = Some(refined);
        }
        let states: Vec<State> = left.states.into_iter().chain(right.states).collect();
        let merged = self.scope.clone();
        let mut departed = Vec::new();
        for (way, flag) in ways.into_iter().zip(flags) {
            let condition = match flag {
                Some(known) => known,
                None => self.node(&joined.next().unwrap_or(Value::Poison), span)?,
            };
            let way = match way {
                Way::Return(_) => Way::Return(joined.next().unwrap_or(Value::Poison)),
                other => other,
            };
            if flag.is_none() {
                self.name_exit(condition, &way, span);
            }
            let scope = self.in_state(&merged, &states, Some(&way));
            let group = Some(regions.0);
            departed.push(Departure {
                condition,
                way,
                scope,
                group,
            });
        }
        match value {
            Some(value) => {
                self.scope = self.in_state(&merged, &states, None);
                self.departed.extend(departed);
                Ok(value)
            }
            None => self.depart(departed),
        }
    }

    /// Two values that leave the sides of a branch; where there is none on a side, any will do.
    fn paired(&mut self, a: Option<&Value>, b: Option<&Value>) -> (Value, Value) {
        match (a, b) {
            (Some(a), Some(b)) => (a.clone(), b.clone()),
            (Some(a), None) => (a.clone(), self.blank(a)),
            (None, Some(b)) => (self.blank(b), b.clone()),
            (None, None) => (Value::unit(), Value::unit()),
        }
    }

    /// A value of the same shape that nobody looks at.
    pub fn blank(&mut self, value: &Value) -> Value {
        let mut leaves = Vec::new();
        value.flatten(&mut leaves);
        let blanks: Vec<NodeId> = leaves.into_iter().map(|id| self.unused(self.ty(id))).collect();
        value.unflatten(&mut blanks.into_iter())
    }

    /// Any value of a type.
    pub fn unused(&mut self, ty: Type) -> NodeId {
        let Type::Array { len, .. } = ty else {
            return self.builder.add(Op::Unused, Vec::new(), ty);
        };
        let element = self.builder.add(Op::Unused, Vec::new(), ty.element());
        self.builder.add(Op::MakeArray, vec![element; len as usize], ty)
    }

    /// Names the booleans that say who has left.
    pub fn name_exit(&mut self, flag: NodeId, way: &Way, span: Span) {
        let name = match way {
            Way::Break(_) => "stopped",
            Way::Continue(_) => "skipped",
            Way::Return(_) => "returned",
        };
        self.name_params(&Value::Node(flag), name, span);
        if let Way::Return(value) = way {
            self.name_params(value, "result", span);
        }
    }

    /// `!a`.
    pub fn not(&mut self, a: NodeId) -> NodeId {
        self.builder.add(Op::Unary(UnaryOp::Not), [a], Type::BOOL)
    }

    /// `a && b`.
    pub fn and(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.known_bool(a), self.known_bool(b)) {
            (Some(true), _) => b,
            (Some(false), _) | (_, Some(true)) => a,
            (_, Some(false)) => b,
            _ => self.builder.add(Op::Binary(BinaryOp::And), [a, b], Type::BOOL),
        }
    }

    /// `a || b`.
    pub fn or(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.known_bool(a), self.known_bool(b)) {
            (Some(false), _) => b,
            (Some(true), _) | (_, Some(false)) => a,
            (_, Some(true)) => b,
            _ => self.builder.add(Op::Binary(BinaryOp::Or), [a, b], Type::BOOL),
        }
    }
}

/// Whether a block never comes to its end.
pub fn always_leaves(block: &Block) -> bool {
    let last = block.value.as_deref().or(match block.statements.last() {
        Some(Statement::Expr(e)) => Some(e),
        _ => None,
    });
    last.is_some_and(leaves)
}

/// Whether an expression never gives a value.
pub fn leaves(e: &Expr) -> bool {
    match &e.kind {
        ExprKind::Return(_) | ExprKind::Break(_) | ExprKind::Continue(_) => true,
        ExprKind::Block(block) => always_leaves(block),
        ExprKind::If(_, then, Some(otherwise), _) => always_leaves(then) && leaves(otherwise),
        ExprKind::Match(_, arms, _) => !arms.is_empty() && arms.iter().all(|arm| leaves(&arm.body)),
        _ => false,
    }
}

/// Whether one side of an `if` never comes to its end, or one of the `else if`s that follow.
pub fn has_exits(then: &Block, otherwise: Option<&Expr>) -> bool {
    always_leaves(then)
        || otherwise.is_some_and(|other| match &other.kind {
            ExprKind::If(_, then, otherwise, _) => has_exits(then, otherwise.as_deref()),
            _ => leaves(other),
        })
}
