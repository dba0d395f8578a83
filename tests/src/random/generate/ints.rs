//! Integers, and what is known of them.

use super::super::ast::*;
use super::{Facts, Generator, LIMIT, Profile};

impl Generator {
    /// An integer that may go into `slot`, and what is known of it.
    pub fn int(&mut self, slot: Facts, d: u32) -> (Expr, Facts) {
        if slot.known {
            let (e, range) = self.known_int(d);
            let (low, high) = slot.range.unwrap_or((-LIMIT, LIMIT));
            let (e, range) = self.squeeze(e, range, low, high);
            return (e, Facts::known(range.0, range.1));
        }
        if slot.range.is_none() {
            return (self.wide(d), Facts::WIDE);
        }
        match self.random.below(4) {
            0..=1 => self.int(Facts::known(-64, 64), d),
            2 => match self.read(&Ty::I32) {
                Some((e, facts)) if facts.fit(Facts::SMALL) => (e, facts),
                _ => self.int(Facts::known(-64, 64), d),
            },
            _ => (self.wide(d), Facts::WIDE),
        }
    }

    fn int_literal(&mut self, low: i64, high: i64) -> Expr {
        let n = self.random.between(low, high) as i32;
        self.e(Ty::I32, Kind::Int(n))
    }

    pub fn int_method(&mut self, method: Method, args: Vec<Expr>) -> Expr {
        self.e(Ty::I32, Kind::Method(method, args))
    }

    fn int_binary(&mut self, op: Binary, a: Expr, b: Expr) -> Expr {
        self.e(Ty::I32, Kind::Binary(op, Box::new(a), Box::new(b)))
    }

    /// A known integer brought into bounds that it may exceed.
    pub fn squeeze(&mut self, e: Expr, range: (i64, i64), low: i64, high: i64) -> (Expr, (i64, i64)) {
        if low <= range.0 && range.1 <= high {
            return (e, range);
        }
        if low <= 0 && high > 0 && range.0 >= 0 && self.random.once_in(2) {
            let modulus = self.e(Ty::I32, Kind::Int(high as i32 + 1));
            return (self.int_binary(Binary::Rem, e, modulus), (0, high.min(range.1)));
        }
        let (a, b) = (
            self.e(Ty::I32, Kind::Int(low as i32)),
            self.e(Ty::I32, Kind::Int(high as i32)),
        );
        if self.random.once_in(2) {
            (self.int_method(Method::Clamp, vec![e, a, b]), (low, high))
        } else {
            let above = self.int_method(Method::Max, vec![e, a]);
            (self.int_method(Method::Min, vec![above, b]), (low, high))
        }
    }

