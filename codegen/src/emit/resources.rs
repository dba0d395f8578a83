//! What a shader binds: only what it reads.

use super::error::EmitError;
use super::layout::layout;
use crate::ir::{NodeId, Op, Texture, Uniform};
use crate::passes::layers_read;
use crate::pipeline::Compiled;
use straightline_manifest::{
    Access, Binding, BindingKind, Dimension, Format, Manifest, Output, SCHEMA, Stage, UniformField,
};

/// Name of the uniform buffer.
pub const UNIFORMS: &str = "parameters";
/// Name of the sampler that GLSL needs to name a texture; no filtering is ever asked of it.
pub const SAMPLER: &str = "unfiltered";
/// Name of the storage texture or colour that is written.
pub const OUTPUT: &str = "destination";
/// Invocations in a workgroup: a row of pixels, as wide as WebGPU's default limits allow. On lavapipe and SwiftShader
/// rows were faster than squares of 8x8 or 16x16, looped and unrolled.
pub const WORKGROUP: [u32; 3] = [256, 1, 1];

/// A shader's bindings.
pub struct Resources {
    /// Stage that it is for.
    pub stage: Stage,
    /// Format of the output.
    pub format: Format,
    /// Every texture of the kernel, read or not, by index.
    textures: Vec<Texture>,
    /// Indices of those that are read, with their binding numbers and layers.
    pub read: Vec<(u32, u32, u32)>,
    /// Fields of the uniform buffer, and its size.
    pub fields: Vec<UniformField>,
    /// Size of the uniform buffer in bytes.
    pub uniform_size: u32,
    /// Whether the shader asks for the frame's size.
    pub needs_frame: bool,
}

impl Resources {
    /// What the scheduled graph reads.
    pub fn of(compiled: &Compiled, stage: Stage, format: Format) -> Result<Resources, EmitError> {
        let graph = &compiled.graph;
        let live = |id: &NodeId| compiled.schedule.place[id.0 as usize].is_some();
        let reads = |k: u32| {
            graph
                .ids()
                .filter(live)
                .any(|id| matches!(graph.node(id).op, Op::Load { texture, .. } if texture == k))
        };
        let mut read = Vec::new();
        for k in 0..graph.textures.len() as u32 {
            if reads(k) {
                read.push((k, read.len() as u32, layers_read(graph, k)));
            }
        }
        let used = |k: u32| graph.ids().filter(live).any(|id| graph.node(id).op == Op::Uniform(k));
        let uniforms: Vec<&Uniform> = graph
            .uniforms
            .iter()
            .enumerate()
            .filter(|(k, _)| used(*k as u32))
            .map(|(_, u)| u)
            .collect();
        let textures_read = read.iter().map(|(k, ..)| &graph.textures[*k as usize].name);
        let bound = textures_read.chain(uniforms.iter().map(|u| &u.name));
        let own = [UNIFORMS, SAMPLER, OUTPUT, "frame", "pixel", "id", "position"];
        if let Some(name) = bound
            .into_iter()
            .find(|name| super::names::is_reserved(name) || own.contains(&name.as_str()))
        {
            return Err(EmitError::Reserved {
                kernel: compiled.kernel.clone(),
                name: name.clone(),
            });
        }
        let (fields, uniform_size) = layout(&uniforms);
        let needs_frame =
            stage == Stage::Compute || graph.ids().filter(live).any(|id| graph.node(id).op == Op::FrameSize);
        if needs_frame && stage == Stage::Fragment && read.is_empty() {
            return Err(EmitError::NoFrame {
                kernel: compiled.kernel.clone(),
            });
        }
        Ok(Resources {
            stage,
            format,
            textures: graph.textures.clone(),
            read,
            fields,
            uniform_size,
            needs_frame,
        })
    }

    /// A texture by its index in the graph.
    pub fn texture(&self, index: u32) -> &Texture {
        &self.textures[index as usize]
    }

    /// Binding number of the output, where it is one.
    pub fn output_binding(&self) -> Option<u32> {
        (self.stage == Stage::Compute).then_some(self.read.len() as u32)
    }

    /// Binding number of the uniform buffer, if there is one.
    pub fn uniform_binding(&self) -> Option<u32> {
        let next = self.read.len() as u32 + u32::from(self.stage == Stage::Compute);
        (!self.fields.is_empty()).then_some(next)
    }

    /// Binding number of the sampler that only GLSL has: the last.
    pub fn sampler_binding(&self) -> u32 {
        self.read.len() as u32 + u32::from(self.stage == Stage::Compute) + u32::from(!self.fields.is_empty())
    }

    /// The manifest of the shader, without its files and with `statements` still 0.
    pub fn manifest(&self, compiled: &Compiled) -> Manifest {
        let mut bindings = Vec::new();
        for (index, binding, layers) in &self.read {
            let texture = self.texture(*index);
            let dimension = if texture.layered {
                Dimension::D2Array
            } else {
                Dimension::D2
            };
            bindings.push(Binding {
                group: 0,
                binding: *binding,
                name: texture.name.clone(),
                kind: BindingKind::Texture {
                    access: Access::Read,
                    dimension,
                    components: texture.components,
                    layers: *layers,
                },
            });
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
        let compute = self.stage == Stage::Compute;
        Manifest {
            schema: SCHEMA,
            generator: super::shell::GENERATOR.to_owned(),
            kernel: compiled.kernel.clone(),
            stage: self.stage,
            unroll: compiled.unroll.name().to_owned(),
            entry_point: super::shell::entry_point(&compiled.kernel),
            workgroup_size: compute.then_some(WORKGROUP),
            bindings,
            output: Output {
                name: OUTPUT.to_owned(),
                group: compute.then_some(0),
                binding: self.output_binding(),
                location: (!compute).then_some(0),
                access: Access::Write,
                format: self.format,
            },
            options: compiled.options.clone(),
            counts: compiled.counts.clone(),
            files: Default::default(),
        }
    }
}
