//! Gain from sharing work over pixel quads.

use super::in_ms;
use straightline_manifest::Stage;
use straightline_study::record::{QuadWay, QuadsRecord};
use straightline_study::statistics::mark_ratio;
use straightline_table::{Column, Table};

/// Columns of times: title, transport and stage.
const COLUMNS: [(&str, &str, Stage); 6] = [
    ("alone, fragment", "none", Stage::Fragment),
    ("alone, compute", "none", Stage::Compute),
    ("`subgroup`", "subgroup", Stage::Fragment),
    ("`derivatives`", "derivatives", Stage::Fragment),
    ("`block`", "block", Stage::Compute),
    ("8x2", "block 8x2", Stage::Compute),
];

/// A row for each way, a column for each stage and transport: milliseconds, and the speedup over the filter's first way.
pub fn ways(record: &QuadsRecord) -> Table {
    let noise = record.noise();
    let name = |way: &'_ QuadWay| (way.filter.clone(), way.way.clone());
    let mut named: Vec<(String, String)> = record.ways.iter().map(name).collect();
    named.dedup();
    let of_row = |row: &(String, String)| {
        let row = row.clone();
        record.ways.iter().filter(move |way| name(way) == row)
    };
    Table::of(&named)
        .column(Column::from("filter").grouped(), |row| &row.0)
        .column(Column::from("way").left(), |row| &row.1)
        .columns(
            COLUMNS,
            |(title, ..)| *title,
            |row, (_, transport, stage)| {
                // A kernel that shares nothing sends nothing, though it is computed in blocks: its columns are the first two.
                let alone = row.1 == "naive" || row.1 == "bilinear";
                let is = match (alone, *transport, *stage) {
                    (true, "none", Stage::Compute) => "block",
                    (true, "block", _) => return String::new(),
                    _ => transport,
                };
                let mut found = of_row(row).filter(|way| way.transport == is && way.stage == *stage);
                found.next().map_or_else(String::new, |way| {
                    let mark = mark_ratio(noise, way.speedup.median);
                    format!("{} ms ({:.1}×{mark})", in_ms(way.median_ms, 0), way.speedup.median)
                })
            },
        )
        .column("mean difference", |row| {
            let difference = of_row(row).next().map_or(0.0, |way| way.mean_difference);
            format!("{difference:.0e}")
        })
        .finish()
}
