//! The tree of a shader: statements and expressions, each with its type, between the graph and a language's text.
//!
//! [`super::lower`] makes it, [`super::legalise`] rewrites what a language says in another way, [`super::names`] gives its
//! variables names, and [`super::print`] writes it. No stage asks a text what it means.

use std::ops::Deref;
use straightline_evaluator::ir::{self, AtomicOp, BinaryOp, Bits, Memory, Origin, Scalar, Type};

/// Type of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Ty {
    /// Scalar, vector or array.
    pub shape: Type,
    /// `true` if floats have 16 bits.
    pub half: bool,
}

impl Ty {
    /// Returns the same shape with components of another kind, in full precision.
    pub fn with_kind(self, scalar: Scalar) -> Ty {
        self.shape.with_scalar(scalar).into()
    }

    /// Returns a short name of the type, which is how WGSL spells it: `f32`, `vec3f`, `array<vec2i, 9>`.
    pub fn short_name(self) -> String {
        match self.shape {
            Type::Array { len, .. } => format!("array<{}, {len}>", self.element_ty().short_name()),
            Type::Value { scalar, components } => match (components, scalar) {
                (1, Scalar::F32) if self.half => "f16".to_owned(),
                (1, _) => scalar.to_string(),
                (_, Scalar::Bool) => format!("vec{components}<bool>"),
                (_, Scalar::F32) if self.half => format!("vec{components}h"),
                _ => format!("vec{components}{}", &scalar.to_string()[..1]),
            },
            Type::Results => "void".to_owned(),
        }
    }

    /// Returns a scalar or vector of `lanes` such components.
    pub fn shape_of(self, lanes: usize) -> Ty {
        let scalar = self.scalar_kind().unwrap_or(Scalar::F32);
        Ty {
            shape: Type::value(scalar, lanes as u8),
            ..self
        }
    }

    /// Returns the type of a component, in full precision.
    pub fn element_of(self) -> Type {
        Type::scalar(self.scalar_kind().unwrap_or(Scalar::F32))
    }

    /// An element of an array; a value is its own.
    pub fn element_ty(self) -> Ty {
        Ty {
            shape: self.shape.element_type(),
            ..self
        }
    }

    /// Returns this type in full precision.
    pub fn to_full_precision(self) -> Ty {
        self.shape.into()
    }
}

impl From<Type> for Ty {
    fn from(shape: Type) -> Ty {
        Ty { shape, half: false }
    }
}

impl Deref for Ty {
    type Target = Type;

    fn deref(&self) -> &Type {
        &self.shape
    }
}

/// A variable of the module: an index into [`Module::variables`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct VarId(pub u32);

impl VarId {
    /// The pixel, and of a block its upper left one.
    pub const PIXEL: VarId = VarId(0);
    /// Width and height of the frame.
    pub const FRAME: VarId = VarId(1);
    /// The pixel, counted from the region's upper left one.
    pub const WITHIN: VarId = VarId(2);
    /// The pixel in the target of a region.
    pub const PLACE: VarId = VarId(3);
    /// The pixel of the workgroup's first invocation.
    pub const ORIGIN: VarId = VarId(4);
    /// Boolean that holds if the invocation's pixel is one to compute.
    pub const INSIDE: VarId = VarId(5);
    /// Position of the invocation in its workgroup.
    pub const LOCAL: VarId = VarId(6);
    /// Stands for the memory of a workgroup in queries of the variables that a statement changes.
    pub const MEMORY: VarId = VarId(u32::MAX);
}

/// A variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Preferred name; [`super::names`] makes names differ.
    pub name: String,
    /// Type of the value.
    pub ty: Ty,
    /// `true` if compilers must round its values as written.
    pub precise: bool,
}

