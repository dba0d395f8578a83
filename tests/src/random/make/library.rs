//! Methods of Rust and glam that the generator has as text of the kernel language.

use super::types::{Lane, Ty, vector};
use super::{Feature, Maker, Want};

impl Maker {
    /// A method that gives a float.
    pub(super) fn float_of_library(&mut self, want: Want) -> String {
        let d = want.deeper();
        let coarse = self.on(Feature::Coarse);
        if coarse && self.random.once_in(4) {
            return self.float_of_angles(d);
        }
        match self.random.below(8) {
            // A driver may lose the sign of a zero. That of a NaN is open in Rust, so it gives way to a number.
            0 if coarse => format!(
                "{}.copysign(f32::max({}, -1e30))",
                self.float_receiver(d),
                self.expr(&Ty::F32, d)
            ),
            1 if coarse => {
                let name = self.random.pick(&["rem_euclid", "div_euclid"]);
                let by = self.random.pick(&["1.5", "-0.75", "3.0"]);
                format!("{}.clamp(-99.0, 99.0).{name}({by})", self.float_receiver(d))
            }
            2 => {
                let names = ["is_infinite", "is_sign_negative", "is_sign_positive"];
                let name = self.random.pick(&names[..if coarse { 3 } else { 1 }]);
                format!(
                    "(u32::from(f32::max({}, -1e30).{name}()) as f32)",
                    self.float_receiver(d)
                )
            }
            3 if coarse => {
                let (three, two) = (Ty::Vec(Lane::F, 3), Ty::Vec(Lane::F, 2));
                let (a, b) = (self.vector_receiver(Lane::F, 3, d), self.expr(&three, d));
                let (v, w) = (self.vector_receiver(Lane::F, 2, d), self.expr(&two, d));
                format!("({a}.angle_between({b}) - {v}.angle_to({w}))")
            }
            4 => {
                let (a, b) = (self.vector_receiver(Lane::F, 2, d), self.expr(&Ty::Vec(Lane::F, 2), d));
                format!("{a}.perp_dot({b})")
            }
            5 if self.on(Feature::Matrices) => {
                let n = self.random.between(2, 4) as u8;
                format!("({}).determinant()", self.expr(&Ty::Mat(n), d))
            }
            6 => format!("f32::from({})", self.float_receiver(d)),
            _ => {
                let ty = self.vector_type_of_floats();
                let Ty::Vec(lane, n) = ty else {
                    return self.leaf(&Ty::F32, want);
                };
                let a = self.vector_receiver(lane, n, d);
                match self.random.once_in(2) {
                    true => format!("({a}.is_normalized() as u32 as f32)"),
                    false => format!("({a}.abs_diff_eq({}, 0.5) as u32 as f32)", self.expr(&ty, d)),
                }
            }
        }
    }

    /// A method that gives a vector, of any numbers.
    pub(super) fn vector_of_library(&mut self, lane: Lane, n: u8, want: Want) -> String {
        let (ty, d) = (Ty::Vec(lane, n), want.deeper());
        let own = d.inferred(false);
        let scalar = ty.lane().expect("a vector has lanes");
        match self.random.below(4) {
            0 => {
                let v = self.vector_receiver(lane, n, own);
                let changed = ["x", "y", "z", "w"][self.random.below(n as usize)];
                format!("{v}.with_{changed}({})", self.expr(&scalar, d.inferred(true)))
            }
            1 => {
                let mask = self.mask(n, own);
                let (a, b) = (self.expr(&ty, d), self.expr(&ty, d));
                format!("{}{n}::select({mask}, {a}, {b})", vector(lane))
            }
            2 => {
                let parts: Vec<String> = (0..n).map(|_| self.expr(&scalar, d.inferred(true))).collect();
                match self.random.once_in(2) {
                    true => format!("{}{n}::from([{}])", vector(lane), parts.join(", ")),
                    false => format!("{}{n}::from(({}))", vector(lane), parts.join(", ")),
                }
            }
            _ if n > 2 => {
                let shorter = self.expr(&Ty::Vec(lane, n - 1), own);
                let last = self.expr(&scalar, d.inferred(true));
                format!("{}{n}::from(({shorter}, {last}))", vector(lane))
            }
            _ => self.leaf(&ty, want),
        }
    }

