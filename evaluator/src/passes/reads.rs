//! Order of texel reads.

use crate::ir::{BinaryOp, Graph, Node, NodeId, Op, RegionId, Scalar, UnaryOp};

/// A pixel far from every border, so that no clamp affects its neighbours. The frame is twice as large.
const PIXEL: f64 = 4096.0;

/// Moves reads to the start of each region, together with the arithmetic for their coordinates, if they depend on nothing
/// else there. Reads are sorted by texture, layer and row, so that neighbours in memory are read consecutively (SRAA paper,
/// §3.1).
///
/// `steps` lists the nodes of each region in an order of evaluation, and `place` the region of each node.
pub fn rows_first(graph: &Graph, place: &[Option<RegionId>], steps: &mut [Vec<NodeId>]) {
    let mut values: Vec<Value> = Vec::with_capacity(graph.nodes.len());
    let mut plain = Vec::with_capacity(graph.nodes.len());
    for id in graph.node_ids() {
        let node = graph.node(id);
        values.push(node_value(node, &values));
        let here = |arg: &&NodeId| place[arg.0 as usize] == place[id.0 as usize];
        plain.push(is_arithmetic(graph, id) && node.args.iter().filter(here).all(|arg| plain[arg.0 as usize]));
    }
    for (k, steps) in steps.iter_mut().enumerate() {
        let region = Some(RegionId(k as u32));
        let here = |arg: &&NodeId| place[arg.0 as usize] == region;
        let mut moved: Vec<(Vec<f64>, NodeId)> = Vec::new();
        for id in steps.iter() {
            let node = graph.node(*id);
            if node.op.is_read() && node.args.iter().filter(here).all(|arg| plain[arg.0 as usize]) {
                moved.extend(sort_key(graph, node, &values).map(|key| (key, *id)));
            }
        }
        moved.sort_by(|(a, x), (b, y)| {
            let apart = a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
            apart.unwrap_or_else(|| (a.len(), x).cmp(&(b.len(), y)))
        });
        let mut needed = vec![false; graph.nodes.len()];
        for (_, id) in &moved {
            needed[id.0 as usize] = true;
        }
        for id in steps.iter().rev() {
            if needed[id.0 as usize] {
                for arg in graph.node(*id).args.iter().filter(here) {
                    needed[arg.0 as usize] = true;
                }
            }
        }
        let (first, rest): (Vec<NodeId>, Vec<NodeId>) = steps.iter().partition(|id| needed[id.0 as usize]);
        let places = first.into_iter().filter(|id| !graph.node(*id).op.is_read());
        let reads = moved.into_iter().map(|(_, id)| id);
        *steps = places.chain(reads).chain(rest).collect();
    }
}

/// Returns whether a node depends only on its arguments, so that it may move freely in its region.
fn is_arithmetic(graph: &Graph, id: NodeId) -> bool {
    let node = graph.node(id);
    let waits = node.op.is_read()
        || node.op.is_effect()
        || node.ty.is_array()
        || !graph.regions_of(id).is_empty()
        || matches!(
            node.op,
            Op::Result(_) | Op::ArrayGet | Op::QuadSwap(_) | Op::Derivative(_)
        );
    !waits
}

/// Sort key of a read: texture or buffer, then layer, level and similar, then row and column. `None` if its position is not
/// relative to the pixel.
fn sort_key(graph: &Graph, node: &Node, values: &[Value]) -> Option<Vec<f64>> {
    let resource = match (&node.op, node.op.texture()) {
        (_, Some(texture)) => f64::from(texture),
        (Op::BufferLoad { buffer, .. }, _) => f64::from(graph.textures.len() as u32 + buffer),
        _ => return None,
    };
    let (at, others) = node.args.split_first()?;
    let mut key = vec![resource];
    for other in others {
        key.extend(values[other.0 as usize].iter().flatten());
    }
    key.extend(values[at.0 as usize].as_ref()?.iter().rev());
    Some(key)
}

/// Components of a value at [`PIXEL`], if it depends only on the pixel and on sizes.
type Value = Option<Vec<f64>>;

/// Value of a node, computed from those of earlier nodes.
fn node_value(node: &Node, values: &[Value]) -> Value {
    let lanes = usize::from(node.ty.component_count());
    let scalar = node.ty.scalar_kind()?;
    let args: Vec<&Vec<f64>> = node
        .args
        .iter()
        .map(|arg| values[arg.0 as usize].as_ref())
        .collect::<Option<_>>()?;
    let each = |of: fn(&[f64]) -> f64| {
        let lane = |k: usize| {
            let known = |arg: &&Vec<f64>| arg.get(k).or(arg.first()).copied();
            Some(of(&args.iter().map(known).collect::<Option<Vec<f64>>>()?))
        };
        (0..lanes).map(lane).collect()
    };
    match &node.op {
        Op::Const(bits) => {
            let number = |bits: &u32| match scalar {
                Scalar::F32 => f64::from(f32::from_bits(*bits)),
                Scalar::I32 => f64::from(*bits as i32),
                _ => f64::from(*bits),
            };
            Some(bits.iter().take(lanes).map(number).collect())
        }
        Op::Pixel => Some(vec![PIXEL; lanes]),
        Op::FrameSize | Op::TextureSize(_) => Some(vec![2.0 * PIXEL; lanes]),
        Op::Lane => Some(vec![0.0; lanes]),
        Op::Splat | Op::Convert => each(|arg| arg[0]),
        Op::Compose => args.iter().map(|arg| arg.first().copied()).collect(),
        Op::Extract(lane) => Some(vec![*args[0].get(usize::from(*lane))?]),
        Op::Clamp => each(|arg| arg[0].max(arg[1]).min(arg[2])),
        Op::Unary(UnaryOp::Neg) => each(|arg| -arg[0]),
        Op::Binary(BinaryOp::Add) => each(|arg| arg[0] + arg[1]),
        Op::Binary(BinaryOp::Sub) => each(|arg| arg[0] - arg[1]),
        Op::Binary(BinaryOp::Mul) => each(|arg| arg[0] * arg[1]),
        Op::Binary(BinaryOp::Div) if scalar == Scalar::F32 => each(|arg| arg[0] / arg[1]),
        Op::Binary(BinaryOp::Min) => each(|arg| arg[0].min(arg[1])),
        Op::Binary(BinaryOp::Max) => each(|arg| arg[0].max(arg[1])),
        _ => None,
    }
}
