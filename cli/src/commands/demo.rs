//! `demo`: a tour of Straightline in one run.

use super::command_line;
use crate::args::DemoArgs;
use crate::failure::Failure;
use crate::gpu::{self, Gpu};
use crate::scene;
use glam::{UVec2, Vec4};
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::{Instant, SystemTime};
use straightline_bench::execute::{Clock, ExecuteError, Inputs, Job, Times, Uploaded, interpret_kernel};
use straightline_codegen::{Compiled, Kernel, Settings, Unroll, default_set, files};
use straightline_kernels::prelude::Frame;
use straightline_manifest::Stage;
use straightline_oracle::metrics;
use straightline_oracle::oracle::{self, SraaParams};
use straightline_runtime::Pass;
use straightline_scene::capture::{Capture, ShadingSample};
use straightline_scene::gbuffer;
use straightline_scene::picture;
use straightline_scene::render::{self, Renderer};
use straightline_table::{Cell, Table};

/// An antialiased picture and its measurements.
struct Method {
    name: &'static str,
    unrolled: Compiled,
    looped: Compiled,
    capture: Capture,
    inputs: Inputs,
}

/// Side of the detail in pixels, and its magnification.
const SIDE: u32 = 80;
const ZOOM: u32 = 5;

/// A row of the table.
#[derive(Clone, Debug, Serialize)]
struct Row {
    method: String,
    texture_reads: Option<u32>,
    weight_evaluations: Option<u32>,
    looped: Option<Times>,
    unrolled: Option<Times>,
    ratio: Option<f64>,
    psnr_db: f64,
    largest_difference_to_f64: Option<f64>,
}

/// The table with its circumstances.
#[derive(Debug, Serialize)]
struct Record {
    command: String,
    date: String,
    scene: String,
    size: [u32; 2],
    executor: String,
    clock: Clock,
    reference: String,
    rows: Vec<Row>,
}

/// Emits shaders, renders a scene, antialiases it, compares, writes and prints.
pub fn run_demo(args: &DemoArgs) -> Result<(), Failure> {
    files::try_folder(&args.out).map_err(Failure::from_error)?;
    let gpu = Gpu::open(&args.adapter)?;
    if gpu.is_none() {
        errln!(
            "No GPU adapter: the same graphs run on the CPU interpreter instead. For the shaders, {}.",
            gpu::INSTALL
        );
    }
    let size = args.size.unwrap_or(if gpu.is_some() {
        UVec2::new(1280, 720)
    } else {
        UVec2::new(320, 180)
    });
    let shaders = default_set::emit_files().map_err(Failure::from_error)?;
    let shaders = shaders
        .into_iter()
        .map(|(name, bytes)| (format!("shaders/{name}"), bytes));
    let mut set: BTreeMap<String, Vec<u8>> = shaders.collect();

    let world = scene::load_scene(args.mesh.as_deref(), &args.scene)?;
    let renderer = scene::create_renderer(gpu.as_ref(), &world, size)?;
    let methods = [
        prepare_method("SRAA 4", "latin4", renderer.as_ref())?,
        prepare_method("SRAA 16", "latin16", renderer.as_ref())?,
    ];
    let x16 = render_supersampled(renderer.as_ref(), 4, "16x supersampling")?;
    let x256 = render_supersampled(renderer.as_ref(), 16, "256x reference")?;

    let mut rows = vec![plain_row("1x, no antialiasing", &methods[0].capture.color, &x256)];
    let mut pictures = vec![("1x", methods[0].capture.color.clone())];
    let mut clock = Clock::WallClock;
    for method in &methods {
        let (resolved, [looped, unrolled], measured) = match &gpu {
            Some(gpu) => on_adapter(gpu, method, args.rounds)?,
            None => on_interpreter(method)?,
        };
        clock = measured;
        rows.push(measured_row(method, &resolved, looped, unrolled, &x256)?);
        pictures.push((method.name, resolved));
    }
    rows.push(plain_row("16x supersampling", &x16, &x256));
    pictures.push(("16x supersampled", x16));
    add_pictures(&mut set, &pictures, &x256)?;
    // Shaders and pictures are written as one set, all or none.
    files::write_all(&args.out, &set).map_err(Failure::from_error)?;

    let executor = gpu.as_ref().map_or("CPU interpreter".to_owned(), Gpu::describe);
    let record = Record {
        command: command_line(),
        date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        scene: args
            .mesh
            .as_ref()
            .map_or("built-in".to_owned(), |p| p.display().to_string()),
        size: size.to_array(),
        executor,
        clock,
        reference: "256x supersampling, PSNR over linear RGB clamped to 0..1".to_owned(),
        rows,
    };
    print(args, &record)
}

