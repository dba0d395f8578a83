//! Conditions, and expressions that choose by one or by a pattern.

use super::types::Ty;
use super::{Feature, Maker, Want};

impl Maker {
    pub(super) fn condition(&mut self, want: Want) -> String {
        let d = want.deeper();
        if want.known {
            return self.known_condition();
        }
        match self.random.below(17) {
            13 if self.on(Feature::Choices) && d.depth > 0 => self.same(want),
            15 if self.on(Feature::Orders) && d.depth > 0 => self.ordered(want),
            14 if self.on(Feature::Library) => self.mask_condition(want),
            0..=2 => {
                let op = self.random.pick(&["<", "<=", ">", ">="]);
                let (a, b) = (self.float_receiver(d), self.expr(&Ty::F32, d));
                format!("({a} {op} {b})")
            }
            3..=6 => {
                let ty = self.random.pick(&[Ty::I32, Ty::U32, Ty::I32, Ty::U32, Ty::Usize]);
                let op = self.random.pick(&["<", "<=", ">", ">=", "==", "!="]);
                let (a, b) = (self.expr(&ty, d.inferred(false)), self.expr(&ty, d.inferred(true)));
                // `a < b` after a cast would be read as generic arguments.
                format!("(({a}) {op} {b})")
            }
            7..=8 => {
                let op = self.random.pick(&["&&", "||"]);
                let a = self.expr(&Ty::Bool, d);
                let b = self.with_effects(|m| m.expr(&Ty::Bool, d));
                format!("({a} {op} {b})")
            }
            9 => {
                let op = self.random.pick(&["&", "|", "^", "==", "!="]);
                let (a, b) = (self.expr(&Ty::Bool, d), self.expr(&Ty::Bool, d));
                format!("({a} {op} {b})")
            }
            10 => format!("(!{})", self.expr(&Ty::Bool, d)),
            11 => {
                let (e, name) = (self.float_receiver(d), self.random.pick(&["is_nan", "is_finite"]));
                format!("{e}.{name}()")
            }
            12 => {
                let ty = self.random.pick(&[Ty::I32, Ty::U32]);
                let e = self.expr(&ty, d.inferred(false));
                let low = self.random.between(0, 3);
                match ty {
                    Ty::I32 => format!("(-{low}..9).contains(&({e}))"),
                    Ty::U32 if self.random.once_in(3) => {
                        format!(
                            "({}_u32.is_multiple_of({}))",
                            self.random.between(0, 9),
                            self.random.between(1, 4)
                        )
                    }
                    _ => format!("({low}..9).contains(&({e} & 15))"),
                }
            }
            _ => self.leaf(&Ty::Bool, want),
        }
    }

    /// A condition that is decided when the shader is made.
    pub(super) fn known_condition(&mut self) -> String {
        let want = Want {
            depth: 1,
            known: true,
            inferred: false,
        };
        if !self.enumerations.is_empty() && self.random.once_in(4) {
            let ty = Ty::Enum(self.random.below(self.enumerations.len()));
            let (a, b) = (self.leaf(&ty, want), self.leaf(&ty, want));
            return format!("({a} {} {b})", self.random.pick(&["==", "!="]));
        }
        let ty = self.random.pick(&[Ty::I32, Ty::U32, Ty::I32, Ty::Usize]);
        let a = self.leaf(&ty, want);
        let n = self.random.between(0, 4);
        match self.random.below(4) {
            0 => format!("(({a} & 1) == {})", n & 1),
            1 => format!("(({a}) != {n})"),
            _ => format!("(({a}) {} {n})", self.random.pick(&["<", ">", "==", ">="])),
        }
    }

    /// `if` as an expression, or `match`.
    pub(super) fn any_if(&mut self, ty: &Ty, want: Want) -> Option<String> {
        if !self.copies(ty) || matches!(ty, Ty::Enum(_)) && !want.known {
            return None;
        }
        let d = want.deeper();
        if !want.known && self.chance(Feature::Matching, 4) {
            return Some(self.runtime_match_expr(ty, d));
        }
        if self.on(Feature::Enums) && self.random.once_in(3) {
            return Some(self.match_expr(ty, want));
        }
        let condition = if want.known || self.random.once_in(4) {
            self.known_condition()
        } else {
            self.condition(Want { known: false, ..d })
        };
        let (a, b) = (self.expr(ty, d), self.expr(ty, d));
        Some(format!("(if {condition} {{ {a} }} else {{ {b} }})"))
    }

    fn match_expr(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        let (subject, patterns) = self.known_match();
        let arms: Vec<String> = patterns
            .into_iter()
            .map(|pattern| format!("{pattern} => {}", self.expr(ty, d)))
            .collect();
        format!("(match {subject} {{ {} }})", arms.join(", "))
    }

    /// A subject that is a compile-time constant, and patterns that take all of its type.
    pub(super) fn known_match(&mut self) -> (String, Vec<String>) {
        let want = Want {
            depth: 0,
            known: true,
            inferred: false,
        };
        if !self.enumerations.is_empty() && self.random.once_in(2) {
            let k = self.random.below(self.enumerations.len());
            let subject = self.leaf(&Ty::Enum(k), want);
            let e = self.enumerations[k].clone();
            let mut patterns: Vec<String> = e.variants.iter().map(|v| format!("{}::{v}", e.name)).collect();
            if self.random.once_in(3) && patterns.len() > 2 {
                let last = patterns.pop().expect("a variant");
                let before = patterns.pop().expect("a variant");
                patterns.push(format!("{before} | {last}"));
            } else if self.random.once_in(2) {
                patterns.pop();
                patterns.push("_".to_owned());
            }
            return (subject, patterns);
        }
        let ty = self.random.pick(&[Ty::I32, Ty::U32, Ty::I32, Ty::Usize]);
        let subject = self.leaf(&ty, want);
        let named: Vec<String> = self
            .constants
            .iter()
            .filter(|(_, t, _)| *t == ty)
            .map(|(name, ..)| name.clone())
            .collect();
        match self.random.below(4) {
            0 => {
                let other = self.leaf(&Ty::I32, want);
                let patterns = ["(0, 1)", "(1 | 2, 0..=3)", "(_, 2)", "_"].map(str::to_owned);
                (format!("({subject}, {other})"), patterns.to_vec())
            }
            1 if !named.is_empty() => {
                let name = self.random.pick(&named);
                (subject, vec![name, "_".to_owned()])
            }
            2 if ty == Ty::I32 => (subject, ["-3..=0", "1 | 5", "2..=4", "_"].map(str::to_owned).to_vec()),
            _ => (subject, ["0", "1 | 2", "3..=6", "_"].map(str::to_owned).to_vec()),
        }
    }
}
