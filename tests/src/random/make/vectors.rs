//! Vectors and matrices.

use super::types::{Lane, Ty, vector};
use super::{Feature, Maker, Want};

impl Maker {
    pub(super) fn vector_type_of_floats(&mut self) -> Ty {
        Ty::Vec(Lane::F, self.random.between(2, 4) as u8)
    }

    pub(super) fn vector_leaf(&mut self, lane: Lane, n: u8, want: Want) -> String {
        let name = format!("{}{n}", vector(lane));
        let scalar = Ty::Vec(lane, n).lane().expect("a vector has lanes");
        let flat = Want {
            depth: 0,
            ..want.inferred(true)
        };
        match self.random.below(6) {
            0 => format!("{name}::{}", self.random.pick(&["ZERO", "ONE", "X", "Y"])),
            1 => format!("{name}::splat({})", self.leaf(&scalar, flat)),
            _ => {
                let parts: Vec<String> = (0..n).map(|_| self.leaf(&scalar, flat)).collect();
                let function = if self.random.once_in(6) {
                    format!("{name}::new")
                } else {
                    name.to_lowercase()
                };
                format!("{function}({})", parts.join(", "))
            }
        }
    }

    pub(super) fn vector_expr(&mut self, lane: Lane, n: u8, want: Want) -> String {
        let ty = Ty::Vec(lane, n);
        let scalar = ty.lane().expect("a vector has lanes");
        let d = want.deeper();
        let own = d.inferred(false);
        match self.random.below(22) {
            20 if self.on(Feature::Library) => self.vector_of_library(lane, n, want),
            21 if self.on(Feature::Library) && lane == Lane::F => self.float_vector_of_library(n, want),
            0..=4 => {
                let op = self.random.pick(&["+", "-", "*", "+"]);
                let (a, b) = (self.expr(&ty, d), self.expr(&ty, d));
                match self.random.below(4) {
                    0 => format!("({a} {op} {})", self.expr(&scalar, own)),
                    1 => format!("({} {op} {b})", self.scalar_left(&scalar, own)),
                    _ => format!("({a} {op} {b})"),
                }
            }
            5 if lane != Lane::U => format!("(-{})", self.expr(&ty, d)),
            6..=7 => {
                let parts: Vec<String> = (0..n).map(|_| self.expr(&scalar, d.inferred(true))).collect();
                format!("{}{n}({})", vector(lane).to_lowercase(), parts.join(", "))
            }
            8 => {
                let from = self.random.between(2, 4) as u8;
                let letters: String = (0..n)
                    .map(|_| b"xyzw"[self.random.below(from as usize)] as char)
                    .collect();
                format!("{}.{letters}()", self.vector_receiver(lane, from, own))
            }
            9 => {
                let name = self.random.pick(&["min", "max"]);
                let a = self.vector_receiver(lane, n, own);
                let b = self.expr(&ty, d);
                match lane {
                    Lane::F => format!("{a}.{name}({b} + 0.03125)"),
                    _ => format!("{a}.{name}({b})"),
                }
            }
            10 if n > 2 => {
                let shorter = self.vector_receiver(lane, n - 1, own);
                format!("{shorter}.extend({})", self.expr(&scalar, d.inferred(true)))
            }
            11 if n < 4 => format!("{}.truncate()", self.vector_receiver(lane, n + 1, own)),
            12 if n == 4 && lane == Lane::F && self.inputs && !want.known => {
                let at = self.expr(&Ty::Vec(Lane::I, 2), d);
                format!("a.load({at})")
            }
            13 => match lane {
                Lane::F => {
                    let from = self.random.pick(&[Lane::I, Lane::U]);
                    let v = self.vector_receiver(from, n, own);
                    match self.on(Feature::Coarse) {
                        true => format!("{v}.as_vec{n}()"),
                        false => format!("({v} % 4096).as_vec{n}()"),
                    }
                }
                Lane::I => format!("{}.as_ivec{n}()", self.vector_receiver(Lane::U, n, own)),
                Lane::U => format!("{}.as_uvec{n}()", self.vector_receiver(Lane::I, n, own)),
            },
            14 if lane == Lane::F => match self.random.below(7) {
                0 => format!("{}.abs()", self.vector_receiver(lane, n, own)),
                1 => {
                    let name = self.random.pick(&["floor", "ceil", "fract_gl"]);
                    let v = self.vector_receiver(lane, n, own);
                    if name == "fract_gl" {
                        format!("fract({v})")
                    } else {
                        format!("{v}.{name}()")
                    }
                }
                2 => {
                    let (a, b) = (self.vector_receiver(lane, n, own), self.expr(&ty, d));
                    format!("{a}.lerp({b}, {})", self.expr(&Ty::F32, d))
                }
                3 if n == 3 => {
                    let (a, b) = (self.vector_receiver(lane, n, own), self.expr(&ty, d));
                    format!("{a}.cross({b})")
                }
                4 => {
                    let (a, b) = (self.expr(&ty, d), self.expr(&ty, d));
                    format!("mix({a}, {b}, {})", self.expr(&Ty::F32, d))
                }
                5 if n == 2 => format!("{}.perp()", self.vector_receiver(lane, n, own)),
                // Rust leaves open which of two zeros a maximum returns.
                _ => format!("saturate({} + 0.0)", self.expr(&ty, d)),
            },
            15 if lane == Lane::F && self.on(Feature::Coarse) => {
                let a = self.expr(&ty, d);
                format!("({a} / ({}.abs() + 0.5))", self.vector_receiver(lane, n, own))
            }
            15 if lane != Lane::F => {
                let op = self.random.pick(&["/", "%"]);
                let a = self.expr(&ty, d);
                let by = self.random.between(1, 9);
                let by = self.int_text(&scalar, by, true);
                format!("({a} {op} {by})")
            }
            16 if lane != Lane::F => {
                let op = self.random.pick(&["&", "|", "^"]);
                let (a, b) = (self.expr(&ty, d), self.expr(&ty, d));
                format!("({a} {op} {b})")
            }
            17 if self.on(Feature::Matrices) && lane == Lane::F => {
                if n == 3 && self.random.once_in(3) {
                    let name = self.random.pick(&["transform_point3", "transform_vector3"]);
                    let m = self.expr(&Ty::Mat(4), d);
                    // These methods take a matrix by reference.
                    return format!("({m}).{name}({})", self.without_effects(|maker| maker.expr(&ty, d)));
                }
                let m = self.expr(&Ty::Mat(n), d);
                match self.random.below(2) {
                    0 => format!("({m} * {})", self.expr(&ty, d)),
                    _ => format!("({m}).mul_vec{n}({})", self.without_effects(|maker| maker.expr(&ty, d))),
                }
            }
            18 if self.on(Feature::Matrices) && lane == Lane::F => {
                let m = self.expr(&Ty::Mat(n), d);
                match self.random.below(4) {
                    0 => format!("({m}).col({})", self.random.below(n as usize)),
                    1 => format!("({m}).row({})", self.random.below(n as usize)),
                    2 => format!("({m}).diagonal()"),
                    _ => {
                        let axis = self.random.below(n as usize);
                        format!("({m}).{}_axis", ["x", "y", "z", "w"][axis])
                    }
                }
            }
            19 => {
                let parts: Vec<String> = (0..n).map(|_| self.expr(&scalar, d.inferred(true))).collect();
                format!("{}{n}::from_array([{}])", vector(lane), parts.join(", "))
            }
            _ => self.leaf(&ty, want),
        }
    }

