//! Classes of pixels: with edges of geometry, with edges of shading only, and without edges.

use super::surfaces::Surfaces;
use crate::record::Shares;
use glam::{IVec2, UVec2, Vec3, Vec4};
use rayon::prelude::*;
use straightline_kernels::prelude::Frame;
use straightline_scene::picture::srgb;

/// Smallest variation of sRGB values over an edge of shading: eight steps of 255.
pub const STEP: f32 = 8.0 / 255.0;

/// Class of each pixel of a picture, row by row from the top.
#[derive(Clone, Debug, Default)]
pub struct Classes {
    /// `true` if the pixel's samples see more than one surface.
    pub geometry: Vec<bool>,
    /// `true` if they see one surface, whose colour varies by more than [`STEP`] over the pixel.
    pub shading: Vec<bool>,
    /// `true` if one of the samples sees a surface that none of the 3 x 3 shading samples around saw.
    pub unseen: Vec<bool>,
}

impl Classes {
    /// Classifies pixels by the geometry in `surfaces`, and by `varies`, which is `true` where a pixel's shading varies.
    pub fn new(surfaces: &Surfaces<'_>, varies: &[bool]) -> Classes {
        let size = surfaces.size();
        let found: Vec<(bool, bool)> = (0..size.y)
            .into_par_iter()
            .flat_map_iter(|y| (0..size.x).map(move |x| UVec2::new(x, y)))
            .map(|pixel| classify_pixel(surfaces, pixel))
            .collect();
        let geometry: Vec<bool> = found.iter().map(|(edge, _)| *edge).collect();
        Classes {
            shading: geometry
                .iter()
                .zip(varies)
                .map(|(edge, varies)| !edge && *varies)
                .collect(),
            geometry,
            unseen: found.iter().map(|(_, unseen)| *unseen).collect(),
        }
    }

    /// Returns whether a pixel has an edge of neither kind.
    pub fn is_flat(&self, pixel: usize) -> bool {
        !self.geometry[pixel] && !self.shading[pixel]
    }

    /// Returns the share of each class.
    pub fn shares(&self) -> Shares {
        let all = self.geometry.len().max(1) as f64;
        let share = |class: &[bool]| class.iter().filter(|is| **is).count() as f64 / all;
        let (geometry, shading) = (share(&self.geometry), share(&self.shading));
        Shares {
            geometry,
            shading,
            flat: 1.0 - geometry - shading,
            unseen: share(&self.unseen),
        }
    }
}

/// Returns whether a pixel has an edge of geometry, and whether it has a surface that was not seen.
fn classify_pixel(surfaces: &Surfaces<'_>, pixel: UVec2) -> (bool, bool) {
    let around = seen_around(surfaces, pixel);
    let (mut edge, mut unseen) = (false, false);
    for sample in 0..surfaces.sample_count() {
        let point = surfaces.point(pixel, sample);
        // The first is the pixel's own.
        if !surfaces.is_same_surface(&point, &around[0]) {
            edge = true;
            unseen |= !around[1..].iter().any(|tap| surfaces.is_same_surface(&point, tap));
        }
    }
    (edge, unseen)
}

/// Returns the points that the shading samples of a pixel and its neighbours see, its own first.
pub(super) fn seen_around(surfaces: &Surfaces<'_>, pixel: UVec2) -> Vec<super::surfaces::Point> {
    let places = std::iter::once(IVec2::ZERO).chain(neighbour_offsets());
    places
        .flat_map(|by| surfaces.shaded_points(pixel.as_ivec2() + by))
        .collect()
}

/// Returns the offsets of the eight pixels around a pixel.
pub(super) fn neighbour_offsets() -> impl Iterator<Item = IVec2> {
    (-1..=1)
        .flat_map(|y| (-1..=1).map(move |x| IVec2::new(x, y)))
        .filter(|by| *by != IVec2::ZERO)
}

/// Returns whether the colours of each pixel vary, for pictures shaded at several positions in it.
pub fn varies_within(shaded: &[Frame<Vec4>]) -> Vec<bool> {
    let pixels = shaded.first().map_or(0, |frame| frame.texels().len());
    (0..pixels)
        .into_par_iter()
        .map(|k| {
            let colors = shaded.iter().map(|frame| display_color(frame.texels()[k]));
            let (low, high) = colors.fold((Vec3::ONE, Vec3::ZERO), |(low, high), c| (low.min(c), high.max(c)));
            (high - low).max_element() > STEP
        })
        .collect()
}

/// Approximates [`varies_within`] for a picture shaded once a pixel: `true` if the colour differs from that of a neighbour
/// above, below, left or right that sees the same surface.
pub fn varies_around(color: &Frame<Vec4>, surfaces: &Surfaces<'_>) -> Vec<bool> {
    let size = color.size();
    let at = |p: IVec2| display_color(color.texels()[(p.y * size.x as i32 + p.x) as usize]);
    (0..size.x * size.y)
        .into_par_iter()
        .map(|k| {
            let pixel = IVec2::new((k % size.x) as i32, (k / size.x) as i32);
            let Some(own) = surfaces.shaded_points(pixel).next() else {
                return false;
            };
            [IVec2::X, IVec2::NEG_X, IVec2::Y, IVec2::NEG_Y].into_iter().any(|by| {
                let near = surfaces.shaded_points(pixel + by).next();
                near.is_some_and(|near| surfaces.is_same_surface(&own, &near))
                    && (at(pixel) - at(pixel + by)).abs().max_element() > STEP
            })
        })
        .collect()
}

/// Returns a colour as displayed.
fn display_color(color: Vec4) -> Vec3 {
    color.truncate().clamp(Vec3::ZERO, Vec3::ONE).map(srgb::from_linear)
}
