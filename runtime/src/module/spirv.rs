//! Modules of SPIR-V, which wgpu hands to the driver as it is.

use super::Source;
use crate::overrides::chosen_overrides;
use crate::pass::check_varyings;
use crate::plan::{OverridePlan, OverrideType, Plan};
use crate::travelling::read_plan;
use crate::{Error, Pass, PassOptions};
use straightline_manifest::Manifest;
use wgpu::{Device, ShaderModule};

/// Creates a module of unchecked words: the caller of [`Pass::from_spirv`] has promised that the manifest describes
/// them.
#[allow(unsafe_code)]
pub(super) fn create_unchecked(device: &Device, plan: &Plan, words: &[u32]) -> ShaderModule {
    let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
        label: Some(&plan.kernel),
        entry_points: vec![wgpu::PassthroughShaderEntryPoint {
            name: plan.entry_point.as_ref().into(),
            // Only Metal needs it.
            workgroup_size: (1, 1, 1),
        }]
        .into(),
        spirv: Some(words.into()),
        ..Default::default()
    };
    // SAFETY: a `Source::Spirv` is made by `Pass::from_spirv` only, whose caller answers for the words.
    unsafe { device.create_shader_module_passthrough(descriptor) }
}

/// Words with these values as the defaults of their specialization constants: wgpu does not specialize what it passes
/// on.
fn specialize(words: &[u32], overrides: &[(&OverridePlan, f64)]) -> Vec<u32> {
    const HEADER: usize = 5;
    let (spec_constant_true, spec_constant_false, spec_constant) = (48, 49, 50);
    let (decorate, spec_id) = (71, 1);
    let mut words = words.to_vec();
    let mut at = HEADER;
    let mut found: Vec<(u32, OverrideType, u32)> = Vec::new();
    while let Some(first) = words.get(at).copied() {
        let (length, opcode) = (((first >> 16) as usize).max(1), first & 0xffff);
        let Some(instruction) = words.get_mut(at..at + length) else {
            break;
        };
        match *instruction {
            [_, target, kind, id] if opcode == decorate && kind == spec_id => {
                let chosen = overrides.iter().find(|(of, _)| of.id == id);
                found.extend(chosen.map(|(of, value)| (target, of.ty, of.ty.bits(*value))));
            }
            [_, _, constant, ..] if (spec_constant_true..=spec_constant).contains(&opcode) => {
                if let Some((_, ty, bits)) = found.iter().find(|(target, ..)| *target == constant) {
                    let flag = [spec_constant_false, spec_constant_true][(*bits != 0) as usize];
                    match *ty {
                        OverrideType::Bool => instruction[0] = first & 0xffff_0000 | flag,
                        _ => instruction[3] = *bits,
                    }
                }
            }
            _ => {}
        }
        at += length;
    }
    words
}

impl Pass {
    /// A pass of SPIR-V, such as another compiler makes of a shader's GLSL or HLSL. It reaches the Vulkan driver as it
    /// is: wgpu neither checks it nor adds checks of its own, nor a bound on loops. The manifest's `entry_point` names
    /// the entry point of the words, which is `main` for a compiler of GLSL, and its bindings are all that they bind: a
    /// [`LanguageBinding`](straightline_manifest::LanguageBinding) is listed as an input like any other.
    ///
    /// Overrides of `options` replace the defaults of specialization constants with the same numbers.
    ///
    /// wgpu numbers what it binds for Vulkan from 0 in each group, so binding numbers must leave none out.
    ///
    /// # Errors
    ///
    /// [`Error::Pipeline`] if they do; [`Error::MissingFeature`] if the device was created without
    /// `PASSTHROUGH_SHADERS`; otherwise those of [`with_options`](Self::with_options) but for [`Error::Mismatch`] and
    /// [`Error::UnboundedLoop`].
    ///
    /// # Safety
    ///
    /// `words` must be a valid module for Vulkan with the manifest's entry point, stage, workgroup size and bindings.
    /// It must not read or write outside of what is bound, and each of its loops must end.
    #[allow(unsafe_code)]
    pub unsafe fn from_spirv(
        device: &Device,
        manifest: &Manifest,
        words: &[u32],
        options: &PassOptions,
    ) -> Result<Self, Error> {
        let plan = read_plan(manifest)?;
        check_varyings(&plan)?;
        if let Some((group, binding, free)) = plan.find_gap() {
            return Err(Error::Pipeline {
                kernel: plan.kernel.into_owned(),
                description: format!(
                    "it has a binding {binding} in group {group} and none {free}, and wgpu numbers what it binds for Vulkan from 0 \
                     without holes, which SPIR-V that it leaves as it is does not follow: generate the shader with numbers \
                     without holes, or make a pass of its WGSL"
                ),
            });
        }
        if !device.features().contains(wgpu::Features::PASSTHROUGH_SHADERS) {
            return Err(Error::MissingFeature {
                purpose: "a pass of SPIR-V",
                feature: "PASSTHROUGH_SHADERS",
            });
        }
        let words = specialize(words, &chosen_overrides(&plan, options)?);
        Self::from_plan(device, plan, Source::Spirv(&words), options)
    }
}
