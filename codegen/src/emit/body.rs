//! Statements of a kernel's body, in any dialect.

use super::arrays::Webs;
use super::dialect::Dialect;
use super::error::EmitError;
use super::listing::Listing;
use super::names::Names;
use super::plan::Plan;
use super::resources::Resources;
use super::text::Text;
use crate::ir::{BinaryOp, NodeId, Op, Scalar};
use crate::passes::{Block, Step};
use crate::pipeline::Compiled;
use std::collections::{BTreeSet, HashSet};

/// Operators and calls that one expression may hold before part of it becomes a statement. Long chains also overflow
/// the recursive parsers of shader compilers.
const LONGEST: u32 = 7;

/// The text of a body.
pub struct Body {
    /// Constant arrays and functions, for module scope.
    pub tables: Vec<String>,
    /// Lines, indented by one level.
    pub lines: Vec<String>,
    /// The colours of the invocation's pixels.
    pub results: Vec<String>,
    /// Statements among the lines.
    pub statements: u32,
}

/// Why a body could not be written in one go.
enum Failure {
    /// For good.
    Error(EmitError),
    /// An array's version is needed that the variable no longer holds: cut its web before this one.
    Cut(NodeId),
}

impl From<EmitError> for Failure {
    fn from(error: EmitError) -> Self {
        Failure::Error(error)
    }
}

type Written<T = ()> = Result<T, Failure>;

/// Writes the body of a compiled kernel.
pub fn body(compiled: &Compiled, resources: &Resources, entry: &str, dialect: &dyn Dialect) -> Result<Body, EmitError> {
    let mut cut = HashSet::new();
    loop {
        match attempt(compiled, resources, entry, dialect, &cut) {
            Ok(body) => return Ok(body),
            Err(Failure::Error(error)) => return Err(error),
            Err(Failure::Cut(version)) => {
                if !cut.insert(version) {
                    let array = compiled
                        .graph
                        .origin(version)
                        .map_or("an array", |o| o.name.as_str())
                        .to_owned();
                    let kernel = compiled.kernel.clone();
                    return Err(EmitError::ArrayVersions { kernel, array });
                }
            }
        }
    }
}

fn attempt(
    compiled: &Compiled,
    resources: &Resources,
    entry: &str,
    dialect: &dyn Dialect,
    cut: &HashSet<NodeId>,
) -> Written<Body> {
    let graph = &compiled.graph;
    let mut writer = Writer {
        compiled,
        dialect,
        plan: Plan::new(graph, &compiled.schedule),
        names: Names::new(graph, resources, entry),
        webs: Webs::new(graph, cut),
        texts: vec![None; graph.nodes.len()],
        tables: Vec::new(),
        helpers: BTreeSet::new(),
        listing: Listing::new(graph),
        statements: 0,
    };
    writer.block(&compiled.schedule.body)?;
    let mut results = Vec::new();
    for output in graph.outputs() {
        let colour = writer.text(*output)?;
        results.push(dialect.leave(graph.ty(*output), colour).code);
    }
    Ok(Body {
        tables: writer.tables.into_iter().chain(writer.helpers).collect(),
        lines: writer.listing.lines(),
        results,
        statements: writer.statements,
    })
}

struct Writer<'a> {
    compiled: &'a Compiled,
    dialect: &'a dyn Dialect,
    plan: Plan<'a>,
    names: Names,
    webs: Webs,
    texts: Vec<Option<Text>>,
    tables: Vec<String>,
    /// Functions at module scope, each once.
    helpers: BTreeSet<String>,
    listing: Listing<'a>,
    statements: u32,
}

