//! Pictures that the passes of a chain draw.

use super::frame::Frame;
use super::texture::{Texel, Texture};
use glam::{IVec2, UVec2};

/// An image that [`draw`] can return: a [`Texture`], or a [`Frame`] for a kernel that takes one.
pub trait Picture {
    /// Type of a texel.
    type Texel;

    /// Creates an image of `size` from its texels, row by row from the top.
    fn from_texels(size: UVec2, texels: Vec<Self::Texel>) -> Self;
}

impl<T: Copy> Picture for Frame<T> {
    type Texel = T;

    fn from_texels(size: UVec2, texels: Vec<T>) -> Self {
        Frame::new(size, texels)
    }
}

impl<T: Texel> Picture for Texture<T> {
    type Texel = T;

    fn from_texels(size: UVec2, texels: Vec<T>) -> Self {
        Texture::new(size, texels)
    }
}

/// Draws a picture of `size`, at least one texel: a pass of a chain. Calls `shade` for each pixel; (0, 0) is the upper left.
///
/// In a chain each call becomes a shader of its own, which reads the pictures that the closure mentions.
///
/// ```
/// use straightline_kernels::prelude::*;
///
/// /// Blurs along rows, then along columns.
/// pub fn blur(color: &Texture<Vec4>) -> Texture<Vec4> {
///     let rows: Texture<Vec4> = draw(color.size(), |pixel| {
///         (color.load(pixel - ivec2(1, 0)) + color.load(pixel) + color.load(pixel + ivec2(1, 0))) / 3.0
///     });
///     draw(color.size(), |pixel| {
///         (rows.load(pixel - ivec2(0, 1)) + rows.load(pixel) + rows.load(pixel + ivec2(0, 1))) / 3.0
///     })
/// }
///
/// let dot = Texture::new(uvec2(3, 1), vec![Vec4::ZERO, Vec4::splat(9.0), Vec4::ZERO]);
/// assert_eq!(blur(&dot).texels()[0], Vec4::splat(3.0));
/// ```
pub fn draw<P: Picture>(size: UVec2, shade: impl Fn(IVec2) -> P::Texel) -> P {
    let size = size.max(UVec2::ONE);
    let rows = (0..size.y as i32).flat_map(|y| (0..size.x as i32).map(move |x| IVec2::new(x, y)));
    P::from_texels(size, rows.map(shade).collect())
}
