//! Emitted shaders: checked by several compilers, and compared with expected text.

use crate::compilers;

use compilers::{FUNCTION, LABEL, instructions, read};
use straightline_codegen::diagnostic::Code;
use straightline_codegen::emit::{Emitted, Target, Texels};
use straightline_codegen::{Branches, Compiled, EmitOptions, Form, Kernel, Settings, Stage, Transport, Unroll};
use straightline_manifest::LanguageKind;

fn settings(unroll: Unroll, branches: Branches) -> Settings {
    Settings::new().unroll(unroll).branches(branches)
}

fn compile(text: &str, unroll: Unroll, branches: Branches) -> Compiled {
    let compiled = Kernel::from_text("kernel.rs", text, "k").compile(&settings(unroll, branches));
    compiled.unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// The kernel in every language, each text read by the compilers that there are.
fn emit(compiled: &Compiled, stage: Stage) -> Emitted {
    let emitted = compiled.emit(&EmitOptions::new().targets(Target::MODERN).stage(stage));
    let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
    read(&emitted).unwrap_or_else(|e| panic!("{stage:?}: {e}"));
    emitted
}

/// The kernel in two forms and two stages; the unrolled one for compute is given back.
fn emit_all(text: &str) -> Emitted {
    let mut first = None;
    for (unroll, branches) in [(Unroll::Full, Branches::Select), (Unroll::None, Branches::Keep)] {
        let compiled = compile(text, unroll, branches);
        for stage in [Stage::Compute, Stage::Fragment] {
            let emitted = emit(&compiled, stage);
            first.get_or_insert(emitted);
        }
    }
    first.expect("a form")
}

fn text(emitted: &Emitted, target: Target) -> String {
    String::from_utf8(emitted.files[&target].clone()).expect("text")
}

fn words(emitted: &Emitted) -> Vec<u32> {
    let bytes = emitted.files[&Target::Spirv].chunks_exact(4);
    bytes.map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect()
}

/// Floats at the edges of the range, and of rounding: all compilers take them, and two read the same bits.
#[test]
fn floats_are_read_as_the_same_bits() {
    let mut bits: Vec<u32> = [f32::MAX, f32::MIN_POSITIVE, 0.1].map(f32::to_bits).into();
    bits.extend([1, 0x007f_ffff]);
    let mut state = 0x9e37_79b9u32;
    while bits.len() < 200 {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let x = f32::from_bits(state);
        if x.is_finite() && x > 0.0 {
            bits.push(state);
        }
    }
    let line = |b: &u32| {
        let x = f64::from(f32::from_bits(*b));
        format!("    sum = sum.max(color.load(pixel).x * {x:?});\n")
    };
    let terms: String = bits.iter().map(line).collect();
    let kernel = format!(
        "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{\n    let mut sum = 0.0;\n{terms}    sum = sum.max(-3.4028234663852886e38);\n    \
         Vec4::splat(sum)\n}}\n"
    );
    let emitted = emit_all(&kernel);
    let known = compilers::constants(&words(&emitted));
    let glsl = compilers::compiled_glsl(&text(&emitted, Target::Glsl450), "comp").expect("glslang reads it");
    let glsl = compilers::constants(&glsl);
    for b in &bits {
        let x = f32::from_bits(*b);
        assert!(known.contains(b), "{x:?} is not in the SPIR-V");
        assert!(glsl.contains(b), "glslang reads {x:?} otherwise");
    }
}

/// Infinities and NaN are constants of kernels too.
#[test]
fn numbers_that_are_not_finite_are_emitted() {
    let kernel = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
        let far = 3.0e38 * 2.0;
        let mut nearest = far;
        let mut largest = -far;
        for i in 0..3 {
            let d = color.load(pixel + ivec2(i, 0)).x;
            nearest = nearest.min(d);
            largest = largest.max(d);
        }
        let table = [far, 1.0, nearest];
        vec4(nearest, largest, table[(pixel.x & 1) as usize], far - far)
    }";
    let emitted = emit_all(kernel);
    let (wgsl, glsl) = (text(&emitted, Target::Wgsl), text(&emitted, Target::Glsl450));
    assert!(wgsl.contains("let infinity = bitcast<f32>(infinity_bits);"), "{wgsl}");
    assert!(glsl.contains("uintBitsToFloat(0x7f800000u)"), "{glsl}");
}

