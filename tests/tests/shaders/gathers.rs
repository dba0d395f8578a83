//! Texels read four at once: the same bits as where each is read by itself, by the interpreter and on a GPU, in every language.

use crate::common;

use common::{bench, same_bits, same_texels};
use straightline_bench::execute::{Bench, Inputs, interpret_kernel, test_inputs};
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Kernel, Origin, Precision, ReadOrder, Settings, Stage};
use straightline_kernels::prelude::*;
use straightline_manifest::{BindingKind, SampleType, SamplerType};
use straightline_runtime::{Error, Region, Resource, wgpu};
use straightline_tests::random::forms::same as same_texel;
use straightline_tests::random::make::{Features, make};
use straightline_tests::random::oracle::{World, computed};
use straightline_tests::sraa::surfaces;
use straightline_tests::{compilers, passthrough};

/// A component of a texel with more, a layer, texels beyond the border on every side, some of them read twice, a whole
/// texel and one at a runtime offset, which stay; a coordinate that tells the texels of a row apart.
const MIXED: &str = "
    pub fn mixed(height: &Frame<f32>, color: &Frame<Vec4>, stack: &FrameLayers<Vec2>, pixel: IVec2) -> Vec4 {
        let mut sum = Vec4::ZERO;
        for y in -2..=2 {
            for x in -1..=2 {
                let k = (5 * y + x) as f32;
                sum.x += height.load(pixel + ivec2(x, y)) * k;
                sum.y += stack.load(pixel + ivec2(y, x), 2).y * k;
                if y > 0 {
                    sum.z += color.load(pixel + ivec2(3 * x, 1 - y)).w * k;
                }
            }
        }
        let far = (height.load(pixel) * 7.0) as i32;
        sum + height.load(pixel + ivec2(far, 1)) * color.load(pixel) - height.load(pixel + ivec2(-1, -1))
    }
";

/// Kernel that reads the texels at the pixel and around it, each into a component of its own.
const AROUND: &str = "
    pub fn around(height: &Frame<f32>, pixel: IVec2) -> Vec4 {
        vec4(
            height.load(pixel),
            height.load(pixel + ivec2(1, 0)),
            height.load(pixel + ivec2(0, -1)),
            height.load(pixel + ivec2(1, -1)),
        )
    }
";

/// A kernel and how it is named.
struct Case {
    name: String,
    kernel: Kernel,
    options: Vec<(String, String)>,
}

/// First seed of random kernels.
const SEED: u64 = 78_000;

fn builtin(name: &str, options: &[(&str, &str)]) -> Case {
    Case {
        name: format!("{name} {options:?}"),
        kernel: Kernel::builtin(name).unwrap_or_else(|e| panic!("{e}")),
        options: straightline_tests::sraa::options::options(options),
    }
}

fn text(text: &str, name: &str) -> Case {
    Case {
        name: name.to_owned(),
        kernel: Kernel::from_text("case.rs", text, name),
        options: Vec::new(),
    }
}

fn cases() -> Vec<Case> {
    vec![
        builtin("sraa", &[]),
        builtin("sraa", &[("metric", "depth"), ("radius", "2")]),
        builtin(
            "sraa",
            &[("layout", "multisampled"), ("metric", "depth"), ("guards", "none")],
        ),
        builtin("stalker", &[]),
        text(MIXED, "mixed"),
        text(AROUND, "around"),
    ]
}

impl Case {
    fn compile(&self, reads: ReadOrder, block: [u32; 2]) -> Compiled {
        let settings = Settings::new()
            .set_all(self.options.clone())
            .reads(reads)
            .block(block[0], block[1]);
        let compiled = self.kernel.compile(&settings);
        compiled.unwrap_or_else(|e| panic!("{}, {reads}:\n{e}", self.name))
    }

