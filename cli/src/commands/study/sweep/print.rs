//! Output of sweeps as text.

use crate::failure::format_count;
use crate::table;
use std::collections::BTreeMap;
use straightline_study::record::{SweepRecord, Swept};
use straightline_study::sweep::{Axis, Compared, Interval};

/// Prints a table of all variants, and the reasons for rejected ones.
pub fn print_record(record: &SweepRecord) {
    let c = &record.circumstances;
    outln!(
        "{} on {}, {}x{}, {}, {}{}\n",
        record.kernel,
        c.adapter,
        c.size[0],
        c.size[1],
        match record.until {
            Some(until) => format!(
                "until ±{:.1} %, at most {}",
                100.0 * until,
                format_count(c.rounds as usize, "round")
            ),
            None => format_count(c.rounds as usize, "round"),
        },
        c.date,
        if c.complete { "" } else { "; interrupted" }
    );
    let axes = varied_axes(record);
    let rivals = record.variants.iter().any(|variant| variant.rival.is_some());
    let mut head: Vec<&str> = axes.iter().map(|axis| axis.name.as_str()).collect();
    if rivals {
        head.push("rival");
    }
    head.extend([
        "rounds",
        "ms",
        "speedup (95 %)",
        "loops",
        "statements",
        "reads",
        "off f64, 99.9 %",
        "largest",
    ]);
    let row = |variant: &Swept| {
        let measured = variant.measured.as_ref()?;
        let number = |number: Option<u32>| number.map_or(String::new(), |number| number.to_string());
        let mut row = setting_values(&axes, &variant.settings);
        if rivals {
            row.push(variant.rival.clone().unwrap_or_default());
        }
        row.extend([
            measured.rounds_ms.len().to_string(),
            format!("{:.3}", measured.median_ms),
            match record.is_baseline(variant) {
                true => "baseline".to_owned(),
                false => measured.speedup.as_ref().map_or(String::new(), format_interval),
            },
            number(measured.loops),
            number(measured.statements),
            number(measured.reads),
            format!("{:.1e}", measured.difference_999),
            format!("{:.1e}", measured.difference),
        ]);
        Some(row)
    };
    let rows: Vec<Vec<String>> = record.variants.iter().filter_map(row).collect();
    out!("{}", table::render_table(&head, &rows));
    let base: Vec<String> = record
        .baseline
        .iter()
        .map(|(name, value)| format!("{name}={value}"))
        .collect();
    outln!(
        "\nspeedup: over {}, all else equal; median of the rounds, and in which interval it lies with 95 %",
        base.join(" ")
    );
    for variant in &record.variants {
        if let Some(why) = &variant.refused {
            let mut what: Vec<String> = axes
                .iter()
                .filter_map(|axis| Some(format!("{}={}", axis.name, variant.settings.get(&axis.name)?)))
                .collect();
            what.extend(variant.rival.clone());
            outln!("not measured, {}: {why}", what.join(" "));
        }
    }
}

/// Prints the comparison of two records.
pub fn print_comparison(record: &SweepRecord, compared: &[Compared]) {
    let axes = varied_axes(record);
    let mut head: Vec<&str> = axes.iter().map(|axis| axis.name.as_str()).collect();
    head.extend(["rival", "first", "second", "second by first", ""]);
    let row = |of: &Compared| {
        let mut row = setting_values(&axes, &of.settings);
        row.push(of.rival.clone().unwrap_or_default());
        row.extend(of.speedup.map(|ratio| format!("{ratio:.3}")));
        row.push(format_interval(&of.quotient));
        row.push(if of.differs { "differs" } else { "" }.to_owned());
        row
    };
    out!(
        "{}",
        table::render_table(&head, &compared.iter().map(row).collect::<Vec<_>>())
    );
    outln!(
        "\nfirst, second: speedup over the baseline. Of all intervals together 95 % hold what they should, for these two runs: \
         how other runs would differ they do not say."
    );
}

/// Returns the axes with several values, or the baseline's axes if no axis has several.
fn varied_axes(record: &SweepRecord) -> Vec<&Axis> {
    let several: Vec<&Axis> = record.axes.iter().filter(|axis| axis.values.len() > 1).collect();
    match several.is_empty() {
        true => record
            .axes
            .iter()
            .filter(|axis| record.baseline.contains_key(&axis.name))
            .collect(),
        false => several,
    }
}

fn setting_values(axes: &[&Axis], settings: &BTreeMap<String, String>) -> Vec<String> {
    let value = |axis: &&Axis| settings.get(&axis.name).cloned().unwrap_or_default();
    axes.iter().map(value).collect()
}

fn format_interval(of: &Interval) -> String {
    format!("{:.2} ({:.2} to {:.2})", of.median, of.low, of.high)
}
