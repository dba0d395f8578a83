//! Everything that the caller of a chain binds.

use super::emitted::EmittedChain;
use std::collections::BTreeSet;
use straightline_manifest::chain::{PassPlan, SizeTerm};
use straightline_manifest::{
    Binding, BindingKind, BufferType, Dimension, Extent, SampleType, SamplerType, UniformField,
};

impl EmittedChain {
    /// Returns the inputs of the chain as one kernel would bind them: each once and in order, fit for all passes that read it, and
    /// then one uniform buffer, `parameters`, with the fields of all passes but the frame's size, which each pass has from its
    /// targets. Offsets are those of the passes, and the buffer's size is 0.
    pub fn bindings(&self) -> Vec<Binding> {
        let mut bindings: Vec<Binding> = Vec::new();
        for name in &*self.plan.inputs {
            let mut kinds = self.plan.passes.iter().flat_map(|pass| self.kinds_of(pass, name));
            let first = kinds.next().cloned();
            let mut kind = first.unwrap_or_else(any_texture);
            kinds.for_each(|other| widen(&mut kind, other));
            if let BindingKind::Texture { extent, .. } = &mut kind {
                // Passes have sizes of their own.
                *extent = Extent::Any;
            }
            bindings.push(bind(name, kind));
        }
        let fields = self.uniform_fields();
        if !fields.is_empty() {
            let kind = BindingKind::Uniform {
                buffer_type: BufferType::Uniform,
                size: 0,
                fields,
            };
            bindings.push(bind("parameters", kind));
        }
        for (number, binding) in (0..).zip(&mut bindings) {
            binding.binding = number;
        }
        bindings
    }

    /// Inputs whose sizes decide those of pictures.
    pub fn sized_inputs(&self) -> BTreeSet<&str> {
        let terms = self.plan.pictures.iter().flat_map(|picture| picture.size.0.iter());
        let names = terms.filter_map(|term| match term {
            SizeTerm::Of(name) => Some(&**name),
            _ => None,
        });
        names.collect()
    }

    /// How a pass reads an input of the chain.
    fn kinds_of<'e>(&'e self, pass: &'e PassPlan, input: &'e str) -> impl Iterator<Item = &'e BindingKind> {
        let bindings = &self.shaders[&*pass.shader].emitted.manifest.bindings;
        let names = pass.reads.iter().filter(move |read| read.from == input);
        names.filter_map(|read| Some(&bindings.iter().find(|binding| *binding.name == *read.name)?.kind))
    }

    /// Uniforms of all passes, each once.
    fn uniform_fields(&self) -> Vec<UniformField> {
        let mut all: Vec<UniformField> = Vec::new();
        for pass in &*self.plan.passes {
            if let Some((fields, _)) = self.shaders[&*pass.shader].emitted.manifest.uniform_block() {
                let own = fields.iter().filter(|field| !field.frame_size);
                let new = own.filter(|field| all.iter().all(|known| known.name != field.name));
                let new: Vec<UniformField> = new.cloned().collect();
                all.extend(new);
            }
        }
        all
    }
}

fn bind(name: &str, kind: BindingKind) -> Binding {
    Binding {
        group: 0,
        binding: 0,
        name: name.to_owned(),
        kind,
    }
}

/// The texture of an input that no pass reads, but whose size pictures have.
fn any_texture() -> BindingKind {
    BindingKind::Texture {
        dimension: Dimension::D2,
        sample_type: SampleType::Unfilterable,
        components: 4,
        layers: 1,
        samples: 1,
        extent: Extent::Any,
    }
}

/// Makes a binding fit another use too.
fn widen(kind: &mut BindingKind, other: &BindingKind) {
    match (kind, other) {
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
