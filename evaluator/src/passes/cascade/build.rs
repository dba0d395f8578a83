//! The kernel of a cascade: for each picture, a phase in which the threads compute its tile.

use super::{Cascade, PAIR, Part, Tile};
use crate::ir::{
    BinaryOp, Builder, Graph, Invocation, Memory, Node, NodeId, Op, OutputTarget, SharedArray, Texture, Type,
};
use crate::passes::fold::Exact;
use crate::passes::fuse::Unfused;
use crate::passes::inline::{Maps, Pixel, add_sized, inline_texel, size_node, with_components};
use crate::passes::nodes::{add, name_node, take_turns};
use crate::passes::tiles::{taken_names, unused_name};
use rustc_hash::FxHashMap;

/// Returns the kernel of workgroups that computes the pictures of `cascade`, which was planned for `parts`. Its images are the
/// stored pictures, and `sized` has the textures that sizes name.
///
/// # Errors
///
/// If the kernel has too many operations.
pub fn compute_cascade(parts: &[Part<'_>], sized: &[Texture], cascade: &Cascade) -> Result<Graph, Unfused> {
    let mut b = Builder::new(&Exact);
    let maps = merge_tables(&mut b, parts, sized, cascade);
    let stored = parts.iter().filter(|part| part.stored).count();
    let [local, origin] = [Op::Thread, Op::GroupOrigin].map(|op| b.add(op, [], PAIR));
    let [x, y] = [0, 1].map(|k| b.add(Op::Extract(k), [local], Type::I32));
    let width = b.i32(Cascade::THREADS[0] as i32);
    let row = add(&mut b, BinaryOp::Mul, y, width);
    let index = add(&mut b, BinaryOp::Add, row, x);
    name_node(&mut b, index, "index");
    let mut phases = Phases {
        parts,
        cascade,
        maps: &maps,
        origin,
        local,
        index,
        corners: Vec::new(),
        is_held: stored > 1,
    };
    for k in 0..parts.len() {
        if k > 0 {
            b.add_effect(Op::Barrier { buffers: false }, Vec::new(), Type::Results);
        }
        phases.compute(&mut b, k).ok_or(Unfused::TooLarge)?;
    }
    Ok(b.finish(Vec::new()))
}

/// Tables of all kernels, with the images and the workgroup memory.
fn merge_tables(b: &mut Builder<'_>, parts: &[Part<'_>], sized: &[Texture], cascade: &Cascade) -> Vec<Maps> {
    let graph = b.graph_mut();
    graph.targets.clear();
    graph.invocation = Invocation::Group(Cascade::THREADS);
    let mut maps = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        let is_part = |name: &str| parts[..k].iter().any(|other| other.name == name);
        maps.push(Maps::merged(graph, part.graph, &is_part));
        add_sized(graph, part.size, sized);
    }
    graph.textures.iter_mut().for_each(|texture| texture.framed = false);
    for (part, tile) in parts.iter().zip(&cascade.tiles).filter(|(part, _)| part.stored) {
        graph.images.push(OutputTarget {
            name: part.name.to_owned(),
            ty: part.graph.targets[0].ty,
            tile: Some(tile.step),
        });
    }
    let mut taken = taken_names(graph);
    for (part, tile) in parts[..parts.len() - 1].iter().zip(&cascade.tiles) {
        let name = unused_name(&taken, format!("{}_tile", part.name));
        taken.insert(name.clone());
        graph.shared.push(SharedArray {
            name,
            element: part.graph.targets[0].ty,
            len: tile.size[0] * tile.size[1],
            atomic: false,
            filled: true,
        });
    }
    maps
}

/// Phases of the kernel.
struct Phases<'a> {
    parts: &'a [Part<'a>],
    cascade: &'a Cascade,
    maps: &'a [Maps],
    /// Position of the workgroup, times its threads.
    origin: NodeId,
    /// Position of the thread in the workgroup, and its number.
    local: NodeId,
    index: NodeId,
    /// First texel of the tile of each picture so far.
    corners: Vec<NodeId>,
    /// `true` if a workgroup may store texels of one picture where another one has none: then places are held inside of tiles.
    is_held: bool,
}

