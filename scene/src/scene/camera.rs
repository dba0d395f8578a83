//! Camera of a scene, and its place.

use super::SKY_DEPTH;
use glam::camera::rh::{proj::directx, view::look_at_mat4};
use glam::{Mat4, UVec2, Vec2, Vec3, vec2, vec3};
use serde::{Deserialize, Serialize};

/// A camera. View space is right-handed: x right, y up, z towards the viewer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// The pinhole, in world space.
    pub position: [f32; 3],
    /// A point in the middle of the picture, in world space; not where the camera is.
    pub target: [f32; 3],
    /// A world-space vector that points upwards in the picture; not along the view direction.
    pub up: [f32; 3],
    /// Angle between the picture's upper and lower edge in radians, above 0 and below π; of no meaning with `parallel_height`.
    #[serde(default)]
    pub vertical_fov: f32,
    /// Of a parallel (orthographic) projection: the distance between the picture's upper and lower edge in scene units,
    /// above 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parallel_height: Option<f32>,
    /// Linear depth before which nothing is drawn, in scene units, above 0.
    pub near: f32,
}

/// Heights of the picture from the near plane to the far one of a parallel projection.
const FAR: f32 = 1000.0;

impl Camera {
    /// World space to view space: a rotation and a shift.
    pub fn view(&self) -> Mat4 {
        look_at_mat4(self.position.into(), self.target.into(), self.up.into())
    }

    /// View space to clip space of a picture of `size` pixels sampled `offset` pixels (x right, y down) from each
    /// pixel's centre. z/w is 1 at `near` and falls to 0 at infinity; w is linear depth. Of a parallel projection, w is 1 and
    /// z falls to 0 at a thousand times the height of what is seen.
    pub fn projection(&self, size: UVec2, offset: Vec2) -> Mat4 {
        let aspect = size.x as f32 / size.y as f32;
        // The shift moves points that lie right of the centre by `offset` onto it.
        let shift = vec2(-offset.x, offset.y) * 2.0 / size.as_vec2();
        let seen = match self.parallel_height {
            // Near and far change places, as in the other projection.
            Some(height) => {
                let [half, far] = [0.5 * height, self.near + FAR * height];
                directx::orthographic(-half * aspect, half * aspect, -half, half, far, self.near)
            }
            None => directx::perspective_infinite_reverse(self.vertical_fov, aspect, self.near),
        };
        Mat4::from_translation(shift.extend(0.0)) * seen
    }

    /// Half the width and height of what is seen at linear depth 1, in scene units; of a parallel projection at any depth.
    pub fn half_extent(&self, size: UVec2) -> Vec2 {
        let tangent = match self.parallel_height {
            Some(height) => 0.5 * height,
            None => (0.5 * self.vertical_fov).tan(),
        };
        vec2(tangent * size.x as f32 / size.y as f32, tangent)
    }

    /// A camera that has the whole box from `min` to `max` in a picture at least as wide as it is high, and looks
    /// down on its front (towards +z) from the right.
    ///
    /// `vertical_fov` is the angle between the picture's upper and lower edge in radians, above 0 and below π.
    pub fn framing(min: Vec3, max: Vec3, vertical_fov: f32) -> Camera {
        // Share of the picture that the box may fill, so that it does not touch the edges.
        let tangent = 0.95 * (0.5 * vertical_fov).tan();
        let centre = 0.5 * (min + max);
        // A point has a picture too.
        let radius = (0.5 * (max - min).length()).max(1.0e-3);
        let towards = vec3(0.5, 0.35, 0.8).normalize();
        let right = Vec3::Y.cross(towards).normalize();
        let up = towards.cross(right);
        // Each corner must be far enough away for its height and its width.
        let corners = (0..8).map(|i| {
            let side = |axis: usize| if i >> axis & 1 == 0 { min[axis] } else { max[axis] };
            vec3(side(0), side(1), side(2)) - centre
        });
        let distances = corners.map(|c| c.dot(towards) + c.dot(right).abs().max(c.dot(up).abs()) / tangent);
        let distance = distances.fold(radius, f32::max);
        Camera {
            position: (centre + towards * distance).into(),
            target: centre.into(),
            up: [0.0, 1.0, 0.0],
            vertical_fov,
            parallel_height: None,
            near: 0.01 * radius,
        }
    }

    /// Returns the defect that makes this camera useless, if it has one.
    pub(super) fn check(&self) -> Result<(), String> {
        let (position, target, up) = (Vec3::from(self.position), Vec3::from(self.target), Vec3::from(self.up));
        if !(position.length() < 0.5 * SKY_DEPTH && target.is_finite() && up.is_finite()) {
            return Err(format!(
                "the camera is not at a finite place, or as far away as the sky: {self:?}"
            ));
        }
        if (target - position).cross(up).length_squared() <= 0.0 {
            return Err("the camera's view direction is nothing, or its up vector points along it".to_owned());
        }
        self.check_projection()?;
        if !(self.near > 0.0 && self.near < SKY_DEPTH) {
            return Err(format!(
                "the camera's near plane is at {}, not above 0 and below {SKY_DEPTH}",
                self.near
            ));
        }
        Ok(())
    }

