//! The tree of a shader: typed statements and expressions, between the graph and a language's text.
//!
//! [`super::lower`] builds the tree, [`super::legalise`] rewrites what a language expresses differently, [`super::names`]
//! names its variables, and [`super::print`] prints it. No stage parses text.

use std::ops::Deref;
use straightline_evaluator::ir::{self, AtomicOp, BinaryOp, Bits, Memory, Origin, Place, Scalar, Type};

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

    /// Returns the type of an array's elements; any other type is returned unchanged.
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
    /// The pixel; for a block, its upper left pixel.
    pub const PIXEL: VarId = VarId(0);
    /// Width and height of the frame.
    pub const FRAME: VarId = VarId(1);
    /// The pixel, relative to the region's upper left pixel.
    pub const WITHIN: VarId = VarId(2);
    /// The pixel in the target of a region.
    pub const PLACE: VarId = VarId(3);
    /// The pixel of the workgroup's first invocation.
    pub const ORIGIN: VarId = VarId(4);
    /// Boolean that is `true` if the invocation's pixel is to be computed.
    pub const INSIDE: VarId = VarId(5);
    /// Position of the invocation in its workgroup.
    pub const LOCAL: VarId = VarId(6);
    /// Stand-in for workgroup memory, in queries for the variables that a statement changes.
    pub const MEMORY: VarId = VarId(u32::MAX);
}

/// A variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Preferred name; [`super::names`] makes names unique.
    pub name: String,
    /// Type of the value.
    pub ty: Ty,
    /// `true` if compilers must round its values as written.
    pub precise: bool,
}

/// A built-in value of the entry point, provided by the host or the driver.
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
    /// Width and height of the written storage texture, `vec2<i32>`.
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

/// Facts about the arguments of a float function whose edge cases the shader may have to handle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Domain {
    /// No component of the first argument is a NaN or below 0; it may be -0.
    pub not_negative: bool,
    /// Every component of the first argument is greater than 0, and normal.
    pub positive: bool,
    /// For a remainder: the quotient is less than 2048.
    pub bounded: bool,
}