impl Phases<'_> {
    /// Adds the phase of picture `k`. `None` if there are too many operations.
    fn compute(&mut self, b: &mut Builder<'_>, k: usize) -> Option<()> {
        let tile = &self.cascade.tiles[k];
        let base = self.base(b, tile);
        let corner = moved(b, base, tile.first);
        name_node(b, corner, "corner");
        self.corners.push(corner);
        let [across, down] = Cascade::THREADS;
        let count = (across * down, tile.size[0] * tile.size[1]);
        take_turns(b, self.index, count, &mut |b, texel| {
            self.compute_texel(b, k, base, texel)
        })
    }

    /// First texel of a picture that the workgroup stores.
    fn base(&self, b: &mut Builder<'_>, tile: &Tile) -> NodeId {
        let sides = [0, 1].map(|axis: usize| (tile.step[axis], Cascade::THREADS[axis]));
        if sides.iter().all(|(step, threads)| step == threads) {
            return self.origin;
        }
        let pair = |b: &mut Builder<'_>, of: [u32; 2]| b.constant(PAIR, [of[0], of[1], 0, 0]);
        let threads = pair(b, Cascade::THREADS);
        let group = add(b, BinaryOp::Div, self.origin, threads);
        name_node(b, group, "group");
        let step = pair(b, tile.step);
        add(b, BinaryOp::Mul, group, step)
    }

    /// Computes the texel of a tile with this number, and stores it.
    fn compute_texel(&self, b: &mut Builder<'_>, k: usize, base: NodeId, texel: NodeId) -> Option<()> {
        let (part, tile) = (&self.parts[k], &self.cascade.tiles[k]);
        let within = match tile.size == Cascade::THREADS {
            true => self.local,
            false => {
                let width = b.i32(tile.size[0] as i32);
                let [x, y] = [BinaryOp::Rem, BinaryOp::Div].map(|op| add(b, op, texel, width));
                b.add(Op::Compose, [x, y], PAIR)
            }
        };
        let place = add(b, BinaryOp::Add, self.corners[k], within);
        name_node(b, place, "place");
        let size = size_node(b, part.size);
        let (zero, one) = (b.constant(PAIR, [0; 4]), b.constant(PAIR, [1, 1, 0, 0]));
        let last = add(b, BinaryOp::Sub, size, one);
        let coordinate = b.add(Op::Clamp, [place, zero, last], PAIR);
        name_node(b, coordinate, "pixel");
        let pixel = Pixel {
            coordinate,
            size: &|b| size_node(b, part.size),
        };
        let mut found = FxHashMap::default();
        let mut replace =
            |b: &mut Builder<'_>, node: &Node, args: &[NodeId]| self.tile_texel(b, k, (node, args), &mut found);
        let value = inline_texel(b, part.graph, &self.maps[k], &pixel, &mut replace)?;
        let ty = part.graph.targets[0].ty;
        let value = with_components(b, value, ty);
        if k + 1 < self.parts.len() {
            let always = b.bool(true);
            b.add_effect(
                Op::Store(Memory::Shared(k as u32)),
                vec![always, texel, value],
                Type::Results,
            );
        }
        if part.stored {
            let image = self.parts[..k].iter().filter(|other| other.stored).count() as u32;
            let is_own = self.is_own(b, tile, (base, place, size));
            b.add_effect(
                Op::Store(Memory::Image(image)),
                vec![is_own, place, value],
                Type::Results,
            );
        }
        Some(())
    }

    /// Returns whether the workgroup stores the texel at a place: one inside the picture, and of no other workgroup.
    fn is_own(&self, b: &mut Builder<'_>, tile: &Tile, (base, place, size): (NodeId, NodeId, NodeId)) -> NodeId {
        let mut all = None;
        for axis in 0..2 {
            let [base, place, size] = [base, place, size].map(|pair| b.add(Op::Extract(axis), [pair], Type::I32));
            let k = usize::from(axis);
            let mut end = size;
            if tile.first[k] + tile.size[k] as i32 > tile.step[k] as i32 {
                let step = b.i32(tile.step[k] as i32);
                let next = add(b, BinaryOp::Add, base, step);
                end = add(b, BinaryOp::Min, size, next);
            }
            let mut tests = vec![b.add(Op::Binary(BinaryOp::Lt), [place, end], Type::BOOL)];
            if tile.first[k] < 0 {
                tests.push(b.add(Op::Binary(BinaryOp::Ge), [place, base], Type::BOOL));
            }
            for test in tests {
                all = Some(match all {
                    None => test,
                    Some(before) => b.add(Op::Binary(BinaryOp::And), [before, test], Type::BOOL),
                });
            }
        }
        all.expect("there are two axes")
    }

    /// Replacement of what picture `k` reads of earlier ones: texels of their tiles, and their sizes.
    fn tile_texel(
        &self,
        b: &mut Builder<'_>,
        k: usize,
        (node, args): (&Node, &[NodeId]),
        found: &mut FxHashMap<(usize, NodeId), NodeId>,
    ) -> Option<NodeId> {
        let texture = &self.parts[k].graph.textures[node.op.texture()? as usize];
        let read = self.parts[..k].iter().position(|other| other.name == texture.name)?;
        match node.op {
            Op::TextureSize(_) => return Some(size_node(b, self.parts[read].size)),
            Op::TextureLevels(_) => return Some(b.i32(1)),
            _ => {}
        }
        let element = b.graph().shared[read].element;
        let texel = match found.get(&(read, args[0])) {
            Some(texel) => *texel,
            None => {
                let [width, height] = self.cascade.tiles[read].size;
                let mut within = add(b, BinaryOp::Sub, args[0], self.corners[read]);
                if self.is_held {
                    let (zero, last) = (
                        b.constant(PAIR, [0; 4]),
                        b.constant(PAIR, [width - 1, height - 1, 0, 0]),
                    );
                    within = b.add(Op::Clamp, [within, zero, last], PAIR);
                }
                let [x, y] = [0, 1].map(|axis| b.add(Op::Extract(axis), [within], Type::I32));
                let width = b.i32(width as i32);
                let row = add(b, BinaryOp::Mul, y, width);
                let at = add(b, BinaryOp::Add, row, x);
                let always = b.bool(true);
                let texel = b.add_effect(Op::SharedLoad(read as u32), vec![always, at], element);
                found.insert((read, args[0]), texel);
                texel
            }
        };
        Some(with_components(b, texel, node.ty))
    }
}

/// A place plus a constant.
fn moved(b: &mut Builder<'_>, place: NodeId, by: [i32; 2]) -> NodeId {
    if by == [0, 0] {
        return place;
    }
    let by = b.constant(PAIR, [by[0] as u32, by[1] as u32, 0, 0]);
    add(b, BinaryOp::Add, place, by)
}
