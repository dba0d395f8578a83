//! Names in one language's text: the kernel's names where the language allows them, and derived names.
//!
//! Hosts refer to everything by the kernel's names. A name that is invalid in a text is spelled differently there, and
//! [`language_bindings`](super::language_bindings) lists the difference.

use super::derived::Derived;
use super::own_words::{OF_GROUPS, OF_REGIONS, OUTPUT, OWN, UNIFORMS, VARIABLE};
use super::print::LOOSE_REGION;
use super::refusal::Refusal;
use super::resources::{BoundOverride, Resources};
use super::words::{Reserved, free_name, is_plain};
use crate::spec::Target;
use std::collections::{BTreeMap, BTreeSet};
use straightline_evaluator::ir::{Element, Structure};

impl Resources {
    /// Returns the derived names of a text, with their preferred spellings.
    fn derived_names(&self, target: Target) -> Vec<(Derived, String)> {
        let mut all = Vec::new();
        let calls_host = self.options.calls_host();
        all.extend(
            self.host
                .iter()
                .map(|f| (Derived::Host(*f), f.default_name(&self.texture(f.texture).name))),
        );
        if target == Target::Hlsl && !calls_host {
            for bound in &self.read {
                let (index, name) = (bound.index, &self.texture(bound.index).name);
                all.push((Derived::Size(index), format!("size_of_{name}")));
                all.push((Derived::Levels(index), format!("levels_of_{name}")));
                all.push((Derived::Layers(index), format!("layers_of_{name}")));
            }
            for (k, _) in &self.read_buffers {
                all.push((Derived::Length(*k), format!("len_of_{}", self.buffer(*k).name)));
            }
            all.push((Derived::OutputSize, format!("size_of_{}", self.sized_output())));
        }
        if target == Target::Wgsl {
            let held = |(k, bound): &(u32, BoundOverride)| (Derived::Held(*k), format!("{}_value", bound.of.name));
            all.extend(self.overrides.iter().map(held));
        }
        if target.is_glsl() {
            let block = |k: u32| (Derived::Block(k), format!("{}_buffer", self.buffer(k).name));
            all.extend(self.read_buffers.iter().map(|(k, _)| block(*k)));
        }
        if Target::OPENGL.contains(&target) && !calls_host {
            for one in &self.combined {
                let first = self.combined.iter().find(|other| other.texture == one.texture);
                if let Some(sampler) = one.sampler.filter(|_| first != Some(one)) {
                    let (texture, sampler) = (&self.texture(one.texture).name, &self.sampler(sampler).name);
                    all.push((Derived::Combined(*one), format!("{texture}_{sampler}")));
                }
            }
        }
        all
    }

    /// Returns a derived name.
    pub fn derived_name(&self, which: Derived) -> &str {
        self.derived.get(&which).map_or("", String::as_str)
    }

    /// Returns the names of a text that are neither the kernel's nor derived from them.
    fn own_names(&self, target: Target) -> BTreeSet<String> {
        let mut all: BTreeSet<String> = OWN.map(str::to_owned).into();
        all.extend([self.entry.clone(), self.outputs_type()]);
        all.extend(self.overrides.iter().map(|(_, bound)| bound.define.clone()));
        if self.options.has_place() {
            all.extend(OF_REGIONS.map(str::to_owned));
        }
        if self.group.is_some() {
            all.extend(OF_GROUPS.map(str::to_owned));
        }
        if Target::OPENGL.contains(&target) {
            all.extend(LOOSE_REGION.map(|(name, _)| name.to_owned()));
        }
        if target == Target::Hlsl {
            all.extend([VARIABLE, "Parameters_buffer", "Region_buffer"].map(str::to_owned));
        }
        all
    }

    /// Returns every name at module scope of a text, and of every parameter, for bindings that are spelled for the
    /// language.
    pub fn taken_names(&self, target: Target) -> BTreeSet<String> {
        let mut all = self.own_names(target);
        all.extend(self.bound_names().map(str::to_owned));
        all.extend(self.read_structures().iter().map(|structure| structure.name.clone()));
        all.extend(self.derived.values().cloned());
        all.extend(self.overrides.iter().map(|(_, bound)| bound.of.name.clone()));
        if self.has_loose_uniforms(target) {
            all.extend(self.uniforms.iter().map(|uniform| uniform.name.clone()));
        }
        all.insert(OUTPUT.to_owned());
        all
    }

