//! Hard cases.

use super::format_caption;
use crate::record::{Executor, HardRecord, HardResult};
use serde::Serialize;
use std::cell::Cell;
use straightline_table::{self as table, Column, Table};

#[derive(Debug, Serialize)]
pub(super) struct Hard {
    caption: String,
    /// Each precision, with its matrix: cases down, kernels across.
    precisions: Vec<(String, String)>,
    /// Worst result among the executors, by outcome: its name, its count, the class of its colour.
    tally: Vec<(&'static str, usize, &'static str)>,
    /// Table of verdicts on half precision; empty without one.
    half: String,
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
    let counts: [Cell<usize>; CLASSES.len()] = Default::default();
    let precisions = precisions.iter().map(|precision| {
        let matrix = build_matrix(record, precision, &counts).to_html();
        ((*precision).to_owned(), matrix)
    });
    let precisions = precisions.collect();
    let tally = CLASSES
        .iter()
        .zip(&counts)
        .map(|((class, words), count)| (*words, count.get(), *class));
    Hard {
        caption: format_caption(&record.circumstances),
        tally: tally.collect(),
        half: match record.half.is_empty() {
            true => String::new(),
            false => half_table(record).to_html(),
        },
        precisions,
    }
}

/// Builds the matrix of a precision, and counts its cells by class.
fn build_matrix(record: &HardRecord, precision: &str, counts: &[Cell<usize>]) -> Table {
    let mut kernels: Vec<&String> = Vec::new();
    for result in record.cases.iter().flat_map(|case| &case.results) {
        if result.precision == precision && !kernels.contains(&&result.kernel) {
            kernels.push(&result.kernel);
        }
    }
    Table::of(&record.cases)
        .column("case", |case| table::Cell::from(&case.name).hinted(&*case.about))
        .columns(
            kernels,
            |kernel| Column::new(*kernel).turned(),
            |case, kernel| {
                let own = case.results.iter();
                let own = own.filter(|r| r.kernel == **kernel && r.precision == precision);
                build_cell(&own.collect::<Vec<_>>(), counts)
            },
        )
        .finish()
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

/// A kernel on a case, by all executors.
fn build_cell(results: &[&HardResult], counts: &[Cell<usize>]) -> Option<table::Cell> {
    let worst = results.iter().map(|result| classify_result(result)).max()?;
    let (class, _) = CLASSES[worst];
    counts[worst].set(counts[worst].get() + 1);
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
    let hint: Vec<String> = results.iter().map(|result| describe_result(result)).collect();
    Some(table::Cell::from(text).classed(class).hinted(hint.join("\n")))
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

/// Table of the verdicts on half precision.
fn half_table(record: &HardRecord) -> Table {
    let number = |value: Option<f64>| value.map(|value| table::Cell::scientific(value, 1));
    Table::of(&record.half)
        .column("kernel", |half| &half.kernel)
        .column(Column::from("verdict").left(), |half| {
            half.reason.as_deref().unwrap_or("may be used")
        })
        .column(Column::from("worst case").left(), |half| half.worst.as_ref())
        .column("off by", |half| number(half.difference))
        .column("seen from", |half| number(half.limit))
        .column("cases broken", |half| format!("{} of {}", half.broken, half.cases))
        .finish()
}
