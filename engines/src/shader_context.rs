//! Context of one shader for templates: its text, and the arguments, functions and uniforms that a template gives it.

use crate::description::MeaningSource;
use crate::fits;
use crate::inputs::{Inputs, whole_name};
use crate::meaning::{Holds, Meaning};
use crate::spelling;
use serde::Serialize;
use std::collections::BTreeMap;
use straightline_codegen::emit::Target;
use straightline_manifest::{BindingKind, LanguageBinding, LanguageKind, Manifest, SamplerType, UniformField};

/// A shader.
#[derive(Clone, Debug, Serialize)]
pub struct ShaderContext {
    /// The text.
    pub text: String,
    /// Name of the entry point or function.
    pub function: String,
    /// Combined samplers of the languages of OpenGL. Where the shader reads by functions, those that the functions need for
    /// textures that the engine does not convert.
    pub combined: Vec<CombinedContext>,
    /// Arguments of a function, in order.
    pub arguments: Vec<ArgumentContext>,
    /// Functions that a template defines before the text, where the shader reads by them.
    pub reads: Vec<ReadContext>,
    /// Uniforms that the engine provides, where the shader reads uniforms by name.
    pub globals: Vec<GlobalContext>,
    /// Invocations of a workgroup, of a compute shader.
    pub workgroup: Option<[u32; 3]>,
    /// The manifest of this text, as `emit --target` writes it.
    pub manifest: serde_json::Value,
}

/// A combined sampler.
#[derive(Clone, Debug, Serialize)]
pub struct CombinedContext {
    /// Name in the shader.
    pub name: String,
    /// Name of the texture in the kernel.
    pub texture: String,
    /// Name of the sampler in the kernel, where there is one.
    pub sampler: Option<String>,
    /// `nearest`, `linear` or `comparison`.
    pub filter: &'static str,
    /// Type: `sampler2D`.
    pub glsl: String,
}

/// An argument of a function.
#[derive(Clone, Debug, Serialize)]
pub struct ArgumentContext {
    /// `texture`, `sampler`, `position`, `varying`, `resolution`, `meaning` or `uniform`.
    pub kind: &'static str,
    /// Name in the function.
    pub name: String,
    /// Name in the kernel.
    pub of: String,
    /// Expression of `engine.toml`, of a `meaning`.
    pub expression: Option<String>,
}

/// A uniform that the engine provides to a shader by name.
#[derive(Clone, Debug, Serialize)]
pub struct GlobalContext {
    /// Name in the shader.
    pub name: String,
    /// Expression of `engine.toml`.
    pub expression: String,
}

/// A function that reads a texture for the shader.
#[derive(Clone, Debug, Serialize)]
pub struct ReadContext {
    /// Name of the function.
    pub name: String,
    /// The texture, in the kernel.
    pub texture: String,
    /// Name of the texture in the text beside the shader.
    pub spelled: String,
    /// `load`, `sample` or `size`.
    pub does: &'static str,
    /// Name of the texture's meaning, if the engine converts it.
    pub meaning: Option<&'static str>,
    /// Four components at `pixel`, if the engine converts the texture.
    pub expression: Option<String>,
}
/// Returns the name of the uniform with the target's size.
fn size_name(manifest: &Manifest) -> Option<&str> {
    manifest.bindings.iter().find_map(|binding| match &binding.kind {
        BindingKind::Uniform { fields, .. } => {
            let field = fields.iter().find(|field| field.frame_size)?;
            Some(field.name.as_str())
        }
        _ => None,
    })
}

/// Circumstances of a shader in its engine.
pub struct ShaderScope<'a> {
    /// Name in `engine.toml`.
    pub name: &'a str,
    /// `true` if it takes uniforms, `false` if they are declared before it.
    pub takes_uniforms: bool,
    /// `true` if the templates fill in the target's size.
    pub fills_size: bool,
    /// Language.
    pub target: Target,
    /// Inputs that the engine provides.
    pub inputs: &'a Inputs,
    /// Their sources.
    pub meanings: &'a BTreeMap<String, MeaningSource>,
}

impl ShaderScope<'_> {
    /// Returns the expression of an input that the engine provides; of a matrix, that of a column.
    fn expression(&self, input: &str, column: Option<u32>) -> Option<(&'static Meaning, String)> {
        let meaning = self.inputs.meaning(input)?;
        let expression = self.meanings.get(meaning.name)?.expressions.get(self.name)?;
        let column = column.unwrap_or_default().to_string();
        Some((meaning, expression.replace("{column}", &column)))
    }

    /// Returns the expression of a uniform.
    fn uniform(&self, manifest: &Manifest, field: &str) -> Option<String> {
        let field = uniform_fields(manifest).iter().find(|other| other.name == field)?;
        let column = field.part.as_ref().map(|part| part.index);
        let (meaning, expression) = self.expression(whole_name(field), column)?;
        let ty = match self.target {
            Target::Wgsl => field.ty.to_string(),
            Target::Hlsl => spelling::hlsl_type(field.ty),
            _ => spelling::glsl_type(field.ty),
        };
        Some(match meaning.holds {
            Holds::Count => format!("{ty}({expression})"),
            _ => expression,
        })
    }

    /// Returns four components of a converted texture at `pixel`.
    fn texel(&self, texture: &str) -> Option<(&'static str, String)> {
        let (meaning, expression) = self.expression(texture, None)?;
        let vector = match self.target {
            Target::Wgsl => "vec4f",
            Target::Hlsl => "float4",
            _ => "vec4",
        };
        let rest = match meaning.holds {
            Holds::Texels(0 | 1) => ", 0.0, 0.0, 1.0",
            Holds::Texels(2) => ", 0.0, 1.0",
            Holds::Texels(3) => ", 1.0",
            _ => return None,
        };
        Some((meaning.name, format!("{vector}({expression}{rest})")))
    }
}

