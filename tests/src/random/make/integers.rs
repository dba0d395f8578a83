//! Integers.

use super::types::Ty;
use super::{Feature, Maker, Want};

impl Maker {
    /// A literal of a value; its type is written unless rustc can tell it.
    pub(super) fn int_text(&mut self, ty: &Ty, n: i64, inferred: bool) -> String {
        let suffix = match ty {
            Ty::I32 => "i32",
            Ty::U32 => "u32",
            _ => "usize",
        };
        let free = inferred && (*ty == Ty::I32 || self.on(Feature::Inferred));
        let digits = if n > 1000 && self.random.once_in(2) {
            format!("{n:#x}")
        } else {
            n.abs().to_string()
        };
        let text = match free && self.random.below(6) > 0 {
            true => digits,
            false => format!("{digits}{}{suffix}", if self.random.once_in(3) { "_" } else { "" }),
        };
        if n < 0 { format!("(-{text})") } else { text }
    }

    pub(super) fn int_literal(&mut self, ty: &Ty, inferred: bool) -> String {
        let edge = self.on(Feature::Edges) && self.random.once_in(12);
        if edge && *ty == Ty::I32 && self.random.once_in(2) {
            return self.random.pick(&["i32::MAX", "i32::MIN"]).to_owned();
        }
        if edge && *ty == Ty::U32 && self.random.once_in(2) {
            return "u32::MAX".to_owned();
        }
        let n = match (ty, self.random.below(8)) {
            (Ty::I32, 0) => self
                .random
                .pick(&[1000, -1000, 0x7fff_ffff, -0x8000_0000, 65_537, -12_345]),
            (Ty::I32, 1..=3) => self.random.between(-9, -1),
            (Ty::U32, 0..=1) => self
                .random
                .pick(&[0x9e37_79b9, 0xffff_ffff, 0x8000_0000, 1_000_000_007, 4096]),
            _ => self.random.between(0, 7),
        };
        // Some are of fewer bits.
        match (ty, n) {
            (Ty::I32, 5) => "(5_u8 as i32)".to_owned(),
            (Ty::I32, -7) => "(-7_i8 as i32)".to_owned(),
            (Ty::I32, 1000) => "(1000_u16 as i32)".to_owned(),
            (Ty::I32, -12_345) => "(-12345_i16 as i32)".to_owned(),
            _ => self.int_text(ty, n, inferred),
        }
    }

    /// Two operands of one type: rustc tells the literals of one from the other.
    fn operands(&mut self, ty: &Ty, want: Want) -> (String, String) {
        let first = self.random.once_in(2);
        let a = self.expr(ty, want.inferred(want.inferred || first));
        let b = self.expr(ty, want.inferred(want.inferred || !first));
        (a, b)
    }

