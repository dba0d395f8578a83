//! Checks whether a kernel fits an engine.

use crate::description::{Limits, SizeSource};
use crate::inputs::Inputs;
use straightline_codegen::diagnostic::Code;
use straightline_manifest::{BindingKind, Dimension, LanguageKind, Manifest, SampleType, SamplerType, UniformField};

/// Reason why a kernel does not fit an engine.
pub struct Misfit {
    /// Statement of what the kernel does, and what the engine gives.
    pub why: String,
    /// Name of the input that does not fit, if it is one.
    pub input: Option<String>,
    /// Kind of error.
    pub code: Code,
    /// Text that would settle it, if there is one.
    pub help: Option<String>,
}

impl Misfit {
    /// A misfit of the kernel as a whole.
    pub fn new(why: String) -> Misfit {
        Misfit {
            why,
            input: None,
            code: Code::EngineUnfit,
            help: None,
        }
    }

    /// A misfit of one input.
    pub fn of_input(input: &str, why: String) -> Misfit {
        Misfit {
            why,
            input: Some(input.to_owned()),
            code: Code::EngineUnfit,
            help: None,
        }
    }

    /// Adds the text that would settle it.
    pub fn help(mut self, help: String) -> Misfit {
        self.help = Some(help);
        self
    }
}

/// Returns the reason why a kernel with this manifest does not fit an engine that provides `inputs` itself.
pub fn why_not(manifest: &Manifest, inputs: &Inputs, limits: &Limits, title: &str) -> Option<Misfit> {
    let gives = |what: &str| match &limits.gives {
        Some(gives) => format!("{title} gives {gives}"),
        None => format!("{title} takes {what}"),
    };
    let textures = manifest
        .bindings
        .iter()
        .filter(|b| matches!(b.kind, BindingKind::Texture { .. }) && !inputs.is_converted(&b.name));
    let count = textures.count() as u32;
    if let Some(most) = limits.textures.filter(|most| count > *most) {
        return Some(Misfit::new(format!(
            "binds {}, and {}",
            format_count(count, "texture"),
            gives(&format!("at most {most}"))
        )));
    }
    let mut uniforms = 0;
    for binding in &manifest.bindings {
        let name = &binding.name;
        match &binding.kind {
            BindingKind::Texture {
                dimension, sample_type, ..
            } => {
                let shape = shape_name(*dimension);
                if let Some(known) = limits.dimensions.as_ref().filter(|known| !contains_name(known, shape)) {
                    let why = format!("binds `{name}`, a {shape} texture, and {}", gives(&join_names(known)));
                    return Some(Misfit::of_input(name, why));
                }
                let what = texel_type_name(*sample_type);
                if let Some(known) = limits.holds.as_ref().filter(|known| !contains_name(known, what)) {
                    let given = gives(&format!("textures of {}", join_names(known)));
                    let why = format!("binds `{name}`, a texture of {what}, and {given}");
                    return Some(Misfit::of_input(name, why));
                }
            }
            BindingKind::Sampler { sampler } => {
                let what = match sampler {
                    SamplerType::Filtering => "filtering",
                    SamplerType::NonFiltering => "non-filtering",
                    SamplerType::Comparison => "comparison",
                };
                if limits
                    .samplers
                    .as_ref()
                    .is_some_and(|known| !contains_name(known, what))
                {
                    let why = format!("binds `{name}`, a {what} sampler, which {title} does not give");
                    return Some(Misfit::of_input(name, why));
                }
            }
            BindingKind::Buffer { .. } if !limits.buffers => {
                let why = format!("binds `{name}`, a storage buffer, which {title} does not give");
                return Some(Misfit::of_input(name, why));
            }
            BindingKind::Buffer { .. } => {}
            BindingKind::Uniform { fields, .. } => {
                if let Some(misfit) = find_unknown_size(manifest, limits, title) {
                    return Some(misfit);
                }
                let sized = |field: &UniformField| field.frame_size && limits.resolution == Some(SizeSource::Filled);
                let filled = |field: &UniformField| sized(field) || inputs.field_meaning(field).is_some();
                let fields = || fields.iter().filter(|field| !filled(field));
                uniforms += fields().count() as u32;
                let types = limits.uniform_types.clone().unwrap_or_else(settable_types);
                if let Some(field) = fields().find(|field| !contains_name(&types, &field.ty.to_string())) {
                    let (field, ty) = (&field.name, &field.ty);
                    let why = format!(
                        "has the uniform `{field}` of type {ty}, and {title} takes {}",
                        join_names(&types)
                    );
                    return Some(Misfit::of_input(field, why));
                }
            }
        }
    }
    if let Some(most) = limits.uniforms.filter(|most| uniforms > *most) {
        let most = format_count(most, "uniform");
        let why = format!("has {}, and {title} gives {most}", format_count(uniforms, "uniform"));
        return Some(Misfit::new(why));
    }
    let (outputs, most) = (manifest.outputs.len() as u32, limits.outputs.unwrap_or(1));
    if outputs > most {
        let why = format!("gives {}, and {title} takes {most}", format_count(outputs, "value"));
        return Some(Misfit::new(why));
    }
    if let Some(varying) = manifest.varyings.first().filter(|_| !limits.varyings) {
        let why = format!(
            "reads the interpolated value `{}`, which {title} does not give",
            varying.name
        );
        return Some(Misfit::of_input(&varying.name, why));
    }
    let feature = manifest
        .features
        .iter()
        .find(|feature| !limits.features.contains(feature));
    feature.map(|feature| {
        Misfit::new(format!(
            "needs the device feature `{feature}`, which {title} is not asked for"
        ))
    })
}

