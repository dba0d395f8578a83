//! Bindings whose names one language alone does not take.

use super::names::Words;
use super::resources::Resources;
use std::collections::{BTreeMap, BTreeSet};
use straightline_evaluator::ir::Element;

impl Resources {
    /// The bindings by names that are no words of HLSL, and no two of which are one: hosts bind by register there.
    pub fn for_hlsl(&self) -> Resources {
        let mut renamed = self.clone();
        let mut taken: BTreeSet<String> = self.names().map(str::to_owned).collect();
        let mut given: BTreeMap<String, String> = BTreeMap::new();
        let mut free = |name: &mut String| {
            if !Words::Hlsl.reserve(name) {
                return;
            }
            let other = given.entry(name.clone()).or_insert_with(|| {
                let mut other = format!("{name}_");
                while Words::Hlsl.reserve(&other) || !taken.insert(other.clone()) {
                    other.push('_');
                }
                other
            });
            name.clone_from(other);
        };
        renamed.textures.iter_mut().for_each(|texture| free(&mut texture.name));
        renamed.buffers.iter_mut().for_each(|buffer| free(&mut buffer.name));
        renamed.samplers.iter_mut().for_each(|sampler| free(&mut sampler.name));
        for buffer in &mut renamed.buffers {
            if let Element::Struct(structure) = &mut buffer.element {
                free(&mut structure.name);
                structure.fields.iter_mut().for_each(|field| free(&mut field.name));
            }
        }
        renamed.outputs.iter_mut().for_each(|output| free(&mut output.name));
        renamed.varying_names.iter_mut().for_each(&mut free);
        renamed.uniform_names.iter_mut().for_each(&mut free);
        renamed.varyings.iter_mut().for_each(|varying| free(&mut varying.name));
        renamed.uniforms.iter_mut().for_each(|uniform| free(&mut uniform.name));
        renamed
    }
}
