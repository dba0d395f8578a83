//! Values of every type.

use super::super::ast::*;
use super::ints::side;
use super::{Facts, Generator, Profile};

impl Generator {
    pub fn float_literal(&mut self) -> Expr {
        let x = match self.random.below(8) {
            0 => 0.0,
            1 => 1.0,
            2 => self.random.pick(&[-0.0, 0.5, -0.5, 2.0, -1.0]),
            _ => self.random.between(-24, 24) as f32 / 8.0,
        };
        self.e(Ty::F32, Kind::Float(x))
    }

    /// A variable, or a part of one, of the type `target`.
    pub fn read(&mut self, target: &Ty) -> Option<(Expr, Facts)> {
        let locals = self.visible();
        if locals.is_empty() {
            return None;
        }
        for _ in 0..5 {
            let local = self.random.pick(&locals);
            let whole = Expr {
                ty: local.ty.clone(),
                kind: Kind::Var(local.var),
            };
            if local.ty == *target {
                self.spend(1);
                return Some((whole, local.facts));
            }
            if let Some(found) = self.descend(whole, target) {
                return Some(found);
            }
        }
        None
    }

    fn descend(&mut self, whole: Expr, target: &Ty) -> Option<(Expr, Facts)> {
        let part = match whole.ty.clone() {
            Ty::Vec(n) if *target == Ty::F32 => {
                let lane = self.random.below(n as usize) as u8;
                self.e(Ty::F32, Kind::Lane(Box::new(whole), lane))
            }
            Ty::IVec(n) if *target == Ty::I32 => {
                let lane = self.random.below(n as usize) as u8;
                return Some((self.e(Ty::I32, Kind::Lane(Box::new(whole), lane)), Facts::WIDE));
            }
            Ty::Array(element, len) if !self.poor() => {
                let index = self.index(len, 1);
                self.e(*element, Kind::Index(Box::new(whole), Box::new(index)))
            }
            Ty::Tuple(parts) => {
                let k = self.random.below(parts.len());
                self.e(parts[k].clone(), Kind::Part(Box::new(whole), k as u8))
            }
            Ty::Struct(s) => {
                let fields = self.program.structs[s as usize].clone();
                let k = self.random.below(fields.len());
                self.e(fields[k].clone(), Kind::Part(Box::new(whole), k as u8))
            }
            _ => return None,
        };
        if part.ty == *target {
            let facts = if *target == Ty::I32 { Facts::SMALL } else { Facts::WIDE };
            return Some((part, facts));
        }
        self.descend(part, target)
    }

    /// A call of a helper that gives `ty`.
    pub fn call(&mut self, ty: &Ty, d: u32) -> Option<Expr> {
        let fitting: Vec<usize> = (0..self.signatures.len())
            .filter(|k| self.signatures[*k].result == *ty)
            .filter(|k| self.cost + self.signatures[*k].cost * self.repeats < self.budget)
            .collect();
        if fitting.is_empty() {
            return None;
        }
        let k = self.random.pick(&fitting);
        let signature = self.signatures[k].clone();
        self.spend(signature.cost);
        let args = signature.params.iter();
        let args = args
            .map(|(ty, facts)| self.of(ty, *facts, d.saturating_sub(1).min(1)))
            .collect();
        Some(self.e(ty.clone(), Kind::Call(k as u8, args)))
    }

    /// A value of a type. `facts` bounds integers.
    pub fn of(&mut self, ty: &Ty, facts: Facts, d: u32) -> Expr {
        match ty {
            Ty::I32 => return self.int(facts, d).0,
            Ty::U32 => return self.uint(d),
            Ty::Bool => return self.condition(false, d),
            _ => {}
        }
        if d > 0 && !self.poor() {
            match self.random.below(16) {
                0 => {
                    if let Some(call) = self.call(ty, d) {
                        return call;
                    }
                }
                1 => {
                    let known = self.random.once_in(2);
                    let condition = self.condition(known, d - 1);
                    let then = self.value_block(ty, !known, d - 1);
                    let otherwise = self.value_block(ty, !known, d - 1);
                    let kind = Kind::If(Box::new(condition), Box::new(then), Box::new(otherwise));
                    return self.e(ty.clone(), kind);
                }
                2 if self.random.once_in(2) => {
                    let (subject, range) = self.known_int(d - 1);
                    let arms = self.arms(range, |g| g.of(ty, Facts::WIDE, d - 1));
                    return self.e(ty.clone(), Kind::Match(Box::new(subject), arms));
                }
                3 if self.random.once_in(2) => {
                    let block = self.value_block(ty, false, d - 1);
                    return self.e(ty.clone(), Kind::Block(Box::new(block)));
                }
                _ => {}
            }
        }
        match ty {
            Ty::F32 => self.float(d),
            Ty::Vec(n) => self.vector(*n, d),
            Ty::IVec(n) => self.int_vector(*n, d),
            _ => self.aggregate(ty, d),
        }
    }

