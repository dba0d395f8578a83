//! Upper bounds for filters with one shading sample a pixel, and antialiasing that shades each surface once.

use super::classes::seen_around;
use super::surfaces::{Point, Surfaces};
use crate::baselines::resolve_directional;
use glam::{UVec2, Vec2, Vec4, ivec2};
use rayon::prelude::*;
use straightline_kernels::prelude::Frame;

/// Multisampling: each sample of a pixel takes the colour of the first sample that sees its surface, so that each surface
/// is shaded once. `shaded` holds the picture at each sample.
pub fn once_a_surface(surfaces: &Surfaces<'_>, shaded: &[Frame<Vec4>]) -> Frame<Vec4> {
    each_pixel(surfaces.size(), |pixel, k| {
        let colors = (0..shaded.len()).map(|sample| multisampled_frame(surfaces, shaded, pixel, sample).texels()[k]);
        colors.sum::<Vec4>() / shaded.len() as f32
    })
}

/// Multisampling resolved by the directionally adaptive filter, each surface shaded once.
pub fn along_edges(surfaces: &Surfaces<'_>, shaded: &[Frame<Vec4>], offsets: &[Vec2]) -> Frame<Vec4> {
    resolve_directional(&multisampled_frames(surfaces, shaded), offsets)
}

/// Returns the colours that the samples of a multisampled target have.
pub fn multisampled_frames(surfaces: &Surfaces<'_>, shaded: &[Frame<Vec4>]) -> Vec<Frame<Vec4>> {
    let stored = (0..shaded.len()).map(|sample| {
        each_pixel(surfaces.size(), |pixel, k| {
            multisampled_frame(surfaces, shaded, pixel, sample).texels()[k]
        })
    });
    stored.collect()
}

/// Returns the picture that has the colour of a sample: that of the first that sees its surface.
fn multisampled_frame<'a>(
    surfaces: &Surfaces<'_>,
    shaded: &'a [Frame<Vec4>],
    pixel: UVec2,
    sample: usize,
) -> &'a Frame<Vec4> {
    let own = surfaces.point(pixel, sample);
    let first = (0..sample).find(|other| surfaces.is_same_surface(&own, &surfaces.point(pixel, *other)));
    &shaded[first.unwrap_or(sample)]
}

/// Deferred multisampling with edge detection: a pixel whose samples all see one surface is shaded at the first of them,
/// any other at every sample.
pub fn where_edges_are(surfaces: &Surfaces<'_>, shaded: &[Frame<Vec4>]) -> Frame<Vec4> {
    each_pixel(surfaces.size(), |pixel, k| {
        let first = surfaces.point(pixel, 0);
        let even = (1..shaded.len()).all(|sample| surfaces.is_same_surface(&first, &surfaces.point(pixel, sample)));
        let shaded = if even { &shaded[..1] } else { shaded };
        shaded.iter().map(|frame| frame.texels()[k]).sum::<Vec4>() / shaded.len() as f32
    })
}

/// Coverage sampling: the colours of `stored` samples are kept, each surface shaded once. All other samples only store the
/// index of their surface among those, or nothing if it is another surface.
pub fn by_coverage(surfaces: &Surfaces<'_>, shaded: &[Frame<Vec4>], stored: &[usize]) -> Frame<Vec4> {
    each_pixel(surfaces.size(), |pixel, k| {
        let seen = (0..shaded.len()).filter_map(|sample| find_stored_sample(surfaces, stored, pixel, sample));
        let colors: Vec<Vec4> = seen.map(|kept| shaded[stored[kept]].texels()[k]).collect();
        colors.iter().sum::<Vec4>() / colors.len().max(1) as f32
    })
}

/// Returns the stored sample that sees the surface that a sample sees, if one does.
pub fn find_stored_sample(surfaces: &Surfaces<'_>, stored: &[usize], pixel: UVec2, sample: usize) -> Option<usize> {
    let point = surfaces.point(pixel, sample);
    let is_same = |kept: &usize| surfaces.is_same_surface(&point, &surfaces.point(pixel, *kept));
    stored.iter().position(is_same)
}

/// Ideal reconstruction, which knows the right colour of every surface that it can know of. Each geometry sample has its
/// own true colour if one of the 3 x 3 shading samples around saw its surface, else the colour of the shading sample that
/// is nearest to it in depth and normal. Its gap to supersampling at the same positions is the price of surfaces that no
/// shading sample saw; SRAA's gap to it is the price of borrowed colours.
///
/// `shaded` holds the picture at each sample, `color` at the shading sample.
pub fn reconstruct_ideal(surfaces: &Surfaces<'_>, shaded: &[Frame<Vec4>], color: &Frame<Vec4>) -> Frame<Vec4> {
    each_pixel(surfaces.size(), |pixel, k| {
        let around = seen_around(surfaces, pixel);
        let sum: Vec4 = shaded
            .iter()
            .enumerate()
            .map(|(sample, shaded)| {
                let point = surfaces.point(pixel, sample);
                if around.iter().any(|tap| surfaces.is_same_surface(&point, tap)) {
                    shaded.texels()[k]
                } else {
                    nearest_pixel(&point, &around).map_or(shaded.texels()[k], |tap| color.load(tap))
                }
            })
            .sum();
        sum / shaded.len() as f32
    })
}

/// Returns the pixel whose shading sample is most similar to a point.
fn nearest_pixel(point: &Point, around: &[Point]) -> Option<glam::IVec2> {
    let nearest = around
        .iter()
        .min_by(|a, b| point.difference_to(a).total_cmp(&point.difference_to(b)))?;
    let pixel = nearest.pixel();
    Some(ivec2(pixel.x as i32, pixel.y as i32))
}

fn each_pixel(size: UVec2, texel: impl Fn(UVec2, usize) -> Vec4 + Sync) -> Frame<Vec4> {
    let texels = (0..size.x * size.y)
        .into_par_iter()
        .map(|k| texel(UVec2::new(k % size.x, k / size.x), k as usize))
        .collect();
    Frame::new(size, texels)
}
