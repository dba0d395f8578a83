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
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ChainSpec {
    /// Description of every pass. Its format is that of the results.
    pub shader: ShaderSpec,
    /// Pictures that are computed where they are read.
    pub fuse: Fuse,
    /// Most pictures that a pass may write, where workgroups compute several. 4 is what every device of WebGPU has.
    pub most_outputs: u32,
    /// Format of the pictures between passes; by default what their texels need: `rgba16float` for three and four components.
    pub pictures: Option<Format>,
}

impl Default for ChainSpec {
    fn default() -> Self {
        ChainSpec {
            shader: ShaderSpec::default(),
            fuse: Fuse::None,
            most_outputs: 4,
            pictures: None,
        }
    }
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

    /// Sets how many pictures a pass may write, where workgroups compute several: at least 1.
    pub fn most_outputs(mut self, most: u32) -> Self {
        self.most_outputs = most;
        self
    }

    /// Sets the format of the pictures between passes, but of those with an attribute.
    pub fn pictures(mut self, format: Format) -> Self {
        self.pictures = Some(format);
        self
    }
}

/// Passes of a chain that are one: pictures that are computed where they are read, or by the workgroup that reads them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Fuse {
    /// None: each call of `draw` is a pass.
    #[default]
    None,
    /// Pictures that cost no more to compute at every read than to store and read.
    Auto,
    /// All that can be computed where they are read.
    All,
    /// All that workgroups can compute in their memory, for a later picture.
    Share,
    /// Pictures of these names.
    Named {
        /// Computed where they are read.
        inline: BTreeSet<String>,
        /// Computed by the workgroup that reads them.
        shared: BTreeSet<String>,
    },
}

/// Prefix of a picture that workgroups share.
const SHARED: &str = "share:";

impl Fuse {
    /// These pictures, computed where they are read.
    pub fn inline<N: Into<String>>(names: impl IntoIterator<Item = N>) -> Fuse {
        Fuse::Named {
            inline: names.into_iter().map(Into::into).collect(),
            shared: BTreeSet::new(),
        }
    }

    /// Returns whether workgroups are to compute a picture in their memory.
    pub fn shares(&self, picture: &str) -> bool {
        match self {
            Fuse::Share => true,
            Fuse::Named { shared, .. } => shared.contains(picture),
            Fuse::None | Fuse::Auto | Fuse::All => false,
        }
    }
}

impl FromStr for Fuse {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (mut inline, mut shared) = (BTreeSet::new(), BTreeSet::new());
        match text {
            "none" => return Ok(Fuse::None),
            "auto" => return Ok(Fuse::Auto),
            "all" => return Ok(Fuse::All),
            "share" => return Ok(Fuse::Share),
            _ => {}
        }
        for name in text.split(',').map(str::trim) {
            let (names, name) = match name.strip_prefix(SHARED) {
                Some(name) => (&mut shared, name),
                None => (&mut inline, name),
            };
            if name.is_empty() {
                return Err(format!(
                    "expected none, auto, all, share, or names of pictures: `--fuse edges,{SHARED}weights`"
                ));
            }
            names.insert(name.to_owned());
        }
        match inline.intersection(&shared).next() {
            Some(both) => Err(format!("`{both}` is given twice: by itself, and as `{SHARED}{both}`")),
            None => Ok(Fuse::Named { inline, shared }),
        }
    }
}

impl fmt::Display for Fuse {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fuse::None => f.write_str("none"),
            Fuse::Auto => f.write_str("auto"),
            Fuse::All => f.write_str("all"),
            Fuse::Share => f.write_str("share"),
            Fuse::Named { inline, shared } => {
                let shared = shared.iter().map(|name| format!("{SHARED}{name}"));
                f.write_str(&inline.iter().cloned().chain(shared).collect::<Vec<_>>().join(","))
            }
        }
    }
}
