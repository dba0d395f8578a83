//! Lowers a scheduled graph to the statements of a kernel.
//!
//! Every step of the schedule becomes a statement or part of one. Lowering cannot fail: there is a tree for every graph.

mod arrays;
mod coalescing;
mod control;
mod entry;
mod exactness;
mod facts;
mod halves;
mod interference;

use super::ast::{Block as Statements, Effect, Expr, Module, Op, Source, Stmt, StmtKind, Ty, VarId};
use super::names::Wanted;
use super::outputs::whole_texel;
use super::tidy::simplify_expr;
use crate::compiled::Compiled;
use coalescing::ArrayCoalescing;
use exactness::Exactness;
use straightline_evaluator::ir::{self, BinaryOp, NodeId, Origin, Type};
use straightline_evaluator::passes::{Block, Step};

pub use entry::wrap_entry_point;

/// Number of uses from which a constant vector gets its own variable.
const OFTEN: u32 = 6;

/// Lowers a kernel: a statement for each value, and at the end an output for each pixel of the invocation.
pub fn lower_kernel<'g>(compiled: &'g Compiled, half: bool) -> Module<'g> {
    let graph = &compiled.graph;
    let mut lowering = Lowering {
        compiled,
        origins: node_origins(compiled),
        exact: Exactness::from_compiled(compiled),
        wanted: Wanted::new(graph),
        coalescing: ArrayCoalescing::new(graph, &compiled.schedule),
        indexed: indexed_arrays(compiled),
        exprs: vec![None; graph.nodes.len()],
        half,
        halves: match half {
            true => vec![false; graph.nodes.len()],
            false => halves::half_values(compiled),
        },
        module: entry::entry_module(),
        block: Vec::new(),
    };
    lowering.emit_constants();
    lowering.steps(&compiled.schedule.body);
    for pixel in graph.outputs().chunks(graph.targets.len().max(1)) {
        let values = pixel.iter().map(|output| lowering.node_expr(*output)).collect();
        let source = pixel
            .first()
            .map(|output| lowering.place_of(*output))
            .unwrap_or_default();
        lowering.block.push(Stmt {
            kind: StmtKind::Output(values),
            source,
        });
    }
    lowering.module.body = lowering.block;
    lowering.module
}

/// Returns the origin of each node. A tally passes its name on to the node that it tallies; nodes are visited last to
/// first, so that chains work too.
fn node_origins(compiled: &Compiled) -> Vec<Option<&Origin>> {
    let graph = &compiled.graph;
    let mut origins: Vec<Option<&Origin>> = graph.node_ids().map(|id| graph.origin(id)).collect();
    for id in graph.node_ids().rev() {
        if let ir::Op::Tally(_) = graph.node(id).op {
            let arg = graph.node(id).args[0].0 as usize;
            origins[arg] = origins[arg].or(origins[id.0 as usize]);
        }
    }
    origins
}

/// Returns for each node whether it is an array that is indexed.
fn indexed_arrays(compiled: &Compiled) -> Vec<bool> {
    let graph = &compiled.graph;
    let mut indexed = vec![false; graph.nodes.len()];
    let reads = graph
        .node_ids()
        .filter(|id| graph.node(*id).op == ir::Op::ArrayGet && compiled.schedule.has_node(*id));
    reads.for_each(|id| indexed[graph.node(id).args[0].0 as usize] = true);
    indexed
}

struct Lowering<'g> {
    compiled: &'g Compiled,
    exact: Exactness,
    /// Origin of each node.
    origins: Vec<Option<&'g Origin>>,
    wanted: Wanted,
    coalescing: ArrayCoalescing,
    /// `true` for each node that is an indexed array.
    indexed: Vec<bool>,
    /// Expression of each node, once it has been evaluated.
    exprs: Vec<Option<Expr>>,
    /// `true` if all floats are in half precision.
    half: bool,
    /// By node, `true` for an `f16` among floats of full precision.
    halves: Vec<bool>,
    module: Module<'g>,
    /// Statements of the current block.
    block: Statements<'g>,
}

impl<'g> Lowering<'g> {
    /// Declares constant vectors that have a name in the kernel and that many lines would repeat.
    fn emit_constants(&mut self) {
        let graph = &self.compiled.graph;
        for id in graph.node_ids() {
            if let ir::Op::Const(bits) = graph.node(id).op
                && self.compiled.schedule.uses[id.0 as usize] >= OFTEN
                && is_long(graph.ty(id), &bits)
                && self.origins[id.0 as usize].is_some_and(|origin| !origin.name.is_empty())
            {
                let var = self.new_variable(id);
                let value = Expr::constant(graph.ty(id), bits);
                self.module.tables.push((var, value));
                self.exprs[id.0 as usize] = Some(self.module.read_variable(var));
            }
        }
    }

