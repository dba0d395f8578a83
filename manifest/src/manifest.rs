//! The manifest: everything that a host must know of one shader, as JSON.

use crate::chain::CHAIN_SCHEMA;
use crate::source_map::SOURCE_MAP_SCHEMA;
use crate::{
    Binding, BindingKind, Form, Immediates, LanguageBinding, Origin, Output, Override, Precision, Stage, Tuned,
    UniformField, ValueType, output,
};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// Version of the manifest's layout. A reader refuses a manifest whose schema it does not know.
pub const SCHEMA: u32 = 3;

/// Everything a host must know to run one emitted shader.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Layout version, [`SCHEMA`].
    pub schema: u32,
    /// Name and version of the generator.
    pub generator: String,
    /// The kernel's name, as in `straightline list`.
    pub kernel: String,
    /// The pipeline stage that the shader is for.
    pub stage: Stage,
    /// Loop policy: `full`, `none` or `partial(N)`, followed by the requests for single loops.
    pub unroll: String,
    /// Precision of the shader's arithmetic. Uniforms, buffers and textures are the same in every precision.
    #[serde(default, skip_serializing_if = "Precision::is_default")]
    pub precision: Precision,
    /// Values of the kernel that are computed in half precision, by their names in its source.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub half: BTreeSet<String>,
    /// Form: a complete shader, or a function for another.
    #[serde(default, skip_serializing_if = "Form::is_default")]
    pub form: Form,
    /// Position of row 0 of textures, target and positions.
    #[serde(default, skip_serializing_if = "Origin::is_default")]
    pub origin: Origin,
    /// Name of the entry point, or of the function.
    pub entry_point: String,
    /// Names of the entry point in languages that have it under another, by target name: `main` in GLSL.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub entry_points: BTreeMap<String, String>,
    /// Invocations in a workgroup; compute only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub workgroup_size: Option<[u32; 3]>,
    /// `true` if every element of workgroup memory is written before it is read, so that it need not be 0 at first.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub fills_memory: bool,
    /// Width and height of the block of pixels that one invocation computes. Compute dispatches one invocation for each
    /// block; a block that extends beyond the target stores only the pixels inside.
    #[serde(default = "one_pixel", skip_serializing_if = "is_one_pixel")]
    pub block: [u32; 2],
    /// Further abilities that the device needs: `subgroup`, quad operations in the shader's stage; `shader-f16`,
    /// arithmetic in half precision; `immediates`, uniforms in the commands.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub features: Vec<String>,
    /// Interpolated values that the host's vertex shader must output; fragment only. A shader with varyings is drawn in
    /// a pipeline of the host's own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub varyings: Vec<Varying>,
    /// Textures, buffers, samplers and uniform buffers that the shader reads, in binding order. What the options make
    /// unnecessary is not listed. Together with `outputs` this is the bind group layout, in WebGPU's words, and all
    /// that WGSL and SPIR-V bind.
    pub bindings: Vec<Binding>,
    /// The uniforms, if they lie in no buffer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub immediates: Option<Immediates>,
    /// Options that the host may set when it creates the pipeline, in the order of the kernel's options. One that the
    /// shader does not read is not listed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overrides: Vec<Override>,
    /// All that the other languages bind, each by its own numbers, registers or names; of functions, their parameters
    /// in order, in WGSL too.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub language_bindings: Vec<LanguageBinding>,
    /// Targets of the results: in JSON an object for a single one, else a list. A kernel that returns a structure or a
    /// tuple has an output for each of its fields.
    #[serde(rename = "output", with = "output")]
    pub outputs: Vec<Output>,
    /// Every option of the kernel with the value it was generated for; `uniform` for one that is set at run time,
    /// and `override(DEFAULT)` for one that is set when the pipeline is created.
    pub options: BTreeMap<String, String>,
    /// Operation counts of one invocation.
    pub counts: Counts,
    /// File of each target that was written, by target name (`wgsl`, `glsl450`, `glsl430`, `glsl330`,
    /// `essl310`, `essl300`, `spirv`, `hlsl`, `msl`).
    #[serde(default)]
    pub files: BTreeMap<String, String>,
    /// Hash of each of those files, by target name: [`hash_of_text`](crate::hash_of_text) of all of the text, comments
    /// included, and [`hash_of_bytes`](crate::hash_of_bytes) of `spirv`. A manifest without one, written by hand say,
    /// claims nothing of that file.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub hashes: BTreeMap<String, String>,
    /// Languages of `files` whose texts naga has validated: WGSL as it is written, SPIR-V and MSL as translations of
    /// that, and GLSL 4.50 where naga's reader knows all that is in it.
    #[serde(default, skip_serializing_if = "BTreeSet::is_empty")]
    pub validated: BTreeSet<String>,
    /// For a shader that `straightline tune` chose: the omitted terms, and their cost.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tuned: Option<Tuned>,
}

