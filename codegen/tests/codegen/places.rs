//! Groups, numbers, registers, names, forms and origins that users give: where they stand in every language, and what is refused.

use crate::compilers;

use compilers::read;
use straightline_codegen::emit::{Emitted, Parameters, Target};
use straightline_codegen::{Compiled, EmitOptions, Form, Kernel, Manifest, Origin, Precision, Settings, Stage};
use straightline_manifest::{LanguageKind, hash_of_text};

/// A kernel with each kind of resource.
const ALL: &str = "pub fn all(color: &Frame<Vec4>, image: &Texture<Vec4>, linear: &Sampler, weights: &Buffer<f32>, tau: f32, \
                   pixel: IVec2) -> Vec4 {\n    let uv = (pixel.as_vec2() + 0.5) / image.size().as_vec2();\n    \
                   color.load(pixel + ivec2(1, 2)) * tau + image.sample(linear, uv) * weights.load((pixel.x % 3) as usize)\n}\n";

/// A kernel that can be a function in every language that has functions with its inputs.
const TAKES: &str = "pub fn takes(color: &Frame<Vec4>, image: &Texture<Vec4>, linear: &Sampler, tau: f32, frame: Vec2, pixel: \
                     IVec2) -> Vec4 {\n    let uv = (pixel.as_vec2() + 0.5) / image.size().as_vec2();\n    let table = [0.1, 0.7, \
                     0.2];\n    color.load(pixel + ivec2(1, 2)) * tau + image.sample(linear, uv) * table[(pixel.x % 3) as usize] \
                     * frame.x * ((pixel.y / pixel.x) as f32)\n}\n";

fn kernel(text: &str, name: &str) -> Compiled {
    let compiled = Kernel::from_text("kernel.rs", text, name).compile(&Settings::default());
    compiled.unwrap_or_else(|e| panic!("{e}"))
}

fn emitted(compiled: &Compiled, options: &EmitOptions) -> Emitted {
    let emitted = compiled.emit(options).unwrap_or_else(|e| panic!("{e}"));
    if options.form == Form::Entry {
        read(&emitted).unwrap_or_else(|e| panic!("{e}"));
    }
    emitted
}

fn text(emitted: &Emitted, target: Target) -> String {
    String::from_utf8(emitted.files[&target].clone()).expect("text")
}

fn says(text: &str, lines: &[&str]) {
    for line in lines {
        assert!(text.contains(line), "no `{line}` in\n{text}");
    }
}

fn refused(compiled: &Compiled, options: &EmitOptions, words: &[&str]) {
    let error = compiled.emit(options).expect_err("a refusal").to_string();
    for word in words {
        assert!(error.contains(word), "no `{word}` in: {error}");
    }
    assert!(error.contains(&format!("`{}`", compiled.kernel)), "{error}");
}

fn numbered() -> EmitOptions {
    EmitOptions::new()
        .targets([
            Target::Wgsl,
            Target::Glsl450,
            Target::Glsl430,
            Target::Essl310,
            Target::Hlsl,
            Target::Spirv,
            Target::Msl,
        ])
        .group(2)
        .binding("parameters", 0)
        .binding("color", 7)
        .register("color", "t9".parse().expect("a register"))
        .register("linear", "s0,space0".parse().expect("a register"))
        .entry("filter_all")
}

