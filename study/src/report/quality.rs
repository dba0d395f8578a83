//! Speed against error.

use super::pictures::{Compared, Pictures};
use super::plot::{Dot, Line, Plot, Scale, format_number};
use super::{ReportError, format_caption};
use crate::record::{Family, Gap, MethodErrors, QualityRecord, SceneErrors, format_decibels};
use serde::Serialize;
use std::path::Path;
use straightline_table::{Column, Table};

#[derive(Debug, Serialize)]
pub(super) struct Quality {
    caption: String,
    /// PSNR of each method on each scene.
    methods: String,
    legend: Vec<(&'static str, &'static str)>,
    scenes: Vec<SceneSection>,
}

#[derive(Debug, Serialize)]
struct SceneSection {
    name: String,
    purpose: String,
    shares: String,
    plot: String,
    table: String,
    absent: Vec<(String, String)>,
    /// Gaps between methods and supersampling, and their causes; empty without one.
    gaps: String,
    compared: Option<Compared>,
}

/// Families with their words and colours.
const FAMILIES: [(Family, &str, usize); 6] = [
    (Family::None, "no antialiasing", 6),
    (Family::Sraa, "SRAA", 0),
    (Family::Edge, "edge filters of the G-buffer", 2),
    (Family::Picture, "filters of the picture", 1),
    (Family::Supersampling, "more samples", 7),
    (Family::Own, "kernels of your own", 3),
];

pub(super) fn color_index(family: Family) -> usize {
    FAMILIES
        .iter()
        .find(|(f, ..)| *f == family)
        .map_or(0, |(.., color)| *color)
}

/// Words and colours of the families that are shown.
pub(super) fn family_legend(is_shown: impl Fn(Family) -> bool) -> Vec<(&'static str, &'static str)> {
    let shown = FAMILIES.iter().filter(|(family, ..)| is_shown(*family));
    shown
        .map(|(_, words, color)| (*words, super::plot::COLORS[*color]))
        .collect()
}

pub(super) fn build_section(
    record: &QualityRecord,
    folder: &Path,
    pictures: &mut Pictures,
) -> Result<Quality, ReportError> {
    let mut names: Vec<&str> = Vec::new();
    for method in record.scenes.iter().flat_map(|scene| &scene.methods) {
        if !names.contains(&method.method.as_str()) {
            names.push(&method.method);
        }
    }
    let scenes: Result<Vec<SceneSection>, ReportError> = record
        .scenes
        .iter()
        .map(|scene| scene_section(record, scene, folder, pictures))
        .collect();
    Ok(Quality {
        caption: format_caption(&record.circumstances),
        methods: overview_table(record, &names).to_html(),
        legend: family_legend(|family| {
            let mut methods = record.scenes.iter().flat_map(|scene| &scene.methods);
            methods.any(|method| method.family == family)
        }),
        scenes: scenes?,
    })
}

