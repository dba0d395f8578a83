//! Texels shared by the pixels of a workgroup: read once into its memory, and from there by each pixel that needs them.
//!
//! A read is eligible if it has a frame-sized texture and a constant offset from the pixel that is clamped to the frame,
//! and if every pixel performs it, outside loops and branches left in the shader. For each texture, and for each of its
//! layers, the offsets span a rectangle; the tile is that rectangle around all pixels of the workgroup. The same reads,
//! clamped in the same way, fill the tile, so each pixel finds there exactly the value that it would have read.
//!
//! File tests: `evaluator/tests/filetests/passes/tiles`.

mod fill;

use super::fold::Exact;
use super::offsets::pixel_offsets;
use super::schedule::schedule_graph;
use crate::ir::{
    Bits, Graph, Invocation, MOST_SHARED_BYTES, NodeId, Op, Rebuild, SharedArray, Type, rebuild_replacing,
};
use crate::policy::ReadOrder;
use fill::Tiling;
use std::collections::BTreeSet;

/// Reason for a tile that does not fit beside the others.
const TOO_LARGE: &str = "its tile does not fit into 16384 bytes beside those of others";

/// Texels of a texture, or of one of its layers, that a workgroup shares.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Name in the shader.
    pub name: String,
    /// The texture's name.
    pub texture: String,
    /// The layer or sample, if there are several.
    pub layer: Option<u32>,
    /// Smallest horizontal and vertical offset.
    pub first: [i32; 2],
    /// Width and height in texels.
    pub size: [u32; 2],
    /// Bytes of workgroup memory.
    pub bytes: u64,
    /// Number of reads per pixel that the tile replaces.
    pub reads: u32,
    /// Number of reads with which each thread fills its part.
    pub fills: u32,
}

impl Tile {
    /// Display name of the texture, with its layer or sample if there are several.
    pub fn display_name(&self) -> String {
        match self.layer {
            Some(layer) => format!("{}[{layer}]", self.texture),
            None => self.texture.clone(),
        }
    }
}

/// Reads of a texture that remain unchanged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnsharedReads {
    /// The texture's name.
    pub texture: String,
    /// Number of reads per pixel.
    pub reads: u32,
    /// Reason.
    pub why: String,
}

/// Outcome of sharing the texture reads of a kernel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sharing {
    /// Width and height of a workgroup in threads.
    pub threads: [u32; 2],
    /// Tiles in the order of the first read of each.
    pub tiles: Vec<Tile>,
    /// Reads that remain unchanged.
    pub unshared: Vec<UnsharedReads>,
}

impl Sharing {
    /// Bytes of workgroup memory in total.
    pub fn byte_size(&self) -> u64 {
        self.tiles.iter().map(|tile| tile.bytes).sum()
    }
}

/// Makes the pixels of a workgroup share their reads. Omits tiles that take as many reads to fill as they save. If the
/// tiles do not all fit into the memory that every device has, omits those that save the fewest reads.
///
/// # Errors
///
/// The reason why the kernel cannot share reads.
pub fn by_workgroup(graph: &Graph, threads: [u32; 2]) -> Result<(Graph, Sharing), String> {
    match graph.invocation {
        Invocation::Pixel => {}
        Invocation::Group(_) => {
            return Err("it is a kernel of workgroups, and says itself what its threads share".to_owned());
        }
        Invocation::Lane | Invocation::MayBeOutside | Invocation::Block(_) => {
            return Err("its invocations compute more than one pixel".to_owned());
        }
    }
    if graph.has_effects() {
        return Err("it writes to buffers or pictures, and threads outside of the frame would too".to_owned());
    }
    let (candidates, mut apart) = find_candidates(graph);
    let kept = choose_tiles(graph, candidates, threads, &mut apart);
    let mut sharing = Sharing {
        threads,
        tiles: kept.iter().map(|candidate| candidate.tile.clone()).collect(),
        unshared: merge_apart(apart),
    };
    if kept.is_empty() {
        let all = sharing.unshared.iter();
        let why: Vec<String> = all
            .map(|apart| format!("of `{}` {}", apart.texture, apart.why))
            .collect();
        return Err(match why.is_empty() {
            true => "it reads no textures".to_owned(),
            false => format!("it reads nothing that pixels can share: {}", why.join("; ")),
        });
    }
    name_tiles(graph, &mut sharing.tiles);
    let mut tiling = Tiling::new(graph, threads, &kept, &sharing.tiles);
    let pass = Rebuild {
        rules: &Exact,
        share_loads: false,
    };
    let made = rebuild_replacing(graph, &pass, &mut tiling);
    Ok((made, sharing))
}

