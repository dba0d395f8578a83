//! Whether a vertex shader gives what a kernel has interpolated.

use super::VertexShader;
use crate::error::{Error, Names};
use crate::guard::guarded;
use crate::plan::Plan;
use crate::reflect::{is_type, located};
use naga::{Binding, Interpolation, Sampling, ShaderStage};
use straightline_manifest::Varying;
use wgpu::{Device, ShaderModule};

/// The module of the vertex shader, whose text gives all varyings of `plan`.
pub(super) fn module(device: &Device, plan: &Plan, vertex: &VertexShader<'_>) -> Result<ShaderModule, Error> {
    let (text, entry_point) = match *vertex {
        VertexShader::Wgsl { text, entry_point } => (text, entry_point),
        VertexShader::Module { module, .. } => return Ok(module.clone()),
    };
    let refused = |description| Error::VertexShader {
        kernel: plan.kernel.clone(),
        description,
    };
    check(plan, text, entry_point)?;
    guarded(device, "compiling a vertex shader", refused, || {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry_point),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        })
    })
}

fn check(plan: &Plan, text: &str, entry_point: &str) -> Result<(), Error> {
    let refused = |description| Error::VertexShader {
        kernel: plan.kernel.clone(),
        description,
    };
    let module =
        naga::front::wgsl::parse_str(text).map_err(|error| refused(error.emit_to_string(text).trim().to_owned()))?;
    let vertex: Vec<_> = module
        .entry_points
        .iter()
        .filter(|entry| entry.stage == ShaderStage::Vertex)
        .collect();
    let Some(entry) = vertex.iter().find(|entry| entry.name == entry_point) else {
        let there: Names = vertex.iter().map(|entry| entry.name.as_str()).collect();
        return Err(refused(format!(
            "it has no entry point `{entry_point}` of stage vertex; of that stage it has {there}"
        )));
    };
    let result = entry.function.result.as_ref();
    let given = result.map_or_else(Vec::new, |result| located(&module, &result.binding, result.ty));
    for varying in &plan.varyings {
        let wrong = |problem: String| Error::Varying {
            kernel: plan.kernel.clone(),
            name: varying.name.clone(),
            location: varying.location,
            ty: varying.ty.to_string(),
            problem,
        };
        let Some((binding, ty)) = given
            .iter()
            .find(|(binding, _)| location(binding) == Some(varying.location))
        else {
            return Err(wrong(format!(
                "and `{entry_point}` gives nothing there: have it return `@location({}) {}: {}`",
                varying.location, varying.name, varying.ty
            )));
        };
        if !is_type(&module.types[*ty].inner, varying.ty) {
            return Err(wrong(format!(
                "and `{entry_point}` gives another type there: have it return `{}`",
                varying.ty
            )));
        }
        if let Binding::Location {
            interpolation,
            sampling,
            ..
        } = binding
            && (interpolation.unwrap_or(Interpolation::Perspective) != Interpolation::Perspective
                || sampling.unwrap_or(Sampling::Center) != Sampling::Center)
        {
            return Err(wrong(format!(
                "and `{entry_point}` has it interpolated otherwise than in perspective, at the pixel's centre: leave \
                 `@interpolate` out there"
            )));
        }
    }
    Ok(())
}

fn location(binding: &Binding) -> Option<u32> {
    match binding {
        Binding::Location { location, .. } => Some(*location),
        Binding::BuiltIn(_) => None,
    }
}

/// What wgpu said of a pipeline, and, where the vertex shader is a module that only wgpu has looked into, what the kernel takes.
pub(super) fn explained(error: Error, plan: &Plan, vertex: &VertexShader<'_>) -> Error {
    match (error, vertex) {
        (Error::Pipeline { kernel, description }, VertexShader::Module { .. }) if !plan.varyings.is_empty() => {
            let taken = |v: &Varying| format!("@location({}) {}: {}", v.location, v.name, v.ty);
            let all: Vec<String> = plan.varyings.iter().map(taken).collect();
            let all: Names = all.iter().map(String::as_str).collect();
            let description = format!("{description}; of the vertex shader it takes {all}");
            Error::Pipeline { kernel, description }
        }
        (error, _) => error,
    }
}
