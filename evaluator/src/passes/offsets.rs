//! Reads of texels at a constant offset from the pixel.

use crate::ir::{BinaryOp, Graph, Node, NodeId, Op, Scalar, UnaryOp};

/// Maximum absolute value that is followed. Frames have fewer pixels, so no sum wraps.
const FARTHEST: i64 = 1 << 24;

/// A component of a coordinate, relative to the pixel, which lies inside the frame. Every variant except the constant names
/// an axis, 0 or 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// A constant.
    Known(i64),
    /// The frame's width or height plus an offset.
    Size(usize, i64),
    /// The pixel's coordinate plus an offset.
    Away(usize, i64),
    /// `Away`, clamped to the frame. Before the clamp it can lie outside only on the side of its offset.
    Inside(usize, i64),
}

use Place::{Away, Inside, Known, Size};

/// The first two components of a value.
type Places = [Option<Place>; 2];

/// By node, the offset from the pixel of a texel with this coordinate, before it is clamped to the frame; `None` for any
/// other value.
pub fn pixel_offsets(graph: &Graph) -> Vec<Option<[i32; 2]>> {
    let mut places: Vec<Places> = Vec::with_capacity(graph.nodes.len());
    for id in graph.node_ids() {
        let node = graph.node(id);
        let is_integer = node.ty.scalar_kind() == Some(Scalar::I32) && !node.ty.is_array();
        places.push(match is_integer {
            true => [0, 1].map(|component| component_place(graph, node, component, &places)),
            false => [None; 2],
        });
    }
    let offset = |places: &Places| -> Option<[i32; 2]> {
        let along = |axis: usize| match places[axis] {
            Some(Inside(of, by)) if of == axis => Some(by as i32),
            Some(Away(of, 0)) if of == axis => Some(0),
            _ => None,
        };
        Some([along(0)?, along(1)?])
    };
    places.iter().map(offset).collect()
}

/// Place of one component of a node's value.
fn component_place(graph: &Graph, node: &Node, component: usize, places: &[Places]) -> Option<Place> {
    if component >= usize::from(node.ty.component_count()) {
        return None;
    }
    let whole = |id: NodeId, component: usize| places[id.0 as usize].get(component).copied().flatten();
    let arg = |k: usize| whole(node.args[k], component);
    let found = match &node.op {
        Op::Const(bits) => Known(i64::from(bits[component] as i32)),
        Op::Pixel => Away(component, 0),
        Op::FrameSize => Size(component, 0),
        Op::TextureSize(texture) if graph.textures[*texture as usize].framed => Size(component, 0),
        Op::Splat => whole(node.args[0], 0)?,
        Op::Compose => whole(node.args[component], 0)?,
        Op::Extract(of) => whole(node.args[0], usize::from(*of))?,
        Op::Tally(_) => arg(0)?,
        Op::Unary(UnaryOp::Neg) => match arg(0)? {
            Known(n) => Known(-n),
            _ => return None,
        },
        Op::Binary(BinaryOp::Add) => match (arg(0)?, arg(1)?) {
            (Known(n), other) | (other, Known(n)) => move_place(other, n)?,
            _ => return None,
        },
        Op::Binary(BinaryOp::Sub) => match (arg(0)?, arg(1)?) {
            (other, Known(n)) => move_place(other, -n)?,
            _ => return None,
        },
        Op::Binary(BinaryOp::Max) => match (arg(0)?, arg(1)?) {
            (Known(0), other) | (other, Known(0)) => not_before(other)?,
            _ => return None,
        },
        Op::Binary(BinaryOp::Min) => match (arg(0)?, arg(1)?) {
            (Size(axis, -1), other) | (other, Size(axis, -1)) => not_behind(other, axis)?,
            _ => return None,
        },
        Op::Clamp => match (arg(1)?, arg(2)?) {
            (Known(0), Size(axis, -1)) => not_behind(not_before(arg(0)?)?, axis)?,
            _ => return None,
        },
        _ => return None,
    };
    let (Known(n) | Size(_, n) | Away(_, n) | Inside(_, n)) = found;
    (-FARTHEST..=FARTHEST).contains(&n).then_some(found)
}

fn move_place(place: Place, by: i64) -> Option<Place> {
    Some(match place {
        Known(n) => Known(n + by),
        Size(axis, n) => Size(axis, n + by),
        Away(axis, n) => Away(axis, n + by),
        // A clamped coordinate has a different offset at the border.
        Inside(..) => return (by == 0).then_some(place),
    })
}

/// Clamps a place to at least 0. A place before the pixel never lies past the last one.
fn not_before(place: Place) -> Option<Place> {
    match place {
        Away(axis, n) if n < 0 => Some(Inside(axis, n)),
        Away(..) | Inside(..) => Some(place),
        Known(_) | Size(..) => None,
    }
}

/// Clamps a place to the last pixel along an axis. A place after the pixel never lies before the first one.
fn not_behind(place: Place, last: usize) -> Option<Place> {
    match place {
        Away(axis, _) | Inside(axis, _) if axis != last => None,
        Away(axis, n) if n > 0 => Some(Inside(axis, n)),
        Away(..) | Inside(..) => Some(place),
        Known(_) | Size(..) => None,
    }
}
