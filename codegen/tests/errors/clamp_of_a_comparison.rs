use straightline_kernels::prelude::*;

fn level() -> f32 {
    if 2 > 1 {
        return 0.5;
    }
    (0.25 < 0.5f32).clamp(-9.0, 9.0) as u32 as f32
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * level()
}
