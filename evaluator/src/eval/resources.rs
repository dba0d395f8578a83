//! Parameters that are bound: samplers here, textures and buffers in modules of their own.

use super::Evaluator;
use super::value::{Eval, Value};
use crate::diagnostic::Span;
use crate::front::tree::Type as SourceType;
use crate::front::unraw;
use crate::ir::{Sampler, Uniform};

impl Evaluator<'_> {
    /// A parameter that stands for a resource; `None` if its type is none.
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

    /// A name for an input, by which hosts know it: the parameter's, unless another input has it.
    pub fn input_name(&self, name: &str) -> String {
        let name = unraw(name);
        self.free_name(name, &|name| self.is_input(name))
    }

    /// A name for an option that is set at run time: its field's, unless a parameter or another input has it.
    pub fn option_name(&self, name: &str) -> String {
        let name = unraw(name);
        self.free_name(name, &|name| self.is_input(name) || self.parameters.contains_key(name))
    }

    /// A name that is made of a parameter's and a part's: that of no other input or parameter.
    pub fn part_name(&self, name: &str, part: &str) -> String {
        let name = format!("{}_{}", unraw(name), unraw(part));
        self.free_name(&name, &|name| self.is_input(name) || self.parameters.contains_key(name))
    }

    /// `name`, or else `name_2`, `name_3`, ...: the first that is not taken.
    pub(super) fn free_name(&self, name: &str, taken: &dyn Fn(&str) -> bool) -> String {
        // There are fewer names than numbers.
        let others = (2..u32::MAX).map(|k| format!("{name}_{k}"));
        let mut all = std::iter::once(name.to_owned()).chain(others);
        all.find(|name| !taken(name)).unwrap_or_else(|| name.to_owned())
    }

    /// Whether an input has a name, or a whole of which parts are inputs.
    fn is_input(&self, name: &str) -> bool {
        let graph = self.builder.graph();
        let is_whole = |u: &Uniform| u.part.as_ref().is_some_and(|part| part.of == name);
        graph.textures.iter().any(|t| t.name == name)
            || graph.buffers.iter().any(|b| b.name == name)
            || graph.images.iter().any(|image| image.name == name)
            || graph.shared.iter().any(|s| s.name == name)
            || graph.samplers.iter().any(|s| s.name == name)
            || graph.uniforms.iter().any(|u| u.name == name || is_whole(u))
            || graph.varyings.iter().any(|v| v.name == name)
    }

    /// A number for a read of its own.
    pub(super) fn next_site(&mut self) -> u32 {
        self.last_site += 1;
        self.last_site
    }
}
