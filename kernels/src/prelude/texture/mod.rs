//! Images of any size, and how they are filtered.

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

/// What a texel can be: `f32`, `i32`, `u32`, and vectors of 2 to 4 of them.
pub trait Texel: Copy {}

/// What a sampler can weigh: `f32` and vectors of 2 to 4 of them.
pub trait Filterable: Texel + Add<Output = Self> + Mul<f32, Output = Self> {
    /// Component `k` of up to four; 0 beyond the last.
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
/// `T` is `f32`, `Vec2`, `Vec3` or `Vec4`, or their like of `i32` or `u32`: the components that the kernel uses. Integers are
/// read texel by texel alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture<T> {
    size: UVec2,
    levels: Vec<Vec<T>>,
}

/// A side of a level: half of that of the level before, rounded down but at least 1.
fn smaller(side: u32, level: usize) -> u32 {
    side.checked_shr(level as u32).unwrap_or(0).max(1)
}

impl<T: Texel> Texture<T> {
    /// An image of `size` texels from rows, top row first. Panics unless there is one texel for each place
    /// and at least one of them.
    pub fn new(size: UVec2, texels: Vec<T>) -> Self {
        Texture::with_levels(size, vec![texels])
    }

    /// An image with smaller levels, the finest first: each has half the width and height of the one before, rounded down but
    /// at least 1. Panics unless each level has one texel for each place and there is at least one of them.
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

    /// Width and height of `level`, 0 the finest, or of the smallest one beyond the end.
    pub fn size_of_level(&self, level: usize) -> UVec2 {
        let level = level.min(self.levels.len() - 1);
        UVec2::new(smaller(self.size.x, level), smaller(self.size.y, level))
    }

    /// All texels of the finest level, row by row from the top.
    pub fn texels(&self) -> &[T] {
        &self.levels[0]
    }

    /// All texels of a level that there is, row by row from the top.
    pub fn texels_of_level(&self, level: usize) -> &[T] {
        &self.levels[level]
    }

    /// The texel at `coord`, or the nearest one on the border if `coord` lies outside. At four coordinates of a quad, four
    /// texels.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P) -> P::Of<T> {
        coord.each(|coord| self.at(coord, Address::Clamp))
    }

    /// The texel of `level`, 0 the finest and the smallest one beyond the end, at `coord`, or the nearest one on the border if
    /// `coord` lies outside.
    pub fn load_level<P: PerLane<IVec2>>(&self, coord: P, level: usize) -> P::Of<T> {
        let level = level.min(self.levels.len() - 1);
        coord.each(|coord| self.at_level(level, coord, Address::Clamp))
    }

    /// Whether it has the size and the number of levels of another.
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
    /// The image at `uv`, (0, 0) its upper left and (1, 1) its lower right corner, as `sampler` reads its finest level.
    /// A GPU weighs texels in steps of 1/256.
    pub fn sample<P: PerLane<Vec2>>(&self, sampler: &Sampler, uv: P) -> P::Of<T> {
        uv.each(|uv| self.sampled(0, sampler, uv))
    }

    /// The image at `uv` and `level`, 0 the finest; between two levels as `sampler.mip` says, outside the nearest one. A GPU
    /// weighs levels, as texels, in steps of 1/256; half-way between two, one that takes the nearest may take either.
    pub fn sample_level<P: PerLane<Vec2>>(&self, sampler: &Sampler, uv: P, level: P::Of<f32>) -> P::Of<T> {
        uv.with(level, |uv, level| {
            filter::between_levels(self.levels(), sampler.mip, level, |k| self.sampled(k, sampler, uv))
        })
    }

    /// The image at `uv`, of the level at which a step of `ddx` or of `ddy`, of the longer one, is one texel. A GPU may take for
    /// that length anything between the larger and the sum of the step's two components, and has few bits of the logarithm: it
    /// is off by up to half a level.
    pub fn sample_grad(&self, sampler: &Sampler, uv: Vec2, ddx: Vec2, ddy: Vec2) -> T {
        self.sample_level(sampler, uv, filter::level_of(self.size, ddx, ddy))
    }

    /// Component `component` of the four texels that a linear filter would weigh at `uv`: lower left, lower right,
    /// upper right, upper left.
    pub fn gather<P: PerLane<Vec2>>(&self, component: usize, sampler: &Sampler, uv: P) -> P::Of<Vec4> {
        let texel = |coord| self.at(coord, Address::Clamp).component(component);
        uv.each(|uv| gather(self.size, sampler, uv, texel))
    }

    /// A level that there is, at `uv`.
    fn sampled(&self, level: usize, sampler: &Sampler, uv: Vec2) -> T {
        sample(self.size_of_level(level), sampler, uv, |coord| {
            self.at_level(level, coord, Address::Clamp)
        })
    }
}
