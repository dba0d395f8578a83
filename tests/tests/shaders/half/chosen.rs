//! Chosen values in half precision: the setting `half`.

use super::*;
use std::collections::BTreeSet;
use std::path::PathBuf;
use straightline_bench::execute::test_inputs;
use straightline_codegen::emit::Target;
use straightline_codegen::ir::Op;
use straightline_codegen::{EmitOptions, passes};
use straightline_tests::random::Random;
use straightline_tests::random::make::{Features, make};
use straightline_tests::random::oracle::{World, computed};

const SIZE: UVec2 = uvec2(48, 32);

/// Two names, of which the second uses the first, and a result in full precision.
const TEXT: &str = "
    pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
        let (a, b) = (color.load(pixel), color.load(pixel + ivec2(1, 0)));
        let step = a.x - b.x;
        let square = (step * step + 0.1) / b.y;
        let weight = square.max(0.3).max(a.z);
        vec4(weight * a.y, square, step, 1.0)
    }";

/// Every name of a kernel that can be lowered.
fn all_names(kernel: &Kernel) -> BTreeSet<String> {
    let whole = kernel.compile(&Settings::default()).unwrap_or_else(|e| panic!("{e}"));
    passes::half_names(&whole.graph)
}

/// The definition, by the crate `half`, and the driver, on numbers that half precision holds.
#[test]
fn operands_and_results_of_chosen_values_are_rounded() {
    let compiled = compile_text(TEXT, &Settings::new().half(["step", "square"]));
    let gpu = capable_bench();
    let inputs = held(test_inputs(&compiled.graph, SIZE));
    let found = interpret_kernel::<f32>(&compiled, &inputs, false).expect("it runs");
    let shown = gpu.run(&compiled, Stage::Compute, &inputs).expect("it runs");
    let color = &inputs.images[0].1[0];
    for (k, (found, shown)) in found.frame(&inputs).texels().iter().zip(shown.texels()).enumerate() {
        let (x, y) = ((k % SIZE.x as usize) as i32, (k / SIZE.x as usize) as i32);
        let (a, b) = (color.load(ivec2(x, y)), color.load(ivec2(x + 1, y)));
        let step = f16::from_f32(a.x) - f16::from_f32(b.x);
        let square = (step * step + f16::from_f32(0.1)) / f16::from_f32(b.y);
        let [step, square] = [step.to_f32(), square.to_f32()];
        let expected = vec4(square.max(0.3).max(a.z) * a.y, square, step, 1.0);
        assert_eq!(
            found.to_array().map(f32::to_bits),
            expected.to_array().map(f32::to_bits),
            "{x} {y}"
        );
        if rounds_exactly(&gpu) {
            assert_eq!(
                shown.to_array().map(f32::to_bits),
                expected.to_array().map(f32::to_bits),
                "{x} {y}"
            );
        }
    }
}

/// Names of all variables, and of a third of them. A driver may round what becomes half in either direction.
#[test]
fn every_kernel_computes_what_the_interpreter_does() {
    let gpu = capable_bench();
    let mut random = Random(1);
    for whole in kernels::compiled() {
        let all = passes::half_names(&whole.graph);
        let some: BTreeSet<String> = all.iter().filter(|_| random.below(3) == 0).cloned().collect();
        let kernel = kernels::named(&whole.kernel);
        for chosen in [all, some] {
            let compiled = kernel
                .compile(&Settings::new().half(chosen.clone()))
                .unwrap_or_else(|e| panic!("{e}"));
            let inputs = held(test_inputs(&compiled.in_blocks().graph, SIZE));
            let shown = gpu
                .run(&compiled, Stage::Compute, &inputs)
                .unwrap_or_else(|e| panic!("{}: {e}", whole.kernel));
            let found =
                interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{}: {e}", whole.kernel));
            let apart = kernels::apart(&shown, &found.frame(&inputs));
            let most = kernels::cost(&whole.kernel).max(8.0);
            assert!(
                kernels::at(&apart, 0.9) <= most,
                "{} {chosen:?}: {}",
                whole.kernel,
                kernels::at(&apart, 0.9)
            );
        }
    }
}

