//! Context of a chain's templates.

use super::scale::ScaleContext;
use crate::context::{Context, ProvidedContext, SamplerContext, TextureContext, UniformContext};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use straightline_codegen::emit::is_among;

/// Context of a template of a chain. A template of a pass has `pass` and `shader` too, of [`ChainContext::passes`] and
/// [`ChainContext::shaders`].
#[derive(Clone, Debug, Serialize)]
pub struct ChainContext {
    /// Name of the files, without extension.
    pub name: String,
    /// Name of the chain's function.
    pub chain: String,
    /// Name of a function of the host's that stands for the chain: that of the shader of the result.
    pub function: String,
    /// The name in the form of a type name: `JointBilateral`.
    pub class: String,
    /// The name in words: `Joint bilateral`.
    pub title: String,
    /// First sentence of the chain's documentation, harmless in a comment of any language; or nothing.
    pub summary: String,
    /// Name and version of the generator.
    pub generator: String,
    /// The engine's name, as it was asked for.
    pub engine: String,
    /// Options that differ from their defaults, as the command line has them: `levels=4`.
    pub changed: Vec<String>,
    /// Textures that the chain takes, in the order of its parameters.
    pub textures: Vec<ChainTextureContext>,
    /// The texture with the meaning `color`, if the chain takes it.
    pub picture: Option<ChainTextureContext>,
    /// Textures that the user sets.
    pub own: Vec<ChainTextureContext>,
    /// Samplers that the chain takes.
    pub samplers: Vec<SamplerContext>,
    /// Uniforms of all passes, each once. Offsets are those of the shaders.
    pub uniforms: Vec<UniformContext>,
    /// Everything that the chain takes, in WebGPU's words, as manifests list it.
    pub bindings: serde_json::Value,
    /// Optional device features that a pass needs.
    pub features: Vec<String>,
    /// Inputs beside the picture that the engine provides by their meanings.
    pub provided: Vec<ProvidedContext>,
    /// Every meaning by name: true if a pass reads it.
    pub meanings: BTreeMap<&'static str, bool>,
    /// Numbers that the picture's width and height are multiples of if all scales are to be exact.
    pub multiple: Option<[u32; 2]>,
    /// Shaders, each as the kernel that it is, in files of its own name. Several passes can have one.
    pub shaders: Vec<Context>,
    /// Passes in the order in which they run.
    pub passes: Vec<PassContext>,
    /// Textures between the passes, by number.
    pub memory: Vec<MemoryContext>,
    /// Pictures that the chain returns.
    pub results: Vec<MemoryContext>,
}

/// A texture that a chain takes.
#[derive(Clone, Debug, Serialize)]
pub struct ChainTextureContext {
    /// The texture, as of a kernel.
    #[serde(flatten)]
    pub texture: TextureContext,
    /// True if the size of a picture depends on its size.
    pub sized: bool,
}

/// A pass.
#[derive(Clone, Debug, Serialize)]
pub struct PassContext {
    /// Index in the order of passes.
    pub index: usize,
    /// Name of the picture that it draws.
    pub name: String,
    /// Index and name of the pass, in letters that every file system takes: `3-down_3`.
    pub file: String,
    /// Index of its shader.
    pub shader: usize,
    /// Textures, samplers and buffers of the shader by their names in the kernel, with what each reads.
    pub reads: BTreeMap<String, SourceContext>,
    /// The textures among them, each once, in the order of the shader.
    pub textures: Vec<SourceContext>,
    /// Its uniforms, of [`ChainContext::uniforms`].
    pub uniforms: Vec<UniformContext>,
    /// Number of the texture that it draws to, unless the picture is a result.
    pub memory: Option<u32>,
    /// Index of the result that it draws.
    pub result: Option<usize>,
    /// Format of what it draws, in the engine's words.
    pub format: String,
    /// Width in JavaScript, where `of("NAME")` has the width and height of an input.
    pub width: String,
    /// Height, likewise.
    pub height: String,
    /// Scales of width and height, where the engine takes sizes so.
    pub scale: Option<[ScaleContext; 2]>,
    /// A texture of the shader with the size of what it draws, by its name in the kernel.
    pub framed: Option<String>,
    /// A texture of the shader that a sampler filters, by its name in the kernel.
    pub sampled: Option<String>,
}

