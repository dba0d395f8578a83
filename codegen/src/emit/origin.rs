//! Kernels on pictures with row 0 at the bottom.

use super::refusal::Refusal;
use crate::compiled::Compiled;
use crate::spec::EmitOptions;
use std::borrow::Cow;
use straightline_evaluator::diagnostic::Code;
use straightline_evaluator::ir::{Invocation, Op, verify};
use straightline_evaluator::passes;
use straightline_manifest::Precision;

/// Returns the kernel in the form for the requested origin.
///
/// # Errors
///
/// If the kernel uses something that cannot be flipped exactly.
pub fn apply_origin<'c>(compiled: &'c Compiled, options: &EmitOptions) -> Result<Cow<'c, Compiled>, Refusal> {
    if !options.counts_from_below() {
        return Ok(Cow::Borrowed(compiled));
    }
    let refused = |why: &str, help: &str| {
        let what = format!("`{}` cannot have its origin at the lower left: {why}", compiled.kernel);
        Refusal::new(Code::LowerLeft, what).help(help)
    };
    let graph = &compiled.graph;
    if graph.invocation == Invocation::Lane {
        return Err(refused(
            "its pixel quads begin at even rows from above, and in a picture of odd height those that a device has begin at odd ones",
            "use the transport `block`, for compute",
        ));
    }
    let filters = |op: &Op| op.sampler().is_some();
    if options.precision == Precision::F16 && graph.nodes.iter().any(|node| filters(&node.op)) {
        return Err(refused(
            "it filters at places in half precision, and `1 - v` rounds small ones away",
            "leave the precision at f32",
        ));
    }
    let graph = passes::clean_graph(&passes::from_below(graph));
    verify::verify_graph(&graph).map_err(|why| Refusal::invalid_text(&compiled.kernel, "graph", &why))?;
    let schedule = passes::schedule_graph(&graph, compiled.policy.reads);
    let turned = Compiled {
        counts: passes::count_operations(&graph, &schedule),
        graph,
        schedule,
        quad: None,
        ..compiled.clone()
    };
    Ok(Cow::Owned(turned))
}
