// A choice between arrays at run time, one of which was written at a runtime index: the interpreter
// had no `Select` of arrays, and WGSL has none.
// expect 0 0: -3 -3 -3 -3

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = [0.0, 1.0, 2.0];
    v[pixel.x.clamp(0, 2) as usize] -= 3.0;
    if pixel.y > 0 {
        v = [7.0, 8.0, 9.0];
    }
    Vec4::splat(v[0])
}
