//! Time of creating the pipelines of `shaders-out/`, and of their first frames, with a pipeline cache and without:
//! `cargo run -p straightline-runtime --features manifest --example pipeline_cache`.
//!
//! Each measurement is a process of its own, because drivers also keep compiled shaders in memory.

use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use straightline_runtime::manifest::{Manifest, Stage};
use straightline_runtime::{Pass, PassOptions, PipelineCacheFile, wgpu};

/// Measurements of each kind, in turn.
const ROUNDS: usize = 11;

const SIZE: wgpu::Extent3d = wgpu::Extent3d {
    width: 64,
    height: 64,
    depth_or_array_layers: 1,
};

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => compare(),
        ["without"] => measure(None),
        ["with", folder] => measure(Some(Path::new(folder))),
        _ => Err("usage: pipeline_cache".into()),
    }
}

/// Measures in processes of their own, and prints medians.
fn compare() -> Result<(), Box<dyn Error>> {
    let folder = std::env::temp_dir().join(format!("straightline-pipelines-{}", std::process::id()));
    let text = folder.to_string_lossy().into_owned();
    let mut found: [Vec<[u64; 2]>; 3] = Default::default();
    for _ in 0..ROUNDS {
        // The second finds no file, the third that of the second.
        let kinds: [&[&str]; 3] = [&["without"], &["with", &text], &["with", &text]];
        for (times, words) in found.iter_mut().zip(kinds) {
            let output = Command::new(std::env::current_exe()?).args(words).output()?;
            let out = String::from_utf8(output.stdout)?;
            let mut numbers = out.lines().last().unwrap_or_default().split(' ').map(str::parse);
            let (Some(created), Some(first)) = (numbers.next(), numbers.next()) else {
                return Err(String::from_utf8(output.stderr)?.into());
            };
            times.push([created?, first?]);
        }
        std::fs::remove_dir_all(&folder)?;
    }
    println!("| cache | pipelines created, ms | first frames, ms |\n| --- | --: | --: |");
    for (name, mut times) in ["none", "empty", "from the file"].into_iter().zip(found) {
        let median = [0, 1].map(|which| {
            times.sort_by_key(|time| time[which]);
            times[ROUNDS / 2][which] as f64 / 1e3
        });
        println!("| {name} | {:.1} | {:.1} |", median[0], median[1]);
    }
    Ok(())
}

/// Prints the microseconds of creating all pipelines, and of the first frames.
#[allow(unsafe_code)]
fn measure(folder: Option<&Path>) -> Result<(), Box<dyn Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
        required_features: wgpu::Features::PIPELINE_CACHE,
        ..Default::default()
    }))?;
    // SAFETY: only this program writes to the folder, which has its process's number.
    let file = folder.map(|folder| unsafe { PipelineCacheFile::open(&device, folder) });
    if let Some(file) = &file {
        println!("{}", file.origin());
    }
    let options = PassOptions::default().pipeline_cache(file.as_ref().and_then(PipelineCacheFile::cache));
    let mut created = Duration::ZERO;
    let mut passes = Vec::new();
    for entry in std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders-out"))? {
        let path = entry?.path();
        if path.extension().is_none_or(|extension| extension != "json") {
            continue;
        }
        let manifest = Manifest::from_json(&std::fs::read_to_string(&path)?)?;
        if manifest.stage != Stage::Compute || !manifest.hashes.contains_key("wgsl") || !manifest.features.is_empty() {
            continue;
        }
        let wgsl = std::fs::read_to_string(path.with_extension("wgsl"))?;
        let pass = Pass::with_options(&device, &manifest, &wgsl, &options)?;
        created += pass.creation_time();
        passes.push(pass);
    }
    let texture = |layers, format, usage| {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                depth_or_array_layers: layers,
                ..SIZE
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        });
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    };
    let input = |layers| {
        let usage = wgpu::TextureUsages::TEXTURE_BINDING;
        texture(layers, wgpu::TextureFormat::Rgba16Float, usage)
    };
    // A view of several layers is an array.
    let (plain, array) = (input(1), input(17));
    let mut first = Duration::ZERO;
    for pass in &passes {
        let of = |name| {
            if matches!(name, "depth" | "normal") {
                &array
            } else {
                &plain
            }
        };
        let inputs: Vec<(&str, &wgpu::TextureView)> = pass.inputs().map(|name| (name, of(name))).collect();
        let target = texture(1, pass.target_format(), wgpu::TextureUsages::STORAGE_BINDING);
        let bound = pass.bind(&inputs, &target)?;
        let start = Instant::now();
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        bound.encode(&mut encoder);
        queue.submit([encoder.finish()]);
        device.poll(wgpu::PollType::wait_indefinitely())?;
        first += start.elapsed();
    }
    if let Some(file) = &file {
        file.save()?;
    }
    eprintln!("{} pipelines", passes.len());
    println!("{} {}", created.as_micros(), first.as_micros());
    Ok(())
}
