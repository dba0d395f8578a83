//! A scene of everything that edges are made of, in one picture: a tiled roof and its ridge, a stair with a railing of
//! thin bars, wires from a pixel and a half down to a fifth of one, a grooved wall, a faceted stone, a picket fence and
//! a tiled floor that recedes to the horizon.

mod house;
pub(super) mod mast;
pub(super) mod square;
pub(super) mod stair;

use super::mesh::Mesh;
use super::{Camera, Scene, Sky, Sun, Textures};
use glam::vec3;

/// Linear reflectances.
pub(super) mod paint {
    use glam::{Vec3, vec3};

    pub const PLASTER: Vec3 = vec3(0.72, 0.58, 0.40);
    pub const STONE: Vec3 = vec3(0.42, 0.40, 0.37);
    pub const BOARD: Vec3 = vec3(0.52, 0.50, 0.44);
    pub const TRIM: Vec3 = vec3(0.80, 0.78, 0.74);
    pub const TIMBER: Vec3 = vec3(0.16, 0.09, 0.05);
    pub const IRON: Vec3 = vec3(0.035, 0.036, 0.04);
    pub const GLASS: Vec3 = vec3(0.05, 0.09, 0.13);
    pub const DOOR: Vec3 = vec3(0.10, 0.20, 0.17);
}

/// The scene. About 34 000 triangles; one unit is a metre.
pub fn builtin_scene() -> Scene {
    let mut mesh = Mesh::default();
    house::add(&mut mesh);
    stair::add(&mut mesh);
    mast::add(&mut mesh);
    square::add(&mut mesh);
    Scene {
        vertices: mesh.vertices,
        triangles: mesh.triangles,
        textures: Textures::default(),
        sun: Sun {
            direction: vec3(0.58, 0.56, 0.60).normalize().into(),
            color: [1.02, 0.86, 0.63],
        },
        sky: Sky {
            zenith: [0.13, 0.25, 0.48],
            horizon: [0.66, 0.71, 0.74],
            ground: [0.20, 0.17, 0.13],
            haze: 0.0025,
        },
        environment: Default::default(),
        lamps: Vec::new(),
        shades: Vec::new(),
        camera: Camera {
            position: [-6.2, 1.7, 11.3],
            target: [0.75, 3.0, -1.5],
            up: [0.0, 1.0, 0.0],
            vertical_fov: 0.72,
            parallel_height: None,
            near: 0.1,
        },
    }
}

/// A fixed number in 0..1 for each `seed`, without pattern (PCG's output permutation).
pub(super) fn hash_noise(seed: u32) -> f32 {
    let state = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    ((word >> 22) ^ word) as f32 / u32::MAX as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_can_be_drawn_and_is_the_same_each_time() {
        let scene = builtin_scene();
        scene.check().expect("a scene");
        assert!(scene == builtin_scene());
    }
}
