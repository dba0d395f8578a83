//! Cost of recording a frame on the processor.

use super::markdown;
use serde_json::Value;
use std::path::Path;

/// Microseconds of each way to record a frame.
pub fn ways(file: &Path) -> Result<String, String> {
    let text = std::fs::read_to_string(file).map_err(|error| format!("`{}`: {error}", file.display()))?;
    let record: Value = serde_json::from_str(&text).map_err(|error| format!("`{}`: {error}", file.display()))?;
    let rows = record["rows"].as_array().cloned().unwrap_or_default();
    let cells = rows.iter().map(|row| {
        let time = |name: &str| row[name].as_f64().map_or("–".to_owned(), |time| format!("{time:.1}"));
        let name = row["name"].as_str().unwrap_or_default().to_owned();
        vec![name, time("recorded_us"), time("finished_us"), time("submitted_us")]
    });
    let head = ["a frame", "recorded", "and finished", "and submitted"];
    Ok(markdown(&head, cells.collect()))
}
