//! Kernels that write to buffers: as rustc compiles them, interpreted in every form, and on GPUs in every language.

use crate::common;

use common::{Texel, bench, same_texels};
use straightline_bench::execute::{Buffers, Inputs, interpret_kernel};
use straightline_codegen::emit::Target;
use straightline_codegen::{Branches, EmitOptions, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_runtime::{Region, wgpu};
use straightline_tests::texts::{compiled, texels};
use straightline_tests::{compilers, kernel, passthrough};

kernel!(HISTOGRAM, histogram, {
    pub fn histogram(color: &Frame<Vec4>, bins: &AtomicBuffer<u32>, pixel: IVec2) {
        let luma = color.load(pixel).x;
        bins.add((luma * 20.0) as usize, 1);
    }
});

// Every way to come to a write or not: sides that are selected or kept, loops that are left, functions that return, `&&`,
// guards of `match`, closures; each place counts in a bin of its own.
kernel!(PLACES, places, {
    fn noted(bins: &AtomicBuffer<u32>, at: usize, x: f32) -> f32 {
        if x > 0.75 {
            bins.add(at, 1);
            return 1.0;
        }
        bins.add(at + 1, 2);
        if x > 0.5 {
            return 0.5;
        }
        bins.add(at + 2, 1);
        x
    }
    pub fn places(color: &Frame<Vec4>, bins: &AtomicBuffer<u32>, least: &AtomicBuffer<i32>, pixel: IVec2) -> Vec4 {
        let here = color.load(pixel);
        let mut sum = noted(bins, 0, here.x) + noted(bins, 3, here.y);
        'rows: for y in 0..3 {
            for x in 0..4 {
                let tap = color.load(pixel + ivec2(x, y));
                if tap.x > 0.9 {
                    break 'rows;
                }
                if tap.y > 0.6 {
                    continue;
                }
                if tap.z > 0.4 && {
                    bins.add(6, 1);
                    tap.w > 0.3
                } {
                    bins.add(7, 1);
                } else if x == 2 {
                    bins.add(8, 1);
                }
                sum += tap.x;
            }
            bins.add(9, 1);
        }
        match (sum * 2.0) as i32 {
            0 => {
                bins.add(10, 1);
            }
            n if n > 3 && {
                bins.add(11, n as u32);
                here.z > 0.5
            } =>
            {
                bins.xor(12, 1 << (n as u32 & 7));
            }
            _ => {
                least.min(0, pixel.x - pixel.y);
            }
        }
        let mut k = 0;
        while k < 6 {
            let tap = color.load(pixel - ivec2(k, 1));
            k += 1;
            if tap.w > 0.8 {
                break;
            }
            let note = |at: usize| bins.or(at, 1 << k as u32);
            note(13);
            if tap.x > 0.5 {
                least.max(1, (tap.x * 100.0) as i32);
                if tap.y > 0.5 {
                    return Vec4::splat(tap.y);
                }
                bins.and(14, !(1 << k as u32));
            }
        }
        bins.add(15, 1);
        // Outside: nothing happens.
        bins.add(16 + (here.x * 9.0) as usize, 1);
        bins.add((here.y * 4.0e9) as usize + 20, 1);
        vec4(sum, k as f32, 0.0, 1.0)
    }
});

// Writes in the order of the pixels.
kernel!(ORDERED, ordered, {
    pub fn ordered(
        color: &Frame<Vec4>,
        bins: &AtomicBuffer<u32>,
        least: &AtomicBuffer<i32>,
        pixel: IVec2,
    ) -> (f32, u32) {
        let before = bins.add(0, 1);
        let other = bins.exchange(1 + (before % 3) as usize, before);
        let mut largest = least.max(0, (color.load(pixel).x * 1000.0) as i32);
        for k in 0..3 {
            if color.load(pixel + ivec2(k, 0)).y > 0.5 {
                largest += least.load(1);
                least.add(1, k);
            }
        }
        (largest as f32, other * 1000 + before)
    }
});

kernel!(STORED, stored, {
    pub fn stored(
        color: &Frame<Vec4>,
        resolution: UVec2,
        brightest: &StorageBuffer<Vec4>,
        columns: &StorageBuffer<i32>,
        pixel: IVec2,
    ) {
        let width = resolution.x as i32;
        let here = color.load(pixel);
        if here.x > 0.5 {
            brightest.store((pixel.y * width + pixel.x) as usize, here * 2.0);
        }
        let mut largest = -1;
        for y in 0..4 {
            if color.load(ivec2(pixel.x, y)).y > 0.5 {
                largest = y;
            }
        }
        if pixel.y == 0 {
            columns.store(pixel.x as usize, largest);
        }
        columns.store(columns.len() + pixel.x as usize, 7);
    }
});

const SIZE: UVec2 = uvec2(13, 9);

fn color() -> Frame<Vec4> {
    texels(SIZE, 5)
}

fn numbers(count: usize, first: f64) -> Vec<[f64; 4]> {
    (0..count).map(|k| [first + k as f64, 0.0, 0.0, 0.0]).collect()
}

