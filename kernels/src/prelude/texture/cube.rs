//! Images of all that is around a point.

use super::filter::{between_levels, sample_cube};
use super::{Address, Filterable, Sampler, Texture};
use crate::prelude::quad::PerLane;
use glam::{UVec2, Vec3};

/// Six square images, the faces of a cube around a point. Bound as a `texture_cube<f32>`.
///
/// `T` is `f32`, `Vec2`, `Vec3` or `Vec4`. A direction finds its face by its largest component; where two are as large, Z goes
/// before Y, and Y before X. Filters are seamless: beyond an edge lie the texels of the next face, and where three faces meet
/// the fourth texel is the mean of the three.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureCube<T> {
    faces: [Texture<T>; 6],
}

impl<T: Filterable> TextureCube<T> {
    /// A cube from its faces, +X, -X, +Y, -Y, +Z, -Z, each with the upper row first as Vulkan and WebGPU have it, with as many
    /// levels as they have. Panics unless they are square, of one size and have as many levels.
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

    /// The faces, +X, -X, +Y, -Y, +Z, -Z.
    pub fn faces(&self) -> &[Texture<T>; 6] {
        &self.faces
    }

    /// What lies in `direction`, which may have any length but 0, as `sampler` reads its finest level; what the sampler says of
    /// borders is of no account. A GPU weighs texels in steps of 1/256.
    pub fn sample<P: PerLane<Vec3>>(&self, sampler: &Sampler, direction: P) -> P::Of<T> {
        direction.each(|direction| self.sampled(0, sampler, direction))
    }

    /// What lies in `direction`, which may have any length but 0, at `level`, 0 the finest; between two levels as `sampler.mip`
    /// says, outside the nearest one.
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
