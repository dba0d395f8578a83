impl Vec2 {
    fn from_angle(angle: f32) -> Vec2 {
        vec2(angle.cos(), angle.sin())
    }

    fn to_angle(self) -> f32 {
        self.y.atan2(self.x)
    }

    fn rotate(self, other: Vec2) -> Vec2 {
        vec2(self.x * other.x - self.y * other.y, self.y * other.x + self.x * other.y)
    }

    fn perp_dot(self, other: Vec2) -> f32 {
        (self.x * other.y) - (self.y * other.x)
    }

    fn angle_to(self, other: Vec2) -> f32 {
        let angle = acos_approx(self.dot(other) / (self.length_squared() * other.length_squared()).sqrt());
        angle * 1.0_f32.copysign(self.perp_dot(other))
    }
}

impl Vec3 {
    fn angle_between(self, other: Vec3) -> f32 {
        acos_approx(self.dot(other) / (self.length_squared() * other.length_squared()).sqrt())
    }

    fn with_xy(self, xy: Vec2) -> Vec3 {
        xy.extend(self.z)
    }

    fn with_yz(self, yz: Vec2) -> Vec3 {
        vec3(self.x, yz.x, yz.y)
    }

    fn rotate_x(self, angle: f32) -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        vec3(self.x, self.y * cos - self.z * sin, self.y * sin + self.z * cos)
    }

    fn rotate_y(self, angle: f32) -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        vec3(self.x * cos + self.z * sin, self.y, self.x * -sin + self.z * cos)
    }

    fn rotate_z(self, angle: f32) -> Vec3 {
        let (sin, cos) = angle.sin_cos();
        vec3(self.x * cos - self.y * sin, self.x * sin + self.y * cos, self.z)
    }

    fn any_orthogonal_vector(self) -> Vec3 {
        if self.x.abs() > self.y.abs() { vec3(-self.z, 0.0, self.x) } else { vec3(0.0, self.z, -self.y) }
    }

    fn any_orthonormal_vector(self) -> Vec3 {
        let sign = 1.0_f32.copysign(self.z);
        let a = -1.0 / (sign + self.z);
        let b = self.x * self.y * a;
        vec3(b, sign + self.y * self.y * a, -self.y)
    }

    fn any_orthonormal_pair(self) -> (Vec3, Vec3) {
        let sign = 1.0_f32.copysign(self.z);
        let a = -1.0 / (sign + self.z);
        let b = self.x * self.y * a;
        (
            vec3(1.0 + sign * self.x * self.x * a, sign * b, -sign * self.x),
            vec3(b, sign + self.y * self.y * a, -self.y),
        )
    }
}

impl Vec4 {
    fn with_xy(self, xy: Vec2) -> Vec4 {
        vec4(xy.x, xy.y, self.z, self.w)
    }

    fn with_zw(self, zw: Vec2) -> Vec4 {
        vec4(self.x, self.y, zw.x, zw.y)
    }

    fn with_xyz(self, xyz: Vec3) -> Vec4 {
        xyz.extend(self.w)
    }
}

impl Mat2 {
    fn from_angle(angle: f32) -> Mat2 {
        let (sin, cos) = angle.sin_cos();
        Mat2::from_cols(vec2(cos, sin), vec2(-sin, cos))
    }

    fn from_scale_angle(scale: Vec2, angle: f32) -> Mat2 {
        let (sin, cos) = angle.sin_cos();
        Mat2::from_cols(vec2(cos * scale.x, sin * scale.x), vec2(-sin * scale.y, cos * scale.y))
    }

    fn from_mat3(m: Mat3) -> Mat2 {
        Mat2::from_cols(m.x_axis.xy(), m.y_axis.xy())
    }

    fn determinant(&self) -> f32 {
        self.x_axis.x * self.y_axis.y - self.x_axis.y * self.y_axis.x
    }

    fn inverse(&self) -> Mat2 {
        let scale = 1.0 / self.determinant();
        Mat2::from_cols(
            vec2(self.y_axis.y * scale, self.x_axis.y * -scale),
            vec2(self.y_axis.x * -scale, self.x_axis.x * scale),
        )
    }
}

impl Mat3 {
    fn from_angle(angle: f32) -> Mat3 {
        let (sin, cos) = angle.sin_cos();
        Mat3::from_cols(vec3(cos, sin, 0.0), vec3(-sin, cos, 0.0), Vec3::Z)
    }

