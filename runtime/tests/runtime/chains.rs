//! Chains: the pictures of all passes, by the shaders' definitions.

use crate::common::{self, chains, ramp, view};

use chains::{BLEND, DOWN, MORE, color_size, four, glow, make, make_of, pass, picture, plan, sizes, split};
use common::{ADD, Fixture, Gpu, Kernel, SCALE, STAGES, Stage, TABLE};
use straightline_runtime::manifest::Format;
use straightline_runtime::manifest::chain::{ChainPlan, SizeOp, SizeRule, SizeTerm};
use straightline_runtime::{BindOptions, BoundChain, Chain, PassOptions, Resource, Timer, wgpu};
use wgpu::{TextureFormat, TextureUsages};

const SIZES: [[u32; 2]; 6] = [[1, 1], [1, 7], [7, 1], [8, 8], [9, 16], [33, 17]];

pub fn run(gpu: &Gpu, bound: &BoundChain) {
    let mut encoder = gpu.encoder();
    bound.encode(&mut encoder);
    gpu.submit(encoder);
}

/// `pixels` with a function of each component.
fn each(pixels: &[[f32; 4]], change: impl Fn(f32) -> f32) -> Vec<[f32; 4]> {
    pixels.iter().map(|pixel| pixel.map(&change)).collect()
}

/// The picture of `glow`.
pub fn glowing(size: [u32; 2]) -> Vec<[f32; 4]> {
    let color = ramp(size, 1);
    let [width, height] = size.map(|side| side as usize);
    let [across, down] = [width, height].map(|side| (side / 2).max(1));
    let texel = |x: usize, y: usize| color[y.min(height - 1) * width + x.min(width - 1)];
    let places = (0..width * height).map(|k| (k % width, k / width));
    let pixel = |(x, y): (usize, usize)| {
        let covering = texel(2 * (x / 2).min(across - 1), 2 * (y / 2).min(down - 1));
        [0, 1, 2, 3].map(|c| texel(x, y)[c] + covering[c])
    };
    places.map(pixel).collect()
}

#[test]
fn passes_of_different_sizes() {
    let gpu = Gpu::new();
    for stage in STAGES {
        let chain = make_of(&gpu, &glow(), &[&DOWN, &BLEND], stage).expect("a chain");
        assert_eq!(chain.name(), "chain");
        assert_eq!(chain.inputs().collect::<Vec<_>>(), ["color"]);
        assert_eq!(
            chain.targets().collect::<Vec<_>>(),
            [("out", TextureFormat::Rgba32Float)]
        );
        for size in SIZES {
            let color = view(&gpu.upload(size, 1, &ramp(size, 1)));
            let half = size.map(|side| (side / 2).max(1));
            let found = chain.sizes(&[("color", &color)]).expect("sizes");
            assert_eq!(found, [("half", half), ("out", size)]);
            let target = gpu.target(size);
            let bound = chain.bind(&[("color", &color)], &view(&target)).expect("to bind");
            assert_eq!(bound.bytes(), u64::from(half[0] * half[1] * 16));
            assert_eq!(bound.passes().collect::<Vec<_>>(), ["half", "out"]);
            let owned = bound.picture("half").expect("a picture").texture();
            assert_eq!([owned.width(), owned.height()], half);
            assert!(bound.picture("color").is_none());
            run(&gpu, &bound);
            assert_eq!(gpu.download(&target), glowing(size), "{stage:?} {size:?}");
        }
    }
}

#[test]
fn pictures_share_memory_and_passes_a_shader() {
    let gpu = Gpu::new();
    let size = [9, 5];
    let color = ramp(size, 1);
    let input = view(&gpu.upload(size, 1, &color));
    for stage in STAGES {
        let chain = make_of(&gpu, &four(), &[&MORE], stage).expect("a chain");
        let target = gpu.target(size);
        let bound = chain.bind(&[("color", &input)], &view(&target)).expect("to bind");
        assert_eq!(bound.bytes(), 2 * 9 * 5 * 16);
        let texture = |name: &str| bound.picture(name).expect("a picture").texture();
        assert_eq!(texture("a"), texture("c"));
        assert_ne!(texture("a"), texture("b"));
        assert_eq!(texture("out"), &target);
        assert_eq!(
            bound.pictures().map(|(name, _)| name).collect::<Vec<_>>(),
            ["a", "b", "c", "out"]
        );
        run(&gpu, &bound);
        assert_eq!(gpu.download(&target), each(&color, |value| value + 4.0), "{stage:?}");
        // At the end `a` has been overwritten; until its pass it is there.
        assert_eq!(
            gpu.download(texture("a")),
            each(&color, |value| value + 3.0),
            "{stage:?}"
        );
        let mut encoder = gpu.encoder();
        let view = bound.encode_until(&mut encoder, "a").expect("a picture");
        gpu.submit(encoder);
        assert_eq!(
            gpu.download(view.texture()),
            each(&color, |value| value + 1.0),
            "{stage:?}"
        );
        assert!(bound.encode_until(&mut gpu.encoder(), "color").is_none());
    }
}

