//! Output of `tune`.

use crate::args::TuneArgs;
use crate::failure::Failure;
use crate::table;
use std::path::PathBuf;
use straightline_bench::execute::Ratio;
use straightline_study::record::{Candidate, TuneRecord};
use straightline_study::tune::ErrorMetric;

/// Prints the record as JSON, or its findings as tables.
pub fn print_report(args: &TuneArgs, record: &TuneRecord, written: &[PathBuf]) -> Result<(), Failure> {
    if args.json {
        outln!("{}", serde_json::to_string_pretty(record).map_err(Failure::from_error)?);
        return Ok(());
    }
    let metric = args.metric;
    let [width, height] = record.circumstances.size;
    let (scene, adapter) = (&record.scene, &record.circumstances.adapter);
    match &record.compiled_for {
        Some(gpu) => outln!("{scene}, {width}x{height}, pictures by {adapter}; cycles by the compiler for {gpu}"),
        None => outln!(
            "{scene}, {width}x{height}, {adapter}; {} rounds in turn",
            record.circumstances.rounds
        ),
    }
    let of_paper = record.best_of_paper().filter(|best| *best != record.best);
    outln!(
        "{} variants against {}; the best has {}{}, the unfiltered picture {}\n",
        record.candidates.len(),
        record.reference,
        metric.format_error(record.best),
        of_paper.map_or(String::new(), |best| format!(
            " (of the paper's terms alone {})",
            metric.format_error(best)
        )),
        metric.format_error(record.unfiltered)
    );
    for line in &record.not_searched {
        outln!("not searched: {line}");
    }
    if let Some(refused) = record.refused.first() {
        outln!(
            "{} variants refused, the first: {}: {}",
            record.refused.len(),
            refused.variant,
            refused.reason
        );
    }
    if !record.terms.is_empty() {
        outln!("\nThe most general variant with one term replaced:\n");
        outln!("{}", terms_table(record, metric));
    }
    if record.candidates.iter().any(|c| c.front) {
        outln!("Of those measured, the front of cost against error:\n");
        outln!("{}", front_table(record, metric));
    }
    let model = &record.model;
    if model.learned_from > 0 {
        outln!(
            "costs were predicted from counts learned on {} variants; on {} others they are off by {:.0} % on average, {:.0} % at most",
            model.learned_from,
            model.tested_on,
            100.0 * model.mean_error,
            100.0 * model.largest_error
        );
    }
    if let Some(chosen) = record.chosen.and_then(|k| record.candidates.get(k)) {
        print_choice(record, chosen, metric);
    }
    outln!();
    for path in written {
        outln!("{}", path.display());
    }
    Ok(())
}

fn print_choice(record: &TuneRecord, chosen: &Candidate, metric: ErrorMetric) {
    outln!("\nchosen: {}", chosen.name);
    outln!(
        "  {}, budget {}; {}",
        metric.format_error(chosen.error),
        format_budget(record, metric),
        format_speed(chosen.ratio)
    );
    for needed in &record.needed {
        outln!("  needs {}: {} without", needed.term, format_loss(needed.cost, metric));
    }
    for out in &record.left_out {
        outln!("  without {}: {}", out.term, format_loss(out.cost, metric));
    }
}

/// Formats the worst error that the budget allows.
fn format_budget(record: &TuneRecord, metric: ErrorMetric) -> String {
    match metric {
        ErrorMetric::Psnr => format!("at least {}", metric.format_error(record.best - record.max_error)),
        ErrorMetric::Flip => format!("at most {}", metric.format_error(record.best + record.max_error)),
    }
}

fn terms_table(record: &TuneRecord, metric: ErrorMetric) -> String {
    let rows = record.terms.iter().map(|term| {
        vec![
            term.term.clone(),
            term.instead.clone(),
            format_loss(term.cost, metric),
            format_ratio(term.ratio),
        ]
    });
    table::render_table(&["instead of", "with", "error", "speedup"], &rows.collect::<Vec<_>>())
}

fn front_table(record: &TuneRecord, metric: ErrorMetric) -> String {
    let mut shown: Vec<(usize, &Candidate)> = record.candidates.iter().enumerate().filter(|(_, c)| c.front).collect();
    let speed = |c: &Candidate| c.ratio.map_or(0.0, |ratio| ratio.median);
    shown.sort_by(|a, b| speed(b.1).total_cmp(&speed(a.1)));
    if let Some(general) = record.candidates.get(record.general)
        && !general.front
    {
        shown.push((record.general, general));
    }
    let rows = shown.iter().map(|(index, c)| {
        let mark = match (record.chosen == Some(*index), *index == record.general) {
            (true, _) => " <- chosen",
            (_, true) => " <- most general",
            _ => "",
        };
        vec![
            format!("{}{mark}", c.name),
            metric.format_error(c.error),
            c.measured_cost().map_or(String::new(), |cost| format!("{cost:.2}")),
            format_ratio(c.ratio),
            format!("{:.2}", c.predicted),
            format!("{:.1}", c.gbuffer_bytes as f64 / 1.0e6),
        ]
    });
    let predicted = format!("predicted {}", record.unit());
    let headings = ["variant", "error", record.unit(), "speedup", &predicted, "G-buffer MB"];
    table::render_table(&headings, &rows.collect::<Vec<_>>())
}

fn format_loss(cost: f64, metric: ErrorMetric) -> String {
    let what = if cost > 0.0 { "worse" } else { "better" };
    match metric {
        _ if cost == 0.0 => "the same".to_owned(),
        ErrorMetric::Psnr => format!("{:.2} dB {what}", cost.abs()),
        ErrorMetric::Flip => format!("{:.5} {what}", cost.abs()),
    }
}

/// Formats the speedup over the most general variant, which may be slower than one with more terms.
fn format_speed(found: Option<Ratio>) -> String {
    let longer = found.filter(|found| found.median < 1.0).map(|found| Ratio {
        median: 1.0 / found.median,
        low: 1.0 / found.high,
        high: 1.0 / found.low,
    });
    match longer {
        Some(_) => format!(
            "takes {} times as long as the most general variant",
            format_ratio(longer)
        ),
        None => format!("speedup {} over the most general variant", format_ratio(found)),
    }
}

fn format_ratio(ratio: Option<Ratio>) -> String {
    ratio.map_or(String::new(), |r| match r.low == r.high {
        true => format!("{:.2}", r.median),
        false => format!("{:.2} ({:.2} to {:.2})", r.median, r.low, r.high),
    })
}