#[test]
fn every_language_has_the_numbers() {
    let compiled = kernel(ALL, "all");
    let all = emitted(&compiled, &numbered());
    says(
        &text(&all, Target::Wgsl),
        &[
            "@group(2) @binding(7) var color: texture_2d<f32>;",
            "@group(2) @binding(1) var image: texture_2d<f32>;",
            "@group(2) @binding(2) var<storage, read> weights: array<f32>;",
            "@group(2) @binding(3) var linear: sampler;",
            "@group(2) @binding(4) var destination: texture_storage_2d<rgba16float, write>;",
            "@group(2) @binding(0) var<uniform> parameters: Parameters;",
            "fn filter_all(",
        ],
    );
    says(
        &text(&all, Target::Glsl450),
        &[
            "layout(set = 2, binding = 7) uniform texture2D color;",
            "layout(std430, set = 2, binding = 2) readonly buffer weights_buffer",
            "layout(set = 2, binding = 3) uniform sampler linear;",
            "layout(set = 2, binding = 4, rgba16f) uniform writeonly image2D destination;",
            "layout(std140, set = 2, binding = 0) uniform Parameters {",
            "layout(set = 2, binding = 5) uniform sampler unfiltered;",
        ],
    );
    for target in [Target::Glsl430, Target::Essl310] {
        says(
            &text(&all, target),
            &[
                "layout(binding = 7) uniform sampler2D color;",
                "layout(binding = 1) uniform sampler2D image;",
                "layout(std430, binding = 2) readonly buffer",
                "uniform float tau;",
            ],
        );
    }
    says(
        &text(&all, Target::Hlsl),
        &[
            "Texture2D<float4> color : register(t9, space2);",
            "Texture2D<float4> image : register(t1, space2);",
            "StructuredBuffer<float> weights : register(t2, space2);",
            "SamplerState linear_ : register(s0);",
            "RWTexture2D<float4> destination : register(u4, space2);",
            "cbuffer Parameters_buffer : register(b0, space2)",
            "void filter_all(",
        ],
    );
    says(
        &text(&all, Target::Msl),
        &[
            "color [[texture(7)]]",
            "image [[texture(1)]]",
            "[[sampler(3)]]",
            "destination [[texture(4)]]",
            "parameters [[buffer(0)]]",
            "_buffer_sizes [[buffer(5)]]",
            "filter_all(",
        ],
    );
    let manifest = &all.manifest;
    let numbers: Vec<_> = manifest
        .bindings
        .iter()
        .map(|b| (b.name.as_str(), b.group, b.binding))
        .collect();
    let expected = [
        ("parameters", 2, 0),
        ("image", 2, 1),
        ("weights", 2, 2),
        ("linear", 2, 3),
        ("color", 2, 7),
    ];
    assert_eq!(numbers, expected);
    assert_eq!(
        (manifest.outputs[0].group, manifest.outputs[0].binding),
        (Some(2), Some(4))
    );
    assert_eq!(manifest.entry_point, "filter_all");
    let names: Vec<_> = manifest
        .entry_points
        .iter()
        .map(|(k, v)| (k.as_str(), v.as_str()))
        .collect();
    assert_eq!(names, [("essl310", "main"), ("glsl430", "main"), ("glsl450", "main")]);
}

