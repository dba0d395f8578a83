//! What the filter borrows: colours of shading samples, and what surfaces make of light.

use super::Inputs;
use super::options::{NonFinite, Sraa};
use super::pattern::Place;
use crate::prelude::*;

/// Colours of the shading samples, linear, alpha premultiplied if it is not 1; and of demodulate, what surfaces make of light. A
/// shader binds only what its options need. Natively what is not read may be of any size: see [`Colors::unread`].
pub struct Colors {
    /// One a pixel.
    pub color: Frame<Vec4>,
    /// A layer for each, where there are several a pixel.
    pub colors: FrameLayers<Vec4>,
    /// Of shading=placed: the geometry sample at which each pixel is shaded, or the number of samples for its centre.
    pub place: Frame<u32>,
    /// Of extra=true: the geometry sample at which each pixel has a further shading sample, or the number of samples where it has
    /// none.
    pub extra: Frame<u32>,
    /// Its colour, where it has one.
    pub extra_color: Frame<Vec4>,
    /// Of demodulate with layout=layers and layout=split: in red, green and blue the share of light that the surface at each
    /// geometry sample reflects diffusely, linear; of demodulate=albedo-shadow in alpha the share of the direct light that
    /// reaches it, 0 in shadow and 1 out of it. Where nothing is reflected, as in the sky, 1.
    pub albedo: FrameLayers<Vec4>,
    /// The same of layout=superresolution.
    pub albedo_grid: Texture<Vec4>,
    /// The same of layout=multisampled.
    pub albedo_samples: Multisampled<Vec4>,
    /// The same at the pixel's centre, where that is shaded and the layout has no place for it.
    pub centre_albedo: Frame<Vec4>,
    /// Of demodulate=albedo-shadow: what the direct light adds to each pixel's colour where no shadow falls, in red, green and
    /// blue: the colour is some rest and the share of the direct light that arrives times this.
    pub direct: Frame<Vec4>,
    /// The same of the further shading samples.
    pub extra_direct: Frame<Vec4>,
    /// Of demodulate with rest=true: what of each pixel's colour does not follow the albedo, in red, green and blue.
    pub rest: Frame<Vec4>,
    /// The same of the further shading samples.
    pub extra_rest: Frame<Vec4>,
    /// Of guide=add: the mean of the guide over the geometry samples of each pixel, in red, green and blue, linear. All colours are
    /// then differences from the guide where they are shaded.
    pub guide_mean: Frame<Vec4>,
}

impl Colors {
    /// Colours of which none may be read: single texels of zero, to be replaced by what the options need.
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

/// What shading gave at a tap: of its pixel's only shading sample, or of its further one.
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

/// Whether a colour may count.
pub(super) fn is_kept(cfg: &Sraa, color: Vec4) -> bool {
    match cfg.non_finite {
        NonFinite::Spread => true,
        NonFinite::Skip => color.is_finite(),
    }
}
