//! Any name works: kernels whose parameters, options, fields, structures and functions are called by words of shading
//! languages, of engines and of hosts' languages, or by names without end, are written in every language, read by its
//! compiler, bound, and run as under their own names.
//!
//! `STRAIGHTLINE_BLESS=1` writes the generated bindings in `names/` anew, which rustc compiles with this test.

use crate::common;
mod kernels;
#[path = "../shaders/engines/readable.rs"]
#[allow(dead_code)] // the tests of engines use all of it
mod readable;

use common::same_texels;
use kernels::{ROLES, SIZE, Words, roles, sources};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;
use straightline_bench::execute::{Bench, Inputs, interpret_kernel, test_inputs};
use straightline_codegen::diagnostic::Code;
use straightline_codegen::emit::Target;
use straightline_codegen::ir::Invocation;
use straightline_codegen::{Compiled, EmitOptions, Form, Kernel, Origin, Settings, Stage};
use straightline_engines::{Engine, Request, engine_names};
use straightline_manifest::LanguageKind;
use straightline_tests::compilers;
use straightline_tests::renamed::{Source, inputs_of};

/// As a shader of the first stage that it can be of, in every language that has what it needs.
fn one_way(compiled: &Compiled) -> Vec<EmitOptions> {
    let stages = [Stage::Compute, Stage::Fragment].map(|stage| EmitOptions::new().stage(stage));
    let each = stages.into_iter().map(|options| in_languages(compiled, options));
    each.filter(|options| !options.targets.is_empty()).take(1).collect()
}

fn in_languages(compiled: &Compiled, options: EmitOptions) -> EmitOptions {
    let has = |target: &Target| compiled.emit(&options.clone().targets([*target])).is_ok();
    options.clone().targets(Target::ALL.into_iter().filter(has))
}

/// Every way in which a kernel can be emitted: options and the languages that support them.
fn ways(compiled: &Compiled) -> Vec<EmitOptions> {
    let function = EmitOptions::new().form(Form::Function);
    let all = [
        EmitOptions::new(),
        EmitOptions::new().region(true),
        EmitOptions::new().origin(Origin::LowerLeft),
        EmitOptions::new().stage(Stage::Fragment),
        function,
    ];
    let each = all.into_iter().map(|options| in_languages(compiled, options));
    each.filter(|options| !options.targets.is_empty()).collect()
}

/// Has a kernel under other names written in ways in which the original can be, and read.
fn written_and_read(name: &str, renamed: &Compiled, ways: Vec<EmitOptions>) -> usize {
    let mut texts = 0;
    for options in ways {
        let emitted = renamed.emit(&options);
        let emitted = emitted.unwrap_or_else(|e| panic!("{name} as {}: {e}\n{options:?}", renamed.kernel));
        texts += emitted.files.len();
        // A function is read in what calls it: see the engines.
        if options.form == Form::Entry {
            compilers::read(&emitted).unwrap_or_else(|e| panic!("{name} as {}: {e}", renamed.kernel));
        }
        for binding in &emitted.manifest.language_bindings {
            if let (Some(text), Some(bytes)) = (
                binding
                    .language
                    .parse::<Target>()
                    .ok()
                    .filter(|t| !matches!(t, Target::Spirv | Target::Msl)),
                emitted.files.get(&binding.language.parse().expect("a language")),
            ) {
                let has = String::from_utf8_lossy(bytes).contains(&binding.name);
                assert!(has, "{name}: {text} has no `{}`", binding.name);
            }
        }
    }
    texts
}

/// Values of each target, or of each buffer.
type Values = Vec<Vec<[f64; 4]>>;

/// Results of a kernel on inputs by name, on a GPU.
fn on_gpu(bench: &Bench, compiled: &Compiled, inputs: &Inputs) -> (Values, Values) {
    let written = bench.all_written(compiled, Stage::Compute, inputs);
    let (targets, buffers) = written.unwrap_or_else(|e| panic!("{}: {e}", compiled.kernel));
    let targets = targets.into_iter().map(|target| target.texels).collect();
    (targets, buffers.into_iter().map(|(_, values)| values).collect())
}

