//! The lower bound (*floor*) of a kernel: its reads and stores, with almost nothing between. No form of the kernel can be
//! faster, so the time above the floor is the cost of its arithmetic.

use super::fold::Exact;
use crate::ir::{BinaryOp, Builder, Graph, NodeId, Op, Scalar, Type, copy_tables};
use std::collections::HashSet;

const PAIR: Type = Type::value(Scalar::I32, 2);
const PLACE: Type = Type::value(Scalar::F32, 2);
const COLOUR: Type = Type::value(Scalar::F32, 4);

/// Exceeds every texel value. The compiler cannot know that before the texel is read.
const LARGE: f32 = 1.0e30;

/// Builds a graph with the same distinct reads and the same number of outputs. Each output is the sum of all components of
/// the reads that it depended on, so no read can be dropped and no two can be merged.
///
/// The position of a read is computed as in the kernel, unless that takes another read or a transcendental function. In
/// that case the read has its own position near the pixel; if it waited for another read, it still does.
///
/// # Errors
///
/// Fails if a loop or branch is left, because the number of its reads is unknown.
pub fn build_floor(graph: &Graph) -> Result<Graph, String> {
    let is_kept = |op: &Op| matches!(op, Op::Loop(_) | Op::If(..));
    if graph.has_effects() {
        return Err("it writes more than its results, and how often depends on what it computes".to_owned());
    }
    let live = dependent_nodes(graph, graph.outputs());
    if graph
        .node_ids()
        .any(|id| live[id.0 as usize] && is_kept(&graph.node(id).op))
    {
        return Err("a loop or branch is left, and how often its reads happen is not known".to_owned());
    }
    let mut builder = Builder::new(&Exact);
    copy_tables(graph, builder.graph_mut());
    let mut floor = FloorBuilder {
        old: graph,
        builder,
        ids: vec![None; graph.nodes.len()],
        made: HashSet::new(),
        moved: 0,
    };
    let reads: Vec<NodeId> = graph
        .node_ids()
        .filter(|id| live[id.0 as usize] && graph.node(*id).op.is_read())
        .collect();
    floor.copy_plain();
    // Unchanged positions come first, so that no chosen position coincides with one of them.
    let (kept, moved): (Vec<NodeId>, Vec<NodeId>) = reads.iter().partition(|id| floor.is_placed(**id));
    for id in kept.into_iter().chain(moved) {
        floor.add_read(id);
    }
    let mut outputs = Vec::new();
    for output in graph.outputs() {
        let needed = dependent_nodes(graph, &[*output]);
        let summed: Vec<NodeId> = reads.iter().filter(|id| needed[id.0 as usize]).copied().collect();
        let sum = floor.sum_reads(&summed);
        outputs.push(floor.color_to_type(sum, graph.ty(*output)));
    }
    Ok(floor.builder.finish(outputs))
}

/// By node, whether one of `from` depends on it.
fn dependent_nodes(graph: &Graph, from: &[NodeId]) -> Vec<bool> {
    let mut inside = vec![false; graph.nodes.len()];
    let mut pending = from.to_vec();
    while let Some(id) = pending.pop() {
        if !std::mem::replace(&mut inside[id.0 as usize], true) {
            pending.extend(&graph.node(id).args);
            for region in graph.regions_of(id) {
                pending.extend(graph.region(region).yielded_values());
            }
        }
    }
    inside
}

struct FloorBuilder<'g> {
    old: &'g Graph,
    builder: Builder<'g>,
    /// By old node, its new one, for reads and for nodes that need no read and no transcendental function.
    ids: Vec<Option<NodeId>>,
    /// Reads added so far.
    made: HashSet<NodeId>,
    /// Number of reads whose position had to be chosen.
    moved: u32,
}

