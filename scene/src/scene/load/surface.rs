//! Normals of triangles.

use glam::{DVec3, Vec3};
use std::collections::{BTreeMap, HashMap};

/// Cosine of the angle between two faces below which they are taken for one rounded surface: 55°.
const CREASE: f32 = 0.574;

/// Unit normal of a triangle, counter-clockwise seen from the side it points to; `None` without an area.
pub(super) fn face_normal(corners: [Vec3; 3]) -> Option<Vec3> {
    area_vector(corners).try_normalize().map(|normal| normal.as_vec3())
}

/// Twice the area along the normal. In double precision, as models may be of any scale.
fn area_vector([a, b, c]: [Vec3; 3]) -> DVec3 {
    let origin = a.as_dvec3();
    (b.as_dvec3() - origin).cross(c.as_dvec3() - origin)
}

fn triangle_corners(positions: &[Vec3], triangle: [u32; 3]) -> [Vec3; 3] {
    triangle.map(|index| positions[index as usize])
}

/// For each corner the normal of its face. Of a triangle without an area, z.
pub(super) fn flat_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[Vec3; 3]> {
    let face = |triangle: &[u32; 3]| [face_normal(triangle_corners(positions, *triangle)).unwrap_or(Vec3::Z); 3];
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
        .map(|triangle| area_vector(triangle_corners(positions, *triangle)))
        .collect();
    let crowded: HashMap<[u32; 3], BTreeMap<[i8; 3], Vec3>> = meeting
        .iter()
        .filter(|(_, faces)| faces.len() > CROWD)
        .map(|(point, faces)| (*point, by_direction(faces, &flat, &areas)))
        .collect();
    let normal = |at: usize, index: u32| {
        let own = flat[at][0];
        if let Some(smooth) = crowded.get(&key(index)) {
            return smooth.get(&round_normal(own)).copied().unwrap_or(own);
        }
        let faces = meeting[&key(index)].iter().map(|face| *face as usize);
        let smooth = faces.filter(|face| flat[*face][0].dot(own) > CREASE);
        let sum: DVec3 = smooth.map(|face| areas[face]).sum();
        sum.try_normalize().map_or(own, |normal| normal.as_vec3())
    };
    let each = triangles.iter().enumerate();
    each.map(|(at, triangle)| triangle.map(|index| normal(at, index)))
        .collect()
}

/// Most faces that meet in a point before faces of like direction are taken together: each is compared with each.
const CROWD: usize = 256;

/// Steps of a direction's components between 0 and 1.
const STEPS: f32 = 16.0;

/// A normal, rounded: what lies within a sixteenth is taken together.
fn round_normal(normal: Vec3) -> [i8; 3] {
    normal.to_array().map(|axis| (axis * STEPS).round() as i8)
}

/// For a point in which many faces meet, the mean of those at less than [`CREASE`] to each direction that there is. Takes
/// time in proportion to the faces.
fn by_direction(faces: &[u32], flat: &[[Vec3; 3]], areas: &[DVec3]) -> BTreeMap<[i8; 3], Vec3> {
    let mut groups: BTreeMap<[i8; 3], (Vec3, DVec3)> = BTreeMap::new();
    for face in faces.iter().map(|face| *face as usize) {
        let own = flat[face][0];
        let group = groups.entry(round_normal(own)).or_insert((own, DVec3::ZERO));
        group.1 += areas[face];
    }
    let mean = |own: Vec3| {
        let near = groups.values().filter(|(other, _)| other.dot(own) > CREASE);
        let sum: DVec3 = near.map(|(_, area)| *area).sum();
        sum.try_normalize().map_or(own, |normal| normal.as_vec3())
    };
    groups
        .iter()
        .map(|(direction, (own, _))| (*direction, mean(*own)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn many_faces_around_a_point_take_no_longer_than_their_number() {
        let count = 200_000;
        let rim = |k: u32| {
            let angle = k as f32 * std::f32::consts::TAU / count as f32;
            vec3(angle.cos(), -0.2, angle.sin())
        };
        let mut positions = vec![Vec3::ZERO];
        positions.extend((0..count).map(rim));
        let triangles: Vec<[u32; 3]> = (0..count).map(|k| [0, (k + 1) % count + 1, k + 1]).collect();
        let start = std::time::Instant::now();
        let normals = smooth_normals(&positions, &triangles);
        assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
        assert!(
            normals.iter().all(|n| (n[0] - Vec3::Y).length() < 0.02),
            "{:?}",
            normals[0][0]
        );
    }

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
