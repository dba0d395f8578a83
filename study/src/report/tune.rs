//! Section on tuning to a scene.

use super::plot::{Dot, Line, Plot, Scale, format_number};
use super::{ReportError, format_caption, format_options};
use crate::record::{Candidate, LeftOut, TuneRecord};
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct Tune {
    caption: String,
    scene: String,
    metric: String,
    max_error: f64,
    unit: &'static str,
    /// The GPU that cycles are of, and its compiler.
    compiled_for: Option<String>,
    plot: String,
    front: Vec<Row>,
    chosen: Option<Row>,
    general: Option<Row>,
    left_out: Vec<(String, String)>,
    needed: Vec<(String, String)>,
    /// Term left out of the most general variant, its replacement, the cost of that, and the saving.
    worth: Vec<[String; 4]>,
    refused: Vec<(String, String)>,
    reference: String,
    best: String,
    unfiltered: String,
    fixed: String,
    tried: usize,
    measured: usize,
    learned_from: usize,
    tested_on: usize,
    mean_error: String,
    largest_error: String,
    terms: Vec<(String, String)>,
}

#[derive(Clone, Debug, Serialize)]
struct Row {
    name: String,
    error: String,
    cost: String,
    ratio: String,
    reads: String,
    bytes: String,
    chosen: bool,
}

pub(super) fn build_section(record: &TuneRecord) -> Result<Tune, ReportError> {
    let row = |index: usize| {
        record
            .candidates
            .get(index)
            .map(|c| build_row(c, record.chosen == Some(index)))
    };
    let mut front: Vec<usize> = (0..record.candidates.len())
        .filter(|k| record.candidates[*k].front)
        .collect();
    let cost = |k: &usize| best_known_cost(&record.candidates[*k]);
    front.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    let percent = |value: f64| format!("{:.1} %", value * 100.0);
    let model = &record.model;
    Ok(Tune {
        caption: format_caption(&record.circumstances),
        scene: record.scene.clone(),
        metric: record.metric.clone(),
        max_error: record.max_error,
        unit: record.unit(),
        compiled_for: record.compiled_for.clone(),
        plot: plot_candidates(record, &front)?,
        front: front.iter().filter_map(|k| row(*k)).collect(),
        chosen: record.chosen.and_then(row),
        general: row(record.general),
        left_out: term_costs(&record.left_out),
        needed: term_costs(&record.needed),
        worth: record
            .terms
            .iter()
            .map(|worth| {
                let ratio = worth.ratio.map_or(String::new(), |r| format!("{:.2}", r.median));
                [
                    worth.term.clone(),
                    worth.instead.clone(),
                    format!("{:.4}", worth.cost),
                    ratio,
                ]
            })
            .collect(),
        refused: record
            .refused
            .iter()
            .map(|refused| (refused.variant.clone(), refused.reason.clone()))
            .collect(),
        reference: record.reference.clone(),
        best: format!("{:.4}", record.best),
        unfiltered: format!("{:.4}", record.unfiltered),
        fixed: format_options(&record.fixed),
        tried: record.candidates.len(),
        measured: record.candidates.iter().filter(|c| c.measured_cost().is_some()).count(),
        learned_from: model.learned_from,
        tested_on: model.tested_on,
        mean_error: percent(model.mean_error),
        largest_error: percent(model.largest_error),
        terms: model
            .terms
            .iter()
            .filter(|(_, weight)| *weight > 0.0)
            .map(|(term, weight)| (term.clone(), format!("{weight:.4}")))
            .collect(),
    })
}

fn term_costs(terms: &[LeftOut]) -> Vec<(String, String)> {
    let of = |left: &LeftOut| (left.term.clone(), format!("{:.3}", left.cost));
    terms.iter().map(of).collect()
}

fn best_known_cost(candidate: &Candidate) -> f64 {
    candidate.measured_cost().unwrap_or(candidate.predicted)
}

fn build_row(candidate: &Candidate, chosen: bool) -> Row {
    Row {
        name: candidate.name.clone(),
        error: format!("{:.4}", candidate.error),
        cost: match candidate.measured_cost() {
            Some(measured) => format!("{measured:.2}"),
            None => format!("{:.2} (predicted)", candidate.predicted),
        },
        ratio: candidate.ratio.map_or(String::new(), |r| {
            format!("{:.2} ({:.2} to {:.2})", r.median, r.low, r.high)
        }),
        reads: format_number(candidate.reads),
        bytes: format!("{:.1}", candidate.gbuffer_bytes as f64 / 1e6),
        chosen,
    }
}

fn plot_candidates(record: &TuneRecord, front: &[usize]) -> Result<String, ReportError> {
    let dots = record.candidates.iter().enumerate().map(|(k, candidate)| {
        let measured = candidate.measured_cost().is_some();
        Dot {
            at: (best_known_cost(candidate), candidate.error),
            spread: None,
            color: match (record.chosen == Some(k), record.general == k, measured) {
                (true, ..) => 1,
                (_, true, _) => 6,
                (.., true) => 0,
                _ => 5,
            },
            label: match (record.chosen == Some(k), record.general == k) {
                (true, _) => Some("chosen".to_owned()),
                (_, true) => Some("most general".to_owned()),
                _ => None,
            },
            title: format!(
                "{}: {:.4}, {} {}{}",
                candidate.name,
                candidate.error,
                format_number(best_known_cost(candidate)),
                record.unit(),
                if measured { "" } else { " (predicted)" }
            ),
        }
    });
    let points = front
        .iter()
        .filter_map(|k| record.candidates.get(*k))
        .map(|c| (best_known_cost(c), c.error));
    let plot = Plot {
        size: (980, 440),
        axes: (
            record.unit().to_owned(),
            match record.metric.as_str() {
                "flip" => "mean FLIP (less is better)".to_owned(),
                _ => "PSNR in dB (more is better)".to_owned(),
            },
        ),
        scales: (Scale::Log, Scale::Linear),
        across: true,
        dots: dots.filter(|dot| dot.at.1.is_finite()).collect(),
        lines: vec![Line {
            points: points.collect(),
            color: 1,
            dashed: true,
            label: None,
        }],
    };
    plot.to_svg()
}
