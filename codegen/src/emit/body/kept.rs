//! Loops and branches that are kept.

use super::{Writer, Written};
use crate::emit::text::Text;
use crate::ir::{NodeId, Op};
use crate::passes::Block;
use std::collections::HashSet;

impl Writer<'_> {
    pub(super) fn kept_loop(&mut self, node: NodeId, body: &Block) -> Written {
        let graph = &self.compiled.graph;
        let args = graph.node(node).args.clone();
        let region = graph.region(graph.regions_of(node)[0]).clone();
        for (param, init) in region.params[1..].iter().zip(&args[2..]) {
            if graph.ty(*param).is_array() {
                self.enter_web(*param, *init)?;
            } else {
                let value = self.text(*init)?;
                let name = self.names.of(graph, *param, self.plan.origin(*param));
                let line = self.dialect.mutable(&name, graph.ty(*param), Some(&value.code));
                self.statement(*param, line);
                self.texts[param.0 as usize] = Some(Text::name(name));
            }
        }
        let counter = self
            .names
            .of(graph, region.params[0], self.plan.origin(region.params[0]));
        let (start, end) = (self.text(args[0])?, self.text(args[1])?);
        self.texts[region.params[0].0 as usize] = Some(Text::name(counter.as_str()));
        self.line(self.dialect.loop_head(&counter, graph.ty(args[0]), &start, &end));
        self.statements += 1;
        let scope = self.webs.snapshot();
        self.listing.indent();
        self.block(body)?;
        self.assign_all(&region.params[1..], &region.results)?;
        if let Some(version) = self.webs.lost(&scope) {
            return Err(self.stale(version));
        }
        self.listing.dedent();
        self.line("}".to_owned());
        self.webs.leave(&scope);
        self.results(node, &region.params[1..]);
        Ok(())
    }

    /// Assigns the next iteration's values, all of them computed before any is changed.
    fn assign_all(&mut self, params: &[NodeId], results: &[NodeId]) -> Written {
        let graph = &self.compiled.graph;
        let mut assignments = Vec::new();
        self.assign_arrays(params, results)?;
        for (param, result) in params.iter().zip(results) {
            if param == result || graph.ty(*param).is_array() {
                continue;
            }
            let target = self.text(*param)?.code;
            let mut value = self.text(*result)?;
            // Another carried variable, or an expression that may read one, must be read before that changes.
            if params.len() > 1 && self.reads_carried(*result) {
                let name = self.names.fresh(&format!("next_{target}"));
                let line = self.dialect.immutable(&name, graph.ty(*result), &value.code);
                self.statement(*result, line);
                value = Text::name(name);
            }
            assignments.push((*param, format!("{target} = {};", value.code)));
        }
        for (param, line) in assignments {
            self.statement(param, line);
        }
        Ok(())
    }

    /// The arrays among them. One that is read from a variable that another is assigned to is copied first, as where two
    /// arrays change places.
    fn assign_arrays(&mut self, params: &[NodeId], results: &[NodeId]) -> Written {
        let graph = &self.compiled.graph;
        let mut moves = Vec::new();
        for (param, result) in params.iter().zip(results) {
            if graph.ty(*param).is_array() {
                let target = self.webs.variable(*param).unwrap_or_default().to_owned();
                moves.push((*param, target, self.text(*result)?));
            }
        }
        let moved = |(_, target, value): &&(NodeId, String, Text)| value.code != *target;
        let targets: HashSet<String> = moves
            .iter()
            .filter(moved)
            .map(|(_, target, _)| target.clone())
            .collect();
        for (param, target, value) in &mut moves {
            if value.code != *target && targets.contains(&value.code) {
                let name = self.names.fresh(&format!("next_{target}"));
                let line = self.dialect.immutable(&name, graph.ty(*param), &value.code);
                self.statement(*param, line);
                *value = Text::name(name);
            }
        }
        for (param, target, value) in moves {
            if value.code != target {
                self.statement(param, format!("{target} = {};", value.code));
            }
            self.webs.advance(param);
        }
        Ok(())
    }

    /// Whether the text of a value reads a variable that is carried from round to round.
    fn reads_carried(&self, id: NodeId) -> bool {
        let node = self.compiled.graph.node(id);
        match node.op {
            Op::Param(..) => true,
            _ => !self.plan.is_statement(id) && node.args.iter().any(|arg| self.reads_carried(*arg)),
        }
    }

    /// After a loop or branch, results go by the variables that were carried or chosen.
    fn results(&mut self, owner: NodeId, variables: &[NodeId]) {
        let graph = &self.compiled.graph;
        for id in graph.ids().skip(owner.0 as usize) {
            let node = graph.node(id);
            if let Op::Result(k) = node.op
                && node.args[0] == owner
                && let Some(variable) = variables.get(k as usize)
            {
                if node.ty.is_array() {
                    self.webs.advance(id);
                } else {
                    self.texts[id.0 as usize] = self.texts[variable.0 as usize].clone();
                }
            }
        }
    }

    pub(super) fn kept_branch(&mut self, node: NodeId, then: &Block, otherwise: &Block) -> Written {
        let graph = &self.compiled.graph;
        let regions: Vec<_> = graph
            .regions_of(node)
            .into_iter()
            .map(|r| graph.region(r).clone())
            .collect();
        let results: Vec<NodeId> = graph
            .ids()
            .skip(node.0 as usize)
            .filter(|id| matches!(graph.node(*id).op, Op::Result(_)) && graph.node(*id).args[0] == node)
            .collect();
        // A side that does nothing leaves values that are known before: the variable begins with them.
        let idle = otherwise.steps.is_empty();
        let mut changes_array = false;
        for id in &results {
            let Op::Result(k) = graph.node(*id).op else { continue };
            let kept = regions[1].results[k as usize];
            if graph.ty(*id).is_array() {
                changes_array |= self.prepare_array(*id, kept);
                continue;
            }
            let begin = if idle { Some(self.text(kept)?.code) } else { None };
            let name = self.names.of(graph, *id, self.plan.origin(*id));
            let line = self.dialect.mutable(&name, graph.ty(*id), begin.as_deref());
            self.statement(*id, line);
            self.texts[id.0 as usize] = Some(Text::name(name));
        }
        let condition = self.text(graph.node(node).args[0])?;
        self.line(self.dialect.if_head(&condition));
        self.statements += 1;
        let before = self.webs.snapshot();
        self.side(then, &results, &regions[0].results, false)?;
        let first = self.webs.snapshot();
        self.webs.restore(&before);
        if !idle || changes_array {
            self.line("} else {".to_owned());
            self.side(otherwise, &results, &regions[1].results, idle)?;
        } else {
            for id in results.iter().filter(|id| graph.ty(**id).is_array()) {
                let Op::Result(k) = graph.node(*id).op else { continue };
                self.enter_web(*id, regions[1].results[k as usize])?;
            }
        }
        self.line("}".to_owned());
        self.webs.leave(&before);
        self.webs.join_sides(&first);
        Ok(())
    }

    /// Sees to it that an array that a branch chooses has its variable before the branch. Gives whether the side that
    /// leaves `kept` must write it, because the variable holds something else.
    fn prepare_array(&mut self, id: NodeId, kept: NodeId) -> bool {
        let graph = &self.compiled.graph;
        if self.webs.variable(id).is_none() {
            let name = self.names.of(graph, id, self.plan.origin(id));
            let line = self.dialect.mutable(&name, graph.ty(id), None);
            self.statement(id, line);
            // Both sides write it before it is read.
            self.webs.declare(id, name, id);
        }
        self.webs.holder(kept) != self.webs.variable(id)
    }

    fn side(&mut self, block: &Block, results: &[NodeId], values: &[NodeId], arrays_only: bool) -> Written {
        let graph = &self.compiled.graph;
        self.listing.indent();
        self.block(block)?;
        for id in results {
            let Op::Result(k) = graph.node(*id).op else { continue };
            let value = values[k as usize];
            if graph.ty(*id).is_array() {
                self.enter_web(*id, value)?;
            } else if !arrays_only {
                let target = self.text(*id)?.code;
                let value = self.text(value)?.code;
                self.statement(*id, format!("{target} = {value};"));
            }
        }
        self.listing.dedent();
        Ok(())
    }
}
