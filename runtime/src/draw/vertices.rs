//! The module of a vertex shader, which outputs a kernel's interpolated values.

use super::VertexShader;
use crate::error::{Error, Names};
use crate::guard::run_guarded;
use crate::plan::Plan;
use straightline_manifest::plan::VaryingPlan;
use wgpu::{Device, ShaderModule};

/// Creates the module of the vertex shader, whose text must output all varyings of `plan`.
pub(super) fn vertex_module(device: &Device, plan: &Plan, vertex: &VertexShader<'_>) -> Result<ShaderModule, Error> {
    let (text, entry_point) = match *vertex {
        VertexShader::Wgsl { text, entry_point } => (text, entry_point),
        VertexShader::Module { module, .. } => return Ok(module.clone()),
    };
    let refused = |description| Error::VertexShader {
        kernel: plan.kernel.to_string(),
        description,
    };
    #[cfg(feature = "manifest")]
    check_text(plan, text, entry_point)?;
    run_guarded(device, "compiling a vertex shader", refused, || {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry_point),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        })
    })
}

/// Reports what the vertex shader lacks, before wgpu does.
#[cfg(feature = "manifest")]
fn check_text(plan: &Plan, text: &str, entry_point: &str) -> Result<(), Error> {
    use straightline_reflect::VertexProblem;
    let refused = |description| Error::VertexShader {
        kernel: plan.kernel.to_string(),
        description,
    };
    straightline_reflect::check_vertices(plan, text, entry_point).map_err(|problem| match problem {
        VertexProblem::Refused(description) => refused(description),
        VertexProblem::NoEntryPoint { there } => refused(format!(
            "it has no entry point `{entry_point}` of stage vertex; of that stage it has {}",
            Names(there)
        )),
        VertexProblem::Varying { varying, problem } => Error::Varying {
            kernel: plan.kernel.to_string(),
            name: varying.name.into_owned(),
            location: varying.location,
            ty: varying.ty.to_string(),
            problem,
        },
    })
}

/// Returns an error of a pipeline. If only wgpu has inspected the vertex shader, the error lists the kernel's varyings.
pub(super) fn explain_error(error: Error, plan: &Plan, vertex: &VertexShader<'_>) -> Error {
    let checked = cfg!(feature = "manifest") && matches!(vertex, VertexShader::Wgsl { .. });
    match error {
        Error::Pipeline { kernel, description } if !checked && !plan.varyings.is_empty() => {
            let taken = |v: &VaryingPlan| format!("@location({}) {}: {}", v.location, v.name, v.ty);
            let all: Vec<String> = plan.varyings.iter().map(taken).collect();
            let all: Names = all.iter().map(String::as_str).collect();
            let description = format!("{description}; of the vertex shader it takes {all}");
            Error::Pipeline { kernel, description }
        }
        error => error,
    }
}
