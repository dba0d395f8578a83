//! `unroll`: what unrolling is worth, kernel by kernel.

use crate::args::UnrollArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::{scene, table};
use serde::Serialize;
use std::path::Path;
use std::time::SystemTime;
use straightline_codegen::{Compiled, Kernel, Settings, Unroll};
use straightline_manifest::Stage;
use straightline_runtime::Pass;
use straightline_study::execute::{Bench, Bound, Clock, ExecuteError, Inputs, Job, Times, interpret, test_inputs};
use straightline_study::picture;

/// Policies in the order of the table; all are compared with the first.
const POLICIES: [Unroll; 4] = [Unroll::None, Unroll::Partial(2), Unroll::Partial(4), Unroll::Full];

/// One kernel with its loops treated in one way.
#[derive(Clone, Debug, Serialize)]
struct Row {
    kernel: String,
    unroll: String,
    loops: u32,
    statements: u32,
    reads: u32,
    time: Times,
    /// How many times as fast as with its loops kept.
    ratio: f64,
    /// Largest difference of a colour to the same graph in `f64`, over pixels where no decision hangs on the last bit.
    largest_difference_to_f64: f64,
    /// The same, of all but the thousandth of the pixels that differ most.
    difference_to_f64_999: f64,
}

/// A run and its circumstances.
#[derive(Clone, Debug, Serialize)]
struct Record {
    command: String,
    date: String,
    adapter: String,
    clock: Clock,
    size: [u32; 2],
    rounds: u32,
    input: &'static str,
    rows: Vec<Row>,
}

/// A kernel in every policy, ready to run.
struct Subject {
    name: String,
    inputs: Inputs,
    exact: Vec<[f64; 4]>,
    forms: Vec<(Compiled, u32, Pass, Bound)>,
}

/// Measures every kernel in every policy, in one run.
pub fn run(args: &UnrollArgs) -> Result<(), Failure> {
    let gpu = Gpu::require(&args.adapter)?;
    let bench = gpu.bench();
    let mut subjects = Vec::new();
    for name in &args.kernels {
        subjects.push(prepare(&bench, args, name)?);
    }
    let mut jobs = Vec::new();
    for subject in &subjects {
        for (_, _, pass, bound) in &subject.forms {
            let size = subject.inputs.size;
            jobs.push(Job { pass, bound, size });
        }
    }
    let bar = scene::bar("timing, in turn");
    bar.set_length(u64::from(args.rounds));
    let timed = bench.interleaved(&jobs, args.rounds, |k| bar.set_position(u64::from(k)));
    let (times, clock) = timed.map_err(Failure::of)?;
    bar.finish_and_clear();

    let mut rows = Vec::new();
    let mut times = times.into_iter();
    for subject in &subjects {
        let mut looped = None;
        for ((compiled, statements, ..), unroll) in subject.forms.iter().zip(POLICIES) {
            let Some(time) = times.next() else { continue };
            let looped = *looped.get_or_insert(time.median_ms);
            let (largest, most) = differences(&bench, subject, compiled)?;
            rows.push(Row {
                kernel: subject.name.clone(),
                unroll: unroll.to_string(),
                loops: compiled.counts.loops,
                statements: *statements,
                reads: compiled.counts.texture_reads + compiled.counts.colour_reads,
                time,
                ratio: looped / time.median_ms,
                largest_difference_to_f64: largest,
                difference_to_f64_999: most,
            });
        }
    }
    if let Some(folder) = &args.pictures {
        write_pictures(&bench, folder, &subjects)?;
    }
    let record = Record {
        command: std::env::args().collect::<Vec<_>>().join(" "),
        date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        adapter: gpu.describe(),
        clock,
        size: args.size.to_array(),
        rounds: args.rounds,
        input: "the test card of `straightline_study::execute::test_inputs`",
        rows,
    };
    print(args, &record)
}