    /// A scalar before an operator: rustc must know its type from itself.
    fn scalar_left(&mut self, scalar: &Ty, want: Want) -> String {
        match scalar {
            Ty::F32 => self.float_receiver(want),
            _ => self.expr(scalar, want),
        }
    }

    pub(super) fn vector_receiver(&mut self, lane: Lane, n: u8, want: Want) -> String {
        let text = self.expr(&Ty::Vec(lane, n), want);
        if text.starts_with("{") {
            format!("({text})")
        } else {
            text
        }
    }

    pub(super) fn vector_to_float(&mut self, e: &str, ty: &Ty, want: Want) -> String {
        let Ty::Vec(_, n) = ty else { return e.to_owned() };
        match self.random.below(9) {
            0 => format!("{e}.dot({})", self.expr(ty, want)),
            1 => format!("{e}.length_squared()"),
            2 if self.on(Feature::Coarse) => format!("{e}.length()"),
            3 => match self
                .random
                .pick(&["element_sum", "element_product", "min_element", "max_element"])
            {
                // The choice between two zeros, and the result for a NaN, are open.
                name @ ("min_element" | "max_element") => {
                    let vec = self.ty(ty);
                    format!("({e}.clamp({vec}::splat(-64.0), {vec}::splat(64.0)) + 0.0).{name}()")
                }
                name => format!("{e}.{name}()"),
            },
            4 => format!("{e}.distance_squared({})", self.expr(ty, want)),
            5 => format!("{e}[{}]", self.random.below(*n as usize)),
            6 => format!("{e}.to_array()[{}]", self.random.below(*n as usize)),
            _ => format!("{e}.{}", self.random.pick(&["x", "y"])),
        }
    }

    pub(super) fn matrix(&mut self, n: u8, want: Want) -> String {
        let d = want.deeper();
        let column = Ty::Vec(Lane::F, n);
        match self.random.below(6) {
            5 if self.on(Feature::Library) => self.matrix_of_library(n, want),
            0 => format!("({} * {})", self.expr(&Ty::Mat(n), d), self.leaf(&Ty::Mat(n), d)),
            1 => format!("({}).transpose()", self.expr(&Ty::Mat(n), d)),
            2 => format!("Mat{n}::from_diagonal({})", self.expr(&column, d)),
            3 => {
                let op = self.random.pick(&["+", "-"]);
                format!("({} {op} {})", self.expr(&Ty::Mat(n), d), self.expr(&Ty::Mat(n), d))
            }
            _ => match self.random.below(4) {
                0 => {
                    let cells: Vec<String> = (0..n * n).map(|_| self.leaf(&Ty::F32, d)).collect();
                    format!("Mat{n}::from_cols_array(&[{}])", cells.join(", "))
                }
                k => {
                    let vectors: Vec<String> = (0..n).map(|_| self.expr(&column, d)).collect();
                    let function = if k == 1 { "from_rows" } else { "from_cols" };
                    format!("Mat{n}::{function}({})", vectors.join(", "))
                }
            },
        }
    }
}
