//! Handwritten shaders beside the emitted ones: they are valid, make the same picture, and are as long as
//! `docs/emitted-code.md` says.
//!
//! After a change of either: `STRAIGHTLINE_BLESS=1 cargo test --workspace --test shaders yardstick::`.

use crate::common;

use common::bench;
use std::path::{Path, PathBuf};
use straightline_bench::execute::{Bench, Corner, Inputs, interpret_kernel};
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::{Compiled, Kernel, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_runtime::Pass;
use straightline_tests::compilers;
use straightline_tests::sraa::options::options;
use straightline_tests::sraa::{Random, compiled, surfaces};
use wgpu::naga::{
    self,
    back::spv,
    proc::{BoundsCheckPolicies, BoundsCheckPolicy},
    valid::{Capabilities, ValidationFlags, Validator},
};

/// Most that a component may be off, relative to the emitted shader's and to the interpreter's.
const BOUND: f32 = 1.0e-5;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("yardstick")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The handwritten text, writing full floats as the bench does.
fn handwritten(stem: &str) -> String {
    read(&folder().join(format!("{stem}.wgsl"))).replace("rgba16float", "rgba32float")
}

/// The SPIR-V that naga makes of a WGSL text, with the options of the generator.
fn spirv(text: &str) -> Vec<u32> {
    let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    let info = validator
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    let options = spv::Options {
        lang_version: (1, 3),
        flags: spv::WriterFlags::empty(),
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Restrict,
            ..BoundsCheckPolicies::default()
        },
        ..spv::Options::default()
    };
    spv::write_vec(&module, &info, &options, None).unwrap_or_else(|e| panic!("{e}"))
}

/// `OpFunction`.
const FUNCTION: u32 = 54;
/// `OpLabel`.
const LABEL: u32 = 248;

/// Instructions from the first function on, labels not counted.
fn instructions(words: &[u32]) -> usize {
    let (mut rest, mut count, mut inside) = (&words[5..], 0, false);
    while let Some(first) = rest.first() {
        inside |= first & 0xffff == FUNCTION;
        count += usize::from(inside && first & 0xffff != LABEL);
        rest = &rest[(first >> 16) as usize..];
    }
    count
}

/// Lines and instructions of emitted shaders before expressions were inlined and names shortened.
const BEFORE: [(&str, usize, usize); 5] = [
    ("sraa4", 295, 599),
    ("sraa4-looped", 163, 481),
    ("pcss", 77, 158),
    ("sraa16", 774, 1499),
    ("bilateral5-block", 758, 2641),
];

#[test]
fn the_document_says_how_long_each_is() {
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders-out");
    let mut table = String::from("\n");
    for (stem, lines_before, instructions_before) in BEFORE {
        let hand = folder().join(format!("{stem}.wgsl"));
        let [hand_lines, hand_instructions] = if hand.exists() {
            let text = read(&hand);
            [text.lines().count(), instructions(&spirv(&text))].map(|n| n.to_string())
        } else {
            ["–", "–"].map(str::to_owned)
        };
        let lines = read(&shaders.join(format!("{stem}.wgsl"))).lines().count();
        let bytes = std::fs::read(shaders.join(format!("{stem}.spv"))).unwrap_or_else(|e| panic!("{stem}: {e}"));
        let instructions = instructions(&compilers::words(&bytes));
        table += &format!(
            "| `{stem}` | {hand_lines} | {lines_before} | {lines} | {hand_instructions} | {instructions_before} | {instructions} |\n"
        );
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/emitted-code.md");
    let document = read(&path);
    let (before, rest) = document.split_once(RULE).expect("the table is there");
    let (found, after) = rest.split_once("<!-- end -->").expect("the table has an end");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        let text = format!("{before}{RULE}{table}<!-- end -->{after}");
        std::fs::write(&path, text).expect("the document is written");
    } else {
        assert_eq!(
            found, table,
            "docs/emitted-code.md says otherwise: run STRAIGHTLINE_BLESS=1 cargo test --workspace --test shaders yardstick::"
        );
    }
}

/// Each excerpt names its file, and has lines of it; `...` stands for lines that are left out.
#[test]
fn excerpts_are_of_their_files() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let document = read(&root.join("docs/emitted-code.md"));
    let mut checked = 0;
    for block in document.split("```wgsl ").skip(1) {
        let (file, rest) = block.split_once('\n').expect("a block has lines");
        let (excerpt, _) = rest.split_once("```").expect("a block has an end");
        let text = read(&root.join(file));
        for piece in excerpt.split("...\n") {
            assert!(
                text.contains(piece),
                "docs/emitted-code.md quotes what {file} does not have:\n{piece}"
            );
        }
        checked += 1;
    }
    assert_eq!(checked, 7, "two excerpts for each kernel, and one to be read back");
}

/// The rule below the table's head.
const RULE: &str = "| --- | --: | --: | --: | --: | --: | --: |";

/// Compares two pictures, and prints by how much they differ at most, relative to the second.
fn assert_close(what: &str, found: &Frame<Vec4>, expected: &Frame<Vec4>) {
    assert_eq!(found.size(), expected.size(), "{what}");
    let mut largest = 0.0f32;
    for (k, (a, b)) in found.texels().iter().zip(expected.texels()).enumerate() {
        assert!(a.is_finite(), "{what}: pixel {k} is {a}");
        let off = (*a - *b).abs() / b.abs().max(Vec4::splat(f32::MIN_POSITIVE));
        assert!(off.max_element() <= BOUND, "{what}: pixel {k} is {a}, expected {b}");
        largest = largest.max(off.max_element());
    }
    println!("{what}: off by {largest:e} at most");
}