    fn from_axis_angle(axis: Vec3, angle: f32) -> Mat3 {
        let (sin, cos) = angle.sin_cos();
        let (of_sin, square) = (axis * sin, axis * axis);
        let omc = 1.0 - cos;
        let xy = axis.x * axis.y * omc;
        let xz = axis.x * axis.z * omc;
        let yz = axis.y * axis.z * omc;
        Mat3::from_cols(
            vec3(square.x * omc + cos, xy + of_sin.z, xz - of_sin.y),
            vec3(xy - of_sin.z, square.y * omc + cos, yz + of_sin.x),
            vec3(xz + of_sin.y, yz - of_sin.x, square.z * omc + cos),
        )
    }

    fn from_scale(scale: Vec2) -> Mat3 {
        Mat3::from_cols(vec3(scale.x, 0.0, 0.0), vec3(0.0, scale.y, 0.0), Vec3::Z)
    }

    fn from_translation(translation: Vec2) -> Mat3 {
        Mat3::from_cols(Vec3::X, Vec3::Y, translation.extend(1.0))
    }

    fn from_rotation_x(angle: f32) -> Mat3 {
        let (sin, cos) = angle.sin_cos();
        Mat3::from_cols(Vec3::X, vec3(0.0, cos, sin), vec3(0.0, -sin, cos))
    }

    fn from_rotation_y(angle: f32) -> Mat3 {
        let (sin, cos) = angle.sin_cos();
        Mat3::from_cols(vec3(cos, 0.0, -sin), Vec3::Y, vec3(sin, 0.0, cos))
    }

    fn from_rotation_z(angle: f32) -> Mat3 {
        let (sin, cos) = angle.sin_cos();
        Mat3::from_cols(vec3(cos, sin, 0.0), vec3(-sin, cos, 0.0), Vec3::Z)
    }

    fn from_mat2(m: Mat2) -> Mat3 {
        Mat3::from_cols(m.x_axis.extend(0.0), m.y_axis.extend(0.0), Vec3::Z)
    }

    fn from_mat4(m: Mat4) -> Mat3 {
        Mat3::from_cols(m.x_axis.xyz(), m.y_axis.xyz(), m.z_axis.xyz())
    }

    fn determinant(&self) -> f32 {
        self.x_axis.dot(self.y_axis.cross(self.z_axis))
    }

    fn inverse(&self) -> Mat3 {
        let x = self.y_axis.cross(self.z_axis);
        let y = self.z_axis.cross(self.x_axis);
        let z = self.x_axis.cross(self.y_axis);
        let scale = 1.0 / self.x_axis.dot(x);
        Mat3::from_cols(x * scale, y * scale, z * scale).transpose()
    }
}

