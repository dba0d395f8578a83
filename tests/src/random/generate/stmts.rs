//! Statements.

use super::super::ast::*;
use super::{Facts, Generator};

/// How often a place may run at most.
const REPEATS: u32 = 64;

impl Generator {
    /// A block of some statements, and a value if one is asked for.
    pub fn block(&mut self, count: usize, value: Option<(&Ty, Facts, u32)>) -> Block {
        let mark = self.locals.len();
        self.nesting += 1;
        let mut block = Block::default();
        for _ in 0..count {
            self.statement(&mut block.statements);
        }
        if let Some((ty, facts, d)) = value {
            block.value = Some(self.of(ty, facts, d));
        }
        self.nesting -= 1;
        self.locals.truncate(mark);
        block
    }

    fn inner(&mut self) -> Block {
        let count = 1 + self.random.below(3);
        self.block(count, None)
    }

    /// One more statement, or none if there is nothing to spend.
    pub fn statement(&mut self, out: &mut Vec<Stmt>) {
        if self.poor() {
            return;
        }
        let deep = self.nesting >= 4;
        match self.random.below(24) {
            0..=3 => self.let_(out, false),
            4..=8 => self.let_(out, true),
            9 => self.let_tuple(out),
            10..=14 => self.assign(out),
            _ if deep => self.assign(out),
            15..=16 => self.if_(out),
            17..=19 => self.for_(out),
            20 => self.for_array(out),
            21 => self.while_(out),
            22 => self.leave(out),
            _ if self.random.once_in(2) => {
                let block = self.inner();
                out.push(Stmt::Block(block));
            }
            _ => {
                let (subject, range) = self.known_int(1);
                let arms = self.arms(range, |g| g.inner());
                out.push(Stmt::Match(subject, arms));
            }
        }
    }

    fn let_(&mut self, out: &mut Vec<Stmt>, mutable: bool) {
        let ty = self.any_type();
        let slot = match ty {
            Ty::I32 => {
                let known = Facts::known(-16, 16);
                self.random.pick(&[known, known, Facts::SMALL, Facts::WIDE])
            }
            _ => Facts::WIDE,
        };
        let (init, facts) = match ty {
            Ty::I32 => self.int(slot, 2),
            _ if self.random.once_in(12) => (self.chosen(&ty, slot, 1), slot),
            _ => (self.of(&ty, slot, 3), slot),
        };
        let var = self.var();
        self.bind(var, ty, mutable, if mutable { slot } else { facts });
        out.push(Stmt::Let {
            var,
            mutable,
            typed: self.random.once_in(2),
            init,
        });
    }

    fn let_tuple(&mut self, out: &mut Vec<Stmt>) {
        let types: Vec<Ty> = (0..2).map(|_| self.part_type()).collect();
        let ty = Ty::Tuple(types.clone());
        let init = self.of(&ty, Facts::WIDE, 2);
        let mut vars: Vec<Var> = Vec::new();
        for ty in types {
            let mut var = self.var();
            while vars.iter().any(|v| v.name == var.name) {
                var = self.var();
            }
            vars.push(var);
            let facts = if ty == Ty::I32 { Facts::SMALL } else { Facts::WIDE };
            self.bind(var, ty, false, facts);
        }
        out.push(Stmt::LetTuple(vars, init));
    }

    fn assign(&mut self, out: &mut Vec<Stmt>) {
        let depth = self.depth;
        let places: Vec<_> = self
            .visible()
            .into_iter()
            .filter(|l| l.mutable && (!l.facts.known || l.depth == depth))
            .collect();
        if places.is_empty() {
            return self.let_(out, true);
        }
        let local = self.random.pick(&places);
        let mut path = Vec::new();
        let mut ty = local.ty.clone();
        let mut facts = local.facts;
        loop {
            let stop = self.random.once_in(4);
            let (step, part) = match &ty {
                Ty::Vec(n) if !stop => (Step::Lane(self.random.below(*n as usize) as u8), Ty::F32),
                Ty::IVec(n) if !stop => {
                    facts = Facts::WIDE;
                    (Step::Lane(self.random.below(*n as usize) as u8), Ty::I32)
                }
                Ty::Array(element, len) if !stop => {
                    let (element, len) = ((**element).clone(), *len);
                    facts = Facts::SMALL;
                    (Step::Index(self.index(len, 2)), element)
                }
                Ty::Tuple(parts) if !stop => {
                    let k = self.random.below(parts.len());
                    facts = Facts::SMALL;
                    (Step::Part(k as u8), parts[k].clone())
                }
                Ty::Struct(s) if !stop => {
                    let fields = &self.program.structs[*s as usize];
                    let k = self.random.below(fields.len());
                    facts = Facts::SMALL;
                    (Step::Field(k as u8), fields[k].clone())
                }
                _ => break,
            };
            path.push(step);
            ty = part;
        }
        let place = Place { var: local.var, path };
        let (op, value) = self.assigned(&ty, facts);
        self.spend(1);
        out.push(Stmt::Assign(place, op, value));
    }