/// A built-in value that the host or the driver provides to the entry point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builtin {
    /// Position of the invocation in the dispatch, `vec2<i32>`.
    Invocation,
    /// Position of the invocation in its workgroup, `vec2<i32>`.
    Local,
    /// Number of the invocation in its workgroup, row by row, `i32`.
    LocalIndex,
    /// Position of the workgroup in the dispatch, `vec2<i32>`.
    Group,
    /// Position of the fragment, `vec2<f32>`, at a pixel's centre.
    Position,
    /// Width and height of the storage texture that is written, `vec2<i32>`.
    OutputSize,
    /// Upper left pixel of the region in the inputs, `vec2<i32>`.
    RegionFirst,
    /// Width and height of the region, `vec2<i32>`.
    RegionSize,
    /// Upper left pixel of the region in the target, `vec2<i32>`.
    RegionPlace,
}

/// Facts about the operands of an integer division.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Division {
    /// No component of the divisor can be 0, and no quotient can overflow.
    pub defined: bool,
    /// No component of either side can be negative.
    pub positive: bool,
}

/// Facts about the arguments of a function of floats whose edge cases a shader may have to handle itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Domain {
    /// No component of the first argument is a NaN or below 0; it may be -0.
    pub not_negative: bool,
    /// Every component of the first argument is greater than 0, and normal.
    pub positive: bool,
    /// Of a remainder, the quotient is less than 2048.
    pub bounded: bool,
}

/// Operation of an expression on its arguments.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    /// An operation of the graph that is none of the others here.
    Ir(ir::Op),
    /// A division or remainder of integers.
    Division(BinaryOp, Division),
    /// A function of floats whose arguments may lie where drivers depart from it.
    Guarded(ir::Op, Domain),
    /// A conversion. `fits` says of integers that every precision has finite numbers as large, of floats that the target type has
    /// an integer for each of them.
    Convert {
        /// `true` if every value can be converted.
        fits: bool,
    },
    /// A vector from scalars, one scalar for all components; an array from its elements.
    Construct,
    /// Components of a vector.
    Swizzle(Vec<u8>),
    /// The argument, as the operation that computes it rounds it. The value of a `let`, a `var` or an assignment, never part of
    /// another expression.
    Exact {
        /// `true` if further arithmetic uses the result, which a compiler could merge with it.
        goes_on: bool,
    },
    /// An element of an array: array, index. An index outside is that of the last element.
    Index {
        /// `true` if the index cannot lie outside.
        inside: bool,
    },
    /// A variable.
    Var(VarId),
    /// A built-in value of the entry point.
    Builtin(Builtin),
    /// True if any component is.
    Any,
    /// True if all components are.
    All,
    /// By component: condition, value if it holds, value if not.
    Choose,
    /// An unsigned constant that says something by its bits, the same in all components.
    Hex(u32),
    /// A built-in function of the language, by its name there.
    Call(&'static str),
    /// A function of the module's.
    Function(String),
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// Operation.
    pub op: Op,
    /// Operands.
    pub args: Vec<Expr>,
    /// Type of the result.
    pub ty: Ty,
}

impl Expr {
    /// An operation of arguments.
    pub fn new(op: Op, args: Vec<Expr>, ty: impl Into<Ty>) -> Expr {
        let ty = ty.into();
        Expr { op, args, ty }
    }

    /// A constant from its bits.
    pub fn constant(ty: impl Into<Ty>, bits: Bits) -> Expr {
        Expr::new(Op::Ir(ir::Op::Const(bits)), Vec::new(), ty)
    }

    /// A constant with the same bits in every component.
    pub fn splat(ty: impl Into<Ty>, bits: u32) -> Expr {
        Expr::constant(ty, [bits; 4])
    }

    /// A vector of two constant integers.
    pub fn ivec2(x: i32, y: i32) -> Expr {
        Expr::constant(Type::value(Scalar::I32, 2), [x as u32, y as u32, 0, 0])
    }

    /// A variable.
    pub fn var(var: VarId, ty: impl Into<Ty>) -> Expr {
        Expr::new(Op::Var(var), Vec::new(), ty)
    }