/// Checks that a renamed kernel computes the same, on a GPU and by the interpreter.
fn gives_the_same(bench: &Bench, name: &str, original: &Compiled, renamed: &Compiled) {
    let inputs = test_inputs(&original.graph, SIZE);
    let others = inputs_of(&original.graph, &renamed.graph, &inputs);
    let [expected, found] = [(original, &inputs), (renamed, &others)].map(|(compiled, inputs)| {
        let run = interpret_kernel::<f32>(compiled, inputs, false);
        run.unwrap_or_else(|e| panic!("{name}: {e}"))
    });
    assert_eq!(expected.targets.len(), found.targets.len(), "{name}");
    for (expected, found) in expected.targets.iter().zip(&found.targets) {
        same_texels(&expected.texels, &found.texels).unwrap_or_else(|e| panic!("{name} interpreted: {e}"));
    }
    // Quads that send messages are in no compute shader.
    if original.graph.invocation == Invocation::Lane && original.emit(&EmitOptions::new()).is_err() {
        return;
    }
    let [expected, found] = [on_gpu(bench, original, &inputs), on_gpu(bench, renamed, &others)];
    assert_eq!(expected.0.len(), found.0.len(), "{name}");
    for (expected, found) in expected.0.iter().chain(&expected.1).zip(found.0.iter().chain(&found.1)) {
        same_texels(expected, found).unwrap_or_else(|e| panic!("{name} on a GPU: {e}"));
    }
}

/// Every kernel of `shaders-out/` and of the gallery under reserved words.
#[test]
fn every_kernel_takes_reserved_words() {
    let bench = common::bench();
    let mut words = Words::new(1).listed();
    let all: Vec<_> = sources()
        .into_iter()
        .map(|(name, source)| {
            let original = source.compile().unwrap_or_else(|e| panic!("{name}:\n{e}"));
            let renamed = source.renamed(&mut words);
            let renamed = renamed.unwrap_or_else(|e| panic!("{name} under other names:\n{e}"));
            (name, original, renamed)
        })
        .collect();
    let texts: usize = all
        .par_iter()
        .map(|(name, original, renamed)| written_and_read(name, &renamed.compiled, one_way(original)))
        .sum();
    let given: usize = all.iter().map(|(.., renamed)| renamed.names.len()).sum();
    let mut run = 0;
    // Interpolated values need triangles.
    let is_run = |of: &Compiled| of.text_counts().statements < 200 && of.graph.varyings.is_empty();
    for (name, original, renamed) in all.iter().filter(|(_, original, _)| is_run(original)) {
        gives_the_same(&bench, name, original, &renamed.compiled);
        run += 1;
    }
    println!("{} kernels, {given} names, {texts} texts, {run} run", all.len());
    assert!(
        all.len() > 40 && given > 200 && run > 20,
        "{} kernels, {given} names, {run} run",
        all.len()
    );
}

/// Random names in every role.
#[test]
fn random_names_in_every_role() {
    let bench = common::bench();
    let rounds = std::env::var("STRAIGHTLINE_NAMES").map_or(12, |n| n.parse().expect("a number"));
    let texts: usize = (0..rounds)
        .into_par_iter()
        .map(|seed| {
            let mut words = Words::new(seed);
            let mut texts = 0;
            for (name, text) in ROLES {
                let source = roles(name, text);
                let original = source.compile().unwrap_or_else(|e| panic!("{name}:\n{e}"));
                let renamed = source.renamed(&mut words);
                let renamed = renamed.unwrap_or_else(|e| panic!("{name}, seed {seed}:\n{e}"));
                let shown = format!("{name}, seed {seed}, {:?}", renamed.names);
                texts += written_and_read(&shown, &renamed.compiled, ways(&original));
                gives_the_same(&bench, &shown, &original, &renamed.compiled);
            }
            texts
        })
        .sum();
    println!("{rounds} seeds, {texts} texts");
}

fn compile(text: &str, function: &str) -> Compiled {
    let compiled = Kernel::from_text("k.rs", text, function).compile(&Settings::default());
    compiled.unwrap_or_else(|e| panic!("{text}\n{e}"))
}

