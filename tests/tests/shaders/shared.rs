//! Texels shared by workgroups: the same bits as where each pixel reads for itself, by the interpreter and on a GPU, in
//! every language.

use crate::common;

use common::{bench, same_bits, same_texels};
use straightline_bench::execute::{Inputs, interpret_kernel, test_inputs};
use straightline_codegen::diagnostic::Code;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Form, Kernel, Origin, Precision, Settings, Share, Stage, Unroll};
use straightline_kernels::filters::FILTERS;
use straightline_kernels::prelude::*;
use straightline_runtime::{Region, wgpu};
use straightline_tests::random::forms::same as same_texel;
use straightline_tests::random::make::{Features, make};
use straightline_tests::random::oracle::{World, computed};
use straightline_tests::sraa::surfaces;
use straightline_tests::{compilers, passthrough};

/// Layers and integers, components of which not all are used, places that are taken to a border twice, a read at a runtime
/// offset, one whose value a branch alone needs, one that a loop does not change, a texture of another size; two values for
/// each pixel.
const MIXED: &str = "
    pub struct Given { pub edge: Vec2, pub found: IVec3 }
    pub fn mixed(
        color: &Frame<Vec4>,
        normals: &FrameLayers<Vec4>,
        ids: &Frame<UVec4>,
        noise: &Texture<f32>,
        rounds: i32,
        pixel: IVec2,
    ) -> Given {
        let mut sum = Vec2::ZERO;
        for y in -2..=1 {
            for x in -1..=3 {
                let texel = color.load(pixel + ivec2(x, y));
                sum += vec2(texel.x, texel.w);
                let normal = normals.load(pixel - ivec2(x, y), 1);
                sum.y += normal.y * normal.z;
            }
        }
        let size = ids.size().as_ivec2();
        let mut found = IVec3::ZERO;
        for k in 0..5 {
            let at = (pixel + ivec2(2 - k, 0)).clamp(IVec2::ZERO, size - 1);
            let id = ids.load(at);
            found += ivec3(id.x as i32, id.z as i32, k);
        }
        let far = color.load(pixel + ivec2(found.x % 3, 1)).y;
        for k in 0..rounds {
            sum.x += color.load(pixel + ivec2(1, 1)).x * k as f32;
            sum.y += color.load(pixel + ivec2(k, 0)).x;
        }
        sum += noise.load(pixel / 2) * far;
        Given { edge: sum, found }
    }
";

/// A kernel, what it reads, and how it is named.
struct Case {
    name: String,
    kernel: Kernel,
    options: Vec<(String, String)>,
    inputs: Inputs,
}

const SIZE: UVec2 = uvec2(41, 23);

/// First seed of random kernels.
const SEED: u64 = 77_000;

fn owned(options: &[(&str, &str)]) -> Vec<(String, String)> {
    let owned = |(name, value): &(&str, &str)| ((*name).to_owned(), (*value).to_owned());
    options.iter().map(owned).collect()
}

fn filter(name: &str, options: &[(&str, &str)]) -> Case {
    let filter = FILTERS.iter().find(|filter| filter.name == name).expect("a filter");
    let kernel = Kernel::from_text(filter.path, filter.text, name);
    of_card(format!("{name} {options:?}"), kernel, owned(options))
}

fn of_card(name: String, kernel: Kernel, options: Vec<(String, String)>) -> Case {
    let settings = Settings::new().set_all(options.clone());
    let compiled = kernel.compile(&settings).unwrap_or_else(|e| panic!("{name}:\n{e}"));
    let inputs = test_inputs(&compiled.graph, SIZE).with_uniform("rounds", &[3.0]);
    Case {
        name,
        kernel,
        options,
        inputs,
    }
}

fn sraa(options: &[(&str, &str)]) -> Case {
    let options = owned(options);
    Case {
        name: format!("sraa {options:?}"),
        kernel: Kernel::builtin("sraa").unwrap_or_else(|e| panic!("{e}")),
        inputs: surfaces::inputs(&options, SIZE, 7),
        options,
    }
}