    /// `self op other`.
    pub fn binary(self, op: BinaryOp, other: Expr) -> Expr {
        let ty = if op.is_comparison() {
            self.ty.with_kind(Scalar::Bool)
        } else {
            self.ty
        };
        Expr::new(Op::Ir(ir::Op::Binary(op)), vec![self, other], ty)
    }

    /// The value as another type, cut off or rounded; every value fits.
    pub fn convert_to(self, ty: impl Into<Ty>) -> Expr {
        Expr::new(Op::Convert { fits: true }, vec![self], ty)
    }

    /// Reinterprets the bits as another type.
    pub fn bits_as(self, ty: impl Into<Ty>) -> Expr {
        Expr::new(Op::Ir(ir::Op::Bitcast), vec![self], ty)
    }

    /// A built-in function of the language.
    pub fn call(name: &'static str, args: Vec<Expr>, ty: impl Into<Ty>) -> Expr {
        Expr::new(Op::Call(name), args, ty)
    }

    /// The bits of a constant.
    pub fn as_constant(&self) -> Option<&Bits> {
        match &self.op {
            Op::Ir(ir::Op::Const(bits)) => Some(bits),
            _ => None,
        }
    }

    /// Rewrites every expression in this one, arguments first.
    pub fn rewrite(self, rule: &mut dyn FnMut(Expr) -> Expr) -> Expr {
        let args = self.args.into_iter().map(|arg| arg.rewrite(rule)).collect();
        rule(Expr { args, ..self })
    }

    /// As [`Expr::rewrite`], where the expression stands.
    pub fn rewrite_in_place(&mut self, rule: &mut dyn FnMut(Expr) -> Expr) {
        let taken = std::mem::replace(self, Expr::new(Op::Construct, Vec::new(), self.ty));
        *self = taken.rewrite(rule);
    }

    /// Shows every expression in this one, arguments first.
    pub fn visit(&self, see: &mut dyn FnMut(&Expr)) {
        self.args.iter().for_each(|arg| arg.visit(see));
        see(self);
    }

    /// Number of operators and calls in it.
    pub fn operation_count(&self) -> usize {
        let mut count = 0;
        self.visit(&mut |expr| {
            let free = matches!(
                expr.op,
                Op::Var(_) | Op::Swizzle(_) | Op::Ir(ir::Op::Const(_) | ir::Op::Uniform(_))
            );
            count += usize::from(!free);
        });
        count
    }
}

/// A statement, and where its value comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Stmt<'g> {
    /// Kind of statement, with its operands.
    pub kind: StmtKind<'g>,
    /// The place in the kernel's source.
    pub origin: Option<&'g Origin>,
}

/// A sequence of statements.
pub type Block<'g> = Vec<Stmt<'g>>;

/// Kind of a statement, with its operands.
#[derive(Clone, Debug, PartialEq)]
pub enum StmtKind<'g> {
    /// An immutable variable.
    Let(VarId, Expr),
    /// A mutable variable; without a value it is undefined until it is assigned.
    Var(VarId, Option<Expr>),
    /// Another value for a variable or an element: `place = value`, or `place op= value`.
    Assign(Expr, Option<BinaryOp>, Expr),
    /// Counts from a start up to an end that is not reached.
    For {
        /// The counter.
        counter: VarId,
        /// First value.
        start: Expr,
        /// Exclusive upper bound.
        end: Expr,
        /// Statements of an iteration.
        body: Block<'g>,
    },
    /// Repeats until a [`StmtKind::Break`].
    Loop(Block<'g>),
    /// Leaves the innermost loop.
    Break,
    /// A branch with two sides.
    If {
        /// A scalar boolean.
        condition: Expr,
        /// If it holds.
        then: Block<'g>,
        /// If not.
        otherwise: Block<'g>,
    },
    /// Writes a texel of an output: which one, place, value.
    Store(usize, Expr, Expr),
    /// Values of a pixel, one for each output.
    Output(Vec<Expr>),
    /// Writes to memory.
    Effect(Effect),
    /// Waits for the other invocations of the workgroup, whose writes are seen behind it.
    Barrier {
        /// `true` if the barrier also orders writes to buffers.
        buffers: bool,
    },
    /// Leaves the function, with its value if it has one.
    Return(Option<Expr>),
    /// A line for the reader.
    Comment(String),
}