    /// Returns whether uniforms are separate names in a text, not members of a structure.
    fn has_loose_uniforms(&self, target: Target) -> bool {
        self.options.is_function() || Target::OPENGL.contains(&target)
    }

    /// Returns the bindings with their names in a language's text: none is reserved, and all are distinct.
    ///
    /// # Errors
    ///
    /// If a million variants of a name are taken.
    pub fn spelled_for(&self, target: Target) -> Result<Resources, Refusal> {
        let mut spelled = self.clone();
        let reserved = Reserved::new(target, &self.options);
        let mut scope = Scope {
            kernel: &self.kernel,
            reserved: &reserved,
            taken: self.own_names(target),
            macros: self.overrides.iter().map(|(_, bound)| bound.define.clone()).collect(),
        };
        let loose = self.has_loose_uniforms(target);
        let structures = self.read_structures();
        // Valid names are kept, even if they come after invalid ones.
        let mut all: Vec<Given> = Vec::new();
        all.extend(self.read.iter().map(|bound| Given::Texture(bound.index)));
        all.extend(self.read_buffers.iter().map(|(k, _)| Given::Buffer(*k)));
        all.extend(self.used_samplers.iter().map(|(k, _)| Given::Sampler(*k)));
        all.extend(self.used_shared.iter().map(|k| Given::Shared(*k)));
        all.extend((0..self.varyings.len()).map(Given::Varying));
        all.extend((0..self.outputs.len()).map(Given::Output));
        all.extend((0..self.overrides.len()).map(Given::Override));
        if loose {
            all.extend((0..self.uniforms.len()).map(Given::Uniform));
        }
        all.extend((0..structures.len()).map(Given::Structure));
        let names = scope.give_names(all.iter().map(|given| self.given_name(*given, &structures)))?;
        let structures: BTreeMap<&str, (String, Vec<String>)> = structures
            .iter()
            .zip(names[names.len() - structures.len()..].iter())
            .map(|(structure, name)| {
                let fields = structure.fields.iter().map(|field| field.name.as_str());
                Ok((
                    structure.name.as_str(),
                    (name.clone(), scope.member_names(target, fields, &[])?),
                ))
            })
            .collect::<Result<_, Refusal>>()?;
        for buffer in &mut spelled.buffers {
            if let Element::Struct(structure) = &mut buffer.element
                && let Some((name, fields)) = structures.get(structure.name.as_str())
            {
                rename_structure(structure, name, fields);
            }
        }
        let mut uniforms: BTreeMap<&str, String> = BTreeMap::new();
        for (given, name) in all.iter().zip(&names) {
            match *given {
                Given::Texture(k) => spelled.textures[k as usize].name.clone_from(name),
                Given::Buffer(k) => spelled.buffers[k as usize].name.clone_from(name),
                Given::Sampler(k) => spelled.samplers[k as usize].name.clone_from(name),
                Given::Shared(k) => spelled.shared[k as usize].name.clone_from(name),
                Given::Varying(k) => spelled.varyings[k].name.clone_from(name),
                Given::Output(k) => spelled.outputs[k].name.clone_from(name),
                Given::Override(k) => spelled.overrides[k].1.of.name.clone_from(name),
                Given::Uniform(k) => {
                    uniforms.insert(&self.uniforms[k].name, name.clone());
                }
                Given::Structure(_) => {}
            }
        }
        if !loose {
            // naga's GLSL parser puts the members of a block into the scope of the other bindings.
            let seen: &[String] = if target == Target::Glsl450 { &names } else { &[] };
            let names = scope.member_names(target, self.uniforms.iter().map(|uniform| uniform.name.as_str()), seen)?;
            uniforms.extend(self.uniforms.iter().map(|uniform| uniform.name.as_str()).zip(names));
        }
        spelled.follow_names(self, &uniforms);
        for (which, name) in spelled.derived_names(target) {
            let name = scope.free_name(&name)?;
            spelled.derived.insert(which, name);
        }
        Ok(spelled)
    }

