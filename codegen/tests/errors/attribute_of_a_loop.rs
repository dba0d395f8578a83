pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    #[cfg_attr(false, unroll(some))]
    for i in 0..3 {
        sum += 1.0;
    }
    #[cfg_attr(false, branch)]
    for i in 0..3 {
        sum += 1.0;
    }
    color.load(pixel) * sum
}