    /// An integer that is known once all loops are unrolled, with its bounds, which are within ±LIMIT.
    pub fn known_int(&mut self, d: u32) -> (Expr, (i64, i64)) {
        if d == 0 || self.poor() || self.random.once_in(3) {
            let known: Vec<_> = self
                .visible()
                .into_iter()
                .filter(|l| l.ty == Ty::I32 && l.facts.known)
                .collect();
            if !known.is_empty() && !self.random.once_in(4) {
                let local = self.random.pick(&known);
                let range = local.facts.range.unwrap_or((0, 0));
                return (self.e(Ty::I32, Kind::Var(local.var)), range);
            }
            if self.random.once_in(6)
                && let Some(k) = self.program.consts.iter().position(|c| c.ty == Ty::I32)
            {
                return (self.e(Ty::I32, Kind::Const(k as u8)), (-5, 5));
            }
            let n = self.random.between(-9, 9);
            return (self.e(Ty::I32, Kind::Int(n as i32)), (n, n));
        }
        let (a, (low, high)) = self.known_int(d - 1);
        let (e, range) = match self.random.below(15) {
            0..=4 => {
                let (b, (l, h)) = self.known_int(d - 1);
                let op = self.random.pick(&[Binary::Add, Binary::Sub, Binary::Mul]);
                let corners = match op {
                    Binary::Add => [low + l, high + h, low + l, high + h],
                    Binary::Sub => [low - h, high - l, low - h, high - l],
                    _ => [low * l, low * h, high * l, high * h],
                };
                (self.int_binary(op, a, b), bounds(&corners))
            }
            5 => {
                let by = self.random.pick(&[1, 2, 3, 5, -1, -2]);
                let divisor = self.e(Ty::I32, Kind::Int(by as i32));
                (
                    self.int_binary(Binary::Div, a, divisor),
                    bounds(&[low / by, high / by, 0]),
                )
            }
            6 => {
                let by = self.random.between(1, 9);
                let divisor = self.e(Ty::I32, Kind::Int(by as i32));
                let range = (if low < 0 { 1 - by } else { 0 }, if high > 0 { by - 1 } else { 0 });
                (self.int_binary(Binary::Rem, a, divisor), range)
            }
            7 => {
                let mask = self.random.between(0, 15);
                let bits = self.e(Ty::I32, Kind::Int(mask as i32));
                (self.int_binary(Binary::And, a, bits), (0, mask))
            }
            8 => {
                let op = self.random.pick(&[Binary::Or, Binary::Xor]);
                let bits = self.int_literal(0, 15);
                (self.int_binary(op, a, bits), (low.min(0) - 16, high.max(0) + 16))
            }
            9 => {
                let count = self.random.between(0, 3);
                let by = self.e(Ty::I32, Kind::Int(count as i32));
                if self.random.once_in(2) {
                    (self.int_binary(Binary::Shr, a, by), (low >> count, high >> count))
                } else {
                    (self.int_binary(Binary::Shl, a, by), (low << count, high << count))
                }
            }
            10 => {
                let (b, (l, h)) = self.known_int(d - 1);
                if self.random.once_in(2) {
                    (self.int_method(Method::Min, vec![a, b]), (low.min(l), high.min(h)))
                } else {
                    (self.int_method(Method::Max, vec![a, b]), (low.max(l), high.max(h)))
                }
            }
            11 => {
                let high = high.abs().max(low.abs());
                (self.int_method(Method::Abs, vec![a]), (0, high))
            }
            12 if self.random.once_in(2) => (
                self.e(Ty::I32, Kind::Unary(Unary::Not, Box::new(a))),
                (-high - 1, -low - 1),
            ),
            12 => (self.e(Ty::I32, Kind::Unary(Unary::Neg, Box::new(a))), (-high, -low)),
            13 => {
                let (b, (l, h)) = self.known_int(d - 1);
                let condition = self.condition(true, d - 1);
                let kind = Kind::If(Box::new(condition), side(a), side(b));
                (self.e(Ty::I32, kind), (low.min(l), high.max(h)))
            }
            _ => {
                let condition = self.condition(true, d - 1);
                (self.e(Ty::I32, Kind::Cast(Box::new(condition))), (0, 1))
            }
        };
        self.squeeze(e, range, -LIMIT, LIMIT)
    }

    /// An integer that the generator never holds as a known integer, so that it wraps.
    pub fn wide(&mut self, d: u32) -> Expr {
        if d == 0 || self.poor() {
            return match self.read(&Ty::I32) {
                Some((e, Facts::WIDE)) => e,
                _ if self.random.once_in(3) => {
                    let number = self.extreme();
                    let number = self.e(Ty::U32, Kind::Uint(number));
                    self.e(Ty::I32, Kind::Cast(Box::new(number)))
                }
                _ => {
                    let pixel = self.e(Ty::IVec(2), Kind::Pixel);
                    let lane = self.random.below(2) as u8;
                    self.e(Ty::I32, Kind::Lane(Box::new(pixel), lane))
                }
            };
        }
        match self.random.below(12) {
            0 => self.rounded(Ty::I32, d),
            1..=4 => {
                let a = self.wide(d - 1);
                let b = if self.random.once_in(2) {
                    self.wide(d - 1)
                } else {
                    self.int(Facts::SMALL, d - 1).0
                };
                let op = self.random.pick(&[
                    Binary::Add,
                    Binary::Sub,
                    Binary::Mul,
                    Binary::Div,
                    Binary::Rem,
                    Binary::And,
                    Binary::Or,
                    Binary::Xor,
                ]);
                let swap = self.random.once_in(2);
                let (a, b) = if swap { (b, a) } else { (a, b) };
                self.int_binary(op, a, b)
            }
            5 => {
                let a = self.wide(d - 1);
                let op = self.random.pick(&[Binary::Shl, Binary::Shr]);
                let count = if self.random.once_in(2) {
                    self.int_literal(0, 31)
                } else {
                    let n = self.random.below(32) as u32;
                    self.e(Ty::U32, Kind::Uint(n))
                };
                self.int_binary(op, a, count)
            }
            6 => {
                let a = self.wide(d - 1);
                let op = self.random.pick(&[Unary::Neg, Unary::Not]);
                self.e(Ty::I32, Kind::Unary(op, Box::new(a)))
            }
            7 => {
                let a = self.wide(d - 1);
                self.int_method(Method::Abs, vec![a])
            }
            8 => {
                let (a, b) = (self.wide(d - 1), self.int(Facts::SMALL, d - 1).0);
                let method = self.random.pick(&[Method::Min, Method::Max]);
                self.int_method(method, vec![a, b])
            }
            9 => {
                let x = self.uint(d - 1);
                self.e(Ty::I32, Kind::Cast(Box::new(x)))
            }
            10 => {
                let condition = self.condition(false, d - 1);
                self.depth += 1;
                let (a, b) = (self.wide(d - 1), self.wide(d - 1));
                self.depth -= 1;
                self.e(Ty::I32, Kind::If(Box::new(condition), side(a), side(b)))
            }
            _ => match self.call(&Ty::I32, d) {
                Some(call) => call,
                None => self.wide(d - 1),
            },
        }
    }

