//! Source maps, and the lines of the source in shaders.

use crate::compilers::{self, lines_by_spirv_cross};
use std::collections::BTreeMap;
use straightline_codegen::emit::{DebugInfo, Emitted, Target};
use straightline_codegen::{EmitOptions, Form, Kernel, Settings, Stage, Unroll};
use straightline_manifest::{MappedStatement, SourceMap};

/// A kernel of `kernels/filters`, under a path as it would be given from there.
fn file_kernel(name: &str) -> Kernel {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../kernels/filters/{name}.rs"));
    let text = std::fs::read_to_string(path).expect("a kernel's file");
    Kernel::from_text(&format!("filters/{name}.rs"), &text, name)
}

const TEXTS: [Target; 4] = [Target::Wgsl, Target::Glsl450, Target::Glsl430, Target::Hlsl];

fn emit(kernel: &Kernel, settings: &Settings, options: &EmitOptions, debug: DebugInfo) -> Emitted {
    let compiled = kernel.compile(settings).unwrap_or_else(|e| panic!("{e}"));
    compiled
        .emit(&options.clone().debug(debug))
        .unwrap_or_else(|e| panic!("{e}"))
}

fn text_of(emitted: &Emitted, target: Target) -> String {
    String::from_utf8(emitted.files[&target].clone()).expect("a text")
}

fn map_of(emitted: &Emitted) -> &SourceMap {
    emitted.source_map.as_ref().expect("a source map")
}

/// Kernels with loops, branches, functions of other files, blocks of pixels and workgroups.
fn mapped() -> Vec<(Kernel, Settings, EmitOptions)> {
    let all = || EmitOptions::new().targets(TEXTS);
    let builtin = |name: &str| Kernel::builtin(name).expect("a built-in kernel");
    let looped = || Settings::new().unroll(Unroll::None);
    vec![
        (builtin("sraa"), Settings::new(), all()),
        (builtin("sraa"), looped(), all()),
        (
            builtin("stalker"),
            Settings::new(),
            all().stage(Stage::Fragment).form(Form::Function),
        ),
        (builtin("pcf"), Settings::new(), all()),
        (file_kernel("bilateral"), Settings::new().block(2, 2), all()),
        (file_kernel("kuwahara"), looped(), all().region(true)),
    ]
}

/// Returns whether a line has a name in it.
fn mentions(line: &str, name: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    line.split(|c: char| !is_part(c)).any(|word| word == name)
}

#[test]
fn statements_come_from_the_expressions_that_the_map_names() {
    for (kernel, settings, options) in mapped() {
        let emitted = emit(&kernel, &settings, &options, DebugInfo::Map);
        let map = map_of(&emitted);
        let files: BTreeMap<&str, &str> = kernel
            .files()
            .iter()
            .map(|f| (f.path.as_str(), f.text.as_str()))
            .collect();
        for target in TEXTS {
            let text = text_of(&emitted, target);
            let lines: Vec<&str> = text.lines().collect();
            let statements = &map.texts[&target.to_string()];
            assert!(
                statements.windows(2).all(|pair| pair[0].last < pair[1].first),
                "{target}: not in order"
            );
            for statement in statements {
                let MappedStatement { first, last, name, .. } = statement;
                let printed = lines[*first as usize - 1..*last as usize].join("\n");
                let context = || {
                    format!(
                        "{} {target} {first}: {printed}\n{}",
                        kernel.name(),
                        map.describe(statement)
                    )
                };
                assert!(
                    name.is_empty() || mentions(lines[*first as usize - 1], name),
                    "{}",
                    context()
                );
                assert!(!printed.trim_start().starts_with("//"), "{}", context());
                let source = files[map.file_of(statement)].lines().nth(statement.line as usize - 1);
                let behind: String = source
                    .unwrap_or_default()
                    .chars()
                    .skip(statement.column as usize - 1)
                    .collect();
                let begin: String = statement.expression.split(' ').next().unwrap_or_default().to_owned();
                assert!(behind.starts_with(begin.trim_end_matches('…')), "{}", context());
            }
        }
    }
}

