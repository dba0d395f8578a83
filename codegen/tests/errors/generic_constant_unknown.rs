fn power<const N: usize>(x: f32) -> f32 {
    let mut p = 1.0;
    for _ in 0..N {
        p *= x;
    }
    p
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * power(2.0)
}
