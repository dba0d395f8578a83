//! What cannot be a function of a shader of the host's.

use super::error::EmitError;
use super::options::EmitOptions;
use super::resources::Resources;
use super::target::Target;
use crate::compiled::Compiled;

/// Whether a kernel can be a function in every language that is written.
///
/// # Errors
///
/// The first thing that cannot be, and what to do.
pub fn check(compiled: &Compiled, resources: &Resources) -> Result<(), EmitError> {
    let EmitOptions {
        targets,
        region,
        enable_subgroups,
        workgroup,
        ..
    } = &resources.options;
    let refused = |why: String| {
        Err(EmitError::Function {
            kernel: compiled.kernel.clone(),
            why,
        })
    };
    if *region {
        return refused("a function computes any position that it is called with: leave `region` out".to_owned());
    }
    if workgroup.is_some() {
        return refused("a function has no workgroup: leave `workgroup` out".to_owned());
    }
    if *enable_subgroups {
        return refused(
            "`enable subgroups;` stands before everything else: write it in the shader that the function is put into"
                .to_owned(),
        );
    }
    if let Some(whole) = [Target::Spirv, Target::Msl].into_iter().find(|t| targets.contains(t)) {
        return refused(format!(
            "{whole} is written as a whole shader: leave it out, or emit the form `entry`"
        ));
    }
    if let Some((buffer, _)) = resources.read_buffers.iter().find(|(k, _)| resources.is_written(*k)) {
        let name = &resources.buffer(*buffer).name;
        return refused(format!(
            "it writes to `{name}`, and a function only gives values: emit the form `entry`"
        ));
    }
    let takes_no_buffers = targets.iter().find(|t| **t != Target::Hlsl);
    if let (Some((buffer, _)), Some(target)) = (resources.read_buffers.first(), takes_no_buffers) {
        let name = &resources.buffer(*buffer).name;
        return refused(format!(
            "it reads the buffer `{name}`, which is no parameter in {target}: read a texture, write hlsl, or emit the form `entry`"
        ));
    }
    Ok(())
}
