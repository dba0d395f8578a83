//! `demo`: a tour of Straightline in one run.

mod steps;
mod table;
mod timing;

use crate::args::DemoArgs;
use crate::failure::Failure;
use crate::gpu::{self, Gpu};
use crate::scene;
use glam::{UVec2, Vec4};
use std::time::Duration;
use steps::Steps;
use straightline_bench::execute::Inputs;
use straightline_codegen::{Compiled, Kernel, Settings, Unroll, default_set};
use straightline_kernels::prelude::Frame;
use straightline_scene::capture::{Capture, ShadingSample};
use straightline_scene::gbuffer;
use straightline_scene::picture;
use straightline_scene::render::{self, Renderer, Samples};
use table::{Record, Row};

/// A filter with its inputs.
struct Method {
    name: &'static str,
    /// Geometry samples beside the shaded one.
    samples: Samples,
    unrolled: Compiled,
    looped: Compiled,
    capture: Capture,
    inputs: Inputs,
}

/// A filter's picture, and the time that it took by whatever drew it.
struct Filtered {
    method: Method,
    picture: Frame<Vec4>,
    took: Duration,
}

/// Side of the detail in pixels, and its magnification.
const SIDE: u32 = 80;
const ZOOM: u32 = 5;

/// Emits shaders, renders a scene, antialiases it, compares, writes and prints. Each picture is written when it is there.
pub fn run_demo(args: &DemoArgs) -> Result<(), Failure> {
    let mut steps = Steps::begin(args)?;
    let shaders = default_set::emit_files().map_err(Failure::from_error)?;
    let shaders = shaders
        .into_iter()
        .map(|(name, bytes)| (format!("shaders/{name}"), bytes));
    steps.write(shaders.collect(), "shaders")?;

    let gpu = Gpu::open(&args.adapter)?;
    let executor = gpu.as_ref().map_or("CPU interpreter".to_owned(), Gpu::describe);
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
    let world = scene::load_scene(args.mesh.as_deref(), &args.scene)?;
    let renderer = scene::create_renderer(gpu.as_ref(), &world, size)?;
    steps.done(&format!("{}x{} on {executor}", size.x, size.y));

    let mut filtered: Vec<Filtered> = Vec::new();
    for (name, pattern, samples) in [
        ("SRAA 4", "latin4", Samples::Four),
        ("SRAA 16", "latin16", Samples::Sixteen),
    ] {
        let method = prepare_method(name, pattern, samples, renderer.as_ref())?;
        if filtered.is_empty() {
            steps.write_picture("1x", &method.capture.color)?;
        }
        let (picture, took) = timing::run(gpu.as_ref(), &method)?;
        steps.write_picture(name, &picture)?;
        filtered.push(Filtered { method, picture, took });
    }
    let x16 = render_supersampled(renderer.as_ref(), 4, "16x supersampling")?;
    steps.write_picture("16x supersampled", &x16)?;
    let x256 = render_supersampled(renderer.as_ref(), 16, "256x reference")?;
    steps.write_picture("256x reference", &x256)?;
    let plain = &filtered[0].method.capture.color;
    let mut all = vec![("1x", plain)];
    all.extend(filtered.iter().map(|of| (of.method.name, &of.picture)));
    all.push(("16x supersampled", &x16));
    let corner = picture::find_busiest_square(plain, &x256, SIDE);
    steps.write_picture("detail", &picture::compare_details(&all, corner, SIDE, ZOOM))?;

    let measured = match &gpu {
        Some(gpu) => timing::time_frames(gpu, &world, size, &filtered, args.rounds)?,
        None => timing::time_interpreter(&filtered)?,
    };
    steps.done("timing");
    let mut rows = vec![Row::plain("1x, no antialiasing", plain, &x256).with_frame(measured.plain_ms)];
    for (of, times) in filtered.iter().zip(&measured.methods) {
        rows.push(Row::measured(&of.method, &of.picture, times, &x256)?);
    }
    rows.push(Row::plain("16x supersampling", &x16, &x256).with_frame(measured.supersampled_ms));
    Record::new(args, size, executor, measured.clock, rows).print(args)
}

fn prepare_method(
    name: &'static str,
    pattern: &'static str,
    samples: Samples,
    renderer: &dyn Renderer,
) -> Result<Method, Failure> {
    let compile = |unroll| {
        let options = vec![("pattern".to_owned(), pattern.to_owned())];
        let settings = Settings::new().set_all(options).unroll(unroll);
        Kernel::builtin("sraa").and_then(|kernel| kernel.compile(&settings))
    };
    let offsets = scene::sample_offsets(pattern)?;
    let capture = render::capture_scene(renderer, &offsets, ShadingSample::Centre).map_err(Failure::from_error)?;
    let unrolled = compile(Unroll::Full)?;
    Ok(Method {
        name,
        samples,
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
