//! What a graph is run on.

use crate::ir::{Graph, Scalar, Type};
use crate::passes::{Schedule, layers_read};
use std::fmt;

/// An image that a graph can read.
pub trait Texels: Sync {
    /// Width and height in texels, and number of layers, or of samples a texel.
    fn extent(&self) -> [u32; 3];
    /// The texel at a coordinate inside the extent; components that the image lacks are 0.
    fn texel(&self, x: u32, y: u32, layer: u32) -> [f32; 4];
}

/// An image in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    size: [u32; 2],
    layers: Vec<Vec<[f32; 4]>>,
}

impl Image {
    /// An image of `size` texels from layers of rows; `None` unless there is a layer and each has all its texels.
    pub fn new(size: [u32; 2], layers: Vec<Vec<[f32; 4]>>) -> Option<Image> {
        let texels = size[0] as usize * size[1] as usize;
        let whole = texels > 0 && !layers.is_empty() && layers.iter().all(|layer| layer.len() == texels);
        whole.then_some(Image { size, layers })
    }
}

impl Texels for Image {
    fn extent(&self) -> [u32; 3] {
        [self.size[0], self.size[1], self.layers.len() as u32]
    }

    fn texel(&self, x: u32, y: u32, layer: u32) -> [f32; 4] {
        let layer = (layer as usize).min(self.layers.len() - 1);
        self.layers[layer][(y * self.size[0] + x) as usize]
    }
}

/// What lies beyond a texture's border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Address {
    /// The border's texels.
    #[default]
    Clamp,
    /// The image again.
    Repeat,
    /// The image mirrored.
    Mirror,
}

/// When a comparison of a reference with a stored depth holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)] // named as everywhere
pub enum Comparison {
    Less,
    #[default]
    LessEqual,
    Greater,
    GreaterEqual,
}

/// How a sampler reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerState {
    /// Whether the four texels around a place are weighed; else the nearest counts alone.
    pub linear: bool,
    /// What lies beyond the border.
    pub address: Address,
    /// For a comparison sampler, when a texel passes.
    pub comparison: Comparison,
}

impl Default for SamplerState {
    fn default() -> Self {
        SamplerState {
            linear: true,
            address: Address::default(),
            comparison: Comparison::default(),
        }
    }
}

/// Images, samplers, buffers and uniforms by name.
#[derive(Clone, Default)]
pub struct Bindings<'a> {
    pub(super) textures: Vec<(String, &'a dyn Texels)>,
    pub(super) samplers: Vec<(String, SamplerState)>,
    pub(super) buffers: Vec<(String, &'a [[f64; 4]])>,
    pub(super) uniforms: Vec<(String, Vec<f64>)>,
}

impl<'a> Bindings<'a> {
    /// Nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// An image for a texture.
    pub fn texture(mut self, name: &str, image: &'a dyn Texels) -> Self {
        self.textures.push((name.to_owned(), image));
        self
    }

    /// The state of a sampler; one that is not named filters linearly, clamps, and compares by `<=`.
    pub fn sampler(mut self, name: &str, state: SamplerState) -> Self {
        self.samplers.push((name.to_owned(), state));
        self
    }

    /// The elements of a buffer, each in as many lanes as it has.
    pub fn buffer(mut self, name: &str, elements: &'a [[f64; 4]]) -> Self {
        self.buffers.push((name.to_owned(), elements));
        self
    }

    /// The lanes of a uniform; a single number is for every lane. One that is not named keeps its default, or 0.
    pub fn uniform(mut self, name: &str, lanes: &[f64]) -> Self {
        self.uniforms.push((name.to_owned(), lanes.to_vec()));
        self
    }
}

/// The entry of a name.
pub(super) fn find<'b, T>(entries: &'b [(String, T)], name: &str) -> Option<&'b T> {
    entries
        .iter()
        .rev()
        .find(|(known, _)| known == name)
        .map(|(_, value)| value)
}

/// Bits of a uniform or buffer element, as the graph's constants have them.
pub(super) fn bits(ty: Type, lanes: &[f64]) -> [u32; 4] {
    let lane = |k: usize| lanes.get(k).or(lanes.first()).copied().unwrap_or(0.0);
    let mut out = [0; 4];
    for (k, slot) in out.iter_mut().enumerate().take(ty.lanes() as usize) {
        *slot = match ty.kind() {
            Some(Scalar::F32) => (lane(k) as f32).to_bits(),
            Some(Scalar::U32) => lane(k) as u32,
            Some(Scalar::I32) => lane(k) as i32 as u32,
            _ => u32::from(lane(k) != 0.0),
        };
    }
    out
}

/// Checks that everything that the scheduled graph reads is there and fits.
pub(super) fn check(
    graph: &Graph,
    schedule: &Schedule,
    frame: [u32; 2],
    bindings: &Bindings<'_>,
) -> Result<(), InputError> {
    let live = graph.ids().filter(|id| schedule.place[id.0 as usize].is_some());
    let ops: Vec<_> = live.map(|id| &graph.node(id).op).collect();
    for (index, texture) in graph.textures.iter().enumerate() {
        if !ops.iter().any(|op| op.texture() == Some(index as u32)) {
            continue;
        }
        let name = texture.name.clone();
        let Some(image) = find(&bindings.textures, &name) else {
            return Err(InputError::Missing(name));
        };
        let [width, height, found] = image.extent();
        // Where nothing bounds the index it is clamped to what there is.
        let needed = layers_read(graph, index as u32).unwrap_or(1);
        if found < needed {
            return Err(InputError::Layers { name, found, needed });
        }
        if texture.framed && [width, height] != frame {
            let found = [width, height];
            return Err(InputError::Size { name, found, frame });
        }
    }
    for (index, buffer) in graph.buffers.iter().enumerate() {
        let read = ops.iter().any(|op| op.buffer() == Some(index as u32));
        if read && find(&bindings.buffers, &buffer.name).is_none_or(|b| b.is_empty()) {
            return Err(InputError::MissingBuffer(buffer.name.clone()));
        }
    }
    Ok(())
}

/// Why a graph cannot be run on the given inputs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum InputError {
    /// A lane of a quad cannot be computed alone: interpret `Compiled::in_blocks`.
    Lanes,
    /// No image was given for a texture that is read.
    Missing(String),
    /// No elements were given for a buffer that is read.
    MissingBuffer(String),
    /// The image has fewer layers, or samples a texel, than the graph reads.
    Layers {
        /// The texture.
        name: String,
        /// Layers that it has.
        found: u32,
        /// Layers that are read.
        needed: u32,
    },
    /// The image has another size than the frame.
    Size {
        /// The texture.
        name: String,
        /// Width and height that it has.
        found: [u32; 2],
        /// Width and height of the frame.
        frame: [u32; 2],
    },
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            InputError::Lanes => write!(
                f,
                "the lanes of a quad are computed together: expand it into one invocation"
            ),
            InputError::Missing(name) => write!(f, "no image for the texture `{name}`"),
            InputError::MissingBuffer(name) => write!(f, "no elements for the buffer `{name}`: it needs at least one"),
            InputError::Layers { name, found, needed } => {
                write!(
                    f,
                    "`{name}` has {found} layers but {needed} are read: one for each geometry sample"
                )
            }
            InputError::Size { name, found, frame } => write!(
                f,
                "`{name}` is {}x{} but the output is {}x{}: a `Frame` has the output's size",
                found[0], found[1], frame[0], frame[1]
            ),
        }
    }
}

impl std::error::Error for InputError {}
