//! Ranges: methods, values, and trip counts of loops over them.
//!
//! A loop left in the shader that is not simply `start..end` counts its iterations from 0, and computes the source's
//! counter from that count with wrapping arithmetic. The trip count is computed without a difference that could overflow,
//! so that ranges up to the ends of their type run as in Rust.

use super::Evaluator;
use super::value::{Eval, Exit, Range, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::Expr;
use crate::ir::{BinaryOp, NodeId, Op, Scalar, Type};

/// Number of iterations above which a loop is considered a mistake.
const MAX_ROUNDS: i128 = 1_000_000;

/// Form of a loop over a range in the graph.
pub struct LoopPlan {
    /// Type in which iterations are counted.
    pub counter_type: Type,
    /// Number of iterations, of type `own`.
    pub trips: NodeId,
    /// First counter and one past the last, if the loop needs no count of its own.
    pub plain_bounds: Option<(NodeId, NodeId)>,
    /// Smallest value, and the end.
    start: NodeId,
    end: NodeId,
    /// First value of the loop.
    from: NodeId,
    /// `true` if the values decrease.
    down: bool,
    /// Distance between values.
    step: u32,
    /// `true` if the values come last to first.
    reversed: bool,
    /// `true` if a constant counter is an untyped integer, which stands for `usize`.
    index: bool,
}

impl LoopPlan {
    /// Nodes of the smallest value and the end.
    pub fn bounds(&self) -> [NodeId; 2] {
        [self.start, self.end]
    }
}

impl Evaluator<'_> {
    /// Evaluates `start..end` or `start..=end`.
    pub fn eval_range(&mut self, start: &Expr, end: &Expr, inclusive: bool) -> Eval {
        let (start, end) = (self.eval_value(start)?, self.eval_value(end)?);
        Ok(Value::Range(Range {
            start: Box::new(start),
            end: Box::new(end),
            inclusive,
            down: false,
            step: 1,
            reversed: false,
        }))
    }

    /// Evaluates a range method.
    pub fn range_method(&mut self, range: &Range, name: &str, args: &[Value], span: Span) -> Eval {
        let mut range = range.clone();
        let plain = range.step == 1 && !range.down;
        match (name, args) {
            ("rev", []) if range.step == 1 => range.down = !range.down,
            ("rev", []) => range.reversed = !range.reversed,
            ("step_by", [step]) => match self.known_int(step) {
                Some(step @ 1..) if !range.reversed => range.step = range.step.saturating_mul(step),
                Some(1..) => {
                    return Err(Diagnostic::error_at(
                        Code::NotInLanguage,
                        span,
                        "`step_by` of a range that is stepped and reversed",
                    )
                    .label("a second step")
                    .help("write one `step_by`, before or after `rev`")
                    .into());
                }
                _ => {
                    let error = Diagnostic::error_at(
                        Code::RuntimeValue,
                        span,
                        "`step_by` needs a step that is a constant of at least 1",
                    )
                    .label("of this step");
                    return Err(self.demand_of(&[step], error));
                }
            },
            ("contains", [x]) if plain => {
                let below = if range.inclusive { BinaryOp::Le } else { BinaryOp::Lt };
                let from = self.eval_binary(BinaryOp::Ge, x, &range.start, span)?;
                let to = self.eval_binary(below, x, &range.end, span)?;
                return self.eval_binary(BinaryOp::And, &from, &to, span);
            }
            _ => {
                return Err(
                    Diagnostic::error_at(Code::UnknownMethod, span, format!("a range has no method `{name}`"))
                        .help("ranges have `rev`, `step_by` and `contains`")
                        .into(),
                );
            }
        }
        Ok(Value::Range(range))
    }

    /// Type of a range's counter, and whether a constant counter has no type of its own.
    fn counted_in(&self, range: &Range, span: Span) -> Eval<(Scalar, bool)> {
        let mut kinds = Vec::new();
        for end in [&range.start, &range.end] {
            match &**end {
                Value::Int(_) => {}
                Value::Poison => return Err(Exit::Noted),
                Value::Node(id) if matches!(self.ty(*id), Type::I32 | Type::U32 | Type::USIZE) => {
                    kinds.extend(self.ty(*id).scalar_kind())
                }
                other => {
                    let found = match other {
                        Value::Node(id) => self.ty(*id).in_rust(),
                        other => other.describe(),
                    };
                    return Err(Diagnostic::error_at(
                        Code::MismatchedTypes,
                        span,
                        format!("a range of {found} cannot be iterated"),
                    )
                    .label("not of integers")
                    .help("convert its ends with `as i32`, `as u32` or `as usize`")
                    .into());
                }
            }
        }
        match kinds[..] {
            [] => Ok((Scalar::Usize, true)),
            [kind] => Ok((kind, kind == Scalar::Usize)),
            [a, b] if a == b => Ok((a, a == Scalar::Usize)),
            _ => Err(Diagnostic::error_at(
                Code::MismatchedTypes,
                span,
                "a range from an i32 to a u32, or the other way round",
            )
            .label("two types")
            .help("convert one of them with `as`")
            .into()),
        }
    }

    /// Constant counter value.
    fn known_counter(&mut self, n: i64, kind: Scalar, index: bool) -> Value {
        if index {
            return Value::Int(n);
        }
        Value::Node(self.builder.constant(Type::scalar(kind), [n as u32, 0, 0, 0]))
    }

    /// Values of a range in loop order, if both its ends are constants.
    pub fn range_values(&mut self, range: &Range, span: Span) -> Eval<Option<Vec<Value>>> {
        let (kind, index) = self.counted_in(range, span)?;
        let Some((start, end)) = self.known_int(&range.start).zip(self.known_int(&range.end)) else {
            return Ok(None);
        };
        let rounds = iteration_count(range, start, end);
        if rounds > MAX_ROUNDS {
            return Err(
                Diagnostic::error_at(Code::TooManyIterations, span, format!("a loop of {rounds} iterations"))
                    .label("too many")
                    .help(format!("a loop may have up to {MAX_ROUNDS}"))
                    .into(),
            );
        }
        let (step, last) = (i128::from(range.step), last_value(range, end));
        let mut values: Vec<i128> = (0..rounds)
            .map(|k| match range.down {
                true => last - k * step,
                false => i128::from(start) + k * step,
            })
            .collect();
        if range.reversed {
            values.reverse();
        }
        let values = values.into_iter().map(|n| self.known_counter(n as i64, kind, index));
        Ok(Some(values.collect()))
    }

    /// Plans the form of a loop over a range in the graph.
    pub fn plan_loop(&mut self, range: &Range, span: Span) -> Eval<LoopPlan> {
        let (kind, index) = self.counted_in(range, span)?;
        let ty = Type::scalar(kind);
        let start = self.end_of_range(&range.start, kind, span)?;
        let end = self.end_of_range(&range.end, kind, span)?;
        let known = self
            .known_int(&Value::Node(start))
            .zip(self.known_int(&Value::Node(end)));
        let limit = match kind {
            Scalar::U32 => i64::from(u32::MAX),
            Scalar::Usize => i64::MAX,
            _ => i64::from(i32::MAX),
        };
        let upright = !range.down && !range.reversed && range.step == 1;
        let plain = match known {
            _ if !upright => None,
            _ if !range.inclusive => Some((start, end)),
            // The value after a constant end, if there is one.
            Some((_, last)) if last < limit => {
                let past = self.int_node(last + 1, kind, span)?;
                Some((start, past))
            }
            _ => None,
        };
        // Counts that fit an i32 need no conversion.
        let from_zero = self.known_int(&Value::Node(start)) == Some(0) && !range.inclusive;
        let counted = known.is_some() || (from_zero && ty != Type::USIZE);
        let own = if counted { ty } else { Type::U32 };
        let trips = match known.and_then(|(start, end)| u32::try_from(iteration_count(range, start, end)).ok()) {
            // The count is small enough, or the range would have been rejected.
            Some(trips) => self.integer_constant(trips, own),
            None => self.build_trip_count(range, (start, end), own),
        };
        let from = if range.down && !range.inclusive {
            self.build_integer_op(BinaryOp::Sub, end, 1)
        } else if range.down {
            end
        } else {
            start
        };
        Ok(LoopPlan {
            counter_type: own,
            trips,
            plain_bounds: plain,
            start,
            end,
            from,
            down: range.down,
            step: range.step as u32,
            reversed: range.reversed,
            index,
        })
    }

    fn end_of_range(&mut self, value: &Value, kind: Scalar, span: Span) -> Eval<NodeId> {
        match value {
            Value::Int(n) => self.int_node(*n, kind, span),
            other => self.value_node(other, span),
        }
    }

    /// Builds the trip count in the type `own`; 0 for an empty or reversed range.
    fn build_trip_count(&mut self, range: &Range, (start, end): (NodeId, NodeId), own: Type) -> NodeId {
        let from_zero = self.known_int(&Value::Node(start)) == Some(0);
        if from_zero && !range.inclusive && range.step == 1 {
            // Only an i32 can be less than 0. For any other type, such an end leaves the range empty.
            return match self.ty(start) {
                Type::I32 => self.builder.add(Op::Binary(BinaryOp::Max), [end, start], own),
                _ => self.counted_end(end, own),
            };
        }
        let holds = if range.inclusive { BinaryOp::Le } else { BinaryOp::Lt };
        let any = self.builder.add(Op::Binary(holds), [start, end], Type::BOOL);
        let (zero, one) = (self.integer_constant(0, own), self.integer_constant(1, own));
        // The distance between two i32 fits a u32, and wraps to it.
        let [low, high] = [start, end].map(|id| self.counted_end(id, own));
        let distance = self.builder.add(Op::Binary(BinaryOp::Sub), [high, low], own);
        let trips = match (range.step, range.inclusive) {
            (1, false) => distance,
            (1, true) => {
                // The number of all values of a type does not fit that type: the last value is dropped.
                let all = self.may_be_all(range, start, end);
                let distance = if all {
                    let most = self.integer_constant(u32::MAX - 1, own);
                    self.builder.add(Op::Binary(BinaryOp::Min), [distance, most], own)
                } else {
                    distance
                };
                self.builder.add(Op::Binary(BinaryOp::Add), [distance, one], own)
            }
            (step, inclusive) => {
                let last = match inclusive {
                    true => distance,
                    false => self.builder.add(Op::Binary(BinaryOp::Sub), [distance, one], own),
                };
                let steps = match u32::try_from(step) {
                    Ok(step) => {
                        let step = self.integer_constant(step, own);
                        self.builder.add(Op::Binary(BinaryOp::Div), [last, step], own)
                    }
                    Err(_) => zero,
                };
                self.builder.add(Op::Binary(BinaryOp::Add), [steps, one], own)
            }
        };
        self.builder.add(Op::Select, [any, trips, zero], own)
    }

    /// Converts an end of a range to the type in which iterations are counted. A loop of 2^32 iterations would not end, so
    /// the upper bits of a `usize` are dropped.
    pub fn counted_end(&mut self, end: NodeId, own: Type) -> NodeId {
        match (self.ty(end), own) {
            (Type::USIZE, Type::U32) => self.builder.add(Op::Bitcast, [end], own),
            _ => self.convert_node(end, own.scalar_kind().unwrap_or(Scalar::U32)),
        }
    }

    /// Returns whether an inclusive range may contain all values of its type, as far as its ends are constants.
    fn may_be_all(&self, range: &Range, start: NodeId, end: NodeId) -> bool {
        let (least, most) = match self.ty(start) {
            Type::U32 => (0, i64::from(u32::MAX)),
            // A loop of 2^64 iterations would not end.
            Type::USIZE => return false,
            _ => (i64::from(i32::MIN), i64::from(i32::MAX)),
        };
        let may = |id: NodeId, n: i64| self.known_int(&Value::Node(id)).is_none_or(|known| known == n);
        range.inclusive && may(start, least) && may(end, most)
    }

    /// Builds the source's counter in iteration `own`.
    pub fn counter_at(&mut self, course: &LoopPlan, own: NodeId) -> Value {
        let ty = self.ty(course.from);
        let mut at = own;
        if course.reversed {
            let one = self.integer_constant(1, course.counter_type);
            let last = self
                .builder
                .add(Op::Binary(BinaryOp::Sub), [course.trips, one], course.counter_type);
            at = self
                .builder
                .add(Op::Binary(BinaryOp::Sub), [last, own], course.counter_type);
        }
        if course.counter_type != ty {
            at = self.convert_node(at, ty.scalar_kind().unwrap_or(Scalar::I32));
        }
        let step = self.integer_constant(course.step, ty);
        let far = self.builder.add(Op::Binary(BinaryOp::Mul), [at, step], ty);
        let towards = if course.down { BinaryOp::Sub } else { BinaryOp::Add };
        let counter = self.builder.add(Op::Binary(towards), [course.from, far], ty);
        if ty == Type::USIZE {
            self.facts.counters.insert(counter, (course.start, course.end));
        }
        self.as_counter(counter, course.index)
    }

    /// Counter as the loop's body expects it: a constant `usize` is an untyped integer.
    pub fn as_counter(&self, counter: NodeId, index: bool) -> Value {
        match self.known_int(&Value::Node(counter)) {
            Some(known) if index => Value::Int(known),
            _ => Value::Node(counter),
        }
    }

    /// Adds a constant integer.
    pub fn integer_constant(&mut self, n: u32, ty: Type) -> NodeId {
        self.builder.constant(ty, [n, 0, 0, 0])
    }

    /// Builds `x op n`, in the type of `x`.
    pub fn build_integer_op(&mut self, op: BinaryOp, x: NodeId, n: u32) -> NodeId {
        let ty = self.ty(x);
        let n = self.integer_constant(n, ty);
        self.builder.add(Op::Binary(op), [x, n], ty)
    }
}

/// Last value of a range with a constant end.
fn last_value(range: &Range, end: i64) -> i128 {
    i128::from(end) - i128::from(!range.inclusive)
}

/// Trip count of a loop over a range with constant ends.
fn iteration_count(range: &Range, start: i64, end: i64) -> i128 {
    let distance = last_value(range, end) - i128::from(start);
    if distance < 0 {
        0
    } else {
        distance / i128::from(range.step) + 1
    }
}

impl LoopPlan {
    /// Returns whether a constant counter is an untyped integer.
    pub fn of_indices(&self) -> bool {
        self.index
    }
}
