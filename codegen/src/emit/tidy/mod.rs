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
use super::liveness::most_alive;
use inline::{Stays, inline};
use straightline_evaluator::ir::Graph;
use straightline_evaluator::limits;
use straightline_evaluator::policy::ReadOrder;

pub use simplify::simplify;

/// Scalars alive at once from which values stay where fewer are alive for them. With fewer, compilers of GPUs do as well by
/// themselves (docs/study.md).
const MANY_ALIVE: u32 = 32;

/// Tidies a kernel's statements. Reads that stand in an order of their own stay where they are, and of a kernel in which many values
/// are alive what would make them more.
pub fn tidy<'g>(module: &mut Module<'g>, graph: &Graph, reads: ReadOrder) {
    module.rewrite(&mut |_, expr| simplify(expr));
    dead::remove(module);
    coalesce::coalesce(module);
    let mut stays = Stays {
        reads: reads == ReadOrder::Rows,
        crowding: false,
    };
    let untouched = module.clone();
    shorten(module, graph, stays);
    if most_alive(module).0 >= MANY_ALIVE {
        stays.crowding = true;
        *module = untouched;
        shorten(module, graph, stays);
    }
    statements::shorten(&mut module.body);
}

/// Writes values where they are used, until there are no more.
fn shorten(module: &mut Module<'_>, graph: &Graph, stays: Stays) {
    inline(module, graph, stays);
    breaks::early(&mut module.body);
    // Variables that were separated by a loop's early exit can be merged now.
    coalesce::coalesce(module);
    // Inlined values have new neighbours, and shorter ones may be inlined now. Each turn but the last removes a statement.
    for _ in 0..=count(&module.body) {
        module.rewrite(&mut |_, expr| simplify(expr));
        dead::remove(module);
        if !inline(module, graph, stays) || limits::exceeded(0).is_some() {
            break;
        }
    }
}
