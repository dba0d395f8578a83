//! Statistics of GPU compilers.

use straightline_isa::Figures;
use straightline_study::record::{FormKind, IsaRecord, SpirvPath};
use straightline_table::{Cell, Table};

/// Each kernel on one family: the unrolled form in full, of looped forms cycles and branches.
pub fn cycles(record: &IsaRecord) -> Table {
    let unrolled = |name: &str, figure: fn(&Figures) -> u64| {
        record
            .figures(name, FormKind::Full, SpirvPath::Naga)
            .map(figure)
            .map(Cell::from)
    };
    let looped = |name: &str, form, path| {
        let figures = record.figures(name, form, path);
        figures.map(|figures| format!("{}, {}", figures.inverse_throughput, figures.branches))
    };
    Table::of(record.kernels())
        .column("kernel", |name| *name)
        .column("instructions", |name| unrolled(name, |f| f.instructions))
        .column("memory", |name| unrolled(name, |f| f.memory))
        .column("registers", |name| unrolled(name, |f| f.vector_registers))
        .column("**unrolled**", |name| {
            let figures = record.figures(name, FormKind::Full, SpirvPath::Naga);
            figures.map(|figures| format!("**{}**", figures.inverse_throughput))
        })
        .column("looped", |name| looped(name, FormKind::Looped, SpirvPath::Naga))
        .column("bounded", |name| looped(name, FormKind::Looped, SpirvPath::NagaBounded))
        .column("by glslang", |name| looped(name, FormKind::Looped, SpirvPath::Glslang))
        .column("hand-optimised", |name| {
            looped(name, FormKind::LoopedByHand, SpirvPath::Naga)
        })
        .column("bounded", |name| {
            looped(name, FormKind::LoopedByHand, SpirvPath::NagaBounded)
        })
        .finish()
}

/// Comparison with Slang's compiler, on one family.
pub fn rivals(record: &IsaRecord) -> Table {
    let by_slang = record.shaders.iter().filter(|asked| asked.form == FormKind::Slang);
    let rows = by_slang.filter_map(|asked| {
        let ours = record.figures(&asked.kernel, FormKind::Full, SpirvPath::Naga)?;
        Some((&asked.kernel, ours, asked.figures.values().next()?))
    });
    Table::of(rows)
        .column("kernel", |(kernel, ..)| *kernel)
        .column("instructions", |(_, ours, _)| ours.instructions)
        .column("by Slang", |(.., theirs)| theirs.instructions)
        .column("**cycles**", |(_, ours, _)| format!("**{}**", ours.inverse_throughput))
        .column("by Slang", |(.., theirs)| theirs.inverse_throughput)
        .finish()
}
