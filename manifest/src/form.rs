//! Form of a shader's text, and the order of its rows.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Form of a shader: complete, or a part of another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Form {
    /// A whole shader with an entry point.
    #[default]
    Entry,
    /// A function that returns the colour of a position, for use in a fragment shader of the host's. Its inputs are its
    /// parameters.
    Function,
}

impl Form {
    /// `entry` or `function`.
    pub fn name(self) -> &'static str {
        match self {
            Form::Entry => "entry",
            Form::Function => "function",
        }
    }

    pub(crate) fn is_default(&self) -> bool {
        *self == Form::default()
    }
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Form {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = [Form::Entry, Form::Function].into_iter().find(|f| f.name() == text);
        known.ok_or_else(|| format!("unknown form `{text}`: one of entry, function"))
    }
}

/// Position of row 0 of every texture, of the target and of positions, as the upright picture is seen. A kernel's own rows
/// always count from above.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Row 0 is the uppermost: WebGPU, Vulkan, Direct3D, Metal.
    #[default]
    UpperLeft,
    /// Row 0 is the lowest: OpenGL, and engines that follow it.
    LowerLeft,
}

impl Origin {
    /// `upper-left` or `lower-left`.
    pub fn name(self) -> &'static str {
        match self {
            Origin::UpperLeft => "upper-left",
            Origin::LowerLeft => "lower-left",
        }
    }

    pub(crate) fn is_default(&self) -> bool {
        *self == Origin::default()
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Origin {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = [Origin::UpperLeft, Origin::LowerLeft].into_iter();
        let mut known = known.filter(|origin| origin.name() == text);
        known
            .next()
            .ok_or_else(|| format!("unknown origin `{text}`: one of upper-left, lower-left"))
    }
}