/// Integers by scalars and vectors, known and not, of both kinds of signs.
#[test]
fn divisions_of_integers_compile_everywhere() {
    let kernel = "pub fn k(color: &Frame<Vec4>, n: i32, m: u32, v: IVec2, pixel: IVec2) -> Vec4 {
        let a = pixel / n + pixel % n + n / pixel;
        let b = pixel / v + pixel % v + v / 3 + v % 3 + v % ivec2(2, -7) + v / -1;
        let c = n / 3 + n % 3 + pixel.x / 2 + pixel.y % 4 + 7 / n + 7 % n;
        let d = m / 3 + m % 5 + m / m + m % m + pixel.x as u32 / m;
        let e = color.load(a + b);
        e + vec4(c as f32, d as f32, 0.0, 0.0)
    }";
    let emitted = emit_all(kernel);
    let glsl = text(&emitted, Target::Glsl450);
    for plain in [
        "pixel.x >> 1",
        "pixel.y & 3",
        "parameters.m / 3u",
        "parameters.m % 5u",
        "parameters.n / 3",
    ] {
        assert!(glsl.contains(plain), "`{plain}` needs no guard:\n{glsl}");
    }
    for guarded in [
        "whole_quotient(pixel, ivec2(parameters.n))",
        "whole_remainder(parameters.n, 3)",
    ] {
        assert!(glsl.contains(guarded), "no `{guarded}`:\n{glsl}");
    }
}

/// Conversions are guarded where a float may be out of range, and bare where it cannot be.
#[test]
fn conversions_are_guarded_where_they_must_be() {
    let kernel = "pub fn k(color: &Frame<Vec4>, place: Vec2, far: f32, pixel: IVec2) -> Vec4 {
        let a = far as i32;
        let b = far as u32;
        let c = place.as_ivec2();
        let d = place.as_uvec2();
        let e = (pixel.as_vec2() * 0.5).floor().as_ivec2();
        let f = far.clamp(0.0, 255.0) as i32;
        color.load(c + e) + vec4(a as f32, b as f32, d.x as f32, f as f32)
    }";
    let wgsl = text(&emit_all(kernel), Target::Wgsl);
    for guarded in [
        "to_i32(parameters.far)",
        "to_u32(parameters.far)",
        "to_vec2i(parameters.place)",
        "to_vec2u(",
    ] {
        assert!(wgsl.contains(guarded), "no `{guarded}`:\n{wgsl}");
    }
    for bare in ["i32(clamp(parameters.far, 0.0, 255.0))", "vec2i(floor("] {
        let guarded = format!("to_{bare}");
        assert!(
            wgsl.contains(bare) && !wgsl.contains(&guarded),
            "`{bare}` is guarded:\n{wgsl}"
        );
    }
}

/// The bound of a loop that stays may be any expression.
#[test]
fn bounds_of_loops_keep_their_parentheses() {
    for bound in [
        "n & 5", "n | 1", "n ^ 3", "n >> 1", "n << 1", "n % 4", "-n", "n.min(3)", "n + 1", "n * 2",
    ] {
        let kernel = format!(
            "pub fn k(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {{
                let mut sum = Vec4::ZERO;
                for i in 0..({bound}) {{ sum += color.load(pixel + ivec2(i, 0)); }}
                sum
            }}"
        );
        emit(&compile(&kernel, Unroll::None, Branches::AsLoops), Stage::Compute);
    }
}

/// Comparisons beside one another are no list of template arguments, and vectors of booleans have operators too.
#[test]
fn comparisons_beside_one_another_are_told_apart() {
    let kernel = "pub fn k(color: &Frame<Vec4>, a: f32, b: f32, pixel: IVec2) -> Vec4 {
        let c = color.load(pixel);
        let holds = c.x < a && c.y > b || c.z < a && c.w >= b;
        let other = (c.x < a) != (c.y > b);
        let all = [c.x < a, c.y > b, c.z < b];
        let mut sum = 0.0;
        if all[(pixel.x & 1) as usize] { sum += 1.0; }
        if holds && other { c } else { c * sum }
    }";
    emit_all(kernel);
}

