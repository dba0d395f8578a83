impl f32 {
    fn sin_cos(self) -> (f32, f32) {
        (self.sin(), self.cos())
    }

    fn copysign(self, sign: f32) -> f32 {
        f32::from_bits((self.to_bits() & 0x7fff_ffff) | (sign.to_bits() & 0x8000_0000))
    }

    fn fract(self) -> f32 {
        self - self.trunc()
    }

    fn round(self) -> f32 {
        let whole = self.trunc();
        if (self - whole).abs() >= 0.5 { whole + (if self < 0.0 { -1.0 } else { 1.0 }) } else { whole }
    }

    fn signum(self) -> f32 {
        if self.is_nan() { self } else { (1.0_f32).copysign(self) }
    }

    fn log(self, base: f32) -> f32 {
        self.ln() / base.ln()
    }

    fn log10(self) -> f32 {
        self.log2() * std::f32::consts::LOG10_2
    }

    fn hypot(self, other: f32) -> f32 {
        let (a, b) = (self.abs(), other.abs());
        let (large, small) = if a < b { (b, a) } else { (a, b) };
        let ratio = small / large;
        if large == 0.0 || large.is_infinite() { large } else { large * (1.0 + ratio * ratio).sqrt() }
    }

    fn is_sign_negative(self) -> bool {
        self.to_bits() >> 31 == 1
    }

    fn is_sign_positive(self) -> bool {
        self.to_bits() >> 31 == 0
    }

    fn midpoint(self, other: f32) -> f32 {
        let sum = self + other;
        if sum.is_finite() { sum * 0.5 } else { self * 0.5 + other * 0.5 }
    }

    fn is_infinite(self) -> bool {
        self.to_bits() & 0x7fff_ffff == 0x7f80_0000
    }

    fn rem_euclid(self, divisor: f32) -> f32 {
        let rest = self % divisor;
        if rest < 0.0 { rest + divisor.abs() } else { rest }
    }

    fn div_euclid(self, divisor: f32) -> f32 {
        let whole = (self / divisor).trunc();
        let below = self % divisor < 0.0;
        if below { if divisor > 0.0 { whole - 1.0 } else { whole + 1.0 } } else { whole }
    }

    fn is_subnormal(self) -> bool {
        let bits = self.to_bits() & 0x7fff_ffff;
        bits != 0 && bits < 0x0080_0000
    }

    fn is_normal(self) -> bool {
        let bits = self.to_bits() & 0x7fff_ffff;
        bits >= 0x0080_0000 && bits < 0x7f80_0000
    }

    fn next_up(self) -> f32 {
        let bits = self.to_bits();
        let size = bits & 0x7fff_ffff;
        let next = if size == 0 { 1 } else if bits == size { bits.wrapping_add(1) } else { bits.wrapping_sub(1) };
        f32::from_bits(if size > 0x7f80_0000 || bits == 0x7f80_0000 { bits } else { next })
    }

    fn next_down(self) -> f32 {
        let bits = self.to_bits();
        let size = bits & 0x7fff_ffff;
        let next = if size == 0 { 0x8000_0001 } else if bits == size { bits.wrapping_sub(1) } else { bits.wrapping_add(1) };
        f32::from_bits(if size > 0x7f80_0000 || bits == 0xff80_0000 { bits } else { next })
    }
}

fn acos_approx(v: f32) -> f32 {
    let x = v.abs();
    let rest = 1.0 - x;
    let root = (if rest < 0.0 { 0.0 } else { rest }).sqrt();
    let sum = ((((((-0.001_262_491_1 * x + 0.006_670_09) * x - 0.017_088_126) * x + 0.030_891_88) * x - 0.050_174_303)
        * x
        + 0.088_978_99)
        * x
        - 0.214_598_8)
        * x
        + 1.570_796_3;
    let angle = sum * root;
    if v >= 0.0 { angle } else { std::f32::consts::PI - angle }
}
