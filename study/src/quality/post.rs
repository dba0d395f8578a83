//! Post-processing of a shaded picture: bloom, and tone mapping for display.
//!
//! The paper (§1, §3.1) reconstructs before it, where a bright edge is a mean of light. After it, the light has already
//! spread, and colours brighter than white no longer count in proportion to their area.

use super::methods::Method;
use super::shot::Shot;
use glam::{UVec2, Vec3, Vec4, ivec2};
use rayon::prelude::*;
use std::collections::BTreeMap;
use straightline_kernels::prelude::Frame;

/// Standard deviation of the spill, in pixels.
const SIGMA: f32 = 4.0;

/// Share of the light brighter than white that spills.
const STRENGTH: f32 = 0.1;

/// Applies bloom, then tone mapping.
pub fn post_process(linear: &Frame<Vec4>) -> Frame<Vec4> {
    let bright = map_texels(linear, |_, texel| {
        (texel.truncate() - Vec3::ONE).max(Vec3::ZERO).extend(0.0)
    });
    let spilt = blur_along(&blur_along(&bright, ivec2(1, 0)), ivec2(0, 1));
    map_texels(linear, |k, texel| {
        let light = texel.truncate() + STRENGTH * spilt.texels()[k].truncate();
        tone_mapped(light).extend(texel.w)
    })
}

/// Reinhard's curve for luminance, with a white of 4 (Reinhard et al. 2002, equation 4), which maps to 1.
fn tone_mapped(light: Vec3) -> Vec3 {
    const WHITE: f32 = 4.0;
    let luminance = light.dot(Vec3::new(0.2126, 0.7152, 0.0722));
    light * (1.0 + luminance / (WHITE * WHITE)) / (1.0 + luminance)
}

fn blur_along(image: &Frame<Vec4>, step: glam::IVec2) -> Frame<Vec4> {
    let reach = (3.0 * SIGMA) as i32;
    let weights: Vec<f32> = (-reach..=reach)
        .map(|x| (-0.5 * (x as f32 / SIGMA).powi(2)).exp())
        .collect();
    let total: f32 = weights.iter().sum();
    let size = image.size();
    map_texels(image, |k, _| {
        let pixel = UVec2::new(k as u32 % size.x, k as u32 / size.x).as_ivec2();
        let taps = (-reach..=reach).zip(&weights);
        taps.map(|(x, weight)| *weight * image.load(pixel + step * x))
            .sum::<Vec4>()
            / total
    })
}

fn map_texels(image: &Frame<Vec4>, of: impl Fn(usize, Vec4) -> Vec4 + Sync) -> Frame<Vec4> {
    let texels = image.texels().par_iter().enumerate().map(|(k, texel)| of(k, *texel));
    Frame::new(image.size(), texels.collect())
}

impl Shot {
    /// Returns the shot with its colours processed, the input of a filter that comes last.
    pub fn post_process(&self) -> Shot {
        let mut captures = self.captures.clone();
        for capture in captures.values_mut() {
            capture.color = post_process(&capture.color);
            capture.colors = capture.colors.iter().map(post_process).collect();
        }
        let shaded = self.shaded.iter();
        Shot {
            captures,
            shaded: shaded
                .map(|(n, frames)| (*n, frames.iter().map(post_process).collect()))
                .collect(),
            // Filters of the displayed picture do not read those.
            extra: BTreeMap::new(),
            aggregated: BTreeMap::new(),
        }
    }
}

/// Returns methods in the order that the paper advises against: on processed shading samples.
pub fn the_other_order() -> Vec<Method> {
    let named = ["SRAA 4", "SRAA 16", "4x", "16x"];
    let all = super::list_methods(true)
        .into_iter()
        .filter(|method| named.contains(&method.name.as_str()));
    let late = all.map(|mut method| {
        method.name += ", after post-processing";
        (method.panned, method.explained, method.last) = (false, false, true);
        method
    });
    late.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dark_pictures_do_not_bloom() {
        let dark = Frame::new(UVec2::new(9, 7), vec![Vec4::new(0.5, 0.25, 0.125, 0.5); 63]);
        let luminance = 0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722 * 0.125;
        let factor = (1.0 + luminance / 16.0) / (1.0 + luminance);
        for texel in post_process(&dark).texels() {
            assert!(
                (texel.truncate() - dark.texels()[0].truncate() * factor)
                    .abs()
                    .max_element()
                    < 1.0e-6
            );
            assert_eq!(texel.w, 0.5);
        }
    }

    /// Light that spreads is neither created nor lost, away from the border.
    #[test]
    fn what_spills_is_a_share_of_what_is_too_bright() {
        let size = UVec2::new(41, 41);
        let mut texels = vec![Vec4::ZERO; 41 * 41];
        texels[20 * 41 + 20] = Vec4::new(11.0, 0.0, 0.0, 0.0);
        let bright = Frame::new(size, texels);
        let spilt = blur_along(&blur_along(&bright, ivec2(1, 0)), ivec2(0, 1));
        let sum: f32 = spilt.texels().iter().map(|texel| texel.x).sum();
        assert!((sum - 11.0).abs() < 1.0e-3, "{sum}");
        assert!(spilt.texels()[20 * 41 + 24].x < spilt.texels()[20 * 41 + 20].x);
    }

    #[test]
    fn white_is_shown_as_white() {
        assert!((tone_mapped(Vec3::splat(4.0)) - Vec3::ONE).abs().max_element() < 1.0e-6);
        assert!(tone_mapped(Vec3::splat(0.01)).x > 0.0098);
    }
}
