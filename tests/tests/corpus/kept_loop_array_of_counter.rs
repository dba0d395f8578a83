// An array with an element computed from the counter: the output depended on the region's parameter.
// expect 0 0: 0 0 0 0

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = [0.0, 0.0];
    for i in 0..pixel.x {
        v = [0.0, i as f32];
    }
    Vec4::splat(v[1])
}