/// Reads that one tile could replace.
struct Candidate {
    tile: Tile,
    texture: u32,
    /// The layer or sample, as given by the reads.
    layer: Option<(Type, Bits)>,
    /// Components that some pixel uses, in order.
    components: Vec<u8>,
    /// Each read with its offset.
    loads: Vec<(NodeId, [i32; 2])>,
}

/// Reads that can be shared, by texture and layer, and those that cannot.
fn find_candidates(graph: &Graph) -> (Vec<Candidate>, Vec<UnsharedReads>) {
    let schedule = schedule_graph(graph, ReadOrder::Source);
    let offsets = pixel_offsets(graph);
    let components = components_used(graph);
    let mut all: Vec<Candidate> = Vec::new();
    let mut apart = Vec::new();
    for id in graph.node_ids().filter(|id| schedule.has_node(*id)) {
        let node = graph.node(id);
        let Some(index) = node.op.texture().filter(|_| node.op.is_read()) else {
            continue;
        };
        let texture = &graph.textures[index as usize];
        let mut stays = |why: &str| {
            apart.push(UnsharedReads {
                texture: texture.name.clone(),
                reads: 1,
                why: why.to_owned(),
            });
        };
        let indexed = usize::from(texture.kind.is_indexed());
        let layer = (indexed == 1).then(|| node.args[1]);
        let known = layer.map(|layer| graph.constant_bits(layer).map(|bits| (graph.ty(layer), bits)));
        match (&node.op, offsets[node.args[0].0 as usize], known) {
            (Op::Load { .. }, ..) if !texture.framed => stays("it has a size of its own"),
            (Op::Load { .. }, ..) if node.args.len() > 1 + indexed => stays("a coarser level is read"),
            (Op::Load { .. }, _, Some(None)) => stays("the layer or sample is a runtime value"),
            (Op::Load { .. }, None, _) => stays("the offset is no constant"),
            (Op::Load { .. }, ..) if schedule.place[id.0 as usize] != Some(Graph::BODY) => {
                stays("it is read in a loop or branch");
            }
            (Op::Load { .. }, Some(offset), layer) => {
                let layer = layer.flatten();
                let same = |candidate: &&mut Candidate| candidate.texture == index && candidate.layer == layer;
                let found = match all.iter_mut().find(same) {
                    Some(found) => found,
                    None => {
                        all.push(Candidate::new(graph, index, layer));
                        all.last_mut().expect("it was pushed")
                    }
                };
                found.loads.push((id, offset));
                found.components.extend(&components[id.0 as usize]);
            }
            _ => stays("a sampler reads it"),
        }
    }
    (all, apart)
}

impl Candidate {
    fn new(graph: &Graph, texture: u32, layer: Option<(Type, Bits)>) -> Candidate {
        Candidate {
            tile: Tile {
                name: String::new(),
                texture: graph.textures[texture as usize].name.clone(),
                layer: layer.map(|(_, bits)| bits[0]),
                first: [0; 2],
                size: [0; 2],
                bytes: 0,
                reads: 0,
                fills: 0,
            },
            texture,
            layer,
            components: Vec::new(),
            loads: Vec::new(),
        }
    }

    /// Type of a tile's elements. Three components take the space of four, and are read as four at once.
    fn element_type(&self, graph: &Graph) -> Type {
        let scalar = graph.textures[self.texture as usize].scalar;
        let lanes = match self.components.len() as u8 {
            3 => 4,
            lanes => lanes,
        };
        Type::value(scalar, lanes)
    }

    /// Computes the size of the tile, and the number of reads that it saves.
    fn measure_tile(&mut self, graph: &Graph, threads: [u32; 2]) {
        self.components.sort_unstable();
        self.components.dedup();
        for axis in 0..2 {
            let all = || self.loads.iter().map(|(_, offset)| offset[axis]);
            let (first, last) = (all().min().unwrap_or(0), all().max().unwrap_or(0));
            self.tile.first[axis] = first;
            self.tile.size[axis] = threads[axis] + first.abs_diff(last);
        }
        let texels = self.texels();
        self.tile.reads = self.loads.len() as u32;
        self.tile.fills = u32::try_from(texels.div_ceil(u64::from(threads[0] * threads[1]))).unwrap_or(u32::MAX);
        self.tile.bytes = self.tile_memory(graph).byte_size().max(texels);
    }

    fn texels(&self) -> u64 {
        u64::from(self.tile.size[0]) * u64::from(self.tile.size[1])
    }

