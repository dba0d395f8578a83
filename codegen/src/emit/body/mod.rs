//! Statements of a kernel's body, in any dialect.

mod arrays;
mod kept;
mod known;

use super::arrays::Webs;
use super::dialect::Dialect;
use super::error::EmitError;
use super::listing::Listing;
use super::names::Names;
use super::plan::Plan;
use super::resources::Resources;
use super::text::Text;
use crate::ir::{BinaryOp, Lanes, NodeId, Op, Scalar, Type};
use crate::passes::{Block, Step};
use crate::pipeline::Compiled;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use straightline_manifest::Precision;

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
pub fn body(compiled: &Compiled, resources: &Resources, dialect: &dyn Dialect) -> Result<Body, EmitError> {
    let graph = &compiled.graph;
    let mut cut = HashSet::new();
    while cut.len() < MAX_CUTS {
        match attempt(compiled, resources, dialect, Webs::new(graph, &cut)) {
            Ok(body) => return Ok(body),
            Err(Failure::Error(error)) => return Err(error),
            Err(Failure::Stale(Some(version))) if cut.insert(version) => {}
            Err(Failure::Stale(_)) => break,
        }
    }
    match attempt(compiled, resources, dialect, Webs::apart(graph)) {
        Ok(body) => Ok(body),
        Err(Failure::Error(error)) => Err(error),
        // No version takes another's place where each has a variable of its own.
        Err(Failure::Stale(_)) => Err(EmitError::Invalid {
            kernel: compiled.kernel.clone(),
            target: "shader",
            message: "an array is read after it was overwritten".to_owned(),
        }),
    }
}

/// Cuts after which every version of an array is given a variable of its own.
const MAX_CUTS: usize = 16;

