//! Errors that the filter's additions beyond the paper fix, each at one place, and the worst remaining error: the pictures of
//! `docs/beyond-the-paper.md`, one of a guide and one of all else.

use std::path::PathBuf;
use std::process::ExitCode;
use straightline_bench::execute::Bench;
use straightline_codegen::{Stage, Unroll};
use straightline_kernels::prelude::{Frame, UVec2, Vec4, uvec2};
use straightline_scene::capture::ShadingSample;
use straightline_scene::render::{self, CpuRenderer, GuideLight, PlacedBy};
use straightline_scene::scene::Scene;
use straightline_scene::{gbuffer, picture};
use straightline_tests::sraa::compiled;
use straightline_tests::sraa::options::{Options, options};

const USAGE: &str = "usage: beyond guide|geometry FILE.png";

type Failure = Box<dyn std::error::Error>;

/// Size of the scenes' pictures, and of a square detail of them.
const SIZE: UVec2 = uvec2(640, 360);
const SIDE: u32 = 28;
const ZOOM: u32 = 6;

const PLACED: (&str, &str) = ("shading", "placed");
const SEARCHED: (&str, &str) = ("search", "five");
const EXTRA: (&str, &str) = ("extra", "true");
const KEPT_EVEN: [(&str, &str); 2] = [("mask", "branch"), ("variation", "within")];
const FULL: (&str, &[(&str, &str)]) = ("full", &[("preset", "full")]);
const GUIDED: (&str, &[(&str, &str)]) = ("guided", &[("preset", "guided")]);

/// A scene with two variants: title and options of each.
#[derive(Clone, Copy)]
struct Row {
    scene: &'static str,
    without: (&'static str, &'static [(&'static str, &'static str)]),
    with: (&'static str, &'static [(&'static str, &'static str)]),
}

/// Paint, a shadow, highlights, a normal map, a horizon, and several lights of which the guide knows one.
const OF_A_GUIDE: [Row; 6] = {
    const fn row(scene: &'static str) -> Row {
        Row {
            scene,
            without: FULL,
            with: GUIDED,
        }
    }
    [
        row("posters"),
        row("awning"),
        row("sparkle"),
        row("relief"),
        row("floor"),
        row("studio"),
    ]
};

/// Options are in addition to those of [`PlacedBy::Planes`].
const OF_GEOMETRY: [Row; 5] = [
    Row {
        scene: "railings",
        without: ("SRAA 4", &[]),
        with: ("placed", &[PLACED]),
    },
    Row {
        scene: "railings",
        without: ("SRAA 4", &[]),
        with: ("searched", &[SEARCHED]),
    },
    Row {
        scene: "tubes",
        without: ("placed, searched", &[PLACED, SEARCHED]),
        with: ("once more", &[PLACED, SEARCHED, EXTRA]),
    },
    Row {
        scene: "sparkle",
        without: ("SRAA 4", &[]),
        with: ("kept even", &KEPT_EVEN),
    },
    Row {
        scene: "roof",
        without: ("SRAA 4", &[]),
        with: ("with all", &[PLACED, SEARCHED, EXTRA, KEPT_EVEN[0], KEPT_EVEN[1]]),
    },
];

fn main() -> ExitCode {
    let words: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let (rows, basis, path) = match &words[..] {
        [what, path] if what.as_os_str() == "guide" => (&OF_A_GUIDE[..], &[][..], path),
        [what, path] if what.as_os_str() == "geometry" => (&OF_GEOMETRY[..], PlacedBy::Planes.options(), path),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    let written = pictures(rows, basis).and_then(|rows| Ok(picture::write_png(path, &below(&rows))?));
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Shows all rows, with the options of `basis`; the last where the remaining error is largest.
fn pictures(rows: &[Row], basis: &[(&str, &str)]) -> Result<Vec<Frame<Vec4>>, Failure> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;
    let bench = Bench::new(&device, &queue, false);
    let each = rows.iter().enumerate();
    each.map(|(k, row)| shown(&bench, row, basis, k + 1 == rows.len()))
        .collect()
}

/// Shows the detail where `with` improves most on `without`, or with `worst` the detail where its error is largest.
fn shown(bench: &Bench, row: &Row, basis: &[(&str, &str)], worst: bool) -> Result<Frame<Vec4>, Failure> {
    let scene = Scene::from_name(row.scene)?;
    let renderer = CpuRenderer::new(&scene, SIZE)?;
    let reference = render::render_reference(&renderer, 16, &mut |_, _| {})?;
    let drawn = |own: &[(&str, &str)]| filtered(bench, &renderer, &options(&[basis, own].concat()));
    let (without, with) = (drawn(row.without.1)?, drawn(row.with.1)?);
    // As displayed.
    let shown = |frame: &Frame<Vec4>, k: usize| frame.texels()[k].clamp(Vec4::ZERO, Vec4::ONE);
    let off = |frame: &Frame<Vec4>, k: usize| (shown(frame, k) - shown(&reference, k)).length_squared();
    let score = |k: usize| {
        if worst {
            off(&with, k)
        } else {
            off(&without, k) - off(&with, k)
        }
    };
    let sums = (0..SIZE.y - SIDE)
        .step_by(4)
        .flat_map(|y| (0..SIZE.x - SIDE).step_by(4).map(move |x| uvec2(x, y)));
    let of_square = |corner: &UVec2| -> f32 {
        let pixels = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| uvec2(x, y)));
        pixels
            .map(|at| score(((corner.y + at.y) * SIZE.x + corner.x + at.x) as usize))
            .sum()
    };
    let corner = sums
        .max_by(|a, b| of_square(a).total_cmp(&of_square(b)))
        .ok_or("no square")?;
    let pictures = [
        (row.without.0, &without),
        (row.with.0, &with),
        ("256 samples", &reference),
    ];
    Ok(picture::compare_details(&pictures, corner, SIDE, ZOOM))
}

fn filtered(bench: &Bench, renderer: &CpuRenderer, set: &Options) -> Result<Frame<Vec4>, Failure> {
    let samples = gbuffer::pattern_offsets("latin4").ok_or("no such pattern")?;
    let compiled = compiled(set, Unroll::Full)?;
    let set = &compiled.options;
    let mut capture = match set.choice("shading") {
        Some("placed") => render::capture_placed(renderer, &samples, PlacedBy::Planes)?,
        _ => render::capture_scene(renderer, &samples, ShadingSample::Centre)?,
    };
    if set.choice("guide") == Some("add") {
        render::add_guide(&mut capture, renderer, GuideLight::default())?;
    }
    let inputs = match set.flag("extra") {
        Some(true) => {
            let budget = (SIZE.x * SIZE.y / 50) as usize;
            render::shade_extra(renderer, &capture, budget)?.sraa_inputs(&capture, &compiled.options)?
        }
        _ => gbuffer::sraa_inputs(&capture, &compiled.options)?,
    };
    Ok(bench.run(&compiled, Stage::Compute, &inputs)?)
}

/// Stacks pictures of one width.
fn below(rows: &[Frame<Vec4>]) -> Frame<Vec4> {
    let width = rows.iter().map(|row| row.size().x).max().unwrap_or(1);
    let mut texels = Vec::new();
    for row in rows {
        for line in row.texels().chunks(row.size().x as usize) {
            texels.extend_from_slice(line);
            texels.resize(texels.len() + width as usize - line.len(), Vec4::ONE);
        }
    }
    Frame::new(uvec2(width, (texels.len() / width as usize) as u32), texels)
}