impl Mat4 {
    fn from_translation(t: Vec3) -> Mat4 {
        Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::Z, t.extend(1.0))
    }

    fn from_scale(s: Vec3) -> Mat4 {
        Mat4::from_cols(
            vec4(s.x, 0.0, 0.0, 0.0),
            vec4(0.0, s.y, 0.0, 0.0),
            vec4(0.0, 0.0, s.z, 0.0),
            Vec4::W,
        )
    }

    fn from_mat3(m: Mat3) -> Mat4 {
        Mat4::from_cols(m.x_axis.extend(0.0), m.y_axis.extend(0.0), m.z_axis.extend(0.0), Vec4::W)
    }

    fn project_point3(&self, point: Vec3) -> Vec3 {
        let whole = self.w_axis + (self.z_axis * point.z + (self.y_axis * point.y + self.x_axis * point.x));
        (whole / whole.w).xyz()
    }

    fn determinant(&self) -> f32 {
        let [m00, m01, m02, m03] = self.x_axis.to_array();
        let [m10, m11, m12, m13] = self.y_axis.to_array();
        let [m20, m21, m22, m23] = self.z_axis.to_array();
        let [m30, m31, m32, m33] = self.w_axis.to_array();
        let a2323 = m22 * m33 - m23 * m32;
        let a1323 = m21 * m33 - m23 * m31;
        let a1223 = m21 * m32 - m22 * m31;
        let a0323 = m20 * m33 - m23 * m30;
        let a0223 = m20 * m32 - m22 * m30;
        let a0123 = m20 * m31 - m21 * m30;
        m00 * (m11 * a2323 - m12 * a1323 + m13 * a1223) - m01 * (m10 * a2323 - m12 * a0323 + m13 * a0223)
            + m02 * (m10 * a1323 - m11 * a0323 + m13 * a0123)
            - m03 * (m10 * a1223 - m11 * a0223 + m12 * a0123)
    }

    fn inverse(&self) -> Mat4 {
        let [m00, m01, m02, m03] = self.x_axis.to_array();
        let [m10, m11, m12, m13] = self.y_axis.to_array();
        let [m20, m21, m22, m23] = self.z_axis.to_array();
        let [m30, m31, m32, m33] = self.w_axis.to_array();
        let coef00 = m22 * m33 - m32 * m23;
        let coef02 = m12 * m33 - m32 * m13;
        let coef03 = m12 * m23 - m22 * m13;
        let coef04 = m21 * m33 - m31 * m23;
        let coef06 = m11 * m33 - m31 * m13;
        let coef07 = m11 * m23 - m21 * m13;
        let coef08 = m21 * m32 - m31 * m22;
        let coef10 = m11 * m32 - m31 * m12;
        let coef11 = m11 * m22 - m21 * m12;
        let coef12 = m20 * m33 - m30 * m23;
        let coef14 = m10 * m33 - m30 * m13;
        let coef15 = m10 * m23 - m20 * m13;
        let coef16 = m20 * m32 - m30 * m22;
        let coef18 = m10 * m32 - m30 * m12;
        let coef19 = m10 * m22 - m20 * m12;
        let coef20 = m20 * m31 - m30 * m21;
        let coef22 = m10 * m31 - m30 * m11;
        let coef23 = m10 * m21 - m20 * m11;
        let fac0 = vec4(coef00, coef00, coef02, coef03);
        let fac1 = vec4(coef04, coef04, coef06, coef07);
        let fac2 = vec4(coef08, coef08, coef10, coef11);
        let fac3 = vec4(coef12, coef12, coef14, coef15);
        let fac4 = vec4(coef16, coef16, coef18, coef19);
        let fac5 = vec4(coef20, coef20, coef22, coef23);
        let row0 = vec4(m10, m00, m00, m00);
        let row1 = vec4(m11, m01, m01, m01);
        let row2 = vec4(m12, m02, m02, m02);
        let row3 = vec4(m13, m03, m03, m03);
        let even = vec4(1.0, -1.0, 1.0, -1.0);
        let odd = vec4(-1.0, 1.0, -1.0, 1.0);
        let x = (row1 * fac0 - row2 * fac1 + row3 * fac2) * even;
        let y = (row0 * fac0 - row2 * fac3 + row3 * fac4) * odd;
        let z = (row0 * fac1 - row1 * fac3 + row3 * fac5) * even;
        let w = (row0 * fac2 - row1 * fac4 + row2 * fac5) * odd;
        let first = self.x_axis * vec4(x.x, y.x, z.x, w.x);
        let scale = 1.0 / (first.x + first.y + first.z + first.w);
        Mat4::from_cols(x * scale, y * scale, z * scale, w * scale)
    }
}

impl Mat2 {
    fn from_cols_array(m: &[f32; 4]) -> Mat2 {
        Mat2::from_cols(vec2(m[0], m[1]), vec2(m[2], m[3]))
    }

    fn from_cols_array_2d(m: &[[f32; 2]; 2]) -> Mat2 {
        Mat2::from_cols(vec2(m[0][0], m[0][1]), vec2(m[1][0], m[1][1]))
    }

    fn to_cols_array(self) -> [f32; 4] {
        [self.x_axis.x, self.x_axis.y, self.y_axis.x, self.y_axis.y]
    }
}

impl Mat3 {
    fn from_cols_array(m: &[f32; 9]) -> Mat3 {
        Mat3::from_cols(vec3(m[0], m[1], m[2]), vec3(m[3], m[4], m[5]), vec3(m[6], m[7], m[8]))
    }

    fn from_cols_array_2d(m: &[[f32; 3]; 3]) -> Mat3 {
        Mat3::from_cols(vec3(m[0][0], m[0][1], m[0][2]), vec3(m[1][0], m[1][1], m[1][2]), vec3(m[2][0], m[2][1], m[2][2]))
    }

    fn to_cols_array(self) -> [f32; 9] {
        [self.x_axis.x, self.x_axis.y, self.x_axis.z, self.y_axis.x, self.y_axis.y, self.y_axis.z, self.z_axis.x, self.z_axis.y, self.z_axis.z]
    }
}

impl Mat4 {
    fn from_cols_array(m: &[f32; 16]) -> Mat4 {
        Mat4::from_cols(vec4(m[0], m[1], m[2], m[3]), vec4(m[4], m[5], m[6], m[7]), vec4(m[8], m[9], m[10], m[11]), vec4(m[12], m[13], m[14], m[15]))
    }

    fn from_cols_array_2d(m: &[[f32; 4]; 4]) -> Mat4 {
        Mat4::from_cols(vec4(m[0][0], m[0][1], m[0][2], m[0][3]), vec4(m[1][0], m[1][1], m[1][2], m[1][3]), vec4(m[2][0], m[2][1], m[2][2], m[2][3]), vec4(m[3][0], m[3][1], m[3][2], m[3][3]))
    }

