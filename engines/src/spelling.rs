//! Spelling, by language, of the types that a manifest names in WGSL's words.

use std::collections::BTreeSet;
use straightline_codegen::emit::is_among;
use straightline_manifest::{Dimension, SampleType, Scalar, ValueType};

/// A number or a vector in GLSL: `vec2f` is `vec2`.
pub fn glsl_type(ty: ValueType) -> String {
    let (scalar, vector) = match ty.scalar() {
        Scalar::F32 => ("float", "vec"),
        Scalar::I32 => ("int", "ivec"),
        Scalar::U32 => ("uint", "uvec"),
    };
    match ty.components() {
        1 => scalar.to_owned(),
        n => format!("{vector}{n}"),
    }
}

/// A number or a vector in HLSL: `vec2f` is `float2`.
pub fn hlsl_type(ty: ValueType) -> String {
    let scalar = match ty.scalar() {
        Scalar::F32 => "float",
        Scalar::I32 => "int",
        Scalar::U32 => "uint",
    };
    match ty.components() {
        1 => scalar.to_owned(),
        n => format!("{scalar}{n}"),
    }
}

/// A combined sampler in GLSL: `sampler2D`, `isampler3D`, `samplerCubeShadow`.
pub fn glsl_sampler(dimension: Dimension, sample_type: SampleType, compares: bool) -> String {
    let kind = match sample_type {
        SampleType::Sint => "i",
        SampleType::Uint => "u",
        _ => "",
    };
    let shape = match dimension {
        Dimension::D2 => "2D",
        Dimension::D2Array => "2DArray",
        Dimension::D3 => "3D",
        Dimension::Cube => "Cube",
        Dimension::D2Multisampled => "2DMS",
    };
    format!("{kind}sampler{shape}{}", if compares { "Shadow" } else { "" })
}

/// A texture in HLSL: `Texture2D<float4>`.
pub fn hlsl_texture(dimension: Dimension, sample_type: SampleType) -> String {
    let shape = match dimension {
        Dimension::D2 => "Texture2D",
        Dimension::D2Array => "Texture2DArray",
        Dimension::D3 => "Texture3D",
        Dimension::Cube => "TextureCube",
        Dimension::D2Multisampled => "Texture2DMS",
    };
    let texel = match sample_type {
        SampleType::Sint => "int4",
        SampleType::Uint => "uint4",
        SampleType::Depth => "float",
        _ => "float4",
    };
    format!("{shape}<{texel}>")
}

/// A number as every language with decimal points reads it: of floats the shortest that is the same `f32`.
pub fn format_number(value: f64, scalar: Scalar) -> String {
    match scalar {
        Scalar::I32 | Scalar::U32 => format!("{}", value as i64),
        Scalar::F32 => format!("{:?}", value as f32),
    }
}

/// `joint_bilateral` as `JointBilateral`: a name in every language, and none of an engine's `words`.
pub fn class_name(name: &str, words: &BTreeSet<String>) -> String {
    let name = spelled_out(name);
    let parts = name
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty());
    let class: String = parts.map(capitalise_word).collect();
    match class.starts_with(|c: char| c.is_ascii_alphabetic()) && !is_among(words, &class) {
        true => class,
        false => format!("Kernel{class}"),
    }
}

/// A name in letters of ASCII: `é` is `ue9`.
pub fn spelled_out(name: &str) -> String {
    let each = name.chars().map(|c| match c.is_ascii() {
        true => c.to_string(),
        false => format!("u{:x}", u32::from(c)),
    });
    each.collect()
}

/// `joint_bilateral` as `Joint bilateral`.
pub fn title(name: &str) -> String {
    let words: Vec<&str> = name.split(['_', '-']).filter(|word| !word.is_empty()).collect();
    capitalise_word(&words.join(" "))
}

fn capitalise_word(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_ascii_uppercase().to_string() + letters.as_str()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_those_of_the_language() {
        for (wgsl, in_glsl, in_hlsl) in [
            ("f32", "float", "float"),
            ("i32", "int", "int"),
            ("u32", "uint", "uint"),
            ("vec2f", "vec2", "float2"),
            ("vec3i", "ivec3", "int3"),
            ("vec4u", "uvec4", "uint4"),
        ] {
            let ty = wgsl.parse().expect("a type");
            assert_eq!((glsl_type(ty).as_str(), hlsl_type(ty).as_str()), (in_glsl, in_hlsl));
        }
    }

    #[test]
    fn numbers_have_a_point_where_they_are_floats() {
        assert_eq!(format_number(f64::from(0.15_f32), Scalar::F32), "0.15");
        assert_eq!(format_number(3.0, Scalar::F32), "3.0");
        assert_eq!(format_number(3.0, Scalar::I32), "3");
    }

    #[test]
    fn names_are_made_of_words() {
        let words = BTreeSet::from(["Plugin".to_owned()]);
        let class = |name: &str| class_name(name, &words);
        assert_eq!(class("joint_bilateral_upsampling"), "JointBilateralUpsampling");
        assert_eq!((class("plugin").as_str(), class("é").as_str()), ("KernelPlugin", "Ue9"));
        assert_eq!(class("_2d"), "Kernel2d");
        assert_eq!(title("joint_bilateral"), "Joint bilateral");
    }
}
