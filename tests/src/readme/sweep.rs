//! Gain from partial unrolling of a convolution.

use super::markdown;
use straightline_study::record::{SweepRecord, Swept};
use straightline_study::sweep::Axis;

/// A row for each value of the first axis, a column for each other variant: milliseconds of the baseline, else how many times
/// as fast it is.
pub fn factors(record: &SweepRecord) -> Result<String, String> {
    let varied = || record.axes.iter().filter(|axis| axis.values.len() > 1);
    let rows = varied().next().ok_or("nothing is varied")?;
    let columns: Vec<&Axis> = varied().skip(1).collect();
    let label = |variant: &Swept| {
        let value = |axis: &&Axis| variant.settings.get(&axis.name).cloned();
        columns.iter().filter_map(value).collect::<Vec<_>>().join(", ")
    };
    let of = |value: &String| {
        let in_row = |variant: &&Swept| variant.settings.get(&rows.name) == Some(value);
        record.variants.iter().filter(in_row).collect::<Vec<_>>()
    };
    let first = rows.values.first().map(of).unwrap_or_default();
    let labels: Vec<String> = first.iter().map(|variant| label(variant)).collect();
    let head: Vec<&str> = std::iter::once(rows.name.as_str())
        .chain(labels.iter().map(String::as_str))
        .collect();
    let cell = |variant: &&Swept| match &variant.measured {
        None => "–".to_owned(),
        Some(measured) if record.is_baseline(variant) => format!("{:.1} ms", measured.median_ms),
        Some(measured) => match &measured.speedup {
            Some(ratio) => format!("{:.2} ({:.2} to {:.2})", ratio.median, ratio.low, ratio.high),
            None => format!("{:.1} ms", measured.median_ms),
        },
    };
    let row = |value: &String| {
        let cells = of(value).iter().map(cell).collect::<Vec<_>>();
        [vec![value.clone()], cells].concat()
    };
    Ok(markdown(&head, rows.values.iter().map(row).collect()))
}
