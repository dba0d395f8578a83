//! Making random kernels that the generator must accept.
//!
//! Every kernel is well typed and within the language's limits: what must be known is known with every loop
//! unrolled, known integers stay small, known indices in range, and the unrolled size is bounded.

mod conditions;
mod exprs;
mod ints;
mod stmts;
mod vectors;

use super::Random;
use super::ast::*;

/// What kernels may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// Everything: for comparison bit for bit on the CPU.
    Exact,
    /// Nothing that a GPU may compute coarsely: no division, root or power of floats.
    Gpu,
}

/// Bound on what a kernel computes with all loops unrolled, in nodes of the tree.
const BUDGET: u32 = 2000;

/// Known integers are kept within ±LIMIT.
const LIMIT: i64 = 1000;

/// The kernel of a seed.
pub fn generate(seed: u64, profile: Profile) -> Program {
    let mut g = Generator {
        random: Random(seed),
        profile,
        program: Program {
            structs: Vec::new(),
            consts: Vec::new(),
            functions: Vec::new(),
            body: Block::default(),
        },
        signatures: Vec::new(),
        locals: Vec::new(),
        next: 0,
        depth: 0,
        nesting: 0,
        repeats: 1,
        cost: 0,
        budget: 0,
        loops: Vec::new(),
        result: None,
    };
    g.declarations();
    for _ in 0..g.random.below(4) {
        if g.random.once_in(4) { g.recursive() } else { g.helper() }
    }
    g.kernel();
    g.program
}

/// What is known of an integer or a condition while it is generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Facts {
    /// Whether its value is known once all loops are unrolled; then it is within `range`.
    pub known: bool,
    /// Bounds of its value if the generator may hold it as a known integer; `None` if it never does, so that it
    /// wraps.
    pub range: Option<(i64, i64)>,
}

impl Facts {
    /// Never held as a known integer.
    pub const WIDE: Facts = Facts {
        known: false,
        range: None,
    };
    /// What parts of arrays, tuples and structures may hold.
    pub const SMALL: Facts = Facts {
        known: false,
        range: Some((-64, 64)),
    };

    /// Known, within bounds.
    pub fn known(low: i64, high: i64) -> Facts {
        Facts {
            known: true,
            range: Some((low, high)),
        }
    }

    /// Whether a value of these facts may go where `slot` is asked for.
    fn fit(self, slot: Facts) -> bool {
        let within = match (self.range, slot.range) {
            (None, None) => true,
            (None, Some(_)) => !slot.known,
            (Some(_), None) => false,
            (Some((a, b)), Some((low, high))) => low <= a && b <= high,
        };
        within && (self.known || !slot.known)
    }
}

/// A variable in reach.
#[derive(Clone, Debug)]
struct Local {
    var: Var,
    ty: Ty,
    mutable: bool,
    facts: Facts,
    /// How many run-time conditions were around it.
    depth: u32,
}

/// A helper as its callers see it.
#[derive(Clone, Debug)]
struct Signature {
    params: Vec<(Ty, Facts)>,
    result: Ty,
    cost: u32,
}

struct Generator {
    random: Random,
    profile: Profile,
    program: Program,
    signatures: Vec<Signature>,
    locals: Vec<Local>,
    next: u32,
    /// Run-time conditions around.
    depth: u32,
    /// Blocks around.
    nesting: u32,
    /// How often the current place runs at most.
    repeats: u32,
    cost: u32,
    budget: u32,
    /// For each loop around, the run-time conditions around it; above that it cannot be left.
    loops: Vec<u32>,
    /// What the helper returns that is being made.
    result: Option<(Ty, Facts)>,
}

impl Generator {
    fn spend(&mut self, n: u32) {
        self.cost = self.cost.saturating_add(n.saturating_mul(self.repeats));
    }

    fn poor(&self) -> bool {
        self.cost >= self.budget
    }

    fn e(&mut self, ty: Ty, kind: Kind) -> Expr {
        self.spend(1);
        Expr { ty, kind }
    }

    /// A new variable; few names make for much shadowing.
    fn var(&mut self) -> Var {
        self.next += 1;
        Var {
            id: self.next,
            name: self.random.below(9) as u8,
        }
    }