    fn to_cols_array(self) -> [f32; 16] {
        [self.x_axis.x, self.x_axis.y, self.x_axis.z, self.x_axis.w, self.y_axis.x, self.y_axis.y, self.y_axis.z, self.y_axis.w, self.z_axis.x, self.z_axis.y, self.z_axis.z, self.z_axis.w, self.w_axis.x, self.w_axis.y, self.w_axis.z, self.w_axis.w]
    }
}

impl Vec3 {
    fn from_homogeneous(v: Vec4) -> Vec3 {
        v.truncate() / v.w
    }

    fn to_homogeneous(self) -> Vec4 {
        self.extend(1.0)
    }

    fn angle_to(self, other: Vec3, axis: Vec3) -> f32 {
        self.cross(other).dot(axis).atan2(self.dot(other))
    }
}

impl Mat2 {
    fn from_mat3_minor(m: Mat3, i: usize, j: usize) -> Mat2 {
        let (a, b) = match i {
            0 => (m.y_axis, m.z_axis),
            1 => (m.x_axis, m.z_axis),
            _ => (m.x_axis, m.y_axis),
        };
        match j {
            0 => Mat2::from_cols(a.yz(), b.yz()),
            1 => Mat2::from_cols(a.xz(), b.xz()),
            _ => Mat2::from_cols(a.xy(), b.xy()),
        }
    }
}

impl Mat3 {
    fn from_scale_angle_translation(scale: Vec2, angle: f32, translation: Vec2) -> Mat3 {
        let (sin, cos) = angle.sin_cos();
        Mat3::from_cols(
            vec3(cos * scale.x, sin * scale.x, 0.0),
            vec3(-sin * scale.y, cos * scale.y, 0.0),
            vec3(translation.x, translation.y, 1.0),
        )
    }

    fn transform_point2(&self, point: Vec2) -> Vec2 {
        Mat2::from_cols(self.x_axis.xy(), self.y_axis.xy()) * point + self.z_axis.xy()
    }

    fn transform_vector2(&self, vector: Vec2) -> Vec2 {
        Mat2::from_cols(self.x_axis.xy(), self.y_axis.xy()) * vector
    }
}

impl Mat4 {
    fn from_mat3_translation(m: Mat3, translation: Vec3) -> Mat4 {
        Mat4::from_cols(m.x_axis.extend(0.0), m.y_axis.extend(0.0), m.z_axis.extend(0.0), translation.extend(1.0))
    }

    fn from_rotation_x(angle: f32) -> Mat4 {
        let (sin, cos) = angle.sin_cos();
        Mat4::from_cols(Vec4::X, vec4(0.0, cos, sin, 0.0), vec4(0.0, -sin, cos, 0.0), Vec4::W)
    }

    fn from_rotation_y(angle: f32) -> Mat4 {
        let (sin, cos) = angle.sin_cos();
        Mat4::from_cols(vec4(cos, 0.0, -sin, 0.0), Vec4::Y, vec4(sin, 0.0, cos, 0.0), Vec4::W)
    }

    fn from_rotation_z(angle: f32) -> Mat4 {
        let (sin, cos) = angle.sin_cos();
        Mat4::from_cols(vec4(cos, sin, 0.0, 0.0), vec4(-sin, cos, 0.0, 0.0), Vec4::Z, Vec4::W)
    }

    fn from_axis_angle(axis: Vec3, angle: f32) -> Mat4 {
        let (sin, cos) = angle.sin_cos();
        let axis_sin = axis * sin;
        let axis_sq = axis * axis;
        let omc = 1.0 - cos;
        let xyomc = axis.x * axis.y * omc;
        let xzomc = axis.x * axis.z * omc;
        let yzomc = axis.y * axis.z * omc;
        Mat4::from_cols(
            vec4(axis_sq.x * omc + cos, xyomc + axis_sin.z, xzomc - axis_sin.y, 0.0),
            vec4(xyomc - axis_sin.z, axis_sq.y * omc + cos, yzomc + axis_sin.x, 0.0),
            vec4(xzomc + axis_sin.y, yzomc - axis_sin.x, axis_sq.z * omc + cos, 0.0),
            Vec4::W,
        )
    }
}

impl IVec2 {
    fn perp(self) -> IVec2 {
        ivec2(-self.y, self.x)
    }

    fn perp_dot(self, other: IVec2) -> i32 {
        self.x * other.y - self.y * other.x
    }

    fn rotate(self, other: IVec2) -> IVec2 {
        ivec2(self.x * other.x - self.y * other.y, self.y * other.x + self.x * other.y)
    }
}
