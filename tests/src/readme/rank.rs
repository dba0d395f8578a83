//! Correlation between a compiler's cycles and measured times of shaders.

use straightline_study::record::{FormKind, IsaRecord, KernelForms, LoopsRecord, SpirvPath};
use straightline_table::Table;

/// Forms that are compared: as they were timed, and as a compiler was asked about them.
const SAME: [(FormKind, FormKind, SpirvPath); 9] = [
    (FormKind::Looped, FormKind::Looped, SpirvPath::NagaBounded),
    (FormKind::LoopedUnchecked, FormKind::Looped, SpirvPath::Naga),
    (FormKind::LoopedByHand, FormKind::LoopedByHand, SpirvPath::NagaBounded),
    (FormKind::LoopedByHandUnchecked, FormKind::LoopedByHand, SpirvPath::Naga),
    (FormKind::Full, FormKind::Full, SpirvPath::Naga),
    (FormKind::FullBlock, FormKind::FullBlock, SpirvPath::Naga),
    (FormKind::FullTile, FormKind::FullTile, SpirvPath::Naga),
    (FormKind::FullGather, FormKind::FullGather, SpirvPath::Naga),
    (FormKind::FullFast, FormKind::FullFast, SpirvPath::Naga),
];

/// Pixels of the block that cycles of [`FormKind::FullBlock`] are of.
const BLOCK: f64 = 4.0;

/// A shader with its cycles a pixel and its time.
struct Shader {
    kernel: String,
    kind: FormKind,
    /// As the compiler left them.
    branches: u64,
    cycles: f64,
    ms: f64,
}

/// Rank correlations of cycles with the times of each record, of all shaders and of some.
pub fn correlations(cycles: &IsaRecord, times: &[LoopsRecord]) -> Table {
    let mut rows = Vec::new();
    for record in times {
        let shaders: Vec<Shader> = record
            .kernels
            .iter()
            .flat_map(|kernel| SAME.iter().filter_map(|same| shader(cycles, kernel, same)))
            .collect();
        let is_line = |s: &&Shader| {
            matches!(
                s.kind,
                FormKind::Full | FormKind::FullBlock | FormKind::FullGather | FormKind::FullFast
            )
        };
        let some: [(&str, Vec<&Shader>); 4] = [
            ("all", shaders.iter().collect()),
            ("without loops", shaders.iter().filter(is_line).collect()),
            (
                "unrolled, single pixels",
                shaders.iter().filter(|s| s.kind == FormKind::Full).collect(),
            ),
            (
                "loops that the compiler keeps",
                shaders.iter().filter(|s| !is_line(s) && s.branches > 3).collect(),
            ),
        ];
        for (name, shaders) in some {
            let cycles = ranks(&shaders.iter().map(|s| s.cycles).collect::<Vec<_>>());
            let times = ranks(&shaders.iter().map(|s| s.ms).collect::<Vec<_>>());
            let far = farthest(&shaders, &cycles, &times);
            rows.push((driver(record), name, shaders.len(), pearson(&cycles, &times), far));
        }
    }
    Table::of(&rows)
        .column("driver", |row| &row.0)
        .column("shaders", |row| row.1)
        .column("number", |row| row.2)
        .fixed("rank correlation", 2, |row| row.3)
        .column("farthest from their rank", |row| &row.4)
        .finish()
}

fn shader(
    cycles: &IsaRecord,
    kernel: &KernelForms,
    (kind, form, path): &(FormKind, FormKind, SpirvPath),
) -> Option<Shader> {
    let timed = kernel.form(*kind)?;
    let asked = cycles.shaders.iter().find(|asked| {
        (&asked.kernel, &asked.options, &asked.form, &asked.path) == (&kernel.kernel, &kernel.options, form, path)
    })?;
    let figures = asked.figures.values().next()?;
    let pixels = if *form == FormKind::FullBlock { BLOCK } else { 1.0 };
    Some(Shader {
        kernel: kernel.kernel.clone(),
        kind: *kind,
        branches: figures.branches,
        cycles: figures.inverse_throughput as f64 / pixels,
        ms: timed.time.median_ms,
    })
}

/// Driver of a record, in a word.
fn driver(record: &LoopsRecord) -> String {
    let circumstances = &record.circumstances;
    match circumstances.adapter.contains("llvmpipe") {
        true => "lavapipe".to_owned(),
        false => "SwiftShader".to_owned(),
    }
}

/// The rank of each, from 1; of equal ones the mean of theirs.
pub(super) fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |value: &f64| {
        let below = values.iter().filter(|other| *other < value).count();
        let equal = values.iter().filter(|other| *other == value).count();
        below as f64 + (equal as f64 + 1.0) / 2.0
    };
    values.iter().map(rank).collect()
}

/// The correlation coefficient, of ranks Spearman's.
pub(super) fn pearson(a: &[f64], b: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let product = |x: &[f64], mean_x: f64, y: &[f64], mean_y: f64| -> f64 {
        x.iter().zip(y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum()
    };
    product(a, mean_a, b, mean_b) / (product(a, mean_a, a, mean_a) * product(b, mean_b, b, mean_b)).sqrt()
}

/// The three that time puts farthest from where cycles do.
fn farthest(shaders: &[&Shader], cycles: &[f64], times: &[f64]) -> String {
    let mut all: Vec<usize> = (0..shaders.len()).collect();
    let off = |k: usize| times[k] - cycles[k];
    all.sort_by(|a, b| off(*b).abs().total_cmp(&off(*a).abs()));
    let named = all.iter().take(3).map(|k| {
        let shader = shaders[*k];
        let side = if off(*k) > 0.0 { "slower" } else { "faster" };
        format!(
            "{}, {} ({side} by {:.0})",
            shader.kernel,
            shader.kind.display_name(),
            off(*k).abs()
        )
    });
    named.collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_of_equal_values_are_their_mean_and_orders_correlate() {
        assert_eq!(ranks(&[3.0, 1.0, 3.0, 9.0]), [2.5, 1.0, 2.5, 4.0]);
        let (up, down) = ([1.0, 2.0, 3.0], [3.0, 2.0, 1.0]);
        assert!((pearson(&up, &up) - 1.0).abs() < 1e-12 && (pearson(&up, &down) + 1.0).abs() < 1e-12);
        // Spearman's of 1 2 3 4 5 and 2 1 4 3 5: 1 - 6 * 4 / (5 * 24).
        let other = [2.0, 1.0, 4.0, 3.0, 5.0];
        assert!((pearson(&ranks(&[1.0, 2.0, 3.0, 4.0, 5.0]), &ranks(&other)) - 0.8).abs() < 1e-12);
    }
}
