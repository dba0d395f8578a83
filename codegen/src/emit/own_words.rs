//! Names in the text around a kernel: bindings beyond the kernel's own inputs, and the entry point's variables.

use straightline_manifest::REGION;

/// Name of the uniform buffer.
pub const UNIFORMS: &str = "parameters";
/// Name of the sampler that GLSL needs to refer to a texture; never used for filtering.
pub const SAMPLER: &str = "unfiltered";
/// Name of the output of a kernel with a single value.
pub const OUTPUT: &str = straightline_evaluator::ir::OutputTarget::DEFAULT_NAME;
/// Name of the uniform that holds the frame's size.
pub const RESOLUTION: &str = "resolution";
/// Prefix for an output with the name of an input, in lists of both: `output.depth`.
pub const OF_OUTPUT: &str = "output.";
/// Name of the structure of several outputs.
pub const OUTPUTS: &str = "Outputs";

/// Prefix of the macro that sets an override: `OVERRIDE_TAU`.
pub const DEFINE: &str = "OVERRIDE_";

/// Names used by the text around a kernel's body.
pub const OWN: [&str; 11] = [
    UNIFORMS,
    SAMPLER,
    REGION,
    "Parameters",
    "Region",
    OUTPUTS,
    "main",
    "frame",
    "pixel",
    "id",
    "position",
];

/// Additional names in shaders that filter a rectangle, or write to another row than their pixel's.
pub const OF_REGIONS: [&str; 2] = ["within", "place"];

/// Additional names in shaders with explicit workgroups.
pub const OF_GROUPS: [&str; 3] = ["local_id", "group_id", "local_index"];

/// The variable that holds several outputs in HLSL.
pub const VARIABLE: &str = "outputs";

/// Returns whether the text around a kernel uses a name.
pub fn is_own(name: &str) -> bool {
    name == OUTPUT || OWN.contains(&name) || OF_REGIONS.contains(&name) || OF_GROUPS.contains(&name)
}
