//! Declarations in the GLSL of OpenGL and OpenGL ES: combined samplers, loose uniforms, precisions.

use super::glsl::{Glsl, LOOSE_REGION, image_type, sampler_of, variable_declared};
use crate::emit::Target;
use crate::emit::derived::Combined;

impl Glsl<'_> {
    /// Returns the types without a default precision in OpenGL ES.
    pub(super) fn opaque_types(&self) -> Vec<String> {
        let r = self.resources;
        let mut all: Vec<String> = Vec::new();
        for ty in r.combined.iter().map(|one| self.combined_type(*one)) {
            if !all.contains(&ty) {
                all.push(ty);
            }
        }
        // A fixed order, independent of the reads.
        all.sort_by_key(|ty| (ty.ends_with("Shadow"), ty.len(), ty.clone()));
        let writes = |ty: &&str| r.outputs.iter().any(|o| o.binding.is_some() && image_type(o) == *ty);
        let written = ["image2D", "iimage2D", "uimage2D"].into_iter().filter(writes);
        all.extend(written.map(str::to_owned));
        all
    }

    /// Returns the type of a combined sampler.
    pub(super) fn combined_type(&self, one: Combined) -> String {
        let r = self.resources;
        let compares = one.sampler.is_some_and(|s| r.sampler(s).comparison);
        sampler_of(r.texture(one.texture), compares)
    }

    /// Declares the bindings of OpenGL.
    pub(super) fn opengl_declarations(&self) -> String {
        let r = self.resources;
        let mut out = String::new();
        for one in &r.combined {
            let binding = r.texture_binding(one.texture).unwrap_or_default();
            let ty = self.combined_type(*one);
            let layout = match r.combined.iter().filter(|c| c.texture == one.texture).count() {
                1 => self.layout_qualifier(binding, "", ""),
                // Two samplers of one texture have two units, numbered by the host.
                _ => String::new(),
            };
            out += &format!("{layout}uniform {ty} {};\n", r.combined_name(*one));
        }
        out += &self.buffer_declarations();
        out += &self.output_and_inputs(matches!(self.target, Target::Glsl430 | Target::Essl310));
        if !r.uniforms.is_empty() {
            out.push('\n');
        }
        for uniform in &r.uniforms {
            out += &format!("uniform {};\n", variable_declared(&uniform.name, uniform.ty.into()));
        }
        if r.options.region {
            out += &format!("\n{}\n", r.region_comment());
            for (name, _) in LOOSE_REGION {
                out += &format!("uniform ivec2 {name};\n");
            }
        }
        out
    }
}
