//! Images of any size, and their samplers.

mod cube;
mod depth;
mod filter;
mod layered;
mod sampler;
mod volume;

use super::quad::PerLane;
use glam::{IVec2, IVec3, IVec4, UVec2, UVec3, UVec4, Vec2, Vec3, Vec4};
use std::ops::{Add, Mul};

pub use cube::TextureCube;
pub use depth::{DepthCube, DepthTexture, DepthTextureArray};
pub(super) use filter::{gather, sample};
pub use layered::{Multisampled, TextureArray};
pub use sampler::{Address, Comparison, ComparisonSampler, Filter, Sampler};
pub use volume::Texture3D;

/// Type of a texel: `f32`, `i32`, `u32`, and vectors of 2 to 4 of them.
pub trait Texel: Copy {}

/// Type that a sampler can filter: `f32` and vectors of 2 to 4 of them.
pub trait Filterable: Texel + Add<Output = Self> + Mul<f32, Output = Self> {
    /// Returns component `k` of up to four; 0 past the last.
    fn component(self, k: usize) -> f32;
}

macro_rules! texels {
    ($($ty:ty)*) => { $(impl Texel for $ty {})* };
}

texels! { f32 Vec2 Vec3 Vec4 i32 IVec2 IVec3 IVec4 u32 UVec2 UVec3 UVec4 }

impl Filterable for f32 {
    fn component(self, k: usize) -> f32 {
        if k == 0 { self } else { 0.0 }
    }
}

macro_rules! filterable {
    ($($ty:ty)*) => { $(
        impl Filterable for $ty {
            fn component(self, k: usize) -> f32 {
                self.to_array().get(k).copied().unwrap_or(0.0)
            }
        }
    )* };
}

filterable! { Vec2 Vec3 Vec4 }

/// A single-sampled image of any size. Bound as a `texture_2d` of `f32`, `i32` or `u32`.
///
/// `T` is `f32`, `Vec2`, `Vec3` or `Vec4`, or the same of `i32` or `u32`: the components that the kernel uses. Images of
/// integers cannot be filtered.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture<T> {
    size: UVec2,
    levels: Vec<Vec<T>>,
}

/// Side of a level: `side` halved `level` times, rounded down but at least 1.
fn smaller(side: u32, level: usize) -> u32 {
    side.checked_shr(level as u32).unwrap_or(0).max(1)
}

impl<T: Texel> Texture<T> {
    /// Creates an image of `size` from its texels, row by row from the top. Panics unless there is one texel for each position
    /// and at least one position.
    pub fn new(size: UVec2, texels: Vec<T>) -> Self {
        Texture::with_levels(size, vec![texels])
    }

    /// Creates an image with smaller levels, the finest first. Each has half the width and height of the previous, rounded down
    /// but at least 1. Panics unless each level has one texel for each position and there is at least one level.
    pub fn with_levels(size: UVec2, levels: Vec<Vec<T>>) -> Self {
        assert!(size.x > 0 && size.y > 0, "an image needs at least one texel");
        assert!(!levels.is_empty(), "an image needs at least one level");
        for (k, texels) in levels.iter().enumerate() {
            let size = UVec2::new(smaller(size.x, k), smaller(size.y, k));
            assert_eq!(
                texels.len(),
                (size.x * size.y) as usize,
                "one texel for each place of {size}"
            );
        }
        Texture { size, levels }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// Number of levels.
    pub fn levels(&self) -> usize {
        self.levels.len()
    }

    /// Width and height of `level`. Level 0 is the finest; a level out of bounds is the smallest.
    pub fn size_of_level(&self, level: usize) -> UVec2 {
        let level = level.min(self.levels.len() - 1);
        UVec2::new(smaller(self.size.x, level), smaller(self.size.y, level))
    }

    /// All texels of the finest level, row by row from the top.
    pub fn texels(&self) -> &[T] {
        &self.levels[0]
    }

    /// All texels of an existing level, row by row from the top.
    pub fn texels_of_level(&self, level: usize) -> &[T] {
        &self.levels[level]
    }

    /// Returns the texel at `coord`, or the nearest one on the border if `coord` is outside. For a quad of coordinates,
    /// returns a quad of texels.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P) -> P::Of<T> {
        coord.each(|coord| self.at(coord, Address::Clamp))
    }

    /// Returns the texel of `level` at `coord`, or the nearest one on the border if `coord` is outside. Level 0 is the finest; a
    /// level out of bounds is the smallest.
    pub fn load_level<P: PerLane<IVec2>>(&self, coord: P, level: usize) -> P::Of<T> {
        let level = level.min(self.levels.len() - 1);
        coord.each(|coord| self.at_level(level, coord, Address::Clamp))
    }

    /// Returns whether the size and the number of levels equal those of another texture.
    fn is_like(&self, other: &Texture<T>) -> bool {
        self.size == other.size && self.levels.len() == other.levels.len()
    }

    fn at(&self, coord: IVec2, address: Address) -> T {
        self.at_level(0, coord, address)
    }

    fn at_level(&self, level: usize, coord: IVec2, address: Address) -> T {
        let size = self.size_of_level(level);
        let (x, y) = (address.wrap(coord.x, size.x), address.wrap(coord.y, size.y));
        self.levels[level][(y * size.x + x) as usize]
    }
}

impl<T: Filterable> Texture<T> {
    /// Samples the finest level at `uv` with `sampler`. (0, 0) is the upper left corner and (1, 1) the lower right.
    /// A GPU quantises filter weights to 1/256.
    pub fn sample<P: PerLane<Vec2>>(&self, sampler: &Sampler, uv: P) -> P::Of<T> {
        uv.each(|uv| self.sampled(0, sampler, uv))
    }

    /// Samples at `uv` and `level`; 0 is the finest. Between two levels `sampler.mip` applies; a level out of range is clamped.
    /// A GPU quantises level weights to 1/256 as well. Half-way between two levels, a nearest filter may take either.
    pub fn sample_level<P: PerLane<Vec2>>(&self, sampler: &Sampler, uv: P, level: P::Of<f32>) -> P::Of<T> {
        uv.with(level, |uv, level| {
            filter::between_levels(self.levels(), sampler.mip, level, |k| self.sampled(k, sampler, uv))
        })
    }

    /// Samples at `uv`, at the level where a step of the longer of `ddx` and `ddy` is one texel. For that length a GPU may take
    /// anything between the larger component of the step and the sum of both. Its logarithm has few bits: the level is off by
    /// up to a half.
    pub fn sample_grad(&self, sampler: &Sampler, uv: Vec2, ddx: Vec2, ddy: Vec2) -> T {
        self.sample_level(sampler, uv, filter::level_of(self.size, ddx, ddy))
    }

    /// Returns component `component` of the four texels that a linear filter would weight at `uv`: lower left, lower right,
    /// upper right, upper left.
    pub fn gather<P: PerLane<Vec2>>(&self, component: usize, sampler: &Sampler, uv: P) -> P::Of<Vec4> {
        let texel = |coord| self.at(coord, Address::Clamp).component(component);
        uv.each(|uv| gather(self.size, sampler, uv, texel))
    }

    /// Samples an existing level at `uv`.
    fn sampled(&self, level: usize, sampler: &Sampler, uv: Vec2) -> T {
        sample(self.size_of_level(level), sampler, uv, |coord| {
            self.at_level(level, coord, Address::Clamp)
        })
    }
}
