//! Inputs of a graph's execution.

use crate::ir::{Bits, Graph, Scalar, Texture, TextureKind, Type};
use crate::passes::{Schedule, layers_read};
use std::fmt;

/// An image that a graph can read.
pub trait Texels: Sync {
    /// Kind of a texel's components: floats or integers.
    fn scalar(&self) -> Scalar {
        Scalar::F32
    }
    /// Number of levels, at least 1.
    fn levels(&self) -> u32 {
        1
    }
    /// Width and height of a level in texels, and number of its layers, slices or faces, or of samples a texel.
    fn extent(&self, level: u32) -> [u32; 3];
    /// The bits of the texel at a coordinate inside the level's extent; components that the image lacks are 0.
    fn texel(&self, x: u32, y: u32, layer: u32, level: u32) -> Bits;
}

/// An image in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    scalar: Scalar,
    levels: Vec<Level>,
}

/// Layers, slices or faces of a size, their texels by their bits.
#[derive(Clone, Debug, PartialEq)]
struct Level {
    size: [u32; 2],
    layers: Vec<Vec<Bits>>,
}

impl Image {
    /// An image of `size` texels from layers of rows, also of the slices of a volume, or the faces of a cube +X, -X,
    /// +Y, -Y, +Z, -Z; `None` unless there is a layer and each has all its texels.
    pub fn new(size: [u32; 2], layers: Vec<Vec<[f32; 4]>>) -> Option<Image> {
        let layers = layers.into_iter();
        let bits = layers.map(|layer| layer.into_iter().map(|texel| texel.map(f32::to_bits)).collect());
        let levels = vec![Level::new(size, bits.collect())?];
        Some(Image {
            scalar: Scalar::F32,
            levels,
        })
    }

    /// An image of integers, by their bits; else as [`new`](Self::new).
    pub fn of_integers(scalar: Scalar, size: [u32; 2], layers: Vec<Vec<Bits>>) -> Option<Image> {
        let levels = vec![Level::new(size, layers)?];
        Some(Image { scalar, levels })
    }

    /// With another one as its next smaller level.
    pub fn with_smaller(mut self, level: Image) -> Image {
        self.levels.extend(level.levels);
        self
    }
}

impl Level {
    fn new(size: [u32; 2], layers: Vec<Vec<Bits>>) -> Option<Level> {
        let texels = size[0] as usize * size[1] as usize;
        let whole = texels > 0 && !layers.is_empty() && layers.iter().all(|layer| layer.len() == texels);
        whole.then_some(Level { size, layers })
    }
}

impl Texels for Image {
    fn scalar(&self) -> Scalar {
        self.scalar
    }

    fn levels(&self) -> u32 {
        self.levels.len() as u32
    }

    fn extent(&self, level: u32) -> [u32; 3] {
        let level = &self.levels[level as usize];
        [level.size[0], level.size[1], level.layers.len() as u32]
    }

    fn texel(&self, x: u32, y: u32, layer: u32, level: u32) -> Bits {
        let level = &self.levels[level as usize];
        let layer = (layer as usize).min(level.layers.len() - 1);
        level.layers[layer][(y * level.size[0] + x) as usize]
    }
}

/// Texels beyond a texture's border.
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

/// State of a sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerState {
    /// `true` if the four texels around a place are interpolated, `false` if only the nearest is read.
    pub linear: bool,
    /// Texels beyond the border.
    pub address: Address,
    /// `true` if the two levels around the level of detail are interpolated, `false` if only the nearest is read.
    pub linear_mip: bool,
    /// For a comparison sampler, when a texel passes.
    pub comparison: Comparison,
}

impl SamplerState {
    /// The nearest texel of the nearest level, clamped to the edge.
    pub const NEAREST: SamplerState = SamplerState {
        linear: false,
        address: Address::Clamp,
        linear_mip: false,
        comparison: Comparison::LessEqual,
    };
}

impl Default for SamplerState {
    fn default() -> Self {
        SamplerState {
            linear: true,
            address: Address::default(),
            linear_mip: true,
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

    /// The elements of a buffer, each in as many components as it has; of structures all their numbers and vectors, one
    /// after the other.
    pub fn buffer(mut self, name: &str, elements: &'a [[f64; 4]]) -> Self {
        self.buffers.push((name.to_owned(), elements));
        self
    }

    /// The components of a uniform, or the value of an override, a boolean as 0 or 1. A single number is for every
    /// component. One that is not named keeps its default, or 0.
    pub fn uniform(mut self, name: &str, lanes: &[f64]) -> Self {
        self.uniforms.push((name.to_owned(), lanes.to_vec()));
        self
    }
}

/// The entry of a name.
pub(super) fn find_entry<'b, T>(entries: &'b [(String, T)], name: &str) -> Option<&'b T> {
    entries
        .iter()
        .rev()
        .find(|(known, _)| known == name)
        .map(|(_, value)| value)
}

