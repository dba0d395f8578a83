//! The scale of the guide: for each channel, the factor at which the colours differ from it most evenly. With it, a guide that is too
//! bright, too dark or of another tint does no harm.
//!
//! > k = Σ w Δc Δg / Σ w Δg Δg, w = 1 / (Δc² + Δg² + ε), from 0 to [`MOST`]
//!
//! over the steps Δ from each shading sample to the next, to the right and down. Steps and not values: effects that a good guide omits, such
//! as ambient light of another direction, change slowly and do not count. The weights make large and small steps count alike.

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
const MOST: f32 = 4.0;

/// Sums over a tile or a row of tiles for [`sraa_fit`], for each channel; alpha is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitSums {
    /// Σ w Δc Δg.
    pub both: Vec4,
    /// Σ w Δg Δg.
    pub own: Vec4,
}

/// Sums over a tile of 16×16 pixels. `pixel` is the index of the tile, counted from the picture's upper left corner.
pub fn sraa_fit_sums(
    cfg: &Sraa,
    gbuffer: &GBuffer,
    view: &View,
    colors: &Colors,
    guiding: &Guiding,
    pixel: IVec2,
) -> FitSums {
    cfg.check();
    assert!(
        cfg.shading_samples() == 1,
        "sraa_fit_sums reads one colour a pixel: set fitted=false, or shade once a pixel"
    );
    let size = colors.color.size().as_ivec2();
    let mut both = Vec3::ZERO;
    let mut own = Vec3::ZERO;
    #[cfg_attr(false, unroll(none))]
    for k in 0..TILE * TILE {
        let at = TILE * pixel + ivec2(k % TILE, k / TILE);
        let here = shaded_pixel(cfg, gbuffer, view, colors, guiding, at);
        for axis in 0..2 {
            let next = at + ivec2(1 - axis, axis);
            let there = shaded_pixel(cfg, gbuffer, view, colors, guiding, next);
            if next.x < size.x && next.y < size.y && here.color.is_finite() && there.color.is_finite() {
                let color = there.color.xyz() - here.color.xyz();
                let guide = there.guide - here.guide;
                let weight = (color * color + guide * guide + FAINT).recip();
                both += weight * color * guide;
                own += weight * guide * guide;
            }
        }
    }
    FitSums {
        both: both.extend(0.0),
        own: own.extend(0.0),
    }
}

/// Colour of a pixel, and the guide at the position that is shaded.
struct Shaded {
    color: Vec4,
    guide: Vec3,
}

fn shaded_pixel(
    cfg: &Sraa,
    gbuffer: &GBuffer,
    view: &View,
    colors: &Colors,
    guiding: &Guiding,
    pixel: IVec2,
) -> Shaded {
    let seen = Estimated {
        gbuffer,
        view,
        colors,
        guiding,
        pixel,
    };
    let place = shaded_place(cfg, &colors.place, pixel, cfg.tap(0, 1));
    Shaded {
        color: colors.color.load(pixel),
        guide: unscaled(cfg, &seen, place),
    }
}

/// Sums over a row of tiles, so that [`sraa_fit`], which is one thread's work, reads fewer. `pixel` is in the first column.
/// Dispatch this kernel for one pixel a row of tiles.
pub fn sraa_fit_rows(cfg: &Sraa, both: &Texture<Vec4>, own: &Texture<Vec4>, pixel: IVec2) -> FitSums {
    cfg.check();
    let mut row = FitSums {
        both: Vec4::ZERO,
        own: Vec4::ZERO,
    };
    for x in 0..both.size().x as i32 {
        row.both += both.load(ivec2(x, pixel.y));
        row.own += own.load(ivec2(x, pixel.y));
    }
    row
}

/// Scale of each channel of the guide, from the sums of all tiles or rows of tiles: the image `guide_scale`, of which only the
/// upper left pixel is read. Dispatch this kernel for that pixel only. Alpha is 0.
pub fn sraa_fit(cfg: &Sraa, both: &Texture<Vec4>, own: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    cfg.check();
    let size = both.size().as_ivec2();
    let mut total_both = Vec4::ZERO;
    let mut total_own = Vec4::ZERO;
    for y in 0..size.y {
        for x in 0..size.x {
            total_both += both.load(pixel + ivec2(x, y));
            total_own += own.load(pixel + ivec2(x, y));
        }
    }
    vec4(
        scale(total_both.x, total_own.x),
        scale(total_both.y, total_own.y),
        scale(total_both.z, total_own.z),
        0.0,
    )
}

/// Scale of a channel from its sums; 0 if the guide is the same everywhere.
#[allow(clippy::manual_clamp)] // `clamp` would keep NaN
fn scale(both: f32, own: f32) -> f32 {
    let scale = if own > 0.0 { both / own } else { 0.0 };
    scale.max(0.0).min(MOST)
}