fn cases() -> Vec<Case> {
    vec![
        filter("bilateral", &[("radius", "2")]),
        filter("bilateral", &[("radius", "3")]),
        filter("median", &[]),
        sraa(&[]),
        sraa(&[("pattern", "latin16")]),
        sraa(&[("layout", "multisampled"), ("metric", "planes-normals")]),
        of_card(
            "mixed".to_owned(),
            Kernel::from_text("mixed.rs", MIXED, "mixed"),
            Vec::new(),
        ),
    ]
}

/// Kernels whose form without sharing has loops and branches in it.
fn looped() -> Vec<Case> {
    vec![
        sraa(&[("guards", "fallback")]),
        of_card(
            "mixed".to_owned(),
            Kernel::from_text("mixed.rs", MIXED, "mixed"),
            Vec::new(),
        ),
    ]
}

impl Case {
    fn compile(&self, share: Share, unroll: Unroll) -> Compiled {
        let settings = Settings::new()
            .set_all(self.options.clone())
            .share(share)
            .unroll(unroll);
        let compiled = self.kernel.compile(&settings);
        compiled.unwrap_or_else(|e| panic!("{}, {share}:\n{e}", self.name))
    }

    fn interpreted(&self, compiled: &Compiled) -> Vec<Vec<[f64; 4]>> {
        let found = interpret_kernel::<f32>(compiled, &self.inputs, false);
        let found = found.unwrap_or_else(|e| panic!("{}: {e}", self.name));
        found.targets.into_iter().map(|target| target.texels).collect()
    }
}

#[track_caller]
fn same(what: &str, expected: &[Vec<[f64; 4]>], found: &[Vec<[f64; 4]>]) {
    assert_eq!(expected.len(), found.len(), "{what}");
    for (expected, found) in expected.iter().zip(found) {
        same_texels(expected, found).unwrap_or_else(|e| panic!("{what}: {e}"));
    }
}

/// Workgroups that are larger and smaller than the frame, rows, and such as have fewer texels around them than threads.
const SIZES: [[u32; 2]; 5] = [[16, 16], [8, 8], [64, 2], [3, 5], [16, 4]];

#[test]
fn the_interpreter_finds_the_same_bits() {
    for case in cases() {
        let expected = case.interpreted(&case.compile(Share::Invocation, Unroll::Full));
        let mut shared = 0;
        for size in SIZES {
            let settings = Settings::new()
                .set_all(case.options.clone())
                .share(Share::Workgroup(size));
            // Small workgroups have too many texels around them.
            let Ok(compiled) = case.kernel.compile(&settings) else {
                continue;
            };
            shared += 1;
            let what = format!("{}, {size:?}", case.name);
            same(&what, &expected, &case.interpreted(&compiled));
        }
        assert!(shared >= 3, "{}: {shared} sizes of workgroups share", case.name);
    }
}

/// Reads that a loop does not change move before it; reads at a runtime offset stay.
#[test]
fn loops_and_branches_stay_what_they_are() {
    for case in looped() {
        let expected = case.interpreted(&case.compile(Share::Invocation, Unroll::Full));
        let compiled = case.compile(Share::WORKGROUP, Unroll::Full);
        assert!(compiled.counts.loops > 0, "{}", case.name);
        same(&case.name, &expected, &case.interpreted(&compiled));
    }
    // With their loops left they have nothing at a constant offset.
    let error = looped()[0]
        .kernel
        .compile(&Settings::new().share(Share::WORKGROUP).unroll(Unroll::None));
    let error = error.expect_err("nothing is shared").to_string();
    assert!(error.contains("of `color` the offset is no constant"), "{error}");
}

