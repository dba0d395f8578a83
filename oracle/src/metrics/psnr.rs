//! Peak signal-to-noise ratio, and plain differences.
//!
//! Errors are taken over red, green and blue of linear colour clamped to 0..=1, the range of a display, and summed in
//! double precision. A pixel that is not finite counts as wrong by the whole range in all three.

use glam::Vec4;
use straightline_kernels::prelude::Frame;

/// PSNR of equal pictures, and the most of any: infinity cannot be written as JSON.
pub const MOST_DB: f64 = 160.0;

/// Peak signal-to-noise ratio of `test` in dB, with a peak of 1: `10·log10(1 / mse)`. Infinite for equal pictures.
pub fn psnr(test: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
    psnr_where(test, reference, |_| true)
}

/// [`psnr`] over the pixels whose index, row by row from the top left, `mask` accepts. NaN if it accepts none.
pub fn psnr_where(test: &Frame<Vec4>, reference: &Frame<Vec4>, mask: impl Fn(usize) -> bool) -> f64 {
    -10.0 * mse_where(test, reference, mask).log10()
}

/// Mean squared error over all pixels and their red, green and blue: 0 for equal pictures, at most 1.
pub fn mse(test: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
    mse_where(test, reference, |_| true)
}

/// [`mse`] over the pixels whose index, row by row from the top left, `mask` accepts. NaN if it accepts none.
pub fn mse_where(test: &Frame<Vec4>, reference: &Frame<Vec4>, mask: impl Fn(usize) -> bool) -> f64 {
    let mut sum = 0.0;
    let mut count = 0u64;
    for (index, (test, reference)) in texel_pairs(test, reference).enumerate() {
        if mask(index) {
            sum += squared_error(test, reference);
            count += 3;
        }
    }
    sum / count as f64
}

/// Returns the error that one pixel in a thousand exceeds, 0 to 1: the root mean square over red, green and blue.
pub fn worst_error(test: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
    let squared = texel_pairs(test, reference).map(|(test, reference)| squared_error(test, reference) / 3.0);
    let mut squared: Vec<f64> = squared.collect();
    let beyond = squared.len() / 1000;
    if squared.is_empty() {
        return 0.0;
    }
    let (_, worst, _) = squared.select_nth_unstable_by(beyond, |a, b| b.total_cmp(a));
    worst.sqrt()
}

/// Largest absolute difference of any component, alpha too, of any pixel: not clamped, so that it bounds the
/// error of a computation. Two components that are both NaN, or the same infinity, do not differ; anything
/// else that is not finite differs infinitely.
pub fn max_abs_difference(test: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
    texel_pairs(test, reference).fold(0.0, |largest, (test, reference)| {
        largest.max(largest_difference(test, reference.to_array().map(f64::from)))
    })
}

/// [`max_abs_difference`] to a reference in double precision, such as the oracle's: one RGBA for each pixel.
/// Panics unless there is exactly one for each.
pub fn max_abs_difference_to(test: &Frame<Vec4>, reference: &[[f64; 4]]) -> f64 {
    assert_eq!(test.texels().len(), reference.len(), "one reference for each pixel");
    test.texels()
        .iter()
        .zip(reference)
        .fold(0.0, |largest, (test, reference)| {
            largest.max(largest_difference(*test, *reference))
        })
}

/// Number of pixels with a component, alpha too, that is NaN or infinite.
pub fn non_finite(frame: &Frame<Vec4>) -> usize {
    frame.texels().iter().filter(|texel| !texel.is_finite()).count()
}

fn texel_pairs<'a>(test: &'a Frame<Vec4>, reference: &'a Frame<Vec4>) -> impl Iterator<Item = (Vec4, Vec4)> + 'a {
    assert_eq!(test.size(), reference.size(), "pictures of one size");
    test.texels().iter().copied().zip(reference.texels().iter().copied())
}

/// Sum over red, green and blue; 3 for a pixel that is not finite.
fn squared_error(test: Vec4, reference: Vec4) -> f64 {
    let (test, reference) = (test.truncate(), reference.truncate());
    if !test.is_finite() || !reference.is_finite() {
        return 3.0;
    }
    let clamped = |value: f32| f64::from(value).clamp(0.0, 1.0);
    (0..3)
        .map(|axis| (clamped(test[axis]) - clamped(reference[axis])).powi(2))
        .sum()
}

