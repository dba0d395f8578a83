//! The directionally adaptive filter (Iourcha, Yang, Pomianowski 2009, "A Directionally Adaptive Edge Anti-Aliasing
//! Filter"), on the CPU, after its publication.
//!
//! It resolves a multisampled picture. Where the samples of a pixel differ, the picture around is taken to change in one
//! direction only: that of the plane which fits the luma of the samples of 3×3 pixels best. All samples on a line across
//! that direction then have one colour, so each counts as long as its line runs through the pixel. Where the plane fits
//! badly, as at corners and in texture, and where the pixel is even, the pixel is the mean of its own samples.
//!
//! The publication leaves open how badly; here a plane must explain half of the variance. Its samples' luma is that of the
//! picture a display is sent, and colours are blended as light.

use glam::{DMat2, DVec2, UVec2, Vec2, Vec3, Vec4, ivec2};
use rayon::prelude::*;
use straightline_kernels::prelude::Frame;
use straightline_scene::picture;

/// The least difference of luma that is an edge: a step of 8 bits.
const EDGE: f64 = 1.0 / 255.0;

/// The share of the variance that a plane must explain.
const EXPLAINED: f64 = 0.5;

/// Resolves a picture. `samples` holds the linear colours of each sample, which lies at its offset from the pixel's centre,
/// in pixels, y down.
pub fn resolve_directional(samples: &[Frame<Vec4>], offsets: &[Vec2]) -> Frame<Vec4> {
    let size = samples.first().map_or(UVec2::ZERO, Frame::size);
    let lumas: Vec<Frame<f32>> = samples.iter().map(luma_frame).collect();
    let texels = (0..size.x * size.y).into_par_iter().map(|k| {
        let pixel = uvec2_at(k, size).as_ivec2();
        let own = |frame: &Frame<Vec4>| frame.texels()[k as usize];
        let even = || samples.iter().map(own).sum::<Vec4>() / samples.len().max(1) as f32;
        let bright = lumas.iter().map(|frame| frame.texels()[k as usize]);
        let (low, high) = bright.fold((f32::MAX, f32::MIN), |(low, high), l| (low.min(l), high.max(l)));
        if f64::from(high - low) < EDGE {
            return even();
        }
        let around = || {
            let pixels = (-1..=1).flat_map(|y| (-1..=1).map(move |x| ivec2(x, y)));
            pixels.flat_map(move |by| (0..offsets.len()).map(move |sample| (by, sample)))
        };
        let places: Vec<(DVec2, f64)> = around()
            .map(|(by, sample)| {
                let place = by.as_dvec2() + offsets[sample].as_dvec2();
                (place, f64::from(lumas[sample].load(pixel + by)))
            })
            .collect();
        let Some(along) = isoline_direction(&places) else {
            return even();
        };
        let (mut sum, mut total) = (Vec4::ZERO, 0.0);
        for ((by, sample), (place, _)) in around().zip(&places) {
            let weight = chord_length(*place, along) as f32;
            sum += weight * samples[sample].load(pixel + by);
            total += weight;
        }
        if total > 0.0 { sum / total } else { even() }
    });
    Frame::new(size, texels.collect())
}

fn uvec2_at(k: u32, size: UVec2) -> UVec2 {
    UVec2::new(k % size.x, k / size.x)
}

/// Returns the luma of the picture as sent to a display.
fn luma_frame(linear: &Frame<Vec4>) -> Frame<f32> {
    let shown = |texel: &Vec4| {
        let [r, g, b] = texel
            .truncate()
            .to_array()
            .map(|c| picture::srgb::from_linear(c.clamp(0.0, 1.0)));
        Vec3::new(r, g, b).dot(Vec3::new(0.2126, 0.7152, 0.0722))
    };
    Frame::new(linear.size(), linear.texels().iter().map(shown).collect())
}

/// Returns the direction in which the picture does not change, if the plane fitted to the values explains them well enough.
fn isoline_direction(values: &[(DVec2, f64)]) -> Option<DVec2> {
    let count = values.len() as f64;
    let middle = values.iter().map(|(place, _)| *place).sum::<DVec2>() / count;
    let mean = values.iter().map(|(_, value)| value).sum::<f64>() / count;
    let (mut squares, mut moment, mut variance) = (DMat2::ZERO, DVec2::ZERO, 0.0);
    for (place, value) in values {
        let (from, off) = (*place - middle, value - mean);
        squares += DMat2::from_cols(from * from.x, from * from.y);
        moment += from * off;
        variance += off * off;
    }
    let slope = squares.inverse() * moment;
    let explained = slope.dot(moment);
    (slope.is_finite() && explained >= EXPLAINED * variance && explained > 0.0).then(|| slope.perp().normalize())
}

