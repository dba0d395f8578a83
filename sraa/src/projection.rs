//! Everything that the filter knows of the camera, from its projection matrix.

use crate::Error;

/// Far plane in place of one at infinity: a cleared depth buffer is then this far away.
const ENDLESS: f32 = 1.0e25;

/// Projection of the camera, from the matrix that projects vertices.
///
/// The matrix takes the camera's space, of either handedness, to the clip space of WebGPU: y up, depth from 0 to 1. Depth may
/// be reversed, with or without a far plane, and the frustum may be off-centre. Columns first, as glam's `to_cols_array_2d`
/// gives them.
///
/// ```
/// use glam::camera::rh::proj::directx::perspective_infinite_reverse;
/// use straightline_sraa::Projection;
///
/// let matrix = perspective_infinite_reverse(0.8, 16.0 / 9.0, 0.1);
/// let projection = Projection::from_matrix(matrix.to_cols_array_2d())?;
/// assert!(projection.is_reversed());
/// assert_eq!(projection.clear_depth(), 0.0);
/// # Ok::<(), straightline_sraa::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    matrix: [[f32; 4]; 4],
    is_parallel: bool,
    is_reversed: bool,
    near: f32,
    far: f32,
    /// Sign of z in front of the camera.
    forward: f32,
}

impl Projection {
    /// Reads a projection matrix.
    ///
    /// # Errors
    ///
    /// [`Error::Projection`] for a matrix that is not a projection to WebGPU's clip space.
    pub fn from_matrix(matrix: [[f32; 4]; 4]) -> Result<Self, Error> {
        let refused = |why| Err(Error::Projection(why));
        if !matrix.as_flattened().iter().all(|number| number.is_finite()) {
            return refused("has a number that is not finite");
        }
        let [x, y, z, w] = matrix;
        if x[3] != 0.0 || y[3] != 0.0 || (z[3] == 0.0) == (w[3] == 0.0) {
            return refused("is that of no camera: its last row must be (0, 0, ±1, 0) or (0, 0, 0, 1)");
        }
        if x[2] != 0.0 || y[2] != 0.0 {
            return refused("has depth that depends on x or y, as for an oblique near plane");
        }
        if (x[0] * y[1] - y[0] * x[1]) == 0.0 {
            return refused("projects everything to one line");
        }
        let is_parallel = z[3] == 0.0;
        // Depth in the buffer, as a function of the depth in scene units: `ends` are where it is 0 and 1.
        let (forward, ends) = if is_parallel {
            let ends = [-w[2] / z[2], (w[3] - w[2]) / z[2]];
            // Most of what is seen lies in front.
            let forward = if ends[0] + ends[1] > 0.0 { 1.0 } else { -1.0 };
            (forward, ends.map(|end| end * forward))
        } else {
            let (slope, shift) = (z[2] / z[3], w[2] / z[3].abs());
            (z[3].signum(), [-shift / slope, shift / (1.0 - slope)])
        };
        // A far plane that is beyond infinity by rounding is at infinity.
        let ends = ends.map(|end| {
            if is_parallel || (end > 0.0 && end < ENDLESS) {
                end
            } else {
                ENDLESS
            }
        });
        let [near, far] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        if !(near.is_finite() && far.is_finite() && near < far) {
            return refused("has no depth: near and far plane are one");
        }
        if !is_parallel && near >= ENDLESS {
            return refused("has no near plane in front of the camera");
        }
        Ok(Projection {
            matrix,
            is_parallel,
            is_reversed: ends[0] > ends[1],
            near,
            far,
            forward,
        })
    }

    /// The matrix, columns first.
    pub fn matrix(&self) -> [[f32; 4]; 4] {
        self.matrix
    }

    /// Returns whether the camera has no perspective.
    pub fn is_parallel(&self) -> bool {
        self.is_parallel
    }

    /// Returns whether nearer surfaces have a greater depth.
    pub fn is_reversed(&self) -> bool {
        self.is_reversed
    }

    /// Depth of the far plane: the value that a depth buffer is cleared to.
    pub fn clear_depth(&self) -> f32 {
        if self.is_reversed { 0.0 } else { 1.0 }
    }

    /// Distances of the near and the far plane in scene units. A far plane at infinity is at 1e25.
    pub fn planes(&self) -> [f32; 2] {
        [self.near, self.far]
    }

    /// The matrix for a sample at `offset` from the pixel's centre, in pixels, y down, of a picture of `size`.
    pub fn matrix_at(&self, offset: [f32; 2], size: [u32; 2]) -> [[f32; 4]; 4] {
        // To sample right of the centre, move everything left.
        let [x, y] = [-offset[0] * 2.0 / size[0] as f32, offset[1] * 2.0 / size[1] as f32];
        self.matrix.map(|[cx, cy, cz, cw]| [cx + x * cw, cy + y * cw, cz, cw])
    }

    /// Height of what is seen, without perspective; with it, at linear depth 1. In scene units.
    pub(crate) fn height(&self) -> f32 {
        let [_, _, [x, y, _]] = self.rays([1, 1]);
        x.hypot(y)
    }

    /// Rays to linear depth 1 in the camera's space: through the upper left corner of the picture, and the steps by a pixel to the
    /// right and down. Without perspective, the corner is the point at depth 0.
    pub(crate) fn rays(&self, size: [u32; 2]) -> [[f32; 3]; 3] {
        let [x, y, z, w] = self.matrix;
        let depth = if self.is_parallel { 0.0 } else { self.forward };
        let scale = if self.is_parallel { w[3] } else { z[3].abs() };
        let determinant = x[0] * y[1] - y[0] * x[1];
        // The point of the plane that is projected there, less the part of the other columns.
        let solve = |a: f32, b: f32| [(a * y[1] - b * y[0]) / determinant, (b * x[0] - a * x[1]) / determinant];
        let rest = |row: usize| depth * z[row] + w[row];
        let [left, top] = solve(-scale - rest(0), scale - rest(1));
        let right = solve(2.0 * scale / size[0] as f32, 0.0);
        let down = solve(0.0, -2.0 * scale / size[1] as f32);
        [[left, top, depth], [right[0], right[1], 0.0], [down[0], down[1], 0.0]]
    }

