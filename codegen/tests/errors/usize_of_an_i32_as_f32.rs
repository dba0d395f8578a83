use straightline_kernels::prelude::*;

pub fn k(color: &Frame<Vec4>, offset: i32, pixel: IVec2) -> Vec4 {
    color.load(pixel) * offset as usize as f32
}
