//! Gain from workgroups that share texels.

use straightline_isa::Figures;
use straightline_study::record::{FormKind, FormRecord, IsaRecord, LoopsRecord, SpirvPath};
use straightline_table::{Cell, Table};

/// Cycles by a compiler: each pixel reading for itself, and by workgroups.
pub fn cycles(record: &IsaRecord) -> Table {
    let shared = record.shaders.iter();
    let shared = shared.filter(|asked| asked.form == FormKind::FullTile && asked.path == SpirvPath::Naga);
    let rows = shared.filter_map(|asked| {
        let alone = record.figures(&asked.kernel, FormKind::Full, SpirvPath::Naga)?;
        Some((&asked.kernel, alone, asked.figures.values().next()?))
    });
    let images = |figures: &Figures| figures.memory - figures.shared;
    Table::of(rows)
        .column("kernel", |(kernel, ..)| *kernel)
        .column("image instructions", |(_, alone, _)| images(alone))
        .column("**shared**", |(.., shared)| format!("**{}**", images(shared)))
        .column("and on shared memory", |(.., shared)| shared.shared)
        .column("bytes of it", |(.., shared)| shared.shared_memory)
        .column("instructions", |(_, alone, _)| alone.instructions)
        .column("shared", |(.., shared)| shared.instructions)
        .column("waves at once", |(_, alone, _)| alone.occupancy)
        .column("shared", |(.., shared)| shared.occupancy)
        .column("cycles", |(_, alone, _)| alone.inverse_throughput)
        .column("shared", |(.., shared)| shared.inverse_throughput)
        .finish()
}

/// Times: of each pixel reading for itself, by blocks, and by workgroups.
pub fn times(record: &LoopsRecord) -> Table {
    let ms = |form: &FormRecord| Cell::fixed(form.time.median_ms, 1).suffixed(" ms");
    let rows = record.kernels.iter();
    let rows = rows.filter_map(|kernel| Some((kernel, kernel.form(FormKind::Full)?, kernel.form(FormKind::FullTile)?)));
    Table::of(rows)
        .column("kernel", |(kernel, ..)| &kernel.kernel)
        .column("reads", |(_, full, _)| full.reads)
        .column("shared", |(.., tile)| tile.reads)
        .column("unrolled", |(_, full, _)| ms(full))
        .column("2×2 pixels", |(kernel, ..)| kernel.form(FormKind::FullBlock).map(ms))
        .column("**shared by workgroups**", |(.., tile)| {
            format!("**{:.1} ms**", tile.time.median_ms)
        })
        .finish()
}