/// A straight-line kernel has no branch, however its conditions are joined.
/// A whole shader binds its textures and uniforms itself.
#[test]
fn whole_shaders_take_nothing_of_a_host() {
    let compiled = Kernel::builtin("tabula_rasa")
        .and_then(|kernel| kernel.compile(&Settings::new()))
        .expect("a kernel");
    let fragment = EmitOptions::new().stage(Stage::Fragment).targets([Target::Hlsl]);
    for options in [
        fragment.clone().texels(Texels::Functions),
        fragment.clone().global_uniforms(true),
    ] {
        let refused = compiled.emit(&options).expect_err("a whole shader");
        assert_eq!(refused.first_code(), Some(Code::UnfitSetting));
        assert!(compiled.emit(&options.form(Form::Function)).is_ok());
    }
}

/// Without comments the same text is left, but for the first two lines.
#[test]
fn comments_are_stripped() {
    let settings = Settings::new().unroll(Unroll::None);
    let compiled = Kernel::builtin("sraa")
        .and_then(|kernel| kernel.compile(&settings))
        .expect("a kernel");
    let written = EmitOptions::new().targets([Target::Wgsl, Target::Glsl450, Target::Hlsl]);
    let whole = compiled.emit(&written).expect("a shader");
    let stripped = compiled.emit(&written.strip_comments(true)).expect("a shader");
    for (target, text) in &stripped.files {
        let lines =
            |bytes: &[u8]| -> Vec<String> { String::from_utf8_lossy(bytes).lines().map(str::to_owned).collect() };
        let (text, whole) = (lines(text), lines(&whole.files[target]));
        let is_comment = |line: &&String| line.trim_start().starts_with("//");
        assert_eq!(text.iter().filter(is_comment).count(), 2, "{target}: {text:#?}");
        let code = |lines: &[String]| {
            lines
                .iter()
                .filter(|line| !is_comment(line))
                .cloned()
                .collect::<Vec<_>>()
        };
        assert_eq!(code(&text), code(&whole), "{target}");
    }
    assert_eq!(stripped.manifest.counts, whole.manifest.counts);
}

#[test]
fn conditions_make_no_branches() {
    let kernel = "pub fn k(color: &Frame<Vec4>, a: f32, b: f32, pixel: IVec2) -> Vec4 {
        let c = color.load(pixel);
        let d = color.load(pixel + ivec2(1, 0));
        let holds = (c.x < a && c.y > b) || (c.z < a && !(c.w >= b)) || d.x * 2.0 > c.y;
        if holds && d.z < a * b { c * d } else { c + d }
    }";
    let emitted = emit(&compile(kernel, Unroll::Full, Branches::Select), Stage::Fragment);
    let (wgsl, glsl) = (text(&emitted, Target::Wgsl), text(&emitted, Target::Glsl450));
    assert_eq!(instructions(&words(&emitted), LABEL).len(), 1, "{wgsl}");
    let compiled = compilers::compiled_glsl(&glsl, "frag").expect("glslang reads it");
    assert_eq!(instructions(&compiled, LABEL).len(), 1, "{glsl}");
}

/// `a < b, c, d > e` is a list of template arguments in WGSL, unless the comparison stands in parentheses.
#[test]
fn comparisons_among_arguments_are_comparisons() {
    let kernel = "pub fn k(color: &Frame<Vec4>, q: u32, r: f32, pixel: IVec2) -> Vec4 {
        let c = color.load(pixel);
        let less = if c.x > r { q < pixel.as_uvec2().x } else { false };
        let more = if c.y > r { true } else { q < pixel.as_uvec2().y };
        if less & more { c } else { -c }
    }";
    for unroll in [Unroll::Full, Unroll::None] {
        let emitted = emit(&compile(kernel, unroll, Branches::Select), Stage::Compute);
        compilers::read(&emitted).unwrap_or_else(|why| panic!("{why}"));
    }
}

/// Every kernel that comes with Straightline and every example.
fn kernels() -> Vec<Kernel> {
    let built_in = straightline_kernels::CATALOGUE.iter();
    let mut kernels: Vec<Kernel> = built_in
        .map(|entry| Kernel::builtin(entry.name).unwrap_or_else(|e| panic!("{e}")))
        .collect();
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../kernels/filters");
    for entry in std::fs::read_dir(examples).expect("examples") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|e| e == "rs") {
            kernels.push(Kernel::from_file(&path, None).unwrap_or_else(|e| panic!("{e}")));
        }
    }
    kernels
}

