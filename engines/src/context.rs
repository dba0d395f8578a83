//! Context of templates: a kernel's name, the resources that it binds, and its shaders.

use crate::description::Description;
use crate::fits;
use crate::inputs::{Inputs, whole_name};
use crate::meaning::{MEANINGS, Meaning};
pub use crate::shader_context::{ArgumentContext, CombinedContext, GlobalContext, ReadContext, ShaderContext};
use crate::spelling;
use serde::Serialize;
use std::collections::BTreeMap;
use straightline_codegen::emit::single_line_comment;
use straightline_codegen::{OptionInfo, OptionKind};
use straightline_manifest::{BindingKind, Extent, LanguageBinding, LanguageKind, Manifest, SamplerType};

/// Documentation of the uniform with the target's size.
const SIZE_DOCS: &str = "Width and height of the target, in pixels.";

/// Context of a template.
#[derive(Clone, Debug, Serialize)]
pub struct Context {
    /// Name of the files, without extension.
    pub name: String,
    /// The kernel's name.
    pub kernel: String,
    /// The name in the form of a type name: `JointBilateral`.
    pub class: String,
    /// The name in words: `Joint bilateral`.
    pub title: String,
    /// First sentence of the kernel's documentation, harmless in a comment of any language; or nothing.
    pub summary: String,
    /// Name and version of the generator.
    pub generator: String,
    /// The engine's name, as it was asked for.
    pub engine: String,
    /// Textures, in order of binding.
    pub textures: Vec<TextureContext>,
    /// The texture that is filtered, if the kernel reads it: the one with the meaning `color`.
    pub picture: Option<TextureContext>,
    /// Textures in the engine's textures: without those that it converts.
    pub given: Vec<TextureContext>,
    /// Textures that the user sets, in order of binding.
    pub own: Vec<TextureContext>,
    /// Samplers, in order of binding.
    pub samplers: Vec<SamplerContext>,
    /// Uniforms, in order of offset.
    pub uniforms: Vec<UniformContext>,
    /// The uniform with the target's width and height, if the templates fill it.
    pub resolution: Option<UniformContext>,
    /// Inputs beside the picture that the engine provides by their meanings.
    pub provided: Vec<ProvidedContext>,
    /// Every meaning by name: true if the kernel reads it.
    pub meanings: BTreeMap<&'static str, bool>,
    /// The buffer that uniforms lie in where the language has one.
    pub block: Option<BlockContext>,
    /// Values computed for a pixel.
    pub outputs: Vec<OutputContext>,
    /// Shaders, by the names of `engine.toml`.
    pub shaders: BTreeMap<String, ShaderContext>,
    /// The shader, where there is one.
    pub shader: Option<ShaderContext>,
    /// Options that differ from their defaults, as the command line has them: `radius=4`.
    pub changed: Vec<String>,
}

/// An input that the engine provides.
#[derive(Clone, Debug, Serialize)]
pub struct ProvidedContext {
    /// Name in the kernel.
    pub name: String,
    /// Name of the meaning.
    pub meaning: &'static str,
    /// Value, with its unit and its space.
    pub docs: &'static str,
    /// Source in the engine.
    pub stored: String,
}

/// A texture.
#[derive(Clone, Debug, Serialize)]
pub struct TextureContext {
    /// Name in the kernel.
    pub name: String,
    /// Name in the shaders: that of the kernel, unless it is reserved in a language or the engine.
    pub spelled: String,
    /// Group and number of WGSL.
    pub binding: u32,
    /// `2d`, `2d-array`, `3d`, `cube` or `multisampled`.
    pub shape: &'static str,
    /// `view_dimension`, as WebGPU has it.
    pub view_dimension: &'static str,
    /// True if a texel has several samples.
    pub multisampled: bool,
    /// `sample_type`, as WebGPU has it.
    pub sample_type: &'static str,
    /// `float`, `depth`, `sint` or `uint`.
    pub holds: &'static str,
    /// Type in HLSL.
    pub hlsl: String,
    /// True if the texture has the output's size.
    pub framed: bool,
    /// Name of the meaning, if the engine provides it.
    pub meaning: Option<&'static str>,
    /// True if the user sets it.
    pub own: bool,
}

