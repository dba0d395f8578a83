//! Colours of the shading samples, and the properties that demodulation and the guide need with them.

use super::Inputs;
use super::options::{NonFinite, Sraa};
use super::pattern::Place;
use crate::prelude::*;

/// Colours of the shading samples, linear, with premultiplied alpha if it is not 1; with demodulate, the albedo of the surfaces
/// too. A shader binds only what its options need. Natively, inputs that are not read may be of any size: see [`Colors::unread`].
pub struct Colors {
    /// With one shading sample a pixel: its colour.
    pub color: Frame<Vec4>,
    /// With several shading samples a pixel: their colours, a layer for each.
    pub colors: FrameLayers<Vec4>,
    /// With shading=placed: the geometry sample at which each pixel is shaded, or the number of samples for its centre.
    pub place: Frame<u32>,
    /// With extra=true: the geometry sample at which each pixel has a further shading sample, or the number of samples where
    /// it has none.
    pub extra: Frame<u32>,
    /// With extra=true: colour of the further shading sample, in pixels that have one.
    pub extra_color: Frame<Vec4>,
    /// With demodulate, and layout=layers or layout=split: in red, green and blue the share of light that the surface at each
    /// geometry sample reflects diffusely, linear; with demodulate=albedo-shadow, in alpha the share of the direct light that
    /// reaches it, 0 in shadow and 1 outside. Where nothing is reflected, as in the sky, 1.
    pub albedo: FrameLayers<Vec4>,
    /// `albedo` with layout=superresolution.
    pub albedo_grid: Texture<Vec4>,
    /// `albedo` with layout=multisampled.
    pub albedo_samples: Multisampled<Vec4>,
    /// `albedo` at the pixel's centre, if that is shaded and the layout has no place for it.
    pub centre_albedo: Frame<Vec4>,
    /// With demodulate=albedo-shadow: contribution of the unshadowed direct light to each pixel's colour, in red, green and blue.
    /// The colour is this times the share of the direct light that arrives, plus a remainder.
    pub direct: Frame<Vec4>,
    /// `direct` at the further shading samples.
    pub extra_direct: Frame<Vec4>,
    /// With demodulate and rest=true: part of each pixel's colour that does not follow the albedo, in red, green and blue.
    pub rest: Frame<Vec4>,
    /// `rest` at the further shading samples.
    pub extra_rest: Frame<Vec4>,
    /// With guide=add: mean of the guide over the geometry samples of each pixel, in red, green and blue, linear. All colours are
    /// then differences from the guide at the position that is shaded.
    pub guide_mean: Frame<Vec4>,
}

impl Colors {
    /// No colours: single texels of zero, to be replaced by the inputs that the options need.
    pub fn unread() -> Colors {
        let frame = || Frame::new(UVec2::ONE, vec![Vec4::ZERO]);
        Colors {
            color: frame(),
            colors: FrameLayers::new(vec![frame()]),
            place: Frame::new(UVec2::ONE, vec![0]),
            extra: Frame::new(UVec2::ONE, vec![0]),
            extra_color: frame(),
            albedo: FrameLayers::new(vec![frame()]),
            albedo_grid: Texture::new(UVec2::ONE, vec![Vec4::ZERO]),
            albedo_samples: Multisampled::new(vec![Texture::new(UVec2::ONE, vec![Vec4::ZERO]); 2]),
            centre_albedo: frame(),
            direct: frame(),
            extra_direct: frame(),
            rest: frame(),
            extra_rest: frame(),
            guide_mean: frame(),
        }
    }
}

/// Colour of a tap.
pub(super) fn color(cfg: &Sraa, inputs: &Inputs, tap: usize, side: usize) -> Vec4 {
    match cfg.shading_samples() {
        1 => color_at(inputs, cfg.tap(tap, side)),
        several => inputs
            .colors
            .colors
            .load(inputs.pixel + cfg.tap(tap, side).pixel, tap % several),
    }
}

/// Colour of a pixel's only shading sample, or of its further one.
pub(super) fn color_at(inputs: &Inputs, tap: Place) -> Vec4 {
    shaded(inputs, tap, &inputs.colors.color, &inputs.colors.extra_color)
}

/// Value of a shading result at a tap: from the pixel's only shading sample, or from its further one.
pub(super) fn shaded(inputs: &Inputs, tap: Place, only: &Frame<Vec4>, further: &Frame<Vec4>) -> Vec4 {
    let at = inputs.pixel + tap.pixel;
    if tap.extra { further.load(at) } else { only.load(at) }
}

/// The pixel's own colour: the mean of its shading samples.
pub(super) fn own_color(cfg: &Sraa, inputs: &Inputs) -> Vec4 {
    match cfg.shading_samples() {
        1 => inputs.colors.color.load(inputs.pixel),
        several => {
            let mut sum = Vec4::ZERO;
            for k in 0..several {
                sum += inputs.colors.colors.load(inputs.pixel, k);
            }
            sum / several as f32
        }
    }
}

/// Returns whether a colour may contribute to the pixel.
pub(super) fn is_kept(cfg: &Sraa, color: Vec4) -> bool {
    match cfg.non_finite {
        NonFinite::Spread => true,
        NonFinite::Skip => color.is_finite(),
    }
}
