//! Normals of triangles.

use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// Cosine of the angle between two faces below which they are taken for one rounded surface: 55°.
const CREASE: f32 = 0.574;

/// Unit normal of a triangle, counter-clockwise seen from the side it points to; `None` without an area.
pub(super) fn face_normal(corners: [Vec3; 3]) -> Option<Vec3> {
    area(corners).try_normalize().map(|normal| normal.as_vec3())
}

/// Twice the area along the normal. In double precision, as models may be of any scale.
fn area([a, b, c]: [Vec3; 3]) -> DVec3 {
    let origin = a.as_dvec3();
    (b.as_dvec3() - origin).cross(c.as_dvec3() - origin)
}

fn corners(positions: &[Vec3], triangle: [u32; 3]) -> [Vec3; 3] {
    triangle.map(|index| positions[index as usize])
}

/// For each corner the normal of its face. Of a triangle without an area, z.
pub(super) fn flat_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[Vec3; 3]> {
    let face = |triangle: &[u32; 3]| [face_normal(corners(positions, *triangle)).unwrap_or(Vec3::Z); 3];
    triangles.iter().map(face).collect()
}

/// For each corner the mean, by area, of the faces that meet there at less than [`CREASE`] to its own face.
/// Corners meet where their positions are equal, whatever their indices.
pub(super) fn smooth_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[Vec3; 3]> {
    let key = |index: u32| positions[index as usize].to_array().map(|axis| (axis + 0.0).to_bits());
    let flat = flat_normals(positions, triangles);
    let mut meeting: HashMap<[u32; 3], Vec<u32>> = HashMap::new();
    for (at, triangle) in triangles.iter().enumerate() {
        for index in triangle {
            meeting.entry(key(*index)).or_default().push(at as u32);
        }
    }
    let areas: Vec<DVec3> = triangles
        .iter()
        .map(|triangle| area(corners(positions, *triangle)))
        .collect();
    let normal = |at: usize, index: u32| {
        let own = flat[at][0];
        let faces = meeting[&key(index)].iter().map(|face| *face as usize);
        let smooth = faces.filter(|face| flat[*face][0].dot(own) > CREASE);
        let sum: DVec3 = smooth.map(|face| areas[face]).sum();
        sum.try_normalize().map_or(own, |normal| normal.as_vec3())
    };
    let each = triangles.iter().enumerate();
    each.map(|(at, triangle)| triangle.map(|index| normal(at, index)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    /// Two triangles that share an edge along x, the second turned up by `angle`.
    fn hinge(angle: f32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let up = vec3(0.0, angle.sin(), -angle.cos());
        let positions = vec![vec3(0.0, 0.0, 1.0), Vec3::X, Vec3::ZERO, Vec3::ZERO, Vec3::X, up];
        (positions, vec![[0, 1, 2], [3, 4, 5]])
    }

    #[test]
    fn shallow_edges_are_smoothed_and_sharp_ones_kept() {
        let (positions, triangles) = hinge(0.2);
        let smooth = smooth_normals(&positions, &triangles);
        assert!((smooth[0][2] - smooth[1][0]).length() < 1.0e-6, "{smooth:?}");
        assert!((smooth[0][2].angle_between(Vec3::Y) - 0.1).abs() < 1.0e-3);
        assert!((smooth[0][0] - Vec3::Y).length() < 1.0e-6);

        let (positions, triangles) = hinge(1.0);
        assert_eq!(
            smooth_normals(&positions, &triangles),
            flat_normals(&positions, &triangles)
        );
    }

    #[test]
    fn tiny_triangles_have_normals_and_lines_have_none() {
        let tiny = [Vec3::ZERO, vec3(1.0e-15, 0.0, 0.0), vec3(0.0, 1.0e-15, 0.0)];
        assert_eq!(face_normal(tiny), Some(Vec3::Z));
        assert_eq!(face_normal([Vec3::ZERO, Vec3::X, Vec3::X * 2.0]), None);
    }
}
