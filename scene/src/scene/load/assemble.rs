//! From the parts of a file, checked, to one mesh of a known size and place.

use super::MAX_TRIANGLES;
use super::surface::{face_normal, flat_normals, smooth_normals};
use crate::scene::{Material, Vertex};
use glam::{DVec2, DVec3, UVec2, Vec2, Vec3};

/// A stretch of triangles as a file gives them, in the file's world space. Nothing of it is trusted.
pub(super) struct MeshPart {
    /// Name in the file, for messages.
    pub name: String,
    pub positions: Vec<Vec3>,
    pub normals: Normals,
    /// Linear; one for each position.
    pub colors: Vec<Vec3>,
    pub paint: Option<Paint>,
    pub triangles: Vec<[u32; 3]>,
}

/// A texture on a part.
pub(super) struct Paint {
    /// Coordinates in the texture, one for each position.
    pub uvs: Vec<Vec2>,
    /// Number of the image, and its size.
    pub image: u32,
    pub size: UVec2,
}

/// Source of a part's normals.
pub(super) enum Normals {
    /// Normals of the file, one for each position, of any length above 0.
    Given(Vec<Vec3>),
    /// Each face's own.
    Flat,
    /// The mean of the faces that meet in a point at a low angle.
    Smooth,
}

/// A checked mesh around the origin.
pub(super) struct Assembled {
    pub vertices: Vec<Vertex>,
    pub triangles: Vec<[u32; 3]>,
    /// Transform from the file's world space to the scene.
    pub place: Place,
}

/// Move and scale of a file's world space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    centre: DVec3,
    scale: f64,
}

impl Place {
    /// Converts a point of the file's world space to the scene.
    pub fn to_scene(self, point: Vec3) -> Vec3 {
        ((point.as_dvec3() - self.centre) * self.scale).as_vec3()
    }
}

/// Diagonal of the finished bounding box.
const DIAGONAL: f32 = 10.0;

/// Joins `parts`, or says what is wrong with one of them.
pub(super) fn assemble_parts(parts: Vec<MeshPart>) -> Result<Assembled, String> {
    let mut mesh = Assembled {
        vertices: Vec::new(),
        triangles: Vec::new(),
        place: Place {
            centre: DVec3::ZERO,
            scale: 1.0,
        },
    };
    for part in parts {
        check_part(&part)?;
        if mesh.triangles.len() + part.triangles.len() > MAX_TRIANGLES {
            return Err(format!("there are more than {MAX_TRIANGLES} triangles"));
        }
        mesh.add(part);
    }
    mesh.centre_and_scale()?;
    Ok(mesh)
}

fn check_part(part: &MeshPart) -> Result<(), String> {
    let name = &part.name;
    let count = part.positions.len();
    if let Some(at) = part.positions.iter().position(|position| !position.is_finite()) {
        return Err(format!(
            "{name}: vertex {at} of {count} is at {}, which is nowhere",
            part.positions[at]
        ));
    }
    if let Some(at) = part.colors.iter().position(|color| !color.is_finite()) {
        return Err(format!("{name}: vertex {at} has the colour {}", part.colors[at]));
    }
    if let Some(paint) = &part.paint {
        if paint.uvs.len() != count {
            let found = paint.uvs.len();
            return Err(format!(
                "{name}: there are {found} texture coordinates for {count} vertices"
            ));
        }
        if let Some(at) = paint.uvs.iter().position(|uv| !uv.is_finite()) {
            return Err(format!("{name}: vertex {at} lies at {} of its texture", paint.uvs[at]));
        }
    }
    let beyond = |triangle: &&[u32; 3]| triangle.iter().any(|index| *index as usize >= count);
    if let Some(triangle) = part.triangles.iter().find(beyond) {
        return Err(format!(
            "{name}: a triangle has the corners {triangle:?}, and there are {count} vertices"
        ));
    }
    match &part.normals {
        Normals::Given(normals) if normals.len() != count => Err(format!(
            "{name}: there are {} normals for {count} vertices",
            normals.len()
        )),
        Normals::Given(normals) => match normals.iter().position(|normal| !normal.is_finite()) {
            Some(at) => Err(format!("{name}: vertex {at} has the normal {}", normals[at])),
            None => Ok(()),
        },
        Normals::Flat | Normals::Smooth => Ok(()),
    }
}