/// Statements of the kernel have a place; those of the entry point have none.
#[test]
fn nearly_every_statement_has_a_place() {
    for (kernel, settings, options) in mapped() {
        let emitted = emit(&kernel, &settings, &options, DebugInfo::Map);
        let map = map_of(&emitted);
        let text = text_of(&emitted, Target::Wgsl);
        let name = kernel.name();
        let body = text
            .lines()
            .enumerate()
            .skip_while(|(_, line)| !line.starts_with(&format!("fn {name}(")));
        let body = body.skip(1).take_while(|(_, line)| *line != "}");
        let is_code = |line: &str| !line.trim_start().starts_with("//") && line.trim().len() > 1;
        let lines: Vec<(u32, &str)> = body
            .filter(|(_, line)| is_code(line))
            .map(|(k, line)| (k as u32 + 1, line))
            .collect();
        let unmapped: Vec<&str> = lines
            .iter()
            .filter(|(line, _)| map.at_line("wgsl", *line).is_none())
            .map(|(_, text)| *text)
            .collect();
        // Size, pixel, its bounds and its corner, the sides of conditions, and what an optimisation names.
        assert!(
            unmapped.len() <= 12 + lines.len() / 20,
            "{name}: {} of {}:\n{}",
            unmapped.len(),
            lines.len(),
            unmapped.join("\n")
        );
    }
}

#[test]
fn a_map_leaves_the_shader_as_it_is() {
    for (kernel, settings, options) in mapped() {
        let plain = emit(&kernel, &settings, &options, DebugInfo::None);
        let mapped = emit(&kernel, &settings, &options, DebugInfo::Map);
        assert_eq!(plain.files, mapped.files, "{}", kernel.name());
        assert_eq!(plain.manifest, mapped.manifest, "{}", kernel.name());
        assert_eq!(plain.source_map, None);
        let files = mapped.named_files("aa");
        let text = std::str::from_utf8(&files["aa.map.json"]).expect("JSON");
        assert_eq!(SourceMap::from_json(text).ok().as_ref(), mapped.source_map.as_ref());
    }
}

#[test]
fn counters_tell_iterations_apart() {
    let text = "pub fn blur(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let mut sum = Vec4::ZERO;\n    for x in -1..=1 {\n        \
                sum += image.load(pixel + ivec2(x, 0));\n    }\n    sum / 3.0\n}\n";
    let kernel = Kernel::from_text("filters/blur.rs", text, "blur");
    let emitted = emit(&kernel, &Settings::new(), &EmitOptions::new(), DebugInfo::Map);
    let map = map_of(&emitted);
    let statements = map.from_source("wgsl", "blur.rs", 4);
    let counters: Vec<_> = statements.map(|statement| statement.counters.clone()).collect();
    assert_eq!(counters, [[("x".to_owned(), -1)], [("x".to_owned(), 1)]]);
}

#[test]
fn absolute_paths_stay_private() {
    let text = "pub fn same(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    image.load(pixel) * 2.0\n}\n";
    let kernel = Kernel::from_text("/home/someone/secret/same.rs", text, "same");
    let all = EmitOptions::new().targets([Target::Spirv, Target::Hlsl, Target::Glsl450]);
    let emitted = emit(&kernel, &Settings::new(), &all, DebugInfo::Lines);
    for (name, bytes) in emitted.named_files("same") {
        assert!(!String::from_utf8_lossy(&bytes).contains("someone"), "{name}");
    }
    assert_eq!(map_of(&emitted).files, ["same.rs"]);
}

fn string(words: &[u32]) -> String {
    let bytes = words
        .iter()
        .flat_map(|word| word.to_le_bytes())
        .take_while(|byte| *byte != 0);
    String::from_utf8(bytes.collect()).expect("UTF-8")
}

/// Text of each file in SPIR-V, and the lines that its instructions are in.
fn debug_information(bytes: &[u8]) -> BTreeMap<String, (String, Vec<u32>)> {
    let (mut names, mut found) = (BTreeMap::new(), BTreeMap::<String, (String, Vec<u32>)>::new());
    let mut current = String::new();
    let words = compilers::words(bytes);
    let mut rest = &words[5..];
    while let Some(head) = rest.first() {
        let (one, behind) = rest.split_at((head >> 16) as usize);
        let operands = &one[1..];
        rest = behind;
        match head & 0xffff {
            7 => _ = names.insert(operands[0], string(&operands[1..])),
            3 if operands.len() > 3 => {
                current = names[&operands[2]].clone();
                found.insert(current.clone(), (string(&operands[3..]), Vec::new()));
            }
            2 => found.get_mut(&current).expect("a source").0 += &string(operands),
            8 => found
                .get_mut(&names[&operands[0]])
                .expect("a source")
                .1
                .push(operands[1]),
            _ => {}
        }
    }
    found
}

