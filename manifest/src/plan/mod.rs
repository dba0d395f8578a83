//! The plan of one shader: everything that a pass binds, and where.
//!
//! A plan is made of constants, which the generator writes into the Rust of a `build.rs`, or of a manifest that was read
//! (the feature `json`). Both are the same type, and the same plan for the same shader.

#[cfg(feature = "json")]
mod binding;
mod difference;
#[cfg(feature = "json")]
mod read;

use crate::{Dimension, Extent, Format, OverrideType, SampleType, SamplerType, ValueType};
use std::borrow::Cow;

#[cfg(feature = "json")]
pub use read::Contradiction;

/// Text of a plan: a constant, or owned by one that was read.
pub type Text = Cow<'static, str>;

/// Items of a plan: a constant, or owned by one that was read.
pub type List<T> = Cow<'static, [T]>;

/// Everything that a pass binds, and where. The generator, or `Plan::from_manifest`, has checked every number in it, except
/// against a device.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The kernel's name.
    pub kernel: Text,
    /// Name of the entry point.
    pub entry_point: Text,
    /// The stage.
    pub stage: StagePlan,
    /// Pixels that one invocation computes, across and down.
    pub block: [u32; 2],
    /// Features of the device, by name: `subgroup`, `shader-f16`, `immediates`.
    pub features: List<Text>,
    /// Resources of the caller, in binding order.
    pub inputs: List<InputPlan>,
    /// Values that are set at run time, in binding order.
    pub uniforms: List<UniformPlan>,
    /// The rectangle, of a shader that filters one.
    pub region: Option<UniformPlan>,
    /// Options that the host sets when it creates the pipeline.
    pub overrides: List<OverridePlan>,
    /// Interpolated values; of a fragment shader only.
    pub varyings: List<VaryingPlan>,
    /// In the order of their locations.
    pub outputs: List<OutputPlan>,
}

/// A resource that the caller binds by name.
#[derive(Clone, Debug, PartialEq)]
pub struct InputPlan {
    /// Name in the kernel's source.
    pub name: Text,
    /// Bind group.
    pub group: u32,
    /// Binding number in the group.
    pub binding: u32,
    /// Kind of resource, with all that it must have.
    pub kind: InputKind,
}

/// Kind of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputKind {
    /// A texture view.
    Texture(TexturePlan),
    /// A sampler.
    Sampler(SamplerType),
    /// A storage buffer.
    Buffer(BufferPlan),
}

/// A texture that the shader reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexturePlan {
    /// Shape of the view.
    pub dimension: Dimension,
    /// Kind of read, which decides the formats that fit.
    pub sample_type: SampleType,
    /// Components that the kernel uses, 1 to 4.
    pub components: u8,
    /// Layers that the shader can address.
    pub layers: u32,
    /// Samples of a texel that the shader can address.
    pub samples: u32,
    /// Size that it must have.
    pub extent: Extent,
}

/// A storage buffer that the shader reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BufferPlan {
    /// Type of an element; none of structures, which are known by their size.
    pub element: Option<ValueType>,
    /// Bytes from one element to the next.
    pub stride: u32,
    /// The shader writes to it.
    pub written: bool,
}

/// A uniform struct.
#[derive(Clone, Debug, PartialEq)]
pub struct UniformPlan {
    /// Name of the variable.
    pub name: Text,
    /// Bind group and binding number of a buffer; immediates have none.
    pub place: Option<(u32, u32)>,
    /// Bytes of the buffer or of the immediates.
    pub size: u32,
    /// Fields in order of offset.
    pub fields: List<FieldPlan>,
}

/// A field of a uniform struct.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldPlan {
    /// Name in the kernel's source, or one that the generator has given to a part.
    pub name: Text,
    /// A number or a vector.
    pub ty: ValueType,
    /// Byte offset in the buffer.
    pub offset: u32,
    /// Bits of the default of a number, little-endian.
    pub default: Option<[u8; 4]>,
    /// The matrix or array that it is a part of.
    pub part: Option<PartPlan>,
    /// `true` if the field holds the width and height of the frame.
    pub frame_size: bool,
}

impl FieldPlan {
    /// Returns the value's name in the kernel's source; for a part, the name of the whole.
    pub fn source_name(&self) -> &str {
        self.part.as_ref().map_or(&self.name, |part| &part.of)
    }
}

/// An option that the host sets when it creates the pipeline.
#[derive(Clone, Debug, PartialEq)]
pub struct OverridePlan {
    /// Name in the kernel's source.
    pub name: Text,
    /// Number in the shader.
    pub id: u32,
    /// Type.
    pub ty: OverrideType,
    /// Value unless the host sets one; of a boolean 0 or 1.
    pub default: f64,
    /// Smallest and largest value that the kernel allows, if it states them.
    pub range: Option<[f64; 2]>,
}

