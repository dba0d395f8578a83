//! `budget`: what SRAA costs in memory, reads and time (the paper's tables 1 and 2), and from which shading cost it pays.

use super::study::command;
use crate::args::BudgetArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::{scene, table};
use serde::Serialize;
use std::time::SystemTime;
use straightline_codegen::{Compiled, Kernel, Settings, files};
use straightline_manifest::Stage;
use straightline_runtime::Pass;
use straightline_testbed::capture::ShadingSample;
use straightline_testbed::execute::{Clock, Job, Times, Uploaded};
use straightline_testbed::{gbuffer, render};

/// Bytes of a geometry sample: what is stored, how many bytes, and where that is assumed.
const FORMATS: [(&str, u64); 3] = [
    ("24-bit depth, RGB8 normal (the paper's MB)", 6),
    ("rgba16float, normals=packed", 8),
    ("r32float depth, rgba16float normal", 12),
];

/// The paper's table 1: milliseconds at 1280×720 with 4 samples on a GeForce GTX 480.
const METRICS: [(&str, f64); 4] = [
    ("planes-normals", 1.86),
    ("depth-normals", 1.14),
    ("normals", 0.95),
    ("depth", 0.55),
];

/// Patterns whose filters are timed.
const PATTERNS: [(&str, u64); 2] = [("latin4", 4), ("latin16", 16)];

/// Memory and work of a method.
#[derive(Clone, Debug, Serialize)]
struct Cost {
    method: String,
    geometry_samples: u64,
    shading_samples: u64,
    /// For each of [`FORMATS`].
    gbuffer_bytes: Vec<u64>,
    reads: Option<u32>,
}

/// Time of a filter.
#[derive(Clone, Debug, Serialize)]
struct Filter {
    metric: &'static str,
    pattern: &'static str,
    reads: u32,
    time: Times,
    /// Times as slow as with metric=depth-normals.
    ratio: f64,
    /// The same in the paper.
    paper_ratio: Option<f64>,
    /// Milliseconds of shading per sample and picture from which the filter costs less than shading all samples.
    pays_from_ms: f64,
}

#[derive(Clone, Debug, Serialize)]
struct Record {
    command: String,
    date: String,
    size: [u32; 2],
    geometry_ms: f64,
    adapter: String,
    clock: Clock,
    costs: Vec<Cost>,
    filters: Vec<Filter>,
}

/// Counts, measures, prints.
pub fn run(args: &BudgetArgs) -> Result<(), Failure> {
    let pixels = u64::from(args.size.x) * u64::from(args.size.y);
    if let Some(path) = &args.record {
        files::try_file(path, true).map_err(Failure::of)?;
    }
    let gpu = Gpu::require(&args.adapter)?;
    let (filters, clock) = measured(args, &gpu)?;
    let reads = |pattern: &str| {
        let default = filters
            .iter()
            .find(|f| f.pattern == pattern && f.metric == "depth-normals");
        default.map(|filter| filter.reads)
    };
    let cost = |method: &str, geometry: u64, shading: u64, reads: Option<u32>| Cost {
        method: method.to_owned(),
        geometry_samples: geometry,
        shading_samples: shading,
        gbuffer_bytes: FORMATS.iter().map(|(_, bytes)| pixels * geometry * bytes).collect(),
        reads,
    };
    let costs = vec![
        cost("1x, no antialiasing", 1, 1, None),
        cost("SRAA 4", 4, 1, reads("latin4")),
        cost("SRAA 16", 16, 1, reads("latin16")),
        cost("4x supersampling", 4, 4, None),
        cost("16x supersampling", 16, 16, None),
    ];
    let record = Record {
        command: command(),
        date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        size: args.size.to_array(),
        geometry_ms: args.geometry_ms,
        adapter: gpu.describe(),
        clock,
        costs,
        filters,
    };
    if let Some(path) = &args.record {
        let text = serde_json::to_string_pretty(&record).map_err(Failure::of)? + "\n";
        files::write(path, text.as_bytes()).map_err(Failure::of)?;
    }
    print(args, &record)
}

