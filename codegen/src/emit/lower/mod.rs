//! From a scheduled graph to the statements of a kernel.
//!
//! Every step of the schedule becomes a statement or part of one. This cannot fail: whatever the graph, there is a tree.

mod arrays;
mod control;
mod entry;
mod facts;
mod webs;

use super::EmitOptions;
use super::ast::{Block as Statements, Expr, Module, Op, Stmt, StmtKind, VarId};
use super::names::Wanted;
use super::plan::Plan;
use crate::ir::{self, BinaryOp, NodeId};
use crate::passes::{Block, Step};
use crate::pipeline::Compiled;
use std::collections::HashSet;
use straightline_manifest::Precision;
use webs::Webs;

pub use entry::entry;

/// Operators and calls that one expression may hold before part of it becomes a statement. Long chains also overflow
/// the recursive parsers of shader compilers.
const LONGEST: u32 = 7;

/// Cuts after which every version of an array is given a variable of its own.
const MAX_CUTS: usize = 16;

/// The statements of a kernel, and the colours of the invocation's pixels.
pub fn lower<'g>(compiled: &'g Compiled, options: &EmitOptions) -> (Module<'g>, Vec<Expr>) {
    let graph = &compiled.graph;
    let mut cut = HashSet::new();
    while cut.len() < MAX_CUTS {
        match attempt(compiled, options, Webs::new(graph, &cut)) {
            (lowered, None) => return lowered,
            (_, Some(Stale::Since(version))) if cut.insert(version) => {}
            _ => break,
        }
    }
    // No version takes another's place where each has a variable of its own.
    attempt(compiled, options, Webs::apart(graph)).0
}

/// An array's version is needed that its variable no longer holds.
#[derive(Clone, Copy)]
enum Stale {
    /// Cut its web before this version, which took its place.
    Since(NodeId),
    /// It is not known which version took its place.
    Unknown,
}

fn attempt<'g>(compiled: &'g Compiled, options: &EmitOptions, webs: Webs) -> ((Module<'g>, Vec<Expr>), Option<Stale>) {
    let graph = &compiled.graph;
    let mut lowering = Lowering {
        compiled,
        plan: Plan::new(graph, &compiled.schedule),
        wanted: Wanted::new(graph),
        webs,
        exprs: vec![None; graph.nodes.len()],
        sizes: vec![0; graph.nodes.len()],
        half: options.precision == Precision::F16,
        module: entry::module(),
        block: Vec::new(),
        stale: None,
    };
    lowering.steps(&compiled.schedule.body);
    let results = graph.outputs().iter().map(|output| lowering.expr(*output)).collect();
    lowering.module.body = lowering.block;
    ((lowering.module, results), lowering.stale)
}

struct Lowering<'g> {
    compiled: &'g Compiled,
    plan: Plan<'g>,
    wanted: Wanted,
    webs: Webs,
    /// By node: how its value is written, once it has been evaluated.
    exprs: Vec<Option<Expr>>,
    /// By node: operators and calls in that.
    sizes: Vec<u32>,
    /// Whether floats are those of half precision.
    half: bool,
    module: Module<'g>,
    /// Statements of the block that is being lowered.
    block: Statements<'g>,
    /// The first array version that was read too late.
    stale: Option<Stale>,
}

impl<'g> Lowering<'g> {
    fn steps(&mut self, block: &'g Block) {
        for step in &block.steps {
            match step {
                Step::Eval(id) => self.eval(*id),
                Step::Loop { node, body } => self.looped(*node, body),
                Step::If { node, then, otherwise } => self.branch(*node, then, otherwise),
            }
        }
    }

