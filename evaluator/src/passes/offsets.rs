//! Which texels are read at a constant offset from the pixel.

use crate::ir::{BinaryOp, Graph, Node, NodeId, Op, Scalar, UnaryOp};

/// Numbers beyond which nothing is followed: pixels are fewer, so that no sum wraps.
const FARTHEST: i64 = 1 << 24;

/// A component of a coordinate, as far as it follows from the pixel, which lies inside the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// A constant.
    Known(i64),
    /// The frame's width or height and so much.
    Size(i64),
    /// The pixel's and so much.
    Away(i64),
    /// The same brought into the frame, from outside at most on the side to which it lies.
    Inside(i64),
}

use Place::{Away, Inside, Known, Size};

/// The first two components of a value.
type Places = [Option<Place>; 2];

/// By node, the offset from the pixel at which a texel with this coordinate lies, before it is brought into the frame. `None` where
/// it is no such coordinate.
pub fn offsets(graph: &Graph) -> Vec<Option<[i32; 2]>> {
    let mut places: Vec<Places> = Vec::with_capacity(graph.nodes.len());
    for id in graph.ids() {
        let node = graph.node(id);
        let is_integer = node.ty.kind() == Some(Scalar::I32) && !node.ty.is_array();
        places.push(match is_integer {
            true => [0, 1].map(|component| place(graph, node, component, &places)),
            false => [None; 2],
        });
    }
    let offset = |places: &Places| -> Option<[i32; 2]> {
        let [x, y] = places.map(|place| match place {
            Some(Inside(by)) => Some(by as i32),
            Some(Away(0)) => Some(0),
            _ => None,
        });
        Some([x?, y?])
    };
    places.iter().map(offset).collect()
}

/// A component of a node's value.
fn place(graph: &Graph, node: &Node, component: usize, places: &[Places]) -> Option<Place> {
    if component >= usize::from(node.ty.lanes()) {
        return None;
    }
    let whole = |id: NodeId, component: usize| places[id.0 as usize].get(component).copied().flatten();
    let arg = |k: usize| whole(node.args[k], component);
    let found = match &node.op {
        Op::Const(bits) => Known(i64::from(bits[component] as i32)),
        Op::Pixel => Away(0),
        Op::FrameSize => Size(0),
        Op::TextureSize(texture) if graph.textures[*texture as usize].framed => Size(0),
        Op::Splat => whole(node.args[0], 0)?,
        Op::Compose => whole(node.args[component], 0)?,
        Op::Extract(of) => whole(node.args[0], usize::from(*of))?,
        Op::Tally(_) => arg(0)?,
        Op::Unary(UnaryOp::Neg) => match arg(0)? {
            Known(n) => Known(-n),
            _ => return None,
        },
        Op::Binary(BinaryOp::Add) => match (arg(0)?, arg(1)?) {
            (Known(n), other) | (other, Known(n)) => moved(other, n)?,
            _ => return None,
        },
        Op::Binary(BinaryOp::Sub) => match (arg(0)?, arg(1)?) {
            (other, Known(n)) => moved(other, -n)?,
            _ => return None,
        },
        Op::Binary(BinaryOp::Max) => match (arg(0)?, arg(1)?) {
            (Known(0), other) | (other, Known(0)) => not_before(other)?,
            _ => return None,
        },
        Op::Binary(BinaryOp::Min) => match (arg(0)?, arg(1)?) {
            (Size(-1), other) | (other, Size(-1)) => not_behind(other)?,
            _ => return None,
        },
        Op::Clamp => match (arg(1)?, arg(2)?) {
            (Known(0), Size(-1)) => not_behind(not_before(arg(0)?)?)?,
            _ => return None,
        },
        _ => return None,
    };
    let (Known(n) | Size(n) | Away(n) | Inside(n)) = found;
    (-FARTHEST..=FARTHEST).contains(&n).then_some(found)
}

fn moved(place: Place, by: i64) -> Option<Place> {
    Some(match place {
        Known(n) => Known(n + by),
        Size(n) => Size(n + by),
        Away(n) => Away(n + by),
        // What has been brought to the border lies at another offset there.
        Inside(n) => return (by == 0).then_some(Inside(n)),
    })
}

/// At least 0. What lies before the pixel is never behind the last one.
fn not_before(place: Place) -> Option<Place> {
    match place {
        Away(n) if n < 0 => Some(Inside(n)),
        Away(_) | Inside(_) => Some(place),
        Known(_) | Size(_) => None,
    }
}

/// At most the last pixel's. What lies behind the pixel is never before the first one.
fn not_behind(place: Place) -> Option<Place> {
    match place {
        Away(n) if n > 0 => Some(Inside(n)),
        Away(_) | Inside(_) => Some(place),
        Known(_) | Size(_) => None,
    }
}
