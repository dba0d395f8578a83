//! Reserved words of each language, and names that are invalid.

mod glsl;
mod hlsl;

use super::refusal::Refusal;
use crate::spec::EmitOptions;
use crate::spec::Target;
use naga::keywords::wgsl;
use std::collections::BTreeSet;
use straightline_evaluator::diagnostic::Code;

/// Maximum length of a name that every compiler accepts.
pub const LONGEST: usize = 255;

/// Maximum number of alternatives for a taken name. A text has far fewer names.
const MOST: u32 = 1_000_000;

/// A language whose reserved words names must avoid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Words {
    /// WGSL, and its translations by naga.
    Wgsl,
    /// GLSL of every version.
    Glsl,
    /// HLSL.
    Hlsl,
}

impl Words {
    /// Returns the language of a target's text.
    pub fn from_target(target: Target) -> Words {
        match target {
            Target::Hlsl => Words::Hlsl,
            Target::Wgsl | Target::Spirv | Target::Msl => Words::Wgsl,
            Target::Glsl450 | Target::Glsl430 | Target::Glsl330 | Target::Essl310 | Target::Essl300 => Words::Glsl,
        }
    }

    /// Returns whether a word is reserved in the language.
    pub fn is_reserved(self, word: &str) -> bool {
        word.starts_with("__")
            || match self {
                Words::Wgsl => {
                    wgsl::RESERVED.contains(&word) || wgsl::BUILTIN_IDENTIFIER_SET.contains(word) || is_wgsl_type(word)
                }
                Words::Glsl => glsl::WORDS.contains(&word) || is_glsl_type(word) || word.starts_with("gl_"),
                Words::Hlsl => {
                    let in_any_case = |known: &&str| known.eq_ignore_ascii_case(word);
                    hlsl::WORDS.contains(&word) || is_hlsl_type(word) || IN_ANY_CASE.iter().any(in_any_case)
                }
            }
    }
}

/// Words of HLSL that FXC reserves regardless of case.
const IN_ANY_CASE: [&str; 8] = [
    "asm",
    "decl",
    "pass",
    "technique",
    "Texture1D",
    "Texture2D",
    "Texture3D",
    "TextureCube",
];

/// Words that names in one text must avoid: those of its language, of others and of an engine.
#[derive(Clone, Debug)]
pub struct Reserved {
    languages: BTreeSet<Words>,
    words: BTreeSet<String>,
}

impl Reserved {
    /// Collects the words for the language of a target.
    pub fn new(target: Target, options: &EmitOptions) -> Reserved {
        let also = options.clear_of.iter().map(|other| Words::from_target(*other));
        Reserved {
            languages: also.chain([Words::from_target(target)]).collect(),
            words: options.reserved.clone(),
        }
    }

    /// Returns whether a word is reserved.
    pub fn has(&self, word: &str) -> bool {
        is_among(&self.words, word) || self.languages.iter().any(|language| language.is_reserved(word))
    }
}

/// Returns whether a word matches an entry of a list, in which `gl_*` stands for every word with that prefix and `*Sampler`
/// for every word with that suffix.
pub fn is_among(words: &BTreeSet<String>, word: &str) -> bool {
    let begins = |pattern: &String| pattern.strip_suffix('*').is_some_and(|start| word.starts_with(start));
    let ends = |pattern: &String| pattern.strip_prefix('*').is_some_and(|end| word.ends_with(end));
    words.contains(word) || words.iter().any(|pattern| begins(pattern) || ends(pattern))
}

/// Returns whether a word is a predeclared type of WGSL from a family (`vec2f`, `mat4x3h`, `texture_2d`), a texel format,
/// or an access mode.
fn is_wgsl_type(word: &str) -> bool {
    const OTHERS: [&str; 21] = [
        "bool",
        "f16",
        "f32",
        "f64",
        "i32",
        "i64",
        "u32",
        "u64",
        "array",
        "atomic",
        "ptr",
        "sampler",
        "sampler_comparison",
        "binding_array",
        "acceleration_structure",
        "ray_query",
        "bgra8unorm",
        "read",
        "write",
        "read_write",
        "storage",
    ];
    let is_number = |kind: &str| {
        let size = word
            .strip_prefix(kind)
            .map(|size| size.trim_end_matches(['f', 'h', 'i', 'u']));
        size.is_some_and(|size| !size.is_empty() && is_size(size) && word.len() - kind.len() - size.len() <= 1)
    };
    let is_texture = word.strip_prefix("texture_").is_some_and(|shape| {
        let shape = shape.trim_start_matches("storage_").trim_start_matches("depth_");
        let shape = shape.trim_start_matches("multisampled_").trim_end_matches("_array");
        ["1d", "2d", "3d", "cube", "external"].contains(&shape)
    });
    let channels = ["r", "rg", "rgba"].iter().find_map(|kind| {
        let rest = word.strip_prefix(kind)?;
        rest.starts_with(|c: char| c.is_ascii_digit()).then_some(rest)
    });
    let is_format = channels.is_some_and(|rest| {
        let kind = rest.trim_start_matches(|c: char| c.is_ascii_digit());
        ["float", "unorm", "snorm", "uint", "sint"].contains(&kind)
    });
    OTHERS.contains(&word) || is_number("vec") || is_number("mat") || is_texture || is_format
}