    /// A literal that is small, or near a border.
    fn extreme(&mut self) -> u32 {
        match self.random.below(4) {
            0 => self.random.pick(&[0, 1, i32::MAX as u32, i32::MIN as u32, u32::MAX]),
            1 => self.random.bits() as u32,
            _ => self.random.below(12) as u32,
        }
    }

    /// A float as an integer. A GPU's conversion of what does not fit is its own.
    fn rounded(&mut self, ty: Ty, d: u32) -> Expr {
        let mut x = self.of(&Ty::F32, Facts::WIDE, d - 1);
        if self.profile == Profile::Gpu {
            let low = if ty == Ty::I32 { -90.0 } else { 0.0 };
            let bounds = [low, 90.0].map(|bound| Expr {
                ty: Ty::F32,
                kind: Kind::Float(bound),
            });
            let [low, high] = bounds;
            x = self.e(Ty::F32, Kind::Method(Method::Clamp, vec![x, low, high]));
        }
        self.e(ty, Kind::Cast(Box::new(x)))
    }

    pub fn uint(&mut self, d: u32) -> Expr {
        if d == 0 || self.poor() {
            return match self.read(&Ty::U32) {
                Some((e, _)) => e,
                None if self.random.once_in(4) => {
                    let size = self.e(Ty::UVec2, Kind::Size);
                    self.e(Ty::U32, Kind::Lane(Box::new(size), 0))
                }
                None => {
                    let n = self.extreme();
                    self.e(Ty::U32, Kind::Uint(n))
                }
            };
        }
        match self.random.below(8) {
            0 => self.rounded(Ty::U32, d),
            1 => {
                let x = self.int(Facts::SMALL, d - 1).0;
                self.e(Ty::U32, Kind::Cast(Box::new(x)))
            }
            2..=4 => {
                let (a, b) = (self.uint(d - 1), self.uint(d - 1));
                let op = self.random.pick(&[
                    Binary::Add,
                    Binary::Sub,
                    Binary::Mul,
                    Binary::Div,
                    Binary::Rem,
                    Binary::And,
                    Binary::Or,
                    Binary::Xor,
                ]);
                self.e(Ty::U32, Kind::Binary(op, Box::new(a), Box::new(b)))
            }
            5 => {
                let a = self.uint(d - 1);
                let op = self.random.pick(&[Binary::Shl, Binary::Shr]);
                let count = self.int_literal(0, 31);
                self.e(Ty::U32, Kind::Binary(op, Box::new(a), Box::new(count)))
            }
            6 => {
                let (a, b) = (self.uint(d - 1), self.uint(d - 1));
                let method = self.random.pick(&[Method::Min, Method::Max]);
                self.e(Ty::U32, Kind::Method(method, vec![a, b]))
            }
            _ => {
                let a = self.uint(d - 1);
                self.e(Ty::U32, Kind::Unary(Unary::Not, Box::new(a)))
            }
        }
    }
}

/// A block of a value alone.
pub fn side(value: Expr) -> Box<Block> {
    Box::new(Block {
        statements: Vec::new(),
        value: Some(value),
    })
}

fn bounds(of: &[i64]) -> (i64, i64) {
    (
        of.iter().copied().min().unwrap_or(0),
        of.iter().copied().max().unwrap_or(0),
    )
}
