//! Registers of a GPU's compiler by the scalars that are alive at once in the text.

use super::markdown;
use super::rank::{pearson, ranks};
use straightline_study::record::{IsaRecord, SpirvPath};

/// Scalars alive at most, of each row.
const UP_TO: [u32; 7] = [16, 24, 32, 48, 64, 96, u32::MAX];

/// A shader by naga: scalars alive, registers, waves at once.
type Shader = (u32, u64, u64);

/// Registers and waves of the shaders of a record, by the scalars that are alive in them; in the last row, how well the two
/// orders agree.
pub fn registers(record: &IsaRecord) -> Result<String, String> {
    let Some(family) = record.devices.keys().next() else {
        return Err("the record has no family".to_owned());
    };
    let by_naga = record.shaders.iter().filter(|asked| asked.path == SpirvPath::Naga);
    let shaders: Vec<Shader> = by_naga
        .filter_map(|asked| {
            let figures = asked.figures.get(family)?;
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
        rows.push(vec![
            words,
            some.len().to_string(),
            middle(&registers),
            format!("{fewest} to {most}"),
            middle(&waves),
        ]);
    }
    let alive: Vec<f64> = shaders.iter().map(|s| f64::from(s.0)).collect();
    let registers: Vec<f64> = shaders.iter().map(|s| s.1 as f64).collect();
    let agreement = pearson(&ranks(&alive), &ranks(&registers));
    rows.push(vec![
        "rank correlation".to_owned(),
        shaders.len().to_string(),
        format!("{agreement:.2}"),
        String::new(),
        String::new(),
    ]);
    let head = [
        "scalars alive",
        "shaders",
        "registers, median",
        "fewest to most",
        "waves at once, median",
    ];
    Ok(markdown(&head, rows))
}

fn sorted(of: impl Iterator<Item = u64>) -> Vec<u64> {
    let mut all: Vec<u64> = of.collect();
    all.sort_unstable();
    all
}
