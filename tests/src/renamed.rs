//! Kernels under other names: host-facing names are replaced by reserved words of shading languages and of hosts'
//! languages.

use std::collections::{BTreeMap, BTreeSet};
use straightline_bench::execute::Inputs;
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::ir::{Element, Graph, OutputTarget};
use straightline_codegen::{Compiled, Kernel, Settings};

/// Words that some language has a use for, and names that texts, engines and hosts have; all are names in Rust, keywords by `r#`.
pub const WORDS: &[&str] = &[
    // WGSL, GLSL, HLSL and MSL.
    "out",
    "input",
    "target",
    "position",
    "shared",
    "log",
    "filter",
    "texture0",
    "sampler0",
    "texture",
    "sampler",
    "frame",
    "parameters",
    "region",
    "id",
    "main",
    "buffer",
    "sample",
    "smooth",
    "patch",
    "discard",
    "uniform",
    "varying",
    "attribute",
    "precise",
    "invariant",
    "layout",
    "flat",
    "common",
    "partition",
    "active",
    "asm",
    "class",
    "union",
    "enum",
    "typedef",
    "template",
    "this",
    "resource",
    "goto",
    "inline",
    "noinline",
    "public",
    "external",
    "interface",
    "long",
    "short",
    "half",
    "fixed",
    "unsigned",
    "superp",
    "output",
    "hvec2",
    "dvec3",
    "fvec4",
    "sampler3DRect",
    "sizeof",
    "cast",
    "namespace",
    "using",
    "vec2f",
    "mat4x3f",
    "array",
    "atomic",
    "bitcast",
    "texture_2d",
    "texture_storage_2d",
    "sampler_comparison",
    "workgroup",
    "storage",
    "private",
    "function",
    "diagnostic",
    "enable",
    "requires",
    "override",
    "alias",
    "const_assert",
    "fallthrough",
    "switch",
    "default",
    "case",
    "var",
    "loop_",
    "select",
    "float4",
    "float4x4",
    "int2",
    "uint3",
    "min16float",
    "dword",
    "cbuffer",
    "tbuffer",
    "groupshared",
    "packoffset",
    "register",
    "technique",
    "technique11",
    "pass",
    "Pass",
    "linear",
    "point",
    "centroid",
    "line",
    "triangle",
    "lerp",
    "saturate",
    "mul",
    "frac",
    "rsqrt",
    "ddx",
    "ddy",
    "clip",
    "lit",
    "Texture2D",
    "RWTexture2D",
    "SamplerState",
    "StructuredBuffer",
    "matrix",
    "vector",
    "string",
    "auto",
    "char",
    "delete",
    "double",
    "explicit",
    "friend",
    "mutable",
    "new",
    "operator",
    "protected",
    "signed",
    "static_cast",
    "throw",
    "typename",
    "kernel",
    "vertex",
    "fragment",
    "device",
    "constant",
    "thread",
    "threadgroup",
    "metal",
    "access",
    "bool",
    "texture2d",
    "depth2d",
    "simd",
    "ptrdiff_t",
    "nullptr",
    "and",
    "or",
    "not",
    "xor",
    "gl_FragCoord",
    "main0",
    "Parameters",
    "Region",
    "Outputs",
    "outputs",
    "unfiltered",
    "destination",
    "place",
    "within",
    "origin",
    "local_id",
    "group_id",
    "local_index",
    "size_of_color",
    "len_of_color",
    "levels_of_color",
    "color_buffer",
    "width",
    "height",
    "depth",
    "levels",
    "layers",
    "samples",
    "count",
    "stride",
    "Parameters_buffer",
    "region_first",
    "to_vec2i",
    "to_i32",
    "whole_quotient",
    "cube_root",
    "padding_4",
    "elements",
    "_buffer_sizes",
    // JavaScript, Python, C#, GDScript, C and Rust.
    "eval",
    "arguments",
    "constructor",
    "__proto__",
    "prototype",
    "toString",
    "null",
    "undefined",
    "function_",
    "with",
    "yield",
    "let",
    "of",
    "from",
    "def",
    "lambda",
    "None_",
    "del",
    "elif",
    "except",
    "global",
    "nonlocal",
    "pass_",
    "raise",
    "self_",
    "cls",
    "object",
    "params",
    "event",
    "delegate",
    "decimal",
    "internal",
    "sealed",
    "checked",
    "fixed_",
    "lock",
    "readonly",
    "ref",
    "stackalloc",
    "ushort",
    "value",
    "volatile",
    "preload",
    "extends",
    "signal",
    "onready",
    "tool",
    "errno",
    "restrict",
    "extern",
    "int",
    "float",
    "void",
    "type",
    "match",
    "move",
    "impl",
    "trait",
    "dyn",
    "async",
    "await",
    "try",
    "macro",
    "abstract",
    "become",
    "box",
    "do",
    "final",
    "priv",
    "typeof",
    "unsized",
    "virtual",
    "gen",
    "union_",
    "inputs",
    "queue",
    "encoder",
    "wgpu",
    "core",
    "Error",
    "Resource",
    "Result",
    "Option",
    "Default",
    "Some_",
    "str",
    "u8",
    "set_parameters",
    "bytes",
    "Bound",
    "Inputs",
    "Targets",
    // Engines.
    "textureSampler",
    "scale",
    "inputBuffer",
    "inputColor",
    "uv",
    "vUV",
    "uTexture",
    "uInputSize",
    "gfu",
    "push",
    "Source",
    "SourceSize",
    "FragColor",
    "HOOKED",
    "hook",
    "COLOR",
    "TIME",
    "PI",
    "UV",
    "VERTEX",
    "hint_range",
    "shader_type",
    "p3d_Vertex",
    "_BlitTexture",
    "BlitTexture",
    "Time",
    "View",
    "SvPosition",
    "ReShade",
    "BUFFER_WIDTH",
    "Plugin",
    "Component",
    "App",
    "colorSampler",
    // Letters, underscores and lengths.
    "größe",
    "é",
    "ue9",
    "名前",
    "_x",
    "x",
    "a__b",
    "a_b",
    "a_",
    "_1",
    "__a",
    "x_",
    "colour",
    "Color",
    "COLOUR",
    "Ω",
    "ﬁ",
    "a_very_long_name_of_a_parameter_that_goes_on_and_on_for_longer_than_anyone_would_ever_want_to_type_or_to_read_again",
];

