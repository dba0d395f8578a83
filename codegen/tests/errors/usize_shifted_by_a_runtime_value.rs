use straightline_kernels::prelude::*;

pub fn k(ids: &Frame<u32>, pixel: IVec2) -> Vec4 {
    let bits = ids.load(pixel) as usize >> ids.load(pixel + 1);
    Vec4::splat((bits & 1) as f32)
}
