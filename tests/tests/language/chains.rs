//! Chains of passes: natively, by the interpreter, stored and fused, bit for bit.

use glam::{UVec2, Vec4, uvec2};
use std::path::Path;
use straightline_bench::execute::{Inputs, Written, interpret_chain, test_inputs};
use straightline_codegen::chain::{Chain, ChainSpec, CompiledChain, Fuse};
use straightline_codegen::{Format, ShaderSpec, Stage, Unroll};
use straightline_kernels::prelude::{Address, Filter, Frame, Sampler, Texture};
use straightline_tests::random::oracle::Rustc;
use straightline_tests::random::oracle::chains::compare_chains;

#[path = "../../../examples/chains/bloom.rs"]
mod bloom;

#[path = "../../chains/constructs.rs"]
mod constructs;

const CONSTRUCTS: &str = include_str!("../../chains/constructs.rs");

/// Sizes of frames: a single texel, rows, columns, odd and even sizes.
pub const SIZES: [UVec2; 6] = [
    uvec2(1, 1),
    uvec2(1, 9),
    uvec2(13, 1),
    uvec2(7, 5),
    uvec2(16, 16),
    uvec2(33, 18),
];

/// A picture with values between -1 and 3.
pub fn picture(size: UVec2) -> Vec<Vec4> {
    let mut state = 7_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 22) as f32 - 1.0
    };
    (0..size.x * size.y)
        .map(|_| Vec4::new(next(), next(), next(), next()))
        .collect()
}

fn linear() -> Sampler {
    Sampler {
        filter: Filter::Linear,
        address: Address::Clamp,
        ..Sampler::default()
    }
}

/// Description of a chain whose pictures keep all bits.
pub fn exact() -> ChainSpec {
    ChainSpec::from(ShaderSpec::new().format(Format::Rgba32Float)).pictures(Format::Rgba32Float)
}

/// Inputs of a chain that reads `color`.
pub fn inputs(size: UVec2) -> Inputs {
    Inputs::new(size).with_image("color", Frame::new(size, picture(size)))
}

fn texels(written: &[Written]) -> Vec<[u32; 4]> {
    let texels = written[0].texels.iter();
    texels
        .map(|texel| texel.map(|value| (value as f32).to_bits()))
        .collect()
}

/// Bits of a picture.
pub fn bits(of: &Texture<Vec4>) -> Vec<[u32; 4]> {
    of.texels()
        .iter()
        .map(|texel| texel.to_array().map(f32::to_bits))
        .collect()
}

type Native = fn(&Texture<Vec4>, &Sampler, f32) -> Texture<Vec4>;

const ALL: [(&str, Native); 11] = [
    ("separable", constructs::separable),
    ("pyramid", constructs::pyramid),
    ("values", constructs::values),
    ("choices", constructs::choices),
    ("calls", constructs::calls),
    ("ping_pong", constructs::ping_pong),
    ("kinds", constructs::kinds),
    ("sizes", constructs::sizes),
    ("named", constructs::named),
    ("repeated", constructs::repeated),
    ("frames", constructs::frames),
];

fn compile(name: &str, spec: &ChainSpec) -> CompiledChain {
    let chain = Chain::from_text("constructs.rs", CONSTRUCTS, name);
    chain
        .compile(spec)
        .unwrap_or_else(|errors| panic!("{name}: {}", errors.render(false)))
}

#[test]
fn every_construct_computes_the_bits_of_rust() {
    let mut looped = exact();
    looped.shader = looped.shader.unroll(Unroll::None);
    let specs = [exact(), exact().fuse(Fuse::All), exact().fuse(Fuse::Auto), looped];
    for (name, native) in ALL {
        for spec in &specs {
            let compiled = compile(name, spec);
            for size in SIZES {
                let color = Texture::new(size, picture(size));
                let expected = native(&color, &linear(), 0.75);
                let inputs = inputs(size).with_uniform("strength", &[0.75]);
                let found = interpret_chain::<f32>(&compiled, &inputs).unwrap_or_else(|e| panic!("{name}: {e}"));
                assert_eq!(found[0].size, expected.size(), "{name} at {size}");
                assert!(
                    texels(&found) == bits(&expected),
                    "{name} at {size}, fused {}",
                    spec.fuse
                );
            }
        }
    }
}

/// Passes of one text have two kernels if a picture is computed in one of them.
#[test]
fn a_fused_picture_leaves_other_passes_of_its_text_alone() {
    let compiled = compile("repeated", &exact().fuse(Fuse::inline(["current"])));
    assert_eq!(compiled.fused, ["current"]);
    let kernels: Vec<&str> = compiled.passes.iter().map(|pass| pass.kernel.as_str()).collect();
    assert!(kernels[0] != kernels[1] && kernels[1] == kernels[2], "{kernels:?}");
    for size in SIZES {
        let expected = constructs::repeated(&Texture::new(size, picture(size)), &linear(), 0.75);
        let inputs = inputs(size).with_uniform("strength", &[0.75]);
        let found = interpret_chain::<f32>(&compiled, &inputs).unwrap_or_else(|e| panic!("{e}"));
        assert!(texels(&found) == bits(&expected), "at {size}");
    }
}

