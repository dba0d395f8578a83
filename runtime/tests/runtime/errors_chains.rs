//! Chains that do not fit their shaders, resources or device are errors that name the pass and the picture.

use crate::common::{self, chains, ramp, view};

use chains::{BLEND, DOWN, MORE, color_size, four, glow, make, make_of, pass, picture, plan, sizes, split};
use common::{ADD, COPY, Fixture, Gpu, SCALE, STAGES, Stage};
use straightline_runtime::manifest::Format;
use straightline_runtime::manifest::chain::{ChainPlan, SizeOp};
use straightline_runtime::{BindOptions, Chain, ChainProblem, Error, PassOptions, Region, Resource, ViewProblem, wgpu};
use wgpu::{TextureFormat, TextureUsages, TextureView};

const SIZE: [u32; 2] = [9, 5];

fn glow_chain(gpu: &Gpu) -> Chain {
    make_of(gpu, &glow(), &[&DOWN, &BLEND], Stage::Compute).expect("a chain")
}

fn input(gpu: &Gpu, size: [u32; 2]) -> TextureView {
    view(&gpu.upload(size, 1, &ramp(size, 1)))
}

/// The error of binding `chain` to `color` and `out`.
fn refuse(chain: &Chain, color: &TextureView, out: &TextureView) -> Error {
    chain.bind(&[("color", color)], out).expect_err("a refusal")
}

#[test]
fn plans_and_shaders_must_fit() {
    type Break = fn(&mut ChainPlan);
    let gpu = Gpu::new();
    let refuse = |change: Break, shaders: &[(&str, Fixture)]| {
        let mut plan = glow();
        change(&mut plan);
        let error = make(&gpu, &plan, shaders, &PassOptions::default()).expect_err("a refusal");
        assert!(matches!(error, Error::Chain { .. }), "{error}");
        error.to_string()
    };
    let both = || {
        [
            ("down", DOWN.emit(Stage::Compute)),
            ("blend", BLEND.emit(Stage::Compute)),
        ]
    };
    let cases: [(Break, &str); 8] = [
        (|p| p.schema = 7, "schema: 7, but this reader knows schema 1"),
        (
            |p| p.pictures.to_mut()[1].memory = Some(1),
            "pictures: none is a result",
        ),
        (
            |p| p.passes.to_mut()[0].shader = "none".into(),
            "shader `down`: is given, and no pass has it",
        ),
        (
            |p| p.passes.to_mut()[1].reads.to_mut().truncate(1),
            "pass `out`: its shader `blend` reads `small`, and nothing is given for it",
        ),
        (
            |p| {
                let reads = p.passes.to_mut()[0].reads.to_mut();
                reads.push(reads[0].clone());
                reads[1].name = "more".into();
            },
            "pass `half`: reads `more`, but its shader `down` reads `big`",
        ),
        (
            |p| {
                let half = p.pictures[0].clone();
                p.pictures.to_mut().push(half);
                p.pictures.to_mut()[2].name = "second".into();
                p.pictures.to_mut()[2].memory = None;
                p.passes.to_mut()[0].writes.to_mut().push("second".into());
            },
            "pass `half`: pictures written: 2, outputs of its shader `down`: 1",
        ),
        (
            |p| p.pictures.to_mut()[0].format = Format::Rgba16Float,
            "pass `half`, which writes `half`: `down` cannot draw to Rgba16Float",
        ),
        (
            |p| p.pictures.to_mut()[0].format = Format::Rgba32Uint,
            "pass `out`, which reads `half` as `small`: input `small` of `blend`: is Rgba32Uint, which cannot be read as floats",
        ),
    ];
    for (change, wanted) in cases {
        let error = refuse(change, &both());
        assert!(error.starts_with(&format!("chain `chain`: {wanted}")), "{error}");
    }
    let [down, _] = both();
    let error = refuse(|_| {}, &[down]);
    let wanted = "chain `chain`: pass `out`: its shader `blend` is not given; given: `down`";
    assert!(error.starts_with(wanted), "{error}");
    let [[down, blend], [again, _]] = [both(), both()];
    let error = refuse(|_| {}, &[down, blend, again]);
    assert!(
        error.starts_with("chain `chain`: shader `down`: is given twice"),
        "{error}"
    );
}