/// Operation of an expression on its arguments.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    /// An operation of the graph without a variant of its own here.
    Ir(ir::Op),
    /// A division or remainder of integers.
    Division(BinaryOp, Division),
    /// A float function with arguments in the range where drivers deviate from the specification.
    Guarded(ir::Op, Domain),
    /// A conversion. For integers, `fits` states that every precision has finite numbers as large. For floats, it states
    /// that the target type can represent each truncated value.
    Convert {
        /// `true` if every value can be converted.
        fits: bool,
    },
    /// A vector from scalars, one scalar for all components; an array from its elements.
    Construct,
    /// Components of a vector.
    Swizzle(Vec<u8>),
    /// The argument, rounded exactly as its operation specifies. Occurs only as the value of a `let`, a `var` or an
    /// assignment, never inside another expression.
    Exact {
        /// `true` if further arithmetic uses the result and a compiler could contract the two.
        goes_on: bool,
    },
    /// An element of an array: array, index. An index out of bounds is clamped to the last element.
    Index {
        /// `true` if the index is always in bounds.
        inside: bool,
    },
    /// A variable.
    Var(VarId),
    /// A built-in value of the entry point.
    Builtin(Builtin),
    /// `true` if any component is.
    Any,
    /// `true` if all components are.
    All,
    /// Component-wise selection: condition, value if true, value if false.
    Choose,
    /// An unsigned constant printed in hexadecimal, the same in all components.
    Hex(u32),
    /// A built-in function of the language, by its name there.
    Call(&'static str),
    /// A function of the module.
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
    /// Creates an operation on arguments.
    pub fn new(op: Op, args: Vec<Expr>, ty: impl Into<Ty>) -> Expr {
        let ty = ty.into();
        Expr { op, args, ty }
    }

    /// Creates a constant from its bits.
    pub fn constant(ty: impl Into<Ty>, bits: Bits) -> Expr {
        Expr::new(Op::Ir(ir::Op::Const(bits)), Vec::new(), ty)
    }

    /// Creates a constant with the same bits in every component.
    pub fn splat(ty: impl Into<Ty>, bits: u32) -> Expr {
        Expr::constant(ty, [bits; 4])
    }

    /// Creates a vector of two constant integers.
    pub fn ivec2(x: i32, y: i32) -> Expr {
        Expr::constant(Type::value(Scalar::I32, 2), [x as u32, y as u32, 0, 0])
    }

    /// Creates a read of a variable.
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

    /// Converts the value to another type, by truncation or rounding. Every value must fit.
    pub fn convert_to(self, ty: impl Into<Ty>) -> Expr {
        Expr::new(Op::Convert { fits: true }, vec![self], ty)
    }

    /// Converts a float to half precision, and any other value not at all.
    pub fn into_half(mut self) -> Expr {
        if !self.ty.is_float() || self.ty.half {
            return self;
        }
        let ty = Ty { half: true, ..self.ty };
        if self.as_constant().is_some() {
            self.ty = ty;
            return self;
        }
        self.convert_to(ty)
    }

    /// Converts a float to full precision, and any other value not at all.
    pub fn into_full(self) -> Expr {
        match self.ty.half {
            true => {
                let ty = self.ty.to_full_precision();
                self.convert_to(ty)
            }
            false => self,
        }
    }

    /// Reinterprets the bits as another type.
    pub fn bits_as(self, ty: impl Into<Ty>) -> Expr {
        Expr::new(Op::Ir(ir::Op::Bitcast), vec![self], ty)
    }

    /// Creates a call of a built-in function of the language.
    pub fn call(name: &'static str, args: Vec<Expr>, ty: impl Into<Ty>) -> Expr {
        Expr::new(Op::Call(name), args, ty)
    }

    /// Returns the bits of a constant.
    pub fn as_constant(&self) -> Option<&Bits> {
        match &self.op {
            Op::Ir(ir::Op::Const(bits)) => Some(bits),
            _ => None,
        }
    }

    /// Rewrites every subexpression and then the expression, arguments first.
    pub fn rewrite(self, rule: &mut dyn FnMut(Expr) -> Expr) -> Expr {
        let args = self.args.into_iter().map(|arg| arg.rewrite(rule)).collect();
        rule(Expr { args, ..self })
    }

    /// Rewrites the expression in place, as [`Expr::rewrite`].
    pub fn rewrite_in_place(&mut self, rule: &mut dyn FnMut(Expr) -> Expr) {
        let taken = std::mem::replace(self, Expr::new(Op::Construct, Vec::new(), self.ty));
        *self = taken.rewrite(rule);
    }

    /// Visits every subexpression and then the expression, arguments first.
    pub fn visit(&self, see: &mut dyn FnMut(&Expr)) {
        self.args.iter().for_each(|arg| arg.visit(see));
        see(self);
    }

    /// Returns the number of operators and calls in the expression.
    pub fn operation_count(&self) -> usize {
        let mut count = 0;
        self.visit(&mut |expr| {
            let free = matches!(
                expr.op,
                Op::Var(_) | Op::Swizzle(_) | Op::Ir(ir::Op::Const(_) | ir::Op::Uniform(_) | ir::Op::Override(_))
            );
            count += usize::from(!free);
        });
        count
    }
}

/// Source of a statement's value in the kernel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Source<'g> {
    /// The variable that holds the value.
    pub origin: Option<&'g Origin>,
    /// The expression that computes it.
    pub place: Option<&'g Place>,
}

