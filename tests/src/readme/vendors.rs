//! Statistics of several vendors' compilers.

use super::rank::{pearson, ranks};
use straightline_isa::{Figures, Gpu};
use straightline_study::loops::list_subjects;
use straightline_study::record::{Asked, FormKind, IsaRecord, SpirvPath};
use straightline_table::Table;

/// GPUs of the table of loops: two of each vendor where there are two kinds, and their names there.
const SHOWN: [(&str, &str); 6] = [
    ("amd:navi21", "AMD Navi 21"),
    ("amd:gfx1201", "AMD gfx1201"),
    ("nvidia:ampere", "NVIDIA Ampere"),
    ("nvidia:blackwell", "NVIDIA Blackwell"),
    ("qualcomm:adreno730", "Adreno 730"),
    ("apple:m1", "Apple M1"),
];

/// Ways of a looped kernel, in the order of a cell.
const WAYS: [(FormKind, SpirvPath); 4] = [
    (FormKind::Full, SpirvPath::Naga),
    (FormKind::Looped, SpirvPath::Naga),
    (FormKind::Looped, SpirvPath::NagaBounded),
    (FormKind::Looped, SpirvPath::Glslang),
];

/// Kernels whose registers are shown.
const KERNELS: [&str; 4] = ["SRAA 4", "SRAA 16", "bilateral", "kuwahara"];

/// Cycles if the compiler states those of a wave among many, else instructions; `L` where a loop is left.
fn cost(figures: &Figures) -> String {
    let cost = match figures.inverse_throughput {
        0 => figures.instructions,
        cycles => cycles,
    };
    match figures.keeps_loops() {
        true => format!("{cost} L"),
        false => cost.to_string(),
    }
}

/// Each kernel on some GPUs: unrolled, looped by naga, the same with wgpu's counter, looped by glslang.
pub fn loops(record: &IsaRecord) -> Result<Table, String> {
    let shown: Vec<(Gpu, &str)> = SHOWN
        .iter()
        .map(|(gpu, title)| Ok((gpu.parse()?, *title)))
        .collect::<Result<_, String>>()?;
    Ok(Table::of(record.kernels())
        .column("kernel", |kernel| *kernel)
        .columns(
            shown,
            |(_, title)| *title,
            |kernel, (gpu, _)| {
                let cells = WAYS.iter().enumerate().map(|(k, (form, path))| {
                    let cost = record
                        .shader(kernel, *form, *path)
                        .and_then(|asked| asked.figures.get(gpu))
                        .map(cost);
                    match (k, cost) {
                        (_, None) => "–".to_owned(),
                        (0, Some(cost)) => format!("**{cost}**"),
                        (_, Some(cost)) => cost,
                    }
                });
                cells.collect::<Vec<_>>().join(", ")
            },
        )
        .finish())
}