/// A column of a matrix, or an element of an array.
#[derive(Clone, Debug, PartialEq)]
pub struct PartPlan {
    /// Name of the whole in the kernel's source.
    pub of: Text,
    /// Type of the whole.
    pub ty: ValueType,
    /// Index of the part, from 0.
    pub index: u32,
}

/// The stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StagePlan {
    /// Compute, with the invocations of a workgroup.
    Compute {
        /// Invocations across, down and in depth, which is 1.
        workgroup: [u32; 3],
        /// `true` if every element of workgroup memory is written before it is read, so that it need not be 0 at first.
        fills_memory: bool,
    },
    /// Fragment.
    Fragment,
}

/// A value that is interpolated for each fragment.
#[derive(Clone, Debug, PartialEq)]
pub struct VaryingPlan {
    /// Name in the kernel's source.
    pub name: Text,
    /// A float or a vector of floats.
    pub ty: ValueType,
    /// Location of the fragment's input.
    pub location: u32,
}

/// Target of a result.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputPlan {
    /// Name of the target.
    pub name: Text,
    /// Group and binding number of a storage texture; of a colour attachment there are none.
    pub place: Option<(u32, u32)>,
    /// Format that the shader was generated for.
    pub format: Format,
    /// Width and height of the texels that a workgroup writes, of an output with a size of its own.
    pub tile: Option<[u32; 2]>,
}

/// Returns the workgroups that a dispatch needs for outputs of which each has a tile and a size, across and down: those of the
/// output that needs most. `None` if an output has no tile, or if there is none.
pub fn workgroups_of_tiles(outputs: impl IntoIterator<Item = (Option<[u32; 2]>, [u32; 2])>) -> Option<[u32; 2]> {
    let mut most = None;
    for (tile, size) in outputs {
        let (tile, before) = (tile?, most.unwrap_or([1, 1]));
        most = Some([0, 1].map(|axis: usize| size[axis].div_ceil(tile[axis]).max(before[axis])));
    }
    most
}

impl OverridePlan {
    /// Returns whether a value lies in the range. A float is compared with the ends as floats.
    pub fn allows(&self, value: f64) -> bool {
        let [low, high] = self.range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let held = |number: f64| match self.ty {
            OverrideType::F32 => f64::from(number as f32),
            _ => number,
        };
        (held(low)..=held(high)).contains(&held(value))
    }
}

impl Plan {
    /// Name of an output in an error: none where it is the only one.
    pub fn target_name(&self, output: usize) -> Option<String> {
        let named = self.outputs.get(output).filter(|_| self.outputs.len() > 1);
        named.map(|output| output.name.to_string())
    }

    /// Returns the structs of runtime values, including that of the region.
    pub fn uniform_structs(&self) -> impl Iterator<Item = &UniformPlan> {
        self.uniforms.iter().chain(&self.region)
    }

    /// Returns the bytes of immediates; 0 if there are none.
    pub fn immediate_size(&self) -> u32 {
        let immediates = self.uniforms.iter().filter(|uniform| uniform.place.is_none());
        immediates.map(|uniform| uniform.size).sum()
    }

    /// Returns whether a caller sets a uniform of this name: a field, or the matrix or array that fields are parts of.
    pub fn has_uniform(&self, name: &str) -> bool {
        let mut fields = self.uniforms.iter().flat_map(|uniform| uniform.fields.iter());
        fields.any(|field| field.part.as_ref().map_or(&*field.name, |part| &*part.of) == name)
    }

    /// Group and binding number of everything, sorted.
    pub fn binding_places(&self) -> Vec<(u32, u32)> {
        let mut places: Vec<(u32, u32)> = self.inputs.iter().map(|i| (i.group, i.binding)).collect();
        places.extend(self.uniform_structs().filter_map(|uniform| uniform.place));
        places.extend(self.outputs.iter().filter_map(|output| output.place));
        places.sort_unstable();
        places
    }

    /// The first binding number that leaves one out: group, number, and the number that is left out.
    pub fn find_gap(&self) -> Option<(u32, u32, u32)> {
        let places = self.binding_places();
        let mut groups = places.chunk_by(|a, b| a.0 == b.0);
        groups.find_map(|group| {
            let mut numbered = group.iter().zip(0..);
            numbered.find_map(|((group, binding), k)| (*binding != k).then_some((*group, *binding, k)))
        })
    }
}
