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

use super::ast::{Module, count_statements};
use super::liveness::most_alive;
use inline::{Stays, inline_values};
use straightline_evaluator::ir::Graph;
use straightline_evaluator::limits;
use straightline_evaluator::policy::ReadOrder;

pub use simplify::simplify_expr;

/// Scalars alive at once from which values stay where fewer are alive for them. With fewer, compilers of GPUs do as well by
/// themselves (docs/study.md).
const MANY_ALIVE: u32 = 32;

/// Tidies a kernel's statements. Reads that stand in an order of their own stay where they are, and of a kernel in which many values
/// are alive what would make them more.
pub fn tidy_kernel<'g>(module: &mut Module<'g>, graph: &Graph, reads: ReadOrder) {
    module.rewrite(&mut |_, expr| simplify_expr(expr));
    dead::remove_dead(module);
    coalesce::coalesce_variables(module);
    let mut stays = Stays {
        reads: reads == ReadOrder::Rows,
        crowding: false,
    };
    let untouched = module.clone();
    inline_repeatedly(module, graph, stays);
    if most_alive(module).0 >= MANY_ALIVE {
        stays.crowding = true;
        *module = untouched;
        inline_repeatedly(module, graph, stays);
    }
    statements::shorten_statements(&mut module.body);
}

/// Writes values where they are used, until there are no more.
fn inline_repeatedly(module: &mut Module<'_>, graph: &Graph, stays: Stays) {
    inline_values(module, graph, stays);
    breaks::sink_breaks(&mut module.body);
    // Variables that were separated by a loop's early exit can be merged now.
    coalesce::coalesce_variables(module);
    // Inlined values have new neighbours, and shorter ones may be inlined now. Each turn but the last removes a statement.
    for _ in 0..=count_statements(&module.body) {
        module.rewrite(&mut |_, expr| simplify_expr(expr));
        dead::remove_dead(module);
        if !inline_values(module, graph, stays) || limits::exceeded_limit(0).is_some() {
            break;
        }
    }
}
