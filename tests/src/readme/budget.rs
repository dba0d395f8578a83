//! The price list of the paper.

use super::markdown;
use serde_json::Value;
use std::path::Path;

/// What each metric costs, on each adapter.
pub fn metrics(files: &[&Path]) -> Result<String, String> {
    let read = |path: &&Path| -> Result<Vec<Value>, String> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("`{}`: {error}", path.display()))?;
        let record: Value = serde_json::from_str(&text).map_err(|error| format!("`{}`: {error}", path.display()))?;
        let filters = record["filters"].as_array().cloned().unwrap_or_default();
        // The paper has these for 4 samples.
        Ok(filters
            .into_iter()
            .filter(|filter| filter["pattern"] == "latin4")
            .collect())
    };
    let records = files.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let stem = |path: &&Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut head = vec!["metric".to_owned(), "reads".to_owned()];
    head.extend(files.iter().map(|path| stem(path).replace("budget-", "ms and ratio, ")));
    head.push("ratio, paper".to_owned());
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let row = |(index, first): (usize, &Value)| {
        let mut cells = vec![
            first["metric"].as_str().unwrap_or_default().to_owned(),
            first["reads"].to_string(),
        ];
        for record in &records {
            let found = record.get(index).unwrap_or(&Value::Null);
            cells.push(format!(
                "{:.0}, {:.2}",
                number(&found["time"]["median_ms"]),
                number(&found["ratio"])
            ));
        }
        cells.push(format!("{:.2}", number(&first["paper_ratio"])));
        cells
    };
    let first = records.first().map(Vec::as_slice).unwrap_or_default();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    Ok(markdown(&head, first.iter().enumerate().map(row).collect()))
}
