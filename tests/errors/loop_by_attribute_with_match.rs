pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    #[cfg_attr(false, unroll(2))]
    for i in 0..8 {
        let weight = match i {
            0 => 1.0,
            _ => 0.5,
        };
        sum += color.load(pixel + ivec2(i, 0)) * weight;
    }
    sum
}
