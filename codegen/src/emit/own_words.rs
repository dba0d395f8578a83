//! Words of the text around a kernel: what is bound beside the kernel's own inputs, and what the entry point declares.

use straightline_manifest::REGION;

/// Name of the uniform buffer.
pub const UNIFORMS: &str = "parameters";
/// Name of the sampler that GLSL needs to name a texture; no filtering is ever asked of it.
pub const SAMPLER: &str = "unfiltered";
/// Name of what is written by a kernel that gives one value.
pub const OUTPUT: &str = straightline_evaluator::ir::Target::DEFAULT_NAME;
/// Mark before the name of an output that has the name of an input, where one list has both: `output.depth`.
pub const OF_OUTPUT: &str = "output.";
/// Name of the structure of several outputs.
pub const OUTPUTS: &str = "Outputs";

/// Names that the text around a kernel's body has uses for.
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

/// Names that it has uses for where the shader filters a rectangle, or writes another row than that of its pixel.
pub const OF_REGIONS: [&str; 2] = ["within", "place"];

/// Names that it has uses for where invocations are those of a workgroup.
pub const OF_GROUPS: [&str; 3] = ["local_id", "group_id", "local_index"];

/// The variable that holds several outputs in HLSL.
pub const VARIABLE: &str = "outputs";

/// True if the text around a kernel has a use for a name.
pub fn is_own(name: &str) -> bool {
    name == OUTPUT || OWN.contains(&name) || OF_REGIONS.contains(&name) || OF_GROUPS.contains(&name)
}
