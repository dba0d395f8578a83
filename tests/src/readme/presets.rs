//! Presets of SRAA against supersampling at their samples, over all scenes of a record.

use super::markdown;
use super::quality::{cell, found};
use std::path::Path;
use straightline_study::record::{MethodErrors, QualityRecord, Record, SceneErrors};

/// Each preset with what a renderer must have for it.
const PRESETS: [(&str, &str); 5] = [
    ("paper", "depth and normals at samples, colour"),
    ("fast", "depth at samples, colour"),
    ("edges", "depth and normals at samples, colour"),
    (
        "full",
        "the same; what shading needs at every sample, to shade where `sraa_place` says",
    ),
    ("guided", "the same; an estimate of the colour at every sample"),
];

/// Name of a preset's method with so many samples.
fn method(preset: &str, samples: &str) -> String {
    match preset {
        "paper" => format!("SRAA {samples}"),
        _ => format!("SRAA {samples}, {preset}"),
    }
}

/// Every preset: what it needs, its distance below supersampling, its time and its memory.
pub fn presets(record: &QualityRecord) -> Result<String, String> {
    let head = [
        "`preset`",
        "what is rendered",
        "below 4×, dB: mean (worst)",
        "below 16×",
        "ms, 4 samples",
        "16",
        "MB, 4 samples",
        "16",
    ];
    let mut rows = Vec::new();
    for (preset, needs) in PRESETS {
        let mut row = vec![format!("`{preset}`"), needs.to_owned()];
        for samples in ["4", "16"] {
            let below = below(record, preset, samples)?;
            row.push(format!("{:.2} ({:.2})", mean(&below), most(&below)));
        }
        for figure in [
            |m: &MethodErrors| m.time.map(|time| time.median_ms),
            |m: &MethodErrors| Some(m.bytes as f64 / 1e6),
        ] {
            for samples in ["4", "16"] {
                let of = |scene| figure(found(scene, &method(preset, samples))?);
                let all: Vec<f64> = record.scenes.iter().filter_map(of).collect();
                row.push(format!("{:.1}", mean(&all)));
            }
        }
        rows.push(row);
    }
    Ok(markdown(&head, rows))
}

/// Every scene: PSNR and FLIP of each preset beside supersampling.
pub fn scenes(record: &QualityRecord) -> String {
    let head: Vec<&str> = ["scene", "samples"]
        .into_iter()
        .chain(PRESETS.map(|(preset, _)| preset))
        .chain(["unscaled guide", "supersampling"])
        .collect();
    let rows = record.scenes.iter().flat_map(|scene| {
        ["4", "16"].map(|samples| {
            let mut row = vec![scene.scene.clone(), samples.to_owned()];
            let methods = PRESETS.map(|(preset, _)| method(preset, samples));
            row.extend(methods.iter().map(|name| cell(scene, name)));
            row.push(cell(scene, &method("guided, unscaled", samples)));
            row.push(cell(scene, &format!("{samples}x")));
            row
        })
    });
    markdown(&head, rows.collect())
}

/// Goals of the guide and of the presets, and what the record says.
pub fn goals(files: &[&Path]) -> Result<String, String> {
    let [file] = files else {
        return Err("the table `guide-goals` needs one record".to_owned());
    };
    let record = QualityRecord::read(file).map_err(|error| error.to_string())?;
    let mut rows = Vec::new();
    for (samples, of_mean, of_worst) in [("4", 0.05, 0.2), ("16", 0.2, 0.6)] {
        for (what, preset) in [("guided", "guided"), ("guided, unscaled", "guided, unscaled")] {
            let below = below(&record, preset, samples)?;
            rows.push(vec![
                format!("{what}, {samples} samples below {samples}×: mean; worst, dB"),
                format!("at most {of_mean}; {of_worst}"),
                format!("**{:.2}; {:.2}**", mean(&below), most(&below)),
                yes(mean(&below) <= of_mean && most(&below) <= of_worst),
            ]);
        }
    }
    for preset in ["edges", "full"] {
        for samples in ["4", "16"] {
            let (paper, own) = (below(&record, "paper", samples)?, below(&record, preset, samples)?);
            let gains: Vec<f64> = paper.iter().zip(&own).map(|(paper, own)| paper - own).collect();
            let least = gains.iter().copied().fold(f64::INFINITY, f64::min);
            rows.push(vec![
                format!("`{preset}`, {samples} samples, above `paper`: worst scene, dB"),
                "at least 0".to_owned(),
                format!("**{least:+.2}**"),
                yes(least >= 0.0),
            ]);
        }
    }
    Ok(markdown(&["what", "goal", "now", "met"], rows))
}

fn yes(is_met: bool) -> String {
    if is_met { "yes" } else { "no" }.to_owned()
}

/// Distance of a preset below supersampling with as many samples, scene by scene.
fn below(record: &QualityRecord, preset: &str, samples: &str) -> Result<Vec<f64>, String> {
    let psnr = |scene: &SceneErrors, name: &str| {
        let errors = found(scene, name).ok_or_else(|| format!("the record has no {name} of {}", scene.scene));
        errors.map(|errors| errors.psnr)
    };
    let scenes = record.scenes.iter();
    let below = scenes.map(|scene| {
        let own = psnr(scene, &method(preset, samples))?;
        Ok(psnr(scene, &format!("{samples}x"))? - own)
    });
    below.collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}
