//! Stages that determine the pixels of one invocation: one, a block, a lane of a quad, or whole quads.

use super::{Made, Refusal, Work};
use straightline_evaluator::passes;
use straightline_evaluator::policy::Transport;

/// Maximum number of pixels of one invocation.
const MAX_BLOCK: u32 = 64;

fn is_block([width, height]: [u32; 2]) -> bool {
    (1..=MAX_BLOCK).contains(&width.saturating_mul(height))
}

/// Expands a kernel of single pixels to a block of pixels per invocation.
pub fn expand_block(work: &mut Work<'_>) -> Result<Made, Refusal> {
    let name = work.kernel;
    if work.settings.transport.is_some() {
        return Err(Refusal::new(
            format!("`{name}` computes one pixel, and sends no messages"),
            "leave the transport out, or take `pixel: Quad<IVec2>` and give a `Quad<Vec4>`",
        ));
    }
    let [width, height] = work.settings.block;
    if !is_block(work.settings.block) {
        return Err(Refusal::new(
            format!("a block of {width}x{height} pixels"),
            "use blocks of 1 to 64 pixels, such as 2x1 or 2x2",
        ));
    }
    let expanded = passes::expand_lanes(&work.graph, work.settings.block).map_err(|why| {
        Refusal::new(
            format!("the pixels of `{name}` cannot run in step: {why}"),
            "unroll fully and select, so that no loop or branch is left, or compute one pixel at a time",
        )
    })?;
    Ok(Made::Kernel(expanded))
}

/// Returns whether the lanes of a kernel of quads communicate by derivatives.
pub fn swaps_by_derivatives(work: &Work<'_>) -> bool {
    work.is_of_lanes() && work.settings.transport == Some(Transport::Derivatives)
}

/// Lowers quad swaps to derivatives.
pub fn lower_to_derivatives(work: &mut Work<'_>) -> Result<Made, Refusal> {
    quad_size(work)?;
    let lowered = passes::by_derivatives(&work.graph);
    let lowered = lowered.map_err(|why| Refusal::new(why, "send floats, or use the transport `subgroup`"))?;
    Ok(Made::Kernel(lowered))
}

/// Expands the lanes of one or more quads into one invocation: replacing the lanes if the transport is `block`, else in
/// addition to them.
pub fn expand_quad(work: &mut Work<'_>) -> Result<Made, Refusal> {
    let size = quad_size(work)?;
    if work.settings.block != [1, 1] {
        work.transport = Some(Transport::Block);
    }
    let expanded = passes::expand_lanes(&work.graph, size).map_err(|why| {
        Refusal::new(
            format!("the lanes of `{}` do not run in step: {why}", work.kernel),
            "decide loops and branches by what the whole quad has in common; choose lane by lane with `select`",
        )
    })?;
    Ok(match work.transport {
        Some(Transport::Block) => Made::Kernel(expanded),
        _ => Made::Quad(expanded),
    })
}

/// Returns the width and height of the pixels that one invocation of a quad kernel computes. Fails if the block does not
/// consist of quads.
fn quad_size(work: &Work<'_>) -> Result<[u32; 2], Refusal> {
    let (name, block) = (work.kernel, work.settings.block);
    let [width, height] = block;
    if block == [1, 1] {
        return Ok([2, 2]);
    }
    if width % 2 != 0 || height % 2 != 0 || !is_block(block) {
        return Err(Refusal::new(
            format!("`{name}` computes quads, and a block of {width}x{height} pixels has other"),
            "use whole quads, such as 4x2 or 8x2, and 64 pixels at most",
        ));
    }
    if work
        .settings
        .transport
        .is_some_and(|transport| transport != Transport::Block)
    {
        return Err(Refusal::new(
            format!("the lanes of `{name}` lie in one invocation, and send no messages"),
            "leave the transport out, or the block",
        ));
    }
    Ok(block)
}
