//! Cheapest variants that meet the needs of scenes.

use straightline_study::record::{Candidate, TuneRecord, join_options};
use straightline_table::{Cell, Table};

/// Chosen variant of every scene.
pub fn scenes(records: &[TuneRecord]) -> Table {
    let unit = |record: &TuneRecord| if record.metric == "flip" { "" } else { " dB" };
    let rows = records.iter();
    let rows = rows.map(|record| (record, record.chosen.and_then(|index| record.candidates.get(index))));
    Table::of(rows)
        .column("scene", |(record, _)| &record.scene)
        .column("budget", |(record, _)| format!("{}{}", record.max_error, unit(record)))
        .column("chosen", |(_, chosen)| chosen.map(describe_variant))
        .column("lost", |(record, chosen)| {
            chosen.map(|c| Cell::fixed((c.error - record.best).abs(), 3).suffixed(unit(record)))
        })
        .column("ms", |(_, chosen)| {
            let time = chosen.and_then(|c| c.time.as_ref())?;
            Some(Cell::fixed(time.median_ms, 1))
        })
        .column("speedup over the most general", |(_, chosen)| {
            let ratio = chosen.and_then(|c| c.ratio)?;
            Some(Cell::interval(ratio.to_array(), 2))
        })
        .percent("model off by", 0, |(record, _)| record.model.mean_error)
        .finish()
}

fn describe_variant(c: &Candidate) -> String {
    let mut words = vec![join_options(&c.options)];
    words.extend((c.precision != "f32").then(|| c.precision.clone()));
    words.extend((c.math != "exact").then(|| format!("math {}", c.math)));
    words.extend((c.block != [1, 1]).then(|| format!("block {}x{}", c.block[0], c.block[1])));
    words.retain(|words| !words.is_empty());
    format!("`{}`", words.join(" "))
}