/// Bits of a uniform or buffer element, as the graph's constants have them.
pub(super) fn element_bits(ty: Type, lanes: &[f64]) -> [u32; 4] {
    let lane = |k: usize| lanes.get(k).or(lanes.first()).copied().unwrap_or(0.0);
    let mut out = [0; 4];
    for (k, slot) in out.iter_mut().enumerate().take(ty.component_count() as usize) {
        *slot = match ty.scalar_kind() {
            Some(Scalar::F32) => (lane(k) as f32).to_bits(),
            Some(Scalar::U32) => lane(k) as u32,
            Some(Scalar::I32) => lane(k) as i32 as u32,
            _ => u32::from(lane(k) != 0.0),
        };
    }
    out
}

/// Checks that everything that the scheduled graph reads is there and fits.
pub(super) fn check_bindings(
    graph: &Graph,
    schedule: &Schedule,
    frame: [u32; 2],
    bindings: &Bindings<'_>,
) -> Result<(), InputError> {
    let live = graph.node_ids().filter(|id| schedule.has_node(*id));
    let ops: Vec<_> = live.map(|id| &graph.node(id).op).collect();
    for (index, texture) in graph.textures.iter().enumerate() {
        if !ops.iter().any(|op| op.texture() == Some(index as u32)) {
            continue;
        }
        let name = texture.name.clone();
        let Some(image) = find_entry(&bindings.textures, &name) else {
            return Err(InputError::Missing(name));
        };
        let [width, height, found] = image.extent(0);
        if image.scalar() != texture.scalar {
            let (found, needed) = (image.scalar(), texture.scalar);
            return Err(InputError::Scalar { name, found, needed });
        }
        if let Some(needed) = required_shape(texture, *image) {
            return Err(InputError::Shape { name, needed });
        }
        // An index without a known bound is clamped to the layers that exist.
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
        let found = find_entry(&bindings.buffers, &buffer.name).map_or(0, |values| values.len());
        if read && found == 0 {
            return Err(InputError::MissingBuffer(buffer.name.clone()));
        }
        let each = buffer.element.value_types().len();
        if read && !found.is_multiple_of(each) {
            let name = buffer.name.clone();
            return Err(InputError::Elements { name, found, each });
        }
    }
    Ok(())
}

/// Returns the shape that a texture requires, if the image or its levels have another one.
fn required_shape(texture: &Texture, image: &dyn Texels) -> Option<&'static str> {
    let half = |side: u32, level: u32| side.checked_shr(level).unwrap_or(0).max(1);
    let [width, height, depth] = image.extent(0);
    let volume = texture.kind == TextureKind::Volume;
    let shrinks = (1..image.levels()).all(|level| {
        let layers = if volume { half(depth, level) } else { depth };
        image.extent(level) == [half(width, level), half(height, level), layers]
    });
    match () {
        () if texture.kind.is_cube() && (depth != 6 || width != height) => Some("six square faces"),
        () if !shrinks => Some("levels each of which has half the size of the one before, rounded down"),
        () => None,
    }
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
    /// The values make no whole number of a buffer's structures.
    Elements {
        /// The buffer.
        name: String,
        /// Numbers and vectors that there are.
        found: usize,
        /// Numbers and vectors of one structure.
        each: usize,
    },
    /// The image has fewer layers, or samples a texel, than the graph reads.
    Layers {
        /// The texture.
        name: String,
        /// Layers that it has.
        found: u32,
        /// Layers that are read.
        needed: u32,
    },
    /// The image has texels of another kind.
    Scalar {
        /// The texture.
        name: String,
        /// Kind of the image's components.
        found: Scalar,
        /// Kind of components that is read.
        needed: Scalar,
    },
    /// The image has another shape.
    Shape {
        /// The texture.
        name: String,
        /// The shape that it needs.
        needed: &'static str,
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
            InputError::Elements { name, found, each } => write!(
                f,
                "{found} numbers and vectors for the buffer `{name}`, each element of which has {each}"
            ),
            InputError::Layers { name, found, needed } => {
                write!(
                    f,
                    "`{name}` has {found} layers but {needed} are read: one for each geometry sample"
                )
            }
            InputError::Scalar { name, found, needed } => {
                write!(f, "`{name}` has texels of {found}, and the kernel reads {needed}")
            }
            InputError::Shape { name, needed } => write!(f, "`{name}` needs {needed}"),
            InputError::Size { name, found, frame } => write!(
                f,
                "`{name}` is {}x{} but the output is {}x{}: a `Frame` has the output's size",
                found[0], found[1], frame[0], frame[1]
            ),
        }
    }
}

impl std::error::Error for InputError {}
