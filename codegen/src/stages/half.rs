//! Half precision for the values that the setting `half` or the kernel's attributes name.

use super::{Made, Refusal, Work};
use std::collections::BTreeSet;
use straightline_evaluator::{passes, suggest_name};

/// Lowers the named values to half precision.
pub fn lower_to_half(work: &mut Work<'_>) -> Result<Made, Refusal> {
    let known = passes::half_names(&work.graph);
    if let Some(unknown) = work.settings.half.iter().find(|name| !known.contains(*name)) {
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let what = format!(
            "`{}` computes no float called `{unknown}`, which `half` names",
            work.kernel
        );
        return Err(Refusal::new(what, suggest_name(unknown, &known, "it computes")));
    }
    // The kernel does not call every function that has an attribute.
    let by_attributes = known.into_iter().filter(|name| is_among(name, &work.half));
    work.half = by_attributes.chain(work.settings.half.iter().cloned()).collect();
    Ok(Made::Kernel(passes::lower_to_half(&work.graph, &work.half)))
}

/// Returns whether a value has one of some names, or is a part of what has it: `name_field`.
fn is_among(value: &str, names: &BTreeSet<String>) -> bool {
    let mut ends = value.match_indices('_').map(|(end, _)| end).chain([value.len()]);
    ends.any(|end| names.contains(&value[..end]))
}
