//! Values in half precision: the cheapest choice for each GPU.

use std::collections::BTreeMap;
use straightline_study::record::{PrecisionRecord, Proposal};
use straightline_table::{Cell, Table};

/// Of each kernel and GPU the cost of the cheapest choice over that of full precision, with its error; and all of them.
pub fn proposals(records: &[PrecisionRecord]) -> Result<Table, String> {
    let first = records.first().ok_or("there is no record")?;
    if let Some(other) = records.iter().find(|record| record.max_error != first.max_error) {
        return Err(format!("`{}` has another bound of the error", other.kernel));
    }
    let proposed = |record: &PrecisionRecord, gpu: &str| -> Option<Cell> {
        let found = record.proposals.iter().find(|proposal| proposal.gpus == [gpu])?;
        Some(Cell::from(described(found, gpu)?))
    };
    Ok(Table::of(records)
        .column("kernel", |record| &record.kernel)
        .columns(
            first.devices.keys(),
            |gpu| (*gpu).clone(),
            |record, gpu| proposed(record, gpu),
        )
        .column("for all of them", |record| {
            let last = record.proposals.last().filter(|last| last.gpus.len() > 1)?;
            names(&last.lowered.half.iter().map(String::as_str).collect::<Vec<_>>())
        })
        .column("all values: dearest, error", |record| {
            let all = record.choices.last()?;
            let dearest = all.ratios.values().copied().fold(0.0, f64::max);
            let error = all
                .error
                .map_or("not finite".to_owned(), |error| format!("{error:.0e}"));
            Some(format!("{dearest:.2}, {error}"))
        })
        .finish())
}

/// Cost and error of a proposal; `None` for full precision.
fn described(proposal: &Proposal, gpu: &str) -> Option<String> {
    let ratios: &BTreeMap<String, f64> = &proposal.lowered.ratios;
    let error = proposal.lowered.error.filter(|_| !proposal.lowered.half.is_empty())?;
    Some(format!("**{:.2}**, {error:.0e}", ratios.get(gpu)?))
}

fn names(names: &[&str]) -> Option<String> {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    (!quoted.is_empty()).then(|| quoted.join(", "))
}
