pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let a = [1.0, 2.0, 3.0];
    let mut sum = 0.0;
    for i in 0..=3 {
        sum += a[i];
    }
    color.load(pixel) * sum
}