/// Table of PSNR by method and scene, with means over the scenes.
fn overview_table(record: &QualityRecord, names: &[&str]) -> Table {
    let find = |scene: &'_ SceneErrors, name: &str| scene.methods.iter().find(|m| m.method == name).cloned();
    let mean = |name: &str, pick: fn(MethodErrors) -> Option<f64>| {
        let values = record.scenes.iter().filter_map(|scene| pick(find(scene, name)?));
        let values: Vec<f64> = values.collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    Table::of(names)
        .column("method", |name| **name)
        .columns(
            &record.scenes,
            |scene| scene.scene.clone(),
            |name, scene| find(scene, name).map(|m| format_decibels(m.psnr)),
        )
        .percent("gap closed", 0, |name| mean(name, |m| m.gap_closed))
        .fixed("FLIP", 4, |name| mean(name, |m| Some(m.flip)))
        .finish()
}

/// Table of the distances between methods and supersampling, in dB.
fn gaps_table(gaps: &[Gap]) -> Table {
    let decibels = |gap: f64| format!("{gap:+.2}");
    Table::of(gaps)
        .column("method", |gap| &gap.method)
        .column(Column::from("against").left(), |gap| &gap.bound)
        .column("gap", |gap| decibels(gap.psnr - gap.bound_psnr))
        .column("unseen surfaces", |gap| decibels(gap.ideal_psnr - gap.bound_psnr))
        .column("borrowed colours", |gap| decibels(gap.psnr - gap.ideal_psnr))
        .percent("error in pixels with unseen surfaces", 1, |gap| gap.error_unseen)
        .column("gap without these", |gap| {
            Some(decibels(gap.psnr_seen? - gap.bound_psnr_seen?))
        })
        .finish()
}

fn scene_section(
    record: &QualityRecord,
    scene: &SceneErrors,
    folder: &Path,
    pictures: &mut Pictures,
) -> Result<SceneSection, ReportError> {
    let files: Vec<(&str, &str)> = scene
        .methods
        .iter()
        .filter_map(|m| Some((m.method.as_str(), m.picture.as_deref()?)))
        .collect();
    let compared = match &scene.reference {
        Some(reference) if !files.is_empty() => pictures.compare_worst_part(folder, reference, &files)?,
        _ => None,
    };
    let percent = |share: f64| format!("{:.1} %", share * 100.0);
    Ok(SceneSection {
        name: scene.scene.clone(),
        purpose: scene.purpose.clone(),
        shares: format!(
            "{} of its pixels have an edge of geometry, {} an edge of shading alone; {} show a surface that no shading sample saw.",
            percent(scene.shares.geometry),
            percent(scene.shares.shading),
            percent(scene.shares.unseen)
        ),
        plot: plot_scene(scene)?,
        table: record.tabulate([scene]).without(&["scene"]).to_html(),
        absent: scene.absent.clone(),
        gaps: match scene.gaps.is_empty() {
            true => String::new(),
            false => gaps_table(&scene.gaps).to_html(),
        },
        compared,
    })
}

/// Returns whether all that a method costs beside one shading sample a pixel is its time. Where samples are shaded, most is
/// not.
fn is_filter(method: &MethodErrors) -> bool {
    method.family != Family::Supersampling
}

fn plot_scene(scene: &SceneErrors) -> Result<String, ReportError> {
    let timed: Vec<(&MethodErrors, f64)> = scene
        .methods
        .iter()
        .filter(|m| is_filter(m))
        .filter_map(|m| Some((m, m.time.as_ref()?.median_ms)))
        .filter(|(m, ms)| m.psnr.is_finite() && *ms > 0.0)
        .collect();
    // Methods that no other method beats in both.
    let best = |m: &MethodErrors, ms: f64| !timed.iter().any(|(other, o)| other.psnr > m.psnr && *o < ms);
    let mut front: Vec<(f64, f64)> = timed
        .iter()
        .filter(|(m, ms)| best(m, *ms))
        .map(|(m, ms)| (*ms, m.psnr))
        .collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    let dots: Vec<Dot> = timed
        .iter()
        .map(|(m, ms)| Dot {
            at: (*ms, m.psnr),
            spread: None,
            color: color_index(m.family),
            label: best(m, *ms).then(|| m.method.clone()),
            title: format!(
                "{}: {} dB, FLIP {:.4}, {} ms",
                m.method,
                format_number(m.psnr),
                m.flip,
                format_number(*ms)
            ),
        })
        .collect();
    let fastest = timed.iter().map(|(_, ms)| *ms).fold(f64::INFINITY, f64::min);
    let slowest = timed.iter().map(|(_, ms)| *ms).fold(0.0, f64::max);
    let ends = match fastest.is_finite() {
        true => (fastest, slowest.max(fastest * 1.01)),
        false => (1.0, 2.0),
    };
    let untimed = scene.methods.iter();
    let untimed = untimed.filter(|m| (m.time.is_none() || !is_filter(m)) && m.psnr.is_finite());
    let mut lines: Vec<Line> = untimed
        .map(|m| Line {
            points: vec![(ends.0, m.psnr), (ends.1, m.psnr)],
            color: color_index(m.family),
            dashed: true,
            label: Some(m.method.clone()),
        })
        .collect();
    lines.push(Line {
        points: front,
        color: 5,
        dashed: false,
        label: None,
    });
    lines.retain(|line| !line.points.is_empty());
    let plot = Plot {
        size: (980, 440),
        axes: (
            "time of the filter in ms".to_owned(),
            "PSNR in dB (more is better)".to_owned(),
        ),
        scales: (Scale::Log, Scale::Linear),
        across: true,
        dots,
        lines,
    };
    plot.to_svg()
}
