//! Filling and reading of tiles.

use super::{Candidate, Tile};
use crate::ir::{BinaryOp, Bits, Builder, Graph, Invocation, Memory, NodeId, Op, Replace, Scalar, SharedArray, Type};
use crate::passes::nodes::{add, name_node, take_turns};
use std::collections::{BTreeMap, HashMap};

const PAIR: Type = Type::value(Scalar::I32, 2);

/// A tile while the graph is built.
struct Place {
    first: [i32; 2],
    size: [u32; 2],
    texture: u32,
    layer: Option<(Type, Bits)>,
    components: Vec<u8>,
    shared: SharedArray,
}

impl Place {
    /// Returns whether an element is a complete texel as returned by reads.
    fn is_whole(&self, texel: Type) -> bool {
        self.shared.element == texel && self.components.len() == usize::from(texel.component_count())
    }
}

/// Fills the tiles, and replaces reads by reads of them.
pub struct Tiling<'g> {
    old: &'g Graph,
    threads: [u32; 2],
    tiles: Vec<Place>,
    /// By read, its tile and offset.
    loads: HashMap<NodeId, (usize, [i32; 2])>,
    /// Reads whose values are used outside the loop or branch that contains them; performed before all others.
    early: HashMap<NodeId, NodeId>,
    /// By tile, the index of the element at the smallest offset.
    here: Vec<NodeId>,
}

impl<'g> Tiling<'g> {
    pub fn new(old: &'g Graph, threads: [u32; 2], kept: &[Candidate], tiles: &[Tile]) -> Tiling<'g> {
        let named = kept.iter().zip(tiles);
        let places = named.map(|(candidate, tile)| Place {
            first: tile.first,
            size: tile.size,
            texture: candidate.texture,
            layer: candidate.layer,
            components: candidate.components.clone(),
            shared: SharedArray {
                name: tile.name.clone(),
                ..candidate.tile_memory(old)
            },
        });
        let loads = kept.iter().enumerate().flat_map(|(k, candidate)| {
            let loads = candidate.loads.iter();
            loads.map(move |(id, offset)| (*id, (k, *offset)))
        });
        Tiling {
            old,
            threads,
            tiles: places.collect(),
            loads: loads.collect(),
            early: HashMap::new(),
            here: Vec::new(),
        }
    }

    /// Fills all tiles of one rectangle.
    fn fill_tiles(&self, b: &mut Builder<'_>, tiles: &[usize], index: NodeId) {
        let Place { first, size, .. } = self.tiles[tiles[0]];
        let origin = b.add(Op::GroupOrigin, Vec::new(), PAIR);
        let offset = b.constant(PAIR, [first[0] as u32, first[1] as u32, 0, 0]);
        let corner = add(b, BinaryOp::Add, origin, offset);
        name_node(b, corner, "corner");
        let count = (self.threads[0] * self.threads[1], size[0] * size[1]);
        take_turns(b, index, count, &mut |b, texel| {
            self.fill_texel(b, tiles, corner, texel);
            Some(())
        });
    }

    /// Fills one element of each of the given tiles.
    fn fill_texel(&self, b: &mut Builder<'_>, tiles: &[usize], corner: NodeId, texel: NodeId) {
        let width = b.i32(self.tiles[tiles[0]].size[0] as i32);
        let [x, y] = [BinaryOp::Rem, BinaryOp::Div].map(|op| add(b, op, texel, width));
        let place = b.add(Op::Compose, [x, y], PAIR);
        let place = add(b, BinaryOp::Add, corner, place);
        let (zero, last) = (b.constant(PAIR, [0; 4]), last_pixel(b));
        let at = b.add(Op::Clamp, [place, zero, last], PAIR);
        name_node(b, at, "at");
        let always = b.bool(true);
        for k in tiles {
            let tile = &self.tiles[*k];
            let mut args = vec![at];
            args.extend(tile.layer.map(|(ty, bits)| b.constant(ty, bits)));
            let ty = b.graph().textures[tile.texture as usize].texel_type();
            let read = Op::Load {
                texture: tile.texture,
                site: 0,
            };
            let read = b.add(read, args, ty);
            let value = match tile.is_whole(ty) {
                true => read,
                false => {
                    let scalar = Type::scalar(b.graph().textures[tile.texture as usize].scalar);
                    let used = tile.components.iter();
                    let used = used.map(|component| match ty.is_scalar() {
                        true => read,
                        false => b.add(Op::Extract(*component), [read], scalar),
                    });
                    let mut used: Vec<NodeId> = used.collect();
                    used.resize_with(usize::from(tile.shared.element.component_count()), || {
                        b.constant(scalar, [0; 4])
                    });
                    match used[..] {
                        [one] => one,
                        _ => b.add(Op::Compose, used, tile.shared.element),
                    }
                }
            };
            let memory = Memory::Shared(*k as u32);
            b.add_effect(Op::Store(memory), vec![always, texel, value], Type::Results);
        }
    }

    /// A texel from a tile, in the type of the read that it replaces; components missing from the tile are unused.
    fn tile_texel(&self, b: &mut Builder<'_>, load: NodeId) -> Option<NodeId> {
        let (k, offset) = *self.loads.get(&load)?;
        let tile = &self.tiles[k];
        let [across, down] = [0, 1].map(|axis| offset[axis] - tile.first[axis]);
        let behind = b.i32(down * tile.size[0] as i32 + across);
        let element = add(b, BinaryOp::Add, self.here[k], behind);
        let always = b.bool(true);
        let found = b.add_effect(Op::SharedLoad(k as u32), vec![always, element], tile.shared.element);
        if let Some(origin) = self.old.origin(load) {
            b.set_origin(found, origin);
        }
        let ty = b.graph().textures[tile.texture as usize].texel_type();
        if tile.is_whole(ty) {
            return Some(found);
        }
        let scalar = Type::scalar(b.graph().textures[tile.texture as usize].scalar);
        let part = |b: &mut Builder<'_>, component: u8| {
            let at = tile.components.iter().position(|c| *c == component);
            match at {
                Some(_) if tile.shared.element.is_scalar() => found,
                Some(at) => b.add(Op::Extract(at as u8), [found], scalar),
                None => b.constant(scalar, [0; 4]),
            }
        };
        let parts: Vec<NodeId> = (0..ty.component_count()).map(|component| part(b, component)).collect();
        Some(b.add(Op::Compose, parts, ty))
    }
}

