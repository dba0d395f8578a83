//! Languages that a shader can be emitted in.

use std::fmt;
use std::str::FromStr;
use straightline_manifest::Stage;

/// A language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Target {
    /// WebGPU's own.
    Wgsl,
    /// Vulkan GLSL 4.50 with separate textures.
    Glsl450,
    /// SPIR-V 1.3, binary.
    Spirv,
    /// HLSL, shader model 5.1; in half precision 6.2, compiled with `-enable-16bit-types`.
    Hlsl,
    /// Metal Shading Language 2.0.
    Msl,
}

impl Target {
    /// Every language.
    pub const ALL: [Target; 5] = [Target::Wgsl, Target::Glsl450, Target::Spirv, Target::Hlsl, Target::Msl];

    /// What files of it end in.
    pub fn extension(self, stage: Stage) -> &'static str {
        match (self, stage) {
            (Target::Wgsl, _) => "wgsl",
            (Target::Glsl450, Stage::Compute) => "comp",
            (Target::Glsl450, Stage::Fragment) => "frag",
            (Target::Spirv, _) => "spv",
            (Target::Hlsl, _) => "hlsl",
            (Target::Msl, _) => "metal",
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Target::Wgsl => "wgsl",
            Target::Glsl450 => "glsl450",
            Target::Spirv => "spirv",
            Target::Hlsl => "hlsl",
            Target::Msl => "msl",
        })
    }
}

impl FromStr for Target {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = Target::ALL.into_iter().find(|target| target.to_string() == text);
        known.ok_or_else(|| format!("unknown language `{text}`: one of wgsl, glsl450, spirv, hlsl, msl"))
    }
}