#[test]
fn random_kernels_find_the_same_bits() {
    let world = World::new(SEED);
    let mut shared = 0;
    for seed in SEED..SEED + 800 {
        let text = make(seed, Features::all());
        let kernel = Kernel::from_text("random.rs", &text.file(), "k");
        let compile = |share: Share| {
            let settings = Settings::new().share(share);
            kernel.compile(&settings)
        };
        let (Ok(alone), Ok(together)) = (compile(Share::Invocation), compile(Share::Workgroup([4, 3]))) else {
            continue;
        };
        let [expected, found] = [&alone, &together].map(|compiled| computed::<f32>(compiled, &world));
        let (Ok(expected), found) = (expected, found) else {
            continue;
        };
        let found = found.unwrap_or_else(|e| panic!("{text}\n{e}"));
        for (place, x, y) in expected.pairs(&found, &world).unwrap_or_else(|e| panic!("{text}\n{e}")) {
            assert!(same_texel(x, y), "{text}\n{place}: {x:?} became {y:?}");
        }
        shared += 1;
    }
    assert!(shared >= 10, "{shared} kernels share texels");
}

#[test]
fn a_gpu_finds_the_same_bits() {
    let bench = bench();
    for case in cases().into_iter().chain(looped()) {
        let picture = |share: Share| {
            let compiled = case.compile(share, Unroll::Full);
            let targets = bench.run_targets(&compiled, Stage::Compute, &case.inputs);
            let targets = targets.unwrap_or_else(|e| panic!("{}, {share}: {e}", case.name));
            targets.into_iter().map(|target| target.texels).collect::<Vec<_>>()
        };
        let expected = picture(Share::Invocation);
        for share in [Share::WORKGROUP, Share::Workgroup([64, 2])] {
            same(&format!("{}, {share}", case.name), &expected, &picture(share));
        }
    }
}

