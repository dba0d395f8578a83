//! What mathematics that may change roundings is worth.

use super::markdown;
use straightline_study::record::{Asked, Form, FormKind, IsaForm, IsaRecord, LoopsRecord, SpirvPath};

/// By a compiler and on a driver: cycles, time and error of what changes no bit, and of what may.
pub fn mathematics(cycles: &IsaRecord, times: &LoopsRecord) -> Result<String, String> {
    let Some(family) = cycles.devices.keys().next() else {
        return Err("the record has no family".to_owned());
    };
    let head = [
        "kernel",
        "cycles",
        "**fast**",
        "ms",
        "**speedup**",
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
        let form = |kind| -> Option<&Form> { timed.form(kind) };
        let (exact, fast) = (form(FormKind::Full), form(FormKind::FullFast));
        let ratio = exact
            .zip(fast)
            .map(|(exact, fast)| fast.ratio.median / exact.ratio.median);
        Some(vec![
            asked.kernel.clone(),
            of(asked, IsaForm::Unrolled),
            format!("**{}**", of(asked, IsaForm::Fast)),
            exact.map_or_else(|| "–".to_owned(), |form| format!("{:.1}", form.time.median_ms)),
            ratio.map_or_else(|| "–".to_owned(), |ratio| format!("**{ratio:.2}**")),
            off(exact.and_then(|form| form.difference_999)),
            format!("**{}**", off(fast.and_then(|form| form.difference_999))),
            off(exact.and_then(|form| form.difference)),
            format!("**{}**", off(fast.and_then(|form| form.difference))),
        ])
    });
    Ok(markdown(&head, rows.collect()))
}
