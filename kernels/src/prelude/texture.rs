//! Images of any size, and how they are filtered.

use super::quad::PerLane;
use glam::{IVec2, UVec2, Vec2, Vec3, Vec4};
use std::ops::{Add, Mul};

/// What a texel can be.
pub trait Texel: Copy + Add<Output = Self> + Mul<f32, Output = Self> {
    /// Component `k` of up to four; 0 beyond the last.
    fn component(self, k: usize) -> f32;
}

impl Texel for f32 {
    fn component(self, k: usize) -> f32 {
        if k == 0 { self } else { 0.0 }
    }
}

impl Texel for Vec2 {
    fn component(self, k: usize) -> f32 {
        self.to_array().get(k).copied().unwrap_or(0.0)
    }
}

impl Texel for Vec3 {
    fn component(self, k: usize) -> f32 {
        self.to_array().get(k).copied().unwrap_or(0.0)
    }
}

impl Texel for Vec4 {
    fn component(self, k: usize) -> f32 {
        self.to_array().get(k).copied().unwrap_or(0.0)
    }
}

/// How texels between which a coordinate falls are weighed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The nearest counts alone.
    Nearest,
    /// The four around it, by their distance.
    #[default]
    Linear,
}

/// What lies beyond the border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Address {
    /// The border's texels.
    #[default]
    Clamp,
    /// The image again.
    Repeat,
    /// The image mirrored.
    Mirror,
}

impl Address {
    fn wrap(self, k: i32, size: u32) -> u32 {
        let n = size as i32;
        let inside = match self {
            Address::Clamp => k.clamp(0, n - 1),
            Address::Repeat => k.rem_euclid(n),
            Address::Mirror => {
                let k = k.rem_euclid(2 * n);
                k.min(2 * n - 1 - k)
            }
        };
        inside as u32
    }

    fn inside(self, coord: IVec2, size: UVec2) -> IVec2 {
        IVec2::new(self.wrap(coord.x, size.x) as i32, self.wrap(coord.y, size.y) as i32)
    }
}

/// How a [`Texture`] is read between its texels. Bound as a `sampler`, which the host makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sampler {
    /// How texels are weighed.
    pub filter: Filter,
    /// What lies beyond the border.
    pub address: Address,
}

/// When a comparison holds: reference, comparison, stored depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Comparison {
    /// `reference < depth`.
    Less,
    /// `reference <= depth`.
    #[default]
    LessEqual,
    /// `reference > depth`.
    Greater,
    /// `reference >= depth`.
    GreaterEqual,
}

impl Comparison {
    /// 1 if it holds of a reference and a stored depth, else 0.
    fn of(self, reference: f32, depth: f32) -> f32 {
        let holds = match self {
            Comparison::Less => reference < depth,
            Comparison::LessEqual => reference <= depth,
            Comparison::Greater => reference > depth,
            Comparison::GreaterEqual => reference >= depth,
        };
        f32::from(u8::from(holds))
    }
}

/// How a [`DepthTexture`] is compared. Bound as a `sampler_comparison`, which the host makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ComparisonSampler {
    /// When a texel counts as 1.
    pub comparison: Comparison,
    /// How results are weighed.
    pub filter: Filter,
}

/// A single-sampled image of any size. Bound as a `texture_2d<f32>`.
///
/// `T` is `f32`, `Vec2`, `Vec3` or `Vec4`: the components that the kernel uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture<T> {
    size: UVec2,
    texels: Vec<T>,
}

impl<T: Texel> Texture<T> {
    /// An image of `size` texels from rows, top row first. Panics unless there is one texel for each place
    /// and at least one of them.
    pub fn new(size: UVec2, texels: Vec<T>) -> Self {
        assert!(size.x > 0 && size.y > 0, "an image needs at least one texel");
        assert_eq!(
            texels.len(),
            (size.x * size.y) as usize,
            "one texel for each place of {size}"
        );
        Texture { size, texels }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// All texels, row by row from the top.
    pub fn texels(&self) -> &[T] {
        &self.texels
    }

    /// The texel at `coord`, or the nearest one on the border if `coord` lies outside. At four coordinates of a quad, four
    /// texels.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P) -> P::Of<T> {
        coord.each(|coord| self.at(coord, Address::Clamp))
    }

    /// The image at `uv`, (0, 0) its upper left and (1, 1) its lower right corner, as `sampler` reads it.
    /// A GPU weighs texels in steps of 1/256.
    pub fn sample<P: PerLane<Vec2>>(&self, sampler: &Sampler, uv: P) -> P::Of<T> {
        uv.each(|uv| sample(self.size, sampler, uv, |coord| self.at(coord, Address::Clamp)))
    }

    /// Component `component` of the four texels that a linear filter would weigh at `uv`: lower left, lower right,
    /// upper right, upper left.
    pub fn gather<P: PerLane<Vec2>>(&self, component: usize, sampler: &Sampler, uv: P) -> P::Of<Vec4> {
        let texel = |coord| self.at(coord, Address::Clamp).component(component);
        uv.each(|uv| gather(self.size, sampler, uv, texel))
    }

