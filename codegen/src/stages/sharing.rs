//! Stages that reduce repeated reads of the same texels.

use super::{Made, Refusal, Work};
use std::sync::Arc;
use straightline_evaluator::passes;
use straightline_evaluator::policy::Share;

/// Maximum number of threads in a workgroup on every device.
const MAX_THREADS: u32 = 256;

/// Makes a workgroup read each texel once, into its memory.
pub fn share_by_workgroup(work: &mut Work<'_>) -> Result<Made, Refusal> {
    let Share::Workgroup(threads) = work.settings.share else {
        return Ok(Made::Kernel(std::mem::take(&mut work.graph)));
    };
    let refused = |why: String, help| {
        let name = work.kernel;
        Refusal::new(
            format!("the pixels of `{name}` cannot share texels by workgroup: {why}"),
            help,
        )
    };
    let [width, height] = threads;
    if !(1..=MAX_THREADS).contains(&width.saturating_mul(height)) {
        let why = format!("a workgroup of {width}x{height} threads");
        return Err(refused(why, "use 1 to 256 threads, such as 16x16 or 32x8"));
    }
    if work.settings.block != [1, 1] {
        let [width, height] = work.settings.block;
        let why = format!("an invocation computes {width}x{height} of them");
        return Err(refused(
            why,
            "share by blocks or by workgroups: leave one of the two out",
        ));
    }
    let (graph, found) = passes::by_workgroup(&work.graph, threads)
        .map_err(|why| refused(why, "let invocations share by themselves: leave `share` out"))?;
    work.sharing = Some(Arc::new(found));
    work.unshared = Some(Arc::new(std::mem::take(&mut work.graph)));
    Ok(Made::Kernel(graph))
}

/// Combines reads into gathers of four texels where several of them are needed.
pub fn gather_reads(work: &mut Work<'_>) -> Result<Made, Refusal> {
    let (graph, found) = passes::form_gathers(&work.graph).map_err(|why| {
        Refusal::new(
            format!("the reads of `{}` cannot be gathered: {why}", work.kernel),
            "leave `reads` out, or let one invocation compute whole pixels",
        )
    })?;
    work.gathered = found.into();
    Ok(Made::Kernel(graph))
}