#[test]
fn half_precision_finds_the_same_bits() {
    let bench = bench().with_precision(Precision::F16);
    let case = filter("bilateral", &[("radius", "2")]);
    let picture = |share: Share| {
        let compiled = case.compile(share, Unroll::Full);
        let found = bench.run(&compiled, Stage::Compute, &case.inputs);
        let found = found.unwrap_or_else(|e| panic!("{share}: {e}"));
        found.texels().iter().map(|t| t.to_array()).collect::<Vec<_>>()
    };
    same_bits(&picture(Share::Invocation), &picture(Share::WORKGROUP)).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn compilers_read_every_language() {
    for case in cases() {
        let compiled = case.compile(Share::WORKGROUP, Unroll::Full);
        let targets = Target::MODERN.into_iter().chain([Target::Glsl430]);
        for origin in [Origin::UpperLeft, Origin::LowerLeft] {
            let options = EmitOptions::new()
                .targets(targets.clone())
                .origin(origin)
                .accept_loss(true);
            let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{}: {e}", case.name));
            compilers::read(&emitted).unwrap_or_else(|e| panic!("{}: {e}", case.name));
            let wgsl = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
            assert_eq!(wgsl.matches("workgroupBarrier();").count(), 1, "{wgsl}");
            assert_eq!(emitted.manifest.workgroup_size, Some([16, 16, 1]));
        }
    }
}

#[test]
fn other_languages_find_the_same() {
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    let case = filter("bilateral", &[("radius", "2")]);
    let expected = case.interpreted(&case.compile(Share::Invocation, Unroll::Full));
    let compiled = case.compile(Share::WORKGROUP, Unroll::Full);
    for language in [Target::Glsl450, Target::Hlsl, Target::Spirv] {
        let options = bench.emit_options(Stage::Compute).targets([Target::Wgsl, language]);
        let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{language}: {e}"));
        let found = passthrough::run(&bench, &emitted, language, &case.inputs);
        let found = found.unwrap_or_else(|e| panic!("{language}: {e}"));
        for (expected, found) in expected[0].iter().zip(found.texels()) {
            let off = (0..4)
                .map(|k| (expected[k] - f64::from(found[k])).abs())
                .fold(0.0, f64::max);
            assert!(off < 1e-5, "{language}: {expected:?} and {found:?}");
        }
    }
}

/// A region that no workgroup fits: its threads read around it, and inside of the frame.
#[test]
fn regions_find_the_same_bits() {
    let bench = bench();
    let case = filter("bilateral", &[("radius", "2")]);
    let region = Region::at([5, 3], [30, 18]);
    let picture = |share: Share| {
        let compiled = case.compile(share, Unroll::Full);
        let options = bench.emit_options(Stage::Compute).region(true);
        let (pass, manifest) = bench.emit_pass(&compiled, &options).unwrap_or_else(|e| panic!("{e}"));
        let uploaded = bench.upload(&manifest, &case.inputs).unwrap_or_else(|e| panic!("{e}"));
        let target = bench.create_target(SIZE, pass.target_format());
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = bench
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let bound = uploaded.bind_region(&pass, &view, region);
        bound.unwrap_or_else(|e| panic!("{e}")).encode(&mut encoder);
        bench.queue().submit([encoder.finish()]);
        let found = bench.download(&target).unwrap_or_else(|e| panic!("{e}"));
        found.texels().iter().map(|t| t.to_array()).collect::<Vec<_>>()
    };
    let expected = picture(Share::Invocation);
    assert!(expected.iter().flatten().any(|x| *x > 0.1));
    same_bits(&expected, &picture(Share::WORKGROUP)).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn graphs_are_read_as_they_are_printed() {
    use straightline_codegen::ir::{parse, print, verify};
    for case in cases() {
        let printed = print(&case.compile(Share::WORKGROUP, Unroll::Full).graph);
        let read = parse(&printed).unwrap_or_else(|e| panic!("{}: {e}\n{printed}", case.name));
        verify::verify_graph(&read).unwrap_or_else(|e| panic!("{}: {e}\n{printed}", case.name));
        assert_eq!(print(&read), printed);
    }
}

/// Each pixel of bilateral 7x7 reads 49 texels; a workgroup of 16x16 has 22x22 around it, which are two reads of each thread.
#[test]
fn reads_are_counted() {
    let compiled = filter("bilateral", &[("radius", "3")]).compile(Share::WORKGROUP, Unroll::Full);
    let counts = &compiled.counts;
    assert_eq!(counts.reads.get("color"), Some(&2));
    assert_eq!((counts.shared_reads, counts.barriers), (49, 1));
    assert_eq!(counts.shared_memory, 22 * 22 * 16);
    let sharing = compiled.sharing.expect("what is shared");
    let [tile] = &sharing.tiles[..] else {
        panic!("{sharing:?}")
    };
    assert_eq!(
        (tile.first, tile.size, tile.reads, tile.fills),
        ([-3, -3], [22, 22], 49, 2)
    );
    assert!(sharing.unshared.is_empty());
}

/// Unshared reads with their reasons; a partially used texel is kept.
#[test]
fn what_is_not_shared_is_told() {
    let case = &looped()[1];
    let sharing = case
        .compile(Share::WORKGROUP, Unroll::Full)
        .sharing
        .expect("what is shared");
    let tiles: Vec<_> = sharing
        .tiles
        .iter()
        .map(|t| (t.display_name(), t.size, t.bytes))
        .collect();
    let expected = [
        ("color".to_owned(), [20, 19], 20 * 19 * 8),
        ("normals[1]".to_owned(), [20, 19], 20 * 19 * 8),
        ("ids".to_owned(), [20, 16], 20 * 16 * 8),
    ];
    assert_eq!(tiles, expected);
    let apart: Vec<_> = sharing
        .unshared
        .iter()
        .map(|a| (&*a.texture, a.reads, &*a.why))
        .collect();
    let expected = [
        ("color", 2, "the offset is no constant"),
        ("noise", 1, "it has a size of its own"),
    ];
    assert_eq!(apart, expected);
}

/// Tiles that save the fewest reads are left out if not all fit.
#[test]
fn tiles_fit_into_the_memory_that_devices_have() {
    let text = "pub fn k(a: &Frame<Vec4>, b: &Frame<Vec4>, c: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
        let mut sum = Vec4::ZERO;
        for y in -4..=4 {
            for x in -4..=4 {
                sum += a.load(pixel + ivec2(x, y));
            }
        }
        for x in -4..=4 {
            sum += b.load(pixel + ivec2(x, 0)) + c.load(pixel + ivec2(x, -x));
        }
        sum
    }";
    let case = of_card("k".to_owned(), Kernel::from_text("k.rs", text, "k"), Vec::new());
    let compiled = case.compile(Share::WORKGROUP, Unroll::Full);
    let sharing = compiled.sharing.clone().expect("what is shared");
    let names: Vec<_> = sharing.tiles.iter().map(|t| &*t.name).collect();
    assert_eq!(names, ["a_tile", "b_tile"], "{sharing:?}");
    assert!(sharing.byte_size() <= 16_384);
    let told = "its tile does not fit into 16384 bytes beside those of others";
    let [apart] = &sharing.unshared[..] else {
        panic!("{sharing:?}")
    };
    assert_eq!((&*apart.texture, apart.reads, &*apart.why), ("c", 9, told));
    let expected = case.interpreted(&case.compile(Share::Invocation, Unroll::Full));
    same("k", &expected, &case.interpreted(&compiled));
}

#[test]
fn what_cannot_share_is_refused() {
    let refused = |text: &str, settings: Settings| {
        let error = Kernel::from_text("k.rs", text, "k").compile(&settings);
        error.expect_err("it is refused").to_string()
    };
    let by = |share: Share| Settings::new().share(share);
    let point = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) }";
    let cases = [
        (
            point,
            by(Share::WORKGROUP),
            "it reads nothing that pixels can share: of `color` a pixel reads one texel",
        ),
        (point, by(Share::Workgroup([0, 8])), "a workgroup of 0x8 threads"),
        (point, by(Share::Workgroup([64, 64])), "a workgroup of 64x64 threads"),
        (
            point,
            by(Share::WORKGROUP).block(2, 2),
            "an invocation computes 2x2 of them",
        ),
        (
            "pub fn k(color: &Frame<Vec4>, pixel: Quad<IVec2>) -> Quad<Vec4> { color.load(pixel) }",
            by(Share::WORKGROUP),
            "its invocations compute more than one pixel",
        ),
        (
            "pub fn k(color: &Frame<Vec4>, out: &StorageBuffer<f32>, pixel: IVec2) -> Vec4 {
                out.store(0, 1.0);
                color.load(pixel) + color.load(pixel + 1) + color.load(pixel - 1)
            }",
            by(Share::WORKGROUP),
            "it writes to buffers or pictures, and threads outside of the frame would too",
        ),
        (
            "pub fn k(color: &Frame<Vec4>, group: &Workgroup<8, 8>) -> PerThread<Vec4> {
                group.each(|t| color.load(t.pixel) + color.load(t.pixel + 1))
            }",
            by(Share::WORKGROUP),
            "it is a kernel of workgroups, and says itself what its threads share",
        ),
        (
            "pub fn k(time: f32, pixel: IVec2) -> Vec4 { Vec4::splat(time) }",
            by(Share::WORKGROUP),
            "it reads no textures",
        ),
    ];
    for (text, settings, why) in cases {
        let error = refused(text, settings);
        assert!(
            error.contains(&format!("cannot share texels by workgroup: {why}")),
            "{error}"
        );
        assert!(error.contains("help"), "{error}");
    }
    let compiled = filter("median", &[]).compile(Share::WORKGROUP, Unroll::Full);
    let error = |options: EmitOptions| {
        let errors = compiled.emit(&options).expect_err("it is refused");
        let help = errors.diagnostics[0].help.clone().expect("help");
        (errors.first_code(), help)
    };
    let staged = (
        Some(Code::StageUnfit),
        "emit it for compute, or leave `share` out".to_owned(),
    );
    assert_eq!(error(EmitOptions::new().stage(Stage::Fragment)), staged);
    assert_eq!(error(EmitOptions::new().form(Form::Function)), staged);
    let other = EmitOptions::new().workgroup(8, 8);
    assert_eq!(
        error(other),
        (
            Some(Code::WorkgroupSize),
            "say `workgroup(8x8)` where sharing is asked for, or leave `workgroup` out".to_owned()
        )
    );
}
