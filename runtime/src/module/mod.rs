//! Shader modules: of WGSL, which wgpu checks, and of SPIR-V, which it hands to the driver as it is.

use crate::guard::run_guarded;
use crate::plan::{Loops, LoopsEnd, Plan};
use crate::{Error, PassOptions, Shader};
use wgpu::{Device, ShaderModule};

#[cfg(feature = "manifest")]
mod spirv;

/// Source of a shader module.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source<'a> {
    /// Text, without wgpu's bound on the trip counts of its loops if the loops are given.
    Wgsl {
        text: &'a str,
        unbounded_loops: Option<&'a Loops>,
    },
    /// Words that the caller of [`Pass::from_spirv`](crate::Pass::from_spirv) answers for.
    #[cfg(feature = "manifest")]
    Spirv(&'a [u32]),
}

impl<'a> Source<'a> {
    /// The text of a shader.
    pub(crate) fn from_shader(shader: &'a Shader<'_>, options: &PassOptions) -> Self {
        Source::Wgsl {
            text: shader.wgsl,
            unbounded_loops: options.unbounded_loops.then_some(&shader.loops),
        }
    }

    /// The module on a device.
    pub(crate) fn create_module(self, device: &Device, plan: &Plan) -> Result<ShaderModule, Error> {
        let kernel = &plan.kernel;
        let refused = |description| Error::Shader {
            kernel: kernel.to_string(),
            description,
        };
        let (text, unbounded_loops) = match self {
            Source::Wgsl { text, unbounded_loops } => (text, unbounded_loops),
            #[cfg(feature = "manifest")]
            Source::Spirv(words) => {
                return run_guarded(device, &format!("compiling `{kernel}`"), refused, || {
                    spirv::create_unchecked(device, plan, words)
                });
            }
        };
        let proof = match unbounded_loops {
            None => None,
            Some(Loops::End(proof)) => Some(*proof),
            Some(Loops::Unproven(problem)) => {
                return Err(Error::UnboundedLoop {
                    kernel: kernel.to_string(),
                    problem: problem.to_string(),
                });
            }
        };
        run_guarded(device, &format!("compiling `{kernel}`"), refused, || {
            let descriptor = wgpu::ShaderModuleDescriptor {
                label: Some(kernel),
                source: wgpu::ShaderSource::Wgsl(text.into()),
            };
            match proof {
                Some(proof) => without_bounds_on_loops(device, descriptor, proof),
                None => device.create_shader_module(descriptor),
            }
        })
    }
}

/// A module whose loops have no bound on their trip counts; all other checks stay.
///
/// wgpu calls this unsafe because a loop that never ends lets the driver's compiler do anything. `_proof` is of this text.
#[allow(unsafe_code)]
fn without_bounds_on_loops(
    device: &Device,
    descriptor: wgpu::ShaderModuleDescriptor<'_>,
    _proof: LoopsEnd,
) -> ShaderModule {
    let checks = wgpu::ShaderRuntimeChecks {
        force_loop_bounding: false,
        ..wgpu::ShaderRuntimeChecks::checked()
    };
    // SAFETY: only the check of loops is omitted, and each loop ends: a `Shader` holds a text and its proof together.
    unsafe { device.create_shader_module_trusted(descriptor, checks) }
}
