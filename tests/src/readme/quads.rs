//! Gain from sharing work over pixel quads.

use straightline_manifest::Stage;
use straightline_study::record::{QuadWay, QuadsRecord};

/// A row for each way, a column for each stage and transport: milliseconds, and the speedup over the filter's first way.
pub fn ways(record: &QuadsRecord) -> String {
    let mut text = "| filter | way | alone, fragment | alone, compute | `subgroup` | `derivatives` | `block` | 8x2 | mean difference |\n".to_owned();
    text += "| --- | --- | --: | --: | --: | --: | --: | --: | --: |\n";
    let mut named: Vec<(&str, &str)> = record.ways.iter().map(name).collect();
    named.dedup();
    for (k, row) in named.iter().enumerate() {
        let of_row = || record.ways.iter().filter(|way| name(way) == *row);
        let filter = match named[..k].iter().any(|(filter, _)| *filter == row.0) {
            true => "",
            false => row.0,
        };
        let columns = [
            ("none", Stage::Fragment),
            ("none", Stage::Compute),
            ("subgroup", Stage::Fragment),
            ("derivatives", Stage::Fragment),
            ("block", Stage::Compute),
            ("block 8x2", Stage::Compute),
        ];
        // A kernel that shares nothing sends nothing, though it is computed in blocks: its columns are the first two.
        let alone = row.1 == "naive" || row.1 == "bilinear";
        let cell = |(transport, stage): (&str, Stage)| {
            let is = match (alone, transport, stage) {
                (true, "none", Stage::Compute) => "block",
                (true, "block", _) => return String::new(),
                _ => transport,
            };
            let mut found = of_row().filter(|way| way.transport == is && way.stage == stage);
            found.next().map_or_else(String::new, |way| {
                format!("{:.0} ms ({:.1}×)", way.median_ms, way.speedup.median)
            })
        };
        let difference = of_row().next().map_or(0.0, |way| way.mean_difference);
        text += &format!(
            "| {filter} | {} | {} | {difference:.0e} |\n",
            row.1,
            columns.map(cell).join(" | ")
        );
    }
    text
}

fn name(way: &QuadWay) -> (&str, &str) {
    (&way.filter, &way.way)
}
