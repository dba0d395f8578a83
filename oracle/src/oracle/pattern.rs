//! Sample positions, typed from the documentation of Direct3D (`D3D11_STANDARD_MULTISAMPLE_QUALITY_LEVELS`) and
//! checked in the tests against the table in Vulkan's specification (*Standard sample locations*). Those of
//! [`Pattern::Latin16`] are these from their mean on, as they should be by definition, numbered quadrant by quadrant.

use super::params::Pattern;

/// Offsets from the pixel's centre, in sixteenths of a pixel, y down; none of a pattern that is given as data.
fn sixteenths(pattern: Pattern) -> &'static [[i32; 2]] {
    match pattern {
        Pattern::Ordered4 => &[[-4, -4], [4, -4], [-4, 4], [4, 4]],
        Pattern::Latin4 => &[[-2, -6], [6, -2], [-6, 2], [2, 6]],
        #[rustfmt::skip]
        Pattern::Standard8 => &[
            [ 1, -3], [-1,  3], [ 5,  1], [-3, -5],
            [-5,  5], [-7, -1], [ 3,  7], [ 7, -7],
        ],
        #[rustfmt::skip]
        Pattern::Ordered16 => &[
            [-6, -6], [-2, -6], [2, -6], [6, -6],
            [-6, -2], [-2, -2], [2, -2], [6, -2],
            [-6,  2], [-2,  2], [2,  2], [6,  2],
            [-6,  6], [-2,  6], [2,  6], [6,  6],
        ],
        #[rustfmt::skip]
        Pattern::Latin16 => &[
            [ 1,  1], [ 2,  5], [ 5,  3], [ 6,  7],
            [-3,  2], [-2,  6], [-6,  4], [-8,  0],
            [-1, -3], [-5, -2], [-4, -6], [-7, -8],
            [ 4, -1], [ 3, -5], [ 0, -7], [ 7, -4],
        ],
        #[rustfmt::skip]
        Pattern::Standard16 => &[
            [ 1,  1], [-1, -3], [-3,  2], [ 4, -1],
            [-5, -2], [ 2,  5], [ 5,  3], [ 3, -5],
            [-2,  6], [ 0, -7], [-4, -6], [-6,  4],
            [-8,  0], [ 7, -4], [ 6,  7], [-7, -8],
        ],
        Pattern::Listed => &[],
    }
}

/// Offsets from the pixel's centre, in pixels, y down. Of [`Pattern::Listed`], `listed` in pairs.
pub(super) fn pattern_offsets(pattern: Pattern, listed: &[f64]) -> Vec<[f64; 2]> {
    match pattern {
        Pattern::Listed => listed.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect(),
        _ => {
            let hardware: Vec<[f64; 2]> = sixteenths(pattern)
                .iter()
                .map(|offset| offset.map(|axis| f64::from(axis) / 16.0))
                .collect();
            let mean = match pattern {
                Pattern::Latin16 => [0, 1].map(|axis| hardware.iter().map(|at| at[axis]).sum::<f64>() / 16.0),
                _ => [0.0; 2],
            };
            hardware.iter().map(|at| [at[0] - mean[0], at[1] - mean[1]]).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vulkan counts from the pixel's top left corner.
    fn from_corner(pattern: Pattern) -> Vec<[f64; 2]> {
        pattern_offsets(pattern, &[])
            .iter()
            .map(|offset| offset.map(|axis| axis + 0.5))
            .collect()
    }

    #[test]
    fn as_vulkan_specifies() {
        assert_eq!(
            from_corner(Pattern::Latin4),
            [[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]]
        );
        #[rustfmt::skip]
        let eight = [
            [0.5625, 0.3125], [0.4375, 0.6875], [0.8125, 0.5625], [0.3125, 0.1875],
            [0.1875, 0.8125], [0.0625, 0.4375], [0.6875, 0.9375], [0.9375, 0.0625],
        ];
        assert_eq!(from_corner(Pattern::Standard8), eight);
        #[rustfmt::skip]
        let sixteen = [
            [0.5625, 0.5625], [0.4375, 0.3125], [0.3125, 0.625], [0.75, 0.4375],
            [0.1875, 0.375], [0.625, 0.8125], [0.8125, 0.6875], [0.6875, 0.1875],
            [0.375, 0.875], [0.5, 0.0625], [0.25, 0.125], [0.125, 0.75],
            [0.0, 0.5], [0.9375, 0.25], [0.875, 0.9375], [0.0625, 0.0],
        ];
        assert_eq!(from_corner(Pattern::Standard16), sixteen);
        // 1/32 further down and to the right: in the middle of sixteen rows and columns.
        let sorted = |mut of: Vec<[f64; 2]>| {
            of.sort_by(|a, b| a[0].total_cmp(&b[0]));
            of
        };
        let centred = sixteen.map(|at| at.map(|axis| axis + 0.03125));
        assert_eq!(sorted(from_corner(Pattern::Latin16)), sorted(centred.to_vec()));
    }

    #[test]
    fn latin_squares_share_no_row_and_no_column() {
        for pattern in [
            Pattern::Latin4,
            Pattern::Standard8,
            Pattern::Latin16,
            Pattern::Standard16,
        ] {
            let samples = pattern_offsets(pattern, &[]);
            for axis in 0..2 {
                let mut cells: Vec<i64> = samples
                    .iter()
                    .map(|offset| ((offset[axis] + 0.5) * samples.len() as f64).floor() as i64)
                    .collect();
                cells.sort_unstable();
                cells.dedup();
                assert_eq!(cells.len(), samples.len(), "{pattern:?}");
            }
        }
    }
}
