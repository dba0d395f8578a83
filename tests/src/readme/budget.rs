//! The price lists of the paper: its tables 1 and 2, from the measurements of `budget`.

use super::markdown;
use serde_json::Value;
use std::path::Path;

/// A record, and the driver that its file's name ends with.
struct Budget {
    driver: String,
    record: Value,
}

fn read(files: &[&Path]) -> Result<Vec<Budget>, String> {
    let read = |path: &&Path| -> Result<Budget, String> {
        let why = |error: &dyn std::fmt::Display| format!("`{}`: {error}", path.display());
        let text = std::fs::read_to_string(path).map_err(|error| why(&error))?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Budget {
            driver: stem.rsplit('-').next().unwrap_or_default().to_owned(),
            record: serde_json::from_str(&text).map_err(|error| why(&error))?,
        })
    };
    files.iter().map(read).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

fn list<'a>(record: &'a Value, name: &str) -> Result<&'a [Value], String> {
    let found = record[name].as_array().filter(|list| !list.is_empty());
    found
        .map(Vec::as_slice)
        .ok_or_else(|| format!("a record of `budget` has no {name}"))
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

/// Cost of each metric, on each adapter.
pub fn metrics(files: &[&Path]) -> Result<String, String> {
    let records = read(files)?;
    // The paper has these for 4 samples.
    let filters = |budget: &Budget| -> Result<Vec<Value>, String> {
        let all = list(&budget.record, "filters")?.iter();
        let is_wanted = |filter: &&Value| filter["pattern"] == "latin4" && filter["shading"] == "centre";
        Ok(all.filter(is_wanted).cloned().collect())
    };
    let filters: Vec<_> = records.iter().map(filters).collect::<Result<_, _>>()?;
    let mut head = vec!["metric".to_owned(), "reads".to_owned()];
    head.extend(records.iter().map(|budget| format!("ms and ratio, {}", budget.driver)));
    head.push("ratio, paper".to_owned());
    let row = |(index, first): (usize, &Value)| {
        let mut cells = vec![text(&first["metric"]).to_owned(), first["reads"].to_string()];
        for record in &filters {
            let found = record.get(index).unwrap_or(&Value::Null);
            cells.push(format!(
                "{:.0}, {:.2}",
                number(&found["ms"]["median"]),
                number(&found["ratio"])
            ));
        }
        cells.push(format!("{:.2}", number(&first["paper_ratio"])));
        cells
    };
    let first = filters.first().map(Vec::as_slice).unwrap_or_default();
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    Ok(markdown(&head, first.iter().enumerate().map(row).collect()))
}

/// The paper's table 2 on its side: a row for each scene, driver and part, a column for each method.
pub fn frames(files: &[&Path]) -> Result<String, String> {
    let records = read(files)?;
    let first = records.first().ok_or("the table `table2` has no record")?;
    let mut head = vec!["scene, driver", "ms"];
    head.extend(
        list(&first.record, "frames")?
            .iter()
            .map(|frame| text(&frame["method"])),
    );
    let mut rows = Vec::new();
    for Budget { driver, record } in &records {
        let frames = list(record, "frames")?;
        for part in ["geometry", "shading", "filter"] {
            let mut cells = vec![String::new(), part.to_owned()];
            cells.extend(frames.iter().map(|frame| match &frame[format!("{part}_ms")] {
                Value::Null => "–".to_owned(),
                found => format!("{:.0}", number(&found["median"])),
            }));
            rows.push(cells);
        }
        let name = text(&record["scene"]).trim_end_matches(".glb");
        let mut cells = vec![format!("{name}, {driver}"), "**net**".to_owned()];
        cells.extend(frames.iter().map(|frame| {
            let [lower, median, upper] =
                ["lower", "median", "upper"].map(|quartile| number(&frame["net_ms"][quartile]));
            format!("**{median:.0}** ({lower:.0} to {upper:.0})")
        }));
        let start = rows.len() - 3;
        rows[start][0] = cells[0].clone();
        cells[0].clear();
        rows.push(cells);
    }
    Ok(markdown(&head, rows))
}

/// Net speedups of SRAA, and the shading from which it pays.
pub fn speedups(files: &[&Path]) -> Result<String, String> {
    let pairs = [
        ("SRAA 4, sample0", "4x shading"),
        ("SRAA 4, MSAA pass", "4x shading"),
        ("SRAA 16", "16x shading"),
        ("SRAA 4, sample0", "16x shading"),
        ("SRAA 4, sample0", "MSAA 4"),
    ];
    let mut head = vec!["scene, driver".to_owned()];
    head.extend(pairs.map(|(method, over)| format!("{method} over {over}")));
    head.extend(
        pairs[..3]
            .iter()
            .map(|(method, over)| format!("{method} pays over {over} from")),
    );
    let row = |Budget { driver, record }: &Budget| -> Result<Vec<String>, String> {
        let comparisons = list(record, "comparisons")?;
        let of = |(method, over): (&str, &str)| {
            let found = comparisons.iter().find(|c| c["method"] == method && c["over"] == over);
            found.ok_or_else(|| format!("no comparison of {method} with {over}"))
        };
        let interval = |of: &Value, digits: usize| {
            let [lower, median, upper] = ["lower", "median", "upper"].map(|quartile| number(&of[quartile]).max(0.0));
            format!("{median:.digits$} ({lower:.digits$} to {upper:.digits$})")
        };
        let name = text(&record["scene"]).trim_end_matches(".glb");
        let mut cells = vec![format!("{name}, {driver}")];
        for pair in pairs {
            cells.push(interval(&of(pair)?["speedup"], 2));
        }
        for pair in &pairs[..3] {
            cells.push(interval(&of(*pair)?["break_even_ms"], 1) + " ms");
        }
        Ok(cells)
    };
    let rows: Result<Vec<_>, _> = read(files)?.iter().map(row).collect();
    Ok(markdown(&head.iter().map(String::as_str).collect::<Vec<_>>(), rows?))
}