    /// The statements that `lower` makes, as a block of their own.
    fn nested(&mut self, lower: impl FnOnce(&mut Self)) -> Statements<'g> {
        let outer = std::mem::take(&mut self.block);
        lower(self);
        std::mem::replace(&mut self.block, outer)
    }

    fn eval(&mut self, id: NodeId) {
        let node = self.compiled.graph.node(id);
        match &node.op {
            // Written where it is used, first copied or indexed.
            ir::Op::Const(_) | ir::Op::MakeArray | ir::Op::Result(_) => {}
            ir::Op::ArraySet => self.array_set(id),
            ir::Op::ArrayGet => self.array_get(id),
            _ => {
                let expr = self.expression(id);
                let size = self.size(id);
                if self.plan.is_statement(id) || size > LONGEST {
                    self.declare(id, expr);
                } else {
                    self.sizes[id.0 as usize] = size;
                    self.exprs[id.0 as usize] = Some(expr);
                }
            }
        }
    }

    /// A new variable for a node's value.
    fn variable(&mut self, id: NodeId) -> VarId {
        let graph = &self.compiled.graph;
        let name = self.wanted.of(graph, id, self.plan.origin(id));
        self.module.variable(name, graph.ty(id))
    }

    /// A statement that names a value.
    fn declare(&mut self, id: NodeId, value: Expr) {
        let var = self.variable(id);
        self.statement(id, StmtKind::Let(var, value));
        self.exprs[id.0 as usize] = Some(self.module.read(var));
    }

    /// A statement of a node's.
    fn statement(&mut self, id: NodeId, kind: StmtKind<'g>) {
        let origin = self.plan.origin(id);
        self.block.push(Stmt { kind, origin });
    }

    /// The value of a node that has been evaluated.
    fn expr(&mut self, id: NodeId) -> Expr {
        if let Some(expr) = &self.exprs[id.0 as usize] {
            return expr.clone();
        }
        let node = self.compiled.graph.node(id);
        match &node.op {
            ir::Op::MakeArray => {
                let parts = node.args.iter().map(|arg| self.expr(*arg)).collect();
                Expr::new(Op::Construct, parts, node.ty)
            }
            ir::Op::Const(bits) => Expr::constant(node.ty, *bits),
            _ => self.version(id),
        }
    }

    fn expression(&mut self, id: NodeId) -> Expr {
        let graph = &self.compiled.graph;
        let node = graph.node(id);
        let mut args: Vec<Expr> = node.args.iter().map(|arg| self.expr(*arg)).collect();
        let op = match &node.op {
            ir::Op::Pixel => Op::Var(VarId::PIXEL),
            ir::Op::FrameSize => Op::Var(VarId::FRAME),
            ir::Op::Lane => {
                args = vec![Expr::var(VarId::PIXEL, node.ty), Expr::splat(node.ty, 1)];
                Op::Ir(ir::Op::Binary(BinaryOp::And))
            }
            ir::Op::Binary(op @ (BinaryOp::Div | BinaryOp::Rem)) if node.ty.is_integer() => {
                Op::Division(*op, facts::division(graph, node.args[0], node.args[1]))
            }
            ir::Op::Binary(op) => {
                // A scalar stands for a vector of it; one side stays a vector, or the result would be a scalar.
                let stands = matches!(op, BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul | BinaryOp::Div);
                let splat = |arg: &NodeId| graph.node(*arg).op == ir::Op::Splat;
                let both = node.args.iter().all(splat);
                for (k, arg) in node.args.iter().enumerate() {
                    if stands && splat(arg) && (k > 0 || !both) {
                        args[k] = self.expr(graph.node(*arg).args[0]);
                    }
                }
                Op::Ir(node.op.clone())
            }
            ir::Op::Splat | ir::Op::Compose => Op::Construct,
            ir::Op::Extract(component) => Op::Swizzle(vec![*component]),
            ir::Op::Convert => Op::Convert {
                fits: facts::converts(graph, node.args[0], node.ty, self.half),
            },
            ir::Op::Tally(_) => return args.swap_remove(0),
            op => Op::Ir(op.clone()),
        };
        if matches!(op, Op::Var(_)) {
            args.clear();
        }
        Expr::new(op, args, node.ty)
    }

    /// Operators and calls in the expression of a value, down to what has a name.
    fn size(&self, id: NodeId) -> u32 {
        use ir::Op::{Extract, FrameSize, Pixel, Splat, Tally, Uniform, Varying};
        let node = self.compiled.graph.node(id);
        let own = match node.op {
            Pixel | FrameSize | Uniform(_) | Varying(_) | Splat | Extract(_) | Tally(_) => 0,
            _ => 1,
        };
        own + node.args.iter().map(|arg| self.sizes[arg.0 as usize]).sum::<u32>()
    }
}
