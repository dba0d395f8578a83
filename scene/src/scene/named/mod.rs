//! Scenes by name, each for one thing that a filter of edges does well or badly.

mod awning;
mod creases;
mod emissive;
mod floor;
mod grooves;
mod isometric;
mod posters;
mod railings;
mod relief;
mod sky;
mod sparkle;
mod studio;
mod terrain;
mod thicket;
mod tubes;
mod wires;

use super::builtin::builtin_scene;
use super::mesh::Mesh;
use super::{Camera, Scene, SceneError, Sky, Sun, Textures};
use glam::{Vec3, vec3};
use std::ops::Range;

/// Every built-in scene: its name, and what it is for.
pub const NAMES: [(&str, &str); 11] = [
    ("roof", "everything that edges are made of, in one picture: the demo's"),
    (
        "grooves",
        "shallow grooves and insets seen at an angle: planes beat depth (paper, figure 5)",
    ),
    (
        "creases",
        "edges across which depth goes on: normals beat depth alone (paper, figure 4)",
    ),
    (
        "floor",
        "a textured floor to the horizon and no edge in it: what blur costs",
    ),
    (
        "railings",
        "railings, a picket fence and an alpha-tested chain-link fence",
    ),
    ("wires", "wires at all angles, from three pixels to a fifth of one"),
    (
        "tubes",
        "bicycles: thin curved tubes and spokes that 1x shading misses (paper, figure 10)",
    ),
    (
        "sparkle",
        "highlights and hard shadows, which no geometry tells of: SRAA must fall back (paper, figure 8)",
    ),
    ("emissive", "lights up to 50 times as bright as white, against the dark"),
    ("sky", "thin things before an infinite sky"),
    (
        "terrain",
        "hills at a grazing angle: ridge behind ridge, all of one surface",
    ),
];

/// Scenes that studies draw on request: edges of paint and shadow, which filters of geometry leave as they are unless they know of
/// these, and what else is hard.
pub const FURTHER: [(&str, &str); 6] = [
    (
        "posters",
        "dots with hard edges on walls, blocks and ground: paint, which no geometry tells of",
    ),
    (
        "awning",
        "hard shadows of slats on even ground, walls and posts, which no geometry tells of",
    ),
    (
        "studio",
        "four coloured lamps and their shadows, studs and highlights: a cheap guide knows one light",
    ),
    (
        "relief",
        "walls and ground with studs that normals alone show, as normal maps do",
    ),
    (
        "thicket",
        "shrubs and grass of triangles that are a pixel or a few large",
    ),
    ("isometric", "the demo's house from above, by a parallel projection"),
];

impl Scene {
    /// The scene of [`NAMES`] or [`FURTHER`] that is called `name`. The same each time; one unit is a metre.
    ///
    /// # Errors
    ///
    /// [`SceneError::UnknownName`], which lists the names.
    pub fn from_name(name: &str) -> Result<Scene, SceneError> {
        match name {
            "roof" => Ok(builtin_scene()),
            "grooves" => Ok(grooves::build_scene()),
            "creases" => Ok(creases::build_scene()),
            "floor" => Ok(floor::build_scene()),
            "railings" => Ok(railings::build_scene()),
            "wires" => Ok(wires::build_scene()),
            "tubes" => Ok(tubes::build_scene()),
            "sparkle" => Ok(sparkle::build_scene()),
            "emissive" => Ok(emissive::build_scene()),
            "sky" => Ok(sky::build_scene()),
            "terrain" => Ok(terrain::build_scene()),
            "posters" => Ok(posters::build_scene()),
            "awning" => Ok(awning::build_scene()),
            "studio" => Ok(studio::build_scene()),
            "relief" => Ok(relief::build_scene()),
            "thicket" => Ok(thicket::build_scene()),
            "isometric" => Ok(isometric::build_scene()),
            _ => Err(SceneError::UnknownName { name: name.to_owned() }),
        }
    }
}

