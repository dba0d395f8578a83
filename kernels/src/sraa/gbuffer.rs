//! What the G-buffer holds, and how: depth and normals at every geometry sample.

use super::metric::Metric;
use super::options::{Guards, Sraa};
use super::pattern::Place;
use super::view::{Projection, View};
use crate::normals::{folded, unit};
use crate::prelude::*;

/// How the G-buffer holds depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// Along the view direction, in scene units; infinite where there is no geometry.
    Linear,
    /// As projected, by either projection: 0 at the near plane, 1 at the far plane.
    Perspective,
    /// As projected with near and far swapped: 1 at the near plane, 0 at the far plane.
    Reversed,
    /// As projected with near and far swapped and no far plane: 1 at the near plane, 0 infinitely far.
    ReversedInfinite,
}

/// How the G-buffer holds normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normals {
    /// As unit vectors, in a float format.
    Float,
    /// As 0.5 + 0.5 n, in a normalised format such as RGB8 or RGB10A2; renormalised if `renormalise` says so.
    Unorm,
    /// Unfolded to a square, each axis as 0.5 + 0.5 n, in a normalised format of two components such as RG8 or RG16.
    Octahedral,
    /// Unfolded to a square, each axis in -1..1, with the depth in the same texel: half the reads. The depth is the sum of
    /// the third and fourth component, so that two 16-bit floats hold one of 22 bits.
    Packed,
}

/// How the G-buffer holds the samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A layer for each; the pixel's centre, if that is shaded, in one more, the last (paper §3.4: one pass for each).
    Layers,
    /// Side by side in one large texture (the listing's superresolution buffers): sample s of c columns is at column s % c
    /// and row s / c of its pixel.
    Superresolution,
    /// The samples of a multisampled texture (paper §3.4: one pass for all).
    Multisampled,
    /// As layers, but depth in a storage buffer: the two come by different caches (paper §3.5). Of metrics that compare both.
    Split,
}

/// The G-buffer. A shader binds only what its layout, its metric and its encodings need.
///
/// Natively all are there, and those that are not read may be of any size: see [`GBuffer::unread`].
pub struct GBuffer {
    /// Of layout=layers.
    pub depth: FrameLayers<f32>,
    /// Of layout=layers and layout=split.
    pub normal: FrameLayers<Vec4>,
    /// Of layout=split: what `depth` is of layout=layers, row by row, layer after layer.
    pub depth_buffer: Buffer<f32>,
    /// Of layout=layers with normals=packed.
    pub packed: FrameLayers<Vec4>,
    /// Of layout=superresolution.
    pub depth_grid: Texture<f32>,
    /// Of layout=superresolution.
    pub normal_grid: Texture<Vec4>,
    /// Of layout=superresolution with normals=packed.
    pub packed_grid: Texture<Vec4>,
    /// Of layout=multisampled.
    pub depth_samples: Multisampled<f32>,
    /// Of layout=multisampled.
    pub normal_samples: Multisampled<Vec4>,
    /// Of layout=multisampled with normals=packed.
    pub packed_samples: Multisampled<Vec4>,
    /// At the pixel's centre, where that is shaded and the layout has no place for it.
    pub centre_depth: Frame<f32>,
    /// At the pixel's centre, where that is shaded and the layout has no place for it.
    pub centre_normal: Frame<Vec4>,
    /// At the pixel's centre, where that is shaded and the layout has no place for it.
    pub centre_packed: Frame<Vec4>,
}

/// The surface seen at one geometry sample.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Linear depth, at most 1e30.
    pub depth: f32,
    /// Unit normal; of normals=unorm that are compared as they are stored, half of it and 0.5.
    pub normal: Vec3,
}

/// More than any depth, and finite: the sky's infinite depth less itself is not a number.
pub(super) const DEEPEST: f32 = 1.0e30;

/// Less than any stored depth but 0.
const SHORTEST: f32 = 1.0e-30;

