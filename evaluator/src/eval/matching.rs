//! `match`, and the constructs lowered to it: `if let`, `let ... else`, `matches!`.
//!
//! The arms form a chain of conditions. A compile-time constant selects an arm during evaluation. For a runtime condition,
//! both the arm and all later arms are evaluated.

use super::Evaluator;
use super::control::Tail;
use super::sequence::has_choices;
use super::value::{Eval, Exit, Step, Value};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::tree::{Arm, Expr, ExprKind, Pattern};
use crate::ir::{BinaryOp, NodeId};
use crate::policy::Branches;
use std::borrow::Cow;

/// Maximum number of alternatives of one pattern that bind names.
const MAX_ALTERNATIVES: usize = 64;

/// A pattern without `|` around bindings, and its arm.
struct Case<'a> {
    pattern: Cow<'a, Pattern>,
    arm: &'a Arm,
}

impl Evaluator<'_> {
    pub fn eval_match(
        &mut self,
        subject: &Expr,
        arms: &[Arm],
        attribute: Option<Branches>,
        tail: Tail<'_>,
        span: Span,
    ) -> Eval {
        let value = self.eval_expr(subject)?;
        let mut arms = arms;
        // Most arms match certainly, or certainly do not.
        while let Some((arm, rest)) = arms.split_first()
            && arm.guard.is_none()
            && !binds_in_or(&arm.pattern)
        {
            let takes = self.test_pattern(&arm.pattern, &value, span)?;
            match self.known_bool(takes) {
                Some(true) => {
                    return self.with_bound(&arm.pattern, &value, span, |e| e.expr_in(&arm.body, tail));
                }
                Some(false) => arms = rest,
                None => break,
            }
        }
        let mut cases = Vec::with_capacity(arms.len());
        for arm in arms {
            if !binds_in_or(&arm.pattern) {
                let pattern = Cow::Borrowed(&arm.pattern);
                cases.push(Case { pattern, arm });
                continue;
            }
            let alternatives = expand_alternatives(&arm.pattern);
            if alternatives.len() > MAX_ALTERNATIVES {
                return Err(Diagnostic::error_at(
                    Code::TooLarge,
                    arm.body.span,
                    format!("a pattern of more than {MAX_ALTERNATIVES} alternatives that bind names"),
                )
                .label("of this arm")
                .help("write an arm for each, and what they share as a function")
                .into());
            }
            cases.extend(alternatives.into_iter().map(|pattern| Case {
                pattern: Cow::Owned(pattern),
                arm,
            }));
        }
        let keep = self.policy.keeps_branch(attribute);
        self.eval_cases(&value, &cases, keep, tail, span)
    }

    /// Evaluates the first case that matches the value.
    fn eval_cases(&mut self, value: &Value, cases: &[Case<'_>], keep: bool, tail: Tail<'_>, span: Span) -> Eval {
        self.count_step(span)?;
        let Some((case, rest)) = cases.split_first() else {
            return Err(Diagnostic::error_at(
                Code::NonExhaustive,
                span,
                format!("no arm of this `match` takes {}", self.describe_known(value)),
            )
            .help("add an arm for it, or `_`")
            .into());
        };
        let mut condition = self.test_pattern(&case.pattern, value, span)?;
        if let Some(guard) = &case.arm.guard
            && self.known_bool(condition) != Some(false)
        {
            let guarded = self.eval_short_circuit(
                true,
                condition,
                |e| e.with_bound(&case.pattern, value, span, |e| e.eval_value(guard)),
                span,
            )?;
            condition = self.value_node(&guarded, guard.span)?;
        }
        let body = |e: &mut Self| e.with_bound(&case.pattern, value, span, |e| e.expr_in(&case.arm.body, tail));
        match self.known_bool(condition) {
            Some(true) => body(self),
            Some(false) => self.eval_cases(value, rest, keep, tail, span),
            // The arms are exhaustive, so the last one matches whatever remains.
            None if case.arm.guard.is_none() && self.is_last(value, rest, span)? => body(self),
            None => self.eval_branch(tail, condition, keep, span, body, |e| {
                e.eval_cases(value, rest, keep, tail, span)
            }),
        }
    }

    /// Returns whether no later case can match: there is none, or all are variants that the value is known not to be.
    fn is_last(&mut self, value: &Value, rest: &[Case<'_>], span: Span) -> Eval<bool> {
        if rest.is_empty() {
            return Ok(true);
        }
        if !has_choices(value) {
            return Ok(false);
        }
        for case in rest {
            let takes = self.test_pattern(&case.pattern, value, span)?;
            if self.known_bool(takes) != Some(false) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Evaluates code in the scope of the names that a matching pattern binds.
    fn with_bound(
        &mut self,
        pattern: &Pattern,
        value: &Value,
        span: Span,
        evaluate: impl FnOnce(&mut Self) -> Eval,
    ) -> Eval {
        let mark = self.scope.enter();
        let bound = self.bind_matched(pattern, value.clone(), span);
        let result = bound.and_then(|()| evaluate(self));
        self.scope.leave(mark);
        result
    }

    /// Builds the test of a value against a pattern: a boolean, constant or not. Binds nothing.
    fn test_pattern(&mut self, pattern: &Pattern, value: &Value, span: Span) -> Eval<NodeId> {
        match pattern {
            Pattern::Wild | Pattern::Rest | Pattern::Name(..) => Ok(self.builder.bool(true)),
            Pattern::At(_, _, inner, _) => self.test_pattern(inner, value, span),
            Pattern::Ref(inner, at) => {
                let value = self.deref_value(value.clone(), *at)?;
                self.test_pattern(inner, &value, span)
            }
            Pattern::Or(cases) => {
                let mut any = self.builder.bool(false);
                for case in cases {
                    if self.known_bool(any) == Some(true) {
                        break;
                    }
                    let takes = self.test_pattern(case, value, span)?;
                    any = self.build_logical(BinaryOp::Or, any, takes, span)?;
                }
                Ok(any)
            }
            Pattern::Tuple(parts, at) => match &self.taken_apart(value.clone(), parts, *at)? {
                Value::Tuple(values) if Pattern::part_ranges(parts, values.len()).is_some() => {
                    self.test_all(zip_patterns(parts, values), span)
                }
                other => {
                    Err(
                        Diagnostic::error_at(Code::Pattern, span, format!("a tuple pattern on {}", other.describe()))
                            .into(),
                    )
                }
            },
            Pattern::Array(parts, at) => {
                let elements = self.elements_of_pattern(value.clone(), parts, *at)?;
                self.test_all(zip_patterns(parts, &elements), span)
            }
            Pattern::Struct(path, fields, _) => {
                let variant = self.library.find_variant(path).map(|(_, k, _)| k);
                let mut is = self.builder.bool(true);
                if let Some(k) = variant {
                    is = self.test_variant(value, k, span)?;
                    if self.known_bool(is) == Some(false) {
                        return Ok(is);
                    }
                }
                let mut pairs = Vec::new();
                for (name, pattern) in fields {
                    let step = match variant {
                        Some(k) => Step::VariantField(k, name.clone()),
                        None => Step::Field(name.clone()),
                    };
                    pairs.push((pattern, self.part_of_value(value, step, span)?));
                }
                let fields = self.test_all(pairs, span)?;
                Ok(self.and(is, fields))
            }
            Pattern::Range(low, high, inclusive) => {
                let value = self.deref_value(value.clone(), span)?;
                let mut inside = self.builder.bool(true);
                let below = if *inclusive { BinaryOp::Le } else { BinaryOp::Lt };
                for (op, end) in [(BinaryOp::Ge, low), (below, high)] {
                    let Some(end) = end else { continue };
                    let bound = self.eval_expr(end)?;
                    let holds = self.eval_binary(op, &value, &bound, end.span)?;
                    let holds = self.value_node(&holds, end.span)?;
                    inside = self.build_logical(BinaryOp::And, inside, holds, span)?;
                }
                Ok(inside)
            }
            Pattern::Value(expr) => {
                if let ExprKind::Path(path) = &expr.kind
                    && let Some((_, k, _)) = self.library.find_variant(path)
                {
                    return self.test_variant(value, k, span);
                }
                let expected = self.eval_expr(expr)?;
                let value = self.deref_value(value.clone(), span)?;
                let same = self.eval_binary(BinaryOp::Eq, &value, &expected, expr.span)?;
                self.value_node(&same, expr.span)
            }
        }
    }

    /// Builds the test for a variant.
    fn test_variant(&mut self, value: &Value, variant: usize, span: Span) -> Eval<NodeId> {
        match self.deref_value(value.clone(), span)? {
            Value::Enum(choice) => Ok(self.is_variant(&choice, variant)),
            Value::Poison => Err(Exit::Noted),
            other => Err(Diagnostic::error_at(
                Code::Pattern,
                span,
                format!("a pattern of an enum for {}", other.describe()),
            )
            .into()),
        }
    }

    /// Builds the test of each value against its pattern. Stops after one that is known not to match.
    fn test_all(&mut self, pairs: Vec<(&Pattern, Value)>, span: Span) -> Eval<NodeId> {
        let mut all = self.builder.bool(true);
        for (pattern, value) in pairs {
            if self.known_bool(all) == Some(false) {
                break;
            }
            let takes = self.test_pattern(pattern, &value, span)?;
            all = self.build_logical(BinaryOp::And, all, takes, span)?;
        }
        Ok(all)
    }

    fn build_logical(&mut self, op: BinaryOp, left: NodeId, right: NodeId, span: Span) -> Eval<NodeId> {
        let value = self.eval_binary(op, &Value::Node(left), &Value::Node(right), span)?;
        self.value_node(&value, span)
    }
}

/// Pairs patterns with the parts of a value; `..` skips any number.
fn zip_patterns<'p>(patterns: &'p [Pattern], parts: &[Value]) -> Vec<(&'p Pattern, Value)> {
    let each = Pattern::part_ranges(patterns, parts.len()).into_iter().flatten();
    let each = each.filter(|(pattern, _)| !pattern.is_rest());
    each.map(|(pattern, taken)| (pattern, parts[taken.start].clone()))
        .collect()
}

/// Expands a pattern to patterns without `|` around bindings.
fn expand_alternatives(pattern: &Pattern) -> Vec<Pattern> {
    if !binds_in_or(pattern) {
        return vec![pattern.clone()];
    }
    let each = |parts: &[Pattern]| {
        let mut rows: Vec<Vec<Pattern>> = vec![Vec::new()];
        for part in parts {
            let choices = expand_alternatives(part);
            let longer = rows.iter().flat_map(|row| {
                choices
                    .iter()
                    .map(move |choice| [row.as_slice(), std::slice::from_ref(choice)].concat())
            });
            rows = longer.take(MAX_ALTERNATIVES + 1).collect();
        }
        rows
    };
    match pattern {
        Pattern::Or(cases) => cases.iter().flat_map(expand_alternatives).collect(),
        Pattern::Tuple(parts, at) => each(parts).into_iter().map(|row| Pattern::Tuple(row, *at)).collect(),
        Pattern::Array(parts, at) => each(parts).into_iter().map(|row| Pattern::Array(row, *at)).collect(),
        Pattern::Struct(path, fields, at) => {
            let parts: Vec<Pattern> = fields.iter().map(|(_, part)| part.clone()).collect();
            let names = || fields.iter().map(|(name, _)| name.clone());
            let rows = each(&parts).into_iter();
            rows.map(|row| Pattern::Struct(path.clone(), names().zip(row).collect(), *at))
                .collect()
        }
        Pattern::Ref(inner, at) => {
            let inner = expand_alternatives(inner).into_iter();
            inner.map(|p| Pattern::Ref(Box::new(p), *at)).collect()
        }
        Pattern::At(name, mutable, inner, at) => {
            let inner = expand_alternatives(inner).into_iter();
            inner
                .map(|p| Pattern::At(name.clone(), *mutable, Box::new(p), *at))
                .collect()
        }
        Pattern::Name(..) | Pattern::Wild | Pattern::Rest | Pattern::Value(_) | Pattern::Range(..) => {
            vec![pattern.clone()]
        }
    }
}

/// Returns whether a `|` anywhere in a pattern binds names.
fn binds_in_or(pattern: &Pattern) -> bool {
    match pattern {
        Pattern::Or(cases) => cases.iter().any(binds_names),
        Pattern::Tuple(parts, _) | Pattern::Array(parts, _) => parts.iter().any(binds_in_or),
        Pattern::Struct(_, fields, _) => fields.iter().any(|(_, part)| binds_in_or(part)),
        Pattern::Ref(inner, _) | Pattern::At(_, _, inner, _) => binds_in_or(inner),
        Pattern::Name(..) | Pattern::Wild | Pattern::Rest | Pattern::Value(_) | Pattern::Range(..) => false,
    }
}

fn binds_names(pattern: &Pattern) -> bool {
    match pattern {
        Pattern::Name(..) | Pattern::At(..) => true,
        Pattern::Or(parts) | Pattern::Tuple(parts, _) | Pattern::Array(parts, _) => parts.iter().any(binds_names),
        Pattern::Struct(_, fields, _) => fields.iter().any(|(_, part)| binds_names(part)),
        Pattern::Ref(inner, _) => binds_names(inner),
        Pattern::Wild | Pattern::Rest | Pattern::Value(_) | Pattern::Range(..) => false,
    }
}