/// Each way of a loop to SPIR-V: how many kernels' loops the compilers keep, and what the others cost over the unrolled text.
///
/// # Errors
///
/// A built-in kernel is missing.
pub fn in_short(record: &IsaRecord) -> Result<Table, String> {
    // A record of all has further kernels, which make no such comparison.
    let studied = list_subjects(false).map_err(|errors| errors.first_message().to_owned())?;
    let is_studied = |asked: &&Asked| studied.iter().any(|subject| subject.name == asked.kernel);
    let ways = [
        ("naga", SpirvPath::Naga),
        ("naga, with wgpu's counter", SpirvPath::NagaBounded),
        ("naga, with the hint to keep loops", SpirvPath::NagaKept),
        ("naga, with the hint to unroll", SpirvPath::NagaUnrolled),
        ("glslang", SpirvPath::Glslang),
    ];
    let rows = ways.map(|(title, path)| {
        let looped = record
            .shaders
            .iter()
            .filter(|asked| asked.form == FormKind::Looped && asked.path == path);
        let looped: Vec<&Asked> = looped.filter(is_studied).collect();
        let is_kept = |asked: &Asked, gpu: &Gpu| asked.figures.get(gpu).is_some_and(Figures::keeps_loops);
        let kept = record
            .devices
            .keys()
            .map(|gpu| looped.iter().filter(|asked| is_kept(asked, gpu)).count());
        let (fewest, most) = (kept.clone().min().unwrap_or(0), kept.max().unwrap_or(0));
        let mut ratios: Vec<f64> = record
            .devices
            .keys()
            .flat_map(|gpu| looped.iter().map(move |asked| (gpu, *asked)))
            .filter(|(gpu, asked)| !is_kept(asked, gpu))
            .filter_map(|(gpu, asked)| {
                let unrolled = record.shader(&asked.kernel, FormKind::Full, SpirvPath::Naga)?;
                Some(asked.figures.get(gpu)?.cost()? as f64 / unrolled.figures.get(gpu)?.cost()? as f64)
            })
            .collect();
        ratios.sort_by(f64::total_cmp);
        let at = |k: usize| ratios.get(k).map(|ratio| format!("{ratio:.2}"));
        let range = [0, ratios.len() / 2, ratios.len().saturating_sub(1)].map(at);
        let kept = match fewest == most {
            true => most.to_string(),
            false => format!("{fewest} to {most}"),
        };
        (title, looped.len(), kept, range)
    });
    Ok(Table::of(&rows)
        .column("SPIR-V by", |row| row.0)
        .column("kernels", |row| row.1)
        .column("loops kept, of a GPU", |row| &row.2)
        .column("cost of the others over unrolled: least", |row| row.3[0].clone())
        .column("median", |row| row.3[1].clone())
        .column("largest", |row| row.3[2].clone())
        .finish())
}

/// Each GPU: the same work by our text and by Slang's, with 4 and with 16 samples.
pub fn rivals(record: &IsaRecord) -> Table {
    let figures = |gpu: &Gpu, kernel: &str, form| {
        let asked = record.shader(kernel, form, SpirvPath::Naga)?;
        asked.figures.get(gpu).map(cost)
    };
    let ours = |gpu: &Gpu, kernel: &str| figures(gpu, kernel, FormKind::Full).map(|cost| format!("**{cost}**"));
    Table::of(record.devices.keys())
        .column("GPU", |gpu| gpu.to_string())
        .column("unit", |gpu| gpu.cost_unit())
        .column("**4 samples**", |gpu| ours(gpu, "SRAA 4, as in Slang"))
        .column("by Slang", |gpu| figures(gpu, "SRAA 4, as in Slang", FormKind::Slang))
        .column("**16 samples**", |gpu| ours(gpu, "SRAA 16, as in Slang"))
        .column("by Slang", |gpu| figures(gpu, "SRAA 16, as in Slang", FormKind::Slang))
        .finish()
}

/// Each GPU: registers and how much runs at once, of some kernels as they are and in blocks of 2x2; and how well the order of
/// shaders by scalars alive is that by registers.
pub fn registers(record: &IsaRecord) -> Table {
    let words = |gpu: &Gpu, kernel: &str, form| {
        let figures = record.shader(kernel, form, SpirvPath::Naga)?.figures.get(gpu)?;
        let spilled = match figures.spilled {
            0 => String::new(),
            spilled => format!(", {spilled} spilled"),
        };
        Some(format!("{} ({}{spilled})", figures.vector_registers, figures.occupancy))
    };
    let both = |gpu: &Gpu, kernel: &str| {
        let block = words(gpu, kernel, FormKind::FullBlock)?;
        Some(format!("{}; {block}", words(gpu, kernel, FormKind::Full)?))
    };
    let agreement = |gpu: &Gpu| {
        let by_naga = record.shaders.iter().filter(|asked| asked.path == SpirvPath::Naga);
        let shaders = by_naga.filter_map(|asked| Some((asked.alive?, asked.figures.get(gpu)?.vector_registers)));
        let (alive, registers): (Vec<f64>, Vec<f64>) = shaders.map(|(a, r)| (f64::from(a), r as f64)).unzip();
        format!("{:.2}", pearson(&ranks(&alive), &ranks(&registers)))
    };
    Table::of(record.devices.keys())
        .column("GPU", |gpu| gpu.to_string())
        .column("at once", |gpu| gpu.occupancy_unit())
        .columns(KERNELS, |kernel| *kernel, |gpu, kernel| both(gpu, kernel))
        .column("by scalars alive", |gpu| agreement(gpu))
        .finish()
}
