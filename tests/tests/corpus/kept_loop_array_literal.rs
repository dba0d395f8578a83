// An array that a structured loop assigns a literal: only its first element was the loop's result.
// expect 0 0: 0 0 0 0

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = [0.0, 0.0];
    for i in 0..pixel.x {
        v = [0.0, 1.0];
    }
    Vec4::splat(v[1])
}