    fn bind(&mut self, var: Var, ty: Ty, mutable: bool, facts: Facts) {
        let depth = self.depth;
        self.locals.push(Local {
            var,
            ty,
            mutable,
            facts,
            depth,
        });
    }

    /// Variables that their names still reach.
    fn visible(&self) -> Vec<Local> {
        let mut seen: Vec<u8> = Vec::new();
        let mut found = Vec::new();
        for local in self.locals.iter().rev() {
            if !seen.contains(&local.var.name) {
                seen.push(local.var.name);
                found.push(local.clone());
            }
        }
        found
    }

    /// Any type that a variable may have.
    fn any_type(&mut self) -> Ty {
        match self.random.below(24) {
            0..=5 => Ty::F32,
            6..=8 => Ty::Vec(4),
            9..=10 => Ty::Vec(self.random.between(2, 3) as u8),
            11..=12 => Ty::I32,
            13 => Ty::U32,
            14 => Ty::Bool,
            15 => Ty::IVec(2),
            16..=18 => Ty::Array(Box::new(Ty::F32), self.random.between(1, 5) as u8),
            19 => Ty::Array(Box::new(Ty::Vec(4)), self.random.between(2, 4) as u8),
            20 => Ty::Array(Box::new(Ty::I32), self.random.between(2, 4) as u8),
            21 => {
                let parts = self.random.between(2, 3);
                Ty::Tuple((0..parts).map(|_| self.part_type()).collect())
            }
            _ if self.program.structs.is_empty() => Ty::F32,
            _ => Ty::Struct(self.random.below(self.program.structs.len()) as u8),
        }
    }

    fn part_type(&mut self) -> Ty {
        match self.random.below(9) {
            0..=2 => Ty::F32,
            3 => Ty::Vec(4),
            4 => Ty::Vec(3),
            5 => Ty::I32,
            6 => Ty::U32,
            7 => Ty::Array(Box::new(Ty::F32), self.random.between(2, 3) as u8),
            _ => Ty::Bool,
        }
    }

    fn declarations(&mut self) {
        for _ in 0..self.random.below(3) {
            let mut fields: Vec<Ty> = (0..self.random.between(1, 3)).map(|_| self.part_type()).collect();
            if !self.program.structs.is_empty() && self.random.once_in(2) {
                fields.push(Ty::Struct(0));
            }
            self.program.structs.push(fields);
        }
        for _ in 0..self.random.below(3) {
            let value = match self.random.below(3) {
                0 => self.float_literal(),
                1 => {
                    let len = self.random.between(2, 4);
                    let elements = (0..len).map(|_| self.float_literal()).collect();
                    self.e(Ty::Array(Box::new(Ty::F32), len as u8), Kind::Many(elements))
                }
                _ => {
                    let n = self.random.between(-5, 5) as i32;
                    self.e(Ty::I32, Kind::Int(n))
                }
            };
            self.program.consts.push(value);
        }
    }

    fn params(&mut self) -> Vec<(Ty, Facts)> {
        let count = self.random.below(4);
        let each = (0..count).map(|_| {
            let ty = self.any_type();
            let facts = match ty {
                Ty::I32 if self.random.once_in(2) => Facts::WIDE,
                Ty::I32 => Facts::known(-4, 8),
                _ => Facts::WIDE,
            };
            (ty, facts)
        });
        each.collect()
    }

    /// Starts a function: its parameters bound, nothing else in reach.
    fn begin(&mut self, params: &[(Ty, Facts)], budget: u32) -> Vec<(Var, Ty)> {
        self.locals.clear();
        self.cost = 0;
        self.budget = budget;
        let mut bound = Vec::new();
        for (k, (ty, facts)) in params.iter().enumerate() {
            let mut var = self.var();
            // Parameters have names of their own.
            var.name = 10 + k as u8;
            self.bind(var, ty.clone(), false, *facts);
            bound.push((var, ty.clone()));
        }
        bound
    }

    fn helper(&mut self) {
        let params = self.params();
        let result = match self.random.below(10) {
            0..=3 => Ty::F32,
            4..=5 => Ty::Vec(4),
            6 => Ty::Vec(3),
            7 => Ty::I32,
            8 => Ty::Array(Box::new(Ty::F32), 3),
            _ => Ty::Tuple(vec![Ty::F32, Ty::Vec(4)]),
        };
        let bound = self.begin(&params, BUDGET / 10);
        self.result = Some((result.clone(), Facts::WIDE));
        let count = self.random.below(4);
        let body = self.block(count, Some((&result, Facts::WIDE, 2)));
        self.close(bound, params, result, body, 1);
    }