fn prepare(bench: &Bench, args: &UnrollArgs, name: &str) -> Result<Subject, Failure> {
    let kernel = Kernel::locate(name)?;
    let mut forms = Vec::new();
    let mut exact = None;
    let mut inputs = None;
    for unroll in POLICIES {
        let settings = Settings {
            unroll,
            ..Settings::default()
        };
        let compiled = kernel.compile(&settings)?;
        let inputs = inputs.get_or_insert_with(|| test_inputs(&compiled.graph, args.size));
        if exact.is_none() {
            exact = Some(interpret::<f64>(&compiled, inputs, false).map_err(Failure::of)?.texels);
        }
        let ready = || -> Result<(u32, Pass, Bound), ExecuteError> {
            let (pass, manifest) = bench.pass(&compiled, Stage::Compute)?;
            let bound = bench.bind(&pass, &manifest, inputs)?;
            Ok((manifest.counts.statements, pass, bound))
        };
        let (statements, pass, bound) = ready().map_err(Failure::of)?;
        forms.push((compiled, statements, pass, bound));
    }
    Ok(Subject {
        name: kernel.name().to_owned(),
        inputs: inputs.unwrap_or_default(),
        exact: exact.unwrap_or_default(),
        forms,
    })
}

/// The largest difference to `f64`, and the largest but for a thousandth of the pixels.
fn differences(bench: &Bench, subject: &Subject, compiled: &Compiled) -> Result<(f64, f64), Failure> {
    let found = bench
        .run(compiled, Stage::Compute, &subject.inputs)
        .map_err(Failure::of)?;
    let off = |(a, b): (&glam::Vec4, &[f64; 4])| (0..4).map(|k| (f64::from(a[k]) - b[k]).abs()).fold(0.0, f64::max);
    let mut all: Vec<f64> = found.texels().iter().zip(&subject.exact).map(off).collect();
    all.sort_by(f64::total_cmp);
    let at = |share: f64| {
        all.get(((all.len() as f64 * share) as usize).min(all.len().saturating_sub(1)))
            .copied()
    };
    Ok((at(1.0).unwrap_or(0.0), at(0.999).unwrap_or(0.0)))
}

/// What each kernel makes, unrolled.
fn write_pictures(bench: &Bench, folder: &Path, subjects: &[Subject]) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|e| Failure::of(format!("cannot make `{}`: {e}", folder.display())))?;
    let mut all = Vec::new();
    for subject in subjects {
        let Some((compiled, ..)) = subject.forms.last() else {
            continue;
        };
        let frame = bench
            .run(compiled, Stage::Compute, &subject.inputs)
            .map_err(Failure::of)?;
        picture::write(&folder.join(format!("{}.png", subject.name)), &frame).map_err(Failure::of)?;
        all.push((subject.name.as_str(), frame));
    }
    let columns: Vec<_> = all.iter().map(|(name, frame)| (*name, frame)).collect();
    picture::write(&folder.join("all.png"), &picture::montage(&columns)).map_err(Failure::of)
}

fn print(args: &UnrollArgs, record: &Record) -> Result<(), Failure> {
    let json = serde_json::to_string_pretty(record).map_err(Failure::of)? + "\n";
    if let Some(path) = &args.record {
        std::fs::write(path, &json).map_err(|e| Failure::of(format!("cannot write `{}`: {e}", path.display())))?;
    }
    if args.json {
        print!("{json}");
        return Ok(());
    }
    let [width, height] = record.size;
    println!(
        "{}, {width}x{height}, {} rounds in turn, {}\n",
        record.adapter, record.rounds, record.date
    );
    let cells = |row: &Row| {
        vec![
            row.kernel.clone(),
            row.unroll.clone(),
            row.loops.to_string(),
            row.statements.to_string(),
            row.reads.to_string(),
            format!(
                "{:.2} ({:.2} to {:.2})",
                row.time.median_ms, row.time.min_ms, row.time.max_ms
            ),
            format!("{:.2}", row.ratio),
            format!("{:.1e}", row.difference_to_f64_999),
            format!("{:.1e}", row.largest_difference_to_f64),
        ]
    };
    let rows: Vec<Vec<String>> = record.rows.iter().map(cells).collect();
    let head = [
        "kernel",
        "unroll",
        "loops",
        "statements",
        "reads",
        "ms",
        "times as fast",
        "off f64, 99.9 %",
        "largest",
    ];
    print!("{}", table::render(&head, &rows));
    Ok(())
}
