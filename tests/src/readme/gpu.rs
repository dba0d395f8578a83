//! Tables of a GPU: forms and workgroups by time, and figures of its own compiler.

use super::in_ms;
use straightline_isa::Figures;
use straightline_study::record::{FormKind, IsaRecord, KernelForms, LoopsRecord, SpirvPath};
use straightline_table::{Cell, Table};

/// Time of each kernel's looped form, and the speedups of the others over it.
pub fn forms(record: &LoopsRecord) -> Table {
    let forms = [
        ("unbounded", FormKind::LoopedUnchecked),
        ("hand-optimised", FormKind::LoopedByHand),
        ("both", FormKind::LoopedByHandUnchecked),
        ("**unrolled**", FormKind::Full),
        ("2×2 pixels", FormKind::FullBlock),
        ("shared by workgroups", FormKind::FullTile),
        ("f16", FormKind::FullHalf),
        ("floor", FormKind::Floor),
    ];
    Table::of(&record.kernels)
        .column("kernel", |kernel| &kernel.kernel)
        .column("looped", |kernel| {
            Some(in_ms(kernel.form(FormKind::Looped)?.time.median_ms, 1) + " ms")
        })
        .columns(
            forms,
            |(title, _)| *title,
            |kernel, (_, kind)| Some(format!("{:.2}", kernel.form(*kind)?.ratio.median)),
        )
        .column("off f64 by", |kernel| {
            Some(Cell::scientific(kernel.form(FormKind::Full)?.difference_999?, 0))
        })
        .finish()
}

/// Unrolled kernels in workgroups that are rows, and in squares: speedups over the looped form, of the kernels that both have.
pub fn workgroups(squares: &LoopsRecord, rows: &LoopsRecord) -> Table {
    let speedup = |kernel: &KernelForms, kind| Some(format!("{:.2}", kernel.form(kind)?.ratio.median));
    let both = squares.kernels.iter().filter_map(|square| {
        let row = rows.kernels.iter().find(|row| row.kernel == square.kernel)?;
        Some((square, row))
    });
    Table::of(both)
        .column("kernel", |(square, _)| &square.kernel)
        .column("unrolled, 256x1", |(_, row)| speedup(row, FormKind::Full))
        .column("16x16", |(square, _)| speedup(square, FormKind::Full))
        .column("2×2 pixels, 256x1", |(_, row)| speedup(row, FormKind::FullBlock))
        .column("16x16", |(square, _)| speedup(square, FormKind::FullBlock))
        .finish()
}

/// Registers and bytes of code of each kernel, unrolled and by three ways to leave its loops to the compiler.
pub fn registers(record: &IsaRecord) -> Table {
    let has_loops = |kernel: &&str| record.figures(kernel, FormKind::Looped, SpirvPath::Naga).is_some();
    let ways = [
        ("**unrolled**", FormKind::Full, SpirvPath::Naga),
        ("looped, unbounded", FormKind::Looped, SpirvPath::Naga),
        ("looped", FormKind::Looped, SpirvPath::NagaBounded),
        ("looped, by glslang", FormKind::Looped, SpirvPath::Glslang),
        ("unrolled, 2×2 pixels", FormKind::FullBlock, SpirvPath::Naga),
    ];
    let words = |figures: &Figures| {
        let spilled = match figures.own.get("Stack Size") {
            Some(bytes @ 1..) => format!(", {bytes} B on the stack"),
            _ => String::new(),
        };
        let (registers, bytes) = (figures.vector_registers, figures.code_size);
        format!("{registers} ({:.1} kB{spilled})", bytes as f64 / 1000.0)
    };
    Table::of(record.kernels().into_iter().filter(has_loops))
        .column("kernel", |kernel| *kernel)
        .columns(
            ways,
            |(title, ..)| *title,
            |kernel, (_, form, path)| record.figures(kernel, *form, *path).map(words),
        )
        .finish()
}
