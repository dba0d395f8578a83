//! The demo's house and square from above, by a parallel projection.

use crate::scene::builtin::builtin_scene;
use crate::scene::{Camera, Scene};

pub(super) fn build_scene() -> Scene {
    Scene {
        camera: Camera {
            position: [-20.0, 18.0, 24.0],
            target: [0.2, 2.0, 0.4],
            up: [0.0, 1.0, 0.0],
            vertical_fov: 0.0,
            parallel_height: Some(11.0),
            near: 0.1,
        },
        ..builtin_scene()
    }
}
