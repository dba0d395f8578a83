//! Output of `tune`.

use crate::args::TuneArgs;
use crate::failure::Failure;
use std::path::PathBuf;
use straightline_study::record::{Candidate, TuneRecord};
use straightline_study::statistics::Interval;
use straightline_study::tune::ErrorMetric;
use straightline_table::Cell;

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
        Some(gpu) => outln!(
            "{scene}, {width}x{height}, pictures by {adapter}; {} by the compiler for {gpu}",
            record.unit()
        ),
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
        let loss = |cost: f64| Cell::new(cost.to_string(), format_loss(cost, metric));
        outln!("{}", record.terms_table(loss).to_text());
    }
    if record.candidates.iter().any(|c| c.front) {
        outln!("Of those measured, the front of cost against error:\n");
        outln!("{}", record.front_table(metric.decimals()).to_text());
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

fn format_loss(cost: f64, metric: ErrorMetric) -> String {
    let what = if cost > 0.0 { "worse" } else { "better" };
    match metric {
        _ if cost == 0.0 => "the same".to_owned(),
        ErrorMetric::Psnr => format!("{:.2} dB {what}", cost.abs()),
        ErrorMetric::Flip => format!("{:.5} {what}", cost.abs()),
    }
}

/// Formats the speedup over the most general variant, which may be slower than one with more terms.
fn format_speed(found: Option<Interval>) -> String {
    match found {
        Some(Interval { median, low, high }) if median < 1.0 => {
            let longer = Interval {
                median: 1.0 / median,
                low: 1.0 / high,
                high: 1.0 / low,
            };
            format!("takes {longer} times as long as the most general variant")
        }
        found => {
            let speedup = found.map_or(String::new(), |found| found.to_string());
            format!("speedup {speedup} over the most general variant")
        }
    }
}