/// A sampler.
#[derive(Clone, Debug, Serialize)]
pub struct SamplerContext {
    /// Name in the kernel.
    pub name: String,
    /// Number in WGSL.
    pub binding: u32,
    /// `filtering`, `non-filtering` or `comparison`.
    #[serde(rename = "type")]
    pub ty: &'static str,
}

/// A uniform.
#[derive(Clone, Debug, Serialize)]
pub struct UniformContext {
    /// Name in the kernel.
    pub name: String,
    /// Name of the matrix or array that it is a part of, or its own.
    pub of: String,
    /// Purpose in the kernel's words, harmless in a comment of any language; or nothing.
    pub docs: String,
    /// Name in the shaders: that of the kernel, unless it is reserved in a language or the engine.
    pub spelled: String,
    /// Type in WGSL.
    pub wgsl: String,
    /// Type in GLSL.
    pub glsl: String,
    /// Type in HLSL.
    pub hlsl: String,
    /// `f`, `i` or `u`.
    pub kind: char,
    /// Components, 1 to 4.
    pub components: u32,
    /// Byte offset in the buffer.
    pub offset: u32,
    /// The value until another is set, in every component, as a literal; 0 where the kernel states none.
    pub default: String,
    /// True if the kernel states the default.
    pub has_default: bool,
    /// Least value, as a literal, where the kernel states it.
    pub min: Option<String>,
    /// Greatest value, as a literal, where the kernel states it.
    pub max: Option<String>,
    /// True if it is the target's width and height.
    pub is_size: bool,
}

/// The buffer of uniforms.
#[derive(Clone, Debug, Serialize)]
pub struct BlockContext {
    /// Name of the buffer: `parameters`, unless the kernel has a use for that.
    pub name: String,
    /// Number in WGSL.
    pub binding: u32,
    /// Bytes.
    pub size: u32,
}

/// An output.
#[derive(Clone, Debug, Serialize)]
pub struct OutputContext {
    /// Name in the shader.
    pub name: String,
    /// Type in WGSL.
    pub wgsl: String,
    /// Type in GLSL.
    pub glsl: String,
    /// Format that it was generated for, as WebGPU has it.
    pub format: &'static str,
}

/// Textures of a manifest.
pub fn texture_contexts(manifest: &Manifest, inputs: &Inputs) -> Vec<TextureContext> {
    let each = manifest.bindings.iter().filter_map(|binding| match &binding.kind {
        BindingKind::Texture {
            dimension,
            sample_type,
            extent,
            ..
        } => Some(TextureContext {
            name: binding.name.clone(),
            spelled: spelled_texture(manifest, &binding.name),
            binding: binding.binding,
            shape: fits::shape_name(*dimension),
            view_dimension: match fits::shape_name(*dimension) {
                "multisampled" => "2d",
                shape => shape,
            },
            multisampled: dimension.is_multisampled(),
            sample_type: match sample_type {
                straightline_manifest::SampleType::Unfilterable => "unfilterable-float",
                other => fits::texel_type_name(*other),
            },
            holds: fits::texel_type_name(*sample_type),
            hlsl: spelling::hlsl_texture(*dimension, *sample_type),
            framed: *extent == Extent::Output,
            meaning: inputs.meaning(&binding.name).map(|meaning| meaning.name),
            own: inputs.meaning(&binding.name).is_none(),
        }),
        _ => None,
    });
    each.collect()
}

/// Returns a texture's name in the shader, or beside it if the host's functions read it.
fn spelled_texture(manifest: &Manifest, name: &str) -> String {
    let stands_for = |b: &&LanguageBinding| match b.kind {
        LanguageKind::Texture | LanguageKind::Function => b.of.as_deref() == Some(name),
        LanguageKind::CombinedSampler => b.texture.as_deref() == Some(name),
        _ => false,
    };
    let found = manifest.language_bindings.iter().find(stands_for);
    let spelled = found.map(|b| match (b.kind, &b.texture) {
        (LanguageKind::Function, Some(texture)) => texture,
        _ => &b.name,
    });
    spelled.map_or(name, String::as_str).to_owned()
}

/// The texture that is filtered.
pub fn filtered_texture(textures: &[TextureContext]) -> Option<TextureContext> {
    let mut all = textures.iter();
    all.find(|texture| texture.meaning.and_then(Meaning::find).is_some_and(Meaning::is_picture))
        .cloned()
}