/// Checks the OpenGL and OpenGL ES shaders of every kernel with glslang, in each version; a feature that a version lacks is refused by
/// name.
#[test]
fn every_kernel_is_read_in_the_languages_of_opengl() {
    let (mut read, mut missing) = (0, 0);
    for kernel in kernels() {
        let name = kernel.name();
        for unroll in [Unroll::Full, Unroll::None] {
            let compiled = kernel.compile(&settings(unroll, Branches::AsLoops));
            let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
            for (target, stage) in Target::OPENGL
                .into_iter()
                .flat_map(|target| [Stage::Compute, Stage::Fragment].map(|stage| (target, stage)))
            {
                match compiled.emit(&EmitOptions::new().stage(stage).targets([target])) {
                    Ok(emitted) => {
                        compilers::read(&emitted).unwrap_or_else(|e| panic!("{name} {target}: {e}"));
                        read += 1;
                    }
                    Err(error) if error.first_code() == Some(Code::NotInTarget) => missing += 1,
                    Err(error) => panic!("{name} {target}: {error}"),
                }
            }
        }
    }
    assert!(read >= 100 && missing >= 40, "{read} read, {missing} missing");
}

/// Neither the shader nor its manifest says where on the author's machine the kernel lies.
#[test]
fn absolute_paths_stay_at_home() {
    let source =
        "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { let twice = color.load(pixel) * 2.0; twice * twice }";
    let kernel = Kernel::from_text("/home/author/secret/k.rs", source, "k");
    let compiled = kernel.compile(&Settings::default()).unwrap_or_else(|e| panic!("{e}"));
    let emitted = compiled.emit(&EmitOptions::new()).unwrap_or_else(|e| panic!("{e}"));
    let manifest = emitted.manifest.to_json();
    assert!(text(&emitted, Target::Wgsl).contains("k.rs:1") && manifest.contains("\"max_live_at\": \"k.rs:1"));
    for (name, bytes) in emitted.named_files("k") {
        assert!(!String::from_utf8_lossy(&bytes).contains("secret"), "{name}");
    }
}

/// The number of basic blocks in the manifest and in the header is that of labels in the SPIR-V, for every kernel that comes
/// with Straightline and every example, but for those that naga adds: of a loop a block to go on from and one that leaves it, with a
/// block behind each test, and one behind a branch that the function ends with.
#[test]
fn basic_blocks_are_those_of_the_spirv() {
    let kernels = kernels();
    let (mut counted, mut straight) = (0, 0);
    for kernel in kernels {
        let name = kernel.name();
        let compiled = kernel.compile(&settings(Unroll::Full, Branches::Select));
        let compiled = compiled.unwrap_or_else(|e| panic!("{e}"));
        for stage in [Stage::Compute, Stage::Fragment] {
            let options = EmitOptions::new().targets(compilers::READ).stage(stage);
            let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
            read(&emitted).unwrap_or_else(|e| panic!("{name}: {e}"));
            let labels = instructions(&words(&emitted), LABEL).len();
            let wgsl = text(&emitted, Target::Wgsl);
            let of_loops = 4 * wgsl.matches("for (").count() + 2 * wgsl.matches("loop {").count();
            let at_the_end = usize::from(wgsl.ends_with("    }\n}\n"));
            let counts = &emitted.manifest.counts;
            let blocks = counts.basic_blocks as usize;
            assert_eq!(blocks + of_loops + at_the_end, labels, "{name}");
            let plural = if blocks == 1 { "" } else { "s" };
            let said = format!("{blocks} basic block{plural}, {} statements", counts.statements);
            for target in [Target::Wgsl, Target::Glsl450] {
                let shader = text(&emitted, target);
                assert!(shader.contains(&said), "{name}: {said}\n{shader}");
            }
            counted += 1;
            straight += u32::from(labels == 1);
        }
    }
    assert!(
        counted >= 20 && straight >= 8,
        "{straight} of {counted} shaders are one block"
    );
}

