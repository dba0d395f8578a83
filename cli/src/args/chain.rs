//! Arguments of chains of passes.

use crate::failure::Failure;
use clap::Args;
use straightline_codegen::chain::{ChainSpec, Fuse};
use straightline_codegen::{Format, ShaderSpec};

/// Settings that only a chain has.
#[derive(Debug, Clone, Args)]
pub struct ChainArgs {
    /// Pictures of a chain to compute where they are read, in place of storing them: none, auto, all, or names; or by the
    /// workgroups that read them: share, or names after `share:`
    #[arg(long, value_name = "PICTURES", value_parser = |text: &str| text.parse::<Fuse>())]
    pub fuse: Option<Fuse>,
    /// Texel format of the pictures between the passes of a chain: rgba8unorm, rgba16float or rgba32float
    #[arg(long, value_name = "FORMAT", value_parser = |text: &str| text.parse::<Format>())]
    pub pictures: Option<Format>,
    /// Most pictures of a chain that a pass may write, with `--fuse share`; 4, which every device of WebGPU has, if none is given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub most_outputs: Option<u32>,
}

impl ChainArgs {
    /// Returns the description of a chain's shaders.
    pub fn chain_spec(&self, shader: ShaderSpec) -> ChainSpec {
        let mut spec = ChainSpec::from(shader).fuse(self.fuse.clone().unwrap_or_default());
        spec.pictures = self.pictures;
        spec.most_outputs = self.most_outputs.unwrap_or(spec.most_outputs);
        spec
    }

    /// Refuses these settings for a kernel.
    pub fn refuse(&self, kernel: &str) -> Result<(), Failure> {
        let given = [
            ("--fuse", self.fuse.is_some()),
            ("--pictures", self.pictures.is_some()),
            ("--most-outputs", self.most_outputs.is_some()),
        ];
        match given.iter().find(|(_, given)| *given) {
            Some((name, _)) => Err(Failure::Usage(format!(
                "`{kernel}` is one pass: {name} is for chains, which return what `draw` draws"
            ))),
            None => Ok(()),
        }
    }
}
