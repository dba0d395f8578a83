//! Gain from workgroups that share texels.

use super::markdown;
use straightline_isa::Figures;
use straightline_study::record::{Asked, FormKind, FormRecord, IsaForm, IsaRecord, LoopsRecord, SpirvPath};

/// Cycles by a compiler: each pixel reading for itself, and by workgroups.
pub fn cycles(record: &IsaRecord) -> Result<String, String> {
    let Some(family) = record.devices.keys().next() else {
        return Err("the record has no family".to_owned());
    };
    let head = [
        "kernel",
        "image instructions",
        "**shared**",
        "and on shared memory",
        "bytes of it",
        "instructions",
        "shared",
        "waves at once",
        "shared",
        "cycles",
        "shared",
    ];
    let of = |name: &str, form| -> Option<&Figures> {
        let is = |asked: &&Asked| asked.kernel == name && asked.form == form && asked.path == SpirvPath::Naga;
        record.shaders.iter().find(is)?.figures.get(family)
    };
    let shared = record.shaders.iter().filter(|asked| asked.form == IsaForm::Tile);
    let rows = shared
        .filter(|asked| asked.path == SpirvPath::Naga)
        .filter_map(|asked| {
            let (alone, shared) = (of(&asked.kernel, IsaForm::Unrolled)?, asked.figures.get(family)?);
            let images = |figures: &Figures| figures.memory - figures.shared;
            Some(vec![
                asked.kernel.clone(),
                images(alone).to_string(),
                format!("**{}**", images(shared)),
                shared.shared.to_string(),
                shared.shared_memory.to_string(),
                alone.instructions.to_string(),
                shared.instructions.to_string(),
                alone.occupancy.to_string(),
                shared.occupancy.to_string(),
                alone.inverse_throughput.to_string(),
                shared.inverse_throughput.to_string(),
            ])
        });
    Ok(markdown(&head, rows.collect()))
}

/// Times: of each pixel reading for itself, by blocks, and by workgroups.
pub fn times(record: &LoopsRecord) -> String {
    let head = [
        "kernel",
        "reads",
        "shared",
        "unrolled",
        "2×2 pixels",
        "**shared by workgroups**",
    ];
    let ms = |form: Option<&FormRecord>| {
        form.map_or_else(|| "–".to_owned(), |form| format!("{:.1} ms", form.time.median_ms))
    };
    let rows = record.kernels.iter().filter_map(|kernel| {
        let (full, tile) = (kernel.form(FormKind::Full)?, kernel.form(FormKind::FullTile)?);
        Some(vec![
            kernel.kernel.clone(),
            full.reads.to_string(),
            tile.reads.to_string(),
            ms(Some(full)),
            ms(kernel.form(FormKind::FullBlock)),
            format!("**{}**", ms(Some(tile))),
        ])
    });
    markdown(&head, rows.collect())
}
