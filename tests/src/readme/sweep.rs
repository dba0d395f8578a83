//! Gain from partial unrolling of a convolution.

use straightline_study::record::{SweepRecord, Swept};
use straightline_study::statistics::mark_ratio;
use straightline_study::sweep::Axis;
use straightline_table::{Cell, Table};

/// A row for each value of the first axis, a column for each other variant: milliseconds of the baseline, else how many times
/// as fast it is.
pub fn factors(record: &SweepRecord) -> Result<Table, String> {
    let noise = record.noise();
    let varied = || record.axes.iter().filter(|axis| axis.values.len() > 1);
    let rows = varied().next().ok_or("nothing is varied")?;
    let label = |variant: &Swept| {
        let value = |axis: &Axis| variant.settings.get(&axis.name).cloned();
        varied().skip(1).filter_map(value).collect::<Vec<_>>().join(", ")
    };
    let of = |value: &String| {
        let in_row = |variant: &&Swept| variant.settings.get(&rows.name) == Some(value);
        record.variants.iter().filter(in_row).collect::<Vec<_>>()
    };
    let first = rows.values.first().map(of).unwrap_or_default();
    Ok(Table::of(&rows.values)
        .column(&*rows.name, |value| *value)
        .columns(
            first.into_iter().enumerate(),
            |(_, variant)| label(variant),
            |value, (k, _)| {
                let variant = *of(value).get(*k)?;
                let measured = variant.measured.as_ref()?;
                Some(match measured.speedup.filter(|_| !record.is_baseline(variant)) {
                    Some(ratio) => Cell::interval(ratio.to_array(), 2).suffixed(mark_ratio(noise, ratio.median)),
                    None => Cell::fixed(measured.median_ms, 1).suffixed(" ms"),
                })
            },
        )
        .finish())
}
