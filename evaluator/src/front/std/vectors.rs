impl Vec3 {
    fn fract(self) -> Vec3 {
        self - self.trunc()
    }

    fn normalize_or(self, fallback: Vec3) -> Vec3 {
        let scale = self.length_recip();
        if scale.is_finite() && scale > 0.0 { self * scale } else { fallback }
    }

    fn try_normalize(self) -> Option<Vec3> {
        let scale = self.length_recip();
        if scale.is_finite() && scale > 0.0 { Some(self * scale) } else { None }
    }

    fn normalize_or_zero(self) -> Vec3 {
        self.normalize_or(Vec3::ZERO)
    }

    fn normalize_and_length(self) -> (Vec3, f32) {
        let length = self.length();
        let scale = 1.0 / length;
        if scale.is_finite() && scale > 0.0 { (self * scale, length) } else { (Vec3::X, 0.0) }
    }

    fn is_normalized(self) -> bool {
        (self.length_squared() - 1.0).abs() <= 2e-4
    }

    fn project_onto(self, other: Vec3) -> Vec3 {
        let squared = other.dot(other);
        other * (self.dot(other) / squared)
    }

    fn project_onto_normalized(self, other: Vec3) -> Vec3 {
        other * self.dot(other)
    }

    fn reject_from(self, other: Vec3) -> Vec3 {
        self - self.project_onto(other)
    }

    fn reject_from_normalized(self, other: Vec3) -> Vec3 {
        self - self.project_onto_normalized(other)
    }

    fn clamp_length(self, min: f32, max: f32) -> Vec3 {
        let squared = self.length_squared();
        if squared < min * min {
            min * (self / squared.sqrt())
        } else if squared > max * max {
            max * (self / squared.sqrt())
        } else {
            self
        }
    }

    fn clamp_length_max(self, max: f32) -> Vec3 {
        let squared = self.length_squared();
        if squared > max * max { max * (self / squared.sqrt()) } else { self }
    }

    fn clamp_length_min(self, min: f32) -> Vec3 {
        let squared = self.length_squared();
        if squared < min * min { min * (self / squared.sqrt()) } else { self }
    }

    fn move_towards(self, target: Vec3, distance: f32) -> Vec3 {
        let away = target - self;
        let length = away.length();
        if length <= distance || length <= 1e-4 { target } else { self + away / length * distance }
    }

    fn midpoint(self, other: Vec3) -> Vec3 {
        (self + other) * 0.5
    }

    fn refract(self, normal: Vec3, eta: f32) -> Vec3 {
        let cosine = normal.dot(self);
        let k = 1.0 - eta * eta * (1.0 - cosine * cosine);
        if k >= 0.0 { eta * self - (eta * cosine + k.sqrt()) * normal } else { Vec3::ZERO }
    }

    fn fract_gl(self) -> Vec3 {
        self - self.floor()
    }

    fn saturate(self) -> Vec3 {
        self.clamp(Vec3::ZERO, Vec3::ONE)
    }

    fn abs_diff_eq(self, other: Vec3, most: f32) -> bool {
        (self - other).abs().cmple(Vec3::splat(most)).all()
    }

    fn step(self, other: Vec3) -> Vec3 {
        Vec3::select(other.cmplt(self), Vec3::ZERO, Vec3::ONE)
    }

    fn smoothstep(self, low: Vec3, high: Vec3) -> Vec3 {
        let t = ((self - low) / (high - low)).saturate();
        t * t * (Vec3::splat(3.0) - Vec3::splat(2.0) * t)
    }

    fn lerp_monotonic(self, other: Vec3, s: f32) -> Vec3 {
        self + (other - self) * s
    }
}
