//! Conditions and indices.

use super::super::ast::*;
use super::{Facts, Generator};

impl Generator {
    /// A condition; if `known`, of what is known once all loops are unrolled.
    pub fn condition(&mut self, known: bool, d: u32) -> Expr {
        let compare = [Binary::Lt, Binary::Le, Binary::Gt, Binary::Ge, Binary::Eq, Binary::Ne];
        let op = self.random.pick(&compare);
        let compared = |g: &mut Generator, a: Expr, b: Expr| g.e(Ty::Bool, Kind::Binary(op, Box::new(a), Box::new(b)));
        if d > 0 && !self.poor() {
            match self.random.below(8) {
                0 | 1 => {
                    let a = self.condition(known, d - 1);
                    // The right side is only run where it matters.
                    self.depth += u32::from(!known);
                    let b = self.condition(known, d - 1);
                    self.depth -= u32::from(!known);
                    let op = self
                        .random
                        .pick(&[Binary::LazyAnd, Binary::LazyOr, Binary::And, Binary::Or, Binary::Xor]);
                    return self.e(Ty::Bool, Kind::Binary(op, Box::new(a), Box::new(b)));
                }
                2 => {
                    let a = self.condition(known, d - 1);
                    return self.e(Ty::Bool, Kind::Unary(Unary::Not, Box::new(a)));
                }
                3 if !known => {
                    if let Some((e, _)) = self.read(&Ty::Bool) {
                        return e;
                    }
                }
                4 if !known => {
                    let (a, b) = (self.wide(d - 1), self.int(Facts::SMALL, d - 1).0);
                    return compared(self, a, b);
                }
                5 if !known => {
                    let ty = self.random.pick(&[Ty::Vec(2), Ty::Vec(4), Ty::IVec(2)]);
                    let (a, b) = (self.of(&ty, Facts::WIDE, d - 1), self.of(&ty, Facts::WIDE, d - 1));
                    let op = self.random.pick(&[Binary::Eq, Binary::Ne]);
                    return self.e(Ty::Bool, Kind::Binary(op, Box::new(a), Box::new(b)));
                }
                6 if !known => return self.condition(true, d - 1),
                _ => {}
            }
        }
        let d = d.saturating_sub(1);
        if !known {
            let (a, b) = (self.of(&Ty::F32, Facts::WIDE, d), self.of(&Ty::F32, Facts::WIDE, d));
            return compared(self, a, b);
        }
        let (a, _) = self.known_int(d);
        if self.random.once_in(5) {
            let a = self.e(Ty::F32, Kind::Cast(Box::new(a)));
            let b = self.float_literal();
            return compared(self, a, b);
        }
        let (b, _) = self.known_int(d);
        compared(self, a, b)
    }

    /// An index of an array of `len` elements; one that is only known at run time is clamped to it.
    pub fn index(&mut self, len: u8, d: u32) -> Expr {
        let last = i64::from(len) - 1;
        if !self.random.once_in(3) {
            return self.int(Facts::known(0, last), d.min(1)).0;
        }
        if self.random.once_in(4) {
            let x = self.uint(d.min(1));
            let len = self.e(Ty::U32, Kind::Uint(u32::from(len)));
            return self.e(Ty::U32, Kind::Binary(Binary::Rem, Box::new(x), Box::new(len)));
        }
        let n = self.int(Facts::SMALL, d.min(2)).0;
        let (low, high) = (self.e(Ty::I32, Kind::Int(0)), self.e(Ty::I32, Kind::Int(last as i32)));
        self.int_method(Method::Clamp, vec![n, low, high])
    }
}
