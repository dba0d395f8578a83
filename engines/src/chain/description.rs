//! The table `[chain]` of `engine.toml`.

use crate::description::{Description, Limits};
use crate::engine::Engine;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use straightline_manifest::Format;

/// Description of chains for an engine that takes several passes: `[chain]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChainDescription {
    /// Template and the file that it makes of the whole chain.
    pub files: BTreeMap<String, String>,
    /// Template and the file that it makes of each pass.
    #[serde(default)]
    pub pass_files: BTreeMap<String, String>,
    /// Shaders of the engine that passes are written in; by default all.
    #[serde(default)]
    pub shaders: Option<Vec<String>>,
    /// Meanings of the engine that these templates provide.
    #[serde(default)]
    pub meanings: Vec<String>,
    /// Maximum number of passes.
    #[serde(default)]
    pub passes: Option<usize>,
    /// Names that no texture of the user's has beside the shaders, as `words` of the engine.
    #[serde(default)]
    pub words: BTreeSet<String>,
    /// Limits in place of those of single kernels.
    #[serde(default)]
    pub limits: Option<Limits>,
    /// Formats of pictures between passes in the engine's words, by their names in WebGPU; by default those names.
    #[serde(default)]
    pub formats: Option<BTreeMap<String, String>>,
    /// `true` if the engine's target has the size of the picture with the meaning `color`.
    #[serde(default)]
    pub draws_picture: bool,
    /// Form of the sizes of pictures.
    #[serde(default)]
    pub sizes: SizeForm,
}

/// Form in which an engine takes the size of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SizeForm {
    /// An expression of JavaScript, which takes any rule.
    #[default]
    Javascript,
    /// A multiple of the size that the pass before draws, or a number of texels.
    Scale,
}

impl ChainDescription {
    /// Looks for names that the engine does not have.
    pub(crate) fn check(&self, engine: &Description) -> Result<(), String> {
        if self.files.is_empty() {
            return Err("it names no file".to_owned());
        }
        let shaders = self.shaders.iter().flatten();
        if let Some(name) = shaders.into_iter().find(|name| !engine.shaders.contains_key(*name)) {
            return Err(format!("there is no shader `{name}`"));
        }
        if let Some(word) = self.meanings.iter().find(|word| !engine.meanings.contains_key(*word)) {
            return Err(format!("the engine has no meaning `{word}`"));
        }
        let mut formats = self.formats.iter().flatten().map(|(name, _)| name);
        match formats.find(|name| Format::ALL.iter().all(|format| format.wgsl_name() != **name)) {
            Some(name) => Err(format!("`{name}` is no format")),
            None => Ok(()),
        }
    }

    pub(crate) fn templates(&self) -> impl Iterator<Item = &String> {
        self.files.keys().chain(self.pass_files.keys())
    }

    /// Returns the name of a format in the engine's words.
    pub(crate) fn format(&self, format: Format) -> Option<&str> {
        match &self.formats {
            Some(known) => known.get(format.wgsl_name()).map(String::as_str),
            None => Some(format.wgsl_name()),
        }
    }
}

impl Engine {
    /// The engine as it takes the passes of a chain; `None` if it takes single kernels alone.
    pub(crate) fn of_passes(&self) -> Option<Engine> {
        let mut engine = self.clone();
        let description = &mut engine.description;
        let chain = description.chain.clone()?;
        if let Some(limits) = chain.limits {
            description.limits = limits;
        }
        if let Some(shaders) = chain.shaders {
            description.shaders.retain(|name, _| shaders.contains(name));
        }
        for (name, source) in &description.meanings {
            if !chain.meanings.contains(name) {
                let reason = format!("only single kernels get {}", source.stored);
                description.lacks.insert(name.clone(), reason);
            }
        }
        description.meanings.retain(|name, _| chain.meanings.contains(name));
        Some(engine)
    }
}
