//! Hard cases.

use std::path::Path;
use straightline_study::record::read_file;
use straightline_table::Table;

/// Every kernel of the hard cases on all adapters: how often it was not finite, or beyond its bound. From CSV: the JSON of
/// thousands of results is too long to be kept.
pub fn kernels(files: &[&Path]) -> Result<Table, String> {
    let mut rows: Vec<((String, String), [usize; 3])> = Vec::new();
    for file in files {
        let text = read_file(file).map_err(|error| error.to_string())?;
        let text = String::from_utf8(text).map_err(|error| format!("`{}`: {error}", file.display()))?;
        let mut lines = text.lines();
        let columns: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
        let column = |name: &str| {
            let found = columns.iter().position(|column| *column == name);
            found.ok_or_else(|| format!("`{}` has no column `{name}`", file.display()))
        };
        let [kernel, precision, executor, non_finite, difference, kept] =
            ["kernel", "precision", "executor", "non_finite", "difference", "kept"].map(column);
        let (kernel, precision, executor) = (kernel?, precision?, executor?);
        let (non_finite, difference, kept) = (non_finite?, difference?, kept?);
        for line in lines {
            // Only the last columns, which are not needed here, hold text with commas.
            let cells: Vec<&str> = line.split(',').collect();
            let cell = |k: usize| cells.get(k).copied().unwrap_or_default();
            let bad = cell(non_finite) != "0";
            // In half precision the device that is as inexact as WGSL allows decides nothing.
            if (cell(difference).is_empty() && !bad)
                || (cell(precision) == "f16" && cell(executor) == "interpreter-loose")
            {
                continue;
            }
            let key = (cell(kernel).to_owned(), cell(precision).to_owned());
            let index = rows.iter().position(|(known, _)| *known == key).unwrap_or_else(|| {
                rows.push((key, [0; 3]));
                rows.len() - 1
            });
            let counts = &mut rows[index].1;
            counts[0] += 1;
            counts[1] += usize::from(bad);
            counts[2] += usize::from(!bad && cell(kept) == "false");
        }
    }
    rows.sort_by_key(|((_, precision), _)| precision != "f32");
    Ok(Table::of(&rows)
        .column("kernel", |((kernel, _), _)| kernel)
        .column("precision", |((_, precision), _)| precision)
        .column("results", |(_, counts)| counts[0])
        .column("not finite", |(_, counts)| counts[1])
        .column("beyond their bound", |(_, counts)| counts[2])
        .finish())
}
