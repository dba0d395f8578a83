//! Cost of recording a frame on the processor.

use super::read_json;
use serde_json::Value;
use std::path::Path;
use straightline_table::{Cell, Table};

/// Microseconds of each way to record a frame.
pub fn ways(files: &[&Path]) -> Result<Table, String> {
    let record = read_json(files.first().ok_or("the table has no record")?)?;
    let time = |row: &Value, name: &str| row[name].as_f64().map(|time| Cell::fixed(time, 1));
    Ok(Table::of(record["rows"].as_array().into_iter().flatten())
        .column("a frame", |row| row["name"].as_str().unwrap_or_default())
        .column("recorded", |row| time(row, "recorded_us"))
        .column("and finished", |row| time(row, "finished_us"))
        .column("and submitted", |row| time(row, "submitted_us"))
        .finish())
}