fn largest_difference(test: Vec4, reference: [f64; 4]) -> f64 {
    let difference = |(test, reference): (f64, f64)| {
        if test == reference || (test.is_nan() && reference.is_nan()) {
            0.0
        } else if test.is_finite() && reference.is_finite() {
            (test - reference).abs()
        } else {
            f64::INFINITY
        }
    };
    test.to_array()
        .map(f64::from)
        .into_iter()
        .zip(reference)
        .map(difference)
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{uvec2, vec4};

    fn row_frame(texels: &[Vec4]) -> Frame<Vec4> {
        Frame::new(uvec2(texels.len() as u32, 1), texels.to_vec())
    }

    const GREY: Vec4 = Vec4::new(0.5, 0.5, 0.5, 1.0);

    #[test]
    fn equal_pictures_are_infinitely_good() {
        let picture = row_frame(&[GREY, Vec4::ZERO]);
        assert_eq!(psnr(&picture, &picture), f64::INFINITY);
        assert_eq!(
            (mse(&picture, &picture), max_abs_difference(&picture, &picture)),
            (0.0, 0.0)
        );
    }

    #[test]
    fn hand_computed() {
        // Squared errors of the six components: 0.25², 0, 0.5² and 0, 0, 0; their mean 0.3125 / 6 = 0.052083.
        let reference = row_frame(&[GREY, GREY]);
        let test = row_frame(&[vec4(0.75, 0.5, 0.0, 0.0), GREY]);
        assert!((mse(&test, &reference) - 0.3125 / 6.0).abs() < 1e-15);
        assert!((psnr(&test, &reference) - 12.833_012).abs() < 1e-6);
        // Alpha counts here, and only here.
        assert_eq!(max_abs_difference(&test, &reference), 1.0);
        // A difference of 0.1 in every component is 20 dB, up to the rounding of 0.6 and 0.5 to f32.
        let test = row_frame(&[vec4(0.6, 0.6, 0.6, 1.0)]);
        assert!((psnr(&test, &row_frame(&[GREY])) - 20.0).abs() < 1e-5);
    }

    #[test]
    fn colour_is_clamped_to_what_a_display_shows() {
        let reference = row_frame(&[vec4(1.0, 0.0, 0.5, 1.0)]);
        let test = row_frame(&[vec4(7.0, -3.0, 0.5, 1.0)]);
        assert_eq!(psnr(&test, &reference), f64::INFINITY);
        assert_eq!(max_abs_difference(&test, &reference), 6.0);
    }

    #[test]
    fn a_mask_chooses_pixels_by_index() {
        let reference = row_frame(&[GREY, GREY, GREY]);
        let test = row_frame(&[GREY, vec4(1.0, 1.0, 1.0, 1.0), GREY]);
        assert_eq!(psnr_where(&test, &reference, |index| index != 1), f64::INFINITY);
        assert!((psnr_where(&test, &reference, |index| index == 1) - 6.020_599_9).abs() < 1e-6);
        assert!(psnr_where(&test, &reference, |_| false).is_nan());
    }

    #[test]
    fn what_is_not_finite_is_as_wrong_as_can_be() {
        let reference = row_frame(&[GREY, GREY]);
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let test = row_frame(&[vec4(0.5, bad, 0.5, 1.0), GREY]);
            assert_eq!(mse(&test, &reference), 0.5);
            assert_eq!(mse(&reference, &test), 0.5);
            assert_eq!(max_abs_difference(&test, &reference), f64::INFINITY);
            assert_eq!(max_abs_difference(&test, &test), 0.0);
            assert_eq!(non_finite(&test), 1);
        }
        // Alpha is no part of the error, but is part of the count.
        let test = row_frame(&[vec4(0.5, 0.5, 0.5, f32::NAN), GREY]);
        assert_eq!(
            (mse(&test, &reference), non_finite(&test), non_finite(&reference)),
            (0.0, 1, 0)
        );
    }

    #[test]
    fn against_double_precision() {
        let test = row_frame(&[vec4(0.25, 0.5, 0.75, f32::NAN)]);
        assert_eq!(
            max_abs_difference_to(&test, &[[0.25, 0.5 + 1e-12, 0.75, f64::NAN]]),
            0.500000000001 - 0.5
        );
        assert_eq!(max_abs_difference_to(&test, &[[0.25, 0.5, 0.75, 1.0]]), f64::INFINITY);
    }

    #[test]
    #[should_panic(expected = "pictures of one size")]
    fn sizes_must_agree() {
        psnr(&row_frame(&[GREY]), &row_frame(&[GREY, GREY]));
    }
}
