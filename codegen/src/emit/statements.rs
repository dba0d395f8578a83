//! Counts of a kernel's text: statements, basic blocks and live values; and bounds available before lowering.

use super::ast::{self, Stmt, StmtKind};
use super::comments;
use super::liveness::most_alive;
use straightline_evaluator::ir::{Graph, Op, Origin};
use straightline_evaluator::passes::Schedule;
use straightline_manifest::Counts;

/// Adds the counts of a kernel's text: statements, and the maximum of live scalars.
pub fn count_text(kernel: &ast::Module<'_>, graph: &Graph, counts: &mut Counts) {
    counts.statements = count_kernel_statements(kernel);
    let (most, place) = most_alive(kernel);
    counts.max_live = most;
    counts.max_live_at = place.map(|origin| place_of(origin, graph)).unwrap_or_default();
}

/// Formats a source location with the counters of surrounding unrolled loops: `kernel.rs:12, sample 3, tap 5`.
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

/// Counts the basic blocks of statements, which branches and loops delimit. A loop's test is a separate block.
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

/// Counts the statements of a kernel's tree, without its results, whose form depends on the entry point.
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

/// Number of nodes that one line of text may represent.
const OPERATIONS: u32 = 32;

/// Number of statements that one node may need: a parameter of a loop is declared, set before the loop and in it, and read
/// after it.
const STATEMENTS: u32 = 4;
