//! Tiles to the horizon. Their pattern is averaged over each pixel, so that nothing in it needs a filter: whatever a
//! filter changes below the horizon is blur.

use super::outdoor_scene;
use crate::scene::Scene;
use crate::scene::builtin::square::add_ground;
use crate::scene::mesh::Mesh;
use glam::vec3;

pub(super) fn build_scene() -> Scene {
    let mut mesh = Mesh::default();
    add_ground(&mut mesh);
    outdoor_scene(mesh, vec3(0.3, 1.7, 0.6), vec3(2.3, 0.75, -5.0), 45.0)
}
