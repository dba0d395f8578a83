//! Row numbers that count from below.

use super::fold::Exact;
use crate::ir::{
    BinaryOp, Builder, Graph, NodeId, Op, Origin, Rebuild, Rules, Scalar, TextureKind, Type, rebuild_graph,
};

const PAIR: Type = Type::value(Scalar::I32, 2);
const PLACE: Type = Type::value(Scalar::F32, 2);

/// Returns the kernel for textures whose row 0 is the lowest. Every row number is converted. [`Op::Pixel`] and values
/// computed from it still count from above; the entry point converts it.
///
/// Reads return the texels that the kernel expects. A filtered position `v` becomes `1 - v`, the same position for every
/// address mode; the four texels of a gather are reordered. Volumes and cubes are not images: they are the same for every
/// host.
pub fn from_below(graph: &Graph) -> Graph {
    let pass = Rebuild {
        rules: &FromBelow { graph },
        share_loads: false,
    };
    rebuild_graph(graph, &pass)
}

struct FromBelow<'g> {
    graph: &'g Graph,
}

impl Rules for FromBelow<'_> {
    fn simplify(&self, b: &mut Builder<'_>, op: &Op, args: &[NodeId], ty: Type) -> Option<NodeId> {
        let kind = op.texture().map(|texture| self.graph.textures[texture as usize].kind);
        if kind.is_some_and(|kind| !kind.has_rows()) {
            return Exact.simplify(b, op, args, ty);
        }
        match op {
            Op::Load { texture, .. } => {
                let indexed = usize::from(kind.is_some_and(TextureKind::is_indexed));
                let coordinate = self.flip_texel(b, *texture, args[0], args.get(1 + indexed));
                let args = [&[coordinate], &args[1..]].concat();
                Some(b.intern(op.clone(), args, ty))
            }
            Op::Sample { .. } | Op::Compare { .. } => {
                let args = [&[flip_place(b, args[0])], &args[1..]].concat();
                Some(b.intern(op.clone(), args, ty))
            }
            Op::Gather { .. } | Op::GatherCompare { .. } => {
                let args = [&[flip_place(b, args[0])], &args[1..]].concat();
                let texels = b.intern(op.clone(), args, ty);
                // Lower left, lower right, upper right, upper left.
                let turned = [3, 2, 1, 0].map(|k| b.add(Op::Extract(k), [texels], Type::F32));
                Some(b.add(Op::Compose, turned, ty))
            }
            _ => Exact.simplify(b, op, args, ty),
        }
    }
}

impl FromBelow<'_> {
    /// Converts a texel's row to count from below. Coordinates have already been clamped to the texture.
    fn flip_texel(&self, b: &mut Builder<'_>, texture: u32, coordinate: NodeId, level: Option<&NodeId>) -> NodeId {
        let size = match self.graph.textures[texture as usize].framed {
            true => Op::FrameSize,
            false => Op::TextureSize(texture),
        };
        let size = b.add(size, Vec::new(), PAIR);
        let mut height = b.add(Op::Extract(1), [size], Type::I32);
        let one = b.constant(Type::I32, [1, 0, 0, 0]);
        if let Some(level) = level {
            let halved = b.add(Op::Binary(BinaryOp::Shr), [height, *level], Type::I32);
            height = b.add(Op::Binary(BinaryOp::Max), [halved, one], Type::I32);
        }
        let last = b.add(Op::Binary(BinaryOp::Sub), [height, one], Type::I32);
        name_node(b, last, "last_row", coordinate);
        let [x, y] = [0, 1].map(|k| b.add(Op::Extract(k), [coordinate], Type::I32));
        let row = b.add(Op::Binary(BinaryOp::Sub), [last, y], Type::I32);
        b.add(Op::Compose, [x, row], PAIR)
    }
}

/// Converts a position between 0 and 1 to a height from below.
fn flip_place(b: &mut Builder<'_>, place: NodeId) -> NodeId {
    let [u, v] = [0, 1].map(|k| b.add(Op::Extract(k), [place], Type::F32));
    let one = b.constant(Type::F32, [1.0f32.to_bits(), 0, 0, 0]);
    let turned = b.add(Op::Binary(BinaryOp::Sub), [one, v], Type::F32);
    let at = b.add(Op::Compose, [u, turned], PLACE);
    name_node(b, at, "from_below", place);
    at
}

/// Names a value and copies its source location from another.
fn name_node(b: &mut Builder<'_>, id: NodeId, name: &str, like: NodeId) {
    if let Some(origin) = b.graph().origin(like).cloned() {
        let origin = Origin {
            name: name.into(),
            counters: [].into(),
            ..origin
        };
        b.set_origin(id, &origin);
    }
}
