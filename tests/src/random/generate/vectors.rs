//! Vectors of floats and of integers.

use super::super::ast::*;
use super::{Facts, Generator, Profile};

impl Generator {
    pub fn vector(&mut self, n: u8, d: u32) -> Expr {
        let ty = Ty::Vec(n);
        if d == 0 || self.poor() {
            if !self.random.once_in(3)
                && let Some((e, _)) = self.read(&ty)
            {
                return e;
            }
            if n == 4 && !self.poor() && !self.random.once_in(3) {
                return self.load(0);
            }
            if self.random.once_in(2) {
                let x = self.float(0);
                return self.e(ty, Kind::Splat(Box::new(x)));
            }
            let lanes = (0..n).map(|_| self.float(0)).collect();
            return self.e(ty, Kind::Compose(lanes));
        }
        match self.random.below(14) {
            0..=3 => {
                let (a, b) = (self.of(&ty, Facts::WIDE, d - 1), self.of(&ty, Facts::WIDE, d - 1));
                let op = self.float_operator();
                self.e(ty, Kind::Binary(op, Box::new(a), Box::new(b)))
            }
            4..=5 => {
                let (a, x) = (self.of(&ty, Facts::WIDE, d - 1), self.of(&Ty::F32, Facts::WIDE, d - 1));
                let op = self.float_operator();
                let (a, b) = if self.random.once_in(2) { (a, x) } else { (x, a) };
                self.e(ty, Kind::Binary(op, Box::new(a), Box::new(b)))
            }
            6 => {
                let x = self.of(&ty, Facts::WIDE, d - 1);
                self.float_unary(ty, x)
            }
            7 => {
                let args = (0..2).map(|_| self.of(&ty, Facts::WIDE, d - 1)).collect();
                let method = self.random.pick(&[Method::Min, Method::Max]);
                self.e(ty, Kind::Method(method, args))
            }
            8 => self.clamped(&ty, d),
            9 => {
                let (a, b) = (self.of(&ty, Facts::WIDE, d - 1), self.of(&ty, Facts::WIDE, d - 1));
                let amount = self.of(&Ty::F32, Facts::WIDE, d - 1);
                self.e(ty, Kind::Method(Method::Lerp, vec![a, b, amount]))
            }
            10 if n == 3 => {
                let args = (0..2).map(|_| self.of(&ty, Facts::WIDE, d - 1)).collect();
                self.e(ty, Kind::Method(Method::Cross, args))
            }
            10 if n == 4 => self.load(d),
            11 if n > 2 => {
                let shorter = self.of(&Ty::Vec(n - 1), Facts::WIDE, d - 1);
                let last = self.of(&Ty::F32, Facts::WIDE, d - 1);
                self.e(ty, Kind::Method(Method::Extend, vec![shorter, last]))
            }
            11 | 12 if n < 4 => {
                let longer = self.of(&Ty::Vec(n + 1), Facts::WIDE, d - 1);
                self.e(ty, Kind::Method(Method::Truncate, vec![longer]))
            }
            12 => {
                let ints = self.of(&Ty::IVec(n), Facts::WIDE, d - 1);
                self.e(ty, Kind::Method(Method::As, vec![ints]))
            }
            _ => {
                let from = self.random.between(2, 4) as u8;
                let x = self.of(&Ty::Vec(from), Facts::WIDE, d - 1);
                let lanes = (0..n).map(|_| self.random.below(from as usize) as u8).collect();
                self.e(ty, Kind::Swizzle(Box::new(x), lanes))
            }
        }
    }

    pub fn int_vector(&mut self, n: u8, d: u32) -> Expr {
        let ty = Ty::IVec(n);
        if d == 0 || self.poor() || self.random.once_in(4) {
            if self.random.once_in(2)
                && let Some((e, _)) = self.read(&ty)
            {
                return e;
            }
            if n == 2 && self.random.once_in(2) {
                return self.e(ty, Kind::Pixel);
            }
            let lanes = (0..n).map(|_| self.int(Facts::SMALL, d.min(1)).0).collect();
            return self.e(ty, Kind::Compose(lanes));
        }
        let a = self.of(&ty, Facts::WIDE, d - 1);
        match self.random.below(7) {
            0..=2 => {
                let op = self.random.pick(&[
                    Binary::Add,
                    Binary::Sub,
                    Binary::Mul,
                    Binary::Div,
                    Binary::Rem,
                    Binary::Xor,
                ]);
                let b = if self.random.once_in(3) {
                    self.int(Facts::SMALL, d - 1).0
                } else {
                    self.of(&ty, Facts::WIDE, d - 1)
                };
                self.e(ty, Kind::Binary(op, Box::new(a), Box::new(b)))
            }
            3 => {
                let b = self.of(&ty, Facts::WIDE, d - 1);
                let method = self.random.pick(&[Method::Min, Method::Max]);
                self.e(ty, Kind::Method(method, vec![a, b]))
            }
            4 => self.e(ty, Kind::Method(Method::Abs, vec![a])),
            5 => {
                let mut floats = self.of(&Ty::Vec(n), Facts::WIDE, d - 1);
                if self.profile == Profile::Gpu {
                    floats = self.clamped(&Ty::Vec(n), d);
                }
                self.e(ty, Kind::Method(Method::As, vec![floats]))
            }
            _ => self.e(ty, Kind::Unary(Unary::Neg, Box::new(a))),
        }
    }
}
