//! Methods of antialiasing against references.

use super::markdown;
use straightline_study::record::QualityRecord;

/// Scenes whose errors are edges of geometry, for which SRAA is made.
pub const GEOMETRIC: [&str; 8] = [
    "roof", "grooves", "creases", "railings", "wires", "tubes", "sky", "terrain",
];

/// Every method: means over the geometric scenes and over the others.
pub fn methods(record: &QualityRecord) -> String {
    let head = [
        "method",
        "PSNR, edges of geometry",
        "FLIP",
        "gap closed",
        "PSNR, other scenes",
        "FLIP",
        "ms",
        "MB",
    ];
    let mut names: Vec<&str> = Vec::new();
    for method in record.scenes.iter().flat_map(|scene| &scene.methods) {
        if !names.contains(&method.method.as_str()) {
            names.push(&method.method);
        }
    }
    let row = |name: &&str| {
        let of = |geometric: bool| {
            let scenes = record
                .scenes
                .iter()
                .filter(move |s| GEOMETRIC.contains(&s.scene.as_str()) == geometric);
            scenes
                .filter_map(|s| s.methods.iter().find(|m| m.method == *name))
                .collect::<Vec<_>>()
        };
        let mean = |values: Vec<f64>| match values.is_empty() {
            true => None,
            false => Some(values.iter().sum::<f64>() / values.len() as f64),
        };
        let shown = |value: Option<f64>, digits: usize, unit: &str| {
            value.map_or("–".to_owned(), |value| format!("{value:.digits$}{unit}"))
        };
        let (edges, others) = (of(true), of(false));
        let all = || edges.iter().chain(&others);
        vec![
            (*name).to_owned(),
            shown(mean(edges.iter().map(|m| m.psnr).collect()), 2, " dB"),
            shown(mean(edges.iter().map(|m| m.flip).collect()), 4, ""),
            shown(
                mean(edges.iter().filter_map(|m| Some(100.0 * m.gap_closed?)).collect()),
                0,
                " %",
            ),
            shown(mean(others.iter().map(|m| m.psnr).collect()), 2, " dB"),
            shown(mean(others.iter().map(|m| m.flip).collect()), 4, ""),
            shown(mean(all().filter_map(|m| Some(m.time?.median_ms)).collect()), 1, ""),
            shown(mean(all().map(|m| m.bytes as f64 / 1e6).collect()), 1, ""),
        ]
    };
    markdown(&head, names.iter().map(row).collect())
}

/// How far SRAA is from supersampling on every scene that has gaps, and what that is made of.
pub fn gaps(record: &QualityRecord) -> String {
    let mut head = vec!["scene".to_owned()];
    let first = record.scenes.iter().find(|scene| !scene.gaps.is_empty());
    for gap in first.map(|scene| scene.gaps.as_slice()).unwrap_or_default() {
        head.push(format!("{} − {}", gap.method, gap.bound));
        head.extend(["unseen surfaces", "borrowed colours"].map(str::to_owned));
    }
    let rows = record
        .scenes
        .iter()
        .filter(|scene| !scene.gaps.is_empty())
        .map(|scene| {
            let figures = scene.gaps.iter().flat_map(|gap| {
                let parts = [
                    gap.psnr - gap.bound_psnr,
                    gap.ideal_psnr - gap.bound_psnr,
                    gap.psnr - gap.ideal_psnr,
                ];
                parts.map(|part| format!("{part:+.2}"))
            });
            std::iter::once(scene.scene.clone()).chain(figures).collect()
        });
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    markdown(&head, rows.collect())
}
