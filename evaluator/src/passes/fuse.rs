//! Fusing of passes: a kernel that computes the texels of a picture where it would read them.
//!
//! Tests: `tests/tests/language/chains.rs` compares fused chains with stored ones and with rustc.

use super::fold::Exact;
use crate::ir::{
    BinaryOp, Builder, Graph, Invocation, NodeId, Op, Rebuild, Replace, Rules, Scalar, Texture, TextureKind, Type,
    rebuild_graph, rebuild_replacing,
};
use crate::limits;
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::fmt;
use std::sync::Arc;
use straightline_manifest::chain::{BadRule, SizeOp, SizeRule, SizeTerm};

const PAIR: Type = Type::value(Scalar::I32, 2);

/// A picture and the kernel that draws it.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// Name of the texture that would hold the picture.
    pub name: &'a str,
    /// Kernel that draws it, as it was evaluated.
    pub graph: &'a Graph,
    /// Its size in those of textures; `None` if it is the size of the frame.
    pub size: Option<&'a SizeRule>,
    /// Textures that the size may name, whether or not one of the kernels reads them.
    pub sized: &'a [Texture],
}

/// Reason why a picture has to be stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfused {
    /// A sampler reads it.
    Sampled,
    /// The kernel that draws it leaves a loop or a branch in the shader.
    Regions,
    /// The kernel that draws it writes memory, or is one of quads, workgroups or blocks.
    Invocation,
    /// Its size is that of a texture that no pass reads.
    Size,
    /// The fused kernel has too many operations.
    TooLarge,
}

impl fmt::Display for Unfused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Unfused::Sampled => "a sampler reads it, and a sampler reads textures",
            Unfused::Regions => "the pass that draws it leaves a loop or a branch in the shader",
            Unfused::Invocation => "the pass that draws it is no kernel of single pixels",
            Unfused::Size => "its size is that of a texture that no pass reads",
            Unfused::TooLarge => "the fused pass is too large",
        })
    }
}

/// Returns why no kernel can compute the picture of `producer` in place of reading it.
pub fn find_obstacle(producer: &Graph) -> Option<Unfused> {
    if producer.regions.len() > 1 {
        return Some(Unfused::Regions);
    }
    let single =
        matches!(producer.invocation, Invocation::Pixel | Invocation::MayBeOutside) && producer.targets.len() == 1;
    (!single || producer.has_effects() || !producer.varyings.is_empty()).then_some(Unfused::Invocation)
}

/// Returns whether all textures that a size names are among `sized`.
pub fn has_textures(rule: &SizeRule, sized: &[Texture]) -> bool {
    rule.0.iter().all(|term| match term {
        SizeTerm::Of(name) => sized.iter().any(|texture| texture.name == **name),
        _ => true,
    })
}

/// Coordinates at which a kernel reads a picture: their number, or `None` if a sampler reads it.
pub fn count_reads(consumer: &Graph, name: &str) -> Option<usize> {
    let is = |texture: u32| consumer.textures[texture as usize].name == name;
    let reads = consumer
        .nodes
        .iter()
        .filter(|node| node.op.is_read() && node.op.texture().is_some_and(is));
    let mut coordinates = Vec::new();
    for node in reads {
        match node.op {
            Op::Load { .. } => coordinates.push(node.args[0]),
            _ => return None,
        }
    }
    coordinates.sort_unstable();
    coordinates.dedup();
    Some(coordinates.len())
}