/// Returns whether a word is a type of HLSL from a family: `float4x3`, `uint2`, `min16float`, `sampler2D`.
fn is_hlsl_type(word: &str) -> bool {
    const SCALARS: [&str; 23] = [
        "bool",
        "int",
        "uint",
        "dword",
        "half",
        "float",
        "double",
        "min10float",
        "min16float",
        "min12int",
        "min16int",
        "min16uint",
        "int16_t",
        "int32_t",
        "int64_t",
        "uint16_t",
        "uint32_t",
        "uint64_t",
        "float16_t",
        "float32_t",
        "float64_t",
        "int8_t4_packed",
        "uint8_t4_packed",
    ];
    let is_numeric = |scalar: &&str| word.strip_prefix(*scalar).is_some_and(is_size);
    let opaque = ["sampler", "texture", "Texture", "RWTexture"];
    let shapes = ["1D", "2D", "3D", "CUBE", "Cube", "RECT"];
    let is_opaque = |kind: &&str| word.strip_prefix(*kind).is_some_and(|shape| shapes.contains(&shape));
    SCALARS.iter().any(is_numeric) || opaque.iter().any(is_opaque)
}

/// Returns whether a text is a size suffix, which follows the scalar in the name of a vector or a matrix: `3`, `4x2`, or
/// nothing.
fn is_size(text: &str) -> bool {
    let side = |c: u8| (b'1'..=b'4').contains(&c);
    match text.as_bytes() {
        [] => true,
        [n] => side(*n),
        [m, b'x', n] => side(*m) && side(*n),
        _ => false,
    }
}

/// Returns whether a word is a type of GLSL from a family: `mat4x3`, `ivec2`, `usampler2DArray`, `image3D`, ...
fn is_glsl_type(word: &str) -> bool {
    let is_type = |bare: &str| {
        let numbered = ["vec", "mat"].iter().any(|kind| {
            let size = bare.strip_prefix(kind);
            size.is_some_and(|size| !size.is_empty() && is_size(size))
        });
        let is_opaque = |kind: &&str| {
            let rest = bare.strip_prefix(*kind);
            let whole = *kind != "image";
            rest.is_some_and(|rest| (whole && rest.is_empty()) || is_shape(rest))
        };
        let opaque = ["sampler", "image", "texture", "subpassInput"];
        numbered || opaque.iter().any(is_opaque)
    };
    is_type(word) || word.strip_prefix(['i', 'u', 'b', 'd', 'f', 'h']).is_some_and(is_type)
}

/// Returns whether a text consists of GLSL's texture shapes and their suffixes: `2DArrayShadow`, `CubeLod`.
fn is_shape(text: &str) -> bool {
    const PARTS: [&str; 11] = [
        "1D", "2D", "3D", "Cube", "Buffer", "Rect", "Array", "Shadow", "MS", "Lod", "Proj",
    ];
    let mut rest = text;
    while let Some(shorter) = PARTS.iter().find_map(|part| rest.strip_prefix(part)) {
        rest = shorter;
    }
    rest.is_empty() && !text.is_empty()
}

/// Returns a name as an identifier of every language: `é` becomes `ue9`, double underscores become one, and very long names
/// are cut.
pub fn to_identifier(name: &str) -> String {
    let mut out = String::new();
    let mut push = |c: char| {
        // GLSL reserves double underscores.
        if c != '_' || !out.ends_with('_') {
            out.push(c);
        }
    };
    for c in name.chars() {
        match c {
            c if c.is_ascii_alphanumeric() => push(c),
            c if c.is_ascii() => push('_'),
            c => format!("u{:x}", u32::from(c)).chars().for_each(&mut push),
        }
    }
    out.truncate(LONGEST / 2);
    let out = out.trim_start_matches('_');
    if out.is_empty() || out.starts_with(|c: char| c.is_ascii_digit()) || out.starts_with("gl_") {
        format!("v_{out}")
    } else {
        out.to_owned()
    }
}

