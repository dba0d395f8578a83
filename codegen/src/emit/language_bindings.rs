//! Bindings of each language, with its numbers, registers and names; for functions, their parameters.

use super::Target;
use super::derived::Derived;
use super::own_words::{SAMPLER, UNIFORMS};
use super::print::LOOSE_REGION;
use super::refusal::Refusal;
use super::resources::Resources;
use straightline_manifest::{LanguageBinding, LanguageKind as Kind, REGION, Stage};

impl Resources {
    /// Returns the bindings of all requested languages. WGSL and SPIR-V bind exactly the manifest's `bindings` and
    /// `outputs`, so they list only renamed items.
    ///
    /// # Errors
    ///
    /// As [`Resources::spelled_for`].
    pub fn language_bindings(&self) -> Result<Vec<LanguageBinding>, Refusal> {
        let mut all = Vec::new();
        for target in &self.options.targets {
            let mut list = List {
                language: target.to_string(),
                bindings: Vec::new(),
            };
            let spelled = self.spelled_for(*target)?;
            match target {
                _ if self.options.is_function() => spelled.list_parameters(self, *target, &mut list),
                Target::Wgsl | Target::Spirv => spelled.list_renamed(self, &mut list),
                Target::Hlsl => spelled.list_registers(self, &mut list),
                Target::Glsl450 => spelled.list_descriptor_sets(self, &mut list),
                Target::Msl => spelled.list_metal_indices(self, &mut list),
                _ => spelled.list_texture_units(self, *target, &mut list),
            }
            all.append(&mut list.bindings);
        }
        Ok(all)
    }

    /// WGSL and SPIR-V: lists the bindings with another name in the text. Here and below, `self` holds the names in the
    /// text, and `original` those of the manifest.
    fn list_renamed(&self, original: &Resources, list: &mut List) {
        self.for_each_binding(original, |kind, _, name, of, binding| {
            if name != of {
                set_number(list.add(kind, name, Some(of)), self.places.bind_group(), binding);
            }
        });
        if self.options.stage == Stage::Fragment {
            for ((varying, of), location) in self.varyings.iter().zip(&original.varyings).zip(0..) {
                if varying.name != of.name {
                    list.add(Kind::Varying, &varying.name, Some(&of.name)).location = Some(location);
                }
            }
        }
        self.list_members(original, list);
    }

    /// Members of the uniform buffer with another name in the text.
    fn list_members(&self, original: &Resources, list: &mut List) {
        for (uniform, of) in self.uniforms.iter().zip(&original.uniforms) {
            if uniform.name != of.name {
                list.add(Kind::Member, &uniform.name, Some(&of.name));
            }
        }
    }

    /// Vulkan's GLSL: numbers in a descriptor set.
    fn list_descriptor_sets(&self, original: &Resources, list: &mut List) {
        let group = self.places.bind_group();
        self.for_each_binding(original, |kind, _, name, of, binding| {
            set_number(list.add(kind, name, Some(of)), group, binding);
        });
        if !self.read.is_empty() {
            let bound = list.add(Kind::Sampler, SAMPLER, None);
            set_number(bound, group, self.sampler_binding());
            bound.what = Some("any sampler: texels are named with one, and not filtered".to_owned());
        }
        self.list_varyings(list, original, true);
        self.list_members(original, list);
    }

    /// HLSL: registers.
    fn list_registers(&self, original: &Resources, list: &mut List) {
        self.for_each_binding(original, |kind, class, name, of, binding| {
            let register = self.places.register_at(class, binding);
            let bound = list.add(kind, name, Some(of));
            bound.register = Some(format!("{}{}", register.class, register.number));
            bound.space = register.space.filter(|space| *space != 0);
        });
        self.list_varyings(list, original, true);
        self.list_members(original, list);
    }

    /// Metal: indices of textures, buffers and samplers.
    fn list_metal_indices(&self, original: &Resources, list: &mut List) {
        self.for_each_binding(original, |kind, _, name, of, binding| {
            list.add(kind, name, Some(of)).binding = Some(binding);
        });
        if !self.read_buffers.is_empty() {
            let bound = list.add(Kind::UniformBuffer, "_buffer_sizes", None);
            bound.binding = Some(self.sizes_binding());
            bound.what = Some("one u32 for each storage buffer, in order of binding: its length in bytes".to_owned());
        }
        self.list_varyings(list, original, true);
        self.list_members(original, list);
    }

    /// The languages of OpenGL: texture units, if the version numbers them, and names.
    fn list_texture_units(&self, original: &Resources, target: Target, list: &mut List) {
        let numbered = matches!(target, Target::Glsl430 | Target::Essl310);
        self.combined_samplers(original, numbered, list);
        for (k, binding) in &self.read_buffers {
            let [name, of] = [self, original].map(|r| &r.buffer(*k).name);
            list.add(Kind::StorageBuffer, name, Some(of)).binding = Some(*binding);
        }
        for (output, of) in self.outputs.iter().zip(&original.outputs) {
            if output.binding.is_some() {
                list.add(Kind::StorageTexture, &output.name, Some(&of.name)).binding = output.binding;
            }
        }
        for (uniform, of) in self.uniforms.iter().zip(&original.uniforms) {
            list.add(Kind::Uniform, &uniform.name, Some(&of.name));
        }
        if self.options.region {
            for (name, of) in LOOSE_REGION {
                list.add(Kind::Uniform, name, Some(of));
            }
        }
        self.list_varyings(list, original, numbered);
    }