/// Fields of the uniform buffer.
fn uniform_fields(manifest: &Manifest) -> &[UniformField] {
    let mut fields = manifest.bindings.iter().filter_map(|binding| match &binding.kind {
        BindingKind::Uniform { fields, .. } if !binding.is_region() => Some(&fields[..]),
        _ => None,
    });
    fields.next().unwrap_or_default()
}

/// A shader, by its manifest.
pub fn shader_context(text: String, manifest: &Manifest, scope: &ShaderScope<'_>) -> ShaderContext {
    let (takes_uniforms, fills_size) = (scope.takes_uniforms, scope.fills_size);
    let size = size_name(manifest);
    let is_size = |b: &LanguageBinding| size.is_some() && b.of.as_deref() == size;
    let bindings = &manifest.language_bindings;
    let combined = bindings.iter().filter(|b| b.kind == LanguageKind::CombinedSampler);
    let combined = combined.map(|b| {
        let texture = b.texture.clone().unwrap_or_default();
        let sampler = b
            .sampler
            .as_ref()
            .and_then(|sampler| match &manifest.binding(sampler)?.kind {
                BindingKind::Sampler { sampler } => Some(*sampler),
                _ => None,
            });
        let compares = sampler == Some(SamplerType::Comparison);
        let glsl = match manifest.binding(&texture).map(|binding| &binding.kind) {
            Some(BindingKind::Texture {
                dimension, sample_type, ..
            }) => spelling::glsl_sampler(*dimension, *sample_type, compares),
            _ => "sampler2D".to_owned(),
        };
        CombinedContext {
            name: b.name.clone(),
            filter: match sampler {
                Some(SamplerType::Comparison) => "comparison",
                Some(SamplerType::Filtering) => "linear",
                Some(SamplerType::NonFiltering) | None => "nearest",
            },
            texture,
            sampler: b.sampler.clone(),
            glsl,
        }
    });
    let arguments = bindings.iter().filter_map(|b| {
        let kind = match b.kind {
            LanguageKind::Texture | LanguageKind::CombinedSampler => "texture",
            LanguageKind::Sampler => "sampler",
            LanguageKind::Position => "position",
            LanguageKind::Varying => "varying",
            LanguageKind::Uniform if takes_uniforms && fills_size && is_size(b) => "resolution",
            LanguageKind::Uniform if takes_uniforms => "uniform",
            _ => return None,
        };
        let of =
            b.of.clone()
                .or_else(|| b.texture.clone())
                .unwrap_or_else(|| b.name.clone());
        let expression = match kind {
            "uniform" => scope.uniform(manifest, &of),
            "texture" if scope.inputs.is_converted(&of) => scope.expression(&of, None).map(|(_, text)| text),
            _ => None,
        };
        Some(ArgumentContext {
            kind: if expression.is_some() { "meaning" } else { kind },
            name: b.name.clone(),
            of,
            expression,
        })
    });
    let globals = bindings
        .iter()
        .filter(|b| b.kind == LanguageKind::Uniform && !takes_uniforms);
    let globals = globals.filter_map(|b| {
        let expression = scope.uniform(manifest, b.of.as_deref()?)?;
        Some(GlobalContext {
            name: b.name.clone(),
            expression,
        })
    });
    let reads = bindings.iter().filter(|b| b.kind == LanguageKind::Function);
    let reads = reads.map(|b| {
        let texture = b.of.clone().unwrap_or_default();
        let (meaning, expression) = scope.texel(&texture).unzip();
        ReadContext {
            name: b.name.clone(),
            texture,
            spelled: b.texture.clone().unwrap_or_default(),
            does: fits::read_kind(&b.name),
            meaning,
            expression,
        }
    });
    let reads: Vec<ReadContext> = reads.collect();
    let mut combined: Vec<CombinedContext> = combined.collect();
    if combined.is_empty() {
        combined = combined_of_reads(&reads);
    }
    ShaderContext {
        text,
        function: manifest.entry_point.clone(),
        combined,
        arguments: arguments.collect(),
        reads,
        globals: globals.collect(),
        workgroup: manifest.workgroup_size,
        manifest: serde_json::to_value(manifest).unwrap_or_default(),
    }
}

/// Combined samplers for functions that read textures, each of which has one.
fn combined_of_reads(reads: &[ReadContext]) -> Vec<CombinedContext> {
    let mut all: Vec<CombinedContext> = Vec::new();
    for read in reads.iter().filter(|read| read.meaning.is_none()) {
        let filter = if read.does == "sample" { "linear" } else { "nearest" };
        match all.iter_mut().find(|one| one.texture == read.texture) {
            Some(one) if filter == "linear" => one.filter = filter,
            Some(_) => {}
            None => all.push(CombinedContext {
                name: read.spelled.clone(),
                texture: read.texture.clone(),
                sampler: None,
                filter,
                glsl: "sampler2D".to_owned(),
            }),
        }
    }
    all
}