impl Writer<'_> {
    fn block(&mut self, block: &Block) -> Written {
        for step in &block.steps {
            match step {
                Step::Eval(id) => self.eval(*id)?,
                Step::Loop { node, body } => self.kept_loop(*node, body)?,
                Step::If { node, then, otherwise } => self.kept_branch(*node, then, otherwise)?,
            }
        }
        Ok(())
    }

    fn eval(&mut self, id: NodeId) -> Written {
        let graph = &self.compiled.graph;
        let node = graph.node(id);
        match &node.op {
            Op::Const(bits) => {
                let text = if node.ty.is_array() {
                    None
                } else {
                    Some(self.dialect.constant(&self.compiled.kernel, node.ty, bits)?)
                };
                self.texts[id.0 as usize] = text;
                Ok(())
            }
            // Written where it is first copied or indexed.
            Op::MakeArray | Op::Result(_) => Ok(()),
            Op::ArraySet => self.array_set(id),
            Op::ArrayGet => self.array_get(id),
            _ => {
                let text = self.expression(id)?;
                let text = if self.plan.is_statement(id) || text.size > LONGEST {
                    self.declare(id, &text)
                } else {
                    text
                };
                self.texts[id.0 as usize] = Some(text);
                Ok(())
            }
        }
    }

    /// A statement that names a value.
    fn declare(&mut self, id: NodeId, value: &Text) -> Text {
        let graph = &self.compiled.graph;
        let name = self.names.of(graph, id, self.plan.origin(id));
        let line = self.dialect.immutable(&name, graph.ty(id), &value.code);
        self.statement(id, line);
        Text::name(name)
    }

    /// The text of a value that has been evaluated.
    fn text(&mut self, id: NodeId) -> Written<Text> {
        if let Some(text) = &self.texts[id.0 as usize] {
            return Ok(text.clone());
        }
        let node = self.compiled.graph.node(id);
        match &node.op {
            Op::MakeArray => {
                let parts: Written<Vec<Text>> = node.args.iter().map(|a| self.text(*a)).collect();
                let parts = parts?;
                Ok(self.dialect.construct(node.ty, &parts.iter().collect::<Vec<_>>()))
            }
            // Constants belong to no place and are written wherever they are used.
            Op::Const(bits) => Ok(self.dialect.constant(&self.compiled.kernel, node.ty, bits)?),
            _ if node.ty.is_array() => match self.webs.holder(id) {
                Some(name) => Ok(Text::name(name)),
                None => Err(self.stale(id)),
            },
            _ => unreachable!("verified and scheduled: arguments are evaluated before their users"),
        }
    }

    fn stale(&self, id: NodeId) -> Failure {
        match self.webs.replacement(id) {
            Some(version) => Failure::Cut(version),
            None => Failure::Error(EmitError::ArrayVersions {
                kernel: self.compiled.kernel.clone(),
                array: self.plan.origin(id).map_or("an array", |o| o.name.as_str()).to_owned(),
            }),
        }
    }

    fn expression(&mut self, id: NodeId) -> Written<Text> {
        let node = self.compiled.graph.node(id);
        let args: Written<Vec<Text>> = node.args.iter().map(|a| self.text(*a)).collect();
        let args = args?;
        let operand = node.args.first().map_or(node.ty, |a| self.compiled.graph.ty(*a));
        let d = self.dialect;
        // What other hardware reads is in full precision, whatever the shader computes in.
        let graph = &self.compiled.graph;
        let outer = |k: usize| d.leave(graph.ty(node.args[k]), args[k].clone());
        let inner = |x: Text| d.enter(node.ty, x);
        Ok(match &node.op {
            Op::Pixel => Text::name("pixel"),
            Op::FrameSize => Text::name("frame"),
            Op::Lane => {
                let one = d.construct(node.ty, &[&d.scalar(Scalar::I32, 1)]);
                Text::infix(&Text::name("pixel"), "&", &one, super::text::Binds::Mixed)
            }
            Op::Varying(k) => inner(Text::name(self.compiled.graph.varyings[*k as usize].name.as_str())),
            Op::Message(direction) => inner(d.message(*direction, &outer(0))),
            Op::Derivative(axis) => inner(d.derivative(*axis, &outer(0))),
            Op::GatherCompare { texture, sampler, .. } => {
                let (text, helper) = d.gather_compare(*texture, *sampler, &outer(0), &outer(1));
                self.helpers.extend(helper);
                inner(text)
            }
            Op::Uniform(k) => inner(d.uniform(&self.compiled.graph.uniforms[*k as usize].name)),
            Op::Unary(op) => d.unary(*op, node.ty, &args[0]),
            Op::Binary(op) => {
                let [x, y] = [0, 1].map(|k| self.operand(*op, node.args[k], &args[k]));
                // One side stays a vector, or the result would be a scalar.
                let x = if self.is_splat(node.args[0]) && self.is_splat(node.args[1]) {
                    args[0].clone()
                } else {
                    x
                };
                d.binary(*op, operand, &x, &y)
            }
            Op::Dot => Text::call("dot", &[&args[0], &args[1]]),
            Op::Cross => Text::call("cross", &[&args[0], &args[1]]),
            Op::Clamp => Text::call("clamp", &[&args[0], &args[1], &args[2]]),
            Op::Select => d.select(&args[0], &args[1], &args[2]),
            Op::Splat => Text {
                size: args[0].size,
                ..d.construct(node.ty, &[&args[0]])
            },
            Op::Compose => d.construct(node.ty, &args.iter().collect::<Vec<_>>()),
            Op::Extract(lane) => Text::member(&args[0], &"xyzw"[*lane as usize..=*lane as usize]),
            Op::Convert => d.convert(operand, node.ty, &args[0], super::half::fits(graph, node.args[0])),
            Op::Bitcast => d.bitcast(operand, node.ty, &args[0]),
            Op::TextureSize(texture) => d.size(*texture),
            Op::Load { texture, .. } => inner(d.load(*texture, &args[0], args.get(1))),
            Op::Sample { texture, sampler, .. } => inner(d.sample(*texture, *sampler, &outer(0))),
            Op::Gather {
                texture,
                sampler,
                component,
                ..
            } => {
                let (text, helper) = d.gather(*texture, *sampler, *component, &outer(0));
                self.helpers.extend(helper);
                inner(text)
            }
            Op::Compare { texture, sampler, .. } => inner(d.compare(*texture, *sampler, &outer(0), &outer(1))),
            Op::BufferLen(buffer) => d.len(*buffer),
            Op::BufferLoad { buffer, .. } => inner(d.element(*buffer, &args[0])),
            Op::Tally(_) => args[0].clone(),
            _ => unreachable!("handled where it has a statement of its own"),
        })
    }

    /// An operand of arithmetic: a scalar stands for a vector of it.
    fn operand(&mut self, op: BinaryOp, id: NodeId, text: &Text) -> Text {
        let arithmetic = matches!(op, BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul | BinaryOp::Div);
        let node = self.compiled.graph.node(id);
        match node.op {
            Op::Splat if arithmetic => self.texts[node.args[0].0 as usize]
                .clone()
                .unwrap_or_else(|| text.clone()),
            _ => text.clone(),
        }
    }

    fn is_splat(&self, id: NodeId) -> bool {
        self.compiled.graph.node(id).op == Op::Splat
    }

    fn array_get(&mut self, id: NodeId) -> Written {
        let graph = &self.compiled.graph;
        let (array, index) = (graph.node(id).args[0], graph.node(id).args[1]);
        if graph.node(array).op == Op::MakeArray && self.texts[array.0 as usize].is_none() {
            let name = self.names.of(graph, array, self.plan.origin(array));
            let literal = self.text(array)?;
            if graph.node(array).args.iter().all(|a| graph.constant(*a).is_some()) {
                self.tables
                    .push(self.dialect.table(&name, graph.ty(array), &literal.code));
                self.texts[array.0 as usize] = Some(Text::name(name));
            } else {
                let line = self.dialect.mutable(&name, graph.ty(array), Some(&literal.code));
                self.statement(id, line);
                // Known in this scope only: it is written again elsewhere.
                let read = self.indexed(&Text::name(name), index)?;
                let text = self.declare(id, &read);
                self.texts[id.0 as usize] = Some(text);
                return Ok(());
            }
        }
        let base = self.text(array)?;
        let read = self.indexed(&base, index)?;
        let text = self.declare(id, &read);
        self.texts[id.0 as usize] = Some(text);
        Ok(())
    }

    fn indexed(&mut self, base: &Text, index: NodeId) -> Written<Text> {
        let index = self.text(index)?;
        Ok(Text::index(base, &index))
    }

    fn array_set(&mut self, id: NodeId) -> Written {
        let args = self.compiled.graph.node(id).args.clone();
        self.enter_web(id, args[0])?;
        let name = Text::name(self.webs.variable(id).unwrap_or_default());
        let place = self.indexed(&name, args[1])?;
        let value = self.text(args[2])?;
        self.statement(id, format!("{} = {};", place.code, value.code));
        Ok(())
    }

    /// Declares the variable of a web with what it begins with.
    fn open_web(&mut self, id: NodeId, begin: NodeId) -> Written {
        let graph = &self.compiled.graph;
        let value = self.text(begin)?;
        let name = self.names.of(graph, id, self.plan.origin(id));
        let line = self.dialect.mutable(&name, graph.ty(id), Some(&value.code));
        self.statement(id, line);
        self.webs.declare(id, name, begin);
        Ok(())
    }

    /// Makes the web's variable hold `begin`, and takes it to be `version`.
    fn enter_web(&mut self, version: NodeId, begin: NodeId) -> Written {
        match self.webs.variable(version).map(str::to_owned) {
            None => self.open_web(version, begin)?,
            Some(name) => {
                let value = self.text(begin)?;
                if value.code != name {
                    self.statement(version, format!("{name} = {};", value.code));
                }
            }
        }
        self.webs.advance(version);
        Ok(())
    }

    fn kept_loop(&mut self, node: NodeId, body: &Block) -> Written {
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
        self.line(self.dialect.loop_head(&counter, &start, &end));
        self.statements += 1;
        let scope = self.webs.snapshot();
        self.listing.indent();
        self.block(body)?;
        self.assign_all(&region.params[1..], &region.results)?;
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
        for (param, result) in params.iter().zip(results) {
            if param == result {
                continue;
            }
            if graph.ty(*param).is_array() {
                self.enter_web(*param, *result)?;
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

    fn kept_branch(&mut self, node: NodeId, then: &Block, otherwise: &Block) -> Written {
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

    /// A statement of a node's, under a comment with those of the same place.
    fn statement(&mut self, id: NodeId, line: String) {
        self.statements += 1;
        self.listing.statement(self.plan.origin(id), &line);
    }

    /// A line that belongs to no place.
    fn line(&mut self, line: String) {
        self.listing.line(&line);
    }
}