/// The chains above fuse what can be: a list that shrinks is a fault of the pass or of the decision.
#[test]
fn pictures_that_are_read_at_single_places_are_fused() {
    let fused = |name: &str| compile(name, &exact().fuse(Fuse::All)).fused.join(" ");
    assert_eq!(fused("separable"), "rows");
    assert_eq!(fused("pyramid"), "first next");
    assert_eq!(fused("kinds"), "light pair counts signs three");
    assert_eq!(fused("frames"), "a b");
    // A pass of one read costs least where it is read, and sums of many reads where they are stored.
    let auto = compile("calls", &exact().fuse(Fuse::Auto));
    assert_eq!(auto.fused, ["rows_2"]);
    let kept = auto.kept.iter().find(|(name, _)| name == "rows").expect("a reason");
    assert!(kept.1.contains("reads of it cost less"), "{}", kept.1);
}

/// A pass that computes one picture in place of reading it costs what both do.
#[test]
fn what_is_fused_counts_for_the_pass_that_computes_it() {
    let text = "
        pub fn dear(color: &Texture<Vec4>) -> Texture<Vec4> {
            let dear: Texture<Vec4> = draw(color.size(), |pixel| {
                let mut sum = color.load(pixel);
                for k in 1..=20 {
                    sum = sum * sum + k as f32;
                }
                sum
            });
            let cheap: Texture<Vec4> = draw(color.size(), |pixel| 2.0 * dear.load(pixel));
            draw(color.size(), |pixel| cheap.load(pixel) + cheap.load(pixel + ivec2(1, 0)))
        }";
    let auto = |text: &str| {
        let compiled = Chain::from_text("dear.rs", text, "dear").compile(&exact().fuse(Fuse::Auto));
        compiled
            .unwrap_or_else(|errors| panic!("{}", errors.render(false)))
            .fused
    };
    assert_eq!(auto(text), ["dear"]);
    assert_eq!(auto(&text.replace("1..=20", "1..=1")), ["dear", "cheap"]);
}

#[test]
fn bloom_computes_the_bits_of_rust_with_every_option() {
    for levels in 1..=4 {
        let chain = Chain::from_text("bloom.rs", include_str!("../../../examples/chains/bloom.rs"), "bloom");
        let compile = |fuse: Fuse| {
            let mut spec = exact().fuse(fuse);
            spec.shader = spec.shader.set("levels", levels.to_string()).set("spread", "0.6");
            let compiled = chain.compile(&spec);
            compiled.unwrap_or_else(|errors| panic!("{}", errors.render(false)))
        };
        let (stored, shared) = (compile(Fuse::None), compile(Fuse::Share));
        assert_eq!(stored.passes.len(), 2 * levels as usize);
        assert!(shared.passes.len() <= levels as usize);
        let options = bloom::Bloom { levels, spread: 0.6 };
        for size in SIZES {
            let color = Texture::new(size, picture(size));
            let expected = bloom::bloom(&options, &color, 0.5, 0.3);
            let inputs = inputs(size)
                .with_uniform("threshold", &[0.5])
                .with_uniform("strength", &[0.3]);
            for compiled in [&stored, &shared] {
                let found = interpret_chain::<f32>(compiled, &inputs).unwrap_or_else(|e| panic!("{e}"));
                assert!(
                    texels(&found) == bits(&expected),
                    "{levels} levels at {size}, fused {}",
                    compiled.fused.len()
                );
            }
        }
    }
}

/// The first example of the page is a chain, of as many passes as the page says.
#[test]
fn the_page_shows_a_chain() {
    let page = include_str!("../../../docs/chains.md");
    let (_, rest) = page.split_once("```rust\n").expect("an example");
    let (text, _) = rest.split_once("```").expect("its end");
    let chain = Chain::from_text("glow.rs", text, "glow").compile(&ChainSpec::default());
    let emitted = chain
        .and_then(|chain| chain.emit())
        .unwrap_or_else(|errors| panic!("{}", errors.render(false)));
    let names: Vec<String> = emitted.named_files().into_keys().collect();
    assert_eq!(
        names,
        [
            "glow.chain.json",
            "glow.json",
            "glow.wgsl",
            "glow_small.json",
            "glow_small.wgsl"
        ]
    );
    for name in names
        .iter()
        .filter(|name| name.ends_with(".wgsl") || name.contains("chain"))
    {
        assert!(page.contains(name.as_str()), "docs/chains.md names {name}");
    }
}

