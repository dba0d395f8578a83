//! Meanings of a kernel's inputs: one table for `engine.toml`, `--bind`, messages, documents and tests.

use straightline_manifest::{Dimension, SampleType, Scalar, ValueType};

/// Word of `--bind` for an input that the user sets, whatever its name.
pub const OWN: &str = "own";

/// A meaning that an engine's data can have.
#[derive(Debug, PartialEq, Eq)]
pub struct Meaning {
    /// Name in `engine.toml` and in `--bind`.
    pub name: &'static str,
    /// Further names of inputs that have this meaning.
    pub aliases: &'static [&'static str],
    /// Type of the input.
    pub holds: Holds,
    /// Value, with its unit and its space.
    pub doc: &'static str,
}

/// Type of a meaning's input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// A two-dimensional texture of floats with any number of components.
    Picture,
    /// A two-dimensional texture of floats with this number of components.
    Texels(u8),
    /// An `f32`.
    Float,
    /// A number of any scalar type.
    Count,
    /// A `Mat4`.
    Matrix,
}

/// The meanings, in the order of the documents.
pub static MEANINGS: [Meaning; 12] = [
    Meaning {
        name: "color",
        aliases: &["colour", "image", "picture", "source", "src", "input", "img"],
        holds: Holds::Picture,
        doc: "The picture that is filtered.",
    },
    Meaning {
        name: "depth",
        aliases: &["linear_depth", "view_depth", "scene_depth"],
        holds: Holds::Texels(1),
        doc: "Distance from the camera along its view, in scene units.",
    },
    Meaning {
        name: "device_depth",
        aliases: &["raw_depth", "depth_buffer", "window_depth"],
        holds: Holds::Texels(1),
        doc: "Depth as it is rasterised: 0 at the near plane and 1 at the far one, not linear.",
    },
    Meaning {
        name: "normal",
        aliases: &["normals", "view_normal", "view_normals"],
        holds: Holds::Texels(3),
        doc: "Unit normal in view space: x right, y up, z towards the viewer.",
    },
    Meaning {
        name: "world_normal",
        aliases: &["world_normals"],
        holds: Holds::Texels(3),
        doc: "Unit normal in the engine's world space.",
    },
    Meaning {
        name: "motion",
        aliases: &["velocity", "motion_vector", "motion_vectors"],
        holds: Holds::Texels(2),
        doc: "Place of the surface in the frame before, less its place now, in pixels, y down.",
    },
    Meaning {
        name: "time",
        aliases: &["seconds"],
        holds: Holds::Float,
        doc: "Seconds since a start that the engine chooses.",
    },
    Meaning {
        name: "frame",
        aliases: &["frame_index", "frame_count", "frame_number"],
        holds: Holds::Count,
        doc: "Number of the frame.",
    },
    Meaning {
        name: "near",
        aliases: &["near_plane", "camera_near"],
        holds: Holds::Float,
        doc: "Distance of the camera's near plane, in scene units.",
    },
    Meaning {
        name: "far",
        aliases: &["far_plane", "camera_far"],
        holds: Holds::Float,
        doc: "Distance of the camera's far plane, in scene units.",
    },
    Meaning {
        name: "projection",
        aliases: &["projection_matrix"],
        holds: Holds::Matrix,
        doc: "Projection of the camera, from view space to clip space as the engine defines it.",
    },
    Meaning {
        name: "inverse_projection",
        aliases: &["projection_inverse", "inv_projection"],
        holds: Holds::Matrix,
        doc: "Inverse of the camera's projection.",
    },
];

impl Meaning {
    /// Returns the meaning of this name.
    pub fn find(name: &str) -> Option<&'static Meaning> {
        MEANINGS.iter().find(|meaning| meaning.name == name)
    }

    /// Returns the meaning that an input of this name has.
    pub fn of_input(name: &str) -> Option<&'static Meaning> {
        let mut all = MEANINGS.iter();
        all.find(|meaning| meaning.name == name || meaning.aliases.contains(&name))
    }

    /// Returns whether this is the picture that is filtered.
    pub fn is_picture(&self) -> bool {
        self.holds == Holds::Picture
    }
}

impl Holds {
    /// Returns the type as a kernel declares it.
    pub fn declared(self) -> &'static str {
        match self {
            Holds::Picture | Holds::Texels(4..) => "&Frame<Vec4>",
            Holds::Texels(0 | 1) => "&Frame<f32>",
            Holds::Texels(2) => "&Frame<Vec2>",
            Holds::Texels(3) => "&Frame<Vec3>",
            Holds::Float => "f32",
            Holds::Count => "u32",
            Holds::Matrix => "Mat4",
        }
    }

    /// Returns whether this is a texture.
    pub fn is_texture(self) -> bool {
        matches!(self, Holds::Picture | Holds::Texels(_))
    }

    /// Returns whether a texture has this type.
    pub fn fits_texture(self, dimension: Dimension, sample_type: SampleType, components: u8) -> bool {
        let flat = is_flat(dimension, sample_type);
        match self {
            Holds::Picture => flat,
            Holds::Texels(needed) => flat && components == needed,
            _ => false,
        }
    }

    /// Returns whether a uniform has this type.
    pub fn fits_uniform(self, ty: ValueType, part_of_matrix: bool) -> bool {
        match self {
            Holds::Float => !part_of_matrix && ty.components() == 1 && ty.scalar() == Scalar::F32,
            Holds::Count => !part_of_matrix && ty.components() == 1,
            Holds::Matrix => part_of_matrix && ty.components() == 4 && ty.scalar() == Scalar::F32,
            _ => false,
        }
    }
}

/// Returns whether a texture is one that engines render to: two-dimensional, of floats.
pub fn is_flat(dimension: Dimension, sample_type: SampleType) -> bool {
    dimension == Dimension::D2 && matches!(sample_type, SampleType::Filterable | SampleType::Unfilterable)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_has_one_meaning() {
        let mut names: Vec<&str> = MEANINGS
            .iter()
            .flat_map(|m| m.aliases.iter().copied().chain([m.name]))
            .collect();
        names.push(OWN);
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
        assert!(
            MEANINGS
                .iter()
                .all(|m| m.doc.ends_with('.') && Meaning::of_input(m.name) == Some(m))
        );
    }
}
