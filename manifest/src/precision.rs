//! Precisions that a shader can compute in.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Precision of every float that a shader computes. The host's inputs and outputs do not change with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// IEEE 754 binary32, which every device has.
    #[default]
    F32,
    /// IEEE 754 binary16, which a device may have: the feature `shader-f16`.
    F16,
}

impl Precision {
    /// Every precision.
    pub const ALL: [Precision; 2] = [Precision::F32, Precision::F16];

    /// The WGSL spelling: `f32` or `f16`.
    pub fn wgsl_name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F16 => "f16",
        }
    }

    /// Returns whether this is the precision that a manifest without the field has.
    pub(crate) fn is_default(&self) -> bool {
        *self == Precision::default()
    }
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.wgsl_name())
    }
}

impl FromStr for Precision {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Precision::ALL
            .into_iter()
            .find(|p| p.wgsl_name() == text)
            .ok_or_else(|| format!("unknown precision `{text}`: one of f16, f32"))
    }
}