    /// Arms of a `match` on an integer within `range`.
    pub fn arms<T>(&mut self, range: (i64, i64), mut body: impl FnMut(&mut Self) -> T) -> Vec<(Vec<i32>, T)> {
        let mut arms = Vec::new();
        for _ in 0..self.random.below(3) {
            let values = (0..self.random.between(1, 2)).map(|_| {
                let high = range.1.clamp(0, 9);
                self.random.between(range.0.clamp(0, high), high) as i32
            });
            arms.push((values.collect(), body(self)));
        }
        arms.push((Vec::new(), body(self)));
        arms
    }

    fn value_block(&mut self, ty: &Ty, run_time: bool, d: u32) -> Block {
        self.depth += u32::from(run_time);
        let count = if self.random.once_in(4) && self.nesting < 3 {
            1
        } else {
            0
        };
        let block = self.block(count, Some((ty, Facts::WIDE, d)));
        self.depth -= u32::from(run_time);
        block
    }

    pub fn float(&mut self, d: u32) -> Expr {
        let ty = Ty::F32;
        if d == 0 || self.poor() {
            if !self.random.once_in(4)
                && let Some((e, _)) = self.read(&ty)
            {
                return e;
            }
            return match self.random.below(6) {
                0 if !self.poor() => {
                    let texel = self.load(0);
                    let lane = self.random.below(4) as u8;
                    self.e(ty, Kind::Lane(Box::new(texel), lane))
                }
                1 => {
                    let n = self.int(Facts::SMALL, 0).0;
                    self.e(ty, Kind::Cast(Box::new(n)))
                }
                2 => match self.program.consts.iter().position(|c| c.ty != Ty::I32) {
                    Some(k) => {
                        let constant = self.program.consts[k].ty.clone();
                        let whole = self.e(constant.clone(), Kind::Const(k as u8));
                        match constant {
                            Ty::Array(_, len) => {
                                let index = self.index(len, 0);
                                self.e(ty, Kind::Index(Box::new(whole), Box::new(index)))
                            }
                            _ => whole,
                        }
                    }
                    None => self.float_literal(),
                },
                _ => self.float_literal(),
            };
        }
        let exact = self.profile == Profile::Exact;
        match self.random.below(14) {
            0..=4 => {
                let (a, b) = (self.of(&ty, Facts::WIDE, d - 1), self.of(&ty, Facts::WIDE, d - 1));
                let op = self.float_operator();
                self.e(ty, Kind::Binary(op, Box::new(a), Box::new(b)))
            }
            5..=6 => {
                let x = self.of(&ty, Facts::WIDE, d - 1);
                self.float_unary(ty, x)
            }
            7 => {
                let args: Vec<Expr> = (0..2).map(|_| self.of(&ty, Facts::WIDE, d - 1)).collect();
                let method = self.random.pick(&[Method::Min, Method::Max]);
                self.e(ty, Kind::Method(method, args))
            }
            8 => self.clamped(&ty, d),
            9 => {
                let n = self.random.between(2, 4) as u8;
                let (a, b) = (
                    self.of(&Ty::Vec(n), Facts::WIDE, d - 1),
                    self.of(&Ty::Vec(n), Facts::WIDE, d - 1),
                );
                let method = self.random.pick(&[Method::Dot, Method::DistanceSquared]);
                self.e(ty, Kind::Method(method, vec![a, b]))
            }
            10 => {
                let n = self.random.between(2, 4) as u8;
                let a = self.of(&Ty::Vec(n), Facts::WIDE, d - 1);
                let methods = [
                    Method::MinElement,
                    Method::MaxElement,
                    Method::ElementSum,
                    Method::LengthSquared,
                    Method::Length,
                ];
                let method = self.random.pick(&methods[..if exact { 5 } else { 4 }]);
                self.e(ty, Kind::Method(method, vec![a]))
            }
            11 => {
                let x = if self.random.once_in(3) {
                    self.uint(d - 1)
                } else {
                    self.int(Facts::SMALL, d - 1).0
                };
                self.e(ty, Kind::Cast(Box::new(x)))
            }
            12 => {
                let x = self.of(&ty, Facts::WIDE, d - 1);
                let power = self.random.between(1, 4) as i32;
                let power = self.e(Ty::I32, Kind::Int(power));
                self.e(ty, Kind::Method(Method::Powi, vec![x, power]))
            }
            _ => self.float(0),
        }
    }

