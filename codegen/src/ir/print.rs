//! The graph as text, for people and for tests.

use super::{Graph, NodeId, Op};
use std::fmt::Write;

/// One line a node, indented by region:
///
/// ```text
/// %3: f32 = binary Add %1 %2    // sum sample=0
/// ```
pub fn print(graph: &Graph) -> String {
    let mut text = String::new();
    let mut depth = 0usize;
    let mut events = graph.events.iter().peekable();
    for id in graph.ids() {
        while let Some((_, event)) = events.next_if(|(at, _)| *at <= id.0) {
            depth = print_event(&mut text, graph, depth, event);
        }
        let _ = writeln!(text, "{}{}", "  ".repeat(depth), line(graph, id));
    }
    for (_, event) in events {
        depth = print_event(&mut text, graph, depth, event);
    }
    text
}

fn print_event(text: &mut String, graph: &Graph, depth: usize, event: &super::Event) -> usize {
    match event {
        super::Event::Open(region) => {
            let _ = writeln!(text, "{}region {} {{", "  ".repeat(depth), region.0);
            depth + 1
        }
        super::Event::Close(region) => {
            let results: Vec<_> = graph
                .region(*region)
                .results
                .iter()
                .map(|r| format!("%{}", r.0))
                .collect();
            let _ = writeln!(text, "{}yield {}", "  ".repeat(depth), results.join(" "));
            if *region != Graph::BODY {
                let _ = writeln!(text, "{}}}", "  ".repeat(depth.saturating_sub(1)));
            }
            depth.saturating_sub(1)
        }
    }
}

fn line(graph: &Graph, id: NodeId) -> String {
    let node = graph.node(id);
    let mut line = format!("%{}: {} = {}", id.0, node.ty, op(graph, &node.op, node.ty));
    for arg in &node.args {
        let _ = write!(line, " %{}", arg.0);
    }
    if let Some(origin) = graph.origin(id) {
        let _ = write!(line, "    // {}", origin.name);
        for counter in &origin.counters {
            let _ = write!(line, " {}={}", counter.name, counter.value);
        }
    }
    line
}

fn op(graph: &Graph, op: &Op, ty: super::Type) -> String {
    match op {
        Op::Const(bits) => {
            let lanes = bits[..ty.lanes() as usize].iter().map(|b| match ty.kind() {
                Some(super::Scalar::F32) => format!("{:?}", f32::from_bits(*b)),
                Some(super::Scalar::I32) => format!("{}", *b as i32),
                _ => format!("{b}"),
            });
            format!("const {}", lanes.collect::<Vec<_>>().join(" "))
        }
        Op::Uniform(k) => format!("uniform {}", graph.uniforms[*k as usize].name),
        Op::Unary(op) => format!("unary {op:?}"),
        Op::Binary(op) => format!("binary {op:?}"),
        Op::Extract(lane) => format!("extract {lane}"),
        Op::Load { texture, site: 0 } => format!("load {}", graph.textures[*texture as usize].name),
        Op::Load { texture, site } => format!("load {} site={site}", graph.textures[*texture as usize].name),
        Op::Tally(name) => format!("tally {}", graph.tallies[*name as usize]),
        Op::Loop(region) => format!("loop region={}", region.0),
        Op::If(then, otherwise) => format!("if region={} else region={}", then.0, otherwise.0),
        Op::Result(k) => format!("result {k}"),
        Op::Param(region, k) => format!("param {} of {}", k, region.0),
        plain => format!("{plain:?}").to_lowercase(),
    }
}