    fn steps(&mut self, block: &'g Block) {
        for step in &block.steps {
            match step {
                Step::Eval(id) => self.lower_node(*id),
                Step::Loop { node, body } => self.lower_loop(*node, body),
                Step::If { node, then, otherwise } => self.lower_branch(*node, then, otherwise),
            }
        }
    }

    /// Returns the statements that `lower` emits, as a separate block.
    fn nested(&mut self, lower: impl FnOnce(&mut Self)) -> Statements<'g> {
        let outer = std::mem::take(&mut self.block);
        lower(self);
        std::mem::replace(&mut self.block, outer)
    }

    fn lower_node(&mut self, id: NodeId) {
        let node = self.compiled.graph.node(id);
        match &node.op {
            // Emitted at the use.
            ir::Op::Const(_) | ir::Op::Undef | ir::Op::Result(_) => {}
            ir::Op::MakeArray => self.make_array(id),
            // Emitted in the statement that rounds the value.
            _ if self.exact.is_part(id) => {}
            ir::Op::Exact => {
                let of = node.args[0];
                let rounded = match self.exact.is_part(of) {
                    true => self.build_expr(of),
                    false => self.node_expr(of),
                };
                let goes_on = self.exact.goes_on(id);
                let ty = rounded.ty;
                self.emit_let(id, Expr::new(Op::Exact { goes_on }, vec![simplify_expr(rounded)], ty));
            }
            ir::Op::ArraySet => self.array_set(id),
            ir::Op::ArrayGet => self.array_get(id),
            ir::Op::SharedLoad(_) => {
                let mut expr = self.build_expr(id);
                // The condition is dropped: the value read where it is `false` is unused.
                expr.args.remove(0);
                self.emit_let(id, simplify_expr(expr));
            }
            op if op.is_effect() => self.lower_effect(id),
            _ => {
                let expr = simplify_expr(self.build_expr(id));
                if is_atom(&expr) {
                    self.exprs[id.0 as usize] = Some(expr);
                } else {
                    self.emit_let(id, expr);
                }
            }
        }
    }

    /// Lowers a write to memory, with its condition.
    fn lower_effect(&mut self, id: NodeId) {
        let graph = &self.compiled.graph;
        let node = graph.node(id);
        let (memory, op) = match node.op {
            ir::Op::Atomic { memory, op } => (memory, Some(op)),
            ir::Op::Store(memory) => (memory, None),
            ir::Op::Barrier { buffers } => return self.emit_statement(id, StmtKind::Barrier { buffers }),
            _ => return,
        };
        let condition = simplify_expr(self.node_expr(node.args[0]));
        let args: Vec<Expr> = node.args[1..]
            .iter()
            .map(|arg| simplify_expr(self.node_expr(*arg)))
            .collect();
        if let (ir::Memory::Image(k), [place, value]) = (memory, &args[..]) {
            let output = graph.targets.len() + k as usize;
            let store = StmtKind::Store(output, place.clone(), whole_texel(value.clone()));
            return self.emit_conditional(id, condition, store);
        }
        let mut effect = Effect {
            memory,
            op,
            args,
            before: None,
        };
        let always = condition.as_constant().is_some_and(|bits| bits[0] != 0);
        if op.is_some() && (self.compiled.schedule.uses[id.0 as usize] > 0 || effect.needs_variable()) {
            let var = self.new_variable(id);
            let zero = (!always).then(|| Expr::splat(node.ty, 0));
            self.emit_statement(id, StmtKind::Var(var, zero));
            self.exprs[id.0 as usize] = Some(self.module.read_variable(var));
            effect.before = Some(var);
        }
        self.emit_conditional(id, condition, StmtKind::Effect(effect));
    }

    /// Emits a statement under a condition.
    fn emit_conditional(&mut self, id: NodeId, condition: Expr, stmt: StmtKind<'g>) {
        match condition.as_constant() {
            Some([0, ..]) => {}
            Some(_) => self.emit_statement(id, stmt),
            None => {
                let then = self.nested(|lowering| lowering.emit_statement(id, stmt));
                let kind = StmtKind::If {
                    condition,
                    then,
                    otherwise: Vec::new(),
                };
                self.emit_statement(id, kind);
            }
        }
    }

    /// Creates a variable for a node's value.
    fn new_variable(&mut self, id: NodeId) -> VarId {
        let graph = &self.compiled.graph;
        let name = self.wanted.preferred_name(graph, id, self.origins[id.0 as usize]);
        self.module.new_variable(name, self.value_type(id))
    }

    fn value_type(&self, id: NodeId) -> Ty {
        Ty {
            half: self.halves[id.0 as usize],
            ..self.compiled.graph.ty(id).into()
        }
    }

    /// Emits a statement that names a value.
    fn emit_let(&mut self, id: NodeId, value: Expr) {
        let var = self.new_variable(id);
        self.emit_statement(id, StmtKind::Let(var, value));
        self.exprs[id.0 as usize] = Some(self.module.read_variable(var));
    }

    /// Emits a statement with a node's source.
    fn emit_statement(&mut self, id: NodeId, kind: StmtKind<'g>) {
        let source = Source {
            origin: self.origins[id.0 as usize],
            ..self.place_of(id)
        };
        self.block.push(Stmt { kind, source });
    }

    /// Returns the place of a node, as the source of a statement without a name.
    fn place_of(&self, id: NodeId) -> Source<'g> {
        Source {
            origin: None,
            place: self.compiled.graph.place(id),
        }
    }

    /// Returns the expression of a node that has been evaluated, in full precision.
    fn node_expr(&mut self, id: NodeId) -> Expr {
        self.held_expr(id).into_full()
    }

    /// Returns the expression of a node that has been evaluated, in the precision that holds its value.
    fn held_expr(&mut self, id: NodeId) -> Expr {
        if let Some(expr) = &self.exprs[id.0 as usize] {
            return expr.clone();
        }
        let node = self.compiled.graph.node(id);
        match &node.op {
            ir::Op::MakeArray => {
                let parts = node.args.iter().map(|arg| self.node_expr(*arg)).collect();
                Expr::new(Op::Construct, parts, node.ty)
            }
            ir::Op::Const(bits) => Expr::constant(node.ty, *bits),
            ir::Op::Undef => Expr::splat(node.ty, 0),
            _ => self.version_expr(id),
        }
    }

    fn build_expr(&mut self, id: NodeId) -> Expr {
        let graph = &self.compiled.graph;
        let node = graph.node(id);
        let args: Vec<Expr> = node.args.iter().map(|arg| self.held_expr(*arg)).collect();
        let convert = match halves::is_operation_on_halves(graph, id, &self.halves) {
            true => Expr::into_half,
            false => Expr::into_full,
        };
        let mut args: Vec<Expr> = args.into_iter().map(convert).collect();
        let op = match &node.op {
            ir::Op::Pixel => Op::Var(VarId::PIXEL),
            ir::Op::FrameSize => Op::Var(VarId::FRAME),
            ir::Op::Thread => Op::Var(VarId::LOCAL),
            ir::Op::GroupOrigin => Op::Var(VarId::ORIGIN),
            ir::Op::Inside => Op::Var(VarId::INSIDE),
            ir::Op::Lane => {
                args = vec![Expr::var(VarId::PIXEL, node.ty), Expr::splat(node.ty, 1)];
                Op::Ir(ir::Op::Binary(BinaryOp::And))
            }
            ir::Op::Binary(op @ (BinaryOp::Div | BinaryOp::Rem)) if node.ty.is_integer() => {
                Op::Division(*op, facts::division_facts(graph, node.args[0], node.args[1]))
            }
            ir::Op::Splat | ir::Op::Compose => Op::Construct,
            ir::Op::Extract(component) => Op::Swizzle(vec![*component]),
            ir::Op::Convert => Op::Convert {
                fits: facts::is_convertible(graph, node.args[0], node.ty, self.half),
            },
            ir::Op::Tally(_) | ir::Op::Half => return args.swap_remove(0),
            // Texels have four components, of which the kernel may take fewer.
            ir::Op::Load { texture, .. } | ir::Op::Sample { texture, .. }
                if !graph.textures[*texture as usize].kind.is_depth() && node.ty.component_count() < 4 =>
            {
                let whole = Type::value(graph.textures[*texture as usize].scalar, 4);
                let texel = Expr::new(Op::Ir(node.op.clone()), args, whole);
                args = vec![texel];
                Op::Swizzle((0..node.ty.component_count()).collect())
            }
            op => match facts::float_domain(graph, id, self.compiled.policy.math) {
                Some(domain) => Op::Guarded(op.clone(), domain),
                None => Op::Ir(op.clone()),
            },
        };
        if matches!(op, Op::Var(_)) {
            args.clear();
        }
        Expr::new(op, args, self.value_type(id))
    }
}

/// Returns whether an expression is short enough to be repeated at every use.
fn is_atom(expr: &Expr) -> bool {
    match &expr.op {
        Op::Var(_) | Op::Ir(ir::Op::Const(_) | ir::Op::Uniform(_) | ir::Op::Override(_) | ir::Op::Varying(_)) => true,
        Op::Swizzle(_) => is_atom(&expr.args[0]),
        Op::Construct => expr.args.len() == 1 && is_atom(&expr.args[0]),
        _ => false,
    }
}

/// Returns whether a constant is a vector of three or four finite floats that are not all equal.
fn is_long(ty: Type, bits: &ir::Bits) -> bool {
    let lanes = &bits[..usize::from(ty.component_count())];
    let finite = |lane: &u32| f32::from_bits(*lane).is_finite();
    ty.is_float() && lanes.len() >= 3 && lanes.iter().all(finite) && lanes.iter().any(|lane| *lane != lanes[0])
}
