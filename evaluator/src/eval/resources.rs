//! Parameters that are bound: samplers here, textures and buffers in modules of their own.

use super::Evaluator;
use super::value::{Eval, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::tree::Type as SourceType;
use crate::ir::Sampler;

impl Evaluator<'_> {
    /// A parameter that stands for a resource; `None` if its type is none.
    pub fn resource(&mut self, name: &str, ty: &SourceType, span: Span) -> Eval<Option<Value>> {
        let SourceType::Name(type_name, args) = ty else {
            return Ok(None);
        };
        match type_name.as_str() {
            "Sampler" | "ComparisonSampler" => {
                self.unused_name(name, span)?;
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

    /// Bindings go by name.
    pub fn unused_name(&self, name: &str, span: Span) -> Eval<()> {
        let graph = self.builder.graph();
        let mut names = graph.textures.iter().map(|t| &t.name);
        let taken = names.any(|n| n == name)
            || graph.buffers.iter().any(|b| b.name == name)
            || graph.images.iter().any(|image| image.name == name)
            || graph.shared.iter().any(|s| s.name == name)
            || graph.samplers.iter().any(|s| s.name == name)
            || graph.uniforms.iter().any(|u| u.name == name)
            || graph.varyings.iter().any(|v| v.name == name);
        if taken {
            return Err(Diagnostic::at(span, format!("two inputs are called `{name}`"))
                .label("the second")
                .help("bindings go by name: rename one")
                .into());
        }
        Ok(())
    }

    /// A number for a read of its own.
    pub(super) fn site(&mut self) -> u32 {
        self.sites += 1;
        self.sites
    }
}
