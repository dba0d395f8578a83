//! Gain from mathematics that may change roundings.

use super::markdown;
use straightline_study::record::{Asked, FormKind, FormRecord, IsaForm, IsaRecord, LoopsRecord, SpirvPath};

/// Cycles by a compiler, and errors on a driver, of exact and of fast mathematics.
pub fn mathematics(cycles: &IsaRecord, times: &LoopsRecord) -> Result<String, String> {
    let Some(family) = cycles.devices.keys().next() else {
        return Err("the record has no family".to_owned());
    };
    let head = [
        "kernel",
        "cycles",
        "**fast**",
        "off f64 by",
        "**fast**",
        "all pixels",
        "**fast**",
    ];
    let of = |asked: &Asked, form| {
        let is = |other: &&Asked| {
            (&other.kernel, &other.options, other.form, other.path)
                == (&asked.kernel, &asked.options, form, SpirvPath::Naga)
        };
        let found = cycles
            .shaders
            .iter()
            .find(is)
            .and_then(|found| found.figures.get(family));
        found.map_or_else(|| "–".to_owned(), |figures| figures.inverse_throughput.to_string())
    };
    let off = |of: Option<f64>| of.map_or_else(|| "–".to_owned(), |off| format!("{off:.0e}"));
    let fast = |asked: &&Asked| asked.form == IsaForm::Fast && asked.path == SpirvPath::Naga;
    let rows = cycles.shaders.iter().filter(fast).filter_map(|asked| {
        let timed = times
            .kernels
            .iter()
            .find(|kernel| kernel.kernel == asked.kernel && kernel.options == asked.options)?;
        let form = |kind| -> Option<&FormRecord> { timed.form(kind) };
        let (exact, fast) = (form(FormKind::Full), form(FormKind::FullFast));
        Some(vec![
            asked.kernel.clone(),
            of(asked, IsaForm::Unrolled),
            format!("**{}**", of(asked, IsaForm::Fast)),
            off(exact.and_then(|form| form.difference_999)),
            format!("**{}**", off(fast.and_then(|form| form.difference_999))),
            off(exact.and_then(|form| form.difference)),
            format!("**{}**", off(fast.and_then(|form| form.difference))),
        ])
    });
    Ok(markdown(&head, rows.collect()))
}
