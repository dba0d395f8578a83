pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    for i in 0.. {
        sum += 1.0;
    }
    color.load(pixel) * sum
}