/// The surface seen at `place`, from `pixel`: as much of it as the metric compares.
pub(super) fn surface(cfg: &Sraa, gbuffer: &GBuffer, view: &View, pixel: IVec2, place: Place) -> Surface {
    let at = pixel + place.pixel;
    match cfg.normals {
        Normals::Packed => {
            let packed = gbuffer.packed(cfg, at, place);
            Surface {
                depth: linear(cfg, view, packed.z + packed.w),
                normal: decoded(cfg, packed),
            }
        }
        _ => Surface {
            depth: match cfg.metric {
                Metric::Normals => 0.0,
                _ => linear(cfg, view, gbuffer.depth(cfg, at, place)),
            },
            normal: match cfg.metric {
                Metric::Depth => Vec3::ZERO,
                _ => decoded(cfg, gbuffer.normal(cfg, at, place)),
            },
        },
    }
}

impl GBuffer {
    fn depth(&self, cfg: &Sraa, pixel: IVec2, place: Place) -> f32 {
        match (cfg.layout, place.centre) {
            (Layout::Layers, _) => self.depth.load(pixel, place.sample),
            (Layout::Split, _) => {
                let size = self.normal.size().as_ivec2();
                let at = pixel.clamp(IVec2::ZERO, size - 1);
                self.depth_buffer
                    .load(((place.sample as i32 * size.y + at.y) * size.x + at.x) as usize)
            }
            (_, true) => self.centre_depth.load(pixel),
            (Layout::Superresolution, _) => self
                .depth_grid
                .load(cfg.cell(self.depth_grid.size(), pixel, place.sample)),
            (Layout::Multisampled, _) => self.depth_samples.load(pixel, cfg.own(place.sample)),
        }
    }

    fn normal(&self, cfg: &Sraa, pixel: IVec2, place: Place) -> Vec4 {
        match (cfg.layout, place.centre) {
            (Layout::Layers | Layout::Split, _) => self.normal.load(pixel, place.sample),
            (_, true) => self.centre_normal.load(pixel),
            (Layout::Superresolution, _) => {
                self.normal_grid
                    .load(cfg.cell(self.normal_grid.size(), pixel, place.sample))
            }
            (Layout::Multisampled, _) => self.normal_samples.load(pixel, cfg.own(place.sample)),
        }
    }

    fn packed(&self, cfg: &Sraa, pixel: IVec2, place: Place) -> Vec4 {
        match (cfg.layout, place.centre) {
            // Nothing is split of a texel that holds both.
            (Layout::Layers | Layout::Split, _) => self.packed.load(pixel, place.sample),
            (_, true) => self.centre_packed.load(pixel),
            (Layout::Superresolution, _) => {
                self.packed_grid
                    .load(cfg.cell(self.packed_grid.size(), pixel, place.sample))
            }
            (Layout::Multisampled, _) => self.packed_samples.load(pixel, cfg.own(place.sample)),
        }
    }
}

/// Texel of a quantity that each layout holds as it holds normals, at a sample of a pixel.
pub(super) fn texel(
    cfg: &Sraa,
    layers: &FrameLayers<Vec4>,
    grid: &Texture<Vec4>,
    samples: &Multisampled<Vec4>,
    centre: &Frame<Vec4>,
    at: IVec2,
    place: Place,
) -> Vec4 {
    match (cfg.layout, place.centre) {
        (Layout::Layers | Layout::Split, _) => layers.load(at, place.sample),
        (_, true) => centre.load(at),
        (Layout::Superresolution, _) => grid.load(cfg.cell(grid.size(), at, place.sample)),
        (Layout::Multisampled, _) => samples.load(at, cfg.own(place.sample)),
    }
}

impl Sraa {
    /// Columns and rows of the samples of a pixel in a superresolution texture: 2×2, 4×4, or as near as can be.
    pub fn grid(&self) -> IVec2 {
        let mut columns = 1;
        while columns * columns < self.samples() {
            columns += 1;
        }
        let rows = self.samples().div_ceil(columns);
        ivec2(columns as i32, rows as i32)
    }

