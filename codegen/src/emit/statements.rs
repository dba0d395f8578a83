//! Counts of a kernel's text: statements, basic blocks and live values; and bounds that are known before lowering.

use super::ast::{self, Stmt, StmtKind};
use super::comments;
use super::liveness::most_alive;
use straightline_evaluator::ir::{Graph, Op, Origin};
use straightline_evaluator::passes::Schedule;
use straightline_manifest::Counts;

/// Adds to a kernel's counts what its text says: statements, and the scalars that are alive at once.
pub fn count_text(kernel: &ast::Module<'_>, graph: &Graph, counts: &mut Counts) {
    counts.statements = count_kernel_statements(kernel);
    let (most, place) = most_alive(kernel);
    counts.max_live = most;
    counts.max_live_at = place.map(|origin| place_of(origin, graph)).unwrap_or_default();
}

/// A place in the source, with the counters of unrolled loops around it: `kernel.rs:12, sample 3, tap 5`.
fn place_of(origin: &Origin, graph: &Graph) -> String {
    let place = match origin.line {
        Origin::NOWHERE => origin.name.to_string(),
        line => comments::source_place(graph, origin.file, line),
    };
    match origin.counters.is_empty() {
        true => place,
        false => format!("{place}, {}", comments::counter_values(&origin.counters)),
    }
}

/// Basic blocks of statements: what a branch or a loop parts, and what follows it. A loop's test is a block of its own.
pub fn basic_blocks(block: &[Stmt<'_>]) -> u32 {
    let inner = block.iter().map(|stmt| match &stmt.kind {
        StmtKind::If { then, otherwise, .. } => {
            let sides = [then, otherwise].into_iter().filter(|side| !side.is_empty());
            1 + sides.map(|side| basic_blocks(side)).sum::<u32>()
        }
        StmtKind::For { body, .. } => 2 + basic_blocks(body),
        StmtKind::Loop(body) => 1 + basic_blocks(body),
        _ => 0,
    });
    1 + inner.sum::<u32>()
}

/// Statements of a kernel's tree. Results are none: how they are written is the entry point's affair.
pub fn count_kernel_statements(kernel: &ast::Module<'_>) -> u32 {
    let results = kernel
        .body
        .iter()
        .filter(|stmt| matches!(stmt.kind, ast::StmtKind::Output(_)));
    ast::count_statements(&kernel.body) - results.count() as u32
}

/// Lower bound of a kernel's statements, without lowering.
pub fn statements_at_least(graph: &Graph, schedule: &Schedule) -> u32 {
    let live = graph.node_ids().filter(|id| schedule.has_node(*id));
    let costs = live.filter(|id| {
        !matches!(
            graph.node(*id).op,
            Op::Const(_) | Op::Extract(_) | Op::Splat | Op::Param(..)
        )
    });
    costs.count() as u32 / OPERATIONS
}

/// Upper bound of a kernel's statements, without a schedule.
pub fn statements_at_most(graph: &Graph) -> u32 {
    (graph.nodes.len() as u32).saturating_mul(STATEMENTS)
}

/// Nodes of the graph that a line of text may stand for.
const OPERATIONS: u32 = 32;

/// Statements that a node may become: a parameter of a loop is declared, set before it, in it, and read behind it.
const STATEMENTS: u32 = 4;
