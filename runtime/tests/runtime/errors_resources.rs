//! Unsuitable samplers, buffers and textures, and manifests that need such, cause errors that name them.

use crate::common;

use common::{
    BINS, COPY, Fixture, Gpu, Kernel, RESOLVE, SCALE, SHADOW, SHAPES, STAGES, Stage, TABLE, array_view, view,
};
use straightline_runtime::manifest::SamplerType;
use straightline_runtime::{BufferProblem, Error, Pass, Resource, ResourceKind, SamplerProblem, ViewProblem, wgpu};
use wgpu::{BufferUsages, TextureFormat, TextureUsages, TextureView};

const SIZE: [u32; 2] = [8, 4];
const READ: TextureUsages = TextureUsages::TEXTURE_BINDING;

fn pass(gpu: &Gpu, kernel: &Kernel, stage: Stage) -> Pass {
    let Fixture { manifest, wgsl } = kernel.emit(stage);
    Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass")
}

/// Binds resources that must be rejected.
fn refuse(gpu: &Gpu, pass: &Pass, inputs: &[(&str, Resource)]) -> Error {
    let target = view(&gpu.target(SIZE));
    let error = pass.bind(inputs, &target).expect_err("a refusal");
    assert!(error.to_string().contains(&format!("`{}`", pass.kernel())), "{error}");
    error
}

/// Makes a pass that must fail and returns the error with its message.
fn refuse_making(gpu: &Gpu, manifest: &str, wgsl: &str) -> (Error, String) {
    let error = Pass::from_json(&gpu.device, manifest, wgsl).expect_err("a refusal");
    let message = error.to_string();
    (error, message)
}

/// `text` with `from`, which must be there, replaced.
fn edit(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "the fixture has no {from}");
    text.replace(from, to)
}

fn view_problem(error: Error, wanted: &str) -> ViewProblem {
    match error {
        Error::Input { name, problem, .. } if name == wanted => problem,
        other => panic!("not about texture `{wanted}`: {other}"),
    }
}

fn sampler_problem(error: Error, wanted: &str) -> SamplerProblem {
    match error {
        Error::InputSampler { name, problem, .. } if name == wanted => problem,
        other => panic!("not about sampler `{wanted}`: {other}"),
    }
}

fn buffer_problem(error: Error, wanted: &str) -> BufferProblem {
    match error {
        Error::InputBuffer { name, problem, .. } if name == wanted => problem,
        other => panic!("not about buffer `{wanted}`: {other}"),
    }
}

#[test]
fn resources_of_another_kind() {
    let gpu = Gpu::new();
    let texture = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba8Unorm, READ));
    let (sampler, buffer) = (gpu.sampler(None), gpu.storage(&[0.0; 4]));
    let given = [Resource::from(&texture), (&sampler).into(), (&buffer).into()];
    for stage in STAGES {
        let cases: [(Kernel, &str, ResourceKind); 3] = [
            (SCALE, "small", ResourceKind::Texture),
            (SCALE, "linear", ResourceKind::Sampler),
            (TABLE, "weights", ResourceKind::Buffer),
        ];
        for (kernel, wanted, kind) in cases {
            let pass = pass(&gpu, &kernel, stage);
            for resource in given.iter().filter(|resource| resource.kind() != kind) {
                // The others are as they should be.
                let inputs: Vec<(&str, Resource)> = pass
                    .inputs()
                    .map(|name| match name {
                        name if name == wanted => (name, *resource),
                        "small" => (name, given[0]),
                        name => (name, given[1]),
                    })
                    .collect();
                match refuse(&gpu, &pass, &inputs) {
                    Error::InputKind {
                        name, needed, given, ..
                    } if name == wanted => assert_eq!((needed, given), (kind, resource.kind())),
                    other => panic!("not about the kind of `{wanted}`: {other}"),
                }
            }
        }
    }
    let message = refuse(&gpu, &pass(&gpu, &TABLE, Stage::Compute), &[("weights", given[1])]).to_string();
    assert_eq!(
        message,
        "`table` reads its input `weights` as a storage buffer, but was given a sampler: give it a `&wgpu::Buffer`"
    );
}

