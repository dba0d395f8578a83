//! Address space of a shader's uniforms.

use std::fmt;
use std::str::FromStr;

/// Address space of the uniforms of a whole shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Parameters {
    /// A uniform buffer.
    #[default]
    Uniform,
    /// Memory of the commands: immediates of WebGPU, push constants of Vulkan, root constants of Direct3D 12.
    Immediate,
}

impl Parameters {
    /// Bytes of immediates that every Vulkan device has, and at most those of Direct3D 12 and Metal.
    pub const MOST_IMMEDIATE_BYTES: u32 = 128;
}

impl fmt::Display for Parameters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Parameters::Uniform => "uniform",
            Parameters::Immediate => "immediate",
        })
    }
}

impl FromStr for Parameters {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "uniform" => Ok(Parameters::Uniform),
            "immediate" => Ok(Parameters::Immediate),
            _ => Err(format!(
                "unknown address space of uniforms `{text}`: uniform or immediate"
            )),
        }
    }
}
