//! The graph and its builder.

use super::{Bits, Buffer, Memory, Op, Origin, Place, Scalar, SharedArray, Texture, Type, usize_bits};
use rustc_hash::{FxHashMap, FxHasher};
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// Index of a node. A node's arguments have smaller indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

/// Index of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RegionId(pub u32);

/// An operation.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Node {
    /// Operation.
    pub op: Op,
    /// Arguments.
    pub args: Vec<NodeId>,
    /// Type of the result.
    pub ty: Type,
}

/// The body of a structured loop, or one side of a branch in the shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Region {
    /// Region that contains this one; `None` for the body of the kernel, region 0.
    pub parent: Option<RegionId>,
    /// Counter and carried values, for a loop.
    pub params: Vec<NodeId>,
    /// Values that leave the region.
    pub results: Vec<NodeId>,
    /// For a loop: whether this iteration is the last one, regardless of the counter.
    pub stop: Option<NodeId>,
    /// Effects of the region in order, including the loops and branches that contain effects.
    pub effects: Vec<NodeId>,
}

impl Region {
    /// Values computed for use outside the region: its results and its stop condition.
    pub fn yielded_values(&self) -> impl Iterator<Item = NodeId> {
        self.results.iter().copied().chain(self.stop)
    }
}

/// Start or end of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Opens a region inside the innermost open one.
    Open(RegionId),
    /// Closes the innermost open region.
    Close(RegionId),
}

/// A sampler.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sampler {
    /// Name in the kernel.
    pub name: String,
    /// `true` for a sampler that compares with a reference.
    pub comparison: bool,
    /// `true` if the sampler may interpolate texels. A sampler that neither filters nor compares gathers texels unchanged,
    /// from inside the texture.
    pub filters: bool,
}

/// A value that a kernel computes for each pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputTarget {
    /// Name: [`OutputTarget::DEFAULT_NAME`], or that of a field of the kernel's structure.
    pub name: String,
    /// A float or integer, or a vector of them.
    pub ty: Type,
    /// Width and height of the texels that a workgroup writes, of an image with a size of its own. `None` of one that has the
    /// frame's size.
    pub tile: Option<[u32; 2]>,
}

impl OutputTarget {
    /// Name of the target of a kernel with a single result.
    pub const DEFAULT_NAME: &'static str = "destination";

    /// The default target: one `vec4f` colour.
    pub fn default_color() -> OutputTarget {
        OutputTarget {
            name: OutputTarget::DEFAULT_NAME.to_owned(),
            ty: Type::value(Scalar::F32, 4),
            tile: None,
        }
    }
}

/// A value set at run time.
#[derive(Clone, Debug, PartialEq)]
pub struct Uniform {
    /// Name in the kernel.
    pub name: String,
    /// Scalar or vector.
    pub ty: Type,
    /// Value to use unless the host sets one.
    pub default: Option<f64>,
    /// The whole that the uniform is a part of, if any.
    pub part: Option<UniformPart>,
}

/// An option that a host may set when it creates the pipeline.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    /// Name in the kernel.
    pub name: String,
    /// Position of the option among those of the kernel, from 0, by which hosts set it.
    pub id: u32,
    /// `f32`, `i32`, `u32` or `bool`.
    pub ty: Type,
    /// Value to use unless the host sets one; of a `bool` 0 or 1.
    pub default: f64,
    /// Smallest and largest value that a host may set, if the kernel states them. No pass relies on them.
    pub range: Option<[f64; 2]>,
}

impl Override {
    /// Bits of the default.
    pub fn default_bits(&self) -> u32 {
        match self.ty.scalar_kind() {
            Some(Scalar::F32) => (self.default as f32).to_bits(),
            Some(Scalar::I32) => self.default as i32 as u32,
            Some(Scalar::Bool) => u32::from(self.default != 0.0),
            _ => self.default as u32,
        }
    }
}

/// A column of a matrix, or an element of an array of scalars or vectors, that is one parameter of the kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UniformPart {
    /// Name of the whole in the kernel.
    pub of: String,
    /// Index of the part, from 0.
    pub index: u32,
    /// Number of parts.
    pub count: u32,
    /// `true` if the parts are columns of a matrix.
    pub columns: bool,
}

