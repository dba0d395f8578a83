//! A large procedural frame resolved in tiles, and the memory that takes.

use std::process::ExitCode;
use std::time::Instant;
use straightline_bench::execute::{Bench, ExecuteError, Inputs, Tile};
use straightline_codegen::{Stage, Unroll};
use straightline_kernels::prelude::{Frame, UVec2, Vec2, Vec4, uvec2, vec4};
use straightline_tests::sraa::compiled;
use straightline_tests::sraa::options::options;

const USAGE: &str = "usage: tiles [SIZE [TILE]]   side of the frame (8192) and of a tile (512), in pixels";

fn main() -> ExitCode {
    let numbers: Option<Vec<u32>> = std::env::args().skip(1).map(|word| word.parse().ok()).collect();
    let (size, side) = match numbers.as_deref() {
        Some([]) => (8192, 512),
        Some([size]) => (*size, 512),
        Some([size, side]) => (*size, *side),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match run(size, side) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(size: u32, side: u32) -> Result<(), Box<dyn std::error::Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;
    let bench = Bench::new(&device, &queue, false);
    let compiled = compiled(&options(&[]), Unroll::Full)?;
    let before = peak_memory();
    let start = Instant::now();
    let (mut sum, mut largest) = (0.0f64, 0u64);
    bench.in_tiles(
        (&compiled, Stage::Compute),
        uvec2(size, size),
        (side, 1),
        |tile| {
            let inputs = inputs(tile);
            largest = largest.max(bytes(&inputs));
            Ok::<_, ExecuteError>(inputs)
        },
        |_, pixels| sum += pixels.texels().iter().map(|texel| f64::from(texel.x)).sum::<f64>(),
    )?;
    let seconds = start.elapsed().as_secs_f64();
    let pixels = f64::from(size) * f64::from(size);
    println!(
        "{size}x{size} in tiles of {side}x{side} on {}: {seconds:.1} s, mean {:.4}",
        adapter.get_info().name,
        sum / pixels
    );
    println!(
        "textures of the largest tile {:.1} MB, of the whole frame {:.1} MB",
        largest as f64 / 1.0e6,
        largest as f64 / 1.0e6 * pixels / f64::from((side + 2) * (side + 2))
    );
    match (before, peak_memory()) {
        (Some(before), Some(after)) => println!("peak memory {before} MB before the first tile, {after} MB at the end"),
        _ => println!("this system does not tell its peak memory"),
    }
    Ok(())
}

/// Bytes of a tile's textures on the device, the target among them.
fn bytes(inputs: &Inputs) -> u64 {
    let images = inputs.images.iter().map(|(name, layers)| {
        let components = if name == "depth" { 1 } else { 4 };
        let texels: u64 = layers.iter().map(|l| u64::from(l.size().element_product())).sum();
        texels * 4 * components
    });
    images.sum::<u64>() + u64::from(inputs.size.element_product()) * 16
}

/// Discs on a floor, by a formula: the whole frame is never in memory.
fn inputs(tile: &Tile) -> Inputs {
    let offsets = [(-2.0, -6.0), (6.0, -2.0), (-6.0, 2.0), (2.0, 6.0), (0.0, 0.0)];
    let layer = |value: &dyn Fn(Vec2) -> Vec4, offset: Vec2| {
        let size = tile.inputs_size;
        let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| uvec2(x, y)));
        Frame::new(
            size,
            pixels
                .map(|p| value((p + tile.inputs_first).as_vec2() + 0.5 + offset))
                .collect(),
        )
    };
    let is_disc = |at: Vec2| (at.rem_euclid(Vec2::splat(64.0)) - 32.0).length() < 20.0;
    let depth = |at: Vec2| Vec4::splat(if is_disc(at) { 2.0 } else { 5.0 + at.y * 1.0e-4 });
    let normal = |at: Vec2| {
        if is_disc(at) {
            vec4(0.0, 0.0, 1.0, 0.0)
        } else {
            vec4(0.0, 1.0, 0.0, 0.0)
        }
    };
    let color = |at: Vec2| Vec4::splat(if is_disc(at) { 0.9 } else { 0.2 });
    let stack = |value: &dyn Fn(Vec2) -> Vec4| {
        let offsets = offsets.iter().map(|(x, y)| Vec2::new(*x, *y) / 16.0);
        offsets.map(|offset| layer(value, offset)).collect::<Vec<_>>()
    };
    Inputs::new(UVec2::new(tile.inputs_size.x, tile.inputs_size.y))
        .with_image("color", layer(&color, Vec2::ZERO))
        .with_layers("depth", stack(&depth))
        .with_layers("normal", stack(&normal))
}

/// Returns the peak memory of the process in MB, if the system reports it.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes / 1024)
}
