//! A growing list of triangles, and the few solids that scenes are built of.

use super::{Material, Vertex};
use glam::{Affine3A, Vec3, vec3};
use std::f32::consts::TAU;

/// Triangles so far, and where the next ones go.
#[derive(Debug, Default)]
pub(super) struct Mesh {
    pub vertices: Vec<Vertex>,
    pub triangles: Vec<[u32; 3]>,
    /// Applied to what is added. A rotation and a shift, so that normals stay normals.
    place: Affine3A,
    /// Of what is added.
    material: Material,
}

impl Mesh {
    /// Adds what `build` adds, moved by `place` relative to where things go now.
    pub fn add_at(&mut self, place: Affine3A, build: impl FnOnce(&mut Mesh)) {
        let outer = self.place;
        self.place = outer * place;
        build(self);
        self.place = outer;
    }

    /// Adds what `build` adds, of a material.
    pub fn add_with_material(&mut self, material: Material, build: impl FnOnce(&mut Mesh)) {
        let outer = std::mem::replace(&mut self.material, material);
        build(self);
        self.material = outer;
    }

    /// The material of what is added now.
    pub fn current_material(&self) -> Material {
        self.material
    }

    /// A flat convex polygon with corners counter-clockwise seen from its front. What is degenerate is left out.
    pub fn add_polygon(&mut self, corners: &[Vec3], color: Vec3) {
        self.add_patch(corners, color, self.material);
    }

    /// [`polygon`](Self::polygon) of a material.
    pub fn add_patch(&mut self, corners: &[Vec3], color: Vec3, material: Material) {
        // Newell's sum: twice the area along the normal, also if corners coincide.
        let next = |i: usize| corners[(i + 1) % corners.len()];
        let area = (0..corners.len()).fold(Vec3::ZERO, |sum, i| sum + corners[i].cross(next(i)));
        if let Some(normal) = area.try_normalize() {
            let corners: Vec<(Vec3, Vec3)> = corners.iter().map(|corner| (*corner, normal)).collect();
            self.add_fan(&corners, color, material);
        }
    }

    /// A convex polygon of positions and normals, with corners as those of [`polygon`](Self::polygon).
    pub fn add_fan(&mut self, corners: &[(Vec3, Vec3)], color: Vec3, material: Material) {
        let first = self.vertices.len() as u32;
        for (position, normal) in corners {
            self.vertices.push(Vertex {
                position: self.place.transform_point3(*position).into(),
                normal: self.place.transform_vector3(*normal).normalize_or_zero().into(),
                color: color.into(),
                material: material as u32,
                ..Vertex::default()
            });
        }
        for i in 2..corners.len() as u32 {
            self.triangles.push([first, first + i - 1, first + i]);
        }
    }

    /// A box with its faces along the axes.
    pub fn add_block(&mut self, min: Vec3, max: Vec3, color: Vec3) {
        self.add_hexahedron([min, max].map(|y| level_rectangle(min, max, y.y)), color);
    }

    /// A solid with six quadrilateral faces: its lower and its upper one, each counter-clockwise seen from above.
    pub fn add_hexahedron(&mut self, [lower, upper]: [[Vec3; 4]; 2], color: Vec3) {
        let [a, b, c, d] = lower;
        self.add_polygon(&[d, c, b, a], color);
        self.add_polygon(&upper, color);
        for i in 0..4 {
            let j = (i + 1) % 4;
            self.add_polygon(&[lower[i], lower[j], upper[j], upper[i]], color);
        }
    }

    /// A straight bar from `from` to `to` with a regular cross-section of `sides` sides and flat faces.
    pub fn add_bar(&mut self, from: Vec3, to: Vec3, radius: f32, sides: u32, color: Vec3) {
        self.add_frustum([(from, radius), (to, radius)], sides, color, false);
    }

    /// A round solid between two parallel circles of given centre and radius. `smooth` gives its sides rounded
    /// normals.
    pub fn add_frustum(&mut self, [(from, r0), (to, r1)]: [(Vec3, f32); 2], sides: u32, color: Vec3, smooth: bool) {
        let axis = (to - from).normalize_or(Vec3::Y);
        let (u, v) = axis.any_orthonormal_pair();
        let around = |i: u32| {
            let angle = TAU * i as f32 / sides as f32;
            u * angle.cos() + v * angle.sin()
        };
        for i in 0..sides {
            let (a, b) = (around(i), around(i + 1));
            let corners = [from + a * r0, from + b * r0, to + b * r1, to + a * r1];
            if smooth {
                let slope = axis * ((r0 - r1) / (to - from).length());
                let normals = [a, b, b, a].map(|radial| (radial + slope).normalize_or(axis));
                let corners: Vec<(Vec3, Vec3)> = corners.into_iter().zip(normals).collect();
                self.add_fan(&corners, color, self.material);
            } else {
                self.add_polygon(&corners, color);
            }
        }
        let ring = |centre: Vec3, radius: f32| (0..sides).map(move |i| centre + around(i) * radius);
        self.add_polygon(&ring(from, r0).rev().collect::<Vec<_>>(), color);
        self.add_polygon(&ring(to, r1).collect::<Vec<_>>(), color);
    }
}

/// Corners of a level rectangle at height `y`, counter-clockwise seen from above.
fn level_rectangle(min: Vec3, max: Vec3, y: f32) -> [Vec3; 4] {
    [
        vec3(min.x, y, max.z),
        vec3(max.x, y, max.z),
        vec3(max.x, y, min.z),
        vec3(min.x, y, min.z),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;

    /// Volume by the divergence theorem: positive, and right, only if every face is closed and faces outwards.
    fn volume(mesh: &Mesh) -> f32 {
        let corner = |i: u32| Vec3::from(mesh.vertices[i as usize].position);
        let solid = |[a, b, c]: [u32; 3]| corner(a).dot(corner(b).cross(corner(c))) / 6.0;
        mesh.triangles.iter().map(|triangle| solid(*triangle)).sum()
    }

    fn check_normals(mesh: &Mesh) {
        for [a, b, c] in &mesh.triangles {
            let [a, b, c] = [a, b, c].map(|i| mesh.vertices[*i as usize]);
            let [p, q, r] = [a, b, c].map(|vertex| Vec3::from(vertex.position));
            let face = (q - p).cross(r - p);
            assert!(face.dot(Vec3::from(a.normal)) > 0.0, "{a:?} {b:?} {c:?}");
        }
    }

    #[test]
    fn solids_are_closed_and_face_outwards() {
        let place = Affine3A::from_rotation_translation(Quat::from_rotation_y(0.7), vec3(3.0, -1.0, 2.0));
        let mut mesh = Mesh::default();
        mesh.add_at(place, |mesh| {
            mesh.add_block(vec3(-1.0, 0.0, 2.0), vec3(1.0, 3.0, 2.5), Vec3::ONE)
        });
        assert!((volume(&mesh) - 3.0).abs() < 1.0e-4);
        check_normals(&mesh);

        for smooth in [false, true] {
            let mut mesh = Mesh::default();
            let ends = [(vec3(1.0, 2.0, 3.0), 2.0), (vec3(1.0, 5.0, 3.0), 1.0)];
            mesh.add_frustum(ends, 64, Vec3::ONE, smooth);
            let exact = std::f32::consts::PI * 3.0 / 3.0 * (4.0 + 2.0 + 1.0);
            assert!((volume(&mesh) / exact - 1.0).abs() < 5.0e-3, "{}", volume(&mesh));
            check_normals(&mesh);
        }
    }
}
