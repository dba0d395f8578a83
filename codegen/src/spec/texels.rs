//! Sources of a function's texels.

use std::fmt;
use std::str::FromStr;

/// Source of the texels that a function ([`Form::Function`](straightline_manifest::Form)) reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Texels {
    /// Textures and samplers, as parameters.
    #[default]
    Textures,
    /// Functions of the host, defined before the shader's function. For hosts that provide no texture, only a way to read
    /// one.
    Functions,
}

impl fmt::Display for Texels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Texels::Textures => "textures",
            Texels::Functions => "functions",
        })
    }
}

impl FromStr for Texels {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "textures" => Ok(Texels::Textures),
            "functions" => Ok(Texels::Functions),
            _ => Err(format!("unknown source of texels `{text}`: textures or functions")),
        }
    }
}
