//! Rules that make a tree read as if written by a colleague. None changes any bit of the result.
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

/// Number of live scalars from which inlining must not increase pressure. Below it, GPU compilers do as well on their own
/// (docs/study.md).
const MANY_ALIVE: u32 = 32;

/// Tidies a kernel's statements. Reads with an explicit order stay in place; in a kernel with many live values, so do
/// values whose inlining would add more.
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

/// Inlines values until there are none left.
fn inline_repeatedly(module: &mut Module<'_>, graph: &Graph, stays: Stays) {
    inline_values(module, graph, stays);
    breaks::sink_breaks(&mut module.body);
    // Variables that were separated by a loop's early exit can be merged now.
    coalesce::coalesce_variables(module);
    // Inlined values have new neighbours, and shorter ones may now be inlined. Each iteration but the last removes a
    // statement.
    for _ in 0..=count_statements(&module.body) {
        module.rewrite(&mut |_, expr| simplify_expr(expr));
        dead::remove_dead(module);
        if !inline_values(module, graph, stays) || limits::exceeded_limit(0).is_some() {
            break;
        }
    }
}
