pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = color.load(pixel);
    #[cfg_attr(false, bound(8))]
    for i in 0..3 {
        sum *= i as f32;
    }
    #[cfg_attr(false, bound(0))]
    while sum.x > 1.0 {
        sum *= 0.5;
    }
    sum
}
