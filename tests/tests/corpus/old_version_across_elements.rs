// An element that is changed by another element of the same array, one of them at a runtime index:
// cannot be emitted with a structured loop, "uses an old version of the array".
// expect 0 0: 1 2 0 0

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = [1.0, 2.0, 3.0];
    for i in 0..3 {
        v[0] -= 1.0;
        v[(pixel.x.clamp(0, 0)) as usize] += v[1] * 0.5;
    }
    vec4(v[0], v[1], 0.0, 0.0)
}
