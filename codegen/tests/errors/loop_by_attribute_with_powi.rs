pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    #[cfg_attr(false, unroll(2))]
    for i in 1..8 {
        sum += color.load(pixel + ivec2(i, 0)) * 0.5_f32.powi(i);
    }
    sum
}
