//! Goals for accuracy, and their state in the records.

use super::goals::{Goal, goals_table};
use super::quality::GEOMETRIC;
use straightline_study::record::{MethodErrors, QualityRecord, SceneErrors};
use straightline_table::Table;

/// Each goal with what it comes to: of the record of what is placed by planes, and that of paint and shadow.
pub fn table(planes: &QualityRecord, paint: &QualityRecord) -> Result<Table, String> {
    let kept = |samples: &str| format!("SRAA {samples}, placed, searched and kept even");
    let mut rows = Vec::new();
    for (samples, mean, worst) in [("4", 0.5, 1.5), ("16", 2.0, 4.0)] {
        let below = below(planes, &kept(samples), samples)?;
        rows.push(row(
            &format!("SRAA {samples} below {samples}×, same shading rate: mean; worst, dB"),
            &format!("at most {mean}; {worst}"),
            &format!("{:.1}; {:.1}", below.0, below.1),
            below.0 <= mean && below.1 <= worst,
        ));
    }
    for (samples, mean) in [("4", 0.4), ("16", 1.6)] {
        let method = format!("SRAA {samples}, placed, searched, kept even and extra");
        let mut most = 0.0f64;
        for scene in &planes.scenes {
            most = most.max(named(scene, &method)?.extra.unwrap_or(1.0));
        }
        let below = below(planes, &method, samples)?.0;
        rows.push(row(
            &format!(
                "SRAA {samples} below {samples}× with up to 2 % of the pixels shaded once more: mean, dB; most, %"
            ),
            &format!("at most {mean}; 2"),
            &format!("{below:.1}; {:.2}", 100.0 * most),
            below <= mean && most <= 0.02,
        ));
    }
    let flips: Result<Vec<f64>, String> = planes
        .scenes
        .iter()
        .map(|scene| Ok(named(scene, &kept("16"))?.flip - named(scene, &kept("4"))?.flip))
        .collect();
    let flip = flips?.into_iter().fold(f64::NEG_INFINITY, f64::max);
    rows.push(row(
        "FLIP of 16 samples less that of 4: worst scene",
        "at most 0",
        &format!("{flip:+.6}"),
        flip <= 0.0,
    ));
    let mut below_paint = 0.0f64;
    for scene in paint
        .scenes
        .iter()
        .filter(|scene| ["posters", "awning"].contains(&scene.scene.as_str()))
    {
        for samples in ["4", "16"] {
            let own = named(
                scene,
                &format!("SRAA {samples}, placed, searched, demodulated and rest apart"),
            )?;
            below_paint = below_paint.max(named(scene, &format!("{samples}x"))?.psnr - own.psnr);
        }
    }
    rows.push(row(
        "paint and shadow, light apart: worst below supersampling, dB",
        "at most 1.5",
        &format!("{below_paint:.1}"),
        below_paint <= 1.5,
    ));
    for samples in ["4", "16"] {
        let mut worst = f64::INFINITY;
        for scene in &planes.scenes {
            let (own, none) = (named(scene, &kept(samples))?, named(scene, "1x")?);
            if let (Some(own), Some(none)) = (own.psnr_flat, none.psnr_flat) {
                worst = worst.min(own - none);
            }
        }
        rows.push(row(
            &format!("even regions above no antialiasing, SRAA {samples}: worst scene, dB"),
            "at least -0.3",
            &format!("{worst:.1}"),
            worst >= -0.3,
        ));
    }
    Ok(goals_table(rows))
}

fn row(what: &str, goal: &str, now: &str, is_met: bool) -> Goal {
    Goal {
        what: what.to_owned(),
        was: "",
        goal: goal.to_owned(),
        now: now.to_owned(),
        is_met,
    }
}

/// Distance of a method below supersampling with as many samples, over the scenes of geometric edges: mean and worst.
fn below(record: &QualityRecord, method: &str, samples: &str) -> Result<(f64, f64), String> {
    let scenes = record
        .scenes
        .iter()
        .filter(|scene| GEOMETRIC.contains(&scene.scene.as_str()));
    let all: Result<Vec<f64>, String> = scenes
        .map(|scene| Ok(named(scene, &format!("{samples}x"))?.psnr - named(scene, method)?.psnr))
        .collect();
    let all = all?;
    let mean = all.iter().sum::<f64>() / all.len().max(1) as f64;
    Ok((mean, all.into_iter().fold(f64::NEG_INFINITY, f64::max)))
}

fn named<'a>(scene: &'a SceneErrors, name: &str) -> Result<&'a MethodErrors, String> {
    let found = scene.methods.iter().find(|method| method.method == name);
    found.ok_or_else(|| format!("the record has no {name} of {}", scene.scene))
}
