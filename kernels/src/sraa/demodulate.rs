//! Separation of light from albedo and shadow. Albedo and shadow vary sharply within a surface, but are known at every geometry
//! sample, so they are not borrowed. The light that is borrowed is smooth.
//!
//! A colour is modelled as a(ρ + vδ): the albedo a, the share v of the direct light that is not shadowed, and light ρ and δ
//! that varies little from pixel to pixel. A shading sample t provides aₜδₜ as the direct light; a geometry sample s takes
//! from it aₛ(ρₜ + vₛδₜ), which is aₛ/aₜ (color + (vₛ - vₜ) direct). There is no division by v, so samples in shadow keep
//! their other light. Light that does not follow the albedo, such as highlights and haze, is rescaled as well, unless it is
//! provided separately (`rest`): then it is borrowed unchanged.

use super::Inputs;
use super::colors::{Colors, color_at, is_kept, shaded};
use super::gbuffer::texel;
use super::options::{Guards, Mask, Normalisation, Resolve, Search, Sraa};
use super::pattern::Place;
use super::placed::shaded_place;
use crate::prelude::*;

/// Properties known at every geometry sample, and therefore not borrowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demodulate {
    /// None: edges of albedo and of shadow are only as sharp as the shading rate permits.
    None,
    /// The albedo.
    Albedo,
    /// The albedo, and the shadow of the direct light.
    AlbedoShadow,
}

/// Reflectance of a surface at a sample, and the direct light that reaches it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paint {
    /// Albedo, at least `albedo_floor` and at most [`BRIGHTEST`].
    pub(super) albedo: Vec3,
    /// Share of the direct light that reaches the sample.
    pub(super) lit: f32,
}

/// Largest 16-bit float. Surfaces that emit light may have their emission as albedo.
pub(super) const BRIGHTEST: f32 = 65504.0;

/// Reflectance of the surface at a sample, and the direct light that reaches it.
pub(super) fn paint(cfg: &Sraa, inputs: &Inputs, place: Place) -> Paint {
    match cfg.demodulate {
        Demodulate::None => Paint {
            albedo: Vec3::ONE,
            lit: 1.0,
        },
        Demodulate::Albedo | Demodulate::AlbedoShadow => {
            let stored = stored(cfg, inputs.colors, inputs.pixel + place.pixel, place);
            Paint {
                albedo: vec3(bounded(cfg, stored.x), bounded(cfg, stored.y), bounded(cfg, stored.z)),
                lit: share(cfg, stored.w),
            }
        }
    }
}

/// Albedo and share of the direct light at a sample of a pixel, as stored in the G-buffer.
pub(super) fn stored(cfg: &Sraa, colors: &Colors, at: IVec2, place: Place) -> Vec4 {
    texel(
        cfg,
        &colors.albedo,
        &colors.albedo_grid,
        &colors.albedo_samples,
        &colors.centre_albedo,
        at,
        place,
    )
}

/// Clamps a channel of the albedo so that it can be divided by; NaN becomes the lower bound.
fn bounded(cfg: &Sraa, albedo: f32) -> f32 {
    match cfg.guards {
        Guards::Fallback | Guards::None => albedo.max(cfg.albedo_floor).min(BRIGHTEST),
        Guards::Inline => {
            if albedo > cfg.albedo_floor {
                albedo.min(BRIGHTEST)
            } else {
                cfg.albedo_floor
            }
        }
    }
}

/// Clamps a share of the direct light to 0..=1; NaN becomes 0.
#[allow(clippy::manual_clamp)] // `clamp` would keep it
pub(super) fn share(cfg: &Sraa, lit: f32) -> f32 {
    match cfg.guards {
        Guards::Fallback | Guards::None => lit.max(0.0).min(1.0),
        Guards::Inline => {
            if lit > 0.0 {
                lit.min(1.0)
            } else {
                0.0
            }
        }
    }
}

/// Contribution of the unshadowed direct light to a tap's colour.
fn direct(inputs: &Inputs, tap: Place) -> Vec4 {
    let light = shaded(inputs, tap, &inputs.colors.direct, &inputs.colors.extra_direct);
    light.xyz().extend(0.0)
}

/// Part of a tap's colour that does not follow the albedo.
fn rest(inputs: &Inputs, tap: Place) -> Vec4 {
    let light = shaded(inputs, tap, &inputs.colors.rest, &inputs.colors.extra_rest);
    light.xyz().extend(0.0)
}