fn prepare_method(name: &'static str, pattern: &'static str, renderer: &dyn Renderer) -> Result<Method, Failure> {
    let compile = |unroll| {
        let options = vec![("pattern".to_owned(), pattern.to_owned())];
        let settings = Settings::new().set_all(options).unroll(unroll);
        Kernel::builtin("sraa").and_then(|kernel| kernel.compile(&settings))
    };
    let samples = scene::sample_offsets(pattern)?;
    let capture = render::capture_scene(renderer, &samples, ShadingSample::Centre).map_err(Failure::from_error)?;
    let unrolled = compile(Unroll::Full)?;
    Ok(Method {
        name,
        inputs: gbuffer::sraa_inputs(&capture, &unrolled.options).map_err(Failure::from_error)?,
        unrolled,
        looped: compile(Unroll::None)?,
        capture,
    })
}

fn render_supersampled(renderer: &dyn Renderer, side: u32, what: &'static str) -> Result<Frame<Vec4>, Failure> {
    let bar = scene::progress_bar(what);
    let frame = render::render_reference(renderer, side, &mut scene::advance_bar(&bar)).map_err(Failure::from_error)?;
    bar.finish_and_clear();
    Ok(frame)
}

/// The picture, the times of the looped and unrolled forms, and the clock.
type Measured = (Frame<Vec4>, [Times; 2], Clock);

fn on_adapter(gpu: &Gpu, method: &Method, rounds: u32) -> Result<Measured, Failure> {
    let (inputs, bench) = (&method.inputs, gpu.bench());
    let prepared = |compiled| -> Result<(Pass, Uploaded), ExecuteError> {
        let (pass, manifest) = bench.compile_pass(compiled, Stage::Compute)?;
        let uploaded = bench.upload(&manifest, inputs)?;
        Ok((pass, uploaded))
    };
    let prepared = [&method.looped, &method.unrolled].map(prepared);
    let mut jobs = Vec::new();
    for pair in &prepared {
        let (pass, uploaded) = pair.as_ref().map_err(Failure::from_error)?;
        let size = inputs.size;
        jobs.push(Job { pass, uploaded, size });
    }
    let bar = scene::progress_bar("timing 2 SRAA shaders");
    bar.set_length(u64::from(rounds));
    let timed = bench.time_interleaved(&jobs, rounds, |k| bar.set_position(u64::from(k)));
    let (times, clock) = timed.map_err(Failure::from_error)?;
    bar.finish_and_clear();
    let resolved = bench
        .run(&method.unrolled, Stage::Compute, inputs)
        .map_err(Failure::from_error)?;
    let times = times
        .try_into()
        .map_err(|_| Failure::Failed("nothing was timed".to_owned()))?;
    Ok((resolved, times, clock))
}

/// Runs one round in the interpreter, which is there to show the result, not to be timed.
fn on_interpreter(method: &Method) -> Result<Measured, Failure> {
    let inputs = &method.inputs;
    let mut times = [Vec::new(), Vec::new()];
    let mut resolved = None;
    let bar = scene::progress_bar("interpreting 2 shaders");
    bar.set_length(2);
    for (times, compiled) in times.iter_mut().zip([&method.looped, &method.unrolled]) {
        let start = Instant::now();
        let texels = interpret_kernel::<f32>(compiled, inputs, false).map_err(Failure::from_error)?;
        resolved = Some(texels.frame(inputs));
        times.push(start.elapsed());
        bar.inc(1);
    }
    bar.finish_and_clear();
    match (
        resolved,
        Times::from_durations(&times[0]),
        Times::from_durations(&times[1]),
    ) {
        (Some(resolved), Some(looped), Some(unrolled)) => Ok((resolved, [looped, unrolled], Clock::WallClock)),
        _ => Err(Failure::from_error("nothing was interpreted")),
    }
}