/// Returns whether a name is already an identifier in every language.
pub fn is_plain(name: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.len() <= LONGEST
        && name.chars().all(is_letter)
        && name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name != "_"
        && !name.contains("__")
}

/// Returns a name that is not taken: `name` itself, or else `name_`, `v_name`, or `v_name_2`, `v_name_3`, ...
///
/// # Errors
///
/// If all of a million names are taken.
pub fn free_name(kernel: &str, name: &str, taken: impl Fn(&str) -> bool) -> Result<String, Refusal> {
    let base = match is_plain(name) {
        true => name.to_owned(),
        false => to_identifier(name),
    };
    if !taken(&base) {
        return Ok(base);
    }
    // Leaves room for the suffix.
    let stem = &base[..base.len().min(LONGEST / 2)];
    let stem = stem.trim_end_matches('_');
    let marked = [format!("{stem}_"), format!("v_{}", stem.trim_start_matches('_'))];
    if let Some(free) = marked.iter().find(|name| !taken(name)) {
        return Ok(free.clone());
    }
    let [_, before] = &marked;
    // An engine may reserve all words with the name's prefix.
    numbered_name(kernel, before, 2, taken).map(|(name, _)| name)
}

/// Returns the first of `stem_K`, `stem_(K + 1)`, ... that is not taken, and the number after its own.
///
/// # Errors
///
/// If all of a million names are taken.
pub fn numbered_name(
    kernel: &str,
    stem: &str,
    from: u32,
    taken: impl Fn(&str) -> bool,
) -> Result<(String, u32), Refusal> {
    let mut numbers = from..from.saturating_add(MOST);
    let found = numbers.find_map(|k| {
        let name = format!("{stem}_{k}");
        (!taken(&name)).then_some((name, k + 1))
    });
    found.ok_or_else(|| {
        let stem = straightline_evaluator::shorten(stem);
        let what = format!("`{kernel}` has a million names like `{stem}`");
        Refusal::new(Code::Names, what).help("give them other names")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn families_of_types_are_whole_words() {
        for word in [
            "float4x3",
            "uint2",
            "half",
            "min16float3",
            "sampler2D",
            "texture",
            "samplerCUBE",
            "int16_t4",
        ] {
            assert!(Words::Hlsl.is_reserved(word), "{word}");
        }
        for word in [
            "mat4x3",
            "ivec2",
            "usampler2DArray",
            "image3D",
            "sampler",
            "gl_x",
            "textureCubeLod",
            "dmat2",
        ] {
            assert!(Words::Glsl.is_reserved(word), "{word}");
        }
        for word in [
            "vec2f",
            "vec3",
            "mat4x3h",
            "texture_storage_2d",
            "texture_depth_2d_array",
            "rgba16float",
            "array",
        ] {
            assert!(Words::Wgsl.is_reserved(word), "{word}");
        }
        for language in [Words::Wgsl, Words::Glsl, Words::Hlsl] {
            for name in [
                "vec2fu",
                "texture_2d_of_it",
                "vecf",
                "r_float",
                "rgba",
                "textures_2d",
                "texture0",
                "sampler0",
                "texture2d_albedo",
                "samplers",
                "float_",
                "vectors",
                "mat_4",
                "image_",
                "intx",
                "sampler2D_",
                "images2D",
            ] {
                assert!(!language.is_reserved(name), "{name} in {language:?}");
            }
        }
    }

    #[test]
    fn a_name_in_place_of_one_that_is_taken_is_free() {
        let taken = BTreeSet::from(["a", "a_", "a_2", "b", "ue9"]);
        let free = |name: &str| free_name("k", name, |name| taken.contains(name) || Words::Glsl.is_reserved(name));
        for (name, other) in [
            ("c", "c"),
            ("_x", "_x"),
            ("a", "v_a"),
            ("b", "b_"),
            ("é", "ue9_"),
            ("_", "v_"),
            ("a__b", "a_b"),
            ("sampler2D", "sampler2D_"),
            ("größe", "gruf6udfe"),
        ] {
            assert_eq!(free(name).expect("a free name"), other, "{name}");
            assert!(is_plain(other), "{other}");
        }
        assert!(super::free_name("k", "a", |_| true).is_err());
        let long = free(&"n".repeat(2000)).expect("a free name");
        assert!(long.len() <= LONGEST);
    }
}