impl Replace for Tiling<'_> {
    fn add_prologue(&mut self, b: &mut Builder<'_>) {
        b.graph_mut().invocation = Invocation::Group(self.threads);
        b.graph_mut().shared = self.tiles.iter().map(|tile| tile.shared.clone()).collect();
        let local = b.add(Op::Thread, Vec::new(), PAIR);
        let [x, y] = [0, 1].map(|k| b.add(Op::Extract(k), [local], Type::I32));
        let row_of = |b: &mut Builder<'_>, width: u32| {
            let width = b.i32(width as i32);
            let row = add(b, BinaryOp::Mul, y, width);
            add(b, BinaryOp::Add, row, x)
        };
        let index = row_of(b, self.threads[0]);
        name_node(b, index, "index");
        let mut rectangles: BTreeMap<([i32; 2], [u32; 2]), Vec<usize>> = BTreeMap::new();
        for (k, tile) in self.tiles.iter().enumerate() {
            rectangles.entry((tile.first, tile.size)).or_default().push(k);
        }
        let mut rectangles: Vec<Vec<usize>> = rectangles.into_values().collect();
        rectangles.sort();
        for tiles in rectangles {
            self.fill_tiles(b, &tiles, index);
        }
        b.add_effect(Op::Barrier { buffers: false }, Vec::new(), Type::Results);
        for tile in &self.tiles {
            let here = row_of(b, tile.size[0]);
            name_node(b, here, "here");
            self.here.push(here);
        }
        let mut inner: Vec<NodeId> = self.loads.keys().copied().collect();
        inner.retain(|load| self.old.homes[load.0 as usize] != Graph::BODY);
        inner.sort_unstable();
        for load in inner {
            if let Some(texel) = self.tile_texel(b, load) {
                self.early.insert(load, texel);
            }
        }
    }

    fn replace_node(&mut self, b: &mut Builder<'_>, old: NodeId, _: &[Option<NodeId>]) -> Option<NodeId> {
        if let Some(texel) = self.early.get(&old) {
            return Some(*texel);
        }
        if self.old.node(old).op != Op::Pixel {
            return self.tile_texel(b, old);
        }
        // A thread outside the frame computes the nearest pixel, so that all facts about pixels hold.
        let (pixel, last) = (b.add(Op::Pixel, Vec::new(), PAIR), last_pixel(b));
        let inside = add(b, BinaryOp::Min, pixel, last);
        name_node(b, inside, "nearest");
        Some(inside)
    }
}

/// The frame's last pixel.
fn last_pixel(b: &mut Builder<'_>) -> NodeId {
    let (frame, one) = (b.add(Op::FrameSize, Vec::new(), PAIR), b.constant(PAIR, [1, 1, 0, 0]));
    let last = add(b, BinaryOp::Sub, frame, one);
    name_node(b, last, "last");
    last
}