/// Texels to a unit of length around each position: by the areas in the image and in space of the triangles that it is a
/// corner of.
fn texel_densities(part: &MeshPart, paint: &Paint) -> Vec<f32> {
    let mut areas = vec![DVec2::ZERO; part.positions.len()];
    let texels = paint.size.as_dvec2();
    for triangle in &part.triangles {
        let [a, b, c] = triangle.map(|index| part.positions[index as usize].as_dvec3());
        let [p, q, r] = triangle.map(|index| paint.uvs[index as usize].as_dvec2() * texels);
        let both = DVec2::new((q - p).perp_dot(r - p).abs(), (b - a).cross(c - a).length());
        triangle.iter().for_each(|index| areas[*index as usize] += both);
    }
    let density = |area: DVec2| (area.x / area.y).sqrt() as f32;
    areas
        .into_iter()
        .map(|area| if area.y > 0.0 { density(area) } else { 0.0 })
        .collect()
}

impl Assembled {
    /// Adds a checked part: corners with a normal each, wound to agree with them.
    fn add(&mut self, part: MeshPart) {
        let corner = |triangle: [u32; 3]| triangle.map(|index| part.positions[index as usize]);
        let visible = part
            .triangles
            .iter()
            .filter(|triangle| face_normal(corner(**triangle)).is_some());
        let triangles: Vec<[u32; 3]> = visible.copied().collect();
        let normals = match &part.normals {
            Normals::Given(normals) => {
                let given = |index: u32| normals[index as usize].try_normalize();
                let faces = flat_normals(&part.positions, &triangles);
                let faces = triangles.iter().zip(faces);
                faces
                    .map(|(corners, face)| std::array::from_fn(|i| given(corners[i]).unwrap_or(face[i])))
                    .collect()
            }
            Normals::Flat => flat_normals(&part.positions, &triangles),
            Normals::Smooth => smooth_normals(&part.positions, &triangles),
        };
        let density = part.paint.as_ref().map(|paint| texel_densities(&part, paint));
        let mut last: Vec<Option<(u32, Vec3)>> = vec![None; part.positions.len()];
        for (triangle, normals) in triangles.into_iter().zip(normals) {
            let mut indices = [0, 1, 2].map(|i: usize| {
                // Corners with one normal stay one vertex, as long as they follow one another.
                let slot = &mut last[triangle[i] as usize];
                match *slot {
                    Some((index, normal)) if normal == normals[i] => index,
                    _ => {
                        let index = self.vertices.len() as u32;
                        *slot = Some((index, normals[i]));
                        self.vertices.push(Vertex {
                            position: part.positions[triangle[i] as usize].into(),
                            normal: normals[i].into(),
                            color: part.colors[triangle[i] as usize].clamp(Vec3::ZERO, Vec3::ONE).into(),
                            material: Material::Plain as u32,
                            uv: part
                                .paint
                                .as_ref()
                                .map_or([0.0; 2], |p| p.uvs[triangle[i] as usize].into()),
                            texture: part.paint.as_ref().map_or(0, |paint| paint.image + 1),
                            density: density.as_ref().map_or(0.0, |density| density[triangle[i] as usize]),
                        });
                        index
                    }
                }
            });
            let outside: Vec3 = normals.into_iter().sum();
            if face_normal(corner(triangle)).is_some_and(|face| face.dot(outside) < 0.0) {
                indices.swap(1, 2);
            }
            self.triangles.push(indices);
        }
    }

    /// Lower and upper corner of the bounding box.
    pub fn bounds(&self) -> [Vec3; 2] {
        let positions = self.vertices.iter().map(|vertex| Vec3::from(vertex.position));
        positions.fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[min, max], position| {
            [min.min(position), max.max(position)]
        })
    }

    /// Moves and scales everything to where it can be looked at.
    fn centre_and_scale(&mut self) -> Result<(), String> {
        if self.vertices.is_empty() {
            return Ok(());
        }
        // In double precision: the box of numbers that are finite need not have a finite size.
        let [min, max] = self.bounds().map(|corner| corner.as_dvec3());
        let (centre, diagonal) = (0.5 * (min + max), (max - min).length());
        if diagonal <= 0.0 || diagonal > f64::from(f32::MAX) {
            return Err(format!("the model's bounding box has a diagonal of {diagonal}"));
        }
        self.place = Place {
            centre,
            scale: f64::from(DIAGONAL) / diagonal,
        };
        for vertex in &mut self.vertices {
            vertex.position = self.place.to_scene(vertex.position.into()).into();
            vertex.density = (f64::from(vertex.density) / self.place.scale) as f32;
        }
        Ok(())
    }
}