/// Returns the length of the line through `place` in the direction `along`, of length 1, within the pixel around the origin.
fn chord_length(place: DVec2, along: DVec2) -> f64 {
    let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..2 {
        if along[axis].abs() < 1.0e-12 {
            if place[axis].abs() > 0.5 {
                return 0.0;
            }
            continue;
        }
        let ends = [-0.5, 0.5].map(|side| (side - place[axis]) / along[axis]);
        from = from.max(ends[0].min(ends[1]));
        to = to.min(ends[0].max(ends[1]));
    }
    (to - from).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    /// Counts the chord's length in small steps.
    #[test]
    fn a_chord_is_as_long_as_the_line_is_inside() {
        for k in 0..200 {
            let angle = f64::from(k) * 0.37;
            let along = dvec2(angle.cos(), angle.sin());
            let place = dvec2((f64::from(k) * 0.71).sin(), (f64::from(k) * 1.13).cos()) * 1.4;
            let inside = |step: i32| (place + along * (f64::from(step) * 1.0e-4)).abs().max_element() <= 0.5;
            let counted = (-40_000..40_000).filter(|step| inside(*step)).count() as f64 * 1.0e-4;
            assert!((chord_length(place, along) - counted).abs() < 4.0e-4, "{place} {along}");
        }
    }

    #[test]
    fn a_ramp_has_its_own_direction() {
        let slope = dvec2(0.3, -0.8);
        let places: Vec<(DVec2, f64)> = (0..36)
            .map(|k| dvec2(f64::from(k % 6) * 0.5, f64::from(k / 6) * 0.4))
            .map(|place| (place, 2.0 + slope.dot(place)))
            .collect();
        let along = isoline_direction(&places).expect("it is a plane");
        assert!(along.dot(slope).abs() < 1.0e-12);
        let noise: Vec<(DVec2, f64)> = places
            .iter()
            .enumerate()
            .map(|(k, (p, _))| (*p, (k * 7919 % 13) as f64))
            .collect();
        assert_eq!(isoline_direction(&noise), None);
    }

    /// The filtered straight edge is closer to the coverage of each pixel than the mean of the samples.
    #[test]
    fn straight_edges_have_more_steps_than_samples() {
        let offsets = straightline_scene::gbuffer::pattern_offsets("latin4").expect("a pattern");
        let size = UVec2::new(24, 12);
        let covered = |place: Vec2| place.y < 4.0 + 0.17 * place.x;
        let white = |inside: bool| {
            if inside {
                Vec4::ONE
            } else {
                Vec4::new(0.0, 0.0, 0.0, 1.0)
            }
        };
        let drawn = |offset: &Vec2| {
            let texel = |k| white(covered(uvec2_at(k, size).as_vec2() + 0.5 + *offset));
            Frame::new(size, (0..size.x * size.y).map(texel).collect())
        };
        let samples: Vec<Frame<Vec4>> = offsets.iter().map(drawn).collect();
        let (found, plain) = (
            resolve_directional(&samples, &offsets),
            straightline_scene::capture::mean_frame(&samples),
        );
        let plain = plain.expect("pictures");
        let exact = |k: u32| {
            let fine = (0..32 * 32).map(|s| Vec2::new((s % 32) as f32 + 0.5, (s / 32) as f32 + 0.5) / 32.0);
            let inside = fine.filter(|by| covered(uvec2_at(k, size).as_vec2() + *by)).count();
            inside as f32 / 1024.0
        };
        let error = |image: &Frame<Vec4>| -> f32 {
            // Away from the border, where the edge ends.
            let inner = (0..size.x * size.y).filter(|k| (2..22).contains(&(k % size.x)));
            inner.map(|k| (image.texels()[k as usize].x - exact(k)).powi(2)).sum()
        };
        assert!(
            error(&found) < 0.5 * error(&plain),
            "{} and {}",
            error(&found),
            error(&plain)
        );
    }

    #[test]
    fn an_even_picture_stays() {
        let even = Frame::new(UVec2::new(5, 4), vec![Vec4::new(0.3, 0.2, 0.1, 1.0); 20]);
        let found = resolve_directional(&[even.clone(), even.clone()], &[Vec2::splat(0.25), Vec2::splat(-0.25)]);
        let far = |(a, b): (&Vec4, &Vec4)| (*a - *b).abs().max_element();
        assert!(found.texels().iter().zip(even.texels()).all(|pair| far(pair) < 1.0e-6));
    }
}