/// An attribute means what the setting does: a proposal of the search can be written into the source.
#[test]
fn attributes_choose_like_the_setting() {
    let marked = |text: &str, line: &str| {
        let line = &format!("{line}\n");
        assert!(text.contains(line.as_str()), "{text}");
        text.replace(line.as_str(), &format!("#[cfg_attr(false, half)] {line}"))
    };
    let emitted = |compiled: &Compiled| {
        let emitted = compiled
            .emit(&EmitOptions::new().strip_comments(true))
            .unwrap_or_else(|e| panic!("{e}"));
        String::from_utf8_lossy(&emitted.files[&Target::Wgsl]).into_owned()
    };
    let chosen = compile_text(TEXT, &Settings::new().half(["step", "square"]));
    let text = marked(TEXT, "let step = a.x - b.x;");
    let whole = marked(&text, "let square = (step * step + 0.1) / b.y;");
    let by_attributes = compile_text(&whole, &Settings::default());
    assert_eq!(emitted(&chosen), emitted(&by_attributes));
    assert_eq!(by_attributes.half, chosen.half);
    // An attribute and the setting add up.
    let both = compile_text(&text, &Settings::new().half(["square"]));
    assert_eq!(emitted(&chosen), emitted(&both));
    // A part of a structure, and the result of a function.
    let text = "
        #[derive(Clone, Copy)]
        pub struct Light { pub near: f32, pub far: f32 }
        #[cfg_attr(false, half)]
        fn luma(c: Vec4) -> f32 { c.x * 0.2 + c.y * 0.7 + c.z * 0.1 }
        #[cfg_attr(false, half)]
        fn never_called(x: f32) -> f32 { x * x }
        pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
            let c = color.load(pixel);
            #[cfg_attr(false, half)]
            let light = Light { near: c.x * 3.0, far: c.y / 7.0 };
            vec4(luma(c), light.near - 0.3, light.far + 0.1, 1.0)
        }";
    let compiled = compile_text(text, &Settings::default());
    let names: Vec<&str> = compiled.half.iter().map(String::as_str).collect();
    assert_eq!(names, ["light_far", "light_near", "luma"]);
}

#[test]
fn the_kernel_of_the_document_is_taken() {
    let document = include_str!("../../../../docs/precision.md");
    let text = document
        .split("```rust\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next());
    let kernel = Kernel::from_text("vivid.rs", text.expect("a kernel"), "vivid");
    let compiled = kernel.compile(&Settings::default()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(compiled.half.iter().collect::<Vec<_>>(), ["grey"]);
}

#[test]
fn attributes_elsewhere_are_refused() {
    for (text, expected) in [
        (
            "#[cfg_attr(false, half)] { out += v; }",
            "`half` is an attribute of a function or a `let`",
        ),
        (
            "#[cfg_attr(false, half)] if v > 0.5 { out += v; }",
            "`half` is an attribute of a function or a `let`",
        ),
        (
            "#[cfg_attr(false, half)] for _ in 0..2 { out += v; }",
            "`half` is an attribute of a function or a `let`",
        ),
        ("#[half] let w = v; out += w;", "the attribute `half` as rustc sees it"),
    ] {
        let text = format!(
            "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{
                let v = color.load(pixel).x;
                let mut out = v;
                {text}
                Vec4::splat(out)
            }}"
        );
        let refused = Kernel::from_text("test.rs", &text, "k").compile(&Settings::default());
        let error = refused.map(drop).expect_err(&text).to_string();
        assert!(error.contains(expected), "{error}");
    }
    let choosing = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
        let v = color.load(pixel).x;
        #[cfg_attr(false, half, branch)]
        let w = if v > 0.5 { v * 2.0 } else { v * v };
        Vec4::splat(w)
    }";
    let compiled = compile_text(choosing, &Settings::default());
    assert_eq!(compiled.half.iter().collect::<Vec<_>>(), ["w"]);
}

/// `f64` is the truth that errors are taken of, and so is that of a kernel with chosen values.
#[test]
fn in_f64_nothing_is_rounded() {
    let whole = compile_text(TEXT, &Settings::default());
    let chosen = compile_text(TEXT, &Settings::new().half(["step", "square", "weight"]));
    let inputs = test_inputs(&whole.graph, SIZE);
    let [whole, chosen] =
        [&whole, &chosen].map(|compiled| interpret_kernel::<f64>(compiled, &inputs, false).expect("it runs"));
    assert_eq!(whole.texels, chosen.texels);
}

