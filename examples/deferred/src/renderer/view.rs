//! Camera and light at one time. Normals, rays and the light's direction are in the space of the camera.

use crate::Size;
use crate::scene::{GROUND_LIGHT, SKY_LIGHT, SUN, SUN_LIGHT};
use glam::camera::rh::proj::directx::perspective_infinite_reverse;
use glam::camera::rh::view::look_at_mat4;
use glam::{Mat4, Vec2, Vec3, vec2, vec3};
use straightline_sraa::Projection;

/// Vertical field of view, in radians.
const FOV: f32 = 0.75;

/// Size of the uniforms of `scene.wgsl`, in bytes.
pub const UNIFORMS: usize = 272;

pub struct View {
    size: Vec2,
    /// World space to the space of the camera.
    camera: Mat4,
    /// Model space to world space: the turntable.
    turn: Mat4,
}

impl View {
    /// Creates the view for a picture of `size` at `time` seconds.
    pub fn new(size: Size, time: f32) -> View {
        let distance = 5.4 + 1.0 * (0.4 * time).sin();
        let eye = vec3(0.0, 0.45, 1.0).normalize() * distance;
        View {
            size: Vec2::from(size.map(|side| side as f32)),
            camera: look_at_mat4(eye, vec3(0.0, -0.4, 0.0), Vec3::Y),
            turn: Mat4::from_rotation_y(0.5 * time),
        }
    }

    /// Direction towards the sun.
    fn sun(&self) -> Vec3 {
        self.camera.transform_vector3(SUN)
    }

    /// Rays to depth 1: through the picture's upper left corner, and the steps from there by a pixel to the right and down.
    fn rays(&self) -> [Vec3; 3] {
        let extent = (0.5 * FOV).tan() * vec2(self.size.x / self.size.y, 1.0);
        let step = 2.0 * extent / self.size;
        [vec3(-extent.x, extent.y, -1.0), vec3(step.x, 0.0, 0.0), vec3(0.0, -step.y, 0.0)]
    }

    /// Projection of the camera: reversed, without a far plane.
    pub fn projection(&self) -> Projection {
        let matrix = perspective_infinite_reverse(FOV, self.size.x / self.size.y, 0.1);
        Projection::from_matrix(matrix.to_cols_array_2d()).expect("a projection")
    }

    /// Uniforms of `scene.wgsl` for a projection matrix. `share` is the weight of a frame in the mean of a reference.
    pub fn uniforms(&self, projection: [[f32; 4]; 4], share: f32) -> [f32; UNIFORMS / 4] {
        let to_view = self.camera * self.turn;
        let to_clip = Mat4::from_cols_array_2d(&projection) * to_view;
        let [corner, right, down] = self.rays();
        let up = self.camera.transform_vector3(Vec3::Y);
        let directions = [corner, right, down, self.sun(), up].map(|v| v.extend(0.0).to_array());
        let light = [SUN_LIGHT, GROUND_LIGHT, SKY_LIGHT].map(|v| v.extend(0.0).to_array());
        let matrices = [to_clip, to_view].map(|m| m.to_cols_array());
        let all = [matrices.as_flattened(), directions.as_flattened(), light.as_flattened(), &[share, 0.0, 0.0, 0.0]]
            .concat();
        all.try_into().expect("the uniforms have the size of the structure in scene.wgsl")
    }
}