/// Inputs of every kernel.
fn inputs() -> Inputs {
    Inputs::new(SIZE)
        .with_image("color", color())
        .with_buffer("bins", numbers(16, 3.0))
        .with_buffer("least", numbers(2, -4.0))
        .with_buffer("brightest", vec![[0.25, 0.5, 0.75, 1.0]; 117])
        .with_buffer("columns", numbers(10, -9.0))
}

/// Native resources of the same kernels.
struct World {
    color: Frame<Vec4>,
    bins: AtomicBuffer<u32>,
    least: AtomicBuffer<i32>,
    brightest: StorageBuffer<Vec4>,
    columns: StorageBuffer<i32>,
}

impl World {
    fn new() -> World {
        World {
            color: color(),
            bins: AtomicBuffer::new((3..19).collect()),
            least: AtomicBuffer::new(vec![-4, -3]),
            brightest: StorageBuffer::new(vec![vec4(0.25, 0.5, 0.75, 1.0); 117]),
            columns: StorageBuffer::new((-9..1).collect()),
        }
    }

    /// Contents of a buffer, as the interpreter and a bench return them.
    fn buffer(&self, name: &str) -> Vec<[f64; 4]> {
        let one = |x: f64| [x, 0.0, 0.0, 0.0];
        match name {
            "bins" => self.bins.elements().into_iter().map(|x| one(x.into())).collect(),
            "least" => self.least.elements().into_iter().map(|x| one(x.into())).collect(),
            "brightest" => self.brightest.elements().iter().map(Texel::texel).collect(),
            _ => self.columns.elements().into_iter().map(|x| one(x.into())).collect(),
        }
    }
}

type Native = fn(&World, IVec2) -> Vec<[f64; 4]>;

/// Name, text, what rustc makes of it, its buffers, and whether the order of pixels matters.
type Case = (&'static str, &'static str, Native, &'static [&'static str], bool);

const KERNELS: [Case; 4] = [
    (
        "histogram",
        HISTOGRAM,
        |w, at| {
            histogram::histogram(&w.color, &w.bins, at);
            Vec::new()
        },
        &["bins"],
        false,
    ),
    (
        "places",
        PLACES,
        |w, at| vec![places::places(&w.color, &w.bins, &w.least, at).texel()],
        &["bins", "least"],
        false,
    ),
    (
        "ordered",
        ORDERED,
        |w, at| {
            let (a, b) = ordered::ordered(&w.color, &w.bins, &w.least, at);
            vec![a.texel(), b.texel()]
        },
        &["bins", "least"],
        true,
    ),
    (
        "stored",
        STORED,
        |w, at| {
            stored::stored(&w.color, SIZE, &w.brightest, &w.columns, at);
            Vec::new()
        },
        &["brightest", "columns"],
        false,
    ),
];

fn native(kernel: Native) -> (World, Vec<Vec<[f64; 4]>>) {
    let world = World::new();
    let pixels = (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| ivec2(x, y)));
    let given = pixels.map(|at| kernel(&world, at)).collect();
    (world, given)
}

#[track_caller]
fn same_buffers(what: &str, world: &World, names: &[&str], found: &Buffers) {
    assert_eq!(
        found.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(),
        names,
        "{what}"
    );
    for (name, found) in found {
        same_texels(&world.buffer(name), found).unwrap_or_else(|e| panic!("{what}, {name}: {e}"));
    }
}

#[test]
fn every_form_writes_what_rustc_writes() {
    for (name, text, kernel, buffers, _) in KERNELS {
        let (world, given) = native(kernel);
        let untouched = World::new();
        for buffer in buffers {
            assert_ne!(
                world.buffer(buffer),
                untouched.buffer(buffer),
                "{name} writes nothing to {buffer}"
            );
        }
        for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(2), Unroll::Partial(3)] {
            for branches in [Branches::AsLoops, Branches::Keep, Branches::Select] {
                let what = format!("{name} {unroll} {branches}");
                let settings = Settings::new().unroll(unroll).branches(branches);
                let found = interpret_kernel::<f32>(&compiled(name, text, &settings), &inputs(), false);
                let found = found.unwrap_or_else(|e| panic!("{what}: {e}"));
                for (k, target) in found.targets.iter().enumerate() {
                    let native: Vec<[f64; 4]> = given.iter().map(|texels| texels[k]).collect();
                    same_texels(&native, &target.texels).unwrap_or_else(|e| panic!("{what}, {}: {e}", target.name));
                }
                same_buffers(&what, &world, buffers, &found.buffers);
            }
        }
    }
}

#[test]
fn graphs_with_effects_are_read_as_they_are_printed() {
    use straightline_codegen::ir::{parse, print, verify};
    for (name, text, ..) in KERNELS {
        for unroll in [Unroll::Full, Unroll::None] {
            let settings = Settings::new().unroll(unroll);
            let graph = compiled(name, text, &settings).graph;
            let printed = print(&graph);
            let read = parse(&printed).unwrap_or_else(|e| panic!("{name}: {e}\n{printed}"));
            verify::verify_graph(&read).unwrap_or_else(|e| panic!("{name}: {e}\n{printed}"));
            assert_eq!(print(&read), printed);
            assert_eq!(read.regions, graph.regions, "{name}");
        }
    }
}

