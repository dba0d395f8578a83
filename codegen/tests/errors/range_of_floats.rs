pub fn k(color: &Frame<Vec4>, width: f32, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for i in 0..width {
        sum += color.load(pixel + ivec2(i, 0));
    }
    sum
}