    /// The vector along each ray from linear depth 0 to 1, without perspective.
    pub(crate) fn forward(&self) -> [f32; 3] {
        let [x, y, z, _] = self.matrix;
        let determinant = x[0] * y[1] - y[0] * x[1];
        let [a, b] = [-self.forward * z[0], -self.forward * z[1]];
        [
            (a * y[1] - b * y[0]) / determinant,
            (b * x[0] - a * x[1]) / determinant,
            self.forward,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::camera::{lh, rh};
    use glam::{Mat4, Vec3, Vec4, vec3};

    fn read(matrix: Mat4) -> Projection {
        Projection::from_matrix(matrix.to_cols_array_2d()).expect("a projection")
    }

    fn assert_near(a: f32, b: f32) {
        assert!((a - b).abs() <= 1e-4 * b.abs().max(1.0), "{a} is not {b}");
    }

    /// A ray through a pixel meets the points that the matrix projects there.
    fn assert_rays(matrix: Mat4) {
        let (projection, size) = (read(matrix), [8, 4]);
        let rays = projection.rays(size).map(Vec3::from);
        for (column, row) in [(0.0, 0.0), (3.5, 1.5), (8.0, 4.0)] {
            let ray = rays[0] + column * rays[1] + row * rays[2];
            for depth in [1.0, 2.5] {
                let point = match projection.is_parallel() {
                    true => ray + depth * Vec3::from(projection.forward()),
                    false => ray * depth,
                };
                let Vec4 { x, y, w, .. } = matrix * point.extend(1.0);
                assert_near(0.5 + 0.5 * x / w, column / 8.0);
                assert_near(0.5 - 0.5 * y / w, row / 4.0);
            }
        }
    }

    #[test]
    fn planes_and_directions_follow_from_the_matrix() {
        use rh::proj::directx as d;
        let all = [
            (d::perspective(0.8, 1.5, 0.1, 100.0), false, [0.1, 100.0]),
            (
                lh::proj::directx::perspective(0.8, 1.5, 0.1, 100.0),
                false,
                [0.1, 100.0],
            ),
            (d::perspective_infinite(0.8, 1.5, 0.1), false, [0.1, ENDLESS]),
            (d::perspective_infinite_reverse(0.8, 1.5, 0.1), true, [0.1, ENDLESS]),
            (d::perspective(0.8, 1.5, 100.0, 0.1), true, [0.1, 100.0]),
            (d::frustum(-0.1, 0.3, -0.2, 0.1, 0.1, 50.0), false, [0.1, 50.0]),
        ];
        for (matrix, is_reversed, planes) in all {
            let projection = read(matrix);
            assert!(!projection.is_parallel());
            assert_eq!(projection.is_reversed(), is_reversed, "{matrix}");
            for (found, expected) in projection.planes().into_iter().zip(planes) {
                assert!(
                    (found / expected - 1.0).abs() < 1e-3,
                    "{found} is not {expected}: {matrix}"
                );
            }
            assert_rays(matrix);
        }
    }

    #[test]
    fn cameras_without_perspective_are_recognised() {
        let all = [
            (rh::proj::directx::orthographic(-3.0, 5.0, -1.0, 2.0, 0.5, 20.0), false),
            (lh::proj::directx::orthographic(-3.0, 5.0, -1.0, 2.0, 0.5, 20.0), false),
            (rh::proj::directx::orthographic(-3.0, 5.0, -1.0, 2.0, 20.0, 0.5), true),
        ];
        for (matrix, is_reversed) in all {
            let projection = read(matrix);
            assert!(projection.is_parallel());
            assert_eq!(projection.is_reversed(), is_reversed);
            let [near, far] = projection.planes();
            assert_near(near, 0.5);
            assert_near(far, 20.0);
            assert_near(projection.height(), 3.0);
            assert_rays(matrix);
        }
    }

    #[test]
    fn a_shifted_matrix_moves_the_picture_the_other_way() {
        let matrix = rh::proj::directx::perspective(0.8, 1.5, 0.1, 100.0);
        let shifted = Mat4::from_cols_array_2d(&read(matrix).matrix_at([0.25, -0.5], [8, 4]));
        let point = vec3(0.3, 0.2, -2.0).extend(1.0);
        let [before, after] = [matrix, shifted].map(|m| m * point).map(|clip| clip / clip.w);
        assert_near(after.x - before.x, -0.25 * 2.0 / 8.0);
        assert_near(after.y - before.y, -0.5 * 2.0 / 4.0);
        assert_near(after.z, before.z);
    }

    #[test]
    fn matrices_of_no_camera_are_refused() {
        let said = |matrix: Mat4| {
            let refused = Projection::from_matrix(matrix.to_cols_array_2d());
            refused.expect_err("a refusal").to_string()
        };
        let good = rh::proj::directx::perspective(0.8, 1.5, 0.1, 100.0);
        assert!(said(Mat4::ZERO).contains("its last row must be"));
        assert!(said(good * f32::NAN).contains("not finite"));
        assert!(said(good * Mat4::from_scale(vec3(0.0, 1.0, 1.0))).contains("one line"));
        assert!(said(good * Mat4::from_rotation_y(0.3)).contains("last row"));
        assert!(said(Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::ZERO, Vec4::W)).contains("near and far"));
    }
}
