#[derive(Clone, Copy, PartialEq)]
struct Quat {
    x: f32,
    y: f32,
    z: f32,
    w: f32,
}

impl Quat {
    const IDENTITY: Quat = Quat { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };

    const NAN: Quat = Quat { x: f32::NAN, y: f32::NAN, z: f32::NAN, w: f32::NAN };

    fn default() -> Quat {
        Quat::IDENTITY
    }

    fn from_xyzw(x: f32, y: f32, z: f32, w: f32) -> Quat {
        Quat { x, y, z, w }
    }

    fn from_array(a: [f32; 4]) -> Quat {
        Quat::from_xyzw(a[0], a[1], a[2], a[3])
    }

    fn from_vec4(v: Vec4) -> Quat {
        Quat::from_xyzw(v.x, v.y, v.z, v.w)
    }

    fn from_axis_angle(axis: Vec3, angle: f32) -> Quat {
        let (sin, cos) = (angle * 0.5).sin_cos();
        let v = axis * sin;
        Quat::from_xyzw(v.x, v.y, v.z, cos)
    }

    fn from_scaled_axis(v: Vec3) -> Quat {
        let length = v.length();
        if length == 0.0 { Quat::IDENTITY } else { Quat::from_axis_angle(v / length, length) }
    }

    fn from_rotation_x(angle: f32) -> Quat {
        let (sin, cos) = (angle * 0.5).sin_cos();
        Quat::from_xyzw(sin, 0.0, 0.0, cos)
    }

    fn from_rotation_y(angle: f32) -> Quat {
        let (sin, cos) = (angle * 0.5).sin_cos();
        Quat::from_xyzw(0.0, sin, 0.0, cos)
    }

    fn from_rotation_z(angle: f32) -> Quat {
        let (sin, cos) = (angle * 0.5).sin_cos();
        Quat::from_xyzw(0.0, 0.0, sin, cos)
    }

    fn from_rotation_arc(from: Vec3, to: Vec3) -> Quat {
        let limit = 1.0 - 2.0 * f32::EPSILON;
        let dot = from.dot(to);
        if dot > limit {
            Quat::IDENTITY
        } else if dot < -limit {
            Quat::from_axis_angle(from.any_orthonormal_vector(), std::f32::consts::PI)
        } else {
            let c = from.cross(to);
            Quat::from_xyzw(c.x, c.y, c.z, 1.0 + dot).normalize()
        }
    }

    fn from_rotation_axes(x: Vec3, y: Vec3, z: Vec3) -> Quat {
        if z.z <= 0.0 {
            let (difference, rest) = (y.y - x.x, 1.0 - z.z);
            if difference <= 0.0 {
                let square = rest - difference;
                let scale = 0.5 / square.sqrt();
                Quat::from_xyzw(square * scale, (x.y + y.x) * scale, (x.z + z.x) * scale, (y.z - z.y) * scale)
            } else {
                let square = rest + difference;
                let scale = 0.5 / square.sqrt();
                Quat::from_xyzw((x.y + y.x) * scale, square * scale, (y.z + z.y) * scale, (z.x - x.z) * scale)
            }
        } else {
            let (sum, rest) = (y.y + x.x, 1.0 + z.z);
            if sum <= 0.0 {
                let square = rest - sum;
                let scale = 0.5 / square.sqrt();
                Quat::from_xyzw((x.z + z.x) * scale, (y.z + z.y) * scale, square * scale, (x.y - y.x) * scale)
            } else {
                let square = rest + sum;
                let scale = 0.5 / square.sqrt();
                Quat::from_xyzw((y.z - z.y) * scale, (z.x - x.z) * scale, (x.y - y.x) * scale, square * scale)
            }
        }
    }

    fn from_mat3(m: &Mat3) -> Quat {
        Quat::from_rotation_axes(m.x_axis, m.y_axis, m.z_axis)
    }

    fn from_mat4(m: &Mat4) -> Quat {
        Quat::from_rotation_axes(m.x_axis.truncate(), m.y_axis.truncate(), m.z_axis.truncate())
    }

    fn to_vec4(self) -> Vec4 {
        vec4(self.x, self.y, self.z, self.w)
    }

    fn to_array(&self) -> [f32; 4] {
        [self.x, self.y, self.z, self.w]
    }

    fn xyz(self) -> Vec3 {
        vec3(self.x, self.y, self.z)
    }

    fn to_axis_angle(self) -> (Vec3, f32) {
        let v = self.xyz();
        let length = v.length();
        if length >= 1.0e-8 { (v / length, 2.0 * length.atan2(self.w)) } else { (Vec3::X, 0.0) }
    }

    fn to_scaled_axis(self) -> Vec3 {
        let (axis, angle) = self.to_axis_angle();
        axis * angle
    }

    fn conjugate(self) -> Quat {
        Quat::from_xyzw(-self.x, -self.y, -self.z, self.w)
    }

    fn inverse(self) -> Quat {
        self.conjugate()
    }

    fn dot(self, other: Quat) -> f32 {
        self.to_vec4().dot(other.to_vec4())
    }