    /// Shared memory of the tile.
    fn tile_memory(&self, graph: &Graph) -> SharedArray {
        SharedArray {
            name: self.tile.name.clone(),
            element: self.element_type(graph),
            len: u32::try_from(self.texels()).unwrap_or(u32::MAX),
            atomic: false,
            filled: true,
        }
    }

    fn saved_reads(&self) -> u32 {
        self.tile.reads.saturating_sub(self.tile.fills)
    }
}

/// Returns the tiles that save reads and fit into the memory together.
fn choose_tiles(
    graph: &Graph,
    candidates: Vec<Candidate>,
    threads: [u32; 2],
    apart: &mut Vec<UnsharedReads>,
) -> Vec<Candidate> {
    let mut kept = Vec::new();
    let mut leave = |candidate: &Candidate, why: String| {
        apart.push(UnsharedReads {
            texture: candidate.tile.texture.clone(),
            reads: candidate.tile.reads,
            why,
        });
    };
    for mut candidate in candidates {
        candidate.measure_tile(graph, threads);
        let [width, height] = candidate.tile.size;
        match candidate.saved_reads() {
            0 if candidate.tile.reads == 1 => leave(&candidate, "a pixel reads one texel".to_owned()),
            0 => {
                let fills = candidate.tile.fills;
                let many = if fills == 1 { "read" } else { "reads" };
                leave(
                    &candidate,
                    format!("a tile of {width}x{height} texels takes {fills} {many} of each thread"),
                );
            }
            _ => kept.push(candidate),
        }
    }
    while kept.iter().map(|candidate| candidate.tile.bytes).sum::<u64>() > MOST_SHARED_BYTES {
        let least = (0..kept.len()).min_by_key(|k| (kept[*k].saved_reads(), u64::MAX - kept[*k].tile.bytes));
        let Some(least) = least else { break };
        leave(&kept.remove(least), TOO_LARGE.to_owned());
    }
    kept
}

/// Merges reads of one texture that have the same reason.
fn merge_apart(apart: Vec<UnsharedReads>) -> Vec<UnsharedReads> {
    let mut all: Vec<UnsharedReads> = Vec::new();
    for one in apart {
        match all.iter_mut().find(|a| a.texture == one.texture && a.why == one.why) {
            Some(same) => same.reads += one.reads,
            None => all.push(one),
        }
    }
    all
}

/// Used components of each read, by node.
pub(super) fn components_used(graph: &Graph) -> Vec<BTreeSet<u8>> {
    let mut used = vec![BTreeSet::new(); graph.nodes.len()];
    let mut whole = |id: NodeId| used[id.0 as usize].extend(0..graph.ty(id).component_count());
    graph.outputs().iter().for_each(|id| whole(*id));
    for region in &graph.regions {
        region.yielded_values().for_each(&mut whole);
    }
    for id in graph.node_ids() {
        let node = graph.node(id);
        match node.op {
            Op::Extract(component) => _ = used[node.args[0].0 as usize].insert(component),
            _ => {
                for arg in &node.args {
                    used[arg.0 as usize].extend(0..graph.ty(*arg).component_count());
                }
            }
        }
    }
    used
}

/// Names the tiles uniquely in the shader.
fn name_tiles(graph: &Graph, tiles: &mut [Tile]) {
    let mut taken = taken_names(graph);
    for tile in tiles {
        let base = match tile.layer {
            Some(layer) => format!("{}_{layer}_tile", tile.texture),
            None => format!("{}_tile", tile.texture),
        };
        tile.name = unused_name(&taken, base);
        taken.insert(tile.name.clone());
    }
}

/// Names of all bindings of a shader.
pub(super) fn taken_names(graph: &Graph) -> BTreeSet<String> {
    let names = graph.textures.iter().map(|t| &t.name);
    let names = names.chain(graph.buffers.iter().map(|b| &b.name));
    let names = names.chain(graph.samplers.iter().map(|s| &s.name));
    let names = names.chain(graph.uniforms.iter().map(|u| &u.name));
    let names = names.chain(graph.overrides.iter().map(|o| &o.name));
    let names = names.chain(graph.varyings.iter().map(|v| &v.name));
    names.chain(graph.written_targets().map(|p| &p.name)).cloned().collect()
}

/// A name that is not taken: `base`, or `base` with a number appended.
pub(super) fn unused_name(taken: &BTreeSet<String>, base: String) -> String {
    let names = (2..).map(|k| format!("{base}_{k}"));
    let mut names = std::iter::once(base.clone()).chain(names);
    names.find(|name| !taken.contains(name)).unwrap_or(base)
}