/// Origin of an input of a pass.
#[derive(Clone, Debug, Serialize)]
pub struct SourceContext {
    /// Name of the input or picture in the chain.
    pub name: String,
    /// Name beside the shaders, of an input.
    pub spelled: String,
    /// True of an input of the chain.
    pub input: bool,
    /// True of the texture with the meaning `color`.
    pub picture: bool,
    /// Number of the texture between the passes that holds the picture.
    pub memory: Option<u32>,
    /// Index of the result that the picture is.
    pub result: Option<usize>,
    /// Index of the pass that drew the picture.
    pub pass: Option<usize>,
}

/// A texture between passes, or for a result.
#[derive(Clone, Debug, Serialize)]
pub struct MemoryContext {
    /// Names of the pictures that it holds in turn.
    pub pictures: Vec<String>,
    /// Format in the engine's words.
    pub format: String,
    /// Width in JavaScript, as of [`PassContext::width`].
    pub width: String,
    /// Height, likewise.
    pub height: String,
    /// The size as a rule: `color.size() / 2`.
    pub size: String,
    /// True if a pass reads it.
    pub read: bool,
    /// True if a pass reads it by a sampler that filters.
    pub filtered: bool,
}

impl ChainContext {
    /// Chooses the names of textures and uniforms beside the shaders: those that a shader has for them, each once.
    pub(super) fn name_inputs(&mut self, words: [&BTreeSet<String>; 2]) {
        let [of_engine, of_textures] = words;
        let functions = self.shaders.iter().flat_map(|shader| shader.shaders.values());
        let mut taken: BTreeSet<String> = functions.map(|text| text.function.clone()).collect();
        let nothing = BTreeSet::new();
        let mut spelled: BTreeMap<String, String> = BTreeMap::new();
        for texture in &mut self.textures {
            let name = &texture.texture.name;
            let own_name = |pass: &PassContext| {
                let mut reads = pass.reads.iter();
                let (own, _) = reads.find(|(_, source)| source.input && source.name == *name)?;
                let textures = &self.shaders.get(pass.shader)?.textures;
                Some(textures.iter().find(|known| known.name == *own)?.spelled.clone())
            };
            let wanted = self.passes.iter().find_map(own_name).unwrap_or_else(|| name.clone());
            texture.texture.spelled = free_name(&wanted, &mut taken, [of_engine, of_textures]);
            spelled.insert(name.clone(), texture.texture.spelled.clone());
        }
        for uniform in &mut self.uniforms {
            let mut all = self.shaders.iter().flat_map(|shader| &shader.uniforms);
            let wanted = all.find(|known| known.name == uniform.name);
            let wanted = wanted.map_or(&uniform.name, |known| &known.spelled).clone();
            uniform.spelled = free_name(&wanted, &mut taken, [of_engine, &nothing]);
        }
        for copy in self.picture.iter_mut().chain(&mut self.own) {
            if let Some(name) = spelled.get(&copy.texture.name) {
                copy.texture.spelled.clone_from(name);
            }
        }
        for pass in &mut self.passes {
            for source in pass.reads.values_mut().chain(&mut pass.textures) {
                if let (true, Some(name)) = (source.input, spelled.get(&source.name)) {
                    source.spelled.clone_from(name);
                }
            }
            let own = self.shaders.get(pass.shader).map(|shader| &shader.uniforms);
            let is_own = |uniform: &&UniformContext| own.is_some_and(|own| own.iter().any(|o| o.name == uniform.name));
            pass.uniforms = self.uniforms.iter().filter(is_own).cloned().collect();
        }
    }
}

/// Returns the wanted name, or one like it that is neither taken nor among the words, and takes it.
fn free_name(wanted: &str, taken: &mut BTreeSet<String>, words: [&BTreeSet<String>; 2]) -> String {
    // Words may stand for all that begin so.
    let marked = format!("v_{wanted}");
    let numbered = (2..1_000_000).map(|number: u32| format!("{marked}_{number}"));
    let mut names = [wanted.to_owned(), marked.clone()].into_iter().chain(numbered);
    let is_free = |name: &String| !taken.contains(name) && words.iter().all(|words| !is_among(words, name));
    let name = names.find(is_free).unwrap_or_else(|| marked.clone());
    taken.insert(name.clone());
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_free() {
        let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect::<BTreeSet<_>>();
        let (engine, textures) = (words(&["Pass*"]), words(&["*_linear"]));
        let mut taken = words(&["area"]);
        let mut free = |name: &str| free_name(name, &mut taken, [&engine, &textures]);
        let found = ["search", "area", "area", "Passed", "a_linear"].map(&mut free);
        assert_eq!(found, ["search", "v_area", "v_area_2", "v_Passed", "v_a_linear_2"]);
    }
}
