//! What each loop contributes to the size of a kernel.

use super::Evaluator;
use super::demand::UnrollReason;
use super::value::Eval;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::limits;
use crate::policy::{self, Unroll};
use std::collections::HashMap;

/// What helps a kernel that is too large.
pub const BUDGET_HELP: &str = "run loops over fewer values, leave the largest one in the shader with `#[cfg_attr(false, unroll(none))]`, or raise the budget";

/// A loop of the source, and what became of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoopReport {
    /// The function that it stands in.
    pub function: String,
    /// Its counter, or `while`.
    pub counter: String,
    /// Where it stands.
    pub span: Span,
    /// What was made of it the last time.
    pub unroll: Unroll,
    /// Why it was unrolled although it was asked to be left in the shader, if it was.
    pub reason: Option<String>,
    /// Copies of its body that were evaluated, over all times that it was reached: one for each iteration if it is unrolled, one
    /// if it is left in the shader.
    pub copies: u64,
    /// Operations that its body left, those of loops inside it left out.
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
    /// Loops being evaluated: index, operations when it began, and operations of loops inside it.
    open: Vec<(usize, usize, usize)>,
    /// How often each loop was tried to be left in the shader in vain, and why not the last time.
    failures: HashMap<Span, (u32, UnrollReason)>,
    /// Attempts to unroll each loop that were given up, as its end turned out to be a runtime value.
    open_ends: HashMap<Span, u32>,
    /// Errors to give if there are no others: what follows a loop needs it unrolled, but it was asked for by name.
    deferred: Vec<Diagnostic>,
}

/// Attempts to leave one loop in the shader after which it is unrolled wherever it is reached. Without such an end loops
/// in loops would be tried twice a level.
const MAX_FAILURES: u32 = 3;

/// Iterations after which a `while` that is left early under a runtime condition is taken to end at run time only.
const MAX_OPEN_ITERATIONS: u64 = 256;

/// The least number of such iterations, after attempts in vain. Without a decrease loops in loops would be tried 256 times a level.
const MIN_OPEN_ITERATIONS: u64 = 4;

impl LoopTracker {
    /// A loop begins, when `operations` have been made.
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

    /// Its body is evaluated once more.
    pub fn record_iteration(&mut self) {
        if let Some((index, ..)) = self.open.last() {
            self.reports[*index].copies += 1;
        }
    }

    /// Notes why a loop is unrolled; the first reason stays.
    pub fn record_reason(&mut self, span: Span, reason: String) {
        if let Some(report) = self.reports.iter_mut().find(|r| r.span == span) {
            report.reason.get_or_insert(reason);
        }
    }

    /// An attempt to leave a loop in the shader has failed.
    pub fn record_failure(&mut self, span: Span, why: &UnrollReason) {
        let entry = self.failures.entry(span).or_insert_with(|| (0, why.clone()));
        *entry = (entry.0 + 1, why.clone());
    }

    /// Why a loop is not tried to be left in the shader any more.
    pub fn previous_failure(&self, span: Span) -> Option<UnrollReason> {
        let (times, why) = self.failures.get(&span)?;
        (*times >= MAX_FAILURES).then(|| why.clone())
    }

    /// Iterations after which the attempt to unroll a loop is given up if some have left it.
    pub fn iteration_limit(&self, span: Span) -> u64 {
        let failed = self.open_ends.get(&span).copied().unwrap_or(0);
        (MAX_OPEN_ITERATIONS >> (2 * failed).min(63)).max(MIN_OPEN_ITERATIONS)
    }

    /// An attempt to unroll a loop is given up.
    pub fn record_open_end(&mut self, span: Span) {
        *self.open_ends.entry(span).or_insert(0) += 1;
    }

    /// An error to give if there are no others.
    pub fn defer_error(&mut self, error: Diagnostic) {
        if !self.deferred.contains(&error) {
            self.deferred.push(error);
        }
    }

    /// Errors to give if there are no others.
    pub fn take_deferred(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.deferred)
    }

    /// Goes back to a state, but keeps in mind which attempts failed.
    pub fn return_to(&mut self, before: LoopTracker) {
        let refused = std::mem::take(&mut self.failures);
        let guessed = std::mem::take(&mut self.open_ends);
        *self = LoopTracker {
            failures: refused,
            open_ends: guessed,
            ..before
        };
    }

    /// It ends.
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

    /// All loops in order of the source.
    pub fn sorted_reports(&self) -> Vec<LoopReport> {
        let mut reports = self.reports.clone();
        reports.sort_by_key(|r| r.span);
        reports
    }

    /// The error with what each loop contributed, the largest five.
    pub fn name_largest(&self, error: Diagnostic) -> Diagnostic {
        name_largest_loops(&self.reports, error)
    }
}

/// An error about size with what each loop contributed, the largest five.
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

/// Parts of a value that are copied in the time of a step.
const PARTS_PER_STEP: usize = 8;

impl Evaluator<'_> {
    /// Counts the work of copying or comparing a value of so many parts, so that copies of large arrays in loops end.
    pub fn count_copy(&mut self, parts: usize, span: Span) -> Eval<()> {
        let steps = (parts / PARTS_PER_STEP) as u64;
        self.steps += steps;
        limits::count_work(steps);
        self.count_step(span)
    }

    /// Notes an error for each loop that the policy names and the kernel has not.
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
                self.errors
                    .push(Diagnostic::new(Code::UnknownLoop, format!("the kernel has no loop `{path}`")).help(help));
            }
        }
    }
}