    fn length(self) -> f32 {
        self.to_vec4().length()
    }

    fn length_squared(self) -> f32 {
        self.to_vec4().length_squared()
    }

    fn length_recip(self) -> f32 {
        self.to_vec4().length_recip()
    }

    fn normalize(self) -> Quat {
        Quat::from_vec4(self.to_vec4().normalize())
    }

    fn is_finite(self) -> bool {
        self.to_vec4().is_finite()
    }

    fn is_nan(self) -> bool {
        self.to_vec4().is_nan()
    }

    fn is_normalized(self) -> bool {
        self.to_vec4().is_normalized()
    }

    fn abs_diff_eq(self, other: Quat, most: f32) -> bool {
        self.to_vec4().abs_diff_eq(other.to_vec4(), most)
    }

    fn is_near_identity(self) -> bool {
        acos_approx(self.w.abs()) * 2.0 < 0.002_847_144_6
    }

    fn angle_between(self, other: Quat) -> f32 {
        acos_approx(self.dot(other).abs()) * 2.0
    }

    fn mul_quat(self, other: Quat) -> Quat {
        let (a, b) = (self, other);
        Quat::from_xyzw(
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
            a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
        )
    }

    fn mul_vec3(self, v: Vec3) -> Vec3 {
        let b = self.xyz();
        let squared = b.dot(b);
        v * (self.w * self.w - squared) + b * (v.dot(b) * 2.0) + b.cross(v) * (self.w * 2.0)
    }

    fn lerp(self, end: Quat, s: f32) -> Quat {
        let bias = if self.dot(end) >= 0.0 { 1.0 } else { -1.0 };
        (self * (1.0 - s) + end * bias * s).normalize()
    }

    fn slerp(self, end: Quat, s: f32) -> Quat {
        let signed = self.dot(end);
        let turned = if signed < 0.0 { -end } else { end };
        let dot = if signed < 0.0 { -signed } else { signed };
        if dot > 1.0 - f32::EPSILON {
            (self * (1.0 - s) + turned * s).normalize()
        } else {
            let theta = acos_approx(dot);
            let first = (theta * (1.0 - s)).sin();
            let second = (theta * s).sin();
            (self * first + turned * second) * (1.0 / theta.sin())
        }
    }
}

impl Mul for Quat {
    type Output = Quat;
    fn mul(self, other: Quat) -> Quat {
        self.mul_quat(other)
    }
}

impl Mul<Vec3> for Quat {
    type Output = Vec3;
    fn mul(self, v: Vec3) -> Vec3 {
        self.mul_vec3(v)
    }
}

impl Mul<f32> for Quat {
    type Output = Quat;
    fn mul(self, x: f32) -> Quat {
        Quat::from_vec4(self.to_vec4() * x)
    }
}

impl Div<f32> for Quat {
    type Output = Quat;
    fn div(self, x: f32) -> Quat {
        Quat::from_vec4(self.to_vec4() / x)
    }
}

impl Add for Quat {
    type Output = Quat;
    fn add(self, other: Quat) -> Quat {
        Quat::from_vec4(self.to_vec4() + other.to_vec4())
    }
}

impl Sub for Quat {
    type Output = Quat;
    fn sub(self, other: Quat) -> Quat {
        Quat::from_vec4(self.to_vec4() - other.to_vec4())
    }
}

impl Neg for Quat {
    type Output = Quat;
    fn neg(self) -> Quat {
        self * -1.0
    }
}

impl Vec3 {
    fn rotate_axis(self, axis: Vec3, angle: f32) -> Vec3 {
        Quat::from_axis_angle(axis, angle) * self
    }
}

impl Mat3 {
    fn from_quat(q: Quat) -> Mat3 {
        let (x2, y2, z2) = (q.x + q.x, q.y + q.y, q.z + q.z);
        let (xx, xy, xz) = (q.x * x2, q.x * y2, q.x * z2);
        let (yy, yz, zz) = (q.y * y2, q.y * z2, q.z * z2);
        let (wx, wy, wz) = (q.w * x2, q.w * y2, q.w * z2);
        Mat3::from_cols(
            vec3(1.0 - (yy + zz), xy + wz, xz - wy),
            vec3(xy - wz, 1.0 - (xx + zz), yz + wx),
            vec3(xz + wy, yz - wx, 1.0 - (xx + yy)),
        )
    }
}

impl Mat4 {
    fn from_quat(q: Quat) -> Mat4 {
        Mat4::from_mat3(Mat3::from_quat(q))
    }

    fn from_rotation_translation(q: Quat, translation: Vec3) -> Mat4 {
        Mat4::from_mat3_translation(Mat3::from_quat(q), translation)
    }

    fn from_scale_rotation_translation(scale: Vec3, q: Quat, translation: Vec3) -> Mat4 {
        let m = Mat3::from_quat(q);
        let columns = Mat3::from_cols(m.x_axis * scale.x, m.y_axis * scale.y, m.z_axis * scale.z);
        Mat4::from_mat3_translation(columns, translation)
    }
}
