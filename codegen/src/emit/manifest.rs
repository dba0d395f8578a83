//! What a host is told of a shader: the manifest, and what single languages bind beside it.

use super::Target;
use super::layout::stride;
use super::print::{GENERATOR, wgsl_type};
use super::resources::{BoundTexture, OUTPUT, Resources, SAMPLER, UNIFORMS};
use crate::compiled::Compiled;
use crate::ir::{Texture, TextureKind};
use straightline_manifest::{
    Access, Binding, BindingKind, Counts, Dimension, Extent, LanguageBinding, Manifest, Output, Precision, REGION,
    REGION_SIZE, SCHEMA, SampleType, SamplerType, Stage, region_fields,
};

impl Resources {
    /// What not every device can do.
    fn features(&self) -> Vec<String> {
        let half = self.options.precision == Precision::F16;
        let features = [(self.subgroups, "subgroup"), (half, "shader-f16")];
        let needed = features.into_iter().filter(|(needed, _)| *needed);
        needed.map(|(_, name)| name.to_owned()).collect()
    }

    /// What single languages of the shader bind beside what all of them do.
    fn language_bindings(&self) -> Vec<LanguageBinding> {
        let mut extra = Vec::new();
        let is_wanted = |target: &Target| self.options.targets.contains(target);
        let mut add = |target: Target, name: &str, what: &str| {
            if is_wanted(&target) {
                extra.push(LanguageBinding {
                    language: target.to_string(),
                    name: name.to_owned(),
                    binding: self.sampler_binding(),
                    what: what.to_owned(),
                    texture: None,
                    sampler: None,
                });
            }
        };
        if !self.read.is_empty() {
            add(
                Target::Glsl450,
                SAMPLER,
                "any sampler: texels are named with one, and not filtered",
            );
        }
        if !self.read_buffers.is_empty() {
            add(
                Target::Msl,
                "_buffer_sizes",
                "a buffer of one u32 for each storage buffer, in order of binding: its length in bytes",
            );
        }
        if is_wanted(&Target::Hlsl) {
            let renamed = self.for_hlsl();
            let numbers = self.read.iter().map(|bound| bound.binding);
            let numbers = numbers.chain(self.read_buffers.iter().chain(&self.used_samplers).map(|(_, n)| *n));
            for ((name, other), binding) in self.names().zip(renamed.names()).zip(numbers) {
                if name != other {
                    extra.push(LanguageBinding {
                        language: Target::Hlsl.to_string(),
                        name: other.to_owned(),
                        binding,
                        what: format!("`{name}`, which is a word of HLSL"),
                        texture: None,
                        sampler: None,
                    });
                }
            }
        }
        for target in Target::OPENGL.into_iter().filter(is_wanted) {
            for one in &self.combined {
                let sampler = one.sampler.map(|sampler| self.sampler(sampler).name.clone());
                extra.push(LanguageBinding {
                    language: target.to_string(),
                    name: self.combined_name(*one),
                    binding: self.texture_binding(one.texture).unwrap_or_default(),
                    what: match sampler {
                        Some(_) => "the texture with the sampler".to_owned(),
                        None => {
                            "the texture, with a sampler for the nearest texel and without smaller levels".to_owned()
                        }
                    },
                    texture: Some(self.texture(one.texture).name.clone()),
                    sampler,
                });
            }
        }
        extra
    }

    /// The manifest of the shader, without its files.
    pub fn manifest(&self, compiled: &Compiled, counts: &Counts) -> Manifest {
        let mut bindings = Vec::new();
        let mut add = |binding: u32, name: &str, kind: BindingKind| {
            bindings.push(Binding {
                group: 0,
                binding,
                name: name.to_owned(),
                kind,
            });
        };
        for bound in &self.read {
            let texture = self.texture(bound.index);
            add(bound.binding, &texture.name, texture_kind(texture, bound));
        }
        for (index, binding) in &self.read_buffers {
            let buffer = self.buffer(*index);
            let kind = BindingKind::Buffer {
                access: Access::Read,
                element: wgsl_type(buffer.element.into()),
                stride: stride(buffer.element),
            };
            add(*binding, &buffer.name, kind);
        }
        for (index, binding) in &self.used_samplers {
            let sampler = match self.sampler(*index).comparison {
                true => SamplerType::Comparison,
                false => SamplerType::Filtering,
            };
            add(*binding, &self.sampler(*index).name, BindingKind::Sampler { sampler });
        }
        if let Some(binding) = self.uniform_binding() {
            bindings.push(Binding {
                group: 0,
                binding,
                name: UNIFORMS.to_owned(),
                kind: BindingKind::Uniform {
                    access: Access::Read,
                    size: self.uniform_size,
                    fields: self.fields.clone(),
                },
            });
        }
        if let Some(binding) = self.region_binding() {
            bindings.push(Binding {
                group: 0,
                binding,
                name: REGION.to_owned(),
                kind: BindingKind::Uniform {
                    access: Access::Read,
                    size: REGION_SIZE,
                    fields: region_fields(),
                },
            });
        }
        let compute = self.options.stage == Stage::Compute;
        Manifest {
            schema: SCHEMA,
            generator: GENERATOR.to_owned(),
            kernel: compiled.kernel.clone(),
            stage: self.options.stage,
            unroll: compiled.policy.to_string(),
            precision: self.options.precision,
            entry_point: self.entry.clone(),
            workgroup_size: compute.then_some(self.options.workgroup()),
            block: self.block,
            features: self.features(),
            varyings: self.varyings().collect(),
            bindings,
            language_bindings: self.language_bindings(),
            output: Output {
                name: OUTPUT.to_owned(),
                group: compute.then_some(0),
                binding: self.output_binding(),
                location: (!compute).then_some(0),
                access: Access::Write,
                format: self.options.format,
            },
            options: compiled.options.clone(),
            counts: counts.clone(),
            files: Default::default(),
            tuned: None,
        }
    }
}

fn texture_kind(texture: &Texture, bound: &BoundTexture) -> BindingKind {
    BindingKind::Texture {
        access: Access::Read,
        dimension: match texture.kind {
            TextureKind::Flat | TextureKind::Depth => Dimension::D2,
            TextureKind::Layers => Dimension::D2Array,
            TextureKind::Multisampled => Dimension::D2Multisampled,
        },
        sample_type: match texture.kind {
            TextureKind::Depth => SampleType::Depth,
            _ if bound.filtered => SampleType::Filterable,
            _ => SampleType::Unfilterable,
        },
        components: texture.components,
        layers: if texture.kind == TextureKind::Layers {
            bound.layers
        } else {
            1
        },
        samples: if texture.kind == TextureKind::Multisampled {
            bound.layers
        } else {
            1
        },
        extent: if texture.framed { Extent::Output } else { Extent::Any },
    }
}