/// Returns `consumer` with the texels of a picture computed in place.
///
/// Textures, samplers, buffers and uniforms of the two kernels are one where they have one name.
///
/// # Errors
///
/// If the picture has to be stored.
pub fn fuse_picture(consumer: &Graph, drawn: &Drawn<'_>) -> Result<Graph, Unfused> {
    if let Some(obstacle) = find_obstacle(drawn.graph) {
        return Err(obstacle);
    }
    if count_reads(consumer, drawn.name).is_none() {
        return Err(Unfused::Sampled);
    }
    if drawn.size.is_some_and(|rule| !has_textures(rule, drawn.sized)) {
        return Err(Unfused::Size);
    }
    let Some(texture) = consumer.textures.iter().position(|texture| texture.name == drawn.name) else {
        return Ok(consumer.clone());
    };
    let mut fuse = Fuse {
        consumer,
        drawn,
        texture: texture as u32,
        maps: Maps::default(),
        texels: FxHashMap::default(),
        too_large: false,
    };
    let pass = Rebuild {
        rules: &Exact,
        share_loads: false,
    };
    let fused = rebuild_replacing(consumer, &pass, &mut fuse);
    match fuse.too_large {
        true => Err(Unfused::TooLarge),
        false => Ok(fused),
    }
}

/// Returns a kernel with textures that are known to have the size of the frame.
pub fn frame_textures(graph: &Graph, is_framed: &dyn Fn(&str) -> bool) -> Graph {
    /// Sizes of these textures are those of the frame.
    struct Frames<'f>(&'f [bool]);

    impl Rules for Frames<'_> {
        fn simplify(&self, b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
            match op {
                Op::TextureSize(texture) if self.0[*texture as usize] => Some(b.add(Op::FrameSize, [], ty)),
                _ => Exact.simplify(b, op, args, ty),
            }
        }
    }
    // A texture of the frame's size has one level.
    let has_levels = |k: usize| graph.nodes.iter().any(|node| node.op == Op::TextureLevels(k as u32));
    let textures = graph.textures.iter().enumerate();
    let framed = textures.map(|(k, of)| of.kind == TextureKind::Flat && is_framed(&of.name) && !has_levels(k));
    let framed: Vec<bool> = framed.collect();
    let pass = Rebuild {
        rules: &Frames(&framed),
        share_loads: false,
    };
    let mut made = rebuild_graph(graph, &pass);
    for (texture, framed) in made.textures.iter_mut().zip(framed) {
        texture.framed |= framed;
    }
    made
}

/// Indices of the producer's tables in those of the fused kernel.
#[derive(Default)]
struct Maps {
    textures: Vec<u32>,
    samplers: Vec<u32>,
    buffers: Vec<u32>,
    uniforms: Vec<u32>,
    overrides: Vec<u32>,
    tallies: Vec<u32>,
    files: Vec<u32>,
}

struct Fuse<'g> {
    consumer: &'g Graph,
    drawn: &'g Drawn<'g>,
    /// Index of the picture among the consumer's textures.
    texture: u32,
    maps: Maps,
    /// Texels by the nodes of their coordinates.
    texels: FxHashMap<NodeId, NodeId>,
    too_large: bool,
}