    /// What a place of a type is assigned, and with which operator.
    fn assigned(&mut self, ty: &Ty, facts: Facts) -> (Option<Binary>, Expr) {
        let compound = self.random.once_in(2);
        match ty {
            Ty::F32 | Ty::Vec(_) if compound => {
                let op = self.random.pick(&[Binary::Add, Binary::Sub, Binary::Mul, Binary::Add]);
                let scalar = self.random.once_in(4);
                let value = self.of(if scalar { &Ty::F32 } else { ty }, Facts::WIDE, 2);
                (Some(op), value)
            }
            Ty::U32 if compound => {
                let ops = [
                    Binary::Add,
                    Binary::Sub,
                    Binary::Mul,
                    Binary::Xor,
                    Binary::Or,
                    Binary::And,
                ];
                (Some(self.random.pick(&ops)), self.uint(2))
            }
            Ty::I32 if compound && facts == Facts::WIDE => {
                let ops = [
                    Binary::Add,
                    Binary::Sub,
                    Binary::Mul,
                    Binary::Xor,
                    Binary::Div,
                    Binary::Rem,
                ];
                (Some(self.random.pick(&ops)), self.int(Facts::SMALL, 2).0)
            }
            // The rest of a small known number is one.
            Ty::I32 if compound && facts.known => {
                let by = self.random.between(2, 9) as i32;
                (Some(Binary::Rem), self.e(Ty::I32, Kind::Int(by)))
            }
            _ => (None, self.of(ty, facts, 2)),
        }
    }

    fn if_(&mut self, out: &mut Vec<Stmt>) {
        let known = self.random.once_in(3);
        let condition = self.condition(known, 2);
        self.depth += u32::from(!known);
        let then = self.inner();
        let otherwise = match self.random.below(3) {
            0 => Block::default(),
            1 => self.inner(),
            _ => {
                let mut chained = Block::default();
                self.nesting += 1;
                if self.nesting < 4 && !self.poor() {
                    self.if_(&mut chained.statements);
                }
                self.nesting -= 1;
                chained
            }
        };
        self.depth -= u32::from(!known);
        out.push(Stmt::If(condition, then, otherwise));
    }

    fn for_(&mut self, out: &mut Vec<Stmt>) {
        let run_time = self.random.once_in(5);
        let step = if self.random.once_in(3) {
            self.random.between(2, 3) as u8
        } else {
            1
        };
        let reversed = self.random.once_in(3);
        let inclusive = self.random.once_in(3);
        let (start, (low, top)) = if self.random.once_in(2) {
            (self.e(Ty::I32, Kind::Int(0)), (0, 0))
        } else {
            let (e, range) = self.known_int(1);
            self.squeeze(e, range, -3, 3)
        };
        let span = self.random.between(1, 5);
        let (end, last) = if run_time {
            let n = self.wide(1);
            let ends = [low - 1, low + span].map(|n| Expr {
                ty: Ty::I32,
                kind: Kind::Int(n as i32),
            });
            let [a, b] = ends;
            (self.int_method(Method::Clamp, vec![n, a, b]), low + span)
        } else if self.random.once_in(2) {
            let n = top + span;
            (self.e(Ty::I32, Kind::Int(n as i32)), n)
        } else {
            let (e, range) = self.known_int(1);
            let (e, range) = self.squeeze(e, range, low - 1, low + span);
            (e, range.1)
        };
        let last = if inclusive { last } else { last - 1 };
        let trips = ((last - low) / i64::from(step) + 1).max(1) as u32;
        if self.repeats * trips > REPEATS {
            return self.assign(out);
        }
        let var = self.var();
        let range = (low.min(last), low.max(last));
        let facts = Facts {
            known: !run_time,
            range: Some(range),
        };
        let body = self.looped(trips, run_time, &[(var, Ty::I32, facts)]);
        let range = Range {
            start,
            end,
            inclusive,
            step,
            reversed,
        };
        out.push(Stmt::For(var, range, body));
    }

