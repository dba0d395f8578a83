//! Origin of non-finite numbers.

use crate::ir::{Counter, Graph, NodeId, Op, Origin};

/// The first operation of a pixel that made a NaN or an infinity of finite numbers, or read one.
#[derive(Clone, Debug, PartialEq)]
pub struct NonFiniteOrigin {
    /// The operation.
    pub node: NodeId,
    /// Result of the operation, component by component.
    pub value: Vec<f64>,
    /// Counters of the loops around it, looped and unrolled, outer ones first.
    pub counters: Vec<Counter>,
}

impl NonFiniteOrigin {
    /// Describes the event in a sentence: the variable, the iterations of the loops around it, and the line.
    pub fn describe(&self, graph: &Graph) -> String {
        let lanes: Vec<String> = self.value.iter().map(f64::to_string).collect();
        let value = lanes.join(", ");
        let origin = named_origin(graph, self.node);
        let name = origin.map_or("a value", |o| &*o.name);
        let mut text = match &graph.node(self.node).op {
            Op::Const(_) => format!("`{name}` is the constant {value}"),
            Op::Unary(op) => format!("`{name}` became {value} in `{}`", format!("{op:?}").to_lowercase()),
            Op::Binary(op) => format!("`{name}` became {value} in `{}`", format!("{op:?}").to_lowercase()),
            read if read.is_read() => format!("`{name}` was read as {value}"),
            _ => format!("`{name}` became {value}"),
        };
        let rounds: Vec<String> = self
            .counters
            .iter()
            .map(|c| format!("{} {}", c.name, c.value))
            .collect();
        if !rounds.is_empty() {
            text += &format!(", {}", rounds.join(", "));
        }
        if let Some(origin) = origin {
            let file = graph.files.get(origin.file as usize).map_or("", String::as_str);
            text += &format!(", at {file}:{}", origin.line);
        }
        text
    }
}

/// Returns an operation's own origin, or that of the first named value that uses it.
pub(super) fn named_origin(graph: &Graph, node: NodeId) -> Option<&Origin> {
    let mut at = node;
    loop {
        if let Some(origin) = graph.origin(at).filter(|o| !o.name.is_empty()) {
            return Some(origin);
        }
        at = graph
            .node_ids()
            .skip(at.0 as usize + 1)
            .find(|id| graph.node(*id).args.contains(&at))?;
    }
}
