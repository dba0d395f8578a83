//! Description of an engine, read from `engine.toml`.

pub use crate::chain::{ChainDescription, SizeForm};
use crate::meaning::Meaning;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Overrides, ShaderSpec, Stage};
use straightline_manifest::{BindingKind, Manifest};

/// An engine: `engine.toml`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Description {
    /// Name of the engine in sentences: `three.js`.
    pub title: String,
    /// Files that are written, in a few words.
    pub about: String,
    /// Extent of testing: `pixels` where the tests compare pixels, `compiled` where a compiler of its language reads the text,
    /// and `untested`.
    #[serde(default)]
    pub tried: Tried,
    /// The shaders that templates put in, by the name that they have there.
    pub shaders: BTreeMap<String, ShaderDescription>,
    /// Names that the templates, the engine and its language have uses for, which nothing in a shader is called: words, and
    /// `p3d_*` or `*Sampler` for all that begin or end so. Those of the shaders' languages need not be listed.
    #[serde(default)]
    pub words: BTreeSet<String>,
    /// Limits of the engine's bindings.
    #[serde(default)]
    pub limits: Limits,
    /// Data that the engine itself has, by [`Meaning`]. Without any, a user binds every input by its own name.
    #[serde(default)]
    pub meanings: BTreeMap<String, MeaningSource>,
    /// Reasons for meanings that the engine does not have, where they are not obvious.
    #[serde(default)]
    pub lacks: BTreeMap<String, String>,
    /// Template and the file that it makes, whose name is a template too.
    pub files: BTreeMap<String, String>,
    /// Description of chains of several passes, of an engine that takes them.
    #[serde(default)]
    pub chain: Option<ChainDescription>,
}

/// Source of a meaning in an engine.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeaningSource {
    /// Name and encoding of the data in the engine, in a few words.
    pub stored: String,
    /// Expression of the value as [`Meaning`] defines it, by the shader that contains it. The texel is at `pixel`, and
    /// `{column}` is the index of a matrix's column. Pictures need none: the templates read them.
    #[serde(default)]
    pub expressions: BTreeMap<String, String>,
}

/// Extent to which an engine has been tested.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tried {
    /// Not in the engine, and by no compiler.
    #[default]
    Untested,
    /// Read by a compiler of the engine's language, not in the engine.
    Compiled,
    /// Run in the engine, and compared with the interpreter.
    Pixels,
}

/// A shader that an engine wants.
#[derive(Clone, Debug, Deserialize)]
pub struct ShaderDescription {
    /// `wgsl`, `glsl450`, `glsl430`, `glsl330`, `essl310`, `essl300` or `hlsl`.
    pub language: String,
    /// Binding numbers that the engine assigns.
    #[serde(default)]
    pub numbers: Option<Numbers>,
    /// Way in which textures that the engine converts reach the shader.
    #[serde(default)]
    pub converted: Converted,
    /// Options of the emitted text, by the names of the command line: `stage` (a fragment shader by default), `form`, `origin`,
    /// `texels` where a template defines functions that read them, `global-uniforms`, ...
    #[serde(flatten)]
    pub knobs: Overrides,
}

/// Way in which a texture that an engine converts, such as depth, reaches a shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Converted {
    /// By a function of the template around the expression, which the shader calls for a texel. It then reads all textures
    /// by functions.
    #[default]
    Functions,
    /// As a texture of converted texels, which the expression in the host's code is.
    Arguments,
}

/// First binding number of each kind; each further resource has the next number.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Numbers {
    /// The first texture.
    pub textures: u32,
    /// The first sampler.
    pub samplers: u32,
    /// The uniform buffer.
    pub parameters: u32,
}

impl Numbers {
    /// The number of each binding by name.
    pub fn number_bindings(self, manifest: &Manifest) -> Vec<(String, u32)> {
        let (mut textures, mut samplers) = (self.textures.., self.samplers..);
        let each = manifest.bindings.iter().filter_map(|binding| {
            let number = match &binding.kind {
                BindingKind::Texture { .. } => textures.next(),
                BindingKind::Sampler { .. } => samplers.next(),
                BindingKind::Uniform { .. } => Some(self.parameters),
                BindingKind::Buffer { .. } => None,
            };
            Some((binding.name.clone(), number?))
        });
        each.collect()
    }
}

/// Knobs that an engine determines, by name: a user's values for them would be ignored.
pub const FIXED: [&str; 16] = [
    "stage",
    "target",
    "region",
    "workgroup",
    "form",
    "origin",
    "entry",
    "group",
    "binding",
    "register",
    "enable-subgroups",
    "texels",
    "global-uniforms",
    "reserve",
    "clear-of",
    "debug",
];