#[test]
fn stages_mix_in_one_texture() {
    let gpu = Gpu::new();
    let size = [9, 5];
    let color = ramp(size, 1);
    let mut mixed = four();
    for number in [0, 3] {
        mixed.passes.to_mut()[number].shader = "drawn".into();
    }
    let shaders = [
        ("more", MORE.emit(Stage::Compute)),
        ("drawn", MORE.emit(Stage::Fragment)),
    ];
    let chain = make(&gpu, &mixed, &shaders, &PassOptions::default()).expect("a chain");
    let target = gpu.target(size);
    let input = view(&gpu.upload(size, 1, &color));
    let bound = chain.bind(&[("color", &input)], &view(&target)).expect("to bind");
    run(&gpu, &bound);
    assert_eq!(gpu.download(&target), each(&color, |value| value + 4.0));
    let usage = bound.picture("a").expect("a picture").texture().usage();
    assert!(usage.contains(TextureUsages::STORAGE_BINDING | TextureUsages::RENDER_ATTACHMENT));
    let usage = bound.picture("b").expect("a picture").texture().usage();
    assert!(!usage.contains(TextureUsages::RENDER_ATTACHMENT));
}

#[test]
fn a_uniform_goes_to_all_passes_that_have_it() {
    let gpu = Gpu::new();
    let size = [5, 3];
    let color = ramp(size, 1);
    let input = view(&gpu.upload(size, 1, &color));
    let [full, _] = sizes();
    let plan = plan(
        &["color"],
        vec![
            picture("first", &full, Some(0)),
            picture("same", &full, Some(1)),
            picture("out", &full, None),
        ],
        vec![
            pass("add", &[("color", "color")], &["first"]),
            pass("more", &[("color", "first")], &["same"]),
            pass("add", &[("color", "same")], &["out"]),
        ],
    );
    let wanted = |offset: f32, scale: f32, steps: f32| {
        let add = |value: f32| value * scale + offset + steps;
        each(&color, |value| add(add(value) + 1.0))
    };
    for stage in STAGES {
        let chain = make_of(&gpu, &plan, &[&ADD, &MORE], stage).expect("a chain");
        let target = gpu.target(size);
        let options = BindOptions::default().uniform("offset", [2.0; 4]).uniform("steps", 1);
        let bound = chain
            .bind_with(&[("color", &input)], &view(&target), &options)
            .expect("to bind");
        run(&gpu, &bound);
        assert_eq!(gpu.download(&target), wanted(2.0, 2.0, 1.0), "{stage:?}");
        bound.write_uniform(&gpu.queue, "scale", 0.5).expect("an f32");
        bound.write_uniform(&gpu.queue, "offset", [4.0; 4]).expect("a vec4f");
        run(&gpu, &bound);
        assert_eq!(gpu.download(&target), wanted(4.0, 0.5, 1.0), "{stage:?}");
    }
}

#[test]
fn results_go_to_targets_by_name() {
    let gpu = Gpu::new();
    let size = [9, 5];
    let color = ramp(size, 1);
    let input = view(&gpu.upload(size, 1, &color));
    let [full, _] = sizes();
    // `low` is a result that a later pass reads; `high` shares a pass with it and is not one.
    let plan = plan(
        &["color"],
        vec![
            picture("low", &full, None),
            picture("high", &full, Some(0)),
            picture("sum", &full, None),
        ],
        vec![
            pass("split", &[("color", "color")], &["low", "high"]),
            pass("blend", &[("color", "low"), ("small", "high")], &["sum"]),
        ],
    );
    for stage in STAGES {
        let shaders = [("split", split(stage)), ("blend", BLEND.emit(stage))];
        let chain = make(&gpu, &plan, &shaders, &PassOptions::default()).expect("a chain");
        let [low, sum] = [gpu.target(size), gpu.target(size)];
        let targets = [("sum", &view(&sum)), ("low", &view(&low))];
        let bound = chain.bind(&[("color", &input)], &targets).expect("to bind");
        run(&gpu, &bound);
        assert_eq!(gpu.download(&low), color, "{stage:?}");
        let texel = |x: usize, y: usize| color[y * 9 + x];
        let wanted: Vec<[f32; 4]> = (0..45)
            .map(|k| [0, 1, 2, 3].map(|c| color[k][c] + 2.0 * texel(k % 9 / 2, k / 9 / 2)[c]))
            .collect();
        assert_eq!(gpu.download(&sum), wanted, "{stage:?}");
    }
}