    fn inputs(&self, size: UVec2) -> Inputs {
        match self.kernel.name() {
            "sraa" => surfaces::inputs(&self.options, size, 7),
            _ => test_inputs(&self.compile(ReadOrder::Source, [1, 1]).graph, size),
        }
    }
}

/// Odd and even, with no inside, and with texels that are beyond the border on both sides.
const SIZES: [UVec2; 5] = [uvec2(41, 23), uvec2(1, 1), uvec2(2, 1), uvec2(1, 5), uvec2(8, 4)];

#[test]
fn the_interpreter_finds_the_same_bits() {
    for case in cases() {
        for block in [[1, 1], [2, 2], [3, 1]] {
            let [source, gather] = [ReadOrder::Source, ReadOrder::Gather].map(|reads| case.compile(reads, block));
            let (one, four) = (source.counts.texture_reads, gather.counts.texture_reads);
            assert!(four < one, "{}, {block:?}: {four} reads of {one}", case.name);
            for size in SIZES {
                let inputs = case.inputs(size);
                let [expected, found] = [&source, &gather].map(|compiled| {
                    let found = interpret_kernel::<f32>(compiled, &inputs, false);
                    found.unwrap_or_else(|e| panic!("{}: {e}", case.name)).texels
                });
                same_bits(&expected, &found).unwrap_or_else(|e| panic!("{}, {block:?}, {size}: {e}", case.name));
            }
        }
    }
}

#[test]
fn random_kernels_find_the_same_bits() {
    let world = World::new(SEED);
    let mut gathered = 0;
    for seed in SEED..SEED + 800 {
        let text = make(seed, Features::all());
        let kernel = Kernel::from_text("random.rs", &text.file(), "k");
        let compile = |reads: ReadOrder| {
            let settings = Settings::new().reads(reads);
            kernel.compile(&settings)
        };
        let (Ok(alone), Ok(together)) = (compile(ReadOrder::Source), compile(ReadOrder::Gather)) else {
            continue;
        };
        if together.gathered.is_empty() {
            continue;
        }
        let [expected, found] = [&alone, &together].map(|compiled| computed::<f32>(compiled, &world));
        let (Ok(expected), found) = (expected, found) else {
            continue;
        };
        let found = found.unwrap_or_else(|e| panic!("{text}\n{e}"));
        for (place, x, y) in expected.pairs(&found, &world).unwrap_or_else(|e| panic!("{text}\n{e}")) {
            assert!(same_texel(x, y), "{text}\n{place}: {x:?} became {y:?}");
        }
        gathered += 1;
    }
    assert!(gathered >= 5, "{gathered} kernels gather");
}

/// A device that filters no 32-bit floats: nothing here asks for it.
fn plain_bench() -> Bench {
    let instance = common::instance();
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
    let adapter = adapter.unwrap_or_else(|e| panic!("this test needs a GPU adapter: {e}"));
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))
        .unwrap_or_else(|e| panic!("the adapter gives no device: {e}"));
    Bench::new(&device, &queue, false)
}

#[track_caller]
fn same_pictures(bench: &Bench, case: &Case, stage: Stage, block: [u32; 2], size: UVec2) {
    let inputs = case.inputs(size);
    let [expected, found] = [ReadOrder::Source, ReadOrder::Gather].map(|reads| {
        let targets = bench.run_targets(&case.compile(reads, block), stage, &inputs);
        let targets = targets.unwrap_or_else(|e| panic!("{}, {reads}, {size}: {e}", case.name));
        targets.into_iter().next().expect("a target").texels
    });
    same_texels(&expected, &found).unwrap_or_else(|e| panic!("{}, {block:?}, {size}: {e}", case.name));
}

#[test]
fn a_gpu_finds_the_same_bits() {
    let bench = plain_bench();
    for case in cases() {
        for size in SIZES {
            same_pictures(&bench, &case, Stage::Compute, [1, 1], size);
            same_pictures(&bench, &case, Stage::Fragment, [1, 1], size);
        }
        same_pictures(&bench, &case, Stage::Compute, [2, 2], SIZES[0]);
    }
}

