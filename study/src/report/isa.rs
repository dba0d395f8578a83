//! Section on the figures of GPU compilers.

use crate::record::{FormKind, IsaRecord, Record, SpirvPath};
use serde::Serialize;
use straightline_isa::Gpu;

#[derive(Debug, Serialize)]
pub(super) struct Isa {
    command: String,
    date: String,
    /// Names of the GPUs, where there are several: columns of the chart.
    gpus: Vec<String>,
    /// Rows of the chart: each kernel, and for each GPU what its loop costs over the unrolled text.
    chart: Vec<(String, Vec<Ratio>)>,
    /// Each GPU's device, and the table of its figures.
    families: Vec<(String, String)>,
    /// Why a GPU has no table.
    absent: Vec<String>,
    /// Kernel, form, and why a compiler says nothing of it.
    refused: Vec<[String; 3]>,
}

/// Cost of a looped kernel over that of the unrolled one.
#[derive(Debug, Serialize)]
struct Ratio {
    /// Text of the field: the ratio, or `L` where the compiler keeps a loop.
    text: String,
    /// Class of its colour.
    class: &'static str,
    /// Both costs, for readers who point at it.
    title: String,
}

/// Ratio from which a loop is clearly dearer.
const DEARER: f64 = 1.1;

impl Ratio {
    fn of(record: &IsaRecord, kernel: &str, gpu: &Gpu) -> Option<Ratio> {
        let find = |form, path| record.shader(kernel, form, path)?.figures.get(gpu);
        let unrolled = find(FormKind::Full, SpirvPath::Naga)?.cost()?;
        let looped = find(FormKind::Looped, SpirvPath::NagaBounded)?;
        let unit = gpu.cost_unit();
        let Some(cost) = looped.cost().filter(|_| !looped.keeps_loops()) else {
            return Some(Ratio {
                text: "L".to_owned(),
                class: "beyond",
                title: format!("{kernel}, {gpu}: {unrolled} {unit} unrolled; the compiler keeps the loop"),
            });
        };
        let ratio = cost as f64 / unrolled as f64;
        Some(Ratio {
            text: format!("{ratio:.2}"),
            class: if ratio >= DEARER { "watched" } else { "kept" },
            title: format!("{kernel}, {gpu}: {unrolled} {unit} unrolled, {cost} looped"),
        })
    }
}

/// Rows of the chart, for a record of several GPUs.
fn chart_rows(record: &IsaRecord) -> Vec<(String, Vec<Ratio>)> {
    let row = |kernel: &&str| {
        let each = record.devices.keys().map(|gpu| Ratio::of(record, kernel, gpu));
        Some(((*kernel).to_owned(), each.collect::<Option<Vec<_>>>()?))
    };
    record.kernels().iter().filter_map(row).collect()
}

pub(super) fn build_section(record: &IsaRecord) -> Isa {
    let table_of = |(gpu, device): (&Gpu, &String)| {
        let table = record.of_gpu(*gpu).to_table();
        (format!("{gpu}: {device}"), table.to_html())
    };
    let refused = record.shaders.iter().filter_map(|asked| {
        let why = asked.refused.clone()?;
        Some([asked.kernel.clone(), asked.form.display_name().to_owned(), why])
    });
    let is_chart = record.devices.len() > 1;
    Isa {
        gpus: record.devices.keys().filter(|_| is_chart).map(Gpu::to_string).collect(),
        chart: if is_chart { chart_rows(record) } else { Vec::new() },
        command: record.command.clone(),
        date: record.date.clone(),
        families: record.devices.iter().map(table_of).collect(),
        absent: record.absent.values().cloned().collect(),
        refused: refused.collect(),
    }
}