/// Guards of divisions and conversions are no functions of the SPIR-V, and no blocks: unrolled, each built-in kernel of pixels or quads is one
/// basic block in a fragment shader, whatever its integers are divided by.
#[test]
fn unrolled_kernels_are_one_basic_block() {
    let cases: &[(&str, Options)] = &[
        ("sraa", &[]),
        ("sraa", &[("layout", "superresolution")]),
        ("sraa", &[("layout", "superresolution"), ("pattern", "standard8")]),
        ("sraa", &[("mask", "select")]),
        ("quad_convolution", &[]),
        ("quad_convolution", &[("taps", "bilinear")]),
        ("quad_upsampling", &[]),
        ("quad_upsampling", &[("factor", "four-times"), ("reads", "apart")]),
        ("downsampling", &[("factor", "four-times")]),
        ("quad_bilateral", &[]),
        ("pcf", &[]),
        ("pcf", &[("method", "gather"), ("weights", "cubic")]),
        ("pcf", &[("weights", "lookup"), ("gradient", "fitted")]),
        ("pcss", &[]),
        ("pcss", &[("sharing", "alone")]),
        ("quad_ssao", &[]),
        ("stalker", &[]),
        ("tabula_rasa", &[]),
    ];
    for (name, options) in cases {
        let settings = Settings::new()
            .set_all(options.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())))
            .transport((name.starts_with("quad") || name.starts_with("pc")).then_some(Transport::Subgroup));
        let kernel = Kernel::builtin(name).unwrap_or_else(|e| panic!("{e}"));
        one_block(&format!("{name} {options:?}"), &kernel, &settings);
    }
    let text = "
/// Divisions that naga guards, and a conversion that is not known to fit.
pub fn divided(color: &Texture<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let thirds = (pixel - 7) / 3;
    let bits = ivec2(pixel.x * taps / 8, (pixel.y - taps) % 16);
    let hash = (pixel.x as u32 / 12) % 10;
    let there = (color.load(thirds).xy() * 100.0).floor().as_ivec2() + bits / taps;
    color.load(there) + hash as f32
}
";
    let kernel = Kernel::from_text("divided.rs", text, "divided");
    one_block("divided", &kernel, &Settings::default());
}

type Options<'a> = &'a [(&'a str, &'a str)];

fn one_block(name: &str, kernel: &Kernel, settings: &Settings) {
    let compiled = kernel.compile(settings).unwrap_or_else(|e| panic!("{name}: {e}"));
    let options = EmitOptions::new().targets([Target::Spirv]).stage(Stage::Fragment);
    let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{name}: {e}"));
    read(&emitted).unwrap_or_else(|e| panic!("{name}: {e}"));
    let words = words(&emitted);
    assert_eq!(instructions(&words, FUNCTION).len(), 1, "{name}: functions");
    assert_eq!(instructions(&words, LABEL).len(), 1, "{name}: basic blocks");
    assert_eq!(emitted.manifest.counts.basic_blocks, 1, "{name}");
}

/// Names of variables and of the kernel are changed where a language has another use for them.
#[test]
fn odd_names_are_changed() {
    let names = "gl_FragCoord gl_x imageStore destination Parameters image2D é Ω 値 textureGather sampler2D vec3 main to_i32 \
                 whole_quotient input output half float4 texture _a lerp mul saturate Texture2D register kernel device constant \
                 metal thread subgroupAdd infinity nan_bits f16 ptr fixed sample patch smooth buffer shared common partition \
                 active filter mix clamp unorm discard within place id position frame region __a a__b Pass Region";
    let long = "n".repeat(1100);
    for name in names.split_whitespace().chain([long.as_str()]) {
        // In Rust a pattern that begins with a capital is a constant.
        let kernel_name = name;
        let name = if name.starts_with(char::is_uppercase) {
            "local"
        } else {
            name
        };
        let kernel = format!(
            "pub fn {kernel_name}(color: &Frame<Vec4>, p: IVec2) -> Vec4 {{
                let {name} = color.load(p);
                let n_1 = {name} * {name};
                let mut sum = n_1;
                for {name} in 0..3 {{ sum += color.load(p + ivec2({name}, 0)); }}
                sum + n_1
            }}"
        );
        for unroll in [Unroll::Full, Unroll::None] {
            let compiled =
                Kernel::from_text("kernel.rs", &kernel, kernel_name).compile(&settings(unroll, Branches::AsLoops));
            let compiled = compiled.unwrap_or_else(|e| panic!("{name}: {e}"));
            emit(&compiled, Stage::Compute);
        }
    }
}

