//! Debug information beside and inside a shader.

use std::fmt;
use std::str::FromStr;

/// Debug information of a shader: where its statements come from in the kernel's source.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum DebugInfo {
    /// None.
    #[default]
    None,
    /// A source map beside the shader ([`SourceMap`](straightline_manifest::SourceMap)). The shader is the same as without.
    Map,
    /// A source map, and the lines of the source in the shader: `OpLine` and the source's text in SPIR-V, `#line` in GLSL
    /// and HLSL. WGSL and MSL have none.
    Lines,
}

impl fmt::Display for DebugInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            DebugInfo::None => "none",
            DebugInfo::Map => "map",
            DebugInfo::Lines => "lines",
        })
    }
}

impl FromStr for DebugInfo {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let all = [DebugInfo::None, DebugInfo::Map, DebugInfo::Lines];
        let found = all.into_iter().find(|info| info.to_string() == text);
        found.ok_or_else(|| format!("unknown debug information `{text}`: none, map or lines"))
    }
}
