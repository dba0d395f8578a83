//! Texel formats that a result can be written in.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A texel format that WebGPU can use for a write-only storage texture everywhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// 8 bits a component, 0 to 1.
    Rgba8Unorm,
    /// 16-bit float components.
    #[default]
    Rgba16Float,
    /// 32-bit float components.
    Rgba32Float,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 3] = [Format::Rgba8Unorm, Format::Rgba16Float, Format::Rgba32Float];

    /// The WGSL spelling: `rgba8unorm`, `rgba16float`, `rgba32float`.
    pub fn wgsl(self) -> &'static str {
        match self {
            Format::Rgba8Unorm => "rgba8unorm",
            Format::Rgba16Float => "rgba16float",
            Format::Rgba32Float => "rgba32float",
        }
    }

    /// The GLSL layout qualifier: `rgba8`, `rgba16f`, `rgba32f`.
    pub fn glsl(self) -> &'static str {
        match self {
            Format::Rgba8Unorm => "rgba8",
            Format::Rgba16Float => "rgba16f",
            Format::Rgba32Float => "rgba32f",
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.wgsl())
    }
}

impl FromStr for Format {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Format::ALL
            .into_iter()
            .find(|f| f.wgsl() == text)
            .ok_or_else(|| format!("unknown output format `{text}`: one of rgba8unorm, rgba16float, rgba32float"))
    }
}
