//! Speed against error.

use super::pictures::{Compared, Pictures};
use super::plot::{Dot, Line, Plot, Scale, format_number};
use super::{ReportError, format_caption, format_options};
use crate::record::{Family, Gap, MOST_DB, MethodErrors, QualityRecord, SceneErrors};
use serde::Serialize;
use std::path::Path;

#[derive(Debug, Serialize)]
pub(super) struct Quality {
    caption: String,
    /// PSNR of each method on each scene.
    methods: Vec<Method>,
    names: Vec<String>,
    legend: Vec<(&'static str, &'static str)>,
    scenes: Vec<SceneSection>,
}

#[derive(Debug, Serialize)]
struct Method {
    name: String,
    psnr: Vec<Option<String>>,
    gap: String,
    flip: String,
}

#[derive(Debug, Serialize)]
struct SceneSection {
    name: String,
    purpose: String,
    shares: String,
    plot: String,
    rows: Vec<Row>,
    absent: Vec<(String, String)>,
    gaps: Vec<GapRow>,
    compared: Option<Compared>,
}

/// Gap between a method and supersampling, in dB, and its causes.
#[derive(Debug, Serialize)]
struct GapRow {
    method: String,
    bound: String,
    gap: String,
    unseen: String,
    borrowed: String,
    error_unseen: String,
    gap_seen: String,
}

#[derive(Debug, Serialize)]
struct Row {
    method: String,
    options: String,
    psnr: String,
    flip: String,
    ssim: String,
    geometry: String,
    shading: String,
    flat: String,
    gap: String,
    temporal: String,
    time: String,
    bytes: String,
    non_finite: usize,
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
        .map(|scene| scene_section(scene, folder, pictures))
        .collect();
    Ok(Quality {
        caption: format_caption(&record.circumstances),
        methods: names.iter().map(|name| build_method(record, name)).collect(),
        names: record.scenes.iter().map(|scene| scene.scene.clone()).collect(),
        legend: family_legend(|family| {
            let mut methods = record.scenes.iter().flat_map(|scene| &scene.methods);
            methods.any(|method| method.family == family)
        }),
        scenes: scenes?,
    })
}

fn build_method(record: &QualityRecord, name: &str) -> Method {
    let found = |scene: &SceneErrors| scene.methods.iter().find(|m| m.method == name).cloned();
    let all: Vec<Option<MethodErrors>> = record.scenes.iter().map(found).collect();
    let mean = |pick: fn(&MethodErrors) -> Option<f64>| {
        let values: Vec<f64> = all.iter().flatten().filter_map(pick).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    Method {
        name: name.to_owned(),
        psnr: all
            .iter()
            .map(|m| m.as_ref().map(|m| format_decibels(m.psnr)))
            .collect(),
        gap: format_percent(mean(|m| m.gap_closed)),
        flip: mean(|m| Some(m.flip)).map_or(NONE.to_owned(), |flip| format!("{flip:.4}")),
    }
}

fn format_decibels(psnr: f64) -> String {
    match psnr < MOST_DB {
        true => format!("{psnr:.2}"),
        false => "∞".to_owned(),
    }
}

/// Placeholder for a missing figure.
const NONE: &str = "–";

fn format_percent(share: Option<f64>) -> String {
    share.map_or(NONE.to_owned(), |share| format!("{:.0} %", share * 100.0))
}

fn scene_section(scene: &SceneErrors, folder: &Path, pictures: &mut Pictures) -> Result<SceneSection, ReportError> {
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
    let gap = |gap: &Gap| GapRow {
        method: gap.method.clone(),
        bound: gap.bound.clone(),
        gap: format!("{:+.2}", gap.psnr - gap.bound_psnr),
        unseen: format!("{:+.2}", gap.ideal_psnr - gap.bound_psnr),
        borrowed: format!("{:+.2}", gap.psnr - gap.ideal_psnr),
        error_unseen: percent(gap.error_unseen),
        gap_seen: match (gap.psnr_seen, gap.bound_psnr_seen) {
            (Some(psnr), Some(bound)) => format!("{:+.2}", psnr - bound),
            _ => NONE.to_owned(),
        },
    };
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
        rows: scene.methods.iter().map(build_row).collect(),
        absent: scene.absent.clone(),
        gaps: scene.gaps.iter().map(gap).collect(),
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
        .filter_map(|m| Some((m, m.time?.median_ms)))
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
                format_decibels(m.psnr),
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

fn build_row(m: &MethodErrors) -> Row {
    let class = |value: Option<f64>| value.map_or(NONE.to_owned(), format_decibels);
    Row {
        method: m.method.clone(),
        options: format_options(&m.options),
        psnr: format_decibels(m.psnr),
        flip: format!("{:.4}", m.flip),
        ssim: format!("{:.4}", m.ssim),
        geometry: class(m.psnr_geometry),
        shading: class(m.psnr_shading),
        flat: class(m.psnr_flat),
        gap: format_percent(m.gap_closed),
        temporal: m.temporal.map_or(NONE.to_owned(), |v| format!("{v:.1e}")),
        time: m.time.map_or(NONE.to_owned(), |t| format_number(t.median_ms)),
        bytes: format!("{:.1}", m.bytes as f64 / 1e6),
        non_finite: m.non_finite,
    }
}
