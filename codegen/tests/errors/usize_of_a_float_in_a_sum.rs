use straightline_kernels::prelude::*;

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let bin = ((color.load(pixel).x * 8.0) as usize + 1) % 8;
    color.load(pixel) * bin as f32
}