/// `weights`, as two texels in half floats, and filtered over four pixels.
fn filtered(format: Format) -> ChainPlan {
    let number = |size: [u32; 2]| SizeRule(vec![SizeTerm::Number(size)].into());
    let mut plan = plan(
        &["weights", "sampler"],
        vec![
            picture("texels", &number([2, 1]), Some(0)),
            picture("out", &number([4, 1]), None),
        ],
        vec![
            pass("table", &[("weights", "weights")], &["texels"]),
            pass("scale", &[("small", "texels"), ("linear", "sampler")], &["out"]),
        ],
    );
    plan.pictures.to_mut()[0].format = format;
    plan
}

/// `TABLE` for texels of `format`.
fn table(stage: Stage, format: Format) -> Fixture {
    let Fixture { manifest, wgsl } = TABLE.emit(stage);
    let change = |text: String| text.replace("rgba32float", format.wgsl_name());
    Fixture {
        manifest: change(manifest),
        wgsl: change(wgsl),
    }
}

#[test]
fn buffers_and_samplers_are_inputs() {
    let all = Gpu::with(wgpu::Features::FLOAT32_FILTERABLE, wgpu::Limits::default());
    let plain = Gpu::new();
    for (gpu, format) in [(&plain, Format::Rgba16Float), (&all, Format::Rgba32Float)] {
        for stage in STAGES {
            let shaders = [("table", table(stage, format)), ("scale", SCALE.emit(stage))];
            let chain = make(gpu, &filtered(format), &shaders, &PassOptions::default()).expect("a chain");
            let weights = gpu.storage(&[0.0, 1.0, 2.0, 0.0, 4.0, 5.0, 6.0, 0.0]);
            let sampler = gpu.sampler(None);
            let target = gpu.target([4, 1]);
            let inputs = [("sampler", Resource::from(&sampler)), ("weights", (&weights).into())];
            let bound = chain.bind(&inputs, &view(&target)).expect("to bind");
            run(gpu, &bound);
            let found: Vec<f32> = gpu.download(&target).iter().map(|pixel| pixel[0]).collect();
            assert_eq!(found, [0.0, 1.0, 3.0, 4.0], "{stage:?} {format}");
        }
    }
    let shaders = [
        ("table", TABLE.emit(Stage::Compute)),
        ("scale", SCALE.emit(Stage::Compute)),
    ];
    let error = make(
        &plain,
        &filtered(Format::Rgba32Float),
        &shaders,
        &PassOptions::default(),
    );
    let error = error.expect_err("floats that cannot be filtered").to_string();
    let wanted = "chain `chain`: pass `out`, which reads `texels` as `small`: input `small` of `scale`: is Rgba32Float, which this \
                  device cannot filter";
    assert!(
        error.starts_with(wanted) && error.contains("FLOAT32_FILTERABLE"),
        "{error}"
    );
}

