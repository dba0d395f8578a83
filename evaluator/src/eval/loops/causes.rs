//! Reasons why a value is no compile-time constant: the inputs of the kernel that it depends on.

use super::demand::source_excerpt;
use crate::diagnostic::Span;
use crate::eval::Evaluator;
use crate::front::scan_effects;
use crate::front::tree::{Block, Expr, ExprKind, Statement};
use crate::ir::{Graph, NodeId, Op};
use rustc_hash::FxHashSet;
use std::collections::HashSet;

/// Inputs that a reason names. More of them would not fit into a line.
const MAX_NAMED: usize = 2;

impl Evaluator<'_> {
    /// Reason why a loop is left in the shader: the expression that decides its end, its place, and the inputs that this
    /// depends on.
    pub fn runtime_end_reason(&self, end: Option<Span>, nodes: &[NodeId]) -> String {
        let excerpt = end.and_then(|end| self.report.excerpt(end));
        let end = excerpt.map_or_else(
            || "its end".to_owned(),
            |(text, place)| format!("`{}` at {place}", source_excerpt(text)),
        );
        match find_inputs(self.builder.graph(), nodes).join(" and ") {
            inputs if inputs.is_empty() => format!("{end} is a runtime value"),
            inputs => format!("{end} is a runtime value, as it depends on {inputs}"),
        }
    }
}

/// Returns the ends of the range that a `for` runs over, also behind `rev` and `step_by`.
pub fn range_ends(over: &Expr) -> Option<(&Expr, &Expr)> {
    match &over.kind {
        ExprKind::Range(start, end, _) => Some((start, end)),
        ExprKind::Method(receiver, ..) => range_ends(receiver),
        _ => None,
    }
}

/// Returns the condition of the first `if` of a loop's body that may leave the loop.
pub fn exit_condition<'b>(body: &'b Block, mutating: &FxHashSet<String>) -> Option<&'b Expr> {
    let statements = body.statements.iter().filter_map(|statement| match statement {
        Statement::Expr(e) => Some(e),
        _ => None,
    });
    statements.chain(body.value.as_deref()).find_map(|e| match &e.kind {
        ExprKind::If(condition, then, ..) if scan_effects(then, mutating).leaves => Some(&**condition),
        _ => None,
    })
}

/// Returns the inputs that nodes depend on, each once, nearest first.
fn find_inputs(graph: &Graph, nodes: &[NodeId]) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut seen = HashSet::new();
    let mut pending: Vec<NodeId> = nodes.iter().rev().copied().collect();
    while let Some(id) = pending.pop() {
        if found.len() == MAX_NAMED || !seen.insert(id) {
            continue;
        }
        let node = graph.node(id);
        match describe_input(graph, &node.op) {
            Some(input) if found.contains(&input) => {}
            Some(input) => found.push(input),
            None => pending.extend(node.args.iter().rev()),
        }
    }
    found
}

/// Returns the name of an input; `None` for an operation on other values.
fn describe_input(graph: &Graph, op: &Op) -> Option<String> {
    Some(match op {
        Op::Uniform(k) => {
            let uniform = &graph.uniforms[*k as usize];
            let name = uniform.part.as_ref().map_or(&uniform.name, |part| &part.of);
            format!("the uniform `{name}`")
        }
        Op::Override(k) => format!("the override `{}`", graph.overrides[*k as usize].name),
        Op::Varying(k) => format!("the varying `{}`", graph.varyings[*k as usize].name),
        Op::Pixel | Op::Lane | Op::Thread | Op::GroupOrigin | Op::Inside => "the pixel's position".to_owned(),
        Op::FrameSize => "the size of the frame".to_owned(),
        Op::TextureSize(k) | Op::TextureLevels(k) | Op::TextureLayers(k) => {
            format!("the size of `{}`", graph.textures[*k as usize].name)
        }
        Op::BufferLen(k) => format!("the length of `{}`", graph.buffers[*k as usize].name),
        Op::SharedLoad(_) => "memory of the workgroup".to_owned(),
        Op::QuadSwap(_) => "another pixel of the quad".to_owned(),
        Op::Param(..) => "a variable of a loop that is left in the shader".to_owned(),
        op => match (op.texture(), op.buffer()) {
            (Some(k), _) => format!("texels of `{}`", graph.textures[k as usize].name),
            (None, Some(k)) => format!("elements of `{}`", graph.buffers[k as usize].name),
            (None, None) => return None,
        },
    })
}
