// An array in a tuple: the loop's results went to the wrong parts, and the kernel was rejected.
// expect 0 0: 0 0 0 0

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = (0.0, [0.0, 0.0], 0u32);
    for i in 0..pixel.y {
        v.1 = [1.0; 2];
    }
    Vec4::splat(v.0 + v.1[0] + v.1[1])
}
