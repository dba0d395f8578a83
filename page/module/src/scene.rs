//! The built-in scene: a few solids on a plane, traced at any place of any pixel, so that every sample pattern has its
//! geometry. Thin bars and wires are there because they are what antialiasing is for.

mod shade;
mod solids;

use crate::texels::{Picture, round_to_half};
use glam::{Vec2, Vec3, Vec4, vec2, vec3};
use std::collections::HashMap;
use std::sync::Arc;

/// Width and height at which the scene is seen unless the page asks for others.
pub const SIZE: [u32; 2] = [480, 300];

/// Distance of the near plane.
pub const NEAR: f32 = 0.1;

/// Distance of the far plane, and depth of the sky.
pub const FAR: f32 = 1000.0;

/// Pixels that one unit at distance one covers, where the picture is [`SIZE`].
const FOCAL: f32 = 300.0;

/// Surface seen at a place.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Depth along the view.
    pub depth: f32,
    /// Unit normal in the view's frame: x right, y down, z away.
    pub normal: Vec3,
}

/// Surfaces of a picture: rows from the top, with an offset from each pixel's centre.
type Surfaces = Arc<Vec<Surface>>;

/// The scene, with what has been traced of it.
#[derive(Default)]
pub struct Scene {
    surfaces: HashMap<([u32; 2], [u32; 2]), Surfaces>,
    pictures: HashMap<([u32; 2], u32), Arc<Picture>>,
}

/// Layers that are kept: those of two large patterns.
const KEPT: usize = 40;

impl Scene {
    /// The surfaces seen `offset` from the pixels' centres, in pixels, y down.
    pub fn trace_surfaces(&mut self, size: [u32; 2], offset: Vec2) -> Surfaces {
        if self.surfaces.len() >= KEPT {
            self.surfaces.clear();
        }
        let key = (size, offset.to_array().map(f32::to_bits));
        let traced = self.surfaces.entry(key).or_insert_with(|| {
            let surfaces = pixel_centres(size).map(|at| trace_surface(size, at + offset));
            Arc::new(surfaces.collect())
        });
        Arc::clone(traced)
    }

    /// The picture with so many samples a pixel: a square number, 1 for what a renderer without antialiasing gives.
    pub fn trace_picture(&mut self, size: [u32; 2], samples: u32) -> Arc<Picture> {
        let side = samples.isqrt().clamp(1, 8);
        let traced = self.pictures.entry((size, side)).or_insert_with(|| {
            let texels = pixel_centres(size).map(|at| {
                let mut sum = Vec3::ZERO;
                for k in 0..side * side {
                    let cell = vec2((k % side) as f32 + 0.5, (k / side) as f32 + 0.5) / side as f32;
                    sum += trace_colour(size, at + cell - 0.5);
                }
                let mean = sum / (side * side) as f32;
                mean.extend(1.0).to_array().map(round_to_half)
            });
            Arc::new(Picture {
                size,
                texels: texels.collect(),
            })
        });
        Arc::clone(traced)
    }
}

/// Centres of all pixels, row by row.
fn pixel_centres(size: [u32; 2]) -> impl Iterator<Item = Vec2> {
    let [width, height] = size;
    (0..height).flat_map(move |y| (0..width).map(move |x| vec2(x as f32 + 0.5, y as f32 + 0.5)))
}

/// Pixels that one unit at distance one covers.
pub fn focal_length(size: [u32; 2]) -> f32 {
    FOCAL * size[0] as f32 / SIZE[0] as f32
}

/// The ray through the upper left corner of a picture, and how it changes by a pixel to the right and down.
pub fn picture_rays(size: [u32; 2]) -> [Vec3; 3] {
    let focal = focal_length(size);
    let half = vec2(size[0] as f32, size[1] as f32) * 0.5 / focal;
    [
        vec3(-half.x, -half.y, 1.0),
        vec3(1.0 / focal, 0.0, 0.0),
        vec3(0.0, 1.0 / focal, 0.0),
    ]
}

/// The eye: where it is, and its axes right, down and away.
const EYE: Vec3 = vec3(0.0, 1.5, -3.6);
const DOWN: Vec3 = vec3(0.0, -0.985_5, -0.169_7);
const AWAY: Vec3 = vec3(0.0, -0.169_7, 0.985_5);

/// Direction through a place of the picture, at depth 1.
fn ray_direction(size: [u32; 2], at: Vec2) -> Vec3 {
    let [corner, right, down] = picture_rays(size);
    let view = corner + right * at.x + down * at.y;
    vec3(view.x, 0.0, 0.0) + DOWN * view.y + AWAY * view.z
}

/// Returns the surface seen at a place.
pub fn trace_surface(size: [u32; 2], at: Vec2) -> Surface {
    match solids::first_hit(EYE, ray_direction(size, at), FAR) {
        None => Surface {
            depth: FAR,
            normal: vec3(0.0, 0.0, -1.0),
        },
        Some(hit) => Surface {
            depth: hit.distance,
            normal: vec3(hit.normal.x, hit.normal.dot(DOWN), hit.normal.dot(AWAY)),
        },
    }
}

/// Returns the colour seen at a place, in linear light.
pub fn trace_colour(size: [u32; 2], at: Vec2) -> Vec3 {
    let direction = ray_direction(size, at);
    match solids::first_hit(EYE, direction, FAR) {
        None => shade::sky(direction),
        Some(hit) => shade::shade_hit(EYE + direction * hit.distance, direction, &hit),
    }
}

/// As a texel.
pub fn to_texel(colour: Vec3, fourth: f32) -> [f32; 4] {
    Vec4::from((colour, fourth)).to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_and_normals_are_those_of_what_is_seen() {
        let mut scene = Scene::default();
        let surfaces = scene.trace_surfaces(SIZE, Vec2::ZERO);
        assert_eq!(surfaces.len(), 480 * 300);
        // The ground at the lower border: the ray meets the plane y = 0.
        let ground = surfaces[299 * 480 + 2];
        let ray = ray_direction(SIZE, vec2(2.5, 299.5));
        assert!((ground.depth - EYE.y / -ray.y).abs() < 1.0e-4, "{ground:?}");
        assert!(surfaces.iter().all(|s| (s.normal.length() - 1.0).abs() < 1.0e-3));
        assert!(surfaces.iter().any(|s| s.depth == FAR), "there is sky");
        // Away from the viewer, no surface shows its back.
        let rays = picture_rays(SIZE);
        let facing = pixel_centres(SIZE).zip(surfaces.iter()).filter(|(at, s)| {
            let ray = rays[0] + rays[1] * at.x + rays[2] * at.y;
            ray.dot(s.normal) < 1.0e-3
        });
        assert_eq!(facing.count(), surfaces.len());
    }

    #[test]
    fn more_samples_give_the_same_picture_but_for_edges() {
        let mut scene = Scene::default();
        let size = [96, 60];
        let (one, sixteen) = (scene.trace_picture(size, 1), scene.trace_picture(size, 16));
        let near = one.texels.iter().zip(&sixteen.texels);
        let near = near.filter(|(a, b)| (0..3).all(|k| (a[k] - b[k]).abs() < 0.02)).count();
        assert!(near * 2 > one.texels.len(), "{near}");
        assert_ne!(one, sixteen);
    }
}
