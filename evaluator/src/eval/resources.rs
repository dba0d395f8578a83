//! Resource parameters: samplers here, textures and buffers in modules of their own.

use super::Evaluator;
use super::value::{Eval, Value};
use crate::diagnostic::Span;
use crate::front::tree::Type as SourceType;
use crate::front::unraw;
use crate::ir::{Sampler, Uniform};
use std::collections::BTreeMap;

/// The kernel's inputs.
#[derive(Default)]
pub struct InputState {
    /// Names of the kernel's parameters and of the fields of parameters that are structures, with the number of uses
    /// of each name.
    pub names: BTreeMap<String, usize>,
    /// Element type of each buffer.
    pub elements: Vec<SourceType>,
    /// Every input, with the span of its declaration.
    pub declared: Vec<(String, Span)>,
}

impl Evaluator<'_> {
    /// Adds a resource parameter; `None` if its type is not a resource.
    pub fn resource_parameter(&mut self, name: &str, ty: &SourceType, span: Span) -> Eval<Option<Value>> {
        let SourceType::Name(type_name, args) = ty else {
            return Ok(None);
        };
        match type_name.as_str() {
            "Sampler" | "ComparisonSampler" => {
                let name = &*self.input_name(name);
                let samplers = &mut self.builder.graph_mut().samplers;
                samplers.push(Sampler {
                    name: name.to_owned(),
                    comparison: type_name == "ComparisonSampler",
                    filters: type_name == "Sampler",
                });
                Ok(Some(Value::Sampler(samplers.len() as u32 - 1)))
            }
            "Buffer" | "StorageBuffer" | "AtomicBuffer" => self.buffer_parameter(name, type_name, args, span).map(Some),
            "StorageTexture" => self.image_parameter(name, args, span).map(Some),
            "Shared" | "AtomicShared" => self.shared_parameter(name, type_name, args, span).map(Some),
            _ => self.texture_parameter(name, type_name, args, span),
        }
    }

    /// Unique name of an input for hosts: the parameter's, unless another input has it.
    pub fn input_name(&self, name: &str) -> String {
        let name = unraw(name);
        self.free_name(name, &|name| self.is_input(name))
    }

    /// Unique name of an option that is set at run time: the field's, unless a parameter or another input has it.
    pub fn option_name(&self, name: &str) -> String {
        let name = unraw(name);
        self.free_name(name, &|name| {
            self.is_input(name) || self.inputs.names.contains_key(name)
        })
    }

    /// Unique name joined from those of a parameter and a part.
    pub fn part_name(&self, name: &str, part: &str) -> String {
        let name = format!("{}_{}", unraw(name), unraw(part));
        self.free_name(&name, &|name| {
            self.is_input(name) || self.inputs.names.contains_key(name)
        })
    }

    /// First of `name`, `name_2`, `name_3`, ... that is not taken.
    pub(super) fn free_name(&self, name: &str, taken: &dyn Fn(&str) -> bool) -> String {
        // There are fewer names than numbers.
        let others = (2..u32::MAX).map(|k| format!("{name}_{k}"));
        let mut all = std::iter::once(name.to_owned()).chain(others);
        all.find(|name| !taken(name)).unwrap_or_else(|| name.to_owned())
    }

    /// Returns whether an input has this name, or a whole whose parts are inputs.
    fn is_input(&self, name: &str) -> bool {
        let graph = self.builder.graph();
        let is_whole = |u: &Uniform| u.part.as_ref().is_some_and(|part| part.of == name);
        graph.textures.iter().any(|t| t.name == name)
            || graph.buffers.iter().any(|b| b.name == name)
            || graph.images.iter().any(|image| image.name == name)
            || graph.shared.iter().any(|s| s.name == name)
            || graph.samplers.iter().any(|s| s.name == name)
            || graph.uniforms.iter().any(|u| u.name == name || is_whole(u))
            || graph.overrides.iter().any(|o| o.name == name)
            || graph.varyings.iter().any(|v| v.name == name)
    }

    /// Next site number for a read.
    pub(super) fn next_site(&mut self) -> u32 {
        self.last_site += 1;
        self.last_site
    }
}
