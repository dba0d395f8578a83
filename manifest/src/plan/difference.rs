//! Differences of two plans that keep one from taking the place of the other.

use super::{FieldPlan, Plan, StagePlan};

impl Plan {
    /// Returns the first difference in what a caller binds by name, such as ``input `mask` is new``: in inputs, targets,
    /// uniforms and their layout, and the rectangle of regions. Binding numbers and defaults of uniforms may differ.
    pub fn find_interface_difference(&self, other: &Plan) -> Option<String> {
        find_difference(&list_bindings(self, false), &list_bindings(other, false))
    }

    /// Returns the first difference that keeps what is bound to this plan's shader from running with the other's. Beside the
    /// interface, binding numbers, stage and workgroup count.
    pub fn find_layout_difference(&self, other: &Plan) -> Option<String> {
        let shape = |plan: &Plan| match plan.stage {
            StagePlan::Compute { workgroup, .. } => Some((workgroup, plan.block)),
            StagePlan::Fragment => None,
        };
        let bound = find_difference(&list_bindings(self, true), &list_bindings(other, true));
        bound.or_else(|| (shape(self) != shape(other)).then(|| "its stage or workgroup is another one".to_owned()))
    }
}

/// Name of something that is bound, and all that a caller depends on.
type Bound = (String, String);

fn find_difference(before: &[Bound], after: &[Bound]) -> Option<String> {
    let is_in = |all: &[Bound], name: &str| all.iter().any(|(other, _)| other == name);
    // A name that comes or goes moves others, so it is the cause.
    if let Some((name, _)) = before.iter().find(|(name, _)| !is_in(after, name)) {
        return Some(format!("{name} is no longer there"));
    }
    if let Some((name, _)) = after.iter().find(|(name, _)| !is_in(before, name)) {
        return Some(format!("{name} is new"));
    }
    let changed = before.iter().find(|bound| !after.contains(bound));
    changed.map(|(name, _)| format!("{name} has another type, place or format"))
}

/// Lists everything that is bound by its name, with or without its place.
fn list_bindings(plan: &Plan, places: bool) -> Vec<Bound> {
    let inputs = plan.inputs.iter().map(|input| {
        let text = format!("{:?} {:?}", input.kind, places.then_some((input.group, input.binding)));
        (format!("input `{}`", input.name), text)
    });
    let outputs = plan.outputs.iter().map(|output| {
        let text = format!(
            "{:?} {:?}",
            output.format,
            places.then_some((output.place, output.tile))
        );
        (format!("target `{}`", output.name), text)
    });
    let uniforms = plan.uniforms.iter().flat_map(|uniform| {
        uniform.fields.iter().map(move |field| {
            let bare = FieldPlan {
                default: None,
                ..field.clone()
            };
            let text = format!("{:?} {} {bare:?}", uniform.place.filter(|_| places), uniform.size);
            (format!("uniform `{}`", field.source_name()), text)
        })
    });
    let region = plan.region.iter().map(|region| {
        let text = format!(
            "{:?} {} {:?}",
            region.place.filter(|_| places),
            region.size,
            region.fields
        );
        ("the rectangle of regions".to_owned(), text)
    });
    inputs.chain(outputs).chain(uniforms).chain(region).collect()
}
