//! The scale of the guide: the factor that brings it nearest to the colours of a picture. With it, a guide that is too bright or
//! too dark everywhere does no harm.
//!
//! > k = Σ w c·g / Σ w g·g, w = 1 / (c·c + g·g + ε), from 0 to [`MOST`]
//!
//! over the shading samples. The weights w make bright and dark pixels count alike. Effects that a good guide omits, such as
//! haze, move k away from 1: near 1 the scale stays 1, and between [`NEAR`] and [`FAR_OFF`] it blends into k.

use super::colors::Colors;
use super::gbuffer::GBuffer;
use super::guide::{Estimated, Guiding, unscaled};
use super::options::Sraa;
use super::placed::shaded_place;
use super::view::View;
use crate::prelude::*;

/// Width and height of a tile, in pixels.
const TILE: i32 = 16;

/// ε of the weights: much darker colours count less.
const FAINT: f32 = 1.0e-4;

/// Largest scale.
const MOST: f32 = 1.5;

/// Difference of the fitted scale from 1 up to which it is replaced by 1.
const NEAR: f32 = 0.25;

/// Difference of the fitted scale from 1 beyond which it is used unchanged.
const FAR_OFF: f32 = 0.5;

/// Sums over a tile of 16×16 pixels for [`sraa_fit`]: w c·g in red and w g·g in green. `pixel` is the index of the tile,
/// counted from the picture's upper left corner.
pub fn sraa_fit_sums(
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
        "sraa_fit_sums reads one colour a pixel: set fitted=false, or shade once a pixel"
    );
    let size = colors.color.size().as_ivec2();
    let mut both = 0.0;
    let mut own = 0.0;
    #[cfg_attr(false, unroll(none))]
    for k in 0..TILE * TILE {
        let at = TILE * pixel + ivec2(k % TILE, k / TILE);
        let seen = Estimated {
            gbuffer,
            view,
            colors,
            guiding,
            pixel: at,
        };
        let place = shaded_place(cfg, &colors.place, at, cfg.tap(0, 1));
        let guide = unscaled(cfg, &seen, place);
        let color = colors.color.load(at);
        if at.x < size.x && at.y < size.y && color.is_finite() {
            let shaded = color.xyz();
            let weight = 1.0 / (shaded.dot(shaded) + guide.dot(guide) + FAINT);
            both += weight * shaded.dot(guide);
            own += weight * guide.dot(guide);
        }
    }
    vec4(both, own, 0.0, 0.0)
}

/// Scale of the guide in red, from the sums of all tiles: the image `guide_scale`, of which only the upper left pixel is read.
/// Dispatch this kernel for that pixel only.
#[allow(clippy::manual_clamp)] // `clamp` would keep NaN
pub fn sraa_fit(cfg: &Sraa, sums: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    cfg.check();
    let size = sums.size().as_ivec2();
    let mut total = Vec4::ZERO;
    for y in 0..size.y {
        for x in 0..size.x {
            total += sums.load(pixel + ivec2(x, y));
        }
    }
    // If the guide is 0 everywhere, so is its scale.
    let scale = if total.y > 0.0 { total.x / total.y } else { 0.0 };
    let apart = scale.max(0.0).min(MOST) - 1.0;
    let share = ((apart.abs() - NEAR) / (FAR_OFF - NEAR)).clamp(0.0, 1.0);
    vec4(1.0 + share * apart, 0.0, 0.0, 0.0)
}