/// Names that are the same in two roles, and names that become the same.
#[test]
fn equal_names_are_told_apart() {
    let bench = common::bench();
    // (text, function, names of inputs, of uniforms, of outputs)
    type Case = (
        &'static str,
        &'static str,
        &'static [&'static str],
        &'static [&'static str],
        &'static [&'static str],
    );
    let cases: [Case; 7] = [
        (
            "pub struct Out { pub depth: Vec4, pub color: f32 }\npub fn k(depth: &Frame<Vec4>, color: &Texture<Vec4>, pixel: IVec2) -> Out { Out { \
             depth: depth.load(pixel) * 2.0, color: color.load(pixel).x } }",
            "k",
            &["depth", "color"],
            &[],
            &["depth", "color"],
        ),
        (
            "pub fn k(destination: &Frame<Vec4>, pixel: IVec2) -> Vec4 { destination.load(pixel) }",
            "k",
            &["destination"],
            &[],
            &["destination"],
        ),
        (
            "pub fn k(parameters: &Frame<Vec4>, region: f32, unfiltered: &Texture<Vec4>, pixel: IVec2) -> Vec4 { parameters.load(pixel) * region + \
             unfiltered.load(pixel) }",
            "k",
            &["parameters", "unfiltered", "parameters_"],
            &["region"],
            &["destination"],
        ),
        (
            "pub struct A { pub size: f32, pub image: Texture<Vec4> }\npub struct B { pub size: f32, pub image: Texture<Vec4> }\npub fn k(a: &A, b: &B, \
             color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) * a.size - b.size * a.image.load(pixel) + b.image.load(pixel) }",
            "k",
            &["a_image", "b_image", "color", "parameters"],
            &["a_size", "b_size"],
            &["destination"],
        ),
        (
            "pub fn k(a: [f32; 2], a_0: f32, m: Mat2, m_x_axis: f32, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) * a[0] + a[1] - a_0 + \
             (m * vec2(m_x_axis, 1.0)).extend(0.0).extend(0.0) }",
            "k",
            &["color", "parameters"],
            &["a_0_2", "a_1", "a_0", "m_x_axis_2", "m_y_axis", "m_x_axis"],
            &["destination"],
        ),
        (
            "pub fn k(k: &Frame<Vec4>, r#type: f32, r#color: f32, pixel: IVec2) -> Vec4 { k.load(pixel) * r#type + color }",
            "k",
            &["k", "parameters"],
            &["type", "color"],
            &["destination"],
        ),
        (
            "pub fn k(é: &Frame<Vec4>, ue9: &Frame<Vec4>, a__b: f32, a_b: f32, depth: &Texture<Vec4>, Depth: &Texture<Vec4>, pixel: IVec2) -> Vec4 { \
             é.load(pixel) * a__b + ue9.load(pixel) * a_b + depth.load(pixel) - Depth.load(pixel) }",
            "k",
            &["é", "ue9", "depth", "Depth", "parameters"],
            &["a__b", "a_b"],
            &["destination"],
        ),
    ];
    for (text, function, inputs, uniforms, outputs) in cases {
        let compiled = compile(text, function);
        written_and_read(text, &compiled, ways(&compiled));
        let emitted = compiled
            .emit(&EmitOptions::new())
            .unwrap_or_else(|e| panic!("{text}\n{e}"));
        let manifest = &emitted.manifest;
        let mut known: Vec<&str> = manifest.bindings.iter().map(|b| b.name.as_str()).collect();
        let mut wanted = inputs.to_vec();
        known.sort_unstable();
        wanted.sort_unstable();
        if text.contains("region: f32") {
            // The uniform buffer steps aside.
            assert!(known.contains(&"parameters_"), "{known:?}");
        }
        assert_eq!(known, wanted, "{text}");
        let known: Vec<&str> = manifest.outputs.iter().map(|o| o.name.as_str()).collect();
        assert_eq!(known, outputs, "{text}");
        let known: Vec<&str> = compiled.graph.uniforms.iter().map(|u| u.name.as_str()).collect();
        assert_eq!(known, uniforms, "{text}");
        gives_the_same(&bench, text, &compiled, &compiled);
    }
}

/// Numbers apply to the item of that name: to the input, if an output has the same name.
#[test]
fn numbers_of_equal_names_are_told_apart() {
    let text = "pub struct Out { pub depth: Vec4, pub seen: f32 }\npub fn k(depth: &Frame<Vec4>, parameters: f32, region: &Texture<Vec4>, pixel: IVec2) -> \
                Out { Out { depth: depth.load(pixel) * parameters, seen: region.load(pixel).x } }";
    let compiled = compile(text, "k");
    let options = EmitOptions::new()
        .region(true)
        .targets([Target::Wgsl, Target::Hlsl, Target::Glsl450])
        .binding("depth", 9)
        .binding("output.depth", 4)
        .binding("region", 5)
        .binding("region_", 6)
        .binding("parameters", 2);
    let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
    compilers::read(&emitted).unwrap_or_else(|e| panic!("{e}"));
    let number = |name: &str| emitted.manifest.binding(name).map(|binding| binding.binding);
    assert_eq!(
        (number("depth"), number("region"), number("region_")),
        (Some(9), Some(5), Some(6))
    );
    assert_eq!(number("parameters"), Some(2));
    assert_eq!(emitted.manifest.outputs[0].binding, Some(4));
    let regions = emitted.manifest.bindings.iter().filter(|binding| binding.is_region());
    assert_eq!(
        regions.map(|binding| binding.name.as_str()).collect::<Vec<_>>(),
        ["region_"]
    );
    let error = compiled.emit(&EmitOptions::new().binding("output.seen", 1));
    let error = error.expect_err("no such name").to_string();
    assert!(error.contains("output.seen"), "{error}");
}