/// Returns whether a tap's colour may contribute, together with its direct light and `rest`.
pub(super) fn may_count(cfg: &Sraa, inputs: &Inputs, tap: Place, shaded: Vec4) -> bool {
    let kept = match cfg.demodulate {
        Demodulate::None | Demodulate::Albedo => is_kept(cfg, shaded),
        Demodulate::AlbedoShadow => is_kept(cfg, shaded) && is_kept(cfg, direct(inputs, tap)),
    };
    if cfg.rest && cfg.demodulate != Demodulate::None {
        kept && is_kept(cfg, rest(inputs, tap))
    } else {
        kept
    }
}

/// Colour of a tap, times its weight in the pixel. The first of `sums` is the weight times the albedo of the samples that use the
/// tap; the second is also multiplied by their shares of the direct light.
pub(super) fn weighed(cfg: &Sraa, inputs: &Inputs, tap: Place, shaded: Vec4, weight: f32, sums: (Vec3, Vec3)) -> Vec4 {
    match cfg.demodulate {
        Demodulate::None => weight * shaded,
        _ => {
            let from = paint(cfg, inputs, shaded_place(cfg, &inputs.colors.place, inputs.pixel, tap));
            taken(cfg, inputs, tap, &from, shaded, weight, sums)
        }
    }
}

/// [`weighed`] for a tap whose paint is known.
fn taken(
    cfg: &Sraa,
    inputs: &Inputs,
    tap: Place,
    from: &Paint,
    shaded: Vec4,
    weight: f32,
    (reflected, lit): (Vec3, Vec3),
) -> Vec4 {
    let all = reflected / from.albedo;
    let brighter = match cfg.demodulate {
        Demodulate::None | Demodulate::Albedo => Vec3::ZERO,
        Demodulate::AlbedoShadow => (lit / from.albedo - from.lit * all) * direct(inputs, tap).xyz(),
    };
    if cfg.rest {
        let rest = rest(inputs, tap).xyz();
        (all * (shaded.xyz() - rest) + brighter + weight * rest).extend(weight * shaded.w)
    } else {
        (all * shaded.xyz() + brighter).extend(weight * shaded.w)
    }
}

/// Colour that a sample with the paint `own` takes from a tap: the pixel's only shading sample, or a further one. With
/// `seen`, the tap shows the sample's own surface; otherwise any surface.
pub(super) fn repainted(cfg: &Sraa, inputs: &Inputs, tap: Place, own: &Paint, seen: bool) -> Vec4 {
    let shaded = color_at(inputs, tap);
    match cfg.demodulate {
        Demodulate::None => shaded,
        _ => {
            let mut from = paint(cfg, inputs, shaded_place(cfg, &inputs.colors.place, inputs.pixel, tap));
            if !seen {
                from.albedo = from.albedo.max(Vec3::splat(cfg.unseen_floor));
            }
            taken(cfg, inputs, tap, &from, shaded, 1.0, (own.albedo, own.lit * own.albedo))
        }
    }
}

impl Sraa {
    /// Returns whether samples whose surface no tap shows are reconstructed separately.
    pub(super) fn sets_apart(&self) -> bool {
        let can_be = self.resolve == Resolve::Box
            && self.normalisation == Normalisation::Shifted
            && self.shading_samples() == 1
            && self.samples() <= 32;
        self.search != Search::None
            || self.extra
            || (self.demodulate != Demodulate::None && can_be && self.unseen_floor > self.albedo_floor)
    }

    /// Panics if the options do not permit demodulation.
    pub(super) fn check_demodulate(&self) {
        if self.demodulate != Demodulate::None {
            assert!(
                self.mask == Mask::None,
                "demodulate mends edges of paint and of shadow where geometry is even, and mask leaves such pixels as they are: \
                 set mask=none"
            );
            assert!(
                self.demodulate == Demodulate::Albedo || self.shading_samples() == 1,
                "demodulate=albedo-shadow reads the direct light of one shading sample a pixel: use demodulate=albedo, or shade \
                 once a pixel"
            );
            assert!(
                !self.rest || self.shading_samples() == 1,
                "rest=true reads what does not follow the albedo of one shading sample a pixel: use rest=false, or shade once a \
                 pixel"
            );
        }
    }
}