/// A statement with the source of its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Stmt<'g> {
    /// Kind of statement, with its operands.
    pub kind: StmtKind<'g>,
    /// Source of its value.
    pub source: Source<'g>,
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
    /// An assignment to a variable or an element: `place = value`, or `place op= value`.
    Assign(Expr, Option<BinaryOp>, Expr),
    /// A counted loop from a start to an exclusive end.
    For {
        /// The counter.
        counter: VarId,
        /// First value.
        start: Expr,
        /// Exclusive upper bound.
        end: Expr,
        /// Body of the loop.
        body: Block<'g>,
    },
    /// An endless loop, left by a [`StmtKind::Break`].
    Loop(Block<'g>),
    /// Leaves the innermost loop.
    Break,
    /// A branch with two sides.
    If {
        /// A scalar boolean.
        condition: Expr,
        /// Statements if the condition is `true`.
        then: Block<'g>,
        /// Statements if the condition is `false`.
        otherwise: Block<'g>,
    },
    /// Writes a texel of an output: output index, place, value.
    Store(usize, Expr, Expr),
    /// Values of a pixel, one per output.
    Output(Vec<Expr>),
    /// Writes to memory.
    Effect(Effect),
    /// A barrier of the workgroup, after which the writes of the other invocations are visible.
    Barrier {
        /// `true` if the barrier also orders writes to buffers.
        buffers: bool,
    },
    /// Returns from the function, with its value if it has one.
    Return(Option<Expr>),
    /// A comment line.
    Comment(String),
}

/// A write to memory at an index within bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// The memory written.
    pub memory: Memory,
    /// The atomic operation; a plain store has none.
    pub op: Option<AtomicOp>,
    /// Index and value; a load has no value.
    pub args: Vec<Expr>,
    /// Variable that receives the old value.
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
        Stmt {
            kind,
            source: Source::default(),
        }
    }
}

impl<'g> Stmt<'g> {
    /// Rewrites every expression of the statement and of its blocks.
    pub fn rewrite(&mut self, rule: &mut dyn FnMut(Expr) -> Expr) {
        for expr in self.own_mut() {
            expr.rewrite_in_place(rule);
        }
        for block in self.blocks_mut() {
            block.iter_mut().for_each(|stmt| stmt.rewrite(rule));
        }
    }

    /// Returns the expressions of the statement itself, without those of its blocks.
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

    /// Visits every expression of the statement and of its blocks.
    pub fn visit(&self, see: &mut dyn FnMut(&Expr)) {
        self.own_exprs().for_each(|expr| expr.visit(see));
        for block in self.blocks() {
            block.iter().for_each(|stmt| stmt.visit(see));
        }
    }

    /// Returns mutable references to the expressions of [`Stmt::own_exprs`].
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

    /// Returns mutable references to the blocks of [`Stmt::blocks`].
    pub fn blocks_mut(&mut self) -> Vec<&mut Block<'g>> {
        match &mut self.kind {
            StmtKind::For { body, .. } | StmtKind::Loop(body) => vec![body],
            StmtKind::If { then, otherwise, .. } => vec![then, otherwise],
            _ => Vec::new(),
        }
    }

    /// Returns the blocks of the statement.
    pub fn blocks(&self) -> Vec<&Block<'g>> {
        match &self.kind {
            StmtKind::For { body, .. } | StmtKind::Loop(body) => vec![body],
            StmtKind::If { then, otherwise, .. } => vec![then, otherwise],
            _ => Vec::new(),
        }
    }
}

/// Counts the statements of a block and its nested blocks, without comments.
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

/// A shader: the items at module scope other than bindings, and the entry point's body.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Module<'g> {
    /// All variables.
    pub variables: Vec<Variable>,
    /// Constant arrays.
    pub tables: Vec<(VarId, Expr)>,
    /// Functions, sorted by name and result type.
    pub functions: Vec<Function<'g>>,
    /// The entry point's statements.
    pub body: Block<'g>,
}

impl<'g> Module<'g> {
    /// Creates a variable.
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

    /// Returns a variable's type.
    pub fn variable_type(&self, var: VarId) -> Ty {
        self.variables[var.0 as usize].ty
    }

    /// Returns a read of a variable.
    pub fn read_variable(&self, var: VarId) -> Expr {
        Expr::var(var, self.variable_type(var))
    }

    /// Rewrites every expression, arguments first. Items that the rule adds to the module are not rewritten.
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

    /// Adds a function unless it exists; returns its name.
    pub fn add_function(&mut self, name: &str, result: Ty, make: impl FnOnce(&mut Self) -> Function<'g>) -> Op {
        if !self.functions.iter().any(|f| f.name == name && f.result == result) {
            let function = make(self);
            self.functions.push(function);
        }
        Op::Function(name.to_owned())
    }
}
