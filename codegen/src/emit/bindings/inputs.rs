//! Inputs of a shader, as fields of a structure.

use super::{parameters, rust_identifier};
use quote::format_ident;
use straightline_manifest::{Binding, BindingKind, Dimension, Element, Extent, Manifest, SampleType, SamplerType};

/// A field of `Inputs`.
pub struct Input {
    pub name: proc_macro2::Ident,
    pub bound: String,
    pub docs: String,
    pub ty: proc_macro2::Ident,
}

impl Input {
    pub fn from_binding(binding: &Binding, manifest: &Manifest) -> Option<Input> {
        let (docs, ty) = match &binding.kind {
            BindingKind::Texture {
                components,
                layers,
                samples,
                dimension,
                sample_type,
                extent,
                ..
            } => {
                let shape = match dimension {
                    Dimension::D2 => "A 2-D texture".to_owned(),
                    Dimension::D2Array if *extent == Extent::Any => "A 2-D array texture".to_owned(),
                    Dimension::D2Array => format!("A 2-D array texture of at least {layers} layers"),
                    Dimension::D3 => "A 3-D texture".to_owned(),
                    Dimension::Cube => "A cube texture".to_owned(),
                    Dimension::D2Multisampled => format!("A multisampled 2-D texture of at least {samples} samples"),
                };
                let size = match extent {
                    Extent::Output => "the target's size",
                    Extent::Any => "any size",
                };
                let plural = if *components == 1 { "component" } else { "components" };
                let format = match sample_type {
                    SampleType::Depth => "a depth format".to_owned(),
                    SampleType::Filterable => format!("a filterable float format with at least {components} {plural}"),
                    SampleType::Unfilterable => format!("a float format with at least {components} {plural}"),
                    SampleType::Sint => format!("a format of signed integers with at least {components} {plural}"),
                    SampleType::Uint => format!("a format of unsigned integers with at least {components} {plural}"),
                };
                (format!("{shape} of {size}, of {format}."), "TextureView")
            }
            BindingKind::Sampler { sampler } => match sampler {
                SamplerType::Filtering => ("A sampler that may filter.".to_owned(), "Sampler"),
                SamplerType::NonFiltering => (
                    "A sampler that takes the nearest texel and clamps to the edge.".to_owned(),
                    "Sampler",
                ),
                SamplerType::Comparison => ("A comparison sampler.".to_owned(), "Sampler"),
            },
            BindingKind::Buffer { element, stride, .. } => (
                match element {
                    Element::Value(ty) => format!("A storage buffer of `{ty}`, {stride} bytes each, at least one."),
                    Element::Structure(name) => format!(
                        "A storage buffer of [`{}`], {stride} bytes each, at least one.",
                        parameters::structure_name(manifest, name)
                    ),
                },
                "Buffer",
            ),
            BindingKind::Uniform { .. } => return None,
        };
        Some(Input {
            name: rust_identifier(&binding.name),
            bound: binding.name.clone(),
            docs,
            ty: format_ident!("{ty}"),
        })
    }
}
