//! Gain from reading four texels at once.

use straightline_isa::Figures;
use straightline_study::record::{FormKind, FormRecord, IsaRecord, KernelForms, LoopsRecord, SpirvPath};
use straightline_table::{Cell, Table};

/// Instructions that read or write images, registers, cycles and latency of kernels without gathers and with them; of those
/// of which no branch is left but the border's, whose cycles are no guesses.
pub fn gathers(record: &IsaRecord) -> Table {
    type Pair<'r> = (&'r String, &'r Figures, &'r Figures);
    let gathered = record.shaders.iter();
    let gathered = gathered.filter(|asked| asked.form == FormKind::FullGather && asked.path == SpirvPath::Naga);
    let rows = gathered.filter_map(|asked| -> Option<Pair<'_>> {
        let four = asked.figures.values().next().filter(|four| four.branches <= 1)?;
        Some((&asked.kernel, record.counterpart(asked, FormKind::Full)?, four))
    });
    Table::of(rows)
        .column("kernel", |(kernel, ..)| *kernel)
        .column("image instructions", |(_, alone, _)| alone.memory)
        .column("**gathered**", |(.., four)| format!("**{}**", four.memory))
        .column("registers", |(_, alone, _)| alone.vector_registers)
        .column("gathered", |(.., four)| four.vector_registers)
        .column("cycles", |(_, alone, _)| alone.inverse_throughput)
        .column("**gathered**", |(.., four)| format!("**{}**", four.inverse_throughput))
        .column("latency", |(_, alone, _)| alone.latency)
        .column("gathered", |(.., four)| four.latency)
        .finish()
}

/// Times without gathers and with them, on each driver, and what of the speedup over the looped form is left if the one is
/// divided by the other.
pub fn times(records: &[LoopsRecord]) -> Result<Table, String> {
    let [first, ..] = records else {
        return Err("no record is given".to_owned());
    };
    let both = |record: &'_ LoopsRecord, name: &str| -> Option<[FormRecord; 2]> {
        let kernel: &KernelForms = record.kernels.iter().find(|other| other.kernel == name)?;
        Some([
            kernel.form(FormKind::Full)?.clone(),
            kernel.form(FormKind::FullGather)?.clone(),
        ])
    };
    let rows = first.kernels.iter().filter_map(|kernel| {
        let all: Option<Vec<_>> = records.iter().map(|record| both(record, &kernel.kernel)).collect();
        Some((&kernel.kernel, all?))
    });
    let mut table = Table::of(rows)
        .column("kernel", |(kernel, _)| *kernel)
        .column("reads", |(_, all)| all[0][0].reads)
        .column("gathered", |(_, all)| all[0][1].reads);
    for (k, record) in records.iter().enumerate() {
        let name = record.circumstances.adapter.split(' ').next().unwrap_or_default();
        let ms = |form: &FormRecord| Cell::fixed(form.time.median_ms, 1).suffixed(" ms");
        table = table
            .column(format!("unrolled, {name}"), |(_, all)| ms(&all[k][0]))
            .column(format!("gathered, {name}"), |(_, all)| ms(&all[k][1]))
            .column(format!("**speedup**, {name}"), |(_, all)| {
                format!("**{:.2}**", all[k][1].ratio.median / all[k][0].ratio.median)
            });
    }
    Ok(table.finish())
}
