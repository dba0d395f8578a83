//! Cheapest variants that meet the needs of scenes.

use super::markdown;
use straightline_study::record::TuneRecord;

/// Chosen variant of every scene.
pub fn scenes(records: &[TuneRecord]) -> String {
    let head = [
        "scene",
        "budget",
        "chosen",
        "lost",
        "ms",
        "speedup over the most general",
        "model off by",
    ];
    let row = |record: &TuneRecord| {
        let chosen = record.chosen.and_then(|index| record.candidates.get(index));
        let unit = if record.metric == "flip" { "" } else { " dB" };
        let cell = |text: Option<String>| text.unwrap_or("–".to_owned());
        vec![
            record.scene.clone(),
            format!("{}{unit}", record.max_error),
            cell(chosen.map(|c| {
                let mut words: Vec<String> = c
                    .options
                    .iter()
                    .map(|(name, value)| format!("{name}={value}"))
                    .collect();
                words.extend((c.precision != "f32").then(|| c.precision.clone()));
                words.extend((c.math != "exact").then(|| format!("math {}", c.math)));
                words.extend((c.block != [1, 1]).then(|| format!("block {}x{}", c.block[0], c.block[1])));
                format!("`{}`", words.join(" "))
            })),
            cell(chosen.map(|c| format!("{:.3}{unit}", (c.error - record.best).abs()))),
            cell(chosen.and_then(|c| c.time).map(|t| format!("{:.1}", t.median_ms))),
            cell(
                chosen
                    .and_then(|c| c.ratio)
                    .map(|r| format!("{:.2} ({:.2} to {:.2})", r.median, r.low, r.high)),
            ),
            format!("{:.0} %", 100.0 * record.model.mean_error),
        ]
    };
    markdown(&head, records.iter().map(row).collect())
}
