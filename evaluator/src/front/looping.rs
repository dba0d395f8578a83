//! Statements that may run a loop which is asked to be left in the shader: evaluation may have to go back to them.
//!
//! A name stands for every function and constant of which it is the last word, as types are not looked at: statements may be found
//! that run no such loop, and none is missed but in types.

use super::library::Library;
use super::scan::child_exprs;
use super::tree::{Block, Expr, ExprKind, Function, Statement};
use crate::diagnostic::Span;
use crate::policy::{Policy, Unroll};
use rustc_hash::{FxHashMap, FxHashSet};

/// Methods that operators call.
const OPERATORS: [&str; 28] = [
    "add",
    "sub",
    "mul",
    "div",
    "rem",
    "neg",
    "not",
    "bitand",
    "bitor",
    "bitxor",
    "shl",
    "shr",
    "index",
    "index_mut",
    "add_assign",
    "sub_assign",
    "mul_assign",
    "div_assign",
    "rem_assign",
    "bitand_assign",
    "bitor_assign",
    "bitxor_assign",
    "shl_assign",
    "shr_assign",
    "eq",
    "ne",
    "partial_cmp",
    "cmp",
];

/// Places of the statements, and of values of blocks, that `entry` reaches and that may run a loop which is asked to be left in
/// the shader.
pub fn looping_statements(library: &Library, entry: &str, policy: &Policy) -> FxHashSet<Span> {
    let mut items: FxHashMap<&str, Vec<Item<'_>>> = FxHashMap::default();
    for (name, function) in &library.functions {
        items
            .entry(last_segment(name))
            .or_default()
            .push(Item::Function(function));
    }
    for (name, constant) in &library.consts {
        items
            .entry(last_segment(name))
            .or_default()
            .push(Item::Const(&constant.value));
    }
    let asked = |unroll: Option<Unroll>| unroll.is_some_and(|unroll| unroll != Unroll::Full);
    let by_function = library.functions.values().any(|function| asked(function.unroll));
    let by_policy = policy.unroll != Unroll::Full || !policy.loops.is_empty();
    let mut scan = Scan {
        every: by_function || by_policy,
        words: FxHashSet::default(),
        values: false,
        operators: false,
        found: FxHashSet::default(),
    };
    let reached = reached_items(&items, last_segment(entry));
    let parts: Vec<(&str, Parts<'_>)> = reached
        .iter()
        .map(|(word, item)| (*word, Parts::from_item(*item)))
        .collect();
    // A loop makes those that call its function run a loop, and so on.
    loop {
        let before = (scan.words.len(), scan.values);
        for (word, parts) in &parts {
            if scan.may_run_loop(parts) {
                scan.words.insert(word);
            }
            scan.values |= parts.closures.iter().any(|closure| scan.may_run_loop(closure));
            scan.values |= parts.paths.iter().any(|path| scan.words.contains(path));
        }
        scan.operators = OPERATORS.iter().any(|name| scan.words.contains(name));
        if before == (scan.words.len(), scan.values) {
            break;
        }
    }
    for (_, item) in &reached {
        match item {
            Item::Function(function) => drop(scan.scan_block(&function.body)),
            Item::Const(value) => drop(scan.scan_expr(value)),
        }
    }
    scan.found
}

/// The last word of a path.
fn last_segment(name: &str) -> &str {
    name.rsplit("::").next().unwrap_or(name)
}

/// Item that a name may stand for.
#[derive(Clone, Copy)]
enum Item<'l> {
    Function(&'l Function),
    Const(&'l Expr),
}

/// Items that `entry` reaches, with the words that they go by.
fn reached_items<'l>(items: &FxHashMap<&'l str, Vec<Item<'l>>>, entry: &'l str) -> Vec<(&'l str, Item<'l>)> {
    let mut seen = FxHashSet::default();
    let mut pending: Vec<&str> = OPERATORS.into_iter().chain([entry]).collect();
    let mut reached = Vec::new();
    while let Some(word) = pending.pop() {
        if !seen.insert(word) {
            continue;
        }
        for item in items.get(word).into_iter().flatten() {
            pending.extend(Parts::from_item(*item).all_words());
            reached.push((word, *item));
        }
    }
    reached
}

/// Facts about an item's or a closure's text.
#[derive(Default)]
struct Parts<'l> {
    /// Attributes of its loops.
    loops: Vec<Option<Unroll>>,
    /// Last words of what it calls.
    calls: FxHashSet<&'l str>,
    /// Last words of what it mentions otherwise: constants, functions as values.
    paths: FxHashSet<&'l str>,
    /// Closures in it, which it may call or give away.
    closures: Vec<Parts<'l>>,
    /// `true` if it calls anything.
    is_caller: bool,
    /// `true` if it has operators that may be of traits.
    operators: bool,
}

