//! Which loops an error comes from: of those that are left in the shader, the ones without which what is looked at would be a
//! compile-time constant.

use super::Evaluator;
use super::value::{Captured, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::front::tree::{Expr, ExprKind};
use crate::front::{children, mentioned_in};
use crate::ir::{Graph, NodeId, Op, RegionId};
use std::collections::{BTreeSet, HashSet};

/// Loops that are left in the shader although they could be unrolled.
#[derive(Default)]
pub struct Kept {
    /// With what they have become, in order.
    loops: Vec<(RegionId, Span)>,
    /// Those of which the trip count is known, or may be.
    avoidable: HashSet<Span>,
}

impl Kept {
    /// A loop has become a region.
    pub fn region(&mut self, region: RegionId, span: Span) {
        self.loops.push((region, span));
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.loops.len()
    }

    /// Forgets those that came later.
    pub fn truncate(&mut self, len: usize) {
        self.loops.truncate(len);
    }

    /// Those that came later and could be unrolled.
    fn since(&self, before: usize) -> Vec<Span> {
        let later = self.loops.get(before..).unwrap_or_default().iter();
        let later = later
            .map(|(_, span)| *span)
            .filter(|span| self.avoidable.contains(span));
        later.collect::<BTreeSet<Span>>().into_iter().collect()
    }

    /// A loop is left in the shader only because that is asked for.
    pub fn avoidable(&mut self, span: Span) {
        self.avoidable.insert(span);
    }
}

impl Evaluator<'_> {
    /// Notes with an error of an expression the loops that what it looks at depends on: what decides, else the integers and booleans
    /// of what it points at, else all that the expression mentions, as they are what has to be known; else loops in functions that
    /// it calls, of which there were `before` when it began; else what its floats depend on.
    pub fn blame(&self, error: &mut Diagnostic, expr: &Expr, before: usize) {
        if !error.loops.is_empty() || self.kept.avoidable.is_empty() || self.exhausted {
            return;
        }
        let parts = children(expr);
        let pointed = parts.iter().find(|part| Some(part.span) == error.span);
        let decides = match expr.kind {
            ExprKind::If(..) | ExprKind::Match(..) => parts.first(),
            _ => None,
        };
        let behind = |part: Option<&&Expr>, floats| part.map_or(Vec::new(), |part| self.loops_behind(part, floats));
        let found: [&dyn Fn() -> Vec<Span>; 6] = [
            &|| behind(decides, false),
            &|| behind(decides, true),
            &|| behind(pointed, false),
            &|| self.loops_behind(expr, false),
            &|| self.kept.since(before),
            &|| self.loops_behind(expr, true),
        ];
        let mut found = found.iter().map(|loops| loops());
        error.loops = found.find(|loops| !loops.is_empty()).unwrap_or_default();
    }

    fn loops_behind(&self, expr: &Expr, floats: bool) -> Vec<Span> {
        let mut names = BTreeSet::new();
        mentioned_in(expr, &mut names);
        let mut slots: Vec<usize> = names.iter().filter_map(|name| self.scope.slot(name)).collect();
        for slot in slots.clone() {
            self.targets(self.scope.at(slot).1, &mut slots);
        }
        let mut walk = Walk::default();
        for slot in slots {
            read(self.scope.at(slot).1, &mut walk.pending);
        }
        walk.pending.retain(|id| floats || !self.ty(*id).is_float());
        walk.run(self.builder.graph(), &self.kept)
    }
}

/// Loops that could be unrolled, of those that a node depends on.
pub fn loops_of(graph: &Graph, kept: &Kept, node: NodeId) -> Vec<Span> {
    let mut walk = Walk::default();
    walk.pending.push(node);
    walk.run(graph, kept)
}

/// All numbers that a value is made of, those that a closure takes along counted.
fn read(value: &Value, out: &mut Vec<NodeId>) {
    match value {
        Value::Closure(closed) => {
            for (_, captured) in &closed.captured {
                if let Captured::Value(value) = captured {
                    read(value, out);
                }
            }
        }
        other => other.flatten(out),
    }
}

/// Goes from numbers to what they are computed from.
#[derive(Default)]
struct Walk {
    seen: HashSet<NodeId>,
    pending: Vec<NodeId>,
    found: BTreeSet<Span>,
}

impl Walk {
    fn run(mut self, graph: &Graph, kept: &Kept) -> Vec<Span> {
        while let Some(id) = self.pending.pop() {
            if !self.seen.insert(id) {
                continue;
            }
            let node = graph.node(id);
            self.pending.extend(&node.args);
            match (&node.op, node.args.first().map(|owner| &graph.node(*owner).op)) {
                (Op::Result(k), Some(Op::Loop(region))) => self.enter(graph, kept, *region, *k as usize),
                (Op::Result(k), Some(Op::If(then, otherwise))) => {
                    for side in [then, otherwise] {
                        self.pending.extend(graph.region(*side).results.get(*k as usize));
                    }
                }
                // The first is the counter.
                (Op::Param(region, k), _) => self.enter(graph, kept, *region, (*k as usize).wrapping_sub(1)),
                _ => {}
            }
        }
        self.found.into_iter().collect()
    }

    /// What a loop carries at a position.
    fn enter(&mut self, graph: &Graph, kept: &Kept, region: RegionId, k: usize) {
        let of = kept.loops.iter().find(|(known, _)| *known == region);
        let span = of.map(|(_, span)| *span);
        self.found.extend(span.filter(|span| kept.avoidable.contains(span)));
        let region = graph.region(region);
        self.pending
            .extend(region.results.get(k).copied().into_iter().chain(region.stop));
    }
}
