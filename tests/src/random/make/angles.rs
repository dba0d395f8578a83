//! Exponentials, logarithms, functions of angles, and directions: what drivers compute in other bits than Rust.

use super::types::{Lane, Ty};
use super::{Maker, Want};

impl Maker {
    /// A float of such a function.
    pub(super) fn float_of_angles(&mut self, d: Want) -> String {
        let a = self.float_receiver(d);
        match self.random.below(9) {
            0 => format!("{a}.{}()", self.random.pick(&["sin", "cos", "tan", "atan", "tanh"])),
            1 => format!("{a}.clamp(-1.0, 1.0).{}()", self.random.pick(&["asin", "acos"])),
            2 => format!("{a}.clamp(-4.0, 4.0).{}()", self.random.pick(&["exp", "sinh", "cosh"])),
            3 => format!("({a}.abs() + 0.125).{}()", self.random.pick(&["ln", "log2"])),
            4 => format!("({a}.abs() + 0.125).log({})", self.random.pick(&["3.0", "10.0", "0.5"])),
            5 => format!("({a}.abs() + 0.125).powf({}.clamp(-3.0, 3.0))", self.float_receiver(d)),
            6 => format!("{a}.atan2({})", self.expr(&Ty::F32, d)),
            7 => format!("{a}.sin_cos().{}", self.random.below(2)),
            _ => {
                let ty = self.vector_type_of_floats();
                let Ty::Vec(lane, n) = ty else { return a };
                let v = self.vector_receiver(lane, n, d);
                match self.random.below(3) {
                    0 => format!("{v}.length_recip()"),
                    1 => format!("{v}.distance({})", self.expr(&ty, d)),
                    _ => format!("{}.to_angle()", self.vector_receiver(Lane::F, 2, d)),
                }
            }
        }
    }

    /// A vector of floats of such a function.
    pub(super) fn vector_of_angles(&mut self, n: u8, d: Want) -> String {
        let ty = Ty::Vec(Lane::F, n);
        let own = self.vector_receiver(Lane::F, n, d);
        let angle = self.expr(&Ty::F32, d);
        match (n, self.random.below(6)) {
            (_, 0) => format!("({own} + 0.0625).normalize()"),
            (_, 1) => format!("{own}.reflect(({} + 0.0625).normalize())", self.expr(&ty, d)),
            (2, 2 | 3) => format!("Vec2::from_angle({angle})"),
            (2, _) => format!("(Mat2::from_scale_angle({own}, {angle}) * {})", self.expr(&ty, d)),
            (3, 2) => format!("{own}.{}({angle})", self.random.pick(&["rotate_x", "rotate_z"])),
            (3, 3) => format!(
                "(Mat3::{}({angle}) * {own})",
                self.random.pick(&["from_rotation_x", "from_rotation_z"])
            ),
            (3, 4) => {
                let of = self.random.pick(&["Mat3", "Quat"]);
                format!("({of}::from_axis_angle(Vec3::Y, {angle}) * {own})")
            }
            (3, _) => {
                let arc = format!("Quat::from_rotation_arc(({own} + 0.0625).normalize(), Vec3::Z)");
                format!(
                    "({arc}.slerp(Quat::from_rotation_x({angle}), 0.25) * {})",
                    self.expr(&ty, d)
                )
            }
            _ => own,
        }
    }
}
