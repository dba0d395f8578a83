//! The price lists of the paper: its tables 1 and 2, from the measurements of `budget`.

use super::{in_ms, read_json};
use serde_json::Value;
use std::path::Path;
use straightline_study::statistics::Interval;
use straightline_table::{Cell, Column, Table};

/// A record, and the driver that its file's name ends with.
struct Budget {
    driver: String,
    record: Value,
}

fn read(files: &[&Path]) -> Result<Vec<Budget>, String> {
    let read = |path: &&Path| -> Result<Budget, String> {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Budget {
            driver: stem.rsplit('-').next().unwrap_or_default().to_owned(),
            record: read_json(path)?,
        })
    };
    files.iter().map(read).collect()
}

impl Budget {
    fn list(&self, name: &str) -> Result<&[Value], String> {
        let found = self.record[name].as_array().filter(|list| !list.is_empty());
        found
            .map(Vec::as_slice)
            .ok_or_else(|| format!("a record of `budget` has no {name}"))
    }

    /// Scene and driver.
    fn label(&self) -> String {
        format!(
            "{}, {}",
            text(&self.record["scene"]).trim_end_matches(".glb"),
            self.driver
        )
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

/// Median and interval; `None` of what has none.
fn interval(value: &Value) -> Option<Interval> {
    serde_json::from_value(value.clone()).ok()
}

/// Cost of each metric, on each adapter.
pub fn metrics(files: &[&Path]) -> Result<Table, String> {
    let records = read(files)?;
    // The paper has these for 4 samples.
    let is_wanted = |filter: &&Value| filter["pattern"] == "latin4" && filter["shading"] == "centre";
    let filters = |budget: &Budget| -> Result<Vec<Value>, String> {
        Ok(budget.list("filters")?.iter().filter(is_wanted).cloned().collect())
    };
    let filters: Vec<_> = records.iter().map(filters).collect::<Result<_, _>>()?;
    let first = filters.first().map(Vec::as_slice).unwrap_or_default();
    Ok(Table::of(first.iter().enumerate())
        .column("metric", |(_, filter)| text(&filter["metric"]))
        .column("reads", |(_, filter)| filter["reads"].to_string())
        .columns(
            records.iter().zip(&filters),
            |(budget, _)| format!("ms and ratio, {}", budget.driver),
            |(k, _), (_, filters)| {
                let found = filters.get(*k).unwrap_or(&Value::Null);
                let ms = in_ms(number(&found["ms"]["median"]), 0);
                format!("{ms}, {:.2}", number(&found["ratio"]))
            },
        )
        .fixed("ratio, paper", 2, |(_, filter)| number(&filter["paper_ratio"]))
        .finish())
}

/// The paper's table 2 on its side: a row for each scene, driver and part, a column for each method.
pub fn frames(files: &[&Path]) -> Result<Table, String> {
    let records = read(files)?;
    let first = records.first().ok_or("the table `table2` has no record")?;
    let mut rows = Vec::new();
    for budget in &records {
        let frames = budget.list("frames")?;
        rows.extend(["geometry", "shading", "filter", "net"].map(|part| (budget.label(), part, frames)));
    }
    Ok(Table::of(&rows)
        .column(Column::from("scene, driver").grouped(), |row| &row.0)
        .column("ms", |(_, part, _)| match *part {
            "net" => "**net**",
            part => part,
        })
        .columns(
            first.list("frames")?.iter().enumerate(),
            |(_, frame)| text(&frame["method"]),
            |(_, part, frames), (k, _)| {
                let of = interval(&frames[*k][format!("{part}_ms")])?;
                Some(match *part {
                    "net" => {
                        let [median, low, high] = of.to_array().map(|ms| in_ms(ms, 0));
                        format!("**{median}** ({low} to {high})")
                    }
                    _ => in_ms(of.median, 0),
                })
            },
        )
        .finish())
}

/// Net speedups of SRAA, and the shading from which it pays.
pub fn speedups(files: &[&Path]) -> Result<Table, String> {
    let pairs = [
        ("SRAA 4, sample0", "4x shading"),
        ("SRAA 4, MSAA pass", "4x shading"),
        ("SRAA 16", "16x shading"),
        ("SRAA 4, sample0", "16x shading"),
        ("SRAA 4, sample0", "MSAA 4"),
    ];
    let records = read(files)?;
    let mut rows = Vec::new();
    for budget in &records {
        rows.push((budget.label(), budget.list("comparisons")?));
    }
    let cell = |row: &(String, &[Value]), (method, over): (&str, &str), name: &str, digits: usize| {
        let found = row.1.iter().find(|c| c["method"] == method && c["over"] == over)?;
        let of = interval(&found[name])?.map(|value| value.max(0.0));
        Some(Cell::interval(of.to_array(), digits))
    };
    Ok(Table::of(rows)
        .column("scene, driver", |row| row.0.clone())
        .columns(
            pairs,
            |(method, over)| format!("{method} over {over}"),
            |row, pair| cell(row, *pair, "speedup", 2),
        )
        .columns(
            pairs.into_iter().take(3),
            |(method, over)| format!("{method} pays over {over} from"),
            |row, pair| cell(row, *pair, "break_even_ms", 1).map(|cell| cell.suffixed(" ms")),
        )
        .finish())
}