impl Description {
    /// Reads an `engine.toml`.
    ///
    /// # Errors
    ///
    /// It is not TOML of this shape, a language of it is unknown, or it names no shader or no file.
    pub(crate) fn from_toml(text: &str) -> Result<Description, String> {
        let description: Description = toml::from_str(text).map_err(|error| error.to_string())?;
        for (name, shader) in &description.shaders {
            let refused = |why| format!("shader `{name}`: {why}");
            shader.target().map_err(refused)?;
            let decided = |knob: &&str| FIXED.contains(knob) && *knob != "target";
            if let Some(other) = shader.knobs.names().find(|knob| !decided(knob)) {
                return Err(refused(format!("`{other}` is for a user to say, not for an engine")));
            }
        }
        let words = description.meanings.keys().chain(description.lacks.keys());
        if let Some(word) = words.into_iter().find(|word| Meaning::find(word).is_none()) {
            return Err(format!("`{word}` is no meaning: docs/engines.md lists them"));
        }
        if description.shaders.is_empty() || description.files.is_empty() {
            return Err("it names no shader, or no file".to_owned());
        }
        if let Some(chain) = &description.chain {
            chain.check(&description).map_err(|why| format!("[chain]: {why}"))?;
        }
        Ok(description)
    }
}

impl Description {
    /// Names of the templates, those of chains too.
    pub(crate) fn templates(&self) -> BTreeSet<&String> {
        let of_chains = self.chain.iter().flat_map(ChainDescription::templates);
        self.files.keys().chain(of_chains).collect()
    }

    /// Returns whether a user can set an input that the engine does not provide.
    pub(crate) fn binds_own(&self, is_texture: bool) -> bool {
        !is_texture || self.limits.own_textures.unwrap_or(true)
    }
}

impl ShaderDescription {
    /// The language.
    ///
    /// # Errors
    ///
    /// It is none that is text, with those that are.
    pub fn target(&self) -> Result<Target, String> {
        let target = self.language.parse::<Target>()?;
        match target {
            Target::Spirv | Target::Msl => Err(format!(
                "`{target}` is no language of engines: use wgsl, hlsl or a GLSL"
            )),
            _ => Ok(target),
        }
    }

    /// The stage.
    pub fn stage(&self) -> Stage {
        self.apply_knobs(&EmitOptions::new()).stage
    }

    /// Returns the emit options for a user who wants `emit`: the engine's choices override those.
    ///
    /// # Errors
    ///
    /// As [`ShaderDescription::target`].
    pub fn emit_options(&self, emit: &EmitOptions) -> Result<EmitOptions, String> {
        Ok(self.apply_knobs(emit).targets([self.target()?]))
    }

    fn apply_knobs(&self, emit: &EmitOptions) -> EmitOptions {
        let mut spec = ShaderSpec::new();
        spec.emit = emit.clone().stage(Stage::Fragment);
        self.knobs.apply(spec).emit
    }
}

/// Source of the target's size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SizeSource {
    /// The templates fill it: it is `resolution` of the context, and not among the uniforms.
    Filled,
    /// The user sets it, as any other uniform.
    Set,
}

/// Limits of an engine's bindings. An omitted field sets no limit unless its own documentation states one; buffers,
/// interpolated values and optional device features must be named.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Resources that the engine provides to a shader, for messages: `one picture`.
    #[serde(default)]
    pub gives: Option<String>,
    /// Maximum number of textures, without those that the engine converts.
    #[serde(default)]
    pub textures: Option<u32>,
    /// `false` if a user cannot bind textures beside those that the engine has.
    #[serde(default)]
    pub own_textures: Option<bool>,
    /// Shapes of textures: `2d`, `2d-array`, `3d`, `cube`, `multisampled`.
    #[serde(default)]
    pub dimensions: Option<Vec<String>>,
    /// Types of texels: `float`, `depth`, `sint`, `uint`.
    #[serde(default)]
    pub holds: Option<Vec<String>>,
    /// Samplers: `filtering`, `non-filtering`, `comparison`.
    #[serde(default)]
    pub samplers: Option<Vec<String>>,
    /// Maximum number of uniforms.
    #[serde(default)]
    pub uniforms: Option<u32>,
    /// Types of uniforms, as WGSL spells them; numbers and vectors by default.
    #[serde(default)]
    pub uniform_types: Option<Vec<String>>,
    /// Maximum number of outputs; 1 by default.
    #[serde(default)]
    pub outputs: Option<u32>,
    /// True if storage buffers can be bound.
    #[serde(default)]
    pub buffers: bool,
    /// Source of the target's size, for kernels that need it and bind no texture of that size. Without one they are refused.
    #[serde(default)]
    pub resolution: Option<SizeSource>,
    /// `true` if the host's vertex shader outputs interpolated values.
    #[serde(default)]
    pub varyings: bool,
    /// Optional device features that the engine enables: `subgroup`, `shader-f16`.
    #[serde(default)]
    pub features: Vec<String>,
}