/// A name that begins as a type of HLSL does, in every language; it made `emit` run without end.
#[test]
fn names_that_begin_as_types_do() {
    for name in [
        "texture0",
        "texture2d_albedo",
        "sampler0",
        "samplerCUBE",
        "samplerCUBE_0",
        "float4_0",
        "image2D_",
        "to_vec2i_2",
    ] {
        let text = format!("pub fn k({name}: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{ {name}.load(pixel) }}");
        let compiled = compile(&text, "k");
        written_and_read(name, &compiled, ways(&compiled));
    }
}

/// The manifest says what stands for what.
#[test]
fn the_manifest_says_what_stands_for_what() {
    let text = "pub fn k(filter: &Frame<Vec4>, sampler: &Sampler, texture: &Texture<Vec4>, log: f32, lerp: f32, pixel: IVec2) -> Vec4 { filter.load(pixel) \
                * log + texture.sample(sampler, vec2(lerp, 0.5)) }";
    let compiled = compile(text, "k");
    let emitted = compiled.emit(
        &EmitOptions::new().targets(
            Target::ALL
                .into_iter()
                .filter(|t| !matches!(t, Target::Glsl330 | Target::Essl300)),
        ),
    );
    let manifest = emitted.unwrap_or_else(|e| panic!("{e}")).manifest;
    let spelled = |language: Target, of: &str| {
        let mut all = manifest.language_bindings.iter();
        let found = all.find(|b| {
            b.language == language.to_string() && (b.of.as_deref() == Some(of) || b.texture.as_deref() == Some(of))
        });
        found.map(|b| (b.name.as_str(), b.kind))
    };
    use LanguageKind::{CombinedSampler, Member, Sampler, Texture, Uniform};
    assert_eq!(spelled(Target::Wgsl, "filter"), Some(("filter_", Texture)));
    assert_eq!(spelled(Target::Wgsl, "sampler"), Some(("sampler_", Sampler)));
    assert_eq!(spelled(Target::Wgsl, "log"), Some(("log_", Member)));
    assert_eq!(spelled(Target::Wgsl, "lerp"), None);
    assert_eq!(spelled(Target::Hlsl, "filter"), Some(("filter", Texture)));
    assert_eq!(spelled(Target::Hlsl, "lerp"), Some(("lerp_", Member)));
    assert_eq!(spelled(Target::Glsl430, "filter"), Some(("filter_", CombinedSampler)));
    assert_eq!(spelled(Target::Glsl430, "log"), Some(("log_", Uniform)));
    assert_eq!(spelled(Target::Glsl430, "lerp"), Some(("lerp", Uniform)));
    assert!(manifest.binding("filter").is_some() && manifest.binding("texture").is_some());
}

/// A name that is asked for is given or refused, never another one.
#[test]
fn entry_points_are_called_as_asked() {
    let compiled = compile(
        "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) }",
        "k",
    );
    let emitted = compiled.emit(&EmitOptions::new().targets([Target::Wgsl, Target::Hlsl]).entry("color"));
    let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(emitted.manifest.entry_point, "color");
    compilers::read(&emitted).unwrap_or_else(|e| panic!("{e}"));
    let refused = compiled.emit(&EmitOptions::new().entry("parameters"));
    let code = refused.as_ref().err().and_then(|errors| errors.first_code());
    assert_eq!(code, Some(Code::EntryName), "{refused:?}");
}