/// Names of all that hosts know of a kernel by name: what it binds, what it gives, structures with their fields, and the
/// kernel's.
pub fn host_names(compiled: &Compiled, options: &[String]) -> Vec<String> {
    let graph = &compiled.graph;
    let mut names: Vec<String> = vec![compiled.kernel.clone()];
    names.extend(graph.textures.iter().map(|t| t.name.clone()));
    names.extend(graph.samplers.iter().map(|s| s.name.clone()));
    names.extend(graph.shared.iter().map(|s| s.name.clone()));
    names.extend(graph.images.iter().map(|i| i.name.clone()));
    names.extend(graph.varyings.iter().map(|v| v.name.clone()));
    let given = graph
        .targets
        .iter()
        .filter(|t| !t.name.starts_with(OutputTarget::DEFAULT_NAME));
    names.extend(given.map(|t| t.name.clone()));
    let whole = |u: &straightline_codegen::ir::Uniform| u.part.as_ref().map_or(&u.name, |part| &part.of).clone();
    names.extend(graph.uniforms.iter().map(whole));
    for buffer in &graph.buffers {
        names.push(buffer.name.clone());
        if let Element::Struct(structure) = &buffer.element {
            names.push(structure.name.clone());
            names.extend(structure.fields.iter().map(|field| field.name.clone()));
        }
    }
    names.extend(options.iter().map(|option| option.replace('-', "_")));
    let mut seen = BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    names
}

/// A text with other names, that of a keyword as a raw identifier. Comments, texts in quotes, and functions, methods and
/// modules of these names stay, but for the `kernel`.
pub fn renamed(text: &str, names: &BTreeMap<String, String>, kernel: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let taken = match c {
            _ if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '"' => quoted(rest),
            c if c == '_' || c.is_alphabetic() => {
                let end = rest
                    .find(|c: char| c != '_' && !c.is_alphanumeric())
                    .unwrap_or(rest.len());
                let (word, behind) = rest.split_at(end);
                if word == "use" {
                    // Imports are of modules and functions.
                    let end = rest.find(';').unwrap_or(rest.len());
                    out += &rest[..end];
                    rest = &rest[end..];
                    continue;
                }
                let is_path = behind.starts_with("::") || out.ends_with("::");
                let is_call = behind.starts_with('(') || is_path;
                let other = names.get(word).filter(|_| !is_call || word == kernel);
                // `'a`, a lifetime.
                let is_lifetime = out.ends_with('\'');
                match other.filter(|_| !is_lifetime) {
                    Some(other) => out += &raw(other),
                    None => out += word,
                }
                rest = behind;
                continue;
            }
            c if c.is_ascii_digit() => {
                // `1e3`, `2.0f32`, and not the method of `1.max`.
                let number = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
                number.unwrap_or(rest.len())
            }
            c => c.len_utf8(),
        };
        out += &rest[..taken];
        rest = &rest[taken..];
    }
    out
}

/// Length of a text in quotes.
fn quoted(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            '"' if !escaped => return at + 1,
            '\\' => escaped = !escaped,
            _ => escaped = false,
        }
    }
    text.len()
}