#[test]
fn spirv_has_the_lines_and_the_text_of_the_source() {
    // Exact sums, overrides and functions that are inlined are edited after naga.
    let settings = || Settings::new();
    let cases = [
        (Kernel::builtin("sraa").expect("sraa"), settings()),
        (
            Kernel::builtin("sraa").expect("sraa"),
            settings()
                .override_options(["tau"])
                .math(straightline_codegen::Math::Strict),
        ),
        (file_kernel("kuwahara"), settings().unroll(Unroll::None)),
    ];
    for (kernel, settings) in cases {
        let options = EmitOptions::new().targets([Target::Wgsl, Target::Spirv]);
        let emitted = emit(&kernel, &settings, &options, DebugInfo::Lines);
        compilers::read(&emitted).unwrap_or_else(|e| panic!("{}: {e}", kernel.name()));
        let map = map_of(&emitted);
        let debug = debug_information(&emitted.files[&Target::Spirv]);
        // A reader of SPIR-V that shares nothing with the generator.
        let seen = lines_by_spirv_cross(&emitted.files[&Target::Spirv]).unwrap_or_else(|e| panic!("{e}"));
        let mut expected: BTreeMap<&str, Vec<u32>> = BTreeMap::new();
        for statement in &map.texts["wgsl"] {
            expected.entry(map.file_of(statement)).or_default().push(statement.line);
        }
        assert_eq!(
            debug.keys().collect::<Vec<_>>(),
            expected.keys().collect::<Vec<_>>(),
            "{}",
            kernel.name()
        );
        for (path, (text, lines)) in &debug {
            let file = kernel
                .files()
                .iter()
                .find(|file| file.path == *path)
                .expect("a file of the kernel");
            assert_eq!(*text, file.text);
            let known = &expected[path.as_str()];
            assert!(lines.iter().all(|line| known.contains(line)), "{path}: {lines:?}");
            let missing: Vec<_> = known.iter().filter(|line| !lines.contains(line)).collect();
            assert!(missing.len() * 5 <= known.len(), "{path}: nothing of {missing:?}");
            let here: Vec<u32> = seen
                .iter()
                .filter(|(file, _)| file == path)
                .map(|(_, line)| *line)
                .collect();
            assert!(
                !here.is_empty() && here.iter().all(|line| lines.contains(line)),
                "{path}: {here:?}"
            );
        }
    }
}

/// A text of more than 65 535 words takes several instructions, which must not cut a character.
#[test]
fn a_long_source_is_continued() {
    let comment = format!("// {}\n", "°…é ".repeat(40_000));
    let text = format!(
        "{comment}pub fn same(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{\n    image.load(pixel) * 2.0\n}}\n"
    );
    let kernel = Kernel::from_text("same.rs", &text, "same");
    let emitted = emit(
        &kernel,
        &Settings::new(),
        &EmitOptions::new().targets([Target::Spirv]),
        DebugInfo::Lines,
    );
    let debug = debug_information(&emitted.files[&Target::Spirv]);
    assert!(debug["same.rs"].0 == text, "the text has changed");
}

#[test]
fn glsl_and_hlsl_have_line_directives() {
    let kernel = file_kernel("bilateral");
    let options = EmitOptions::new().targets(TEXTS).entry("main_image");
    let emitted = emit(&kernel, &Settings::new(), &options, DebugInfo::Lines);
    compilers::read(&emitted).unwrap_or_else(|e| panic!("{e}"));
    let map = map_of(&emitted);
    for (target, file) in [
        (Target::Glsl450, "0"),
        (Target::Glsl430, "0"),
        (Target::Hlsl, "\"filters/bilateral.rs\""),
    ] {
        let text = text_of(&emitted, target);
        let lines: Vec<&str> = text.lines().collect();
        for statement in &map.texts[&target.to_string()] {
            let before = lines[statement.first as usize - 2];
            assert_eq!(
                before,
                format!("#line {} {file}", statement.line),
                "{target} {}",
                statement.first
            );
        }
    }
    assert!(!text_of(&emitted, Target::Wgsl).contains("#line"));
    assert!(text_of(&emitted, Target::Glsl450).contains("// Lines of string 0 are those of filters/bilateral.rs."));
}