/// Names of inputs are a host's: in the manifest they stay, and a text has others where it must.
#[test]
fn odd_names_of_inputs_are_taken() {
    let long = "n".repeat(2000);
    let names = [
        ("imageStore", "imageStore_"),
        ("parameters", "parameters_"),
        ("destination", "destination"),
        ("Parameters", "Parameters_"),
        ("k", "k_"),
        ("a__b", "a_b"),
        ("image2D", "image2D_"),
        ("é", "ue9"),
        ("gl_x", "v_gl_x"),
        ("__a", "a"),
        ("_", "v_"),
        (&long, &long[..127]),
    ];
    for (name, in_glsl) in names {
        let kernels = [
            format!("pub fn k({name}: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{ {name}.load(pixel) }}"),
            format!(
                "pub fn k(color: &Frame<Vec4>, {name}: f32, pixel: IVec2) -> Vec4 {{ color.load(pixel) * {name} }}"
            ),
        ];
        for kernel in kernels.iter().filter(|_| name != "_") {
            let emitted = emit(&compile(kernel, Unroll::Full, Branches::Select), Stage::Compute);
            let is_field = kernel.contains("color");
            match is_field {
                false => assert!(emitted.manifest.binding(name).is_some(), "{kernel}"),
                true => assert!(
                    emitted.manifest.to_json().contains(&format!("\"name\": \"{name}\"")),
                    "{kernel}"
                ),
            }
            let glsl = text(&emitted, Target::Glsl450);
            // Members have only words to stay clear of.
            let own = ["Parameters", "k"].contains(&name);
            let wanted = match (is_field, name) {
                (true, "destination") => "destination_",
                (true, _) if own => name,
                _ => in_glsl,
            };
            assert!(glsl.contains(&format!(" {wanted};\n")), "no `{wanted}` in\n{glsl}");
        }
    }
}

/// Nothing in a path or a doc comment ends a comment.
#[test]
fn comments_hold_what_they_are_given() {
    let ends = ['\u{2028}', '\u{2029}', '\u{85}', '\u{b}', '\u{c}', '\r', '\n', '\\'];
    for end in ends {
        let hostile = format!("a{end}let broken = no_such_name;{end}");
        let documented = hostile.replace(['\n', '\r'], " ");
        let kernel = format!(
            "/// {documented}\npub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{\n    let tap = color.load(pixel);\n    \
             tap * tap\n}}\n"
        );
        let compiled = Kernel::from_text(&hostile, &kernel, "k").compile(&Settings::default());
        let emitted = emit(&compiled.unwrap_or_else(|e| panic!("{end:?}: {e}")), Stage::Compute);
        let outside = |line: &str| line.contains("no_such_name") && !line.trim_start().starts_with("//");
        for target in [Target::Wgsl, Target::Glsl450] {
            let shader = text(&emitted, target);
            assert!(!shader.split(ends).any(outside), "{end:?}:\n{shader}");
            assert!(!shader.contains('\\'), "{end:?}:\n{shader}");
        }
    }
}

/// Samplers of HLSL are bound by registers of their own, as any engine binds them, and GLSL gathers.
#[test]
fn samplers_and_gathers() {
    let kernel =
        "pub fn k(image: &Texture<Vec4>, shadow: &DepthTexture, linear: &Sampler, less: &ComparisonSampler, at: Vec2, \
                  pixel: IVec2) -> Vec4 {
        let a = image.sample(linear, at);
        let b = image.gather(1, linear, at);
        let c = shadow.gather_compare(less, at, 0.5);
        a + b + c
    }";
    let emitted = emit(&compile(kernel, Unroll::Full, Branches::Select), Stage::Compute);
    let hlsl = text(&emitted, Target::Hlsl);
    for bound in [": register(s2);", ": register(s3);"] {
        assert!(hlsl.contains(bound), "{hlsl}");
    }
    assert!(!hlsl.contains("SamplerHeap") && !hlsl.contains("IndexArray"), "{hlsl}");
    let glsl = text(&emitted, Target::Glsl450);
    assert_eq!(glsl.matches("textureGather(").count(), 2, "{glsl}");
    assert!(!glsl.contains("textureLod(sampler2DShadow"), "{glsl}");
}

