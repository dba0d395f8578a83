//! Shader modules: of WGSL, which wgpu checks, and of SPIR-V, which it hands to the driver as it is.

use crate::guard::guarded;
use crate::pass::check_varyings;
use crate::plan::Plan;
use crate::{Error, Pass, PassOptions, loops};
use straightline_manifest::Manifest;
use wgpu::{Device, ShaderModule};

/// What a shader module is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source<'a> {
    /// Text, with or without wgpu's bound on the trip counts of its loops.
    Wgsl { text: &'a str, unbounded_loops: bool },
    /// Words that the caller of [`Pass::from_spirv`] answers for.
    Spirv(&'a [u32]),
}

impl Source<'_> {
    /// The module on a device.
    pub(crate) fn module(self, device: &Device, plan: &Plan) -> Result<ShaderModule, Error> {
        let kernel = &plan.kernel;
        if let Source::Wgsl {
            text,
            unbounded_loops: true,
        } = self
        {
            loops::check(text).map_err(|problem| Error::UnboundedLoop {
                kernel: kernel.clone(),
                problem,
            })?;
        }
        let refused = |description| Error::Shader {
            kernel: kernel.clone(),
            description,
        };
        guarded(device, &format!("compiling `{kernel}`"), refused, || match self {
            Source::Wgsl { text, unbounded_loops } => {
                let descriptor = wgpu::ShaderModuleDescriptor {
                    label: Some(kernel),
                    source: wgpu::ShaderSource::Wgsl(text.into()),
                };
                match unbounded_loops {
                    true => without_bounds_on_loops(device, descriptor),
                    false => device.create_shader_module(descriptor),
                }
            }
            Source::Spirv(words) => unchecked(device, plan, words),
        })
    }
}

/// A module whose loops have no bound on their trip counts; all other checks stay.
///
/// wgpu calls this unsafe because a loop that never ends lets the driver's compiler do anything. [`loops::check`] has
/// shown of this text that each of its loops ends.
#[allow(unsafe_code)]
fn without_bounds_on_loops(device: &Device, descriptor: wgpu::ShaderModuleDescriptor<'_>) -> ShaderModule {
    let checks = wgpu::ShaderRuntimeChecks {
        force_loop_bounding: false,
        ..wgpu::ShaderRuntimeChecks::checked()
    };
    // SAFETY: the only check that is left out is that of loops, and the caller has had `loops::check` pass the text.
    unsafe { device.create_shader_module_trusted(descriptor, checks) }
}

/// A module of words that nothing checks: the caller of [`Pass::from_spirv`] has promised that they are what the manifest
/// describes.
#[allow(unsafe_code)]
fn unchecked(device: &Device, plan: &Plan, words: &[u32]) -> ShaderModule {
    let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
        label: Some(plan.kernel.as_str()),
        entry_points: vec![wgpu::PassthroughShaderEntryPoint {
            name: plan.entry_point.as_str().into(),
            // Only Metal asks for it.
            workgroup_size: (1, 1, 1),
        }]
        .into(),
        spirv: Some(words.into()),
        ..Default::default()
    };
    // SAFETY: a `Source::Spirv` is made by `Pass::from_spirv` only, whose caller answers for the words.
    unsafe { device.create_shader_module_passthrough(descriptor) }
}

impl Pass {
    /// A pass of SPIR-V, such as another compiler makes of a shader's GLSL or HLSL. It reaches the Vulkan driver as it is:
    /// wgpu neither checks it nor adds checks of its own, nor a bound on loops. The manifest's `entry_point` names the
    /// entry point of the words, which is `main` for a compiler of GLSL, and its bindings are all that they bind: a
    /// [`LanguageBinding`](straightline_manifest::LanguageBinding) is listed as an input like any other.
    ///
    /// wgpu numbers what it binds for Vulkan from 0 in each group, so binding numbers must leave none out.
    ///
    /// # Errors
    ///
    /// [`Error::Pipeline`] if they do; [`Error::MissingFeature`] if the device was created without `PASSTHROUGH_SHADERS`; otherwise those of
    /// [`with_options`](Self::with_options) but for [`Error::Mismatch`] and [`Error::UnboundedLoop`].
    ///
    /// # Safety
    ///
    /// `words` must be a valid module for Vulkan with the manifest's entry point, stage, workgroup size and bindings. It must
    /// not read or write outside of what is bound, and each of its loops must end.
    #[allow(unsafe_code)]
    pub unsafe fn from_spirv(
        device: &Device,
        manifest: &Manifest,
        words: &[u32],
        options: &PassOptions,
    ) -> Result<Self, Error> {
        let plan = Plan::new(manifest)?;
        check_varyings(&plan)?;
        if let Some((group, binding, free)) = plan.hole() {
            return Err(Error::Pipeline {
                kernel: plan.kernel,
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
        Self::made(device, manifest, plan, Source::Spirv(words), options)
    }
}
