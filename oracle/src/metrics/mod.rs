//! Metrics of a picture's distance from its reference.
//!
//! [`psnr()`] compares linear colour clamped to 0..=1. [`ssim()`] and [`flip()`] compare what a display shows: linear colour
//! clamped to 0..=1, in the transfer function of sRGB. Alpha is not compared. A pixel with a red, green or blue that is
//! not finite, in either picture, counts as wrong as can be in all of them: a NaN must never look like a small error.
//!
//! Every function that takes two pictures panics unless they have the same size.

mod display;
mod flip;
mod psnr;
mod ssim;
#[cfg(test)]
mod tests;

pub use flip::{flip, flip_map};
pub use psnr::{
    MOST_DB, max_abs_difference, max_abs_difference_to, mse, mse_where, non_finite, psnr, psnr_where, worst_error,
};
pub use ssim::ssim;
