//! Rules that make a tree read as a colleague would have written it. None changes what is computed, by a single bit.
//!
//! File tests: `codegen/tests/filetests/tidy`.

mod breaks;
mod coalesce;
mod columns;
mod dead;
mod inline;
mod simplify;
mod statements;

use super::ast::{Module, count};
use straightline_evaluator::ir::Graph;
use straightline_evaluator::limits;
use straightline_evaluator::policy::ReadOrder;

pub use simplify::simplify;

/// Tidies a kernel's statements. Reads that stand in an order of their own stay where they are.
pub fn tidy(module: &mut Module<'_>, graph: &Graph, reads: ReadOrder) {
    module.rewrite(&mut |_, expr| simplify(expr));
    dead::remove(module);
    coalesce::coalesce(module);
    inline::inline(module, graph, reads);
    breaks::early(&mut module.body);
    // What a loop's early end stood between is one variable now.
    coalesce::coalesce(module);
    // What was inlined has new neighbours, and what is shorter now may be inlined. Each turn but the last takes a statement away.
    for _ in 0..=count(&module.body) {
        module.rewrite(&mut |_, expr| simplify(expr));
        dead::remove(module);
        if !inline::inline(module, graph, reads) || limits::exceeded(0).is_some() {
            break;
        }
    }
    statements::shorten(&mut module.body);
}