/// The bindings that the manifest lists for each language are those in its text, without omissions.
#[test]
fn the_manifest_lists_what_every_language_binds() {
    let compiled = kernel(ALL, "all");
    let all = emitted(&compiled, &numbered());
    let json = all.manifest.to_json();
    assert_eq!(Manifest::from_json(&json).expect("its own JSON"), all.manifest);
    let of = |language: &'static str| {
        all.manifest
            .language_bindings
            .iter()
            .filter(move |b| b.language == language)
    };
    for language in ["glsl450", "glsl430", "essl310", "hlsl", "msl"] {
        let target: Target = language.parse().expect("a language");
        let text = text(&all, target);
        for bound in of(language) {
            let place = match (language, bound.kind, bound.binding) {
                ("hlsl", ..) => {
                    let register = bound.register.as_deref().expect("a register");
                    let space = bound.space.map_or(String::new(), |space| format!(", space{space}"));
                    format!("register({register}{space})")
                }
                ("msl", LanguageKind::Texture | LanguageKind::StorageTexture, Some(n)) => format!("[[texture({n})]]"),
                ("msl", LanguageKind::Sampler, Some(n)) => format!("[[sampler({n})]]"),
                ("msl", _, Some(n)) => format!("[[buffer({n})]]"),
                ("glsl450", _, Some(n)) => format!("set = {}, binding = {n}", bound.group.expect("a set")),
                (_, _, Some(n)) => format!("binding = {n}"),
                (_, kind, None) => {
                    assert_eq!(kind, LanguageKind::Uniform, "{bound:?}");
                    "uniform float".to_owned()
                }
            };
            let stands = text
                .lines()
                .any(|line| line.contains(&place) && line.contains(&bound.name))
                || (language == "hlsl" && bound.kind == LanguageKind::UniformBuffer && text.contains(&place));
            let is_block = language == "glsl450" && bound.kind == LanguageKind::UniformBuffer;
            assert!(
                stands || (is_block && text.contains(&place)),
                "{bound:?} is not in\n{text}"
            );
        }
    }
    // color, image, weights, linear, destination, parameters; GLSL 4.50 one more sampler, MSL the lengths of buffers.
    assert_eq!(of("hlsl").count(), 6);
    assert_eq!(of("glsl450").count(), 7);
    assert_eq!(of("msl").count(), 7);
    // color, image with linear, weights, destination, tau.
    assert_eq!(of("glsl430").count(), 5);
    let renamed = of("hlsl")
        .find(|b| b.name == "linear_")
        .expect("a word of HLSL is renamed");
    assert_eq!(renamed.of.as_deref(), Some("linear"));
    // The words of WebGPU.
    says(
        &json,
        &[
            r#""view_dimension": "2d""#,
            r#""multisampled": false"#,
            r#""sample_type": "unfilterable-float""#,
            r#""sample_type": "float""#,
            r#""sampler_type": "filtering""#,
            r#""buffer_type": "read-only-storage""#,
            r#""buffer_type": "uniform""#,
            r#""access": "write-only""#,
            r#""format": "rgba16float""#,
        ],
    );
}

#[test]
fn hashes_are_those_of_the_texts() {
    let all = emitted(&kernel(ALL, "all"), &numbered());
    assert_eq!(all.manifest.hashes.len(), all.files.len());
    for target in [Target::Wgsl, Target::Hlsl, Target::Msl, Target::Essl310] {
        assert_eq!(
            all.manifest.hashes[&target.to_string()],
            hash_of_text(&text(&all, target))
        );
    }
}

#[test]
fn numbers_and_registers_that_cannot_be_are_refused() {
    let compiled = kernel(ALL, "all");
    let new = EmitOptions::new;
    let hlsl = || EmitOptions::new().targets([Target::Hlsl]);
    let register = |text: &str| text.parse().expect("a register");
    refused(&compiled, &new().group(32), &["bind group 32", "0 to 31"]);
    refused(
        &compiled,
        &new().binding("color", 1000),
        &["1000", "`color`", "0 to 999"],
    );
    refused(
        &compiled,
        &new().binding("colour", 1),
        &["nothing called `colour`", "did you mean `color`"],
    );
    refused(
        &compiled,
        &new().binding("tau", 1),
        &["nothing called `tau`", "parameters"],
    );
    let twice = new().binding("color", 3).binding("image", 3);
    refused(&compiled, &twice, &["number 3", "`color`", "`image`", "of its own"]);
    let two = new().binding("color", 3).binding("color", 4);
    refused(&compiled, &two, &["`color`", "3 and 4"]);
    refused(&compiled, &new().binding("unfiltered", 9), &["`unfiltered`", "glsl450"]);
    let fragment = new().stage(Stage::Fragment).binding("destination", 3);
    refused(&compiled, &fragment, &["`destination`", "location 0"]);
    refused(
        &compiled,
        &new().register("color", register("t1")),
        &["HLSL is not written", "hlsl"],
    );
    refused(
        &compiled,
        &hlsl().register("color", register("s1")),
        &["s1", "`color`", "register t1"],
    );
    refused(
        &compiled,
        &hlsl().register("linear", register("b1")),
        &["a sampler", "register s1"],
    );
    refused(
        &compiled,
        &hlsl().register("parameters", register("t1")),
        &["a uniform buffer", "register b1"],
    );
    refused(
        &compiled,
        &hlsl().register("destination", register("t1")),
        &["written", "register u1"],
    );
    refused(
        &compiled,
        &hlsl().register("color", register("t1")),
        &["`color` and `image`", "t1", "both a register"],
    );
    let msl = new().targets([Target::Msl]).binding("linear", 16);
    refused(&compiled, &msl, &["16", "sampler", "0 to 15", "msl"]);
    let buffer = new().targets([Target::Msl]).binding("weights", 31);
    refused(&compiled, &buffer, &["31", "buffer", "0 to 30"]);
    // Default numbers may be set explicitly.
    assert!(
        compiled
            .emit(&new().binding("color", 0).binding("destination", 4))
            .is_ok()
    );
}