/// As wide and as high as every device's textures may be, and not powers of two.
#[test]
fn a_gpu_finds_the_same_texels_in_large_pictures() {
    let bench = plain_bench();
    let case = text(AROUND, "around");
    for size in [
        uvec2(8192, 2),
        uvec2(8191, 1),
        uvec2(3, 8189),
        uvec2(6_007, 5),
        uvec2(1, 8192),
    ] {
        same_pictures(&bench, &case, Stage::Compute, [1, 1], size);
    }
}

/// The corner that four texels share is half a texel from where others would be taken. In `f32`, with a division that is
/// off by as much as Vulkan allows, it is off by less than a hundredth.
#[test]
fn places_are_half_a_texel_from_all_others() {
    let mut worst = 0.0f64;
    for size in 1..=16_384u32 {
        let exact = 1.0 / size as f32;
        for texel in [exact.to_bits() - 3, exact.to_bits(), exact.to_bits() + 3].map(f32::from_bits) {
            for corner in (0..=size).step_by(1 + size as usize / 61).chain([size - 1, size]) {
                let place = f64::from(corner as f32 * texel) * f64::from(size);
                worst = worst.max((place - f64::from(corner)).abs());
            }
        }
    }
    assert!((1e-4..0.01).contains(&worst), "{worst}");
}

#[test]
fn compilers_read_every_language() {
    for case in cases() {
        let compiled = case.compile(ReadOrder::Gather, [1, 1]);
        let targets = Target::MODERN.into_iter().chain([Target::Glsl430, Target::Essl310]);
        for origin in [Origin::UpperLeft, Origin::LowerLeft] {
            let options = EmitOptions::new().targets(targets.clone()).origin(origin);
            let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{}: {e}", case.name));
            compilers::read(&emitted).unwrap_or_else(|e| panic!("{}: {e}", case.name));
            let bindings = &emitted.manifest.bindings;
            let samplers = bindings.iter().filter(|binding| {
                let ours = BindingKind::Sampler {
                    sampler: SamplerType::NonFiltering,
                };
                binding.kind == ours && binding.name == "texels"
            });
            assert_eq!(samplers.count(), 1, "{}: {bindings:?}", case.name);
            // 32-bit floats will do, which not every device filters.
            for texture in compiled.gathered.iter().map(|gathered| &gathered.texture) {
                let bound = bindings.iter().find(|binding| binding.name == *texture);
                let kind = &bound.expect("what is gathered is bound").kind;
                let plain = matches!(kind, BindingKind::Texture { sample_type, .. } if *sample_type == SampleType::Unfilterable);
                assert!(plain, "{}: {bindings:?}", case.name);
            }
        }
    }
}

#[test]
fn other_languages_find_the_same() {
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    for case in [text(AROUND, "around"), text(MIXED, "mixed")] {
        let inputs = case.inputs(SIZES[0]);
        let expected = interpret_kernel::<f32>(&case.compile(ReadOrder::Source, [1, 1]), &inputs, false);
        let expected = expected.unwrap_or_else(|e| panic!("{e}")).texels;
        let compiled = case.compile(ReadOrder::Gather, [1, 1]);
        for language in [Target::Glsl450, Target::Hlsl, Target::Spirv] {
            let options = bench.emit_options(Stage::Compute).targets([Target::Wgsl, language]);
            let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{language}: {e}"));
            let found = passthrough::run(&bench, &emitted, language, &inputs);
            let found = found.unwrap_or_else(|e| panic!("{language}: {e}"));
            for (expected, found) in expected.iter().zip(found.texels()) {
                let off = (0..4)
                    .map(|k| (expected[k] - found[k]).abs() / expected[k].abs().max(1.0))
                    .fold(0.0, f32::max);
                assert!(off < 1e-5, "{language}: {expected:?} and {found:?}");
            }
        }
    }
}

