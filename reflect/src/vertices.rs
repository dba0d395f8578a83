//! Checks that a vertex shader returns everything that a kernel has interpolated.

use crate::parse;
use crate::plan::{is_type, located_members};
use naga::{Binding, Interpolation, Sampling, ShaderStage};
use straightline_manifest::plan::{Plan, VaryingPlan};

/// Reason why a vertex shader cannot be combined with a kernel.
#[derive(Clone, Debug, PartialEq)]
pub enum VertexProblem {
    /// The text does not parse.
    Refused(String),
    /// The text has no entry point of that name and of stage vertex.
    NoEntryPoint {
        /// Names of those of stage vertex.
        there: Vec<String>,
    },
    /// The entry point does not return a varying, or returns it otherwise.
    Varying {
        /// The varying.
        varying: VaryingPlan,
        /// Description of the output there, and of the one needed.
        problem: String,
    },
}

/// Checks that `entry_point` of the WGSL `text` returns each varying of `plan` at its location, of its type, interpolated in
/// perspective.
///
/// # Errors
///
/// The first problem.
pub fn check_vertices(plan: &Plan, text: &str, entry_point: &str) -> Result<(), VertexProblem> {
    let module = parse(text).map_err(VertexProblem::Refused)?;
    let vertex: Vec<_> = module
        .entry_points
        .iter()
        .filter(|entry| entry.stage == ShaderStage::Vertex)
        .collect();
    let Some(entry) = vertex.iter().find(|entry| entry.name == entry_point) else {
        return Err(VertexProblem::NoEntryPoint {
            there: vertex.iter().map(|entry| entry.name.clone()).collect(),
        });
    };
    let result = entry.function.result.as_ref();
    let given = result.map_or_else(Vec::new, |result| located_members(&module, &result.binding, result.ty));
    for varying in plan.varyings.iter() {
        let wrong = |problem: String| VertexProblem::Varying {
            varying: varying.clone(),
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