/// Runs a program on a text, to see whether it is one of its language.
fn judged(program: &str, package: &str, arguments: &[&str], ending: &str, text: &str) -> Result<(), String> {
    use std::sync::atomic::{AtomicU32, Ordering};
    static NEXT: AtomicU32 = AtomicU32::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let path = std::env::temp_dir().join(format!("straightline-names-{}-{number}.{ending}", std::process::id()));
    std::fs::write(&path, text).map_err(|e| e.to_string())?;
    let ran = Command::new(program).args(arguments).arg(&path).output();
    let _ = std::fs::remove_file(&path);
    let ran = ran.map_err(|e| format!("cannot run {program} ({e}): install Debian's {package}"))?;
    match ran.status.success() {
        true => Ok(()),
        false => Err(format!(
            "{program} refuses it: {}\n{text}",
            String::from_utf8_lossy(&ran.stderr)
        )),
    }
}

/// Has the files of an engine read by parsers of the languages that they are in. C is read with the header's shaders.
fn host_reads(files: &BTreeMap<String, String>) -> Result<(), String> {
    for (name, text) in files {
        match name.rsplit_once('.').map_or("", |(_, ending)| ending) {
            "js" | "mjs" => judged("node", "nodejs", &["--check"], "mjs", text)?,
            "py" => {
                let reads = [
                    "-c",
                    "import ast, sys; ast.parse(open(sys.argv[1], encoding='utf-8').read())",
                ];
                judged("python3", "python3", &reads, "py", text)?;
            }
            "rs" => drop(syn::parse_file(text).map_err(|e| format!("not Rust: {e}\n{text}"))?),
            _ => {}
        }
    }
    Ok(())
}

/// Random names in every template: compilers read the shaders, parsers of the hosts' languages what is around them, and
/// shaders of one engine agree on names.
#[test]
fn random_names_in_every_template() {
    let rounds = std::env::var("STRAIGHTLINE_NAMES").map_or(4, |n| n.parse().expect("a number"));
    let subjects: Vec<(&str, Source)> = ROLES.iter().map(|(name, text)| (*name, roles(name, text))).collect();
    let mut read = BTreeMap::<&str, usize>::new();
    for (name, source) in &subjects {
        let original = source.compile().unwrap_or_else(|e| panic!("{name}:\n{e}"));
        let fitting: BTreeSet<&str> = engine_names()
            .filter(|engine| Engine::builtin(engine).is_some_and(|e| e.fits_kernel(&Request::new(&original, &[]))))
            .collect();
        let found: Vec<&str> = (0..rounds)
            .into_par_iter()
            .flat_map(|seed| {
                let mut words = Words::new(1000 + seed);
                let renamed = source
                    .renamed(&mut words)
                    .unwrap_or_else(|e| panic!("{name}, seed {seed}:\n{e}"));
                let kernel = Kernel::from_text("k.rs", &renamed.text, &renamed.compiled.kernel);
                let options = kernel.options().unwrap_or_else(|e| panic!("{name}, seed {seed}:\n{e}"));
                let request = Request::new(&renamed.compiled, &options);
                for engine in &fitting {
                    let shown = format!("{name} for {engine}, seed {seed}, {:?}", renamed.names);
                    let found = Engine::builtin(engine).expect("an engine");
                    let picture = renamed.names.get("color").map_or("color", String::as_str);
                    let request = match found.description().meanings.is_empty() {
                        true => request.clone(),
                        false => request.clone().bind(picture, "color"),
                    };
                    let files = found.render_files(&request).unwrap_or_else(|e| panic!("{shown}: {e}"));
                    let files: BTreeMap<String, String> = files
                        .into_iter()
                        .map(|(name, bytes)| (name, String::from_utf8(bytes).expect("text")))
                        .collect();
                    readable::check(engine, &files).unwrap_or_else(|e| panic!("{shown}: {e}"));
                    host_reads(&files).unwrap_or_else(|e| panic!("{shown}: {e}"));
                    let context = found.context(&request).unwrap_or_else(|e| panic!("{shown}: {e}"));
                    let spelled = context.shaders.values().map(|shader| {
                        let given = shader.arguments.iter().filter(|a| a.kind != "sampler");
                        given
                            .map(|a| (a.of.clone(), a.name.clone()))
                            .collect::<BTreeMap<_, _>>()
                    });
                    let spelled: BTreeSet<_> = spelled.collect();
                    assert_eq!(spelled.len(), 1, "{shown}: {spelled:?}");
                }
                fitting.iter().copied().collect::<Vec<_>>()
            })
            .collect();
        for engine in found {
            *read.entry(engine).or_default() += 1;
        }
    }
    for engine in engine_names() {
        assert!(read.contains_key(engine), "no kernel of the roles fits {engine}");
    }
    println!("{read:?}");
}
