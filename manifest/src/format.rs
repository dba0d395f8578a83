//! Texel formats that a result can be written in.

#[cfg(feature = "json")]
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A texel format that WebGPU can use for a write-only storage texture everywhere.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "json", derive(Serialize, Deserialize), serde(rename_all = "lowercase"))]
#[allow(missing_docs)] // named as in WebGPU
pub enum Format {
    /// 8 bits a component, 0 to 1.
    Rgba8Unorm,
    /// 16-bit float components.
    #[default]
    Rgba16Float,
    /// 32-bit float components.
    Rgba32Float,
    R32Float,
    Rg32Float,
    R32Uint,
    Rg32Uint,
    Rgba32Uint,
    R32Sint,
    Rg32Sint,
    Rgba32Sint,
}

/// Number type of a texel's components.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // named as everywhere
pub enum Component {
    Float,
    Uint,
    Sint,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 11] = [
        Format::Rgba8Unorm,
        Format::Rgba16Float,
        Format::Rgba32Float,
        Format::R32Float,
        Format::Rg32Float,
        Format::R32Uint,
        Format::Rg32Uint,
        Format::Rgba32Uint,
        Format::R32Sint,
        Format::Rg32Sint,
        Format::Rgba32Sint,
    ];

    /// Formats of colours, among which a generator's caller chooses.
    pub const COLOURS: [Format; 3] = [Format::Rgba8Unorm, Format::Rgba16Float, Format::Rgba32Float];

    /// The WGSL spelling: `rgba8unorm`, `rgba16float`, `r32uint`, ...
    pub fn wgsl_name(self) -> &'static str {
        match self {
            Format::Rgba8Unorm => "rgba8unorm",
            Format::Rgba16Float => "rgba16float",
            Format::Rgba32Float => "rgba32float",
            Format::R32Float => "r32float",
            Format::Rg32Float => "rg32float",
            Format::R32Uint => "r32uint",
            Format::Rg32Uint => "rg32uint",
            Format::Rgba32Uint => "rgba32uint",
            Format::R32Sint => "r32sint",
            Format::Rg32Sint => "rg32sint",
            Format::Rgba32Sint => "rgba32sint",
        }
    }

    /// The GLSL layout qualifier: `rgba8`, `rgba16f`, `r32ui`, ...
    pub fn glsl_qualifier(self) -> &'static str {
        match self {
            Format::Rgba8Unorm => "rgba8",
            Format::Rgba16Float => "rgba16f",
            Format::Rgba32Float => "rgba32f",
            Format::R32Float => "r32f",
            Format::Rg32Float => "rg32f",
            Format::R32Uint => "r32ui",
            Format::Rg32Uint => "rg32ui",
            Format::Rgba32Uint => "rgba32ui",
            Format::R32Sint => "r32i",
            Format::Rg32Sint => "rg32i",
            Format::Rgba32Sint => "rgba32i",
        }
    }

    /// Components of a texel: 1, 2 or 4.
    pub fn components(self) -> u8 {
        match self {
            Format::R32Float | Format::R32Uint | Format::R32Sint => 1,
            Format::Rg32Float | Format::Rg32Uint | Format::Rg32Sint => 2,
            _ => 4,
        }
    }

    /// Returns the number type of the components.
    pub fn component_type(self) -> Component {
        match self {
            Format::R32Uint | Format::Rg32Uint | Format::Rgba32Uint => Component::Uint,
            Format::R32Sint | Format::Rg32Sint | Format::Rgba32Sint => Component::Sint,
            _ => Component::Float,
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.wgsl_name())
    }
}

/// Reads a format of colours.
impl FromStr for Format {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Format::COLOURS
            .into_iter()
            .find(|f| f.wgsl_name() == text)
            .ok_or_else(|| format!("unknown output format `{text}`: one of rgba8unorm, rgba16float, rgba32float"))
    }
}
