//! Chains whose workgroups compute a picture after another: natively, by the interpreter and on a driver, bit for bit.

use crate::chains::{SIZES, bits as texel_bits, exact, inputs, picture};
use glam::{UVec2, Vec4, uvec2};
use straightline_bench::execute::{Written, interpret_chain};
use straightline_codegen::chain::{Chain, ChainSpec, CompiledChain, Fuse};
use straightline_kernels::prelude::{Frame, Texture};

#[path = "../../chains/cascades.rs"]
mod constructs;

const CONSTRUCTS: &str = include_str!("../../chains/cascades.rs");

type Native = fn(UVec2, Vec<Vec4>) -> Vec<Texture<Vec4>>;

/// Calls a chain natively.
macro_rules! native {
    ($name:ident -> $($part:tt)+) => {
        (stringify!($name), (|size, texels| {
            let all = constructs::$name(&Texture::new(size, texels));
            native!(@ all $($part)+)
        }) as Native)
    };
    (@ $all:ident list) => {
        $all
    };
    (@ $all:ident one) => { vec![$all] };
    (@ $all:ident $($part:tt)+) => { vec![$($all.$part),+] };
}

fn chains() -> [(&'static str, Native); 7] {
    [
        native!(mips -> list),
        native!(blur -> one),
        native!(rounded_up -> one),
        native!(rounded_down -> one),
        native!(kinds -> one),
        native!(halves -> 0 1),
        ("frames", |size, texels| {
            let made = constructs::frames(&Frame::new(size, texels));
            vec![Texture::new(size, made.texels().to_vec())]
        }),
    ]
}

fn compile(name: &str, spec: &ChainSpec) -> CompiledChain {
    let chain = Chain::from_text("cascades.rs", CONSTRUCTS, name);
    chain
        .compile(spec)
        .unwrap_or_else(|errors| panic!("{name}: {}", errors.render(false)))
}

fn shared() -> ChainSpec {
    exact().fuse(Fuse::Share).most_outputs(5)
}

fn bits(written: &Written) -> Vec<[u32; 4]> {
    let texels = written.texels.iter();
    texels
        .map(|texel| texel.map(|value| (value as f32).to_bits()))
        .collect()
}

/// Sizes at which tiles end beside the border of a picture, or one texel from it.
fn sizes() -> impl Iterator<Item = UVec2> {
    let more = [uvec2(31, 32), uvec2(33, 65), uvec2(48, 47), uvec2(97, 50), uvec2(2, 3)];
    SIZES.into_iter().chain(more)
}

#[test]
fn a_cascade_computes_the_bits_of_rust() {
    for (name, native) in chains() {
        let all = compile(name, &shared());
        assert!(!all.shared.is_empty(), "{name}: {:?}", all.kept);
        // Pictures that a user names are shared although tiles overlap more than `share` lets them.
        let names = all.shared.iter().flat_map(|pass| pass.cascade.tiles.iter());
        let names: Vec<String> = names.map(|tile| format!("share:{}", tile.name)).collect();
        let first = exact().fuse(names[0].parse().expect("a picture")).most_outputs(5);
        for spec in [exact(), shared(), first] {
            let compiled = compile(name, &spec);
            for size in sizes() {
                let expected = native(size, picture(size));
                let found = interpret_chain::<f32>(&compiled, &inputs(size)).unwrap_or_else(|e| panic!("{name}: {e}"));
                for (expected, found) in expected.iter().zip(&found) {
                    assert_eq!(found.size, expected.size(), "{name} at {size}");
                    assert!(
                        bits(found) == texel_bits(expected),
                        "{name} at {size}, fused {}",
                        spec.fuse
                    );
                }
            }
        }
    }
}

#[test]
fn a_driver_computes_what_the_interpreter_does() {
    let bench = crate::common::bench();
    for (name, _) in chains() {
        // Drivers round to halves in two ways.
        let halves = ChainSpec::from(exact().shader).fuse(Fuse::Share);
        for (spec, near) in [(shared(), 1.0e-4), (halves, 0.02)] {
            let compiled = compile(name, &spec);
            let emitted = compiled
                .emit()
                .unwrap_or_else(|errors| panic!("{name}: {}", errors.render(false)));
            for size in [uvec2(1, 1), uvec2(33, 65), uvec2(97, 50)] {
                let inputs = inputs(size);
                let expected = interpret_chain::<f32>(&compiled, &inputs).unwrap_or_else(|e| panic!("{name}: {e}"));
                let found = bench
                    .run_chain(&emitted, &inputs)
                    .unwrap_or_else(|e| panic!("{name}: {e}"));
                for (expected, found) in expected.iter().zip(&found) {
                    let pairs = expected.texels.iter().flatten().zip(found.texels.iter().flatten());
                    for (a, b) in pairs {
                        assert!((a - b).abs() <= near * (1.0 + a.abs()), "{name} at {size}: {a} and {b}");
                    }
                }
            }
        }
    }
}

/// The tiles that are planned: a list that shrinks is a fault of the plan.
#[test]
fn pictures_are_shared_where_their_places_follow_from_the_pixel() {
    let groups = |name: &str| -> String {
        let compiled = compile(name, &shared());
        let each = compiled.shared.iter().map(|pass| {
            let tiles = pass.cascade.tiles.iter();
            let tiles = tiles.map(|tile| format!("{} {}x{}", tile.name, tile.size[0], tile.size[1]));
            tiles.collect::<Vec<_>>().join(", ")
        });
        each.collect::<Vec<_>>().join("; ")
    };
    assert_eq!(groups("mips"), "a 16x16, b 8x8, c 4x4, d 2x2, e 1x1");
    assert_eq!(groups("blur"), "rows 16x22, result 16x16");
    assert_eq!(groups("kinds"), "light 21x21, signs 19x19, thin 17x17, result 16x16");
}

/// Tiles of many pictures are small, and would leave most threads without work.
#[test]
fn a_cascade_ends_where_threads_have_no_work() {
    let text = "
        pub fn wide(color: &Texture<Vec4>) -> Texture<Vec4> {
            let first: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel) * 0.5);
            let mut sum: Texture<Vec4> = draw(color.size(), |pixel| first.load(pixel));
            for k in 0..20 {
                let part: Texture<Vec4> = draw(color.size(), |pixel| first.load(pixel + ivec2(k % 3, k % 2)));
                sum = draw(color.size(), |pixel| sum.load(pixel) + part.load(pixel - 1));
            }
            sum
        }";
    let compile = |fuse: Fuse| {
        let compiled = Chain::from_text("wide.rs", text, "wide").compile(&exact().fuse(fuse));
        compiled.unwrap_or_else(|errors| panic!("{}", errors.render(false)))
    };
    let (stored, shared) = (compile(Fuse::None), compile(Fuse::Share));
    assert!(shared.passes.len() < stored.passes.len());
    for pass in &shared.shared {
        let last = pass.cascade.tiles.last().expect("tiles");
        assert!(last.size[0] * last.size[1] >= 64, "{:?}", pass.cascade);
    }
    let size = uvec2(33, 20);
    let [expected, found] = [&stored, &shared].map(|compiled| {
        let written = interpret_chain::<f32>(compiled, &inputs(size));
        bits(&written.unwrap_or_else(|e| panic!("{e}"))[0])
    });
    assert!(expected == found);
}
