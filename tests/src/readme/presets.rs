//! Presets of SRAA against supersampling at their samples, over all scenes of a record.

use super::goals::{Goal, goals_table};
use super::quality::{by_samples, cell, found};
use std::collections::BTreeMap;
use straightline_study::record::{MethodErrors, QualityRecord, SceneErrors};
use straightline_table::{Cell, Table};

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

/// Every preset: what it needs, its distance below supersampling by `record`, its time and its memory by `timed`.
pub fn presets(record: &QualityRecord, timed: &QualityRecord) -> Result<Table, String> {
    let below = PRESETS.map(|(preset, _)| ["4", "16"].map(|samples| below(record, preset, samples)));
    let mean_of = |preset: &str, samples: &str, figure: fn(&MethodErrors) -> Option<f64>| {
        let of = |scene| figure(found(scene, &method(preset, samples))?);
        let all: Vec<f64> = timed.scenes.iter().filter_map(of).collect();
        Cell::fixed(mean(&all), 1)
    };
    let mut rows = Vec::new();
    for ((preset, needs), [four, sixteen]) in PRESETS.into_iter().zip(below) {
        let below = [four?, sixteen?].map(|below| format!("{:.2} ({:.2})", mean(&below), most(&below)));
        rows.push((preset, needs, below));
    }
    Ok(Table::of(&rows)
        .column("`preset`", |(preset, ..)| format!("`{preset}`"))
        .column("what is rendered", |(_, needs, _)| *needs)
        .column("below 4×, dB: mean (worst)", |(.., below)| &below[0])
        .column("below 16×", |(.., below)| &below[1])
        .column("ms, 4 samples", |(preset, ..)| {
            mean_of(preset, "4", MethodErrors::median_ms)
        })
        .column("16", |(preset, ..)| mean_of(preset, "16", MethodErrors::median_ms))
        .column("MB, 4 samples", |(preset, ..)| {
            mean_of(preset, "4", MethodErrors::megabytes)
        })
        .column("16", |(preset, ..)| mean_of(preset, "16", MethodErrors::megabytes))
        .finish())
}

/// Records of one size as one, with the scenes of all.
pub fn joined(records: Vec<QualityRecord>) -> Result<QualityRecord, String> {
    let mut records = records.into_iter();
    let mut all = records.next().ok_or("there is no record")?;
    for record in records {
        if record.circumstances.size != all.circumstances.size {
            return Err(format!(
                "records of {:?} and {:?}",
                all.circumstances.size, record.circumstances.size
            ));
        }
        all.scenes.extend(record.scenes);
    }
    Ok(all)
}

/// Every scene: PSNR and FLIP of each preset beside supersampling.
pub fn scenes(record: &QualityRecord) -> Table {
    const METHODS: [(&str, &str); 7] = [
        ("SRAA N", "paper"),
        ("SRAA N, fast", "fast"),
        ("SRAA N, edges", "edges"),
        ("SRAA N, full", "full"),
        ("SRAA N, guided", "guided"),
        ("SRAA N, guided, unscaled", "unscaled guide"),
        ("Nx", "supersampling"),
    ];
    by_samples(record, METHODS, cell)
}

/// Goals of the guide and of the presets, and what the record says.
pub fn goals(record: &QualityRecord) -> Result<Table, String> {
    let goal = |what: String, goal: String, now: String, is_met: bool| Goal {
        what,
        was: "",
        goal,
        now,
        is_met,
    };
    let mut rows = Vec::new();
    for (samples, of_mean, of_worst) in [("4", 0.05, 0.2), ("16", 0.2, 0.6)] {
        for preset in ["guided", "guided, unscaled"] {
            let below = below(record, preset, samples)?;
            rows.push(goal(
                format!("{preset}, {samples} samples below {samples}×: mean; worst, dB"),
                format!("at most {of_mean}; {of_worst}"),
                format!("{:.2}; {:.2}", mean(&below), most(&below)),
                mean(&below) <= of_mean && most(&below) <= of_worst,
            ));
        }
    }
    for preset in ["edges", "full"] {
        for samples in ["4", "16"] {
            let (paper, own) = (below(record, "paper", samples)?, below(record, preset, samples)?);
            let gains: Vec<f64> = paper.iter().zip(&own).map(|(paper, own)| paper - own).collect();
            let least = gains.iter().copied().fold(f64::INFINITY, f64::min);
            rows.push(goal(
                format!("`{preset}`, {samples} samples, above `paper`: worst scene, dB"),
                "at least 0".to_owned(),
                format!("{least:+.2}"),
                least >= 0.0,
            ));
        }
    }
    Ok(goals_table(rows))
}

/// Records of several sizes: the guide below supersampling, and the least gain of presets over the paper's filter.
pub fn sizes(records: Vec<QualityRecord>) -> Result<Table, String> {
    let mut by_size: BTreeMap<[u32; 2], Vec<QualityRecord>> = BTreeMap::new();
    for record in records {
        by_size.entry(record.circumstances.size).or_default().push(record);
    }
    let mut rows = Vec::new();
    for ([width, height], records) in by_size {
        let record = &joined(records)?;
        let mut cells = Vec::new();
        for samples in ["4", "16"] {
            let (guided, paper) = (below(record, "guided", samples)?, below(record, "paper", samples)?);
            cells.push(format!("{:.2} ({:.2})", mean(&guided), most(&guided)));
            for preset in ["edges", "full"] {
                let own = below(record, preset, samples)?;
                let gains = paper.iter().zip(&own).map(|(paper, own)| paper - own);
                cells.push(format!("{:+.2}", gains.fold(f64::INFINITY, f64::min)));
            }
        }
        rows.push((format!("{width}×{height}"), cells));
    }
    let titles = [
        "guided below 4×, mean (worst), dB",
        "`edges` above `paper`, worst",
        "`full`",
        "guided below 16×",
        "`edges` above `paper`",
        "`full`, 16",
    ];
    Ok(Table::of(&rows)
        .column("size", |(size, _)| size)
        .columns(
            titles.iter().enumerate(),
            |(_, title)| **title,
            |(_, cells), (k, _)| Some(cells[*k].clone()),
        )
        .finish())
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