#[test]
fn an_input_is_of_one_kind_and_a_uniform_of_one_type() {
    let gpu = Gpu::new();
    let [full, half] = sizes();
    let refuse = |plan: &ChainPlan, shaders: &[(&str, Fixture)]| {
        let error = make(&gpu, plan, shaders, &PassOptions::default());
        error.expect_err("a refusal").to_string()
    };
    let scale = || ("scale", SCALE.emit(Stage::Compute));
    // `color` gives its size, so that it is a texture.
    let one = plan(
        &["color", "other"],
        vec![picture("out", &half, None)],
        vec![pass("scale", &[("small", "other"), ("linear", "color")], &["out"])],
    );
    let error = refuse(&one, &[scale()]);
    let wanted = "chain `chain`: input `color`: is a texture, but pass `out` reads it as a sampler";
    assert!(error.starts_with(wanted), "{error}");
    let two = plan(
        &["color"],
        vec![picture("texels", &half, Some(0)), picture("out", &full, None)],
        vec![
            pass("copy", &[("color", "color")], &["texels"]),
            pass("scale", &[("small", "color"), ("linear", "texels")], &["out"]),
        ],
    );
    let error = refuse(&two, &[("copy", COPY.emit(Stage::Compute)), scale()]);
    let wanted = "chain `chain`: pass `out`: reads picture `texels` as `linear`, which is no texture";
    assert!(error.starts_with(wanted), "{error}");
    let Fixture { manifest, wgsl } = ADD.emit(Stage::Compute);
    let typed = Fixture {
        manifest: manifest.replace(
            r#""type": "i32", "offset": 20, "size": 4, "default": -3"#,
            r#""type": "u32", "offset": 20, "size": 4"#,
        ),
        wgsl: wgsl.replace("steps: i32", "steps: u32"),
    };
    let mut three = four();
    for (pass, shader) in three.passes.to_mut().iter_mut().zip(["add", "typed", "add", "add"]) {
        pass.shader = shader.into();
    }
    let error = refuse(&three, &[("add", ADD.emit(Stage::Compute)), ("typed", typed)]);
    let wanted = "chain `chain`: uniform `steps`: is of type i32, but of type u32 in pass `b`";
    assert!(error.starts_with(wanted), "{error}");
}

#[test]
fn formats_are_those_of_results() {
    let gpu = Gpu::new();
    let make = |plan: &ChainPlan, shaders: &[(&str, Fixture)], options: PassOptions| {
        make(&gpu, plan, shaders, &options).expect_err("a refusal").to_string()
    };
    let fragment = || {
        [
            ("down", DOWN.emit(Stage::Fragment)),
            ("blend", BLEND.emit(Stage::Fragment)),
        ]
    };
    let half = PassOptions::default().format_of("half", TextureFormat::Rgba8Unorm);
    let error = make(&glow(), &fragment(), half);
    assert_eq!(
        error,
        "`chain` cannot draw to Rgba8Unorm: it writes no `half`; it writes `out`"
    );
    let integers = PassOptions::default().target_format(TextureFormat::R32Uint);
    let error = make(&glow(), &fragment(), integers);
    let wanted = "chain `chain`: pass `out`, which writes `out`: `blend` cannot draw to R32Uint";
    assert!(error.starts_with(wanted), "{error}");
    let [full, _] = sizes();
    let two = plan(
        &["color"],
        vec![picture("low", &full, None), picture("high", &full, None)],
        vec![pass("split", &[("color", "color")], &["low", "high"])],
    );
    let one = PassOptions::default().target_format(TextureFormat::Rgba8Unorm);
    let error = make(&two, &[("split", split(Stage::Fragment))], one);
    assert!(
        error.contains("it writes `low` and `high`: say with `format_of`"),
        "{error}"
    );
}

