//! Sample positions, typed from the documentation of Direct3D (`D3D11_STANDARD_MULTISAMPLE_QUALITY_LEVELS`) and
//! checked in the tests against the table in Vulkan's specification (*Standard sample locations*).

use super::params::{Pattern, Shading};

/// Offsets from the pixel's centre, in sixteenths of a pixel, y down.
pub(super) fn samples(pattern: Pattern) -> &'static [[i32; 2]] {
    match pattern {
        Pattern::Ordered4 => &[[-4, -4], [4, -4], [-4, 4], [4, 4]],
        Pattern::Latin4 => &[[-2, -6], [6, -2], [-6, 2], [2, 6]],
        #[rustfmt::skip]
        Pattern::Ordered16 => &[
            [-6, -6], [-2, -6], [2, -6], [6, -6],
            [-6, -2], [-2, -2], [2, -2], [6, -2],
            [-6,  2], [-2,  2], [2,  2], [6,  2],
            [-6,  6], [-2,  6], [2,  6], [6,  6],
        ],
        #[rustfmt::skip]
        Pattern::Latin16 => &[
            [ 1,  1], [-1, -3], [-3,  2], [ 4, -1],
            [-5, -2], [ 2,  5], [ 5,  3], [ 3, -5],
            [-2,  6], [ 0, -7], [-4, -6], [-6,  4],
            [-8,  0], [ 7, -4], [ 6,  7], [-7, -8],
        ],
    }
}

/// Offset of the shading sample from the pixel's centre, in sixteenths.
pub(super) fn shaded(pattern: Pattern, shading: Shading) -> [i32; 2] {
    match shading {
        Shading::Sample0 => samples(pattern)[0],
        Shading::Centre => [0, 0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vulkan counts from the pixel's top left corner.
    fn from_corner(pattern: Pattern) -> Vec<[f64; 2]> {
        samples(pattern)
            .iter()
            .map(|offset| offset.map(|axis| f64::from(axis) / 16.0 + 0.5))
            .collect()
    }

    #[test]
    fn as_vulkan_specifies() {
        assert_eq!(
            from_corner(Pattern::Latin4),
            [[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]]
        );
        #[rustfmt::skip]
        let sixteen = [
            [0.5625, 0.5625], [0.4375, 0.3125], [0.3125, 0.625], [0.75, 0.4375],
            [0.1875, 0.375], [0.625, 0.8125], [0.8125, 0.6875], [0.6875, 0.1875],
            [0.375, 0.875], [0.5, 0.0625], [0.25, 0.125], [0.125, 0.75],
            [0.0, 0.5], [0.9375, 0.25], [0.875, 0.9375], [0.0625, 0.0],
        ];
        assert_eq!(from_corner(Pattern::Latin16), sixteen);
    }

    #[test]
    fn latin_patterns_have_one_sample_in_each_row_and_column() {
        for (pattern, step) in [(Pattern::Latin4, 4), (Pattern::Latin16, 1)] {
            for axis in 0..2 {
                let mut cells: Vec<i32> = samples(pattern).iter().map(|s| (s[axis] + 8) / step).collect();
                cells.sort();
                assert_eq!(
                    cells,
                    (0..samples(pattern).len() as i32).collect::<Vec<_>>(),
                    "{}",
                    pattern.name()
                );
            }
        }
    }
}
