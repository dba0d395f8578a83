//! Errors, limits, and the calls being evaluated.

use super::value::Exit;
use crate::diagnostic::{Code, Diagnostic, Errors, File, Span};
use crate::limits;
use std::borrow::Cow;
use std::sync::Arc;

/// Steps after which a kernel is assumed not to terminate.
const MAX_STEPS: u64 = 20_000_000;

/// Steps between two checks of time and memory.
const STEPS_BETWEEN_CHECKS: u64 = 1 << 10;

/// Nodes after which a loop is assumed to be unrolled by mistake.
const MAX_NODES: usize = 400_000;

/// Call depth after which a recursion is assumed not to terminate.
pub const MAX_CALLS: usize = 200;

/// Depth of nested expressions, those of the calling functions included. WebAssembly uses its host's stack of about
/// one megabyte. Everywhere else the stack is deep enough for anything that the front end and [`MAX_CALLS`] allow.
const MAX_EXPRESSIONS: u32 = if cfg!(target_arch = "wasm32") { 700 } else { 100_000 };

/// Errors of a kernel, and the work that it takes.
pub struct Report<'a> {
    /// The kernel's files, for excerpts.
    files: Arc<Vec<File>>,
    errors: Vec<Diagnostic>,
    /// Functions being evaluated, innermost last.
    calls: Vec<Cow<'a, str>>,
    /// Depth of nested expressions.
    depth: u32,
    /// Steps of work, earlier attempts at the kernel included.
    steps: u64,
    /// Step count at the last check of time and memory.
    last_check: u64,
    /// Upper limit for the number of nodes.
    most_nodes: usize,
    /// `true` after a limit has been reached.
    exhausted: bool,
}

impl<'a> Report<'a> {
    /// Report of a kernel that earlier attempts have spent `steps` on.
    pub fn new(files: &Arc<Vec<File>>, steps: u64) -> Report<'a> {
        Report {
            files: Arc::clone(files),
            errors: Vec::new(),
            calls: Vec::new(),
            depth: 0,
            steps,
            last_check: steps,
            most_nodes: MAX_NODES,
            exhausted: false,
        }
    }

    /// Steps of work so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Number of errors so far.
    pub fn error_count(&self) -> usize {
        self.errors.len()
    }

    /// Adds an error.
    pub fn push_error(&mut self, error: Diagnostic) {
        self.errors.push(error);
    }

    /// Records the errors of an exit, unless they have been recorded already.
    pub fn record_exit(&mut self, exit: Exit) -> Exit {
        let errors = match exit {
            Exit::Error(error) => vec![*error],
            Exit::Demand(needs) => needs.into_iter().map(|need| need.error).collect(),
            other => return other,
        };
        for error in errors {
            if !self.errors.contains(&error) {
                self.errors.push(error);
            }
        }
        Exit::Noted
    }

    /// Drops all errors after the first `count`. Returns the first of them.
    pub fn drop_errors(&mut self, count: usize) -> Option<Diagnostic> {
        let first = self.errors.get(count).cloned();
        self.errors.truncate(count);
        first
    }

    /// Takes all errors.
    pub fn take_errors(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.errors)
    }

    /// Takes all errors, with the files that they are about.
    pub fn take_located(&mut self) -> Errors {
        Errors::new(std::mem::take(&mut self.errors), &self.files)
    }

    /// Returns the text at a place, and the place as `FILE:LINE`.
    pub fn excerpt(&self, span: Span) -> Option<(&str, String)> {
        let file = self.files.get(span.file as usize)?;
        let text = file.text.get(span.start as usize..span.end as usize)?;
        Some((text, format!("{}:{}", file.path, span.line)))
    }

    /// Enters a function or constant.
    pub fn enter_call(&mut self, name: impl Into<Cow<'a, str>>) {
        self.calls.push(name.into());
    }

    /// Leaves the innermost function.
    pub fn leave_call(&mut self) {
        self.calls.pop();
    }

    /// Number of functions being evaluated.
    pub fn call_depth(&self) -> usize {
        self.calls.len()
    }

    /// Returns whether no further function may be entered.
    pub fn is_too_deep(&self) -> bool {
        self.calls.len() >= MAX_CALLS
    }

    /// Name of the innermost function.
    pub fn function(&self) -> Cow<'a, str> {
        self.calls.last().cloned().unwrap_or_default()
    }

    /// Number of calls around the outermost call of a function.
    pub fn calls_around(&self, function: &str) -> usize {
        self.calls.iter().position(|name| *name == function).unwrap_or(0)
    }

    /// Enters an expression.
    pub fn enter_expr(&mut self, span: Span) -> Result<(), Box<Diagnostic>> {
        if self.depth >= MAX_EXPRESSIONS {
            let what = format!("calls and expressions are nested more than {MAX_EXPRESSIONS} deep");
            let error = Diagnostic::error_at(Code::Recursion, span, what).label("reached here");
            return Err(Box::new(error.help("the command line goes deeper than a browser can")));
        }
        self.depth += 1;
        Ok(())
    }

    /// Leaves the innermost expression.
    pub fn leave_expr(&mut self) {
        self.depth -= 1;
    }

    /// Counts steps of work.
    pub fn count_work(&mut self, steps: u64) {
        self.steps += steps;
        limits::count_work(steps);
    }

    /// Returns the error of a limit that is exceeded when the graph has `nodes` nodes. `help` is for limits of size.
    pub fn check_limits(&mut self, nodes: usize, help: &str, span: Span) -> Result<(), Box<Diagnostic>> {
        let (code, what, help) = if self.steps > MAX_STEPS {
            let what = format!("evaluation takes more than {MAX_STEPS} steps");
            (Code::Budget, what, help)
        } else if nodes > self.most_nodes {
            let what = format!("the kernel unrolls to more than {} operations", self.most_nodes);
            (Code::Budget, what, help)
        } else {
            let due = self.steps >= self.last_check + STEPS_BETWEEN_CHECKS;
            let Some(excess) = due.then(|| limits::exceeded_limit(nodes)).flatten() else {
                self.last_check = if due { self.steps } else { self.last_check };
                return Ok(());
            };
            (Code::Limit, format!("evaluation takes {excess}"), excess.help())
        };
        self.exhausted = true;
        let error = Diagnostic::error_at(code, span, what)
            .label(format!("reached here, in `{}`", self.function()))
            .help(help);
        Err(Box::new(error))
    }

    /// Returns whether a limit has been reached.
    pub fn is_exhausted(&self) -> bool {
        self.exhausted
    }

    /// Lowers the upper limit for the number of nodes. Returns the limit before.
    pub fn limit_nodes(&mut self, most: usize) -> usize {
        let before = self.most_nodes;
        self.most_nodes = before.min(most);
        before
    }

    /// Restores the upper limit for the number of nodes. Returns `true` if a graph of `nodes` nodes exceeded the lower limit
    /// alone; evaluation may then go on.
    pub fn restore_limit(&mut self, most: usize, nodes: usize) -> bool {
        let lower = std::mem::replace(&mut self.most_nodes, most);
        let exceeded_lower = self.exhausted && nodes > lower && nodes <= most;
        self.exhausted &= !exceeded_lower;
        exceeded_lower
    }
}
