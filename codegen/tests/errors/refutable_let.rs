pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (x, 0..=3) = (2.0, pixel.x);
    for (1, y) in [(1, 2.0), (2, 3.0)] {
        return color.load(pixel) * x * y;
    }
    color.load(pixel)
}
