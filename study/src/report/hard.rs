//! Hard cases.

use super::caption;
use crate::record::{Executor, HardRecord, HardResult};
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct Hard {
    caption: String,
    columns: Vec<String>,
    rows: Vec<Row>,
    /// Cells by what became of them: what it is called, how many there are, the class of their colour.
    tally: Vec<(&'static str, usize, &'static str)>,
}

#[derive(Debug, Serialize)]
struct Row {
    name: String,
    about: String,
    cells: Vec<Option<Cell>>,
}

#[derive(Debug, Serialize)]
struct Cell {
    class: &'static str,
    text: String,
    title: String,
}

/// Classes of cells, from the best to the worst, and what they mean.
const CLASSES: [(&str, &str); 5] = [
    ("kept", "finite, and within its bound"),
    ("watched", "finite, without a bound"),
    ("refused", "not run"),
    ("beyond", "finite, beyond its bound"),
    ("bad", "not finite"),
];

pub(super) fn section(record: &HardRecord) -> Hard {
    let results = || record.cases.iter().flat_map(|case| &case.results);
    let mut columns: Vec<String> = Vec::new();
    for result in results() {
        let column = column(result);
        if !columns.contains(&column) {
            columns.push(column);
        }
    }
    let rows = record.cases.iter().map(|case| {
        let cell = |name: &String| {
            let found = case.results.iter().find(|result| column(result) == *name);
            found.map(cell)
        };
        Row {
            name: case.name.clone(),
            about: case.about.clone(),
            cells: columns.iter().map(cell).collect(),
        }
    });
    let tally = CLASSES.iter().map(|(class, words)| {
        let count = results().filter(|result| classify(result) == *class).count();
        (*words, count, *class)
    });
    Hard {
        caption: caption(&record.circumstances),
        rows: rows.collect(),
        tally: tally.collect(),
        columns,
    }
}

fn column(result: &HardResult) -> String {
    let executor = match result.executor {
        Executor::Interpreter => "interpreter",
        Executor::InterpreterFlushed => "flushed",
        Executor::InterpreterLoose => "loose",
        Executor::Gpu => "shader",
    };
    format!("{} · {} · {executor}", result.kernel, result.precision)
}

fn classify(result: &HardResult) -> &'static str {
    match result {
        r if r.refused.is_some() => "refused",
        r if r.non_finite > 0 => "bad",
        r if r.bound.is_none() => "watched",
        r if r.kept => "kept",
        _ => "beyond",
    }
}

fn cell(result: &HardResult) -> Cell {
    let class = classify(result);
    let text = match class {
        "refused" => "·".to_owned(),
        "bad" => result.non_finite.to_string(),
        _ => result.difference.map_or(String::new(), |d| match d {
            0.0 => "0".to_owned(),
            d => format!("{d:.0e}"),
        }),
    };
    let mut title = vec![column(result)];
    title.extend(result.refused.clone());
    if result.refused.is_none() {
        title.push(format!("{} of {} pixels not finite", result.non_finite, result.pixels));
        title.extend(result.difference.map(|d| format!("largest difference to f64: {d:.2e}")));
        title.extend(result.ulps.map(|u| format!("{u:.1} ULP")));
        title.extend(result.bound.map(|b| format!("bound: {b:.1e}")));
        title.extend(result.born.as_ref().map(|b| format!("born at {b}")));
    }
    Cell {
        class,
        text,
        title: title.join("\n"),
    }
}