    fn combined_samplers(&self, original: &Resources, numbered: bool, list: &mut List) {
        for one in &self.combined {
            let alone = self.combined.iter().filter(|c| c.texture == one.texture).count() == 1;
            let bound = list.add(Kind::CombinedSampler, self.combined_name(*one), None);
            // Two samplers of one texture have two units, numbered by the host.
            bound.binding = self.texture_binding(one.texture).filter(|_| numbered && alone);
            bound.texture = Some(original.texture(one.texture).name.clone());
            bound.sampler = one.sampler.map(|sampler| original.sampler(sampler).name.clone());
        }
    }

    /// Lists the parameters of a function, in order.
    fn list_parameters(&self, original: &Resources, target: Target, list: &mut List) {
        if self.options.calls_host() {
            for function in &self.host {
                let of = &original.texture(function.texture).name;
                let bound = list.add(Kind::Function, self.derived_name(Derived::Host(*function)), Some(of));
                bound.texture = Some(self.texture(function.texture).name.clone());
                bound.what = Some(function.result_description().to_owned());
            }
        } else if Target::OPENGL.contains(&target) {
            self.combined_samplers(original, false, list);
        } else {
            self.for_each_binding(original, |kind, _, name, of, _| {
                if kind != Kind::UniformBuffer {
                    list.add(kind, name, Some(of));
                }
            });
            if target == Target::Glsl450 && !self.read.is_empty() {
                list.add(Kind::Sampler, SAMPLER, None).what =
                    Some("any sampler: texels are named with one, and not filtered".to_owned());
            }
        }
        list.add(Kind::Position, "position", None);
        self.list_varyings(list, original, false);
        for (uniform, of) in self.uniforms.iter().zip(&original.uniforms) {
            list.add(Kind::Uniform, &uniform.name, Some(&of.name));
        }
    }

    fn list_varyings(&self, list: &mut List, original: &Resources, numbered: bool) {
        if self.options.stage == Stage::Fragment {
            for ((varying, of), location) in self.varyings.iter().zip(&original.varyings).zip(0..) {
                list.add(Kind::Varying, &varying.name, Some(&of.name)).location = numbered.then_some(location);
            }
        }
    }

    /// Visits everything bound at a number: kind, register class, name in the text, name in the manifest, number.
    fn for_each_binding(&self, original: &Resources, mut see: impl FnMut(Kind, char, &str, &str, u32)) {
        for bound in &self.read {
            let [name, of] = [self, original].map(|r| &r.texture(bound.index).name);
            see(Kind::Texture, 't', name, of, bound.binding);
        }
        for (k, binding) in &self.read_buffers {
            let [name, of] = [self, original].map(|r| &r.buffer(*k).name);
            see(Kind::StorageBuffer, self.buffer_class(*k), name, of, *binding);
        }
        for (k, binding) in &self.used_samplers {
            let [name, of] = [self, original].map(|r| &r.sampler(*k).name);
            see(Kind::Sampler, 's', name, of, *binding);
        }
        for (output, of) in self.outputs.iter().zip(&original.outputs) {
            if let Some(binding) = output.binding {
                see(Kind::StorageTexture, 'u', &output.name, &of.name, binding);
            }
        }
        if let Some(binding) = self.uniform_binding() {
            let kind = match self.has_immediates() {
                true => Kind::Immediates,
                false => Kind::UniformBuffer,
            };
            see(kind, 'b', UNIFORMS, &self.own_names.uniforms, binding);
        }
        if let Some(binding) = self.region_binding() {
            see(Kind::UniformBuffer, 'b', REGION, &self.own_names.region, binding);
        }
    }
}

/// Sets descriptor set and number, which immediates do not have.
fn set_number(bound: &mut LanguageBinding, group: u32, binding: u32) {
    if bound.kind != Kind::Immediates {
        (bound.group, bound.binding) = (Some(group), Some(binding));
    }
}

/// Bindings of one language.
struct List {
    language: String,
    bindings: Vec<LanguageBinding>,
}

impl List {
    fn add(&mut self, kind: Kind, name: &str, of: Option<&str>) -> &mut LanguageBinding {
        self.bindings.push(LanguageBinding {
            language: self.language.clone(),
            name: name.to_owned(),
            kind,
            group: None,
            binding: None,
            register: None,
            space: None,
            location: None,
            of: of.map(str::to_owned),
            texture: None,
            sampler: None,
            what: None,
        });
        self.bindings.last_mut().expect("just added")
    }
}
