//! FLIP: how visible a difference is to someone who flips between both pictures (Andersson et al. 2020), by `flip-rs`, a port
//! of NVIDIA's version 1.7.

use super::display::encode_for_display;
use flip_rs::{DEFAULT_PPD, RgbImage, ldr_flip};
use glam::{Vec3, Vec4};
use straightline_kernels::prelude::Frame;

/// Mean of [`flip_map`]: 0 for equal pictures, at most 1.
pub fn flip(test: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
    let map = flip_map(test, reference);
    map.iter().map(|error| f64::from(*error)).sum::<f64>() / map.len() as f64
}

/// Visibility of the difference at each pixel, row by row from the top, 0 to 1: LDR-FLIP for a display of 3840 pixels in 0.7 m,
/// seen from 0.7 m, which is the authors' default. 1 where a picture is not finite.
pub fn flip_map(test: &Frame<Vec4>, reference: &Frame<Vec4>) -> Vec<f32> {
    let shown = encode_for_display(test, reference);
    let (width, height) = (test.size().x as usize, test.size().y as usize);
    let image = |texels: &[Vec3]| {
        let channels = texels.iter().flat_map(|texel| texel.to_array()).collect::<Vec<f32>>();
        RgbImage::new(width, height, channels)
    };
    let map = image(&shown.reference)
        .and_then(|reference| image(&shown.test).and_then(|test| ldr_flip(&reference, &test, DEFAULT_PPD)));
    // `ldr_flip` refuses pictures of no size, of two sizes, of values that are not finite, and of more than 2^34 sums: a frame
    // has pixels, `shown` sees to two and three, and no picture that is read or drawn here is so large.
    let mut map = map
        .expect("two pictures of one size and of finite values")
        .into_pixels();
    for index in shown.bad {
        map[index] = 1.0;
    }
    map
}