impl Replace for Fuse<'_> {
    fn add_prologue(&mut self, builder: &mut Builder<'_>) {
        let producer = self.drawn.graph;
        let graph = builder.graph_mut();
        self.maps = Maps {
            textures: merge(&mut graph.textures, &producer.textures, |a, b| a.name == b.name),
            samplers: merge(&mut graph.samplers, &producer.samplers, |a, b| a.name == b.name),
            buffers: merge(&mut graph.buffers, &producer.buffers, |a, b| a.name == b.name),
            uniforms: merge(&mut graph.uniforms, &producer.uniforms, |a, b| a.name == b.name),
            overrides: merge(&mut graph.overrides, &producer.overrides, |a, b| a.id == b.id),
            tallies: merge(&mut graph.tallies, &producer.tallies, |a, b| a == b),
            files: merge(&mut graph.files, &producer.files, |a, b| a == b),
        };
        for (of, index) in producer.textures.iter().zip(&self.maps.textures) {
            let texture = &mut graph.textures[*index as usize];
            texture.components = texture.components.max(of.components);
            // A frame of the producer has the picture's size, which the consumer's frame may not have.
            let known = self.consumer.textures.get(*index as usize);
            texture.framed = known.map_or(of.framed && self.drawn.size.is_none(), |known| known.framed);
        }
        if let Some(rule) = self.drawn.size {
            let named = |texture: &&Texture| {
                rule.0
                    .iter()
                    .any(|term| *term == SizeTerm::Of(texture.name.clone().into()))
            };
            for texture in self.drawn.sized.iter().filter(named) {
                if graph.textures.iter().all(|known| known.name != texture.name) {
                    let framed = false;
                    graph.textures.push(Texture {
                        framed,
                        ..texture.clone()
                    });
                }
            }
        }
        for (of, index) in producer.samplers.iter().zip(&self.maps.samplers) {
            graph.samplers[*index as usize].filters |= of.filters;
        }
        let mut purposes = graph.purposes.to_vec();
        purposes.extend(producer.purposes.iter().map(|purpose| {
            let mut purpose = purpose.clone();
            purpose.file = self.maps.files[purpose.file as usize];
            purpose
        }));
        purposes.sort();
        purposes.dedup();
        graph.purposes = Arc::from(purposes);
    }

    fn replace_node(&mut self, builder: &mut Builder<'_>, old: NodeId, new: &[Option<NodeId>]) -> Option<NodeId> {
        let node = self.consumer.node(old);
        if node.op.texture() != Some(self.texture) {
            return None;
        }
        match node.op {
            Op::Load { .. } => {
                let coordinate = new[node.args[0].0 as usize].expect("arguments are built before their users");
                let texel = self.texel(builder, coordinate);
                Some(with_components(builder, texel, node.ty))
            }
            Op::TextureSize(_) => Some(self.picture_size(builder)),
            Op::TextureLevels(_) => Some(builder.i32(1)),
            _ => None,
        }
    }
}

impl Fuse<'_> {
    /// Computes the texel at a coordinate, which lies inside the picture.
    fn texel(&mut self, builder: &mut Builder<'_>, coordinate: NodeId) -> NodeId {
        if let Some(texel) = self.texels.get(&coordinate) {
            return *texel;
        }
        let producer = self.drawn.graph;
        let mut made: Vec<NodeId> = Vec::with_capacity(producer.nodes.len());
        for id in producer.node_ids() {
            self.too_large |= limits::exceeded_limit(builder.graph().nodes.len()).is_some();
            if self.too_large {
                return builder.constant(producer.targets[0].ty, [0; 4]);
            }
            let node = producer.node(id);
            let args: Vec<NodeId> = node.args.iter().map(|arg| made[arg.0 as usize]).collect();
            let copy = match &node.op {
                Op::Pixel => coordinate,
                Op::FrameSize => self.picture_size(builder),
                Op::Extract(0) if builder.graph().ty(args[0]) == node.ty => args[0],
                op => {
                    let op = self.mapped(op);
                    let ty = match (&op, op.texture()) {
                        (Op::Load { .. } | Op::Sample { .. }, Some(texture)) => {
                            builder.graph().textures[texture as usize].texel_type()
                        }
                        _ => node.ty,
                    };
                    match op {
                        Op::Const(_) => builder.intern(op, args, ty),
                        op => builder.add(op, args, ty),
                    }
                }
            };
            let file = |of: u32| self.maps.files.get(of as usize).copied().unwrap_or(of);
            builder.place_nodes(|| {
                let mut place = producer.place(id)?.clone();
                place.span.file = file(place.span.file);
                Some(place)
            });
            if let Some(origin) = producer.origin(id) {
                let mut origin = origin.clone();
                origin.file = file(origin.file);
                if copy != coordinate {
                    builder.set_origin(copy, &origin);
                }
            }
            made.push(copy);
        }
        let texel = made[producer.outputs()[0].0 as usize];
        self.texels.insert(coordinate, texel);
        texel
    }

    /// An operation of the producer on the tables of the fused kernel.
    fn mapped(&self, op: &Op) -> Op {
        let mut op = op.clone();
        let maps = &self.maps;
        match &mut op {
            Op::Load { texture, .. }
            | Op::TextureSize(texture)
            | Op::TextureLevels(texture)
            | Op::TextureLayers(texture) => {
                *texture = maps.textures[*texture as usize];
            }
            Op::Sample { texture, sampler, .. }
            | Op::Gather { texture, sampler, .. }
            | Op::Compare { texture, sampler, .. }
            | Op::GatherCompare { texture, sampler, .. } => {
                *texture = maps.textures[*texture as usize];
                *sampler = maps.samplers[*sampler as usize];
            }
            Op::BufferLen(buffer) | Op::BufferLoad { buffer, .. } => *buffer = maps.buffers[*buffer as usize],
            Op::Uniform(uniform) => *uniform = maps.uniforms[*uniform as usize],
            Op::Override(of) => *of = maps.overrides[*of as usize],
            Op::Tally(tally) => *tally = maps.tallies[*tally as usize],
            _ => {}
        }
        op
    }

    /// Width and height of the picture.
    fn picture_size(&self, builder: &mut Builder<'_>) -> NodeId {
        match self.drawn.size {
            None => builder.add(Op::FrameSize, [], PAIR),
            Some(rule) => size_node(builder, rule),
        }
    }
}