#[test]
fn textures_that_cannot_be_filtered() {
    let gpu = Gpu::new();
    let linear = gpu.sampler(None);
    for stage in STAGES {
        let pass = pass(&gpu, &SCALE, stage);
        let with = |small: &TextureView| {
            let inputs = [("small", small.into()), ("linear", (&linear).into())];
            view_problem(refuse(&gpu, &pass, &inputs), "small")
        };
        let of = |format| with(&view(&gpu.texture([2, 2], 1, format, READ)));
        let format = TextureFormat::Rgba32Float;
        assert_eq!(of(format), ViewProblem::NotFilterable { format });
        for format in [TextureFormat::Depth32Float, TextureFormat::Depth24PlusStencil8] {
            assert_eq!(of(format), ViewProblem::DepthFiltered { format });
        }
        let format = TextureFormat::Rgba8Uint;
        assert_eq!(of(format), ViewProblem::NotFloat { format });
        let array = array_view(&gpu.texture([2, 2], 1, TextureFormat::Rgba8Unorm, READ));
        assert!(matches!(with(&array), ViewProblem::Dimension { ref found, .. } if found == "2d-array"));
    }
}

#[test]
fn a_filtered_input_that_is_the_target() {
    let gpu = Gpu::new();
    let linear = gpu.sampler(None);
    for stage in STAGES {
        let Fixture { manifest, wgsl } = SCALE.emit(stage);
        let [manifest, wgsl] = [manifest, wgsl].map(|text| text.replace("rgba32float", "rgba16float"));
        let pass = Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass");
        let usage = READ | TextureUsages::STORAGE_BINDING | TextureUsages::RENDER_ATTACHMENT;
        let image = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba16Float, usage));
        let inputs = [("small", Resource::from(&image)), ("linear", (&linear).into())];
        let error = pass.bind(&inputs, &image).expect_err("a refusal");
        assert_eq!(view_problem(error, "small"), ViewProblem::IsTarget);
    }
}

