//! Number of statements of a kernel: exactly, and bounds that are known before lowering.

use super::ast;
use straightline_evaluator::ir::{Graph, Op};
use straightline_evaluator::passes::Schedule;

/// Statements of a kernel's tree. Results are none: how they are written is the entry point's affair.
pub fn count(kernel: &ast::Module<'_>) -> u32 {
    let results = kernel
        .body
        .iter()
        .filter(|stmt| matches!(stmt.kind, ast::StmtKind::Output(_)));
    ast::count(&kernel.body) - results.count() as u32
}

/// Lower bound of a kernel's statements, without lowering.
pub fn statements_at_least(graph: &Graph, schedule: &Schedule) -> u32 {
    let live = graph.ids().filter(|id| schedule.has(*id));
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
