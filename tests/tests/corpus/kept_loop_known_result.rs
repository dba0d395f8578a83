// An integer that a structured loop assigns a known value kept that value even if the loop had no round.
// expect 0 0: 0 0 0 0

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = 0;
    for i in 0..0 {
        v = 1;
    }
    Vec4::splat(v as f32)
}
