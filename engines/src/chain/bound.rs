//! Everything that the caller of a chain binds, as the manifest of one kernel: engines are asked for it as for a kernel's.

use straightline_codegen::chain::{CompiledChain, CompiledPass, EmittedChain};
use straightline_manifest::Manifest;

/// Returns the inputs and uniforms of all passes under their names in the chain, and its results as outputs.
/// `None` of a chain without passes.
pub fn bound_manifest(compiled: &CompiledChain, emitted: &EmittedChain) -> Option<Manifest> {
    let manifest_of = |pass: &CompiledPass| &emitted.shaders[&pass.shader].emitted.manifest;
    let mut bound = manifest_of(compiled.passes.first()?).clone();
    bound.kernel.clone_from(&compiled.name);
    bound.language_bindings.clear();
    for manifest in compiled.passes.iter().map(manifest_of) {
        add_new(&mut bound.varyings, &manifest.varyings);
        add_new(&mut bound.features, &manifest.features);
    }
    bound.bindings = emitted.bindings();
    let results = compiled.results.iter().map(|index| &compiled.passes[*index]);
    bound.outputs = results
        .flat_map(|pass| manifest_of(pass).outputs.iter().cloned())
        .collect();
    Some(bound)
}

/// Appends what a list does not have yet.
fn add_new<T: Clone + PartialEq>(all: &mut Vec<T>, more: &[T]) {
    for item in more {
        if !all.contains(item) {
            all.push(item.clone());
        }
    }
}