#[test]
fn names_that_no_entry_point_can_have_are_refused() {
    let compiled = kernel(ALL, "all");
    let with = |name: &str, target: Target| EmitOptions::new().targets([target]).entry(name);
    for name in ["", "2d", "a b", "_a", "é", "a-b"] {
        refused(&compiled, &with(name, Target::Wgsl), &["is not a letter"]);
    }
    refused(&compiled, &with("a__b", Target::Wgsl), &["two underscores"]);
    refused(&compiled, &with(&"a".repeat(300), Target::Wgsl), &["longer than"]);
    refused(&compiled, &with("fn", Target::Wgsl), &["`fn`", "word of WGSL"]);
    refused(&compiled, &with("technique", Target::Hlsl), &["word of HLSL"]);
    refused(&compiled, &with("kernel", Target::Msl), &["word of MSL"]);
    refused(&compiled, &with("parameters", Target::Wgsl), &["has a use for"]);
    // Words of another language than those that are written are names like any other.
    for (name, target) in [
        ("technique", Target::Wgsl),
        ("kernel", Target::Wgsl),
        ("main", Target::Wgsl),
        ("main", Target::Hlsl),
        // Inputs and what is made of their names step aside.
        ("color", Target::Wgsl),
        ("size_of_color", Target::Hlsl),
    ] {
        let all = emitted(&compiled, &with(name, target));
        assert!(text(&all, target).contains(&format!("{name}(")));
    }
    let digits = emitted(&compiled, &with("filter2", Target::Msl));
    assert_eq!(digits.manifest.entry_points["msl"], "filter2_");
    assert!(text(&digits, Target::Msl).contains("filter2_("));
}

