//! Limits of shaders emitted as functions for a host's shader.

use super::refusal::Refusal;
use super::resources::Resources;
use crate::compiled::Compiled;
use crate::spec::{EmitOptions, Target};

/// Checks that a kernel can be a function in every requested language.
///
/// # Errors
///
/// The first obstacle, with its remedy.
pub fn check_function_form(compiled: &Compiled, resources: &Resources) -> Result<(), Refusal> {
    let EmitOptions {
        targets,
        region,
        enable_subgroups,
        workgroup,
        ..
    } = &resources.options;
    let refused = |why: &str, help: &str| Refusal::no_function_form(&compiled.kernel, why, help);
    if *region {
        return Err(refused(
            "it computes any position that it is called with",
            "leave `region` out",
        ));
    }
    if workgroup.is_some() {
        return Err(refused("a function has no workgroup", "leave `workgroup` out"));
    }
    if *enable_subgroups {
        return Err(refused(
            "`enable subgroups;` stands before everything else",
            "write it in the shader that the function is put into",
        ));
    }
    if let Some(whole) = [Target::Spirv, Target::Msl].into_iter().find(|t| targets.contains(t)) {
        return Err(refused(
            &format!("{whole} is written as a whole shader"),
            "leave it out, or emit the form `entry`",
        ));
    }
    if let Some((buffer, _)) = resources.read_buffers.iter().find(|(k, _)| resources.is_written(*k)) {
        let name = &resources.buffer(*buffer).name;
        let why = format!("it writes to `{name}`, and a function only gives values");
        return Err(refused(&why, "emit the form `entry`").about_input(name));
    }
    let takes_no_buffers = targets.iter().find(|t| **t != Target::Hlsl);
    if let (Some((buffer, _)), Some(target)) = (resources.read_buffers.first(), takes_no_buffers) {
        let name = &resources.buffer(*buffer).name;
        let why = format!("it reads the buffer `{name}`, which is no parameter in {target}");
        return Err(refused(&why, "read a texture, write hlsl, or emit the form `entry`").about_input(name));
    }
    Ok(())
}