/// Inputs that an engine provides beside the picture.
pub fn provided_contexts(inputs: &Inputs, description: &Description) -> Vec<ProvidedContext> {
    let beside = inputs.iter().filter(|(_, meaning)| !meaning.is_picture());
    let each = beside.filter_map(|(name, meaning)| {
        Some(ProvidedContext {
            name: name.to_owned(),
            meaning: meaning.name,
            docs: meaning.doc,
            stored: description.meanings.get(meaning.name)?.stored.clone(),
        })
    });
    each.collect()
}

/// Every meaning, and whether the kernel reads it.
pub fn used_meanings(inputs: &Inputs) -> BTreeMap<&'static str, bool> {
    let is_used = |meaning: &Meaning| inputs.iter().any(|(_, used)| used == meaning);
    MEANINGS
        .iter()
        .map(|meaning| (meaning.name, is_used(meaning)))
        .collect()
}

/// Samplers of a manifest.
pub fn sampler_contexts(manifest: &Manifest) -> Vec<SamplerContext> {
    let each = manifest.bindings.iter().filter_map(|binding| match &binding.kind {
        BindingKind::Sampler { sampler } => Some(SamplerContext {
            name: binding.name.clone(),
            binding: binding.binding,
            ty: match sampler {
                SamplerType::Filtering => "filtering",
                SamplerType::NonFiltering => "non-filtering",
                SamplerType::Comparison => "comparison",
            },
        }),
        _ => None,
    });
    each.collect()
}

/// Returns the uniform with the target's size.
pub fn size_context(manifest: &Manifest) -> Option<UniformContext> {
    let (uniforms, _) = uniform_contexts(manifest, &[]);
    uniforms.into_iter().find(|uniform| uniform.is_size)
}

/// Returns the uniforms of a manifest, with the information of the kernel's options.
pub fn uniform_contexts(manifest: &Manifest, options: &[OptionInfo]) -> (Vec<UniformContext>, Option<BlockContext>) {
    let block = manifest.bindings.iter().find_map(|binding| match &binding.kind {
        BindingKind::Uniform { size, fields, .. } => Some((binding, *size, fields)),
        _ => None,
    });
    let Some((binding, size, fields)) = block else {
        return (Vec::new(), None);
    };
    let each = fields.iter().map(|field| {
        let scalar = field.ty.scalar();
        let option = options
            .iter()
            .find(|option| option.name.replace('-', "_") == field.name);
        let range = match option.map(|option| &option.kind) {
            Some(OptionKind::Number(of)) => [of.min, of.max],
            _ => [None, None],
        };
        let [min, max] = range.map(|bound| bound.map(|bound| spelling::format_number(bound, scalar)));
        let is_uniform = |kind: LanguageKind| matches!(kind, LanguageKind::Uniform | LanguageKind::Member);
        let mut bindings = manifest.language_bindings.iter();
        let spelled = bindings.find(|b| is_uniform(b.kind) && b.of.as_ref() == Some(&field.name));
        UniformContext {
            name: field.name.clone(),
            of: whole_name(field).to_owned(),
            spelled: spelled.map_or(&field.name, |b| &b.name).clone(),
            docs: match field.frame_size {
                true => SIZE_DOCS.to_owned(),
                false => option
                    .map(|option| single_line_comment(&option.docs))
                    .unwrap_or_default(),
            },
            wgsl: field.ty.to_string(),
            glsl: spelling::glsl_type(field.ty),
            hlsl: spelling::hlsl_type(field.ty),
            kind: scalar.letter(),
            components: field.ty.components().into(),
            offset: field.offset,
            default: spelling::format_number(field.default.unwrap_or_default(), scalar),
            has_default: field.default.is_some(),
            min,
            max,
            is_size: field.frame_size,
        }
    });
    let block = BlockContext {
        name: binding.name.clone(),
        binding: binding.binding,
        size,
    };
    (each.collect(), Some(block))
}

/// Outputs of a manifest.
pub fn output_contexts(manifest: &Manifest) -> Vec<OutputContext> {
    let each = manifest.outputs.iter().map(|output| OutputContext {
        name: output.name.clone(),
        wgsl: output.ty.to_string(),
        glsl: spelling::glsl_type(output.ty),
        format: output.format.wgsl_name(),
    });
    each.collect()
}
