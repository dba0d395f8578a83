//! Floats.

use super::types::Ty;
use super::{Feature, Maker, Want};
use crate::edges;

/// A float as Rust has it.
fn extreme(x: f32) -> String {
    match x {
        _ if x.is_nan() => "f32::NAN".to_owned(),
        f32::INFINITY => "f32::INFINITY".to_owned(),
        f32::NEG_INFINITY => "f32::NEG_INFINITY".to_owned(),
        f32::MAX => "f32::MAX".to_owned(),
        f32::MIN => "f32::MIN".to_owned(),
        f32::MIN_POSITIVE => "f32::MIN_POSITIVE".to_owned(),
        _ if x.is_sign_negative() => format!("({x:?})"),
        _ => format!("{x:?}"),
    }
}

impl Maker {
    pub(super) fn float_literal(&mut self) -> String {
        if self.on(Feature::Extremes) && self.random.once_in(8) {
            return extreme(match self.on(Feature::Coarse) {
                true => self.random.pick(&edges::FLOATS),
                false => self.random.pick(&edges::of_drivers()),
            });
        }
        let text = match self.random.below(10) {
            0 => "0.0".to_owned(),
            1 => "1.0".to_owned(),
            2 if self.on(Feature::Coarse) => self
                .random
                .pick(&["0.1", "3.3", "1e-3", "12345.678", "0.7f32"])
                .to_owned(),
            3 => self
                .random
                .pick(&["0.5", "2.0", "4.0f32", "1_0.25", "3f32", "5."])
                .to_owned(),
            _ => format!("{:?}", self.random.between(1, 64) as f32 / 16.0),
        };
        if self.random.once_in(4) {
            format!("(-{text})")
        } else {
            text
        }
    }

    /// A float of an operation, or one read.
    pub(super) fn float(&mut self, want: Want) -> String {
        let d = want.deeper();
        let coarse = self.on(Feature::Coarse);
        if self.tries && !want.known && d.depth > 0 && self.random.once_in(12) {
            let [a, b] = [0, 1].map(|_| self.expr(&Ty::F32, d));
            return match self.random.once_in(2) {
                true => format!("scaling({a})({b})"),
                false => format!("ends([{a}, 0.5, {b}])"),
            };
        }
        match self.random.below(30) {
            0..=8 => {
                let op = self.random.pick(&["+", "-", "*", "+", "-"]);
                let (a, b) = (self.expr(&Ty::F32, d), self.expr(&Ty::F32, d));
                format!("({a} {op} {b})")
            }
            9..=10 if coarse => {
                let (a, b) = (self.expr(&Ty::F32, d), self.float_receiver(d));
                format!("({a} / ({b}.abs() + 0.75))")
            }
            11 => format!("(-{})", self.expr(&Ty::F32, d)),
            12 => {
                let name = self.random.pick(&["abs", "floor", "ceil", "trunc", "round_ties_even"]);
                format!("{}.{name}()", self.float_receiver(d))
            }
            13 => {
                let name = self.random.pick(&["min", "max"]);
                let (a, b) = (self.float_receiver(d), self.expr(&Ty::F32, d));
                format!("{a}.{name}({b} + 0.03125)")
            }
            14 => format!("{}.clamp(-2.0, 8.5)", self.float_receiver(d)),
            15 if coarse && self.random.once_in(4) => format!("{}.clamp(-4.5, 4.0).exp2()", self.float_receiver(d)),
            15 if coarse => {
                let name = self.random.pick(&["sqrt", "cbrt", "recip", "to_radians", "to_degrees"]);
                format!("({}.abs() + 0.25).{name}()", self.float_receiver(d))
            }
            16 => format!(
                "{}.clamp(-3.0, 3.0).powi({})",
                self.float_receiver(d),
                self.random.between(1, 7)
            ),
            17 => {
                let from = self.random.pick(&[Ty::I32, Ty::U32, Ty::Usize]);
                let e = self.expr(&from, d.inferred(false));
                match from {
                    Ty::Usize => format!("({e} as f32)"),
                    _ if coarse && self.random.once_in(2) => format!("({e} as f32)"),
                    _ => format!("(({e} & 0xfff) as f32)"),
                }
            }
            18 => {
                let e = self.expr(&Ty::Bool, d);
                format!("({e} as i32 as f32)")
            }
            19..=20 => {
                let ty = self.vector_type_of_floats();
                let e = self.receiver(&ty, d);
                self.vector_to_float(&e, &ty, d)
            }
            21 => {
                let (name, n) = self.random.pick(&[
                    ("saturate", 1),
                    ("fract", 1),
                    ("sign", 1),
                    ("round", 1),
                    ("mix", 3),
                    ("step", 2),
                    ("smoothstep", 9),
                    ("inverse_sqrt", 8),
                ]);
                match n {
                    8 if coarse => format!("inverse_sqrt({}.abs() + 0.5)", self.float_receiver(d)),
                    8 | 9 if !coarse => self.leaf(&Ty::F32, want),
                    // Rust leaves open which of two zeros a maximum returns.
                    _ if name == "saturate" => format!("saturate({} + 0.0f32)", self.expr(&Ty::F32, d)),
                    9 => format!("smoothstep(-1.0, 3.0, {})", self.expr(&Ty::F32, d)),
                    _ => {
                        let args: Vec<String> = (0..n).map(|_| self.expr(&Ty::F32, d)).collect();
                        format!("{name}({})", args.join(", "))
                    }
                }
            }
            22 => {
                let e = self.float_receiver(d);
                format!("f32::from_bits(({e}.clamp(-64.0, 64.0) + 0.0).to_bits() & 0xffff_fff0)")
            }
            23 if !want.known => format!("tally(\"seen\", {})", self.expr(&Ty::F32, d)),
            24 => {
                let e = self.expr(&Ty::F32, d);
                let v = self.fresh("t");
                format!("{{ let {v} = {e}; {v} * 0.5 }}")
            }
            25 if self.random.once_in(3) => self.random.pick(&["std::f32::consts::PI", "f32::EPSILON"]).to_owned(),
            26 => {
                let index = self.index(5, want.known, 1);
                if self.inputs && !want.known {
                    format!("b.load({index})")
                } else {
                    format!("[1.0, 0.5, 2.0, -1.5, 3.0][{index}]")
                }
            }
            27 => {
                let e = self.float_receiver(d);
                let other = self.expr(&Ty::F32, d);
                format!("(if {e}.is_finite() {{ {other} }} else {{ 0.25 }})")
            }
            28 if self.on(Feature::Library) => self.float_of_library(want),
            _ => self.leaf(&Ty::F32, want),
        }
    }

    /// A float whose type rustc knows from itself.
    pub(super) fn float_receiver(&mut self, want: Want) -> String {
        let text = self.expr(&Ty::F32, want);
        // Only a part that says its type would do, and `+ 0.0f32` says it without a change but of -0.
        format!("({text} + 0.0f32)")
    }
}