/// A value that is interpolated for each fragment.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Varying {
    /// Name in the kernel's source.
    pub name: String,
    /// A number or a vector.
    #[serde(rename = "type")]
    pub ty: ValueType,
    /// Location of the fragment's input.
    pub location: u32,
}

/// Operation counts of one invocation, taken on the generated graph. Loops count as often as they run; of the two sides
/// of a branch the larger counts.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counts {
    /// Basic blocks of the shader's text. 1 means straight-line code; a compute shader has two more, for pixels outside
    /// of the target. Blocks of a loop's test count; blocks that a compiler adds do not.
    pub basic_blocks: u32,
    /// Loops that are left in the shader.
    pub loops: u32,
    /// Reads of geometry: every texture but the image being filtered.
    pub texture_reads: u32,
    /// Reads of the image being filtered, the texture named `color`.
    pub colour_reads: u32,
    /// Reads by texture name.
    pub reads: BTreeMap<String, u32>,
    /// Values that the kernel tallies by name, such as `weight_evaluations`.
    pub tallies: BTreeMap<String, u32>,
    /// Exponentials, logarithms, powers, roots and trigonometric calls.
    pub transcendentals: u32,
    /// Messages between the lanes of a quad, or the derivatives that carry them.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub messages: u32,
    /// Atomic operations on buffers, and stores into them.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub writes: u32,
    /// Reads of memory shared by a workgroup.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub shared_reads: u32,
    /// Barriers at which the invocations of a workgroup wait for each other.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub barriers: u32,
    /// Bytes of memory that a workgroup shares; devices of WebGPU promise 16384.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub shared_memory: u32,
    /// Operations on floats that no driver may reorder or contract.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub exact: u32,
    /// All other arithmetic, comparison and selection operations, a vector operation counting once.
    pub alu: u32,
    /// Statements of the emitted body.
    pub statements: u32,
    /// Maximum number of live scalars, in the order of the text: components of vectors, and each element of an array;
    /// without booleans, constants and uniforms. Compilers need about as many registers.
    pub max_live: u32,
    /// Place of that maximum in the source, with the counters of unrolled loops: `kernel.rs:12, tap 3`.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub max_live_at: String,
}

fn one_pixel() -> [u32; 2] {
    [1, 1]
}

fn is_one_pixel(block: &[u32; 2]) -> bool {
    *block == [1, 1]
}

fn is_zero(n: &u32) -> bool {
    *n == 0
}

/// Reason why a text is not a manifest.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Not JSON, or not of this shape.
    #[error("not a shader manifest: {0}")]
    Json(#[from] serde_json::Error),
    /// Made by a generator of another time.
    #[error("manifest schema {found}, but this reader knows schema {SCHEMA}: generate the shader again")]
    Schema {
        /// The schema that the manifest states.
        found: u32,
    },
    /// A chain, made by a generator of another time.
    #[error("chain schema {found}, but this reader knows schema {CHAIN_SCHEMA}: generate the chain again")]
    ChainSchema {
        /// The schema that the chain states.
        found: u32,
    },
    /// A source map, made by a generator of another time.
    #[error("source map schema {found}, but this reader knows schema {SOURCE_MAP_SCHEMA}: generate the shader again")]
    SourceMapSchema {
        /// The schema that the map states.
        found: u32,
    },
}

impl Manifest {
    /// Reads a manifest from JSON, refusing other schemas and unknown fields.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        #[derive(Deserialize)]
        struct Head {
            schema: u32,
        }
        let head: Head = serde_json::from_str(text)?;
        if head.schema != SCHEMA {
            return Err(Error::Schema { found: head.schema });
        }
        Ok(serde_json::from_str(text)?)
    }

    /// The manifest as indented JSON that ends in a newline. Equal manifests give equal text.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("a manifest is plain data");
        text.push('\n');
        text
    }

    /// Fields and size in bytes of the kernel's uniforms, in a buffer or as immediates. The region's are not among them.
    pub fn uniform_block(&self) -> Option<(&[UniformField], u32)> {
        let mut bound = self.bindings.iter().filter_map(|binding| match &binding.kind {
            BindingKind::Uniform { fields, size, .. } if !binding.is_region() => Some((&fields[..], *size)),
            _ => None,
        });
        let immediates = self.immediates.as_ref();
        bound
            .next()
            .or_else(|| immediates.map(|all| (&all.fields[..], all.size)))
    }

    /// The binding called `name`.
    pub fn binding(&self, name: &str) -> Option<&Binding> {
        self.bindings.iter().find(|b| b.name == name)
    }
}