/// Returns the misfit of a shader that needs the target's size, in an engine without a source for it.
pub fn find_unknown_size(manifest: &Manifest, limits: &Limits, title: &str) -> Option<Misfit> {
    let needs_size = manifest.bindings.iter().any(|binding| match &binding.kind {
        BindingKind::Uniform { fields, .. } => fields.iter().any(|field| field.frame_size),
        _ => false,
    });
    let why = format!(
        "needs the target's size, and {title} gives only the sizes of textures: take the picture as a `Frame`, which has that size"
    );
    (needs_size && limits.resolution.is_none()).then_some(Misfit {
        why,
        input: None,
        code: Code::FrameSize,
        help: None,
    })
}

/// Returns the misfit of a shader that filters a texture which the engine converts texel by texel.
pub fn find_filtered(manifest: &Manifest, inputs: &Inputs, title: &str) -> Option<Misfit> {
    let functions = manifest.language_bindings.iter();
    let mut functions = functions.filter(|b| b.kind == LanguageKind::Function && read_kind(&b.name) == "sample");
    let name = functions.find_map(|b| b.of.as_deref().filter(|of| inputs.is_converted(of)))?;
    let why = format!("filters `{name}`, and {title} converts it for the kernel texel by texel");
    Some(Misfit::of_input(name, why).help(format!("read it by `{name}.load(pixel)`")))
}

/// Kind of read that a function of the host's does, by its name: `load`, `sample` or `size`.
pub fn read_kind(function: &str) -> &'static str {
    match function.split('_').next() {
        Some("load") => "load",
        Some("sample") => "sample",
        _ => "size",
    }
}

/// Types of uniforms that every template can set: numbers and vectors of them.
fn settable_types() -> Vec<String> {
    let lanes = ["vec2", "vec3", "vec4"].into_iter();
    let vectors = lanes.flat_map(|vector| ["f", "i", "u"].map(|kind| format!("{vector}{kind}")));
    ["f32", "i32", "u32"]
        .map(str::to_owned)
        .into_iter()
        .chain(vectors)
        .collect()
}

fn contains_name(known: &[String], name: &str) -> bool {
    known.iter().any(|one| one == name)
}

fn join_names(known: &[String]) -> String {
    known.join(", ")
}

/// `1 texture`, `2 textures`.
fn format_count(n: u32, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// Name of a shape in `engine.toml`.
pub fn shape_name(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::D2 => "2d",
        Dimension::D2Array => "2d-array",
        Dimension::D3 => "3d",
        Dimension::Cube => "cube",
        Dimension::D2Multisampled => "multisampled",
    }
}

/// Name of a texture's texel type in `engine.toml`.
pub fn texel_type_name(sample_type: SampleType) -> &'static str {
    match sample_type {
        SampleType::Unfilterable | SampleType::Filterable => "float",
        SampleType::Depth => "depth",
        SampleType::Sint => "sint",
        SampleType::Uint => "uint",
    }
}