#[test]
fn names_are_checked_both_ways() {
    let gpu = Gpu::new();
    let chain = glow_chain(&gpu);
    let (color, target, sampler) = (input(&gpu, SIZE), view(&gpu.target(SIZE)), gpu.sampler(None));
    let refuse = |inputs: &[(&str, &TextureView)]| chain.bind(inputs, &target).expect_err("a refusal").to_string();
    assert_eq!(refuse(&[]), "`chain` was not given its input `color`; it reads `color`");
    let unknown = refuse(&[("color", &color), ("colour", &color)]);
    assert_eq!(unknown, "`chain` has no input `colour`; it reads `color`");
    let twice = refuse(&[("color", &color), ("color", &color)]);
    assert_eq!(twice, "`chain` was given its input `color` more than once");
    let kind = chain
        .bind(&[("color", Resource::from(&sampler))], &target)
        .expect_err("a refusal");
    assert!(matches!(kind, Error::InputKind { .. }), "{kind}");
    let none = chain.sizes(&[] as &[(&str, Resource<'_>)]).expect_err("a refusal");
    assert!(matches!(none, Error::MissingInput { .. }), "{none}");

    let refuse = |targets: &[(&str, &TextureView)]| {
        chain
            .bind(&[("color", &color)], targets)
            .expect_err("a refusal")
            .to_string()
    };
    assert_eq!(refuse(&[]), "`chain` was not given the target `out`; it writes `out`");
    let unknown = refuse(&[("out", &target), ("half", &target)]);
    assert_eq!(unknown, "`chain` has no target `half`; it writes `out`");
}

#[test]
fn targets_have_the_sizes_of_the_rules() {
    let gpu = Gpu::new();
    let chain = glow_chain(&gpu);
    let error = refuse(&chain, &input(&gpu, SIZE), &view(&gpu.target([9, 6])));
    assert_eq!(
        error.to_string(),
        "chain `chain`: target `out` is 9x6, but the chain writes 9x5 there, by the size `color.size()`: `Chain::sizes` returns the \
         size that is needed"
    );
    let mut small = glow();
    small.pictures.to_mut()[1].size = color_size(Some((SizeOp::Mul, 2)));
    small.passes.to_mut()[1] = pass("down", &[("big", "half")], &["out"]);
    let chain = make_of(&gpu, &small, &[&DOWN], Stage::Fragment).expect("a chain");
    let error = refuse(&chain, &input(&gpu, SIZE), &view(&gpu.target(SIZE))).to_string();
    assert!(
        error.contains("is 9x5, but the chain writes 18x10 there, by the size `color.size() * 2`"),
        "{error}"
    );
}

#[test]
fn a_picture_fits_the_device() {
    let gpu = Gpu::new();
    let mut large = glow();
    large.pictures.to_mut()[0].size = color_size(Some((SizeOp::Mul, 4096)));
    let chain = make_of(&gpu, &large, &[&DOWN, &BLEND], Stage::Compute).expect("a chain");
    let (color, target) = (input(&gpu, SIZE), view(&gpu.target(SIZE)));
    let wanted = "chain `chain`: picture `half` is 36864x20480, by its size `color.size() * 4096`, but the device allows 8192 along a \
                  side";
    let bound = refuse(&chain, &color, &target).to_string();
    assert!(bound.starts_with(wanted), "{bound}");
    let sizes = chain.sizes(&[("color", &color)]).expect_err("a refusal").to_string();
    assert_eq!(bound, sizes);
    // More than a number holds.
    large.pictures.to_mut()[0].size = color_size(Some((SizeOp::Mul, u32::MAX)));
    let chain = make_of(&gpu, &large, &[&DOWN, &BLEND], Stage::Compute).expect("a chain");
    let error = refuse(&chain, &color, &target).to_string();
    assert!(error.contains("picture `half` is 4294967295x4294967295"), "{error}");
    // A size of 0 is 1.
    large.pictures.to_mut()[0].size = color_size(Some((SizeOp::Sub, 100)));
    let chain = make_of(&gpu, &large, &[&DOWN, &BLEND], Stage::Compute).expect("a chain");
    let found = chain.sizes(&[("color", &color)]).expect("sizes");
    assert_eq!(found[0], ("half", [1, 1]));
    chain.bind(&[("color", &color)], &target).expect("to bind");
}

#[test]
fn a_pass_that_cannot_be_bound_is_named() {
    let gpu = Gpu::new();
    let (color, target) = (input(&gpu, SIZE), view(&gpu.target(SIZE)));
    let mut unlike = glow();
    // `copy` reads at the pixel, so that its input has the target's size.
    unlike.passes.to_mut()[1] = pass("copy", &[("color", "half")], &["out"]);
    for stage in STAGES {
        let chain = make_of(&gpu, &unlike, &[&DOWN, &COPY], stage).expect("a chain");
        let error = refuse(&chain, &color, &target);
        assert_eq!(
            error.to_string(),
            "chain `chain`: pass `out`, which reads `half` as `color`: input `color` of `copy`: is 4x2, but the target is 9x5: this \
             input has the size of the target"
        );
        let Error::Chain {
            problem: ChainProblem::Pass { pass, error, .. },
            ..
        } = error
        else {
            panic!("not about a pass: {error}");
        };
        assert_eq!(pass, "out");
        assert!(
            matches!(
                *error,
                Error::Input {
                    problem: ViewProblem::Size { .. },
                    ..
                }
            ),
            "{error}"
        );
        // A target of the caller's, and an input under the name of the chain.
        let chain = make_of(&gpu, &glow(), &[&DOWN, &BLEND], stage).expect("a chain");
        let sampled = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba32Float, TextureUsages::TEXTURE_BINDING));
        let error = refuse(&chain, &color, &sampled).to_string();
        let wanted =
            "chain `chain`: pass `out`, which writes `out`: target of `blend`: its texture was created without";
        assert!(error.starts_with(wanted), "{error}");
        let integers = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba8Uint, TextureUsages::TEXTURE_BINDING));
        let error = refuse(&chain, &integers, &target).to_string();
        let wanted = "chain `chain`: pass `half`, which reads `color` as `big`: input `big` of `down`: is Rgba8Uint";
        assert!(error.starts_with(wanted), "{error}");
    }
}