#[test]
fn textures_with_the_wrong_number_of_samples() {
    let gpu = Gpu::new();
    for stage in STAGES {
        let Fixture { manifest, wgsl } = RESOLVE.emit(stage);
        let of = |samples: u32, texture: &wgpu::Texture| {
            let manifest = manifest.replace(r#""samples": 4"#, &format!(r#""samples": {samples}"#));
            let pass = Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass");
            let color = view(texture);
            view_problem(refuse(&gpu, &pass, &[("color", (&color).into())]), "color")
        };
        let single = gpu.texture(SIZE, 1, TextureFormat::Rgba16Float, READ);
        let four = gpu.multisampled(SIZE, 4, TextureFormat::Rgba16Float);
        assert_eq!(of(4, &single), ViewProblem::SingleSampled { needed: 4 });
        // Even one sample is read from a multisampled texture.
        assert_eq!(of(1, &single), ViewProblem::SingleSampled { needed: 2 });
        assert_eq!(of(8, &four), ViewProblem::Samples { needed: 8, found: 4 });
        let small = gpu.multisampled([4, 4], 4, TextureFormat::Rgba16Float);
        assert_eq!(
            of(4, &small),
            ViewProblem::Size {
                input: [4, 4],
                target: SIZE
            }
        );
        let color = view(&four);
        let error = refuse(&gpu, &pass(&gpu, &COPY, stage), &[("color", (&color).into())]);
        assert_eq!(view_problem(error, "color"), ViewProblem::Multisampled { samples: 4 });
    }
}

#[test]
fn colours_are_not_depths() {
    let gpu = Gpu::new();
    let compare = gpu.sampler(Some(wgpu::CompareFunction::Less));
    for stage in STAGES {
        let pass = pass(&gpu, &SHADOW, stage);
        for format in [TextureFormat::R32Float, TextureFormat::Rgba8Unorm] {
            let depth = view(&gpu.texture(SIZE, 1, format, READ));
            let error = refuse(
                &gpu,
                &pass,
                &[("depth", (&depth).into()), ("compare", (&compare).into())],
            );
            assert_eq!(view_problem(error, "depth"), ViewProblem::NotDepth { format });
        }
    }
}

#[test]
fn textures_of_another_shape_or_of_other_numbers() {
    let gpu = Gpu::new();
    let linear = gpu.sampler(None);
    let square = |layers| gpu.texture([4, 4], layers, TextureFormat::Rgba8Unorm, READ);
    let cube = |texture: &wgpu::Texture| {
        texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::Cube),
            ..Default::default()
        })
    };
    let volume = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: 2,
            height: 2,
            depth_or_array_layers: 2,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D3,
        format: TextureFormat::Rgba8Unorm,
        usage: READ,
        view_formats: &[],
    });
    let ids = gpu.texture([4, 4], 1, TextureFormat::R32Uint, READ);
    let six = square(6);
    let (six_view, volume_view, ids_view) = (cube(&six), view(&volume), view(&ids));
    for stage in STAGES {
        let pass = pass(&gpu, &SHAPES, stage);
        let with = |around: &TextureView, volume: &TextureView, ids: &TextureView, wanted: &str| {
            let inputs = [
                ("around", around.into()),
                ("volume", volume.into()),
                ("ids", ids.into()),
                ("linear", (&linear).into()),
            ];
            view_problem(refuse(&gpu, &pass, &inputs), wanted)
        };
        let target = view(&gpu.target(SIZE));
        let mut encoder = gpu.encoder();
        let fitting: [(&str, Resource); 4] = [
            ("around", (&six_view).into()),
            ("volume", (&volume_view).into()),
            ("ids", (&ids_view).into()),
            ("linear", (&linear).into()),
        ];
        pass.bind(&fitting, &target).expect("all fits").encode(&mut encoder);
        gpu.submit(encoder);
        let one = view(&square(1));
        let found = with(&one, &volume_view, &ids_view, "around");
        assert_eq!(found, ViewProblem::Layers { needed: 6, found: 1 });
        let flat = array_view(&six);
        let found = with(&flat, &volume_view, &ids_view, "around").to_string();
        assert!(
            found.contains("needs a view of dimension cube") && found.contains("2d-array"),
            "{found}"
        );
        let wide = array_view(&gpu.texture([8, 4], 6, TextureFormat::Rgba8Unorm, READ));
        let found = with(&wide, &volume_view, &ids_view, "around");
        assert_eq!(found, ViewProblem::NotSquare { size: [8, 4] });
        let found = with(&six_view, &one, &ids_view, "volume").to_string();
        assert!(
            found.contains("dimension 3d") && found.contains("a 2d texture"),
            "{found}"
        );
        let found = with(&volume_view, &volume_view, &ids_view, "around").to_string();
        assert!(found.contains("a 3d texture"), "{found}");
        for format in [TextureFormat::R32Sint, TextureFormat::R32Float] {
            let other = view(&gpu.texture([4, 4], 1, format, READ));
            let found = with(&six_view, &volume_view, &other, "ids").to_string();
            assert!(found.contains("reads unsigned integers"), "{found}");
        }
        let found = with(&ids_view, &volume_view, &ids_view, "around");
        assert_eq!(found, ViewProblem::Layers { needed: 6, found: 1 });
    }
}

#[test]
fn samplers_for_another_use() {
    let gpu = Gpu::new();
    let other = gpu.sibling();
    let small = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba8Unorm, READ));
    let depth = view(&gpu.texture(SIZE, 1, TextureFormat::Depth32Float, READ));
    let less = Some(wgpu::CompareFunction::Less);
    for stage in STAGES {
        let scale = pass(&gpu, &SCALE, stage);
        let shadow = pass(&gpu, &SHADOW, stage);
        let filtering = |sampler: &wgpu::Sampler| {
            let inputs = [("small", (&small).into()), ("linear", sampler.into())];
            sampler_problem(refuse(&gpu, &scale, &inputs), "linear")
        };
        let comparison = |sampler: &wgpu::Sampler| {
            let inputs = [("depth", (&depth).into()), ("compare", sampler.into())];
            sampler_problem(refuse(&gpu, &shadow, &inputs), "compare")
        };
        let needed = SamplerType::Filtering;
        assert_eq!(filtering(&gpu.sampler(less)), SamplerProblem::Type { needed });
        let needed = SamplerType::Comparison;
        assert_eq!(comparison(&gpu.sampler(None)), SamplerProblem::Type { needed });
        let foreign = filtering(&other.sampler(None));
        assert!(matches!(foreign, SamplerProblem::Refused { .. }), "{foreign}");
    }
}

