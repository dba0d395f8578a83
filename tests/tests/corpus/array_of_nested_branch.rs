// With its loops left in the shader, an array made of a nested branch's result was computed before the branch that the
// result is in. expect 0 0: 1 1 1 1

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = [0.0, 0.0];
    if pixel.x > 0 {
        for i in 0..0 {
            v = v;
        }
    } else if pixel.x >= 0 {
        v[0] += 1.0;
    }
    Vec4::splat(v[0])
}
