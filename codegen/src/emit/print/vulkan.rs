//! Declarations in Vulkan's GLSL: separate textures and samplers in descriptor sets.

use super::glsl::{Glsl, sampler_type, texture_type, variable_declared};
use super::overrides::PrintOverrides;
use crate::emit::own_words::{SAMPLER, UNIFORMS};
use straightline_manifest::REGION;

impl Glsl<'_> {
    /// Declares the overrides, which a host sets by their numbers.
    pub(super) fn specialization_constants(&self) -> String {
        let mut out = self.override_comment();
        for (_, bound) in &self.resources.overrides {
            let of = &bound.of;
            let declared = variable_declared(&of.name, of.ty.into());
            let (default, range) = (self.override_default(of), self.range_comment(of));
            out += &format!("layout(constant_id = {}) const {declared} = {default};{range}\n", of.id);
        }
        out
    }

    /// Declares the bindings of Vulkan.
    pub(super) fn of_vulkan(&self) -> String {
        let r = self.resources;
        let mut out = String::new();
        for bound in &r.read {
            let texture = r.texture(bound.index);
            let (layout, ty) = (self.layout_qualifier(bound.binding, "", ""), texture_type(texture));
            out += &format!("{layout}uniform {ty} {};\n", texture.name);
        }
        out += &self.buffer_declarations();
        for (k, binding) in &r.used_samplers {
            let sampler = r.sampler(*k);
            let (layout, ty) = (
                self.layout_qualifier(*binding, "", ""),
                sampler_type(sampler.comparison),
            );
            out += &format!("{layout}uniform {ty} {};\n", sampler.name);
        }
        out += &self.output_and_inputs(true);
        if let Some(binding) = r.uniform_binding() {
            let layout = match r.has_immediates() {
                true => "layout(push_constant) ".to_owned(),
                false => self.layout_qualifier(binding, "std140, ", ""),
            };
            out += &format!("\n{layout}uniform Parameters {{\n");
            for uniform in &r.uniforms {
                out += &format!("    {};\n", variable_declared(&uniform.name, uniform.ty.into()));
            }
            out += &format!("}} {UNIFORMS};\n");
        }
        if let Some(binding) = r.region_binding() {
            out += &format!(
                "\n{}uniform Region {{\n",
                self.layout_qualifier(binding, "std140, ", "")
            );
            out += &format!("    {}\n", r.region_comment());
            out += "    ivec2 first;\n    ivec2 size;\n    ivec2 place;\n";
            out += &format!("}} {REGION};\n");
        }
        if !r.read.is_empty() {
            out += &format!(
                "{}uniform sampler {SAMPLER};\n",
                self.layout_qualifier(r.sampler_binding(), "", "")
            );
        }
        out
    }
}
