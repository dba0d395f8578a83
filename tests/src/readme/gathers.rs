//! What texels read four at once are worth.

use super::markdown;
use straightline_isa::Figures;
use straightline_study::record::{Asked, IsaForm, IsaRecord, SpirvPath};

/// Instructions that read or write images, registers, cycles and latency of kernels without gathers and with them.
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
        let four = asked.figures.get(family)?;
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
