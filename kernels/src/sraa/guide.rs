//! The additive guide: a cheap estimate g of the colour, known at every geometry sample. It follows albedo, shadow and
//! slopes, which one shading sample a pixel cannot.
//!
//! The colours that the filter reads are c - g, with g at the position that is shaded. It borrows these differences as it
//! would borrow colours, as a weighted mean is linear. Afterwards the mean of g over the pixel's geometry samples is added.
//! A pixel is supersampled if g is its colour, and unchanged if g is 0.

use super::Inputs;
use super::colors::Colors;
use super::demodulate::{BRIGHTEST, Demodulate, share, stored};
use super::gbuffer::{GBuffer, surface, texel};
use super::metric::{Metric, is_drawn};
use super::options::{Guards, Sraa};
use super::pattern::Place;
use super::placed::shaded_place;
use super::total_share;
use super::view::View;
use crate::prelude::*;

/// Estimate of the colour that is subtracted before filtering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guide {
    /// None: colours are borrowed as they are.
    None,
    /// A guide, whose mean over each pixel is added to the filtered differences.
    Add,
}

/// Source of the guide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Estimate {
    /// Images that the renderer provides.
    Given,
    /// Albedo times the light from one direction, outside of shadow, and from all around.
    Diffuse,
    /// Albedo times that light, plus the light that the surface emits.
    Emissive,
}

/// Inputs of the guide. A shader binds only those that its options need.
pub struct Guiding {
    /// With estimate=given, and layout=layers or layout=split: the guide at each geometry sample in red, green and blue,
    /// linear; 0 where there is none. In haze it includes the haze, and is the sky's colour in the sky.
    pub guide: FrameLayers<Vec4>,
    /// `guide` with layout=superresolution.
    pub guide_grid: Texture<Vec4>,
    /// `guide` with layout=multisampled.
    pub guide_samples: Multisampled<Vec4>,
    /// `guide` at the pixel's centre, if that is shaded and the layout has no place for it.
    pub centre_guide: Frame<Vec4>,
    /// With estimate=emissive, and layout=layers or layout=split: light that the surface at each geometry sample emits, linear.
    pub emission: FrameLayers<Vec4>,
    /// `emission` with layout=superresolution.
    pub emission_grid: Texture<Vec4>,
    /// `emission` with layout=multisampled.
    pub emission_samples: Multisampled<Vec4>,
    /// `emission` at the pixel's centre, if that is shaded and the layout has no place for it.
    pub centre_emission: Frame<Vec4>,
    /// With estimate=diffuse and estimate=emissive: unit vector towards the light, in the space of the normals.
    pub light_direction: Vec3,
    /// Linear colour of a white surface that faces the light, lit by it alone.
    pub light_color: Vec3,
    /// Linear colour of a white surface lit only from all around.
    pub ambient: Vec3,
    /// With fitted=true: scale of each channel of the guide, in the upper left pixel. The kernel `sraa_fit` writes it.
    pub guide_scale: Texture<Vec4>,
}

/// Inputs of the guide's kernels.
pub(super) struct Estimated<'a> {
    pub(super) gbuffer: &'a GBuffer,
    pub(super) view: &'a View,
    pub(super) colors: &'a Colors,
    pub(super) guiding: &'a Guiding,
    pub(super) pixel: IVec2,
}

/// Mean of the guide over the geometry samples of `pixel`, weighted by their shares in the pixel: the image `guide_mean` of the
/// filter. Alpha is 0.
pub fn sraa_guide(
    cfg: &Sraa,
    gbuffer: &GBuffer,
    view: &View,
    colors: &Colors,
    guiding: &Guiding,
    pixel: IVec2,
) -> Vec4 {
    cfg.check();
    let seen = Estimated {
        gbuffer,
        view,
        colors,
        guiding,
        pixel,
    };
    let total = total_share(cfg);
    let mut mean = Vec3::ZERO;
    for sample in 0..cfg.reconstructed() {
        if cfg.share(sample) != 0.0 {
            mean += cfg.share(sample) / total * guide(cfg, &seen, cfg.place(sample));
        }
    }
    mean.extend(0.0)
}

/// Difference between the colour of `pixel` and the guide at the position that is shaded: the image `color` of the filter, for
/// renderers that do not subtract the guide as they shade. Alpha is unchanged.
pub fn sraa_residual(
    cfg: &Sraa,
    gbuffer: &GBuffer,
    view: &View,
    colors: &Colors,
    guiding: &Guiding,
    pixel: IVec2,
) -> Vec4 {
    cfg.check();
    assert!(
        cfg.shading_samples() == 1,
        "sraa_residual reads one colour a pixel: subtract the guide as you shade, or shade once a pixel"
    );
    let seen = Estimated {
        gbuffer,
        view,
        colors,
        guiding,
        pixel,
    };
    let place = shaded_place(cfg, &colors.place, pixel, cfg.tap(0, 1));
    colors.color.load(pixel) - guide(cfg, &seen, place).extend(0.0)
}

