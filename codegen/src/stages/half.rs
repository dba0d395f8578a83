//! Half precision for the values that the setting `half` names.

use super::{Made, Refusal, Work};
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
    Ok(Made::Kernel(passes::lower_to_half(&work.graph, &work.settings.half)))
}
