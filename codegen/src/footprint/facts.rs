//! Facts about the reads of one invocation: texels, weights and messages.

use std::fmt;

/// Texels that one invocation of a kernel reads, relative to its pixel, in the middle of a large frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Footprint {
    /// Width and height of the pixels: the block of an invocation, or the four of a quad.
    pub pixels: [u32; 2],
    /// `true` if each pixel is a lane of a quad.
    pub lanes: bool,
    /// Textures that are read, in the kernel's order.
    pub textures: Vec<TextureReads>,
    /// Messages between the lanes of a quad, by direction.
    pub messages: Vec<Messages>,
    /// Reads of buffers and of workgroup memory.
    pub memories: Vec<MemoryReads>,
    /// `true` if a weight holds only where a comparison or a clamp in the kernel keeps the value.
    pub tested: bool,
}

/// Reads of a texture, or of one of its levels.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureReads {
    /// Name in the kernel.
    pub texture: String,
    /// Level that is read, if it is constant.
    pub level: u32,
    /// Unit of the places of the taps.
    pub unit: Unit,
    /// Number of all reads of an invocation, or of the four lanes.
    pub reads: u32,
    /// Reads at a constant place, row by row.
    pub taps: Vec<Tap>,
    /// Reads at any other place, by cause.
    pub elsewhere: Vec<Elsewhere>,
    /// Texels that a workgroup reads in common, if it shares the texture.
    pub shared: Vec<SharedTexels>,
}

/// Unit of the places of a texture's taps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unit {
    /// Texels of the texture. A pixel is as wide as this number of texels.
    Texels(f64),
    /// Pixels of the frame: a position for a sampler, in a texture of another size.
    Pixels,
    /// Texels, relative to a place that depends on runtime values: only their distances are constant.
    Around(Causes),
}

/// A read at a constant place.
#[derive(Clone, Debug, PartialEq)]
pub struct Tap {
    /// Place relative to the upper left corner of the first pixel, or of the first tap's texel ([`Unit::Around`]), y down.
    /// A texel's middle lies at a half.
    pub at: [f64; 2],
    /// Way of reading.
    pub method: Method,
    /// Layer or sample, if the texture has several and the number is constant.
    pub layer: Option<u32>,
    /// Lane that reads, row by row; 0 without lanes.
    pub lane: u32,
    /// Number of reads of the texel.
    pub reads: u32,
    /// `true` if a runtime condition decides about the read.
    pub conditional: bool,
    /// By pixel, row by row: the weight of the tap in the pixel's colour, if it is constant. Of a gather, those of its
    /// four texels: lower left, lower right, upper right, upper left.
    pub weights: Vec<Option<Vec<f64>>>,
}

/// Way of reading a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Method {
    /// One texel.
    Load,
    /// By a sampler, filtered.
    Sample,
    /// Four texels at once.
    Gather,
    /// Filtered comparison with a reference.
    Compare,
    /// Comparison of four texels.
    GatherCompare,
}

impl Method {
    /// Name in `explain --json`.
    pub fn name(self) -> &'static str {
        match self {
            Method::Load => "load",
            Method::Sample => "sample",
            Method::Gather => "gather",
            Method::Compare => "compare",
            Method::GatherCompare => "gather-compare",
        }
    }

    /// Returns whether the four texels around the place are returned one by one.
    pub fn is_gather(self) -> bool {
        matches!(self, Method::Gather | Method::GatherCompare)
    }
}

/// Reads whose place is not constant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Elsewhere {
    /// Number of reads.
    pub reads: u32,
    /// Reason, as a phrase: `places that depend on uniforms`.
    pub place: String,
}

/// Texels in the memory of a workgroup.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SharedTexels {
    /// Layer or sample, if there are several.
    pub layer: Option<u32>,
    /// Offset of the upper left texel from the workgroup's first pixel.
    pub first: [i32; 2],
    /// Width and height in texels.
    pub size: [u32; 2],
    /// Width and height of the workgroup.
    pub workgroup: [u32; 2],
}

/// Messages of one direction, per lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Messages {
    /// 1 along each axis along which the other lane lies.
    pub direction: [u32; 2],
    /// Number of messages.
    pub messages: u32,
    /// Number of scalars in them.
    pub values: u32,
}

/// Reads of a buffer or of workgroup memory.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MemoryReads {
    /// Name in the kernel.
    pub name: String,
    /// `true` for memory of a workgroup.
    pub workgroup: bool,
    /// Number of reads.
    pub reads: u32,
}

/// Things that a value depends on, if it is not constant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Causes(u8);

impl Causes {
    /// Texels and other memory of the host.
    pub const READS: Causes = Causes(1);
    /// Uniforms.
    pub const UNIFORMS: Causes = Causes(2);
    /// Values interpolated by the rasteriser.
    pub const VARYINGS: Causes = Causes(4);
    /// Iterations of a loop left in the shader.
    pub const LOOPS: Causes = Causes(8);
    /// The pixel's or thread's position.
    pub const POSITION: Causes = Causes(16);
    /// Memory of a workgroup.
    pub const WORKGROUP: Causes = Causes(32);

    /// Returns the causes of both.
    pub fn with(self, other: Causes) -> Causes {
        Causes(self.0 | other.0)
    }
}

impl fmt::Display for Causes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = [
            (Causes::READS, "values that are read"),
            (Causes::UNIFORMS, "uniforms"),
            (Causes::VARYINGS, "interpolated values"),
            (Causes::LOOPS, "the iteration of a loop"),
            (Causes::POSITION, "the position in the frame"),
            (Causes::WORKGROUP, "workgroup memory"),
        ];
        // Almost every place depends on the position too.
        let named = if *self == Causes::POSITION {
            self.0
        } else {
            self.0 & !Causes::POSITION.0
        };
        let found = names.iter().filter(|(cause, _)| named & cause.0 != 0);
        let words: Vec<&str> = found.map(|(_, words)| *words).collect();
        match words[..] {
            [] => f.write_str("runtime values"),
            [one] => f.write_str(one),
            [ref first @ .., last] => write!(f, "{} and {last}", first.join(", ")),
        }
    }
}