#[test]
fn buffers_that_cannot_be_bound() {
    let limits = wgpu::Limits {
        max_storage_buffer_binding_size: 64,
        ..Default::default()
    };
    let gpu = Gpu::with(wgpu::Features::empty(), limits);
    let other = gpu.sibling();
    for stage in STAGES {
        let pass = pass(&gpu, &TABLE, stage);
        let with = |buffer: &wgpu::Buffer| {
            let error = refuse(&gpu, &pass, &[("weights", buffer.into())]);
            buffer_problem(error, "weights")
        };
        let of = |size| with(&gpu.buffer(size, BufferUsages::STORAGE));
        assert_eq!(of(12), BufferProblem::TooSmall { size: 12, stride: 16 });
        assert_eq!(of(0), BufferProblem::TooSmall { size: 0, stride: 16 });
        assert_eq!(of(68), BufferProblem::TooLarge { size: 68, max: 64 });
        assert_eq!(of(22), BufferProblem::Unaligned { size: 22 });
        let uniform = gpu.buffer(16, BufferUsages::UNIFORM);
        assert_eq!(with(&uniform), BufferProblem::Usage { missing: "STORAGE" });
        let foreign = with(&other.buffer(16, BufferUsages::STORAGE));
        assert!(matches!(foreign, BufferProblem::Refused { .. }), "{foreign}");
        let destroyed = gpu.buffer(16, BufferUsages::STORAGE);
        destroyed.destroy();
        let destroyed = with(&destroyed);
        assert!(matches!(destroyed, BufferProblem::Refused { .. }), "{destroyed}");
    }
}

/// A buffer that is written and bound twice is an error of `bind`; wgpu would refuse the caller's encoder. One that is only
/// read may be bound as often as one likes.
#[test]
fn buffers_that_are_written_and_bound_twice() {
    let gpu = Gpu::new();
    let buffer = || gpu.buffer(64, BufferUsages::STORAGE);
    let [table, bins, more] = [buffer(), buffer(), buffer()];
    let pass = pass(&gpu, &BINS, Stage::Compute);
    let given = |table, bins, more| {
        let pairs: [(&str, &wgpu::Buffer); 3] = [("table", table), ("bins", bins), ("more", more)];
        pairs.map(|(name, buffer)| (name, Resource::from(buffer)))
    };
    let target = view(&gpu.target(SIZE));
    pass.bind(&given(&table, &bins, &more), &target).expect("three buffers");
    for (inputs, name, other) in [
        (given(&bins, &bins, &more), "bins", "table"),
        (given(&table, &bins, &bins), "bins", "more"),
        (given(&more, &bins, &more), "more", "table"),
        (given(&bins, &bins, &bins), "bins", "table"),
        // A clone is the same buffer.
        (given(&bins.clone(), &bins, &more), "bins", "table"),
    ] {
        let problem = buffer_problem(refuse(&gpu, &pass, &inputs), name);
        assert_eq!(
            problem,
            BufferProblem::IsOther {
                other: other.to_owned()
            }
        );
    }
}

