//! Remarks on settings with hidden costs: blocks of pixels that keep many values alive, unroll factors that multiply, and
//! loops that are unrolled to very many operations.

use straightline_codegen::{Compiled, Kernel, LoopReport, Settings, Unroll};

/// Number of live scalars above which GPUs run fewer threads or spill (docs/study.md, "Live values").
const MANY_ALIVE: u32 = 64;

/// Copies of a loop's body above which an unroll factor was probably meant for fewer loops.
const MANY_COPIES: u64 = 64;

/// Copies of a loop's body, and their operations, from which unrolling was probably not meant.
const LONG_LOOP: (u64, u64) = (32, 5000);

/// Returns the remarks on a compiled kernel, one line each.
pub fn find_notes(kernel: &Kernel, settings: &Settings, compiled: &Compiled) -> Vec<String> {
    let long = long_loop(compiled).map(|(_, note)| note);
    let notes = [
        crowded_block(kernel, settings, compiled),
        multiplied_factors(compiled),
        long,
    ];
    notes.into_iter().flatten().collect()
}

/// Remarks on a block of pixels with many live values, compared with single pixels.
fn crowded_block(kernel: &Kernel, settings: &Settings, compiled: &Compiled) -> Option<String> {
    let [width, height] = settings.block;
    if settings.block == [1, 1] {
        return None;
    }
    let block = compiled.text_counts().max_live;
    if block < MANY_ALIVE {
        return None;
    }
    let single = kernel.compile(&settings.clone().block(1, 1)).ok()?.text_counts();
    Some(format!(
        "{} scalars are alive at once in blocks of {width}x{height}, {} in single pixels; a GPU then runs fewer threads at once, or spills",
        block, single.max_live
    ))
}

/// Remarks on a loop with many copies, because the factors of nested loops multiply.
fn multiplied_factors(compiled: &Compiled) -> Option<String> {
    let most = compiled.loops.iter().max_by_key(|report| report.copies)?;
    if most.copies < MANY_COPIES || !matches!(most.unroll, Unroll::Partial(_)) {
        return None;
    }
    let (path, unroll) = (most.policy_path(), most.unroll.to_string());
    let factor = unroll.trim_start_matches("partial(").trim_end_matches(')');
    Some(format!(
        "`{path}` is written {} times: the factors of loops in loops multiply; give one to this loop alone: `--unroll none --unroll-loop {path}={factor}`",
        most.copies
    ))
}

/// Returns the loop that is unrolled to the most operations, if they are very many and it could stay in the shader, and a
/// remark on it.
pub fn long_loop(compiled: &Compiled) -> Option<(&LoopReport, String)> {
    let most = compiled.loops.iter().max_by_key(|report| report.operations)?;
    let (copies, operations) = LONG_LOOP;
    let is_long = most.copies >= copies && most.operations >= operations;
    if !is_long || most.unroll != Unroll::Full || most.reason.is_some() {
        return None;
    }
    let path = most.policy_path();
    let note = format!(
        "`{path}` is unrolled to {} operations in {} copies: `--unroll-loop {path}=none` leaves it in the shader",
        most.operations, most.copies
    );
    Some((most, note))
}