/// Long expressions that are split, arrays and loops: the budget, the manifest and the header say one number, that of lines.
#[test]
fn statements_are_counted_once() {
    let kernel = "pub fn k(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
        let mut a = [0.0; 4];
        for i in 0..4 { a[i] = color.load(pixel + ivec2(i as i32, n)).x; }
        let mut sum = 0.0;
        for i in 0..4 {
            sum += a[i] * a[(i + 1) % 4] + a[i] * 2.0 - a[i] / 3.0 + a[i] * a[i] * a[i] * 7.0 + (a[i] - 1.0) * (a[i] + 5.0);
        }
        vec4(sum, a[0], a[1], a[2])
    }";
    for (unroll, branches) in [(Unroll::Full, Branches::Select), (Unroll::None, Branches::Keep)] {
        let compiled = compile(kernel, unroll, branches);
        let statements = compiled.text_counts().statements;
        let emitted = emit(&compiled, Stage::Compute);
        assert_eq!(emitted.manifest.counts.statements, statements);
        for target in [Target::Wgsl, Target::Glsl450] {
            let shader = text(&emitted, target);
            assert!(shader.contains(&format!(" {statements} statements,")), "{shader}");
            let body = shader.split("return;\n    }\n").nth(1).expect("a body");
            let lines = body.lines().filter(|l| l.ends_with(';') || l.ends_with('{')).count() as u32;
            // The store is not the kernel's.
            assert_eq!(lines - 1, statements, "{shader}");
        }
        let mut tight = settings(unroll, branches);
        tight.budget = statements;
        let kernel = Kernel::from_text("kernel.rs", kernel, "k");
        assert!(kernel.compile(&tight).is_ok());
        tight.budget = statements - 1;
        let error = kernel.compile(&tight).expect_err("too long").render(false);
        assert!(error.contains(&format!("has {statements} statements")), "{error}");
    }
}

/// Statements are counted only where there may be too many, estimated by the graph's size: the estimate must not be too low.
#[test]
fn no_kernel_goes_over_its_budget_unseen() {
    for entry in straightline_kernels::CATALOGUE {
        for (unroll, branches) in [(Unroll::Full, Branches::Select), (Unroll::None, Branches::Keep)] {
            let kernel = Kernel::builtin(entry.name).unwrap_or_else(|e| panic!("{e}"));
            let mut tight = settings(unroll, branches);
            let compiled = kernel.compile(&tight).unwrap_or_else(|e| panic!("{}: {e}", entry.name));
            tight.budget = compiled.text_counts().statements - 1;
            assert!(kernel.compile(&tight).is_err(), "{}: {unroll}", entry.name);
        }
    }
}

/// An index beyond an array is that of the last element on every way to a GPU: clamped in GLSL and SPIR-V, and by the compilers that read
/// WGSL.
#[test]
fn indices_outside_of_arrays_are_clamped() {
    let kernel = "pub fn k(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
        let mut a = [1.0, 2.0, 3.0, color.load(pixel).x];
        a[n as usize] = 5.0;
        let known = a[(pixel.x & 3) as usize];
        vec4(a[0], a[1], a[n as usize], known)
    }";
    let glsl = text(&emit_all(kernel), Target::Glsl450);
    assert_eq!(glsl.matches("min(uint(parameters.n), 3u)").count(), 2, "{glsl}");
    assert!(!glsl.contains("min(uint(pixel"), "{glsl}");
}

