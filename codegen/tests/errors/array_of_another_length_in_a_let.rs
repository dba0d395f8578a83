use straightline_kernels::prelude::*;

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let taps: [IVec2; 2] = [IVec2::ZERO, IVec2::X, IVec2::Y];
    color.load(pixel + taps[1])
}
