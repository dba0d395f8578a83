//! Output of the measurements as text or JSON.

use super::frame::FrameCost;
use super::{Cost, FORMATS, Record};
use crate::args::BudgetArgs;
use crate::failure::Failure;
use crate::table;
use straightline_bench::execute::{Clock, Quartiles};

/// The paper's table 2: milliseconds at 1280×720 on a GeForce GTX 480, of geometry, shading, filter and net.
const PAPER: [(&str, [f64; 4]); 3] = [
    ("1x", [1.1, 10.0, 0.0, 11.1]),
    ("SRAA 4, sample0", [2.5, 10.0, 1.9, 14.4]),
    ("16x shading", [5.0, 160.0, 2.0, 167.0]),
];

const ROWS: [&str; 4] = ["geometry", "shading", "filter", "net"];

/// Prints the record as JSON, or as tables.
pub fn print_record(args: &BudgetArgs, record: &Record) -> Result<(), Failure> {
    if args.json {
        outln!("{}", serde_json::to_string_pretty(record).map_err(Failure::from_error)?);
        return Ok(());
    }
    outln!(
        "{}, {}x{} on {}; medians of {} rounds in turn, {}, in ms\n",
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
    print_frames(record)?;
    print_comparisons(record)?;
    print_passes(record)?;
    print_filters(record)?;
    if let Some(together) = &record.together {
        outln!(
            "{} in one submission, from graphics to compute and back: {} ms, {} times its parts' sum.\n",
            together.method,
            format_interval(together.ms),
            format_interval(together.over_parts)
        );
    }
    print_memory(record)
}

fn print_frames(record: &Record) -> Result<(), Failure> {
    let ms = |part: Option<Quartiles>| part.map_or("-".to_owned(), |part| format!("{:.2}", part.median));
    let row = |name: &str, cell: &dyn Fn(&FrameCost) -> String| {
        let cells = record.frames.iter().map(cell);
        std::iter::once(name.to_owned()).chain(cells).collect::<Vec<_>>()
    };
    let mut rows = vec![
        row(ROWS[0], &|frame| ms(frame.geometry_ms)),
        row(ROWS[1], &|frame| ms(Some(frame.shading_ms))),
        row(ROWS[2], &|frame| ms(frame.filter_ms)),
        row(ROWS[3], &|frame| ms(Some(frame.net_ms))),
        row("net, lower quartile", &|frame| format!("{:.2}", frame.net_ms.lower)),
        row("net, upper quartile", &|frame| format!("{:.2}", frame.net_ms.upper)),
    ];
    for (index, name) in ROWS.iter().enumerate() {
        rows.push(row(&format!("paper, {name}"), &|frame| {
            let paper = PAPER.iter().find(|(method, _)| *method == frame.method);
            paper.map_or(String::new(), |(_, figures)| format!("{:.1}", figures[index]))
        }));
    }
    let headings: Vec<&str> = std::iter::once("ms")
        .chain(record.frames.iter().map(|frame| frame.method.as_str()))
        .collect();
    outln!("{}", table::render_table(&headings, &rows));
    outln!("paper: SRAA's table 2, 1280x720, GeForce GTX 480.");
    outln!(
        "sample0: shaded at one of the four samples, as in the paper, so three more are drawn; else at the centre, and four more."
    );
    outln!("SRAA 16 has no multisampled pass: WebGPU has four samples, not sixteen.");
    outln!("MSAA 4: forward rendering; geometry, shading and resolve are one pass, which stands under shading.\n");
    Ok(())
}

fn print_comparisons(record: &Record) -> Result<(), Failure> {
    let rows: Vec<Vec<String>> = record
        .comparisons
        .iter()
        .map(|comparison| {
            vec![
                comparison.method.clone(),
                comparison.over.clone(),
                format_interval(comparison.speedup),
                comparison.break_even_ms.map_or(String::new(), not_negative),
            ]
        })
        .collect();
    let headings = ["method", "over", "speedup (quartiles)", "pays from, ms of shading"];
    outln!("{}", table::render_table(&headings, &rows));
    outln!(
        "pays from: what shading once a pixel costs from which SRAA's frame is cheaper, if every sample costs as much; 0: always.\n"
    );
    Ok(())
}

fn print_passes(record: &Record) -> Result<(), Failure> {
    let rows: Vec<Vec<String>> = record
        .passes
        .iter()
        .map(|pass| {
            vec![
                pass.name.to_owned(),
                pass.samples.to_string(),
                pass.passes.to_string(),
                format_interval(pass.ms),
            ]
        })
        .collect();
    outln!(
        "{}",
        table::render_table(&["timed", "samples", "passes", "ms (quartiles)"], &rows)
    );
    let evaluations = match record.shading_cost {
        1 => "1 evaluation".to_owned(),
        several => format!("{several} evaluations"),
    };
    outln!("{evaluations} of the shading for each sample.\n");
    Ok(())
}

fn print_filters(record: &Record) -> Result<(), Failure> {
    let rows: Vec<Vec<String>> = record
        .filters
        .iter()
        .map(|filter| {
            vec![
                filter.metric.to_owned(),
                filter.pattern.to_owned(),
                filter.shading.to_owned(),
                filter.reads.to_string(),
                format_interval(filter.ms),
                format!("{:.2}", filter.ratio),
                filter.paper_ratio.map_or(String::new(), |ratio| format!("{ratio:.2}")),
                not_negative(filter.break_even_ms),
            ]
        })
        .collect();
    let headings = [
        "metric",
        "pattern",
        "shading",
        "reads",
        "ms (quartiles)",
        "ratio",
        "paper",
        "pays from, ms",
    ];
    outln!("{}", table::render_table(&headings, &rows));
    outln!("ratio: to depth-normals of the same pattern, shaded at the centre; paper: table 1, GeForce GTX 480.\n");
    Ok(())
}

fn print_memory(record: &Record) -> Result<(), Failure> {
    let megabytes = |bytes: &u64| format!("{:.1} MB", *bytes as f64 / 1.0e6);
    let row = |cost: &Cost| {
        let mut row = vec![
            cost.method.clone(),
            cost.geometry_samples.to_string(),
            cost.shading_samples.to_string(),
        ];
        row.extend(cost.gbuffer_bytes.iter().map(megabytes));
        row.push(cost.reads.map_or(String::new(), |reads| reads.to_string()));
        row
    };
    let headings = ["per pixel", "geometry", "shading", "6 B", "8 B", "12 B", "reads"];
    outln!(
        "{}",
        table::render_table(&headings, &record.costs.iter().map(row).collect::<Vec<_>>())
    );
    for (format, bytes) in FORMATS {
        outln!("{bytes} B a sample: {format}");
    }
    outln!("Shading at the pixel's centre needs the geometry there too, which the main G-buffer pass has.");
    Ok(())
}

fn format_interval(of: Quartiles) -> String {
    format!("{:.2} ({:.2} to {:.2})", of.median, of.lower, of.upper)
}

/// Formats a cost. Negative costs print as 0: a method with a negative break-even always pays.
fn not_negative(of: Quartiles) -> String {
    format_interval(Quartiles {
        lower: of.lower.max(0.0),
        median: of.median.max(0.0),
        upper: of.upper.max(0.0),
    })
}