/// `mesh` on a clear afternoon, seen from `position` towards `target` at an angle of `fov` degrees from the lower to the
/// upper edge.
fn outdoor_scene(mesh: Mesh, position: Vec3, target: Vec3, fov: f32) -> Scene {
    Scene {
        vertices: mesh.vertices,
        triangles: mesh.triangles,
        textures: Textures::default(),
        sun: Sun {
            direction: vec3(0.45, 0.62, 0.64).normalize().into(),
            color: [1.02, 0.9, 0.72],
        },
        sky: Sky {
            zenith: [0.14, 0.26, 0.48],
            horizon: [0.64, 0.70, 0.74],
            ground: [0.20, 0.18, 0.15],
            haze: 0.002,
        },
        environment: Default::default(),
        lamps: Vec::new(),
        shades: Vec::new(),
        camera: Camera {
            position: position.into(),
            target: target.into(),
            up: [0.0, 1.0, 0.0],
            vertical_fov: fov.to_radians(),
            parallel_height: None,
            near: 0.1,
        },
    }
}

/// A level square of plain ground, cut up so that no triangle is large where it passes the camera.
fn add_lawn(mesh: &mut Mesh, half: f32, color: Vec3) {
    const CUTS: i32 = 16;
    let at = |k: i32| half * (k as f32 / CUTS as f32).powi(3);
    for x in -CUTS..CUTS {
        for z in -CUTS..CUTS {
            let corner = |i: i32, j: i32| vec3(at(x + i), 0.0, at(z + j));
            mesh.add_polygon(&[corner(0, 1), corner(1, 1), corner(1, 0), corner(0, 0)], color);
        }
    }
}

/// Level ground of squares: one for each pair of `x` and `z`, which count them from the origin. Cut up so that no triangle is large
/// where it passes the camera.
fn add_slabs(mesh: &mut Mesh, x: Range<i32>, z: Range<i32>, side: f32, color: impl Fn(i32, i32) -> Vec3) {
    for x in x {
        for z in z.clone() {
            let corner = side * vec3(x as f32, 0.0, z as f32);
            let corners = [(0.0, side), (side, side), (side, 0.0), (0.0, 0.0)];
            mesh.add_polygon(&corners.map(|(x, z)| corner + vec3(x, 0.0, z)), color(x, z));
        }
    }
}

/// A bar of `sides` flat faces through `points`.
fn add_tube(mesh: &mut Mesh, points: &[Vec3], radius: f32, sides: u32, color: Vec3) {
    for pair in points.windows(2) {
        mesh.add_bar(pair[0], pair[1], radius, sides, color);
    }
}

/// A ball of `rings` × twice as many faces, with rounded normals if `smooth`.
fn add_ball(mesh: &mut Mesh, centre: Vec3, radius: f32, rings: u32, smooth: bool, color: Vec3) {
    let out = |ring: u32, side: u32| {
        let polar = std::f32::consts::PI * ring as f32 / rings as f32;
        let angle = std::f32::consts::PI * side as f32 / rings as f32;
        vec3(polar.sin() * angle.cos(), -polar.cos(), -polar.sin() * angle.sin())
    };
    for ring in 0..rings {
        for side in 0..2 * rings {
            let corners = [
                out(ring, side),
                out(ring, side + 1),
                out(ring + 1, side + 1),
                out(ring + 1, side),
            ];
            if smooth {
                let corners = corners.map(|n| (centre + n * radius, n));
                let material = mesh.current_material();
                mesh.add_fan(&corners, color, material);
            } else {
                mesh.add_polygon(&corners.map(|n| centre + n * radius), color);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_a_scene_that_can_be_drawn_and_is_the_same_each_time() {
        for (name, purpose) in NAMES.into_iter().chain(FURTHER) {
            let scene = Scene::from_name(name).expect(name);
            scene.check().unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(scene == Scene::from_name(name).expect(name), "{name}");
            assert!(purpose.len() < 100, "{name} is for more than one line");
            let (triangles, most) = (scene.triangles.len(), 90_000);
            assert!(triangles < most, "{name} has {triangles} triangles");
        }
    }

    #[test]
    fn an_unknown_name_is_refused_with_those_that_there_are() {
        let message = Scene::from_name("rooof").expect_err("no scene").to_string();
        assert!(
            message.contains("rooof") && message.contains("roof, grooves"),
            "{message}"
        );
    }
}