    fn at(&self, coord: IVec2, address: Address) -> T {
        let (x, y) = (address.wrap(coord.x, self.size.x), address.wrap(coord.y, self.size.y));
        self.texels[(y * self.size.x + x) as usize]
    }
}

/// What `sampler` makes of an image of `size` at `uv`; `texel` is only asked inside.
pub(super) fn sample<T: Texel>(size: UVec2, sampler: &Sampler, uv: Vec2, texel: impl Fn(IVec2) -> T) -> T {
    filtered(sampler.filter, uv * size.as_vec2(), |coord| {
        texel(sampler.address.inside(coord, size))
    })
}

/// The four texels that a linear filter would weigh: lower left, lower right, upper right, upper left.
pub(super) fn gather(size: UVec2, sampler: &Sampler, uv: Vec2, texel: impl Fn(IVec2) -> f32) -> Vec4 {
    let (corner, _) = footprint(uv * size.as_vec2());
    let tap = |x, y| texel(sampler.address.inside(corner + IVec2::new(x, y), size));
    Vec4::new(tap(0, 1), tap(1, 1), tap(1, 0), tap(0, 0))
}

/// What a filter makes of the texels around a place.
fn filtered<T: Texel>(filter: Filter, at: Vec2, texel: impl Fn(IVec2) -> T) -> T {
    match filter {
        Filter::Nearest => texel(at.floor().as_ivec2()),
        Filter::Linear => {
            let (corner, t) = footprint(at);
            let tap = |x, y| texel(corner + IVec2::new(x, y));
            let upper = tap(0, 0) * (1.0 - t.x) + tap(1, 0) * t.x;
            let lower = tap(0, 1) * (1.0 - t.x) + tap(1, 1) * t.x;
            upper * (1.0 - t.y) + lower * t.y
        }
    }
}

/// The upper left of the four texels around a place, and the weights of those to the right and below.
fn footprint(at: Vec2) -> (IVec2, Vec2) {
    let from = at - 0.5;
    let corner = from.floor();
    (corner.as_ivec2(), from - corner)
}

/// Depths of any size, 0 to 1, to be compared. Bound as a `texture_depth_2d`.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthTexture {
    depths: Texture<f32>,
}

impl DepthTexture {
    /// Depths from rows, as [`Texture::new`].
    pub fn new(size: UVec2, depths: Vec<f32>) -> Self {
        DepthTexture {
            depths: Texture::new(size, depths),
        }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.depths.size()
    }

    /// All depths, row by row from the top.
    pub fn texels(&self) -> &[f32] {
        self.depths.texels()
    }

    /// The depth at `coord`, or the nearest one on the border if `coord` lies outside.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P) -> P::Of<f32> {
        self.depths.load(coord)
    }

    /// How much of what lies at `uv` passes the comparison with `reference`: 0 to 1. Beyond the border lie its texels.
    pub fn compare<P: PerLane<Vec2>>(&self, sampler: &ComparisonSampler, uv: P, reference: P::Of<f32>) -> P::Of<f32> {
        uv.with(reference, |uv, reference| {
            filtered(sampler.filter, uv * self.depths.size.as_vec2(), |coord| {
                sampler.comparison.of(reference, self.depths.at(coord, Address::Clamp))
            })
        })
    }

    /// Which of the four texels that a linear filter would weigh at `uv` pass the comparison, 1 or 0 each: lower left,
    /// lower right, upper right, upper left.
    pub fn gather_compare<P: PerLane<Vec2>>(
        &self,
        sampler: &ComparisonSampler,
        uv: P,
        reference: P::Of<f32>,
    ) -> P::Of<Vec4> {
        uv.with(reference, |uv, reference| {
            let depths = Sampler::default();
            gather(self.depths.size, &depths, uv, |coord| {
                sampler.comparison.of(reference, self.depths.at(coord, Address::Clamp))
            })
        })
    }
}

/// An image of any size with several samples a texel. Bound as a `texture_multisampled_2d<f32>`.
#[derive(Clone, Debug, PartialEq)]
pub struct Multisampled<T> {
    samples: Vec<Texture<T>>,
}

impl<T: Texel> Multisampled<T> {
    /// An image from the images of each sample. Panics unless there are at least two and all have the same size.
    pub fn new(samples: Vec<Texture<T>>) -> Self {
        assert!(samples.len() > 1, "at least two samples a texel");
        assert!(
            samples.windows(2).all(|pair| pair[0].size == pair[1].size),
            "samples of one size"
        );
        Multisampled { samples }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.samples[0].size()
    }

    /// The images of each sample.
    pub fn samples(&self) -> &[Texture<T>] {
        &self.samples
    }

    /// Sample `sample` of the texel at `coord`, or of the nearest one on the border if `coord` lies outside.
    /// Panics if there is no such sample; a shader's manifest states how many it needs.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P, sample: usize) -> P::Of<T> {
        self.samples[sample].load(coord)
    }
}
