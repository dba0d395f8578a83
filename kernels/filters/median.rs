//! The median of 3×3 pixels by a network of 19 exchanges (Devillard 1998).

use straightline_kernels::prelude::*;

/// Pairs to sort, in this order. Afterwards the median is in the middle.
const EXCHANGES: [(usize, usize); 19] = [
    (1, 2),
    (4, 5),
    (7, 8),
    (0, 1),
    (3, 4),
    (6, 7),
    (1, 2),
    (4, 5),
    (7, 8),
    (0, 3),
    (5, 8),
    (4, 7),
    (3, 6),
    (1, 4),
    (2, 5),
    (4, 7),
    (4, 2),
    (6, 4),
    (4, 2),
];

/// Median of each component over the 3×3 pixels around.
pub fn median(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut values = [Vec4::ZERO; 9];
    for k in 0..9 {
        values[k] = color.load(pixel + ivec2(k as i32 % 3 - 1, k as i32 / 3 - 1));
    }
    for (low, high) in EXCHANGES {
        let (a, b) = (values[low], values[high]);
        values[low] = a.min(b);
        values[high] = a.max(b);
    }
    values[4]
}