/// The picture of a compute shader whose text is replaced.
fn picture(bench: &Bench, emitted: &Emitted, text: &str, inputs: &Inputs) -> Frame<Vec4> {
    let mut manifest = emitted.manifest.clone();
    manifest.hashes.clear();
    let pass = Pass::new(bench.device(), &manifest, text).unwrap_or_else(|e| panic!("{e}"));
    let uploaded = bench.upload(&manifest, inputs).expect("it is bound");
    bench.picture_of(&pass, &uploaded, inputs.size).expect("it runs")
}

#[test]
fn sraa_makes_the_same_picture() {
    let bench = bench();
    let set = options(&[]);
    for size in [uvec2(61, 47), uvec2(1, 1), uvec2(2, 33)] {
        let inputs = surfaces::inputs(&set, size, 5);
        for (stem, unroll) in [("sraa4", Unroll::Full), ("sraa4-looped", Unroll::None)] {
            let compiled = compiled(&set, unroll).unwrap_or_else(|e| panic!("{e}"));
            let emitted = compiled
                .emit(&bench.emit_options(Stage::Compute))
                .expect("it is emitted");
            let hand = picture(&bench, &emitted, &handwritten(stem), &inputs);
            let text = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
            let generated = picture(&bench, &emitted, &text, &inputs);
            assert_close(&format!("{stem}, {size}, and emitted"), &hand, &generated);
            let interpreted = interpret_kernel::<f32>(&compiled, &inputs, false).expect("it runs");
            assert_close(
                &format!("{stem}, {size}, and interpreted"),
                &hand,
                &interpreted.frame(&inputs),
            );
        }
    }
}

#[test]
fn a_bad_colour_is_left_out() {
    let bench = bench();
    let set = options(&[]);
    let size = uvec2(24, 16);
    let inputs = surfaces::inputs(&set, size, 5);
    let mut random = Random(9);
    let texel = |_| {
        let texel = vec4(random.unit(), random.unit(), random.unit(), 1.0);
        match random.number() % 8 {
            0 => texel * f32::NAN,
            1 => texel * f32::INFINITY,
            _ => texel,
        }
    };
    let color = Frame::new(size, (0..size.x * size.y).map(texel).collect());
    let inputs = inputs.with_image("color", color);
    for (stem, unroll) in [("sraa4", Unroll::Full), ("sraa4-looped", Unroll::None)] {
        let compiled = compiled(&set, unroll).unwrap_or_else(|e| panic!("{e}"));
        let emitted = compiled
            .emit(&bench.emit_options(Stage::Compute))
            .expect("it is emitted");
        let hand = picture(&bench, &emitted, &handwritten(stem), &inputs);
        let interpreted = interpret_kernel::<f32>(&compiled, &inputs, false).expect("it runs");
        assert_close(stem, &hand, &interpreted.frame(&inputs));
    }
}

/// A triangle that covers the frame, on a slanted plane of the shadow map's space.
fn cover(size: UVec2) -> Vec<Corner> {
    let corner = |x: f32, y: f32| {
        let pixel = vec2(x + 1.0, 1.0 - y) / 2.0 * size.as_vec2();
        let coord = vec3(0.231, 0.217, 0.402)
            + pixel.x * vec3(0.0123, 0.0031, 0.0007)
            + pixel.y * vec3(-0.0029, 0.0149, 0.0011);
        Corner {
            position: vec4(x, y, 0.5, 1.0),
            varyings: vec![coord.extend(0.0)],
        }
    };
    vec![corner(-1.0, -1.0), corner(3.0, -1.0), corner(-1.0, 3.0)]
}

#[test]
fn pcss_draws_the_same_picture() {
    let bench = bench();
    let compiled: Compiled = Kernel::builtin("pcss")
        .and_then(|k| k.compile(&Settings::default()))
        .unwrap_or_else(|e| panic!("{e}"));
    let (size, map) = (uvec2(25, 17), uvec2(48, 40));
    let mut random = Random(31);
    let depth = |k: u32| {
        let (x, y) = ((k % map.x) as f32, (k / map.x) as f32);
        let wave = (x * 0.35).sin() * (y * 0.27 + 1.0).cos();
        Vec4::splat(0.43 + 0.1 * wave + 0.03 * random.unit())
    };
    let shadow = Frame::new(map, (0..map.x * map.y).map(depth).collect());
    let inputs = Inputs::new(size).with_image("shadow", shadow);
    let emitted = compiled
        .emit(&bench.emit_options(Stage::Fragment))
        .expect("it is emitted");
    let mut manifest = emitted.manifest;
    manifest.hashes.clear();
    let draw = |text: &str| {
        let forward = bench.forward_by(&manifest, text, &inputs, &cover(size));
        bench
            .draw_forward(&forward.unwrap_or_else(|e| panic!("{e}")))
            .expect("it is drawn")
    };
    let text = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
    let (hand, emitted) = (draw(&handwritten("pcss")), draw(&text));
    let lit = emitted.texels().iter().filter(|t| t.x > 0.1 && t.x < 0.9).count();
    assert!(lit > 20, "{lit} pixels lie in a penumbra");
    assert_close("pcss and emitted", &hand, &emitted);
}
