//! Scenes that the testbed draws: triangles with materials, a sun, a sky and a camera.
//!
//! A [`Scene`] is plain data that every renderer reads alike. [`Scene::from_name`] makes one of [`NAMES`] without any file;
//! [`load_scene()`] reads a model, with the feature `models`. World space is right-handed with y up; lengths are in scene units.

mod builtin;
mod camera;
mod error;
#[cfg_attr(not(feature = "models"), path = "without_models.rs")]
mod load;
mod mesh;
mod named;
mod textures;

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

pub use builtin::builtin_scene;
pub use camera::{Camera, Viewpoint};
pub use error::SceneError;
pub use load::{load_scene, load_seen};
pub use named::{FURTHER, NAMES};
pub(crate) use textures::decode_texel;
pub use textures::{Image, Textures};

/// File name extensions that [`load_scene()`] knows, in lower case.
pub const EXTENSIONS: [&str; 3] = ["gltf", "glb", "obj"];

/// Linear depth where no geometry is seen.
///
/// Far beyond any geometry, yet finite: the difference of two sky depths is then 0, where that of two infinite ones
/// is not a number. A scene's own geometry must lie nearer; [`Scene::check`] sees to that.
pub const SKY_DEPTH: f32 = 1.0e6;

/// Everything that a renderer needs to know. The camera sees triangles from either side.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Corners of the triangles.
    pub vertices: Vec<Vertex>,
    /// Three indices into `vertices` for each triangle, counter-clockwise seen from the side its normals point to.
    pub triangles: Vec<[u32; 3]>,
    /// Textures, which vertices name by number.
    pub textures: Textures,
    /// The one light with a direction.
    pub sun: Sun,
    /// Background, and light from all around.
    pub sky: Sky,
    /// More light from all around on a white surface: linear RGB to multiply with 1, x, y, z, xy, yz, 3z² − 1, xz and x² − y² of
    /// the normal in world space.
    pub environment: [[f32; 3]; 9],
    /// At most [`MAX_LAMPS`].
    pub lamps: Vec<Lamp>,
    /// Balls that cast shadows in the light of lamps and sun, whatever triangles there are. At most [`MAX_SHADES`].
    pub shades: Vec<Shade>,
    /// Camera that sees the scene.
    pub camera: Camera,
}

/// A corner of a triangle. Renderers interpolate position, normal, colour and place in a texture across it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    /// In world space.
    pub position: [f32; 3],
    /// Unit vector in world space.
    pub normal: [f32; 3],
    /// Linear RGB, the share of light reflected diffusely, each in 0..=1.
    pub color: [f32; 3],
    /// A [`Material`] as a number. All corners of a triangle have the same.
    pub material: u32,
    /// In its texture: (0, 0) is the upper left corner, (1, 1) the lower right one, and beyond it repeats.
    pub uv: [f32; 2],
    /// 0 for none, else 1 and the number of one of the scene's images, whose colours are multiplied with. All corners of a
    /// triangle have the same.
    pub texture: u32,
    /// Texels of the image to a scene unit of the surface.
    pub density: f32,
}

/// Material of a surface, beyond its vertices' colour.
#[repr(u32)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Material {
    /// Nothing more.
    #[default]
    Plain = 0,
    /// Tiles of one unit with grooves between, laid out in the world's x and z.
    Tiles = 1,
    /// A fence of crossed wires, alpha-tested: between them it is not there. Laid out in the world's x + z and y, so it
    /// stands upright along x or along z.
    ChainLink = 2,
    /// In the sun only between hard shadows of slats above, half a unit apart along the world's x.
    Slats = 3,
    /// Polished: a narrow highlight, brighter than 1.
    Glossy = 4,
    /// A light: its colour times [`EMISSION`], whatever falls on it.
    Emissive = 5,
    /// Painted with dark dots that have hard edges, three to a unit of the world.
    Dots = 6,
    /// Studs, four to a unit of the world, which normals alone show, as of a normal map; a rough highlight.
    Studded = 7,
}

/// Radiance of a white [`Material::Emissive`], where a white surface in the sun is about 1.
pub const EMISSION: f32 = 50.0;

/// Light from one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector towards the sun, in world space.
    pub direction: [f32; 3],
    /// Linear RGB of a white surface that faces the sun and nothing else lights.
    pub color: [f32; 3],
}