/// A rectangle of the inputs, whose pixels are counted from its corner.
#[test]
fn regions_find_the_same_bits() {
    let bench = bench();
    let case = text(AROUND, "around");
    let (size, region) = (SIZES[0], Region::at([5, 3], [36, 20]));
    let inputs = case.inputs(size);
    let [expected, found] = [ReadOrder::Source, ReadOrder::Gather].map(|reads| {
        let options = bench.emit_options(Stage::Compute).region(true);
        let compiled = case.compile(reads, [1, 1]);
        let (pass, manifest) = bench.emit_pass(&compiled, &options).unwrap_or_else(|e| panic!("{e}"));
        let uploaded = bench.upload(&manifest, &inputs).unwrap_or_else(|e| panic!("{e}"));
        let target = bench.create_target(size, pass.target_format());
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = bench
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let bound = uploaded.bind_region(&pass, &view, region);
        bound.unwrap_or_else(|e| panic!("{e}")).encode(&mut encoder);
        bench.queue().submit([encoder.finish()]);
        let found = bench.download(&target).unwrap_or_else(|e| panic!("{e}"));
        found.texels().iter().map(|t| t.to_array()).collect::<Vec<_>>()
    });
    assert!(expected.iter().flatten().any(|x| *x > 0.1));
    same_bits(&expected, &found).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn what_cannot_be_gathered_is_refused() {
    let refused = |name: &str, settings: Settings| {
        let settings = settings.reads(ReadOrder::Gather);
        let kernel = Kernel::builtin(name).unwrap_or_else(|e| panic!("{e}"));
        kernel.compile(&settings).expect_err("it is refused").to_string()
    };
    let error = refused("quad_convolution", Settings::default());
    assert!(
        error.contains("the lanes of a quad read for each other already"),
        "{error}"
    );
    let shared = Settings::new().share(straightline_codegen::Share::WORKGROUP);
    let error = refused("sraa", shared);
    assert!(
        error.contains("its threads share what they read by their workgroup"),
        "{error}"
    );
    let half = EmitOptions::new().precision(Precision::F16).accept_loss(true);
    let error = text(AROUND, "around").compile(ReadOrder::Gather, [1, 1]).emit(&half);
    let error = error.expect_err("half precision is refused").to_string();
    assert!(error.contains("half precision does not hold where they lie"), "{error}");
}

/// A sampler that weighs texels would need a format that can be filtered.
#[test]
fn a_sampler_that_filters_is_refused() {
    let bench = plain_bench();
    let compiled = text(AROUND, "around").compile(ReadOrder::Gather, [1, 1]);
    let options = bench.emit_options(Stage::Compute);
    let (pass, _) = bench.emit_pass(&compiled, &options).unwrap_or_else(|e| panic!("{e}"));
    let view = |format, usage| {
        let size = wgpu::Extent3d {
            width: 4,
            height: 4,
            depth_or_array_layers: 1,
        };
        let texture = bench.device().create_texture(&wgpu::TextureDescriptor {
            label: None,
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        });
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    };
    let height = view(wgpu::TextureFormat::R32Float, wgpu::TextureUsages::TEXTURE_BINDING);
    let target = view(pass.target_format(), wgpu::TextureUsages::STORAGE_BINDING);
    let bound = |filter| {
        let sampler = bench.device().create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: filter,
            ..Default::default()
        });
        let inputs = [("height", Resource::from(&height)), ("texels", (&sampler).into())];
        pass.bind(&inputs, &target).map(|_| ())
    };
    bound(wgpu::FilterMode::Nearest).unwrap_or_else(|e| panic!("{e}"));
    let error = bound(wgpu::FilterMode::Linear).expect_err("it filters");
    assert!(
        matches!(&error, Error::InputSampler { name, .. } if name == "texels"),
        "{error}"
    );
    assert!(error.to_string().contains("takes the nearest texel"), "{error}");
}
