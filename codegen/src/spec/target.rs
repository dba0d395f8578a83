//! Languages that a shader can be emitted in.

use std::fmt;
use std::str::FromStr;
use straightline_manifest::{Form, Stage};

/// A language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Target {
    /// WebGPU's shading language.
    Wgsl,
    /// Vulkan GLSL 4.50 with separate textures.
    Glsl450,
    /// GLSL 4.30 of OpenGL, with combined samplers.
    Glsl430,
    /// GLSL 3.30 of OpenGL, with combined samplers; fragment shaders.
    Glsl330,
    /// GLSL 3.10 of OpenGL ES, with combined samplers.
    Essl310,
    /// GLSL 3.00 of OpenGL ES and WebGL 2, with combined samplers; fragment shaders.
    Essl300,
    /// SPIR-V 1.3, binary.
    Spirv,
    /// HLSL, shader model 5.1; in half precision 6.2, compiled with `-enable-16bit-types`.
    Hlsl,
    /// Metal Shading Language 2.0.
    Msl,
}

impl Target {
    /// Every language.
    pub const ALL: [Target; 9] = [
        Target::Wgsl,
        Target::Glsl450,
        Target::Glsl430,
        Target::Glsl330,
        Target::Essl310,
        Target::Essl300,
        Target::Spirv,
        Target::Hlsl,
        Target::Msl,
    ];

    /// Languages that support every shader, except for half precision and fine derivatives.
    pub const MODERN: [Target; 5] = [Target::Wgsl, Target::Glsl450, Target::Spirv, Target::Hlsl, Target::Msl];

    /// Languages of OpenGL and OpenGL ES, in which a texture and its sampler are combined, and uniforms are not in a block.
    pub const OPENGL: [Target; 4] = [Target::Glsl430, Target::Glsl330, Target::Essl310, Target::Essl300];

    /// Extension of the language's files.
    pub fn extension(self, stage: Stage, form: Form) -> &'static str {
        if form == Form::Function {
            // The extension marks a function, which is not a whole shader.
            return match self {
                Target::Glsl450 => "glsl",
                Target::Glsl430 => "430.glsl",
                Target::Glsl330 => "330.glsl",
                Target::Essl310 => "es310.glsl",
                Target::Essl300 => "es300.glsl",
                _ => self.extension(stage, Form::Entry),
            };
        }
        match (self, stage) {
            (Target::Wgsl, _) => "wgsl",
            (Target::Glsl450, Stage::Compute) => "comp",
            (Target::Glsl450, Stage::Fragment) => "frag",
            (Target::Glsl430, Stage::Compute) => "430.comp",
            (Target::Glsl430, Stage::Fragment) => "430.frag",
            (Target::Glsl330, _) => "330.frag",
            (Target::Essl310, Stage::Compute) => "es310.comp",
            (Target::Essl310, Stage::Fragment) => "es310.frag",
            (Target::Essl300, _) => "es300.frag",
            (Target::Spirv, _) => "spv",
            (Target::Hlsl, _) => "hlsl",
            (Target::Msl, _) => "metal",
        }
    }

    /// Returns whether the language is a GLSL.
    pub fn is_glsl(self) -> bool {
        self == Target::Glsl450 || Target::OPENGL.contains(&self)
    }

    /// The `#version` of a GLSL.
    pub(crate) fn glsl_version(self) -> &'static str {
        match self {
            Target::Glsl430 => "430",
            Target::Glsl330 => "330",
            Target::Essl310 => "310 es",
            Target::Essl300 => "300 es",
            _ => "450",
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Target::Wgsl => "wgsl",
            Target::Glsl450 => "glsl450",
            Target::Glsl430 => "glsl430",
            Target::Glsl330 => "glsl330",
            Target::Essl310 => "essl310",
            Target::Essl300 => "essl300",
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
        known.ok_or_else(|| {
            format!(
                "unknown language `{text}`: one of wgsl, glsl450, glsl430, glsl330, essl310, essl300, spirv, hlsl, msl"
            )
        })
    }
}
