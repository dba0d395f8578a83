//! Images of the whole surroundings of a point.

use super::filter::{between_levels, sample_cube};
use super::{Address, Filterable, Sampler, Texture};
use crate::prelude::quad::PerLane;
use glam::{UVec2, Vec3};

/// Six square images, the faces of a cube around a point. Bound as a `texture_cube<f32>`.
///
/// `T` is `f32`, `Vec2`, `Vec3` or `Vec4`. The largest component of a direction selects the face; on a tie, Z precedes Y, and Y
/// precedes X. Filtering is seamless: beyond an edge are the texels of the adjacent face, and where three faces meet,
/// the fourth texel is the mean of the three.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureCube<T> {
    faces: [Texture<T>; 6],
}

impl<T: Filterable> TextureCube<T> {
    /// Creates a cube from its faces, +X, -X, +Y, -Y, +Z, -Z, each with the top row first as in Vulkan and WebGPU. All levels of
    /// the faces are used. Panics unless the faces are square and have the same size and number of levels.
    pub fn new(faces: [Texture<T>; 6]) -> Self {
        let size = faces[0].size();
        assert!(
            size.x == size.y && faces.iter().all(|face| face.is_like(&faces[0])),
            "six square faces of one size, with as many levels"
        );
        TextureCube { faces }
    }

    /// Width and height of a face in texels.
    pub fn size(&self) -> UVec2 {
        self.faces[0].size()
    }

    /// Number of levels.
    pub fn levels(&self) -> usize {
        self.faces[0].levels()
    }

    /// Faces in the order +X, -X, +Y, -Y, +Z, -Z.
    pub fn faces(&self) -> &[Texture<T>; 6] {
        &self.faces
    }

    /// Samples the finest level in `direction`, which may have any length but 0. The sampler's address mode has no
    /// effect. A GPU quantises filter weights to 1/256.
    pub fn sample<P: PerLane<Vec3>>(&self, sampler: &Sampler, direction: P) -> P::Of<T> {
        direction.each(|direction| self.sampled(0, sampler, direction))
    }

    /// Samples `level` in `direction`, which may have any length but 0. Level 0 is the finest. Between two levels `sampler.mip`
    /// applies; a level out of range is clamped.
    pub fn sample_level<P: PerLane<Vec3>>(&self, sampler: &Sampler, direction: P, level: P::Of<f32>) -> P::Of<T> {
        direction.with(level, |direction, level| {
            between_levels(self.levels(), sampler.mip, level, |k| {
                self.sampled(k, sampler, direction)
            })
        })
    }

    fn sampled(&self, level: usize, sampler: &Sampler, direction: Vec3) -> T {
        let side = self.faces[0].size_of_level(level).x;
        sample_cube(side, sampler.filter, direction, |face, coord| {
            self.faces[face].at_level(level, coord, Address::Clamp)
        })
    }
}
