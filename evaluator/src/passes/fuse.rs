//! Fusing of passes: a kernel that computes the texels of a picture where it would read them.
//!
//! Tests: `tests/tests/language/chains.rs` compares fused chains with stored ones and with rustc.

use super::fold::Exact;
use super::inline::{Maps, Pixel, add_sized, inline_texel, size_node, with_components};
use crate::ir::{
    Builder, Graph, Invocation, NodeId, Op, Rebuild, Replace, Rules, Scalar, Texture, TextureKind, Type, rebuild_graph,
    rebuild_replacing,
};
use rustc_hash::FxHashMap;
use std::fmt;
use straightline_manifest::chain::{SizeRule, SizeTerm};

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
        let graph = builder.graph_mut();
        let known = graph.textures.len();
        self.maps = Maps::merged(graph, self.drawn.graph, &|_| false);
        for (of, index) in self.drawn.graph.textures.iter().zip(&self.maps.textures) {
            // A frame of the producer has the picture's size, which the consumer's frame may not have.
            if let Some(index) = index.filter(|index| *index as usize >= known) {
                graph.textures[index as usize].framed = of.framed && self.drawn.size.is_none();
            }
        }
        if let Some(rule) = self.drawn.size {
            add_sized(graph, rule, self.drawn.sized);
        }
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
            Op::TextureSize(_) => Some(picture_size(builder, self.drawn.size)),
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
        let (drawn, maps) = (self.drawn, &self.maps);
        let size = |builder: &mut Builder<'_>| picture_size(builder, drawn.size);
        let pixel = Pixel {
            coordinate,
            size: &size,
        };
        match inline_texel(builder, drawn.graph, maps, &pixel, &mut |_, _, _| None) {
            Some(texel) => {
                self.texels.insert(coordinate, texel);
                texel
            }
            None => {
                self.too_large = true;
                builder.constant(drawn.graph.targets[0].ty, [0; 4])
            }
        }
    }
}

/// Width and height of a picture; of one of the frame's size without a rule.
fn picture_size(builder: &mut Builder<'_>, rule: Option<&SizeRule>) -> NodeId {
    match rule {
        None => builder.add(Op::FrameSize, [], PAIR),
        Some(rule) => size_node(builder, rule),
    }
}