/// A fragment's value that the host's rasteriser interpolates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Varying {
    /// Name in the kernel.
    pub name: String,
    /// Float, or vector of floats.
    pub ty: Type,
}

/// Pixels that an invocation computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Invocation {
    /// A pixel inside the frame.
    #[default]
    Pixel,
    /// A pixel that may lie outside the frame: part of a block that is still to be expanded.
    MayBeOutside,
    /// A pixel, in step with the other three of its quad; may lie outside the frame.
    Lane,
    /// A pixel of a workgroup with this width and height; may lie outside the frame.
    Group([u32; 2]),
    /// A block of pixels with this width and height. The upper left one lies inside the frame.
    Block([u32; 2]),
}

impl Invocation {
    /// Width and height in pixels.
    pub fn block_size(self) -> [u32; 2] {
        match self {
            Invocation::Pixel | Invocation::MayBeOutside | Invocation::Lane | Invocation::Group(_) => [1, 1],
            Invocation::Block(size) => size,
        }
    }

    /// Width and height in pixels of the area computed together: by an invocation, or by all invocations of a workgroup.
    pub fn tile_size(self) -> [u32; 2] {
        match self {
            Invocation::Group(size) => size,
            other => other.block_size(),
        }
    }
}

/// A kernel as a graph of pure operations. The module's documentation defines its semantics.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// In order of creation: arguments precede their users.
    pub nodes: Vec<Node>,
    /// Origin of each node, by node.
    pub origins: Vec<Option<Origin>>,
    /// Place of each node in the source, by node; nodes that the source does not have are in none.
    pub places: Vec<Option<Place>>,
    /// Region in which each node was first created, by node.
    pub homes: Vec<RegionId>,
    /// Region 0 is the body of the kernel.
    pub regions: Vec<Region>,
    /// Starts and ends of regions in order, each with the number of nodes at that point.
    pub events: Vec<(u32, Event)>,
    /// Textures, by the index that `Op::Load` carries.
    pub textures: Vec<Texture>,
    /// Buffers, by the index that `Op::BufferLoad` carries.
    pub buffers: Vec<Buffer>,
    /// Images that are written at any position, by the index that `Memory::Image` carries.
    pub images: Vec<OutputTarget>,
    /// Workgroup memory, by the index that `Memory::Shared` carries.
    pub shared: Vec<SharedArray>,
    /// Samplers, by the index that `Op::Sample` carries.
    pub samplers: Vec<Sampler>,
    /// Runtime parameters, by the index that `Op::Uniform` carries.
    pub uniforms: Vec<Uniform>,
    /// Options that the host sets when it creates the pipeline, by the index that `Op::Override` carries.
    pub overrides: Vec<Override>,
    /// Interpolated values, by the index that `Op::Varying` carries.
    pub varyings: Vec<Varying>,
    /// Values that the kernel computes for each pixel.
    pub targets: Vec<OutputTarget>,
    /// Pixels that an invocation computes.
    pub invocation: Invocation,
    /// Names of tallies, by the index that `Op::Tally` carries.
    pub tallies: Vec<String>,
    /// Source files, by the index that origins carry.
    pub files: Vec<String>,
    /// Purposes of the source's functions, ordered by file and first line.
    pub purposes: Arc<[Purpose]>,
}

/// Purpose of a function of the source, for comments.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Purpose {
    /// Index into [`Graph::files`].
    pub file: u32,
    /// The function's line, from 1.
    pub line: u32,
    /// A few words from its documentation; empty if it has none.
    pub words: String,
}

impl Graph {
    /// The body of the kernel.
    pub const BODY: RegionId = RegionId(0);

    /// End of a loop that only its stop ends, an `i32`.
    pub const ENDLESS: i32 = i32::MAX;

    /// Returns a node.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }

    /// Returns a node's type.
    pub fn ty(&self, id: NodeId) -> Type {
        self.node(id).ty
    }

    /// Returns a region.
    pub fn region(&self, id: RegionId) -> &Region {
        &self.regions[id.0 as usize]
    }

    /// Returns the origin of a node.
    pub fn origin(&self, id: NodeId) -> Option<&Origin> {
        self.origins[id.0 as usize].as_ref()
    }

    /// Returns the place of a node in the source.
    pub fn place(&self, id: NodeId) -> Option<&Place> {
        self.places.get(id.0 as usize)?.as_ref()
    }