    /// The sample, or the last one: the pixel's centre, which has a texture of its own, comes here too where it is not known which
    /// it is.
    pub(super) fn own(&self, sample: usize) -> usize {
        sample.min(self.samples() - 1)
    }

    /// The texel of a superresolution texture of `size` that holds `sample` of `pixel`, or of the nearest pixel inside.
    pub(super) fn cell(&self, size: UVec2, pixel: IVec2, sample: usize) -> IVec2 {
        let grid = self.grid();
        let last = size.as_ivec2() / grid - 1;
        let sample = self.own(sample) as i32;
        pixel.clamp(IVec2::ZERO, last) * grid + ivec2(sample % grid.x, sample / grid.x)
    }
}

/// Depth along the view direction, in scene units.
fn linear(cfg: &Sraa, view: &View, stored: f32) -> f32 {
    let (near, far) = (view.near, view.far);
    let depth = match (cfg.projection, cfg.depth) {
        (_, Depth::Linear) => stored,
        (Projection::Parallel, Depth::Perspective) => near + (far - near) * stored,
        (Projection::Parallel, _) => far - (far - near) * stored,
        // 1 - stored is exact near the far plane, where far - stored * (far - near) would cancel; and of an infinite far
        // plane the share is 0.
        (_, Depth::Perspective) => near / ((1.0 - stored) + near / far * stored),
        (_, Depth::Reversed) => near / (stored + near / far * (1.0 - stored)),
        (_, Depth::ReversedInfinite) => near / if stored > SHORTEST { stored } else { SHORTEST },
    };
    match cfg.guards {
        Guards::Fallback | Guards::None => depth.min(DEEPEST),
        // What is infinite or not a number is as deep as the sky. `min` may give either of its operands if one is a NaN.
        Guards::Inline => {
            if depth.abs() < DEEPEST {
                depth
            } else {
                DEEPEST
            }
        }
    }
}

/// The normal that a texel `n` holds, as [`Surface`] has it.
fn decoded(cfg: &Sraa, n: Vec4) -> Vec3 {
    match cfg.normals {
        Normals::Float => n.xyz(),
        Normals::Unorm if cfg.renormalise => unit(2.0 * n.xyz() - 1.0),
        Normals::Unorm if cfg.metric == Metric::PlanesNormals => 2.0 * n.xyz() - 1.0,
        Normals::Unorm => n.xyz(),
        Normals::Octahedral => folded(2.0 * n.xy() - 1.0),
        Normals::Packed => folded(n.xy()),
    }
}

impl GBuffer {
    /// A G-buffer of which nothing may be read: single texels of zero, to be replaced by what a layout needs.
    pub fn unread() -> GBuffer {
        let scalar = || Frame::new(UVec2::ONE, vec![0.0]);
        let vector = || Frame::new(UVec2::ONE, vec![Vec4::ZERO]);
        GBuffer {
            depth: FrameLayers::new(vec![scalar()]),
            normal: FrameLayers::new(vec![vector()]),
            depth_buffer: Buffer::new(vec![0.0]),
            packed: FrameLayers::new(vec![vector()]),
            depth_grid: Texture::new(UVec2::ONE, vec![0.0]),
            normal_grid: Texture::new(UVec2::ONE, vec![Vec4::ZERO]),
            packed_grid: Texture::new(UVec2::ONE, vec![Vec4::ZERO]),
            depth_samples: Multisampled::new(vec![Texture::new(UVec2::ONE, vec![0.0]); 2]),
            normal_samples: Multisampled::new(vec![Texture::new(UVec2::ONE, vec![Vec4::ZERO]); 2]),
            packed_samples: Multisampled::new(vec![Texture::new(UVec2::ONE, vec![Vec4::ZERO]); 2]),
            centre_depth: scalar(),
            centre_normal: vector(),
            centre_packed: vector(),
        }
    }
}
