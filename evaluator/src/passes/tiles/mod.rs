//! Texels that the pixels of a workgroup share: read once into its memory, and from there by each pixel that needs them.
//!
//! A read takes part if it is of a texture of the frame's size, at a constant offset from the pixel that is then brought into
//! the frame, and if every pixel does it: not in a loop or branch that is left in the shader. For each texture, and each of its layers, the
//! offsets make a rectangle; that around all pixels of the workgroup is the tile. It is filled by the same reads, brought into
//! the frame alike, so that what a pixel finds there is what it would have read, bit for bit.
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

/// Why a tile was left out that would not fit beside the others.
const TOO_LARGE: &str = "its tile does not fit into 16384 bytes beside those of others";

/// Texels of a texture, or of a layer of it, that a workgroup shares.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Name in the shader.
    pub name: String,
    /// The texture's name.
    pub texture: String,
    /// The layer or sample, where there are several.
    pub layer: Option<u32>,
    /// The smallest offset across and down.
    pub first: [i32; 2],
    /// Texels across and down.
    pub size: [u32; 2],
    /// Bytes of the workgroup's memory.
    pub bytes: u64,
    /// Reads of a pixel that it stands for.
    pub reads: u32,
    /// Reads by which a thread fills its part.
    pub fills: u32,
}

impl Tile {
    /// The texture, and its layer or sample where there are several, for people.
    pub fn display_name(&self) -> String {
        match self.layer {
            Some(layer) => format!("{}[{layer}]", self.texture),
            None => self.texture.clone(),
        }
    }
}

/// Reads of a texture that stay as they are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnsharedReads {
    /// The texture's name.
    pub texture: String,
    /// Number of reads of a pixel.
    pub reads: u32,
    /// Why.
    pub why: String,
}

/// Outcome of sharing for a kernel's reads of textures.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sharing {
    /// Threads of a workgroup, across and down.
    pub threads: [u32; 2],
    /// In the order of the first read of each.
    pub tiles: Vec<Tile>,
    /// Reads that stay.
    pub unshared: Vec<UnsharedReads>,
}

impl Sharing {
    /// Bytes of a workgroup's memory.
    pub fn byte_size(&self) -> u64 {
        self.tiles.iter().map(|tile| tile.bytes).sum()
    }
}

/// Has the pixels of a workgroup of so many threads share what they read. Tiles that would take as many reads to fill as they save
/// are left out, and so are those that save the fewest where all do not fit into the memory that every device has.
///
/// # Errors
///
/// Why the kernel has no such form.
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

/// Reads that one tile could stand for.
struct Candidate {
    tile: Tile,
    texture: u32,
    /// The layer or sample, as reads have it.
    layer: Option<(Type, Bits)>,
    /// Components that some pixel uses, in order.
    components: Vec<u8>,
    /// Each read with its offset.
    loads: Vec<(NodeId, [i32; 2])>,
}

/// Reads that could be shared, by texture and layer, and those that could not.
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

    /// Type of a tile's elements. Three components take the space of four, and are read at once as four.
    fn element_type(&self, graph: &Graph) -> Type {
        let scalar = graph.textures[self.texture as usize].scalar;
        let lanes = match self.components.len() as u8 {
            3 => 4,
            lanes => lanes,
        };
        Type::value(scalar, lanes)
    }

    /// Computes the size of the tile, and the reads that it saves.
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

    /// The memory of the tile.
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

/// Reads of one texture for one reason together.
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

/// Components of each read that are used, by node.
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

/// Gives tiles names that nothing else in the shader has.
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

/// Names of what a shader binds.
pub(super) fn taken_names(graph: &Graph) -> BTreeSet<String> {
    let names = graph.textures.iter().map(|t| &t.name);
    let names = names.chain(graph.buffers.iter().map(|b| &b.name));
    let names = names.chain(graph.samplers.iter().map(|s| &s.name));
    let names = names.chain(graph.uniforms.iter().map(|u| &u.name));
    let names = names.chain(graph.varyings.iter().map(|v| &v.name));
    names.chain(graph.written_targets().map(|p| &p.name)).cloned().collect()
}

/// A name that is not taken: this one, or with a number behind it.
pub(super) fn unused_name(taken: &BTreeSet<String>, base: String) -> String {
    let names = (2..).map(|k| format!("{base}_{k}"));
    let mut names = std::iter::once(base.clone()).chain(names);
    names.find(|name| !taken.contains(name)).unwrap_or(base)
}