    /// The kernel's results: for each pixel of the invocation, row by row, a value for each of [`Graph::targets`].
    pub fn outputs(&self) -> &[NodeId] {
        &self.regions[0].results
    }

    /// Returns whether the kernel has effects besides its values.
    pub fn has_effects(&self) -> bool {
        !self.regions[0].effects.is_empty()
    }

    /// Returns whether the kernel changes a buffer or an image. Workgroup memory does not count, because its contents are
    /// lost at the end.
    pub fn has_lasting_effects(&self) -> bool {
        let mut effects = self.regions.iter().flat_map(|region| &region.effects);
        effects.any(|id| matches!(self.node(*id).op.memory(), Some(Memory::Buffer(_) | Memory::Image(_))))
    }

    /// All images that the kernel writes: its targets, and those written at any position.
    pub fn written_targets(&self) -> impl Iterator<Item = &OutputTarget> + Clone {
        self.targets.iter().chain(&self.images)
    }

    /// Type of the elements of memory, and its name.
    pub fn memory(&self, memory: Memory) -> (Type, &str) {
        match memory {
            Memory::Buffer(k) => {
                let buffer = &self.buffers[k as usize];
                (buffer.value_type(), &buffer.name)
            }
            Memory::Shared(k) => {
                let shared = &self.shared[k as usize];
                (shared.element, &shared.name)
            }
            Memory::Image(k) => {
                let image = &self.images[k as usize];
                (image.ty, &image.name)
            }
        }
    }

    /// All nodes in order.
    pub fn node_ids(&self) -> impl DoubleEndedIterator<Item = NodeId> + use<> {
        (0..self.nodes.len() as u32).map(NodeId)
    }

    /// The bits of a constant.
    pub fn constant_bits(&self, id: NodeId) -> Option<Bits> {
        match self.node(id).op {
            Op::Const(bits) => Some(bits),
            _ => None,
        }
    }

    /// Regions of a loop or branch; empty for other nodes.
    pub fn regions_of(&self, id: NodeId) -> Vec<RegionId> {
        match self.node(id).op {
            Op::Loop(body) => vec![body],
            Op::If(then, otherwise) => vec![then, otherwise],
            _ => Vec::new(),
        }
    }
}

/// Simplifications applied when nodes are created.
pub trait Rules {
    /// Returns a node equivalent to `op` of `args`, or `None` to create it unchanged. May create other nodes first.
    fn simplify(&self, builder: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId>;
}

/// Builds a graph node by node; equal nodes are created once.
pub struct Builder<'r> {
    graph: Graph,
    /// Nodes by hash. On a collision, the later node uses the next free hash.
    known: FxHashMap<u64, NodeId>,
    rules: &'r dyn Rules,
    open: Vec<RegionId>,
    /// `true` while operations on floats are made [`Op::Exact`].
    pub(super) exact: bool,
}

impl<'r> Builder<'r> {
    /// Creates an empty graph whose body is open.
    pub fn new(rules: &'r dyn Rules) -> Self {
        let body = Region {
            parent: None,
            params: Vec::new(),
            results: Vec::new(),
            stop: None,
            effects: Vec::new(),
        };
        let graph = Graph {
            regions: vec![body],
            targets: vec![OutputTarget::default_color()],
            ..Graph::default()
        };
        Builder {
            graph,
            known: FxHashMap::default(),
            rules,
            open: vec![Graph::BODY],
            exact: false,
        }
    }

    /// Reserves capacity for nodes.
    pub fn reserve(&mut self, nodes: usize) {
        self.graph.nodes.reserve(nodes);
        self.graph.origins.reserve(nodes);
        self.known.reserve(nodes);
    }

    /// Returns the graph as built so far.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// The tables of textures, uniforms, tallies and files, to be filled by the caller.
    pub fn graph_mut(&mut self) -> &mut Graph {
        &mut self.graph
    }

    /// Adds `op` of `args`, simplified.
    pub fn add(&mut self, op: Op, args: impl AsRef<[NodeId]>, ty: Type) -> NodeId {
        if self.exact && op.is_rounding() && ty.is_float() {
            return self.add_exact(op, args.as_ref(), ty);
        }
        self.add_simplified(op, args, ty)
    }