    /// Reports an angle of view or a height that no picture has.
    pub(crate) fn check_projection(&self) -> Result<(), String> {
        if let Some(height) = self.parallel_height {
            return match height > 0.0 && height.is_finite() {
                true => Ok(()),
                false => Err(format!("the camera's parallel_height is {height}, not above 0")),
            };
        }
        if !(self.vertical_fov > 0.0 && self.vertical_fov < std::f32::consts::PI) {
            return Err(format!(
                "the camera's angle is {} radians, not above 0 and below π",
                self.vertical_fov
            ));
        }
        Ok(())
    }
}

/// Viewpoint of a scene, as far as the caller cares.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Viewpoint {
    /// The pinhole; by default where all of the scene is seen.
    pub eye: Option<Vec3>,
    /// A point in the middle of the picture; by default the middle of a model, and what a scene's own camera looks at.
    pub target: Option<Vec3>,
    /// Angle between the picture's upper and lower edge in radians.
    pub vertical_fov: Option<f32>,
}

impl Viewpoint {
    /// The angle of cameras that frame a model, in radians.
    pub const FOV: f32 = 35.0 * std::f32::consts::PI / 180.0;

    /// Returns the camera of `by_default`, which is given the angle to use, changed as requested; `place` converts a requested
    /// point to the scene. Up is the world's y, but straight up or down from `eye` it is -z.
    pub fn camera(&self, by_default: impl Fn(f32) -> Camera, place: impl Fn(Vec3) -> Vec3) -> Camera {
        let mut camera = by_default(self.vertical_fov.unwrap_or(Self::FOV));
        if let Some(eye) = self.eye {
            camera.position = place(eye).into();
        }
        if let Some(target) = self.target {
            camera.target = place(target).into();
        }
        if let Some(fov) = self.vertical_fov {
            camera.vertical_fov = fov;
        }
        let along = Vec3::from(camera.target) - Vec3::from(camera.position);
        if along.cross(camera.up.into()).length() <= 1.0e-4 * along.length() {
            camera.up = [0.0, 0.0, -1.0];
        }
        camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CAMERA: Camera = Camera {
        position: [1.0, 2.0, 3.0],
        target: [1.0, 2.0, -7.0],
        up: [0.0, 1.0, 0.0],
        vertical_fov: 1.0,
        parallel_height: None,
        near: 0.1,
    };

    #[test]
    fn clip_w_is_linear_depth_and_offsets_move_the_samples() {
        let size = UVec2::new(200, 100);
        let clip = CAMERA.projection(size, Vec2::ZERO) * CAMERA.view() * vec3(1.5, 2.5, -1.0).extend(1.0);
        assert!((clip.w - 4.0).abs() < 1.0e-5);
        let moved = CAMERA.projection(size, vec2(1.0, 0.5)) * CAMERA.view() * vec3(1.5, 2.5, -1.0).extend(1.0);
        // Moved by a pixel to the left of 200, half a pixel up of 100, in a range of 2.
        assert!((moved.x / moved.w - (clip.x / clip.w - 0.01)).abs() < 1.0e-6);
        assert!((moved.y / moved.w - (clip.y / clip.w + 0.01)).abs() < 1.0e-6);
    }

    #[test]
    fn a_framed_box_is_inside_the_picture() {
        let (min, max) = (vec3(-3.0, 0.0, 10.0), vec3(1.0, 9.0, 11.0));
        let camera = Camera::framing(min, max, Viewpoint::FOV);
        assert_eq!(camera.check(), Ok(()));
        let to_clip = camera.projection(UVec2::new(64, 64), Vec2::ZERO) * camera.view();
        for corner in 0..8 {
            let pick = |axis: usize| if corner >> axis & 1 == 0 { min[axis] } else { max[axis] };
            let clip = to_clip * vec3(pick(0), pick(1), pick(2)).extend(1.0);
            assert!(
                clip.w > camera.near && clip.x.abs() <= clip.w && clip.y.abs() <= clip.w,
                "{clip}"
            );
        }
    }

    #[test]
    fn a_viewpoint_changes_what_it_names_alone() {
        let place = |point: Vec3| 2.0 * point;
        let seen = |viewpoint: Viewpoint| viewpoint.camera(|_| CAMERA, place);
        assert_eq!(seen(Viewpoint::default()), CAMERA);
        let moved = seen(Viewpoint {
            eye: Some(vec3(4.0, 5.0, 6.0)),
            ..Viewpoint::default()
        });
        assert_eq!((moved.position, moved.target), ([8.0, 10.0, 12.0], CAMERA.target));
        // From straight above there is a picture too.
        let above = seen(Viewpoint {
            eye: Some(vec3(0.5, 9.0, -3.5)),
            vertical_fov: Some(0.5),
            ..Viewpoint::default()
        });
        assert_eq!((above.check(), above.vertical_fov), (Ok(()), 0.5));
    }

    #[test]
    fn cameras_that_see_nothing_are_refused() {
        let refused = |change: fn(&mut Camera)| {
            let mut camera = CAMERA;
            change(&mut camera);
            camera.check().expect_err("a refusal")
        };
        assert!(refused(|camera| camera.target = camera.position).contains("direction"));
        assert!(refused(|camera| camera.up = [0.0, 0.0, 1.0]).contains("up"));
        assert!(refused(|camera| camera.vertical_fov = f32::NAN).contains("angle"));
        assert!(refused(|camera| camera.parallel_height = Some(0.0)).contains("parallel_height"));
        assert!(refused(|camera| camera.near = 0.0).contains("near"));
        assert!(refused(|camera| camera.position[1] = f32::INFINITY).contains("finite"));
    }
}