/// Random chains are what rustc makes of them, stored, fused and looped.
#[test]
fn random_chains_compute_the_bits_of_rust() {
    let rustc = Rustc::find().unwrap_or_else(|why| panic!("{why}"));
    let seeds = 52_000..52_120;
    let tally = compare_chains(&rustc, seeds).unwrap_or_else(|why| panic!("{why}"));
    assert_eq!(tally.compared, 120);
    assert!(
        tally.fused > 30,
        "most chains have a picture that can be fused: {tally:?}"
    );
    assert!(tally.shared > 30, "many have pictures that can be shared: {tally:?}");
}

/// Drivers run the passes of a chain one after another, and compute the picture of the interpreter.
#[test]
fn every_construct_is_the_same_picture_on_a_gpu() {
    let bench = crate::common::bench();
    for (name, _) in ALL {
        for spec in [exact(), exact().fuse(Fuse::All), ChainSpec::from(exact().shader)] {
            for stage in [Stage::Compute, Stage::Fragment] {
                let mut spec = spec.clone();
                spec.shader = spec.shader.stage(stage);
                let compiled = compile(name, &spec);
                let emitted = compiled
                    .emit()
                    .unwrap_or_else(|errors| panic!("{name}: {}", errors.render(false)));
                for size in [SIZES[0], SIZES[5]] {
                    let inputs = inputs(size).with_uniform("strength", &[0.75]);
                    let expected = interpret_chain::<f32>(&compiled, &inputs).unwrap_or_else(|e| panic!("{name}: {e}"));
                    let found = bench
                        .run_chain(&emitted, &inputs)
                        .unwrap_or_else(|e| panic!("{name}: {e}"));
                    assert_eq!(found[0].size, expected[0].size, "{name} at {size}");
                    for (a, b) in expected[0]
                        .texels
                        .iter()
                        .flatten()
                        .zip(found[0].texels.iter().flatten())
                    {
                        // Filters weigh by 1/256, and halves between passes have 11 bits.
                        let near = (a - b).abs() <= 0.02 * (1.0 + a.abs());
                        assert!(near, "{name} at {size}, {stage}, fused {}: {a} and {b}", spec.fuse);
                    }
                }
            }
        }
    }
}

/// Further files of an example.
fn sources_of(example: &str) -> &'static [&'static str] {
    match example {
        "occlusion" => &["kernels/filters/ssao.rs"],
        "smaa" => &[
            "examples/gallery/smaa_edges.rs",
            "examples/gallery/smaa_weights.rs",
            "examples/gallery/smaa_blend.rs",
        ],
        "temporal" => &["examples/gallery/taa.rs", "examples/gallery/rcas.rs"],
        _ => &[],
    }
}

/// Every example runs, stored and fused, and a driver draws the pictures of the interpreter.
#[test]
fn the_examples_are_the_same_pictures_on_a_gpu() {
    let bench = crate::common::bench();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = std::fs::read_dir(root.join("examples/chains")).expect("the examples");
    let mut names: Vec<String> = Vec::new();
    for entry in folder {
        let path = entry.expect("an entry").path();
        let name = path
            .file_stem()
            .and_then(|stem| stem.to_str())
            .expect("a name")
            .to_owned();
        let chain = Chain::from_file(&path, None).unwrap_or_else(|errors| panic!("{}", errors.render(false)));
        let chain = chain.unwrap_or_else(|| panic!("{name} is no chain"));
        let chain = sources_of(&name).iter().fold(chain, |chain, file| {
            let with = chain.with_file(&root.join(file));
            with.unwrap_or_else(|errors| panic!("{}", errors.render(false)))
        });
        for fuse in [Fuse::None, Fuse::All, Fuse::Share] {
            let compiled = chain.compile(&ChainSpec::from(exact().shader).fuse(fuse.clone()));
            let compiled = compiled.unwrap_or_else(|errors| panic!("{}", errors.render(false)));
            let emitted = compiled
                .emit()
                .unwrap_or_else(|errors| panic!("{}", errors.render(false)));
            let inputs = test_inputs(&compiled.inputs_graph(), uvec2(33, 18));
            let expected = interpret_chain::<f32>(&compiled, &inputs).unwrap_or_else(|e| panic!("{name}: {e}"));
            let found = bench
                .run_chain(&emitted, &inputs)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            for (expected, found) in expected.iter().zip(&found) {
                let values = |written: &Written| written.texels.clone().into_iter().flatten();
                let pairs: Vec<(f64, f64)> = values(expected).zip(values(found)).collect();
                // Filters weigh by 1/256; a comparison in between can go the other way.
                let far = pairs.iter().filter(|(a, b)| (a - b).abs() > 0.02 * (1.0 + a.abs()));
                let (far, all) = (far.count(), pairs.len());
                assert!(100 * far <= all, "{name}, fused {fuse}: {far} of {all} values differ");
            }
        }
        names.push(name);
    }
    names.sort();
    assert_eq!(
        names,
        ["bloom", "blur", "mips", "occlusion", "outline", "smaa", "temporal"]
    );
}