    /// Adds `op` of `args`, simplified but not made exact.
    pub(super) fn add_simplified(&mut self, op: Op, args: impl AsRef<[NodeId]>, ty: Type) -> NodeId {
        let (rules, args) = (self.rules, args.as_ref());
        match rules.simplify(self, &op, args, ty) {
            Some(id) => id,
            None => self.intern(op, args, ty),
        }
    }

    /// Adds `op` of `args` exactly as given.
    pub fn intern(&mut self, op: Op, args: impl AsRef<[NodeId]>, ty: Type) -> NodeId {
        let args = args.as_ref();
        let free = match self.find_or_hash(&op, args, ty) {
            Ok(id) => return id,
            Err(free) => free,
        };
        let args = args.to_vec();
        let id = self.push(Node { op, args, ty });
        self.known.insert(free, id);
        let regions = self.graph.regions_of(id);
        if regions
            .iter()
            .any(|region| !self.graph.region(*region).effects.is_empty())
        {
            self.record_effect(id);
        }
        id
    }

    /// Adds an effect after all others of the innermost open region.
    pub fn add_effect(&mut self, op: Op, args: Vec<NodeId>, ty: Type) -> NodeId {
        let id = self.push(Node { op, args, ty });
        self.record_effect(id);
        id
    }

    fn push(&mut self, node: Node) -> NodeId {
        let id = NodeId(self.graph.nodes.len() as u32);
        self.graph.nodes.push(node);
        self.graph.origins.push(None);
        self.graph.homes.push(self.innermost_region());
        id
    }

    fn innermost_region(&self) -> RegionId {
        *self.open.last().expect("the body is always open")
    }

    fn record_effect(&mut self, id: NodeId) {
        let region = self.innermost_region();
        self.graph.regions[region.0 as usize].effects.push(id);
    }

    /// Open regions, the body first.
    pub fn open_regions(&self) -> &[RegionId] {
        &self.open
    }

    /// Returns the number of effects of each open region.
    pub fn effect_counts(&self) -> Vec<usize> {
        let open = self.open.iter();
        open.map(|region| self.graph.region(*region).effects.len()).collect()
    }

    /// Removes the effects added since the open regions had these numbers of them.
    pub fn take_back(&mut self, effects: &[usize]) {
        for (region, count) in self.open.iter().zip(effects) {
            self.graph.regions[region.0 as usize].effects.truncate(*count);
        }
    }

    /// Returns a state for [`Builder::return_to`].
    pub fn mark(&self) -> Mark {
        Mark {
            nodes: self.graph.nodes.len(),
            regions: self.graph.regions.len(),
            events: self.graph.events.len(),
            effects: self.effect_counts(),
        }
    }

    /// Removes all nodes, regions and effects added since a mark. The same regions must be open as at the mark.
    pub fn return_to(&mut self, mark: &Mark) {
        self.take_back(&mark.effects);
        for k in (mark.nodes..self.graph.nodes.len()).rev() {
            let node = &self.graph.nodes[k];
            let mut hash = hash_of(&node.op, &node.args, node.ty);
            // Removal is last in, first out, so no chain of equal hashes breaks. Effects are in no chain.
            while let Some(id) = self.known.get(&hash) {
                if id.0 as usize == k {
                    self.known.remove(&hash);
                    break;
                }
                hash = hash.wrapping_add(1);
            }
        }
        self.graph.nodes.truncate(mark.nodes);
        self.graph.origins.truncate(mark.nodes);
        self.graph.places.truncate(mark.nodes);
        self.graph.homes.truncate(mark.nodes);
        self.graph.regions.truncate(mark.regions);
        self.graph.events.truncate(mark.events);
    }

    /// Node that computes `op` of `args`, if there is one already.
    pub fn find_node(&self, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
        self.find_or_hash(op, args, ty).ok()
    }

    /// Equal node, or the hash under which a new one is stored.
    fn find_or_hash(&self, op: &Op, args: &[NodeId], ty: Type) -> Result<NodeId, u64> {
        let mut hash = hash_of(op, args, ty);
        while let Some(id) = self.known.get(&hash) {
            let node = self.graph.node(*id);
            if node.args == args && node.ty == ty && node.op == *op {
                return Ok(*id);
            }
            hash = hash.wrapping_add(1);
        }
        Err(hash)
    }

