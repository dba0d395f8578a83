// The assignment on the right side of `&&` took place even if the left side was false at run time.
// expect 0 0: 1 1 1 1

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = 1.0;
    let both = pixel.x > 0 && {
        v = 2.0;
        true
    };
    Vec4::splat(v)
}