    /// The body of a loop.
    fn looped(&mut self, trips: u32, run_time: bool, vars: &[(Var, Ty, Facts)]) -> Block {
        let mark = self.locals.len();
        self.depth += u32::from(run_time);
        self.repeats *= trips;
        // A loop whose bounds are only known at run time cannot be left early.
        self.loops.push(if run_time { u32::MAX } else { self.depth });
        for (var, ty, facts) in vars {
            self.bind(*var, ty.clone(), false, *facts);
        }
        let body = self.inner();
        self.loops.pop();
        self.repeats /= trips;
        self.depth -= u32::from(run_time);
        self.locals.truncate(mark);
        body
    }

    fn for_array(&mut self, out: &mut Vec<Stmt>) {
        let element = self.random.pick(&[Ty::F32, Ty::F32, Ty::Vec(4), Ty::I32]);
        let len = self.random.between(1, 5) as u8;
        if self.repeats * u32::from(len) > REPEATS {
            return self.assign(out);
        }
        let arrays: Vec<_> = self
            .visible()
            .into_iter()
            .filter(|l| matches!(l.ty, Ty::Array(_, n) if self.repeats * u32::from(n) <= REPEATS))
            .collect();
        let (array, element, len) = if !arrays.is_empty() && self.random.once_in(2) {
            let local = self.random.pick(&arrays);
            let Ty::Array(element, len) = local.ty.clone() else {
                return;
            };
            (self.e(local.ty, Kind::Var(local.var)), *element, len)
        } else {
            let ty = Ty::Array(Box::new(element.clone()), len);
            (self.of(&ty, Facts::WIDE, 1), element, len)
        };
        let var = self.var();
        let facts = if element == Ty::I32 { Facts::SMALL } else { Facts::WIDE };
        let body = self.looped(u32::from(len), false, &[(var, element, facts)]);
        let by_reference = self.random.once_in(2);
        out.push(Stmt::ForArray(var, array, by_reference, body));
    }

    /// `let mut n = ...; while n > 0 { n -= 1; ... }`, or to the like.
    fn while_(&mut self, out: &mut Vec<Stmt>) {
        let first = self.random.between(1, 4);
        if self.repeats * first as u32 > REPEATS {
            return self.assign(out);
        }
        let var = self.var();
        let init = self.e(Ty::I32, Kind::Int(first as i32));
        out.push(Stmt::Let {
            var,
            mutable: true,
            typed: false,
            init,
        });
        let facts = Facts::known(0, first);
        self.bind(var, Ty::I32, false, facts);
        let number = |g: &mut Generator, n: i32| g.e(Ty::I32, Kind::Int(n));
        let n = self.e(Ty::I32, Kind::Var(var));
        let zero = number(self, 0);
        let mut condition = self.e(Ty::Bool, Kind::Binary(Binary::Gt, Box::new(n), Box::new(zero)));
        if self.random.once_in(3) {
            let more = self.condition(true, 1);
            condition = self.e(
                Ty::Bool,
                Kind::Binary(Binary::LazyAnd, Box::new(condition), Box::new(more)),
            );
        }
        let (op, by) = if self.random.once_in(3) {
            (Binary::Div, 2)
        } else {
            (Binary::Sub, 1)
        };
        let by = number(self, by);
        let less = Stmt::Assign(Place { var, path: Vec::new() }, Some(op), by);
        let mut body = self.looped(first as u32, false, &[]);
        body.statements.insert(0, less);
        out.push(Stmt::While(condition, body));
    }

    /// `break`, `continue` or `return` under a known condition.
    fn leave(&mut self, out: &mut Vec<Stmt>) {
        let in_loop = self.loops.last() == Some(&self.depth);
        let around = in_loop && !self.random.once_in(4);
        if !around && self.depth > 0 {
            return self.assign(out);
        }
        let condition = self.condition(true, 1);
        let mark = self.locals.len();
        let mut then = Block::default();
        if self.random.once_in(3) {
            self.nesting += 1;
            self.statement(&mut then.statements);
            self.nesting -= 1;
        }
        let statement = if around {
            self.random.pick(&[Stmt::Break, Stmt::Continue])
        } else {
            let Some((ty, facts)) = self.result.clone() else { return };
            Stmt::Return(self.of(&ty, facts, 2))
        };
        self.locals.truncate(mark);
        then.statements.push(statement);
        out.push(Stmt::If(condition, then, Block::default()));
    }
}