#[test]
fn a_function_takes_what_it_reads() {
    let compiled = kernel(TAKES, "takes");
    let options = EmitOptions::new().form(Form::Function).targets([
        Target::Wgsl,
        Target::Hlsl,
        Target::Glsl450,
        Target::Glsl430,
        Target::Glsl330,
        Target::Essl310,
        Target::Essl300,
    ]);
    let all = emitted(&compiled, &options);
    let wgsl = text(&all, Target::Wgsl);
    // three.js finds the function by what a text begins with.
    let head = "fn takes(color: texture_2d<f32>, image: texture_2d<f32>, linear: sampler, position: vec2f, tau: f32, \
                frame_: vec2f) -> vec4f {\n    // takes\n";
    assert!(wgsl.starts_with(head), "{wgsl}");
    let caller = "@group(0) @binding(0) var c: texture_2d<f32>;\n@group(0) @binding(1) var s: sampler;\n@fragment\nfn main(@builtin(position) \
                  at: vec4f) -> @location(0) vec4f {\n    return takes(c, c, s, at.xy, 0.5, vec2f(2.0));\n}\n";
    compiles(&format!("{wgsl}\n{caller}"), "caller.wgsl", compilers::tint);
    let hlsl = text(&all, Target::Hlsl);
    says(
        &hlsl,
        &[
            "float4 takes(Texture2D<float4> color, Texture2D<float4> image, SamplerState linear_, float2 position, float tau, float2 frame_) {",
        ],
    );
    assert!(!hlsl.contains("register"), "{hlsl}");
    let caller = "Texture2D<float4> c;\nSamplerState s;\nfloat4 main(float4 at : SV_Position) : SV_Target0 {\n    return takes(c, c, s, at.xy, \
                  0.5, float2(2.0, 2.0));\n}\n";
    let hlsl = |path: &std::path::Path| compilers::hlsl(path, Stage::Fragment, "main");
    compiles(&format!("{}\n{caller}", text(&all, Target::Hlsl)), "caller.hlsl", hlsl);
    let vulkan = "layout(set = 0, binding = 0) uniform texture2D c;\nlayout(set = 0, binding = 1) uniform sampler s;\nlayout(location = 0) \
                  out vec4 result;\nvoid main() {\n    result = takes(c, c, s, s, gl_FragCoord.xy, 0.5, vec2(2.0));\n}\n";
    let vulkan = format!("#version 450\n{}\n{vulkan}", text(&all, Target::Glsl450));
    compiles(&vulkan, "caller.frag", compilers::glsl);
    for (target, version) in [
        (Target::Glsl430, "430"),
        (Target::Glsl330, "330"),
        (Target::Essl310, "310 es"),
        (Target::Essl300, "300 es"),
    ] {
        let caller = "uniform sampler2D c;\nout vec4 result;\nvoid main() {\n    result = takes(c, c, gl_FragCoord.xy, 0.5, \
                      vec2(2.0));\n}\n";
        let caller = caller.replace(
            "out vec4",
            if target == Target::Essl300 {
                "layout(location = 0) out vec4"
            } else {
                "out vec4"
            },
        );
        let glsl = format!("#version {version}\n{}\n{caller}", text(&all, target));
        compiles(&glsl, "caller.frag", compilers::opengl);
    }
    let buffers = emitted(&kernel(ALL, "all"), &options.clone().targets([Target::Hlsl]));
    let caller = "Texture2D<float4> c;\nSamplerState s;\nStructuredBuffer<float> w;\nfloat4 main(float4 at : SV_Position) : SV_Target0 {\n    \
                  return all_of(c, c, w, s, at.xy, 0.5);\n}\n";
    // `all` is a word of HLSL.
    let caller = caller.replace("all_of", &buffers.manifest.entry_point);
    compiles(
        &format!("{}\n{caller}", text(&buffers, Target::Hlsl)),
        "buffers.hlsl",
        hlsl,
    );
    let manifest = &all.manifest;
    assert_eq!((manifest.form, manifest.stage), (Form::Function, Stage::Fragment));
    let taken = |language: &str| -> Vec<String> {
        let bindings = manifest.language_bindings.iter().filter(|b| b.language == language);
        bindings.map(|b| b.name.clone()).collect()
    };
    assert_eq!(taken("wgsl"), ["color", "image", "linear", "position", "tau", "frame_"]);
    assert_eq!(
        taken("hlsl"),
        ["color", "image", "linear_", "position", "tau", "frame_"]
    );
    assert_eq!(taken("glsl330"), ["color", "image", "position", "tau", "frame_"]);
    let names = all.named_files("takes");
    assert!(
        names.contains_key("takes.es300.glsl") && names.contains_key("takes.wgsl"),
        "{:?}",
        names.keys()
    );
}