#[test]
fn a_resized_chain_keeps_textures_of_the_same_size() {
    let gpu = Gpu::new();
    // `half` has the same size for both widths, `copy` has not.
    let [full, half] = sizes();
    let plan = plan(
        &["color"],
        vec![
            picture("half", &half, Some(0)),
            picture("copy", &full, Some(1)),
            picture("out", &full, None),
        ],
        vec![
            pass("down", &[("big", "color")], &["half"]),
            pass("blend", &[("color", "color"), ("small", "half")], &["copy"]),
            pass("more", &[("color", "copy")], &["out"]),
        ],
    );
    for stage in STAGES {
        let chain = make_of(&gpu, &plan, &[&DOWN, &BLEND, &MORE], stage).expect("a chain");
        let other = make_of(&gpu, &plan, &[&DOWN, &BLEND, &MORE], stage).expect("a chain");
        let bind = |chain: &Chain, size: [u32; 2], old: Option<BoundChain>| {
            let input = view(&gpu.upload(size, 1, &ramp(size, 1)));
            let target = gpu.target(size);
            let (inputs, targets) = ([("color", &input)], view(&target));
            let bound = match old {
                None => chain.bind(&inputs, &targets),
                Some(old) => chain.rebind(old, &inputs, &targets, &BindOptions::default()),
            };
            let bound = bound.expect("to bind");
            // Not waited for: the next size is bound while this one runs.
            run(&gpu, &bound);
            (bound, target)
        };
        let owned =
            |bound: &BoundChain| ["half", "copy"].map(|name| bound.picture(name).expect("one").texture().clone());
        let (first, early) = bind(&chain, [8, 6], None);
        let before = owned(&first);
        let (second, late) = bind(&chain, [9, 7], Some(first));
        let after = owned(&second);
        assert_eq!(before[0], after[0]);
        assert_ne!(before[1], after[1]);
        assert_eq!(
            gpu.download(&early),
            each(&glowing([8, 6]), |value| value + 1.0),
            "{stage:?}"
        );
        assert_eq!(
            gpu.download(&late),
            each(&glowing([9, 7]), |value| value + 1.0),
            "{stage:?}"
        );
        // Textures of another chain may differ in more than their size.
        let (third, target) = bind(&other, [9, 7], Some(second));
        assert!(owned(&third).iter().zip(&after).all(|(own, other)| own != other));
        assert_eq!(
            gpu.download(&target),
            each(&glowing([9, 7]), |value| value + 1.0),
            "{stage:?}"
        );
    }
}

#[test]
fn a_target_is_an_input_that_was_read_before() {
    let gpu = Gpu::new();
    let size = [9, 5];
    for stage in STAGES {
        let chain = make_of(&gpu, &four(), &[&MORE], stage).expect("a chain");
        let color = gpu.target(size);
        let bound = chain.bind(&[("color", &view(&color))], &view(&color)).expect("to bind");
        for _ in 0..3 {
            run(&gpu, &bound);
        }
        assert_eq!(gpu.download(&color), vec![[12.0; 4]; 45], "{stage:?}");
    }
}

#[test]
fn a_result_has_the_format_that_is_asked_for() {
    let gpu = Gpu::new();
    let size = [3, 2];
    let options = PassOptions::default().target_format(TextureFormat::Bgra8Unorm);
    let chain = make(&gpu, &four(), &[("more", MORE.emit(Stage::Fragment))], &options).expect("a chain");
    assert_eq!(
        chain.targets().collect::<Vec<_>>(),
        [("out", TextureFormat::Bgra8Unorm)]
    );
    let color = view(&gpu.upload(size, 1, &[[-4.0, -3.5, -3.0, -3.0]; 6]));
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
    let target = gpu.texture(size, 1, TextureFormat::Bgra8Unorm, usage);
    run(
        &gpu,
        &chain.bind(&[("color", &color)], &view(&target)).expect("to bind"),
    );
    assert_eq!(gpu.download_bytes(&target)[..4], [255, 128, 0, 255]);
}

#[test]
fn each_pass_is_timed() {
    let gpu = Gpu::with(wgpu::Features::TIMESTAMP_QUERY, wgpu::Limits::default());
    let size = [8, 8];
    let chain = make_of(&gpu, &four(), &[&MORE], Stage::Compute).expect("a chain");
    let (color, target) = (view(&gpu.upload(size, 1, &ramp(size, 1))), gpu.target(size));
    let bound = chain.bind(&[("color", &color)], &view(&target)).expect("to bind");
    let mut small = Timer::new(&gpu.device, &gpu.queue, 3).expect("a timer");
    let mut encoder = gpu.encoder();
    let error = bound.encode_timed(&mut encoder, &mut small).expect_err("no room");
    assert!(error.to_string().contains("the timer's 3 spans"), "{error}");
    gpu.submit(encoder);
    assert_eq!(gpu.download(&target), [[0.0; 4]; 64]);
    let mut timer = Timer::new(&gpu.device, &gpu.queue, 4).expect("a timer");
    let mut encoder = gpu.encoder();
    bound.encode_timed(&mut encoder, &mut timer).expect("to encode");
    timer.resolve(&mut encoder).expect("to resolve");
    gpu.submit(encoder);
    assert_eq!(timer.read().expect("timestamps").len(), 4);
    assert_eq!(gpu.download(&target), each(&ramp(size, 1), |value| value + 4.0));
}

