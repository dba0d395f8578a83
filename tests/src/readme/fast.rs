//! Gain from mathematics that may change roundings.

use straightline_study::record::{FormKind, FormRecord, IsaRecord, LoopsRecord, SpirvPath};
use straightline_table::{Cell, Table};

/// Cycles by a compiler, and errors on a driver, of exact and of fast mathematics.
pub fn mathematics(cycles: &IsaRecord, times: &LoopsRecord) -> Table {
    let fast = cycles.shaders.iter();
    let fast = fast.filter(|asked| asked.form == FormKind::FullFast && asked.path == SpirvPath::Naga);
    let rows = fast.filter_map(|asked| {
        let mut kernels = times.kernels.iter();
        let timed = kernels.find(|kernel| kernel.kernel == asked.kernel && kernel.options == asked.options)?;
        let cycles =
            [FormKind::Full, FormKind::FullFast].map(|form| Some(cycles.counterpart(asked, form)?.inverse_throughput));
        Some((
            asked,
            cycles,
            [FormKind::Full, FormKind::FullFast].map(|kind| timed.form(kind)),
        ))
    });
    let bold = |cell: Option<String>| format!("**{}**", cell.unwrap_or_else(|| "–".to_owned()));
    let off = |form: Option<&FormRecord>, all: bool| {
        let off = form.and_then(|form| if all { form.difference } else { form.difference_999 });
        off.map(|off| format!("{off:.0e}"))
    };
    Table::of(rows)
        .column("kernel", |(asked, ..)| &asked.kernel)
        .column("cycles", |(_, [exact, _], _)| exact.map(Cell::from))
        .column("**fast**", |(_, [_, fast], _)| bold(fast.map(|fast| fast.to_string())))
        .column("off f64 by", |(.., [exact, _])| off(*exact, false))
        .column("**fast**", |(.., [_, fast])| bold(off(*fast, false)))
        .column("all pixels", |(.., [exact, _])| off(*exact, true))
        .column("**fast**", |(.., [_, fast])| bold(off(*fast, true)))
        .finish()
}
