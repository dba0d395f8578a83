//! Differences of two plans that keep a bound pass from taking the other's pipeline.

use crate::plan::{FieldPlan, Plan, StagePlan};

/// Returns the first difference in bindings, stage or workgroup, such as ``input `mask` is new``. Defaults of uniforms may
/// differ.
pub(super) fn find_change(old: &Plan, new: &Plan) -> Option<String> {
    let [before, after] = [old, new].map(list_bindings);
    let find = |all: &[(String, String)], name: &str| all.iter().position(|(other, _)| other == name);
    // A name that comes or goes moves others, so it is the cause.
    if let Some((name, _)) = before.iter().find(|(name, _)| find(&after, name).is_none()) {
        return Some(format!("{name} is no longer there"));
    }
    if let Some((name, _)) = after.iter().find(|(name, _)| find(&before, name).is_none()) {
        return Some(format!("{name} is new"));
    }
    if let Some((name, _)) = before.iter().find(|binding| !after.contains(binding)) {
        return Some(format!("{name} has another type, place or format"));
    }
    let shape = |plan: &Plan| match plan.stage {
        StagePlan::Compute { workgroup, .. } => Some((workgroup, plan.block)),
        StagePlan::Fragment => None,
    };
    (shape(old) != shape(new)).then(|| "its stage or workgroup is another one".to_owned())
}

/// Everything that is bound by its name, with all that a bind group depends on.
fn list_bindings(plan: &Plan) -> Vec<(String, String)> {
    let inputs = plan.inputs.iter();
    let inputs = inputs.map(|input| (format!("input `{}`", input.name), format!("{input:?}")));
    let outputs = plan.outputs.iter();
    let outputs = outputs.map(|output| (format!("target `{}`", output.name), format!("{output:?}")));
    let structs = plan.uniforms.iter();
    let uniforms = structs.flat_map(|uniform| {
        uniform.fields.iter().map(move |field| {
            let place = (uniform.group, uniform.binding, uniform.size);
            let bare = FieldPlan {
                default: None,
                ..field.clone()
            };
            (
                format!("uniform `{}`", field.source_name()),
                format!("{place:?} {bare:?}"),
            )
        })
    });
    let region = plan.region.iter();
    let region = region.map(|region| ("the rectangle of regions".to_owned(), format!("{region:?}")));
    inputs.chain(outputs).chain(uniforms).chain(region).collect()
}