fn attempt(compiled: &Compiled, resources: &Resources, dialect: &dyn Dialect, webs: Webs) -> Written<Body> {
    let graph = &compiled.graph;
    let mut writer = Writer {
        compiled,
        dialect,
        plan: Plan::new(graph, &compiled.schedule),
        names: Names::new(graph, resources, &resources.entry),
        webs,
        texts: vec![None; graph.nodes.len()],
        half: resources.options.precision == Precision::F16,
        specials: BTreeMap::new(),
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
    let specials = writer.specials.into_values().flat_map(|special| special.lines);
    Ok(Body {
        tables: writer.tables.into_iter().chain(writer.helpers).collect(),
        lines: specials.chain(writer.listing.lines()).collect(),
        results,
        statements: writer.statements,
    })
}

/// A float that is not finite, in a language that has no expression for one.
struct Special {
    name: String,
    lines: Vec<String>,
}

struct Writer<'a> {
    compiled: &'a Compiled,
    dialect: &'a dyn Dialect,
    plan: Plan<'a>,
    names: Names,
    webs: Webs,
    texts: Vec<Option<Text>>,
    /// Whether floats are those of half precision.
    half: bool,
    /// Floats without a literal that the body has names for, by their bits.
    specials: BTreeMap<u32, Special>,
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
                let text = (!node.ty.is_array()).then(|| self.constant(node.ty, bits));
                self.texts[id.0 as usize] = text;
                Ok(())
            }
            // Written where it is first copied or indexed.
            Op::MakeArray | Op::Result(_) => Ok(()),
            Op::ArraySet => self.array_set(id),
            Op::ArrayGet => self.array_get(id),
            _ => {
                let mut text = self.expression(id)?;
                // Counted on the graph, so that every language has the same statements.
                text.size = self.size(id);
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
            Op::Const(bits) => Ok(self.constant(node.ty, bits)),
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
                inner(d.gather_compare(*texture, *sampler, &outer(0), &outer(1)))
            }
            Op::Uniform(k) => inner(d.uniform(&self.compiled.graph.uniforms[*k as usize].name)),
            Op::Unary(op) => d.unary(*op, node.ty, &args[0]),
            Op::Binary(op @ (BinaryOp::Div | BinaryOp::Rem))
                if operand.is_integer()
                    && let Some((text, helper)) = d.divide(
                        *op,
                        operand,
                        &args[0],
                        &args[1],
                        known::division(graph, node.args[0], node.args[1]),
                    ) =>
            {
                self.helpers.insert(helper);
                text
            }
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
            Op::Select => d.select(node.ty, &args[0], &args[1], &args[2]),
            Op::Splat => Text {
                size: args[0].size,
                ..d.construct(node.ty, &[&args[0]])
            },
            Op::Compose => d.construct(node.ty, &args.iter().collect::<Vec<_>>()),
            Op::Extract(lane) => Text::member(&args[0], &"xyzw"[*lane as usize..=*lane as usize]),
            Op::Convert => {
                let fits = match operand.is_float() && node.ty.is_integer() {
                    true => known::has_integer(graph, node.args[0], node.ty, self.half),
                    false => super::half::fits(graph, node.args[0]),
                };
                let (text, helper) = d.convert(operand, node.ty, &args[0], fits);
                self.helpers.extend(helper);
                text
            }
            Op::Bitcast => d.bitcast(operand, node.ty, &args[0]),
            Op::TextureSize(texture) => d.size(*texture),
            Op::Load { texture, .. } => inner(d.load(*texture, &args[0], args.get(1))),
            Op::Sample { texture, sampler, .. } => inner(d.sample(*texture, *sampler, &outer(0))),
            Op::Gather {
                texture,
                sampler,
                component,
                ..
            } => inner(d.gather(*texture, *sampler, *component, &outer(0))),
            Op::Compare { texture, sampler, .. } => inner(d.compare(*texture, *sampler, &outer(0), &outer(1))),
            Op::BufferLen(buffer) => d.len(*buffer),
            Op::BufferLoad { buffer, .. } => inner(d.element(*buffer, &args[0])),
            Op::Tally(_) => args[0].clone(),
            _ => unreachable!("handled where it has a statement of its own"),
        })
    }

    /// A constant scalar or vector.
    fn constant(&mut self, ty: Type, bits: &Lanes) -> Text {
        let lanes = &bits[..ty.lanes() as usize];
        let special = |bits: &u32| ty.is_float() && !f32::from_bits(*bits).is_finite();
        if !lanes.iter().any(special) {
            return self.dialect.constant(ty, bits);
        }
        let kind = ty.kind().unwrap_or(Scalar::F32);
        let parts = lanes.iter().map(|bits| match special(bits) {
            true => self.non_finite(*bits),
            false => self.dialect.scalar(kind, *bits),
        });
        let parts: Vec<Text> = parts.collect();
        self.dialect.vector(ty, &parts)
    }

    /// An infinity or a NaN. WGSL has no expression for one that is known when the shader is made, and takes the bits of a
    /// variable.
    fn non_finite(&mut self, bits: u32) -> Text {
        if let Some(text) = self.dialect.non_finite(bits) {
            return text;
        }
        if bits == f32::NEG_INFINITY.to_bits() {
            let infinity = self.non_finite(f32::INFINITY.to_bits());
            return Text::prefix("-", &infinity);
        }
        if let Some(special) = self.specials.get(&bits) {
            return Text::name(special.name.as_str());
        }
        let wanted = if f32::from_bits(bits).is_nan() {
            "nan"
        } else {
            "infinity"
        };
        let [name, variable] = [wanted.to_owned(), format!("{wanted}_bits")].map(|name| self.names.fresh(&name));
        let value = self
            .dialect
            .bitcast(Type::U32, Type::F32, &Text::name(variable.as_str()));
        let comment = "// A variable, since no constant may be an infinity or a NaN.".to_owned();
        let variable = self
            .dialect
            .mutable(&variable, Type::U32, Some(&format!("{bits:#010x}u")));
        let value = self.dialect.immutable(&name, Type::F32, &value.code);
        let lines = [comment, variable, value].map(|line| format!("    {line}")).into();
        self.statements += 2;
        let text = Text::name(name.as_str());
        self.specials.insert(bits, Special { name, lines });
        text
    }

    /// Operators and calls in the expression of a value, down to what has a name.
    fn size(&self, id: NodeId) -> u32 {
        let node = self.compiled.graph.node(id);
        let own = match node.op {
            Op::Pixel | Op::FrameSize | Op::Uniform(_) | Op::Varying(_) | Op::Splat | Op::Extract(_) | Op::Tally(_) => {
                0
            }
            _ => 1,
        };
        let inside = |arg: &NodeId| self.texts[arg.0 as usize].as_ref().map_or(0, |text| text.size);
        own + node.args.iter().map(inside).sum::<u32>()
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