    /// Copies the new names to items that occur in a second list.
    fn follow_names(&mut self, original: &Resources, uniforms: &BTreeMap<&str, String>) {
        let renamed = |name: &mut String| {
            if let Some(other) = uniforms.get(name.as_str()) {
                name.clone_from(other);
            }
        };
        self.uniform_names.iter_mut().for_each(renamed);
        self.uniforms.iter_mut().for_each(|uniform| renamed(&mut uniform.name));
        self.fields.iter_mut().for_each(|field| renamed(&mut field.name));
        let varyings = original.varyings.iter().zip(&self.varyings);
        let varyings: BTreeMap<&str, &str> = varyings
            .map(|(from, to)| (from.name.as_str(), to.name.as_str()))
            .collect();
        for name in &mut self.varying_names {
            if let Some(other) = varyings.get(name.as_str()) {
                *name = (*other).to_owned();
            }
        }
        // Images with writes at arbitrary places are the last of the outputs.
        let images = self.images.iter_mut().rev().zip(self.outputs.iter().rev());
        images.for_each(|(image, output)| image.name.clone_from(&output.name));
    }

    /// Returns the name of an item in the kernel.
    fn given_name<'r>(&'r self, which: Given, structures: &[&'r Structure]) -> &'r str {
        match which {
            Given::Texture(k) => &self.textures[k as usize].name,
            Given::Buffer(k) => &self.buffers[k as usize].name,
            Given::Sampler(k) => &self.samplers[k as usize].name,
            Given::Shared(k) => &self.shared[k as usize].name,
            Given::Varying(k) => &self.varyings[k].name,
            Given::Output(k) => &self.outputs[k].name,
            Given::Override(k) => &self.overrides[k].1.of.name,
            Given::Uniform(k) => &self.uniforms[k].name,
            Given::Structure(k) => &structures[k].name,
        }
    }
}

/// An item with a name in the kernel: an index in the graph, or in a list of [`Resources`].
#[derive(Clone, Copy)]
enum Given {
    Texture(u32),
    Buffer(u32),
    Sampler(u32),
    Shared(u32),
    Varying(usize),
    Output(usize),
    Override(usize),
    Uniform(usize),
    Structure(usize),
}

/// Renames a structure and its fields.
fn rename_structure(structure: &mut Structure, name: &str, fields: &[String]) {
    name.clone_into(&mut structure.name);
    for (field, name) in structure.fields.iter_mut().zip(fields) {
        field.name.clone_from(name);
    }
}

/// Names at module scope of a text that are already taken.
struct Scope<'r> {
    kernel: &'r str,
    reserved: &'r Reserved,
    taken: BTreeSet<String>,
    /// Macros, which replace members of structures too.
    macros: BTreeSet<String>,
}

impl Scope<'_> {
    /// Returns a free name for an item.
    fn free_name(&mut self, name: &str) -> Result<String, Refusal> {
        let name = free_name(self.kernel, name, |name| {
            self.taken.contains(name) || self.reserved.has(name)
        })?;
        self.taken.insert(name.clone());
        Ok(name)
    }

    /// Returns names for several items; those that can keep their names come first.
    fn give_names<'n>(&mut self, names: impl Iterator<Item = &'n str>) -> Result<Vec<String>, Refusal> {
        let names: Vec<&str> = names.collect();
        let mut given: Vec<Option<String>> = Vec::new();
        for name in &names {
            let kept = is_plain(name) && !self.reserved.has(name) && self.taken.insert((*name).to_owned());
            given.push(kept.then(|| (*name).to_owned()));
        }
        let each = names.iter().zip(given);
        each.map(|(name, kept)| kept.map_or_else(|| self.free_name(name), Ok))
            .collect()
    }

    /// Returns names for the members of a structure, which have their own scope, apart from the names `seen` beside them.
    fn member_names<'n>(
        &self,
        target: Target,
        names: impl Iterator<Item = &'n str>,
        seen: &[String],
    ) -> Result<Vec<String>, Refusal> {
        let names: Vec<&str> = names.collect();
        // HLSL's padding is numbered by its position. naga rejects GLSL whose block has a member with the block's name.
        let is_own = |name: &&&str| match name.strip_prefix("padding_") {
            Some(at) => target == Target::Hlsl && at.bytes().all(|b| b.is_ascii_digit()),
            None => **name == UNIFORMS,
        };
        let mut scope = Scope {
            kernel: self.kernel,
            reserved: self.reserved,
            taken: names
                .iter()
                .filter(is_own)
                .map(|name| (*name).to_owned())
                .chain(seen.iter().cloned())
                .chain(self.macros.iter().cloned())
                .collect(),
            macros: BTreeSet::new(),
        };
        scope.give_names(names.into_iter())
    }
}
