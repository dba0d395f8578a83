//! Comparison of pictures, in bytes of sRGB as files have them.

use super::srgb::to_srgb8;
use std::fmt;

/// Greatest difference of a picture from its golden file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Likeness {
    /// All bytes are equal.
    Exact,
    /// No component of a pixel is farther away; 1 is from black to white, in sRGB.
    Absolute(f32),
    /// Least ratio of peak signal to noise, in decibels.
    Psnr(f32),
}

impl fmt::Display for Likeness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Likeness::Exact => f.write_str("exactly()"),
            Likeness::Absolute(e) => write!(f, "absolute({e:?})"),
            Likeness::Psnr(least) => write!(f, "psnr({least:?})"),
        }
    }
}

/// Difference of a picture from its golden file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Ratio of peak signal to noise in decibels, of the components in sRGB; alpha counts if one of the pictures uses it.
    pub psnr: f64,
    /// Pixels that differ.
    pub count: usize,
    /// The pixel that differs most, the first of several, or the first with a NaN.
    pub worst: [u32; 2],
    /// Its texel, not rounded to bytes.
    pub texel: [f32; 4],
    /// Its bytes in the picture and in the file.
    pub bytes: [[u8; 4]; 2],
}

/// Compares a picture of `width` with the bytes of its golden file. Returns `None` if all bytes are equal.
///
/// ```
/// use straightline_kernels::pictures::{Likeness, compare_pictures};
///
/// let (white, golden) = ([1.0; 4], [[255; 4], [254, 255, 255, 255]]);
/// let difference = compare_pictures(2, &[white, white], &golden).expect("one byte differs");
/// assert_eq!(difference.worst, [1, 0]);
/// assert!(difference.is_within(Likeness::Psnr(50.0)) && !difference.is_within(Likeness::Exact));
/// ```
pub fn compare_pictures(width: u32, texels: &[[f32; 4]], golden: &[[u8; 4]]) -> Option<Difference> {
    let mut found: Option<Difference> = None;
    let (mut squares, mut translucent, mut most) = (0.0f64, false, 0);
    for (k, (texel, golden)) in texels.iter().zip(golden).enumerate() {
        let bytes = to_srgb8(*texel);
        translucent |= bytes[3] != 255 || golden[3] != 255;
        let apart = [0, 1, 2, 3].map(|c| u32::from(bytes[c].abs_diff(golden[c])));
        squares += apart.iter().map(|apart| f64::from(apart * apart)).sum::<f64>();
        // A file has no NaN, whatever byte stands for it.
        let apart = match texel.iter().any(|component| component.is_nan()) {
            true => 256,
            false => apart.into_iter().max().unwrap_or(0),
        };
        if apart == 0 {
            continue;
        }
        let count = found.map_or(0, |found| found.count) + 1;
        if apart > most {
            most = apart;
            found = Some(Difference {
                psnr: 0.0,
                count,
                worst: [k as u32 % width, k as u32 / width],
                texel: *texel,
                bytes: [bytes, *golden],
            });
        } else if let Some(found) = &mut found {
            found.count = count;
        }
    }
    let components = texels.len() * if translucent { 4 } else { 3 };
    let mut found = found?;
    found.psnr = 10.0 * (255.0 * 255.0 * components as f64 / squares).log10();
    Some(found)
}

impl Difference {
    /// Returns whether a test takes the difference.
    pub fn is_within(&self, likeness: Likeness) -> bool {
        let [own, golden] = self.bytes;
        let apart = own.iter().zip(golden).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0);
        let is_nan = self.texel.iter().any(|component| component.is_nan());
        !is_nan
            && match likeness {
                Likeness::Exact => false,
                Likeness::Absolute(e) => f32::from(apart) <= e * 255.0,
                Likeness::Psnr(least) => self.psnr >= f64::from(least),
            }
    }
}

impl fmt::Display for Difference {
    /// `41.20 dB; 3 pixels differ, most at (7, 2): [255, 0, 0, 255] instead of [250, 0, 0, 255]`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x, y], [own, golden]) = (self.worst, self.bytes);
        let differ = if self.count == 1 {
            "pixel differs"
        } else {
            "pixels differ"
        };
        write!(f, "{:.2} dB; {} {differ}, most at ({x}, {y}): ", self.psnr, self.count)?;
        match self.texel.iter().any(|component| component.is_nan()) {
            true => write!(f, "{:?} instead of {golden:?}", self.texel),
            false => write!(f, "{own:?} instead of {golden:?}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GREY: [f32; 4] = [0.5, 0.5, 0.5, 1.0];

    #[test]
    fn differences_are_measured_in_bytes() {
        let golden = vec![to_srgb8(GREY); 6];
        assert_eq!(compare_pictures(3, &[GREY; 6], &golden), None);
        let mut drawn = [GREY; 6];
        drawn[4] = [1.0, 0.5, 0.5, 1.0];
        drawn[5] = [0.51, 0.5, 0.5, 1.0];
        let found = compare_pictures(3, &drawn, &golden).expect("they differ");
        assert_eq!((found.worst, found.count), ([1, 1], 2));
        assert_eq!(found.bytes, [[255, 188, 188, 255], [188, 188, 188, 255]]);
        // 67 and 1 of 255 in 2 of 18 components.
        let squares = (67.0 * 67.0 + 1.0) / 18.0;
        assert!(
            (found.psnr - 10.0 * (65025.0f64 / squares).log10()).abs() < 1e-9,
            "{found}"
        );
        assert!(found.is_within(Likeness::Psnr(24.0)) && !found.is_within(Likeness::Psnr(25.0)));
        assert!(found.is_within(Likeness::Absolute(68.0 / 255.0)) && !found.is_within(Likeness::Absolute(0.25)));
        assert!(!found.is_within(Likeness::Exact));
        assert_eq!(
            found.to_string(),
            "24.16 dB; 2 pixels differ, most at (1, 1): [255, 188, 188, 255] instead of [188, 188, 188, 255]"
        );
    }

    #[test]
    fn a_nan_is_within_nothing_and_alpha_counts_where_it_is_used() {
        let black = [0, 0, 0, 255];
        let mut drawn = [[0.0, 0.0, 0.0, 1.0]; 2];
        drawn[1][2] = f32::NAN;
        let found = compare_pictures(2, &drawn, &[black; 2]).expect("a NaN is no black");
        assert!(
            !found.is_within(Likeness::Psnr(0.0)) && found.to_string().contains("NaN"),
            "{found}"
        );
        let clear = compare_pictures(1, &[[0.0; 4]], &[black]).expect("alpha differs");
        assert!((clear.psnr - 10.0 * 4.0f64.log10()).abs() < 1e-9, "{clear}");
    }
}