    pub fn float_operator(&mut self) -> Binary {
        let all = [
            Binary::Add,
            Binary::Sub,
            Binary::Mul,
            Binary::Add,
            Binary::Sub,
            Binary::Mul,
            Binary::Div,
            Binary::Rem,
        ];
        let count = if self.profile == Profile::Exact { 8 } else { 6 };
        self.random.pick(&all[..count])
    }

    pub fn float_unary(&mut self, ty: Ty, x: Expr) -> Expr {
        let all = [
            Method::Abs,
            Method::Floor,
            Method::Ceil,
            Method::Trunc,
            Method::RoundTiesEven,
            Method::Sqrt,
            Method::Exp2,
            Method::Recip,
        ];
        let count = if self.profile == Profile::Exact { 8 } else { 5 };
        if self.random.once_in(4) {
            return self.e(ty, Kind::Unary(Unary::Neg, Box::new(x)));
        }
        let method = self.random.pick(&all[..count]);
        self.e(ty, Kind::Method(method, vec![x]))
    }

    pub fn clamped(&mut self, ty: &Ty, d: u32) -> Expr {
        let x = self.of(ty, Facts::WIDE, d - 1);
        let low = self.random.between(-8, 4) as f32 / 4.0;
        let bounds = [low, low + 1.5].map(|bound| {
            let scalar = Expr {
                ty: Ty::F32,
                kind: Kind::Float(bound),
            };
            match ty {
                Ty::F32 => scalar,
                _ => Expr {
                    ty: ty.clone(),
                    kind: Kind::Splat(Box::new(scalar)),
                },
            }
        });
        let [low, high] = bounds;
        self.e(ty.clone(), Kind::Method(Method::Clamp, vec![x, low, high]))
    }

    pub fn load(&mut self, d: u32) -> Expr {
        let pixel = self.e(Ty::IVec(2), Kind::Pixel);
        let coordinate = match self.random.below(5) {
            0 => pixel,
            1 if d > 0 => self.of(&Ty::IVec(2), Facts::WIDE, d - 1),
            _ => {
                let lanes = (0..2).map(|_| self.int(Facts::known(-6, 6), 1).0).collect();
                let offset = self.e(Ty::IVec(2), Kind::Compose(lanes));
                let op = self.random.pick(&[Binary::Add, Binary::Add, Binary::Sub]);
                self.e(Ty::IVec(2), Kind::Binary(op, Box::new(pixel), Box::new(offset)))
            }
        };
        self.e(Ty::Vec(4), Kind::Load(Box::new(coordinate)))
    }

    /// An array, tuple or structure.
    fn aggregate(&mut self, ty: &Ty, d: u32) -> Expr {
        if self.random.once_in(3)
            && let Some((e, _)) = self.read(ty)
        {
            return e;
        }
        let d = d.saturating_sub(1).min(1);
        let parts = match ty {
            Ty::Array(element, _) if self.random.once_in(3) => {
                let x = self.of(element, Facts::SMALL, d);
                return self.e(ty.clone(), Kind::Repeat(Box::new(x)));
            }
            Ty::Array(element, len) => vec![(**element).clone(); *len as usize],
            Ty::Tuple(parts) => parts.clone(),
            Ty::Struct(k) => self.program.structs[*k as usize].clone(),
            _ => Vec::new(),
        };
        let parts = parts.iter().map(|part| self.of(part, Facts::SMALL, d)).collect();
        self.e(ty.clone(), Kind::Many(parts))
    }

    /// An `if` between two values of one type, one side the value of `of`.
    pub fn chosen(&mut self, ty: &Ty, facts: Facts, d: u32) -> Expr {
        let condition = self.condition(false, d);
        self.depth += 1;
        let (a, b) = (self.of(ty, facts, d), self.of(ty, facts, d));
        self.depth -= 1;
        self.e(ty.clone(), Kind::If(Box::new(condition), side(a), side(b)))
    }
}
