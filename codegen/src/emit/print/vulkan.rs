//! What Vulkan's GLSL declares: separate textures and samplers in descriptor sets.

use super::glsl::{Glsl, declared, sampler_type, texture_type, type_name};
use crate::emit::resources::{OUTPUT, SAMPLER, UNIFORMS};
use straightline_manifest::REGION;

impl Glsl<'_> {
    /// What is bound in Vulkan.
    pub(super) fn of_vulkan(&self) -> String {
        let r = self.resources;
        let mut out = String::new();
        for bound in &r.read {
            let texture = r.texture(bound.index);
            let (layout, ty) = (self.layout(bound.binding, "", ""), texture_type(texture.kind));
            out += &format!("{layout}uniform {ty} {};\n", texture.name);
        }
        for (k, binding) in &r.read_buffers {
            let (name, element) = (&r.buffer(*k).name, type_name(r.buffer(*k).element.into()));
            let layout = self.layout(*binding, "std430, ", "");
            out += &format!("{layout}readonly buffer {name}_buffer {{ {element} elements[]; }} {name};\n");
        }
        for (k, binding) in &r.used_samplers {
            let sampler = r.sampler(*k);
            let (layout, ty) = (self.layout(*binding, "", ""), sampler_type(sampler.comparison));
            out += &format!("{layout}uniform {ty} {};\n", sampler.name);
        }
        match r.output_binding() {
            Some(binding) => {
                let layout = self.layout(binding, "", &format!(", {}", r.options.format.glsl()));
                out += &format!("{layout}uniform writeonly image2D {OUTPUT};\n");
            }
            None => {
                for (k, varying) in r.varyings.iter().enumerate() {
                    let declared = declared(&varying.name, varying.ty.into());
                    out += &format!("layout(location = {k}) in {declared};\n");
                }
                out += &format!("layout(location = 0) out vec4 {OUTPUT};\n");
            }
        }
        if let Some(binding) = r.uniform_binding() {
            out += &format!("\n{}uniform Parameters {{\n", self.layout(binding, "std140, ", ""));
            for uniform in &r.uniforms {
                out += &format!("    {};\n", declared(&uniform.name, uniform.ty.into()));
            }
            out += &format!("}} {UNIFORMS};\n");
        }
        if let Some(binding) = r.region_binding() {
            out += &format!("\n{}uniform Region {{\n", self.layout(binding, "std140, ", ""));
            out += &format!("    {}\n", r.region_comment());
            out += "    ivec2 first;\n    ivec2 size;\n    ivec2 place;\n";
            out += &format!("}} {REGION};\n");
        }
        if !r.read.is_empty() {
            out += &format!(
                "{}uniform sampler {SAMPLER};\n",
                self.layout(r.sampler_binding(), "", "")
            );
        }
        out
    }
}
