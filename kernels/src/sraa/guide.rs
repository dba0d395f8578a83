//! The additive guide: a cheap estimate g of the colour, known at every geometry sample, follows paint, shadow and slopes that one
//! shading sample a pixel cannot.
//!
//! Colours that the filter reads are c - g, with g at the place that is shaded; it borrows these differences as it would colours, for
//! a weighted mean is linear. Afterwards the mean of g over the pixel's geometry samples is added. Where g is the colour the pixel is
//! supersampled; where g is 0 nothing changes.

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

/// Estimate that colours are differences from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guide {
    /// None: colours are borrowed as they are.
    None,
    /// A guide, of which the mean over each pixel is added to the filtered differences.
    Add,
}

/// Source of the guide at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Estimate {
    /// Images of the renderer's own.
    Given,
    /// The albedo times the light from one direction, where no shadow falls, and from all around.
    Diffuse,
    /// The same, and the light that the surface emits.
    Emissive,
}

/// Inputs of the guide. A shader binds only the part that its options need.
pub struct Guiding {
    /// Of estimate=given with layout=layers and layout=split: the guide at each geometry sample in red, green and blue, linear; 0
    /// where there is none, as in the sky.
    pub guide: FrameLayers<Vec4>,
    /// The same of layout=superresolution.
    pub guide_grid: Texture<Vec4>,
    /// The same of layout=multisampled.
    pub guide_samples: Multisampled<Vec4>,
    /// The same at the pixel's centre, where that is shaded and the layout has no place for it.
    pub centre_guide: Frame<Vec4>,
    /// Of estimate=emissive with layout=layers and layout=split: the light that the surface at each geometry sample emits, linear.
    pub emission: FrameLayers<Vec4>,
    /// The same of layout=superresolution.
    pub emission_grid: Texture<Vec4>,
    /// The same of layout=multisampled.
    pub emission_samples: Multisampled<Vec4>,
    /// The same at the pixel's centre, where that is shaded and the layout has no place for it.
    pub centre_emission: Frame<Vec4>,
    /// Of estimate=diffuse and emissive: unit vector towards the light, in the space that normals are in.
    pub light_direction: Vec3,
    /// Linear colour that the light gives a white surface that faces it.
    pub light_color: Vec3,
    /// Linear colour of the light from all around on a white surface.
    pub ambient: Vec3,
    /// Of fitted=true: the scale of the guide in red, in the upper left pixel: the kernel `sraa_fit` writes it.
    pub guide_scale: Texture<Vec4>,
}

/// What the kernels of the guide look at.
pub(super) struct Estimated<'a> {
    pub(super) gbuffer: &'a GBuffer,
    pub(super) view: &'a View,
    pub(super) colors: &'a Colors,
    pub(super) guiding: &'a Guiding,
    pub(super) pixel: IVec2,
}

/// Mean of the guide over the geometry samples of `pixel`, each by its share in the pixel: the image `guide_mean` of the filter. Alpha
/// is 0.
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

/// Difference of the colour of `pixel` from the guide where it is shaded: the image `color` of the filter, for renderers that do not
/// subtract the guide as they shade. Alpha stays.
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

/// The filtered differences of a pixel and the mean of its guide. No channel but alpha is below 0.
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

/// A channel of a colour that is not below 0; not a number stays so.
fn at_least_0(channel: f32) -> f32 {
    if channel < 0.0 { 0.0 } else { channel }
}

/// The guide at a geometry sample, as it counts.
fn guide(cfg: &Sraa, seen: &Estimated, place: Place) -> Vec3 {
    let found = unscaled(cfg, seen, place);
    if cfg.fitted {
        counted(cfg, seen.guiding.guide_scale.load(IVec2::ZERO).x * found)
    } else {
        found
    }
}

/// The guide at a geometry sample before it is scaled, as it counts.
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

/// Light of one direction and from all around that a surface reflects; where nothing is drawn, 0.
fn reflected(cfg: &Sraa, seen: &Estimated, place: Place) -> Vec3 {
    let guiding = seen.guiding;
    // Depth and normal at length 1, whatever the filter compares.
    let all = Sraa {
        metric: Metric::PlanesNormals,
        ..*cfg
    };
    let own = surface(&all, seen.gbuffer, seen.view, seen.pixel, place);
    let paint = stored(cfg, seen.colors, seen.pixel + place.pixel, place);
    let facing = own.normal.dot(guiding.light_direction);
    // Not a number is neither.
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

/// A guide that counts: one that a half cannot hold, or that is not a number, is 0 both where it is subtracted and where it is added.
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
    /// Inputs of which none may be read: single texels of zero, to be replaced by what the options need.
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
    /// Refuses what differences cannot be taken apart for.
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