fn measured(args: &BudgetArgs, gpu: &Gpu) -> Result<(Vec<Filter>, Clock), Failure> {
    let bench = gpu.bench();
    let world = scene::load(None, "roof")?;
    let renderer = scene::renderer(Some(gpu), &world, args.size)?;
    let mut subjects: Vec<(&str, &str, u64, Compiled, Pass, Uploaded)> = Vec::new();
    for (pattern, samples) in PATTERNS {
        let offsets = scene::pattern(pattern)?;
        let capture = render::capture(renderer.as_ref(), &offsets, ShadingSample::Centre).map_err(Failure::of)?;
        for (metric, _) in METRICS {
            let options = [("pattern", pattern), ("metric", metric)];
            let settings = Settings {
                options: options.map(|(k, v)| (k.to_owned(), v.to_owned())).into(),
                ..Settings::default()
            };
            let compiled = Kernel::builtin("sraa")?.compile(&settings)?;
            let inputs = gbuffer::inputs(&capture, &compiled.options).map_err(Failure::of)?;
            let (pass, manifest) = bench.pass(&compiled, Stage::Compute).map_err(Failure::of)?;
            let uploaded = bench.upload(&manifest, &inputs).map_err(Failure::of)?;
            subjects.push((pattern, metric, samples, compiled, pass, uploaded));
        }
    }
    let jobs: Vec<Job<'_>> = subjects
        .iter()
        .map(|(.., pass, uploaded)| Job {
            pass,
            uploaded,
            size: args.size,
        })
        .collect();
    let bar = scene::bar(&format!("timing {} SRAA shaders", jobs.len()));
    bar.set_length(u64::from(args.rounds));
    let timed = bench.interleaved(&jobs, args.rounds, |k| bar.set_position(u64::from(k)));
    let (times, clock) = timed.map_err(Failure::of)?;
    bar.finish_and_clear();
    let base = |pattern: &str| {
        let all = subjects.iter().zip(&times);
        let found = all
            .into_iter()
            .find(|((p, metric, ..), _)| *p == pattern && *metric == "depth-normals");
        found.map_or(f64::NAN, |(_, time)| time.median_ms)
    };
    let paper = |metric: &str| {
        METRICS
            .iter()
            .find(|(known, _)| *known == metric)
            .map(|(_, ms)| ms / METRICS[1].1)
    };
    let filters = subjects
        .iter()
        .zip(&times)
        .map(|((pattern, metric, samples, compiled, ..), time)| Filter {
            metric: METRICS
                .iter()
                .map(|(name, _)| *name)
                .find(|name| name == metric)
                .unwrap_or_default(),
            pattern: PATTERNS
                .iter()
                .map(|(name, _)| *name)
                .find(|name| name == pattern)
                .unwrap_or_default(),
            reads: compiled.counts.texture_reads + compiled.counts.colour_reads,
            time: *time,
            ratio: time.median_ms / base(pattern),
            paper_ratio: paper(metric).filter(|_| *samples == 4),
            pays_from_ms: (args.geometry_ms + time.median_ms) / (*samples as f64 - 1.0),
        });
    Ok((filters.collect(), clock))
}

fn print(args: &BudgetArgs, record: &Record) -> Result<(), Failure> {
    if args.json {
        outln!("{}", serde_json::to_string_pretty(record).map_err(Failure::of)?);
        return Ok(());
    }
    outln!(
        "{}x{} on {}; medians of {} rounds in turn, {}\n",
        record.size[0],
        record.size[1],
        record.adapter,
        args.rounds,
        match record.clock {
            Clock::GpuTimestamps => "GPU timestamps",
            Clock::WallClock => "wall clock",
        }
    );
    let megabytes = |bytes: &u64| format!("{:.1} MB", *bytes as f64 / 1.0e6);
    let rows: Vec<Vec<String>> = record
        .costs
        .iter()
        .map(|cost| {
            let mut row = vec![
                cost.method.clone(),
                cost.geometry_samples.to_string(),
                cost.shading_samples.to_string(),
            ];
            row.extend(cost.gbuffer_bytes.iter().map(megabytes));
            row.push(cost.reads.map_or(String::new(), |reads| reads.to_string()));
            row
        })
        .collect();
    let headings = ["per pixel", "geometry", "shading", "6 B", "8 B", "12 B", "reads"];
    outln!("{}", table::render(&headings, &rows));
    for (format, bytes) in FORMATS {
        outln!("{bytes} B a sample: {format}");
    }
    outln!("Shading at the pixel's centre needs the geometry there too, which the main G-buffer pass has.\n");
    let rows: Vec<Vec<String>> = record
        .filters
        .iter()
        .map(|filter| {
            vec![
                filter.metric.to_owned(),
                filter.pattern.to_owned(),
                filter.reads.to_string(),
                format!(
                    "{:.2} ({:.2} to {:.2})",
                    filter.time.median_ms, filter.time.min_ms, filter.time.max_ms
                ),
                format!("{:.2}", filter.ratio),
                filter.paper_ratio.map_or(String::new(), |ratio| format!("{ratio:.2}")),
                format!("{:.2} ms", filter.pays_from_ms),
            ]
        })
        .collect();
    let headings = ["metric", "pattern", "reads", "ms", "ratio", "paper", "pays from"];
    outln!("{}", table::render(&headings, &rows));
    outln!("ratio: to depth-normals of the same pattern; paper: table 1, GeForce GTX 480.");
    outln!(
        "pays from: shading of one sample a pixel that costs at least this is dearer for all samples than the filter{}.",
        match args.geometry_ms > 0.0 {
            true => format!(" and the {} ms of further geometry", args.geometry_ms),
            false => "; state your further geometry with --geometry-ms".to_owned(),
        }
    );
    Ok(())
}