impl FloorBuilder<'_> {
    /// Copies the nodes that need no read and no transcendental function.
    fn copy_plain(&mut self) {
        for id in self.old.node_ids() {
            let node = self.old.node(id);
            let is_dear = match &node.op {
                Op::Unary(op) => op.is_transcendental(),
                Op::Binary(BinaryOp::Pow | BinaryOp::Atan2) => true,
                Op::Param(..) | Op::Result(_) | Op::QuadSwap(_) | Op::Derivative(_) => true,
                op => op.is_read(),
            };
            let args: Option<Vec<NodeId>> = node.args.iter().map(|a| self.ids[a.0 as usize]).collect();
            if let (false, Some(args)) = (is_dear, args) {
                let new = match &node.op {
                    Op::Const(bits) => self.builder.intern(Op::Const(*bits), args, node.ty),
                    op => self.builder.add(op.clone(), args, node.ty),
                };
                self.take_over(id, new);
            }
        }
    }

    fn take_over(&mut self, old: NodeId, new: NodeId) {
        self.ids[old.0 as usize] = Some(new);
        if let Some(origin) = self.old.origin(old) {
            self.builder.set_origin(new, origin);
        }
        self.builder.place_nodes(|| self.old.place(old).cloned());
    }

    /// Returns whether the position of a read is computed as in the kernel.
    fn is_placed(&self, read: NodeId) -> bool {
        let mut args = self.old.node(read).args.iter();
        args.all(|arg| self.ids[arg.0 as usize].is_some() && !self.old.node(*arg).op.is_read())
    }

    fn add_read(&mut self, id: NodeId) {
        let node = self.old.node(id).clone();
        let op = node.op.clone().without_site();
        let new = if self.is_placed(id) {
            let args: Vec<_> = node.args.iter().filter_map(|a| self.ids[a.0 as usize]).collect();
            self.builder.add(op, args, node.ty)
        } else {
            let awaited = self.awaited_read(&node.args);
            loop {
                let args = self.moved_args(&op, &node.args, awaited);
                self.moved += 1;
                let new = self.builder.add(op.clone(), args, node.ty);
                if !self.made.contains(&new) {
                    break new;
                }
            }
        };
        self.made.insert(new);
        self.take_over(id, new);
    }

    /// Last read that the arguments depend on, as a number.
    fn awaited_read(&mut self, args: &[NodeId]) -> Option<NodeId> {
        let needed = dependent_nodes(self.old, args);
        let is_read = |id: &NodeId| needed[id.0 as usize] && self.old.node(*id).op.is_read();
        let last = self.old.node_ids().rev().find(is_read)?;
        let last = self.ids[last.0 as usize]?;
        let float = self.as_floats(last);
        Some(match self.builder.graph().ty(float).is_scalar() {
            true => float,
            false => self.builder.add(Op::Extract(0), [float], Type::F32),
        })
    }

    /// Arguments for a read whose position cannot be computed as in the kernel.
    fn moved_args(&mut self, op: &Op, old: &[NodeId], awaited: Option<NodeId>) -> Vec<NodeId> {
        let step = self.build_step(awaited);
        let first = match op {
            Op::Load { texture, .. } => {
                let texture = *texture;
                self.texel(texture, step)
            }
            Op::BufferLoad { buffer, .. } => {
                let buffer = *buffer;
                self.element(buffer, step)
            }
            op => self.place(op.texture(), step),
        };
        let mut args = vec![first];
        for arg in &old[1..] {
            // A layer, or a reference for comparison.
            let ty = self.old.ty(*arg);
            let plain = self.ids[arg.0 as usize].filter(|_| !self.old.node(*arg).op.is_read());
            let other = match (plain, awaited) {
                (Some(plain), _) => plain,
                (None, Some(awaited)) if ty == Type::F32 => awaited,
                (None, _) => self.builder.constant(ty, [0; 4]),
            };
            args.push(other);
        }
        args
    }

    /// Next step from the pixel, different for each call; depends on `awaited` if there is one.
    fn build_step(&mut self, awaited: Option<NodeId>) -> NodeId {
        let (x, y) = ((self.moved % 5) as i32 - 2, (self.moved / 5) as i32 - 2);
        let near = self.builder.constant(PAIR, [x as u32, y as u32, 0, 0]);
        let Some(awaited) = awaited else { return near };
        let far = self.builder.constant(PAIR, [x as u32, (y + 1) as u32, 0, 0]);
        let large = self.builder.f32(LARGE);
        let is_large = self.builder.add(Op::Binary(BinaryOp::Gt), [awaited, large], Type::BOOL);
        self.builder.add(Op::Select, [is_large, far, near], PAIR)
    }

    /// Width and height of a texture, or of the frame.
    fn size(&mut self, texture: Option<u32>) -> NodeId {
        match texture {
            Some(texture) if !self.old.textures[texture as usize].framed => {
                let ty = self.old.textures[texture as usize].kind.coordinate_type();
                let size = self.builder.add(Op::TextureSize(texture), Vec::new(), ty);
                match ty {
                    PAIR => size,
                    _ => {
                        let [x, y] = [0, 1].map(|k| self.builder.add(Op::Extract(k), [size], Type::I32));
                        self.builder.add(Op::Compose, [x, y], PAIR)
                    }
                }
            }
            _ => self.builder.add(Op::FrameSize, Vec::new(), PAIR),
        }
    }

    /// Extends a pair to the components of `ty`, the third of them `last`.
    fn extend_pair(&mut self, pair: NodeId, last: NodeId, ty: Type) -> NodeId {
        if ty.component_count() == 2 {
            return pair;
        }
        let part = Type::scalar(ty.scalar_kind().unwrap_or(Scalar::F32));
        let [x, y] = [0, 1].map(|k| self.builder.add(Op::Extract(k), [pair], part));
        self.builder.add(Op::Compose, [x, y, last], ty)
    }

    fn binary(&mut self, op: BinaryOp, x: NodeId, y: NodeId) -> NodeId {
        let ty = self.builder.graph().ty(x);
        self.builder.add(Op::Binary(op), [x, y], ty)
    }

    /// Coordinate of a texel near the pixel, inside the texture. In a texture of another size, near the pixel's relative
    /// position.
    fn texel(&mut self, texture: u32, step: NodeId) -> NodeId {
        let size = self.size(Some(texture));
        let mut pixel = self.builder.add(Op::Pixel, Vec::new(), PAIR);
        if !self.old.textures[texture as usize].framed {
            let frame = self.size(None);
            let scaled = self.binary(BinaryOp::Mul, pixel, size);
            pixel = self.binary(BinaryOp::Div, scaled, frame);
        }
        let one = self.builder.constant(PAIR, [1, 1, 0, 0]);
        let zero = self.builder.constant(PAIR, [0; 4]);
        let last = self.binary(BinaryOp::Sub, size, one);
        let at = self.binary(BinaryOp::Add, pixel, step);
        let inside = self.builder.add(Op::Clamp, [at, zero, last], PAIR);
        let slice = self.builder.i32(0);
        self.extend_pair(
            inside,
            slice,
            self.old.textures[texture as usize].kind.coordinate_type(),
        )
    }

    /// Position near the pixel, from 0 to 1.
    fn place(&mut self, texture: Option<u32>, step: NodeId) -> NodeId {
        let (size, frame) = (self.size(texture), self.size(None));
        let pixel = self.builder.add(Op::Pixel, Vec::new(), PAIR);
        let half = self.builder.constant(PLACE, [0.5f32.to_bits(), 0.5f32.to_bits(), 0, 0]);
        let floats = |floor: &mut Self, id| floor.builder.add(Op::Convert, [id], PLACE);
        let (size, frame) = (floats(self, size), floats(self, frame));
        let (pixel, step) = (floats(self, pixel), floats(self, step));
        let centre = self.binary(BinaryOp::Add, pixel, half);
        let own = self.binary(BinaryOp::Div, centre, frame);
        let away = self.binary(BinaryOp::Div, step, size);
        let place = self.binary(BinaryOp::Add, own, away);
        let ty = texture.map_or(PLACE, |texture| {
            self.old.textures[texture as usize].kind.position_type()
        });
        let middle = self.builder.f32(0.5);
        self.extend_pair(place, middle, ty)
    }

    /// Index inside a buffer.
    fn element(&mut self, buffer: u32, step: NodeId) -> NodeId {
        let length = self.builder.add(Op::BufferLen(buffer), Vec::new(), Type::I32);
        let [x, y] = [0, 1].map(|lane| self.builder.add(Op::Extract(lane), [step], Type::I32));
        let five = self.builder.i32(5);
        let rows = self.binary(BinaryOp::Mul, y, five);
        let index = self.binary(BinaryOp::Add, rows, x);
        // Steps begin at (-2, -2).
        let first = self.builder.i32(12);
        let index = self.binary(BinaryOp::Add, index, first);
        let (zero, one) = (self.builder.i32(0), self.builder.i32(1));
        let last = self.binary(BinaryOp::Sub, length, one);
        self.builder.add(Op::Clamp, [index, zero, last], Type::I32)
    }

    fn as_floats(&mut self, id: NodeId) -> NodeId {
        let ty = self.builder.graph().ty(id);
        match ty.is_float() {
            true => id,
            false => self.builder.add(Op::Convert, [id], ty.with_scalar(Scalar::F32)),
        }
    }

    /// Sum of reads as a colour. Reads with the same number of components are summed first.
    fn sum_reads(&mut self, reads: &[NodeId]) -> NodeId {
        let mut sums: [Option<NodeId>; 4] = [None; 4];
        for read in reads {
            let Some(new) = self.ids[read.0 as usize] else { continue };
            let floats = self.as_floats(new);
            let slot = usize::from(self.builder.graph().ty(floats).component_count()) - 1;
            sums[slot] = Some(match sums[slot] {
                Some(sum) => self.binary(BinaryOp::Add, sum, floats),
                None => floats,
            });
        }
        let mut total: Option<NodeId> = None;
        for (k, sum) in sums.into_iter().enumerate() {
            let Some(sum) = sum else { continue };
            let colour = self.as_color(sum, k + 1);
            total = Some(match total {
                Some(total) => self.binary(BinaryOp::Add, total, colour),
                None => colour,
            });
        }
        total.unwrap_or_else(|| self.builder.constant(COLOUR, [0; 4]))
    }

    /// First components of a colour, converted to another type.
    fn color_to_type(&mut self, colour: NodeId, ty: Type) -> NodeId {
        let lanes = ty.component_count();
        let floats = Type::value(Scalar::F32, lanes);
        let mut value = colour;
        if lanes < 4 {
            let mut parts = Vec::new();
            for lane in 0..lanes {
                parts.push(self.builder.add(Op::Extract(lane), [colour], Type::F32));
            }
            value = match parts[..] {
                [one] => one,
                _ => self.builder.add(Op::Compose, parts, floats),
            };
        }
        match ty.is_float() {
            true => value,
            false => self.builder.add(Op::Convert, [value], ty),
        }
    }

    /// Extends a value with `lanes` components to a colour.
    fn as_color(&mut self, value: NodeId, lanes: usize) -> NodeId {
        match lanes {
            1 => self.builder.add(Op::Splat, [value], COLOUR),
            4 => value,
            _ => {
                let mut parts = Vec::new();
                for k in 0..4 {
                    let lane = (k % lanes) as u8;
                    parts.push(self.builder.add(Op::Extract(lane), [value], Type::F32));
                }
                self.builder.add(Op::Compose, parts, COLOUR)
            }
        }
    }
}
