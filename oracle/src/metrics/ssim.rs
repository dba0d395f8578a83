//! Structural similarity (Wang et al. 2004), with the paper's constants: Gaussian windows of 11 x 11 pixels.
//!
//! Not by a crate: of those that there are, `image-compare` 0.5 takes sums for the variances that the formula asks for and knows
//! 8 bits only, and `dssim-core` is another measure under another licence. The tests compare with scikit-image.

use super::display::encode_for_display;
use glam::{Vec3, Vec4, dvec3};
use rayon::prelude::*;
use straightline_kernels::prelude::Frame;

/// Side of a window in pixels, and standard deviation of its weights.
const SIDE: usize = 11;
const SIGMA: f64 = 1.5;
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// Mean structural similarity of luma (Rec. 709, of sRGB values) over all windows that lie wholly in the picture: 1 for equal
/// pictures, down to -1. Along a side of less than 11 pixels a window is as long as the side.
pub fn ssim(test: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
    let shown = encode_for_display(test, reference);
    let luma = |texels: &[Vec3]| -> Vec<f64> {
        let weights = dvec3(0.2126, 0.7152, 0.0722);
        texels.iter().map(|texel| texel.as_dvec3().dot(weights)).collect()
    };
    let (x, y) = (luma(&shown.test), luma(&shown.reference));
    let (width, height) = (test.size().x as usize, test.size().y as usize);
    let (across, down) = (gaussian_weights(width.min(SIDE)), gaussian_weights(height.min(SIDE)));
    let rows: Vec<f64> = (0..=height - down.len())
        .into_par_iter()
        .map(|top| {
            let columns = weighted_columns(&x, &y, width, top, &down);
            let windows = columns.windows(across.len());
            windows.map(|window| window_similarity(window, &across)).sum::<f64>()
        })
        .collect();
    let mut sum = rows.iter().sum::<f64>();
    let (inner_width, inner_height) = (width - across.len() + 1, height - down.len() + 1);
    // A window around a non-finite pixel counts as completely wrong.
    for index in shown.bad {
        let left = (index % width)
            .checked_sub(across.len() / 2)
            .filter(|left| *left < inner_width);
        let top = (index / width)
            .checked_sub(down.len() / 2)
            .filter(|top| *top < inner_height);
        if let (Some(left), Some(top)) = (left, top) {
            let columns = weighted_columns(&x, &y, width, top, &down);
            sum -= 1.0 + window_similarity(&columns[left..left + across.len()], &across);
        }
    }
    sum / (inner_width * inner_height) as f64
}

/// Weights of `length` pixels in a row, which sum to 1.
fn gaussian_weights(length: usize) -> Vec<f64> {
    let middle = (length as f64 - 1.0) / 2.0;
    let weight = |k: usize| (-(k as f64 - middle).powi(2) / (2.0 * SIGMA * SIGMA)).exp();
    let sum: f64 = (0..length).map(weight).sum();
    (0..length).map(|k| weight(k) / sum).collect()
}

/// For each column of the rows from `top` on, weighted means of x, y, x², y² and xy.
fn weighted_columns(x: &[f64], y: &[f64], width: usize, top: usize, down: &[f64]) -> Vec<[f64; 5]> {
    let mut columns = vec![[0.0; 5]; width];
    for (row, weight) in down.iter().enumerate() {
        let first = (top + row) * width;
        let pairs = x[first..first + width].iter().zip(&y[first..first + width]);
        for (column, (x, y)) in columns.iter_mut().zip(pairs) {
            for (sum, value) in column.iter_mut().zip([*x, *y, x * x, y * y, x * y]) {
                *sum += weight * value;
            }
        }
    }
    columns
}

fn window_similarity(window: &[[f64; 5]], across: &[f64]) -> f64 {
    let mut means = [0.0; 5];
    for (column, weight) in window.iter().zip(across) {
        for (mean, value) in means.iter_mut().zip(column) {
            *mean += weight * value;
        }
    }
    let [x, y, xx, yy, xy] = means;
    let (variances, covariance) = (xx - x * x + yy - y * y, xy - x * y);
    (2.0 * x * y + C1) * (2.0 * covariance + C2) / ((x * x + y * y + C1) * (variances + C2))
}
