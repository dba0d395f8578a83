//! Registers of a GPU's compiler by the scalars that are alive at once in the text.

use super::rank::{pearson, ranks};
use straightline_study::record::{IsaRecord, SpirvPath};
use straightline_table::Table;

/// Scalars alive at most, of each row.
const UP_TO: [u32; 7] = [16, 24, 32, 48, 64, 96, u32::MAX];

/// A shader by naga: scalars alive, registers, waves at once.
type Shader = (u32, u64, u64);

/// Registers and waves of the shaders of a record, by the scalars that are alive in them; in the last row, how well the two
/// orders agree.
pub fn registers(record: &IsaRecord) -> Result<Table, String> {
    let by_naga = record.shaders.iter().filter(|asked| asked.path == SpirvPath::Naga);
    let shaders: Vec<Shader> = by_naga
        .filter_map(|asked| {
            let figures = asked.figures.values().next()?;
            Some((asked.alive?, figures.vector_registers, figures.occupancy))
        })
        .collect();
    if shaders.is_empty() {
        return Err("the record does not say how many scalars are alive".to_owned());
    }
    let mut rows = Vec::new();
    let mut from = 0;
    for to in UP_TO {
        let some: Vec<&Shader> = shaders.iter().filter(|s| (from..=to).contains(&s.0)).collect();
        let words = match to {
            u32::MAX => format!("{from} or more"),
            _ => format!("{from} to {to}"),
        };
        from = to.saturating_add(1);
        let registers = sorted(some.iter().map(|s| s.1));
        let waves = sorted(some.iter().map(|s| s.2));
        let (Some(fewest), Some(most)) = (registers.first(), registers.last()) else {
            continue;
        };
        let middle = |of: &[u64]| of[of.len() / 2].to_string();
        let range = format!("{fewest} to {most}");
        rows.push((words, some.len(), [middle(&registers), range, middle(&waves)]));
    }
    let alive: Vec<f64> = shaders.iter().map(|s| f64::from(s.0)).collect();
    let registers: Vec<f64> = shaders.iter().map(|s| s.1 as f64).collect();
    let agreement = format!("{:.2}", pearson(&ranks(&alive), &ranks(&registers)));
    let last = [agreement, String::new(), String::new()];
    rows.push(("rank correlation".to_owned(), shaders.len(), last));
    // Not every driver says how many waves there are at once.
    let waves = shaders.iter().any(|s| s.2 > 0).then_some("waves at once, median");
    Ok(Table::of(&rows)
        .column("scalars alive", |row| &row.0)
        .column("shaders", |row| row.1)
        .column("registers, median", |row| &row.2[0])
        .column("fewest to most", |row| &row.2[1])
        .columns(waves, |title| *title, |row, _| &row.2[2])
        .finish())
}

fn sorted(of: impl Iterator<Item = u64>) -> Vec<u64> {
    let mut all: Vec<u64> = of.collect();
    all.sort_unstable();
    all
}
