// `iter` of an array that was written at a runtime index was refused.
// expect 0 0: 8 8 8 8

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = [0.0, 1.0, 2.0];
    v[pixel.x.clamp(0, 2) as usize] = 5.0;
    let mut sum = 0.0;
    for &x in v.iter() {
        sum += x;
    }
    Vec4::splat(sum)
}