    pub(super) fn integer(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        let own = d.inferred(false);
        let signed = *ty == Ty::I32;
        if !want.known
            && self.random.once_in(12)
            && let Some(text) = self.discriminant(ty, want)
        {
            return text;
        }
        match self.random.below(34) {
            32..=33 if self.on(Feature::Library) => self.integer_of_library(ty, want),
            0..=5 => {
                let op = self.random.pick(&["+", "-", "*", "+", "-"]);
                let (a, b) = self.operands(ty, d);
                format!("({a} {op} {b})")
            }
            6..=7 => {
                let op = self.random.pick(&["&", "|", "^"]);
                let (a, b) = self.operands(ty, d);
                format!("({a} {op} {b})")
            }
            8..=9 => {
                let op = self.random.pick(&["<<", ">>"]);
                let a = self.expr(ty, own);
                match self.random.below(3) {
                    0 => {
                        let by = self.expr(&Ty::U32, own);
                        format!("({a} {op} ({by} & 31))")
                    }
                    1 if !signed => {
                        let by = self.expr(&Ty::I32, own);
                        format!("({a} {op} ({by} & 31))")
                    }
                    _ => format!("({a} {op} {})", self.random.between(0, 31)),
                }
            }
            10..=12 => {
                let op = self.random.pick(&["/", "%"]);
                let a = self.expr(ty, own);
                let n = self.random.between(1, 9);
                match (self.random.below(3), signed) {
                    (0, true) => format!("({a} {op} (({} & 7) + {n}))", self.expr(ty, own)),
                    (0, false) => format!("({a} {op} ({} | {n}))", self.expr(ty, own)),
                    (1, true) if n > 1 => format!("({a} {op} (-{n}))"),
                    _ => {
                        let by = self.int_text(ty, n, true);
                        format!("({a} {op} {by})")
                    }
                }
            }
            13 => {
                let name = self.random.pick(&["min", "max"]);
                let a = self.receiver(ty, own);
                format!("{a}.{name}({})", self.expr(ty, d.inferred(true)))
            }
            14 => {
                let a = self.receiver(ty, own);
                let (low, high) = if signed { (-3, 9) } else { (1, 9) };
                format!("{a}.clamp({low}, {high})")
            }
            15..=16 => {
                let name = self.random.pick(&["wrapping_add", "wrapping_sub", "wrapping_mul"]);
                let a = self.receiver(ty, own);
                format!("{a}.{name}({})", self.expr(ty, d.inferred(true)))
            }
            17 => {
                let name = self.random.pick(&["wrapping_shl", "wrapping_shr"]);
                let a = self.receiver(ty, own);
                format!("{a}.{name}({})", self.random.between(0, 40))
            }
            18 => format!("(!{})", self.expr(ty, d)),
            19 if signed => format!("(-{})", self.expr(ty, d)),
            20 => {
                let a = self.receiver(ty, own);
                match (signed, self.random.below(7)) {
                    (true, 0) => format!("{a}.abs()"),
                    // Of constants alone.
                    (true, 1) => format!(
                        "({}_i32).div_euclid({})",
                        self.random.between(-9, 9),
                        self.random.between(1, 4)
                    ),
                    (true, 2) => format!("{a}.signum()"),
                    (true, 3) => format!("{a}.rem_euclid({})", self.random.between(1, 9)),
                    (true, _) => format!("{a}.wrapping_neg()"),
                    (false, 0) => format!("{a}.count_ones()"),
                    (false, 1) => format!("{a}.leading_zeros()"),
                    (false, 2) => format!("{a}.trailing_zeros()"),
                    (false, 3) => format!("{a}.rem_euclid({})", self.random.between(1, 9)),
                    (false, _) => format!("{a}.reverse_bits()"),
                }
            }
            21 => format!("{}.pow({})", self.receiver(ty, own), self.random.between(0, 4)),
            22..=24 => {
                let from = self.random.pick(&[Ty::I32, Ty::U32, Ty::Usize, Ty::Bool]);
                format!("({} as {})", self.expr(&from, own), self.ty(ty))
            }
            25 => {
                let e = self.float_receiver(own);
                if self.on(Feature::Coarse) {
                    format!("({e} as {})", self.ty(ty))
                } else {
                    format!("({e}.clamp(-4096.0, 4096.0) as {})", self.ty(ty))
                }
            }
            26 => {
                let v = self.fresh("t");
                let e = self.expr(ty, own);
                let name = self.ty(ty);
                format!("{{ let {v}: {name} = {e}; {v} ^ (({v} as u32) >> 7) as {name} }}")
            }
            27 if !signed => {
                let e = self.expr(&Ty::F32, own);
                format!("(({e} + 0.0f32).clamp(-9.0, 9.0) as u32)")
            }
            28..=29 => {
                let lane = match signed {
                    true => super::types::Lane::I,
                    false => super::types::Lane::U,
                };
                let n = self.random.between(2, 4) as u8;
                let v = self.receiver(&Ty::Vec(lane, n), own);
                let name = self.random.pick(&["x", "y", "x", "y"]);
                match self.random.below(4) {
                    0 => format!("{v}.{}()", self.random.pick(&["min_element", "max_element"])),
                    1 => format!("{v}[{}]", self.random.below(n as usize)),
                    _ => format!("{v}.{name}"),
                }
            }
            30 if want.known && !signed => {
                let seven = self.int_text(&Ty::Usize, 7, false);
                format!("({seven}.div_ceil({}) as u32)", self.random.between(1, 4))
            }
            _ => self.leaf(ty, want),
        }
    }

    /// A `usize` that is small, of numbers that need not be: hashes, and what is below 0 as an i32.
    pub(super) fn size(&mut self, want: Want) -> String {
        let d = want.deeper();
        let own = d.inferred(false);
        match self.random.below(13) {
            0..=1 => {
                let op = self.random.pick(&["+", "+", "*"]);
                let (a, n) = (self.expr(&Ty::Usize, own), self.random.between(1, 3));
                let n = self.int_text(&Ty::Usize, n, true);
                format!("(({a} {op} {n}) % 64)")
            }
            2 => {
                let a = self.expr(&Ty::Usize, own);
                format!("({a} {} {})", self.random.pick(&["/", "%"]), self.random.between(1, 5))
            }
            3 => {
                let a = self.receiver(&Ty::Usize, own);
                format!(
                    "{a}.{}({})",
                    self.random.pick(&["min", "max"]),
                    self.random.between(0, 4)
                )
            }
            4..=5 => format!("(({} & 15) as usize)", self.expr(&Ty::U32, own)),
            6 => format!("({}.rem_euclid(7) as usize)", self.receiver(&Ty::I32, own)),
            7 => {
                let arrays: Vec<String> = self
                    .visible()
                    .into_iter()
                    .filter(|l| matches!(l.ty, Ty::Array(..)))
                    .map(|l| l.name)
                    .collect();
                if arrays.is_empty() {
                    self.leaf(&Ty::Usize, want)
                } else {
                    format!("{}.len()", self.random.pick(&arrays))
                }
            }
            8 => {
                let hash = self.expr(&Ty::U32, own);
                format!(
                    "({hash} as usize {} {})",
                    self.random.pick(&["%", "%", "&"]),
                    self.random.between(1, 63)
                )
            }
            9 => {
                let hash = self.expr(&Ty::U32, own);
                format!("(({hash} as usize / {}) % 61)", self.random.pick(&[3, 1000, 65_536]))
            }
            10 => {
                let place = self.expr(&Ty::I32, own);
                let n = self.random.between(1, 9);
                match self.random.below(4) {
                    0 => format!("({place} as usize).min({n})"),
                    1 => format!("(({place} as usize) < {n}) as usize"),
                    2 => format!("({place} as usize & {n})"),
                    _ => format!("(({place} as usize).wrapping_sub({n}) % 32)"),
                }
            }
            11 => {
                let (a, b) = (self.expr(&Ty::U32, own), self.expr(&Ty::Usize, own));
                let op = self.random.pick(&["wrapping_add", "wrapping_sub", "wrapping_mul"]);
                format!("(({a} as usize).{op}({b}) & 31)")
            }
            _ => self.leaf(&Ty::Usize, want),
        }
    }
}
