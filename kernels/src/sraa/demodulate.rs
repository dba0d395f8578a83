//! Light apart from paint and from shadow. What varies sharply within a surface is known at every geometry sample and not borrowed;
//! what is borrowed is smooth.
//!
//! A colour is taken to be a(ρ + vδ): the albedo a, the share v of the direct light that no shadow keeps away, and light ρ and δ
//! that varies little from pixel to pixel. A shading sample t gives aₜδₜ as the direct light; a geometry sample s takes from it
//! aₛ(ρₜ + vₛδₜ), which is aₛ/aₜ (color + (vₛ - vₜ) direct). Nothing is divided by v, so that what is in shadow keeps its rest.

use super::Inputs;
use super::colors::{color_at, is_kept};
use super::gbuffer::Layout;
use super::options::{Guards, Mask, Sraa};
use super::pattern::Place;
use super::placed::shaded_place;
use crate::prelude::*;

/// What is known at every geometry sample and so not borrowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demodulate {
    /// Nothing: edges of paint and of shadow are as sharp as shading is dense.
    None,
    /// The albedo.
    Albedo,
    /// The albedo, and the shadow of the direct light.
    AlbedoShadow,
}

/// What a surface makes of light at a sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paint {
    /// At least `albedo_floor`, at most [`BRIGHTEST`].
    pub(super) albedo: Vec3,
    /// Share of the direct light that reaches it.
    pub(super) lit: f32,
}

/// The largest half: what shines by itself may give what it shines with as its albedo.
const BRIGHTEST: f32 = 65504.0;

/// What the surface at a sample makes of light.
pub(super) fn paint(cfg: &Sraa, inputs: &Inputs, place: Place) -> Paint {
    match cfg.demodulate {
        Demodulate::None => Paint {
            albedo: Vec3::ONE,
            lit: 1.0,
        },
        Demodulate::Albedo | Demodulate::AlbedoShadow => {
            let stored = stored(cfg, inputs, place);
            Paint {
                albedo: vec3(bounded(cfg, stored.x), bounded(cfg, stored.y), bounded(cfg, stored.z)),
                lit: share(cfg, stored.w),
            }
        }
    }
}

fn stored(cfg: &Sraa, inputs: &Inputs, place: Place) -> Vec4 {
    let (colors, at) = (inputs.colors, inputs.pixel + place.pixel);
    match (cfg.layout, place.centre) {
        (Layout::Layers | Layout::Split, _) => colors.albedo.load(at, place.sample),
        (_, true) => colors.centre_albedo.load(at),
        (Layout::Superresolution, _) => colors
            .albedo_grid
            .load(cfg.cell(colors.albedo_grid.size(), at, place.sample)),
        (Layout::Multisampled, _) => colors.albedo_samples.load(at, cfg.own(place.sample)),
    }
}

/// A channel of the albedo that can be divided by; what is not a number is the least.
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

/// A share of the direct light; what is not a number is none.
#[allow(clippy::manual_clamp)] // which would keep it
fn share(cfg: &Sraa, lit: f32) -> f32 {
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

/// What the direct light adds to a tap's colour out of shadow.
fn direct(inputs: &Inputs, tap: Place) -> Vec4 {
    inputs.colors.direct.load(inputs.pixel + tap.pixel).xyz().extend(0.0)
}

/// Whether a tap's colour, and the direct light in it, may count.
pub(super) fn may_count(cfg: &Sraa, inputs: &Inputs, tap: Place, shaded: Vec4) -> bool {
    match cfg.demodulate {
        Demodulate::None | Demodulate::Albedo => is_kept(cfg, shaded),
        Demodulate::AlbedoShadow => is_kept(cfg, shaded) && is_kept(cfg, direct(inputs, tap)),
    }
}

/// A tap's colour by its weight in the pixel. `reflected` is the weight times the albedo of the samples that it counts for, and
/// `lit` of these what is lit.
pub(super) fn weighed(
    cfg: &Sraa,
    inputs: &Inputs,
    tap: Place,
    shaded: Vec4,
    weight: f32,
    (reflected, lit): (Vec3, Vec3),
) -> Vec4 {
    let at = shaded_place(cfg, inputs, tap);
    match cfg.demodulate {
        Demodulate::None => weight * shaded,
        Demodulate::Albedo => {
            let own = paint(cfg, inputs, at);
            (reflected / own.albedo * shaded.xyz()).extend(weight * shaded.w)
        }
        Demodulate::AlbedoShadow => {
            let own = paint(cfg, inputs, at);
            let (all, direct) = (reflected / own.albedo, direct(inputs, tap).xyz());
            let brighter = lit / own.albedo - own.lit * all;
            (all * shaded.xyz() + brighter * direct).extend(weight * shaded.w)
        }
    }
}

/// The colour that a sample with a paint of its own takes from the only shading sample of a tap's pixel.
pub(super) fn repainted(cfg: &Sraa, inputs: &Inputs, tap: Place, own: &Paint) -> Vec4 {
    let shaded = color_at(inputs, tap);
    match cfg.demodulate {
        Demodulate::None => shaded,
        _ => weighed(cfg, inputs, tap, shaded, 1.0, (own.albedo, own.lit * own.albedo)),
    }
}

impl Sraa {
    /// Refuses what light cannot be taken apart for.
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
        }
    }
}
