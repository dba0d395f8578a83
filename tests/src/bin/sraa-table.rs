//! Every metric × pattern × falloff × normalisation × layout × stage of SRAA on this machine's adapter: the largest
//! difference of the emitted shader to the oracle in f64, or the reason why there is none. Then every metric on every scene
//! of the testbed, with the bound of the error analysis in `oracle::bound`.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;
use straightline_bench::execute::Bench;
use straightline_codegen::{Stage, Unroll};
use straightline_kernels::prelude::uvec2;
use straightline_oracle::oracle::{self, SraaParams};
use straightline_tests::sraa::options::{choices, completed, refusal, samples_needed};
use straightline_tests::sraa::{Options, compiled, difference, scenes, surfaces};

const USAGE: &str = "usage: sraa-table [--record FILE]";

/// Options that vary over the rows.
const COLUMNS: [&str; 5] = ["metric", "pattern", "falloff", "normalisation", "layout"];

fn main() -> ExitCode {
    let mut words = std::env::args().skip(1);
    let record = match (words.next().as_deref(), words.next(), words.next()) {
        (None, ..) => None,
        (Some("--record"), Some(path), None) => Some(PathBuf::from(path)),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match table(record) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Maximum error of a row, for colours in 0..1.
const BOUND: f64 = 1.0 / 1024.0;

/// Returns whether all rows are within the bound.
fn table(record: Option<PathBuf>) -> Result<bool, String> {
    let (bench, adapter, samples) = device()?;
    let start = Instant::now();
    let (mut rows, mut worst, mut over) = (Vec::new(), BTreeMap::<String, f64>::new(), 0);
    let (mut run, mut refused) = (0, 0);
    for options in all() {
        for stage in [Stage::Compute, Stage::Fragment] {
            let outcome = match refusal(&options) {
                Some(why) => {
                    if compiled(&options, Unroll::Full).is_ok() {
                        return Err(format!("{options:?} should be refused: {why}"));
                    }
                    Err(format!("refused by the kernel: {why}"))
                }
                None if samples_needed(&options) > samples => {
                    Err(format!("not run: this adapter has {samples} samples a texel at most"))
                }
                None => Ok(row(&bench, &options, stage)?),
            };
            match &outcome {
                Ok((largest, bad)) => {
                    run += 1;
                    over += usize::from(*largest > BOUND || *bad > 0);
                    for name in COLUMNS {
                        let value = options.iter().find(|(known, _)| known == name);
                        let key = format!("{name}={}", value.map_or("", |(_, value)| value.as_str()));
                        let entry = worst.entry(key).or_default();
                        *entry = entry.max(*largest);
                    }
                }
                Err(_) => refused += 1,
            }
            rows.push((options.clone(), stage, outcome));
        }
    }
    let on_scenes = scenes::rows(&bench)?;
    let beyond: usize = on_scenes.iter().map(|row| row.beyond).sum();
    let seconds = start.elapsed().as_secs_f64();
    println!("{adapter}: {run} run, {refused} refused or not run, {over} beyond {BOUND:.1e}, {seconds:.0} s");
    for (key, largest) in &worst {
        println!("{key:<32} {largest:.1e}");
    }
    scenes::print(&on_scenes);
    if let Some(path) = record {
        let text = json(&adapter, &rows, &on_scenes);
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(over == 0 && beyond == 0)
}

/// Largest difference, and pixels that are not finite and should be.
fn row(bench: &Bench, options: &Options, stage: Stage) -> Result<(f64, usize), String> {
    let inputs = surfaces::inputs(options, uvec2(37, 29), 5);
    let compiled = compiled(options, Unroll::Full).map_err(|errors| format!("{options:?}:\n{errors}"))?;
    let result = bench.run(&compiled, stage, &inputs);
    let result = result.map_err(|error| format!("{options:?} {stage:?}: {error}"))?;
    let params = SraaParams::from_options(&compiled.options).map_err(|error| error.to_string())?;
    let expected = oracle::resolve_sraa(&inputs, &params).map_err(|error| error.to_string())?;
    let off = difference(&result, &expected);
    Ok((off.largest, off.non_finite))
}

/// The product of the columns' values.
fn all() -> Vec<Options> {
    let choices = choices();
    let mut all: Vec<Options> = vec![Options::new()];
    for name in COLUMNS {
        let values = choices.iter().find(|(known, _)| known == name);
        let values = values.map(|(_, values)| values.clone()).unwrap_or_default();
        all = all
            .iter()
            .flat_map(|set| {
                values.iter().map(move |value| {
                    let mut set = set.clone();
                    set.push((name.to_owned(), value.clone()));
                    set
                })
            })
            .collect();
    }
    all.into_iter().map(completed).collect()
}

fn device() -> Result<(Bench, String, u32), String> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
        .map_err(|e| format!("no GPU adapter; without a GPU install Debian's mesa-vulkan-drivers: {e}"))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))
        .map_err(|e| format!("the adapter gives no device: {e}"))?;
    let info = adapter.get_info();
    let name = format!("{} ({} {})", info.name, info.driver, info.driver_info);
    // Without a feature of its own, WebGPU has 4.
    Ok((Bench::new(&device, &queue, false), name, 4))
}

type Outcome = Result<(f64, usize), String>;

fn json(adapter: &str, rows: &[(Options, Stage, Outcome)], scenes: &[scenes::Row]) -> String {
    let rows: Vec<serde_json::Value> = rows
        .iter()
        .map(|(options, stage, outcome)| {
            let options: BTreeMap<&String, &String> = options.iter().map(|(name, value)| (name, value)).collect();
            match outcome {
                Ok((largest, bad)) => serde_json::json!({
                    "options": options, "stage": stage.name(), "largest_difference_to_f64": largest,
                    "non_finite_pixels": bad,
                }),
                Err(why) => serde_json::json!({ "options": options, "stage": stage.name(), "not_run": why }),
            }
        })
        .collect();
    let lines = |rows: Vec<serde_json::Value>| {
        rows.iter()
            .map(|row| format!("    {row}"))
            .collect::<Vec<_>>()
            .join(",\n")
    };
    format!(
        "{{\n  \"command\": \"cargo run --release -p straightline-tests --bin sraa-table\",\n  \"adapter\": {},\n  \"colours\": \"0 to 1, but in the scenes sparkle and emissive\",\n  \"rows\": [\n{}\n  ],\n  \"scenes\": [\n{}\n  ]\n}}\n",
        serde_json::json!(adapter),
        lines(rows),
        lines(scenes.iter().map(scenes::Row::json).collect())
    )
}
