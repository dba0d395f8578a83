//! Output of the measurements as text or JSON.

use super::frame::FrameCost;
use super::{FORMATS, Record};
use crate::args::BudgetArgs;
use crate::failure::Failure;
use straightline_bench::execute::Clock;
use straightline_study::statistics::Interval;
use straightline_table::{Cell, Column, Table};

/// The paper's table 2: milliseconds at 1280×720 on a GeForce GTX 480, of geometry, shading, filter and net.
const PAPER: [(&str, [f64; 4]); 3] = [
    ("1x", [1.1, 10.0, 0.0, 11.1]),
    ("SRAA 4, sample0", [2.5, 10.0, 1.9, 14.4]),
    ("16x shading", [5.0, 160.0, 2.0, 167.0]),
];

/// Prints the record as JSON, or as tables.
pub fn print_record(args: &BudgetArgs, record: &Record) -> Result<(), Failure> {
    if args.json {
        outln!("{}", serde_json::to_string_pretty(record).map_err(Failure::from_error)?);
        return Ok(());
    }
    outln!(
        "{}, {}x{} on {}; medians of {} rounds in turn with their 95 % intervals, {}, in ms\n",
        record.scene,
        record.circumstances.size[0],
        record.circumstances.size[1],
        record.circumstances.adapter,
        record.circumstances.rounds,
        match record.circumstances.clock {
            Clock::GpuTimestamps => "GPU timestamps",
            Clock::WallClock => "wall clock",
        }
    );
    print_frames(record);
    print_comparisons(record);
    print_passes(record);
    print_filters(record);
    if let Some(together) = &record.together {
        let table = Table::of([together])
            .column("in one submission, from graphics to compute and back", |whole| {
                whole.method
            })
            .column("ms", |whole| interval(whole.ms))
            .column("by the sum of its parts", |whole| interval(whole.over_parts))
            .finish();
        outln!("{}", table.to_text());
    }
    print_memory(record);
    Ok(())
}

/// Prints a table with a row for each part, and a column for each method.
fn print_frames(record: &Record) {
    type Part = (&'static str, fn(&FrameCost) -> Option<f64>);
    const PARTS: [Part; 6] = [
        ("geometry", |frame| frame.geometry_ms.map(|ms| ms.median)),
        ("shading", |frame| Some(frame.shading_ms.median)),
        ("filter", |frame| frame.filter_ms.map(|ms| ms.median)),
        ("net", |frame| Some(frame.net_ms.median)),
        ("net, low", |frame| Some(frame.net_ms.low)),
        ("net, high", |frame| Some(frame.net_ms.high)),
    ];
    let measured = PARTS.map(|(name, _)| name.to_owned());
    let paper = PARTS.into_iter().take(4).map(|(name, _)| format!("paper, {name}"));
    let table = Table::of(measured.into_iter().chain(paper).enumerate())
        .column("ms", |(_, name)| name.clone())
        .columns(
            &record.frames,
            |frame| frame.method.clone(),
            |(k, _), frame| match PARTS.get(*k) {
                Some((_, part)) => part(frame).map(|ms| Cell::fixed(ms, 2)),
                None => {
                    let found = PAPER.iter().find(|(method, _)| *method == frame.method);
                    found.map(|(_, figures)| Cell::fixed(figures[k - PARTS.len()], 1))
                }
            },
        )
        .finish();
    outln!("{}", table.to_text());
    outln!("paper: SRAA's table 2, 1280x720, GeForce GTX 480.");
    outln!(
        "sample0: shaded at one of the four samples, as in the paper, so three more are drawn; else at the centre, and four more."
    );
    outln!("SRAA 16 has no multisampled pass: WebGPU has four samples, not sixteen.");
    outln!("MSAA 4: forward rendering; geometry, shading and resolve are one pass, shown as shading.\n");
}

fn print_comparisons(record: &Record) {
    let table = Table::of(&record.comparisons)
        .column("method", |comparison| &comparison.method)
        .column(Column::from("over").left(), |comparison| &comparison.over)
        .column("speedup", |comparison| interval(comparison.speedup))
        .column("pays from, ms of shading", |comparison| {
            comparison.break_even_ms.map(not_negative)
        })
        .finish();
    outln!("{}", table.to_text());
    outln!(
        "pays from: what shading once a pixel costs from which SRAA's frame is cheaper, if every sample costs as much; 0: always.\n"
    );
}

fn print_passes(record: &Record) {
    let table = Table::of(&record.passes)
        .column("timed", |pass| pass.name)
        .column("samples", |pass| pass.samples)
        .column("passes", |pass| pass.passes)
        .column("ms", |pass| interval(pass.ms))
        .finish();
    outln!("{}", table.to_text());
    let evaluations = match record.shading_cost {
        1 => "1 evaluation".to_owned(),
        several => format!("{several} evaluations"),
    };
    outln!("{evaluations} of the shading for each sample.\n");
}

fn print_filters(record: &Record) {
    let ratio = |ratio: f64| Cell::fixed(ratio, 2);
    let table = Table::of(&record.filters)
        .column("metric", |filter| filter.metric)
        .column(Column::from("pattern").left(), |filter| filter.pattern)
        .column(Column::from("shading").left(), |filter| filter.shading)
        .column("reads", |filter| filter.reads)
        .column("ms", |filter| interval(filter.ms))
        .column("ratio", |filter| ratio(filter.ratio))
        .column("paper", |filter| filter.paper_ratio.map(ratio))
        .column("pays from, ms", |filter| not_negative(filter.break_even_ms))
        .finish();
    outln!("{}", table.to_text());
    outln!("ratio: to depth-normals of the same pattern, shaded at the centre; paper: table 1, GeForce GTX 480.\n");
}

fn print_memory(record: &Record) {
    let table = Table::of(&record.costs)
        .column("per pixel", |cost| &cost.method)
        .column("geometry", |cost| cost.geometry_samples)
        .column("shading", |cost| cost.shading_samples)
        .columns(
            FORMATS.iter().enumerate(),
            |(_, (_, bytes))| format!("{bytes} B"),
            |cost, (k, _)| Cell::fixed(cost.gbuffer_bytes[*k] as f64 / 1.0e6, 1).suffixed(" MB"),
        )
        .column("reads", |cost| cost.reads)
        .finish();
    outln!("{}", table.to_text());
    for (format, bytes) in FORMATS {
        outln!("{bytes} B a sample: {format}");
    }
    outln!("Shading at the pixel's centre needs the geometry there too, which the main G-buffer pass has.");
}

/// Returns a median with its interval as a cell.
fn interval(of: Interval) -> Cell {
    Cell::interval(of.to_array(), 2)
}

/// Returns a cost as a cell. Negative costs are shown as 0: a method with a negative break-even always pays.
fn not_negative(of: Interval) -> Cell {
    interval(of.map(|ms| ms.max(0.0)))
}
