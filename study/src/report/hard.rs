//! Hard cases.

use super::format_caption;
use crate::record::{Executor, HalfVerdict, HardRecord, HardResult};
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct Hard {
    caption: String,
    precisions: Vec<Matrix>,
    /// Worst result among the executors, by outcome: its name, its count, the class of its colour.
    tally: Vec<(&'static str, usize, &'static str)>,
    half: Vec<Half>,
}

/// Cases down, kernels across.
#[derive(Debug, Serialize)]
struct Matrix {
    precision: String,
    columns: Vec<String>,
    rows: Vec<Row>,
}

#[derive(Debug, Serialize)]
struct Row {
    name: String,
    about: String,
    cells: Vec<Option<Cell>>,
}

/// A kernel on a case, by all executors.
#[derive(Debug, Serialize)]
struct Cell {
    class: &'static str,
    text: String,
    title: String,
}

/// Row on the half precision of a kernel.
#[derive(Debug, Serialize)]
struct Half {
    kernel: String,
    verdict: String,
    worst: String,
    difference: String,
    limit: String,
    broken: String,
}

/// Classes of cells, from the best to the worst, and what they mean.
const CLASSES: [(&str, &str); 5] = [
    ("refused", "not run"),
    ("watched", "finite, without a bound"),
    ("kept", "finite, and within its bound"),
    ("beyond", "finite, beyond its bound"),
    ("bad", "not finite"),
];

pub(super) fn build_section(record: &HardRecord) -> Hard {
    let mut precisions: Vec<&str> = Vec::new();
    for result in record.cases.iter().flat_map(|case| &case.results) {
        if !precisions.contains(&result.precision.as_str()) {
            precisions.push(&result.precision);
        }
    }
    precisions.sort_by_key(|precision| std::cmp::Reverse(*precision));
    let precisions: Vec<Matrix> = precisions
        .iter()
        .map(|precision| build_matrix(record, precision))
        .collect();
    let cells = || {
        precisions
            .iter()
            .flat_map(|m| &m.rows)
            .flat_map(|row| row.cells.iter().flatten())
    };
    let tally = CLASSES.iter().map(|(class, words)| {
        let count = cells().filter(|cell| cell.class == *class).count();
        (*words, count, *class)
    });
    Hard {
        caption: format_caption(&record.circumstances),
        tally: tally.collect(),
        half: record.half.iter().map(build_half_row).collect(),
        precisions,
    }
}

fn build_matrix(record: &HardRecord, precision: &str) -> Matrix {
    let mut columns: Vec<String> = Vec::new();
    for result in record.cases.iter().flat_map(|case| &case.results) {
        if result.precision == precision && !columns.contains(&result.kernel) {
            columns.push(result.kernel.clone());
        }
    }
    let rows = record.cases.iter().map(|case| {
        let cell = |kernel: &String| {
            let own = case.results.iter();
            let own: Vec<&HardResult> = own
                .filter(|r| r.kernel == *kernel && r.precision == precision)
                .collect();
            build_cell(&own)
        };
        Row {
            name: case.name.clone(),
            about: case.about.clone(),
            cells: columns.iter().map(cell).collect(),
        }
    });
    Matrix {
        precision: precision.to_owned(),
        rows: rows.collect(),
        columns: columns.clone(),
    }
}

fn executor_name(result: &HardResult) -> &'static str {
    match result.executor {
        Executor::Interpreter => "interpreter",
        Executor::InterpreterFlushed => "interpreter, subnormals flushed",
        Executor::InterpreterLoose => "interpreter, as inexact as WGSL allows",
        Executor::Gpu => "shader",
    }
}

/// Place in [`CLASSES`].
fn classify_result(result: &HardResult) -> usize {
    match result {
        r if r.refused.is_some() => 0,
        r if r.non_finite > 0 => 4,
        r if r.bound.is_none() => 1,
        r if r.kept => 2,
        _ => 3,
    }
}

fn build_cell(results: &[&HardResult]) -> Option<Cell> {
    let worst = results.iter().map(|result| classify_result(result)).max()?;
    let (class, _) = CLASSES[worst];
    let text = match class {
        "refused" => "·".to_owned(),
        "bad" => results.iter().map(|r| r.non_finite).max().unwrap_or(0).to_string(),
        _ => results
            .iter()
            .filter_map(|r| r.difference)
            .reduce(f64::max)
            .map_or(String::new(), |d| match d {
                0.0 => "0".to_owned(),
                d => format!("{d:.0e}"),
            }),
    };
    Some(Cell {
        class,
        text,
        title: results
            .iter()
            .map(|result| describe_result(result))
            .collect::<Vec<_>>()
            .join("\n"),
    })
}

/// A result in a line.
fn describe_result(result: &HardResult) -> String {
    if let Some(why) = &result.refused {
        return format!("{}: {why}", executor_name(result));
    }
    let mut words = vec![format!("{} of {} pixels not finite", result.non_finite, result.pixels)];
    words.extend(result.difference.map(|d| format!("off f64 by {d:.2e}")));
    words.extend(result.ulps.map(|u| format!("{u:.1} ULP")));
    words.extend(result.bound.map(|b| format!("bound {b:.1e}")));
    words.extend(result.born.as_ref().map(|b| format!("born at {b}")));
    format!("{}: {}", executor_name(result), words.join(", "))
}

fn build_half_row(verdict: &HalfVerdict) -> Half {
    let number = |value: Option<f64>| value.map_or("–".to_owned(), |v| format!("{v:.1e}"));
    Half {
        kernel: verdict.kernel.clone(),
        verdict: verdict.reason.clone().unwrap_or_else(|| "may be used".to_owned()),
        worst: verdict.worst.clone().unwrap_or_default(),
        difference: number(verdict.difference),
        limit: number(verdict.limit),
        broken: format!("{} of {}", verdict.broken, verdict.cases),
    }
}
