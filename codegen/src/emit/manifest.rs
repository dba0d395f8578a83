//! The manifest: description of a shader for the host.

use super::layout::value_type;
use super::print::GENERATOR;
use super::refusal::Refusal;
use super::resources::{BoundOverride, BoundTexture, Resources};
use crate::compiled::Compiled;
use straightline_evaluator::ir::{Element, Field, Scalar, Texture, TextureKind};
use straightline_manifest::{
    Access, Binding, BindingKind, BufferType, Counts, Dimension, Extent, Immediates, Manifest, Output, Override,
    OverrideType, REGION_SIZE, SCHEMA, SampleType, SamplerType, Stage, UniformField, ViewDimension, region_fields,
};

impl Resources {
    /// Optional device features that the shader needs.
    fn device_features(&self) -> Vec<String> {
        let features = [
            (self.subgroups, "subgroup"),
            (self.half, "shader-f16"),
            (self.has_immediates(), "immediates"),
        ];
        let needed = features.into_iter().filter(|(needed, _)| *needed);
        needed.map(|(_, name)| name.to_owned()).collect()
    }

    /// Returns the manifest of the shader, without the facts that only its texts provide.
    ///
    /// # Errors
    ///
    /// As [`Resources::spelled_for`].
    pub fn build_manifest(&self, compiled: &Compiled, counts: &Counts) -> Result<Manifest, Refusal> {
        let mut bindings = Vec::new();
        let group = self.places.bind_group();
        let mut add = |binding: u32, name: &str, kind: BindingKind| {
            bindings.push(Binding {
                group,
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
                buffer_type: match self.is_written(*index) {
                    true => BufferType::Storage,
                    false => BufferType::ReadOnlyStorage,
                },
                element: match &buffer.element {
                    Element::Value(ty) => straightline_manifest::Element::Value(value_type(*ty)),
                    Element::Struct(structure) => straightline_manifest::Element::Structure(structure.name.clone()),
                },
                stride: buffer.element.stride(),
                fields: match &buffer.element {
                    Element::Value(_) => Vec::new(),
                    Element::Struct(structure) => structure.fields.iter().map(uniform_field).collect(),
                },
            };
            add(*binding, &buffer.name, kind);
        }
        for (index, binding) in &self.used_samplers {
            let bound = self.sampler(*index);
            let sampler = match (bound.comparison, bound.filters) {
                (true, _) => SamplerType::Comparison,
                (false, true) => SamplerType::Filtering,
                (false, false) => SamplerType::NonFiltering,
            };
            add(*binding, &bound.name, BindingKind::Sampler { sampler });
        }
        let is_immediate = self.has_immediates();
        if let Some(binding) = self.uniform_binding().filter(|_| !is_immediate) {
            bindings.push(Binding {
                group,
                binding,
                name: self.own_names.uniforms.clone(),
                kind: BindingKind::Uniform {
                    buffer_type: BufferType::Uniform,
                    size: self.uniform_size,
                    fields: self.fields.clone(),
                },
            });
        }
        if let Some(binding) = self.region_binding() {
            bindings.push(Binding {
                group,
                binding,
                name: self.own_names.region.clone(),
                kind: BindingKind::Uniform {
                    buffer_type: BufferType::Uniform,
                    size: REGION_SIZE,
                    fields: region_fields(),
                },
            });
        }
        bindings.sort_by_key(|binding: &Binding| binding.binding);
        let compute = self.options.stage == Stage::Compute;
        let outputs = self.outputs.iter().zip(0..).map(|(output, location)| Output {
            name: output.name.clone(),
            group: compute.then_some(group),
            binding: output.binding,
            location: (!compute).then_some(location),
            access: Access::WriteOnly,
            view_dimension: ViewDimension::D2,
            format: output.format,
            ty: value_type(output.ty),
            tile: output.tile,
        });
        Ok(Manifest {
            schema: SCHEMA,
            generator: GENERATOR.to_owned(),
            kernel: compiled.kernel.clone(),
            stage: self.options.stage,
            unroll: compiled.policy.to_string(),
            precision: self.options.precision,
            half: compiled.half.clone(),
            form: self.options.form,
            origin: self.options.origin,
            entry_point: self.entry.clone(),
            entry_points: Default::default(),
            workgroup_size: compute.then_some(self.workgroup_size()),
            fills_memory: !self.used_shared.is_empty() && !self.is_zeroed(),
            block: self.block,
            features: self.device_features(),
            varyings: self.manifest_varyings().collect(),
            bindings,
            immediates: is_immediate.then(|| Immediates {
                name: self.own_names.uniforms.clone(),
                size: self.uniform_size,
                fields: self.fields.clone(),
            }),
            overrides: self
                .overrides
                .iter()
                .map(|(_, bound)| manifest_override(bound))
                .collect(),
            language_bindings: self.language_bindings()?,
            outputs: outputs.collect(),
            options: compiled.options.spelled(),
            counts: counts.clone(),
            files: Default::default(),
            hashes: Default::default(),
            validated: Default::default(),
            tuned: None,
        })
    }
}

/// Converts a field of a structure to the manifest's description.
fn uniform_field(field: &Field) -> UniformField {
    UniformField {
        name: field.name.clone(),
        ty: value_type(field.ty),
        offset: field.offset,
        size: field.ty.memory_layout().1,
        default: None,
        part: None,
        frame_size: false,
    }
}

fn manifest_override(bound: &BoundOverride) -> Override {
    let of = &bound.of;
    Override {
        name: of.name.clone(),
        id: of.id,
        define: bound.define.clone(),
        ty: match of.ty.scalar_kind() {
            Some(Scalar::I32) => OverrideType::I32,
            Some(Scalar::U32) => OverrideType::U32,
            Some(Scalar::Bool) => OverrideType::Bool,
            _ => OverrideType::F32,
        },
        default: of.default,
        range: of.range,
    }
}

fn texture_kind(texture: &Texture, bound: &BoundTexture) -> BindingKind {
    let counted = |kind: TextureKind| if texture.kind == kind { bound.layers } else { 1 };
    BindingKind::Texture {
        dimension: match texture.kind {
            TextureKind::Flat | TextureKind::Depth => Dimension::D2,
            TextureKind::Layers | TextureKind::DepthLayers => Dimension::D2Array,
            TextureKind::Volume => Dimension::D3,
            TextureKind::Cube | TextureKind::DepthCube => Dimension::Cube,
            TextureKind::Multisampled => Dimension::D2Multisampled,
        },
        sample_type: match texture.scalar {
            Scalar::I32 => SampleType::Sint,
            Scalar::U32 | Scalar::Usize | Scalar::Bool => SampleType::Uint,
            Scalar::F32 if texture.kind.is_depth() => SampleType::Depth,
            Scalar::F32 if bound.filtered => SampleType::Filterable,
            Scalar::F32 => SampleType::Unfilterable,
        },
        components: texture.components,
        layers: counted(TextureKind::Layers),
        samples: counted(TextureKind::Multisampled),
        extent: if texture.framed { Extent::Output } else { Extent::Any },
    }
}