/// A size by its rule, in the sizes of textures that the graph has.
fn size_node(builder: &mut Builder<'_>, rule: &SizeRule) -> NodeId {
    let builder = RefCell::new(builder);
    let number = |[x, y]: [u32; 2]| builder.borrow_mut().constant(PAIR, [x, y, 0, 0]);
    let of = |name: &str| {
        let mut builder = builder.borrow_mut();
        let textures = &builder.graph().textures;
        let index = textures.iter().position(|texture| texture.name == name);
        let index = index.ok_or_else(|| BadRule(format!("no texture `{name}`")))?;
        let op = match textures[index].framed {
            true => Op::FrameSize,
            false => Op::TextureSize(index as u32),
        };
        Ok(builder.add(op, [], PAIR))
    };
    let apply = |op: SizeOp, a: NodeId, b: NodeId| {
        let op = match op {
            SizeOp::Add => BinaryOp::Add,
            SizeOp::Sub => BinaryOp::Sub,
            SizeOp::Mul => BinaryOp::Mul,
            SizeOp::Div => BinaryOp::Div,
            SizeOp::Max => BinaryOp::Max,
            SizeOp::Min => BinaryOp::Min,
        };
        builder.borrow_mut().add(Op::Binary(op), [a, b], PAIR)
    };
    let size = rule.fold(of, number, apply).expect("the textures were added before");
    let builder = builder.into_inner();
    let one = builder.constant(PAIR, [1, 1, 0, 0]);
    builder.add(Op::Binary(BinaryOp::Max), [size, one], PAIR)
}

/// A texel with as many components as `ty` has, of one with at least as many.
fn with_components(builder: &mut Builder<'_>, texel: NodeId, ty: Type) -> NodeId {
    if builder.graph().ty(texel) == ty {
        return texel;
    }
    let scalar = ty.scalar_kind().map_or(Type::F32, Type::scalar);
    let parts: Vec<NodeId> = (0..ty.component_count())
        .map(|k| builder.add(Op::Extract(k), [texel], scalar))
        .collect();
    match parts.as_slice() {
        [only] => *only,
        parts => builder.add(Op::Compose, parts, ty),
    }
}

/// Appends what a table lacks, and returns the indices of all of it.
fn merge<T: Clone>(table: &mut Vec<T>, other: &[T], same: impl Fn(&T, &T) -> bool) -> Vec<u32> {
    let index = |of: &T, table: &mut Vec<T>| match table.iter().position(|known| same(known, of)) {
        Some(index) => index as u32,
        None => {
            table.push(of.clone());
            table.len() as u32 - 1
        }
    };
    other.iter().map(|of| index(of, table)).collect()
}
