//! Everything that the caller of a chain binds, as the manifest of one kernel: engines are asked for it as for a kernel's.

use std::collections::BTreeSet;
use straightline_codegen::chain::{CompiledChain, CompiledPass, EmittedChain, SizeTerm};
use straightline_manifest::{
    Binding, BindingKind, BufferType, Dimension, Extent, Manifest, SampleType, SamplerType, UniformField,
};

/// Returns the inputs and uniforms of all passes under their names in the chain, and its results as outputs.
/// `None` of a chain without passes.
pub fn bound_manifest(compiled: &CompiledChain, emitted: &EmittedChain) -> Option<Manifest> {
    let manifest_of = |pass: &CompiledPass| &emitted.shaders[&pass.shader].emitted.manifest;
    let mut bound = manifest_of(compiled.passes.first()?).clone();
    bound.kernel.clone_from(&compiled.name);
    bound.language_bindings.clear();
    bound.varyings.clear();
    bound.features.clear();
    let mut given: Vec<Binding> = Vec::new();
    let mut fields: Vec<UniformField> = Vec::new();
    for pass in &compiled.passes {
        let manifest = manifest_of(pass);
        for binding in &manifest.bindings {
            match &binding.kind {
                BindingKind::Uniform { fields: own, .. } if !binding.is_region() => {
                    let is_new = |field: &&UniformField| {
                        !field.frame_size && fields.iter().all(|known| known.name != field.name)
                    };
                    let new: Vec<UniformField> = own.iter().filter(is_new).cloned().collect();
                    fields.extend(new);
                }
                BindingKind::Uniform { .. } => {}
                kind => {
                    if let Some(name) = pass.input_named(&binding.name) {
                        add_input(&mut given, name, kind);
                    }
                }
            }
        }
        for varying in &manifest.varyings {
            if !bound.varyings.contains(varying) {
                bound.varyings.push(varying.clone());
            }
        }
        for feature in &manifest.features {
            if !bound.features.contains(feature) {
                bound.features.push(feature.clone());
            }
        }
    }
    for name in sized_inputs(emitted) {
        // Nothing reads it, but pictures have its size.
        let kind = BindingKind::Texture {
            dimension: Dimension::D2,
            sample_type: SampleType::Unfilterable,
            components: 4,
            layers: 1,
            samples: 1,
            extent: Extent::Any,
        };
        if given.iter().all(|binding| binding.name != name) {
            add_input(&mut given, name, &kind);
        }
    }
    let place = |binding: &Binding| compiled.inputs.iter().position(|name| *name == binding.name);
    given.sort_by_key(place);
    if !fields.is_empty() {
        given.push(Binding {
            group: 0,
            binding: 0,
            name: "parameters".to_owned(),
            kind: BindingKind::Uniform {
                buffer_type: BufferType::Uniform,
                size: 0,
                fields,
            },
        });
    }
    for (number, binding) in (0..).zip(&mut given) {
        binding.binding = number;
    }
    bound.bindings = given;
    let results = compiled.results.iter().map(|index| &compiled.passes[*index]);
    bound.outputs = results
        .flat_map(|pass| manifest_of(pass).outputs.iter().cloned())
        .collect();
    Some(bound)
}

/// Inputs whose sizes decide those of pictures.
pub fn sized_inputs(emitted: &EmittedChain) -> BTreeSet<&str> {
    let terms = emitted.plan.pictures.iter().flat_map(|picture| picture.size.0.iter());
    let names = terms.filter_map(|term| match term {
        SizeTerm::Of(name) => Some(&**name),
        _ => None,
    });
    names.collect()
}

/// Adds an input, or makes a known one fit this use too.
fn add_input(given: &mut Vec<Binding>, name: &str, kind: &BindingKind) {
    let known = given.iter_mut().find(|binding| binding.name == name);
    let Some(known) = known else {
        let mut kind = kind.clone();
        if let BindingKind::Texture { extent, .. } = &mut kind {
            // Passes have sizes of their own.
            *extent = Extent::Any;
        }
        given.push(Binding {
            group: 0,
            binding: 0,
            name: name.to_owned(),
            kind,
        });
        return;
    };
    match (&mut known.kind, kind) {
        (
            BindingKind::Texture {
                sample_type,
                components,
                ..
            },
            BindingKind::Texture {
                sample_type: other,
                components: more,
                ..
            },
        ) => {
            *components = (*components).max(*more);
            if *other == SampleType::Filterable {
                *sample_type = SampleType::Filterable;
            }
        }
        (BindingKind::Sampler { sampler }, BindingKind::Sampler { sampler: other })
            if *other == SamplerType::Filtering =>
        {
            *sampler = *other;
        }
        _ => {}
    }
}