#[test]
fn bindings_that_contradict_themselves() {
    let gpu = Gpu::new();
    let cases: [(Kernel, &str, &str, &str); 15] = [
        (COPY, r#""samples": 1"#, r#""samples": 0"#, "`color`: no samples"),
        (
            COPY,
            r#""samples": 1"#,
            r#""samples": 4"#,
            "not multisampled, but with 4 samples",
        ),
        (RESOLVE, r#""samples": 4"#, r#""samples": 0"#, "no samples"),
        (RESOLVE, "unfilterable-float", "float", "multisampled, but filterable"),
        (RESOLVE, r#""layers": 1"#, r#""layers": 2"#, "with 2 layers"),
        (
            SHADOW,
            r#""components": 1"#,
            r#""components": 2"#,
            "a depth, but with 2 components",
        ),
        (
            SHADOW,
            r#""view_dimension": "2d", "multisampled""#,
            r#""view_dimension": "3d", "multisampled""#,
            "a depth, but not 2d",
        ),
        (
            TABLE,
            "read-only-storage",
            "uniform",
            "neither read-only-storage nor storage",
        ),
        (
            TABLE,
            r#""stride": 16"#,
            r#""stride": 16, "fields": [{"name": "x", "type": "f32", "offset": 16, "size": 4}]"#,
            "field `x` does not lie inside the 16 bytes",
        ),
        (TABLE, r#""stride": 16"#, r#""stride": 0"#, "a stride of 0 bytes"),
        (TABLE, r#""stride": 16"#, r#""stride": 18"#, "a stride of 18 bytes"),
        (
            TABLE,
            r#""stride": 16"#,
            r#""stride": 8"#,
            "an element of type vec3f takes 12",
        ),
        (
            TABLE,
            r#""element": "vec3f""#,
            r#""element": "mat3x3f""#,
            "elements of type `mat3x3f`",
        ),
        (
            SCALE,
            r#""name": "linear""#,
            r#""name": "small""#,
            "input `small` is listed twice",
        ),
        (SCALE, r#""binding": 1,"#, r#""binding": 0,"#, "is listed twice"),
    ];
    for (kernel, from, to, wanted) in cases {
        let Fixture { manifest, wgsl } = kernel.emit(Stage::Compute);
        let (error, message) = refuse_making(&gpu, &edit(&manifest, from, to), &wgsl);
        assert!(matches!(error, Error::BadManifest { .. }), "{message}");
        assert!(message.contains(wanted), "{message}");
    }
}

#[test]
fn declarations_that_are_not_their_bindings() {
    let gpu = Gpu::new();
    let cases: [(Kernel, &str, &str, &str); 8] = [
        (
            SCALE,
            "filtering",
            "comparison",
            "`linear` is not a `sampler_comparison`",
        ),
        (SCALE, r#""float""#, r#""depth""#, "`small` is not a `texture_depth_2d`"),
        (SHADOW, "comparison", "filtering", "`compare` is not a `sampler`"),
        (
            SHADOW,
            r#""sample_type": "depth""#,
            r#""sample_type": "unfilterable-float""#,
            "`depth` is not a `texture_2d<f32>`",
        ),
        (
            RESOLVE,
            r#""multisampled": true, "sample_type": "unfilterable-float", "components": 4, "layers": 1, "samples": 4"#,
            r#""multisampled": false, "sample_type": "unfilterable-float", "components": 4, "layers": 1, "samples": 1"#,
            "`color` is not a `texture_2d<f32>`",
        ),
        (TABLE, "vec3f", "vec4f", "type array<vec4f>"),
        (TABLE, r#""stride": 16"#, r#""stride": 12"#, "type array<vec3f>"),
        (TABLE, "weights", "heights", "where `heights` should be"),
    ];
    for (kernel, from, to, wanted) in cases {
        let Fixture { manifest, wgsl } = kernel.emit(Stage::Compute);
        // A depth has one component.
        let manifest = edit(&manifest, from, to);
        let manifest = match to {
            r#""depth""# => edit(&manifest, r#""components": 4"#, r#""components": 1"#),
            _ => manifest,
        };
        let (error, message) = refuse_making(&gpu, &manifest, &wgsl);
        assert!(matches!(error, Error::Mismatch { .. }), "{message}");
        assert!(message.contains(wanted), "{message}");
    }
    // A buffer that the shader could write is another one.
    let Fixture { manifest, wgsl } = TABLE.emit(Stage::Compute);
    let (error, message) = refuse_making(&gpu, &manifest, &edit(&wgsl, "storage, read>", "storage, read_write>"));
    assert!(
        matches!(error, Error::Mismatch { .. }) && message.contains("var<storage, read>"),
        "{message}"
    );
}

#[test]
fn a_sampler_on_a_texture_that_the_manifest_calls_unfilterable() {
    let gpu = Gpu::new();
    for stage in STAGES {
        let Fixture { manifest, wgsl } = SCALE.emit(stage);
        let (error, message) = refuse_making(&gpu, &edit(&manifest, r#""float""#, r#""unfilterable-float""#), &wgsl);
        assert!(matches!(error, Error::Pipeline { .. }), "{message}");
    }
}
