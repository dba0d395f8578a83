//! Heads of functions that take all their inputs as parameters, in every language that supports it: resources, the
//! position, interpolated values, uniforms.

use super::glsl::{self, Glsl};
use super::hlsl::{self, Hlsl, buffer_declared, sampler_declared, texture_declared};
use super::wgsl::{self, Wgsl};
use crate::emit::ast::Ty;
use crate::emit::own_words::SAMPLER;

impl Wgsl<'_> {
    /// Returns the head of a function that takes all its inputs as parameters.
    pub(super) fn kernel_function_head(&self) -> String {
        let r = self.resources;
        // A function that reads textures through the host's functions takes no textures.
        let calls_host = r.options.calls_host();
        let textures = r.read.iter().filter(|_| !calls_host).map(|bound| {
            let texture = r.texture(bound.index);
            format!("{}: {}", texture.name, wgsl::texture_type(texture))
        });
        let samplers = r.used_samplers.iter().filter(|_| !calls_host).map(|(k, _)| {
            let sampler = r.sampler(*k);
            format!("{}: {}", sampler.name, wgsl::sampler_type(sampler.comparison))
        });
        let varyings = r.manifest_varyings().map(|v| format!("{}: {}", v.name, v.ty));
        let uniforms = r
            .uniforms
            .iter()
            .map(|u| format!("{}: {}", u.name, Ty::from(u.ty).short_name()));
        let all = textures.chain(samplers).chain(["position: vec2f".to_owned()]);
        let all: Vec<String> = all.chain(varyings).chain(uniforms).collect();
        format!("fn {}({}) -> {} {{", r.entry, all.join(", "), self.result_type())
    }
}

impl Glsl<'_> {
    /// Returns the head of a function that takes all its inputs as parameters.
    pub(super) fn kernel_function_head(&self) -> String {
        let r = self.resources;
        let mut all = Vec::new();
        if r.options.calls_host() {
            // The host's functions read the textures.
        } else if self.is_vulkan() {
            for bound in &r.read {
                let texture = r.texture(bound.index);
                all.push(format!("{} {}", glsl::texture_type(texture), texture.name));
            }
            for (k, _) in &r.used_samplers {
                let sampler = r.sampler(*k);
                all.push(format!("{} {}", glsl::sampler_type(sampler.comparison), sampler.name));
            }
            if !r.read.is_empty() {
                all.push(format!("sampler {SAMPLER}"));
            }
        } else {
            for one in &r.combined {
                all.push(format!("{} {}", self.combined_type(*one), r.combined_name(*one)));
            }
        }
        all.push("vec2 position".to_owned());
        all.extend(r.varyings.iter().map(|v| glsl::variable_declared(&v.name, v.ty.into())));
        let uniforms = r.uniforms.iter().filter(|_| !r.options.global_uniforms);
        all.extend(uniforms.map(|u| glsl::variable_declared(&u.name, u.ty.into())));
        format!("{} {}({}) {{", self.result_type(), r.entry, all.join(", "))
    }
}

impl Hlsl<'_> {
    /// Returns the head of a function that takes all its inputs as parameters.
    pub(super) fn kernel_function_head(&self) -> String {
        let r = self.resources;
        let textures = r.read.iter().map(|bound| texture_declared(r, bound.index));
        let buffers = r.read_buffers.iter().map(|(k, _)| buffer_declared(r, *k));
        let samplers = r.used_samplers.iter().map(|(k, _)| sampler_declared(r, *k));
        let varyings = r.varyings.iter().map(|v| hlsl::variable_declared(&v.name, v.ty.into()));
        let uniforms = r.uniforms.iter().filter(|_| !r.options.global_uniforms);
        let uniforms = uniforms.map(|u| hlsl::variable_declared(&u.name, u.ty.into()));
        let bound = textures.chain(buffers).chain(samplers);
        // A function that reads textures through the host's functions takes no textures.
        let bound = bound.filter(|_| !r.options.calls_host());
        let all = bound
            .chain(["float2 position".to_owned()])
            .chain(varyings)
            .chain(uniforms);
        let all: Vec<String> = all.collect();
        format!("{} {}({}) {{", self.result_type(), r.entry, all.join(", "))
    }
}
