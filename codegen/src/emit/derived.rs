//! Names in a text beyond the kernel's own.

use straightline_evaluator::ir::Op;

/// A texture with the sampler that reads it, combined in OpenGL. Texel loads and size queries have no sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Combined {
    /// The texture's index in the graph.
    pub texture: u32,
    /// The sampler's index in the graph.
    pub sampler: Option<u32>,
}

/// A derived name in a text. Numbers are indices in the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Derived {
    /// HLSL's function for a texture's size.
    Size(u32),
    /// HLSL's function for the number of a texture's levels.
    Levels(u32),
    /// HLSL's function for the number of a texture's layers.
    Layers(u32),
    /// HLSL's function for a buffer's length.
    Length(u32),
    /// HLSL's function for the output's size.
    OutputSize,
    /// GLSL's block of a buffer.
    Block(u32),
    /// OpenGL's combination of a texture and one of several samplers.
    Combined(Combined),
    /// WGSL's variable that holds the value of an override.
    Held(u32),
    /// A function of the host.
    Host(HostFunction),
}

/// Kind of read that a host function implements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum What {
    Load,
    Sample,
    Size,
}

impl What {
    /// Prefix of the function's name, before the texture's.
    fn name_prefix(self) -> &'static str {
        match self {
            What::Load => "load_",
            What::Sample => "sample_",
            What::Size => "size_of_",
        }
    }

    /// Description of the function's result, for a manifest.
    fn result_description(self) -> &'static str {
        match self {
            What::Load => "the texel at a pixel (two integers)",
            What::Sample => "the colour, filtered, at a place (two floats, 0 to 1), at the finest level",
            What::Size => "width and height in pixels (two integers)",
        }
    }
}

/// A function of the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HostFunction {
    /// Index of the texture in the graph.
    pub texture: u32,
    what: What,
}

impl HostFunction {
    /// Returns the function's default name.
    pub fn default_name(self, texture: &str) -> String {
        format!("{}{texture}", self.what.name_prefix())
    }

    /// Returns parameters and result in WGSL.
    pub fn signature(self) -> (&'static str, &'static str) {
        match self.what {
            What::Load => ("pixel: vec2i", "vec4f"),
            What::Sample => ("place: vec2f", "vec4f"),
            What::Size => ("", "vec2i"),
        }
    }

    /// Description of its result.
    pub fn result_description(self) -> &'static str {
        self.what.result_description()
    }

    /// Returns the host function that implements a read, if there is one.
    pub fn of_read(op: &Op) -> Option<HostFunction> {
        let (texture, what) = match op {
            Op::Load { texture, .. } => (*texture, What::Load),
            Op::Sample { texture, .. } => (*texture, What::Sample),
            Op::TextureSize(texture) => (*texture, What::Size),
            _ => return None,
        };
        Some(HostFunction { texture, what })
    }
}

/// Returns all host functions that a kernel calls, in a fixed order.
pub fn host_functions(ops: &[&Op], sized: Option<u32>) -> Vec<HostFunction> {
    let mut all: Vec<HostFunction> = ops.iter().filter_map(|op| HostFunction::of_read(op)).collect();
    all.extend(sized.map(|texture| HostFunction {
        texture,
        what: What::Size,
    }));
    all.sort();
    all.dedup();
    all
}