/// Most lamps of a scene.
pub const MAX_LAMPS: usize = 4;

/// Most balls of a scene that cast shadows.
pub const MAX_SHADES: usize = 8;

/// Light from one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// In world space.
    pub place: [f32; 3],
    /// Linear RGB of a white surface close to it that faces it.
    pub color: [f32; 3],
    /// Distance at which half of the light is left, in scene units, above 0.
    pub reach: f32,
}

/// A ball that casts shadows with hard edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shade {
    /// In world space.
    pub centre: [f32; 3],
    /// In scene units, above 0.
    pub radius: f32,
}

/// Background where there is no geometry, and the light that comes from there. Linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// Straight up.
    pub zenith: [f32; 3],
    /// At the horizon, and of the haze that distance fades to.
    pub horizon: [f32; 3],
    /// Light from below on a white surface.
    pub ground: [f32; 3],
    /// Share of the light that haze takes per scene unit, as a negative binary logarithm; 0 for clear air.
    pub haze: f32,
}

impl Scene {
    /// Refuses what no renderer could draw: a scene without triangles, indices out of range, numbers that are not
    /// finite or beyond [`SKY_DEPTH`], normals that are not unit vectors, more lamps and shadows than there is room for, and a
    /// camera that does not see.
    ///
    /// # Errors
    ///
    /// [`SceneError::Unusable`], which names the first such thing.
    pub fn check(&self) -> Result<(), SceneError> {
        let refuse = |problem: String| Err(SceneError::Unusable { problem });
        if self.triangles.is_empty() {
            return refuse("there are no triangles".to_owned());
        }
        let count = self.vertices.len();
        let beyond = |triangle: &[u32; 3]| triangle.iter().any(|index| *index as usize >= count);
        if let Some(at) = self.triangles.iter().position(beyond) {
            let corners = self.triangles[at];
            return refuse(format!(
                "triangle {at} has corners {corners:?}, and there are {count} vertices"
            ));
        }
        for (at, vertex) in self.vertices.iter().enumerate() {
            let numbers = [vertex.position, vertex.normal, vertex.color];
            let of_texture = [vertex.uv[0], vertex.uv[1], vertex.density];
            if numbers
                .iter()
                .chain([&of_texture])
                .flatten()
                .any(|number| !number.is_finite())
            {
                return refuse(format!("vertex {at} has a number that is not finite: {vertex:?}"));
            }
            if (Vec3::from(vertex.normal).length() - 1.0).abs() > 1.0e-3 {
                return refuse(format!(
                    "vertex {at} has the normal {:?}, not a unit vector",
                    vertex.normal
                ));
            }
            if vertex.texture as usize > self.textures.images.len() {
                let count = self.textures.images.len();
                return refuse(format!(
                    "vertex {at} has texture {}, and there are {count}",
                    vertex.texture
                ));
            }
            if Vec3::from(vertex.position).length() >= 0.5 * SKY_DEPTH {
                return refuse(format!("vertex {at} is {:?}, as far away as the sky", vertex.position));
            }
        }
        self.check_lamps().or_else(refuse)?;
        self.camera.check().or_else(refuse)
    }

    fn check_lamps(&self) -> Result<(), String> {
        let (lamps, shades) = (self.lamps.len(), self.shades.len());
        if lamps > MAX_LAMPS || shades > MAX_SHADES {
            return Err(format!(
                "there are {lamps} lamps and {shades} shades, and room for {MAX_LAMPS} and {MAX_SHADES}"
            ));
        }
        let usable =
            |length: f32, values: &[[f32; 3]]| length > 0.0 && values.as_flattened().iter().all(|v| v.is_finite());
        if let Some(lamp) = self
            .lamps
            .iter()
            .find(|lamp| !usable(lamp.reach, &[lamp.place, lamp.color]))
        {
            return Err(format!("a lamp has a number that is not finite, or no reach: {lamp:?}"));
        }
        if let Some(shade) = self.shades.iter().find(|shade| !usable(shade.radius, &[shade.centre])) {
            return Err(format!(
                "a shade has a number that is not finite, or no radius: {shade:?}"
            ));
        }
        match usable(1.0, &self.environment) {
            true => Ok(()),
            false => Err(format!(
                "the environment has a number that is not finite: {:?}",
                self.environment
            )),
        }
    }
}