/// Naga validates each text on the way, and another validator reads the SPIR-V.
#[test]
fn every_kernel_is_emitted_in_every_language_but_glsl() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("half-chosen");
    std::fs::create_dir_all(&folder).expect("a folder for shaders");
    let targets: BTreeSet<Target> = Target::MODERN.into_iter().filter(|t| *t != Target::Glsl450).collect();
    let mut spirv = Vec::new();
    for whole in kernels::compiled() {
        let kernel = kernels::named(&whole.kernel);
        let chosen = all_names(&kernel);
        let compiled = kernel
            .compile(&Settings::new().half(chosen.clone()))
            .unwrap_or_else(|e| panic!("{e}"));
        for stage in [Stage::Compute, Stage::Fragment] {
            let emitted = compiled.emit(&EmitOptions::new().stage(stage).targets(targets.clone()));
            let emitted = emitted.unwrap_or_else(|e| panic!("{} {}: {e}", compiled.kernel, stage.name()));
            let text = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]);
            assert!(text.starts_with("enable f16;\n\n// "), "{text}");
            assert_eq!(emitted.manifest.half, chosen);
            assert_eq!(emitted.manifest.precision, Precision::F32);
            assert!(emitted.manifest.features.contains(&"shader-f16".to_owned()));
            let path = folder.join(format!("{}-{}.spv", compiled.kernel, stage.name()));
            std::fs::write(&path, &emitted.files[&Target::Spirv]).expect("a shader is written");
            spirv.push(path);
        }
    }
    common::other_compilers(&[], &spirv);
}

#[test]
fn what_cannot_be_chosen_is_refused() {
    let refused = |name: &str| {
        let compiled = Kernel::from_text("test.rs", TEXT, "k").compile(&Settings::new().half([name]));
        compiled.map(drop).expect_err("it is refused").to_string()
    };
    let text = refused("squares");
    assert!(text.contains("`k` computes no float called `squares`"), "{text}");
    assert!(text.contains("did you mean `square`?"), "{text}");
    let text = refused("nothing_like_it");
    assert!(text.contains("it computes weight, result, step, square"), "{text}");
    let compiled = compile_text(TEXT, &Settings::new().half(["step"]));
    let glsl = compiled.emit(&EmitOptions::new().targets([Target::Glsl450]));
    let text = glsl.map(drop).expect_err("it is refused").to_string();
    assert!(text.contains("leave `half` out"), "{text}");
}

/// Random kernels with random names: valid in every language, and the same in `f64`.
#[test]
fn random_kernels_with_chosen_values_are_valid() {
    const SEED: u64 = 51_000;
    let world = World::new(SEED);
    let targets: BTreeSet<Target> = Target::MODERN.into_iter().filter(|t| *t != Target::Glsl450).collect();
    let (mut lowered, mut same) = (0, 0);
    for seed in SEED..SEED + 300 {
        let text = make(seed, Features::all());
        let kernel = Kernel::from_text("random.rs", &text.file(), "k");
        let Ok(whole) = kernel.compile(&Settings::default()) else {
            continue;
        };
        let mut random = Random(seed);
        let chosen: BTreeSet<String> = passes::half_names(&whole.graph)
            .into_iter()
            .filter(|_| random.below(2) == 0)
            .collect();
        if chosen.is_empty() {
            continue;
        }
        let compiled = kernel
            .compile(&Settings::new().half(chosen.clone()))
            .unwrap_or_else(|e| panic!("{text}\n{e}"));
        if whole.emit(&EmitOptions::new().targets(targets.clone())).is_err() {
            continue;
        }
        let emitted = compiled.emit(&EmitOptions::new().targets(targets.clone()));
        emitted.unwrap_or_else(|e| panic!("{text}\n{chosen:?}: {e}"));
        lowered += 1;
        // Constants that no half holds become others.
        let is_held = |x: f32| {
            !x.is_finite() || x == 0.0 || (f64::from(nearest(x)) - f64::from(x)).abs() <= f64::from(x.abs()) / 2048.0
        };
        let constants = whole
            .graph
            .nodes
            .iter()
            .filter(|node| node.ty.is_float())
            .filter_map(|node| match node.op {
                Op::Const(bits) => Some(bits.map(f32::from_bits)),
                _ => None,
            });
        if !constants.flatten().all(is_held) {
            continue;
        }
        let [expected, found] = [&whole, &compiled].map(|compiled| computed::<f64>(compiled, &world));
        if let (Ok(expected), Ok(found)) = (expected, found) {
            for (place, x, y) in expected.pairs(&found, &world).unwrap_or_else(|e| panic!("{text}\n{e}")) {
                let same = x.iter().zip(&y).all(|(x, y)| x == y || (x.is_nan() && y.is_nan()));
                assert!(same, "{text}\n{chosen:?} {place}: {x:?} became {y:?}");
            }
            same += 1;
        }
    }
    assert!(
        lowered >= 100 && same >= 50,
        "{lowered} kernels have chosen values, {same} were compared"
    );
}