#[test]
fn nothing_is_read_after_it_is_overwritten() {
    let gpu = Gpu::new();
    let chain = glow_chain(&gpu);
    let both = view(&gpu.target(SIZE));
    let error = refuse(&chain, &both, &both);
    assert!(
        error
            .to_string()
            .starts_with("input `color` of `chain`: is the target itself"),
        "{error}"
    );
    // Read in a later pass than the one that writes.
    let [full, _] = sizes();
    let later = plan(
        &["color"],
        vec![picture("first", &full, None), picture("second", &full, None)],
        vec![
            pass("copy", &[("color", "color")], &["first"]),
            pass("more", &[("color", "color")], &["second"]),
        ],
    );
    let chain = make_of(&gpu, &later, &[&COPY, &MORE], Stage::Compute).expect("a chain");
    let [one, two] = [view(&gpu.target(SIZE)), view(&gpu.target(SIZE))];
    let bind = |color, first, second| chain.bind(&[("color", color)], &[("first", first), ("second", second)]);
    let error = bind(&one, &one, &two).expect_err("a refusal");
    assert!(
        error
            .to_string()
            .starts_with("input `color` of `chain`: is the target itself"),
        "{error}"
    );
    let error = bind(&input(&gpu, SIZE), &one, &one).expect_err("a refusal").to_string();
    assert_eq!(
        error,
        "target `second` of `chain`: is the target `first` too: give each a texture of its own"
    );
}

#[test]
fn uniforms_and_options_that_no_pass_has() {
    let gpu = Gpu::new();
    let mut adding = four();
    for pass in &mut adding.passes.to_mut()[2..] {
        pass.shader = "add".into();
    }
    let chain = make_of(&gpu, &adding, &[&MORE, &ADD], Stage::Compute).expect("a chain");
    let (color, target) = (input(&gpu, SIZE), view(&gpu.target(SIZE)));
    let bind = |options: &BindOptions<'_>| chain.bind_with(&[("color", &color)], &target, options);
    let refuse = |options: BindOptions<'_>| bind(&options).expect_err("a refusal").to_string();
    let options = || BindOptions::default().uniform("offset", [0.0; 4]);
    let unset = refuse(BindOptions::default());
    let wanted =
        "chain `chain`: pass `c`: uniform `offset` of `add` has no default: give it a value when the pass is bound";
    assert!(unset.starts_with(wanted), "{unset}");
    let unknown = "`chain` has no uniform `tau`; it has `offset`, `scale` and `steps`";
    assert_eq!(refuse(options().uniform("tau", 1.0)), unknown);
    let typed = "uniform `scale` of `chain` is of type f32, but was given a value of type i32";
    assert_eq!(refuse(options().uniform("scale", 1)), typed);
    let bound = bind(&options()).expect("to bind");
    let late = |error: Result<(), Error>| error.expect_err("a refusal").to_string();
    assert_eq!(late(bound.write_uniform(&gpu.queue, "tau", 1.0)), unknown);
    assert_eq!(late(bound.write_uniform(&gpu.queue, "scale", 1)), typed);
    let region = refuse(options().region(Region::at([0, 0], [1, 1])));
    assert!(region.contains("it filters whole images"), "{region}");
    let bytes = refuse(options().uniforms(&[0; 32]));
    assert!(bytes.contains("give values by name"), "{bytes}");
}

#[test]
fn a_lost_device_is_no_error_of_a_pass() {
    let gpu = Gpu::new();
    let chain = glow_chain(&gpu);
    let (color, target) = (input(&gpu, SIZE), view(&gpu.target(SIZE)));
    gpu.device.destroy();
    let error = refuse(&chain, &color, &target);
    assert!(matches!(error, Error::DeviceLost { .. }), "{error}");
    let error = make_of(&gpu, &glow(), &[&DOWN, &BLEND], Stage::Compute).expect_err("a lost device");
    assert!(matches!(error, Error::DeviceLost { .. }), "{error}");
}