#[test]
fn sizes_follow_several_terms() {
    let gpu = Gpu::new();
    let mut plan = glow();
    // A column more than half.
    let mut terms = color_size(Some((SizeOp::Div, 2))).0.into_owned();
    terms.extend([SizeTerm::Number([1, 0]), SizeTerm::Apply(SizeOp::Add)]);
    plan.pictures.to_mut()[0].size = SizeRule(terms.into());
    let chain = make_of(&gpu, &plan, &[&DOWN, &BLEND], Stage::Compute).expect("a chain");
    let color = view(&gpu.upload([5, 1], 1, &ramp([5, 1], 1)));
    let found = chain.sizes(&[("color", &color)]).expect("sizes");
    assert_eq!(found, [("half", [3, 1]), ("out", [5, 1])]);
}

/// The target's size, and the diagonal of a matrix.
const RESOLUTION: Kernel = Kernel {
    name: "extent",
    bindings: &[
        COLOR_OF_ANY_SIZE,
        r#"{"group": 0, "binding": 1, "name": "params", "type": "uniform", "buffer_type": "uniform", "size": 32, "fields": [
        {"name": "resolution", "type": "vec2u", "offset": 0, "size": 8, "frame_size": true},
        {"name": "grade_0", "type": "vec2f", "offset": 8, "size": 8, "part": {"of": "grade", "type": "mat2x2f", "index": 0}},
        {"name": "grade_1", "type": "vec2f", "offset": 16, "size": 8, "part": {"of": "grade", "type": "mat2x2f", "index": 1}}]}"#,
    ],
    declarations: "struct Params { resolution: vec2u, grade_0: vec2f, grade_1: vec2f }
        @group(0) @binding(0) var color: texture_2d<f32>;
        @group(0) @binding(1) var<uniform> params: Params;",
    result: "vec4f(vec2f(params.resolution), params.grade_0.x, params.grade_1.y) + 0.0 * textureLoad(color, vec2i(0), 0)",
};
const COLOR_OF_ANY_SIZE: &str = r#"{"group": 0, "binding": 0, "name": "color", "type": "texture",
    "view_dimension": "2d", "multisampled": false, "sample_type": "unfilterable-float", "components": 4, "layers": 1, "samples": 1,
    "extent": "any"}"#;

#[test]
fn each_pass_has_its_own_resolution_and_all_the_same_matrix() {
    let gpu = Gpu::new();
    let [full, half] = sizes();
    let plan = plan(
        &["color"],
        vec![picture("half", &half, None), picture("out", &full, None)],
        vec![
            pass("extent", &[("color", "color")], &["half"]),
            pass("extent", &[("color", "half")], &["out"]),
        ],
    );
    for stage in STAGES {
        let chain = make_of(&gpu, &plan, &[&RESOLUTION], stage).expect("a chain");
        let color = view(&gpu.upload([6, 4], 1, &ramp([6, 4], 1)));
        let [half, out] = [gpu.target([3, 2]), gpu.target([6, 4])];
        let (inputs, targets) = ([("color", &color)], [view(&half), view(&out)]);
        let targets = [("half", &targets[0]), ("out", &targets[1])];
        let options = BindOptions::default().uniform("grade", [[5.0, 0.0], [0.0, 7.0]]);
        let bound = chain.bind_with(&inputs, &targets, &options).expect("to bind");
        run(&gpu, &bound);
        assert_eq!(gpu.download(&half), [[3.0, 2.0, 5.0, 7.0]; 6], "{stage:?}");
        assert_eq!(gpu.download(&out), [[6.0, 4.0, 5.0, 7.0]; 24], "{stage:?}");
        let error = bound.write_uniform(&gpu.queue, "resolution", [1u32, 1]);
        let error = error.expect_err("a size that follows from the targets").to_string();
        assert_eq!(error, "`chain` has no uniform `resolution`; it has `grade`");
        bound
            .write_uniform(&gpu.queue, "grade", [[1.0, 0.0], [0.0, 2.0]])
            .expect("a mat2x2f");
        run(&gpu, &bound);
        assert_eq!(gpu.download(&out)[0], [6.0, 4.0, 1.0, 2.0], "{stage:?}");
    }
}
