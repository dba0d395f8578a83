//! Gain from reading four texels at once.

use super::markdown;
use straightline_isa::Figures;
use straightline_study::record::{Asked, FormKind, FormRecord, IsaForm, IsaRecord, LoopsRecord, SpirvPath};

/// Instructions that read or write images, registers, cycles and latency of kernels without gathers and with them; of those
/// of which no branch is left but the border's, whose cycles are no guesses.
pub fn gathers(record: &IsaRecord) -> Result<String, String> {
    let Some(family) = record.devices.keys().next() else {
        return Err("the record has no family".to_owned());
    };
    let head = [
        "kernel",
        "image instructions",
        "**gathered**",
        "registers",
        "gathered",
        "cycles",
        "**gathered**",
        "latency",
        "gathered",
    ];
    let gathered = |asked: &&Asked| asked.form == IsaForm::Gather && asked.path == SpirvPath::Naga;
    let rows = record.shaders.iter().filter(gathered).filter_map(|asked| {
        let is = |other: &&Asked| {
            (&other.kernel, &other.options, other.form, other.path)
                == (&asked.kernel, &asked.options, IsaForm::Unrolled, SpirvPath::Naga)
        };
        let alone = record.shaders.iter().find(is)?.figures.get(family)?;
        let four = asked.figures.get(family).filter(|four| four.branches <= 1)?;
        let pair = |of: fn(&Figures) -> u64, bold: bool| {
            let four = of(four);
            [
                of(alone).to_string(),
                if bold { format!("**{four}**") } else { four.to_string() },
            ]
        };
        let cells = [
            pair(|f| f.memory, true),
            pair(|f| f.vector_registers, false),
            pair(|f| f.inverse_throughput, true),
            pair(|f| f.latency, false),
        ];
        Some(
            std::iter::once(asked.kernel.clone())
                .chain(cells.into_iter().flatten())
                .collect(),
        )
    });
    Ok(markdown(&head, rows.collect()))
}

/// Times without gathers and with them, on each driver, and what of the speedup over the looped form is left if the one is
/// divided by the other.
pub fn times(records: &[LoopsRecord]) -> Result<String, String> {
    let [first, ..] = records else {
        return Err("no record is given".to_owned());
    };
    let mut head = vec!["kernel".to_owned(), "reads".to_owned(), "gathered".to_owned()];
    for record in records {
        let name = record.circumstances.adapter.split(' ').next().unwrap_or_default();
        head.extend(["unrolled", "gathered", "**speedup**"].map(|what| format!("{what}, {name}")));
    }
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let rows = first.kernels.iter().filter_map(|kernel| {
        let reads = |kind| kernel.form(kind).map(|form: &FormRecord| form.reads.to_string());
        let mut cells = vec![
            kernel.kernel.clone(),
            reads(FormKind::Full)?,
            reads(FormKind::FullGather)?,
        ];
        for record in records {
            let same = record.kernels.iter().find(|other| other.kernel == kernel.kernel)?;
            let (full, gathered) = (same.form(FormKind::Full)?, same.form(FormKind::FullGather)?);
            cells.extend([full, gathered].map(|form| format!("{:.1} ms", form.time.median_ms)));
            cells.push(format!("**{:.2}**", gathered.ratio.median / full.ratio.median));
        }
        Some(cells)
    });
    Ok(markdown(&head, rows.collect()))
}