/// Uniforms as immediates have a number in HLSL and MSL alone, after all others.
#[test]
fn immediates_have_no_number() {
    let compiled = kernel(ALL, "all");
    let options = EmitOptions::new()
        .targets(Target::MODERN)
        .region(true)
        .group(2)
        .parameters(Parameters::Immediate);
    let all = emitted(&compiled, &options);
    let lines = [
        (Target::Wgsl, "\nvar<immediate> parameters: Parameters;\n"),
        (Target::Wgsl, "@group(2) @binding(5) var<uniform> region: Region;"),
        (
            Target::Glsl450,
            "layout(push_constant) uniform Parameters {\n    float tau;\n} parameters;",
        ),
        (
            Target::Hlsl,
            "#ifdef __spirv__\n[[vk::push_constant]]\n#endif\nConstantBuffer<Parameters> parameters : register(b6, space2);",
        ),
        (Target::Msl, "constant Parameters& parameters [[buffer(6)]]"),
    ];
    for (target, line) in lines {
        says(&text(&all, target), &[line]);
    }
    let manifest = &all.manifest;
    assert_eq!(manifest.features, ["immediates"]);
    assert!(manifest.binding("parameters").is_none());
    let immediates = manifest.immediates.as_ref().expect("immediates");
    assert_eq!((immediates.name.as_str(), immediates.size), ("parameters", 16));
    let listed = manifest.language_bindings.iter();
    let listed = listed.filter(|bound| bound.kind == LanguageKind::Immediates);
    let listed: Vec<_> = listed
        .map(|bound| (bound.language.as_str(), bound.binding, bound.register.as_deref()))
        .collect();
    let wanted = [
        ("glsl450", None, None),
        ("hlsl", None, Some("b6")),
        ("msl", Some(6), None),
    ];
    assert_eq!(listed, wanted);
    let chosen = options
        .clone()
        .register("parameters", "b3".parse().expect("a register"));
    says(
        &text(&emitted(&compiled, &chosen), Target::Hlsl),
        &["parameters : register(b3, space2)"],
    );

    let opengl = EmitOptions::new().targets([Target::Glsl430]);
    let [loose, immediate] = [Parameters::Uniform, Parameters::Immediate]
        .map(|space| text(&emitted(&compiled, &opengl.clone().parameters(space)), Target::Glsl430));
    assert_eq!(loose, immediate);

    let copy = "pub fn copy(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel)\n}\n";
    let copy = emitted(&kernel(copy, "copy"), &options);
    assert!(copy.manifest.immediates.is_none() && copy.manifest.features.is_empty());
}

/// Writes a text and shows it to a compiler.
fn compiles(text: &str, name: &str, compiler: impl Fn(&std::path::Path) -> Result<(), String>) {
    let folder = std::env::temp_dir().join(format!("straightline-function-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a file");
    compiler(&path).unwrap_or_else(|why| panic!("{why}\n{text}"));
    std::fs::remove_dir_all(&folder).expect("it goes");
}

#[test]
fn what_cannot_be_a_function_is_refused() {
    let function = || EmitOptions::new().form(Form::Function);
    let takes = kernel(TAKES, "takes");
    refused(
        &takes,
        &function().targets([Target::Spirv]),
        &["spirv", "whole shader", "`entry`"],
    );
    refused(&takes, &function().targets([Target::Msl]), &["msl"]);
    refused(&takes, &function().region(true), &["`region`"]);
    refused(&takes, &function().binding("color", 1), &["binds nothing", "`color`"]);
    refused(&takes, &function().group(1), &["binds nothing", "group 1"]);
    let immediate = function().parameters(Parameters::Immediate);
    refused(&takes, &immediate, &["binds nothing", "`parameters` as `immediate`"]);
    refused(&kernel(ALL, "all"), &function(), &["buffer `weights`", "wgsl", "hlsl"]);
    refused(&takes, &function().entry("main"), &["`main`", "has a use for"]);
    let workgroup = function().workgroup(8, 8);
    refused(&takes, &workgroup, &["no workgroup"]);
    let subgroups = function().enable_subgroups(true);
    refused(&takes, &subgroups, &["`enable subgroups;`"]);
}

#[test]
fn what_cannot_count_rows_from_below_is_refused() {
    let below = || EmitOptions::new().origin(Origin::LowerLeft);
    let pcf = Kernel::builtin("pcf")
        .and_then(|k| k.compile(&Settings::default()))
        .expect("it compiles");
    refused(
        &pcf,
        &below().stage(Stage::Fragment),
        &["pixel quads", "odd height", "transport `block`"],
    );
    assert!(
        pcf.emit(&below()).is_ok(),
        "whole quads have no device's quads to agree with"
    );
    let half = below().precision(Precision::F16);
    refused(&kernel(ALL, "all"), &half, &["half precision", "f32"]);
    for stage in [Stage::Compute, Stage::Fragment] {
        for region in [false, true] {
            let options = below().stage(stage).region(region).targets(Target::MODERN);
            let all = emitted(&kernel(ALL, "all"), &options);
            assert_eq!(all.manifest.origin, Origin::LowerLeft);
            says(&text(&all, Target::Wgsl), &["rows from below"]);
        }
    }
}
