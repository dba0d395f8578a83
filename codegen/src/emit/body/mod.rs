//! Statements of a kernel's body, in any dialect.

mod arrays;
mod kept;

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
    /// An array's version is needed that its variable no longer holds: cut its web before the one that took its place,
    /// if it is known which.
    Stale(Option<NodeId>),
}

impl From<EmitError> for Failure {
    fn from(error: EmitError) -> Self {
        Failure::Error(error)
    }
}

type Written<T = ()> = Result<T, Failure>;

/// Writes the body of a compiled kernel.
pub fn body(compiled: &Compiled, resources: &Resources, entry: &str, dialect: &dyn Dialect) -> Result<Body, EmitError> {
    let graph = &compiled.graph;
    let mut cut = HashSet::new();
    while cut.len() < MAX_CUTS {
        match attempt(compiled, resources, entry, dialect, Webs::new(graph, &cut)) {
            Ok(body) => return Ok(body),
            Err(Failure::Error(error)) => return Err(error),
            Err(Failure::Stale(Some(version))) if cut.insert(version) => {}
            Err(Failure::Stale(_)) => break,
        }
    }
    match attempt(compiled, resources, entry, dialect, Webs::apart(graph)) {
        Ok(body) => Ok(body),
        Err(Failure::Error(error)) => Err(error),
        Err(Failure::Stale(_)) => unreachable!("no version takes another's place where each has a variable of its own"),
    }
}

/// Cuts after which every version of an array is given a variable of its own.
const MAX_CUTS: usize = 16;

fn attempt(
    compiled: &Compiled,
    resources: &Resources,
    entry: &str,
    dialect: &dyn Dialect,
    webs: Webs,
) -> Written<Body> {
    let graph = &compiled.graph;
    let mut writer = Writer {
        compiled,
        dialect,
        plan: Plan::new(graph, &compiled.schedule),
        names: Names::new(graph, resources, entry),
        webs,
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
        Failure::Stale(self.webs.replacement(id))
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
