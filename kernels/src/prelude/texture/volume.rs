//! Volumes: colour tables, clouds, distance fields.

use super::filter::{between_levels, sample_volume};
use super::{Filterable, Sampler, Texel, smaller};
use crate::prelude::quad::PerLane;
use glam::{IVec3, UVec3, Vec3};

/// A volume of any size. Bound as a `texture_3d` of `f32`, `i32` or `u32`.
///
/// `T` is as for [`Texture`](super::Texture).
#[derive(Clone, Debug, PartialEq)]
pub struct Texture3D<T> {
    size: UVec3,
    levels: Vec<Vec<T>>,
}

impl<T: Texel> Texture3D<T> {
    /// Creates a volume from its texels, slice by slice. Panics unless there is one texel for each position and at least one.
    pub fn new(size: UVec3, texels: Vec<T>) -> Self {
        Texture3D::with_levels(size, vec![texels])
    }

    /// Creates a volume with smaller levels, the finest first. Each has half the width, height and depth of the previous, rounded
    /// down but at least 1. Panics unless each level has one texel for each position and there is at least one level.
    pub fn with_levels(size: UVec3, levels: Vec<Vec<T>>) -> Self {
        assert!(size.min_element() > 0, "a volume needs at least one texel");
        assert!(!levels.is_empty(), "a volume needs at least one level");
        for (k, texels) in levels.iter().enumerate() {
            let size = UVec3::from_array(size.to_array().map(|side| smaller(side, k)));
            assert_eq!(
                texels.len(),
                (size.x * size.y * size.z) as usize,
                "one texel for each place of {size}"
            );
        }
        Texture3D { size, levels }
    }

    /// Width, height and depth in texels.
    pub fn size(&self) -> UVec3 {
        self.size
    }

    /// Number of levels.
    pub fn levels(&self) -> usize {
        self.levels.len()
    }

    /// All texels of an existing level, slice by slice and row by row.
    pub fn texels_of_level(&self, level: usize) -> &[T] {
        &self.levels[level]
    }

    /// Returns the texel at `coord`, or the nearest one on the border if `coord` is outside.
    pub fn load<P: PerLane<IVec3>>(&self, coord: P) -> P::Of<T> {
        coord.each(|coord| self.at(0, coord.clamp(IVec3::ZERO, self.size.as_ivec3() - 1)))
    }

    fn size_at(&self, level: usize) -> UVec3 {
        UVec3::from_array(self.size.to_array().map(|side| smaller(side, level)))
    }

    fn at(&self, level: usize, inside: IVec3) -> T {
        let (size, at) = (self.size_at(level), inside.as_uvec3());
        self.levels[level][((at.z * size.y + at.y) * size.x + at.x) as usize]
    }
}

impl<T: Filterable> Texture3D<T> {
    /// Samples the finest level at `place` with `sampler`; (0, 0, 0) and (1, 1, 1) are opposite corners. A GPU quantises filter
    /// weights to 1/256.
    pub fn sample<P: PerLane<Vec3>>(&self, sampler: &Sampler, place: P) -> P::Of<T> {
        place.each(|place| self.sampled(0, sampler, place))
    }

    /// Samples at `place` and `level`; 0 is the finest. Between levels `sampler.mip` applies; a level out of range is clamped.
    pub fn sample_level<P: PerLane<Vec3>>(&self, sampler: &Sampler, place: P, level: P::Of<f32>) -> P::Of<T> {
        place.with(level, |place, level| {
            between_levels(self.levels(), sampler.mip, level, |k| self.sampled(k, sampler, place))
        })
    }

    fn sampled(&self, level: usize, sampler: &Sampler, place: Vec3) -> T {
        sample_volume(self.size_at(level), sampler, place, |coord| self.at(level, coord))
    }
}
