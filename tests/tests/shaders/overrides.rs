//! Overridden options on a Vulkan driver: one text gives the picture of each value, in every language that the driver
//! can be given, bit for bit that of the text with the constant.

use glam::{Vec4, uvec2};
use straightline_bench::execute::{Inputs, interpret_kernel, override_options, test_inputs};
use straightline_codegen::chain::{Chain, ChainSpec, EmittedChain};
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::{Compiled, Format, Kernel, Settings, ShaderSpec, Stage};
use straightline_kernels::prelude::Frame;
use straightline_runtime::PassOptions;
use straightline_tests::sraa::surfaces;
use straightline_tests::{compilers, passthrough};

/// A sum and then products, which drivers cannot contract.
const TEXT: &str = "
options! {
    pub struct Cfg {
        /// How far.
        pub radius: i32 [1..=4] = 2,
        /// How much.
        pub tau: f32 = 500.0,
        /// Mirrored.
        pub mirrored: bool = false,
        /// Seed.
        pub seed: u32 = 7,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for x in 0..cfg.radius {
        let offset = if cfg.mirrored { -x } else { x };
        sum += color.load(pixel + ivec2(offset, 0));
    }
    // Overflows: an expression of constants alone would be refused.
    sum * (cfg.tau * 2.0) * ((cfg.seed.wrapping_mul(4_000_000_000) >> 28) as f32)
}";

const LANGUAGES: [Target; 4] = [Target::Wgsl, Target::Spirv, Target::Glsl450, Target::Hlsl];

/// Values of the options of `TEXT`.
const SETS: [[(&str, f64); 4]; 3] = [
    [("radius", 2.0), ("tau", 500.0), ("mirrored", 0.0), ("seed", 7.0)],
    [
        ("radius", 4.0),
        ("tau", -0.25),
        ("mirrored", 1.0),
        ("seed", 4_294_967_295.0),
    ],
    [("radius", 1.0), ("tau", 3.0e30), ("mirrored", 0.0), ("seed", 0.0)],
];

fn kernel() -> Kernel {
    Kernel::from_text("k.rs", TEXT, "k")
}

/// The kernel with constants.
fn constant(set: &[(&str, f64)]) -> Compiled {
    let settings = set.iter().fold(Settings::new(), |settings, (name, value)| match *name {
        "mirrored" => settings.set(name, *value != 0.0),
        _ => settings.set(name, value),
    });
    kernel().compile(&settings).unwrap_or_else(|e| panic!("{e}"))
}

fn with_values(inputs: &Inputs, set: &[(&str, f64)]) -> Inputs {
    set.iter().fold(inputs.clone(), |inputs, (name, value)| {
        inputs.with_uniform(name, &[*value])
    })
}

fn bits(picture: &Frame<Vec4>) -> Vec<[u32; 4]> {
    picture
        .texels()
        .iter()
        .map(|texel| texel.to_array().map(f32::to_bits))
        .collect()
}

/// The text in HLSL behind definitions of the macros, as a host compiles it.
fn defined(emitted: &Emitted, set: &[(&str, f64)]) -> String {
    let text = std::str::from_utf8(&emitted.files[&Target::Hlsl]).expect("HLSL");
    let defines = emitted.manifest.overrides.iter().map(|of| {
        let (_, value) = set.iter().find(|(name, _)| *name == of.name).expect("a value");
        let value = match of.name.as_str() {
            "mirrored" => (*value != 0.0).to_string(),
            "tau" => format!("{:?}", *value as f32),
            "seed" => format!("{value}u"),
            _ => value.to_string(),
        };
        format!("#define {} {value}\n", of.define)
    });
    defines.collect::<String>() + text
}

#[test]
fn one_text_gives_every_picture() {
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    let overridden = kernel().compile(&Settings::new().override_options(["radius", "tau", "mirrored", "seed"]));
    let overridden = overridden.unwrap_or_else(|e| panic!("{e}"));
    let inputs = test_inputs(&overridden.graph, uvec2(13, 9));
    for stage in [Stage::Compute, Stage::Fragment] {
        let emitted = overridden.emit(&bench.emit_options(stage).targets(LANGUAGES));
        let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
        compilers::read(&emitted).unwrap_or_else(|e| panic!("{e}"));
        let mut seen = Vec::new();
        for set in &SETS {
            let given = with_values(&inputs, set);
            let expected = interpret_kernel::<f32>(&constant(set), &inputs, false).unwrap_or_else(|e| panic!("{e}"));
            let expected = bits(&expected.frame(&inputs));
            let interpreted = interpret_kernel::<f32>(&overridden, &given, false).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(bits(&interpreted.frame(&given)), expected, "{set:?}");
            assert!(!seen.contains(&expected), "{set:?} changes the picture");
            for target in LANGUAGES {
                let found = match target {
                    Target::Wgsl => {
                        let options = override_options(&emitted.manifest, &given);
                        let pass = bench
                            .create_pass(&emitted, &options)
                            .unwrap_or_else(|e| panic!("{set:?}: {e}"));
                        let uploaded = bench
                            .upload(&emitted.manifest, &given)
                            .unwrap_or_else(|e| panic!("{e}"));
                        bench
                            .written_by(&pass, &uploaded, given.size)
                            .map_err(|e| e.to_string())
                    }
                    Target::Hlsl => {
                        let (manifest, text) = (&emitted.manifest, defined(&emitted, set));
                        let words = compilers::compiled_hlsl(&text, stage, &manifest.entry_point);
                        let words = words.unwrap_or_else(|e| panic!("{set:?}: {e}"));
                        let mut manifest = manifest.clone();
                        manifest.overrides.clear();
                        passthrough::written(&bench, manifest, target, &words, &given).map(|(written, _)| written)
                    }
                    target => passthrough::run_all(&bench, &emitted, target, &given),
                };
                let found = found.unwrap_or_else(|e| panic!("{set:?} {target}: {e}"));
                assert_eq!(bits(&found[0].frame()), expected, "{set:?} {stage:?} {target}");
            }
            seen.push(expected);
        }
    }
}

/// The driver computes exponentials at run time in one case and may fold them in the other.
#[test]
fn sraa_by_overrides_is_that_by_constants() {
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    let options = [("pattern".to_owned(), "latin4".to_owned())];
    let inputs = surfaces::inputs(&options.to_vec(), uvec2(45, 31), 5);
    let kernel = Kernel::builtin("sraa").unwrap_or_else(|e| panic!("{e}"));
    let settings = || Settings::new().set("pattern", "latin4");
    let compile = |settings: &Settings| kernel.compile(settings).unwrap_or_else(|e| panic!("{e}"));
    let overridden = compile(&settings().override_options(["tau"]));
    let emitted = overridden.emit(&bench.emit_options(Stage::Compute).targets(LANGUAGES));
    let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
    for tau in [0.0, 500.0, 60.5] {
        let of_constant = compile(&settings().set("tau", tau));
        let constant = of_constant.emit(&bench.emit_options(Stage::Compute).targets(LANGUAGES));
        let constant = constant.unwrap_or_else(|e| panic!("{e}"));
        let given = with_values(&inputs, &[("tau", tau)]);
        for target in [Target::Spirv, Target::Glsl450] {
            let run = |emitted: &Emitted, inputs: &Inputs| {
                passthrough::run(&bench, emitted, target, inputs).unwrap_or_else(|e| panic!("{tau} {target}: {e}"))
            };
            let (found, expected) = (run(&emitted, &given), run(&constant, &inputs));
            assert_eq!(bits(&found), bits(&expected), "{tau} {target}");
        }
        let found = bench
            .run_targets(&overridden, Stage::Compute, &given)
            .unwrap_or_else(|e| panic!("{e}"));
        let expected = bench
            .run_targets(&of_constant, Stage::Compute, &inputs)
            .unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(bits(&found[0].frame()), bits(&expected[0].frame()), "{tau}");
    }
}

/// A chain sets an override in each pass that has it.
#[test]
fn chains_take_overrides() {
    const CHAIN: &str = "
options! {
    pub struct Grade {
        /// Weight.
        pub gain: f32 [0.0..=8.0] = 2.0,
    }
}

pub fn graded(cfg: &Grade, color: &Frame<Vec4>) -> Frame<Vec4> {
    let scaled: Frame<Vec4> = draw(color.size(), |pixel| color.load(pixel) * cfg.gain);
    draw(color.size(), |pixel| (scaled.load(pixel) - color.load(pixel)) * cfg.gain)
}";
    let bench = passthrough::bench().unwrap_or_else(|e| panic!("{e}"));
    let emit = |spec: ShaderSpec| {
        let spec = ChainSpec::from(spec.format(Format::Rgba32Float)).pictures(Format::Rgba32Float);
        let compiled = Chain::from_text("graded.rs", CHAIN, "graded").compile(&spec);
        let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
        let emitted = compiled.emit().unwrap_or_else(|e| panic!("{e}"));
        (compiled, emitted)
    };
    let (overridden, emitted) = emit(ShaderSpec::new().override_options(["gain"]));
    let inputs = test_inputs(&overridden.inputs_graph(), uvec2(13, 9));
    for gain in [2.0, 0.0, 6.5] {
        let (_, constant) = emit(ShaderSpec::new().set("gain", gain));
        let run = |emitted: &EmittedChain, inputs: &Inputs| {
            let written = bench
                .run_chain(emitted, inputs)
                .unwrap_or_else(|e| panic!("{gain}: {e}"));
            bits(&written[0].frame())
        };
        let found = run(&emitted, &with_values(&inputs, &[("gain", gain)]));
        assert_eq!(found, run(&constant, &inputs), "{gain}");
    }
    let options = PassOptions::default().override_option("gian", 1.0);
    let refused = bench.create_chain(&emitted, &options).expect_err("no pass has it");
    assert!(refused.to_string().contains("gian"), "{refused}");
}

#[test]
fn words_have_a_specialization_constant_for_each() {
    let overridden = kernel().compile(&Settings::new().override_options(["radius", "tau", "mirrored", "seed"]));
    let overridden = overridden.unwrap_or_else(|e| panic!("{e}"));
    let options = straightline_codegen::EmitOptions::new().targets([Target::Spirv]);
    let emitted = overridden.emit(&options).unwrap_or_else(|e| panic!("{e}"));
    let words = compilers::words(&emitted.files[&Target::Spirv]);
    // `OpSpecConstant` and `OpSpecConstantFalse`, and `OpDecorate` with `SpecId`.
    let constants: Vec<u32> = compilers::instructions(&words, 50).iter().map(|i| i[2]).collect();
    assert_eq!(constants, [2, 500.0_f32.to_bits(), 7]);
    assert_eq!(compilers::instructions(&words, 49).len(), 1);
    let ids = compilers::instructions(&words, 71)
        .into_iter()
        .filter(|i| i[1] == 1)
        .map(|i| i[2]);
    assert_eq!(ids.collect::<Vec<_>>(), [0, 1, 2, 3]);
}
