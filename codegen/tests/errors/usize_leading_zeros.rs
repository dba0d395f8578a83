use straightline_kernels::prelude::*;

pub fn k(ids: &Frame<u32>, pixel: IVec2) -> Vec4 {
    Vec4::splat((ids.load(pixel) as usize).leading_zeros() as f32)
}