#[test]
fn gpus_write_the_same() {
    let bench = bench();
    for (name, text, kernel, buffers, is_ordered) in KERNELS {
        let (world, given) = native(kernel);
        for unroll in [Unroll::Full, Unroll::None] {
            for stage in [Stage::Compute, Stage::Fragment] {
                let settings = Settings::new().unroll(unroll);
                let compiled = compiled(name, text, &settings);
                if is_ordered || (stage == Stage::Fragment && compiled.graph.targets.is_empty()) {
                    continue;
                }
                let what = format!("{name} {unroll} {stage:?}");
                let (targets, found) = bench
                    .all_written(&compiled, stage, &inputs())
                    .unwrap_or_else(|e| panic!("{what}: {e}"));
                same_buffers(&what, &world, buffers, &found);
                for (k, target) in targets.iter().enumerate() {
                    let native: Vec<[f64; 4]> = given.iter().map(|texels| texels[k]).collect();
                    same_texels(&native, &target.texels).unwrap_or_else(|e| panic!("{what}: {e}"));
                }
            }
        }
    }
    // Whatever the order of the pixels, all of them count.
    let (name, text, ..) = KERNELS[2];
    let (_, found) = bench
        .all_written(&compiled(name, text, &Settings::default()), Stage::Compute, &inputs())
        .unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(found[0].1[0][0], 3.0 + f64::from(SIZE.x * SIZE.y));
}

#[test]
fn glsl_hlsl_and_spirv_write_the_same_through_vulkan() {
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    for (name, text, kernel, buffers, is_ordered) in KERNELS {
        let (world, _) = native(kernel);
        for unroll in [Unroll::Full, Unroll::None] {
            let settings = Settings::new().unroll(unroll);
            let compiled = compiled(name, text, &settings);
            for language in [Target::Glsl450, Target::Hlsl, Target::Spirv] {
                let what = format!("{name} {unroll} {language}");
                let options = bench.emit_options(Stage::Compute).targets([Target::Wgsl, language]);
                let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{what}: {e}"));
                let found = passthrough::run_buffers(&bench, &emitted, language, &inputs());
                let found = found.unwrap_or_else(|e| panic!("{what}: {e}"));
                if !is_ordered {
                    same_buffers(&what, &world, buffers, &found);
                }
            }
        }
    }
}

#[test]
fn compilers_read_every_language() {
    for (name, text, ..) in KERNELS {
        for unroll in [Unroll::Full, Unroll::None] {
            let settings = Settings::new().unroll(unroll);
            let compiled = compiled(name, text, &settings);
            let targets = Target::MODERN.into_iter().chain([Target::Glsl430, Target::Essl310]);
            let emitted = compiled.emit(&EmitOptions::new().targets(targets));
            let emitted = emitted.unwrap_or_else(|e| panic!("{name}: {e}"));
            compilers::read(&emitted).unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
}

/// A kernel that gives nothing runs over its inputs; a region of them counts its pixels alone.
#[test]
fn regions_count_their_own_pixels() {
    let bench = bench();
    let (name, text, ..) = KERNELS[0];
    let compiled = compiled(name, text, &Settings::default());
    let options = bench.emit_options(Stage::Compute).region(true);
    let (pass, manifest) = bench.emit_pass(&compiled, &options).unwrap_or_else(|e| panic!("{e}"));
    assert!(manifest.outputs.is_empty());
    let uploaded = bench.upload(&manifest, &inputs()).unwrap_or_else(|e| panic!("{e}"));
    let region = Region::at([2, 1], [5, 4]);
    let none: &[(&str, &wgpu::TextureView)] = &[];
    let mut encoder = bench
        .device()
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let bound = uploaded.bind_region(&pass, none, region);
    bound.unwrap_or_else(|e| panic!("{e}")).encode(&mut encoder);
    bench.queue().submit([encoder.finish()]);
    let found = bench
        .read_buffers(&manifest, &uploaded)
        .unwrap_or_else(|e| panic!("{e}"));
    let world = World::new();
    for at in (1..5).flat_map(|y| (2..7).map(move |x| ivec2(x, y))) {
        histogram::histogram(&world.color, &world.bins, at);
    }
    same_buffers("region", &world, &["bins"], &found);
}

/// Pixels that lie outside of the frame would write too.
#[test]
fn blocks_of_pixels_write_nothing() {
    let (name, text, ..) = KERNELS[0];
    let settings = Settings::new().block(2, 2);
    let refused = Kernel::from_text("kernel.rs", text, name)
        .compile(&settings)
        .expect_err("a block");
    let said = refused.to_string();
    assert!(
        said.contains("an invocation of several pixels writes to `bins`") && said.contains("leave the block out"),
        "{said}"
    );
}
