//! Contribution of each loop to the size of a kernel.

use super::demand::UnrollReason;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::eval::Evaluator;
use crate::policy::{self, Unroll};
use std::collections::HashMap;

/// Help for a kernel that is too large.
pub const BUDGET_HELP: &str = "run loops over fewer values, leave the largest one in the shader with `#[cfg_attr(false, unroll(none))]`, or raise the budget";

/// A loop of the source, and how it was evaluated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoopReport {
    /// Function that contains the loop.
    pub function: String,
    /// Counter of the loop, or `while`.
    pub counter: String,
    /// Location of the loop.
    pub span: Span,
    /// Unroll mode that was used most recently.
    pub unroll: Unroll,
    /// Reason why the loop was unrolled although it was requested to stay in the shader.
    pub reason: Option<String>,
    /// Number of copies of the body that were evaluated, over all visits: one for each iteration of an unrolled loop, one
    /// for a loop left in the shader.
    pub copies: u64,
    /// Operations that the body produced, without those of nested loops.
    pub operations: u64,
}

impl LoopReport {
    /// `function.counter`, as policies name it.
    pub fn policy_path(&self) -> String {
        format!("{}.{}", self.function, self.counter)
    }
}

/// All loops that were reached.
#[derive(Clone, Debug, Default)]
pub struct LoopTracker {
    reports: Vec<LoopReport>,
    /// Loops being evaluated: index, number of operations at the start, and operations of nested loops.
    open: Vec<(usize, usize, usize)>,
    /// Failed attempts to leave each loop in the shader: their number, and the reason for the last one.
    failures: HashMap<Span, (u32, UnrollReason)>,
    /// Attempts to unroll each loop that were given up because its end is a runtime value.
    open_ends: HashMap<Span, u32>,
    /// Errors to report if there are no others: the code after a loop needs it unrolled, but the loop was explicitly
    /// requested to stay.
    deferred: Vec<Diagnostic>,
}

/// Number of failed attempts to leave a loop in the shader, after which it is always unrolled. Without this limit, nested
/// loops would be tried twice a level.
const MAX_FAILURES: u32 = 3;

/// Number of iterations after which a `while` with exits under runtime conditions is assumed to end at run time only.
const MAX_OPEN_ITERATIONS: u64 = 256;

/// Minimum of that number after failed attempts. Without a decrease, nested loops would be tried 256 times a level.
const MIN_OPEN_ITERATIONS: u64 = 4;

impl LoopTracker {
    /// Enters a loop when the graph has `operations` operations.
    pub fn enter_loop(&mut self, function: &str, counter: &str, span: Span, operations: usize) {
        let known = self.reports.iter().position(|r| r.span == span);
        let index = known.unwrap_or_else(|| {
            self.reports.push(LoopReport {
                function: function.to_owned(),
                counter: counter.to_owned(),
                span,
                unroll: Unroll::Full,
                reason: None,
                copies: 0,
                operations: 0,
            });
            self.reports.len() - 1
        });
        self.open.push((index, operations, 0));
    }

    /// Counts one more evaluation of the innermost loop's body.
    pub fn record_iteration(&mut self) {
        if let Some((index, ..)) = self.open.last() {
            self.reports[*index].copies += 1;
        }
    }

    /// Records why a loop is unrolled. The first reason is kept.
    pub fn record_reason(&mut self, span: Span, reason: String) {
        if let Some(report) = self.reports.iter_mut().find(|r| r.span == span) {
            report.reason.get_or_insert(reason);
        }
    }

    /// Records that an attempt to leave a loop in the shader failed.
    pub fn record_failure(&mut self, span: Span, why: &UnrollReason) {
        let entry = self.failures.entry(span).or_insert_with(|| (0, why.clone()));
        *entry = (entry.0 + 1, why.clone());
    }

    /// Reason why a loop is no longer tried in the shader; `None` while it may be tried.
    pub fn previous_failure(&self, span: Span) -> Option<UnrollReason> {
        let (times, why) = self.failures.get(&span)?;
        (*times >= MAX_FAILURES).then(|| why.clone())
    }

    /// Number of iterations after which an attempt to unroll a loop is given up, if an exit was taken under a runtime
    /// condition.
    pub fn iteration_limit(&self, span: Span) -> u64 {
        let failed = self.open_ends.get(&span).copied().unwrap_or(0);
        (MAX_OPEN_ITERATIONS >> (2 * failed).min(63)).max(MIN_OPEN_ITERATIONS)
    }

    /// Records that an attempt to unroll a loop was given up.
    pub fn record_open_end(&mut self, span: Span) {
        *self.open_ends.entry(span).or_insert(0) += 1;
    }

    /// Records an error to report if there are no others.
    pub fn defer_error(&mut self, error: Diagnostic) {
        if !self.deferred.contains(&error) {
            self.deferred.push(error);
        }
    }

    /// Takes the errors to report if there are no others.
    pub fn take_deferred(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.deferred)
    }

    /// Restores an earlier state, but keeps the record of failed attempts.
    pub fn return_to(&mut self, before: LoopTracker) {
        let refused = std::mem::take(&mut self.failures);
        let guessed = std::mem::take(&mut self.open_ends);
        *self = LoopTracker {
            failures: refused,
            open_ends: guessed,
            ..before
        };
    }

    /// Leaves the innermost loop.
    pub fn leave_loop(&mut self, unroll: Unroll, operations: usize) {
        if let Some((index, began, inner)) = self.open.pop() {
            let made = operations.saturating_sub(began);
            self.reports[index].operations += made.saturating_sub(inner) as u64;
            self.reports[index].unroll = unroll;
            if let Some((_, _, outer)) = self.open.last_mut() {
                *outer += made;
            }
        }
    }

    /// All loops in source order.
    pub fn sorted_reports(&self) -> Vec<LoopReport> {
        let mut reports = self.reports.clone();
        reports.sort_by_key(|r| r.span);
        reports
    }

    /// Adds the contribution of each of the five largest loops to an error.
    pub fn name_largest(&self, error: Diagnostic) -> Diagnostic {
        name_largest_loops(&self.reports, error)
    }
}

/// Adds the contribution of each of the five largest loops to an error about size.
pub fn name_largest_loops(reports: &[LoopReport], mut error: Diagnostic) -> Diagnostic {
    let mut largest: Vec<&LoopReport> = reports.iter().filter(|r| r.copies > 0).collect();
    largest.sort_by_key(|r| std::cmp::Reverse(r.operations));
    for report in largest.into_iter().take(5) {
        let LoopReport { copies, operations, .. } = report;
        let text = format!(
            "`{}`: {copies} iterations, {operations} operations of its own",
            report.policy_path()
        );
        error = error.label_at(report.span, text);
    }
    error
}

impl Evaluator<'_> {
    /// Records an error for each loop that the policy names and the kernel does not have.
    pub fn check_loop_paths(&mut self) {
        let known = self.loops.sorted_reports();
        for (path, _) in &self.policy.loops {
            if !known
                .iter()
                .any(|r| policy::path_names_loop(path, &r.function, &r.counter))
            {
                let mut paths: Vec<String> = known.iter().map(LoopReport::policy_path).collect();
                paths.dedup();
                let help = if paths.is_empty() {
                    "it reaches no loop with these options".to_owned()
                } else {
                    format!("its loops are {}", paths.join(", "))
                };
                self.report.push_error(
                    Diagnostic::new(Code::UnknownLoop, format!("the kernel has no loop `{path}`")).help(help),
                );
            }
        }
    }
}