    /// A method that gives a vector of floats.
    pub(super) fn float_vector_of_library(&mut self, n: u8, want: Want) -> String {
        let (lane, ty, d) = (Lane::F, Ty::Vec(Lane::F, n), want.deeper());
        let coarse = self.on(Feature::Coarse);
        if coarse && self.random.once_in(4) {
            return self.vector_of_angles(n, d);
        }
        let own = self.vector_receiver(lane, n, d);
        let other = self.expr(&ty, d);
        match self.random.below(14) {
            0 => format!("{own}.midpoint({other})"),
            1 => format!("{own}.fract_gl()"),
            // Rust leaves open which of two zeros a maximum returns.
            2 => format!("({own} + 0.0).saturate()"),
            3 => format!("{own}.copysign({other}.max(Vec{n}::splat(-1e30)))"),
            4 => format!("{own}.project_onto_normalized({other})"),
            5 => format!("{own}.reject_from_normalized({other})"),
            6 if coarse => {
                let name = self.random.pick(&["project_onto", "reject_from"]);
                format!("{own}.{name}({other} + 0.5)")
            }
            7 if coarse => match self.random.below(4) {
                0 => format!("{own}.normalize_or_zero()"),
                1 => format!("{own}.normalize_and_length().0"),
                _ => format!("{own}.normalize_or({other})"),
            },
            8 if coarse => {
                let (name, args) = self.random.pick(&[
                    ("clamp_length", "0.5, 4.0"),
                    ("clamp_length_max", "2.0"),
                    ("clamp_length_min", "0.25"),
                ]);
                format!("{own}.{name}({args})")
            }
            9 if coarse => format!("{own}.move_towards({other}, 0.75)"),
            10 if coarse => format!("{own}.refract({other}, 0.8)"),
            11 if coarse => {
                let name = self.random.pick(&["rem_euclid", "div_euclid"]);
                format!("{own}.clamp(Vec{n}::splat(-99.0), Vec{n}::splat(99.0)).{name}(Vec{n}::splat(1.5))")
            }
            _ if n == 2 => format!("{own}.rotate({other})"),
            _ if n == 3 => match self.random.below(3) {
                0 if coarse => format!("{own}.any_orthonormal_vector()"),
                1 if coarse => format!("{own}.any_orthonormal_pair().{}", self.random.below(2)),
                _ => format!("{own}.any_orthogonal_vector()"),
            },
            _ if n == 4 && self.on(Feature::Matrices) && coarse && self.random.once_in(2) => {
                let m = self.expr(&Ty::Mat(4), d);
                format!("({m}).project_point3({}).extend(1.0)", self.expr(&Ty::Vec(lane, 3), d))
            }
            _ => other,
        }
    }

    /// A method that gives a matrix.
    pub(super) fn matrix_of_library(&mut self, n: u8, want: Want) -> String {
        let d = want.deeper();
        match (n, self.random.below(4)) {
            (_, 0) if self.on(Feature::Coarse) => format!("({}).inverse()", self.expr(&Ty::Mat(n), d)),
            (2, _) => format!("Mat2::from_mat3({})", self.expr(&Ty::Mat(3), d)),
            (3, 1) => format!("Mat3::from_mat2({})", self.expr(&Ty::Mat(2), d)),
            (3, _) => format!("Mat3::from_mat4({})", self.expr(&Ty::Mat(4), d)),
            (_, 1) => format!("Mat4::from_mat3({})", self.expr(&Ty::Mat(3), d)),
            (_, 2) => format!("Mat4::from_translation({})", self.expr(&Ty::Vec(Lane::F, 3), d)),
            _ => format!("Mat4::from_scale({})", self.expr(&Ty::Vec(Lane::F, 3), d)),
        }
    }

    /// A vector of booleans.
    fn mask(&mut self, n: u8, want: Want) -> String {
        let d = want.deeper();
        let lane = self.random.pick(&[Lane::F, Lane::I, Lane::U]);
        match self.random.below(if want.depth == 0 { 2 } else { 4 }) {
            0 => format!("BVec{n}::{}", self.random.pick(&["TRUE", "FALSE"])),
            1 => {
                let parts: Vec<String> = (0..n).map(|_| self.expr(&Ty::Bool, d)).collect();
                format!("BVec{n}::new({})", parts.join(", "))
            }
            2 => {
                let op = self.random.pick(&["&", "|", "^"]);
                format!("({} {op} !{})", self.mask(n, d), self.mask(n, d))
            }
            _ => {
                let name = self
                    .random
                    .pick(&["cmplt", "cmple", "cmpgt", "cmpge", "cmpeq", "cmpne"]);
                let a = self.vector_receiver(lane, n, d.inferred(false));
                format!("{a}.{name}({})", self.expr(&Ty::Vec(lane, n), d))
            }
        }
    }

