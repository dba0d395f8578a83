// Of a structured loop's variables one takes the old value of another, which then changes: the text changes the other first.
// expect 0 0: 0 0 0 0

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut w = 0.0;
    let mut v = Vec4::ZERO;
    for i in 0..1 {
        w = v.z;
        v.z += 1.0;
    }
    Vec4::splat(w)
}