/// Functions whose host reads the textures: what they call, what they take, and what they refuse.
#[test]
fn hosts_read_their_textures() {
    let source = "pub fn k(color: &Frame<Vec4>, linear: &Sampler, gain: f32, pixel: IVec2) -> Vec4 {\n    \
        gain * color.load(pixel + ivec2(1, 0)) + color.sample(linear, vec2(0.5, 0.25))\n}\n";
    let compiled = compile(source, Unroll::Full, Branches::Select);
    let mut options = EmitOptions::new()
        .form(Form::Function)
        .texels(Texels::Functions)
        .targets([Target::Glsl330, Target::Hlsl, Target::Wgsl]);
    let emitted = compiled.emit(&options).unwrap_or_else(|e| panic!("{e}"));
    let wgsl = text(&emitted, Target::Wgsl);
    assert!(wgsl.contains("fn k(position: vec2f, gain: f32) -> vec4f {"), "{wgsl}");
    assert!(wgsl.contains("sample_color(vec2f(0.5, 0.25))"), "{wgsl}");
    // The host's functions are read along with it, and not written.
    assert!(!wgsl.contains("fn load_color"), "{wgsl}");
    let glsl = text(&emitted, Target::Glsl330);
    for part in [
        "vec4 k(vec2 position, float gain) {",
        "load_color(",
        "sample_color(vec2(0.5, 0.25))",
        "size_of_color()",
    ] {
        assert!(glsl.contains(part), "no {part}:\n{glsl}");
    }
    let around = "#version 330\nuniform sampler2D picture;\nout vec4 colour;\nuniform float gain;\n\
        vec4 load_color(ivec2 p) { return texelFetch(picture, p, 0); }\n\
        vec4 sample_color(vec2 p) { return textureLod(picture, p, 0.0); }\n\
        ivec2 size_of_color() { return textureSize(picture, 0); }\n";
    let read = |body: &str, call: &str| {
        let whole = format!("{around}{body}void main() {{ colour = {call}; }}\n");
        let path = std::env::temp_dir().join(format!("straightline-host-{}.frag", std::process::id()));
        std::fs::write(&path, whole).expect("a file");
        compilers::opengl(&path).unwrap_or_else(|e| panic!("{e}"));
        std::fs::remove_file(&path).expect("the file");
    };
    read(&glsl, "k(gl_FragCoord.xy, gain)");
    let hlsl = text(&emitted, Target::Hlsl);
    assert!(hlsl.contains("float4 k(float2 position, float gain) {"), "{hlsl}");
    // Called functions are declared before the kernel's function, not in it.
    assert!(!hlsl.contains("GetDimensions"), "{hlsl}");
    let host = emitted
        .manifest
        .language_bindings
        .iter()
        .filter(|b| b.kind == LanguageKind::Function);
    let host: Vec<&str> = host.filter(|b| b.language == "hlsl").map(|b| b.name.as_str()).collect();
    assert_eq!(host, ["load_color", "sample_color", "size_of_color"]);

    options.global_uniforms = true;
    let emitted = compiled.emit(&options.clone().targets([Target::Glsl330]));
    let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
    let glsl = text(&emitted, Target::Glsl330);
    assert!(glsl.contains("vec4 k(vec2 position) {"), "{glsl}");
    read(&glsl, "k(gl_FragCoord.xy)");

    for (targets, source, said) in [
        (Target::Wgsl, source, "which wgsl does not have"),
        (
            Target::Glsl330,
            "pub fn k(color: &Frame<Vec4>, map: &Texture3D<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel) + map.load(ivec3(0, 0, 0))\n}\n",
            "`map` is none",
        ),
        (
            Target::Glsl330,
            "pub fn k(color: &Frame<Vec4>, map: &Texture<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel) + map.load_level(ivec2(0, 0), 1)\n}\n",
            "it reads `map` and asks how many levels",
        ),
    ] {
        let compiled = compile(source, Unroll::Full, Branches::Select);
        let refused = compiled.emit(&options.clone().targets([targets]));
        let message = refused.expect_err("the host cannot").to_string();
        assert!(message.contains(said), "{message}");
    }
}

/// An array that a branch changes is changed in place, though elements of its earlier value are read after the first
/// write.
#[test]
fn arrays_are_changed_in_place_while_other_elements_are_read() {
    let kernel = "pub fn k(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 { let mut sums = [Vec4::ZERO; 4]; \
                  for y in -2..=2 { let c = image.load(pixel + ivec2(0, y)); \
                  if y <= 0 { sums[0] += c; sums[1] += c * 2.0; } \
                  if y >= 0 { sums[2] += c; sums[3] += c * 3.0; } } sums[0] * sums[3] + sums[1] * sums[2] }";
    let emitted = emit(&compile(kernel, Unroll::None, Branches::Keep), Stage::Compute);
    let text = text(&emitted, Target::Wgsl);
    assert!(!text.contains("sums_2"), "{text}");
    assert_eq!(text.matches("array<vec4f, 4>(").count(), 1, "{text}");
}
