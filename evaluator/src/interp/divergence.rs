//! The first operation whose result in `f32` is far from that in `f64`.

use super::{Bindings, InputError, Interpreter, Scratch, to_texel};
use crate::ir::{Graph, Memory, NodeId, Op, Origin, Real};
use crate::passes::Schedule;
use rustc_hash::FxHashSet;

/// Values that are traced in an invocation.
const MOST_TRACED: usize = 1 << 18;

/// Distance from which on two results part, as a part of the greater one.
const FAR: f64 = 1.0e-3;

/// Values below which a distance does not count.
const SMALLEST: f64 = 1.0e-36;

/// Operations in their order with their results.
pub(super) type Trace = Vec<(NodeId, [f64; 4])>;

/// An operation whose results in `f32` and `f64` are far apart, while those of all operations before are not.
#[derive(Clone, Debug, PartialEq)]
pub struct Divergence {
    /// The operation.
    pub node: NodeId,
    /// Result in `f32`, component by component.
    pub single: Vec<f64>,
    /// Result in `f64`, component by component.
    pub double: Vec<f64>,
}

impl Divergence {
    /// Returns the origin of the operation, or that of the first named value that uses it.
    pub fn origin<'g>(&self, graph: &'g Graph) -> Option<&'g Origin> {
        super::finite::named_origin(graph, self.node)
    }

    /// Describes the operation and both results in a sentence.
    pub fn describe(&self, graph: &Graph) -> String {
        let list = |of: &[f64], single: bool| {
            let each = of.iter().map(|v| match single {
                true => format!("{:?}", *v as f32),
                false => format!("{v:?}"),
            });
            each.collect::<Vec<_>>().join(", ")
        };
        let operation = match &graph.node(self.node).op {
            Op::Unary(op) => format!(" in `{}`", format!("{op:?}").to_lowercase()),
            Op::Binary(op) => format!(" in `{}`", format!("{op:?}").to_lowercase()),
            _ => String::new(),
        };
        let origin = self.origin(graph);
        let name = match origin {
            Some(origin) if !origin.name.is_empty() => format!("`{}`", origin.name),
            _ => "a value".to_owned(),
        };
        let place = origin.map(|origin| {
            let file = graph.files.get(origin.file as usize).map_or("", String::as_str);
            format!(", at {file}:{}", origin.line)
        });
        format!(
            "f32 and f64 part first{operation}: {name} is {} in f32 and {} in f64{}",
            list(&self.single, true),
            list(&self.double, false),
            place.unwrap_or_default()
        )
    }
}

/// Runs one invocation in both precisions, and finds the first operation whose results are far apart, among those that
/// the values that are stored depend on.
///
/// # Errors
///
/// As of [`Interpreter::new`].
pub fn first_divergence(
    graph: &Graph,
    schedule: &Schedule,
    frame: [u32; 2],
    bindings: &Bindings<'_>,
    [x, y]: [u32; 2],
) -> Result<Option<Divergence>, InputError> {
    let single = Interpreter::<f32>::in_precision(graph, schedule, frame, bindings)?.trace_pixel(x, y);
    let double = Interpreter::<f64>::in_precision(graph, schedule, frame, bindings)?.trace_pixel(x, y);
    let relevant = stored_values(graph);
    for ((node, a), (other, b)) in single.iter().zip(&double) {
        if node != other {
            break;
        }
        let ty = graph.ty(*node);
        let components = ty.component_count() as usize;
        let whole = !ty.is_float();
        if relevant.contains(node) && (0..components).any(|k| is_far(a[k], b[k], whole)) {
            return Ok(Some(Divergence {
                node: *node,
                single: a[..components].to_vec(),
                double: b[..components].to_vec(),
            }));
        }
    }
    Ok(None)
}

fn is_far(a: f64, b: f64, whole: bool) -> bool {
    if a == b || a.is_nan() && b.is_nan() {
        return false;
    }
    let greater = a.abs().max(b.abs());
    // A NaN or an infinity of one alone is far.
    whole || !((a - b).abs() <= FAR * greater || greater < SMALLEST)
}

/// Nodes that the stored values depend on; the conditions and places of the stores do not count.
fn stored_values(graph: &Graph) -> FxHashSet<NodeId> {
    let mut found = FxHashSet::default();
    let stores = graph
        .node_ids()
        .filter(|id| matches!(graph.node(*id).op, Op::Store(Memory::Buffer(_))));
    let mut open: Vec<NodeId> = stores.filter_map(|id| graph.node(id).args.get(2).copied()).collect();
    while let Some(id) = open.pop() {
        if !found.insert(id) {
            continue;
        }
        let node = graph.node(id);
        open.extend(node.args.iter().copied());
        if matches!(node.op, Op::Loop(_) | Op::If(..)) {
            for region in graph.regions_of(id) {
                open.extend(graph.region(region).results.iter().copied());
            }
        }
    }
    found
}

impl<R: Real> Interpreter<'_, R> {
    fn trace_pixel(&self, x: u32, y: u32) -> Trace {
        let mut scratch = self.new_scratch();
        scratch.trace = Some(Trace::new());
        self.run_invocation(x, y, &mut scratch);
        scratch.trace.unwrap_or_default()
    }

    /// Notes the result of an operation.
    pub(super) fn trace_value(&self, id: NodeId, s: &mut Scratch) {
        let ty = self.graph.ty(id);
        let Some(trace) = &mut s.trace else { return };
        if trace.len() < MOST_TRACED && !ty.is_array() && ty.scalar_kind().is_some() {
            trace.push((id, to_texel::<R>(ty, s.values[id.0 as usize])));
        }
    }
}
