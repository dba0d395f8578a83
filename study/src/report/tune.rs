//! Section on tuning to a scene.

use super::plot::{Dot, Line, Plot, Scale, format_number};
use super::{ReportError, format_caption};
use crate::record::{Candidate, LeftOut, TuneRecord, join_options};
use serde::Serialize;
use straightline_table::Cell;

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
    /// Table of the front, and of the most general variant.
    front: String,
    /// Name, error, cost and speedup of the chosen variant.
    chosen: Option<[String; 4]>,
    left_out: Vec<(String, String)>,
    needed: Vec<(String, String)>,
    /// Table of the terms of the most general variant; empty without one.
    worth: String,
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

pub(super) fn build_section(record: &TuneRecord) -> Result<Tune, ReportError> {
    let mut front: Vec<usize> = (0..record.candidates.len())
        .filter(|k| record.candidates[*k].front)
        .collect();
    let cost = |k: &usize| record.candidates[*k].best_known_cost();
    front.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    let chosen = |k: usize| Some(describe_choice(record.candidates.get(k)?));
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
        front: record.front_table(4).to_html(),
        chosen: record.chosen.and_then(chosen),
        left_out: term_costs(&record.left_out),
        needed: term_costs(&record.needed),
        worth: match record.terms.is_empty() {
            true => String::new(),
            false => record.terms_table(|cost| Cell::fixed(cost, 4)).to_html(),
        },
        refused: record
            .refused
            .iter()
            .map(|refused| (refused.variant.clone(), refused.reason.clone()))
            .collect(),
        reference: record.reference.clone(),
        best: format!("{:.4}", record.best),
        unfiltered: format!("{:.4}", record.unfiltered),
        fixed: join_options(&record.fixed),
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

/// Returns name, error, cost and speedup of a variant.
fn describe_choice(candidate: &Candidate) -> [String; 4] {
    let predicted = if candidate.measured_cost().is_some() {
        ""
    } else {
        " (predicted)"
    };
    [
        candidate.name.clone(),
        format!("{:.4}", candidate.error),
        format!("{:.2}{predicted}", candidate.best_known_cost()),
        candidate.ratio.map_or(String::new(), |ratio| ratio.to_string()),
    ]
}

fn plot_candidates(record: &TuneRecord, front: &[usize]) -> Result<String, ReportError> {
    let dots = record.candidates.iter().enumerate().map(|(k, candidate)| {
        let measured = candidate.measured_cost().is_some();
        Dot {
            at: (candidate.best_known_cost(), candidate.error),
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
                format_number(candidate.best_known_cost()),
                record.unit(),
                if measured { "" } else { " (predicted)" }
            ),
        }
    });
    let points = front
        .iter()
        .filter_map(|k| record.candidates.get(*k))
        .map(|c| (c.best_known_cost(), c.error));
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