fn plain_row(method: &str, frame: &Frame<Vec4>, reference: &Frame<Vec4>) -> Row {
    Row {
        method: method.to_owned(),
        texture_reads: None,
        weight_evaluations: None,
        looped: None,
        unrolled: None,
        ratio: None,
        psnr_db: metrics::psnr(frame, reference),
        largest_difference_to_f64: None,
    }
}

fn measured_row(
    method: &Method,
    resolved: &Frame<Vec4>,
    looped: Times,
    unrolled: Times,
    reference: &Frame<Vec4>,
) -> Result<Row, Failure> {
    let counts = &method.unrolled.counts;
    let params = SraaParams::from_options(&method.unrolled.options).map_err(Failure::from_error)?;
    let exact = oracle::resolve_sraa(&method.inputs, &params).map_err(Failure::from_error)?;
    let exact: Vec<[f64; 4]> = exact.into_iter().map(|pixel| pixel.color).collect();
    Ok(Row {
        texture_reads: Some(counts.texture_reads + counts.colour_reads),
        weight_evaluations: counts.tallies.get("weight_evaluations").copied(),
        ratio: Some(looped.median_ms / unrolled.median_ms),
        looped: Some(looped),
        unrolled: Some(unrolled),
        largest_difference_to_f64: Some(metrics::max_abs_difference_to(resolved, &exact)),
        ..plain_row(method.name, resolved, reference)
    })
}

fn add_pictures(
    set: &mut BTreeMap<String, Vec<u8>>,
    pictures: &[(&str, Frame<Vec4>)],
    reference: &Frame<Vec4>,
) -> Result<(), Failure> {
    let mut save = |name: &str, frame: &Frame<Vec4>| -> Result<(), Failure> {
        set.insert(name.to_owned(), picture::png_bytes(frame).map_err(Failure::from_error)?);
        Ok(())
    };
    for (name, frame) in pictures {
        save(&format!("{}.png", name.to_lowercase().replace(' ', "-")), frame)?;
    }
    save("256x-reference.png", reference)?;
    let corner = picture::find_busiest_square(&pictures[0].1, reference, SIDE);
    let all: Vec<(&str, &Frame<Vec4>)> = pictures.iter().map(|(name, frame)| (*name, frame)).collect();
    save("detail.png", &picture::compare_details(&all, corner, SIDE, ZOOM))
}

fn print(args: &DemoArgs, record: &Record) -> Result<(), Failure> {
    if args.json {
        outln!("{}", serde_json::to_string_pretty(record).map_err(Failure::from_error)?);
        return Ok(());
    }
    let time = |time: &Option<Times>| time.as_ref().map(|time| Cell::fixed(time.median_ms, 2).suffixed(" ms"));
    let table = Table::of(&record.rows)
        .column("method", |row| &row.method)
        .column("reads", |row| row.texture_reads)
        .column("weights", |row| row.weight_evaluations)
        .column("looped", |row| time(&row.looped))
        .column("unrolled", |row| time(&row.unrolled))
        .column("ratio", |row| {
            row.ratio.map(|ratio| Cell::fixed(ratio, 1).suffixed("x"))
        })
        .column("PSNR", |row| Cell::fixed(row.psnr_db, 2).suffixed(" dB"))
        .scientific("off f64 by", 1, |row| row.largest_difference_to_f64)
        .finish();
    outln!("{}", table.to_text());
    let with = match record.clock {
        Clock::GpuTimestamps => "GPU timestamps, shaders in turn",
        Clock::WallClock => "wall clock, in turn",
    };
    outln!(
        "{}x{} on {}; medians by {with}.",
        record.size[0],
        record.size[1],
        record.executor
    );
    outln!("PSNR is against {}.", record.reference);
    outln!(
        "Shaders, pictures and an enlarged detail are in {}.",
        args.out.display()
    );
    Ok(())
}
