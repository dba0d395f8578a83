//! The Kuwahara filter with its default options, its loops left in the shader: each of the 7×7 pixels is read once, and half a
//! row is summed once for the two quadrants that share it. An array of all pixels was slower than reading them again.

use straightline_kernels::prelude::*;

/// Equals `kuwahara`, except for rounding: between two quadrants of similar variance, they may choose differently.
pub fn kuwahara(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    // Upper left, upper right, lower left, lower right.
    let mut sums = [Vec3::ZERO; 4];
    let mut squares = [Vec3::ZERO; 4];
    let mut alpha = 0.0;
    for y in -3..=3 {
        let middle = color.load(pixel + ivec2(0, y));
        let own = middle.truncate();
        let (mut left, mut right) = (own, own);
        let (mut left_squares, mut right_squares) = (own * own, own * own);
        for x in 1..=3 {
            let before = color.load(pixel + ivec2(-x, y)).truncate();
            let after = color.load(pixel + ivec2(x, y)).truncate();
            left += before;
            left_squares += before * before;
            right += after;
            right_squares += after * after;
        }
        if y <= 0 {
            sums[0] += left;
            squares[0] += left_squares;
            sums[1] += right;
            squares[1] += right_squares;
        }
        if y >= 0 {
            sums[2] += left;
            squares[2] += left_squares;
            sums[3] += right;
            squares[3] += right_squares;
        }
        if y == 0 {
            alpha = middle.w;
        }
    }
    let mut best = Vec3::ZERO;
    let mut least = f32::MAX;
    for quarter in 0..4 {
        let mean = sums[quarter] / 16.0;
        let variance = (squares[quarter] / 16.0 - mean * mean).element_sum();
        if variance < least {
            least = variance;
            best = mean;
        }
    }
    best.extend(alpha)
}
