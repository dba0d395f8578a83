//! A chain of two results, which workgroups compute together.

use straightline_kernels::prelude::*;

fn mean(from: &Texture<Vec4>, pixel: IVec2) -> Vec4 {
    0.5 * (from.load(pixel * 2) + from.load(pixel * 2 + 1))
}

/// Two levels of a picture.
pub fn levels(color: &Texture<Vec4>) -> Vec<Texture<Vec4>> {
    let half: Texture<Vec4> = draw(color.size() / 2, |pixel| mean(color, pixel));
    let quarter: Texture<Vec4> = draw(half.size() / 2, |pixel| mean(&half, pixel));
    vec![half, quarter]
}
