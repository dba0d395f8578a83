//! Options that a host sets when it creates the pipeline.

use std::fmt;

/// Type of an override.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "json",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
pub enum OverrideType {
    /// A float of 32 bits.
    F32,
    /// A signed integer of 32 bits.
    I32,
    /// An unsigned integer of 32 bits.
    U32,
    /// A boolean.
    Bool,
}

impl OverrideType {
    /// Returns whether the type has a value, which is finite; of a boolean 0 or 1.
    pub fn holds(self, value: f64) -> bool {
        let is_whole = value.fract() == 0.0;
        match self {
            OverrideType::F32 => (value as f32).is_finite(),
            OverrideType::I32 => is_whole && (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&value),
            OverrideType::U32 => is_whole && (0.0..=f64::from(u32::MAX)).contains(&value),
            OverrideType::Bool => value == 0.0 || value == 1.0,
        }
    }

    /// Returns the bits of a value that the type holds, as a shader has them.
    pub fn bits(self, value: f64) -> u32 {
        match self {
            OverrideType::F32 => (value as f32).to_bits(),
            OverrideType::I32 => value as i32 as u32,
            OverrideType::U32 => value as u32,
            OverrideType::Bool => u32::from(value != 0.0),
        }
    }
}

impl fmt::Display for OverrideType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            OverrideType::F32 => "f32",
            OverrideType::I32 => "i32",
            OverrideType::U32 => "u32",
            OverrideType::Bool => "bool",
        })
    }
}

/// An option that a host may set when it creates the pipeline: a pipeline-overridable constant of WGSL, a
/// specialization constant of SPIR-V, a macro of other languages.
#[cfg(feature = "json")]
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Override {
    /// Name in the kernel's source.
    pub name: String,
    /// Position among the kernel's options: `@id` in WGSL, `SpecId` in SPIR-V, `constant_id` in Vulkan's GLSL.
    pub id: u32,
    /// Macro that sets it in HLSL, in GLSL for OpenGL, and in functions in GLSL.
    pub define: String,
    /// Type.
    #[serde(rename = "type")]
    pub ty: OverrideType,
    /// Value unless the host sets one; of a boolean 0 or 1.
    pub default: f64,
    /// Smallest and largest value that the kernel allows, if it states them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
}