    /// Adds a constant.
    pub fn constant(&mut self, ty: Type, bits: Bits) -> NodeId {
        self.intern(Op::Const(bits), Vec::new(), ty)
    }

    /// Adds a constant float.
    pub fn f32(&mut self, value: f32) -> NodeId {
        self.constant(Type::F32, [value.to_bits(), 0, 0, 0])
    }

    /// Adds a constant signed integer.
    pub fn i32(&mut self, value: i32) -> NodeId {
        self.constant(Type::I32, [value as u32, 0, 0, 0])
    }

    /// Adds a constant `usize`.
    pub fn usize(&mut self, value: u64) -> NodeId {
        self.constant(Type::USIZE, usize_bits(value))
    }

    /// Adds a constant boolean.
    pub fn bool(&mut self, value: bool) -> NodeId {
        self.constant(Type::BOOL, [value as u32, 0, 0, 0])
    }

    /// Sets the origin of a node. If the node already has one, the two are merged ([`Origin::merge`]).
    pub fn set_origin(&mut self, id: NodeId, origin: &Origin) {
        match &mut self.graph.origins[id.0 as usize] {
            Some(present) => present.merge(origin),
            empty => *empty = Some(origin.clone()),
        }
    }

    /// Sets the place of all nodes that have been created since the last call.
    pub fn place_nodes(&mut self, place: impl FnOnce() -> Option<Place>) {
        let graph = &mut self.graph;
        if graph.places.len() < graph.nodes.len() {
            graph.places.resize(graph.nodes.len(), place());
        }
    }

    /// Opens a region inside the open one, with parameters of the given types.
    pub fn open_region(&mut self, params: &[Type]) -> RegionId {
        let id = RegionId(self.graph.regions.len() as u32);
        let parent = self.open.last().copied();
        self.graph.regions.push(Region {
            parent,
            params: Vec::new(),
            results: Vec::new(),
            stop: None,
            effects: Vec::new(),
        });
        self.open.push(id);
        self.graph.events.push((self.graph.nodes.len() as u32, Event::Open(id)));
        let made = params
            .iter()
            .enumerate()
            .map(|(k, ty)| self.intern(Op::Param(id, k as u32), Vec::new(), *ty));
        let made: Vec<_> = made.collect();
        self.graph.regions[id.0 as usize].params = made;
        id
    }

    /// Closes the innermost open region.
    pub fn close_region(&mut self, results: Vec<NodeId>) {
        let id = self.open.pop().expect("a region is open");
        self.graph
            .events
            .push((self.graph.nodes.len() as u32, Event::Close(id)));
        self.graph.regions[id.0 as usize].results = results;
    }

    /// Adds a parameter to an open region, for a value that leaves the loop but is not read in it.
    pub fn add_param(&mut self, region: RegionId, ty: Type) -> NodeId {
        let k = self.graph.region(region).params.len() as u32;
        let param = self.intern(Op::Param(region, k), Vec::new(), ty);
        self.graph.regions[region.0 as usize].params.push(param);
        param
    }

    /// Sets the condition under which a loop ends before its counter does.
    pub fn set_stop(&mut self, region: RegionId, stop: NodeId) {
        let never = self.graph.constant_bits(stop).is_some_and(|bits| bits[0] == 0);
        self.graph.regions[region.0 as usize].stop = (!never).then_some(stop);
    }

    /// Closes the body with its results and returns the graph.
    pub fn finish(mut self, outputs: Vec<NodeId>) -> Graph {
        self.place_nodes(|| None);
        self.close_region(outputs);
        assert!(self.open.is_empty(), "every region that was opened is closed");
        self.graph
    }
}

/// State of a builder: the number of nodes and effects.
#[derive(Clone, Debug)]
pub struct Mark {
    /// Number of nodes.
    pub nodes: usize,
    regions: usize,
    events: usize,
    /// Number of effects of each open region.
    effects: Vec<usize>,
}

impl Mark {
    /// Returns this mark with the effects of an earlier one.
    pub fn with_effects_of(self, earlier: &Mark) -> Mark {
        Mark {
            effects: earlier.effects.clone(),
            ..self
        }
    }
}

fn hash_of(op: &Op, args: &[NodeId], ty: Type) -> u64 {
    let mut hasher = FxHasher::default();
    (op, args, ty).hash(&mut hasher);
    hasher.finish()
}