    /// A boolean of a vector of booleans.
    pub(super) fn mask_condition(&mut self, want: Want) -> String {
        let n = self.random.between(2, 4) as u8;
        let mask = self.mask(n, want.deeper());
        match self.random.below(5) {
            0 => format!("{mask}.test({})", self.random.below(n as usize)),
            1 => format!("({mask}.{})", self.random.pick(&["x", "y"])),
            2 | 3 => format!("{mask}.any()"),
            _ => format!("{mask}.all()"),
        }
    }

    /// A method of an integer.
    pub(super) fn integer_of_library(&mut self, ty: &Ty, want: Want) -> String {
        let (own, given) = (want.deeper().inferred(false), want.deeper().inferred(true));
        let signed = *ty == Ty::I32;
        let a = self.receiver(ty, own);
        match self.random.below(8) {
            0..=1 => {
                let name = self.random.pick(&["rem_euclid", "div_euclid"]);
                let by = self.expr(ty, own);
                match (signed, self.random.once_in(2)) {
                    (true, true) => format!("{a}.{name}(({by} & 7) - 12)"),
                    _ => format!("{a}.{name}(({by} & 7) + 3)"),
                }
            }
            2 if !signed => {
                let by = self.expr(ty, own);
                format!("{a}.div_ceil(({by} & 7) + 2)")
            }
            3 => {
                let name = self.random.pick(&["rotate_left", "rotate_right"]);
                format!("{a}.{name}({} & 31)", self.expr(&Ty::U32, own))
            }
            4 if !signed => {
                let b = self.expr(ty, given);
                match self.random.below(5) {
                    0 => format!("{a}.checked_add({b}).unwrap_or(7)"),
                    1 => format!("{a}.checked_sub({b}).unwrap_or(9)"),
                    k => format!("{a}.{}({b})", ["saturating_add", "saturating_sub", "midpoint"][k - 2]),
                }
            }
            5 if !signed => {
                let b = self.expr(ty, own);
                format!(
                    "(u32::from({a}.is_multiple_of({b} & 3)) + u32::from({}.is_power_of_two()))",
                    self.receiver(ty, own)
                )
            }
            5 => format!(
                "(i32::from({a}.is_positive()) - i32::from({}.is_negative()))",
                self.receiver(ty, own)
            ),
            _ if !signed && self.random.once_in(2) => {
                let (x, y) = (self.receiver(&Ty::I32, own), self.expr(&Ty::I32, given));
                format!("({x}.abs_diff({y}) ^ {}.unsigned_abs())", self.receiver(&Ty::I32, own))
            }
            _ if !signed => format!("{a}.abs_diff({})", self.expr(ty, given)),
            6 => {
                let (lane, n) = (self.random.pick(&[Lane::I, Lane::U]), self.random.between(2, 4) as u8);
                let name = self.random.pick(&["min_position", "max_position"]);
                format!(
                    "{a}.wrapping_add({}.{name}() as i32)",
                    self.vector_receiver(lane, n, own)
                )
            }
            _ => a,
        }
    }

    /// `mem::swap` or `mem::replace` of variables.
    pub(super) fn exchange(&mut self) {
        let Some(place) = self.writable(None) else {
            return self.assign();
        };
        if !self.copies(&place.ty) {
            return self.assign();
        }
        let name = self.fresh("v");
        self.freeze(&place.root, true);
        let value = self.without_effects(|m| {
            let want = m.wish(1).inferred(true);
            m.expr(&place.ty, want)
        });
        self.freeze(&place.root, false);
        let written = self.ty(&place.ty);
        if self.random.once_in(2) {
            self.line(format!(
                "let {name}: {written} = std::mem::replace(&mut {}, {value});",
                place.text
            ));
        } else {
            self.line(format!("let mut {name}: {written} = {value};"));
            self.line(format!("std::mem::swap(&mut {}, &mut {name});", place.text));
        }
        self.bind(&name, &place.ty, false);
    }
}