impl<'l> Parts<'l> {
    fn from_item(item: Item<'l>) -> Parts<'l> {
        let mut parts = Parts::default();
        match item {
            Item::Function(function) => parts.block(&function.body),
            Item::Const(value) => parts.expr(value),
        }
        parts
    }

    fn all_words(&self) -> Vec<&'l str> {
        let inside = self.closures.iter().flat_map(Parts::all_words);
        self.calls.iter().chain(&self.paths).copied().chain(inside).collect()
    }

    fn block(&mut self, block: &'l Block) {
        for statement in &block.statements {
            value_of(statement).into_iter().for_each(|value| self.expr(value));
        }
        block.value.iter().for_each(|value| self.expr(value));
    }

    fn expr(&mut self, e: &'l Expr) {
        match &e.kind {
            ExprKind::For(f) => self.loops.push(f.unroll),
            ExprKind::While(.., unroll) => self.loops.push(*unroll),
            ExprKind::Call(path, ..) => self.calls.extend(path.last().map(String::as_str)),
            ExprKind::Method(_, name, ..) => drop(self.calls.insert(last_segment(name))),
            ExprKind::Path(path) => self.paths.extend(path.last().map(String::as_str)),
            ExprKind::Closure(closure) => {
                let mut inside = Parts::default();
                inside.expr(&closure.body);
                self.closures.push(inside);
                return;
            }
            _ => {}
        }
        self.operators |= is_operator(e);
        self.is_caller |= matches!(e.kind, ExprKind::Call(..) | ExprKind::Method(..) | ExprKind::Invoke(..));
        child_exprs(e).into_iter().for_each(|child| self.expr(child));
        blocks(e).into_iter().for_each(|block| self.block(block));
    }
}

fn is_operator(e: &Expr) -> bool {
    matches!(
        e.kind,
        ExprKind::Unary(..) | ExprKind::Binary(..) | ExprKind::Assign(..) | ExprKind::Index(..)
    )
}

/// Blocks directly in an expression.
fn blocks(e: &Expr) -> Vec<&Block> {
    match &e.kind {
        ExprKind::If(_, block, ..) | ExprKind::While(_, block, ..) => vec![block],
        ExprKind::Block(block) | ExprKind::Labelled(_, block) => vec![block],
        ExprKind::For(f) => vec![&f.body],
        _ => Vec::new(),
    }
}

/// The expression of a statement.
fn value_of(statement: &Statement) -> Option<&Expr> {
    match statement {
        Statement::Let(_, _, init, _) => init.as_ref(),
        Statement::Expr(e) => Some(e),
        Statement::Const(constant) => Some(&constant.value),
    }
}

struct Scan<'l> {
    /// `true` if every loop is asked to be left in the shader, and not only those with an attribute.
    every: bool,
    /// Last words of functions and constants that may run such a loop.
    words: FxHashSet<&'l str>,
    /// `true` if a value that can be called may run such a loop.
    values: bool,
    /// `true` if an operator may run such a loop.
    operators: bool,
    found: FxHashSet<Span>,
}

impl Scan<'_> {
    fn keeps_loop(&self, unroll: Option<Unroll>) -> bool {
        self.every || unroll.is_some_and(|unroll| unroll != Unroll::Full)
    }

    fn may_run_loop(&self, parts: &Parts<'_>) -> bool {
        let called = &parts.calls;
        parts.loops.iter().any(|unroll| self.keeps_loop(*unroll))
            || (self.values && parts.is_caller)
            || (self.operators && parts.operators)
            || called.iter().chain(&parts.paths).any(|word| self.words.contains(word))
            || parts.closures.iter().any(|closure| self.may_run_loop(closure))
    }

    fn scan_block(&mut self, block: &Block) -> bool {
        let mut any = false;
        let statements = block.statements.iter();
        let statements = statements.filter_map(|statement| Some((value_of(statement)?, statement.span())));
        let value = block.value.as_deref().map(|value| (value, value.span));
        for (part, span) in statements.chain(value) {
            if self.scan_expr(part) {
                self.found.insert(span);
                any = true;
            }
        }
        any
    }

    /// Returns whether an expression may run such a loop. Notes the statements in it that do.
    fn scan_expr(&mut self, e: &Expr) -> bool {
        let is_named = |path: &[String]| path.last().is_some_and(|word| self.words.contains(word.as_str()));
        let mut runs = match &e.kind {
            ExprKind::For(f) => self.keeps_loop(f.unroll),
            ExprKind::While(.., unroll) => self.keeps_loop(*unroll),
            ExprKind::Call(path, ..) => self.values || is_named(path),
            ExprKind::Method(_, name, ..) => self.values || self.words.contains(last_segment(name)),
            ExprKind::Invoke(..) => self.values,
            ExprKind::Path(path) => is_named(path),
            _ => self.operators && is_operator(e),
        };
        for child in child_exprs(e) {
            runs |= self.scan_expr(child);
        }
        for block in blocks(e) {
            runs |= self.scan_block(block);
        }
        runs
    }
}
