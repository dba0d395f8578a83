//! Values of inputs as a pass takes them: uniforms, and overrides of its pipeline.

use super::{convert, find_entry};
use straightline_manifest::{Binding, BindingKind, Immediates, Manifest, OverrideType};
use straightline_runtime::{PassOptions, UniformValue};
use straightline_scene::inputs::Inputs;

/// Options of a pass with the values that `inputs` have for the overrides of a shader, among the uniforms.
pub fn override_options(manifest: &Manifest, inputs: &Inputs) -> PassOptions {
    manifest.overrides.iter().fold(PassOptions::default(), |options, of| {
        let value = find_entry(&inputs.uniforms, &of.name).and_then(|numbers| numbers.first().copied());
        match (value, of.ty) {
            (None, _) => options,
            (Some(value), OverrideType::F32) => options.override_option(&of.name, value as f32),
            (Some(value), OverrideType::I32) => options.override_option(&of.name, value as i32),
            (Some(value), OverrideType::U32) => options.override_option(&of.name, value as u32),
            (Some(value), OverrideType::Bool) => options.override_option(&of.name, value != 0.0),
        }
    })
}

/// The uniforms of a shader that `inputs` say; of the region's none, which is stated with each that is bound.
pub fn uniform_values(
    bindings: &[Binding],
    immediates: Option<&Immediates>,
    inputs: &Inputs,
) -> Vec<(String, UniformValue)> {
    let mut uniforms = Vec::new();
    let bound = bindings.iter().filter(|binding| !binding.is_region());
    let bound = bound.filter_map(|binding| match &binding.kind {
        BindingKind::Uniform { fields, .. } => Some(fields),
        _ => None,
    });
    for field in bound.chain(immediates.map(|immediates| &immediates.fields)).flatten() {
        if field.frame_size {
            uniforms.push((field.name.clone(), UniformValue::from(inputs.size.to_array())));
        } else if let Some(numbers) = find_entry(&inputs.uniforms, &field.name) {
            uniforms.push((field.name.clone(), convert::uniform_value(field.ty, numbers)));
        }
    }
    uniforms
}