/// A write to memory, whose index is inside of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// The memory written.
    pub memory: Memory,
    /// The atomic operation; a plain store has none.
    pub op: Option<AtomicOp>,
    /// Index and value; a load has no value.
    pub args: Vec<Expr>,
    /// The variable that takes what was there before.
    pub before: Option<VarId>,
}

impl Effect {
    /// Returns whether some language can only express the operation with a variable for the old value.
    pub fn needs_variable(&self) -> bool {
        matches!(self.op, Some(AtomicOp::Exchange | AtomicOp::Load))
    }
}

impl<'g> From<StmtKind<'g>> for Stmt<'g> {
    fn from(kind: StmtKind<'g>) -> Stmt<'g> {
        Stmt { kind, origin: None }
    }
}

impl<'g> Stmt<'g> {
    /// Rewrites every expression of the statement, those of its blocks too.
    pub fn rewrite(&mut self, rule: &mut dyn FnMut(Expr) -> Expr) {
        for expr in self.own_mut() {
            expr.rewrite_in_place(rule);
        }
        for block in self.blocks_mut() {
            block.iter_mut().for_each(|stmt| stmt.rewrite(rule));
        }
    }

    /// Expressions of the statement itself, without those of its blocks.
    pub fn own_exprs(&self) -> impl Iterator<Item = &Expr> {
        let (few, many): (_, &[Expr]) = match &self.kind {
            StmtKind::Let(_, value) => ([Some(value), None], &[]),
            StmtKind::Output(values) => ([None; 2], values),
            StmtKind::Effect(effect) => ([None; 2], &effect.args),
            StmtKind::Var(_, value) | StmtKind::Return(value) => ([value.as_ref(), None], &[]),
            StmtKind::Assign(place, _, value) | StmtKind::Store(_, place, value) => ([Some(place), Some(value)], &[]),
            StmtKind::For { start, end, .. } => ([Some(start), Some(end)], &[]),
            StmtKind::If { condition, .. } => ([Some(condition), None], &[]),
            StmtKind::Loop(_) | StmtKind::Break | StmtKind::Comment(_) | StmtKind::Barrier { .. } => ([None; 2], &[]),
        };
        few.into_iter().flatten().chain(many)
    }

    /// Shows every expression of the statement, those of its blocks too.
    pub fn visit(&self, see: &mut dyn FnMut(&Expr)) {
        self.own_exprs().for_each(|expr| expr.visit(see));
        for block in self.blocks() {
            block.iter().for_each(|stmt| stmt.visit(see));
        }
    }

    /// As [`Stmt::own_exprs`], to change them.
    pub fn own_mut(&mut self) -> impl Iterator<Item = &mut Expr> {
        let (few, many): (_, &mut [Expr]) = match &mut self.kind {
            StmtKind::Let(_, value) => ([Some(value), None], &mut []),
            StmtKind::Output(values) => ([None, None], values),
            StmtKind::Effect(effect) => ([None, None], &mut effect.args),
            StmtKind::Var(_, value) | StmtKind::Return(value) => ([value.as_mut(), None], &mut []),
            StmtKind::Assign(place, _, value) | StmtKind::Store(_, place, value) => {
                ([Some(place), Some(value)], &mut [])
            }
            StmtKind::For { start, end, .. } => ([Some(start), Some(end)], &mut []),
            StmtKind::If { condition, .. } => ([Some(condition), None], &mut []),
            StmtKind::Loop(_) | StmtKind::Break | StmtKind::Comment(_) | StmtKind::Barrier { .. } => {
                ([None, None], &mut [])
            }
        };
        few.into_iter().flatten().chain(many)
    }

