//! What GLSL of OpenGL and OpenGL ES declares: combined samplers, loose uniforms, precisions.

use super::glsl::{Glsl, LOOSE_REGION, declared, image_type, loose, plain_sampler};
use crate::emit::Target;
use crate::emit::resources::Combined;
use crate::ir::TextureKind;

impl Glsl<'_> {
    /// Types that have no precision of their own in OpenGL ES.
    pub(super) fn opaque(&self) -> Vec<&'static str> {
        let r = self.resources;
        let writes = |ty: &str| r.outputs.iter().any(|o| o.binding.is_some() && image_type(o) == ty);
        let kinds = |kind: TextureKind| r.combined.iter().any(|one| r.texture(one.texture).kind == kind);
        let compares = r
            .combined
            .iter()
            .any(|one| one.sampler.is_some_and(|s| r.sampler(s).comparison));
        let all = [
            (kinds(TextureKind::Flat) || kinds(TextureKind::Depth), "sampler2D"),
            (kinds(TextureKind::Layers), "sampler2DArray"),
            (kinds(TextureKind::Multisampled), "sampler2DMS"),
            (compares, "sampler2DShadow"),
            (writes("image2D"), "image2D"),
            (writes("iimage2D"), "iimage2D"),
            (writes("uimage2D"), "uimage2D"),
        ];
        all.into_iter().filter(|(used, _)| *used).map(|(_, ty)| ty).collect()
    }

    /// The type of a combined sampler.
    pub(super) fn combined_type(&self, one: Combined) -> &'static str {
        let r = self.resources;
        match one.sampler.is_some_and(|s| r.sampler(s).comparison) {
            true => "sampler2DShadow",
            false => plain_sampler(r.texture(one.texture).kind),
        }
    }

    /// What is bound in OpenGL.
    pub(super) fn opengl(&self) -> String {
        let r = self.resources;
        let mut out = String::new();
        for one in &r.combined {
            let binding = r.texture_binding(one.texture).unwrap_or_default();
            let ty = self.combined_type(*one);
            let layout = match r.combined.iter().filter(|c| c.texture == one.texture).count() {
                1 => self.layout(binding, "", ""),
                // Two samplers of one texture have two units, which the host numbers.
                _ => String::new(),
            };
            out += &format!("{layout}uniform {ty} {};\n", r.combined_name(*one));
        }
        out += &self.buffers();
        out += &self.output_and_inputs(matches!(self.target, Target::Glsl430 | Target::Essl310));
        if !r.uniforms.is_empty() {
            out.push('\n');
        }
        for uniform in &r.uniforms {
            out += &format!("uniform {};\n", declared(&loose(&uniform.name), uniform.ty.into()));
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
