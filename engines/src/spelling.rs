//! How languages spell the types that a manifest names in WGSL's words.

use straightline_manifest::{Dimension, SampleType};

/// Component kind of a uniform: `f`, `i` or `u`, and how many there are.
pub fn parts(wgsl: &str) -> (char, u32) {
    match wgsl.strip_prefix("vec") {
        Some(rest) => {
            let lanes = rest.chars().next().and_then(|c| c.to_digit(10)).unwrap_or(1);
            (rest.chars().last().unwrap_or('f'), lanes)
        }
        None => (wgsl.chars().next().unwrap_or('f'), 1),
    }
}

/// A scalar or vector in GLSL: `vec2f` is `vec2`.
pub fn glsl(wgsl: &str) -> String {
    match parts(wgsl) {
        ('i', 1) => "int".to_owned(),
        ('u', 1) => "uint".to_owned(),
        (_, 1) => "float".to_owned(),
        ('i', n) => format!("ivec{n}"),
        ('u', n) => format!("uvec{n}"),
        (_, n) => format!("vec{n}"),
    }
}

/// A scalar or vector in HLSL: `vec2f` is `float2`.
pub fn hlsl(wgsl: &str) -> String {
    let (kind, n) = parts(wgsl);
    let scalar = match kind {
        'i' => "int",
        'u' => "uint",
        _ => "float",
    };
    match n {
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
pub fn number(value: f64, kind: char) -> String {
    match kind {
        'i' | 'u' => format!("{}", value as i64),
        _ => format!("{:?}", value as f32),
    }
}

/// `joint_bilateral` as `JointBilateral`.
pub fn class(name: &str) -> String {
    let words = name
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty());
    words.map(capitalised).collect()
}

/// `joint_bilateral` as `Joint bilateral`.
pub fn title(name: &str) -> String {
    let words: Vec<&str> = name.split(['_', '-']).filter(|word| !word.is_empty()).collect();
    capitalised(&words.join(" "))
}

fn capitalised(word: &str) -> String {
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
            assert_eq!((glsl(wgsl).as_str(), hlsl(wgsl).as_str()), (in_glsl, in_hlsl));
        }
    }

    #[test]
    fn numbers_have_a_point_where_they_are_floats() {
        assert_eq!(number(f64::from(0.15_f32), 'f'), "0.15");
        assert_eq!(number(3.0, 'f'), "3.0");
        assert_eq!(number(3.0, 'i'), "3");
    }

    #[test]
    fn names_are_made_of_words() {
        assert_eq!(class("joint_bilateral_upsampling"), "JointBilateralUpsampling");
        assert_eq!(title("joint_bilateral"), "Joint bilateral");
    }
}
