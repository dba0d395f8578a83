//! Images with one texel for each pixel of the output.

use super::quad::PerLane;
use super::texture::{self, Filterable, Sampler};
use glam::{IVec2, UVec2, Vec2, Vec4};

/// A single-sampled image with one texel for each pixel of the output. Bound as a `texture_2d` of `f32`, `i32`
/// or `u32`.
///
/// `T` is `f32`, `Vec2`, `Vec3` or `Vec4`, or the same of `i32` or `u32`: the components that the kernel uses. Images of
/// integers cannot be filtered.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame<T> {
    size: UVec2,
    texels: Vec<T>,
}

impl<T: Copy> Frame<T> {
    /// Creates an image of `size` from its texels, row by row from the top. Panics unless there is one texel for each pixel
    /// and at least one pixel.
    pub fn new(size: UVec2, texels: Vec<T>) -> Self {
        assert!(size.x > 0 && size.y > 0, "an image needs at least one texel");
        assert_eq!(
            texels.len(),
            (size.x * size.y) as usize,
            "one texel for each of {size} pixels"
        );
        Frame { size, texels }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// All texels, row by row from the top.
    pub fn texels(&self) -> &[T] {
        &self.texels
    }

    /// Returns the texel at `coord`, or the nearest one on the border if `coord` is outside. For a quad of coordinates,
    /// returns a quad of texels.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P) -> P::Of<T> {
        coord.each(|coord| self.texel(coord))
    }

    fn texel(&self, coord: IVec2) -> T {
        let inside = coord.clamp(IVec2::ZERO, self.size.as_ivec2() - 1);
        self.texels[(inside.y as u32 * self.size.x + inside.x as u32) as usize]
    }
}

impl<T: Filterable> Frame<T> {
    /// Samples the image at `uv` with `sampler`. (0, 0) is the upper left corner and (1, 1) the lower right.
    /// A GPU quantises filter weights to 1/256.
    pub fn sample<P: PerLane<Vec2>>(&self, sampler: &Sampler, uv: P) -> P::Of<T> {
        uv.each(|uv| texture::sample(self.size, sampler, uv, |coord| self.texel(coord)))
    }

    /// Returns component `component` of the four texels that a linear filter would weight at `uv`: lower left, lower right,
    /// upper right, upper left.
    pub fn gather<P: PerLane<Vec2>>(&self, component: usize, sampler: &Sampler, uv: P) -> P::Of<Vec4> {
        uv.each(|uv| texture::gather(self.size, sampler, uv, |coord| self.texel(coord).component(component)))
    }
}

/// A stack of [`Frame`]s, one layer for each geometry sample. Bound as a `texture_2d_array<f32>`.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameLayers<T> {
    layers: Vec<Frame<T>>,
}

impl<T: Copy> FrameLayers<T> {
    /// Creates a stack from its layers. Panics unless there is at least one and all have the same size.
    pub fn new(layers: Vec<Frame<T>>) -> Self {
        assert!(
            layers.windows(2).all(|pair| pair[0].size == pair[1].size),
            "layers of one size"
        );
        assert!(!layers.is_empty(), "a stack needs at least one layer");
        FrameLayers { layers }
    }

    /// Width and height in texels.
    pub fn size(&self) -> UVec2 {
        self.layers[0].size
    }

    /// The layers, first to last.
    pub fn layers(&self) -> &[Frame<T>] {
        &self.layers
    }

    /// Returns the texel of `layer` at `coord`, or the nearest one on the border if `coord` is outside.
    /// Panics if there is no such layer. A shader's manifest states how many it needs.
    pub fn load<P: PerLane<IVec2>>(&self, coord: P, layer: usize) -> P::Of<T> {
        self.layers[layer].load(coord)
    }
}
