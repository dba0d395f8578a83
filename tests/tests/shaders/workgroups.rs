//! Kernels of workgroups: as rustc compiles them, interpreted in every form, and on GPUs in every language.

use crate::common;

use common::{Texel, bench, same_texels};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::diagnostic::Code;
use straightline_codegen::emit::Target;
use straightline_codegen::{Branches, EmitOptions, Form, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_runtime::{Region, wgpu};
use straightline_tests::texts::{compiled, texels};
use straightline_tests::{compilers, kernel, passthrough};

// Counts in memory of the workgroup first, and adds up what it has counted.
kernel!(HISTOGRAM, histogram, {
    pub fn histogram(
        color: &Frame<Vec4>,
        counts: &AtomicShared<[u32; 40]>,
        bins: &AtomicBuffer<u32>,
        group: &Workgroup<4, 4>,
    ) {
        group.each(|thread| {
            if thread.inside {
                counts.add((color.load(thread.pixel).x * 40.0) as usize, 1);
            }
        });
        group.each(|thread| {
            for k in 0..3 {
                let bin = thread.index + 16 * k;
                let count = counts.load(bin);
                if count > 0 {
                    bins.add(bin, count);
                }
            }
        });
    }
});

// A window of texels that every thread reads many of; more texels than threads.
kernel!(BLUR, blur, {
    const SIDE: i32 = 8;
    const REACH: i32 = 2;
    const TILE: i32 = SIDE + 2 * REACH;
    pub fn blur(color: &Frame<Vec4>, tile: &Shared<[Vec4; 144]>, group: &Workgroup<8, 8>) -> PerThread<Vec4> {
        let corner = group.origin() - IVec2::splat(REACH);
        group.each(|thread| {
            let mut at = thread.index;
            while at < tile.len() {
                let place = at as i32;
                tile.store(at, color.load(corner + ivec2(place % TILE, place / TILE)));
                at += 64;
            }
        });
        group.each(|thread| {
            let mut sum = Vec4::ZERO;
            for y in 0..=2 * REACH {
                for x in 0..=2 * REACH {
                    let place = thread.local + ivec2(x, y);
                    sum += tile.load((place.y * TILE + place.x) as usize);
                }
            }
            sum / 25.0
        })
    }
});

// A sum by halves, whose phases lie in a loop; each thread goes on with what it has kept.
kernel!(REDUCTION, reduction, {
    pub fn reduction(
        color: &Frame<Vec4>,
        sums: &Shared<[f32; 64]>,
        totals: &StorageBuffer<f32>,
        resolution: UVec2,
        group: &Workgroup<8, 8>,
    ) -> PerThread<Vec2> {
        let own = group.each(|thread| {
            let value = if thread.inside { color.load(thread.pixel).y } else { 0.0 };
            sums.store(thread.index, value);
            value
        });
        let mut half = 32;
        while half > 0 {
            group.each(|thread| {
                if thread.index < half {
                    sums.store(thread.index, sums.load(thread.index) + sums.load(thread.index + half));
                }
            });
            half /= 2;
        }
        let place = group.origin() / 8;
        let across = (resolution.x as i32 + 7) / 8;
        group.each(|thread| {
            if thread.index == 0 {
                totals.store((place.y * across + place.x) as usize, sums.load(0));
            }
            vec2(own.of(thread), sums.load(0) / 64.0)
        })
    }
});

// A prefix sum over 32 threads in a loop that is left in the shader where loops are, with two memories in turn; a number of
// phases that a uniform says; what a thread reads before a barrier is not what it reads behind it.
kernel!(SCAN, scan, {
    fn summed(values: &Shared<[i32; 64]>, group: &Workgroup<32, 1>, steps: i32) -> PerThread<IVec2> {
        let mut from = 0;
        let mut first = 0;
        for step in 0..steps {
            group.each(|thread| {
                let reach = 1 << (step & 31);
                let here = values.load(from + thread.index);
                let other = if thread.index >= reach {
                    values.load(from + thread.index - reach)
                } else {
                    0
                };
                values.store(32 - from + thread.index, here + other);
            });
            from = 32 - from;
            first += step;
        }
        group.each(|thread| ivec2(values.load(from + thread.index), first))
    }
    pub fn scan(
        color: &Frame<Vec4>,
        values: &Shared<[i32; 64]>,
        steps: i32,
        group: &Workgroup<32, 1>,
    ) -> PerThread<(i32, i32, Vec4)> {
        let texels = group.each(|thread| {
            let texel = color.load(thread.pixel);
            values.store(thread.index, (texel.z * 64.0) as i32);
            texel
        });
        let sums = summed(values, group, steps);
        group.each(|thread| {
            let sum = sums.of(thread);
            (sum.x, sum.y, texels.of(thread))
        })
    }
});

const SIZE: UVec2 = uvec2(37, 19);
const STEPS: i32 = 5;

fn color() -> Frame<Vec4> {
    texels(SIZE, 5)
}

/// Inputs of every kernel.
fn inputs() -> Inputs {
    Inputs::new(SIZE)
        .with_image("color", color())
        .with_buffer("bins", vec![[2.0, 0.0, 0.0, 0.0]; 40])
        .with_buffer("totals", vec![[-1.0, 0.0, 0.0, 0.0]; 15])
        .with_uniform("steps", &[f64::from(STEPS)])
}

/// Values of each target, and contents of each buffer that a kernel writes.
#[derive(PartialEq)]
struct Given {
    targets: Vec<Vec<[f64; 4]>>,
    buffers: Vec<(&'static str, Vec<[f64; 4]>)>,
}

/// Combines the results of each workgroup's threads into those of all pixels of the frame.
fn whole<T: Texel, const W: usize, const H: usize>(given: &[PerThread<T>]) -> Vec<[f64; 4]> {
    let across = (SIZE.x as usize).div_ceil(W);
    let pixels = (0..SIZE.y as usize).flat_map(|y| (0..SIZE.x as usize).map(move |x| (x, y)));
    let of = |(x, y): (usize, usize)| given[y / H * across + x / W].values()[y % H * W + x % W].texel();
    pixels.map(of).collect()
}

fn one(x: f64) -> [f64; 4] {
    [x, 0.0, 0.0, 0.0]
}

fn native_histogram() -> Given {
    let bins = AtomicBuffer::new(vec![2; 40]);
    for group in Workgroup::all(SIZE) {
        histogram::histogram(&color(), &AtomicShared::new(), &bins, &group);
    }
    let bins = bins.elements().into_iter().map(|n| one(n.into())).collect();
    Given {
        targets: Vec::new(),
        buffers: vec![("bins", bins)],
    }
}

fn native_blur() -> Given {
    let color = color();
    let groups = Workgroup::all(SIZE).map(|group| blur::blur(&color, &Shared::new(), &group));
    Given {
        targets: vec![whole::<_, 8, 8>(&groups.collect::<Vec<_>>())],
        buffers: Vec::new(),
    }
}

fn native_reduction() -> Given {
    let (color, totals) = (color(), StorageBuffer::new(vec![-1.0; 15]));
    let groups = Workgroup::all(SIZE);
    let given = groups.map(|group| reduction::reduction(&color, &Shared::new(), &totals, SIZE, &group));
    Given {
        targets: vec![whole::<_, 8, 8>(&given.collect::<Vec<_>>())],
        buffers: vec![(
            "totals",
            totals.elements().into_iter().map(|x| one(f64::from(x))).collect(),
        )],
    }
}

fn native_scan() -> Given {
    let color = color();
    let groups = Workgroup::all(SIZE).map(|group| (scan::scan(&color, &Shared::new(), STEPS, &group), group));
    let groups: Vec<_> = groups.collect();
    let part = |of: fn((i32, i32, Vec4)) -> [f64; 4]| {
        let texels = |(given, group): &(PerThread<(i32, i32, Vec4)>, Workgroup<32, 1>)| {
            let values = given.values().to_vec();
            group
                .each(|thread| values[thread.index])
                .values()
                .iter()
                .map(|v| of(*v))
                .collect::<Vec<_>>()
        };
        let all: Vec<Vec<[f64; 4]>> = groups.iter().map(texels).collect();
        let pixels = (0..SIZE.y as usize).flat_map(|y| (0..SIZE.x as usize).map(move |x| (x, y)));
        pixels.map(|(x, y)| all[y * 2 + x / 32][x % 32]).collect()
    };
    Given {
        targets: vec![part(|v| v.0.texel()), part(|v| v.1.texel()), part(|v| v.2.texel())],
        buffers: Vec::new(),
    }
}

/// Name, text, what rustc makes of it.
type Case = (&'static str, &'static str, fn() -> Given);

const KERNELS: [Case; 4] = [
    ("histogram", HISTOGRAM, native_histogram),
    ("blur", BLUR, native_blur),
    ("reduction", REDUCTION, native_reduction),
    ("scan", SCAN, native_scan),
];

fn forms() -> Vec<Settings> {
    let mut forms = Vec::new();
    for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(2)] {
        for branches in [Branches::AsLoops, Branches::Keep, Branches::Select] {
            forms.push(Settings::new().unroll(unroll).branches(branches));
        }
    }
    forms
}

#[track_caller]
fn same(what: &str, native: &Given, targets: &[Vec<[f64; 4]>], buffers: &[(String, Vec<[f64; 4]>)]) {
    assert_eq!(targets.len(), native.targets.len(), "{what}");
    for (native, found) in native.targets.iter().zip(targets) {
        same_texels(native, found).unwrap_or_else(|e| panic!("{what}: {e}"));
    }
    assert_eq!(buffers.len(), native.buffers.len(), "{what}");
    for ((name, native), (found_name, found)) in native.buffers.iter().zip(buffers) {
        assert_eq!(name, found_name, "{what}");
        same_texels(native, found).unwrap_or_else(|e| panic!("{what}, {name}: {e}"));
    }
}

#[test]
fn every_form_does_what_rustc_does() {
    for (name, text, native) in KERNELS {
        let native = native();
        for settings in forms() {
            let what = format!("{name} {} {}", settings.unroll, settings.branches);
            let found = interpret_kernel::<f32>(&compiled(name, text, &settings), &inputs(), false);
            let found = found.unwrap_or_else(|e| panic!("{what}: {e}"));
            let targets: Vec<_> = found.targets.into_iter().map(|t| t.texels).collect();
            same(&what, &native, &targets, &found.buffers);
        }
    }
}

#[test]
fn gpus_do_the_same() {
    let bench = bench();
    for (name, text, native) in KERNELS {
        let native = native();
        for settings in forms() {
            let what = format!("{name} {} {}", settings.unroll, settings.branches);
            let compiled = compiled(name, text, &settings);
            let (targets, found) = bench
                .all_written(&compiled, Stage::Compute, &inputs())
                .unwrap_or_else(|e| panic!("{what}: {e}"));
            let targets: Vec<_> = targets.into_iter().map(|t| t.texels).collect();
            same(&what, &native, &targets, &found);
        }
    }
}

#[test]
fn glsl_hlsl_and_spirv_do_the_same_through_vulkan() {
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    let (name, text, native) = KERNELS[0];
    let native = native();
    for settings in forms() {
        let compiled = compiled(name, text, &settings);
        for language in [Target::Glsl450, Target::Hlsl, Target::Spirv] {
            let what = format!("{name} {} {language}", settings.unroll);
            let options = bench.emit_options(Stage::Compute).targets([Target::Wgsl, language]);
            let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{what}: {e}"));
            let found = passthrough::run_buffers(&bench, &emitted, language, &inputs());
            let found = found.unwrap_or_else(|e| panic!("{what}: {e}"));
            same(&what, &native, &[], &found);
        }
    }
}

#[test]
fn compilers_read_every_language() {
    for (name, text, _) in KERNELS {
        for settings in forms() {
            let compiled = compiled(name, text, &settings);
            let targets = Target::MODERN.into_iter().chain([Target::Glsl430]);
            let emitted = compiled.emit(&EmitOptions::new().targets(targets));
            let emitted = emitted.unwrap_or_else(|e| panic!("{name}: {e}"));
            compilers::read(&emitted).unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
}

#[test]
fn graphs_are_read_as_they_are_printed() {
    use straightline_codegen::ir::{parse, print, verify};
    for (name, text, _) in KERNELS {
        for settings in forms() {
            let printed = print(&compiled(name, text, &settings).graph);
            let read = parse(&printed).unwrap_or_else(|e| panic!("{name}: {e}\n{printed}"));
            verify::verify_graph(&read).unwrap_or_else(|e| panic!("{name}: {e}\n{printed}"));
            assert_eq!(print(&read), printed);
        }
    }
}

/// A phase ends before the next one begins, and no barrier stands where nothing was written before.
#[test]
fn barriers_stand_between_phases() {
    for (name, text, wanted) in [
        ("histogram", HISTOGRAM, 1),
        ("blur", BLUR, 1),
        ("reduction", REDUCTION, 7),
    ] {
        let emitted = compiled(name, text, &Settings::default()).emit(&EmitOptions::new().targets([Target::Wgsl]));
        let emitted = emitted.unwrap_or_else(|e| panic!("{name}: {e}"));
        let text = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
        assert_eq!(text.matches("workgroupBarrier();").count(), wanted, "{text}");
        assert!(!text.contains("storageBarrier"), "{text}");
    }
}

#[test]
fn races_are_found_where_they_happen() {
    let race = "pub fn race(color: &Frame<Vec4>, a: &Shared<[f32; 16]>, group: &Workgroup<4, 4>) -> PerThread<f32> {
        group.each(|t| a.store(t.index, color.load(t.pixel).x));
        group.each(|t| {
            if t.index < 15 {
                a.store(t.index, a.load(t.index + 1));
            }
        });
        group.each(|t| a.load(t.index))
    }";
    let found = interpret_kernel::<f32>(&compiled("race", race, &Settings::default()), &inputs(), false);
    let Err(error) = found else { panic!("a race") };
    assert_eq!(
        error.to_string(),
        "`race`: threads [0, 1] of the workgroup at [0, 0] both use `a[1]` in one phase, and one of them writes it"
    );
    let same = "pub fn same(color: &Frame<Vec4>, any: &Shared<[u32; 1]>, group: &Workgroup<4, 4>) -> PerThread<u32> {
        group.each(|t| if color.load(t.pixel).x > 0.9 { any.store(0, 1) });
        group.each(|t| any.load(0))
    }";
    interpret_kernel::<f32>(&compiled("same", same, &Settings::default()), &inputs(), false)
        .expect("all write the same");
}

#[test]
fn what_has_no_workgroups_is_refused() {
    let (name, text, _) = KERNELS[1];
    let blur = compiled(name, text, &Settings::default());
    let fragment = EmitOptions::new().stage(Stage::Fragment);
    let code = |options: &EmitOptions| blur.emit(options).err().and_then(|errors| errors.first_code());
    assert_eq!(code(&fragment), Some(Code::StageUnfit));
    let function = EmitOptions::new().form(Form::Function);
    assert_eq!(code(&function), Some(Code::StageUnfit));
    let other = EmitOptions::new().workgroup(16, 16);
    assert_eq!(code(&other), Some(Code::WorkgroupSize));
    let block = Settings::new().block(2, 2);
    let error = Kernel::from_text("kernel.rs", text, name)
        .compile(&block)
        .expect_err("a block");
    assert!(error.to_string().contains("is a workgroup"), "{error}");
}

/// Threads outside of a region are outside, though their pixels are inside of the frame.
#[test]
fn regions_are_computed_by_themselves() {
    let bench = bench();
    let (name, text, _) = KERNELS[0];
    let compiled = compiled(name, text, &Settings::default());
    let options = bench.emit_options(Stage::Compute).region(true);
    let (pass, manifest) = bench.emit_pass(&compiled, &options).unwrap_or_else(|e| panic!("{e}"));
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
    let bins = AtomicBuffer::new(vec![2; 40]);
    for x in [2, 6] {
        let group = Workgroup::new(ivec2(x, 1), uvec2(7, 5));
        histogram::histogram(&color(), &AtomicShared::new(), &bins, &group);
    }
    let bins = bins.elements().into_iter().map(|n| one(n.into())).collect();
    let native = Given {
        targets: Vec::new(),
        buffers: vec![("bins", bins)],
    };
    same("region", &native, &[], &found);
}
