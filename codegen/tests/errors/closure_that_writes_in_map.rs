pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut n = 0.0;
    let sum: f32 = [1.0, 2.0]
        .iter()
        .map(|x| {
            n += x;
            n
        })
        .sum();
    color.load(pixel) * sum
}