/// Adds the mean of a pixel's guide to the filtered differences. Negative channels, except alpha, become 0.
pub(super) fn guided(cfg: &Sraa, inputs: &Inputs, filtered: Vec4) -> Vec4 {
    match cfg.guide {
        Guide::None => filtered,
        Guide::Add => {
            let found = filtered.xyz() + counted(cfg, inputs.colors.guide_mean.load(inputs.pixel).xyz());
            vec4(
                at_least_0(found.x),
                at_least_0(found.y),
                at_least_0(found.z),
                filtered.w,
            )
        }
    }
}

/// Clamps a channel to at least 0; NaN stays NaN.
fn at_least_0(channel: f32) -> f32 {
    if channel < 0.0 { 0.0 } else { channel }
}

/// The guide at a geometry sample, scaled and with unusable values replaced by 0.
fn guide(cfg: &Sraa, seen: &Estimated, place: Place) -> Vec3 {
    let found = unscaled(cfg, seen, place);
    if cfg.fitted {
        counted(cfg, seen.guiding.guide_scale.load(IVec2::ZERO).xyz() * found)
    } else {
        found
    }
}

/// The guide at a geometry sample before it is scaled, with unusable values replaced by 0.
pub(super) fn unscaled(cfg: &Sraa, seen: &Estimated, place: Place) -> Vec3 {
    let (guiding, at) = (seen.guiding, seen.pixel + place.pixel);
    let found = match cfg.estimate {
        Estimate::Given => texel(
            cfg,
            &guiding.guide,
            &guiding.guide_grid,
            &guiding.guide_samples,
            &guiding.centre_guide,
            at,
            place,
        )
        .xyz(),
        Estimate::Diffuse => reflected(cfg, seen, place),
        Estimate::Emissive => {
            let emitted = texel(
                cfg,
                &guiding.emission,
                &guiding.emission_grid,
                &guiding.emission_samples,
                &guiding.centre_emission,
                at,
                place,
            );
            reflected(cfg, seen, place) + emitted.xyz()
        }
    };
    counted(cfg, found)
}

/// Light from one direction and from all around that a surface reflects; 0 where nothing is drawn.
fn reflected(cfg: &Sraa, seen: &Estimated, place: Place) -> Vec3 {
    let guiding = seen.guiding;
    // Depth and a unit normal, regardless of what the filter compares.
    let all = Sraa {
        metric: Metric::PlanesNormals,
        ..*cfg
    };
    let own = surface(&all, seen.gbuffer, seen.view, seen.pixel, place);
    let paint = stored(cfg, seen.colors, seen.pixel + place.pixel, place);
    let facing = own.normal.dot(guiding.light_direction);
    // With a NaN, no direct light arrives.
    let arrives = if facing > 0.0 {
        facing * share(cfg, paint.w)
    } else {
        0.0
    };
    if is_drawn(&all, seen.view, &own, own.normal.dot(own.normal)) {
        paint.xyz() * (guiding.ambient + arrives * guiding.light_color)
    } else {
        Vec3::ZERO
    }
}

/// Replaces a guide by 0 if a 16-bit float cannot hold it or it is NaN, both where it is subtracted and where it is added.
fn counted(cfg: &Sraa, guide: Vec3) -> Vec3 {
    match cfg.guards {
        Guards::None => guide,
        Guards::Inline | Guards::Fallback => {
            if guide.x.abs() <= BRIGHTEST && guide.y.abs() <= BRIGHTEST && guide.z.abs() <= BRIGHTEST {
                guide
            } else {
                Vec3::ZERO
            }
        }
    }
}

impl Guiding {
    /// No inputs: single texels of zero, to be replaced by the inputs that the options need.
    pub fn unread() -> Guiding {
        let frame = || Frame::new(UVec2::ONE, vec![Vec4::ZERO]);
        let texture = || Texture::new(UVec2::ONE, vec![Vec4::ZERO]);
        Guiding {
            guide: FrameLayers::new(vec![frame()]),
            guide_grid: texture(),
            guide_samples: Multisampled::new(vec![texture(); 2]),
            centre_guide: frame(),
            emission: FrameLayers::new(vec![frame()]),
            emission_grid: texture(),
            emission_samples: Multisampled::new(vec![texture(); 2]),
            centre_emission: frame(),
            light_direction: Vec3::ZERO,
            light_color: Vec3::ZERO,
            ambient: Vec3::ZERO,
            guide_scale: texture(),
        }
    }
}

impl Sraa {
    /// Panics if the options do not permit a guide.
    pub(super) fn check_guide(&self) {
        if self.guide == Guide::Add {
            assert!(
                self.demodulate == Demodulate::None,
                "guide=add follows paint and shadow, and differences from a guide are no light that an albedo divides: set \
                 demodulate=none"
            );
        }
    }
}