    /// `fn f(n, ...) { if n <= 0 { return ...; } ... f(n - 1, ...) ... }`.
    fn recursive(&mut self) {
        let mut params = self.params();
        params.insert(0, (Ty::I32, Facts::known(0, 3)));
        let result = if self.random.once_in(2) { Ty::F32 } else { Ty::Vec(4) };
        let mut bound = self.begin(&params, BUDGET / 40);
        let n = Var {
            id: bound[0].0.id,
            name: N,
        };
        bound[0].0 = n;
        self.locals[0].var = n;
        self.result = Some((result.clone(), Facts::WIDE));
        let read = |g: &mut Generator| g.e(Ty::I32, Kind::Var(n));
        let (left, zero) = (read(self), self.e(Ty::I32, Kind::Int(0)));
        let ends = self.e(Ty::Bool, Kind::Binary(Binary::Le, Box::new(left), Box::new(zero)));
        let value = self.of(&result, Facts::WIDE, 1);
        let ending = Block {
            statements: vec![Stmt::Return(value)],
            value: None,
        };
        let mut body = Block {
            statements: vec![Stmt::If(ends, ending, Block::default())],
            value: None,
        };
        for _ in 0..self.random.below(3) {
            self.statement(&mut body.statements);
        }
        let (left, one) = (read(self), self.e(Ty::I32, Kind::Int(1)));
        let less = self.e(Ty::I32, Kind::Binary(Binary::Sub, Box::new(left), Box::new(one)));
        let mut args = vec![less];
        for (ty, facts) in &params[1..] {
            args.push(self.of(ty, *facts, 1));
        }
        let this = self.program.functions.len() as u8;
        let call = self.e(result.clone(), Kind::Call(this, args));
        let rest = self.of(&result, Facts::WIDE, 1);
        let op = self.random.pick(&[Binary::Add, Binary::Sub]);
        body.value = Some(self.e(result.clone(), Kind::Binary(op, Box::new(call), Box::new(rest))));
        self.close(bound, params, result, body, 4);
    }

    fn close(&mut self, bound: Vec<(Var, Ty)>, params: Vec<(Ty, Facts)>, result: Ty, body: Block, times: u32) {
        self.signatures.push(Signature {
            params,
            result: result.clone(),
            cost: self.cost * times,
        });
        self.program.functions.push(Function {
            params: bound,
            result,
            body,
        });
    }

    fn kernel(&mut self) {
        self.begin(&[], BUDGET);
        self.result = Some((Ty::Vec(4), Facts::WIDE));
        let count = 3 + self.random.below(8);
        let mut body = Block::default();
        for _ in 0..count {
            self.statement(&mut body.statements);
        }
        // What the variables hold at the end is part of the colour.
        self.budget += 200;
        let lanes = (0..4).map(|_| {
            let (a, b) = (self.seen(), self.seen());
            self.e(Ty::F32, Kind::Binary(Binary::Add, Box::new(a), Box::new(b)))
        });
        let lanes = lanes.collect();
        let state = self.e(Ty::Vec(4), Kind::Compose(lanes));
        let rest = self.of(&Ty::Vec(4), Facts::WIDE, 2);
        body.value = Some(self.e(Ty::Vec(4), Kind::Binary(Binary::Add, Box::new(state), Box::new(rest))));
        self.program.body = body;
    }

    /// A float that shows the value of some variable.
    fn seen(&mut self) -> Expr {
        for _ in 0..4 {
            let ty = self
                .random
                .pick(&[Ty::F32, Ty::F32, Ty::F32, Ty::I32, Ty::U32, Ty::Bool]);
            let Some((value, _)) = self.read(&ty) else { continue };
            return match ty {
                Ty::F32 => value,
                Ty::Bool => {
                    let number = self.e(Ty::I32, Kind::Cast(Box::new(value)));
                    self.e(Ty::F32, Kind::Cast(Box::new(number)))
                }
                _ => self.e(Ty::F32, Kind::Cast(Box::new(value))),
            };
        }
        self.float_literal()
    }
}