    /// As [`Stmt::blocks`], to change them.
    pub fn blocks_mut(&mut self) -> Vec<&mut Block<'g>> {
        match &mut self.kind {
            StmtKind::For { body, .. } | StmtKind::Loop(body) => vec![body],
            StmtKind::If { then, otherwise, .. } => vec![then, otherwise],
            _ => Vec::new(),
        }
    }

    /// Blocks of the statement.
    pub fn blocks(&self) -> Vec<&Block<'g>> {
        match &self.kind {
            StmtKind::For { body, .. } | StmtKind::Loop(body) => vec![body],
            StmtKind::If { then, otherwise, .. } => vec![then, otherwise],
            _ => Vec::new(),
        }
    }
}

/// Statements of a block and of the blocks in it; comments are none.
pub fn count_statements(block: &[Stmt<'_>]) -> u32 {
    let own = |stmt: &Stmt<'_>| u32::from(!matches!(stmt.kind, StmtKind::Comment(_)));
    block
        .iter()
        .map(|stmt| {
            own(stmt)
                + stmt
                    .blocks()
                    .into_iter()
                    .map(|inner| count_statements(inner))
                    .sum::<u32>()
        })
        .sum()
}

/// A function beside the entry point.
#[derive(Clone, Debug, PartialEq)]
pub struct Function<'g> {
    /// Purpose, printed above the function.
    pub comment: String,
    /// Name in the text.
    pub name: String,
    /// Parameters.
    pub params: Vec<VarId>,
    /// Type of the result.
    pub result: Ty,
    /// Statements.
    pub body: Block<'g>,
}

/// A shader: what stands at module scope beside the bindings, and the entry point's body.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Module<'g> {
    /// All variables.
    pub variables: Vec<Variable>,
    /// Constant arrays.
    pub tables: Vec<(VarId, Expr)>,
    /// Functions, by name and type of their results.
    pub functions: Vec<Function<'g>>,
    /// The entry point's statements.
    pub body: Block<'g>,
}

impl<'g> Module<'g> {
    /// A new variable.
    pub fn new_variable(&mut self, name: impl Into<String>, ty: impl Into<Ty>) -> VarId {
        let (name, ty) = (name.into(), ty.into());
        self.variables.push(Variable {
            name,
            ty,
            precise: false,
        });
        VarId(self.variables.len() as u32 - 1)
    }

    /// Returns whether the entry point contains an exact operation.
    pub fn has_exact(&self) -> bool {
        let mut found = false;
        let mut see = |expr: &Expr| found |= matches!(expr.op, Op::Exact { .. });
        self.body.iter().for_each(|stmt| stmt.visit(&mut see));
        found
    }

    /// A variable's type.
    pub fn variable_type(&self, var: VarId) -> Ty {
        self.variables[var.0 as usize].ty
    }

    /// A variable as an expression.
    pub fn read_variable(&self, var: VarId) -> Expr {
        Expr::var(var, self.variable_type(var))
    }

    /// Rewrites every expression, arguments first. What the rule adds to the module is not rewritten.
    pub fn rewrite(&mut self, rule: &mut dyn FnMut(&mut Module<'g>, Expr) -> Expr) {
        let (mut body, tables) = (std::mem::take(&mut self.body), std::mem::take(&mut self.tables));
        for stmt in &mut body {
            stmt.rewrite(&mut |expr| rule(self, expr));
        }
        let tables = tables
            .into_iter()
            .map(|(var, value)| (var, value.rewrite(&mut |expr| rule(self, expr))));
        let tables: Vec<_> = tables.collect();
        self.tables.splice(0..0, tables);
        self.body = body;
    }

    /// Adds a function unless it is there; gives its name.
    pub fn add_function(&mut self, name: &str, result: Ty, make: impl FnOnce(&mut Self) -> Function<'g>) -> Op {
        if !self.functions.iter().any(|f| f.name == name && f.result == result) {
            let function = make(self);
            self.functions.push(function);
        }
        Op::Function(name.to_owned())
    }
}