/// A name as Rust writes it.
pub fn raw(name: &str) -> String {
    const KEYWORDS: [&str; 48] = [
        "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn", "else", "enum",
        "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
        "move", "mut", "override", "priv", "pub", "ref", "return", "static", "struct", "trait", "true", "try", "type",
        "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
    ];
    match KEYWORDS.contains(&name) {
        true => format!("r#{name}"),
        false => name.to_owned(),
    }
}

/// Words of Rust's identifiers in a text.
pub fn words_of(text: &str) -> BTreeSet<&str> {
    let is_word = |c: char| c == '_' || c.is_alphanumeric();
    text.split(|c| !is_word(c)).filter(|word| !word.is_empty()).collect()
}

/// A kernel's files, its function, and how it is evaluated.
#[derive(Clone, Debug)]
pub struct Source {
    /// The files' texts.
    pub texts: Vec<String>,
    /// The function.
    pub function: String,
    /// Settings of the evaluation.
    pub settings: Settings,
}

/// A kernel under other names.
pub struct Renamed {
    /// The compiled kernel.
    pub compiled: Compiled,
    /// The other names by those of the original.
    pub names: BTreeMap<String, String>,
    /// Text of its first file.
    pub text: String,
}

impl Source {
    /// The kernel.
    ///
    /// # Errors
    ///
    /// It is wrong.
    pub fn kernel(&self) -> Kernel {
        let kernel = Kernel::from_text("0.rs", &self.texts[0], &self.function);
        let others = self.texts[1..].iter().enumerate();
        others.fold(kernel, |kernel, (k, text)| {
            kernel.with_text(&format!("{}.rs", k + 1), text)
        })
    }

    /// The kernel as it is.
    ///
    /// # Errors
    ///
    /// It is wrong.
    pub fn compile(&self) -> Result<Compiled, Errors> {
        self.kernel().compile(&self.settings)
    }

    /// The kernel with everything that hosts know by name called by the next of some words. Words that its files have are
    /// left out.
    ///
    /// # Errors
    ///
    /// It is wrong under one of its names.
    pub fn renamed(&self, words: &mut dyn Iterator<Item = String>) -> Result<Renamed, Errors> {
        let kernel = self.kernel();
        let options: Vec<String> = kernel.options()?.into_iter().map(|option| option.name).collect();
        let original = kernel.compile(&self.settings)?;
        let all = self.texts.concat();
        let mut used: BTreeSet<String> = words_of(&all).into_iter().map(str::to_owned).collect();
        let mut names = BTreeMap::new();
        for name in host_names(&original, &options) {
            // In the kernel language a local in capitals is a constant.
            let places = [
                "let $", "mut $", "for $", "|$", "($,", ", $)", ", $,", "{ $", "$ }", "Some($)",
            ];
            let is_local = places.iter().any(|place| all.contains(&place.replace('$', &name)));
            let suits = |word: &String| !(is_local && word.starts_with(char::is_uppercase));
            let mut free = words.filter(|word| suits(word) && used.insert(word.clone()));
            names.insert(name, free.next().expect("words without end"));
        }
        let mut other = self.clone();
        for text in &mut other.texts {
            *text = renamed(text, &names, &self.function);
        }
        other.function.clone_from(&names[&self.function]);
        for (option, _) in &mut other.settings.options {
            *option = names[&option.replace('-', "_")].replace('_', "-");
        }
        Ok(Renamed {
            compiled: other.compile()?,
            names,
            text: other.texts[0].clone(),
        })
    }
}

/// Renames inputs for another graph of the same kernel.
pub fn inputs_of(from: &Graph, to: &Graph, inputs: &Inputs) -> Inputs {
    let mut names: BTreeMap<&str, &str> = BTreeMap::new();
    let each = |graph: &'_ Graph| -> Vec<String> {
        let textures = graph.textures.iter().map(|t| t.name.clone());
        let samplers = graph.samplers.iter().map(|s| s.name.clone());
        let buffers = graph.buffers.iter().map(|b| b.name.clone());
        let uniforms = graph.uniforms.iter().map(|u| u.name.clone());
        textures.chain(samplers).chain(buffers).chain(uniforms).collect()
    };
    let (before, after) = (each(from), each(to));
    assert_eq!(before.len(), after.len(), "another kernel");
    names.extend(before.iter().map(String::as_str).zip(after.iter().map(String::as_str)));
    let mut other = inputs.clone();
    let rename = |name: &mut String| {
        if let Some(other) = names.get(name.as_str()) {
            *name = (*other).to_owned();
        }
    };
    other.images.iter_mut().for_each(|(name, _)| rename(name));
    other.smaller.iter_mut().for_each(|(name, _)| rename(name));
    other.integers.iter_mut().for_each(|(name, _)| rename(name));
    other.samplers.iter_mut().for_each(|(name, _)| rename(name));
    other.buffers.iter_mut().for_each(|(name, _)| rename(name));
    other.uniforms.iter_mut().for_each(|(name, _)| rename(name));
    other
}
