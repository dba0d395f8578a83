//! Description of the shaders of a chain.

use crate::spec::ShaderSpec;
use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;
use straightline_manifest::Format;

/// Description of the shaders of a chain.
///
/// ```
/// use straightline_codegen::ShaderSpec;
/// use straightline_codegen::chain::{ChainSpec, Fuse};
///
/// let spec = ChainSpec::from(ShaderSpec::new().set("levels", "5")).fuse(Fuse::Auto);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ChainSpec {
    /// Description of every pass. Its format is that of the results.
    pub shader: ShaderSpec,
    /// Pictures that are computed where they are read.
    pub fuse: Fuse,
    /// Format of the pictures between passes; by default what their texels need: `rgba16float` for three and four components.
    pub pictures: Option<Format>,
}

impl From<ShaderSpec> for ChainSpec {
    fn from(shader: ShaderSpec) -> Self {
        ChainSpec {
            shader,
            ..ChainSpec::default()
        }
    }
}

impl ChainSpec {
    /// Sets which pictures are computed where they are read.
    pub fn fuse(mut self, fuse: Fuse) -> Self {
        self.fuse = fuse;
        self
    }

    /// Sets the format of the pictures between passes, but of those with an attribute.
    pub fn pictures(mut self, format: Format) -> Self {
        self.pictures = Some(format);
        self
    }
}

/// Pictures of a chain that are computed where they are read, in place of being stored in a texture.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Fuse {
    /// None: each call of `draw` is a pass.
    #[default]
    None,
    /// Pictures that cost no more to compute at every read than to store and read.
    Auto,
    /// All that can be.
    All,
    /// Pictures of these names.
    Named(BTreeSet<String>),
}

impl FromStr for Fuse {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "none" => Ok(Fuse::None),
            "auto" => Ok(Fuse::Auto),
            "all" => Ok(Fuse::All),
            names => {
                let names: BTreeSet<String> = names.split(',').map(|name| name.trim().to_owned()).collect();
                match names.iter().any(String::is_empty) {
                    true => Err("expected none, auto, all, or names of pictures: `--fuse edges,weights`".to_owned()),
                    false => Ok(Fuse::Named(names)),
                }
            }
        }
    }
}

impl fmt::Display for Fuse {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fuse::None => f.write_str("none"),
            Fuse::Auto => f.write_str("auto"),
            Fuse::All => f.write_str("all"),
            Fuse::Named(names) => f.write_str(&names.iter().cloned().collect::<Vec<_>>().join(",")),
        }
    }
}
