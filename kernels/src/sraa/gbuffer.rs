//! Contents and encodings of the G-buffer: depth and normals at every geometry sample.

use super::metric::Metric;
use super::options::{Guards, Sraa};
use super::pattern::Place;
use super::view::{Projection, View};
use crate::normals::{folded, unit};
use crate::prelude::*;

/// Encoding of depth in the G-buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// Distance along the view direction, in scene units; infinite where there is no geometry.
    Linear,
    /// Projected depth, of either projection: 0 at the near plane, 1 at the far plane.
    Perspective,
    /// Projected depth with near and far swapped: 1 at the near plane, 0 at the far plane.
    Reversed,
    /// Projected depth with near and far swapped and no far plane: 1 at the near plane, 0 infinitely far.
    ReversedInfinite,
}

/// Encoding of normals in the G-buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normals {
    /// Unit vectors, in a float format.
    Float,
    /// 0.5 + 0.5 n, in a normalised format such as RGB8 or RGB10A2; renormalised with `renormalise`.
    Unorm,
    /// Octahedral: unfolded to a square, each axis as 0.5 + 0.5 n, in a normalised format of two components such as RG8 or RG16.
    Octahedral,
    /// Octahedral, each axis in -1..1, with the depth in the same texel: half the reads. The depth is the sum of the third
    /// and fourth component, so that two 16-bit floats hold one of 22 bits.
    Packed,
}

/// Storage of a pixel's samples in the G-buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A layer for each sample; the pixel's centre, if it is shaded, is one more layer, the last (paper §3.4: one pass for each).
    Layers,
    /// Side by side in one large texture (the listing's superresolution buffers): with c columns, sample s is at column s % c
    /// and row s / c of its pixel.
    Superresolution,
    /// Samples of a multisampled texture (paper §3.4: one pass for all).
    Multisampled,
    /// Layers, but depth in a storage buffer: reads use two separate caches (paper §3.5). For metrics that compare both.
    Split,
}

/// The G-buffer. A shader binds only the inputs that its layout, metric and encodings need.
///
/// Natively all inputs exist, and those that are not read may be of any size: see [`GBuffer::unread`].
pub struct GBuffer {
    /// With layout=layers: depth.
    pub depth: FrameLayers<f32>,
    /// With layout=layers and layout=split: normals.
    pub normal: FrameLayers<Vec4>,
    /// With layout=split: the contents of `depth`, row by row, layer after layer.
    pub depth_buffer: Buffer<f32>,
    /// With layout=layers and normals=packed: normals and depth.
    pub packed: FrameLayers<Vec4>,
    /// With layout=superresolution: depth.
    pub depth_grid: Texture<f32>,
    /// With layout=superresolution: normals.
    pub normal_grid: Texture<Vec4>,
    /// With layout=superresolution and normals=packed: normals and depth.
    pub packed_grid: Texture<Vec4>,
    /// With layout=multisampled: depth.
    pub depth_samples: Multisampled<f32>,
    /// With layout=multisampled: normals.
    pub normal_samples: Multisampled<Vec4>,
    /// With layout=multisampled and normals=packed: normals and depth.
    pub packed_samples: Multisampled<Vec4>,
    /// Depth at the pixel's centre, if that is shaded and the layout has no place for it.
    pub centre_depth: Frame<f32>,
    /// Normal at the pixel's centre, if that is shaded and the layout has no place for it.
    pub centre_normal: Frame<Vec4>,
    /// With normals=packed: normal and depth at the pixel's centre, if that is shaded and the layout has no place for it.
    pub centre_packed: Frame<Vec4>,
}

/// Surface seen at a geometry sample.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Linear depth, at most 1e30.
    pub depth: f32,
    /// Unit normal; with normals=unorm compared as stored, 0.5 + 0.5 n.
    pub normal: Vec3,
}

/// Larger than any depth, and finite: the difference of two infinite depths would be NaN.
pub(super) const DEEPEST: f32 = 1.0e30;

/// Smaller than any stored depth but 0.
const SHORTEST: f32 = 1.0e-30;

/// Surface seen at `place` relative to `pixel`, with only the properties that the metric compares.
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
            // A texel that holds both is not split.
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

/// Texel at a sample of a pixel, of an input with the same layouts as normals.
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
    /// Columns and rows of the samples of a pixel in a superresolution texture: 2×2, 4×4, or as close to square as possible.
    pub fn grid(&self) -> IVec2 {
        let mut columns = 1;
        while columns * columns < self.samples() {
            columns += 1;
        }
        let rows = self.samples().div_ceil(columns);
        ivec2(columns as i32, rows as i32)
    }

    /// Clamps the index to that of the last sample. A place known only at run time may be the pixel's centre, which has its
    /// own texture but is looked up here too.
    pub(super) fn own(&self, sample: usize) -> usize {
        sample.min(self.samples() - 1)
    }

    /// Texel of a superresolution texture of `size` that holds `sample` of `pixel`, clamped to the nearest pixel inside.
    pub(super) fn cell(&self, size: UVec2, pixel: IVec2, sample: usize) -> IVec2 {
        let grid = self.grid();
        let last = size.as_ivec2() / grid - 1;
        let sample = self.own(sample) as i32;
        pixel.clamp(IVec2::ZERO, last) * grid + ivec2(sample % grid.x, sample / grid.x)
    }
}

/// Converts a stored depth to the depth along the view direction, in scene units.
fn linear(cfg: &Sraa, view: &View, stored: f32) -> f32 {
    let (near, far) = (view.near, view.far);
    let depth = match (cfg.projection, cfg.depth) {
        (_, Depth::Linear) => stored,
        (Projection::Parallel, Depth::Perspective) => near + (far - near) * stored,
        (Projection::Parallel, _) => far - (far - near) * stored,
        // 1 - stored is exact near the far plane, where far - stored * (far - near) would cancel. With an infinite far plane,
        // near / far is 0.
        (_, Depth::Perspective) => near / ((1.0 - stored) + near / far * stored),
        (_, Depth::Reversed) => near / (stored + near / far * (1.0 - stored)),
        (_, Depth::ReversedInfinite) => near / if stored > SHORTEST { stored } else { SHORTEST },
    };
    match cfg.guards {
        Guards::Fallback | Guards::None => depth.min(DEEPEST),
        // Infinity and NaN become the depth of the sky. With a NaN operand, `min` may return either operand.
        Guards::Inline => {
            if depth.abs() < DEEPEST {
                depth
            } else {
                DEEPEST
            }
        }
    }
}

/// Decodes the normal in the texel `n`, in the form of [`Surface`].
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
    /// No G-buffer: single texels of zero, to be replaced by the inputs that the layout needs.
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
